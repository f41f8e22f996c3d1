"""Gradients by the transposed equations of a trim against differences: by twist parameters, and of any measure."""

import math
import pickle
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import Design, FlightCondition, Solution, make_design, solve
from rotor.aero.inflow import INFLOW_MODELS
from rotor.design import TableTwist
from rotor.engine.linearise import jacobian
from rotor.optimisation import CONCEPTS
from rotor.optimisation.objective import (
    POWERS,
    Objective,
    WeightedCondition,
    at_condition,
    evaluate_objective,
)
from rotor.trim import Analysis, SolverOptions, analyse, power_gradient
from rotor.trim.adjoint import Adjoint, ElementSlopes
from rotor.trim.newton import FEW_DIGITS, FactorBox
from tests.solved import assert_same_trim

TIGHT = SolverOptions(residual_tolerance=1e-14, inflow_tolerance=1e-12, torsion_tolerance=1e-14)
RELATIVE = 1e-6
"""Accepted error, as a part of what the whole range of a parameter does to the power at the steepest slope."""
CONCEPT = CONCEPTS["free-form"]
"""It moves the pitch of every element, which holds the slopes of all concepts: `tests/rotor/optimisation`."""
VALUES = np.array([0.16, 0.09, 0.05, 0.025, -0.035, -0.07])
SPAN = np.array([parameter.high - parameter.low for parameter in CONCEPT.parameters])


def check(design: Design, *objectives: Objective) -> None:
    """One direction in which all parameters move; all objectives at the same trims."""
    way = np.random.default_rng(5).choice([-1.0, 1.0], len(SPAN))
    step = 4e-6  # Halving it from 8e-6 quarters the difference's own error, which was 7e-7.
    before, trims = (), list[tuple[Analysis, ...]]()
    for along in (0.0, step, -step):
        there = CONCEPT.apply(design, VALUES + along * SPAN * way)
        made = evaluate_objective(objectives[0], there, before, gradient=False, options=TIGHT)
        before = before or made.solutions
        trims.append(made.trims)
    for objective in objectives:
        made = [
            evaluate_objective(objective, design, solved=one, gradient=one is trims[0])
            for one in trims
        ]
        power, ahead, behind = (one.power or math.nan for one in made)
        assert made[0].by_pitch is not None
        exact = CONCEPT.slopes(VALUES, before[0].disk.r) @ made[0].by_pitch * SPAN
        measured = (ahead - behind) / (2 * step)
        # Induced power of a prescribed inflow does not answer to twist: its scale is then the power itself.
        scale = max(np.abs(exact).max(), 1e-3 * abs(power))
        assert_allclose(
            way @ exact, measured, atol=RELATIVE * scale, rtol=0.0, err_msg=objective.quantity
        )


def coarse(**given: Any) -> Design:
    """A coarse grid: exactness of a gradient does not depend on it."""
    design = make_design(**given)
    return replace(design, models=replace(design.models, elements=16, azimuths=36))


CLIMBS = ((0.0, 5.0), (0.03, 5.0), (0.2, -12.0), (0.25, 8.0))
STANDS = {
    "thrust": ("wind-tunnel", {"shaft_tilt_deg": 5.0, "ct_over_sigma": 0.075}),
    "collective": ("wind-tunnel", {"collective_deg": 7.0}),
    "controls": ("controls", {"collective_deg": 7.0, "flapping": "free"}),
}
FLOWN: dict[str, dict[str, Any]] = {
    **{inflow: {"mu": 0.25, "inflow": inflow} for inflow in INFLOW_MODELS},
    **{f"joined {inflow}": {"mu": 0.06, "inflow": inflow} for inflow in ("lifting-line", "local-momentum")},
    **{f"climb {rate} at µ {mu}": {"mu": mu, "climb_m_s": rate} for mu, rate in CLIMBS},
    "closed form in descent": {"mu": 0.0, "climb_m_s": -4.0, "inflow": "closed-form"},
    **{f"{name} at µ {mu}": {"mu": mu, "trim": trim, "stand": stand}
       for mu in (0.0, 0.2) for name, (trim, stand) in STANDS.items()},
    "stalled": {"mu": 0.35, "mass_kg": 9500.0}, "drag area": {"mu": 0.2, "drag_area_m2": 2.0},
    "hover": {"mu": 0.0}, "hover of the thesis": {"mu": 0.0, "preset": "thesis"}, "thesis": {"preset": "thesis"},
}  # fmt: skip


@pytest.mark.parametrize("name", FLOWN)
def test_power_by_the_pitch_of_every_element(name: str):
    design = coarse(**FLOWN[name])
    check(design, *(at_condition(design, quantity) for quantity in POWERS))


def test_mission():
    legs = (
        WeightedCondition(FlightCondition(0.0, 8000.0, 500.0), 0.5),
        WeightedCondition(FlightCondition(0.15, 8300.0), 1.0),
        WeightedCondition(FlightCondition(0.28, 7600.0, 1500.0), 2.0),
    )
    check(coarse(mu=0.2), Objective("total", legs))


