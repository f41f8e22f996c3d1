"""The lines of every misprint run and show the difference."""

import math

import pytest
from numpy.testing import assert_allclose

from rotor.validation.thesis.misprints import MISPRINTS, Misprint, shown_values

BY_EQUATION = {one.equation: one for one in MISPRINTS}


@pytest.mark.parametrize("one", MISPRINTS, ids=lambda one: one.equation)
def test_the_two_values_differ(one: Misprint):
    printed, ours = shown_values(one)
    assert math.isfinite(printed)
    assert math.isfinite(ours)
    assert abs(printed - ours) > 1e-3 * abs(ours)
    assert "\n" not in one.setting + one.showing


def test_values_by_hand():
    """Values of the correct formula: 2λ², 2λ³, σC_d0/8, 15π/32, V/ΩR."""
    assert_allclose(shown_values(BY_EQUATION["2.26"])[1], 2 * 0.05**2, rtol=1e-6)
    assert_allclose(shown_values(BY_EQUATION["2.27"])[1], 2 * 0.05**3, rtol=1e-6)
    assert_allclose(shown_values(BY_EQUATION["2.32"])[1], 15 * math.pi / 32)
    printed, ours = shown_values(BY_EQUATION["3.15"])
    assert_allclose(ours, 0.0821 * 0.01 / 8, rtol=1e-5)  # midpoint sum of r³
    assert_allclose(printed / ours, 2.0)
    assert_allclose(shown_values(BY_EQUATION["throughout"])[1], 46.3 / 220.8276)
    assert_allclose(shown_values(BY_EQUATION["§3.2"])[1], 0.0065, rtol=2e-3)


def test_linear_inflow_does_not_respond_to_twist_and_the_wake_does():
    printed, ours = shown_values(BY_EQUATION["3.4 and abstract"])
    assert printed < 3.0 < 10.0 < ours  # The loss on the inflow responds, at the ends of the blade.
