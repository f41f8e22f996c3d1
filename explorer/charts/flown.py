"""Power measured in flight beside ours: marks over the power curve, trimmed in each flight while the page rests."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from explorer.charts.strip import StripMark
from explorer.flown import POWER_REPORTS, MeasuredPower, as_measured, measured_powers
from explorer.text.units import Units, number
from rotor.analysis.series import between_drag_areas
from rotor.design.aircraft import FlightCondition
from rotor.design.design import Design
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

_KEPT = 20
"""Models whose flights are remembered per session."""


@dataclass(frozen=True)
class OurPower:
    """Our main-rotor power in a measured flight [W]."""

    power: float | None
    """None where it does not trim."""
    band: tuple[float, float] | None
    """With the lowest and the highest drag area of the sources; None where they give one value."""


class FlownPowers:
    """One session's: each flight is trimmed once for each choice of models."""

    def __init__(self) -> None:
        self._ours: dict[Design, dict[str, OurPower]] = {}

    def marks(self, solution: Solution, units: Units) -> tuple[StripMark, ...]:
        """The measured flights as far as ours are known; empty unless the blade is that of the flights."""
        design = solution.design
        ours = self._ours.get(_any_flight(design), {})
        unit = units.power[0]
        return tuple(
            StripMark(
                one.mu,
                unit.of(one.power),
                0.0,
                flight_words(one, ours.get(one.case) or _now(one, solution), units),
                case=one.case,
                elsewhere=not one.same_air(design),
            )
            for one in _shown(design)
        )

    def value(self, solution: Solution) -> str:
        """The error at the present flight where it is a measured one."""
        here = next((one for one in _shown(solution.design) if one.same_flight(solution.design)), None)
        if here is None:
            return ""
        percent = 100.0 * (solution.power.main_rotor / here.power - 1.0)
        return f"{here.case}: {number(percent, 1, sign=True)} %"

    def rest(self, solution: Solution, superseded: Callable[[], bool], shown: Callable[[], None]) -> None:
        """Trim in every measured flight, unless newer input comes; `shown`: called when there is more to draw."""
        flights = _shown(solution.design)
        key = _any_flight(solution.design)
        if len(self._ours) > _KEPT:
            self._ours.clear()
        known = self._ours.setdefault(key, {})
        if all(one.case in known for one in flights):
            return
        for one in flights:
            if superseded():
                return
            if one.case not in known:
                found = solve(key.at(mu=one.mu, mass_kg=one.mass, altitude_m=one.altitude))
                known[one.case] = _ours(found, between_drag_areas(found))
        shown()


def flight_words(one: MeasuredPower, ours: OurPower | None, units: Units) -> str:
    """A measured flight in words, with ours where it is known."""
    words = f"{one.title}. Main rotor: measured {units.watts(one.power, 1)}"
    if ours is None:
        return f"{words}."
    if ours.power is None:
        return f"{words}; ours does not trim."
    percent = number(100.0 * (ours.power / one.power - 1.0), 1, sign=True)
    words = f"{words}, ours {units.watts(ours.power, 1)}, {percent} %"
    if ours.band is None:
        return f"{words}."
    low, high = (units.watts(end, 1) for end in ours.band)
    return f"{words}; {low} to {high} between the drag areas of the sources."


def source_of(design: Design) -> str:
    """Where the measured flights of this rotor are from, as a sentence; empty where none is shown."""
    if not _shown(design):
        return ""
    return f"Circles: main-rotor power measured in flight, {POWER_REPORTS[design.aircraft.key]}."


def _shown(design: Design) -> tuple[MeasuredPower, ...]:
    """The flights of this rotor; none on a stand, in climb, and with another blade."""
    here = design.condition
    level = here.stand is None and here.climb_speed == 0.0 and not design.pitch_per_rev
    return measured_powers(design.aircraft.key) if level and as_measured(design) else ()


def _any_flight(design: Design) -> Design:
    """The same design for every flight."""
    return replace(design, condition=FlightCondition(0.0, design.aircraft.mass))


def _now(one: MeasuredPower, solution: Solution) -> OurPower | None:
    return OurPower(solution.power.main_rotor, None) if one.same_flight(solution.design) else None


def _ours(found: Solution, ends: tuple[Solution, Solution] | None) -> OurPower:
    return OurPower(
        found.power.main_rotor if found.converged else None,
        None if ends is None else (ends[0].power.main_rotor, ends[1].power.main_rotor),
    )
