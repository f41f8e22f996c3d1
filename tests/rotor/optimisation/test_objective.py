"""Objectives, missions and the smooth stalled area."""

import math
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
    assert len(hover_and_cruise(design, 0.0, 0.3).conditions) == 1
    with pytest.raises(ValueError, match=r"hover share 1\.5"):
        hover_and_cruise(design, 1.5, 0.3)


def test_a_design_that_does_not_trim_has_no_power():
    """None, not zero or NaN, with the message of the condition that failed."""
    design = small(0.2)
    conditions = (WeightedCondition(design.condition), WeightedCondition(FlightCondition(0.0, 20000.0, 4000.0)))
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
        return stalled_share(Analysis(solve(concept.apply(design, at), centre, tight).require()).adjoint)[0]

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
    first, second, third = legs = read_mission(path, make_design(mass_kg=8000.0, altitude_m=200.0, climb_m_s=1.0))
    assert [leg.flight.climb_speed for leg in legs] == [1.0, -3.0, 1.0]
    assert (first.flight.advance_ratio, first.flight.mass, first.hours) == (0.0, 9000.0, 0.5)
    assert (second.flight.mass, second.flight.altitude, second.hours) == (8000.0, 1500.0, 2.0)
    assert (third.flight.advance_ratio, third.flight.altitude, third.hours) == (0.3, 200.0, 1.0)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (None, "does not exist"),
        ("", "is empty"),
        ("mu,hours\n", "no flight conditions"),
        ("speed,hours\n0.2,1\n", "line 1 reads 'speed,hours'"),
        ("mass_kg\n8000\n", "only mu is required"),
        ("mu,hours\n0.2,1\nfast,1\n", "line 3: mu is 'fast'"),
        ("mu,hours\n0.2,0\n", "line 2: 0 hours"),
        ("mu,climb_m_s\n0.2,1\n0.2,900\n", "line 3: rate of climb 900 m/s"),
    ],
)
def test_mission_file_errors(tmp_path: Path, text: str | None, words: str):
    path = tmp_path / "mission.csv"
    if text is not None:
        path.write_text(text)
    with pytest.raises(ValueError, match=words) as caught:
        read_mission(path, make_design())
    assert "\n" not in str(caught.value)
    path.write_text("mu,climb_m_s\n0.2,5\n")
    with pytest.raises(ValueError, match=r"line 2: rate of climb 5 m/s: .* use the preset flight"):
        read_mission(path, make_design(preset="thesis"))


def test_objective_errors():
    with pytest.raises(ValueError, match="'shaft' is not known"):
        Objective("shaft", (WeightedCondition(FlightCondition(0.2, 8000.0)),))  # pyright: ignore[reportArgumentType]
    with pytest.raises(ValueError, match="give at least one"):
        Objective("total", ())
    assert math.isclose(sum(at_condition(make_design()).shares), 1.0)
