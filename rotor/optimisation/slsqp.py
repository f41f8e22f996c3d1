"""SciPy's SLSQP (Kraft 1988) with typed arguments, in the coordinates of a metric."""

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from scipy import optimize

from rotor.arrays import Array
from rotor.optimisation.metric import Metric

_minimize = cast(Callable[..., Any], optimize.minimize)


@dataclass(frozen=True, eq=False)
class Inequality:
    """margins(y) ≥ 0."""

    margins: Callable[[Array], Array]
    slopes: Callable[[Array], Array]


def slsqp(
    value: Callable[[Array], float],
    slope: Callable[[Array], Array],
    start: Array,
    inequalities: Sequence[Inequality],
    *,
    iterations: int,
    tolerance: float,
) -> bool:
    """Minimise; True when it ended by itself. The evaluations on the way are the result, whoever makes them keeps them.

    An end without descent along the search direction counts as one: so descents end on the kink of a movable break.
    """
    constraints = [{"type": "ineq", "fun": one.margins, "jac": one.slopes} for one in inequalities]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        ended = _minimize(
            value,
            start,
            jac=slope,
            method="SLSQP",
            constraints=constraints,
            options={"maxiter": iterations, "ftol": tolerance},
        )
    return int(ended.status) in (0, 8)


def walls(metric: Metric) -> Inequality:
    """The bounds 0 ≤ x ≤ 1, each scaled to a distance in the metric's coordinates."""
    size = np.linalg.norm(metric.stretch, axis=1)
    rows = metric.stretch / size[:, None]
    both = np.vstack([rows, -rows])

    def margins(y: Array) -> Array:
        x = metric.x(y)
        return np.concatenate([x / size, (1.0 - x) / size])

    return Inequality(margins, lambda _: both)
