"""Stability of the blade against hand calculations of a uniform blade, time marching and Floquet's theorem."""

import math
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

from rotor.aero.inflow.interface import PLAIN, SectionInterface
from rotor.aero.section import M
from rotor.aero.unsteady_section import unsteady_interface
from rotor.airfoil.c81 import C81Block, C81Deck, format_c81
from rotor.airfoil.sections import OwnSection
from rotor.design.blade import BladeStructure, Span
from rotor.design.design import Design
from rotor.design.twist import parse_twist
from rotor.files.make_design import make_design
from rotor.support.arrays import Array
from rotor.trim.blade_system import blade_system
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from rotor.trim.stability import (
    damped_modes,
    divergence_stiffness,
    exponents,
    linearised,
    margins,
    stability,
    stability_boundary,
)

SLOPE, CHORD, ROOT = 5.7, 0.5, 0.1
MASS, INERTIA, SPRING = 10.0, 0.15, 3e4
"""m [kg/m], I_θ [kg m] and K_θ [N m/rad] of the uniform blade."""


def linear_section() -> OwnSection:
    """C_l = 5.7 α up to 20°, no moment."""
    degrees = np.unique(np.concatenate([np.linspace(-180.0, 180.0, 37), np.linspace(-20.0, 20.0, 41)]))
    mach, alpha = np.array([0.0, 1.0]), np.deg2rad(degrees)
    lift = SLOPE * np.clip(alpha, -math.radians(20.0), math.radians(20.0)) * (np.abs(degrees) < 170.0)

    def block(values: Array) -> C81Block:
        return C81Block(mach, degrees, np.stack([values, values], axis=1))

    drag, none = np.where(np.abs(degrees) <= 20.0, 0.001, 0.1), np.zeros_like(lift)
    return OwnSection(
        "linear", format_c81(C81Deck("linear", block(lift), block(drag), block(none))), "naca0012", "test"
    )


def uniform(offset: float = 0.0, mu: float = 0.0) -> Design:
    """A uniform blade, rigid but for a spring at its pitch bearing, hinged at the shaft, with little lift."""
    design = make_design(mu=mu, mass_kg=1500.0, off="compressibility,tip-loss,swirl")
    rotor = design.rotor
    radius = rotor.radius
    structure = BladeStructure(
        radius=radius, stations=(0.0, radius), torsional_stiffness=(1e9, 1e9), mass_per_length=(MASS, MASS),
        torsional_inertia=(INERTIA, INERTIA), tension_gyration=0.0, clamp=ROOT * radius, control_stiffness=SPRING,
        pitch_horn=0.2, mass_offset=(offset, offset),
    )  # fmt: skip
    blade = replace(
        rotor.blade, root_cutout=ROOT, chord_stations=(0.0, 1.0), chords=(CHORD, CHORD),
        spans=(Span(ROOT, 1.0, "linear"),), flap_hinge=0.0, flap_inertia=MASS * radius**3 / 3.0,
        flap_static_moment=MASS * radius**2 / 2.0, mass=MASS * radius, tip_sweep=0.0, surface_drag=1.0,
        own_sections=(linear_section(),), structure=structure,
    )  # fmt: skip
    return replace(design, rotor=replace(rotor, blade=blade), twist=parse_twist("linear:0"))


