"""What a user asks of the optimiser, and the search as the page follows it: the designs to play."""

import math
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

from explorer.workers.background import FRAME
from explorer.workers.solver import ReferencePower, StartPower
from rotor import Design, Limits, Optimum
from rotor.optimisation import (
    CONCEPTS,
    Concept,
    Objective,
    Progress,
    Search,
    WeightedCondition,
    at_condition,
    even_change_limit,
    find_concept,
    hover_and_cruise,
)
from rotor.optimisation.concepts import AIRFOIL_BREAKS, DIVISION
from rotor.support.processes import JobEnded, JobEvent, JobFailed, JobProgress, JobQueued, JobStarted
from rotor.support.user_input import shorten

MISSION = "0:0.5, 0.1:0.5, 0.15:0.5, 0.2:1, 0.25:1, 0.3:0.5"
"""Advance ratio and hours of each leg."""
MOST_LEGS = 12
_FASTEST, _LONGEST = 0.45, 99.0


def mission_of(text: str) -> tuple[tuple[float, float], ...]:
    """Advance ratio and hours of the legs in order of speed; ValueError with one sentence for what is no mission.

    Legs are apart by a comma or a new line; hours that are left out are 1.
    """
    parts = [part.strip() for part in text.replace("\n", ",").split(",") if part.strip()]
    if len(parts) > MOST_LEGS:
        raise ValueError(f"The mission has {len(parts)} legs: give at most {MOST_LEGS}.")
    flown = sorted(_leg(part) for part in parts)
    if not any(hours for _, hours in flown):
        raise ValueError("The mission has no hours: give at least one leg, such as 0.2:1.")
    return tuple(leg for leg in flown if leg[1])


def _leg(text: str) -> tuple[float, float]:
    speed, _, flown = text.partition(":")
    try:
        mu, hours = float(speed), float(flown or 1.0)
    except ValueError:
        mu = hours = math.nan
    if not (0.0 <= mu <= _FASTEST and 0.0 <= hours <= _LONGEST):
        wanted = f"advance ratio 0 to {_FASTEST:g} and hours 0 to {_LONGEST:g}, such as 0.2:1"
        raise ValueError(f"The mission has {shorten(text, 30)!r}: write each leg as {wanted}.")
    return mu, hours


