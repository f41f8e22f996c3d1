"""A schedule played as a flight: speed runs through the mission, the blade untwists, and the saving counts up.

At the legs all numbers are those of the schedule. Between two legs twist and power are interpolated for the eye, and
no time of the mission passes: the energy saved grows only while a leg is flown.
"""

import bisect
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from explorer.interpolation import blend, eased
from explorer.tabs.optimise.schedule_view import PlanProgress
from explorer.text.units import SI, Units, number
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
    fixed: float | None
    """Power of the best fixed blade [W]; None while that is not known."""


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
    fixed: float | None
    """Power of the best fixed blade [W]."""
    leg: int
    """The leg flown, or the one just left."""
    between: bool
    """Whether the instant lies between two legs, where twist and power are interpolated."""
    hours: float
    """Flown so far."""
    saved: float
    """Energy saved so far against the starting design [J]."""
    saved_over_fixed: float | None
    """The same against the best fixed blade [J]."""

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
    """The playback of the legs that a schedule knows, in the order of speed."""

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

        def powers(read: Callable[[FlownLeg], float | None]) -> float | None:
            before, after = read(leg), read(following)
            return None if before is None or after is None else blend(before, after, weight)

        root = self._plan.design.rotor.blade.root_cutout
        ends = twist(np.array([root, 1.0]))
        return FlightInstant(
            advance_ratio=blend(leg.advance_ratio, following.advance_ratio, weight),
            twist=twist,
            root_to_tip_deg=math.degrees(float(ends[1] - ends[0])),
            moving=blend(leg.moving, following.moving, weight),
            starting=blend(leg.starting, following.starting, weight),
            fixed=powers(lambda one: one.fixed),
            leg=k,
            between=between,
            hours=self._so_far(k, flown, lambda one: 1.0) or 0.0,
            saved=3600.0 * (self._so_far(k, flown, lambda one: one.starting - one.moving) or 0.0),
            saved_over_fixed=_times(3600.0, self._so_far(k, flown, _over_fixed)),
        )

    def design(self, instant: FlightInstant) -> Design:
        """The design of an instant, to be solved and drawn."""
        plan = self._plan
        leg = min(range(len(plan.conditions)), key=lambda k: self._distance(k, instant))
        condition = replace(plan.conditions[leg].flight, advance_ratio=instant.advance_ratio)
        return replace(plan.design, twist=instant.twist, condition=condition)

    def sequence(self, frames_per_second: float = 10.0) -> list[FlightInstant]:
        """All instants of the playback, the first and the last included."""
        count = max(round(self.seconds * frames_per_second), 1)
        return [self.at(self.seconds * k / count) for k in range(count + 1)]

    def _distance(self, leg: int, instant: FlightInstant) -> float:
        return abs(self._plan.conditions[leg].flight.advance_ratio - instant.advance_ratio)

    def _so_far(self, leg: int, part: float, read: Callable[[FlownLeg], float | None]) -> float | None:
        """Sum of hours × something over the legs before, and over `part` of this one; None where it is not known."""
        total = 0.0
        for k in range(leg + 1):
            value = read(self.legs[k])
            if value is None:
                return None
            total += (part if k == leg else 1.0) * self.legs[k].hours * value
        return total


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
                fixed=progress.fixed_power(k),
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


def largest_change_deg(flight: ScheduleFlight) -> float:
    """The most that the blade turns between two neighbouring legs, root to tip."""
    root = flight.design(flight.at(0.0)).rotor.blade.root_cutout
    stations = np.linspace(root, 1.0, 40)
    angles = [leg.twist(stations) - leg.twist(np.array(root)) for leg in flight.legs]
    return max((math.degrees(float(np.abs(b - a).max())) for a, b in pairwise(angles)), default=0.0)


def _over_fixed(leg: FlownLeg) -> float | None:
    return None if leg.fixed is None else leg.fixed - leg.moving


def _times(factor: float, value: float | None) -> float | None:
    return None if value is None else factor * value


def _energy(joules: float, units: Units) -> str:
    """kW h, or hp h where power is shown in horsepower."""
    unit = units.power[0]
    return f"{number(unit.of(joules / 3600.0), 1)} {unit.symbol}\u202fh"
