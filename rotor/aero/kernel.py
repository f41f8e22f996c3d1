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

import numpy as np

from rotor.airfoil.bicubic import ALPHA_STEP, MACH_STEP, N_ALPHA, N_MACH
from rotor.arrays import Array
from rotor.compiled import compiled

(FZ, FX, FZ_THETA, FX_THETA, FZ_UT, FX_UT, FZ_UP, FX_UP, FZ_UR, FX_UR, LIFT, ALPHA, MACH, CL, CD, CD_MACH) = range(16)
"""Rows of the result. FZ, FX: dC_T/dr and dC_Q/dr; then their derivatives by pitch, U_T, U_P and U_R;
LIFT: ½σ U C_l, so that ∂FZ/∂F = LIFT·U_T and ∂FX/∂F = LIFT·U_P; then the flow at the section."""

_PI = math.pi
_TWO_PI = 2.0 * math.pi
_INVERSE_ALPHA = 1.0 / ALPHA_STEP
_INVERSE_MACH = 1.0 / MACH_STEP


# Contraction (fused multiply-add) is the only deviation from strict IEEE arithmetic.
_compile = compiled(error_model="numpy", fastmath={"contract"})


@_compile
def velocities(
    pitch: Array,
    pitch_around: Array,
    along: Array,
    along_around: Array,
    arm: Array,
    flap_rate: Array,
    through: Array,
    induced: Array,
    shapes: Array,
    twist_around: Array,
    rate_around: Array,
    pitch_rate: Array,
) -> Array:
    """θ, U_T, U_P, elastic twist φ and rate of pitch θ' of eqs. (3.5), (3.6), (5, elements, azimuths).

    θ = pitch(r) + pitch_around(ψ) + φ, U_T = along(r) + along_around(ψ), U_P = λ_i + arm(r) β'(ψ) + through(ψ) and
    φ = Σ Φ_k(r) q_k(ψ) with the shapes (modes, elements), q_k (modes, azimuths) and their rates.
    """
    n, m = induced.shape
    out = np.empty((5, n, m))
    for i in range(n):
        for j in range(m):
            out[1, i, j] = along[i] + along_around[j]
            out[2, i, j] = induced[i, j] + arm[i] * flap_rate[j] + through[j]
            out[3, i, j] = 0.0
            out[4, i, j] = pitch_rate[j]
        for k in range(len(shapes)):
            for j in range(m):
                out[3, i, j] += shapes[k, i] * twist_around[k, j]
                out[4, i, j] += shapes[k, i] * rate_around[k, j]
        for j in range(m):
            out[0, i, j] = pitch[i] + pitch_around[j] + out[3, i, j]
    return out


@_compile
def _wrapped(angle: float) -> float:
    """The angle in [−π, π). `math.floor` for those outside alone: for all it takes a third of the time of the loads."""
    if -_PI <= angle < _PI:
        return angle
    return angle - _TWO_PI * math.floor((angle + _PI) / _TWO_PI)


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
    u_r: Array,
    loss: Array,
    tip_mach: float,
    half_solidity: Array,
    section: Any,
    weight: Array,
    offset: Array,
    tables: Array,
    cos_sweep: Array,
    sin_sweep: Array,
) -> Array:
    """Loads, derivatives and section flow, (16, elements, azimuths); rows named by this module's constants.

    theta [rad], u_t, u_p (over ΩR): (elements, azimuths). u_r: flow along the blade, outward (over ΩR), (azimuths,);
    it enters the Mach number of a swept tip alone, that of the flow normal to its quarter chord: U_T cos Λ − U_R sin Λ
    and U_P. loss: F on lift, (elements,). The rest as in `Disk`.
    """
    n, m = theta.shape
    out = np.empty((16, n, m))
    for i in range(n):
        hs = half_solidity[i]
        factor = loss[i]
        first = tables[section[i, 0]]
        second = tables[section[i, 1]]
        w = weight[i]
        cos = cos_sweep[i]
        sin = sin_sweep[i]
        for j in range(m):
            t = u_t[i, j]
            p = u_p[i, j]
            square = t * t + p * p + 1e-30
            u = math.sqrt(square)
            alpha = _wrapped(theta[i, j] - math.atan2(p, t))
            normal = t * cos - u_r[j] * sin
            mach = math.sqrt(normal * normal + p * p + 1e-30) * tip_mach
            a = _wrapped(alpha - offset[i, 0])
            cl, cd, cl_a, cd_a, cl_m, cd_m = _section(first, a, mach)
            if w > 0.0:
                a = _wrapped(alpha - offset[i, 1])
                cl2, cd2, cl_a2, cd_a2, cl_m2, cd_m2 = _section(second, a, mach)
                cl += w * (cl2 - cl)
                cd += w * (cd2 - cd)
                cl_a += w * (cl_a2 - cl_a)
                cd_a += w * (cd_a2 - cd_a)
                cl_m += w * (cl_m2 - cl_m)
                cd_m += w * (cd_m2 - cd_m)
            lift = factor * cl
            lift_a = factor * cl_a
            # ∂α/∂U_T = U_P/U², ∂α/∂U_P = −U_T/U²; ∂M/∂U_P = M_tip² U_P/M, and so on.
            t_over = t / square
            p_over = p / square
            scale = tip_mach * tip_mach / mach
            mach_t = scale * normal * cos
            mach_p = scale * p
            mach_r = -scale * normal * sin
            lift_t = lift_a * p_over + factor * cl_m * mach_t
            lift_p = -lift_a * t_over + factor * cl_m * mach_p
            lift_r = factor * cl_m * mach_r
            cd_t = cd_a * p_over + cd_m * mach_t
            cd_p = -cd_a * t_over + cd_m * mach_p
            cd_r = cd_m * mach_r
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
            out[FZ_UR, i, j] = k * (lift_r * t - cd_r * p)
            out[FX_UR, i, j] = k * (lift_r * p + cd_r * t)
            out[LIFT, i, j] = k * cl
            out[ALPHA, i, j] = alpha
            out[MACH, i, j] = mach
            out[CL, i, j] = cl
            out[CD, i, j] = cd
            out[CD_MACH, i, j] = cd_m
    return out


