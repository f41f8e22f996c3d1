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

from rotor.aero.look_up import INVERSE_MACH, look_up, places_along_alpha, places_along_mach, wrapped
from rotor.arrays import Array
from rotor.compiled import compiled

(FZ, FX, FZ_THETA, FX_THETA, FZ_UT, FX_UT, FZ_UP, FX_UP, FZ_UR, FX_UR, LIFT, ALPHA, MACH, CL, CD, CD_MACH) = range(16)
"""Rows of the result. FZ, FX: dC_T/dr and dC_Q/dr; then their derivatives by pitch, U_T, U_P and U_R;
LIFT: ½σ U C_l, so that ∂FZ/∂F = LIFT·U_T and ∂FX/∂F = LIFT·U_P; then the flow at the section."""

_PI = math.pi


# Contraction (fused multiply-add) is the only deviation from strict IEEE arithmetic.
_compile = compiled(error_model="numpy", fastmath={"contract"})


@_compile
def velocities(
    twist: Array,
    along: Array,
    arm: Array,
    cos: Array,
    sin: Array,
    pitch: Any,
    flap: Any,
    mu_x: float,
    mu_z: float,
    induced: Array,
    shapes: Array,
    twist_around: Array,
    rate_around: Array,
) -> Any:
    """θ, U_T and U_P of eqs. (3.5), (3.6), for an elastic blade its twist φ and rate of pitch θ' as well, and β.

    θ = θ_tw + θ0 + θ1c cos ψ + θ1s sin ψ + φ, U_T = along(r) + µ_x sin ψ, U_P = µ_z + λ_i + (r − e) β' + µ_x β cos ψ
    and φ = Σ Φ_k(r) q_k(ψ) with the shapes (modes, elements), q_k (modes, azimuths) and their rates. pitch, flap: mean,
    cosine and sine parts of θ and β; arm: r − e. Fields are (3 or 5, elements, azimuths), β is (azimuths,).
    """
    n, m = induced.shape
    around = around_azimuth(cos, sin, pitch, flap, mu_x, mu_z)
    out = np.empty((5 if len(shapes) else 3, n, m))
    for i in range(n):
        velocities_of_row(twist[i], along[i], arm[i], sin, mu_x, induced[i], around, out[0, i], out[1, i], out[2, i])
        if len(shapes):
            add_twist(shapes[:, i], twist_around, rate_around, around, out[0, i], out[3, i], out[4, i])
    return out, around[BETA]


(BETA, _BETA_RATE, _THROUGH, _CYCLIC, _CYCLIC_RATE) = range(5)


@_compile
def around_azimuth(cos: Array, sin: Array, pitch: Any, flap: Any, mu_x: float, mu_z: float) -> Array:
    """β, β', µ_z + µ_x β cos ψ, the cyclic pitch and its rate, (5, azimuths)."""
    out = np.empty((5, len(cos)))
    for j in range(len(cos)):
        out[BETA, j] = flap[0] + flap[1] * cos[j] + flap[2] * sin[j]
        out[_BETA_RATE, j] = flap[2] * cos[j] - flap[1] * sin[j]
        out[_THROUGH, j] = mu_z + mu_x * out[BETA, j] * cos[j]
        out[_CYCLIC, j] = pitch[0] + pitch[1] * cos[j] + pitch[2] * sin[j]
        out[_CYCLIC_RATE, j] = pitch[2] * cos[j] - pitch[1] * sin[j]
    return out


@_compile
def velocities_of_row(
    twist: float, along: float, arm: float, sin: Array, mu_x: float, induced: Array, around: Any, theta: Array,
    u_t: Array, u_p: Array,
) -> None:  # fmt: skip
    """θ without elastic twist, U_T and U_P of one row."""
    for j in range(len(theta)):
        theta[j] = twist + around[_CYCLIC, j]
        u_t[j] = along + mu_x * sin[j]
        u_p[j] = induced[j] + arm * around[_BETA_RATE, j] + around[_THROUGH, j]


@_compile
def add_twist(
    shapes: Any, twist_around: Any, rate_around: Any, around: Any, theta: Array, twist: Array, rate: Array
) -> None:
    """Elastic twist and rate of pitch of one row; the twist is added to θ."""
    for j in range(len(theta)):
        twist[j] = 0.0
        rate[j] = around[_CYCLIC_RATE, j]
    for k in range(len(shapes)):
        for j in range(len(theta)):
            twist[j] += shapes[k] * twist_around[k, j]
            rate[j] += shapes[k] * rate_around[k, j]
    for j in range(len(theta)):
        theta[j] += twist[j]


