"""A mission: the legs of a flight with their hours, for verdicts, schedules and searches.

Legs of the default mission have no source: their speeds and hours are assumed.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from rotor.design.aircraft import FlightCondition
from rotor.design.design import Design
from rotor.optimisation.objective import WeightedCondition, read_mission

ASSUMED_HOURS = (0.5, 0.25, 1.0, 0.25)
"""Hours of the legs of `standard_flight`: assumed, we know no source for a mission of this kind."""


@dataclass(frozen=True)
class FlightLeg:
    """One steady part of a flight."""

    name: str
    advance_ratio: float
    climb_speed: float = 0.0
    """[m/s], negative in descent."""
    hours: float = 1.0
    """Flight time [h]."""
    flight: FlightCondition | None = None
    """The whole flight condition where a file gives it; None for the design's own at this speed."""

    def of(self, design: Design) -> Design:
        """The design in the flight condition of this leg."""
        condition = self.flight
        if condition is None:
            condition = replace(
                design.condition, advance_ratio=self.advance_ratio, climb_speed=self.climb_speed
            )
        return replace(design, condition=condition)


def standard_flight(
    design: Design, hours: Sequence[float] = ASSUMED_HOURS
) -> tuple[FlightLeg, ...]:
    """Hover, a climb of 5 m/s (about 1000 ft/min) near the speed of least power, cruise and fast flight.

    Level in place of the climb where the models of the design know no axial flow, and on a test stand.
    """
    climb = FlightLeg("climb", 0.15, 5.0)
    if not design.models.disk_axial_flow or design.condition.stand is not None:
        climb = FlightLeg("slow", 0.15)
    legs = (FlightLeg("hover", 0.0), climb, FlightLeg("cruise", 0.25), FlightLeg("fast", 0.33))
    return tuple(replace(leg, hours=flown) for leg, flown in zip(legs, hours, strict=True))


@dataclass(frozen=True)
class Mission:
    """The legs that one aircraft flies, at least two that differ."""

    design: Design
    """Rotor, models, mass and altitude; its twist is what a retrofit starts from."""
    legs: tuple[FlightLeg, ...]

    def __post_init__(self) -> None:
        for leg in self.legs:
            if not (math.isfinite(leg.hours) and leg.hours > 0.0):
                raise ValueError(f"leg {leg.name} has {leg.hours:g} hours: give more than 0")
        if len(set(self.designs())) < 2:
            raise ValueError("the mission has one flight condition: give at least two that differ")

    @property
    def shares(self) -> tuple[float, ...]:
        """Fraction of the time of each leg; they add up to 1."""
        total = math.fsum(leg.hours for leg in self.legs)
        return tuple(leg.hours / total for leg in self.legs)

    @property
    def assumed(self) -> bool:
        """Whether its hours are those of the default, which have no source."""
        return self.legs == standard_flight(self.design)

    @property
    def words(self) -> str:
        """The names of its legs, for example `hover, climb, cruise and fast`."""
        *others, last = (leg.name for leg in self.legs)
        return f"{', '.join(others)} and {last}"

    @property
    def conditions(self) -> tuple[WeightedCondition, ...]:
        """The legs as conditions of an objective."""
        return tuple(
            WeightedCondition(design.condition, leg.hours)
            for design, leg in zip(self.designs(), self.legs, strict=True)
        )

    def mean(self, values: Iterable[float]) -> float:
        """Mean of a value on each leg, by hours."""
        return sum(share * value for share, value in zip(self.shares, values, strict=True))

    def designs(self) -> tuple[Design, ...]:
        """The design on each leg."""
        return tuple(leg.of(self.design) for leg in self.legs)


def standard_mission(design: Design) -> Mission:
    """The mission that is flown unless another is given: `standard_flight` with assumed hours."""
    return Mission(design, standard_flight(design))


def mission_at(
    design: Design, advance_ratios: Sequence[float], hours: Sequence[float] | None = None
) -> Mission:
    """A mission of level flight at some advance ratios, for equal hours unless they are given."""
    flown = [1.0] * len(advance_ratios) if hours is None else hours
    pairs = zip(advance_ratios, flown, strict=True)
    return Mission(design, tuple(FlightLeg(flight_text(mu), mu, hours=time) for mu, time in pairs))


def mission_from(path: str | Path, design: Design) -> Mission:
    """The mission of a CSV table (`read_mission`)."""
    return Mission(
        design,
        tuple(
            FlightLeg(
                flight_text(one.flight.advance_ratio),
                one.flight.advance_ratio,
                one.flight.climb_speed,
                one.hours,
                one.flight,
            )
            for one in read_mission(path, design)
        ),
    )


def flight_text(advance_ratio: float) -> str:
    """The name of a flight at an advance ratio, for example `µ 0.30`."""
    return "hover" if advance_ratio == 0.0 else f"µ {advance_ratio:.2f}"
