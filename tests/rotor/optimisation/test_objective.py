"""Objectives, missions and the smooth stalled area."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import Design, FlightCondition, make_design, solve
from rotor.optimisation import CONCEPTS
from rotor.optimisation.limits import stalled_share
from rotor.optimisation.objective import (
    Objective,
    WeightedCondition,
    at_condition,
    evaluate_objective,
    hover_and_cruise,
    read_mission,
)
from rotor.trim import Analysis, SolverOptions


def small(mu: float, **choices: float) -> Design:
    design = make_design(mu=mu, **choices)  # pyright: ignore[reportArgumentType]
    return replace(design, models=replace(design.models, elements=20, azimuths=48))


def test_hover_and_cruise():
    design = small(0.2)
    mixed = hover_and_cruise(design, 0.25, 0.3)
    assert [condition.flight.advance_ratio for condition in mixed.conditions] == [0.0, 0.3]
    assert_allclose(mixed.shares, (0.25, 0.75))
    assert at_condition(design).shares == (1.0,)
    assert len(hover_and_cruise(design, 0.0, 0.3).conditions) == 1


def test_a_design_that_does_not_trim_has_no_power():
    """None, not zero or NaN, with the message of the condition that failed."""
    design = small(0.2)
    conditions = (
        WeightedCondition(design.condition),
        WeightedCondition(FlightCondition(0.0, 20000.0, 4000.0)),
    )
    made = evaluate_objective(Objective("total", conditions), design)
    assert made.power is None
    assert made.by_pitch is None
    assert "lower the mass" in made.message


@pytest.mark.parametrize("mu", [0.0, 0.25, 0.35])
@pytest.mark.parametrize("preset", ["flight", "thesis"])
def test_stalled_share_has_exact_slopes(preset: str, mu: float):
    design = make_design(preset=preset, mu=mu, mass_kg=10500.0 if mu == 0.0 else 8800.0)
    design = replace(design, models=replace(design.models, elements=20, azimuths=48))
    concept, values, step = CONCEPTS["quadratic"], np.array([0.05, -0.3]), 1e-6
    tight = SolverOptions(residual_tolerance=1e-12, inflow_tolerance=1e-11)
    centre = solve(concept.apply(design, values), options=tight)
    _, slope = stalled_share(Analysis(centre).adjoint)
    exact = concept.slopes(values, centre.disk.r) @ slope

    def area(at: np.ndarray) -> float:
        return stalled_share(
            Analysis(solve(concept.apply(design, at), centre, tight).require()).adjoint
        )[0]

    measured = [(area(values + step * e) - area(values - step * e)) / (2 * step) for e in np.eye(2)]
    assert_allclose(exact, measured, atol=2e-5 * max(np.abs(exact).max(), 1e-3), rtol=0.0)


def test_stalled_share_is_close_to_the_counted_area():
    """Steady sections: the smooth one, on the panels of the trim, differs by the cells within half a degree of stall.

    At µ 0.38 these are many: 3.8 against 2.7 % of the disk (with twice the panels 4.0 against 3.2 %).
    """
    for mu, apart in ((0.3, 0.005), (0.35, 0.006), (0.38, 0.012)):
        solution = solve(make_design(mu=mu, twist="linear:-4", off="unsteady,dynamic-stall"))
        share, _ = stalled_share(Analysis(solution).adjoint)
        assert_allclose(share, solution.stalled_area, atol=apart)


MISSION = "# a day\nmu,mass_kg,altitude_m,hours,climb_m_s\n0,9000,0,0.5   # hover\n\n0.2,,1500,2,-3\n0.3\n"


def test_mission_file(tmp_path: Path):
    path = tmp_path / "mission.csv"
    path.write_text(MISSION)
    first, second, third = legs = read_mission(
        path, make_design(mass_kg=8000.0, altitude_m=200.0, climb_m_s=1.0)
    )
    assert [leg.flight.climb_speed for leg in legs] == [1.0, -3.0, 1.0]
    assert (first.flight.advance_ratio, first.flight.mass, first.hours) == (0.0, 9000.0, 0.5)
    assert (second.flight.mass, second.flight.altitude, second.hours) == (8000.0, 1500.0, 2.0)
    assert (third.flight.advance_ratio, third.flight.altitude, third.hours) == (0.3, 200.0, 1.0)
