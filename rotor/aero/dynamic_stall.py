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
from rotor.airfoil.stall_onset import LAG_PRESSURE, LAG_SEPARATION, LAG_VORTEX, NEGATIVE, POSITIVE, SLOPE, TRAVEL
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
_LEAST_FINE = 48
"""Azimuths on which the lags are followed: 15° are up to eight semi-chords of travel. Our choice: 96 take nearly
twice as long. 192 raise the power of the UH-60A between µ .1 and .3 by up to .01 % at 8,322 kg, .05 % at 10,900 kg and,
with 8 % of the disk stalled, .19 % at 12,500 kg."""
_LONGEST = 40.0
"""Step over a lag time that leaves nothing of what was before."""
_PI = math.pi

_VALUES = (_X, _MACH, _X_LAGGED, _SEPARATED, _PLACE, _GATED, _VORTEX, _GONE_BY) = tuple(range(8))
"""On the finer azimuths: x, M, x_f, f″, m″, g, C_nᵛ and τ."""
_WEIGHTS = (_DECAY, _BEGIN, _END) = tuple(range(3))
_TRAVEL = (_DISTANCE, _SUM, _FED, _HELD) = tuple(range(4))
"""s, ∫ g ds, C_nα x (1 − K) and h."""

_compile = compiled(error_model="numpy")


@_compile
def spread(coarse: Any, steps: int, out: Any) -> None:
    """Linear between azimuths, onto finer ones; after the last comes the first again."""
    n = len(coarse)
    for c in range(n):
        here, after = coarse[c], coarse[c + 1 if c + 1 < n else 0]
        for m in range(steps):
            w = m / steps
            out[c * steps + m] = (1.0 - w) * here + w * after
    out[n * steps] = coarse[0]


@_compile
def _gather(fine: Any, steps: int, out: Any) -> None:
    """The transposed of `spread` over the steps: a mean about every azimuth."""
    n = len(out)
    out[:] = 0.0
    for m in range(steps):
        after = m / (steps * steps)
        here = 1.0 / steps - after
        for c in range(n):
            out[c] += here * fine[c * steps + m]
        for c in range(n if m > 0 else 0):
            out[c] += after * fine[(c - 1 if c > 0 else n - 1) * steps + m]


@_compile
def _around(decay: Any, z: Any) -> None:
    """z[k + 1] = decay[k] z[k] + given[k], periodic, in place: z holds what is given. Its end is its beginning."""
    n = len(decay)
    value, rest = 0.0, 1.0
    for k in range(n):  # First from zero: what is left of a start after one turn is known.
        rest *= decay[k]
        value = decay[k] * value + z[k]
    value /= 1.0 - rest
    for k in range(n):
        given = z[k]
        z[k] = value
        value = decay[k] * value + given
    z[n] = z[0]


@_compile
def _both_around(decay: Any, z: Any, y: Any) -> None:
    """`_around` for two: each waits for its own last value, so both take as long as one."""
    n = len(decay)
    value, other, rest = 0.0, 0.0, 1.0
    for k in range(n):
        rest *= decay[k]
        value, other = decay[k] * value + z[k], decay[k] * other + y[k]
    value, other = value / (1.0 - rest), other / (1.0 - rest)
    for k in range(n):
        given, beside = z[k], y[k]
        z[k], y[k] = value, other
        value, other = decay[k] * value + given, decay[k] * other + beside
    z[n], y[n] = z[0], y[0]


@_compile
def _slopes_around(decay: Any, z: Any) -> None:
    """`_around` for many columns, (azimuths, columns)."""
    n, columns = z.shape
    value, rest = np.zeros(columns), 1.0
    for k in range(n):
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
def lag_steps(row: Any, mach: Any, unit: float, slopes: bool, h: Any, by_mach: Any) -> None:
    """Steps over a lag time, and where asked for their slopes by the sum of the Mach numbers at their ends.

    row: the lag time at the mean Mach numbers of the steps and its slope, (2, steps). unit: travel over the sum.
    """
    for k in range(len(h)):
        h[k] = unit * (mach[k] + mach[k + 1]) / row[0, k]
    for k in range(len(h) if slopes else 0):
        by_mach[k] = (unit - h[k] * 0.5 * row[1, k]) / row[0, k]


