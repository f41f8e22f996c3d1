"""The objective of a search: power or the vibration index at one flight condition or their mean over several, and the
gradient by pitch."""

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np

from rotor.design.aircraft import FlightCondition
from rotor.design.design import Design
from rotor.design.quantities import CONDITION
from rotor.design.quantity import number
from rotor.optimisation.limits import PERCENT, Limits, stalled_share
from rotor.support.arrays import Array
from rotor.support.user_input import check_known, read_text, refusing
from rotor.trim.adjoint import Objective as PowerKind
from rotor.trim.adjoint import power_along
from rotor.trim.analysis import Analysis
from rotor.trim.hub_loads import hub_index, index_along
from rotor.trim.many import analyse_many
from rotor.trim.newton import DEFAULT_OPTIONS, SolverOptions
from rotor.trim.no_hub_loads import why_no_hub_loads
from rotor.trim.solution import Solution
from rotor.trim.solve import Start, analyse

Quantity = Literal["total", "induced", "vibration"]
POWERS: tuple[PowerKind, ...] = ("total", "induced")
QUANTITIES: tuple[Quantity, ...] = (*POWERS, "vibration")
"""What a search can make small; the last is the index of `rotor.trim.hub_loads`."""


@dataclass(frozen=True)
class WeightedCondition:
    """A flight condition and its flight time."""

    flight: FlightCondition
    hours: float = 1.0
    """Flight time [h]."""

    def __post_init__(self) -> None:
        if not (math.isfinite(self.hours) and self.hours > 0.0):
            raise ValueError(
                f"{self.hours:g} hours at advance ratio {self.flight.advance_ratio:g}: give more than 0"
            )


@dataclass(frozen=True)
class Objective:
    """Mean power [W], or mean index [%], over the conditions by their hours."""

    quantity: Quantity
    conditions: tuple[WeightedCondition, ...]

    def __post_init__(self) -> None:
        check_known("objective", self.quantity, QUANTITIES)
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
        raise ValueError(
            "a free rotor takes no power from its shaft: use the objective induced, or trim wind-tunnel"
        )
    return Objective(quantity, (WeightedCondition(design.condition),))


def over_conditions(
    design: Design, conditions: Sequence[tuple[float | Design, float]], quantity: Quantity = "total"
) -> Objective:
    """The mean over several flight conditions of the design, each an advance ratio, or a design at it, with its weight.

    Raises TypeError or ValueError with one sentence for what cannot be used.
    """
    at_condition(design, quantity)
    example = "conditions=[(0.0, 1), (0.3, 2)]"
    if isinstance(conditions, str) or not hasattr(conditions, "__iter__"):
        raise TypeError(
            f"conditions is {conditions!r}: give pairs of advance ratio and weight, {example}"
        )
    weighted: list[WeightedCondition] = []
    for pair in conditions:
        if not isinstance(pair, tuple | list) or len(pair) != 2:  # pyright: ignore[reportUnnecessaryIsInstance]
            raise TypeError(
                f"condition {pair!r} is not a pair: give advance ratio and weight, {example}"
            )
        where, weight = pair
        if isinstance(where, Design):
            if where.rotor.at_speed(100.0).tip_speed != design.rotor.at_speed(100.0).tip_speed:
                raise ValueError(
                    f"a condition has {where.rotor.name}, the design {design.rotor.name}: use one rotor"
                )
            flight = where.condition
        else:
            flight = design.at(mu=where).condition
        weighted.append(WeightedCondition(flight, number("weight", weight, "1")))
    return Objective(quantity, tuple(weighted))


def hover_and_cruise(
    design: Design, hover_share: float, cruise_advance_ratio: float, quantity: Quantity = "total"
) -> Objective:
    """Power in hover and in cruise, weighted by the share of time in hover, 0…1; ValueError outside."""
    if not 0.0 <= hover_share <= 1.0:
        raise ValueError(
            f"hover share {hover_share:g} is outside 0…1: give the fraction of time in hover"
        )
    pairs = ((0.0, hover_share), (cruise_advance_ratio, 1.0 - hover_share))
    conditions = tuple(
        WeightedCondition(replace(design.condition, advance_ratio=mu), share)
        for mu, share in pairs
        if share > 0.0
    )
    return Objective(quantity, conditions)


@dataclass(frozen=True, eq=False)
class ObjectiveValue:
    """An objective evaluated for a design."""

    power: float | None
    """Mean power [W], the total for the objective `vibration`; None when a condition did not trim."""
    trims: tuple[Analysis, ...]
    """One per condition, as far as they were solved."""
    value: float | None = None
    """The objective: the power [W] or the mean index [%]."""
    by_pitch: Array | None = None
    """∂value/∂θ of each element's pitch [1/rad], (elements,)."""
    index: float | None = None
    """Mean index [%] where objective or limits ask for it."""
    limited: tuple[float, ...] = ()
    """What the limits hold [%]: the area past the static angle on every condition, then the index on every one."""
    limited_by_pitch: Array | None = None
    """[1/rad], (limited, elements)"""

    @property
    def solutions(self) -> tuple[Solution, ...]:
        """The solutions of `trims`."""
        return tuple(trim.solution for trim in self.trims)

    @property
    def message(self) -> str:
        """Message of the condition that did not trim, or of the last one."""
        return self.trims[-1].solution.message


