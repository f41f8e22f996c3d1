"""The objective of a search: power at one flight condition or its mean over several, and its gradient by pitch."""

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np

from rotor.arrays import Array
from rotor.design.aircraft import FlightCondition
from rotor.design.design import Design
from rotor.optimisation.limits import stalled_share
from rotor.trim.adjoint import Adjoint, power_along
from rotor.trim.newton import DEFAULT_OPTIONS, SolverOptions
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from rotor.user_input import read_text, refusing

Quantity = Literal["total", "induced"]
QUANTITIES: tuple[Quantity, ...] = ("total", "induced")


@dataclass(frozen=True)
class WeightedCondition:
    """A flight condition and its flight time."""

    flight: FlightCondition
    hours: float = 1.0

    def __post_init__(self) -> None:
        if not (math.isfinite(self.hours) and self.hours > 0.0):
            raise ValueError(f"{self.hours:g} hours at advance ratio {self.flight.advance_ratio:g}: give more than 0")


@dataclass(frozen=True)
class Objective:
    """Mean power over the conditions, by their hours [W]."""

    quantity: Quantity
    conditions: tuple[WeightedCondition, ...]

    def __post_init__(self) -> None:
        if self.quantity not in QUANTITIES:
            raise ValueError(f"objective {self.quantity!r} is not known: use {' or '.join(QUANTITIES)}")
        if not self.conditions:
            raise ValueError("an objective needs a flight condition: give at least one")

    @property
    def shares(self) -> tuple[float, ...]:
        """Fraction of the total time of each condition."""
        hours = math.fsum(condition.hours for condition in self.conditions)
        return tuple(condition.hours / hours for condition in self.conditions)


def at_condition(design: Design, quantity: Quantity = "total") -> Objective:
    """Power at the design's own flight condition.

    Raises ValueError for the total power of a free rotor, which is zero.
    """
    if design.models.trim == "free-rotor" and quantity == "total":
        raise ValueError("a free rotor takes no power from its shaft: use the objective induced, or trim wind-tunnel")
    return Objective(quantity, (WeightedCondition(design.condition),))


def hover_and_cruise(
    design: Design, hover_share: float, cruise_advance_ratio: float, quantity: Quantity = "total"
) -> Objective:
    """Power in hover and in cruise, weighted by the fraction of time in hover (0…1)."""
    if not 0.0 <= hover_share <= 1.0:
        raise ValueError(f"hover share {hover_share:g} is outside 0…1: give the fraction of time in hover")
    pairs = ((0.0, hover_share), (cruise_advance_ratio, 1.0 - hover_share))
    conditions = tuple(
        WeightedCondition(replace(design.condition, advance_ratio=mu), share) for mu, share in pairs if share > 0.0
    )
    return Objective(quantity, conditions)


@dataclass(frozen=True, eq=False)
class Measured:
    """An objective evaluated for a design."""

    power: float | None
    """Mean power [W]; None when a condition did not trim."""
    by_pitch: Array | None
    """∂power/∂θ of each element's pitch [W/rad], (elements,)."""
    stalled: tuple[float, ...]
    """Smooth stalled share of the disk (0…1), one per condition; empty unless requested."""
    stalled_by_pitch: Array | None
    """[1/rad], (conditions, elements)"""
    solutions: tuple[Solution, ...]
    """One per condition, as far as they were solved."""

    @property
    def message(self) -> str:
        """Message of the condition that did not trim, or of the last one."""
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
    options: SolverOptions = DEFAULT_OPTIONS,
) -> Measured:
    """Trim the design on every condition; power, and its exact gradient by pitch along the blade.

    `starts`: earlier solutions of the same conditions to begin from. Stops at the first condition that does not trim.
    """
    solutions: list[Solution] = []
    power = 0.0
    by_pitch: Array | None = None
    stalled: list[float] = []
    stalled_by_pitch: list[Array] = []
    for k, (condition, share) in enumerate(zip(objective.conditions, objective.shares, strict=True)):
        start = starts[k] if k < len(starts) else None
        solution = solve(replace(design, condition=condition.flight), start, options)
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


MISSION_COLUMNS = ("mu", "mass_kg", "altitude_m", "climb_m_s", "hours")


@refusing("mission", f"give a CSV file with {', '.join(MISSION_COLUMNS)}")
def read_mission(path: str | Path, design: Design) -> tuple[WeightedCondition, ...]:
    """Flight conditions of a CSV table with the columns `MISSION_COLUMNS`; `#` starts a comment.

    Only mu is needed: mass, altitude and rate of climb left out or blank are the design's own, hours are 1. Raises
    ValueError with one sentence that names file, line and remedy.
    """
    path = Path(path)
    text = read_text(path, "mission", f"give a CSV file with {', '.join(MISSION_COLUMNS)}")
    numbered = [(number, line.partition("#")[0].strip()) for number, line in enumerate(text.splitlines(), start=1)]
    rows = [(number, next(csv.reader([line]))) for number, line in numbered if line]
    if not rows:
        raise ValueError(f"mission {str(path)!r} is empty: start it with the line {','.join(MISSION_COLUMNS)}")
    heading = [cell.strip() for cell in rows[0][1]]
    unknown = [name for name in heading if name not in MISSION_COLUMNS]
    if unknown or "mu" not in heading:
        raise ValueError(
            f"mission {str(path)!r} line {rows[0][0]} reads {','.join(heading)!r}: "
            f"write the heading {','.join(MISSION_COLUMNS)}; only mu is required"
        )
    if len(rows) < 2:
        raise ValueError(f"mission {str(path)!r} has no flight conditions: add a line such as 0.2,8322,0,0,1.5")
    return tuple(
        _condition(path, number, dict(zip(heading, cells, strict=False)), design) for number, cells in rows[1:]
    )


def _condition(path: Path, line: int, cells: dict[str, str], design: Design) -> WeightedCondition:
    condition = design.condition
    try:
        condition = replace(
            condition,
            advance_ratio=_number(cells, "mu", None),
            mass=_number(cells, "mass_kg", condition.mass),
            altitude=_number(cells, "altitude_m", condition.altitude),
            climb_speed=_number(cells, "climb_m_s", condition.climb_speed),
        )
        replace(design, condition=condition)  # Refuses a climb where the models are those of level flight.
        return WeightedCondition(condition, _number(cells, "hours", 1.0))
    except ValueError as error:
        raise ValueError(f"mission {str(path)!r} line {line}: {error}") from None


def _number(cells: dict[str, str], name: str, default: float | None) -> float:
    text = cells.get(name, "").strip()
    if not text and default is not None:
        return default
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ValueError(f"{name} is {text!r}: write a number")
    return value