_EIGHTH_TURN = 0.25 * _PI
_TAN_SIXTEENTH_TURN = math.tan(0.125 * _PI)
_TINY = 1e-30
"""Added to squares of velocities, so that nothing divides by zero at the centre of the reverse-flow region."""

# The loops below each run along one row of azimuths with few arrays and no branches: so the compiler makes vector code
# of them, and four elements take about as long as one. Only the look-up goes from element to element.


@_compile
def arctangent(p: float, t: float) -> float:
    """atan2(p, t), to 1.5 units in the last place (tested); 0 where both are zero.

    With |x| ≤ 1 by swapping the two and |z| ≤ tan π/8 by arctan x = π/4 + arctan (x − 1)/(x + 1), the rational function
    of Cephes for arctan z (S. Moshier, Methods and Programs for Mathematical Functions, 1989).
    """
    large = max(abs(p), abs(t), 1e-300)
    small = min(abs(p), abs(t))
    beyond = small > _TAN_SIXTEENTH_TURN * large
    z = (small - large if beyond else small) / (large + small if beyond else large)
    s = z * z
    above = (
        (((-8.750608600031904e-1 * s - 1.615753718733365e1) * s - 7.500855792314705e1) * s - 1.228866684490136e2) * s
    ) - 6.485021904942025e1
    below = (
        (((s + 2.485846490142306e1) * s + 1.650270098316989e2) * s + 4.328810604912903e2) * s + 4.853903996359137e2
    ) * s + 1.945506571482614e2
    angle = z + z * s * (above / below)
    angle = angle + _EIGHTH_TURN if beyond else angle
    angle = 0.5 * _PI - angle if abs(p) > abs(t) else angle
    angle = _PI - angle if t < 0.0 else angle
    return -angle if p < 0.0 else angle


@_compile
def angles_of_attack(theta: Array, u_t: Array, u_p: Array, out: Array) -> None:
    """α = θ − φ of one row, with φ = atan2(U_P, U_T)."""
    for j in range(len(out)):
        out[j] = wrapped(theta[j] - arctangent(u_p[j], u_t[j]))


@_compile
def mach_numbers(u_t: Array, u_p: Array, u_r: Array, cos: float, sin: float, tip_mach: float, out: Array) -> None:
    """M of the flow normal to the swept quarter chord, of one row."""
    for j in range(len(out)):
        normal = u_t[j] * cos - u_r[j] * sin
        out[j] = math.sqrt(normal * normal + u_p[j] * u_p[j] + _TINY) * tip_mach


@_compile
def _blended(
    alpha: Array,
    mach: Array,
    section: Any,
    weight: float,
    offset: Array,
    tables: Any,
    cells: Any,
    places: Any,
    out: Any,
) -> None:
    """Coefficients of one row with slopes, blended from the two sections at its element.

    cells (2, azimuths), places (3, azimuths): memory to work in. The rest as in `Disk` and `_look_up`.
    """
    places_along_mach(mach, cells[1], places[1], places[2])
    for which in range(2):
        share = weight if which == 1 else 1.0
        if share > 0.0:
            places_along_alpha(alpha, offset[which], cells[0], places[0])
            look_up(tables, section[which], cells[0], cells[1], places[0], places[1], places[2], share, out)


@_compile
def _forces(
    u_t: Array, u_p: Array, half_solidity: float, loss: float, cl: Array, cl_a: Array, cd: Array, cd_a: Array,
    fz: Array, fx: Array, fz_theta: Array, fx_theta: Array, lift: Array,
) -> None:  # fmt: skip
    """dC_T/dr and dC_Q/dr of one row, their slopes by the pitch, and ½σ U C_l."""
    for j in range(len(fz)):
        t, p = u_t[j], u_p[j]
        k = half_solidity * math.sqrt(t * t + p * p + _TINY)
        fz[j] = k * (loss * cl[j] * t - cd[j] * p)
        fx[j] = k * (loss * cl[j] * p + cd[j] * t)
        fz_theta[j] = k * (loss * cl_a[j] * t - cd_a[j] * p)
        fx_theta[j] = k * (loss * cl_a[j] * p + cd_a[j] * t)
        lift[j] = k * cl[j]


