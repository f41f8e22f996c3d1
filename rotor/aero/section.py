"""A blade element: from pitch and velocities to forces, with partial derivatives. The only place they are written.

With velocities over ΩR, the flow along the blade U_R, U² = U_T² + U_P² and φ = atan2(U_P, U_T) (reverse flow needs no
special case),

    α = θ − φ,      M = M_tip √((U_T cos Λ − U_R sin Λ)² + U_P²)
    dC_T/dr = F_z = ½σ U (F C_l U_T − C_d U_P)                              (2.15), (2.17), (3.9)
    dC_Q/dr = F_x = ½σ U (F C_l U_P + C_d U_T) + ½σ c_f (V − |U_T|) U_T     (2.16), (2.18), (3.10)
              F_r = ½σ c_f V U_R
    dC_M/dr = M   = ½σ (c/R) U² C_m − x F_z − d U θ' − ½ j sin 2θ

F: loss factor on lift. Λ: sweep of the quarter chord. V² = U_T² + U_R²: skin friction follows the yawed velocity
(Harris, J. AHS 11(3), 1966; Johnson, Helicopter Theory, 1980), C_d holds it for the flow across the blade. M is nose up
about the pitch axis: x is how far the quarter chord lies behind it, d = N_b (c/R)³/8 the damping −πρb³Uθ̇ of
thin-airfoil theory (Theodorsen, NACA Report 496), j the propeller moment.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from rotor.aero.look_up import look_up, places_along_alpha, places_along_mach, wrapped
from rotor.support.arrays import Array, Booleans, Integers, fix
from rotor.support.compiled import compiled

CHANNELS = (TH, UT, UP, UR, LOSS, RATE) = tuple(range(6))
"""θ, U_T, U_P, U_R, F and dθ/dψ."""
FORCES = (FZ, FX, FR, M) = tuple(range(4))
PAIRS = (
    *((FZ, c) for c in (TH, UT, UP, UR, LOSS)),
    *((FX, c) for c in (TH, UT, UP, UR, LOSS)),
    *((M, c) for c in (TH, UT, UP, UR, LOSS, RATE)),
    *((FR, c) for c in (UT, UR)),
)
"""Force and channel of each row of the partial derivatives."""
FLOW = (ALPHA, MACH, CL, CD, CD_MACH) = tuple(range(5))
"""Rows of the flow at the section; CD_MACH: ∂C_d/∂M."""

_TINY = 1e-30
"""Added to squares of velocities, so that nothing divides by zero at the centre of the reverse-flow region."""
_PI = math.pi


class SectionData(NamedTuple):
    """What forces need beside the channels; arrays by element unless said otherwise. The first eight: see `Disk`."""

    half_solidity: Array
    section: Integers
    weight: Array
    offset: Array
    tables: Array
    held: Array
    cos_sweep: Array
    sin_sweep: Array
    tip_mach: float
    friction: float
    """c_f; 0 without friction of the flow along the blade."""
    lossy: bool
    """Whether F differs from 1."""
    unloaded: Booleans
    """Elements on which the air exerts no force, (elements, azimuths), or (0, 0)."""
    added: Array
    """What unsteady flow adds to C_l, C_d and C_m, (3, elements, azimuths), or without elements."""
    scatter: Array
    """By how much section data may be wrong, `SCATTER`, or empty: see `rotor.trim.doubt`."""
    moment_gain: Array
    """½σ c/R; this and the rest are empty for a blade that is rigid in torsion, which has no moment."""
    damping: Array
    """d"""
    lag: Array
    """x"""
    moment_tables: Array
    """C_m, (sections, α cells, Mach cells, 1, 4, 4)."""
    inertia: Array
    """j"""


NO_INCREMENTS = np.zeros((3, 0, 0))
"""`SectionData.added` in steady flow."""
SCATTER = (MORE_LIFT, MORE_DRAG, MORE_MOMENT, EARLIER_RISE) = tuple(range(4))
"""Rows of `SectionData.scatter`: shares of C_l and C_d, an amount of C_m, and the Mach number by which drag rises
earlier, to first order: partial derivatives leave out that of the last."""
NO_SCATTER = np.zeros(0)
_NONE = np.zeros(0)
NO_MOMENT = {
    "moment_gain": _NONE,
    "damping": _NONE,
    "lag": _NONE,
    "moment_tables": np.zeros((0,) * 6),
    "inertia": _NONE,
}
"""The last five of `SectionData` for a rigid blade."""
fix(NO_MOMENT)  # As those of a blade that twists: kernels are compiled for either kind of array.

# Contraction (fused multiply-add) is the only deviation from strict IEEE arithmetic. The loops below run along one row
# of azimuths and have no branches: so the compiler makes vector code of them, and four elements take about as long as
# one. Only the look-up goes from element to element.
_compile = compiled(error_model="numpy")
_inline = compiled(error_model="numpy", inline="always")

(_U, _K, _LIFT, _DRAG, _LIFT_A, _LIFT_M, _T_OVER, _P_OVER, _BACK, _BY_T, _BY_P, _BY_R, _ONE, _TWO) = range(14)
"""Rows of work: U, ½σU, F C_l, C_d, F ∂C_l/∂α, F ∂C_l/∂M, U_T/U², U_P/U², −U_T/U², ∂M/∂(U_T, U_P, U_R)."""


@_compile
def section(c: Any, data: Any, slopes: bool, flow: bool) -> Any:
    """Forces (4, elements, azimuths), partial derivatives (`PAIRS`, …) and flow (`FLOW`, …) of channels (6, …).

    Derivatives and flow have no elements where they are not asked for. Units: dC_T/dr and so on; see this file's head.
    """
    n, m = c.shape[1:]
    f, d = np.empty((4, n, m)), np.empty((18, n if slopes else 0, m))
    s = np.empty((5, n if flow else 0, m))
    elastic, masked = len(data.moment_gain) > 0, len(data.unloaded) > 0
    w, alpha, mach = np.empty((14, m)), np.empty(m), np.empty(m)
    cells, places, coeffs = np.empty((2, m), np.int32), np.empty((3, m)), np.zeros((9, m))
    for i in range(n):
        t, p, r = c[UT, i], c[UP, i], c[UR, i]
        _speeds(t, p, data.half_solidity[i], w)
        angles_of_attack(c[TH, i], t, p, alpha)
        _mach_numbers((t, p, r), data.cos_sweep[i], data.sin_sweep[i], data.tip_mach, mach)
        scattered = len(data.scatter) > 0
        _coefficients(data, i, alpha, mach, slopes or flow or scattered, cells, places, coeffs)
        if scattered:
            _scatter(data.scatter, coeffs)
        if data.added.shape[1] > 0:
            for k in range(3):
                for j in range(m):
                    coeffs[3 * k, j] += data.added[k, i, j]
        lift = coeffs[0]
        if data.lossy:
            lift = w[_LIFT]
            _times(c[LOSS, i], coeffs[0], lift)
        _resolve(t, p, w, lift, coeffs[3], f[FZ, i], f[FX, i])
        f[M, i] = 0.0
        if elastic:
            _moment(c, i, data, coeffs, w, f)
        if slopes:
            _force_slopes(c, i, data, mach, coeffs, w, f, d)
            if elastic:
                _moment_slopes(c, i, data, coeffs, w, d)
        if data.friction > 0.0:
            _along_blade(t, r, data.friction * data.half_solidity[i], w, f[FX, i], f[FR, i])
            if slopes:
                _along_blade_slopes(t, r, data.friction * data.half_solidity[i], w, i, d)
        else:
            f[FR, i] = 0.0
            if slopes:
                d[_R:, i] = 0.0
        if flow:
            for j in range(m):  # Rows assigned as a whole take numba longer to compile.
                s[ALPHA, i, j], s[MACH, i, j] = alpha[j], mach[j]
                s[CL, i, j], s[CD, i, j], s[CD_MACH, i, j] = coeffs[0, j], coeffs[3, j], coeffs[5, j]
        if masked:
            _unload(data.unloaded[i], c[TH, i], data.inertia[i] if elastic else 0.0, i, f, d, s)
    return f, d, s


@_inline
def _speeds(t: Any, p: Any, half_solidity: float, w: Any) -> None:
    """U and ½σU of one row."""
    for j in range(w.shape[1]):
        w[_U, j] = math.sqrt(t[j] * t[j] + p[j] * p[j] + _TINY)
        w[_K, j] = half_solidity * w[_U, j]


_EIGHTH_TURN = 0.25 * _PI
_TAN_SIXTEENTH_TURN = math.tan(0.125 * _PI)


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
def angles_of_attack(theta: Any, u_t: Any, u_p: Any, out: Any) -> None:
    """α = θ − φ of one row, in [−π, π)."""
    for j in range(len(out)):
        out[j] = wrapped(theta[j] - arctangent(u_p[j], u_t[j]))


@_inline
def _mach_numbers(air: Any, cos: float, sin: float, tip_mach: float, out: Any) -> None:
    t, p, r = air
    for j in range(len(out)):
        normal = t[j] * cos - r[j] * sin
        out[j] = math.sqrt(normal * normal + p[j] * p[j] + _TINY) * tip_mach


@_compile
def _coefficients(data: Any, i: int, alpha: Any, mach: Any, slopes: bool, cells: Any, places: Any, coeffs: Any) -> None:
    """C_l, C_d and C_m of one row, blended from the two sections at its element, each followed by ∂/∂α and ∂/∂M.

    cells (2, azimuths), places (3, azimuths): memory to work in.
    """
    places_along_mach(mach, cells[1], places[1], places[2])
    for which in range(2):
        share = data.weight[i] if which == 1 else 1.0
        if share > 0.0:
            places_along_alpha(alpha, data.offset[i, which], cells[0], places[0])
            table = data.section[i, which]
            look_up(data.tables, table, cells, places, share, slopes, coeffs[:6])
            if len(data.moment_gain) > 0:
                look_up(data.moment_tables, table, cells, places, share, slopes, coeffs[6:])


@_inline
def _scatter(scatter: Any, coeffs: Any) -> None:
    """Change the coefficients of one row and their derivatives."""
    for j in range(coeffs.shape[1]):
        coeffs[3, j] += scatter[EARLIER_RISE] * coeffs[5, j]
        for k in range(3):
            coeffs[k, j] *= 1.0 + scatter[MORE_LIFT]
            coeffs[3 + k, j] *= 1.0 + scatter[MORE_DRAG]
        coeffs[6, j] += scatter[MORE_MOMENT]


@_inline
def _times(factor: Any, other: Any, out: Any) -> None:
    for j in range(len(out)):
        out[j] = factor[j] * other[j]


@_inline
def _resolve(t: Any, p: Any, w: Any, lift: Any, drag: Any, z: Any, x: Any) -> None:
    """½σU (l U_T − d U_P) and ½σU (l U_P + d U_T): lift and drag, or their derivatives, in axes of the shaft."""
    for j in range(len(z)):
        z[j] = w[_K, j] * (lift[j] * t[j] - drag[j] * p[j])
    for j in range(len(x)):
        x[j] = w[_K, j] * (lift[j] * p[j] + drag[j] * t[j])


@_inline
def _along_blade(t: Any, r: Any, rub: float, w: Any, fx: Any, fr: Any) -> None:
    """F_r of one row, and friction of the flow along the blade in F_x; rub: ½σ c_f."""
    for j in range(len(fx)):
        w[_ONE, j] = rub * math.sqrt(t[j] * t[j] + r[j] * r[j] + _TINY)
        fx[j] += (w[_ONE, j] - rub * abs(t[j])) * t[j]
    _times(w[_ONE], r, fr)


@_inline
def _moment(c: Any, i: int, data: Any, coeffs: Any, w: Any, f: Any) -> None:
    """M of one row."""
    gain, damping, lag, inertia = data.moment_gain[i], data.damping[i], data.lag[i], data.inertia[i]
    for j in range(w.shape[1]):
        f[M, i, j] = gain * w[_U, j] * w[_U, j] * coeffs[6, j] - damping * w[_U, j] * c[RATE, i, j]
        f[M, i, j] -= lag * f[FZ, i, j] + 0.5 * inertia * of_double_angle(c[TH, i, j])[0]


# First rows of the derivatives of each force; the channels follow in their order.
_Z, _X, _N, _R = 0, 5, 10, 16


@_inline
def _force_slopes(c: Any, i: int, data: Any, mach: Any, coeffs: Any, w: Any, f: Any, d: Any) -> None:
    """Derivatives of F_z and F_x of one row, without friction: ∂α/∂U_T = U_P/U², ∂α/∂U_P = −U_T/U²."""
    m, cos, sin, square = w.shape[1], data.cos_sweep[i], data.sin_sweep[i], data.tip_mach * data.tip_mach
    t, p, r, lift, lift_a, lift_m = c[UT, i], c[UP, i], c[UR, i], coeffs[0], coeffs[1], coeffs[2]
    if data.lossy:
        lift, lift_a, lift_m = w[_LIFT], w[_LIFT_A], w[_LIFT_M]
        _times(c[LOSS, i], coeffs[1], lift_a)
        _times(c[LOSS, i], coeffs[2], lift_m)
    for j in range(m):
        w[_T_OVER, j] = t[j] / (w[_U, j] * w[_U, j])
        w[_P_OVER, j] = p[j] / (w[_U, j] * w[_U, j])
        w[_BACK, j] = -w[_T_OVER, j]
        w[_BY_T, j] = square / mach[j] * (t[j] * cos - r[j] * sin)
        w[_BY_R, j] = -sin * w[_BY_T, j]
        w[_BY_T, j] *= cos
        w[_BY_P, j] = square / mach[j] * p[j]
    _resolve(t, p, w, lift_a, coeffs[4], d[_Z + TH, i], d[_X + TH, i])
    _resolve(t, p, w, lift_m, coeffs[5], w[_ONE], w[_TWO])  # By the Mach number.
    _times(w[_K], coeffs[3], w[_DRAG])
    _times(w[_K], lift, w[_LIFT])
    _by_velocities(w, f[FZ, i], w[_ONE], w[_LIFT], w[_DRAG], -1.0, i, d[_Z:_X])
    _by_velocities(w, f[FX, i], w[_TWO], w[_DRAG], w[_LIFT], 1.0, i, d[_X:_N])
    if data.lossy:
        for j in range(m):
            d[_Z + LOSS, i, j] = w[_K, j] * coeffs[0, j] * t[j]
            d[_X + LOSS, i, j] = w[_K, j] * coeffs[0, j] * p[j]


@_inline
def _by_velocities(w: Any, f: Any, by_mach: Any, with_t: Any, with_p: Any, sign: float, i: int, d: Any) -> None:
    """Derivatives of a force ½σU (a U_T ± b U_P) or the moment by U_T, U_P and U_R, from those by θ and by Mach.

    with_t, with_p: ½σU a and ½σU b, with the sign of b; d: rows of this force.
    """
    by_alpha = d[TH, i]
    for j in range(w.shape[1]):
        d[UT, i, j] = w[_T_OVER, j] * f[j] + w[_P_OVER, j] * by_alpha[j] + with_t[j] + by_mach[j] * w[_BY_T, j]
        d[UP, i, j] = w[_P_OVER, j] * f[j] + w[_BACK, j] * by_alpha[j] + sign * with_p[j] + by_mach[j] * w[_BY_P, j]
    _times(by_mach, w[_BY_R], d[UR, i])


@_inline
def _along_blade_slopes(t: Any, r: Any, rub: float, w: Any, i: int, d: Any) -> None:
    """Derivatives of F_r of one row, and those of friction in F_x."""
    m = w.shape[1]
    for j in range(m):
        w[_ONE, j] = math.sqrt(t[j] * t[j] + r[j] * r[j] + _TINY)  # V
        d[_X + UT, i, j] += rub * (w[_ONE, j] + t[j] * t[j] / w[_ONE, j] - 2.0 * abs(t[j]))
        d[_R, i, j] = rub * t[j] * r[j] / w[_ONE, j]
        d[_X + UR, i, j] += d[_R, i, j]
        d[_R + 1, i, j] = rub * (w[_ONE, j] + r[j] * r[j] / w[_ONE, j])


@_inline
def _moment_slopes(c: Any, i: int, data: Any, coeffs: Any, w: Any, d: Any) -> None:
    """Derivatives of M of one row, those of −x F_z from those of F_z; coeffs: C_m and its derivatives are spent."""
    m, gain, damping, lag, inertia = w.shape[1], data.moment_gain[i], data.damping[i], data.lag[i], data.inertia[i]
    for k in range(6, 9):
        for j in range(m):
            coeffs[k, j] *= gain * w[_U, j] * w[_U, j]
    for j in range(m):
        d[_N + TH, i, j] = coeffs[7, j]
        w[_ONE, j] = 2.0 * coeffs[6, j] - damping * c[RATE, i, j] * w[_U, j]
        w[_TWO, j] = 0.0
    _by_velocities(w, w[_ONE], coeffs[8], w[_TWO], w[_TWO], 1.0, i, d[_N:_R])
    for j in range(m):
        d[_N + TH, i, j] -= inertia * of_double_angle(c[TH, i, j])[1]
        d[_N + RATE, i, j] = -damping * w[_U, j]
        d[_N + LOSS, i, j] = 0.0
    if lag != 0.0:
        for channel in range(5 if data.lossy else 4):
            for j in range(m):
                d[_N + channel, i, j] -= lag * d[_Z + channel, i, j]


@_compile
def _unload(unloaded: Any, theta: Any, inertia: float, i: int, f: Any, d: Any, s: Any) -> None:
    """Leave the propeller moment alone where the air exerts no force."""
    for j in range(len(unloaded)):
        if unloaded[j]:
            sine, cosine = of_double_angle(theta[j])
            f[:, i, j] = 0.0
            f[M, i, j] = -0.5 * inertia * sine
            if d.shape[1] > 0:
                d[:, i, j] = 0.0
                d[_N + TH, i, j] = -inertia * cosine
            if s.shape[1] > 0:
                s[CL:, i, j] = 0.0


@_compile
def of_double_angle(angle: float) -> Any:
    """sin and cos of twice an angle, to 4·10⁻¹⁶ (tested), without branches so that loops over it become vector code.

    Of the rest y after turns of π/2 with the polynomials of Cephes for |y| ≤ π/4 (S. Moshier, Methods and Programs for
    Mathematical Functions, 1989); each turn changes both signs.
    """
    turns = math.floor(angle * (2.0 / math.pi) + 0.5)
    sign = 1.0 - 2.0 * (turns - 2.0 * math.floor(0.5 * turns))
    y = (angle - turns * 1.5707963267948966) - turns * 6.123233995736766e-17
    s = y * y
    sine = 1.58962301576546568e-10 * s - 2.50507477628578073e-8
    sine = ((sine * s + 2.75573136213857245e-6) * s - 1.98412698295895386e-4) * s + 8.33333333332211859e-3
    sine = y + y * s * (sine * s - 1.66666666666666307e-1)
    cosine = -1.13585365213876817e-11 * s + 2.08757008419747317e-9
    cosine = ((cosine * s - 2.75573141792967388e-7) * s + 2.48015872888517045e-5) * s - 1.38888888888730564e-3
    cosine = 1.0 - 0.5 * s + s * s * (cosine * s + 4.16666666666665929e-2)
    return sign * 2.0 * sine * cosine, sign * (1.0 - 2.0 * sine * sine)


@_compile
def stall_angles(mach: Any, section: Any, weight: Any, offset: Any, stall: Any) -> Any:
    """Negative and positive stall angle about the blade's reference line [rad], (2, elements, azimuths).

    stall: angles about the section's own chord at the Mach knots, (sections, 2, knots): negative end, positive end.
    """
    n, m = mach.shape
    out = np.zeros((2, n, m))
    top = stall.shape[2] - 1 - 1e-9
    cell, place, slope = np.empty(m, np.int32), np.empty(m), np.empty(m)
    for i in range(n):
        places_along_mach(mach[i], cell, place, slope)
        for which in range(2):
            share = weight[i] if which == 1 else 1.0 - weight[i]
            if share > 0.0:
                row = stall[section[i, which]]
                for j in range(m):
                    k, v = min(cell[j], int(top)), place[j]
                    out[0, i, j] += share * (row[0, k] * (1.0 - v) + row[0, k + 1] * v + offset[i, which])
                    out[1, i, j] += share * (row[1, k] * (1.0 - v) + row[1, k + 1] * v + offset[i, which])
    return out


@_compile
def stall_margins(alpha: Any, mach: Any, u_t: Any, section: Any, weight: Any, offset: Any, stall: Any) -> Any:
    """Angle of attack left before stall [rad], (elements, azimuths): negative when stalled, π/2 in reverse flow.

    stall: as in `stall_angles`.
    """
    low, high = stall_angles(mach, section, weight, offset, stall)
    out = np.empty(alpha.shape)
    for i in range(alpha.shape[0]):
        for j in range(alpha.shape[1]):
            margin = min(high[i, j] - alpha[i, j], alpha[i, j] - low[i, j])
            out[i, j] = 0.5 * _PI if u_t[i, j] < 0.0 else margin
    return out
