"""The Export folder: the shape of the blade, tables, a picture of the view, and the report."""

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import viser

from explorer.charts.plots import PowerCurves
from explorer.export.blade import blade_stl
from explorer.export.contents import DesignReport, ReportEntry
from explorer.export.provenance import blade_csv, disk_csv, file_stem, power_csv
from explorer.export.report import report_html
from explorer.export.view_picture import view_png
from explorer.model.inputs import baseline_title
from explorer.model.session_state import SessionState
from explorer.model.units import UNITS
from explorer.picture.fields import FIELDS
from explorer.scene.controller import SceneController
from explorer.scene.still_scene import make_stage
from explorer.tabs.context import Tab, TabContext
from explorer.tabs.history_panel import HistoryPanel
from explorer.text.glossary import hint
from rotor import Design
from rotor.actuator import Verdict
from rotor.markup import tag

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


def _file(design: Design, ending: str, content: str | bytes, *words: str) -> File:
    """Named after its design and these words."""
    text = content.encode("utf-8") if isinstance(content, str) else content
    return File(f"{file_stem(design, *words)}.{ending}", text)


def jig_file(state: SessionState) -> File:
    """One blade in jig shape as STL, for manufacture."""
    design = state.solution.design
    return _file(design, "stl", blade_stl(design), "blade", "jig")


def _disk_table(state: SessionState) -> File:
    return _file(state.solution.design, "csv", disk_csv(state.solution), "disk")


def _blade_table(state: SessionState) -> File:
    """The blade at the marked azimuth as CSV."""
    azimuth = state.view.azimuth_deg
    content = blade_csv(state.solution, state.reference.design, azimuth)
    return _file(state.solution.design, "csv", content, "blade", f"psi{azimuth:.0f}")


class ExportPanel(Tab):
    """One session's. Each file is made on a thread of its own, one at a time; what fails is a sentence."""

    def __init__(
        self, context: TabContext, scene: SceneController, history: HistoryPanel, actuator: Callable[[], Verdict | str]
    ) -> None:
        """`actuator`: the verdict on the one chosen, why there is none, or empty where none was."""
        self._context, self._scene, self._history, self._actuator = context, scene, history, actuator
        self._busy = threading.Lock()
        self._curves = PowerCurves()
        self._stale = False
        """Whether the sliders mean a design without an answer, so that the last good one is exported."""
        shapes = {"Jig STL": jig_file}
        tables = {"Disk": _disk_table, "Blade": _blade_table, "Power": self._power_table}
        pictures = {"View as PNG": self._view_picture}
        gui = context.gui
        with gui.add_folder("Export"):
            for label, makers, name in (
                ("Shape", shapes, "export_shape"),
                ("CSV", tables, "export_table"),
                ("Picture", pictures, "export_picture"),
            ):
                group = gui.add_button_group(label, tuple(makers), hint=hint(name))
                group.on_click(lambda event, makers=makers: self._save("the file", makers[event.target.value]))
            report = gui.add_button(
                "Report of this session", icon=viser.Icon.REPORT, color="gray", hint=hint("export_report")
            )
            self._state = gui.add_html("")
        self._say("idle", "Exports the design on the sliders.")
        report.on_click(lambda _: self._save("the report", self._report))
        context.keyboard.bind("export", lambda: context.layout.open_drawer("share"))

    def show(self, state: SessionState) -> None:
        """Files are made from the state of the session when they are asked for."""
        self._stale = False

    def show_failure(self) -> None:
        """The last good answer is still exported, and the line says so."""
        self._stale = True

    def _power_table(self, state: SessionState) -> File:
        design, reference = state.solution.design, state.reference.design
        self._curves.sweep(design, reference, lambda: False)
        return _file(
            design, "csv", power_csv(state.solution, reference, self._curves.known(design, reference)), "power"
        )

    def _view_picture(self, state: SessionState) -> File:
        """The scene as the page's camera sees it between its cards, with title, flight, power and scale."""
        client, view = self._context.client, state.view
        height = round(_WIDTH / client.camera.aspect)
        pixels = client.get_render(height, _WIDTH, transport_format="png", timeout=_PATIENCE)
        above, below = self._scene.camera.covered
        seen = pixels[round(above * height) : height - round(below * height)]
        png = view_png(seen, state.solution, self._scene.scale, UNITS[view.units], view.dark)
        return _file(state.solution.design, "png", png, "view")

    def _report(self, state: SessionState) -> File:
        """The present and the kept designs compared with A or the baseline, and the actuator chosen, as HTML."""
        solution, pinned, view = state.solution, state.pinned, replace(state.view, difference=False)
        if state.pin is None:
            reference = ReportEntry(baseline_title(solution.design), state.baseline)
        else:
            # A may not converge in the present flight condition; then its own solution is used.
            flies = pinned is not None and pinned.converged
            reference = ReportEntry("A, pinned", pinned if pinned is not None and flies else state.pin.solution)
        known = (solution.design, reference.solution.design)
        others = [item for item in self._history.kept if item.solution.design not in known]
        entries = [ReportEntry("Now", solution)]
        entries += [ReportEntry(f"Kept {k + 1}", item.solution) for k, item in enumerate(others)]
        field = FIELDS[view.field]
        report = DesignReport(
            reference,
            entries,
            state.view,
            {view.field: self._scene.held_range(field)},
            own_section=state.pin is not None,
            actuator=self._actuator(),
        )
        stage = make_stage([entry.solution for entry in report.shown], view, report.colour_range(field))
        return _file(report.entries[0].solution.design, "html", report_html(report, stage, self._curves), "report")

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
        told = {"data_explorer": "export", "data_kind": kind}
        self._state.content = tag("div.rx.rx-small.rx-export", sentence, **told)