def legs(design: Design, mission: str = MISSION) -> tuple[WeightedCondition, ...]:
    """The legs at the design's weight and altitude; ValueError as in `mission_of`."""
    return tuple(
        WeightedCondition(replace(design.condition, advance_ratio=mu), hours) for mu, hours in mission_of(mission)
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
        if self.index is not None and not design.models.bending:
            raise ValueError("A limit on vibration needs blades that bend: switch Blade bending on, under Model.")
        return Search(
            design=design, concept=self.known_concept(), objective=self.wanted(design, legs), limits=self.limits(design)
        )

    def limits(self, design: Design) -> Limits:
        """The limits; change is counted from the design's own twist."""
        change = None if self.change is None else even_change_limit(design.twist, math.radians(self.change))
        return Limits(stalled=None if self.stalled is None else self.stalled / 100.0, change=change, index=self.index)


State = Literal["starting", "waiting", "running", "stopping", "done", "stopped", "late", "broken"]
_CATCH_UP = 8
"""Never further behind the search than about so many frames."""


@dataclass(frozen=True)
class SearchFrame:
    """A design that was the best so far."""

    evaluation: int
    power: float
    """By the objective of the search [W]."""
    design: Design


class SearchRun:
    """Written by the pool's threads (`on_event`), read by the session's."""

    def __init__(self, search: Search, reference_title: str = "") -> None:
        """`reference_title`: what the saving is also measured against."""
        self.search, self.reference_title = search, reference_title
        self.state: State = "starting"
        self.ahead = 0
        self.sentence = ""
        self.start_power: float | None = None
        """Power of the design that the search began from [W]."""
        self.reference_power: float | None = None
        self.frames: list[SearchFrame] = []
        self._tried = 0
        """Designs of the start under way."""
        self.progress: Progress | None = None
        self.optimum: Optimum | None = None
        self._lock = threading.Lock()
        self._cursor, self._plays, self._since = 0, True, 0.0
        """Which frame is shown, whether it moves on by itself, and since when it is shown."""

    @property
    def concept(self) -> Concept:
        return self.search.concept

    @property
    def under_way(self) -> bool:
        return self.state in ("starting", "waiting", "running", "stopping")

    @property
    def best(self) -> SearchFrame | None:
        """The best so far; None before any design was better than none."""
        return self.frames[-1] if len(self.frames) > 1 else None

    @property
    def part_done(self) -> float:
        """0…1: starts first, then the band."""
        if self.state in ("done", "stopped", "late", "broken"):
            return 1.0
        progress = self.progress
        if progress is None:
            return 0.0
        if progress.phase == "band":
            return 0.9
        return 0.85 * (progress.start + self._tried / (self._tried + 15.0)) / progress.starts

    def stopping(self) -> None:
        with self._lock:
            if self.under_way:
                self.state = "stopping"

    def on_event(self, news: JobEvent) -> None:
        with self._lock:
            match news:
                case JobQueued(ahead):
                    self.state, self.ahead = "waiting", ahead
                case JobStarted():
                    if self.state != "stopping":
                        self.state = "running"
                case JobProgress(StartPower(power)):
                    self.start_power = power
                    self.frames.append(SearchFrame(0, float("inf") if power is None else power, self.search.design))
                case JobProgress(ReferencePower(power)):
                    self.reference_power = power
                case JobProgress(Progress() as progress):
                    self._step(progress)
                case JobEnded(result, stopped, late):
                    self.state = "late" if late else "stopped" if stopped else "done"
                    self._finish(result)
                case JobFailed(message):
                    self.state, self.sentence = "broken", message
                case _:
                    pass

    def _step(self, progress: Progress) -> None:
        before, self.progress = self.progress, progress
        if progress.phase == "search":
            self._tried = self._tried + 1 if before is not None and before.start == progress.start else 1
        best, values = progress.best_power, progress.best_parameters
        if best is None or values is None:
            return
        # The concept's first may be no better than the blade it began from; it is shown all the same.
        if len(self.frames) == 1 or best < self.frames[-1].power:
            design = self.concept.apply(self.search.design, values)
            self.frames.append(SearchFrame(progress.evaluation, best, design))

    def _finish(self, optimum: Optimum | None) -> None:
        self.optimum = optimum
        if optimum is None:
            return
        self.sentence = optimum.message
        if optimum.best is not None and self.frames and optimum.design != self.frames[-1].design:
            self.frames.append(SearchFrame(optimum.evaluations, optimum.best.power, optimum.design))

    def matches(self, design: Design) -> bool:
        """Whether this is the design that the search began from."""
        return design == self.search.design

    def shown(self) -> SearchFrame | None:
        """The frame whose turn it is: each for `FRAME`, never far behind."""
        if not self.frames:
            return None
        last, now = len(self.frames) - 1, time.monotonic()
        if self._since == 0.0:
            self._since = now  # The first has its time as well.
        if self._plays and self._cursor < last and now - self._since >= FRAME:
            self._cursor += max(1, last - self._cursor - _CATCH_UP)
            self._since = now
        return self.frames[min(self._cursor, last)]

    @property
    def cursor(self) -> int:
        return min(self._cursor, max(len(self.frames) - 1, 0))

    @property
    def chosen(self) -> SearchFrame:
        """What Apply takes: the frame that somebody scrubbed to, or else the best, even while the picture plays."""
        return self.frames[-1 if self._plays else self.cursor]

    @property
    def playing(self) -> bool:
        """Whether more frames wait to be shown."""
        return self._plays and self._cursor < len(self.frames) - 1

    def scrub(self, cursor: int) -> None:
        """Show one frame and stay there."""
        self._cursor, self._plays = cursor, False
