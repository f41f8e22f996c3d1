"""Everything that shows one design, without a browser: parts and texts of the page, the report, what commands print."""

import html
import json
import math
import re
from collections.abc import Generator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any

import msgspec
import numpy as np

from explorer.charts.plots import SWEEP, PowerCurve, PowerCurves
from explorer.charts.probe_drawing import probe_panel
from explorer.export.contents import DesignReport, ReportEntry
from explorer.export.figures import actuator_section
from explorer.export.live import live_html
from explorer.export.provenance import provenance_lines
from explorer.export.report import report_html
from explorer.model.inputs import Inputs, ViewState, baseline_of
from explorer.model.session_state import SessionState
from explorer.model.units import SI
from explorer.page import PANELS
from explorer.picture.element import probe
from explorer.picture.fields import FIELDS
from explorer.picture.plan import plan
from explorer.picture.ride import AZIMUTHS
from explorer.views.actuated import actuated_blade
from explorer.views.page_state import OpenPanels, PageState
from explorer.views.work import shown_doubt
from explorer.workers.call import at_once
from rotor import Design, Solution, doubt, solution_record, solve, sweep
from rotor.actuator import Verdict
from rotor.aero.inflow import INFLOW_MODELS
from rotor.command import actuator as actuator_command
from rotor.command.solve import report as solve_report
from rotor.trim.doubt import Doubt
from tests.actuate import answered

DRAWERS = "details", "trust"
STATION, TURN_STEP = 12, 18
"""Element, and step of a turn with it, at which a section is read: the disk has a station there."""
PSI_DEG = 360.0 * TURN_STEP / AZIMUTHS
"""Azimuth of that step."""


@dataclass(frozen=True, eq=False)
class Documents:
    """All that is written of one design outside the page, each made when it is first read."""

    solution: Solution
    reference: Solution
    band: Doubt
    verdict: Verdict | None = None

    @cached_property
    def record(self) -> Mapping[str, Any]:
        """What `rotor solve --json --doubt` prints."""
        return {**solution_record(self.solution), "doubt": self.band.record()}

    @cached_property
    def solved(self) -> str:
        """What `rotor solve` prints."""
        return solve_report(self.solution)

    @cached_property
    def swept(self) -> Mapping[str, Any]:
        """The row of `rotor sweep --relative-to`; empty for a blade that is its own reference."""
        here, other = self.solution.design, self.reference.design
        if here.twist == other.twist:
            return {}
        table = sweep((here, other), mu=[here.condition.advance_ratio])
        columns = table.relative_to(other.twist.spec()).to_dict()
        return {name: values[0] for name, values in columns.items()}

    @cached_property
    def report(self) -> str:
        """The report without its markup."""
        entries = [ReportEntry("Now", self.solution)]
        content = DesignReport(ReportEntry("Reference", self.reference), entries, ViewState())
        return plain(report_html(content, None, _NoCurves()))

    @cached_property
    def travelling(self) -> Mapping[str, float]:
        """Total power and its band of the page that travels, as its script makes them of the polynomials at the shared
        twist; empty where the polynomials take long."""
        design = self.solution.design
        quick = not INFLOW_MODELS[design.models.inflow].load_dependent and not design.hovering
        if not quick or design.models.bending or design.rotor.blade.carried is not None:
            return {}
        block = re.search(r'id="model"[^>]*>(.*?)</script>', live_html(self.solution), re.DOTALL)
        assert block is not None
        model = json.loads(block[1])
        places = [(one["shared"] - one["centre"]) / one["half"] for one in model["handles"]]
        terms = np.array([np.prod(np.power(places, powers)) for powers in model["exponents"]])
        # Bands are polynomials of lower order.
        parts = [np.dot(row, terms[: len(row)]) for row in model["doubt"]["power"]]
        return {
            "power": float(np.array(model["power"]["total"]) @ terms),
            "band": float(np.linalg.norm(parts)),
        }

    @cached_property
    def provenance(self) -> str:
        """What stands above a table of data."""
        return "\n".join(provenance_lines(self.solution))

    @cached_property
    def notebook(self) -> str:
        """What a notebook shows of the solution."""
        return repr(self.solution)

    @cached_property
    def section(self) -> str:
        """The drawer of the section at `STATION` and `PSI_DEG` without its markup."""
        r = float(self.solution.disk.r[STATION])
        return plain(probe_panel(probe(self.solution, r, math.radians(PSI_DEG)), self.solution))

    @cached_property
    def actuator(self) -> str:
        """The report's section on the actuator without its markup; empty where there is none."""
        return "" if self.verdict is None else plain(actuator_section(self.verdict, SI))

    @cached_property
    def verdict_record(self) -> Mapping[str, Any]:
        """What `rotor actuator --json` prints; empty without an actuator."""
        return {} if self.verdict is None else actuator_command.record(self.verdict)

    @cached_property
    def judged(self) -> str:
        """What `rotor actuator` prints; empty without an actuator."""
        return "" if self.verdict is None else actuator_command.report(self.verdict)


