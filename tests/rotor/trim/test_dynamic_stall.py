"""Trims with dynamic stall: exact derivatives, gradients, convergence, and nothing where it is off."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rotor import make_design, solve
from rotor.design.design import Design
from rotor.trim.adjoint import Adjoint, power_gradient
from rotor.trim.distribution import distribution
from tests.rotor.check_jacobian import check_along

HEAVY: dict[str, Any] = {"mu": 0.35, "mass_kg": 9500.0}


def steady(design: Design) -> Design:
    return replace(design, models=replace(design.models, dynamic_stall=False))


@pytest.mark.parametrize("changed", [{}, {"off": "elastic-twist"}, {"bending": True}])
def test_the_jacobian_is_exact(changed: dict[str, Any]):
    solution = solve(make_design(**HEAVY, dynamic_stall=True, **changed)).require()
    assert solution.disk.unsteady is not None
    assert solution.disk.unsteady.separation.min() < 0.5
    point = Adjoint(solution).point
    along = np.random.default_rng(0).normal(size=len(point.system.free)) * point.system.limits
    check_along(point, along * (1e-5 / np.abs(along).max()), 1e-5)


def test_the_gradient_is_that_of_trims():
    """Power by linear twist. The wake lies still, as it does for the gradient."""
    design = make_design(**HEAVY, twist="linear:-10", dynamic_stall=True)
    solution = solve(design).require()
    gradient = power_gradient(solution)
    along = gradient.along((gradient.r - 0.75)[None])[0]
    powers = [solve(design.with_twist(f"linear:{rate}"), solution).require().power.total for rate in (-9.99, -10.01)]
    assert along == pytest.approx((powers[0] - powers[1]) / np.radians(0.02), rel=2e-3)


def test_random_designs_trim_as_with_steady_sections():
    rng = np.random.default_rng(3)
    for _ in range(6):
        mu, rate, mass = rng.uniform(0.1, 0.4), rng.uniform(-24.0, 0.0), rng.uniform(6500.0, 10000.0)
        design = make_design(mu=float(mu), twist=f"linear:{rate:.2f}", mass_kg=float(mass), dynamic_stall=True)
        unsteady, still = solve(design), solve(steady(design))
        assert unsteady.converged or not still.converged, unsteady.message
        assert unsteady.power.total == pytest.approx(still.power.total, rel=0.05)


def test_stalled_lift_comes_later_and_is_more():
    design = make_design(**HEAVY, dynamic_stall=True)
    unsteady, still = solve(design).require(), solve(steady(design)).require()
    assert unsteady.power.total < 0.995 * still.power.total
    assert np.nanmin(distribution(unsteady).cm) < np.nanmin(distribution(still).cm) - 0.01
    assert not [caveat for caveat in unsteady.caveats if "without dynamic stall" in caveat.sentence]


@pytest.mark.parametrize("given", [{"hover": True}, {"mu": 0.3, "inflow": "local-momentum"}])
def test_no_effect_in_hover_and_where_the_section_balances_itself(given: dict[str, Any]):
    design = make_design(**given, dynamic_stall=True)
    assert solve(design).power.total == solve(steady(design)).power.total