CLOSED = SolverOptions(residual_tolerance=1e-13, inflow_tolerance=1e-11, torsion_tolerance=1e-13)
NAMES = ("fz", "fx", "inflow", "theta", "u_t", "u_p", "u_r", "swirl")


def line(
    mu: float, inflow: str = "lifting-line", *, elastic: bool = True, preset: str = "flight"
) -> Design:
    made = make_design(preset=preset, twist="linear:-14", mu=mu)
    return replace(
        made,
        models=replace(made.models, inflow=inflow, elastic_twist=elastic, elements=20, azimuths=48),
    )


@pytest.mark.parametrize("elastic", [False, True], ids=["rigid", "elastic"])
# At the second forward flight is joined with hover.
@pytest.mark.parametrize("mu", [0.0, 0.06, 0.25])
@pytest.mark.parametrize("inflow", ["lifting-line", "local-momentum", "drees"])
def test_gradient_of_a_solution_from_another_process(inflow: str, mu: float, elastic: bool):
    here = analyse(line(mu, inflow, elastic=elastic))
    there: Solution = pickle.loads(pickle.dumps(here.solution))
    for objective in ("total", "induced"):
        own = power_gradient(here, objective).by_element
        assert_allclose(
            power_gradient(there, objective).by_element, own, rtol=0, atol=1e-9 * np.abs(own).max()
        )


def test_gradient_of_a_solution_whose_thrust_is_downward():
    """Its λ0, which is negative, was taken as 1e-4 where only the solution was given: 0.2 % off."""
    here = analyse(make_design(mu=0.2, trim="controls", stand={"collective_deg": -4.0}))
    own = power_gradient(here).by_element
    assert_allclose(
        power_gradient(here.solution).by_element, own, rtol=0, atol=1e-9 * np.abs(own).max()
    )


@pytest.mark.parametrize(
    "made",
    [*(line(mu, elastic=elastic) for mu in (0.0, 0.06, 0.2) for elastic in (True, False)),
     *(line(0.2, inflow) for inflow in ("pitt-peters", "local-momentum")), line(0.2, "uniform", preset="thesis")],
    ids=lambda made: f"{made.models.inflow} {made.condition.advance_ratio} {made.models.elastic_twist}",
)  # fmt: skip
def test_any_measure_of_the_blade_elements(made: Design):
    """Random weights on each field that a measure may depend on, against differences of trims.

    Of two steps the one that agrees better counts: where the slope of a section bends within the first, the second
    does not reach it, and where rounding shows in the second, the first has less.
    """
    random, start = np.random.default_rng(1), solve(made, options=CLOSED).require()
    r, adjoint = start.disk.r, Analysis(start).adjoint
    bend = random.uniform(-1.0, 1.0, len(r))

    def trimmed(step: float) -> Adjoint:
        angles = made.twist(r) + step * bend
        law = TableTwist(tuple(r.tolist()), tuple(angles.tolist()), name="bent")
        return Analysis(solve(replace(made, twist=law), start, CLOSED).require()).adjoint

    ends = {step: (trimmed(step), trimmed(-step)) for step in (5e-6, 1e-6)}
    for name in NAMES:
        weights = random.uniform(0.5, 1.5, adjoint.elements.theta.shape)
        found = adjoint.by_pitch(replace(ElementSlopes(), **{name: weights}))
        field = "induced" if name == "inflow" else name
        errors: list[float] = []
        for step, (ahead, behind) in ends.items():
            change = getattr(ahead.elements, field) - getattr(behind.elements, field)
            total = (weights * (change[:, None] if name == "swirl" else change)).sum()
            errors.append(abs(float(found @ bend) - float(total) / (2.0 * step)))
        assert min(errors) <= 1e-6 * np.abs(found).max() + 1e-10


@pytest.mark.parametrize(
    "models", [{}, {"bending": True}, {"inflow": "pitt-peters", "azimuths": 120}], ids=str
)
def test_factors_made_at_a_trim_spare_passes_and_change_no_answer(models: dict[str, Any]) -> None:
    """Beside the whole Jacobian with what forces remember, solved directly. The last factors of a blade that bends were
    made so near its trim that none are better."""
    trim = analyse(make_design(mu=0.2, twist="linear:-16", **models))
    nearby, start = make_design(mu=0.2, twist="linear:-15.5", **models), trim.solution.start
    without = solve(nearby, replace(start, box=FactorBox(start.factors)))
    adjoint, point = trim.adjoint, trim.linear.point
    matrix, power = jacobian(point, adjoint.total_terms)
    exact = np.linalg.solve(matrix.T, power[0])
    np.testing.assert_allclose(adjoint.of_total, exact, rtol=0.0, atol=1e-8 * np.abs(exact).max())
    assert start.box is not None
    assert start.box.at_trim
    after, moving = solve(nearby, trim.solution), analyse(nearby, trim.solution, FEW_DIGITS)
    assert not moving.linear.point.slopes.size  # They are made when slopes of power are asked for.
    whole = power_gradient(after).by_element
    assert_allclose(moving.gradient.by_element, whole, rtol=0.0, atol=1e-4 * np.abs(whole).max())
    assert after.passes <= without.passes if "bending" in models else after.passes < without.passes
    assert_same_trim(after, without)
