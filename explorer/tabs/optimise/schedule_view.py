"""A schedule as charts, words and CSV, and played as a flight."""

import bisect
import csv
import io
import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from explorer.charts.plots import Plot, Range, held_range
from explorer.text.units import SI, Units, number
from explorer.tour import blend, eased
from rotor.design.design import Design
from rotor.design.twist import (
    LinearTwist,
    PiecewiseLinearTwist,
    QuadraticTwist,
    SplineTwist,
    SumTwist,
    TableTwist,
    TwistLaw,
)
from rotor.optimisation.objective import MISSION_COLUMNS
from rotor.optimisation.schedule import Cell, Plan, Schedule
from rotor.optimisation.search import Optimum

LEGS = 6
"""Rows of the mission table, so traces of the twist chart."""
_COLUMNS = (*MISSION_COLUMNS, "as_it_is_kw", "best_kw", "saving_percent", "fixed_kw", "twist")


@dataclass
class PlanProgress:
    """What is known of a plan with one concept."""

    plan: Plan
    cells: list[Cell] = field(default_factory=list)
    fixed_powers: tuple[float | None, ...] = ()

    @property
    def schedule(self) -> Schedule:
        return Schedule(self.plan, tuple(self.cells))

    def at(self, leg: int | None) -> Optimum | None:
        """The optimum at a leg; None: the fixed blade."""
        return self.schedule.at(leg, self.plan.concepts[0].name)

    def fixed_power(self, leg: int) -> float | None:
        return self.fixed_powers[leg] if leg < len(self.fixed_powers) else None

    @property
    def part_done(self) -> float:
        """0…1"""
        return len(self.cells) / (len(self.plan.conditions) + 1)


def twist_plot(progress: PlanProgress | None, previous: Range | None) -> Plot:
    """Series: LEGS best twists and the best fixed one [°]; one that is not known lies outside the axis."""
    r = np.linspace(0.13, 1.0, 80)
    optima = (
        [] if progress is None else [*(progress.at(k) for k in range(len(progress.plan.conditions))), progress.at(None)]
    )
    known = [np.degrees(one.design.twist(r)) for one in optima if one is not None and one.best is not None]
    y_range = (
        held_range(previous, min(map(np.min, known)), max(map(np.max, known))) if known else previous or (-1.0, 1.0)
    )
    lines = [np.full(len(r), 1e3) for _ in range(LEGS + 1)]
    for k, one in enumerate(optima):
        if one is not None and one.best is not None:
            lines[LEGS if k == len(optima) - 1 else k] = np.degrees(one.design.twist(r))
    return Plot((r, *lines), y_range)


def saving_plot(progress: PlanProgress | None, previous: Range | None) -> Plot:
    """Series: no saving, best fixed blade, best twist per leg [% of the blade as it is] over µ; legs that are known."""
    legs = [] if progress is None else [(leg, *_saving(progress, k)) for k, leg in enumerate(progress.plan.conditions)]
    points = sorted((leg.flight.advance_ratio, *saved) for leg, *saved in legs if math.isfinite(saved[0]))
    mu, moving, fixed = np.array(points or [(0.0, math.nan, math.nan), (0.4, math.nan, math.nan)]).T
    known = np.concatenate((fixed, moving))
    known = known[np.isfinite(known)]
    y_range = previous or (0.0, 1.0)
    if len(known):
        y_range = held_range(previous, min(0.0, float(known.min())), max(0.1, float(known.max())))
    outside = 10.0 * y_range[1] + 10.0
    lines = (np.where(np.isfinite(values), values, outside) for values in (fixed, moving))
    return Plot((mu, np.zeros(len(mu)), *lines), y_range)


def _saving(progress: PlanProgress, leg: int) -> tuple[float, float]:
    """Of the best twist of a leg and of the best fixed blade there [%]; NaN when not known."""
    one, fixed = progress.at(leg), progress.fixed_power(leg)
    if one is None or one.saving is None or one.baseline_power is None:
        return math.nan, math.nan
    return 100.0 * one.saving, math.nan if fixed is None else 100.0 * (1.0 - fixed / one.baseline_power)


def table(progress: PlanProgress, units: Units = SI) -> str:
    """HTML: one row a leg, then what moving is worth."""
    rows = []
    for k, leg in enumerate(progress.plan.conditions):
        one = progress.at(k)
        moving, fixed = _saving(progress, k)
        baseline = None if one is None or one.baseline_power is None else units.power[0].of(one.baseline_power)
        rows.append(
            f"<tr><td>{number(leg.flight.advance_ratio, 2) if leg.flight.advance_ratio else 'hover'}</td>"
            f'<td class="rx-num">{number(baseline)}</td><td class="rx-num">{number(fixed, 2)}</td>'
            f'<td class="rx-num">{number(moving, 2)}</td></tr>'
        )
    heading = (
        f'<tr class="rx-dim rx-small"><td>µ</td><td class="rx-num">current [{units.power[0].symbol}]</td>'
        '<td class="rx-num">fixed [%]</td><td class="rx-num">variable [%]</td></tr>'
    )
    body = f"{verdict(progress, units)}<table>{heading}{''.join(rows)}</table>"
    return f'<div class="rx rx-found" data-explorer="schedule">{body}</div>'