@_compile
def _slopes_by_angle(
    u_t: Array, u_p: Array, half_solidity: float, loss: float, cl: Array, cl_a: Array, cd: Array, cd_a: Array,
    fz_ut: Array, fx_ut: Array, fz_up: Array, fx_up: Array,
) -> None:  # fmt: skip
    """Slopes of the forces of one row by U_T and U_P at the same Mach number: ∂α/∂U_T = U_P/U², ∂α/∂U_P = −U_T/U²."""
    for j in range(len(fz_ut)):
        t, p = u_t[j], u_p[j]
        square = t * t + p * p + _TINY
        k = half_solidity * math.sqrt(square)
        t_over, p_over = t / square, p / square
        lift, drag = loss * cl[j], cd[j]
        z, x = lift * t - drag * p, lift * p + drag * t
        z_a, x_a = loss * cl_a[j] * t - cd_a[j] * p, loss * cl_a[j] * p + cd_a[j] * t
        fz_ut[j] = k * (t_over * z + p_over * z_a + lift)
        fx_ut[j] = k * (t_over * x + p_over * x_a + drag)
        fz_up[j] = k * (p_over * z - t_over * z_a - drag)
        fx_up[j] = k * (p_over * x - t_over * x_a + lift)


@_compile
def _add_slopes_by_mach(
    u_t: Array, u_p: Array, u_r: Array, cos: float, sin: float, half_solidity: float, loss: float, tip_mach: float,
    mach: Array, cl_m: Array, cd_m: Array, fz_ut: Array, fx_ut: Array, fz_up: Array, fx_up: Array, fz_ur: Array,
    fx_ur: Array,
) -> None:  # fmt: skip
    """Add what the Mach number adds to the slopes of one row, and write those by U_R: ∂M/∂U_P = M_tip² U_P/M."""
    for j in range(len(mach)):
        t, p = u_t[j], u_p[j]
        normal = t * cos - u_r[j] * sin
        scale = half_solidity * math.sqrt(t * t + p * p + _TINY) * tip_mach * tip_mach / mach[j]
        z, x = scale * (loss * cl_m[j] * t - cd_m[j] * p), scale * (loss * cl_m[j] * p + cd_m[j] * t)
        fz_ut[j] += z * normal * cos
        fx_ut[j] += x * normal * cos
        fz_up[j] += z * p
        fx_up[j] += x * p
        fz_ur[j] = -z * normal * sin
        fx_ur[j] = -x * normal * sin


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
    cells, places = np.empty((2, m), np.int32), np.empty((3, m))
    found = np.empty((6, m))
    for i in range(n):
        t, p, alpha, mach = u_t[i], u_p[i], out[ALPHA, i], out[MACH, i]
        angles_of_attack(theta[i], t, p, alpha)
        mach_numbers(t, p, u_r, cos_sweep[i], sin_sweep[i], tip_mach, mach)
        _blended(alpha, mach, section[i], weight[i], offset[i], tables, cells, places, found)
        cl, cl_a, cl_m, cd, cd_a, cd_m = found[0], found[1], found[2], found[3], found[4], found[5]
        _forces(
            t, p, half_solidity[i], loss[i], cl, cl_a, cd, cd_a,
            out[FZ, i], out[FX, i], out[FZ_THETA, i], out[FX_THETA, i], out[LIFT, i],
        )  # fmt: skip
        _slopes_by_angle(
            t, p, half_solidity[i], loss[i], cl, cl_a, cd, cd_a,
            out[FZ_UT, i], out[FX_UT, i], out[FZ_UP, i], out[FX_UP, i],
        )  # fmt: skip
        _add_slopes_by_mach(
            t, p, u_r, cos_sweep[i], sin_sweep[i], half_solidity[i], loss[i], tip_mach, mach, cl_m, cd_m,
            out[FZ_UT, i], out[FX_UT, i], out[FZ_UP, i], out[FX_UP, i], out[FZ_UR, i], out[FX_UR, i],
        )  # fmt: skip
        out[CL, i], out[CD, i], out[CD_MACH, i] = cl, cd, cd_m
    return out


(MOMENT, M_THETA, M_RATE, M_UT, M_UP, M_UR) = range(6)
"""Rows of `element_moments`: dC_M/dr about the pitch axis, then its derivatives by pitch, by the rate of pitch dθ/dψ,
and by U_T, U_P and U_R."""