@dataclass(frozen=True, eq=False)
class Screen:
    """What shows one design: parts of the page as its scripts get them, its texts, and documents."""

    solution: Solution
    reference: Solution
    """What changes count from."""
    frame: Mapping[str, Any]
    """Parts of the page by name, as JSON."""
    texts: Mapping[str, str] = field(default_factory=dict[str, str])
    """Markup beside the frame, by name."""
    documented: bool = True
    """Whether documents are read as well."""
    verdict: Verdict | None = None
    """On the actuator of the screen; None: it has none."""
    drive: float = 0.0
    """Power that the drive of the actuator takes, which changes of power hold as well [W]."""

    @cached_property
    def band(self) -> Doubt:
        """How sure power is, and its change from the reference where that is another design."""
        same = self.solution.design == self.reference.design
        return _doubt(self.solution, None if same else self.reference)

    @cached_property
    def documents(self) -> Documents | None:
        """The documents; None where they are not read."""
        if not self.documented:
            return None
        return Documents(self.solution, self.reference, self.band, self.verdict)


@lru_cache(maxsize=64)
def _doubt(solution: Solution, reference: Solution | None) -> Doubt:
    """Known for the next message of a page that shows the same design."""
    return doubt(solution, reference)


class _NoCurves(PowerCurves):
    """Curves of a report whose charts nobody reads: they cost nothing."""

    def sweep(self, *_: Any, **__: Any) -> Generator[None, None, bool]:
        yield
        return True

    def known(self, design: Design, reference: Design) -> PowerCurve:
        none = np.full(len(SWEEP), math.nan)
        return PowerCurve(none, none, none)


def plain(markup: str) -> str:
    """Markup as it is read: without elements, in one line."""
    return re.sub(r"[ \n\u00a0]+", " ", html.unescape(re.sub(r"<[^>]*>", " ", markup)))


def explored(inputs: Inputs) -> Screen:
    """Explore with the drawers of power and of trust and the view of the disk, once the band of its power is known."""
    design = inputs.design()
    solution = solve(design).require()
    reference = solve(baseline_of(design)).require()
    view = ViewState()
    state = SessionState(inputs, view, solution, reference, None)
    now = PageState(inputs, design, state, view=view)
    bands = {work.key: at_once(work.run(lambda: None)) for work in shown_doubt(now)}
    now = replace(now, answers=bands)
    frame, texts = seen(now, *(OpenPanels(drawer=drawer, disk=True) for drawer in DRAWERS))
    shown = FIELDS[view.field]
    frame["plan"] = _as_json(plan(solution, view, shown, (shown.low, shown.high), at_rest=True))
    return Screen(solution, reference, frame, texts)


def actuated(id: str, inputs: Inputs) -> Screen:
    """Actuate with the blade out of the rotor and what would pay on the stage, once all is known."""
    now = answered("same-blade", (77.0, 0.0, 0.0, 0.0, 0.0), "set", id, inputs)
    frame, texts = seen(now, now.ui)
    staged = replace(now, hand=replace(now.hand, on_stage=True))
    frame |= {"suppose": seen(staged, now.ui)[0]["suppose"]}
    blade, state = actuated_blade(now), now.state
    assert blade is not None
    assert state is not None
    assert blade.verdict is not None
    return Screen(
        state.solution,
        state.baseline,
        frame,
        texts,
        verdict=blade.verdict,
        drive=blade.verdict.drive.hold_power,
    )


def seen(now: PageState, *open_panels: OpenPanels) -> tuple[dict[str, Any], dict[str, str]]:
    """Parts of the frame and texts of all panels that are seen with one of these open."""
    frame = dict[str, Any]()
    texts = dict[str, str]()
    for ui in open_panels:
        for panel in PANELS:
            if not panel.seen(ui):
                continue
            for name, part in panel.view(replace(now, ui=ui)).items():
                if isinstance(part, str):
                    texts[name] = part
                else:
                    frame[name] = _as_json(part)
    return frame, texts


def _as_json(part: Any) -> Any:
    return json.loads(msgspec.json.encode(part))