def verdict(progress: PlanProgress, units: Units = SI) -> str:
    """What the best fixed blade saves, and what moving is worth beyond it."""
    worth = progress.schedule.worth(progress.plan.concepts[0].name)
    if worth is None:
        return ""
    saved = worth.baseline - worth.fixed
    return (
        f'<table><tr><td>Best fixed blade saves</td><td class="rx-num">{units.watts(saved, 1)}</td>'
        f'<td class="rx-num" style="width:20%">{number(100.0 * saved / worth.baseline, 2)} %</td></tr>'
        '<tr><td style="white-space:normal"><b>Additional saving from variable twist</b></td>'
        f'<td class="rx-num"><b>{units.watts(worth.gain, 1)}</b></td>'
        f'<td class="rx-num"><b>{number(100.0 * worth.share, 2)} %</b></td></tr></table>'
    )


def csv_of(progress: PlanProgress) -> bytes:
    """The schedule as a CSV file; what is not known is blank."""
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(_COLUMNS)
    for k, leg in enumerate(progress.plan.conditions):
        one, c = progress.at(k), leg.flight
        best = None if one is None else one.best
        writer.writerow(
            (
                f"{c.advance_ratio:g}",
                f"{c.mass:g}",
                f"{c.altitude:g}",
                f"{c.climb_speed:g}",
                f"{leg.hours:g}",
                _kilowatt(None if one is None else one.baseline_power),
                _kilowatt(None if best is None else best.power),
                "" if one is None or one.saving is None else f"{100.0 * one.saving:.3f}",
                _kilowatt(progress.fixed_power(k)),
                "" if best is None else best.twist,
            )
        )
    fixed = progress.at(None)
    if fixed is not None and fixed.best is not None:
        hours = sum(leg.hours for leg in progress.plan.conditions)
        mean = (_kilowatt(fixed.baseline_power), "", "", _kilowatt(fixed.best.power))
        writer.writerow(("mean", "", "", "", f"{hours:g}", *mean, fixed.best.twist))
    return text.getvalue().encode()


def _kilowatt(watts: float | None) -> str:
    return "" if watts is None else f"{watts / 1e3:.3f}"


SECONDS = 16.0
"""[s] a playback takes."""
_CHANGING = 0.45
"""Part of the playback that passes between legs."""
_STATIONS = np.linspace(0.05, 1.0, 77)
"""r/R of a twist between two laws of different kinds; some laws are singular at the centre."""


@dataclass(frozen=True)
class FlownLeg:
    """One leg of the mission with its best twist."""

    advance_ratio: float
    hours: float
    twist: TwistLaw
    moving: float
    """Power with the best twist of this leg [W]."""
    starting: float
    """Power of the blade that the schedule began from [W]."""


@dataclass(frozen=True)
class FlightInstant:
    """What the page shows at one time of the playback."""

    advance_ratio: float
    twist: TwistLaw
    root_to_tip_deg: float
    """Twist at the tip less twist at the root cut-out."""
    moving: float
    """Power with the twist of the instant [W]."""
    starting: float
    """Power of the starting design [W]."""
    leg: int
    """The leg flown, or the one just left."""
    between: bool
    """Whether the instant lies between two legs, where twist and power are interpolated."""
    hours: float
    """Flown so far."""
    saved: float
    """Energy saved so far against the starting design [J]."""

    @property
    def saving(self) -> float:
        """Power saved now against the starting design [W]."""
        return self.starting - self.moving

    def numbers(self, units: Units = SI) -> tuple[tuple[str, str], ...]:
        """Three large numbers with their captions: speed, twist, and what has been saved so far."""
        speed = "hover" if self.advance_ratio == 0.0 else f"µ {number(self.advance_ratio, 2)}"
        return (
            ("speed", speed),
            ("twist, root to tip", f"{number(self.root_to_tip_deg, 1)}°"),
            ("saved vs. starting design", f"{_energy(self.saved, units)}"),
        )


