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

so that at rest nothing is added. f(x), m(x): `rotor.airfoil.stall_onset`; where rotation delays stall, those of a
larger K (`delay_separation`). Every stage is a linear lag whose coefficients the stages before it give: its periodic
solution is exact after one turn. So are its derivatives: linear lags of the same decay, which `rotor.engine.memory`
follows for any small changes of x and M.

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
from rotor.engine.memory import around, onto_coarser, onto_finer
from rotor.support.arrays import Array, Integers, fix
from rotor.support.compiled import compiled

INPUTS = (ANGLE, MACH_NUMBER) = tuple(range(2))
"""x and M."""
ADDED = (ADDED_N, ADDED_C, ADDED_M) = tuple(range(3))
"""C_n, C_c and C_m less the static ones."""
STATES = (SEPARATION, VORTEX, POSITION, ONSET_GATE) = tuple(range(4))
"""What is shown: f″, C_nᵛ, τ and g."""
FULL, GONE = math.radians(25.0), math.radians(50.0)
"""Angles from zero lift up to which, and from which nothing of, the unsteady part counts."""
_RISE_WIDTH = 0.04
_ARM = 0.2
_LEAST_FINE = 48
"""Azimuths on which the lags are followed: 15° are up to eight semi-chords of travel. Our choice: 96 take nearly
twice as long. 192 raise the power of the UH-60A between µ .1 and .3 by up to .01 % at 8,322 kg, .05 % at 10,900 kg and,
with 8 % of the disk stalled, .19 % at 12,500 kg."""
_MOST_LAGS = 40.0
"""Step over a lag time that leaves nothing of what was before."""
_PI = math.pi

_VALUES = (
    _X, _MACH, _OF_N, _OF_C, _OF_M, _X_LAGGED, _SEPARATED, _PLACE, _GATED, _VORTEX, _GONE_BY, _DISTANCE, _SUM, _FED,
    _HELD,
) = tuple(range(15))  # fmt: skip
"""On the finer azimuths: x, M, what is added, x_f, f″, m″, g, C_nᵛ, τ, s, ∫ g ds, C_nα x (1 − K) and h."""
_WEIGHTS = (_DECAY, _BEGIN, _END) = tuple(range(3))

_LAGGING = {_X_LAGGED: 0, _SEPARATED: 1, _PLACE: 1, _VORTEX: 2, _DISTANCE: 3, _SUM: 3}
"""Rows of `Lags.decays`; nothing decays in the last."""
_HERE, _BEFORE, _FIRST, _TURN = -1, 0, 1, 2
"""Rows of `Lags.places`: one and two travels of the vortex ago, and the last step of the turn."""
_ATTACHED = (
    (_X_LAGGED, _X, _HERE, 2), (_X_LAGGED, _MACH, _HERE, 2),
    (_SEPARATED, _X_LAGGED, _HERE, 2), (_SEPARATED, _MACH, _HERE, 2),
    (_PLACE, _X_LAGGED, _HERE, 2), (_PLACE, _MACH, _HERE, 2),
    (_OF_N, _SEPARATED, _HERE, 1), (_OF_N, _X, _HERE, 1), (_OF_N, _MACH, _HERE, 1),
    (_OF_C, _SEPARATED, _HERE, 1), (_OF_C, _X, _HERE, 1), (_OF_C, _MACH, _HERE, 1),
    (_OF_M, _SEPARATED, _HERE, 1), (_OF_M, _PLACE, _HERE, 1), (_OF_M, _X, _HERE, 1), (_OF_M, _MACH, _HERE, 1),
)  # fmt: skip
"""Links of the derivatives: variable fed, variable it comes from, where that is taken, and terms."""
_SHED = (
    (_GATED, _X_LAGGED, _HERE, 1), (_GATED, _MACH, _HERE, 1),
    (_DISTANCE, _MACH, _HERE, 2),
    (_SUM, _MACH, _HERE, 2), (_SUM, _GATED, _HERE, 2),
    (_FED, _X, _HERE, 1), (_FED, _SEPARATED, _HERE, 1), (_FED, _MACH, _HERE, 1),
    (_HELD, _GATED, _HERE, 1), (_HELD, _GATED, _BEFORE, 2), (_HELD, _MACH, _HERE, 1),
    (_HELD, _DISTANCE, _HERE, 1), (_HELD, _DISTANCE, _TURN, 2), (_HELD, _DISTANCE, _BEFORE, 2),
    (_GONE_BY, _GATED, _FIRST, 2), (_GONE_BY, _MACH, _HERE, 1),
    (_GONE_BY, _SUM, _HERE, 1), (_GONE_BY, _SUM, _TURN, 2), (_GONE_BY, _SUM, _FIRST, 2),
    (_GONE_BY, _DISTANCE, _HERE, 1), (_GONE_BY, _DISTANCE, _TURN, 2), (_GONE_BY, _DISTANCE, _FIRST, 2),
    (_VORTEX, _HELD, _HERE, 2), (_VORTEX, _FED, _HERE, 2), (_VORTEX, _MACH, _HERE, 2),
    (_OF_N, _VORTEX, _HERE, 1), (_OF_M, _VORTEX, _HERE, 1), (_OF_M, _GONE_BY, _HERE, 1),
)  # fmt: skip
"""Those beside where a vortex leaves."""
_ALL_LINKS = len(_ATTACHED) + len(_SHED)
LINKS = np.array(_ATTACHED + _SHED)
DECAYING = np.array([_LAGGING.get(value, -1) for value in _VALUES])
"""For `Lags`."""