@dataclass(frozen=True)
class Hand:
    """The blade by hand: Theodorsen with C = 1 about the quarter chord, small angles, hover, no induced flow.

    L = ½ρac U (Uθ − w' + bθ') + ρπb² (−w'' + Uθ' + ½bθ''), M = −½b ρπb² (…) − ½ρπb³ Uθ' − ⅛ρπb⁴ θ'', U = Ωr.
    These are the equations of pitch–flap flutter of Johnson, Helicopter Theory, ch. 12 (β and θ of a rigid blade).
    """

    density: float
    radius: float
    speed: float
    offset: float
    spring: float = SPRING

    def matrices(self) -> tuple[Array, Array, Array]:
        """Mass, damping and stiffness of (β, θ), over Ω²."""
        low, high = ROOT * self.radius, self.radius
        n = [(high ** (k + 1) - low ** (k + 1)) / (k + 1) for k in range(4)]
        b, q = 0.5 * CHORD, 0.5 * self.density * SLOPE * CHORD
        air = self.density * math.pi * b**2
        flap = MASS * high**3 / 3.0
        coupled = MASS * self.offset * (high**2 - low**2) / 2.0
        pitch = INERTIA * (high - low)
        mass = np.array([
            [flap + air * n[2], -coupled - 0.5 * air * b * n[1]],
            [-coupled - 0.5 * air * b * n[1], pitch + (0.25 + 0.125) * air * b**2 * n[0]],
        ])  # fmt: skip
        damping = np.array([[q * n[3], -q * b * n[2] - air * n[2]], [0.0, air * b * n[1]]])
        stiffness = np.array([[flap, -coupled - q * n[3]], [-coupled, self.spring / self.speed**2 + pitch]])
        return mass, damping, stiffness

    def growth(self) -> float:
        """The largest real part of the roots of the quartic det(M λ² + C λ + K) = 0, per radian."""
        m, c, k = self.matrices()
        rows = [[(m[i, j], c[i, j], k[i, j]) for j in range(2)] for i in range(2)]
        quartic = np.polysub(np.polymul(rows[0][0], rows[1][1]), np.polymul(rows[0][1], rows[1][0]))
        return float(np.roots(quartic).real.max())


def by_hand(design: Design, offset: float, spring: float = SPRING) -> Hand:
    return Hand(design.condition.density, design.rotor.radius, design.rotor.angular_speed, offset, spring)


def test_flap_damping_in_hover_is_a_sixteenth_of_the_lock_number():
    """λ² I' + λ C + I = 0: with a root cut-out and apparent mass to 1 %, and ζ = γ/16 without them to 3 %."""
    design = uniform()
    system = blade_system(linearised(design)).only(("flap",))
    (found,) = damped_modes(system, exponents(system.at()))
    mass, damping, stiffness = by_hand(design, 0.0).matrices()
    expected = np.roots([mass[0, 0], damping[0, 0], stiffness[0, 0]])[0]
    assert found.growth == pytest.approx(expected.real, rel=0.01)
    assert found.frequency == pytest.approx(abs(expected.imag), rel=0.01)
    lock = design.condition.density * SLOPE * CHORD * design.rotor.radius**4 / design.rotor.blade.flap_inertia
    assert found.damping_ratio == pytest.approx(lock / 16.0, rel=0.03)


def test_torsion_in_hover_is_that_of_its_spring_and_the_air():
    """(I + ⅜ρπb⁴) θ'' + ρπb³ Uθ' + (K_θ + I Ω²) θ = 0, to 1 %: flap held."""
    design = uniform()
    system = blade_system(linearised(design)).only(("torsion",)).at()[0]
    kept = [0, 2]  # The first mode; the second is the blade's twist at 1e9 N m².
    mass, damping, stiffness = by_hand(design, 0.0).matrices()
    expected = np.roots([mass[1, 1], damping[1, 1], stiffness[1, 1]])[0]
    found = np.linalg.eigvals(system[np.ix_(kept, kept)])
    assert found.real.max() == pytest.approx(expected.real, rel=0.01)
    assert np.abs(found.imag).max() == pytest.approx(abs(expected.imag), rel=0.01)


@pytest.mark.parametrize("offset", [0.02, 0.05])
def test_divergence_by_hand(offset: float):
    """K_θ = I_x (I_x + ¼ρacR⁴…) Ω²/I_β − I_θ Ω²: the lift by pitch raises the blade, and its mass twists it."""
    design = uniform(offset)
    _, _, k = by_hand(design, offset, spring=0.0).matrices()
    spring = (k[0, 1] * k[1, 0] / k[0, 0] - k[1, 1]) * design.rotor.angular_speed**2
    assert spring > 0.0
    system = blade_system(linearised(design)).only(("flap", "torsion"))
    assert divergence_stiffness(system) == pytest.approx(spring / SPRING, rel=0.02)


