"""The mission mix of the page: hours at a few advance ratios, as rows that a person edits."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rotor.design.design import Design
from rotor.optimisation.objective import WeightedCondition


@dataclass(frozen=True)
class MissionRow:
    """So many hours at one advance ratio; 0 hours: left out."""

    advance_ratio: float
    hours: float


ROWS = (
    MissionRow(0.0, 0.5),
    MissionRow(0.1, 0.5),
    MissionRow(0.15, 0.5),
    MissionRow(0.2, 1.0),
    MissionRow(0.25, 1.0),
    MissionRow(0.3, 0.5),
)


def legs(design: Design, rows: Sequence[MissionRow] = ROWS) -> tuple[WeightedCondition, ...]:
    """The legs at the design's weight and altitude; ValueError with one sentence when no hours are flown."""
    flown = sorted((row for row in rows if row.hours > 0.0), key=lambda row: row.advance_ratio)
    if not flown:
        raise ValueError("The mission has no hours: give at least one leg more than 0.")
    return tuple(
        WeightedCondition(replace(design.condition, advance_ratio=row.advance_ratio), row.hours) for row in flown
    )
