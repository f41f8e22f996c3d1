"""The section in unsteady attached flow: lift by the flow at three quarters of the chord, and apparent mass.

Of a thin aerofoil of half chord b whose wake is part of the inflow (Theodorsen, NACA Report 496, 1935, with C = 1; its
speed may change, Greenberg, NACA TN 1326, 1947), with the rates θ', θ'', U_T' and U_P' of the blade's own motion and of
the wind of flight, G = ½ (U_T + U)/(U² + 0.01), d = N_b b³ and a = x + b/2 from the pitch axis to the middle of the
chord,

    C_l, C_d, C_m at α + b θ' G                                      three quarters of the chord; a quarter in reverse
    w' = U_T' sin θ − U_P' cos θ + (U_T cos θ + U_P sin θ) θ' + a θ''            air through the middle of the chord
    N  = N_b b² w'             normal to the chord, in its middle               apparent mass
    S  = ¼ d (U_T + U) G θ'²   along the chord, forward                         suction of the leading edge
    M += −a N + ½ d U θ' − b d θ''/8

The last three are in units of dC_T/dr and dC_M/dr. `rotor.aero.section` has the damping −d U θ' in its moment, half of
which is in N. Suction closes the energy: a plate without friction then takes none over a cycle (tested).

The rates leave the inflow out. A gust comes to three quarters of the chord after the middle, and this delay takes away
what apparent mass would give: to first order in b its lift is the steady one in the middle (Sears, J. Aero. Sci. 8(3),
1941, at C = 1), half a semi-chord after the quarter chord, where the inflow is known.
"""

import math
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from rotor.aero.elements import BladeElements
from rotor.aero.inflow.interface import SectionInterface, places_of
from rotor.aero.section import FX, FZ, RATE, TH, UP, UT, M, SectionData, of_double_angle
from rotor.engine.memory import LagFactors
from rotor.support.arrays import Array
from rotor.support.compiled import compiled

RATES = (DTH, DUT, DUP) = tuple(range(3))
"""Channels θ'', U_T' and U_P', after those of the section within."""
SLOWEST = 0.1
"""U below which the pitch rate's share of the angle of attack no longer grows: the 0.01 in G."""
_PUSHED = (FZ, FX, M)
"""Forces that apparent mass adds to."""

_compile = compiled(error_model="numpy")


class UnsteadyData(NamedTuple):
    """Data of a section in unsteady flow; arrays by element."""

    section: SectionData
    within: Any
    """Data of the section within: this one's, or with those of dynamic stall."""
    half_chord: Array
    """b/R"""
    arm: Array
    """a"""
    mass: Array
    """N_b b²"""


@_compile
def _ahead(b: float, rate: float, t: float, p: float) -> Any:
    """b θ' G and its slopes by U_T, U_P and θ'; ½ (U_T + U) G and its slopes by U_T and U_P; U."""
    square = t * t + p * p + 1e-30
    u = math.sqrt(square)
    forward, below = 0.5 * (t + u), square + SLOWEST * SLOWEST
    g, by_t, by_p = forward / below, 0.5 * (1.0 + t / u), 0.5 * p / u
    g_t, g_p = (by_t - 2.0 * t * g) / below, (by_p - 2.0 * p * g) / below
    share = b * rate
    ahead = share * g, share * g_t, share * g_p, b * g
    return *ahead, forward * g, by_t * g + forward * g_t, by_p * g + forward * g_p, u


@_compile
def at_three_quarters(c: Any, half_chord: Any) -> Any:
    """Channels with the pitch of the flow at three quarters of the chord: of the section within."""
    out = c.copy()
    for i in range(c.shape[1]):
        for j in range(c.shape[2]):
            out[TH, i, j] += _ahead(half_chord[i], c[RATE, i, j], c[UT, i, j], c[UP, i, j])[0]
    return out


def apparent(e: BladeElements, half_chord: Array) -> Array:
    """What apparent mass adds to C_n and C_m about the quarter chord, which holds the damping of pitch, (2, …)."""
    assert e.rates is not None
    b, square = half_chord[:, None], e.u_t**2 + e.u_p**2 + SLOWEST**2
    sine, cosine = np.sin(e.theta), np.cos(e.theta)
    rise = e.rates[DUT] * sine - e.rates[DUP] * cosine + (e.u_t * cosine + e.u_p * sine) * e.rate
    normal = math.pi * b * (rise + 0.5 * b * e.rates[DTH]) / square
    turning = b * e.rate * np.sqrt(square) + 0.25 * b**2 * e.rates[DTH]
    return np.stack([normal, -0.25 * (normal + math.pi * turning / square)])


