"""Dynamic stall of a blade element: what its coefficients have beyond the static ones, periodic around the azimuth.

After Leishman and Beddoes (J. AHS 34(3), 1989) and, for sections of any data, Hansen, Gaunaa and Madsen (Risø-R-1354,
2004). x: angle from zero lift; s: travel in semi-chords b; q = b θ'/U; V: speed across the blade over ΩR.

    x_E = x + q, where no vortex wake sheds lagged by Jones' function       angle at three quarters of the chord
    C_nᴵ = π d(x + ½q)/ds                                                   apparent mass, by the middle of the chord
    x_f = lag(x_E + C_nᴵ/C_nα, T_p)                                         pressure at the leading edge
    f″ = lag(f(x_f), T_f),   m″ = lag(m(x_f), T_f)                          separation point, place of the force
    g(x_f)                                                                  0 below, 1 above the force of static stall
    C_nᵛ: T_v dC_nᵛ/ds + C_nᵛ = T_v h d/ds [C_nα x_E (1 − K(f″))],   h = g(s) (1 − g(s − T_vl))
    τ = (1/T_vl) ∫ g over the last 2 T_vl                                   how far the vortex has travelled

    C_n − static = C_nα [x_E K(f″) − x K(f)] + C_nᵛ + C_nᴵ
    C_c − static = C_nα [x_E² √f″ − x² √f]                                  along the chord, forward
    C_m − static = C_nα [x_E K(f″) m″ − x K(f) m] − 0.2 (1 − cos πτ) C_nᵛ − ¼ (C_nᴵ + ¼π dq/ds − π q)

so that at rest nothing is added. f(x), m(x): `rotor.airfoil.stall_onset`. Every stage is a linear lag whose
coefficients the stages before it give: its periodic solution is exact after one turn, and so are its derivatives. The
last term leaves out the pitch rate, whose moment `rotor.aero.section` has. Apparent mass and its moment are
Theodorsen's (NACA Report 496, 1935).

Choices of ours: g rises over ±4 % of x_f, where Leishman and Beddoes switch; T_f and T_v stay the same in all phases;
one vortex leaves in each stall. Beyond 25° x fades out to 50°, and what is added with it: in deep stall and in reverse
flow sections are static.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from rotor.aero.look_up import look_up, places_along_alpha, places_along_mach
from rotor.airfoil.stall_onset import (
    LAG_PRESSURE,
    LAG_SEPARATION,
    LAG_VORTEX,
    NEGATIVE,
    POSITIVE,
    SLOPE,
    TRAVEL,
)
from rotor.arrays import Array, Integers
from rotor.compiled import compiled

INPUTS = (ANGLE, MACH_NUMBER, PITCH_RATE) = tuple(range(3))
"""x, M and q."""
ADDED = (ADDED_N, ADDED_C, ADDED_M) = tuple(range(3))
"""C_n, C_c and C_m less the static ones."""
STATES = (SEPARATION, VORTEX, POSITION, ONSET_GATE) = tuple(range(4))
"""What is shown: f″, C_nᵛ, τ and g."""
FULL, GONE = math.radians(25.0), math.radians(50.0)
"""Angles from zero lift up to which, and from which nothing of, the unsteady part counts."""
SLOWEST = 0.1
"""V below which apparent mass and pitch rate no longer grow."""
_GATE = 0.04
_ARM = 0.2
_LEAST_FINE = 96
"""Azimuths on which the lags are followed: 15° are up to eight semi-chords of travel."""
_JONES = ((0.165, 0.0455), (0.335, 0.3))
"""Amplitudes and rates of the response to a step (R. T. Jones, NACA Report 681, 1940)."""
_PI = math.pi

_compile = compiled(error_model="numpy", fastmath={"contract"})


class StallData(NamedTuple):
    """What dynamic stall needs beside x, M and q."""

    numbers: Array
    """`StallOnset.numbers` of every element, (elements, 8, Mach nodes); zero lift about the blade's reference line."""
    tables: Array
    """f and m, (sections, α cells, Mach cells, 2, 4, 4)."""
    section: Integers
    weight: Array
    half_chord: Array
    """b/R, (elements,)."""
    tip_mach: float
    sheds: bool
    """Whether a vortex wake sheds; if not, lift follows by Jones' function."""