@_compile
def lag_weights(h: Any, weights: Any) -> None:
    """e^−h of each step, and the weights of an input linear in it, at its beginning and at its end, (3, steps).

    1 − e^−h is the series of h/32, doubled five times: this makes vector code, and a short step loses no digits.
    """
    for k in range(len(h)):
        step = h[k] + 1e-30
        y = 0.03125 * min(step, _LONGEST)
        q = 1.0 - y * (1.0 / 10.0) * (1.0 - y * (1.0 / 11.0))
        q = 1.0 - y * (1.0 / 8.0) * (1.0 - y * (1.0 / 9.0) * q)
        q = 1.0 - y * (1.0 / 6.0) * (1.0 - y * (1.0 / 7.0) * q)
        q = 1.0 - y * (1.0 / 4.0) * (1.0 - y * (1.0 / 5.0) * q)
        q = y * (1.0 - y * (1.0 / 2.0) * (1.0 - y * (1.0 / 3.0) * q))
        q *= 2.0 - q
        q *= 2.0 - q
        q *= 2.0 - q
        q *= 2.0 - q
        q *= 2.0 - q
        share = q / step
        weights[_DECAY, k], weights[_BEGIN, k], weights[_END, k] = 1.0 - q, share - (1.0 - q), 1.0 - share


@_compile
def _feed(u: Any, weights: Any, z: Any) -> None:
    for k in range(weights.shape[1]):
        z[k] = weights[_BEGIN, k] * u[k] + weights[_END, k] * u[k + 1]


@_compile
def lag(u: Any, weights: Any, z: Any) -> None:
    """z of dz/ds = (u − z)/T, periodic, exact for an input that is linear in s within every step, (steps + 1,)."""
    _feed(u, weights, z)
    _around(weights[_DECAY], z)


@_compile
def _add_hat(k: int, steps: int, factor: float, row: Any) -> None:
    """Add slopes of what is linear between the azimuths given, at a finer one, by its values at those, (azimuths,)."""
    c, w = k // steps, (k % steps) / steps
    row[c] += (1.0 - w) * factor
    row[c + 1 if c + 1 < len(row) else 0] += w * factor