@_compile
def slopes_ahead(c: Any, half_chord: Any) -> Any:
    """Slopes of what `at_three_quarters` adds to the pitch by U_T, U_P and θ', (3, elements, azimuths)."""
    out = np.empty((3, *c.shape[1:]))
    for i in range(c.shape[1]):
        for j in range(c.shape[2]):
            values = _ahead(half_chord[i], c[RATE, i, j], c[UT, i, j], c[UP, i, j])
            out[0, i, j], out[1, i, j], out[2, i, j] = values[1], values[2], values[3]
    return out


@_compile
def _push(c: Any, first: int, blade: Any, inertia: Any, unloaded: Any, f: Any) -> None:
    """Add apparent mass and suction to the forces; inertia: j, without elements on a rigid blade."""
    half_chord, arm, mass = blade
    elastic = len(inertia) > 0
    for i in range(c.shape[1]):
        b, a = half_chord[i], arm[i]
        for j in range(c.shape[2]):
            h = 0.0 if len(unloaded) > 0 and unloaded[i, j] else mass[i]
            t, p, rate, turning = c[UT, i, j], c[UP, i, j], c[RATE, i, j], c[first + DTH, i, j]
            sine, cosine = of_double_angle(0.5 * c[TH, i, j])
            ahead, _, _, _, suction, _, _, u = _ahead(b, rate, t, p)
            rise = (
                c[first + DUT, i, j] * sine
                - c[first + DUP, i, j] * cosine
                + (t * cosine + p * sine) * rate
            )
            normal = h * (rise + a * turning)
            along = 0.5 * h * b * suction * rate * rate
            f[FZ, i, j] += normal * cosine + along * sine
            f[FX, i, j] += normal * sine - along * cosine
            if elastic:
                f[M, i, j] += 0.5 * h * b * (u * rate - 0.25 * b * turning) - a * normal
                twice = of_double_angle(c[TH, i, j] + ahead)[0] - of_double_angle(c[TH, i, j])[0]
                # The propeller moment is that of the pitch itself.
                f[M, i, j] += 0.5 * inertia[i] * twice


@_compile
def _ahead_slopes(first: int, i: int, q: Any, d: Any, rows: Any, place: Any, out: Any) -> None:
    """Derivatives of one element's section within, its pitch turned as the flow ahead turns it."""
    for o in range(len(rows)):
        through = rows[o, TH]
        for k in range(first + 3):
            at = place[o, k]
            if at < 0:
                continue
            inner = rows[o, k] if k < first else -1
            for j in range(q.shape[1]):
                out[at, i, j] = d[inner, i, j] if inner >= 0 else 0.0
            turned = 1 if k == UT else 2 if k == UP else 3 if k == RATE else 0
            if turned > 0 and through >= 0:
                for j in range(q.shape[1]):
                    out[at, i, j] += d[through, i, j] * q[turned, j]


