"""A section in unsteady attached flow: Theodorsen's force and moment, apparent mass by hand, energy, derivatives."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import make_design
from rotor.aero.inflow.interface import PLAIN
from rotor.aero.lifting_line import theodorsen
from rotor.aero.problem import build_problem
from rotor.aero.section import (
    CHANNELS,
    FX,
    FZ,
    LOSS,
    NO_INCREMENTS,
    NO_SCATTER,
    RATE,
    TH,
    UP,
    UT,
    M,
    SectionData,
)
from rotor.aero.unsteady_section import DTH, DUP, DUT, UnsteadyData, unsteady_interface
from rotor.airfoil.c81 import C81Block
from rotor.airfoil.section_table import N_ALPHA, bicubic_coefficients, mach_nodes
from rotor.support.arrays import Array
from rotor.trim.solve import analyse

N = 64
PSI = 2.0 * np.pi * np.arange(N) / N
SPEED, BLADES = 10.0, 4
REDUCED = np.array([0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0])
"""k of the elements: their half chords are k times the speed, in motion at one per revolution."""
B = REDUCED * SPEED
SECTION = unsteady_interface(PLAIN)
FIRST = len(CHANNELS)
SMALL = 1e-4


def plate() -> Array:
    """C_l = 2π sin α and no drag at any Mach number, as a table of the section."""
    degrees, mach = np.linspace(-180.0, 0.5 * N_ALPHA - 180.0, N_ALPHA + 1), mach_nodes()
    lift = np.repeat(2.0 * math.pi * np.sin(np.radians(degrees))[:, None], len(mach), axis=1)
    one = bicubic_coefficients(C81Block(mach, degrees, lift))
    return np.stack([one, np.zeros_like(one)], axis=2)[None]


def flat(half_chord: Array) -> UnsteadyData:
    """Elements of a flat plate at low speed on an elastic blade without inertia."""
    chord, tables, none = 2.0 * half_chord, plate(), np.zeros(len(half_chord))
    half_solidity, damping = BLADES * half_chord / math.pi, BLADES * half_chord**3
    own = SectionData(
        half_solidity=half_solidity, section=np.zeros((len(none), 2), np.int64), weight=none,
        offset=np.zeros((len(none), 2)), tables=tables, held=tables[:0], delay=none[:0],
        missing=tables[:0], held_missing=tables[:0],
        cos_sweep=none + 1.0, sin_sweep=none, tip_mach=1e-9, yawed=False, lossy=False,
        unloaded=np.zeros((0, 0), np.bool_), added=NO_INCREMENTS, scatter=NO_SCATTER,
        moment_gain=half_solidity * chord, damping=damping, lag=none,
        moment_tables=np.zeros_like(tables[:, :, :, :1]), inertia=none,
    )  # fmt: skip
    return UnsteadyData(
        own, own, half_chord=half_chord, arm=0.5 * half_chord, mass=BLADES * half_chord**2
    )


def moving(pitch: Any, plunge: Any, mean: float = 0.0) -> Array:
    """Channels of pitch Re(a exp iψ) and of a height Re(h exp iψ) with complex a, h, (elements,), without a wake."""
    wave = np.exp(1j * PSI)
    c = np.zeros((FIRST + 3, len(pitch), N))
    c[LOSS], c[UT] = 1.0, SPEED
    for channel, motion, order in (
        (TH, pitch, 0), (RATE, pitch, 1), (FIRST + DTH, pitch, 2), (UP, plunge, 1), (FIRST + DUP, plunge, 2),
    ):  # fmt: skip
        c[channel] = np.real(np.outer(motion * 1j**order, wave))
    c[TH] += mean
    return c


def first(values: Array) -> Array:
    """The first harmonic, complex, of rows around the azimuth."""
    return 2.0 * (values @ np.exp(-1j * PSI)) / N


@pytest.mark.parametrize(("pitches", "height"), [(1.0, 0.0), (0.0, 1.0), (0.7 + 0.2j, -0.4j)])
def test_force_and_moment_are_theodorsens_over_reduced_frequency(
    pitches: complex, height: complex
) -> None:
    """In the downwash of its wake, (1 − C) of that at three quarters of the chord: NACA Report 496, eqs. (XVIII), (XX).

    a = −½, h up. Amplitude and phase within 0.05 %.
    """
    data, s = flat(B), 1j
    alpha, h = np.full(len(B), SMALL * pitches), SMALL * height * B
    c = moving(alpha, h)
    wake = theodorsen(REDUCED)
    seen = SPEED * alpha - s * h + B * s * alpha
    c[UP] += np.real(np.outer((1.0 - wake) * seen, np.exp(1j * PSI)))
    f = SECTION.section(c, data, False, False)[0]
    mass = BLADES * B**2
    lift = mass * (-(s**2) * h + SPEED * s * alpha + 0.5 * B * s**2 * alpha)
    lift = lift + 2.0 * BLADES * SPEED * B * wake * seen
    moment = mass * (0.5 * B * s**2 * h - SPEED * B * s * alpha - 0.375 * B**2 * s**2 * alpha)
    assert_allclose(first(f[FZ]) / lift, 1.0, atol=5e-4)
    assert_allclose(first(f[M]) / moment, 1.0, atol=5e-4)


def test_without_a_wake_slow_motion_is_steady_and_a_step_has_wagners_half() -> None:
    """C is 1 at k = 0 and ½ where k has no bound, as Wagner's function begins with ½ and ends with 1."""
    slow, fast = theodorsen(np.array([1e-6, 1e4]))
    assert slow == pytest.approx(1.0, abs=1e-4)
    assert fast == pytest.approx(0.5, abs=1e-4)
    data = flat(np.array([1e-3 * SPEED]))
    f = SECTION.section(moving(np.array([SMALL]), np.zeros(1)), data, False, False)[0]
    still = PLAIN.section(
        moving(np.array([SMALL]), np.zeros(1))[:FIRST], data.section, False, False
    )[0]
    assert_allclose(f[FZ], still[FZ], atol=3e-3 * float(np.abs(still[FZ]).max()))


