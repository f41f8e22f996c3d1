"""From one start to one local minimum, and how flat the minimum is.

A descent is SciPy's SLSQP (Kraft 1988) on the exact gradient, in coordinates in which the power is nearly a round
paraboloid. Power is close to quadratic in the twist, but much flatter along some parameters than along others. Least
squares on the exact gradients of earlier evaluations gives its second derivatives. In the coordinates y a step of
length one costs BAND of the power in any direction, so a descent takes few steps and the band is a sphere.

The band of a parameter is how far it can go with P ≤ (1 + BAND) P*, the others re-optimised: one small SLSQP problem
per parameter and side, started from the end of the ellipsoid that the second derivatives predict. Earlier evaluations
inside the band widen it.
"""

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, cast

import numpy as np
from scipy import optimize

from rotor.arrays import Array
from rotor.optimisation.evaluator import Evaluation, Evaluator
from rotor.optimisation.results import Band

_minimize = cast(Callable[..., Any], optimize.minimize)


@dataclass(frozen=True, eq=False)
class Inequality:
    """margins(y) ≥ 0."""

    margins: Callable[[Array], Array]
    slopes: Callable[[Array], Array]


@dataclass(frozen=True, eq=False)
class SlsqpEnd:
    """Where SLSQP ended."""

    x: Array
    settled: bool
    """Whether it converged, or found no descent along the search direction, as at the kink of a movable break."""


def slsqp(
    value: Callable[[Array], Any],
    slope: Callable[[Array], Array] | Literal[True],
    start: Array,
    inequalities: Sequence[Inequality] = (),
    *,
    iterations: int,
    tolerance: float,
    bounds: Sequence[tuple[float, float]] | None = None,
) -> SlsqpEnd:
    """Minimise `value` from `start`; with slope True, `value` returns the value and its gradient together."""
    constraints = [{"type": "ineq", "fun": one.margins, "jac": one.slopes} for one in inequalities]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        ended = _minimize(
            value,
            start,
            jac=slope,
            method="SLSQP",
            bounds=bounds,
            constraints=constraints,
            options={"maxiter": iterations, "ftol": tolerance},
        )
    return SlsqpEnd(np.asarray(ended.x, dtype=np.float64), int(ended.status) in (0, 8))


_least_squares = cast(Callable[..., Any], np.linalg.lstsq)

BAND = 1e-3
"""Relative rise of power that defines the band of each parameter."""
_REACH = 0.25
"""Scaled distance within which evaluations have full weight for the second derivatives."""
_FLATTEST = 2e-3
"""Least curvature over the largest; flatter directions are left to the descent."""


@dataclass(frozen=True, eq=False)
class Preconditioner:
    """x = centre + stretch · y."""

    centre: Array
    stretch: Array
    """(parameters, parameters)"""
    unit: float
    """Power [W] by which the objective is scaled: half a |y|² of it."""

    def x(self, y: Array) -> Array:
        """Scaled parameters of y."""
        return self.centre + self.stretch @ y

    def y(self, x: Array) -> Array:
        """The inverse of `x`."""
        return np.asarray(np.linalg.solve(self.stretch, x - self.centre), dtype=np.float64)


def initial_preconditioner(centre: Array, power: float) -> Preconditioner:
    """Before any evaluation: power rises by some per cent over half the range of a parameter."""
    return Preconditioner(centre, np.sqrt(2.0 * BAND) * np.eye(len(centre)), 2.0 * BAND * power)


def fit_preconditioner(records: Sequence[Evaluation], best: Evaluation) -> Preconditioner | None:
    """The preconditioner at the best point; None while the evaluations do not determine it."""
    assert best.power is not None
    known = [one for one in records if one.power is not None and one.power < 1.5 * best.power]
    n = len(best.x)
    pairs = [(i, j) for i in range(n) for j in range(i, n)]
    if len(known) * n < len(pairs) + 2 * n:
        return None
    offsets = np.array([one.x - best.x for one in known])
    gradients = np.array([one.slope for one in known]) / best.power
    weight = 1.0 / (1.0 + (offsets**2).sum(axis=1) / _REACH**2)
    # Unknowns: the gradient at the best point, then the upper triangle of the second derivatives.
    rows = np.zeros((len(known), n, n + len(pairs)))
    rows[:, np.arange(n), np.arange(n)] = 1.0
    for column, (i, j) in enumerate(pairs, start=n):
        rows[:, i, column] += offsets[:, j]
        if i != j:
            rows[:, j, column] += offsets[:, i]
    matrix, wanted = (rows * weight[:, None, None]).reshape(-1, n + len(pairs)), (gradients * weight[:, None]).ravel()
    found: list[float] = _least_squares(matrix, wanted, rcond=1e-9)[0].tolist()
    second = np.zeros((n, n))
    for value, (i, j) in zip(found[n:], pairs, strict=True):
        second[i, j] = second[j, i] = value
    size, axes = np.linalg.eigh(second)
    if not size[-1] > 0.0:
        return None
    size = np.maximum(size, _FLATTEST * size[-1])
    # P/P* − 1 = ½ xᵀ H x = BAND |y|².
    return Preconditioner(best.x, axes * np.sqrt(2.0 * BAND / size), 2.0 * BAND * best.power)


def bound_margins(preconditioner: Preconditioner) -> Inequality:
    """The bounds 0 ≤ x ≤ 1, each scaled to a distance in the preconditioner's coordinates."""
    size = np.linalg.norm(preconditioner.stretch, axis=1)
    rows = preconditioner.stretch / size[:, None]
    both = np.vstack([rows, -rows])

    def margins(y: Array) -> Array:
        x = preconditioner.x(y)
        return np.concatenate([x / size, (1.0 - x) / size])

    return Inequality(margins, lambda _: both)


TOLERANCE = 2e-4
"""Change of the objective at which a descent ends, in units of the preconditioner: 4e-7 of the power."""
_ITERATIONS = 60


@dataclass(frozen=True, eq=False)
class Descent:
    """Where a descent ended."""

    end: Evaluation | None
    """The best feasible point evaluated; None when there was none."""
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