@_compile
def window(y: float) -> Any:
    """By which x is weighted at y from zero lift, and its slope."""
    u = (abs(y) - FULL) / (GONE - FULL)
    if u <= 0.0:
        return 1.0, 0.0
    if u >= 1.0:
        return 0.0, 0.0
    return 1.0 - u * u * (3.0 - 2.0 * u), -6.0 * u * (1.0 - u) / (GONE - FULL) * (1.0 if y > 0.0 else -1.0)


@_compile
def _spread(coarse: Any, steps: int, out: Any) -> None:
    """Linear between azimuths, onto finer ones."""
    n = len(coarse)
    for k in range(len(out)):
        c, w = k // steps, (k % steps) / steps
        out[k] = (1.0 - w) * coarse[c] + w * coarse[(c + 1) % n]


@_compile
def _around(decay: Any, z: Any) -> None:
    """z[k + 1] = decay[k] z[k] + given[k], periodic, where z holds what is given: (azimuths, columns), in place."""
    n, columns = z.shape
    value, rest = np.zeros(columns), 1.0
    for k in range(n):  # First from zero: what is left of a start after one turn is known.
        rest *= decay[k]
        for j in range(columns):
            value[j] = decay[k] * value[j] + z[k, j]
    for j in range(columns):
        value[j] /= 1.0 - rest
    for k in range(n):
        for j in range(columns):
            given = z[k, j]
            z[k, j] = value[j]
            value[j] = decay[k] * value[j] + given


@_compile
def _lag(u: Any, du: Any, h: Any, by_mach: Any, dm: Any, z: Any, dz: Any) -> None:
    """z of dz/ds = (u − z)/T, periodic, exact for an input that is linear in s within every step.

    h: step over T; by_mach: its slope by the sum of the Mach numbers at its ends; d…: slopes by the seeds.
    """
    n, seeds = du.shape
    rates = np.empty((n, 5))
    for k in range(n):
        e = math.exp(-h[k])
        if h[k] > 1e-4:
            phi = (1.0 - e) / h[k]
            by = (e - phi) / h[k]
        else:
            phi, by = 1.0 - 0.5 * h[k], -0.5 + h[k] / 3.0
        rates[k, 0], rates[k, 1], rates[k, 2] = e, phi - e, 1.0 - phi
        rates[k, 3], rates[k, 4] = by + e, -by
        z[k] = rates[k, 1] * u[k] + rates[k, 2] * u[(k + 1) % n]
    decay = rates[:, 0]
    _around(decay, z.reshape(n, 1))
    for k in range(n if seeds else 0):
        one = (k + 1) % n
        a, b = rates[k, 1], rates[k, 2]
        by = (-decay[k] * z[k] + rates[k, 3] * u[k] + rates[k, 4] * u[one]) * by_mach[k]
        for j in range(seeds):
            dz[k, j] = a * du[k, j] + b * du[one, j] + by * (dm[k, j] + dm[one, j])
    _around(decay, dz)


@_compile
def _steps(row: Any, fine: Any, mach: Any, unit: float, h: Any, by_mach: Any) -> None:
    """Steps over a lag time, and their slopes by the sum of the Mach numbers at their ends.

    row: the lag time at the mean Mach numbers of the steps and its slope, (2, steps). unit: travel over the sum.
    """
    n = len(mach)
    for k in range(n):
        h[k] = unit * (mach[k] + mach[(k + 1) % n]) / row[0, k]
        by_mach[k] = (unit - h[k] * 0.5 * row[1, k]) / row[0, k]


