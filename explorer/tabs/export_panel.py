"""The Export folder: shapes, tables, the disk as a drawing, a picture of the view, the 3D scene and the report."""

import io
import logging
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from html import escape

import viser
from PIL import Image

from explorer.charts.power_curve import PowerCurves
from explorer.export import files
from explorer.export.files import File
from explorer.export.report.contents import judged_actuator
from explorer.model.session_state import SessionState
from explorer.picture.fields import FIELDS, shown_field
from explorer.scene.controller import SceneController
from explorer.scene.still_scene import make_stage
from explorer.tabs.context import Tab, TabContext
from explorer.tabs.history_panel import HistoryPanel
from explorer.text.glossary import hint
from rotor.actuator.verdict import Verdict

_log = logging.getLogger(__name__)
_PATIENCE = 90.0
"""[s] for the page to draw; browsers that draw in software take some."""
_WIDTH = 1920
"""[px] of a picture of the view."""


class ExportPanel(Tab):
    """One session's. Each file is made on a thread of its own, one at a time; what fails is a sentence."""

    def __init__(
        self,
        context: TabContext,
        scene: SceneController,
        history: HistoryPanel,
        actuator: Callable[[], Verdict | str],
    ) -> None:
        """`actuator`: the verdict on the one chosen, why there is none, or empty where none was."""
        self._context, self._scene, self._history, self._actuator = context, scene, history, actuator
        self._busy = threading.Lock()
        self._curves = PowerCurves()
        self._stale = False
        """Whether the sliders mean a design without an answer, so that the last good one is exported."""
        shapes = {"Jig STL": files.jig_file, "Flown STL": files.flown_file, "Rotor GLB": files.rotor_file}
        tables: dict[str, Callable[[SessionState], File]] = {
            "Disk": files.disk_file,
            "Blade": files.along_file,
            "Power": lambda state: files.power_file(state, self._curves),
        }
        pictures = {"Disk as SVG": self._disk_drawing, "View as PNG": self._view_picture}
        gui = context.gui
        with gui.add_folder("Export"):
            for label, makers, name in (
                ("Shape", shapes, "export_shape"),
                ("CSV", tables, "export_table"),
                ("Picture", pictures, "export_picture"),
            ):
                group = gui.add_button_group(label, tuple(makers), hint=hint(name))
                group.on_click(lambda event, makers=makers: self._save("the file", makers[event.target.value]))
            page = gui.add_button("3D scene as one file", icon=viser.Icon.CUBE, color="gray", hint=hint("export_scene"))
            report = gui.add_button(
                "Report of this session", icon=viser.Icon.REPORT, color="gray", hint=hint("export_report")
            )
            self._state = gui.add_html("")
        self._say("idle", "Exports the design on the sliders.")
        page.on_click(lambda _: self._save("the file", self._scene_page))
        report.on_click(lambda _: self._save("the report", self._report))
        context.keyboard.bind("export", lambda: context.layout.open_drawer("share"))

    def show(self, state: SessionState) -> None:
        """Files are made from the state of the session when they are asked for."""
        self._stale = False

    def show_failure(self) -> None:
        """The last good answer is still exported, and the line says so."""
        self._stale = True

    def _disk_drawing(self, state: SessionState) -> File:
        return files.disk_drawing_file(state, self._scene.held_range(shown_field(state.view, state.pinned)))

    def _view_picture(self, state: SessionState) -> File:
        """The scene as the page's camera sees it; what the frame draws over it is not in the picture."""
        client = self._context.client
        height = round(_WIDTH / client.camera.aspect)
        pixels = client.get_render(height, _WIDTH, transport_format="png", timeout=_PATIENCE)
        png = io.BytesIO()
        Image.fromarray(pixels).save(png, "PNG")
        return File(f"{files.file_stem(state.solution.design, 'view', f'{_WIDTH}x{height}')}.png", png.getvalue())

    def _scene_page(self, state: SessionState) -> File:
        return files.scene_file(state, self._scene.held_range(FIELDS[state.view.field]))

    def _report(self, state: SessionState) -> File:
        view = replace(state.view, difference=False)
        outcome = self._actuator()
        actuator = outcome if isinstance(outcome, str) else judged_actuator(outcome)
        colour_range = self._scene.held_range(FIELDS[view.field])
        report = files.session_report(state, self._history.kept, colour_range, actuator)
        stage = make_stage([entry.solution for entry in report.shown], view, report.colour_range(FIELDS[view.field]))
        return files.report_file(report, stage, self._curves)

    def _save(self, what: str, make: Callable[[SessionState], File]) -> None:
        """Make a file and send it, unless another is under way."""
        state = self._context.state()
        if state is None:
            self._say("problem", "There is no solution yet: wait for the first.")
        elif not self._busy.acquire(blocking=False):
            self._say("busy", f"Busy: {what} can be made after that.")
        else:
            self._say("busy", f"Making {what} …")
            threading.Thread(target=self._make, args=(what, make, state), name="export", daemon=True).start()

    def _make(self, what: str, make: Callable[[SessionState], File], state: SessionState) -> None:
        begin = time.perf_counter()
        try:
            file = make(state)
            self._context.download(file.name, file.content)
            stale = " This is the last converged solution: the sliders have none." if self._stale else ""
            self._say("done", f"{file.name}, {file.size} ({time.perf_counter() - begin:.1f} s).{stale}")
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