class ScheduleFlight:
    """The playback of the legs that a schedule has, in the order of speed."""

    def __init__(self, progress: PlanProgress, seconds: float = SECONDS) -> None:
        """ValueError with one sentence where no leg has an optimum yet."""
        self._plan = progress.plan
        self.legs = flown_legs(progress)
        if not self.legs:
            raise ValueError("The schedule has no optimum to play yet: compute it first.")
        self.seconds = seconds
        count = len(self.legs)
        changing = _CHANGING * seconds if count > 1 else 0.0
        total = sum(leg.hours for leg in self.legs)
        self._arrivals: list[float] = []
        self._departures: list[float] = []
        time = 0.0
        for k, leg in enumerate(self.legs):
            self._arrivals.append(time)
            time += (seconds - changing) * leg.hours / total
            self._departures.append(time)
            if k < count - 1:
                time += changing / (count - 1)

    def at(self, time: float) -> FlightInstant:
        """What is shown `time` [s] after the start; the last leg's end stays."""
        time = min(max(time, 0.0), self.seconds)
        k = max(bisect.bisect_right(self._arrivals, time) - 1, 0)
        leg = self.legs[k]
        stay = self._departures[k] - self._arrivals[k]
        flown = min((time - self._arrivals[k]) / stay, 1.0) if stay > 0.0 else 1.0
        between = time > self._departures[k] and k + 1 < len(self.legs)
        weight = 0.0
        following = leg
        if between:
            following = self.legs[k + 1]
            weight = eased((time - self._departures[k]) / (self._arrivals[k + 1] - self._departures[k]))
        twist = twist_between(leg.twist, following.twist, weight)

        root = self._plan.design.rotor.blade.root_cutout
        ends = twist(np.array([root, 1.0]))
        return FlightInstant(
            advance_ratio=blend(leg.advance_ratio, following.advance_ratio, weight),
            twist=twist,
            root_to_tip_deg=math.degrees(float(ends[1] - ends[0])),
            moving=blend(leg.moving, following.moving, weight),
            starting=blend(leg.starting, following.starting, weight),
            leg=k,
            between=between,
            hours=self._so_far(k, flown, lambda _: 1.0),
            saved=3600.0 * self._so_far(k, flown, lambda one: one.starting - one.moving),
        )

    def design(self, instant: FlightInstant) -> Design:
        """The design of an instant, to be solved and drawn."""
        plan = self._plan
        leg = min(range(len(plan.conditions)), key=lambda k: self._distance(k, instant))
        condition = replace(plan.conditions[leg].flight, advance_ratio=instant.advance_ratio)
        return replace(plan.design, twist=instant.twist, condition=condition)

    def _distance(self, leg: int, instant: FlightInstant) -> float:
        return abs(self._plan.conditions[leg].flight.advance_ratio - instant.advance_ratio)

    def _so_far(self, leg: int, part: float, read: Callable[[FlownLeg], float]) -> float:
        """Sum of hours × something over the legs before, and over `part` of this one."""
        before = sum(one.hours * read(one) for one in self.legs[:leg])
        return before + part * self.legs[leg].hours * read(self.legs[leg])


def flown_legs(progress: PlanProgress) -> tuple[FlownLeg, ...]:
    """The legs whose optimum is known, in the order of speed."""
    legs: list[FlownLeg] = []
    for k, leg in enumerate(progress.plan.conditions):
        optimum = progress.at(k)
        if optimum is None or optimum.best is None or optimum.baseline_power is None:
            continue
        legs.append(
            FlownLeg(
                advance_ratio=leg.flight.advance_ratio,
                hours=leg.hours,
                twist=optimum.design.twist,
                moving=optimum.best.power,
                starting=optimum.baseline_power,
            )
        )
    return tuple(sorted(legs, key=lambda one: one.advance_ratio))


def twist_between(before: TwistLaw, after: TwistLaw, weight: float) -> TwistLaw:
    """A law on the way from one to another; `weight` 0…1, exact at both ends.

    Two laws of one kind are interpolated by their parameters, divisions included; others by their angles.
    """
    if weight <= 0.0 or before == after:
        return before
    if weight >= 1.0:
        return after

    def mix(one: tuple[float, ...], other: tuple[float, ...]) -> tuple[float, ...]:
        return tuple(blend(a, b, weight) for a, b in zip(one, other, strict=True))

    match before, after:
        case LinearTwist(), LinearTwist():
            return LinearTwist(blend(before.rate, after.rate, weight))
        case QuadraticTwist(), QuadraticTwist():
            return QuadraticTwist(*mix((before.curvature, before.difference), (after.curvature, after.difference)))
        case PiecewiseLinearTwist(), PiecewiseLinearTwist() if len(before.rates) == len(after.rates):
            return PiecewiseLinearTwist(mix(before.rates, after.rates), mix(before.breaks, after.breaks))
        case SumTwist(), SumTwist() if before.base == after.base:
            return SumTwist(before.base, twist_between(before.change, after.change, weight))
        case SplineTwist(), SplineTwist() if before.stations == after.stations:
            return SplineTwist(before.stations, mix(before.angles, after.angles))
        case _:
            angles = (1.0 - weight) * before(_STATIONS) + weight * after(_STATIONS)
            return TableTwist(tuple(_STATIONS.tolist()), tuple(angles.tolist()), "between two legs")


def _energy(joules: float, units: Units) -> str:
    """kW h, or hp h where power is shown in horsepower."""
    unit = units.power[0]
    return f"{number(unit.of(joules / 3600.0), 1)} {unit.symbol}\u202fh"
