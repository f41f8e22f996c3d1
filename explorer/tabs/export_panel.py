"""The Export folder: shapes, tables, the disk as a drawing, a picture of the view, the 3D scene and the report."""

import io
import logging
import math
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from html import escape

import viser
from PIL import Image

from explorer.charts.plots import PowerCurves, Range
from explorer.export.blade import blade_stl, flown_design, rotor_glb
from explorer.export.disk_drawing import disk_svg
from explorer.export.provenance import blade_csv, disk_csv, file_stem, power_csv
from explorer.export.report.contents import DesignReport, JudgedActuator, ReportEntry, judged_actuator, report_of
from explorer.export.report.document import report_html
from explorer.model.inputs import baseline_title
from explorer.model.session_state import SessionState
from explorer.model.undo import KeptDesign
from explorer.model.units import UNITS
from explorer.picture.fields import FIELDS, shown_field
from explorer.picture.picture import marks_of
from explorer.scene.controller import SceneController
from explorer.scene.still_scene import EmbeddedViewer, make_stage, scene_page
from explorer.tabs.context import Tab, TabContext
from explorer.tabs.history_panel import HistoryPanel
from explorer.text.design_words import flight_words, title_words
from explorer.text.glossary import hint
from explorer.text.readout import fineness
from rotor.actuator import Verdict

_log = logging.getLogger(__name__)
_PATIENCE = 90.0
"""[s] for the page to draw; browsers that draw in software take some."""
_WIDTH = 1920
"""[px] of a picture of the view."""


@dataclass(frozen=True)
class File:
    name: str
    content: bytes

    @property
    def size(self) -> str:
        count = len(self.content)
        return f"{count / 1e6:.1f} MB" if count >= 1e6 else f"{max(count / 1e3, 1.0):.0f} kB"


def jig_file(state: SessionState) -> File:
    """One blade in jig shape as STL, for manufacture."""
    design = state.solution.design
    return File(f"{file_stem(design, 'blade', 'jig')}.stl", blade_stl(design))


def flown_file(state: SessionState) -> File:
    """The reference blade as flown at its azimuth as STL."""
    solution, azimuth = state.solution, state.view.azimuth_deg
    name = file_stem(solution.design, "blade", "flown", f"psi{azimuth:.0f}")
    return File(f"{name}.stl", blade_stl(flown_design(solution, math.radians(azimuth))))


def rotor_file(state: SessionState) -> File:
    """The rotor in trim as GLB."""
    solution = state.solution
    return File(f"{file_stem(solution.design, 'rotor')}.glb", rotor_glb(solution, state.view.azimuth_deg))


def disk_file(state: SessionState) -> File:
    """Every field over the disk as CSV."""
    return File(f"{file_stem(state.solution.design, 'disk')}.csv", disk_csv(state.solution))


def along_file(state: SessionState) -> File:
    """The blade at the marked azimuth as CSV."""
    azimuth = state.view.azimuth_deg
    content = blade_csv(state.solution, state.reference.design, azimuth)
    return File(f"{file_stem(state.solution.design, 'blade', f'psi{azimuth:.0f}')}.csv", content)


def power_file(state: SessionState, curves: PowerCurves) -> File:
    """Power over advance ratio as CSV."""
    design, reference = state.solution.design, state.reference.design
    curves.sweep(design, reference, lambda: False)
    content = power_csv(state.solution, reference, curves.known(design, reference))
    return File(f"{file_stem(design, 'power')}.csv", content)


def session_report(
    state: SessionState, kept: Sequence[KeptDesign], colour_range: Range, actuator: JudgedActuator | str = ""
) -> DesignReport:
    """The report of the present and the kept designs, compared with A or the baseline, and of the actuator chosen."""
    pinned, solution = state.pinned, state.solution
    if state.pin is None:
        reference = ReportEntry(baseline_title(solution.design), state.baseline)
    else:
        # A may not converge in the present flight condition; then its own solution is used.
        flies = pinned is not None and pinned.converged
        reference = ReportEntry("A, pinned", pinned if pinned is not None and flies else state.pin.solution)
    others = [item for item in kept if item.solution.design not in (solution.design, reference.solution.design)]
    entries = [
        ReportEntry("Now", solution),
        *(ReportEntry(f"Kept {k + 1}", item.solution) for k, item in enumerate(others)),
    ]
    return report_of(
        reference,
        entries,
        state.view,
        {state.view.field: colour_range},
        own_section=state.pin is not None,
        actuator=actuator,
    )


def scene_file(state: SessionState, colour_range: Range) -> File:
    """The rotor in trim as one HTML page to be turned with the mouse, without a server."""
    solution, view = state.solution, replace(state.view, difference=False)
    design, units = solution.design, UNITS[view.units]
    powers = units.watts(solution.power.total, fineness(solution.power))
    line = f"{powers} · {flight_words(design, units)} · {view.field} on the disk"
    times = f" · twist exaggeration × {view.exaggeration:g}" if view.exaggeration != 1.0 else ""
    page = scene_page(solution, view, colour_range, title_words(design), line + times)
    return File(f"{file_stem(design, 'scene')}.html", page.encode("utf-8"))


def report_file(report: DesignReport, stage: EmbeddedViewer | None, curves: PowerCurves) -> File:
    """The report as one HTML file."""
    name = file_stem(report.entries[0].solution.design, "report")
    return File(f"{name}.html", report_html(report, stage, curves).encode("utf-8"))


def disk_drawing_file(state: SessionState, colour_range: Range) -> File:
    """The disk from above as SVG, as the page colours and marks it."""
    view, solution = state.view, state.solution
    field = shown_field(view, state.pinned)
    drawing = disk_svg(solution, field, colour_range, marks_of(view), UNITS[view.units])
    return File(f"{file_stem(solution.design, 'disk', field.title)}.svg", drawing.encode("utf-8"))


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
        shapes = {"Jig STL": jig_file, "Flown STL": flown_file, "Rotor GLB": rotor_file}
        tables: dict[str, Callable[[SessionState], File]] = {
            "Disk": disk_file,
            "Blade": along_file,
            "Power": lambda state: power_file(state, self._curves),
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
        return disk_drawing_file(state, self._scene.held_range(shown_field(state.view, state.pinned)))

    def _view_picture(self, state: SessionState) -> File:
        """The scene as the page's camera sees it; what the frame draws over it is not in the picture."""
        client = self._context.client
        height = round(_WIDTH / client.camera.aspect)
        pixels = client.get_render(height, _WIDTH, transport_format="png", timeout=_PATIENCE)
        png = io.BytesIO()
        Image.fromarray(pixels).save(png, "PNG")
        return File(f"{file_stem(state.solution.design, 'view', f'{_WIDTH}x{height}')}.png", png.getvalue())

    def _scene_page(self, state: SessionState) -> File:
        return scene_file(state, self._scene.held_range(FIELDS[state.view.field]))

    def _report(self, state: SessionState) -> File:
        view = replace(state.view, difference=False)
        outcome = self._actuator()
        actuator = outcome if isinstance(outcome, str) else judged_actuator(outcome)
        colour_range = self._scene.held_range(FIELDS[view.field])
        report = session_report(state, self._history.kept, colour_range, actuator)
        stage = make_stage([entry.solution for entry in report.shown], view, report.colour_range(FIELDS[view.field]))
        return report_file(report, stage, self._curves)

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
