"""Dynamic stall of one section: what it takes from static data, Theodorsen's lift, time marching, derivatives."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.aero.dynamic_stall import (
    DECAYING,
    LINKS,
    SEPARATION,
    VORTEX,
    StallData,
    empty_lags,
    stall_states,
)
from rotor.airfoil.sections import load_section
from rotor.airfoil.stall_onset import (
    LAG_PRESSURE,
    LAG_SEPARATION,
    LAG_VORTEX,
    POSITIVE,
    SLOPE,
    TRAVEL,
    ZERO,
    stall_onset,
)
from rotor.engine.memory import LagFactors, Lags
from rotor.engine.waves import wave_grid
from rotor.support.arrays import Array

TABLE = load_section("naca0012")
ONSET = stall_onset(TABLE)


def data(half_chord: float, tip_mach: float) -> StallData:
    return StallData(
        numbers=ONSET.numbers[None].copy(), tables=ONSET.tables[None].copy(), section=np.zeros((1, 2), np.int64),
        weight=np.zeros(1), half_chord=np.array([half_chord]), tip_mach=tip_mach,
    )  # fmt: skip


def followed(x: Any, mach: Any, own: StallData) -> tuple[Array, Array]:
    """What is added and the states."""
    n = len(x)
    added, shown = np.empty((3, n)), np.empty((4, n))
    stall_states(0, np.array(x), np.array(mach), own, False, added, empty_lags(0, n), shown)
    return added, shown


def remembered(x: Array, mach: Array, own: StallData) -> LagFactors:
    """The derivatives: forces are what is added, channels x and M."""
    n = len(x)
    linked, decays, factors, places = room = empty_lags(1, n)
    stall_states(0, x, mach, own, True, np.empty((3, n)), room, np.empty((4, n)))
    left, right = (
        np.repeat(np.eye(rows, columns)[:, :, None, None], n, axis=3)
        for rows, columns in ((3, 4), (2, 2))
    )
    return LagFactors(
        left, Lags(LINKS, DECAYING, linked, np.ones((1, n)), decays, factors, places), right
    )


@pytest.mark.parametrize("name", ["naca0012", "sc1095", "sc1094r8"])
@pytest.mark.parametrize("mach", [0.3, 0.4, 0.6])
def test_kirchhoffs_flow_gives_the_static_force_back(name: str, mach: float):
    """C_n = C_nα x ¼ (1 + √f)² wherever f is within its bounds."""
    table = load_section(name)
    found, node = stall_onset(table), round(mach * 20)
    x = np.deg2rad(np.arange(2.0, 20.0, 0.5))
    alpha = x + found.numbers[ZERO, node]
    static = table(alpha, mach)
    force = static.cl * np.cos(alpha) + static.cd * np.sin(alpha)
    f = found.tables[360 + np.arange(4, 40), node, 0, 0, 0]
    free = (f > 0.021) & (f < 0.999)
    assert free.any()
    made = found.numbers[SLOPE, node] * x * 0.25 * (1.0 + np.sqrt(f)) ** 2
    assert_allclose(made[free], force[free], rtol=1e-9)


def test_separation_reaches_leishman_and_beddoes_0_7_near_static_stall():
    """Their α1 of a NACA 0012 at Mach 0.4 is 12.5°, their C_n1 1.2."""
    found = stall_onset(load_section("naca0012"))
    f = found.tables[360:, 8, 0, 0, 0]
    assert 0.5 * float(np.argmax(f < 0.7)) == pytest.approx(12.5, abs=1.5)
    assert found.numbers[SLOPE, 8] * found.numbers[POSITIVE, 8] == pytest.approx(1.2, abs=0.2)
    assert found.numbers[TRAVEL, 8] == 9.0


def around(azimuths: int, degrees: float) -> tuple[Array, Array]:
    """x and M of a blade that stalls where it retreats, by the mean of x."""
    psi = 2.0 * np.pi * np.arange(azimuths) / azimuths
    return np.radians(degrees - 0.8 * degrees * np.sin(psi)), 0.463 + 0.203 * np.sin(psi)


@pytest.mark.parametrize("degrees", [-12.0, 0.0, 8.0, 14.0, 20.0])
def test_a_section_at_rest_has_its_static_data(degrees: float):
    still = np.full(24, math.radians(degrees)), np.full(24, 0.42)
    assert np.abs(followed(*still, data(0.03, 0.6))[0]).max() < 1e-12


def _marched(
    x: Array, mach: Array, own: StallData, turns: int = 4, fine: int = 4800
) -> tuple[Array, Array]:
    """f″ and C_nᵛ by explicit steps in time from rest, on the last of some turns."""
    numbers, steps = own.numbers[0], fine // len(x)
    around = np.append(np.arange(len(x)), len(x))
    at = np.arange(fine) / steps
    xs, ms = (np.interp(at, around, np.append(v, v[0])) for v in (x, mach))
    rows = np.array([np.interp(ms, np.arange(21) / 20.0, row) for row in numbers])
    b, v = own.half_chord[0], ms / own.tip_mach
    step = v * (2.0 * math.pi / fine) / b
    angles = np.radians(np.linspace(-30.0, 30.0, 1201))
    xf, f, cv, before = xs[0], 1.0, 0.0, 0.0
    history: list[tuple[float, float]] = []
    found = np.zeros((2, fine))
    tables = {m: _separation(angles, m) for m in np.round(np.unique(np.round(ms, 2)), 2)}
    travelled = 0.0
    for turn in range(turns):
        for k in range(fine):
            gate = np.clip((xf / rows[POSITIVE, k] - 0.96) / 0.08, 0.0, 1.0)
            gate = gate * gate * (3.0 - 2.0 * gate)
            history.append((travelled, gate))
            ago = travelled - rows[TRAVEL, k]
            late = 0.0
            if ago > 0.0:
                while len(history) > 1 and history[1][0] <= ago:
                    history.pop(0)
                late = history[0][1]
            feed = rows[SLOPE, k] * xs[k] * (1.0 - 0.25 * (1.0 + math.sqrt(f)) ** 2)
            cv += (
                gate * (1.0 - late) * (feed - before if turn + k else 0.0)
                - cv * step[k] / rows[LAG_VORTEX, k]
            )
            before = feed
            xf += (xs[k] - xf) * step[k] / rows[LAG_PRESSURE, k]
            f += (
                (np.interp(xf, angles, tables[round(float(ms[k]), 2)]) - f)
                * step[k]
                / rows[LAG_SEPARATION, k]
            )
            travelled += step[k]
            found[:, k] = f, cv
    return found[0, ::steps], found[1, ::steps]


def _separation(angles: Array, mach: float) -> Array:
    """Kirchhoff's f at a Mach number from the section's own data."""
    alpha = angles + float(np.interp(mach, np.arange(21) / 20.0, ONSET.numbers[3]))
    static = TABLE(alpha, mach)
    force = static.cl * np.cos(alpha) + static.cd * np.sin(alpha)
    slope = float(np.interp(mach, np.arange(21) / 20.0, ONSET.numbers[SLOPE]))
    ratio = np.where(
        np.abs(angles) < math.radians(1.0),
        1.0,
        force / np.where(angles == 0.0, 1.0, slope * angles),
    )
    return np.clip((2.0 * np.sqrt(np.maximum(ratio, 0.25)) - 1.0) ** 2, 0.02, 1.0)


def test_the_periodic_solution_is_that_of_marching_in_time():
    x, mach = around(24, 10.5)
    shown = followed(x, mach, data(0.04, 0.6))[1]
    separation, vortex = _marched(x, mach, data(0.04, 0.6))
    assert shown[SEPARATION].min() < 0.5
    assert shown[VORTEX].max() > 0.05
    assert np.abs(shown[SEPARATION] - separation).max() < 0.015  # .0123 on 48 azimuths.
    assert np.abs(shown[VORTEX] - vortex).max() < 0.01


@pytest.mark.parametrize("azimuths", [24, 48, 120])  # On finer azimuths, and on those themselves.
@pytest.mark.parametrize("degrees", [3.0, 10.0])  # Without and with a vortex.
def test_derivatives_are_exact(azimuths: int, degrees: float):
    own, (x, mach), random = data(0.04, 0.6), around(azimuths, degrees), np.random.default_rng(1)
    memory, (dx, dm) = remembered(x, mach, own), random.normal(size=(2, azimuths))
    ahead, behind = (followed(x + step * dx, mach + step * dm, own)[0] for step in (1e-7, -1e-7))
    expected = memory.times({0: dx[None], 1: dm[None]})[:, 0]
    assert (np.abs(followed(x, mach, own)[1][VORTEX]).max() > 0.0) == (degrees > 5.0)
    assert np.abs((ahead - behind) / 2e-7 - expected).max() < 1e-5 * np.abs(expected).max()


@pytest.mark.parametrize("azimuths", [24, 120])
@pytest.mark.parametrize("degrees", [3.0, 10.0])
def test_the_transposed_of_the_derivatives_is_exact(azimuths: int, degrees: float):
    memory, random = (
        remembered(*around(azimuths, degrees), data(0.04, 0.6)),
        np.random.default_rng(2),
    )
    fields, weights = random.normal(size=(2, 1, azimuths)), random.normal(size=(3, 1, azimuths))
    forces = memory.times(dict(enumerate(fields)))
    back = memory.transposed(weights)
    assert np.sum(back * fields) == pytest.approx(np.sum(weights * forces), rel=1e-12)
    waves = wave_grid(5, azimuths)
    by_inputs, means = memory.by_inputs(waves), (forces[:, 0] @ waves.mean)
    found = sum(
        memory.by_channel(by_inputs, c)[:, :, 0] @ field[0] for c, field in enumerate(fields)
    )
    assert_allclose(found, means, rtol=0, atol=1e-12 * np.abs(means).max())
