"""Load factor as a quantity: a heavier aircraft with the same drag; in a climb power lifts the weight alone."""

from typing import Any

import pytest
from numpy.testing import assert_allclose

import rotor

SMALL: dict[str, Any] = {"elements": 12, "azimuths": 24, "inflow": "drees"}


def test_one_is_the_design_without_it():
    design = rotor.make_design(mu=0.2, **SMALL)
    assert design.at(load_factor=1.7).at(load_factor=1.0) == design
    assert "load_factor" not in design.to_dict()


@pytest.mark.parametrize("mu", [0.0, 0.02, 0.25])
def test_it_is_a_heavier_aircraft_with_the_same_drag(mu: float):
    """n = 1.2 at a mass m is n = 1 at 1.2 m."""
    design = rotor.make_design(mu=mu, mass_kg=7000, load_factor=1.2, **SMALL)
    turning, heavy = (rotor.solve(one).require() for one in (design, design.at(mass_kg=8400, load_factor=1)))
    assert_allclose(vars(turning.power)["induced"], heavy.power.induced, rtol=1e-9)
    assert_allclose(turning.power.total, heavy.power.total, rtol=1e-9)
    assert_allclose(turning.controls.array(), heavy.controls.array(), rtol=1e-7, atol=1e-10)
    assert turning.power.total > rotor.solve(design.at(load_factor=1)).require().power.total
    assert_allclose(turning.lift_to_drag or 0.0, heavy.lift_to_drag or 0.0, rtol=1e-9)


def test_in_a_climbing_turn_power_lifts_the_weight_alone():
    """Along the path the rotor pulls D + W sin γ, not n times the weight's part: W V_c is gained."""
    design = rotor.make_design(mu=0.2, climb_m_s=4.0, load_factor=1.5, off="download", **SMALL)
    turn, level = rotor.solve(design).require(), rotor.solve(design.at(climb_m_s=0.0)).require()
    assert_allclose(turn.power.climb, design.condition.weight * 4.0, rtol=1e-12)
    assert_allclose(turn.power.parasite, design.drag * design.flight_speed, rtol=1e-9)
    assert_allclose(turn.power.main_rotor, turn.power.shaft, rtol=1e-6)
    assert_allclose(turn.power.main_rotor - level.power.main_rotor, turn.power.climb, rtol=0.05)


def test_hover_needs_the_power_of_momentum_theory():
    """P_i ∝ n^1.5, of a rotor whose loading keeps its shape within per cents."""
    design = rotor.make_design(hover=True, off="download", **SMALL)
    one, two = (rotor.solve(design.at(load_factor=n)).require() for n in (1.0, 1.5))
    assert_allclose(two.power.induced / one.power.induced, 1.5**1.5, rtol=0.03)


def test_what_it_may_be():
    with pytest.raises(ValueError, match=r"load factor 9 is outside 0\.1…5: choose a value inside"):
        rotor.make_design(load_factor=9)
    assert "load factor 1.5" in repr(rotor.make_design(load_factor=1.5))
