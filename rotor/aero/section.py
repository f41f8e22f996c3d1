"""A blade element: from pitch and velocities to forces, with partial derivatives. The only place they are written.

With velocities over ΩR, the flow along the blade U_R, U² = U_T² + U_P² and φ = atan2(U_P, U_T) (reverse flow needs no
special case),

    α = θ − φ,      M = M_tip √((U_T cos Λ − U_R sin Λ)² + U_P²)
    V² = U² + U_R²,      sin α' = sin α U/V
    dC_T/dr = F_z = ½σ (U F C_l(α) U_T − V C_d(α') U_P)                     (2.15), (2.17), (3.9)
    dC_Q/dr = F_x = ½σ (U F C_l(α) U_P + V C_d(α') U_T)                     (2.16), (2.18), (3.10)
              F_r = ½σ V C_d(α') U_R
    dC_M/dr = M   = ½σ (c/R) U² C_m(α) − x F_z − d U θ' − ½ j sin 2θ

F: loss factor on lift. Λ: sweep of the quarter chord. C_l has what `rotor.airfoil.stall_delay` adds near the hub. Drag
is along the whole velocity V, with the coefficient of the section along the stream, at α' (after Harris, J. AHS 11(3),
1966, which could not be obtained; closed forms of Johnson, Helicopter Theory, 1980, follow for constant C_d); with U_R
left out it is that of the section's plane. α' is beyond 90° where the stream meets the trailing edge first; where the
stream is within 15° of the blade's axis, C_d goes smoothly from that of one edge to that of the other.

M is nose up about the pitch axis: x is how far the quarter chord lies behind it, d = N_b (c/R)³/8 the damping −πρb³Uθ̇
of thin-airfoil theory (Theodorsen, NACA Report 496), j the propeller moment.
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
    *((FR, c) for c in (TH, UT, UP, UR)),
)
"""Force and channel of each row of the partial derivatives."""
FLOW = (ALPHA, MACH, CL, CD, CD_MACH) = tuple(range(5))
"""Rows of the flow at the section; CD_MACH: ∂C_d/∂M."""

_TINY = 1e-30
"""Added to squares of velocities, so that nothing divides by zero at the centre of the reverse-flow region."""
_PI = math.pi


class SectionData(NamedTuple):
    """What forces need beside the channels; arrays by element unless said otherwise. The first eleven: see `Disk`."""

    half_solidity: Array
    section: Integers
    weight: Array
    offset: Array
    tables: Array
    held: Array
    delay: Array
    missing: Array
    held_missing: Array
    cos_sweep: Array
    sin_sweep: Array
    tip_mach: float
    yawed: bool
    """Whether drag is along the whole velocity; else along that in the section's plane."""
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
SCATTER = (MORE_LIFT, MORE_MOMENT, EARLIER_RISE) = tuple(range(3))
"""Rows of `SectionData.scatter`: a share of C_l, an amount of C_m, and the Mach number by which drag rises
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

(_U, _V, _S, _C, _G, _SIN, _COS, _STREAM) = range(8)
(_LIFT, _DRAG, _BY_T, _BY_P, _BY_R, _ONE, _TWO, _MACH) = range(8, 16)
"""Rows of work: U, V; U sin α, U cos α and √((U cos α)² + U_R²); sin θ, cos θ; α'; ½σU F C_l, ½σV C_d; ∂M/∂(U_T, U_P,
U_R); three more."""
_LIFT_BY, _DRAG_BY = 16, 20
"""First rows of the derivatives of ½σU F C_l and ½σV C_d by θ, U_T, U_P and U_R."""
_TURN = 9
"""Row of coefficients: ∂C_d/∂(C/G) of `_other_edge`, followed by two to work in."""
_MISSING = 12
"""Row of coefficients: C_l* − C_l of `rotor.airfoil.stall_delay`, followed by its slopes by α and M."""
_FADES = 0.25
"""C/G below which C_d goes to that of the stream from the other edge; with half of it the UH-60A's power at µ 0.4 is
0.01 % less."""


@_compile
def section(c: Any, data: Any, slopes: bool, flow: bool) -> Any:
    """Forces (4, elements, azimuths), partial derivatives (`PAIRS`, …) and flow (`FLOW`, …) of channels (6, …).

    Derivatives and flow have no elements where they are not asked for. Units: dC_T/dr and so on; see this file's head.
    """
    n, m = c.shape[1:]
    f, d = np.zeros((4, n, m)), np.zeros((20, n if slopes else 0, m))
    s = np.empty((5, n if flow else 0, m))
    elastic, masked, scattered = (
        len(data.moment_gain) > 0,
        len(data.unloaded) > 0,
        len(data.scatter) > 0,
    )
    w, alpha, mach = np.empty((_DRAG_BY + 4, m)), np.empty(m), np.empty(m)
    cells, places, coeffs = np.empty((2, m), np.int32), np.empty((3, m)), np.zeros((15, m))
    for i in range(n):
        t, p, r = c[UT, i], c[UP, i], c[UR, i]
        angles_of_attack(c[TH, i], t, p, alpha)
        _speeds(t, p, w[_U])
        _mach_numbers((t, p, r), data.cos_sweep[i], data.sin_sweep[i], data.tip_mach, mach)
        by_angle, speed, between = slopes or flow or scattered, w[_U], False
        places_along_mach(mach, cells[1], places[1], places[2])
        _coefficients(
            data, i, alpha, (0, 1 if data.yawed else 2), by_angle, cells, places, coeffs, 0
        )
        if data.yawed:
            speed, between = w[_V], _streamwise(c[TH, i], t, p, r, w)
            _coefficients(data, i, w[_STREAM], (1, 2), by_angle, cells, places, coeffs, 3)
        if between:
            for j in range(m):
                w[_ONE, j] = _PI - w[_STREAM, j]
            _coefficients(data, i, w[_ONE], (1, 2), by_angle, cells, places, coeffs, _TURN)
            _other_edge(w, coeffs)
        if scattered:
            _scatter(data.scatter, coeffs)
        if data.added.shape[1] > 0:
            for k in range(3):
                for j in range(m):
                    coeffs[3 * k, j] += data.added[k, i, j]
        for j in range(m):
            w[_LIFT, j] = data.half_solidity[i] * w[_U, j] * coeffs[0, j]
        if data.lossy:
            if slopes:
                _times(w[_LIFT], t, d[_Z + LOSS, i])
                _times(w[_LIFT], p, d[_X + LOSS, i])
                _times(c[LOSS, i], coeffs[1], coeffs[1])
                _times(c[LOSS, i], coeffs[2], coeffs[2])
            _times(c[LOSS, i], w[_LIFT], w[_LIFT])
        for j in range(m):
            w[_DRAG, j] = data.half_solidity[i] * speed[j] * coeffs[3, j]
        _resolve(t, p, w[_LIFT], w[_DRAG], f[FZ, i], f[FX, i])
        if data.yawed:
            _times(w[_DRAG], r, f[FR, i])
        if elastic:
            _moment(c, i, data, coeffs, w, f)
        if slopes:
            _force_slopes(c, i, data, between, mach, coeffs, w, d)
            if elastic:
                _moment_slopes(c, i, data, coeffs, w, d)
        if flow:
            for j in range(m):  # Rows assigned as a whole take numba longer to compile.
                s[ALPHA, i, j], s[MACH, i, j] = alpha[j], mach[j]
                s[CL, i, j], s[CD, i, j], s[CD_MACH, i, j] = (
                    coeffs[0, j],
                    coeffs[3, j],
                    coeffs[5, j],
                )
        if masked:
            _unload(data.unloaded[i], c[TH, i], data.inertia[i] if elastic else 0.0, i, f, d, s)
    return f, d, s


@_inline
def _speeds(t: Any, p: Any, out: Any) -> None:
    """U of one row."""
    for j in range(len(out)):
        out[j] = math.sqrt(t[j] * t[j] + p[j] * p[j] + _TINY)


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
        (
            ((-8.750608600031904e-1 * s - 1.615753718733365e1) * s - 7.500855792314705e1) * s
            - 1.228866684490136e2
        )
        * s
    ) - 6.485021904942025e1
    below = (
        (((s + 2.485846490142306e1) * s + 1.650270098316989e2) * s + 4.328810604912903e2) * s
        + 4.853903996359137e2
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


@_inline
def _streamwise(theta: Any, t: Any, p: Any, r: Any, w: Any) -> bool:
    """V and the streamwise angles of one row; whether any of its drag is between those of the two edges.

    With S = U sin α and C = U cos α, α' is the arctangent of S/G or, where C < 0, π less that; G² = C² + U_R².
    """
    m, between = w.shape[1], 0
    for j in range(m):
        w[_SIN, j], w[_COS, j] = of_double_angle(0.5 * theta[j])
    for j in range(m):
        w[_S, j] = t[j] * w[_SIN, j] - p[j] * w[_COS, j]
    for j in range(m):
        w[_C, j] = t[j] * w[_COS, j] + p[j] * w[_SIN, j]
    for j in range(m):
        w[_G, j] = math.sqrt(w[_C, j] * w[_C, j] + r[j] * r[j] + _TINY)
        w[_V, j] = math.sqrt(w[_U, j] * w[_U, j] + r[j] * r[j])
    for j in range(m):
        front = arctangent(w[_S, j], w[_G, j])
        w[_STREAM, j] = front if w[_C, j] >= 0.0 else _PI - front
    for j in range(m):
        between += 1 if abs(w[_C, j]) < _FADES * w[_G, j] else 0
    return between > 0


@_inline
def _other_edge(w: Any, coeffs: Any) -> None:
    """Mix C_d of one row with that of the stream from the other edge in `_TURN`; half of each where C = 0."""
    for j in range(w.shape[1]):
        x = min(abs(w[_C, j]) / (_FADES * w[_G, j]), 1.0)
        share, drag = 0.5 - 0.25 * x * (3.0 - x * x), coeffs[_TURN, j] - coeffs[3, j]
        coeffs[3, j] += share * drag
        coeffs[4, j] -= share * (coeffs[_TURN + 1, j] + coeffs[4, j])
        coeffs[5, j] += share * (coeffs[_TURN + 2, j] - coeffs[5, j])
        coeffs[_TURN, j] = drag * (0.75 / _FADES) * (x * x - 1.0)


@_inline
def _coefficients(
    data: Any,
    i: int,
    angle: Any,
    kinds: Any,
    slopes: bool,
    cells: Any,
    places: Any,
    coeffs: Any,
    row: int,
) -> None:
    """Coefficients of one row from kinds[0] to before kinds[1], with C_m beside C_l, blended from the two sections at
    its element, each followed by ∂/∂α and ∂/∂M; cells (2, azimuths), places (3, azimuths): along Mach they are there.
    """
    gain = data.delay[i] if kinds[0] == 0 and len(data.delay) > 0 else 0.0
    for which in range(2):
        share = data.weight[i] if which == 1 else 1.0
        if share > 0.0:
            places_along_alpha(angle, data.offset[i, which], cells[0], places[0])
            table = data.section[i, which]
            look_up(data.tables, kinds, table, cells, places, share, slopes, coeffs, row)
            if kinds[0] == 0 and len(data.moment_gain) > 0:
                look_up(data.moment_tables, (0, 1), table, cells, places, share, slopes, coeffs, 6)
            if gain > 0.0:
                look_up(data.missing, (0, 1), table, cells, places, share, slopes, coeffs, _MISSING)
    if gain > 0.0:
        for k in range(3 if slopes else 1):
            for j in range(coeffs.shape[1]):
                coeffs[k, j] += gain * coeffs[_MISSING + k, j]


@_inline
def _scatter(scatter: Any, coeffs: Any) -> None:
    """Change the coefficients of one row and their derivatives."""
    for j in range(coeffs.shape[1]):
        coeffs[3, j] += scatter[EARLIER_RISE] * coeffs[5, j]
        for k in range(3):
            coeffs[k, j] *= 1.0 + scatter[MORE_LIFT]
        coeffs[6, j] += scatter[MORE_MOMENT]


@_inline
def _times(factor: Any, other: Any, out: Any) -> None:
    for j in range(len(out)):
        out[j] = factor[j] * other[j]


@_inline
def _resolve(t: Any, p: Any, lift: Any, drag: Any, z: Any, x: Any) -> None:
    """Lift and drag over U and V, or their derivatives, in axes of the shaft."""
    for j in range(len(z)):
        z[j] = lift[j] * t[j] - drag[j] * p[j]
    for j in range(len(x)):
        x[j] = lift[j] * p[j] + drag[j] * t[j]


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
def _force_slopes(
    c: Any, i: int, data: Any, between: bool, mach: Any, coeffs: Any, w: Any, d: Any
) -> None:
    """Derivatives of F_z, F_x and F_r of one row, from those of ½σU F C_l and ½σV C_d."""
    m, cos, sin, square = (
        w.shape[1],
        data.cos_sweep[i],
        data.sin_sweep[i],
        data.tip_mach * data.tip_mach,
    )
    t, p, r, half = c[UT, i], c[UP, i], c[UR, i], data.half_solidity[i]
    for j in range(m):
        by_normal = square / mach[j] * (t[j] * cos - r[j] * sin)
        w[_BY_T, j], w[_BY_R, j] = by_normal * cos, -sin * by_normal
    for j in range(m):
        w[_BY_P, j] = square / mach[j] * p[j]
    _by_air(t, p, half, w[_U], w[_LIFT], coeffs[:3], w, w[_LIFT_BY:_DRAG_BY])
    if data.yawed:
        _by_yawed_air(t, p, r, half, between, coeffs, w, w[_DRAG_BY:])
    else:
        _by_air(t, p, half, w[_U], w[_DRAG], coeffs[3:6], w, w[_DRAG_BY:])
    for k in range(4):
        lift, drag = w[_LIFT_BY + k], w[_DRAG_BY + k]
        _resolve(t, p, lift, drag, d[_Z + k, i], d[_X + k, i])
        if data.yawed:
            _times(drag, r, d[_R + k, i])
    for row, own, sign in (
        (_Z + UT, _LIFT, 1.0),
        (_X + UP, _LIFT, 1.0),
        (_Z + UP, _DRAG, -1.0),
        (_X + UT, _DRAG, 1.0),
    ):
        for j in range(m):
            d[row, i, j] += sign * w[own, j]
    for j in range(m if data.yawed else 0):
        d[_R + UR, i, j] += w[_DRAG, j]


@_inline
def _by_air(
    t: Any, p: Any, half: float, speed: Any, value: Any, coeffs: Any, w: Any, out: Any
) -> None:
    """Derivatives of ½σU C by θ, U_T, U_P and U_R, with ∂α/∂U_T = U_P/U² and ∂α/∂U_P = −U_T/U²."""
    for j in range(len(t)):
        w[_ONE, j] = half * coeffs[1, j] / speed[j]
        w[_TWO, j] = value[j] / (speed[j] * speed[j])
    for j in range(len(t)):
        w[_MACH, j] = half * speed[j] * coeffs[2, j]
        out[TH, j] = half * speed[j] * coeffs[1, j]
    for j in range(len(t)):
        out[UT, j] = w[_TWO, j] * t[j] + w[_ONE, j] * p[j] + w[_MACH, j] * w[_BY_T, j]
    for j in range(len(t)):
        out[UP, j] = w[_TWO, j] * p[j] - w[_ONE, j] * t[j] + w[_MACH, j] * w[_BY_P, j]
    _times(w[_MACH], w[_BY_R], out[UR])


@_inline
def _by_yawed_air(
    t: Any, p: Any, r: Any, half: float, between: bool, coeffs: Any, w: Any, out: Any
) -> None:
    """Those of ½σV C_d: ∂α'/∂θ = C/G, by air (C U_P + U_R² sin θ, −C U_T − U_R² cos θ, −S U_R)/(G V²)."""
    for j in range(len(t)):
        w[_ONE, j] = math.copysign(half, w[_C, j]) * coeffs[4, j] / (w[_V, j] * w[_G, j])
        w[_TWO, j] = w[_DRAG, j] / (w[_V, j] * w[_V, j])
        w[_MACH, j] = half * w[_V, j] * coeffs[5, j]
    for j in range(len(t)):
        out[TH, j] = w[_ONE, j] * w[_C, j] * (w[_V, j] * w[_V, j])
    for j in range(len(t)):
        out[UT, j] = w[_TWO, j] * t[j] + w[_ONE, j] * w[_C, j] * p[j] + w[_MACH, j] * w[_BY_T, j]
    for j in range(len(t)):
        out[UP, j] = w[_TWO, j] * p[j] - w[_ONE, j] * w[_C, j] * t[j] + w[_MACH, j] * w[_BY_P, j]
    for j in range(len(t)):
        out[UR, j] = (w[_TWO, j] - w[_ONE, j] * w[_S, j]) * r[j] + w[_MACH, j] * w[_BY_R, j]
    for j in range(len(t)):
        out[UT, j] += w[_ONE, j] * (r[j] * r[j]) * w[_SIN, j]
        out[UP, j] -= w[_ONE, j] * (r[j] * r[j]) * w[_COS, j]
    for j in range(len(t) if between else 0):
        turn = (
            math.copysign(half, w[_C, j])
            * w[_V, j]
            * coeffs[_TURN, j]
            * r[j]
            / (w[_G, j] * w[_G, j] * w[_G, j])
        )
        out[TH, j] -= turn * r[j] * w[_S, j]
        out[UT, j] += turn * r[j] * w[_COS, j]
        out[UP, j] += turn * r[j] * w[_SIN, j]
        out[UR, j] -= turn * w[_C, j]