_compile = compiled(error_model="numpy")


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
        y = 0.03125 * min(step, _MOST_LAGS)
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
        weights[_DECAY, k], weights[_BEGIN, k], weights[_END, k] = (
            1.0 - q,
            share - (1.0 - q),
            1.0 - share,
        )


@_compile
def lag(u: Any, weights: Any, z: Any) -> None:
    """z of dz/ds = (u − z)/T, periodic, exact for an input that is linear in s within every step, (steps + 1,)."""
    for k in range(weights.shape[1]):
        z[k] = weights[_BEGIN, k] * u[k] + weights[_END, k] * u[k + 1]
    around(weights[_DECAY], z)


_NO_DELAY = np.zeros(0)
fix(_NO_DELAY)


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
    delay: Array = _NO_DELAY
    """g of `rotor.airfoil.stall_delay`, (elements,), or without elements."""


@_compile
def window(y: float) -> Any:
    """By which x is weighted at y from zero lift, and its slope."""
    u = (abs(y) - FULL) / (GONE - FULL)
    if u <= 0.0:
        return 1.0, 0.0
    if u >= 1.0:
        return 0.0, 0.0
    return 1.0 - u * u * (3.0 - 2.0 * u), -6.0 * u * (1.0 - u) / (GONE - FULL) * (
        1.0 if y > 0.0 else -1.0
    )


@_compile
def _gate(x: float, positive: float, negative: float) -> Any:
    """0 below, 1 above x = onset, smoothly over ±4 %; slopes by x and onset."""
    onset = positive if x > 0.0 else negative
    u = min(max((x / onset - 1.0 + _RISE_WIDTH) / (2.0 * _RISE_WIDTH), 0.0), 1.0)
    by = 6.0 * u * (1.0 - u) / (2.0 * _RISE_WIDTH)
    return u * u * (3.0 - 2.0 * u), by / onset, -by * x / (onset * onset)


@_compile
def _kirchhoff(f: float) -> Any:
    """K and √f with their slopes by f."""
    root = math.sqrt(f)
    return 0.25 * (1.0 + root) ** 2, 0.25 * (1.0 + 1.0 / root), root, 0.5 / root


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
            look_up(
                data.tables,
                (0, 2),
                data.section[element, which],
                cells,
                places,
                share,
                slopes,
                fm,
                0,
            )
    if len(data.delay) > 0:
        delay_separation(data.delay[element], slopes, fm)
    fm[0, -1], fm[3, -1] = fm[0, 0], fm[3, 0]


@_compile
def delay_separation(gain: float, slopes: bool, fm: Any) -> None:
    """Change f and m of one row, with their slopes where asked for, to those of an element whose stall is delayed.

    The force of attached flow has K = 1: so K goes to K + g (1 − K), and f to that of the new K. The moment stays, so
    its arm m is that of the section times K over the new K.
    """
    for k in range(fm.shape[1] - 1):
        # Attached: both stay, and f, which is largest there, has no slope.
        if fm[0, k] == 1.0:
            continue
        own, by_f, _, _ = _kirchhoff(fm[0, k])
        kept = own + gain * (1.0 - own)
        root = 2.0 * math.sqrt(kept) - 1.0
        arm = fm[3, k]
        fm[0, k] = root * root
        fm[3, k] = arm * own / kept
        if slopes:
            of_f = 4.0 * root / (root + 1.0) * (1.0 - gain) * by_f
            of_arm = arm * gain / (kept * kept) * by_f
            for row in (1, 2):
                fm[3 + row, k] = fm[3 + row, k] * own / kept + of_arm * fm[row, k]
                fm[row, k] *= of_f


