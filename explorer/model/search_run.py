"""What a user asks of the optimiser, and the search as it stands: the designs that it found."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from explorer.workers.background import WorkRecord
from explorer.workers.solver import ReferenceSaving, StartPower
from rotor import Design, Limits, Optimum
from rotor.optimisation import (
    CONCEPTS,
    Concept,
    Mission,
    Objective,
    Progress,
    Search,
    at_condition,
    even_change_limit,
    find_concept,
    hover_and_cruise,
)
from rotor.optimisation.concepts import AIRFOIL_BREAKS, DIVISION
from rotor.trim.doubt import Doubt

OBJECTIVES = {
    "total": "Total power",
    "induced": "Induced power",
    "hover-cruise": "Hover and cruise",
    "mission": "Mission",
}
_DIVIDED = ("two-segment", "two-segment-two-airfoils")


@dataclass(frozen=True)
class SearchRequest:
    concept: str = "two-segment-free"
    objective: str = "total"
    hover_share: float = 50.0
    """[%]"""
    division: float = DIVISION
    first: float = round(AIRFOIL_BREAKS[0], 2)
    second: float = round(AIRFOIL_BREAKS[1], 2)
    stalled: float | None = None
    """[%] of the disk; None: no limit."""
    change: float | None = None
    """[°] at the tip; None: no limit."""
    index: float | None = None
    """Vibration index [%]; None: no limit."""

    def asks_for(self, name: str) -> bool:
        """Whether the number of that name plays a part."""
        match name:
            case "hover_share":
                return self.objective == "hover-cruise"
            case "division":
                return self.concept in _DIVIDED
            case "first" | "second":
                return self.concept == "three-segment"
            case _:  # A limit that is not set is None.
                return getattr(self, name) is not None

    def known_concept(self) -> Concept:
        if self.concept in _DIVIDED:
            return find_concept(self.concept, [self.division])
        if self.concept == "three-segment":
            breaks = [self.first, self.second]
            # Places that are those of the airfoils but for the sliders' two digits are those of the airfoils.
            if breaks == [round(place, 2) for place in AIRFOIL_BREAKS]:
                return CONCEPTS[self.concept]
            return find_concept(self.concept, breaks)
        return CONCEPTS[self.concept]

    def wanted(self, design: Design, mission: Callable[[Design], Mission]) -> Objective:
        """The objective; ValueError with one sentence where the design cannot have it."""
        if self.objective == "mission":
            return Objective("total", mission(design).conditions)
        if self.objective == "hover-cruise":
            cruise = design.condition.advance_ratio
            if cruise == 0.0:
                raise ValueError("Hover and cruise: set an advance ratio above 0 for the cruise.")
            return hover_and_cruise(design, self.hover_share / 100.0, cruise)
        return at_condition(design, "induced" if self.objective == "induced" else "total")

    def search(self, design: Design, mission: Callable[[Design], Mission]) -> Search:
        """The search; ValueError with one sentence where it makes no sense."""
        if self.index is not None and not design.models.bending:
            raise ValueError(
                "A limit on vibration needs blades that bend: switch Blade bending on, under Model."
            )
        return Search(
            design, self.known_concept(), self.wanted(design, mission), self.limits(design)
        )

    def limits(self, design: Design) -> Limits:
        """The limits; change is counted from the design's own twist."""
        change = (
            None
            if self.change is None
            else even_change_limit(design.twist, math.radians(self.change))
        )
        return Limits(
            stalled=None if self.stalled is None else self.stalled / 100.0,
            change=change,
            index=self.index,
        )


@dataclass(frozen=True)
class SearchFrame:
    """A design that was the best so far."""

    power: float
    """By the objective of the search [W]."""
    design: Design


@dataclass(frozen=True, eq=False)
class SearchRun:
    """A search as it stands."""

    record: WorkRecord

    @property
    def search(self) -> Search:
        return self.record.task.search

    @property
    def concept(self) -> Concept:
        return self.search.concept

    @property
    def under_way(self) -> bool:
        return self.record.under_way

    @property
    def start_power(self) -> float | None:
        """Power of the design that the search began from [W]."""
        return next(
            (report.power for report in self.record.reports if isinstance(report, StartPower)), None
        )

    @property
    def reference_doubt(self) -> Doubt | None:
        """What the optimum saves over the reference design; None where that is the start, or not known."""
        return next(
            (report.doubt for report in self.record.reports if isinstance(report, ReferenceSaving)),
            None,
        )

    @property
    def optimum(self) -> Optimum | None:
        """The result; None before the end."""
        return self.record.result

    @property
    def progress(self) -> Progress | None:
        return next(
            (report for report in reversed(self.record.reports) if isinstance(report, Progress)),
            None,
        )

    @cached_property
    def frames(self) -> tuple[SearchFrame, ...]:
        """The designs to show: the first, and each that was better; the last is the optimum."""
        frames, optimum = list[SearchFrame](), self.optimum
        for report in self.record.reports:
            if isinstance(report, StartPower):
                power = math.inf if report.power is None else report.power
                frames.append(SearchFrame(power, self.search.design))
                continue
            if (
                not isinstance(report, Progress)
                or report.best_power is None
                or report.best_parameters is None
            ):
                continue
            # The concept's first may be no better than the blade it began from; it is shown all the same.
            if len(frames) == 1 or report.best_power < frames[-1].power:
                design = self.concept.apply(self.search.design, report.best_parameters)
                frames.append(SearchFrame(report.best_power, design))
        if (
            optimum is not None
            and optimum.best is not None
            and frames
            and optimum.design != frames[-1].design
        ):
            frames.append(SearchFrame(optimum.best.power, optimum.design))
        return tuple(frames)

    @property
    def best(self) -> SearchFrame | None:
        """The best so far; None before any design was better than none."""
        return self.frames[-1] if len(self.frames) > 1 else None

    @property
    def sentence(self) -> str:
        return self.record.sentence if self.optimum is None else self.optimum.message

    @property
    def part_done(self) -> float:
        """0…1: starts first, then the band."""
        progress = self.progress
        if not self.under_way:
            return 1.0
        if progress is None:
            return 0.0
        if progress.phase == "band":
            return 0.9
        tried = sum(
            isinstance(one, Progress) and one.start == progress.start for one in self.record.reports
        )
        return 0.85 * (progress.start + tried / (tried + 15.0)) / progress.starts

    def matches(self, design: Design) -> bool:
        """Whether this is the design that the search began from."""
        return design == self.search.design