@pytest.mark.parametrize(("offset", "flutters"), [(0.01, False), (0.03, True), (0.06, True)])
def test_pitch_flap_boundary_is_that_of_the_quartic(offset: float, flutters: bool):
    """The stiffness of the control system that the blade needs, to 2 %: to flutter, or to divergence where that is
    first."""
    design = uniform(offset)
    springs = np.geomspace(100.0 * SPRING, 0.01 * SPRING, 200)
    rates = [by_hand(design, offset, spring).growth() for spring in springs]
    first = int(np.flatnonzero(np.array(rates) > 0.0)[0])
    expected = brentq(lambda spring: by_hand(design, offset, spring).growth(), springs[first], springs[first - 1])
    (point,) = stability_boundary(design, (0.0,))
    assert point.instability_stiffness == pytest.approx(expected / SPRING, rel=0.02)
    assert (point.instability_stiffness > 1.02 * point.divergence_stiffness) == flutters


def test_how_far_aft_the_centre_of_gravity_may_be():
    """The quartic again, over the offset, to 2 %."""
    design = uniform()
    aft = brentq(lambda x: by_hand(design, x).growth(), 0.001, 0.2)
    found = margins(design).offset
    assert found == pytest.approx(aft / CHORD, rel=0.02)


@cache
def uh60a(mu: float) -> Solution:
    return solve(make_design(mu=mu)).require()


