"""Coordinates in which the power is nearly a round paraboloid, from the gradients of earlier evaluations.

Power is close to quadratic in the twist, but much flatter along some parameters than along others. Least squares on the
exact gradients gives its second derivatives. In the coordinates y a step of length one costs BAND of the power in any
direction, so a descent takes few steps and the band is a sphere.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from rotor.arrays import Array
from rotor.optimisation.evaluator import Evaluation
from rotor.optimisation.slsqp import Inequality

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
