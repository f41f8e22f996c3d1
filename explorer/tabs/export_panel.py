"""The Export folder: shapes, tables, the disk as a drawing, the 3D scene and the report."""

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
from explorer.export.files import File
from explorer.interface import SessionState, TabContext
from explorer.picture.fields import FIELDS, Field, shown_field
from explorer.scene.still_scene import make_stage
from explorer.text.glossary import hint
from explorer.undo import KeptDesign

_log = logging.getLogger(__name__)
_SHAPES = {"Jig STL": files.jig_file, "Flown STL": files.flown_file, "Rotor GLB": files.rotor_file}


@dataclass(frozen=True)
class ExportSources:
    """What the folder needs beyond its context."""

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
            drawing = gui.add_button("Disk as SVG", color="gray", hint=hint("export_picture"))
            scene = gui.add_button(
                "3D scene as one file", icon=viser.Icon.CUBE, color="gray", hint=hint("export_scene")
            )
            report = gui.add_button(
                "Report of this session", icon=viser.Icon.REPORT, color="gray", hint=hint("export_report")
            )
            self._state = gui.add_html("")
        self._say("idle", "Exports the design on the sliders.")
        shapes.on_click(lambda event: self._save(_SHAPES[event.target.value]))
        tables.on_click(self._table_clicked)
        drawing.on_click(lambda _: self._save(self._drawing))
        scene.on_click(lambda _: self._save(self._scene))
        report.on_click(lambda _: self._do("the report", self._report))
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

    def _drawing(self, state: SessionState) -> File:
        colour_range = self._sources.colour_range(shown_field(state.view, state.pinned))
        return files.disk_drawing_file(state, colour_range)

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
            self._say("problem", f"Making {what} failed ({error}): try again.")
        finally:
            self._busy.release()

    def _say(self, kind: str, sentence: str) -> None:
        self._state.content = (
            f'<div class="rx rx-small rx-export" data-explorer="export" data-kind="{kind}">{escape(sentence)}</div>'
        )
