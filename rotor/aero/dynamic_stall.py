"""Dynamic stall of a blade element: what its coefficients have beyond attached flow, periodic around the azimuth.

After Leishman and Beddoes (J. AHS 34(3), 1989) and, for sections of any data, Hansen, Gaunaa and Madsen (Risø-R-1354,
2004). x: angle from zero lift of the flow at three quarters of the chord (`rotor.aero.unsteady_section`); s: travel in
semi-chords b.

    x_f = lag(x, T_p)                                                       pressure at the leading edge
    f″ = lag(f(x_f), T_f),   m″ = lag(m(x_f), T_f)                          separation point, place of the force
    g(x_f)                                                                  0 below, 1 above the force of static stall
    C_nᵛ: T_v dC_nᵛ/ds + C_nᵛ = T_v h d/ds [C_nα x (1 − K(f″))],   h = g(s) (1 − g(s − T_vl))
    τ = (1/T_vl) ∫ g over the last 2 T_vl                                   how far the vortex has travelled

    C_n − static = C_nα x [K(f″) − K(f)] + C_nᵛ
    C_c − static = C_nα x² [√f″ − √f]                                       along the chord, forward
    C_m − static = C_nα x [K(f″) m″ − K(f) m] − 0.2 (1 − cos πτ) C_nᵛ

so that at rest nothing is added. f(x), m(x): `rotor.airfoil.stall_onset`. Every stage is a linear lag whose
coefficients the stages before it give: its periodic solution is exact after one turn, and so are its derivatives.

Choices of ours: g rises over ±4 % of x_f, where Leishman and Beddoes switch; T_f and T_v stay the same in all phases;
one vortex leaves in each stall; what apparent mass adds to the pressure at the leading edge is left out. Beyond 25° x
fades out to 50°, and what is added with it: in deep stall and in reverse flow sections are static.
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

INPUTS = (ANGLE, MACH_NUMBER) = tuple(range(2))
"""x and M."""
ADDED = (ADDED_N, ADDED_C, ADDED_M) = tuple(range(3))
"""C_n, C_c and C_m less the static ones."""
STATES = (SEPARATION, VORTEX, POSITION, ONSET_GATE) = tuple(range(4))
"""What is shown: f″, C_nᵛ, τ and g."""
FULL, GONE = math.radians(25.0), math.radians(50.0)
"""Angles from zero lift up to which, and from which nothing of, the unsteady part counts."""
_GATE = 0.04
_ARM = 0.2
_LEAST_FINE = 96
"""Azimuths on which the lags are followed: 15° are up to eight semi-chords of travel."""
_PI = math.pi

_compile = compiled(error_model="numpy")


@_compile
def spread(coarse: Any, steps: int, out: Any) -> None:
    """Linear between azimuths, onto finer ones."""
    n = len(coarse)
    for k in range(len(out)):
        c, w = k // steps, (k % steps) / steps
        out[k] = (1.0 - w) * coarse[c] + w * coarse[(c + 1) % n]


@_compile
def around(decay: Any, z: Any) -> None:
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
def lag(u: Any, du: Any, h: Any, by_mach: Any, dm: Any, z: Any, dz: Any) -> None:
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
    around(decay, z.reshape(n, 1))
    for k in range(n if seeds else 0):
        after = (k + 1) % n
        a, b = rates[k, 1], rates[k, 2]
        by = (-decay[k] * z[k] + rates[k, 3] * u[k] + rates[k, 4] * u[after]) * by_mach[k]
        for j in range(seeds):
            dz[k, j] = a * du[k, j] + b * du[after, j] + by * (dm[k, j] + dm[after, j])
    around(decay, dz)


@_compile
def lag_steps(row: Any, fine: Any, mach: Any, unit: float, h: Any, by_mach: Any) -> None:
    """Steps over a lag time, and their slopes by the sum of the Mach numbers at their ends.

    row: the lag time at the mean Mach numbers of the steps and its slope, (2, steps). unit: travel over the sum.
    """
    n = len(mach)
    for k in range(n):
        h[k] = unit * (mach[k] + mach[(k + 1) % n]) / row[0, k]
        by_mach[k] = (unit - h[k] * 0.5 * row[1, k]) / row[0, k]


class StallData(NamedTuple):
    """What dynamic stall needs beside x and M."""

    numbers: Array
    """`StallOnset.numbers` of every element, (elements, 8, Mach nodes); zero lift about the blade's reference line."""
    tables: Array
    """f and m, (sections, α cells, Mach cells, 2, 4, 4)."""
    section: Integers
    weight: Array
    half_chord: Array
    """b/R, (elements,)."""
    tip_mach: float


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
def _combine(to: Any, a: float, first: Any, b: float, second: Any) -> None:
    for j in range(len(to)):
        to[j] = a * first[j] + b * second[j]