@_compile
def _gate(x: float, onset: float) -> Any:
    """0 below, 1 above x = onset, smoothly over ±4 %; slopes by x and onset."""
    u = (x / onset - 1.0 + _GATE) / (2.0 * _GATE)
    if u <= 0.0 or u >= 1.0:
        return (0.0 if u <= 0.0 else 1.0), 0.0, 0.0
    by = 6.0 * u * (1.0 - u) / (2.0 * _GATE)
    return u * u * (3.0 - 2.0 * u), by / onset, -by * x / (onset * onset)


@_compile
def _kirchhoff(f: float) -> Any:
    """K and √f with their slopes by f."""
    root = math.sqrt(f)
    return 0.25 * (1.0 + root) ** 2, 0.25 * (1.0 + 1.0 / root), root, 0.5 / root


@_compile
def _combine(to: Any, a: float, one: Any, b: float, two: Any) -> None:
    for j in range(len(to)):
        to[j] = a * one[j] + b * two[j]


@_compile
def _add(to: Any, a: float, one: Any) -> None:
    for j in range(len(to)):
        to[j] += a * one[j]


@_compile
def _before(distance: Any, back: float, k: int) -> Any:
    """The step in which the flow was `back` semi-chords before azimuth k, how far in it, and how many turns before."""
    n = len(distance) - 1
    total = distance[n]
    at, turns = distance[k] - back, 0
    while at < 0.0:
        at += total
        turns += 1
    low, high = 0, n
    while high - low > 1:
        middle = (low + high) // 2
        if distance[middle] <= at:
            low = middle
        else:
            high = middle
    return low, (at - distance[low]) / (distance[low + 1] - distance[low]), turns


@_compile
def _along(one: int, tables: Any, section: Any, weight: float, cells: Any, places: Any, x: Any, found: Any) -> None:
    """f and m of one row, blended from the two sections of an element, with slopes; Mach cells are there."""
    places_along_alpha(x, 0.0, cells[0], places[0])
    for which in range(2):
        share = weight if which == 1 else 1.0
        if share > 0.0:
            look_up(tables, section[one, which], cells, places, share, True, found)


@_compile
def _over_mach(numbers: Any, first: int, end: int, cell: Any, places: Any, rows: Any) -> None:
    """Some of the numbers and their slopes by the Mach number."""
    for r in range(first, end):
        for k in range(len(cell)):
            low, high = numbers[r, cell[k]], numbers[r, cell[k] + 1]
            rows[r, 0, k] = low + (high - low) * places[1, k]
            rows[r, 1, k] = (high - low) * places[2, k]


