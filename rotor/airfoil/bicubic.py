"""Deck values as a smooth surface: bicubic Hermite cells on one uniform grid that all sections share.

The slopes at the deck's knots are monotone (PCHIP). Every knot is a node of the uniform grid, so the piecewise cubics
keep their shape on it. The surface is C1
everywhere, periodic in alpha, without overshoot, and reproduces every deck value.
"""

from collections.abc import Callable

import numpy as np
import scipy
from numpy.typing import NDArray

from rotor.airfoil.c81 import C81Block
from rotor.arrays import Array

N_ALPHA = 720
N_MACH = 20
ALPHA_STEP = np.pi / 360.0  # rad, half a degree
MACH_STEP = 0.05

# Monomial coefficients of a cubic on [0, 1] from (value, value, slope, slope) at its ends.
_HERMITE = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [-3, 3, -2, -1], [2, -2, 1, 1]], dtype=np.float64)


def mach_nodes() -> Array:
    """The grid's Mach numbers, shape (N_MACH + 1,)."""
    return np.arange(N_MACH + 1) / N_MACH


def _nodes_along_alpha(block: C81Block) -> tuple[Array, Array]:
    """Values and alpha-slopes (per cell) at the uniform alpha nodes, shape (N_ALPHA + 1, Machs)."""
    knots, values = block.alpha_deg, block.values
    if abs(knots[0] + 180.0) > 1e-9 or abs(knots[-1] - 180.0) > 1e-9 or np.any(np.abs(values[0] - values[-1]) > 1e-9):
        raise ValueError("the angles must run from -180 to 180 deg with equal ends: add the missing angles")
    if np.any(np.abs(knots * 2.0 - np.round(knots * 2.0)) > 1e-9):
        raise ValueError("an angle is no multiple of 0.5 deg: move it, the run-time grid has half-degree steps")
    # Two knots of the next turn on each side make the slopes at +-180 deg periodic.
    longer = np.concatenate((knots[-3:-1] - 360.0, knots, knots[1:3] + 360.0))
    curve = scipy.interpolate.PchipInterpolator(longer, np.concatenate((values[-3:-1], values, values[1:3])), axis=0)
    nodes = np.arange(N_ALPHA + 1) * 0.5 - 180.0
    slope: Callable[[Array], Array] = curve.derivative()
    return np.asarray(curve(nodes)), np.asarray(slope(nodes)) * 0.5


def _along_mach(mach: Array, values: Array) -> tuple[Array, Array]:
    """Values and Mach-slopes (per cell) at the uniform Mach nodes, shape (rows, N_MACH + 1), constant outside."""
    nodes = mach_nodes()
    inside = np.clip(nodes, mach[0], mach[-1])
    own = np.asarray(scipy.interpolate.PchipInterpolator(mach, values, axis=1).derivative()(mach))
    own[:, -1] = 0.0  # Constant beyond the data, so the slope at its end is zero: C1 across the limit.
    own[:, 0] = 0.0
    curve = scipy.interpolate.CubicHermiteSpline(mach, values, own, axis=1)
    slope: Callable[[Array], Array] = curve.derivative()
    flat = (nodes > mach[0]) & (nodes < mach[-1])
    return np.asarray(curve(inside)), np.asarray(slope(inside)) * MACH_STEP * flat


def bicubic_coefficients(block: C81Block) -> Array:
    """Cell polynomials (N_ALPHA, N_MACH, 4, 4) of the C1 surface through the deck values of `block`.

    Raises ValueError when a knot is not on the uniform grid, or when the angles do not cover the full circle.
    """
    steps = block.mach / MACH_STEP
    if np.any(np.abs(steps - np.round(steps)) > 1e-9) or block.mach[-1] > 1.0 + 1e-9:
        raise ValueError("a Mach number is no multiple of 0.05 within 0..1: move it to the run-time grid")
    f, f_u = _nodes_along_alpha(block)
    f, f_v = _along_mach(block.mach, f)
    f_u, f_uv = _along_mach(block.mach, f_u)
    return _cells(f, f_u, f_v, f_uv)


def _cells(f: Array, f_u: Array, f_v: Array, f_uv: Array) -> Array:
    """Cell polynomials of the surface with these values and slopes per cell at its nodes, (α nodes, Mach nodes, …)."""
    corners = np.empty((N_ALPHA, N_MACH, *f.shape[2:], 4, 4))
    for row, (of_value, of_slope) in enumerate(((f, f_v), (f, f_v), (f_u, f_uv), (f_u, f_uv))):
        upper = row % 2  # Rows: values at i, at i + 1, slopes at i, at i + 1; columns the same along Mach.
        rows = slice(upper, upper + N_ALPHA)
        corners[..., row, 0], corners[..., row, 1] = of_value[rows, :-1], of_value[rows, 1:]
        corners[..., row, 2], corners[..., row, 3] = of_slope[rows, :-1], of_slope[rows, 1:]
    return np.matmul(np.matmul(_HERMITE, corners), _HERMITE.T)


def stack_coefficients(cl: Array, cd: Array) -> Array:
    """Lift and drag cell polynomials side by side, C-contiguous, in the layout of `SectionTable`."""
    return np.ascontiguousarray(np.stack((cl, cd), axis=2))


def held_beyond_peak(coefficients: Array) -> Array:
    """Lift and drag that keep, beyond the largest lift, what they have there; in the layout of `SectionTable`.

    From 0 outwards on both sides they go on only where lift exceeds all before (below 0: falls below it). So lift never
    falls as the angle grows, and up to its first peak nothing changes.
    """
    last = coefficients[:, -1]  # Its end is where the Mach number is 1.
    at_end = np.stack([last.sum(axis=-1), last @ np.arange(4.0)], axis=-1)
    nodes = np.concatenate([coefficients[..., :2], at_end[:, None]], axis=1)[:, :, :, :2]
    nodes = np.concatenate([nodes, nodes[:1]])  # Values and slopes, (α, Mach number, coefficient, by α, by Mach).
    lift, zero = nodes[:, :, 0, 0, 0], N_ALPHA // 2
    place = np.empty(lift.shape, dtype=np.int64)
    place[zero:] = zero + _last_record(lift[zero:])
    place[zero::-1] = zero - _last_record(-lift[zero::-1])
    held = np.take_along_axis(nodes, place[:, :, None, None, None], axis=0)
    own = place == np.arange(N_ALPHA + 1)[:, None]
    held[~(own & np.roll(own, 1, axis=0) & np.roll(own, -1, axis=0)), :, 1] = 0.0  # Level from end to end.
    return np.ascontiguousarray(_cells(held[..., 0, 0], held[..., 1, 0], held[..., 0, 1], held[..., 1, 1]))


def _last_record(values: Array) -> NDArray[np.int64]:
    """For every row, the last one up to it that exceeds all before, column by column."""
    best = np.maximum.accumulate(values, axis=0)
    new = np.concatenate([np.full((1, values.shape[1]), True), values[1:] > best[:-1]])
    return np.maximum.accumulate(np.where(new, np.arange(len(values))[:, None], 0), axis=0)
