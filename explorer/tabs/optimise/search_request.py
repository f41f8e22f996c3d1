"""What a user asks of the optimiser, the mission included, and the search that it means."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from rotor.design.design import Design
from rotor.optimisation.concepts import CONCEPTS, Concept, find_concept
from rotor.optimisation.concepts.catalogue import AIRFOIL_BREAKS, DIVISION
from rotor.optimisation.objective import Objective, WeightedCondition, at_condition, hover_and_cruise
from rotor.optimisation.search import STARTS, Limits, Search, even_change_limit


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


OBJECTIVES = {
    "total": "Total power",
    "induced": "Induced power",
    "hover-cruise": "Hover and cruise",
    "mission": "Mission",
}
_DIVIDED = ("two-segment", "two-segment-two-airfoils")


@dataclass(frozen=True)
class SearchRequest:
    """The Optimise tab's widgets."""

    concept: str = "two-segment-free"
    objective: str = "total"
    hover_share: float = 50.0
    """[%]"""
    division: float = DIVISION
    first: float = round(AIRFOIL_BREAKS[0], 2)
    second: float = round(AIRFOIL_BREAKS[1], 2)
    starts: int = STARTS
    stalled: float | None = None
    """[%] of the disk; None: no limit."""
    change: float | None = None
    """[°] at the tip; None: no limit."""

    def asks_for(self, name: str) -> bool:
        """Whether the number of that name plays a part."""
        match name:
            case "hover_share":
                return self.objective == "hover-cruise"
            case "division":
                return self.concept in _DIVIDED
            case "first" | "second":
                return self.concept == "three-segment"
            case "stalled":
                return self.stalled is not None
            case "change":
                return self.change is not None
            case _:
                return True

    def known_concept(self) -> Concept:
        """The concept, divided as asked."""
        if self.concept in _DIVIDED:
            return find_concept(self.concept, [self.division])
        if self.concept == "three-segment":
            breaks = [self.first, self.second]
            # The sliders' two digits, where they still mean the airfoils' own places, are those places.
            if breaks == [round(place, 2) for place in AIRFOIL_BREAKS]:
                return CONCEPTS[self.concept]
            return find_concept(self.concept, breaks)
        return CONCEPTS[self.concept]

    def wanted(self, design: Design, legs: Callable[[Design], tuple[WeightedCondition, ...]]) -> Objective:
        """The objective; ValueError with one sentence where the design cannot have it."""
        if self.objective == "mission":
            return Objective("total", legs(design))
        if self.objective == "hover-cruise":
            cruise = design.condition.advance_ratio
            if cruise == 0.0:
                raise ValueError("Hover and cruise: set an advance ratio above 0 for the cruise.")
            return hover_and_cruise(design, self.hover_share / 100.0, cruise)
        return at_condition(design, "induced" if self.objective == "induced" else "total")

    def search(self, design: Design, legs: Callable[[Design], tuple[WeightedCondition, ...]]) -> Search:
        """The search; ValueError with one sentence where it makes no sense."""
        return Search(
            design=design,
            concept=self.known_concept(),
            objective=self.wanted(design, legs),
            limits=self.limits(design),
            starts=self.starts,
        )

    def limits(self, design: Design) -> Limits:
        """The limits; change is counted from the design's own twist."""
        change = None if self.change is None else even_change_limit(design.twist, math.radians(self.change))
        return Limits(stalled=None if self.stalled is None else self.stalled / 100.0, change=change)