@_compile
def follow(one: int, x: Any, mach: Any, q: Any, data: Any, slopes: bool, added: Any, by: Any, shown: Any) -> None:
    """One element: `ADDED`, (3, azimuths), and `STATES`, (4, azimuths), from x, M and q, (azimuths,) each.

    by: slopes by these at all azimuths, (3, azimuths, 3 azimuths), only where asked for, else without the last.
    """
    n = len(x)
    steps = max(1, -(-_LEAST_FINE // n))
    fine, seeds = n * steps, 3 * n if slopes else 0
    b, tip = data.half_chord[one], data.tip_mach
    unit = math.pi / fine / (b * tip)  # Travel in a step over the sum of the Mach numbers at its ends.
    every = np.zeros((5, fine, seeds))
    dx, dm, de, dp, df = every[0], every[1], every[2], every[3], every[4]
    xs, ms, es, ps = np.empty(fine), np.empty(fine), np.empty(fine), np.empty(fine)
    _spread(x, steps, xs)
    _spread(mach, steps, ms)
    _seed(n, steps, dx, dm)
    cells, places, found = np.empty((2, fine), np.int32), np.empty((3, fine)), np.zeros((6, fine))
    rows = np.empty((8, 2, fine))
    _numbers(data.numbers[one], ms, cells, places, rows)
    mass, turning = np.empty(n), np.empty(n)
    dmass, dturning = np.zeros((n, seeds)), np.zeros((n, seeds))
    _apparent_mass(x, mach, q, b, tip, mass, turning, dmass, dturning)
    _three_quarters(x, q, mass, steps, dx, dmass, es, ps, de, dp)
    if not data.sheds:
        _lift_deficiency(ms, dm, unit, es, de)
    xf, dxf = np.empty(fine), np.empty((fine, seeds))
    _leading_edge(rows, ms, dm, unit, es, de, ps, dp, xf, dxf)
    _along(one, data.tables, data.section, data.weight[one], cells, places, xf, found)
    f, dfs, m, dms = np.empty(fine), np.empty((fine, seeds)), np.empty(fine), np.empty((fine, seeds))
    _separation(rows, ms, dm, unit, found, dxf, df, f, dfs, m, dms)
    g, dg = np.empty(fine), dxf
    _onset(rows, xf, dxf, dm, g, dg)
    cv, tau = np.zeros(fine), np.zeros(fine)
    dcv, dtau = np.zeros((fine, seeds)), np.zeros((fine, seeds))
    if g.max() > 0.0:
        _vortex(rows, ms, dm, es, de, f, dfs, g, dg, unit, cv, dcv, tau, dtau)
    _along(one, data.tables, data.section, data.weight[one], cells, places, xs, found)
    added[:] = 0.0
    by[:] = 0.0
    shown[:] = 0.0
    _sum_up(rows, steps, found, xs, es, f, m, cv, tau, dx, dm, de, dfs, dms, dcv, dtau, added, by)
    for k in range(n):
        added[ADDED_N, k] += mass[k]
        added[ADDED_M, k] -= 0.25 * (mass[k] + 0.25 * turning[k] - _PI * q[k])
        at = k * steps
        shown[SEPARATION, k], shown[VORTEX, k], shown[POSITION, k], shown[ONSET_GATE, k] = f[at], cv[at], tau[at], g[at]
        if seeds:
            _add(by[ADDED_N, k], 1.0, dmass[k])
            _add(by[ADDED_M, k], -0.25, dmass[k])
            _add(by[ADDED_M, k], -0.0625, dturning[k])
            by[ADDED_M, k, 2 * n + k] += 0.25 * _PI


@_compile
def _seed(n: int, steps: int, dx: Any, dm: Any) -> None:
    """Slopes of x and M on the finer azimuths by those at the azimuths given."""
    fine, seeds = dx.shape
    for k in range(fine if seeds else 0):
        c, w = k // steps, (k % steps) / steps
        after = (c + 1) % n
        dx[k, c] += 1.0 - w
        dx[k, after] += w
        dm[k, n + c] += 1.0 - w
        dm[k, n + after] += w


@_compile
def _numbers(numbers: Any, ms: Any, cells: Any, places: Any, rows: Any) -> None:
    """The element's numbers at its Mach numbers, with slopes: those of lags in the middle of every step.

    The Mach cells and places that are left are those of the azimuths themselves.
    """
    fine = len(ms)
    middle = np.empty(fine)
    for k in range(fine):
        middle[k] = 0.5 * (ms[k] + ms[(k + 1) % fine])
    places_along_mach(middle, cells[1], places[1], places[2])
    _over_mach(numbers, LAG_PRESSURE, TRAVEL, cells[1], places, rows)
    places_along_mach(ms, cells[1], places[1], places[2])
    _over_mach(numbers, 0, LAG_PRESSURE, cells[1], places, rows)
    _over_mach(numbers, TRAVEL, TRAVEL + 1, cells[1], places, rows)


@_compile
def _apparent_mass(
    x: Any, mach: Any, q: Any, b: float, tip: float, mass: Any, turning: Any, dmass: Any, dturning: Any
) -> None:
    """C_nᴵ and π dq/ds at the azimuths given, by differences of fourth order, and their slopes."""
    n, seeds = dmass.shape
    quarter = n / (2.0 * _PI) / 12.0
    for k in range(n):
        v = mach[k] / tip
        slow = b * v / (v * v + SLOWEST * SLOWEST)
        turning[k] = _PI * slow * quarter * (8.0 * (q[(k + 1) % n] - q[k - 1]) - q[(k + 2) % n] + q[k - 2])
        rise = quarter * (8.0 * (x[(k + 1) % n] - x[k - 1]) - x[(k + 2) % n] + x[k - 2])
        mass[k] = _PI * slow * rise + 0.5 * turning[k]
    for k in range(n if seeds else 0):
        v = mach[k] / tip
        below = v * v + SLOWEST * SLOWEST
        slow = b * v / below
        for step, factor in ((1, 8.0), (-1, -8.0), (2, -1.0), (-2, 1.0)):
            at = (k + step) % n
            dmass[k, at] += _PI * slow * quarter * factor
            dmass[k, 2 * n + at] += 0.5 * _PI * slow * quarter * factor
            dturning[k, 2 * n + at] += _PI * slow * quarter * factor
        if v > 1e-12:
            by_mach_number = b * (below - 2.0 * v * v) / (below * below) / tip / slow
            dmass[k, n + k] += mass[k] * by_mach_number
            dturning[k, n + k] += turning[k] * by_mach_number


@_compile
def _three_quarters(
    x: Any, q: Any, mass: Any, steps: int, dx: Any, dmass: Any, es: Any, ps: Any, de: Any, dp: Any
) -> None:
    """x + q and C_nᴵ on the finer azimuths, and their slopes."""
    n = len(x)
    raw = np.empty(n)
    for k in range(n):
        raw[k] = x[k] + q[k]
    _spread(raw, steps, es)
    _spread(mass, steps, ps)
    fine, seeds = dx.shape
    for k in range(fine if seeds else 0):
        c, w = k // steps, (k % steps) / steps
        after = (c + 1) % n
        de[k] = dx[k]
        de[k, 2 * n + c] += 1.0 - w
        de[k, 2 * n + after] += w
        _combine(dp[k], 1.0 - w, dmass[c], w, dmass[after])


@_compile
def _lift_deficiency(ms: Any, dm: Any, unit: float, es: Any, de: Any) -> None:
    """x_E in place of x + q: lagged by Jones' function."""
    fine, seeds = dm.shape
    h, by_mach = np.empty(fine), np.empty(fine)
    lag = np.ones((2, fine))
    lag[1] = 0.0
    total, dtotal = np.zeros(fine), np.zeros((fine, seeds))
    z, dz = np.empty(fine), np.empty((fine, seeds))
    share = 1.0
    for amplitude, rate in _JONES:
        lag[0] = 1.0 / rate
        _steps(lag, fine, ms, unit, h, by_mach)
        _lag(es, de, h, by_mach, dm, z, dz)
        share -= amplitude
        for k in range(fine):
            total[k] += amplitude * z[k]
            _add(dtotal[k], amplitude, dz[k])
    for k in range(fine):
        es[k] = share * es[k] + total[k]
        _combine(de[k], share, de[k], 1.0, dtotal[k])


@_compile
def _leading_edge(
    rows: Any, ms: Any, dm: Any, unit: float, es: Any, de: Any, ps: Any, dp: Any, xf: Any, dxf: Any
) -> None:
    """x_f with its slopes; ps, C_nᴵ before, is x_E + C_nᴵ/C_nα after."""
    fine = len(ms)
    for k in range(fine):
        slope, by_m = rows[SLOPE, 0, k], rows[SLOPE, 1, k]
        _combine(dp[k], 1.0 / slope, dp[k], 1.0, de[k])
        _add(dp[k], -ps[k] * by_m / (slope * slope), dm[k])
        ps[k] = es[k] + ps[k] / slope
    h, by_mach = np.empty(fine), np.empty(fine)
    _steps(rows[LAG_PRESSURE], fine, ms, unit, h, by_mach)
    _lag(ps, dp, h, by_mach, dm, xf, dxf)


@_compile
def _separation(
    rows: Any, ms: Any, dm: Any, unit: float, found: Any, dxf: Any, df: Any, f: Any, dfs: Any, m: Any, dms: Any
) -> None:
    """f″ and m″ with their slopes; df is overwritten."""
    fine = len(ms)
    h, by_mach = np.empty(fine), np.empty(fine)
    _steps(rows[LAG_SEPARATION], fine, ms, unit, h, by_mach)
    for k in range(fine):
        _combine(df[k], found[1, k], dxf[k], found[2, k], dm[k])
    _lag(found[0], df, h, by_mach, dm, f, dfs)
    for k in range(fine):
        _combine(df[k], found[4, k], dxf[k], found[5, k], dm[k])
    _lag(found[3], df, h, by_mach, dm, m, dms)


@_compile
def _onset(rows: Any, xf: Any, dxf: Any, dm: Any, g: Any, dg: Any) -> None:
    """g with its slopes; dg may be dxf."""
    for k in range(len(xf)):
        edge = POSITIVE if xf[k] > 0.0 else NEGATIVE
        g[k], by_x, by_onset = _gate(xf[k], rows[edge, 0, k])
        _combine(dg[k], by_x, dxf[k], by_onset * rows[edge, 1, k], dm[k])


@_compile
def _sum_up(
    rows: Any, steps: int, found: Any, xs: Any, es: Any, f: Any, m: Any, cv: Any, tau: Any, dx: Any, dm: Any, de: Any,
    dfs: Any, dms: Any, dcv: Any, dtau: Any, added: Any, by: Any,
) -> None:  # fmt: skip
    """What is added, but for apparent mass, brought back to the azimuths given."""
    fine, seeds = dx.shape
    n = fine // steps
    row = np.empty((3, seeds))
    value = np.empty(3)
    for k in range(fine):
        slope, by_m = rows[SLOPE, 0, k], rows[SLOPE, 1, k]
        now, by_now, root, by_root = _kirchhoff(f[k])
        rest, by_rest, own, by_own = _kirchhoff(found[0, k])
        xe, y, at, mm = es[k], xs[k], m[k], found[3, k]
        arm = _ARM * (1.0 - math.cos(_PI * tau[k]))
        value[0] = slope * (xe * now - y * rest) + cv[k]
        value[1] = slope * (xe * xe * root - y * y * own)
        value[2] = slope * (xe * now * at - y * rest * mm) - arm * cv[k]
        if seeds:
            by_arm = _ARM * _PI * math.sin(_PI * tau[k])
            for j in range(seeds):
                dxe, dy, dmach = de[k, j], dx[k, j], dm[k, j]
                dnow, droot = by_now * dfs[k, j], by_root * dfs[k, j]
                dfound = found[1, k] * dy + found[2, k] * dmach
                dmm = found[4, k] * dy + found[5, k] * dmach
                drest, down = by_rest * dfound, by_own * dfound
                dn = dxe * now + xe * dnow
                ds = dy * rest + y * drest
                row[0, j] = slope * (dn - ds) + by_m * (xe * now - y * rest) * dmach + dcv[k, j]
                row[1, j] = slope * (2.0 * xe * dxe * root + xe * xe * droot - 2.0 * y * dy * own - y * y * down)
                row[1, j] += by_m * (xe * xe * root - y * y * own) * dmach
                row[2, j] = slope * (dn * at + xe * now * dms[k, j] - ds * mm - y * rest * dmm)
                row[2, j] += by_m * (xe * now * at - y * rest * mm) * dmach
                row[2, j] -= arm * dcv[k, j] + by_arm * cv[k] * dtau[k, j]
        c, w = k // steps, (k % steps) / steps
        after = (c + 1) % n
        for o in range(3):
            added[o, c] += (1.0 - w) / steps * value[o]
            added[o, after] += w / steps * value[o]
            if seeds:
                _add(by[o, c], (1.0 - w) / steps, row[o])
                _add(by[o, after], w / steps, row[o])


@_compile
def _vortex(
    rows: Any, ms: Any, dm: Any, es: Any, de: Any, f: Any, df: Any, g: Any, dg: Any, unit: float, cv: Any, dcv: Any,
    tau: Any, dtau: Any,
) -> None:  # fmt: skip
    """C_nᵛ and τ with their slopes."""
    n, seeds = dm.shape
    s, ds = np.zeros(n + 1), np.zeros((n + 1, seeds))
    total, dtotal = np.zeros(n + 1), np.zeros((n + 1, seeds))  # ∫ g ds
    for k in range(n):
        one = (k + 1) % n
        step, mean = unit * (ms[k] + ms[one]), 0.5 * (g[k] + g[one])
        s[k + 1], total[k + 1] = s[k] + step, total[k] + mean * step
        for j in range(seeds):
            by_step = unit * (dm[k, j] + dm[one, j])
            ds[k + 1, j] = ds[k, j] + by_step
            dtotal[k + 1, j] = dtotal[k, j] + mean * by_step + 0.5 * step * (dg[k, j] + dg[one, j])
    feed, dfeed = np.empty(n), np.empty((n, seeds))  # C_nα x_E (1 − K)
    h, dh = np.empty(n), np.empty((n, seeds))
    for k in range(n):
        slope, by_m = rows[SLOPE, 0, k], rows[SLOPE, 1, k]
        now, by_now, _, _ = _kirchhoff(f[k])
        feed[k] = slope * es[k] * (1.0 - now)
        _combine(dfeed[k], slope * (1.0 - now), de[k], -slope * es[k] * by_now, df[k])
        _add(dfeed[k], by_m * es[k] * (1.0 - now), dm[k])
        time, by_time = rows[TRAVEL, 0, k], rows[TRAVEL, 1, k]
        j0, w, back = _before(s, time, k)
        j1, step = (j0 + 1) % n, s[j0 + 1] - s[j0]
        before = (1.0 - w) * g[j0] + w * g[j1]
        h[k] = g[k] * (1.0 - before)
        change = g[j1] - g[j0]
        low, v, turns = _before(s, 2.0 * time, k)
        high, wide = (low + 1) % n, s[low + 1] - s[low]
        rise = g[high] - g[low]
        inside = v * g[low] + 0.5 * v * v * rise
        tau[k] = (total[k] + turns * total[n] - total[low] - wide * inside) / time
        for j in range(seeds):
            by_w = ds[k, j] + back * ds[n, j] - by_time * dm[k, j] - ds[j0, j] - w * (ds[j0 + 1, j] - ds[j0, j])
            dbefore = (1.0 - w) * dg[j0, j] + w * dg[j1, j] + change / step * by_w
            dh[k, j] = dg[k, j] * (1.0 - before) - g[k] * dbefore
            dwide = ds[low + 1, j] - ds[low, j]
            by_v = ds[k, j] + turns * ds[n, j] - 2.0 * by_time * dm[k, j] - ds[low, j] - v * dwide
            dinside = v * dg[low, j] + 0.5 * v * v * (dg[high, j] - dg[low, j])
            whole = dtotal[k, j] + turns * dtotal[n, j] - dtotal[low, j]
            whole -= dwide * inside + wide * dinside + (g[low] + v * rise) * by_v
            dtau[k, j] = (whole - tau[k] * by_time * dm[k, j]) / time
    steps, by_mach = np.empty(n), np.empty(n)
    _steps(rows[LAG_VORTEX], n, ms, unit, steps, by_mach)
    decay = np.exp(-steps)
    for k in range(n):
        one = (k + 1) % n
        cv[k] = math.sqrt(decay[k]) * 0.5 * (h[k] + h[one]) * (feed[one] - feed[k])
    _around(decay, cv.reshape(n, 1))
    for k in range(n if seeds else 0):
        one = (k + 1) % n
        root, mean, grown = math.sqrt(decay[k]), 0.5 * (h[k] + h[one]), feed[one] - feed[k]
        by = -(decay[k] * cv[k] + 0.5 * root * mean * grown) * by_mach[k]
        for j in range(seeds):
            by_mean = 0.5 * (dh[k, j] + dh[one, j])
            dcv[k, j] = root * (by_mean * grown + mean * (dfeed[one, j] - dfeed[k, j])) + by * (dm[k, j] + dm[one, j])
    _around(decay, dcv)
