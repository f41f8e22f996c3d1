"""What a user asks of the optimiser, and the search as the page follows it: designs to play, and its starts."""

import math
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate
from typing import Literal

from explorer.model.units import SI, Units
from explorer.tabs.background import FRAME
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
from rotor.optimisation.search import STARTS
from rotor.processes import JobEnded, JobEvent, JobFailed, JobProgress, JobQueued, JobStarted


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
            design=design,
            concept=self.known_concept(),
            objective=self.wanted(design, legs),
            limits=self.limits(design),
            starts=self.starts,
        )

    def limits(self, design: Design) -> Limits:
        """The limits; change is counted from the design's own twist."""
        change = None if self.change is None else even_change_limit(design.twist, math.radians(self.change))
        return Limits(stalled=None if self.stalled is None else self.stalled / 100.0, change=change, index=self.index)


State = Literal["starting", "waiting", "running", "stopping", "done", "stopped", "late", "broken"]
TRACES = 16
"""The most starts of a search on the page."""
_CATCH_UP = 8
"""Never further behind the search than about so many frames."""


@dataclass(frozen=True)
class SearchFrame:
    """A design that was the best so far."""

    evaluation: int
    power: float
    """By the objective of the search [W]."""
    design: Design


StartState = Literal["waiting", "running", "finished", "not run"]


@dataclass(frozen=True)
class StartTrace:
    """One start of a search at one time."""

    number: int
    """From 1."""
    powers: tuple[float, ...]
    """Power of every design tried [W]."""
    best: tuple[float, ...]
    """The least so far after each of them [W]."""
    state: StartState
    gap: float | None
    """Best power of the start above the best of all starts [W]; None before its first design."""

    @property
    def is_best(self) -> bool:
        """Whether the best of all starts is its own."""
        return self.gap == 0.0

    def legend(self, units: Units = SI) -> str:
        """A start in the legend: `Start 3: best`, `Start 2: equal`, `Start 1: +0.4 kW`, `Start 6: waiting`."""
        if self.gap is None:
            return f"Start {self.number}: {'no trim' if self.state == 'finished' else self.state}"
        behind = units.watts(self.gap, 1, sign=True)
        # As printed: what is less than the last digit is no difference.
        return f"Start {self.number}: {'best' if self.is_best else behind if behind.startswith('+') else 'equal'}"


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
        self.traces: list[list[float]] = [[] for _ in range(search.starts)]
        """Power at each evaluation of each start [W]; one without trim or beyond a limit repeats the one before.
        At the end that of the minimum it leads to."""
        self.paths: list[list[tuple[tuple[float, ...], float]]] = [[] for _ in range(search.starts)]
        """Parameters and power [W] of each start's best design so far, whenever there was a better one."""
        self.progress: Progress | None = None
        self.optimum: Optimum | None = None
        self._lock = threading.Lock()
        self._play = Playback()

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
        done = len(self.traces[progress.start]) if progress.start < len(self.traces) else 0
        return 0.85 * (progress.start + done / (done + 15.0)) / progress.starts

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
        self.progress = progress
        if progress.phase == "search" and progress.start < len(self.traces):
            trace = self.traces[progress.start]
            if progress.power is not None and progress.feasible:
                trace.append(progress.power)
                path = self.paths[progress.start]
                if not path or progress.power < path[-1][1]:
                    path.append((progress.parameters, progress.power))
            elif trace:
                trace.append(trace[-1])
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
        for minimum in optimum.minima:  # A start that leads to a minimum known is not followed to its end.
            for start in minimum.starts:
                if self.traces[start] and minimum.power < self.traces[start][-1]:
                    self.traces[start].append(minimum.power)
                    self.paths[start].append((minimum.parameters, minimum.power))
        if optimum.best is not None and self.frames and optimum.design != self.frames[-1].design:
            self.frames.append(SearchFrame(optimum.evaluations, optimum.best.power, optimum.design))

    def starts(self) -> tuple[StartTrace, ...]:
        """How far each start is. A snapshot: the run may be written meanwhile."""
        traces = [tuple(trace) for trace in self.traces]
        progress = self.progress
        current = -1 if progress is None else progress.start
        searching = progress is None or progress.phase != "band"
        bests = [tuple(accumulate(trace, min)) for trace in traces]
        least = min((best[-1] for best in bests if best), default=0.0)
        starts: list[StartTrace] = []
        for k, (trace, best) in enumerate(zip(traces, bests, strict=True)):
            state: StartState = "finished"
            if searching and self.under_way:
                state = "finished" if k < current else "running" if k == current else "waiting"
            elif searching and self.state != "done" and k > current:
                state = "not run"
            starts.append(StartTrace(k + 1, trace, best, state, best[-1] - least if best else None))
        return tuple(starts)

    def matches(self, design: Design) -> bool:
        """Whether this is the design that the search began from."""
        return design == self.search.design

    def shown(self) -> SearchFrame | None:
        """The frame whose turn it is."""
        return self._play.frame(self.frames)

    @property
    def cursor(self) -> int:
        return min(self._play.cursor, max(len(self.frames) - 1, 0))

    @property
    def chosen(self) -> SearchFrame:
        """What Apply takes: the frame that somebody scrubbed to, or else the best, even while the picture plays."""
        return self.frames[-1 if self._play.running else self.cursor]

    @property
    def playing(self) -> bool:
        """Whether more frames wait to be shown."""
        return self._play.running and self._play.cursor < len(self.frames) - 1

    def scrub(self, cursor: int) -> None:
        """Show one frame and stay there."""
        self._play = Playback(cursor=cursor, running=False)

    def replay(self) -> None:
        """Play from the start, each frame in its turn."""
        self._play = Playback(thorough=True)


@dataclass
class Playback:
    """Which frame is shown: each for `FRAME`, never far behind unless `thorough`."""

    cursor: int = 0
    running: bool = True
    thorough: bool = False
    since: float = 0.0

    def frame(self, frames: list[SearchFrame]) -> SearchFrame | None:
        if not frames:
            return None
        last = len(frames) - 1
        now = time.monotonic()
        if self.since == 0.0:
            self.since = now  # The first has its time as well.
        if self.running and self.cursor < last and now - self.since >= (2.0 if self.thorough else 1.0) * FRAME:
            behind = last - self.cursor
            self.cursor += 1 if self.thorough else max(1, behind - _CATCH_UP)
            self.since = now
        return frames[min(self.cursor, last)]