@_compile
def _over_mach(numbers: Any, cell: Any, places: Any, slopes: bool, row: Any) -> None:
    """One of the numbers at all azimuths, and its slope by the Mach number where asked for, (2, azimuths)."""
    for k in range(len(cell)):
        low, high = numbers[cell[k]], numbers[cell[k] + 1]
        row[0, k] = low + (high - low) * places[0, k]
    for k in range(len(cell) if slopes else 0):
        row[1, k] = (numbers[cell[k] + 1] - numbers[cell[k]]) * places[1, k]


@_compile
def empty_lags(elements: int, azimuths: int) -> Any:
    """`linked`, `decays`, `factors` and `places` of `Lags` to be filled by `stall_states`."""
    fine = azimuths * max(1, -(-_LEAST_FINE // azimuths))
    factors, decays = np.empty((elements, _ALL_LINKS, 2, fine)), np.ones((elements, 4, fine))
    return np.empty(elements, np.int64), decays, factors, np.empty((elements, 3, fine), np.int32)


@_compile
def stall_states(
    element: int, x: Any, mach: Any, data: Any, slopes: bool, added: Any, lags: Any, shown: Any
) -> None:
    """One element: `ADDED`, (3, azimuths), and `STATES`, (4, azimuths), from x and M, (azimuths,) each.

    lags: `empty_lags` all elements, filled where slopes are asked for, else for none.
    """
    n = len(x)
    steps = max(1, -(-_LEAST_FINE // n))
    fine = n * steps
    v = np.empty((len(_VALUES), fine + 1))
    rows, cells, places = np.empty((8, 2, fine)), np.empty((3, fine), np.int32), np.empty((5, fine))
    h, weights = np.empty((3, 2, fine)), np.empty((3, len(_WEIGHTS), fine))
    lagged, static = np.empty((6, fine + 1)), np.empty((6, fine + 1))
    onto_finer(x, steps, v[_X])
    onto_finer(mach, steps, v[_MACH])
    numbers = data.numbers[element]
    # Travel over the Mach numbers at its ends.
    unit = math.pi / fine / (data.half_chord[element] * data.tip_mach)
    middle = v[_OF_N, :fine]
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
    lag(lagged[0], weights[1], v[_SEPARATED])
    lag(lagged[3], weights[1], v[_PLACE])
    most = 0.0
    for k in range(fine):
        v[_GATED, k] = _gate(v[_X_LAGGED, k], rows[POSITIVE, 0, k], rows[NEGATIVE, 0, k])[0]
    for k in range(fine):
        most = max(most, v[_GATED, k])
    v[_GATED, fine] = v[_GATED, 0]
    shedding = fine if most > 0.0 else 0
    earlier = np.empty((2, shedding), np.int32), np.empty((2, shedding)), np.empty((2, shedding))
    v[_VORTEX], v[_GONE_BY] = 0.0, 0.0
    if most > 0.0:
        _over_mach(numbers[TRAVEL], cells[1], places[1:3], slopes, rows[TRAVEL])
        _over_mach(numbers[LAG_VORTEX], cells[2], places[3:], slopes, rows[LAG_VORTEX])
        lag_steps(rows[LAG_VORTEX], v[_MACH], unit, slopes, h[2, 0], h[2, 1])
        lag_weights(h[2, 0], weights[2])
        _shed(rows, unit, weights[2, _DECAY], v, earlier)
    _along(element, data, cells, places, v[_X], slopes, static)
    _sum_up(rows, static, v, most > 0.0)
    for o in range(len(ADDED)):
        onto_coarser(v[_OF_N + o], steps, added[o])
    for k in range(n):
        for state, value in (
            (SEPARATION, _SEPARATED),
            (VORTEX, _VORTEX),
            (POSITION, _GONE_BY),
            (ONSET_GATE, _GATED),
        ):
            shown[state, k] = v[value, k * steps]
    if slopes:
        decays, factors, at = lags[1][element], lags[2][element], lags[3][element]
        lags[0][element] = _ALL_LINKS if most > 0.0 else len(_ATTACHED)
        _lag_slopes(rows, static, lagged, h, weights, v, decays, factors)
        if most > 0.0:
            decays[2], at[_BEFORE], at[_FIRST], at[_TURN] = (
                weights[2, _DECAY],
                earlier[0][0],
                earlier[0][1],
                fine - 1,
            )
            _shed_links(
                rows, unit, weights[2, _DECAY], h[2, 1], v, earlier, factors[len(_ATTACHED) :]
            )


@_compile
def _lag_slopes(
    rows: Any, static: Any, lagged: Any, h: Any, weights: Any, v: Any, decays: Any, factors: Any
) -> None:
    """Decays and links of the lags of attached flow, and the links of their sum."""
    n = h.shape[2]
    decays[0], decays[1] = weights[0, _DECAY], weights[1, _DECAY]
    _lag_links(v[_X], np.ones(n), np.zeros(n), h[0], weights[0], v[_X_LAGGED], factors[0:2])
    _lag_links(lagged[0], lagged[1], lagged[2], h[1], weights[1], v[_SEPARATED], factors[2:4])
    _lag_links(lagged[3], lagged[4], lagged[5], h[1], weights[1], v[_PLACE], factors[4:6])
    _sum_links(rows, static, v, factors[6:])


@_compile
def _shed(rows: Any, unit: float, decay: Any, v: Any, earlier: Any) -> None:
    """C_nᵛ and τ, with the travel; earlier: where the flow was one and two travels of the vortex ago."""
    n, (low, share, turns) = len(decay), earlier
    g, s, total, fed, held = v[_GATED], v[_DISTANCE], v[_SUM], v[_FED], v[_HELD]
    s[0], total[0] = 0.0, 0.0
    for k in range(n):
        step = unit * (v[_MACH, k] + v[_MACH, k + 1])
        s[k + 1], total[k + 1] = s[k] + step, total[k] + 0.5 * (g[k] + g[k + 1]) * step
    _find_before(s, rows[TRAVEL, 0], 1.0, low[0], share[0], turns[0])
    _find_before(s, rows[TRAVEL, 0], 2.0, low[1], share[1], turns[1])
    for k in range(n):
        fed[k] = rows[SLOPE, 0, k] * v[_X, k] * (1.0 - _kirchhoff(v[_SEPARATED, k])[0])
        j, w = low[0, k], share[0, k]
        held[k] = g[k] * (1.0 - (1.0 - w) * g[j] - w * g[j + 1])
        j, w = low[1, k], share[1, k]
        inside = w * g[j] + 0.5 * w * w * (g[j + 1] - g[j])
        passed = total[k] + turns[1, k] * total[n] - total[j] - (s[j + 1] - s[j]) * inside
        v[_GONE_BY, k] = passed / rows[TRAVEL, 0, k]
    fed[n], held[n] = fed[0], held[0]
    for k in range(n):
        v[_VORTEX, k] = math.sqrt(decay[k]) * 0.5 * (held[k] + held[k + 1]) * (fed[k + 1] - fed[k])
    around(decay, v[_VORTEX])


@_compile
def _sum_up(rows: Any, static: Any, v: Any, vortex: bool) -> None:
    """What is added on the finer azimuths."""
    for k in range(rows.shape[2]):
        slope, y = rows[SLOPE, 0, k], v[_X, k]
        now, _, root, _ = _kirchhoff(v[_SEPARATED, k])
        rest, _, rest_root, _ = _kirchhoff(static[0, k])
        v[_OF_N, k] = slope * y * (now - rest)
        v[_OF_C, k] = slope * y * y * (root - rest_root)
        v[_OF_M, k] = slope * y * (now * v[_PLACE, k] - rest * static[3, k])
    if vortex:
        for k in range(rows.shape[2]):
            v[_OF_N, k] += v[_VORTEX, k]
            v[_OF_M, k] -= _ARM * (1.0 - math.cos(_PI * v[_GONE_BY, k])) * v[_VORTEX, k]


@_compile
def _lag_links(u: Any, by: Any, by_mach: Any, h: Any, weights: Any, z: Any, out: Any) -> None:
    """Links to a lag z from what its input u follows with slopes `by`, and from M, by `by_mach` and by the steps.

    h: as `lag_steps` gives it.
    """
    n = out.shape[2]
    for k in range(n):
        after = (k + 1) % n
        step, e, a, b = h[0, k], weights[_DECAY, k], weights[_BEGIN, k], weights[_END, k]
        by_step = (1.0 - b - e) / step if step > 1e-4 else 0.5 - step / 3.0  # Of b.
        turned = ((e - by_step) * u[k] + by_step * u[after] - e * z[k]) * h[1, k]
        out[0, 0, k], out[0, 1, k] = a * by[k], b * by[after]
        out[1, 0, k], out[1, 1, k] = a * by_mach[k] + turned, b * by_mach[after] + turned


@_compile
def _sum_links(rows: Any, static: Any, v: Any, out: Any) -> None:
    """Links to what is added without a vortex."""
    for k in range(rows.shape[2]):
        slope, by_m = rows[SLOPE, 0, k], rows[SLOPE, 1, k]
        now, by_now, root, by_root = _kirchhoff(v[_SEPARATED, k])
        rest, by_rest, rest_root, by_rest_root = _kirchhoff(static[0, k])
        y, at, mm = v[_X, k], v[_PLACE, k], static[3, k]
        force, along, turns = now - rest, root - rest_root, now * at - rest * mm
        lift = slope * y
        factors = (
            lift * by_now,
            slope * force - lift * by_rest * static[1, k],
            by_m * y * force - lift * by_rest * static[2, k],
            lift * y * by_root,
            y * (2.0 * slope * along - lift * by_rest_root * static[1, k]),
            y * (by_m * y * along - lift * by_rest_root * static[2, k]),
            lift * by_now * at,
            lift * now,
            slope * turns - lift * (by_rest * static[1, k] * mm + rest * static[4, k]),
            by_m * y * turns - lift * (by_rest * static[2, k] * mm + rest * static[5, k]),
        )
        for link, factor in enumerate(factors):
            out[link, 0, k] = factor


@_compile
def _shed_links(
    rows: Any, unit: float, decay: Any, by_mach: Any, v: Any, earlier: Any, out: Any
) -> None:
    """Links to C_nᵛ, τ and what is added with them.

    by_mach: slopes of the steps over T_v by the sum of their Mach numbers.
    """
    n, (low, share, turns) = len(decay), earlier
    g, s, fed, held = v[_GATED], v[_DISTANCE], v[_FED], v[_HELD]
    for k in range(n):
        slope, by_m, x, cv, tau = (
            rows[SLOPE, 0, k],
            rows[SLOPE, 1, k],
            v[_X, k],
            v[_VORTEX, k],
            v[_GONE_BY, k],
        )
        edge = POSITIVE if v[_X_LAGGED, k] > 0.0 else NEGATIVE
        _, by_x, by_onset = _gate(v[_X_LAGGED, k], rows[POSITIVE, 0, k], rows[NEGATIVE, 0, k])
        now, by_now, _, _ = _kirchhoff(v[_SEPARATED, k])
        by_time, per = rows[TRAVEL, 1, k], 1.0 / rows[TRAVEL, 0, k]
        step, mean = s[k + 1] - s[k], 0.5 * (g[k] + g[k + 1])
        j, w, back = low[0, k], share[0, k], turns[0, k]
        late = -g[k] * (g[j + 1] - g[j]) / (s[j + 1] - s[j])  # Slope of h by the distance there.
        first, y, whole = low[1, k], share[1, k], turns[1, k]
        wide, rise = s[first + 1] - s[first], g[first + 1] - g[first]
        there, inside, half = (
            per * (g[first] + y * rise),
            per * (y * g[first] + 0.5 * y * y * rise),
            0.5 * y * y,
        )
        root, held_mean, grown = (
            math.sqrt(decay[k]),
            0.5 * (held[k] + held[k + 1]),
            fed[k + 1] - fed[k],
        )
        by_step = -(decay[k] * cv + 0.5 * root * held_mean * grown) * by_mach[k]
        arm, by_arm = _ARM * (1.0 - math.cos(_PI * tau)), _ARM * _PI * math.sin(_PI * tau)
        factors = (
            (by_x, 0.0), (by_onset * rows[edge, 1, k], 0.0),
            (unit, unit),
            (mean * unit, mean * unit), (0.5 * step, 0.5 * step),
            (slope * (1.0 - now), 0.0), (-slope * x * by_now, 0.0), (by_m * x * (1.0 - now), 0.0),
            (1.0 - (1.0 - w) * g[j] - w * g[j + 1], 0.0), (-g[k] * (1.0 - w), -g[k] * w), (-late * by_time, 0.0),
            (late, 0.0), (0.0, late * back), (-late * (1.0 - w), -late * w),
            (-per * wide * (y - half), -per * wide * half), ((2.0 * there - per * tau) * by_time, 0.0),
            (per, 0.0), (0.0, per * whole), (-per, 0.0),
            (-there, 0.0), (0.0, -there * whole), (inside + there * (1.0 - y), there * y - inside),
            (0.5 * root * grown, 0.5 * root * grown), (-root * held_mean, root * held_mean), (by_step, by_step),
            (1.0, 0.0), (-arm, 0.0), (-by_arm * cv, 0.0),
        )  # fmt: skip
        for link, (here, after) in enumerate(factors):
            out[link, 0, k], out[link, 1, k] = here, after