(MOMENT, M_THETA, M_RATE, M_UT, M_UP, M_UR) = range(6)
"""Rows of `element_moments`: dC_M/dr about the pitch axis, then its derivatives by pitch, by the rate of pitch dθ/dψ,
and by U_T, U_P and U_R."""


@_compile
def _moment_coefficient(table: Any, alpha: float, mach: float) -> Any:
    """C_m and its slopes by α [rad] and Mach at one point."""
    x = (alpha + _PI) * _INVERSE_ALPHA
    i = int(x)
    if i >= N_ALPHA:
        i -= N_ALPHA
        x -= N_ALPHA
    u = x - i
    y = mach * _INVERSE_MACH
    inside = 1.0
    if y >= N_MACH:
        y = N_MACH - 1e-9
        inside = 0.0
    j = int(y)
    v = y - j
    cm = 0.0
    cm_u = 0.0
    cm_v = 0.0
    for k in range(3, -1, -1):
        p = ((table[i, j, k, 3] * v + table[i, j, k, 2]) * v + table[i, j, k, 1]) * v + table[i, j, k, 0]
        p_v = (3.0 * table[i, j, k, 3] * v + 2.0 * table[i, j, k, 2]) * v + table[i, j, k, 1]
        cm_u = cm_u * u + cm
        cm = cm * u + p
        cm_v = cm_v * u + p_v
    return cm, cm_u * _INVERSE_ALPHA, cm_v * inside * _INVERSE_MACH


@_compile
def element_moments(
    loads: Array,
    u_t: Array,
    u_p: Array,
    u_r: Array,
    rate: Array,
    tip_mach: float,
    gain: Array,
    damping: Array,
    lag: Array,
    section: Any,
    weight: Array,
    offset: Array,
    tables: Array,
    cos_sweep: Array,
    sin_sweep: Array,
) -> Array:
    """Moments of the air about the pitch axis with derivatives, (6, elements, azimuths), nose up:

        dC_M/dr = ½σ (c/R) U² C_m − x dF_z − d U θ'

    loads: as `element_loads` returns. rate: θ' = dθ/dψ, (elements, azimuths). gain: ½σ c/R; damping: d = N_b (c/R)³/8,
    which is −πρb³Uθ̇ of thin-airfoil theory about the quarter chord (Theodorsen, NACA Report 496); lag: x, by which the
    quarter chord lies behind the pitch axis, over R: each (elements,). tables: C_m, (sections, α cells, Mach cells, 4,
    4). The rest as in `element_loads`.
    """
    n, m = u_t.shape
    out = np.empty((6, n, m))
    for i in range(n):
        first = tables[section[i, 0]]
        second = tables[section[i, 1]]
        w = weight[i]
        cos = cos_sweep[i]
        sin = sin_sweep[i]
        g = gain[i]
        d = damping[i]
        x = lag[i]
        for j in range(m):
            t = u_t[i, j]
            p = u_p[i, j]
            square = t * t + p * p + 1e-30
            u = math.sqrt(square)
            alpha = loads[ALPHA, i, j]
            mach = loads[MACH, i, j]
            a = _wrapped(alpha - offset[i, 0])
            cm, cm_a, cm_m = _moment_coefficient(first, a, mach)
            if w > 0.0:
                a = _wrapped(alpha - offset[i, 1])
                cm2, cm_a2, cm_m2 = _moment_coefficient(second, a, mach)
                cm += w * (cm2 - cm)
                cm_a += w * (cm_a2 - cm_a)
                cm_m += w * (cm_m2 - cm_m)
            normal = t * cos - u_r[j] * sin
            scale = tip_mach * tip_mach / mach
            slow = d * rate[i, j] / u
            out[MOMENT, i, j] = g * square * cm - x * loads[FZ, i, j] - d * u * rate[i, j]
            out[M_THETA, i, j] = g * square * cm_a - x * loads[FZ_THETA, i, j]
            out[M_RATE, i, j] = -d * u
            out[M_UT, i, j] = (
                g * (2.0 * t * cm + cm_a * p + square * cm_m * scale * normal * cos) - x * loads[FZ_UT, i, j] - slow * t
            )
            out[M_UP, i, j] = (
                g * (2.0 * p * cm - cm_a * t + square * cm_m * scale * p) - x * loads[FZ_UP, i, j] - slow * p
            )
            out[M_UR, i, j] = -g * square * cm_m * scale * normal * sin - x * loads[FZ_UR, i, j]
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
