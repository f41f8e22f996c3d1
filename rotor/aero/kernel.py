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
def _wrapped(angle: float) -> float:
    """The angle in [−π, π)."""
    return angle - _TWO_PI * math.floor((angle + _PI) * (1.0 / _TWO_PI))


@_compile
def _angles_of_attack(theta: Array, u_t: Array, u_p: Array, out: Array) -> None:
    """α = θ − φ of one row, with φ = atan2(U_P, U_T)."""
    for j in range(len(out)):
        out[j] = _wrapped(theta[j] - arctangent(u_p[j], u_t[j]))


@_compile
def _mach_numbers(u_t: Array, u_p: Array, u_r: Array, cos: float, sin: float, tip_mach: float, out: Array) -> None:
    """M of the flow normal to the swept quarter chord, of one row."""
    for j in range(len(out)):
        normal = u_t[j] * cos - u_r[j] * sin
        out[j] = math.sqrt(normal * normal + u_p[j] * u_p[j] + _TINY) * tip_mach


@_compile
def _places_along_alpha(alpha: Array, offset: float, cell: Any, place: Array) -> None:
    """Cells of the table and the places in them, from 0 to 1, of one row about the section's own chord."""
    for j in range(len(alpha)):
        x = (_wrapped(alpha[j] - offset) + _PI) * _INVERSE_ALPHA
        i = max(min(np.int32(x), np.int32(N_ALPHA - 1)), np.int32(0))  # Never outside, also where α is not a number.
        cell[j] = i
        place[j] = x - i


@_compile
def _places_along_mach(mach: Array, cell: Any, place: Array, slope: Array) -> None:
    """The same along Mach, and ∂place/∂M: 0 beyond the table, where section data are constant; there is a caveat."""
    for j in range(len(mach)):
        y = min(mach[j] * _INVERSE_MACH, N_MACH - 1e-9)
        i = max(min(np.int32(y), np.int32(N_MACH - 1)), np.int32(0))
        cell[j] = i
        place[j] = y - i
        slope[j] = _INVERSE_MACH if mach[j] * _INVERSE_MACH < N_MACH else 0.0


@_compile
def _along_alpha(cell: Any, k: int, u: float) -> Any:
    """The factor of v^k in a cell's polynomial at u, and its slope: Horner's rule for both."""
    value = cell[3, k] * u + cell[2, k]
    slope = cell[3, k] * u + value
    value = value * u + cell[1, k]
    slope = slope * u + value
    return value * u + cell[0, k], slope


@_compile
def _surface(cell: Any, u: float, v: float) -> Any:
    """A cell's bicubic polynomial (4, 4) and its slopes by u and v."""
    c0, s0 = _along_alpha(cell, 0, u)
    c1, s1 = _along_alpha(cell, 1, u)
    c2, s2 = _along_alpha(cell, 2, u)
    c3, s3 = _along_alpha(cell, 3, u)
    value = c3 * v + c2
    by_v = c3 * v + value
    value = value * v + c1
    by_v = by_v * v + value
    return value * v + c0, ((s3 * v + s2) * v + s1) * v + s0, by_v


@_compile
def _look_up(
    tables: Any, which: int, at_alpha: Any, at_mach: Any, u: Array, v: Array, mach_slope: Array, share: float, out: Any
) -> None:
    """Blend a section into coefficients and slopes by α [rad] and Mach of one row, out[which coefficient] + 0, 1, 2.

    tables: (sections, α cells, Mach cells, coefficients, 4, 4); share: of this section, 1 for the first of two.
    """
    for j in range(len(u)):
        cell = tables[which, at_alpha[j], at_mach[j]]
        for k in range(cell.shape[0]):
            value, by_u, by_v = _surface(cell[k], u[j], v[j])
            if share < 1.0:
                out[3 * k, j] += share * (value - out[3 * k, j])
                out[3 * k + 1, j] += share * (by_u * _INVERSE_ALPHA - out[3 * k + 1, j])
                out[3 * k + 2, j] += share * (by_v * mach_slope[j] - out[3 * k + 2, j])
            else:
                out[3 * k, j] = value
                out[3 * k + 1, j] = by_u * _INVERSE_ALPHA
                out[3 * k + 2, j] = by_v * mach_slope[j]


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
    _places_along_mach(mach, cells[1], places[1], places[2])
    for which in range(2):
        share = weight if which == 1 else 1.0
        if share > 0.0:
            _places_along_alpha(alpha, offset[which], cells[0], places[0])
            _look_up(tables, section[which], cells[0], cells[1], places[0], places[1], places[2], share, out)


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
        _angles_of_attack(theta[i], t, p, alpha)
        _mach_numbers(t, p, u_r, cos_sweep[i], sin_sweep[i], tip_mach, mach)
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
