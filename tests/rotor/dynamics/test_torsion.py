"""The rotating blade in torsion against closed forms, and the UH-60A's against its published fan plot."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

from rotor.design.blade import BladeStructure
from rotor.dynamics.structure import uh60a_structure
from rotor.dynamics.torsion import blade_modes, torsion_beam, torsion_modes

GJ, INERTIA, LENGTH, SPEED = 7e4, 0.15, 6.0, 27.0


def uniform(control: float = math.inf, gyration: float = 0.0) -> BladeStructure:
    return BladeStructure(
        radius=LENGTH, stations=(0.0, LENGTH), torsional_stiffness=(GJ, GJ), mass_per_length=(10.0, 10.0),
        torsional_inertia=(INERTIA, INERTIA), tension_gyration=gyration, clamp=0.0, control_stiffness=control,
        pitch_horn=0.2,
    )  # fmt: skip


def test_modes_of_a_uniform_blade_clamped_and_on_a_control_spring():
    """ω = π(2n − 1)/2 √(GJ/I_θ)/L, shapes sin((2n − 1)πr/2L)."""
    modes = blade_modes(uniform(), 0.0, 3)
    order = 2.0 * np.arange(1, 4) - 1.0
    assert_allclose(
        modes.frequency, 0.5 * math.pi * order * math.sqrt(GJ / INERTIA) / LENGTH, rtol=2e-4
    )
    expected = np.sin(0.5 * math.pi * np.outer(order, modes.r) / LENGTH)
    assert_allclose(modes.shape, expected / expected[:, -1:], atol=1e-3)
    assert_allclose(modes.inertia, 0.5 * INERTIA * LENGTH, rtol=1e-3)
    # GJ φ' = K_θ φ at the root of a uniform blade: kL tan kL = K_θ L/GJ.
    spring = 1.1e5
    root = brentq(lambda x: x * math.tan(x) - spring * LENGTH / GJ, 1e-6, 0.5 * math.pi - 1e-9)
    found = blade_modes(uniform(spring), 0.0, 1)
    assert_allclose(found.frequency[0], root * math.sqrt(GJ / INERTIA) / LENGTH, rtol=1e-4)
    assert_allclose(found.shape[0, 0], math.cos(root), rtol=1e-3)


@pytest.mark.parametrize("control", [math.inf, 1e5])
def test_rotation_adds_one_to_the_square_of_every_frequency(control: float):
    """ν² = ν0² + 1 by the propeller moment, without tension stiffness."""
    still, turning = (blade_modes(uniform(control), speed, 3).frequency for speed in (0.0, SPEED))
    assert_allclose((turning / SPEED) ** 2, (still / SPEED) ** 2 + 1.0, rtol=1e-9)


def test_static_twist_of_a_uniform_blade_by_hand():
    """A moment m per length of a clamped blade: φ_tip = m L²/2GJ; the modes add up to it."""
    modes = torsion_modes(torsion_beam(uniform(), 0.0), 12)
    moment = 200.0
    load = np.trapezoid(modes.shape, modes.r, axis=1) * moment
    assert_allclose((load / modes.stiffness).sum(), moment * LENGTH**2 / (2.0 * GJ), rtol=1e-3)


def test_fan_plot_of_the_uh60a():
    """First torsion and fourth flap, not to be told apart, at 20.56…21.04 Hz at rest and 20.98…22.36 Hz at 27 rad/s.

    Bowen-Davies, PhD thesis, University of Maryland, digitised by TU Munich. The control stiffness is an assumption
    made with this plot in view, so only the rise with rotation is independent.
    """
    still, turning = (
        blade_modes(uh60a_structure(), speed, 1).frequency[0] / (2.0 * math.pi)
        for speed in (0.0, SPEED)
    )
    assert 0.97 * 20.56 < still < 1.03 * 21.04
    assert 20.98 < turning < 22.36
    assert 0.98 - 0.56 < turning - still < 22.36 - 20.56
