"""Inflow that answers to the load: identities, gradients, hover and what twist does to induced power."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import Design, make_design, solve
from rotor.aero.elements import BladeElements
from rotor.aero.inflow import INFLOW_MODELS, DiskFlow
from rotor.aero.inflow.local_momentum import GAIN
from rotor.aero.problem import Problem
from rotor.engine.linearise import Point
from rotor.support.arrays import Array
from rotor.trim import Analysis
from rotor.trim.low_speed import trim_problem

LOAD_DEPENDENT = [name for name, model in INFLOW_MODELS.items() if model.load_dependent]


def design_of(inflow: str, mu: float, twist: str = "linear:-10", preset: str = "flight") -> Design:
    return make_design(preset=preset, twist=twist, mu=mu, inflow=inflow)


def coarse(inflow: str, mu: float) -> Design:
    """For identities and gradients, which hold on any grid."""
    design = design_of(inflow, mu)
    return replace(design, models=replace(design.models, elements=20, azimuths=48))


def answer(problem: Problem, point: Point, elements: BladeElements) -> Array:
    """The inflow that the model gives to the loads, (elements, azimuths)."""
    disk, state, nodes = problem.disk, elements.state, point.system.nodes
    if nodes is not None:
        (mean,) = problem.inflow_terms.shapes().values()
        return mean[:, None] + nodes.field(point.forces[nodes.force].ravel()).reshape(disk.shape)
    along, through = problem.design.in_disk_axes(state.shaft_tilt)
    followed = problem.inflow_terms.follow(
        DiskFlow(along, through, state.lambda0), through, sees_tilt=True
    )
    gradient = followed.atoms["lambda0 kx"][0] * np.outer(disk.r, disk.cos)
    return followed.live[GAIN, "gain"][0][:, None] * elements.fz + gradient


@pytest.mark.parametrize("inflow", LOAD_DEPENDENT)
@pytest.mark.parametrize("mu", [0.06, 0.2, 0.35])
def test_the_converged_inflow_is_the_response_of_the_model(inflow: str, mu: float):
    """Converged: λ_i = A d, at low speed with the part of hover, closed to 1e-8 of λ0, and the power closed with it.

    Momentum answers to lift without apparent mass, which steady flow does not have.
    """
    design = coarse(inflow, mu)
    if not INFLOW_MODELS[inflow].pointwise:
        design = replace(design, models=replace(design.models, unsteady=False))
    solution = solve(design).require()
    problem = trim_problem(solution.design)
    expected = answer(problem, Analysis(solution).linear.point, Analysis(solution).linear.elements)
    if problem.air.joined is not None:
        expected = expected + problem.air.joined[0][:, None]
    assert_allclose(
        Analysis(solution).linear.elements.induced,
        expected,
        atol=1.1e-8 * solution.controls.lambda0,
    )
    assert_allclose(solution.power.shaft, solution.power.main_rotor, rtol=1e-9)


@pytest.mark.parametrize("inflow", LOAD_DEPENDENT)
def test_twist_changes_induced_power(inflow: str):
    """The point of it all: 5–9 % of total power over 0…−20° (linear models: induced power to 1 % the same)."""
    induced = [
        solve(design_of(inflow, 0.2, f"linear:{rate}")).require().power.induced
        for rate in (0, -8, -20)
    ]
    assert np.ptp(induced) > 0.05 * min(induced)
