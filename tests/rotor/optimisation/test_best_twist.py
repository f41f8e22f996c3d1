"""How far the best linear twist can move, beside searches alone."""

import math
from dataclasses import replace

import pytest

import rotor
from rotor.optimisation.results import BestTwist, TwistRange
from rotor.optimisation.search import best_linear_twist, nearby_flights


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
    stand = rotor.make_design(rotor="pca2", mu=0.2, trim="wind-tunnel", stand={"ct_over_sigma": 0.06})
    assert nearby_flights(stand) == []
    free = rotor.make_design(rotor="pca2", mu=0.2, trim="free-rotor", stand={"ct_over_sigma": 0.07})
    with pytest.raises(ValueError, match="takes no power"):
        best_linear_twist(free)


def test_a_range_without_an_end_is_left_out():
    assert not math.isfinite(TwistRange("mass", (-0.2, math.nan)).width)
    heavy = rotor.make_design(hover=True, mass_kg=15000)
    assert "mass" not in {each.cause for each in best_linear_twist(heavy).ranges}
