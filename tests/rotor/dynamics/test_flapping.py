"""Flapping by harmonic balance against the equation of motion marched in time (the document's ode45)."""

import math

import pytest
from numpy.testing import assert_allclose

from rotor.aero.problem import build_problem
from rotor.dynamics.flapping import flap_dynamics, lock_number
from rotor.files.make_design import make_design, uh60a_rotor
from rotor.trim.forward import first_guess
from rotor.trim.newton import newton
from rotor.validation.verification import marched_flapping


@pytest.mark.parametrize(("preset", "mu"), [("flight", 0.15), ("thesis", 0.15), ("thesis", 0.3)])
def test_ode_agrees_with_harmonic_balance(preset: str, mu: float):
    """First harmonics of the marched motion against the balance: the difference is the neglected 2/rev and higher."""
    marched, balanced, second = marched_flapping(preset, mu)
    # A 2/rev motion of amplitude b reaches 1/rev only through µ: its velocity 2br meets µ sin ψ (4/3 µb against the
    # damping ∫r³), its slope meets µ cos ψ (2/3 µb). So 2µb bounds what the balance neglects.
    assert_allclose(marched, balanced, atol=2.0 * mu * second + 2e-5)
    assert second < math.radians(0.6)


def test_no_hinge_offset_leaves_no_first_harmonic_moment():
    design = make_design(
        preset="thesis", mu=0.25, twist="linear:-10", inflow="pitt-peters", off="elastic-twist"
    )
    problem = build_problem(design)
    moment = (
        problem.disk.r * problem.disk.dr @ newton(problem, first_guess(problem)).linear.elements.fz
    )
    assert_allclose((moment @ problem.disk.cos, moment @ problem.disk.sin), 0.0, atol=1e-11)


def test_published_flap_frequency_and_lock_number():
    """ν = 1.035/rev and γ = 8.07 for c = 1.73 ft (8.19 published, TM-85890) at a = 5.73, sea level."""
    rotor = uh60a_rotor("flight")
    assert_allclose(math.sqrt(rotor.flap_frequency_squared), 1.035, atol=1e-3)
    assert_allclose(lock_number(rotor, 1.225, 5.73), 8.07, atol=0.05)


def test_inertia_of_the_document_and_weight_of_the_blade():
    """13.92 kg/m about a hinge at the centre: m R³/3 = 2539 kg m², Lock number 6.5."""
    rotor = uh60a_rotor("thesis")
    assert_allclose(rotor.blade.flap_inertia, 2539.0, atol=1.0)
    assert_allclose(lock_number(rotor, 1.225, 5.73), 6.5, atol=0.05)
    assert rotor.flap_frequency_squared == 1.0
    # g S/(I Ω²) = 9.807·385.66/(2050.8·729) = 0.00253 rad.
    rotor = uh60a_rotor("flight")
    assert_allclose(flap_dynamics(rotor, 1.225, blade_weight=True).weight, 0.00253, atol=1e-5)
    assert flap_dynamics(rotor, 1.225, blade_weight=False).weight == 0.0
