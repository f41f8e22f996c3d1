"""The content of a report: the designs of a session, their reference, colours and fields; or one actuator.

Each part of a report on an actuator is an answer of the Python API, or the sentence that says why there is none.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime
from typing import TypeVar

import numpy as np

from explorer.charts.plots import Range
from explorer.colours import BASELINE
from explorer.model.inputs import ViewState
from explorer.model.units import UNITS, Units
from explorer.picture.fields import FIELDS, Field, fitted_range
from explorer.picture.picture import field_values
from rotor import Design, Solution, failure, solve
from rotor.actuator import (
    ActuatorFlight,
    ActuatorStability,
    Failure,
    FlightLeg,
    Verdict,
    actuator_stability,
    fly,
    phase_sweep,
    try_actuator,
    with_actuator_mass,
)
from rotor.actuator.harmonic import PhaseSweep
from rotor.study.envelope import Reach, reach
from rotor.trim import HubLoads, why_no_hub_loads

COLOURS = ("#1c7ed6", "#e8590c", "#0ca678", "#9c36b5", "#c99700", "#c2255c", "#0b7285", "#5f3dc4")
"""Colours of the designs in charts and badges, in turn."""
FIELDS_SHOWN = 4
_USUAL = ("Angle of attack", "Induced inflow λi", "Thrust dT/dr", "Power dP/dr")

Part = TypeVar("Part")
CRUISE, USUAL = 0.25, 0.3
"""Advance ratios: of the cruise in which an actuator stops, and of a report on a design that hovers."""
HARMONIC = 2
"""Per revolution: the harmonic that saves power, if any does."""


@dataclass(frozen=True, eq=False)
class ReportEntry:
    """A design of the report."""

    title: str
    """The name that the user knows, for example Now."""
    solution: Solution
    """Converged."""


@dataclass(frozen=True, eq=False)
class JudgedActuator:
    """The actuator of a report."""

    verdict: Verdict
    flight: ActuatorFlight | str
    """Over the standard flight, or the sentence that says why there is none."""


def judged_actuator(verdict: Verdict) -> JudgedActuator:
    """Fly the actuator of a verdict; a second or two."""
    try:
        return JudgedActuator(verdict, fly(verdict))
    except RuntimeError as error:
        return JudgedActuator(verdict, str(error))


@dataclass(frozen=True, eq=False)
class DesignReport:
    """The content of a report."""

    reference: ReportEntry
    """The reference of all changes: the pinned design, or the baseline twist."""
    entries: tuple[ReportEntry, ...]
    """The designs, the present one first; the reference is not among them."""
    view: ViewState
    when: datetime
    ranges: Mapping[str, Range] = field(default_factory=dict)
    """Colour range by title of the field, where it is not the default; the same for all designs."""
    own_section: bool = False
    """Whether the reference is the user's own design, which is shown like the others."""
    actuator: JudgedActuator | str = ""
    """The actuator chosen for the first design, or why there is no verdict on it; empty where none was chosen."""

    @property
    def units(self) -> Units:
        """Units of power, speed and weight."""
        return UNITS[self.view.units]

    def colour_range(self, shown: Field) -> Range:
        """The colour range of a field."""
        return self.ranges.get(shown.title, (shown.low, shown.high))

    def comparable(self, entry: ReportEntry) -> bool:
        """Whether it has the reference's flight condition, so that the blade explains a difference of power."""
        return entry.solution.design.condition == self.reference.solution.design.condition

    @property
    def all(self) -> tuple[ReportEntry, ...]:
        """All designs, the reference last."""
        return (*self.entries, self.reference)

    @property
    def shown(self) -> tuple[ReportEntry, ...]:
        """The designs with a section and a 3D scene: the first of `all`."""
        return self.all if self.own_section else self.entries


def colours_of(report: DesignReport) -> list[str]:
    """The colour of each entry; grey for the reference."""
    return [*(COLOURS[k % len(COLOURS)] for k in range(len(report.entries))), BASELINE]


def fields_of(report: DesignReport) -> list[Field]:
    """The field on the page, then the default ones."""
    names = dict.fromkeys((report.view.field, *_USUAL))
    return [FIELDS[name] for name in list(names)[:FIELDS_SHOWN]]


