"""Loads without slopes are those of `evaluate_elements`, whatever the models leave out or add."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.aero.elements import build_problem, evaluate_elements
from rotor.aero.trial_loads import evaluate_loads, loads_of
from rotor.aero.trim_state import TrimState
from rotor.design.active_twist import ActiveTwist, Harmonic
from rotor.design.design import Design
from rotor.files.make_design import make_design

STATE = TrimState(0.17, 0.03, -0.12, 0.08, 0.05, -0.01, 0.02, 0.012)


def without(design: Design, **models: object) -> Design:
    return replace(design, models=replace(design.models, **models))


FLIGHT = make_design(preset="flight", mu=0.3)
DESIGNS = {
    "flight": FLIGHT,
    "rigid": without(FLIGHT, elastic_twist=False),
    "linear inflow": without(FLIGHT, inflow="pitt-peters"),
    "no reverse flow": without(FLIGHT, reverse_flow=False),
    "no friction, no swirl": without(FLIGHT, radial_friction=False, swirl=False),
    "active twist": replace(FLIGHT, active_twist=ActiveTwist((Harmonic(2, 0.02, 0.3),))),
    "thesis": make_design(preset="thesis", mu=0.2),
}


@pytest.mark.parametrize("name", DESIGNS)
def test_loads_of_a_trial_are_those_of_its_elements(name: str):
    problem = build_problem(DESIGNS[name])
    noise = np.random.default_rng(5)
    induced = 0.012 + 0.004 * noise.standard_normal(problem.disk.shape) if problem.inflow.load_dependent else None
    elastic = 0.01 * noise.standard_normal(problem.given_torsion.shape)
    elements = evaluate_elements(problem, STATE, induced, elastic if elastic.size else None)
    trial = evaluate_loads(problem, STATE, induced, elastic)
    expected = loads_of(problem, elements)
    for found, field in (
        (trial.sums, expected.sums), (trial.response.induced, expected.response.induced), (trial.modal, expected.modal)
    ):  # fmt: skip
        assert_allclose(found, field, rtol=0, atol=1e-13 * np.abs(field).max(initial=0.0))
