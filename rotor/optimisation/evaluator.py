"""Evaluates designs for a search: trims from the nearest earlier solution, reports progress, stops on request."""

import math
import time
from collections import deque
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotor.aero.problem import build_problem
from rotor.design.blade import Rotor
from rotor.design.design import Design
from rotor.optimisation.concept import Concept
from rotor.optimisation.limits import Limits, cheap_margins
from rotor.optimisation.objective import (
    Objective,
    ObjectiveValue,
    evaluate_objective,
    evaluate_objectives,
)
from rotor.optimisation.results import Phase, Progress
from rotor.support.arrays import Array
from rotor.trim.newton import SolverOptions
from rotor.trim.solution import Solution

FEASIBLE = 1e-3
"""Accepted violation of a limit: a thousandth of a degree, or of a per cent of the disk."""
_KEPT_SOLUTIONS = 64
"""Solutions kept as starts for trims."""


@dataclass(frozen=True, eq=False)
class TrimmedBlade:
    """A trim of one blade, from which trims of similar blades of any concept can start."""

    rotor: Rotor
    pitch: Array
    """Twist at the elements [rad], (elements,)."""
    measured: ObjectiveValue
    """Without the trims; solutions are kept of the last ones only."""


class TrimHistory:
    """The blades that searches with one objective have trimmed."""

    def __init__(self) -> None:
        self.all: list[TrimmedBlade] = []
        self._lost: list[TrimmedBlade] = []
        """What did not trim."""
        self._solved: deque[tuple[TrimmedBlade, tuple[Solution, ...]]] = deque(
            maxlen=_KEPT_SOLUTIONS
        )

    def known(self, rotor: Rotor, pitch: Array) -> TrimmedBlade | None:
        """The trim of exactly this blade, or None."""
        every = (*self.all, *self._lost)
        return next(
            (
                point
                for point in every
                if np.array_equal(point.pitch, pitch) and point.rotor == rotor
            ),
            None,
        )

    def starts(self, pitch: Array, r: Array) -> tuple[Solution, ...]:
        """The trims of the nearest blade."""
        gap = min(
            self._solved,
            key=lambda pair: float(((r * (pair[0].pitch - pitch)) ** 2).sum()),
            default=None,
        )
        return () if gap is None else gap[1]

    def add(self, rotor: Rotor, pitch: Array, measured: ObjectiveValue) -> TrimmedBlade:
        """Keep what was trimmed."""
        blade = TrimmedBlade(rotor, pitch, replace(measured, trims=()))
        if measured.power is not None:
            self.all.append(blade)
            self._solved.append((blade, measured.solutions))
        else:
            self._lost.append(blade)
        return blade


@dataclass(frozen=True, eq=False)
class Evaluation:
    """One evaluated design. x: parameters scaled to 0…1 over their bounds."""

    x: Array
    blade: TrimmedBlade
    margins: Array
    """Margin of each limit, scaled, positive inside, (limits,)."""

    @property
    def power(self) -> float | None:
        """Mean power [W]; None if the design does not trim."""
        return self.blade.measured.power

    @property
    def feasible(self) -> bool:
        """Whether it trims and meets all limits."""
        return self.blade.measured.value is not None and bool((self.margins >= -FEASIBLE).all())

    @property
    def cost(self) -> float:
        """The objective [W or %], infinite where it does not trim, for comparing."""
        value = self.blade.measured.value
        return math.inf if value is None else value

    @property
    def rank(self) -> tuple[float, float]:
        """The sort key, smaller is better: the objective within the limits, the violation outside."""
        if self.power is None:
            return math.inf, math.inf
        return (0.0, self.cost) if self.feasible else (-float(self.margins.min()), self.cost)


class SearchStopped(Exception):
    """The caller stopped the search."""


