"""Measured points over our curve: as a chart of the strip on a test stand, as marks on power over µ in flight."""

import math
import time
from collections.abc import Callable, Generator
from dataclasses import replace

from explorer.charts.plots import Range, held_range
from explorer.charts.strip import INK, now_dot, role_line
from explorer.model.stand import as_measured, flight_powers, place_of
from explorer.model.units import Units, number
from explorer.text.status import validated
from rotor import Design, FlightCondition, Solution, solve
from rotor.design import Stand
from rotor.support.chart import Axis, Chart, Points
from rotor.validation import Comparison, MeasuredSet, compare_point, design_at
from rotor.validation.compare import ComparedPoint, quantity_of
from rotor.validation.flown import POWER_REPORTS, MeasuredPower

_AT_ONCE = ("ct", "cp", "cq_over_sigma", "cp_drag")
"""Quantities that a solution has by itself; the others need further trims."""
_KEPT = 20
"""Curves remembered per session, and models whose flights are."""
_REDRAW_S = 0.3
"""[s] between two drawings of a curve that grows."""
_MILLE = "×10³"
_AXES = {
    "ct": ("CT ×10³", 1e3),
    "ct_over_sigma": ("CT/σ", 1.0),
    "mu": ("µ", 1.0),
    "collective_deg": ("θ₀ [°]", 1.0),
}
_QUANTITIES = {
    "ct": ("CT over the collective", "CT ×10³", 1e3),
    "cp": ("CP over CT", "CP ×10³", 1e3),
    "cq_over_sigma": ("CQ/σ over µ", "CQ/σ ×10³", 1e3),
    "cp_drag": ("CP of the drag over µ", "CP ×10³", 1e3),
    "cq_above_zero": ("CQ − CQ0 over CT", "CQ above zero ×10³", 1e3),
    "change_percent": ("Effect of twist over CT", "% of CQ", 1.0),
}
"""Title, unit and factor of a measured quantity."""


class MeasuredChart:
    """The measured points of a session, trimmed while the page rests and kept for each blade and its models."""

    def __init__(self) -> None:
        self._points: dict[tuple[str, Design], tuple[ComparedPoint, ...]] = {}
        self._now: tuple[Solution, float] | None = None

    def chart(self, solution: Solution, previous: Range | None = None) -> Chart | None:
        """The chart as far as it is known; None in flight, and for a rotor that was not measured."""
        measured = set_shown(solution)
        if measured is None:
            return None
        known = self._points.get(_key(measured, solution.design), ())
        now = self._present(measured, solution, measured.quantity in _AT_ONCE)
        along = measured.varied[0]
        title, unit, size = _QUANTITIES[measured.quantity]
        axis, wide = _AXES.get(along, (along, 1.0))
        places = [wide * point[along] for point in measured.points]
        values = [size * point[measured.quantity] for point in measured.points]
        scatter = [size * measured.scatter_of(point) for point in measured.points]
        computed = [
            (wide * one.given[along], size * one.computed[measured.quantity])
            for one in known
            if one.computed
        ]
        computed.sort()
        x = wide * place_of(solution)[along]
        y = size * now
        seen = [*values, *(value for _, value in computed), *([y] if math.isfinite(y) else [])]
        low, high = min(places), max(places)
        points = (*known, *[None] * len(values))
        words = [
            _words(measured, value, point) for value, point in zip(values, points, strict=False)
        ]
        value, note = _summary(measured, known, solution)
        both = unit.endswith(_MILLE) and axis.endswith(_MILLE)
        return Chart(
            title,
            Axis(range=(min(0.0, low), max(high, min(x, 1.3 * high)) * 1.04)),
            Axis("both ×10³" if both else unit, held_range(previous, min(seen), max(seen))),
            (
                role_line(
                    "saving",
                    [place for place, _ in computed],
                    [value_here for _, value_here in computed],
                ),
                Points("", places, values, INK, "ring", scatter, words, size=2.6),
                now_dot(x, y),
            ),
            value=value,
            note=note,
        )

    def _present(self, measured: MeasuredSet, solution: Solution, compute: bool) -> float:
        """The quantity of the present solution; NaN where it is not known and not to be computed."""
        if compute and (self._now is None or self._now[0] is not solution):
            self._now = solution, quantity_of(measured.quantity, solution, measured)
        return self._now[1] if self._now is not None and self._now[0] is solution else math.nan

    def trim_points(
        self, solution: Solution, shown: Callable[[], None]
    ) -> Generator[None, None, None]:
        """Trim at every measured point, yielding before each; `shown`: called when there is more to draw."""
        measured = set_shown(solution)
        if measured is None:
            return
        self._present(measured, solution, True)
        key = _key(measured, solution.design)
        points = list(self._points.get(key, ()))
        if len(self._points) > _KEPT:
            self._points.clear()
        begun = time.monotonic()
        for point in measured.points[len(points) :]:
            yield
            points.append(compare_point(measured, point, key[1]))
            self._points[key] = tuple(points)
            if time.monotonic() - begun > _REDRAW_S:
                begun = time.monotonic()
                shown()
        shown()


def set_shown(solution: Solution) -> MeasuredSet | None:
    """The measured set that belongs to a test; None in flight, and where nothing was measured."""
    return None if solution.design.condition.stand is None else validated(solution).measured


