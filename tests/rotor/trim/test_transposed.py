"""Gradients by the transposed equations of a trim: of any measure, and of solutions from elsewhere."""

import pickle
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.design.design import Design
from rotor.design.twist import TableTwist
from rotor.files.make_design import make_design
from rotor.trim.adjoint import Adjoint, Weights, power_gradient
from rotor.trim.newton import SolverOptions
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

TIGHT = SolverOptions(residual_tolerance=1e-13, inflow_tolerance=1e-11, torsion_tolerance=1e-13)
NAMES = ("fz", "fx", "inflow", "theta", "u_t", "u_p", "u_r", "swirl")


def design(mu: float, inflow: str = "lifting-line", *, elastic: bool = True, preset: str = "flight") -> Design:
    made = make_design(preset=preset, twist="linear:-14", mu=mu)
    return replace(made, models=replace(made.models, inflow=inflow, elastic_twist=elastic, elements=20, azimuths=48))


@pytest.mark.parametrize("elastic", [False, True], ids=["rigid", "elastic"])
@pytest.mark.parametrize("mu", [0.0, 0.06, 0.3])  # At the second forward flight is joined with hover.
@pytest.mark.parametrize("inflow", ["lifting-line", "local-momentum", "drees"])
def test_gradient_of_a_solution_from_another_process(inflow: str, mu: float, elastic: bool):
    here = solve(design(mu, inflow, elastic=elastic)).require()
    there: Solution = pickle.loads(pickle.dumps(here))
    assert there.linear is None
    for objective in ("total", "induced"):
        own = power_gradient(here, objective).by_element
        assert_allclose(power_gradient(there, objective).by_element, own, rtol=0, atol=2e-10 * np.abs(own).max())


@pytest.mark.parametrize(
    "made",
    [*(design(mu, elastic=elastic) for mu in (0.0, 0.06, 0.2) for elastic in (True, False)),
     *(design(0.2, inflow) for inflow in ("pitt-peters", "local-momentum")), design(0.2, "uniform", preset="thesis")],
    ids=lambda made: f"{made.models.inflow} {made.condition.advance_ratio} {made.models.elastic_twist}",
)  # fmt: skip
def test_any_measure_of_the_blade_elements(made: Design):
    """Random weights on each field that a measure may depend on, against differences of trims."""
    random, start = np.random.default_rng(1), solve(made, options=TIGHT).require()
    r, adjoint, step = start.disk.r, Adjoint(start), 1e-5
    bend = random.uniform(-1.0, 1.0, len(r))

    def trimmed(sign: float) -> Adjoint:
        angles = made.twist(r) + sign * step * bend
        law = TableTwist(tuple(r.tolist()), tuple(angles.tolist()), name="bent")
        return Adjoint(solve(replace(made, twist=law), start, TIGHT).require())

    ends = [trimmed(sign) for sign in (1.0, -1.0)]
    for name in NAMES:
        weights = random.uniform(0.5, 1.5, adjoint.elements.theta.shape)
        fields = [getattr(one.elements, "induced" if name == "inflow" else name) for one in ends]
        change = (fields[0] - fields[1]) / (2.0 * step)
        slope = float((weights * (change[:, None] if name == "swirl" else change)).sum())
        found = adjoint.by_pitch(replace(Weights(), **{name: weights}))
        assert_allclose(found @ bend, slope, rtol=0, atol=1e-6 * np.abs(found).max() + 3e-11)