class Evaluator:
    """Evaluates the designs of one search and keeps the results."""

    def __init__(
        self,
        design: Design,
        concept: Concept,
        objective: Objective,
        limits: Limits,
        starts: int,
        watch: Callable[[Progress], None] | None,
        stop: Callable[[], bool] | None,
        trimmed: TrimHistory,
    ) -> None:
        """trimmed: in earlier searches with this objective; the blades of this one are added."""
        self.design, self.concept, self.objective, self.limits = design, concept, objective, limits
        self.low, self.high = np.array(limits.bounds_of(concept)).reshape(-1, 2).T
        self.span = self.high - self.low
        self.largest = limits.largest(len(objective.conditions))
        """The largest of what the limits hold beside, [%]."""
        self.phase: Phase = "baseline"
        self.start, self.starts = 0, starts
        self.count = 0
        self.begin = time.perf_counter()
        self.records: list[Evaluation] = []
        self.best: Evaluation | None = None
        self.trimmed = trimmed
        self.r = build_problem(design).disk.r
        self._ahead: list[TrimmedBlade] = []
        """Trimmed, and not yet asked for."""
        self._watch, self._stop = watch, stop

    @property
    def elapsed(self) -> float:
        """Time since the search began [s]."""
        return time.perf_counter() - self.begin

    def values(self, x: Array) -> tuple[float, ...]:
        """Parameters of a scaled point, within their bounds."""
        return tuple((self.low + self.span * np.clip(x, 0.0, 1.0)).tolist())

    def scaled(self, values: Sequence[float]) -> Array:
        """The scaled point of parameters, within its bounds."""
        return np.clip((np.asarray(values, dtype=np.float64) - self.low) / self.span, 0.0, 1.0)

    def pitch(self, x: Array) -> Array:
        """Twist at the elements [rad], (elements,)."""
        return self.concept.twist(self.values(x))(self.r)

    def pitch_slopes(self, x: Array) -> Array:
        """∂(twist at the elements)/∂x, (parameters, elements)."""
        return self.concept.slopes(self.values(x), self.r) * self.span[:, None]

    def cheap_margins(self, x: Array) -> tuple[Array, Array]:
        """Margins of the limits that need no trim, and slopes by x, (limits, parameters)."""
        margins, slopes = cheap_margins(
            self.limits, self.concept, self.values(x), self.design.rotor.blade.root_cutout
        )
        return margins, slopes * self.span

    def baseline(self) -> ObjectiveValue:
        """Evaluation of the design as given; its trim is where the first start begins."""
        self._check()
        return self._trim(self.design, remedy=True).measured

    def __call__(self, x: Array) -> Evaluation:
        """Evaluate a scaled point; SearchStopped when the caller stops the search."""
        self._check()
        x = np.clip(x, 0.0, 1.0)
        if self.records and np.array_equal(self.records[-1].x, x):
            return self.records[-1]
        values = self.values(x)
        blade = self._trim(self.concept.apply(self.design, values))
        margins = self.cheap_margins(x)[0]
        if blade.measured.power is not None:
            margins = np.concatenate([margins, self.largest - np.asarray(blade.measured.limited)])
        record = Evaluation(x, blade, margins)
        self.records.append(record)
        if record.feasible and (self.best is None or record.cost < self.best.cost):
            self.best = record
        if self._watch is not None:
            self._watch(self._progress(record, values))
        return record

    def _trim(self, design: Design, *, remedy: bool = False) -> TrimmedBlade:
        """Trim a design from the nearest one trimmed before; the design itself need not be trimmed again."""
        pitch = design.twist(self.r)
        known = self.trimmed.known(design.rotor, pitch)
        if known is None or known in self._ahead:
            self.count += 1
        if known is not None:
            self._ahead = [blade for blade in self._ahead if blade is not known]
            return known
        starts, options = self.trimmed.starts(pitch, self.r), SolverOptions(remedy=remedy)
        measured = evaluate_objective(
            self.objective, design, starts, limits=self.limits, options=options
        )
        return self.trimmed.add(design.rotor, pitch, measured)

    def trim_ahead(self, points: Iterable[Array]) -> None:
        """Trim the blades of some points at once, for when they are asked for; SearchStopped as in `__call__`."""
        self._check()
        every = [self.concept.apply(self.design, self.values(x)) for x in points]
        designs = [
            design
            for design in every
            if self.trimmed.known(design.rotor, design.twist(self.r)) is None
        ]
        starts, options = (
            [self.starts_for(each) for each in designs],
            SolverOptions(stop=self._stop, remedy=False),
        )
        found = evaluate_objectives(
            self.objective, designs, starts, limits=self.limits, options=options
        )
        self._check()
        for design, measured in zip(designs, found, strict=True):
            self._ahead.append(self.trimmed.add(design.rotor, design.twist(self.r), measured))

    def starts_for(self, design: Design) -> tuple[Solution, ...]:
        """The trims of the nearest blade trimmed before."""
        return self.trimmed.starts(design.twist(self.r), self.r)

    def _check(self) -> None:
        if self._stop is not None and self._stop():
            raise SearchStopped

    def _progress(self, record: Evaluation, values: tuple[float, ...]) -> Progress:
        best = self.best
        return Progress(
            phase=self.phase,
            start=self.start,
            starts=self.starts,
            evaluation=self.count,
            parameters=values,
            twist=self.concept.twist(values).spec(),
            power=record.power,
            feasible=record.feasible,
            best_parameters=None if best is None else self.values(best.x),
            best_power=None if best is None else best.power,
            elapsed=self.elapsed,
            best_index=None if best is None else best.blade.measured.index,
        )
