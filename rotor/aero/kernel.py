"""Section loads and their pointwise derivatives at every blade element and azimuth: the innermost loop.

Compiled by numba, because plain NumPy takes several times as long for the table look-up (`python -m rotor bench`).
With velocities over ΩR, U² = U_T² + U_P² and the smeared coefficients of eqs. (2.17), (2.18),

    dC_T/dr = ½σ U (F C_l U_T − C_d U_P)        dF_z = dL cos φ − dD sin φ     (2.15), (3.9)
    dC_Q/dr = ½σ U (F C_l U_P + C_d U_T)        dF_x = dL sin φ + dD cos φ     (2.16), (3.10)

where U cos φ = U_T and U sin φ = U_P (φ by atan2, so reverse flow needs no special case with ±180° section data)
and F is the loss factor on lift. Both forms of (2.17)–(2.18) without the hover approximation U ≈ Ωy.
"""

import math
from typing import Any

import numba  # pyright: ignore[reportMissingTypeStubs]
import numpy as np

from rotor.airfoil.bicubic import ALPHA_STEP, MACH_STEP, N_ALPHA, N_MACH
from rotor.arrays import Array

FZ, FX, FZ_THETA, FX_THETA, FZ_UT, FX_UT, FZ_UP, FX_UP, LIFT, ALPHA, MACH, CL, CD, CD_MACH = range(14)
"""Rows of the result. FZ, FX: dC_T/dr and dC_Q/dr; then their derivatives by pitch, U_T and U_P;
LIFT: ½σ U C_l, so that ∂FZ/∂F = LIFT·U_T and ∂FX/∂F = LIFT·U_P; then the flow at the section."""

_PI = math.pi
_TWO_PI = 2.0 * math.pi
_INVERSE_ALPHA = 1.0 / ALPHA_STEP
_INVERSE_MACH = 1.0 / MACH_STEP


def _compile(function: Any) -> Any:
    # Contraction (fused multiply-add) is the only deviation from strict IEEE arithmetic.
    return numba.njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})(function)


@_compile
def _section(table: Any, alpha: float, mach: float) -> Any:
    """C_l, C_d and their slopes by α [rad] and Mach at one point."""
    x = (alpha + _PI) * _INVERSE_ALPHA
    i = int(x)
    if i >= N_ALPHA:
        i -= N_ALPHA
        x -= N_ALPHA
    u = x - i
    y = mach * _INVERSE_MACH
    inside = 1.0
    if y >= N_MACH:  # Beyond the table the section data are constant, without slope; the solution has a caveat.
        y = N_MACH - 1e-9
        inside = 0.0
    j = int(y)
    v = y - j
    cl = 0.0
    cl_u = 0.0
    cl_v = 0.0
    cd = 0.0
    cd_u = 0.0
    cd_v = 0.0
    for k in range(3, -1, -1):  # Horner in u of polynomials in v.
        p = ((table[i, j, 0, k, 3] * v + table[i, j, 0, k, 2]) * v + table[i, j, 0, k, 1]) * v + table[i, j, 0, k, 0]
        p_v = (3.0 * table[i, j, 0, k, 3] * v + 2.0 * table[i, j, 0, k, 2]) * v + table[i, j, 0, k, 1]
        cl_u = cl_u * u + cl
        cl = cl * u + p
        cl_v = cl_v * u + p_v
        q = ((table[i, j, 1, k, 3] * v + table[i, j, 1, k, 2]) * v + table[i, j, 1, k, 1]) * v + table[i, j, 1, k, 0]
        q_v = (3.0 * table[i, j, 1, k, 3] * v + 2.0 * table[i, j, 1, k, 2]) * v + table[i, j, 1, k, 1]
        cd_u = cd_u * u + cd
        cd = cd * u + q
        cd_v = cd_v * u + q_v
    mach_slope = inside * _INVERSE_MACH
    return cl, cd, cl_u * _INVERSE_ALPHA, cd_u * _INVERSE_ALPHA, cl_v * mach_slope, cd_v * mach_slope


