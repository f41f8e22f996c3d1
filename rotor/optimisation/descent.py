"""From one start to one local minimum, and how flat the minimum is.

A descent is SLSQP on the exact gradient. The band of a parameter is how far it can go with P ≤ (1 + BAND) P*, the
others re-optimised: one small SLSQP problem per parameter and side, started from the end of the ellipsoid that the
preconditioner predicts. Earlier evaluations inside the band widen it.
"""

from dataclasses import dataclass

import numpy as np

from rotor.arrays import Array
from rotor.optimisation.evaluator import Evaluation, Evaluator
from rotor.optimisation.preconditioner import BAND, Preconditioner, bound_margins
from rotor.optimisation.results import Band
from rotor.optimisation.slsqp import Inequality, slsqp

TOLERANCE = 2e-4
"""Change of the objective at which a descent ends, in units of the preconditioner: 4e-7 of the power."""
_ITERATIONS = 60


@dataclass(frozen=True, eq=False)
class Descent:
    """Where a descent ended."""

    end: Evaluation | None
    """The best feasible point on the way; None when there was none."""
    settled: bool
    """Whether it converged."""


def descend(evaluate: Evaluator, preconditioner: Preconditioner, first: Evaluation) -> Descent:
    """Descend from a point that trims."""
    problem = CachedProblem(evaluate, preconditioner, first)
    seen_before = len(evaluate.records)
    inequalities = [bound_margins(preconditioner)]
    if first.margins.size:
        inequalities.append(Inequality(problem.margins, problem.margin_slopes))
    end = slsqp(
        problem.value,
        problem.slope,
        preconditioner.y(first.x),
        inequalities,
        iterations=_ITERATIONS,
        tolerance=TOLERANCE,
    )
    seen = [record for record in (first, *evaluate.records[seen_before:]) if record.feasible]
    return Descent(min(seen, key=lambda record: record.watts, default=None), end.settled)


class CachedProblem:
    """Value, gradient and margins for SLSQP from one evaluation per point."""

    def __init__(self, evaluate: Evaluator, preconditioner: Preconditioner, first: Evaluation) -> None:
        self.evaluate, self.preconditioner = evaluate, preconditioner
        self.trimmed = [first]
        self._key, self._record = preconditioner.y(first.x).tobytes(), first

    def at(self, y: Array) -> Evaluation:
        """The record of a point."""
        key = y.tobytes()
        if key != self._key:
            self._key, self._record = key, self.evaluate(self.preconditioner.x(y))
            if self._record.power is not None:
                self.trimmed.append(self._record)
        return self._record

    def value(self, y: Array) -> float:
        """Scaled power. Where nothing trims: a cone that leads back to the nearest point that did."""
        record = self.at(y)
        if record.power is not None:
            return record.power / self.preconditioner.unit
        worst = max(one.watts for one in self.trimmed)
        return 1.01 * worst / self.preconditioner.unit + float(np.linalg.norm(self._away(record)))

    def slope(self, y: Array) -> Array:
        """Its gradient."""
        record = self.at(y)
        if record.power is not None:
            return self.preconditioner.stretch.T @ record.slope / self.preconditioner.unit
        away = self._away(record)
        return away / max(float(np.linalg.norm(away)), 1e-12)

    def margins(self, y: Array) -> Array:
        """Margins of the limits; where nothing trims, those of the nearest point that did."""
        return self._trimmed_at(y).margins

    def margin_slopes(self, y: Array) -> Array:
        """Their gradients."""
        return self._trimmed_at(y).margin_slopes @ self.preconditioner.stretch

    def _trimmed_at(self, y: Array) -> Evaluation:
        record = self.at(y)
        return record if record.power is not None else self._near(record)

    def _away(self, record: Evaluation) -> Array:
        return self.preconditioner.y(record.x) - self.preconditioner.y(self._near(record).x)

    def _near(self, record: Evaluation) -> Evaluation:
        return min(self.trimmed, key=lambda one: float(((one.x - record.x) ** 2).sum()))


_TOLERANCE = 1e-3
"""Relative tolerance of a side of the band."""
_INSIDE = 2e-5
"""Power above the edge of the band that still counts as on it: two per cent of the band."""
_BAND_ITERATIONS = 7


def measure_band(evaluate: Evaluator, preconditioner: Preconditioner, best: Evaluation) -> tuple[Band, ...]:
    """The band of every parameter, SI."""
    edge = best.watts * (1.0 + BAND)
    found: list[Band] = []
    for k, parameter in enumerate(evaluate.concept.parameters):
        ends: list[float] = []
        for side in (-1.0, 1.0):
            _go(evaluate, preconditioner, best, edge, side * preconditioner.stretch[k])
            inside = [one for one in evaluate.records if one.feasible and one.watts <= edge * (1.0 + _INSIDE)]
            ends.append(side * max(side * float(one.x[k]) for one in inside))
        low, high = (float(evaluate.low[k] + evaluate.span[k] * end) for end in ends)
        found.append(Band(parameter.name, low, high))
    return tuple(found)


def _go(evaluate: Evaluator, preconditioner: Preconditioner, best: Evaluation, edge: float, row: Array) -> None:
    """Maximise one parameter within the band, along one row of the preconditioner; the evaluations are the result."""
    problem = CachedProblem(evaluate, preconditioner, best)
    along = row / np.linalg.norm(row)
    centre = preconditioner.y(best.x)
    scale = BAND * best.watts

    def room(y: Array) -> Array:
        record = problem.at(y)
        if record.power is None:  # Outside by the square of the distance, as for a quadratic.
            return np.array([1.0 - float(((y - centre) ** 2).sum())])
        return np.array([(edge - record.power) / scale])

    def room_slope(y: Array) -> Array:
        record = problem.at(y)
        if record.power is None:
            return -2.0 * (y - centre)[None]
        return -(preconditioner.stretch.T @ record.slope)[None] / scale

    inequalities = [Inequality(room, room_slope), bound_margins(preconditioner)]
    if best.margins.size:
        inequalities.append(Inequality(problem.margins, problem.margin_slopes))
    slsqp(
        lambda y: -float(along @ y),
        lambda _: -along,
        centre + along,
        inequalities,
        iterations=_BAND_ITERATIONS,
        tolerance=_TOLERANCE,
    )
