"""How sure a saving is, and where the best twist may lie, beside new searches with changed inputs."""

import math
import re
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import pytest

import rotor
from rotor import Design, doubt
from rotor.aero.lifting_line import WakeCourse
from rotor.design.uncertain import UNCERTAIN
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.doubt import saving_doubt
from rotor.optimisation.objective import at_condition, over_conditions
from rotor.optimisation.results import BestTwist, TwistRange
from rotor.optimisation.search import Search, best_linear_twist, nearby_flights, run_search
from rotor.trim.doubt import with_other_inflow
from tests.patched import Patch
from tests.uncertain import either_side

MU = 0.3
CONDITIONS = {
    "hover": {"hover": True},
    "µ 0.2": {"mu": 0.2},
    "µ 0.3": {"mu": 0.3},
    "µ 0.35": {"mu": 0.35},
}
ROWS = (
    "section_lift_percent",
    "section_moment",
    "drag_rise_mach",
    "drag_area_percent",
    "torsional_stiffness_percent",
)


def best_rate(design: Design) -> float:
    found = run_search(Search(design, find_concept("linear"), starts=1, band=False))
    return found.best.parameters[0]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "condition"),
    [
        (name, at)
        for name in ROWS
        for at in CONDITIONS
        if (name, at) != ("drag_area_percent", "hover")
    ],
)
def test_the_best_twist_moves_as_new_searches_find(name: str, condition: str, patch: Patch):
    """Half the difference between an input larger and one smaller by its size; within 15 % of the whole band."""
    design = rotor.make_design(**CONDITIONS[condition])  # type: ignore[arg-type]
    patch("rotor.optimisation.doubt.MOST_INPUTS", 99)
    (band,) = rotor.optimise(design, "linear", starts=1).doubt_band
    expected = dict(band.causes)[{row.name: row.words for row in UNCERTAIN}[name]]
    ends = [best_rate(changed) for changed in either_side(name, design, patch)]
    print(
        f"{name} {condition}: {math.degrees(0.5 * (ends[0] - ends[1])):.2f}, first order {math.degrees(expected):.2f}°"
    )
    assert 0.5 * (ends[0] - ends[1]) == pytest.approx(
        expected, abs=0.15 * 0.5 * (band.high - band.low)
    )


@pytest.mark.parametrize(
    "mu",
    [0.1, pytest.param(0.2, marks=pytest.mark.slow), pytest.param(0.3, marks=pytest.mark.slow)],
)
def test_the_range_holds_the_best_twists_of_other_wakes(mu: float, patch: Patch):
    """Of Pitt and Peters' inflow, and of a wake along Beddoes' path; each shift as a new search finds it."""
    design = rotor.make_design(mu=mu)
    patch("rotor.optimisation.doubt.MOST_INPUTS", 99)
    best = rotor.optimise(design, "linear", starts=1)
    (band,), (rate,), shifts = (
        best.doubt_band,
        best.best.parameters,
        dict(best.doubt_band[0].causes),
    )
    found = {"inflow pitt-peters": best_rate(with_other_inflow(design)) - rate}
    patch("rotor.aero.problem.WakeCourse", partial(WakeCourse, beddoes=1.0))
    found["path of the wake"] = best_rate(design) - rate
    for name, shift in found.items():
        print(
            f"mu {mu}, {name}: {math.degrees(shift):.2f}, stated {math.degrees(shifts[name]):.2f}°"
        )
        assert band.low < rate + shift < band.high
        assert shifts[name] == pytest.approx(shift, abs=0.15 * 0.5 * (band.high - band.low))
    # Another model is right or it is not: it widens the range to its own side only.
    model, size = shifts.pop("inflow pitt-peters"), math.hypot(*shifts.values())
    assert model > 0.0
    assert rate - band.low == pytest.approx(size)
    assert band.high - rate == pytest.approx(math.hypot(size, model))


def test_a_search_says_how_sure_its_saving_is():
    design = rotor.make_design(mu=MU)
    found = rotor.optimise(design, "linear", starts=1)
    alone = doubt(rotor.solve(found.design), rotor.solve(design))
    assert found.doubt.change_band == pytest.approx(alone.change_band, rel=1e-3)
    assert found.doubt.sureness == "sure"
    (band,) = found.doubt_band
    assert band.low < found.best.parameters[0] < band.high
    assert len(band.causes) == 2