@_compile
def _lag_slopes(u: Any, by: Any, du: Any, by_mach: Any, h: Any, weights: Any, z: Any, steps: int, dz: Any) -> None:
    """Slopes of z by the seeds, x and M at the azimuths given; h: as `lag_steps` gives it.

    Those of its input u are `by` times du, and `by_mach` by M.
    """
    n, seeds = du.shape
    for k in range(n):
        after = (k + 1) % n
        step, e, a, b = h[0, k], weights[_DECAY, k], weights[_BEGIN, k], weights[_END, k]
        by_step = (1.0 - b - e) / step if step > 1e-4 else 0.5 - step / 3.0  # Of b.
        turned = ((e - by_step) * u[k] + by_step * u[after] - e * z[k]) * h[1, k]
        here, there = a * by[k], b * by[after]
        for j in range(seeds):
            dz[k, j] = here * du[k, j] + there * du[after, j]
        _add_hat(k, steps, a * by_mach[k] + turned, dz[k, seeds // 2 :])
        _add_hat(after, steps, b * by_mach[after] + turned, dz[k, seeds // 2 :])
    _slopes_around(weights[_DECAY], dz)


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
def _gate(x: float, positive: float, negative: float) -> Any:
    """0 below, 1 above x = onset, smoothly over ±4 %; slopes by x and onset."""
    onset = positive if x > 0.0 else negative
    u = min(max((x / onset - 1.0 + _GATE) / (2.0 * _GATE), 0.0), 1.0)
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
def _find_before(s: Any, back: Any, times: float, low: Any, share: Any, turns: Any) -> None:
    """The steps in which the flow was `times` `back` semi-chords before, how far in them, and how many turns before.

    s: travel at the azimuths, from 0 to that of the whole turn. Each search begins where the one before it ended.
    """
    n = len(low)
    step, turn = 0, 0
    for k in range(n):
        at = s[k] - times * back[k]
        place = at + turn * s[n]
        while place >= s[step + 1]:
            step += 1
            if step == n:
                step, turn = 0, turn - 1
                place = at + turn * s[n]
        while place < s[step]:
            step -= 1
            if step < 0:
                step, turn = n - 1, turn + 1
                place = at + turn * s[n]
        low[k], turns[k] = step, turn
        share[k] = (place - s[step]) / (s[step + 1] - s[step])


@_compile
def _along(element: int, data: Any, cells: Any, places: Any, x: Any, slopes: bool, fm: Any) -> None:
    """f and m of one row with their slopes by x and M where asked for, (6, steps + 1); Mach cells are there."""
    places_along_alpha(x[:-1], 0.0, cells[0], places[0])
    for which in range(2):
        share = data.weight[element] if which == 1 else 1.0
        if share > 0.0:
            look_up(data.tables, data.section[element, which], cells, places, share, slopes, fm)
    fm[0, -1], fm[3, -1] = fm[0, 0], fm[3, 0]


@_compile
def _over_mach(numbers: Any, cell: Any, places: Any, slopes: bool, row: Any) -> None:
    """One of the numbers at all azimuths, and its slope by the Mach number where asked for, (2, azimuths)."""
    for k in range(len(cell)):
        low, high = numbers[cell[k]], numbers[cell[k] + 1]
        row[0, k] = low + (high - low) * places[0, k]
    for k in range(len(cell) if slopes else 0):
        row[1, k] = (numbers[cell[k] + 1] - numbers[cell[k]]) * places[1, k]


@_compile
def follow(element: int, x: Any, mach: Any, data: Any, slopes: bool, added: Any, by: Any, shown: Any) -> None:
    """One element: `ADDED`, (3, azimuths), and `STATES`, (4, azimuths), from x and M, (azimuths,) each.

    by: slopes by these at all azimuths, (3, azimuths, 2 azimuths), only where asked for, else without the last.
    """
    n = len(x)
    steps = max(1, -(-_LEAST_FINE // n))
    fine = n * steps
    v, sums = np.empty((len(_VALUES), fine + 1)), np.empty((len(ADDED), fine))
    rows, cells, places = np.empty((8, 2, fine)), np.empty((3, fine), np.int32), np.empty((5, fine))
    h, weights = np.empty((3, 2, fine)), np.empty((3, len(_WEIGHTS), fine))
    lagged, static = np.empty((6, fine + 1)), np.empty((6, fine + 1))
    spread(x, steps, v[_X])
    spread(mach, steps, v[_MACH])
    numbers = data.numbers[element]
    unit = math.pi / fine / (data.half_chord[element] * data.tip_mach)  # Travel over the Mach numbers at its ends.
    middle = sums[0]
    for k in range(fine):
        middle[k] = 0.5 * (v[_MACH, k] + v[_MACH, k + 1])
    places_along_mach(middle, cells[2], places[3], places[4])
    places_along_mach(v[_MACH, :-1], cells[1], places[1], places[2])
    for row in (SLOPE, POSITIVE, NEGATIVE):
        _over_mach(numbers[row], cells[1], places[1:3], slopes, rows[row])
    for k, row in enumerate((LAG_PRESSURE, LAG_SEPARATION)):
        _over_mach(numbers[row], cells[2], places[3:], slopes, rows[row])
        lag_steps(rows[row], v[_MACH], unit, slopes, h[k, 0], h[k, 1])
        lag_weights(h[k, 0], weights[k])
    lag(v[_X], weights[0], v[_X_LAGGED])
    _along(element, data, cells, places, v[_X_LAGGED], slopes, lagged)
    _feed(lagged[0], weights[1], v[_SEPARATED])
    _feed(lagged[3], weights[1], v[_PLACE])
    _both_around(weights[1, _DECAY], v[_SEPARATED], v[_PLACE])
    most = 0.0
    for k in range(fine):
        v[_GATED, k] = _gate(v[_X_LAGGED, k], rows[POSITIVE, 0, k], rows[NEGATIVE, 0, k])[0]
    for k in range(fine):
        most = max(most, v[_GATED, k])
    v[_GATED, fine] = v[_GATED, 0]
    shedding = fine if most > 0.0 else 0
    travel, low = np.empty((len(_TRAVEL), shedding + 1)), np.empty((2, shedding), np.int32)
    earlier = low, np.empty((2, shedding)), np.empty((2, shedding))
    v[_VORTEX], v[_GONE_BY] = 0.0, 0.0
    if most > 0.0:
        _over_mach(numbers[TRAVEL], cells[1], places[1:3], slopes, rows[TRAVEL])
        _over_mach(numbers[LAG_VORTEX], cells[2], places[3:], slopes, rows[LAG_VORTEX])
        lag_steps(rows[LAG_VORTEX], v[_MACH], unit, slopes, h[2, 0], h[2, 1])
        lag_weights(h[2, 0], weights[2])
        _shed(rows, unit, weights[2, _DECAY], v, travel, earlier)
    _along(element, data, cells, places, v[_X], slopes, static)
    _sum_up(rows, static, v, most > 0.0, sums)
    for o in range(len(ADDED)):
        _gather(sums[o], steps, added[o])
    for k in range(n):
        for state, value in ((SEPARATION, _SEPARATED), (VORTEX, _VORTEX), (POSITION, _GONE_BY), (ONSET_GATE, _GATED)):
            shown[state, k] = v[value, k * steps]
    if slopes:
        work, shed = np.empty((4, fine, 2 * n)), np.empty((3, shedding, 2 * n))
        dx, dxf, df, dplace, dm, dcv, dtau = work[0], work[1], work[2], work[3], shed[0], shed[1], shed[2]
        _seed(n, steps, 0, dx)
        _lag_slopes(v[_X], np.ones(fine), dx, np.zeros(fine), h[0], weights[0], v[_X_LAGGED], steps, dxf)
        _lag_slopes(lagged[0], lagged[1], dxf, lagged[2], h[1], weights[1], v[_SEPARATED], steps, df)
        _lag_slopes(lagged[3], lagged[4], dxf, lagged[5], h[1], weights[1], v[_PLACE], steps, dplace)
        if most > 0.0:
            _seed(n, steps, n, dm)
            for k in range(fine):
                edge = POSITIVE if v[_X_LAGGED, k] > 0.0 else NEGATIVE
                _, by_x, by_onset = _gate(v[_X_LAGGED, k], rows[POSITIVE, 0, k], rows[NEGATIVE, 0, k])
                _combine(dxf[k], by_x, dxf[k], by_onset * rows[edge, 1, k], dm[k])  # Now those of g.
            given = dx, dm, df, dxf
            _shed_slopes(rows, unit, weights[2, _DECAY], h[2, 1], v, travel, earlier, given, dcv, dtau)
        by[:] = 0.0
        _sum_up_slopes(rows, steps, static, v, df, dplace, dcv, dtau, by)


@_compile
def _seed(n: int, steps: int, first: int, out: Any) -> None:
    """Slopes of x (first = 0) or M (first = n) on the finer azimuths by the seeds."""
    out[:] = 0.0
    for k in range(len(out)):
        _add_hat(k, steps, 1.0, out[k, first : first + n])


@_compile
def _shed(rows: Any, unit: float, decay: Any, v: Any, travel: Any, earlier: Any) -> None:
    """C_nᵛ and τ, with the travel; earlier: where the flow was one and two travels of the vortex ago."""
    n, (low, share, turns) = len(decay), earlier
    g, s, total = v[_GATED], travel[_DISTANCE], travel[_SUM]
    s[0], total[0] = 0.0, 0.0
    for k in range(n):
        step = unit * (v[_MACH, k] + v[_MACH, k + 1])
        s[k + 1], total[k + 1] = s[k] + step, total[k] + 0.5 * (g[k] + g[k + 1]) * step
    _find_before(s, rows[TRAVEL, 0], 1.0, low[0], share[0], turns[0])
    _find_before(s, rows[TRAVEL, 0], 2.0, low[1], share[1], turns[1])
    for k in range(n):
        travel[_FED, k] = rows[SLOPE, 0, k] * v[_X, k] * (1.0 - _kirchhoff(v[_SEPARATED, k])[0])
        j, w = low[0, k], share[0, k]
        travel[_HELD, k] = g[k] * (1.0 - (1.0 - w) * g[j] - w * g[j + 1])
        j, w = low[1, k], share[1, k]
        inside = w * g[j] + 0.5 * w * w * (g[j + 1] - g[j])
        passed = total[k] + turns[1, k] * total[n] - total[j] - (s[j + 1] - s[j]) * inside
        v[_GONE_BY, k] = passed / rows[TRAVEL, 0, k]
    for row in (_FED, _HELD):
        travel[row, n] = travel[row, 0]
    fed, held = travel[_FED], travel[_HELD]
    for k in range(n):
        v[_VORTEX, k] = math.sqrt(decay[k]) * 0.5 * (held[k] + held[k + 1]) * (fed[k + 1] - fed[k])
    _around(decay, v[_VORTEX])


@_compile
def _sum_up(rows: Any, static: Any, v: Any, vortex: bool, out: Any) -> None:
    """What is added on the finer azimuths."""
    for k in range(out.shape[1]):
        slope, y = rows[SLOPE, 0, k], v[_X, k]
        now, _, root, _ = _kirchhoff(v[_SEPARATED, k])
        rest, _, rest_root, _ = _kirchhoff(static[0, k])
        out[0, k] = slope * y * (now - rest)
        out[1, k] = slope * y * y * (root - rest_root)
        out[2, k] = slope * y * (now * v[_PLACE, k] - rest * static[3, k])
    if vortex:
        for k in range(out.shape[1]):
            out[0, k] += v[_VORTEX, k]
            out[2, k] -= _ARM * (1.0 - math.cos(_PI * v[_GONE_BY, k])) * v[_VORTEX, k]


@_compile
def _sum_up_slopes(
    rows: Any, steps: int, static: Any, v: Any, df: Any, dplace: Any, dcv: Any, dtau: Any, by: Any
) -> None:
    """Slopes of what is added by x and M at all azimuths; dcv, dtau: without azimuths where no vortex leaves."""
    fine, seeds = df.shape
    n = seeds // 2
    row = np.empty((3, seeds))
    for k in range(fine):
        slope, by_m = rows[SLOPE, 0, k], rows[SLOPE, 1, k]
        now, by_now, root, by_root = _kirchhoff(v[_SEPARATED, k])
        rest, by_rest, rest_root, by_rest_root = _kirchhoff(static[0, k])
        y, at, mm = v[_X, k], v[_PLACE, k], static[3, k]
        force, along, turns = now - rest, root - rest_root, now * at - rest * mm
        lift = slope * y
        for j in range(seeds):
            row[0, j] = lift * by_now * df[k, j]
            row[1, j] = lift * y * by_root * df[k, j]
            row[2, j] = lift * by_now * at * df[k, j] + lift * now * dplace[k, j]
        if len(dcv) > 0:
            cv, tau = v[_VORTEX, k], v[_GONE_BY, k]
            arm, by_arm = _ARM * (1.0 - math.cos(_PI * tau)), _ARM * _PI * math.sin(_PI * tau)
            for j in range(seeds):
                row[0, j] += dcv[k, j]
                row[2, j] -= arm * dcv[k, j] + by_arm * cv * dtau[k, j]
        for which in range(2):  # By x, then by M at the same f″ and m″.
            by_both = slope if which == 0 else by_m * y  # Of C_nα x.
            twice = by_both + slope if which == 0 else by_both
            dstatic, dmm = static[1 + which, k], static[4 + which, k]
            part = slice(which * n, which * n + n)
            _add_hat(k, steps, by_both * force - lift * by_rest * dstatic, row[0, part])
            _add_hat(k, steps, y * (twice * along - lift * by_rest_root * dstatic), row[1, part])
            _add_hat(k, steps, by_both * turns - lift * (by_rest * dstatic * mm + rest * dmm), row[2, part])
        c, w = k // steps, (k % steps) / steps
        after = (c + 1) % n
        for o in range(3):
            _add(by[o, c], (1.0 - w) / steps, row[o])
            if w > 0.0:
                _add(by[o, after], w / steps, row[o])


@_compile
def _shed_slopes(
    rows: Any, unit: float, decay: Any, by_mach: Any, v: Any, travel: Any, earlier: Any, given: Any, dcv: Any, dtau: Any
) -> None:
    """Slopes of C_nᵛ and τ by the seeds, from those of x, M, f″ and g.

    by_mach: slopes of the steps over T_v by the sum of their Mach numbers.
    """
    (low, share, turns), (dx, dm, df, dg) = earlier, given
    n, seeds = dm.shape
    g, s, fed, held = v[_GATED], travel[_DISTANCE], travel[_FED], travel[_HELD]
    ds, dtotal = np.zeros((n + 1, seeds)), np.zeros((n + 1, seeds))
    for k in range(n):
        after = (k + 1) % n
        step, mean = s[k + 1] - s[k], 0.5 * (g[k] + g[k + 1])
        for j in range(seeds):
            by_step = unit * (dm[k, j] + dm[after, j])
            ds[k + 1, j] = ds[k, j] + by_step
            dtotal[k + 1, j] = dtotal[k, j] + mean * by_step + 0.5 * step * (dg[k, j] + dg[after, j])
    dfed, dheld = np.empty_like(dx), np.empty_like(dx)
    for k in range(n):
        slope, by_m = rows[SLOPE, 0, k], rows[SLOPE, 1, k]
        now, by_now, _, _ = _kirchhoff(v[_SEPARATED, k])
        _combine(dfed[k], slope * (1.0 - now), dx[k], -slope * v[_X, k] * by_now, df[k])
        _add(dfed[k], by_m * v[_X, k] * (1.0 - now), dm[k])
        time, by_time, tau = rows[TRAVEL, 0, k], rows[TRAVEL, 1, k], v[_GONE_BY, k]
        j0, w, back = low[0, k], share[0, k], turns[0, k]
        j1, step = (j0 + 1) % n, s[j0 + 1] - s[j0]
        before, change = (1.0 - w) * g[j0] + w * g[j1], g[j1] - g[j0]
        first, x, around = low[1, k], share[1, k], turns[1, k]
        last, wide = (first + 1) % n, s[first + 1] - s[first]
        rise = g[last] - g[first]
        inside = x * g[first] + 0.5 * x * x * rise
        for j in range(seeds):
            by_w = ds[k, j] + back * ds[n, j] - by_time * dm[k, j] - ds[j0, j] - w * (ds[j0 + 1, j] - ds[j0, j])
            dbefore = (1.0 - w) * dg[j0, j] + w * dg[j1, j] + change / step * by_w
            dheld[k, j] = dg[k, j] * (1.0 - before) - g[k] * dbefore
            dwide = ds[first + 1, j] - ds[first, j]
            by_x = ds[k, j] + around * ds[n, j] - 2.0 * by_time * dm[k, j] - ds[first, j] - x * dwide
            dinside = x * dg[first, j] + 0.5 * x * x * (dg[last, j] - dg[first, j])
            whole = dtotal[k, j] + around * dtotal[n, j] - dtotal[first, j]
            whole -= dwide * inside + wide * dinside + (g[first] + x * rise) * by_x
            dtau[k, j] = (whole - tau * by_time * dm[k, j]) / time
    for k in range(n):
        after = (k + 1) % n
        root, mean, grown = math.sqrt(decay[k]), 0.5 * (held[k] + held[after]), fed[after] - fed[k]
        by = -(decay[k] * v[_VORTEX, k] + 0.5 * root * mean * grown) * by_mach[k]
        for j in range(seeds):
            by_mean = 0.5 * (dheld[k, j] + dheld[after, j])
            dcv[k, j] = root * (by_mean * grown + mean * (dfed[after, j] - dfed[k, j]))
            dcv[k, j] += by * (dm[k, j] + dm[after, j])
    _slopes_around(decay, dcv)
