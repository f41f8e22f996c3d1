"""The Export folder: shapes, tables, pictures, the report, and the design as text to run elsewhere."""

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from html import escape
from typing import Any

import viser

from explorer.charts.plots import Range
from explorer.charts.power_curve import PowerCurves
from explorer.export import files
from explorer.export.as_code import as_command_line, as_python
from explorer.export.files import File
from explorer.export.sheet import LARGEST, SIZES, SMALLEST, DiskContent, Paper, disk_sheet, shown, view_sheet, window
from explorer.hosting import browser
from explorer.interface import SessionState, TabContext
from explorer.picture.fields import FIELDS, Field, shown_field
from explorer.picture.png import encode_rgba
from explorer.scene.camera import FittedCamera
from explorer.scene.still_scene import make_stage
from explorer.text.glossary import hint
from explorer.undo import KeptDesign

_log = logging.getLogger(__name__)
_OWN = "Own size"
_DISK, _VIEW = "Disk", "3D view"
_PATIENCE = 90.0
"""[s] for the page to draw; browsers that draw in software take some."""
_SHAPES = {"Jig STL": files.jig_file, "Flown STL": files.flown_file, "Rotor GLB": files.rotor_file}


@dataclass(frozen=True)
class ExportSources:
    """What the folder needs beyond its context."""

    camera: Callable[[], FittedCamera]
    kept: Callable[[], tuple[KeptDesign, ...]]
    """Designs that were set aside."""
    colour_range: Callable[[Field], Range]
    """As it is held on the page."""