@_compile
def element_loads(
    theta: Array,
    u_t: Array,
    u_p: Array,
    loss: Array,
    tip_mach: float,
    half_solidity: Array,
    section: Any,
    weight: Array,
    offset: Array,
    tables: Array,
) -> Array:
    """Loads, derivatives and section flow, (14, elements, azimuths); rows named by this module's constants.

    theta [rad], u_t, u_p (over ΩR): (elements, azimuths). loss: F on lift, (elements,). The rest as in `Disk`.
    """
    n, m = theta.shape
    out = np.empty((14, n, m))
    for i in range(n):
        hs = half_solidity[i]
        factor = loss[i]
        first = tables[section[i, 0]]
        second = tables[section[i, 1]]
        w = weight[i]
        for j in range(m):
            t = u_t[i, j]
            p = u_p[i, j]
            square = t * t + p * p + 1e-30
            u = math.sqrt(square)
            alpha = theta[i, j] - math.atan2(p, t)
            alpha -= _TWO_PI * math.floor((alpha + _PI) / _TWO_PI)
            mach = u * tip_mach
            a = alpha - offset[i, 0]
            a -= _TWO_PI * math.floor((a + _PI) / _TWO_PI)
            cl, cd, cl_a, cd_a, cl_m, cd_m = _section(first, a, mach)
            if w > 0.0:
                a = alpha - offset[i, 1]
                a -= _TWO_PI * math.floor((a + _PI) / _TWO_PI)
                cl2, cd2, cl_a2, cd_a2, cl_m2, cd_m2 = _section(second, a, mach)
                cl += w * (cl2 - cl)
                cd += w * (cd2 - cd)
                cl_a += w * (cl_a2 - cl_a)
                cd_a += w * (cd_a2 - cd_a)
                cl_m += w * (cl_m2 - cl_m)
                cd_m += w * (cd_m2 - cd_m)
            lift = factor * cl
            lift_a = factor * cl_a
            # ∂α/∂U_T = U_P/U², ∂α/∂U_P = −U_T/U²; ∂M/∂U_T = M U_T/U², and so on.
            t_over = t / square
            p_over = p / square
            lift_t = lift_a * p_over + factor * cl_m * mach * t_over
            lift_p = -lift_a * t_over + factor * cl_m * mach * p_over
            cd_t = cd_a * p_over + cd_m * mach * t_over
            cd_p = -cd_a * t_over + cd_m * mach * p_over
            z = lift * t - cd * p
            x = lift * p + cd * t
            k = hs * u
            out[FZ, i, j] = k * z
            out[FX, i, j] = k * x
            out[FZ_THETA, i, j] = k * (lift_a * t - cd_a * p)
            out[FX_THETA, i, j] = k * (lift_a * p + cd_a * t)
            out[FZ_UT, i, j] = k * (t_over * z + lift_t * t + lift - cd_t * p)
            out[FX_UT, i, j] = k * (t_over * x + lift_t * p + cd_t * t + cd)
            out[FZ_UP, i, j] = k * (p_over * z + lift_p * t - cd_p * p - cd)
            out[FX_UP, i, j] = k * (p_over * x + lift_p * p + lift + cd_p * t)
            out[LIFT, i, j] = k * cl
            out[ALPHA, i, j] = alpha
            out[MACH, i, j] = mach
            out[CL, i, j] = cl
            out[CD, i, j] = cd
            out[CD_MACH, i, j] = cd_m
    return out


@_compile
def stall_margins(
    alpha: Array, mach: Array, u_t: Array, section: Any, weight: Array, offset: Array, stall: Array
) -> Array:
    """Angle of attack left before stall [rad], (elements, azimuths): negative when stalled, π/2 in reverse flow.

    stall: angles about the section's own chord at the Mach knots, (sections, 2, knots): negative end, positive end.
    """
    n, m = alpha.shape
    out = np.empty((n, m))
    top = stall.shape[2] - 1 - 1e-9
    for i in range(n):
        w = weight[i]
        for j in range(m):
            if u_t[i, j] < 0.0:
                out[i, j] = 0.5 * _PI
                continue
            x = min(mach[i, j] * _INVERSE_MACH, top)
            k = int(x)
            v = x - k
            high = 0.0
            low = 0.0
            for which in range(2):
                share = w if which == 1 else 1.0 - w
                if share > 0.0:
                    row = stall[section[i, which]]
                    low += share * (row[0, k] * (1.0 - v) + row[0, k + 1] * v + offset[i, which])
                    high += share * (row[1, k] * (1.0 - v) + row[1, k + 1] * v + offset[i, which])
            out[i, j] = min(high - alpha[i, j], alpha[i, j] - low)
    return out
