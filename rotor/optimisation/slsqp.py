"""SciPy's SLSQP (Kraft 1988) with typed arguments."""

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, cast

import numpy as np
from scipy import optimize

from rotor.arrays import Array

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