@_compile
def _add(to: Any, a: float, row: Any) -> None:
    for j in range(len(to)):
        to[j] += a * row[j]


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
def _along(element: int, tables: Any, section: Any, weight: float, cells: Any, places: Any, x: Any, fm: Any) -> None:
    """f and m of one row, blended from the two sections of an element, with slopes; Mach cells are there."""
    places_along_alpha(x, 0.0, cells[0], places[0])
    for which in range(2):
        share = weight if which == 1 else 1.0
        if share > 0.0:
            look_up(tables, section[element, which], cells, places, share, True, fm)


@_compile
def _over_mach(numbers: Any, first: int, end: int, cell: Any, places: Any, rows: Any) -> None:
    """Some of the numbers and their slopes by the Mach number."""
    for r in range(first, end):
        for k in range(len(cell)):
            low, high = numbers[r, cell[k]], numbers[r, cell[k] + 1]
            rows[r, 0, k] = low + (high - low) * places[1, k]
            rows[r, 1, k] = (high - low) * places[2, k]


@_compile
def follow(element: int, x: Any, mach: Any, data: Any, slopes: bool, added: Any, by: Any, shown: Any) -> None:
    """One element: `ADDED`, (3, azimuths), and `STATES`, (4, azimuths), from x and M, (azimuths,) each.

    by: slopes by these at all azimuths, (3, azimuths, 2 azimuths), only where asked for, else without the last.
    """
    n = len(x)
    steps = max(1, -(-_LEAST_FINE // n))
    fine, seeds = n * steps, 2 * n if slopes else 0
    unit = (
        math.pi / fine / (data.half_chord[element] * data.tip_mach)
    )  # Travel in a step over the Mach numbers at its ends.
    every = np.zeros((3, fine, seeds))
    dx, dm, df = every[0], every[1], every[2]
    xs, ms = np.empty(fine), np.empty(fine)
    spread(x, steps, xs)
    spread(mach, steps, ms)
    _seed(n, steps, dx, dm)
    cells, places, fm = np.empty((2, fine), np.int32), np.empty((3, fine)), np.zeros((6, fine))
    rows = np.empty((8, 2, fine))
    _numbers(data.numbers[element], ms, cells, places, rows)
    h, by_mach = np.empty(fine), np.empty(fine)
    lag_steps(rows[LAG_PRESSURE], fine, ms, unit, h, by_mach)
    xf, dxf = np.empty(fine), np.empty((fine, seeds))
    lag(xs, dx, h, by_mach, dm, xf, dxf)
    _along(element, data.tables, data.section, data.weight[element], cells, places, xf, fm)
    f, dfs, m, dms = np.empty(fine), np.empty((fine, seeds)), np.empty(fine), np.empty((fine, seeds))
    _separation(rows, ms, dm, unit, fm, dxf, df, f, dfs, m, dms)
    g, dg = np.empty(fine), dxf
    _onset(rows, xf, dxf, dm, g, dg)
    cv, tau = np.zeros(fine), np.zeros(fine)
    dcv, dtau = np.zeros((fine, seeds)), np.zeros((fine, seeds))
    if g.max() > 0.0:
        _vortex(rows, ms, dm, xs, dx, f, dfs, g, dg, unit, cv, dcv, tau, dtau)
    _along(element, data.tables, data.section, data.weight[element], cells, places, xs, fm)
    added[:] = 0.0
    by[:] = 0.0
    _sum_up(rows, steps, fm, xs, f, m, cv, tau, dx, dm, dfs, dms, dcv, dtau, added, by)
    for k in range(n):
        at = k * steps
        shown[SEPARATION, k], shown[VORTEX, k], shown[POSITION, k], shown[ONSET_GATE, k] = f[at], cv[at], tau[at], g[at]


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
def _separation(
    rows: Any, ms: Any, dm: Any, unit: float, fm: Any, dxf: Any, df: Any, f: Any, dfs: Any, m: Any, dms: Any
) -> None:
    """f″ and m″ with their slopes; df is overwritten."""
    fine = len(ms)
    h, by_mach = np.empty(fine), np.empty(fine)
    lag_steps(rows[LAG_SEPARATION], fine, ms, unit, h, by_mach)
    for k in range(fine):
        _combine(df[k], fm[1, k], dxf[k], fm[2, k], dm[k])
    lag(fm[0], df, h, by_mach, dm, f, dfs)
    for k in range(fine):
        _combine(df[k], fm[4, k], dxf[k], fm[5, k], dm[k])
    lag(fm[3], df, h, by_mach, dm, m, dms)


@_compile
def _onset(rows: Any, xf: Any, dxf: Any, dm: Any, g: Any, dg: Any) -> None:
    """g with its slopes; dg may be dxf."""
    for k in range(len(xf)):
        edge = POSITIVE if xf[k] > 0.0 else NEGATIVE
        g[k], by_x, by_onset = _gate(xf[k], rows[edge, 0, k])
        _combine(dg[k], by_x, dxf[k], by_onset * rows[edge, 1, k], dm[k])


@_compile
def _sum_up(
    rows: Any,
    steps: int,
    fm: Any,
    x: Any,
    f: Any,
    m: Any,
    cv: Any,
    tau: Any,
    dx: Any,
    dm: Any,
    dfs: Any,
    dms: Any,
    dcv: Any,
    dtau: Any,
    added: Any,
    by: Any,
) -> None:
    """What is added, brought back to the azimuths given."""
    fine, seeds = dx.shape
    n = fine // steps
    row = np.empty((3, seeds))
    value = np.empty(3)
    for k in range(fine):
        slope, by_m = rows[SLOPE, 0, k], rows[SLOPE, 1, k]
        now, by_now, root, by_root = _kirchhoff(f[k])
        rest, by_rest, rest_root, by_rest_root = _kirchhoff(fm[0, k])
        y, at, mm = x[k], m[k], fm[3, k]
        arm = _ARM * (1.0 - math.cos(_PI * tau[k]))
        force, along, turns = now - rest, root - rest_root, now * at - rest * mm
        value[0] = slope * y * force + cv[k]
        value[1] = slope * y * y * along
        value[2] = slope * y * turns - arm * cv[k]
        if seeds:
            by_arm = _ARM * _PI * math.sin(_PI * tau[k])
            for j in range(seeds):
                dy, dmach = dx[k, j], dm[k, j]
                dstatic = fm[1, k] * dy + fm[2, k] * dmach
                dmm = fm[4, k] * dy + fm[5, k] * dmach
                by_both = slope * dy + by_m * y * dmach  # Of C_nα x.
                dnow, drest = by_now * dfs[k, j], by_rest * dstatic
                row[0, j] = by_both * force + slope * y * (dnow - drest) + dcv[k, j]
                row[1, j] = (by_both + slope * dy) * y * along
                row[1, j] += slope * y * y * (by_root * dfs[k, j] - by_rest_root * dstatic)
                row[2, j] = by_both * turns - arm * dcv[k, j] - by_arm * cv[k] * dtau[k, j]
                row[2, j] += slope * y * (dnow * at + now * dms[k, j] - drest * mm - rest * dmm)
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
    rows: Any,
    ms: Any,
    dm: Any,
    es: Any,
    de: Any,
    f: Any,
    df: Any,
    g: Any,
    dg: Any,
    unit: float,
    cv: Any,
    dcv: Any,
    tau: Any,
    dtau: Any,
) -> None:
    """C_nᵛ and τ with their slopes."""
    n, seeds = dm.shape
    s, ds = np.zeros(n + 1), np.zeros((n + 1, seeds))
    total, dtotal = np.zeros(n + 1), np.zeros((n + 1, seeds))  # ∫ g ds
    for k in range(n):
        after = (k + 1) % n
        step, mean = unit * (ms[k] + ms[after]), 0.5 * (g[k] + g[after])
        s[k + 1], total[k + 1] = s[k] + step, total[k] + mean * step
        for j in range(seeds):
            by_step = unit * (dm[k, j] + dm[after, j])
            ds[k + 1, j] = ds[k, j] + by_step
            dtotal[k + 1, j] = dtotal[k, j] + mean * by_step + 0.5 * step * (dg[k, j] + dg[after, j])
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
    lag_steps(rows[LAG_VORTEX], n, ms, unit, steps, by_mach)
    decay = np.exp(-steps)
    for k in range(n):
        after = (k + 1) % n
        cv[k] = math.sqrt(decay[k]) * 0.5 * (h[k] + h[after]) * (feed[after] - feed[k])
    around(decay, cv.reshape(n, 1))
    for k in range(n if seeds else 0):
        after = (k + 1) % n
        root, mean, grown = math.sqrt(decay[k]), 0.5 * (h[k] + h[after]), feed[after] - feed[k]
        by = -(decay[k] * cv[k] + 0.5 * root * mean * grown) * by_mach[k]
        for j in range(seeds):
            by_mean = 0.5 * (dh[k, j] + dh[after, j])
            dcv[k, j] = root * (by_mean * grown + mean * (dfeed[after, j] - dfeed[k, j])) + by * (
                dm[k, j] + dm[after, j]
            )
    around(decay, dcv)