def test_apparent_mass_by_hand() -> None:
    """A plate of half chord 0.05 at rest in air, accelerated down by 2 and turned by 3: 4 π b² ρ of air over ρπ."""
    b = np.array([0.05])
    c = np.zeros((FIRST + 3, 1, N))
    c[LOSS], c[FIRST + DUP], c[FIRST + DTH] = 1.0, -2.0, 3.0
    f = SECTION.section(c, flat(b), False, False)[0][:, 0, 0]
    normal = 4.0 * 0.05**2 * (2.0 + 0.025 * 3.0)
    assert f[FZ] == pytest.approx(normal, rel=1e-12)
    assert f[FX] == pytest.approx(0.0, abs=1e-15)
    assert f[M] == pytest.approx(-0.025 * normal - 4.0 * 0.05**4 / 8.0 * 3.0, rel=1e-12)
    c[TH] = math.pi / 2.0  # Now the wind that grows along the blade's path is normal to the chord.
    c[FIRST + DUT] = 5.0
    f = SECTION.section(c, flat(b), False, False)[0][:, 0, 0]
    assert f[FX] == pytest.approx(4.0 * 0.05**2 * (5.0 + 0.025 * 3.0), rel=1e-12)
    assert f[FZ] == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize(("pitches", "height"), [(1.0, 0.0), (0.0, 1.0), (0.6 - 0.4j, 0.3 + 0.2j)])
def test_a_plate_without_friction_takes_no_power_over_a_cycle(
    pitches: complex, height: complex
) -> None:
    """The wake apart, lift, suction, apparent mass and moment close to second order of the motion."""
    c = moving(np.full(len(B), SMALL * pitches), SMALL * height * B)
    f = SECTION.section(c, flat(B), False, False)[0]
    power = c[UT] * f[FX] - c[UP] * f[FZ] - f[M] * c[RATE]
    scale = np.abs(c[UP] * f[FZ]).mean(axis=1) + np.abs(f[M] * c[RATE]).mean(axis=1)
    assert np.abs(power.mean(axis=1) / scale).max() < 1e-3


def test_reverse_flow_has_no_lag_and_the_moment_of_its_own_nose() -> None:
    """With the wind from behind the pitch axis is at three quarters of the chord: θ' adds no angle of attack."""
    data = flat(np.array([0.3]))
    c = moving(np.array([SMALL]), np.zeros(1))
    c[UT] = -SPEED
    alpha = SECTION.section(c, data, False, True)[2][0]
    assert_allclose(alpha, PLAIN.section(c[:FIRST], data.section, False, True)[2][0], atol=1e-12)


@pytest.mark.parametrize("bends", [False, True])
def test_derivatives_are_exact(bends: bool) -> None:
    problem = build_problem(
        make_design(mu=0.3, bending=bends, inflow="pitt-peters", off="dynamic-stall")
    )
    data, interface = problem.grid_data(1), problem.interface
    rng = np.random.default_rng(3)
    c = 0.05 * rng.normal(size=(interface.channels, *problem.disk.shape))
    c[UT] += problem.disk.r[:, None] + 0.3 * problem.disk.sin
    c[LOSS] = 1.0
    way = rng.normal(size=c.shape)
    way[LOSS] = 0.0
    d = interface.section(c, data, True, False)[1]
    exact = np.zeros((interface.forces, *problem.disk.shape))
    for (force, channel), slope in zip(interface.pairs, d, strict=True):
        if channel != LOSS:
            exact[force] += slope * way[channel]
    step = 1e-7
    ahead, behind = (
        interface.section(c + sign * step * way, data, False, False)[0] for sign in (1.0, -1.0)
    )
    missing = np.abs((ahead - behind) / (2.0 * step) - exact)
    assert np.median(missing) < 1e-9
    assert (
        missing < 1e-5 * np.abs(exact).max(axis=(1, 2), keepdims=True)
    ).mean() > 0.995  # But for edges of cells.


def test_rates_of_a_trim_are_those_of_its_motion() -> None:
    """θ'' and the rates of U_T and U_P are the Fourier derivatives of the channels, but for the inflow in U_P."""
    design = make_design(mu=0.3, inflow="uniform", pitch_per_rev="3:1:60", off="tip-loss,hub-loss")
    e = analyse(design).linear
    rates, n = e.elements.rates, len(e.elements.beta)
    waves = np.fft.rfftfreq(n, 1.0 / n)

    def derivative(field: Array) -> Array:
        return np.fft.irfft(1j * waves * np.fft.rfft(field, axis=1), n=n, axis=1)

    assert_allclose(rates[DTH], derivative(e.elements.rate), atol=1e-10)
    assert_allclose(rates[DUT], derivative(e.elements.u_t), atol=1e-10)
    assert_allclose(rates[DUP], derivative(e.elements.u_p), atol=1e-10)