def report_of(
    reference: ReportEntry,
    entries: Sequence[ReportEntry],
    view: ViewState,
    ranges: Mapping[str, Range] | None = None,
    *,
    own_section: bool = False,
    actuator: JudgedActuator | str = "",
) -> DesignReport:
    """A report of these designs; ValueError where there is none, or where one did not converge."""
    if not entries:
        raise ValueError("There is no design to report on: wait for the first solution.")
    for entry in (*entries, reference):
        if not entry.solution.converged:
            raise ValueError(f"{entry.title} is not trimmed, so it cannot be reported: {entry.solution.message}")
    installed = {name: _fitted(FIELDS[name], entries) for name in _USUAL if not FIELDS[name].void_in_reverse_flow}
    return DesignReport(
        reference=reference,
        entries=tuple(entries),
        view=view,
        when=datetime.now().astimezone(),
        ranges={**installed, **(ranges or {})},
        own_section=own_section,
        actuator=actuator,
    )


def _fitted(shown: Field, entries: Sequence[ReportEntry]) -> Range:
    """A colour range that covers all designs, so that their pictures can be compared."""
    return fitted_range(shown, np.concatenate([field_values(entry.solution, shown).ravel() for entry in entries]))


@dataclass(frozen=True, eq=False)
class FlownLimits:
    """Largest load factor and top speed, of the blade as built and of the one with the actuator and its twist."""

    load_factors: tuple[Reach, Reach]
    """At the speed of the report."""
    top_speeds: tuple[Reach, Reach]
    """Advance ratios."""


@dataclass(frozen=True, eq=False)
class ActuatorReport:
    """A report on an actuator. A text in place of a part says why there is none."""

    judged: JudgedActuator
    speed: float
    """Advance ratio of the report."""
    hub_loads: tuple[HubLoads, HubLoads] | str
    """Loads on the hub of blades that bend: as built, and with the actuator and its twist of this speed."""
    sweep: PhaseSweep | str
    failures: tuple[Failure, ...] | str
    """Stopped in hover and in cruise; each flown on in hover, but where it stopped there, and at this speed."""
    stability: ActuatorStability | str
    limits: FlownLimits | str
    when: datetime

    @property
    def verdict(self) -> Verdict:
        return self.judged.verdict

    @property
    def design(self) -> Design:
        """As built, at the speed of the report."""
        return self.verdict.baseline.pair.design.at(mu=self.speed)


def actuator_report(name: str, design: Design) -> ActuatorReport:
    """Judge an actuator between hover and the speed of the design (µ 0.3 for one in hover); about half a minute.

    ValueError for an actuator or a blade that cannot be used, RuntimeError where there is no verdict.
    """
    speed = design.condition.advance_ratio or USUAL
    design = design.at(mu=speed)
    verdict = try_actuator(name, design, (0.0, speed))

    def driven() -> Design:
        (at_speed,) = fly(verdict, [FlightLeg("this speed", speed)]).designs
        return with_actuator_mass(at_speed, verdict.installed)

    def hub_loads() -> tuple[HubLoads, HubLoads]:
        if (reason := why_no_hub_loads(design)) is not None:
            raise RuntimeError(reason.sentence)
        bending = (replace(each, models=replace(each.models, bending=True)) for each in (design, driven()))
        without, fitted = (solve(each).require().hub_loads for each in bending)
        if without is None or fitted is None:
            raise RuntimeError("No hub loads.")
        return without, fitted

    def sweep() -> PhaseSweep:
        return phase_sweep(verdict.actuator_off, verdict.installed, HARMONIC, reference=verdict.without_actuator)

    def failures() -> tuple[Failure, ...]:
        flights = {0.0: [speed], CRUISE: [0.0, speed]}
        return tuple(failure(verdict, stops_at=stop, mu=mu) for stop, mu in flights.items())

    def limits() -> FlownLimits:
        pair = (design, driven())
        first, second = (reach(each, "load_factor", both=True) for each in pair)
        slow, fast = (reach(each, "mu") for each in pair)
        return FlownLimits((first, second), (slow, fast))

    return ActuatorReport(
        judged=judged_actuator(verdict),
        speed=speed,
        hub_loads=_or_reason(hub_loads),
        sweep=_or_reason(sweep),
        failures=_or_reason(failures),
        stability=_or_reason(lambda: actuator_stability(verdict.installed, design)),
        limits=_or_reason(limits),
        when=datetime.now().astimezone(),
    )


def _or_reason(part: Callable[[], Part]) -> Part | str:
    """The part, or the sentence that says why there is none."""
    try:
        return part()
    except (RuntimeError, ValueError) as error:
        return str(error)
