"""What an optimiser makes small: power at one flight condition or its mean over several, with its slopes by pitch."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from rotor.arrays import Array
from rotor.design.design import Design
from rotor.design.flight import FlightCondition
from rotor.optimisation.stall_limit import stalled_share
from rotor.trim.adjoint import Adjoint, power_along
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

Quantity = Literal["total", "induced"]
QUANTITIES: tuple[Quantity, ...] = ("total", "induced")


@dataclass(frozen=True)
class Leg:
    """A flight condition and how long it is flown."""

    condition: FlightCondition
    hours: float = 1.0

    def __post_init__(self) -> None:
        if not (math.isfinite(self.hours) and self.hours > 0.0):
            raise ValueError(
                f"{self.hours:g} hours at advance ratio {self.condition.advance_ratio:g}: give more than 0"
            )


@dataclass(frozen=True)
class Objective:
    """Mean power over the legs, by their hours [W]."""

    quantity: Quantity
    legs: tuple[Leg, ...]

    def __post_init__(self) -> None:
        if self.quantity not in QUANTITIES:
            raise ValueError(f"objective {self.quantity!r} is not known: use {' or '.join(QUANTITIES)}")
        if not self.legs:
            raise ValueError("an objective without a flight condition: give at least one leg")

    @property
    def shares(self) -> tuple[float, ...]:
        """Part of the hours of each leg."""
        hours = math.fsum(leg.hours for leg in self.legs)
        return tuple(leg.hours / hours for leg in self.legs)


def at_condition(design: Design, quantity: Quantity = "total") -> Objective:
    """Power at the design's own flight condition."""
    return Objective(quantity, (Leg(design.condition),))


def hover_and_cruise(
    design: Design, hover_share: float, cruise_advance_ratio: float, quantity: Quantity = "total"
) -> Objective:
    """Power in hover and in cruise, weighted by the part of the time spent hovering (0…1)."""
    if not 0.0 <= hover_share <= 1.0:
        raise ValueError(f"hover share {hover_share:g} is outside 0…1: give the part of the time spent hovering")
    pairs = ((0.0, hover_share), (cruise_advance_ratio, 1.0 - hover_share))
    legs = tuple(Leg(replace(design.condition, advance_ratio=mu), share) for mu, share in pairs if share > 0.0)
    return Objective(quantity, legs)


@dataclass(frozen=True, eq=False)
class Measured:
    """A design measured by an objective."""

    power: float | None
    """Mean power [W]; None when a leg did not trim."""
    by_pitch: Array | None
    """∂power/∂θ of each element's pitch [W/rad], (elements,)."""
    stalled: tuple[float, ...]
    """Smooth stalled share of the disk (0…1), one per leg; empty unless asked for."""
    stalled_by_pitch: Array | None
    """[1/rad], (legs, elements)"""
    solutions: tuple[Solution, ...]
    """One per leg, as far as they were solved."""

    @property
    def message(self) -> str:
        """The sentence of the leg that did not trim, or of the last one."""
        return self.solutions[-1].message


def power_of(solution: Solution, quantity: Quantity) -> float:
    """[W]"""
    return solution.power.total if quantity == "total" else solution.power.induced


def measure(
    objective: Objective,
    design: Design,
    starts: Sequence[Solution] = (),
    *,
    gradient: bool = True,
    stall: bool = False,
) -> Measured:
    """Trim the design on every leg; power, and its exact gradient by pitch along the blade.

    `starts`: earlier solutions of the same legs to begin from. Stops at the first leg that does not trim.
    """
    solutions: list[Solution] = []
    power = 0.0
    by_pitch: Array | None = None
    stalled: list[float] = []
    stalled_by_pitch: list[Array] = []
    for k, (leg, share) in enumerate(zip(objective.legs, objective.shares, strict=True)):
        start = starts[k] if k < len(starts) else None
        solution = solve(replace(design, condition=leg.condition), start)
        solutions.append(solution)
        if not solution.converged:
            return Measured(None, None, (), None, tuple(solutions))
        power += share * power_of(solution, objective.quantity)
        if gradient or stall:
            adjoint = Adjoint(solution)
            part = share * power_along(adjoint, objective.quantity).by_element
            by_pitch = part if by_pitch is None else by_pitch + part
            if stall:
                area, slope = stalled_share(adjoint)
                stalled.append(area)
                stalled_by_pitch.append(slope)
    return Measured(power, by_pitch, tuple(stalled), np.array(stalled_by_pitch) if stall else None, tuple(solutions))