@_compile
def _moments(
    u_t: Array, u_p: Array, rate: Array, gain: float, damping: float, lag: float, cm: Array, cm_a: Array, fz: Array,
    fz_theta: Array, moment: Array, by_theta: Array, by_rate: Array,
) -> None:  # fmt: skip
    """dC_M/dr of one row with its slopes by pitch and rate of pitch."""
    for j in range(len(moment)):
        square = u_t[j] * u_t[j] + u_p[j] * u_p[j] + _TINY
        by_rate[j] = -damping * math.sqrt(square)
        moment[j] = gain * square * cm[j] - lag * fz[j] - damping * math.sqrt(square) * rate[j]
        by_theta[j] = gain * square * cm_a[j] - lag * fz_theta[j]


@_compile
def _moment_slopes(
    u_t: Array, u_p: Array, u_r: Array, rate: Array, cos: float, sin: float, gain: float, damping: float, lag: float,
    tip_mach: float, mach: Array, cm: Array, cm_a: Array, cm_m: Array, fz_ut: Array, fz_up: Array, fz_ur: Array,
    by_ut: Array, by_up: Array, by_ur: Array,
) -> None:  # fmt: skip
    """Slopes of dC_M/dr of one row by U_T, U_P and U_R."""
    for j in range(len(by_ut)):
        t, p = u_t[j], u_p[j]
        square = t * t + p * p + _TINY
        normal = t * cos - u_r[j] * sin
        by_mach = square * cm_m[j] * tip_mach * tip_mach / mach[j]
        slow = damping * rate[j] / math.sqrt(square)
        by_ut[j] = gain * (2.0 * t * cm[j] + cm_a[j] * p + by_mach * normal * cos) - lag * fz_ut[j] - slow * t
        by_up[j] = gain * (2.0 * p * cm[j] - cm_a[j] * t + by_mach * p) - lag * fz_up[j] - slow * p
        by_ur[j] = -gain * by_mach * normal * sin - lag * fz_ur[j]


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
    quarter chord lies behind the pitch axis, over R: each (elements,). tables: C_m, (sections, α cells, Mach cells, 1,
    4, 4). The rest as in `element_loads`.
    """
    n, m = u_t.shape
    out = np.empty((6, n, m))
    cells, places = np.empty((2, m), np.int32), np.empty((3, m))
    found = np.empty((3, m))
    for i in range(n):
        mach = loads[MACH, i]
        _blended(loads[ALPHA, i], mach, section[i], weight[i], offset[i], tables, cells, places, found)
        _moments(
            u_t[i], u_p[i], rate[i], gain[i], damping[i], lag[i], found[0], found[1], loads[FZ, i], loads[FZ_THETA, i],
            out[MOMENT, i], out[M_THETA, i], out[M_RATE, i],
        )  # fmt: skip
        _moment_slopes(
            u_t[i], u_p[i], u_r, rate[i], cos_sweep[i], sin_sweep[i], gain[i], damping[i], lag[i], tip_mach, mach,
            found[0], found[1], found[2], loads[FZ_UT, i], loads[FZ_UP, i], loads[FZ_UR, i],
            out[M_UT, i], out[M_UP, i], out[M_UR, i],
        )  # fmt: skip
    return out


@_compile
def force_values(
    u_t: Array, u_p: Array, half_solidity: float, loss: float, cl: Array, cd: Array, fz: Array, fx: Array
) -> None:
    """dC_T/dr and dC_Q/dr of one row."""
    for j in range(len(fz)):
        t, p = u_t[j], u_p[j]
        k = half_solidity * math.sqrt(t * t + p * p + _TINY)
        fz[j] = k * (loss * cl[j] * t - cd[j] * p)
        fx[j] = k * (loss * cl[j] * p + cd[j] * t)


@_compile
def moment_values(
    u_t: Array, u_p: Array, rate: Array, gain: float, damping: float, lag: float, cm: Array, fz: Array, moment: Array
) -> None:
    """dC_M/dr of one row."""
    for j in range(len(moment)):
        square = u_t[j] * u_t[j] + u_p[j] * u_p[j] + _TINY
        moment[j] = gain * square * cm[j] - lag * fz[j] - damping * math.sqrt(square) * rate[j]


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
            x = min(mach[i, j] * INVERSE_MACH, top)
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
