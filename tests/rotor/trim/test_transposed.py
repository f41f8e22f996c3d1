"""The transposed equations of a trim: the gradient with derivatives of a trim nearby is that with its own."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotor.trim.adjoint as adjoint_module
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.trim.adjoint import Adjoint, PitchGradient, Weights, power_along, power_gradient
from rotor.trim.newton import KEPT, KeptTrim, differentiate
from rotor.trim.solution import Solution
from rotor.trim.solve import solve


def design(
    mu: float, rate: float, inflow: str = "dynamic-wake", *, elastic: bool = True, preset: str = "flight"
) -> Design:
    made = make_design(preset=preset, twist=f"linear:{rate:g}", mu=mu)
    return replace(made, models=replace(made.models, inflow=inflow, elastic_twist=elastic))


def at(solution: Solution, derivatives_of: Solution | None) -> Adjoint:
    """The adjoint of a solution that keeps the exact derivatives of another trim; without one its own."""
    own = Adjoint(solution)
    kept = None
    if derivatives_of is not None:
        other = Adjoint(derivatives_of)
        _, kept = differentiate(other.problem, other.elements, own._transposed.unknowns)
    KEPT.keep(KeptTrim(solution.disk.induced, kept, own.elements, own.problem))
    return Adjoint(solution)


@pytest.fixture
def evaluated(monkeypatch: pytest.MonkeyPatch) -> list[object]:
    """What new derivatives were evaluated of."""
    made: list[object] = []
    monkeypatch.setattr(adjoint_module, "differentiate", lambda *of: made.append(of) or differentiate(*of))
    return made


@pytest.mark.parametrize("elastic", [False, True], ids=["rigid", "elastic"])
@pytest.mark.parametrize("mu", [0.1, 0.3])  # At the first forward flight is joined with hover.
@pytest.mark.parametrize(
    "inflow", ["dynamic-wake", "dynamic-wake-quick", "dynamic-wake-infinite-blades", "pitt-peters", "drees"]
)
def test_gradient_with_the_derivatives_of_a_trim_nearby(inflow: str, mu: float, elastic: bool, evaluated: list[object]):
    near = solve(design(mu, -14.0, inflow, elastic=elastic)).require()
    here = solve(design(mu + 0.002, -13.0, inflow, elastic=elastic), near).require()
    for objective in ("total", "induced"):
        own = power_along(at(here, None), objective).by_element
        evaluated.clear()
        found = power_along(at(here, near), objective).by_element
        assert not evaluated
        assert_allclose(found, own, rtol=0, atol=2e-10 * np.abs(own).max())


def test_gradient_of_another_trim_and_with_other_models(evaluated: list[object]):
    """Free flapping of the thesis, tip and root losses on the lift, and a test stand."""
    thesis = make_design(preset="thesis", mu=0.2)
    for made in (thesis, replace(thesis, models=replace(thesis.models, trim="propulsive"))):
        near = solve(made).require()
        here = solve(replace(made, twist=make_design(twist="linear:-9").twist), near).require()
        own = power_along(at(here, None)).by_element
        evaluated.clear()
        assert_allclose(power_along(at(here, near)).by_element, own, rtol=0, atol=2e-10 * np.abs(own).max())
        assert not evaluated


def test_any_measure_of_the_blade_elements():
    """Random weights on all that a measure may depend on."""
    near = solve(design(0.2, -14.0)).require()
    here = solve(design(0.2, -13.5), near).require()
    random, shape = np.random.default_rng(1), here.disk.theta.shape
    names = ("fz", "fx", "inflow", "theta", "u_t", "u_p", "u_r", "swirl")
    weights = Weights(**{name: random.normal(size=shape) for name in names}, tilt=3.0)
    own = at(here, None).by_pitch(weights)
    assert_allclose(at(here, near).by_pitch(weights), own, rtol=0, atol=2e-10 * np.abs(own).max())


def test_derivatives_of_a_trim_too_far_away_are_evaluated_anew(evaluated: list[object]):
    """They are kept for other measures of this trim and for the next one."""
    far, here = solve(design(0.35, 0.0)).require(), solve(design(0.15, -20.0)).require()
    own = power_along(at(here, None)).by_element
    evaluated.clear()
    adjoint = at(here, far)
    found: PitchGradient = power_along(adjoint)
    assert len(evaluated) == 1
    assert_allclose(found.by_element, own, rtol=0, atol=1e-13 * np.abs(own).max())
    assert_allclose(power_gradient(here).by_element, own, rtol=0, atol=2e-10 * np.abs(own).max())
    assert len(evaluated) == 1