def marched(system: Array, turns: float, start: Array, steps: int = 1440) -> Array:
    """States over ψ by Runge and Kutta's method, A as its Fourier series; (steps of the whole, states, columns)."""
    count = len(system)
    order = np.arange(-((count - 1) // 2), (count - 1) // 2 + 1)
    series = (np.fft.fft(system, axis=0) / count)[order]

    def at(psi: float) -> Array:
        return np.einsum("k,kij->ij", np.exp(1j * order * psi), series).real

    step, z, out = 2.0 * math.pi / steps, start.astype(float), [start.astype(float)]
    for k in range(round(turns * steps)):
        first, middle, last = (at((k + half) * step) for half in (0.0, 0.5, 1.0))
        k1 = first @ z
        k2 = middle @ (z + 0.5 * step * k1)
        k3 = middle @ (z + 0.5 * step * k2)
        k4 = last @ (z + step * k3)
        z = z + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        out.append(z)
    return np.stack(out)


def test_hills_matrix_agrees_with_floquets_theorem_at_speed():
    """At µ 0.35, all modes: every real part is that of a multiplier to 0.002, and every multiplier is found."""
    system = blade_system(linearised(uh60a(0.35)))
    found = exponents(system.at(), 8)
    n = 2 * len(system.names)
    turn = marched(system.at(), 1.0, np.eye(n))[-1]
    expected = np.log(np.linalg.eigvals(turn).astype(complex)) / (2.0 * math.pi)
    assert_allclose(np.sort(found.values.real), np.sort(expected.real), atol=0.003)
    for mode in damped_modes(system, found):
        apart = complex(mode.growth, mode.frequency) - expected
        assert np.abs(apart - 1j * np.round(apart.imag)).min() < 0.004, mode


def test_a_march_in_time_dies_away_as_the_least_damped_mode_does():
    """After 6 turns the lag mode alone is left: its decay over the next 4 is that of its exponent to 1 %."""
    system = blade_system(linearised(uh60a(0.0)))
    found = damped_modes(system, exponents(system.at()))
    least = max(found, key=lambda mode: mode.growth)
    assert least.name == "lag 1"
    n = 2 * len(system.names)
    motion = marched(system.at()[:1], 24.0, np.ones((n, 1)), 400)[:, :, 0]
    period = 1.0 / least.frequency  # [turns]
    ends = [np.abs(motion[round(400 * t) : round(400 * (t + period)) + 1]).max() for t in (8.0, 8.0 + 3.0 * period)]
    rate = math.log(ends[1] / ends[0]) / (2.0 * math.pi * 3.0 * period)
    assert rate == pytest.approx(least.growth, rel=0.02)


def test_frequencies_in_hover_are_near_those_in_vacuum():
    """Damped flap is lower by √(1 − ζ²), and lag 1 and torsion move by a few per cent."""
    frequencies = uh60a(0.0).blade_frequencies
    found = stability(uh60a(0.0), with_margins=False)
    flap = found.mode("flap 1")
    assert math.hypot(flap.frequency, flap.growth) == pytest.approx(frequencies.flap[0], rel=0.05)
    assert found.mode("lag 1").frequency == pytest.approx(frequencies.lag[0], rel=0.05)
    assert found.mode("torsion 1").frequency == pytest.approx(frequencies.torsion[0], rel=0.05)


def test_shed_vorticity_damps_flap_less():
    """Theodorsen's |C| < 1: less damping of flap, which no longer is γ/16; and no state of the air is unstable."""
    attached, shed = (stability(uh60a(0.0), air=air, with_margins=False) for air in ("quasi-steady", "unsteady"))
    assert 0.8 < shed.mode("flap 1").growth / attached.mode("flap 1").growth < 1.1
    assert shed.mode("flap 2").damping_ratio < attached.mode("flap 2").damping_ratio
    assert shed.stable


def test_slow_motion_feels_all_of_the_lift():
    """The two lags of shed vorticity end at one: their static stiffness is that of quasi-steady air."""
    linear = linearised(uh60a(0.0))
    steady, shed = blade_system(linear), blade_system(linear, shed=True)
    n = len(steady.names)
    a = shed.at()[0]
    held = a[: 2 * n, 2 * n :] @ np.linalg.solve(a[2 * n :, 2 * n :], a[2 * n :, : 2 * n])
    assert_allclose((a[: 2 * n, : 2 * n] - held)[n:, :n], steady.at()[0][n:, :n], rtol=1e-6, atol=1e-8)


@pytest.mark.parametrize("shed", [False, True])
def test_a_rigid_blade_does_not_read_slopes_of_the_moment(shed: bool, monkeypatch: pytest.MonkeyPatch):
    """Its section leaves them undefined: what memory held there before, seldom not a number."""

    def undefined(interface: SectionInterface) -> SectionInterface:
        moment = [force == M for force, _ in interface.pairs]

        def section(*arguments: Any) -> Any:
            forces, slopes, flow = interface.section(*arguments)
            slopes[moment] = math.nan
            return forces, slopes, flow

        return replace(interface, section=section)

    linear = linearised(make_design(rotor="r22", mu=0.2))
    wanted = blade_system(linear, shed=shed).at()
    monkeypatch.setattr("rotor.trim.blade_system.PLAIN", undefined(PLAIN))
    monkeypatch.setattr(
        "rotor.trim.blade_system.unsteady_interface", lambda plain: undefined(unsteady_interface(plain))
    )
    assert_allclose(blade_system(linear, shed=shed).at(), wanted, rtol=1e-12, atol=1e-12)


def test_a_rigid_blade_has_flap_alone_and_no_margins():
    found = stability(make_design(rotor="r22", mu=0.0))
    assert [mode.name for mode in found.modes] == ["flap 1"]
    assert found.margins is None
    assert stability_boundary(found.design, (0.0,)) == ()
    with pytest.raises(ValueError, match="rigid in torsion"):
        margins(found.design)


def test_bad_input_is_named():
    with pytest.raises(ValueError, match="quasi-steady or unsteady"):
        stability(uh60a(0.0), air="steady")  # pyright: ignore[reportArgumentType]
    with pytest.raises(ValueError, match="chords"):
        stability(uh60a(0.0), offset=2.0)
    with pytest.raises(KeyError, match="no mode 'flap 9'"):
        stability(uh60a(0.0), with_margins=False).mode("flap 9")