@_inline
def _moment_slopes(c: Any, i: int, data: Any, coeffs: Any, w: Any, d: Any) -> None:
    """Derivatives of M of one row, those of −x F_z from those of F_z; coeffs: C_m and its derivatives are spent."""
    m, gain, damping, lag, inertia = (
        w.shape[1],
        data.moment_gain[i],
        data.damping[i],
        data.lag[i],
        data.inertia[i],
    )
    for k in range(6, 9):
        for j in range(m):
            coeffs[k, j] *= gain * w[_U, j] * w[_U, j]
    for j in range(m):
        d[_N + TH, i, j] = coeffs[7, j]
        over = 1.0 / (w[_U, j] * w[_U, j])
        own = over * (2.0 * coeffs[6, j] - damping * c[RATE, i, j] * w[_U, j])
        turned = over * coeffs[7, j]
        d[_N + UT, i, j] = own * c[UT, i, j] + turned * c[UP, i, j] + coeffs[8, j] * w[_BY_T, j]
        d[_N + UP, i, j] = own * c[UP, i, j] - turned * c[UT, i, j] + coeffs[8, j] * w[_BY_P, j]
        d[_N + UR, i, j] = coeffs[8, j] * w[_BY_R, j]
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
    """sin and cos of twice an angle [rad], to 4·10⁻¹⁶ (tested), without branches so that loops become vector code.

    Of the rest y after turns of π/2 with the polynomials of Cephes for |y| ≤ π/4 (S. Moshier, Methods and Programs for
    Mathematical Functions, 1989); each turn changes both signs.
    """
    turns = math.floor(angle * (2.0 / math.pi) + 0.5)
    sign = 1.0 - 2.0 * (turns - 2.0 * math.floor(0.5 * turns))
    y = (angle - turns * 1.5707963267948966) - turns * 6.123233995736766e-17
    s = y * y
    sine = 1.58962301576546568e-10 * s - 2.50507477628578073e-8
    sine = (
        (sine * s + 2.75573136213857245e-6) * s - 1.98412698295895386e-4
    ) * s + 8.33333333332211859e-3
    sine = y + y * s * (sine * s - 1.66666666666666307e-1)
    cosine = -1.13585365213876817e-11 * s + 2.08757008419747317e-9
    cosine = (
        (cosine * s - 2.75573141792967388e-7) * s + 2.48015872888517045e-5
    ) * s - 1.38888888888730564e-3
    cosine = 1.0 - 0.5 * s + s * s * (cosine * s + 4.16666666666665929e-2)
    return sign * 2.0 * sine * cosine, sign * (1.0 - 2.0 * sine * sine)


