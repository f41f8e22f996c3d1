"""Prandtl's loss factors at the tip and at the root, eqs. (3.16)–(3.18): of blade elements, and of a smeared disk."""

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rotor.aero.section import arctangent
from rotor.support.arrays import Array
from rotor.support.compiled import compiled

HUB_FACTOR = 0.95
"""B of eq. (3.17) as printed: "around 0.95 for the hub relation" (thesis p. 24)."""

_SMALLEST_INFLOW = 1e-9
"""Keeps f finite where the inflow passes through zero; F is 1 there to rounding."""

SMALLEST_TIP_FACTOR = 0.1
"""Floor of `tip_factor`: at the very tip λ/F would have no bound."""


def prandtl(f: ArrayLike) -> tuple[Array, Array]:
    """F = (2/π) arccos(e^−f), eq. (3.18), and dF/df, for f > 0."""
    decay = np.exp(-np.asarray(f, dtype=float))
    # 1 − e^(−2f) by expm1: exact as f → 0, where the slope grows without bound.
    return 2.0 / np.pi * np.arccos(decay), 2.0 / np.pi * decay / np.sqrt(
        -np.expm1(-2.0 * np.asarray(f))
    )


def loss_factor(
    r: ArrayLike,
    inflow: ArrayLike,
    blades: int,
    root_cutout: float,
    *,
    tip: bool = True,
    hub: bool = True,
) -> tuple[Array, Array]:
    """F = F_tip F_hub and dF/dλ at r = y/R for a total inflow ratio λ; shapes broadcast.

    With φ = λ/r, r φ = λ: f_tip = ½N_b (1 − r)/λ, eq. (3.16); f_hub = ½B (r − r_min)/λ, eq. (3.17), B = 0.95 as
    printed. Finite at both ends; the direction of the flow does not matter (|λ|).
    """
    r = np.asarray(r, dtype=float)
    inflow = np.asarray(inflow, dtype=float)
    signed = np.where(np.abs(inflow) < _SMALLEST_INFLOW, _SMALLEST_INFLOW, inflow)
    factor = np.ones(np.broadcast(r, signed).shape)
    slope = np.zeros_like(factor)
    spacings = ([0.5 * blades * (1.0 - r)] if tip else []) + (
        [0.5 * HUB_FACTOR * (r - root_cutout)] if hub else []
    )
    for spacing in spacings:
        f = np.minimum(spacing / np.abs(signed), 700.0)
        end, end_slope = prandtl(f)
        slope = slope * end + factor * end_slope * (-f / signed)
        factor = factor * end
    return factor, slope


_LARGEST = 40.0
"""f from which F is 1 and its slope 0 to rounding."""

_compile = compiled(error_model="numpy")


@_compile
def _fall(f: float) -> float:
    """1 − e^−f for 0 ≤ f ≤ 40, to rounding (tested): the series of e^x − 1 at f/1024, doubled ten times.

    Plain multiplications, so that the compiler makes vector code of a loop over it; the C library's expm1 is none.
    """
    x = -f / 1024.0
    growth = x * (
        1.0 + x / 2.0 * (1.0 + x / 3.0 * (1.0 + x / 4.0 * (1.0 + x / 5.0 * (1.0 + x / 6.0))))
    )
    for _ in range(10):  # e^2x − 1 = (e^x − 1)(e^x + 1)
        growth = growth * (2.0 + growth)
    return -growth


@_compile
def end_factor(spacing: float, inflow: float) -> Any:
    """`prandtl` of one end of the blade at f = spacing/|λ|, and its slope by λ, for one element."""
    signed = inflow if abs(inflow) >= _SMALLEST_INFLOW else _SMALLEST_INFLOW
    f = min(spacing / abs(signed), _LARGEST)
    fall = _fall(f)
    decay = 1.0 - fall
    root = math.sqrt(fall * (1.0 + decay))  # The sine of arccos e^−f.
    slope = -2.0 / math.pi * decay / root * f / signed if f < _LARGEST else 0.0
    return 2.0 / math.pi * arctangent(root, decay), slope


@_compile
def _multiply_end(spacing: float, inflow: Any, factor: Any, slope: Any) -> None:
    """Multiply one row of factors, with their slopes by λ, by `end_factor`."""
    for j in range(len(inflow)):
        end, end_slope = end_factor(spacing, inflow[j])
        slope[j] = slope[j] * end + factor[j] * end_slope
        factor[j] *= end


@_compile
def mean_loss_factor(
    r: Any, inflow: Any, slopes: Any, blade: tuple[float, float], tip: bool, hub: bool
) -> Any:
    """Means around the azimuth of `loss_factor`, of ∂F/∂λ and of the slopes that follow, (2 + slopes, elements).

    inflow: λ, (elements, azimuths); slopes: ∂λ by anything, (slopes, elements, azimuths); blade: number (times a
    factor on f) and root cut-out r_min/R.
    """
    (blades, root_cutout), (n, m) = blade, inflow.shape
    out = np.zeros((2 + len(slopes), n))
    factor, slope = np.empty(m), np.empty(m)
    for i in range(n):
        factor[:], slope[:] = 1.0, 0.0
        if tip:
            _multiply_end(0.5 * blades * (1.0 - r[i]), inflow[i], factor, slope)
        if hub:
            _multiply_end(0.5 * HUB_FACTOR * (r[i] - root_cutout), inflow[i], factor, slope)
        out[0, i], out[1, i] = factor.sum(), slope.sum()
        for k in range(len(slopes)):
            for j in range(m):
                out[2 + k, i] += slope[j] * slopes[k, i, j]
    return out / m


def tip_factor(r: ArrayLike, inflow: float, blades: float) -> tuple[Array, Array]:
    """F of inflow models that smear the blades over the disk, and ∂F/∂λ; shapes of r.

    F = (2/π) arccos exp(−N_b (1 − r)/(2|λ|)) with the mean total inflow λ = µ_z + λ0 of the disk; at least 0.1, with
    slope 0 at that floor. The inflow at the blade is λ_i/F, above the mean around the azimuth. No root factor.
    """
    size = max(abs(inflow), 1e-9)
    f = np.minimum(0.5 * blades * (1.0 - np.asarray(r, dtype=float)) / size, 700.0)
    factor, slope = prandtl(np.maximum(f, 1e-12))
    free = factor > SMALLEST_TIP_FACTOR
    return np.where(free, factor, SMALLEST_TIP_FACTOR), np.where(
        free, slope * (-f / size) * np.sign(inflow), 0.0
    )