@_compile
def _push_slopes(
    c: Any,
    first: int,
    blade: Any,
    inertia: Any,
    unloaded: Any,
    d: Any,
    rows: Any,
    place: Any,
    out: Any,
) -> None:
    """Partial derivatives of all forces by all channels; rows: those of the section within, place: those here."""
    half_chord, arm, mass = blade
    elastic = len(inertia) > 0
    m = c.shape[2]
    q, full = np.empty((8, m)), np.empty((3, first + 3, m))
    for i in range(c.shape[1]):
        b, a = half_chord[i], arm[i]
        for j in range(m):
            q[0, j], q[1, j], q[2, j], q[3, j], q[4, j], q[5, j], q[6, j], q[7, j] = _ahead(
                b, c[RATE, i, j], c[UT, i, j], c[UP, i, j]
            )
        _ahead_slopes(first, i, q, d, rows, place, out)
        full[:] = 0.0
        for j in range(m):
            h = 0.0 if len(unloaded) > 0 and unloaded[i, j] else mass[i]
            t, p, rate, turning = c[UT, i, j], c[UP, i, j], c[RATE, i, j], c[first + DTH, i, j]
            faster, sinking = c[first + DUT, i, j], c[first + DUP, i, j]
            sine, cosine = of_double_angle(0.5 * c[TH, i, j])
            by_theta = faster * cosine + sinking * sine + (p * cosine - t * sine) * rate
            across = t * cosine + p * sine
            normal = h * (faster * sine - sinking * cosine + across * rate + a * turning)
            half = 0.5 * h * b
            along, by_rate = half * q[4, j] * rate * rate, 2.0 * half * q[4, j] * rate
            by_t, by_p = half * q[5, j] * rate * rate, half * q[6, j] * rate * rate
            for o in range(2):
                up, on = (cosine, sine) if o == 0 else (sine, -cosine)
                full[o, TH, j] = h * by_theta * up + (
                    along * cosine - normal * sine if o == 0 else 0.0
                )
                if o == 1:
                    full[o, TH, j] += normal * cosine + along * sine
                full[o, UT, j] = h * cosine * rate * up + by_t * on
                full[o, UP, j] = h * sine * rate * up + by_p * on
                full[o, RATE, j] = h * across * up + by_rate * on
                full[o, first + DTH, j] = h * a * up
                full[o, first + DUT, j] = h * sine * up
                full[o, first + DUP, j] = -h * cosine * up
            if elastic:
                u, stiff = q[7, j], inertia[i]
                turn = stiff * of_double_angle(c[TH, i, j] + q[0, j])[1]
                full[2, TH, j] = turn - stiff * of_double_angle(c[TH, i, j])[1] - a * h * by_theta
                full[2, UT, j] = turn * q[1, j] + half * rate * t / u - a * h * cosine * rate
                full[2, UP, j] = turn * q[2, j] + half * rate * p / u - a * h * sine * rate
                full[2, RATE, j] = turn * q[3, j] + half * u - a * h * across
                full[2, first + DTH, j] = -0.25 * half * b - a * a * h
                full[2, first + DUT, j] = -a * h * sine
                full[2, first + DUP, j] = a * h * cosine
        for o in range(3):
            force = FZ if o == 0 else FX if o == 1 else M
            for k in range(first + 3):
                at = place[force, k]
                if at >= 0:
                    for j in range(m):
                        out[at, i, j] += full[o, k, j]


@lru_cache(maxsize=8)
def unsteady_interface(inner: SectionInterface) -> SectionInterface:
    """The interface of a section in unsteady attached flow."""
    first, channels = inner.channels, inner.channels + len(RATES)
    turned = sorted({force for force, channel in inner.pairs if channel == TH})
    new = [
        (force, channel)
        for force in turned
        for channel in (UT, UP, RATE)
        if (force, channel) not in inner.pairs
    ]
    pairs = (*inner.pairs, *new, *((force, first + rate) for force in _PUSHED for rate in RATES))
    rows, place = (
        places_of(inner.pairs, inner.forces, first),
        places_of(pairs, inner.forces, channels),
    )

    def section(
        c: Array, data: UnsteadyData, slopes: bool, flow: bool
    ) -> tuple[Array, Array, Array]:
        f, d, s = inner.section(
            at_three_quarters(c[:first], data.half_chord), data.within, slopes, flow
        )
        of = (data.half_chord, data.arm, data.mass), data.section.inertia, data.section.unloaded
        _push(c, first, *of, f)
        partials = np.empty((len(pairs), *(c.shape[1:] if slopes else (0, c.shape[2]))))
        if slopes:
            _push_slopes(c, first, *of, d, rows, place, partials)
        return f, partials, s

    def memory(c: Array, data: UnsteadyData) -> LagFactors:
        """That of the section within, its pitch turned."""
        assert inner.memory is not None
        within = inner.memory(at_three_quarters(c[:first], data.half_chord), data.within)
        right = np.concatenate(
            [within.right, np.zeros((len(within.right), len(RATES), *c.shape[1:]))], axis=1
        )
        for channel, slope in zip((UT, UP, RATE), slopes_ahead(c, data.half_chord), strict=True):
            right[:, channel] += within.right[:, TH] * slope
        return LagFactors(within.left, within.lags, right)

    remembers = None if inner.memory is None else memory
    return SectionInterface(section, pairs, channels, inner.forces, inner.balanced, remembers)