def _key(measured: MeasuredSet, design: Design) -> tuple[str, Design]:
    """A set, and the design without its condition."""
    any_test = FlightCondition(0.0, design.aircraft.mass, stand=Stand(ct_over_sigma=0.07))
    return measured.name, replace(
        design, condition=any_test, models=replace(design.models, trim="wind-tunnel")
    )


def _words(measured: MeasuredSet, value: float, point: ComparedPoint | None) -> str:
    """A measured value in words, with the computed one and its error where they are known."""
    _, unit, size = _QUANTITIES[measured.quantity]
    words = f"{unit}: measured {value:.4g}"
    if point is None:
        return words
    if point.computed is None or point.error_percent is None:
        return f"{words}; the computed case does not trim"
    computed = size * point.computed[measured.quantity]
    return f"{words}, computed {computed:.4g}, {number(point.error_percent, 1, sign=True)} %"


def _summary(
    measured: MeasuredSet, points: tuple[ComparedPoint, ...], solution: Solution
) -> tuple[str, str]:
    """For the corner, the error at the present point where that is a measured one, and the rms; then the source."""
    source = f"Measured: {measured.report}."
    condition = solution.design.condition
    parts: list[str] = []
    for point, compared in zip(measured.points, points, strict=False):
        test = design_at(measured, point).condition
        same = test.advance_ratio == condition.advance_ratio and test.stand == condition.stand
        if same and compared.error_percent is not None:
            parts.append(f"{number(compared.error_percent, 1, sign=True)} %")
            break
    errors = Comparison(measured, "", points) if len(points) == len(measured.points) else None
    if errors is not None and errors.rms_percent is not None:
        parts.append(f"rms {number(errors.rms_percent, 1)} %")
    return ", ".join(parts), source


class FlownPowers:
    """The measured flights of a session, each trimmed once for each choice of models."""

    def __init__(self) -> None:
        self._computed: dict[Design, dict[str, float]] = {}
        """Main-rotor power by case [W]; NaN where it does not trim."""

    def marks(self, solution: Solution, units: Units) -> Points | None:
        """The measured flights as far as their powers are computed; None unless the blade is that of the flights."""
        design, unit = solution.design, units.power[0]
        flights = _shown(design)
        if not flights:
            return None
        known = self._computed.get(_any_flight(design), {})
        return Points(
            "",
            [flight.mu for flight in flights],
            [unit.of(flight.power) for flight in flights],
            INK,
            "ring",
            words=[
                f"{flight_words(flight, known.get(flight.case, _now(flight, solution)), units)} Press to fly there."
                for flight in flights
            ],
            action="flown",
            press=[flight.case for flight in flights],
            faint=[not flight.same_air(design) for flight in flights],
            size=2.6,
        )

    def value(self, solution: Solution) -> str:
        """The error at the present flight where it is a measured one."""
        here = next(
            (flight for flight in _shown(solution.design) if flight.same_flight(solution.design)),
            None,
        )
        if here is None:
            return ""
        return f"{here.case}: {number(100.0 * here.error(solution), 1, sign=True)} %"

    def trim_flights(
        self, solution: Solution, shown: Callable[[], None]
    ) -> Generator[None, None, None]:
        """Trim in every measured flight, yielding before each; `shown`: called when there is more to draw."""
        flights = _shown(solution.design)
        if not flights:
            return
        key = _any_flight(solution.design)
        if len(self._computed) > _KEPT:
            self._computed.clear()
        known = self._computed.setdefault(key, {})
        if all(flight.case in known for flight in flights):
            return
        for flight in flights:
            if flight.case not in known:
                yield
                trimmed = solve(
                    key.at(mu=flight.mu, mass_kg=flight.mass, altitude_m=flight.altitude)
                )
                known[flight.case] = trimmed.power.main_rotor if trimmed.converged else math.nan
        shown()


def flight_words(measured: MeasuredPower, computed: float | None, units: Units) -> str:
    """A measured flight in words, with the computed power [W] where it is known; NaN where it does not trim."""
    words = f"{measured.title}. Main rotor: measured {units.watts(measured.power, 1)}"
    if computed is not None and math.isnan(computed):
        words += "; the computed case does not trim"
    elif computed is not None:
        percent = number(100.0 * (computed / measured.power - 1.0), 1, sign=True)
        words += f", computed {units.watts(computed, 1)}, {percent} %"
    return f"{words}."


def source_of(design: Design) -> str:
    """Where the measured flights of this rotor are from, as a sentence; empty where none is shown."""
    if not _shown(design):
        return ""
    return f"Circles: main-rotor power measured in flight, {POWER_REPORTS[design.aircraft.key]}."


def _shown(design: Design) -> tuple[MeasuredPower, ...]:
    """The flights of this rotor; none on a stand, in climb, at another rotor speed, and with another blade."""
    here = design.condition
    level = here.stand is None and not design.unusual and not design.pitch_per_rev
    return flight_powers(design.aircraft.key) if level and as_measured(design) else ()


def _any_flight(design: Design) -> Design:
    """One design for all flights of an aircraft."""
    return replace(design, condition=FlightCondition(0.0, design.aircraft.mass))


def _now(measured: MeasuredPower, solution: Solution) -> float | None:
    return solution.power.main_rotor if measured.same_flight(solution.design) else None