def check_index(design: Design, objective: Objective, limits: Limits) -> None:
    """Raise ValueError, with one sentence, where the index is asked for and a condition has none."""
    if objective.quantity != "vibration" and limits.index is None:
        return
    for condition in objective.conditions:
        reason = why_no_hub_loads(replace(design, condition=condition.flight))
        if reason is not None:
            where = f"advance ratio {condition.flight.advance_ratio:g}"
            why = f"{reason.sentence[0].lower()}{reason.sentence[1:].rstrip('.')}"
            raise ValueError(
                f"there is no vibration index at {where} ({why}): choose other conditions"
            )
    if not design.models.bending:
        raise ValueError(
            "the vibration index needs bending blades: add --bending, or bending=True in Python"
        )


def evaluate_objective(
    objective: Objective,
    design: Design,
    starts: Sequence[Solution] = (),
    *,
    gradient: bool = True,
    limits: Limits | None = None,
    options: SolverOptions = DEFAULT_OPTIONS,
    solved: Sequence[Analysis] = (),
) -> ObjectiveValue:
    """Trim the design on every condition; the objective and what limits hold, with exact gradients by the pitch along
    the blade.

    `starts`: earlier solutions of the same conditions to begin from. `solved`: the trims themselves, where they are
    known. Stops at the first condition that does not trim.
    """
    limits = limits or Limits()
    vibration, indexed = objective.quantity == "vibration", limits.index is not None
    kind: PowerKind = "induced" if objective.quantity == "induced" else "total"
    trims, stalled, indices = (
        list[Analysis](),
        list[tuple[float, Array]](),
        list[tuple[float, Array]](),
    )
    power, index, slopes = 0.0, 0.0, list[Array]()
    for k, (condition, share) in enumerate(
        zip(objective.conditions, objective.shares, strict=True)
    ):
        if k < len(solved):
            trims.append(solved[k])
        else:
            start = starts[k] if k < len(starts) else None
            trims.append(analyse(replace(design, condition=condition.flight), start, options))
        solution = trims[-1].solution
        if not solution.converged:
            return ObjectiveValue(None, tuple(trims))
        power += share * getattr(solution.power, kind)
        if not gradient:
            index += share * hub_index(trims[-1].adjoint) if vibration or indexed else 0.0
            continue
        adjoint = trims[-1].adjoint
        if vibration or indexed:
            indices.append(index_along(adjoint))
            index += share * indices[-1][0]
        by_pitch = indices[-1][1] if vibration else power_along(adjoint, kind).by_element
        slopes.append(share * by_pitch)
        if limits.stalled is not None:
            area, slope = stalled_share(adjoint)
            stalled.append((area / PERCENT, slope / PERCENT))
    limited = [*stalled, *(indices if indexed else [])]
    return ObjectiveValue(
        power=power,
        trims=tuple(trims),
        value=index if vibration else power,
        by_pitch=sum(slopes[1:], start=slopes[0]) if gradient else None,
        index=index if vibration or indexed else None,
        limited=tuple(value for value, _ in limited),
        limited_by_pitch=np.array([slope for _, slope in limited]) if limited else None,
    )


def evaluate_objectives(
    objective: Objective,
    designs: Sequence[Design],
    starts: Sequence[Sequence[Start]] = (),
    *,
    gradient: bool = True,
    limits: Limits | None = None,
    options: SolverOptions = DEFAULT_OPTIONS,
) -> list[ObjectiveValue]:
    """`evaluate_objective` of many designs at once; starts: for each design, by condition."""
    by_condition = [
        analyse_many(
            [replace(design, condition=condition.flight) for design in designs],
            [each[k] if k < len(each) else None for each in starts],
            options,
        )
        for k, condition in enumerate(objective.conditions)
    ]
    return [
        evaluate_objective(objective, design, gradient=gradient, limits=limits, solved=trims)
        for design, trims in zip(designs, zip(*by_condition, strict=True), strict=True)
    ]


MISSION_COLUMNS = (*CONDITION, "hours")
"""Columns of a mission that are read; only mu is needed."""


@refusing("mission", f"give a CSV file with {', '.join(MISSION_COLUMNS)}")
def read_mission(path: str | Path, design: Design) -> tuple[WeightedCondition, ...]:
    """Flight conditions of a CSV table with columns of `CONDITION` and hours; `#` starts a comment.

    Only mu is needed: what is left out or blank is the design's own, hours are 1. Raises ValueError with one sentence
    that names file, line and remedy.
    """
    path = Path(path)
    text = read_text(path, "mission", f"give a CSV file with {', '.join(MISSION_COLUMNS)}")
    numbered = [
        (number, line.partition("#")[0].strip())
        for number, line in enumerate(text.splitlines(), start=1)
    ]
    rows = [(number, next(csv.reader([line]))) for number, line in numbered if line]
    if not rows:
        raise ValueError(
            f"mission {str(path)!r} is empty: start it with the line {','.join(MISSION_COLUMNS)}"
        )
    heading = [cell.strip() for cell in rows[0][1]]
    unknown = [name for name in heading if name not in MISSION_COLUMNS]
    if unknown or "mu" not in heading:
        raise ValueError(
            f"mission {str(path)!r} line {rows[0][0]} reads {','.join(heading)!r}: "
            f"write the heading {','.join(MISSION_COLUMNS)}; only mu is required"
        )
    if len(rows) < 2:
        raise ValueError(
            f"mission {str(path)!r} has no flight conditions: add a line with a number for each column"
        )
    return tuple(
        _condition(path, line, dict(zip(heading, cells, strict=False)), design)
        for line, cells in rows[1:]
    )


def _condition(path: Path, line: int, cells: dict[str, str], design: Design) -> WeightedCondition:
    try:
        base = design.condition.numbers | {"mu": None}
        numbers = {row.field: _number(cells, name, base[name]) for name, row in CONDITION.items()}
        condition = replace(design.condition, **numbers)
        # Refuses a climb where the models are those of level flight.
        replace(design, condition=condition)
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