@_compile
def stall_angles(mach: Any, weight: Any, offset: Any, stall: Any) -> Any:
    """Negative and positive stall angle about the blade's reference line [rad], (2, elements, azimuths).

    stall: angles about the chord of each of the two sections of an element at the Mach knots, (elements, 2, 2, knots):
    negative end, positive end.
    """
    n, m = mach.shape
    out = np.zeros((2, n, m))
    top = stall.shape[3] - 1 - 1e-9
    cell, place, slope = np.empty(m, np.int32), np.empty(m), np.empty(m)
    for i in range(n):
        places_along_mach(mach[i], cell, place, slope)
        for which in range(2):
            share = weight[i] if which == 1 else 1.0 - weight[i]
            if share > 0.0:
                row = stall[i, which]
                for j in range(m):
                    k, v = min(cell[j], int(top)), place[j]
                    out[0, i, j] += share * (
                        row[0, k] * (1.0 - v) + row[0, k + 1] * v + offset[i, which]
                    )
                    out[1, i, j] += share * (
                        row[1, k] * (1.0 - v) + row[1, k + 1] * v + offset[i, which]
                    )
    return out


@_compile
def stall_margins(alpha: Any, mach: Any, u_t: Any, weight: Any, offset: Any, stall: Any) -> Any:
    """Angle of attack left before stall [rad], (elements, azimuths): negative when stalled, π/2 in reverse flow.

    stall: as in `stall_angles`.
    """
    low, high = stall_angles(mach, weight, offset, stall)
    out = np.empty(alpha.shape)
    for i in range(alpha.shape[0]):
        for j in range(alpha.shape[1]):
            margin = min(high[i, j] - alpha[i, j], alpha[i, j] - low[i, j])
            out[i, j] = 0.5 * _PI if u_t[i, j] < 0.0 else margin
    return out