def test_over_conditions_rows_are_means():
    design, other = rotor.make_design(mu=0.2), rotor.make_design(mu=0.2, twist="linear:-8")
    both = saving_doubt(over_conditions(other, [(0.1, 1.0), (0.3, 3.0)]), other, design)
    alone = [
        doubt(rotor.solve(other.at(mu=mu)), rotor.solve(design.at(mu=mu))) for mu in (0.1, 0.3)
    ]
    for row in both.rows:
        first, second = (
            {each.name: each.power for each in found.rows}.get(row.name, 0.0) for found in alone
        )
        assert row.power == pytest.approx(0.25 * first + 0.75 * second, rel=1e-3, abs=1.0)


def test_induced_power_has_a_band_of_its_own():
    design = rotor.make_design(mu=0.2)
    other = design.with_twist("linear:-12")
    band, total = (
        saving_doubt(at_condition(design, "induced"), other, design),
        doubt(*map(rotor.solve, (other, design))),
    )
    assert band is not None
    assert band.power == pytest.approx(rotor.solve(other).power.induced, rel=1e-6)
    assert band.change_band == pytest.approx(total.part_bands["induced"], rel=0.01)
    assert band.sentence.startswith("Induced power ")
    found = rotor.optimise(design, "linear", quantity="induced", starts=1)
    assert re.search(r"saves [\d.]+ ± [\d.]+ %: \w+$", found.saving_words)


def test_hover_has_another_wake_with_more_twist(answer: Callable[..., Any]):
    found = answer("optimise", "--hover", "--starts", "1", "--doubt")
    line, ours = (
        found["models"]["inflow lifting-line"]["parameters"]["rate_deg"],
        found["parameters"]["rate_deg"],
    )
    low, high = found["doubt_band"]["rate_deg"]
    assert line < ours - 1.0
    assert low < ours < high
    assert math.isfinite(found["saving_doubt_percent"])


def test_the_doubt_of_a_twist_in_flight_names_masses_and_drag_areas(
    answer: Callable[..., Any], refused: Callable[..., str]
):
    command = ["optimise", "--mu", "0.2", "--inflow", "uniform", "--starts", "1", "--doubt"]
    flights = ["mass 6658 kg", "mass 9987 kg", "drag area 0.0 m²", "drag area 4.1 m²"]
    assert list(answer(*command)["flights"]) == flights
    assert "total power of one condition" in refused(*command, "--objective", "induced")


# How far the best linear twist can move, beside searches alone


def degrees(best: BestTwist, cause: str) -> tuple[float, float]:
    low, high = next(each.rates for each in best.ranges if each.cause == cause)
    return math.degrees(low), math.degrees(high)


def test_drag_area_and_mass_move_it_further_than_what_is_uncertain():
    design = rotor.make_design(mu=0.35)
    best = best_linear_twist(design)
    width = {each.cause: each.width for each in best.ranges}
    assert set(width) == {"flat", "doubt", "mass", "drag area"}
    assert width["drag area"] > width["doubt"]
    sleek, draggy = degrees(best, "drag area")
    assert -7.5 < sleek < -6.3
    light, heavy = degrees(best, "mass")
    assert heavy < math.degrees(best.rate) < light
    assert draggy < math.degrees(best.rate) < sleek
    low, high = degrees(best, "flat")
    assert low < math.degrees(best.rate) < high


def test_ends_are_those_of_searches_alone():
    design = rotor.make_design(mu=0.3, inflow="uniform")
    sleek = replace(design, fuselage=replace(design.fuselage, drag_area=0.0))
    alone = rotor.optimise(sleek, "linear", starts=1).best
    assert degrees(best_linear_twist(design), "drag area")[0] == pytest.approx(
        math.degrees(alone.parameters[0]), abs=0.1
    )


def test_on_a_stand_neither_mass_nor_drag_counts():
    stand = rotor.make_design(
        rotor="pca2", mu=0.2, trim="wind-tunnel", stand={"ct_over_sigma": 0.06}
    )
    assert nearby_flights(stand) == []
    free = rotor.make_design(rotor="pca2", mu=0.2, trim="free-rotor", stand={"ct_over_sigma": 0.07})
    with pytest.raises(ValueError, match="takes no power"):
        best_linear_twist(free)


def test_a_range_without_an_end_is_left_out():
    assert not math.isfinite(TwistRange("mass", (-0.2, math.nan)).width)
    heavy = rotor.make_design(hover=True, mass_kg=15000)
    assert "mass" not in {each.cause for each in best_linear_twist(heavy).ranges}
