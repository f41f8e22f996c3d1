"""The cubic spline as a matrix: its value anywhere is linear in the values at its knots."""

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline

from rotor.arrays import Array


def spline_basis(knots: tuple[float, ...], x: ArrayLike, *, derivative: int = 0) -> Array:
    """B with spline(x) = B · values at the knots, (…, knots); end condition not-a-knot."""
    return np.asarray(_spline(knots)(np.asarray(x, dtype=float), derivative))


@lru_cache(maxsize=32)
def _spline(knots: tuple[float, ...]) -> CubicSpline:
    return CubicSpline(knots, np.eye(len(knots)))