class ExportPanel:
    """One session's. Each file is made on a thread of its own, one at a time; what fails is a sentence."""

    def __init__(
        self, client: viser.ClientHandle, context: TabContext, sources: ExportSources, open_drawer: Callable[[], None]
    ) -> None:
        """`open_drawer`: brings the folder before the eyes."""
        self._client, self._context, self._sources = client, context, sources
        self._busy = threading.Lock()
        self._curves = PowerCurves()
        self._stale = False
        """Whether the sliders mean a design without an answer, so that the last good one is exported."""
        gui = client.gui
        with gui.add_folder("Export"):
            shapes = gui.add_button_group("Shape", tuple(_SHAPES), hint=hint("export_shape"))
            tables = gui.add_button_group("CSV", ("Disk", "Blade", "Power"), hint=hint("export_table"))
            self._what = gui.add_dropdown("Picture", (_DISK, _VIEW), hint=hint("export_picture"))
            size = list(SIZES)[1]
            self._size = gui.add_dropdown("Size [px]", (*SIZES, _OWN), initial_value=size, hint=hint("export_size"))
            low, high = (SMALLEST, SMALLEST), (LARGEST, LARGEST)
            self._own = gui.add_vector2(
                "W, H [px]", (1600, 900), min=low, max=high, step=1, visible=False, hint=hint("export_own")
            )
            self._clear = gui.add_checkbox("Transparent", False, hint=hint("export_clear"))
            pictures = gui.add_button_group("Save as", ("PNG", "SVG"), hint=hint("export_kind"))
            scene = gui.add_button(
                "3D scene as one file", icon=viser.Icon.CUBE, color="gray", hint=hint("export_scene")
            )
            report = gui.add_button(
                "Report of this session", icon=viser.Icon.REPORT, color="gray", hint=hint("export_report")
            )
            texts = gui.add_button_group("Copy as", ("Python", "Command"), hint=hint("export_text"))
            self._state = gui.add_html("")
        self._say("idle", "Exports the design on the sliders.")
        shapes.on_click(lambda event: self._save(_SHAPES[event.target.value]))
        tables.on_click(self._table_clicked)
        self._size.on_update(lambda _: self._size_changed())
        pictures.on_click(lambda event: self._picture(event.target.value))
        scene.on_click(lambda _: self._save(self._scene))
        report.on_click(lambda _: self._do("the report", self._report))
        texts.on_click(self._text_clicked)
        context.bind_command("export", open_drawer)

    def show(self, state: SessionState) -> None:
        """Files are made from the state of the session when they are asked for."""
        self._stale = False

    def show_failure(self) -> None:
        """The last good answer is still exported, and the line says so."""
        self._stale = True

    def stop(self) -> None:
        """A file under way is made for nobody."""

    def _save(self, make: Callable[[SessionState], File]) -> None:
        def work(state: SessionState) -> str:
            file = make(state)
            self._context.download(file.name, file.content)
            return f"{file.name}, {file.size}"

        self._do("the file", work)

    def _table_clicked(self, event: viser.GuiEvent[Any]) -> None:
        makers: dict[str, Callable[[SessionState], File]] = {
            "Disk": files.disk_file,
            "Blade": files.along_file,
            "Power": lambda state: files.power_file(state, self._curves),
        }
        self._save(makers[event.target.value])

    def _size_changed(self) -> None:
        self._own.visible = self._size.value == _OWN

    def _paper(self, state: SessionState) -> Paper:
        """ValueError with one sentence for a size that cannot be."""
        width, height = SIZES.get(self._size.value) or (round(edge) for edge in self._own.value)
        return Paper(width, height, state.view.dark, self._clear.value)

    def _picture(self, kind: str) -> None:
        flat = self._what.value == _DISK
        if not flat and kind == "SVG":
            self._say("problem", "The 3D view is a pixel image: save it as PNG, or choose the disk.")
            return
        self._do("the picture", lambda state: self._disk_picture(state, kind) if flat else self._view_picture(state))

    def _shown(self, state: SessionState) -> DiskContent:
        field = shown_field(state.view, state.pinned)
        note = f"A: {state.pin.title}" if state.pin is not None and field.title not in FIELDS else ""
        return shown(state.view, field, self._sources.colour_range(field), note)

    def _disk_picture(self, state: SessionState, kind: str) -> str:
        paper, on_disk = self._paper(state), self._shown(state)
        drawing = disk_sheet(state.solution, on_disk, paper)
        name = files.picture_name(state.solution, on_disk, "disk", paper, kind.lower())
        if kind == "SVG":
            file = File(name, drawing.encode("utf-8"))
            self._context.download(file.name, file.content)
            return f"{file.name}, {file.size}"
        return self._draw(drawing, paper, name)

    def _view_picture(self, state: SessionState) -> str:
        paper, on_disk = self._paper(state), self._shown(state)
        if state.view.exaggeration != 1.0:
            times = f"Twist exaggeration × {state.view.exaggeration:g}"
            on_disk = replace(on_disk, note=f"{on_disk.note}. {times}" if on_disk.note else times)
        *_, wide, high = window(state.solution, paper)
        wxyz, position, fov = self._sources.camera().pictured(wide / high)
        pixels = self._client.get_render(
            high, wide, wxyz=wxyz, position=position, fov=fov, transport_format="png", timeout=_PATIENCE
        )
        drawing = view_sheet(state.solution, on_disk, paper, encode_rgba(pixels))
        return self._draw(drawing, paper, files.picture_name(state.solution, on_disk, "view", paper, "png"))

    def _draw(self, drawing: str, paper: Paper, name: str) -> str:
        made = browser.save_picture(self._client, drawing, (paper.width, paper.height), name, _PATIENCE)
        return f"{name}, {made / 1e3:.0f} kB"

    def _scene(self, state: SessionState) -> File:
        return files.scene_file(state, self._sources.colour_range(FIELDS[state.view.field]))

    def _report(self, state: SessionState) -> str:
        view = replace(state.view, difference=False)
        field = FIELDS[view.field]
        report = files.session_report(state, self._sources.kept(), self._sources.colour_range(field))
        stage = make_stage([entry.solution for entry in report.shown], view, report.colour_range(field))
        file = files.report_file(report, stage, self._curves)
        self._context.download(file.name, file.content)
        return f"{file.name}, {file.size}, {len(report.shown)} design{'s' if len(report.shown) > 1 else ''}"

    def _text_clicked(self, event: viser.GuiEvent[Any]) -> None:
        python = event.target.value == "Python"

        def work(state: SessionState) -> str:
            text = as_python(state.solution.design) if python else as_command_line(state.solution.design).text
            browser.copy_text(self._client, text)
            self._show_text("As Python" if python else "As a command line", text)
            return "Copied to the clipboard where the browser allows it."

        self._do("the text", work)

    def _show_text(self, title: str, text: str) -> None:
        """Over the page, to be read and selected."""
        gui = self._client.gui
        with gui.add_modal(title) as modal:
            gui.add_html(
                '<div class="rx rx-dim">Copied where the browser allows it; otherwise select it here.</div>'
                f'<pre class="rx-code" data-explorer="code">{escape(text)}</pre>'
            )
            gui.add_button("Close", hint=hint("close")).on_click(lambda _: modal.close())

    def _do(self, what: str, work: Callable[[SessionState], str]) -> None:
        """Start `work`, unless other work is under way; it returns what was made."""
        state = self._context.state()
        if state is None:
            self._say("problem", "There is no solution yet: wait for the first.")
        elif not self._busy.acquire(blocking=False):
            self._say("busy", f"Busy: {what} can be made after that.")
        else:
            self._say("busy", f"Making {what} …")
            threading.Thread(target=self._work, args=(what, work, state), name="export", daemon=True).start()

    def _work(self, what: str, work: Callable[[SessionState], str], state: SessionState) -> None:
        begin = time.perf_counter()
        try:
            made = work(state)
            stale = " This is the last converged solution: the sliders have none." if self._stale else ""
            self._say("done", f"{made} ({time.perf_counter() - begin:.1f} s).{stale}")
        except (ValueError, TimeoutError) as error:
            self._say("problem", str(error))
        except Exception as error:  # The session goes on whatever a file meets.
            _log.exception("export of %s failed", what)
            self._say("problem", f"Making {what} failed ({error}): try again, or another size.")
        finally:
            self._busy.release()

    def _say(self, kind: str, sentence: str) -> None:
        self._state.content = (
            f'<div class="rx rx-small rx-export" data-explorer="export" data-kind="{kind}">{escape(sentence)}</div>'
        )
