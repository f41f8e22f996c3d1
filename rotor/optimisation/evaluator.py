"""Evaluates designs for a search: trims from the nearest earlier solution, reports progress, stops on request."""

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from rotor.arrays import Array
from rotor.design.design import Design
from rotor.optimisation.concepts import Concept
from rotor.optimisation.limits import Limits, cheap_margins, stall_margins
from rotor.optimisation.objective import Measured, Objective, measure
from rotor.optimisation.results import Phase, Progress
from rotor.trim.solution import Solution

FEASIBLE = 1e-3
"""Accepted violation of a limit: a thousandth of a degree, or of a per cent of the disk."""


@dataclass(frozen=True, eq=False)
class Evaluation:
    """One evaluated design. x: parameters scaled to 0…1 over their bounds."""

    x: Array
    power: float | None
    """[W]; None when it does not trim."""
    slope: Array
    """∂power/∂x [W]"""
    margins: Array
    """Margin of each limit, scaled, positive inside, (limits,)."""
    margin_slopes: Array
    """(limits, parameters)"""

    @property
    def feasible(self) -> bool:
        """Whether it trims and meets all limits."""
        return self.power is not None and bool((self.margins >= -FEASIBLE).all())

    @property
    def watts(self) -> float:
        """Power, infinite where it does not trim, for comparing."""
        return math.inf if self.power is None else self.power


_KEPT_SOLUTIONS = 64
"""Solutions kept as starts for trims."""


class SearchStopped(Exception):
    """The caller stopped the search."""


class Evaluator:
    """One search's evaluations."""

    def __init__(
        self,
        design: Design,
        concept: Concept,
        objective: Objective,
        limits: Limits,
        starts: int,
        watch: Callable[[Progress], None] | None,
        stop: Callable[[], bool] | None,
    ) -> None:
        self.design, self.concept, self.objective, self.limits = design, concept, objective, limits
        self.low, self.high = np.array(limits.bounds_of(concept)).T
        self.span = self.high - self.low
        self.phase: Phase = "baseline"
        self.start, self.starts = 0, starts
        self.count = 0
        self.begin = time.perf_counter()
        self.records: list[Evaluation] = []
        self.best: Evaluation | None = None
        self._watch, self._stop = watch, stop
        self._solved: list[tuple[Array, tuple[Solution, ...]]] = []

    @property
    def elapsed(self) -> float:
        """[s]"""
        return time.perf_counter() - self.begin

    def values(self, x: Array) -> tuple[float, ...]:
        """Parameters of a scaled point, within their bounds."""
        return tuple((self.low + self.span * np.clip(x, 0.0, 1.0)).tolist())

    def scaled(self, values: Sequence[float]) -> Array:
        """The scaled point of parameters, within its bounds."""
        return np.clip((np.asarray(values, dtype=np.float64) - self.low) / self.span, 0.0, 1.0)

    def baseline(self) -> float | None:
        """Power of the design as given [W]; its trim is where the first start begins."""
        self._check()
        made = measure(self.objective, self.design, gradient=False)
        self.count += 1
        self._solved.append((np.full(len(self.span), 0.5), made.solutions))
        return made.power

    def __call__(self, x: Array) -> Evaluation:
        """Evaluate a scaled point; SearchStopped when the caller stops the search."""
        self._check()
        x = np.clip(x, 0.0, 1.0)
        values = self.values(x)
        made = measure(
            self.objective,
            self.concept.apply(self.design, values),
            self._nearest(x),
            stall=self.limits.stalled is not None,
        )
        self.count += 1
        record = self._record(x, values, made)
        self.records.append(record)
        if made.power is not None:
            self._solved.append((x, made.solutions))
            del self._solved[:-_KEPT_SOLUTIONS]
        if record.feasible and (self.best is None or record.watts < self.best.watts):
            self.best = record
        self._report(record, values)
        return record

    def _record(self, x: Array, values: tuple[float, ...], made: Measured) -> Evaluation:
        margins, slopes = cheap_margins(self.limits, self.concept, values, self.design.rotor.blade.root_cutout)
        if made.power is None or made.by_pitch is None:
            return Evaluation(x, None, np.zeros_like(x), margins, slopes * self.span)
        by_value = self.concept.slopes(values, made.solutions[0].disk.r)
        if made.stalled_by_pitch is not None:
            more, more_slopes = stall_margins(self.limits, made.stalled, made.stalled_by_pitch @ by_value.T)
            margins, slopes = np.concatenate([margins, more]), np.concatenate([slopes, more_slopes])
        return Evaluation(x, made.power, (by_value @ made.by_pitch) * self.span, margins, slopes * self.span)

    def _nearest(self, x: Array) -> tuple[Solution, ...]:
        if not self._solved:
            return ()
        return min(self._solved, key=lambda pair: float(((pair[0] - x) ** 2).sum()))[1]

    def _check(self) -> None:
        if self._stop is not None and self._stop():
            raise SearchStopped

    def _report(self, record: Evaluation, values: tuple[float, ...]) -> None:
        if self._watch is None:
            return
        self._watch(
            Progress(
                phase=self.phase,
                start=self.start,
                starts=self.starts,
                evaluation=self.count,
                parameters=values,
                twist=self.concept.twist(values).spec(),
                power=record.power,
                feasible=record.feasible,
                best_parameters=None if self.best is None else self.values(self.best.x),
                best_power=None if self.best is None else self.best.power,
                elapsed=self.elapsed,
            )
        )
