"""Dynamic stall of one section: what it takes from static data, Theodorsen's lift, time marching, derivatives."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import kv

from rotor.aero import dynamic_stall
from rotor.aero.dynamic_stall import ADDED_M, ADDED_N, SEPARATION, VORTEX, StallData, follow
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
from rotor.arrays import Array

TABLE = load_section("naca0012")
ONSET = stall_onset(TABLE)


def data(half_chord: float, tip_mach: float, *, sheds: bool = True) -> StallData:
    section, weight = np.zeros((1, 2), np.int64), np.zeros(1)
    return StallData(
        ONSET.numbers[None].copy(), ONSET.tables[None].copy(), section, weight, np.array([half_chord]), tip_mach, sheds
    )


def followed(x: Any, mach: Any, q: Any, own: StallData, *, slopes: bool = False) -> tuple[Array, Array, Array]:
    """What is added, its slopes and the states."""
    n = len(x)
    added, by, shown = np.empty((3, n)), np.empty((3, n, 3 * n if slopes else 0)), np.empty((4, n))
    follow(0, np.array(x), np.array(mach), np.array(q), own, slopes, added, by, shown)
    return added, by, shown


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


PSI = 2.0 * np.pi * np.arange(24) / 24
RETREATING = np.radians(10.0 - 8.0 * np.sin(PSI)), 0.463 + 0.203 * np.sin(PSI), 0.01 * np.cos(PSI)


@pytest.mark.parametrize("degrees", [-12.0, 0.0, 8.0, 14.0, 20.0])
def test_a_section_at_rest_has_its_static_data(degrees: float):
    still = np.full(24, math.radians(degrees)), np.full(24, 0.42), np.zeros(24)
    assert np.abs(followed(*still, data(0.03, 0.6))[0]).max() < 1e-12


@pytest.mark.parametrize("k", [0.05, 0.1, 0.2])
def test_attached_lift_is_theodorsens(k: float):
    """Pitching about the quarter chord by a tenth of a degree where no wake sheds: circulatory lift within 3 %.

    One turn is one period: with V = 1 the half chord is k. The slope of lift is that of the section, not 2π.
    """
    alpha = math.radians(0.1) * np.sin(2.0 * np.pi * np.arange(96) / 96)
    q = k * math.radians(0.1) * np.cos(2.0 * np.pi * np.arange(96) / 96)
    added = followed(alpha, np.full(96, 0.35), q, data(k, 0.35, sheds=False))[0][ADDED_N]
    slope = float(np.interp(0.35, np.arange(21) / 20.0, ONSET.numbers[SLOPE]))
    wave = np.exp(-2j * np.pi * np.arange(96) / 96)
    found = ((added + slope * alpha) @ wave) / ((slope * alpha) @ wave)
    mass = math.pi * 1j * k * (1.0 + 0.5j * k) / slope / (1.0 + dynamic_stall.SLOWEST**2)  # π d(x + ½q)/ds
    circulatory = (found - mass) / (1.0 + 1j * k)
    one, zero = kv([1.0, 0.0], np.full(2, 1j * k))
    assert abs(circulatory / complex(one / (one + zero)) - 1.0) < 0.03


@pytest.mark.parametrize("k", [0.1, 0.5])
def test_moment_of_apparent_mass_is_theodorsens(k: float):
    """About the quarter chord, pitching about it: C_m = −π/2 (q + ⅜ dq/ds) (NACA Report 496); circulation adds nothing.

    The first term is the damping that `rotor.aero.section` has. SLOWEST leaves 1 % out.
    """
    own = data(k, 0.35)
    own.tables[..., 1, :, :] = 0.0  # The normal force acts at the quarter chord.
    wave = np.exp(2j * np.pi * np.arange(96) / 96)
    alpha, q = math.radians(0.1) * np.imag(wave), k * math.radians(0.1) * np.real(wave)
    added = followed(alpha, np.full(96, 0.35), q, own)[0][ADDED_M] - 0.5 * math.pi * q
    found = (added @ wave.conj()) / (alpha @ wave.conj())
    assert found == pytest.approx(-0.5 * math.pi * (1j * k + 0.375 * (1j * k) ** 2), rel=0.01)


def _marched(x: Array, mach: Array, own: StallData, turns: int = 4, fine: int = 4800) -> tuple[Array, Array]:
    """f″ and C_nᵛ by explicit steps in time from rest, on the last of some turns; without pitch rate."""
    numbers, steps = own.numbers[0], fine // len(x)
    around = np.append(np.arange(len(x)), len(x))
    at = np.arange(fine) / steps
    xs, ms = (np.interp(at, around, np.append(v, v[0])) for v in (x, mach))
    rows = np.array([np.interp(ms, np.arange(21) / 20.0, row) for row in numbers])
    b, v = own.half_chord[0], ms / own.tip_mach
    step = v * (2.0 * math.pi / fine) / b
    knots = (8.0 * (np.roll(x, -1) - np.roll(x, 1)) - np.roll(x, -2) + np.roll(x, 2)) / 12.0
    speed = mach / own.tip_mach
    mass = math.pi * b * speed / (speed**2 + 0.01) * knots * len(x) / (2.0 * math.pi)
    pressure = xs + np.interp(at, around, np.append(mass, mass[0])) / rows[SLOPE]
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
            cv += gate * (1.0 - late) * (feed - before if turn + k else 0.0) - cv * step[k] / rows[LAG_VORTEX, k]
            before = feed
            xf += (pressure[k] - xf) * step[k] / rows[LAG_PRESSURE, k]
            f += (np.interp(xf, angles, tables[round(float(ms[k]), 2)]) - f) * step[k] / rows[LAG_SEPARATION, k]
            travelled += step[k]
            found[:, k] = f, cv
    return found[0, ::steps], found[1, ::steps]


def _separation(angles: Array, mach: float) -> Array:
    """Kirchhoff's f at a Mach number from the section's own data."""
    alpha = angles + float(np.interp(mach, np.arange(21) / 20.0, ONSET.numbers[3]))
    static = TABLE(alpha, mach)
    force = static.cl * np.cos(alpha) + static.cd * np.sin(alpha)
    slope = float(np.interp(mach, np.arange(21) / 20.0, ONSET.numbers[SLOPE]))
    ratio = np.where(np.abs(angles) < math.radians(1.0), 1.0, force / np.where(angles == 0.0, 1.0, slope * angles))
    return np.clip((2.0 * np.sqrt(np.maximum(ratio, 0.25)) - 1.0) ** 2, 0.02, 1.0)


def test_the_periodic_solution_is_that_of_marching_in_time():
    x, mach, _ = RETREATING
    shown = followed(x, mach, np.zeros(24), data(0.04, 0.6))[2]
    separation, vortex = _marched(x, mach, data(0.04, 0.6))
    assert shown[SEPARATION].min() < 0.5
    assert shown[VORTEX].max() > 0.05
    assert np.abs(shown[SEPARATION] - separation).max() < 0.012
    assert np.abs(shown[VORTEX] - vortex).max() < 0.01


@pytest.mark.parametrize("sheds", [True, False])
def test_derivatives_are_exact(sheds: bool):
    own, way = data(0.04, 0.6, sheds=sheds), np.random.default_rng(1).normal(size=(3, 24))
    by = followed(*RETREATING, own, slopes=True)[1]
    x, mach, q = RETREATING
    ahead, behind = (
        followed(x + step * way[0], mach + step * way[1], q + step * way[2], own)[0] for step in (1e-6, -1e-6)
    )
    expected = by @ way.ravel()
    assert np.abs((ahead - behind) / 2e-6 - expected).max() < 1e-5 * np.abs(expected).max()
