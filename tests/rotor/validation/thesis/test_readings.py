"""The thesis as printed: readings of its data and losses, misprints, the ladder from its preset to `flight`."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import make_design, solve
from rotor.airfoil.polynomial import THESIS_NAME, THESIS_READING, parse_reading, thesis_polar
from rotor.airfoil.sections import load_section
from rotor.validation.thesis import readings
from rotor.validation.thesis.ladder import RUNGS, linear_optimum, moving_twist, rung_design
from rotor.validation.thesis.misprints import MISPRINTS, Misprint, shown_values
from rotor.validation.thesis.twist_effect import hover_optimum
from tests.solved import assert_same_trim


@pytest.mark.parametrize(
    "section", [name for name in readings.SECTIONS if name.startswith(THESIS_NAME)]
)
def test_a_reading_is_its_own_polar_and_range(section: str):
    """The table of each name follows the points of its own polar, and ends where its own fit ends."""
    reading = parse_reading(section)
    assert reading.name == section
    table, polar = load_section(section), thesis_polar(reading)
    assert table.fit_range is not None
    assert_allclose(np.degrees(table.fit_range), reading.range_deg)
    attached = (polar.alpha_deg >= -4.0) & (polar.alpha_deg <= 8.0)
    made = table(np.deg2rad(polar.alpha_deg[attached]), 0.3).cl
    assert_allclose(made, polar.cl[attached], atol=0.03)


def test_the_preset_is_one_of_the_readings():
    preset = readings.reading_design(THESIS_READING.name, "inflow", -8.0, 0.2)
    assert preset == make_design(preset="thesis", twist="linear:-8", mu=0.2)
    before = readings.reading_design(THESIS_NAME, "lift", -8.0, 0.2)
    assert before == make_design(
        preset="thesis", twist="linear:-8", mu=0.2, loss_on="lift", airfoils=THESIS_NAME
    )


@pytest.mark.slow
def test_the_preset_is_the_reading_that_holds_most():
    """The numbers decide what is said to hold; units of twist scale, and torque less parts is what the disk takes."""
    found = readings.judged_readings()
    assert len(found) == 80
    most = max(sum(judgement.holds) for judgement in found)
    preset = readings.ThesisReading(THESIS_READING.name, "inflow", "root to tip", "sum")
    assert found[0].reading == preset
    assert sum(found[0].holds) == most
    radius, _, tip, torque = readings.judge(THESIS_READING.name, "inflow")
    assert_allclose(radius.optimum_deg, hover_optimum("thesis")[0], atol=0.2)
    root = make_design(preset="thesis").rotor.blade.root_cutout
    assert_allclose(tip.optimum_deg, radius.optimum_deg * (1.0 - root), atol=0.2)
    # In hover torque and parts are the same.
    assert_allclose(tip.excess[0], torque.excess[0], rtol=1e-9)
    assert_allclose(radius.overtakes, 0.18, atol=0.005)


# Misprints: both values of each are shown and differ


BY_EQUATION = {one.equation: one for one in MISPRINTS}


@pytest.mark.parametrize("one", MISPRINTS, ids=lambda one: one.equation)
def test_the_two_values_differ(one: Misprint):
    printed, ours = shown_values(one)
    assert math.isfinite(printed)
    assert math.isfinite(ours)
    assert abs(printed - ours) > 1e-3 * abs(ours)
    assert "\n" not in one.setting + one.showing


def test_values_by_hand():
    """Values of the correct formula: 2λ², 2λ³, σC_d0/8, 15π/32, V/ΩR."""
    assert_allclose(shown_values(BY_EQUATION["2.26"])[1], 2 * 0.05**2, rtol=1e-6)
    assert_allclose(shown_values(BY_EQUATION["2.27"])[1], 2 * 0.05**3, rtol=1e-6)
    assert_allclose(shown_values(BY_EQUATION["2.32"])[1], 15 * math.pi / 32)
    printed, ours = shown_values(BY_EQUATION["3.15"])
    assert_allclose(ours, 0.0821 * 0.01 / 8, rtol=1e-5)  # midpoint sum of r³
    assert_allclose(printed / ours, 2.0)
    assert_allclose(shown_values(BY_EQUATION["throughout"])[1], 46.3 / 220.8276)
    assert_allclose(shown_values(BY_EQUATION["§3.2"])[1], 0.0065, rtol=2e-3)


def test_linear_inflow_does_not_respond_to_twist_and_the_wake_does():
    printed, ours = shown_values(BY_EQUATION["3.4 and abstract"])
    assert printed < 3.0 < 10.0 < ours  # The loss on the inflow responds, at the ends of the blade.


# The ladder from the preset thesis to flight


@pytest.mark.parametrize("mu", [0.0, 0.2, 0.35])
def test_the_ladder_begins_at_thesis_and_ends_at_flight(mu: float):
    thesis = make_design(preset="thesis", twist="linear:-16", mu=mu)
    assert_same_trim(solve(rung_design((), mu)), solve(thesis))
    assert rung_design(tuple(RUNGS), mu) == make_design(twist="linear:-16", mu=mu)


@pytest.mark.parametrize("name", RUNGS)
def test_each_rung_changes_something(name: str):
    """Each is a change of its own, by its power at µ 0.35 in the ladder."""
    place = tuple(RUNGS).index(name)
    before, after = (
        solve(rung_design(tuple(RUNGS)[: place + k], 0.35)).require().power.total for k in (0, 1)
    )
    assert abs(after / before - 1.0) > 1e-4


@pytest.mark.slow
def test_the_best_twist_is_a_least_and_moving_saves_something():
    for count in range(len(RUNGS) + 1):
        on = tuple(RUNGS)[:count]
        assert -1e-9 <= moving_twist(on, (0.0, 0.35), None).gain < 0.02
        if count not in (0, 5, len(RUNGS)):
            continue
        best = linear_optimum(on, 0.35, None)  # Its band by trims of their own, without the search.
        edges = [
            solve(rung_design(on, 0.35, f"linear:{rate:.9f}")).require().power.total / 1e3
            for rate in best.band_deg
        ]
        assert_allclose(edges, 1.001 * best.power_kw, rtol=2e-4)
