"""What a step of each slider is worth, against differences of whole trims."""

import math
import re
from dataclasses import replace

import pytest
from numpy.testing import assert_allclose

from explorer.model.inputs import FLIGHT, LAWS, Inputs, preset_inflow, with_rotor
from explorer.model.sliders import (
    SLIDERS,
    SliderSensitivity,
    flight_sensitivities,
    nearest_trim,
    slider,
    stand_slider,
    twist_sensitivities,
)
from explorer.model.units import AVIATION, SI, UNITS, number
from explorer.views.worth import step_bands, worth_row
from explorer.workers.call import at_once
from rotor import doubt
from rotor.trim.analysis import Analysis, power_gradient
from rotor.trim.solve import solve

DIVISION_STEP = 1e-4
"""Small enough that no element centre is passed, where the slope by a division jumps."""


def total(inputs: Inputs) -> float:
    return solve(inputs.design()).require().power.total


def difference(inputs: Inputs, name: str, step: float) -> float:
    """[W per unit of the input], central."""
    value = getattr(inputs, name)
    low, high = (replace(inputs, **{name: value + sign * step}) for sign in (-1.0, 1.0))
    return (total(high) - total(low)) / (2.0 * step)


@pytest.mark.parametrize("mu", [0.0, 0.2])
@pytest.mark.parametrize("law", [law for law, entry in LAWS.items() if entry.inputs])
def test_twist_sliders_agree_with_differences_of_trims(law: str, mu: float):
    inputs = replace(
        Inputs(law=law, advance_ratio=mu),
        two_division=0.52,
        three_inner_break=0.41,
        three_outer_break=0.76,
    )
    found = twist_sensitivities(inputs, power_gradient(solve(inputs.design()).require()))
    assert tuple(found) == LAWS[law].inputs
    for name, one in found.items():
        step = DIVISION_STEP if SLIDERS[name].per.endswith("R") else 0.01
        assert_allclose(one.slope, difference(inputs, name, step), rtol=2e-3, atol=2.0)


def test_the_band_of_a_step_of_twist_is_that_of_two_designs():
    inputs = Inputs(law="linear", linear=-12.0)
    here, there = (solve(one.design()).require() for one in (inputs, replace(inputs, linear=-11.0)))
    found = at_once(step_bands(inputs, Analysis(here)))
    assert found == {"linear": pytest.approx(doubt(there, here).change_band, rel=1e-3)}


@pytest.mark.parametrize("mass", [8.0, 9.5])
def test_flight_sliders_agree_with_differences_of_another_step(mass: float):
    inputs = Inputs(advance_ratio=0.25, mass_t=mass, altitude_m=500.0)
    solution = solve(inputs.design()).require()
    found = at_once(flight_sensitivities(solution))
    assert tuple(found) == tuple(FLIGHT)
    for name, step in (
        ("advance_ratio", 3e-4),
        ("mass_t", 2e-3),
        ("altitude_m", 3.0),
        ("climb_m_s", 0.03),
    ):
        assert_allclose(found[name].slope, difference(inputs, name, step), rtol=1e-2)


def test_the_documents_equations_have_no_climb():
    found = at_once(
        flight_sensitivities(
            solve(Inputs(preset="thesis", **preset_inflow("thesis")).design()).require()
        )
    )
    assert tuple(found) == tuple(name for name in FLIGHT if name != "climb_m_s")


def test_weight_in_hover_costs_what_momentum_theory_says():
    """Ideal induced power goes with W^1.5: a per cent of weight costs 1.5 per cent of it, and profile power adds."""
    inputs = Inputs(advance_ratio=0.0)
    solution = solve(inputs.design()).require()
    found = at_once(flight_sensitivities(solution))
    per_cent_of_mass = found["mass_t"].slope * 0.01 * inputs.mass_t
    assert 1.3 < per_cent_of_mass / (0.01 * solution.power.total) < 1.8
    assert "advance_ratio" not in found


def test_one_sided_at_the_edge_of_the_permitted_altitude():
    inputs = Inputs(altitude_m=8000.0, mass_t=5.0)
    found = at_once(flight_sensitivities(solve(inputs.design()).require()))
    lower = total(replace(inputs, altitude_m=7990.0))
    assert_allclose(found["altitude_m"].slope, (total(inputs) - lower) / 10.0, rtol=1e-3)


def test_a_row_carries_the_sign_of_a_step_up_and_says_which_way_saves():
    inputs = Inputs(law="builtin")
    solution = solve(inputs.design()).require()
    found = at_once(flight_sensitivities(solution))
    faster = worth_row(found["advance_ratio"], solution.power, SI, 1e3)
    assert total(replace(inputs, advance_ratio=0.21)) > solution.power.total
    assert (faster.value[0], faster.way, faster.unit) == ("+", "down", "kW/0.01")
    assert faster.sentence.startswith(
        f"Adv. ratio µ: 0.01 more changes power by {faster.value} ± 1.0"
    )
    assert faster.sentence.endswith(" kW: sure. A lower value saves power.")
    twist = worth_row(SliderSensitivity("built_outer", -900.0), solution.power, SI)
    # Not known how sure.
    assert (twist.value, twist.way, twist.unit) == (
        "−0.9 kW per °/R",
        "",
        "kW per °/R",
    )
    bent = worth_row(SliderSensitivity("quadratic_curvature", -900.0), solution.power, SI)
    assert bent.unit == "kW per °/R²"
    assert twist.sentence.endswith("1°/R more changes power by −0.9 kW.")
    sure, unclear = (
        worth_row(SliderSensitivity("built_outer", -900.0), solution.power, SI, band)
        for band in (400.0, 1100.0)
    )
    assert "by −0.9 ± 0.4 kW: sure. A higher value saves power." in sure.sentence
    assert unclear.sentence.endswith("by −0.9 ± 1.1 kW: unclear.")
    assert (unclear.way, unclear.value) == ("", "−0.9 kW per °/R")
    climb = worth_row(SliderSensitivity("climb_m_s", 100e3), solution.power, AVIATION)
    assert "100 ft/min more changes power by +" in climb.sentence
    nothing = worth_row(SliderSensitivity("built_division", 0.0), solution.power, SI)
    assert (nothing.value, nothing.way) == ("no effect", "")
    optimum = worth_row(SliderSensitivity("built_outer", 3.0), solution.power, SI)
    assert (optimum.value, optimum.way) == ("flat here", "")
    sizes = [
        worth_row(SliderSensitivity("mass_t", slope), solution.power, SI).size
        for slope in (3e4, 9e4, 9e5)
    ]
    assert sizes == sorted(set(sizes))  # A larger change has a longer arrow.
    assert sizes[-1] < 1.0


@pytest.mark.parametrize("rotor", ["hart2", "2mrts"])
def test_twist_of_a_small_rotor_has_an_effect(rotor: str):
    """One decimal more than power has, and an arrow as long as the part of the power that a step changes."""
    inputs = with_rotor(Inputs(law="builtin"), rotor)
    solution = solve(inputs.design()).require()
    (step,) = (
        one
        for name, one in twist_sensitivities(inputs, power_gradient(solution)).items()
        if name == "built_outer"
    )
    row = worth_row(step, solution.power, SI, 1e-3)
    assert row.value == number(1e-3 * step.watts(), 2, sign=True)
    assert row.way == ("down" if step.watts() > 0.0 else "up")
    large = worth_row(step, replace(solution.power, profile=2.0 * solution.power.total), SI)
    assert 0.0 < large.size < row.size


def converges(inputs: Inputs) -> bool:
    return solve(inputs.design()).converged


@pytest.mark.parametrize(
    "asked", [Inputs(mass_t=18.0, advance_ratio=0.0), Inputs(mass_t=25.0, advance_ratio=0.0)]
)
def test_in_hover_the_nearest_design_that_trims_is_that_of_the_rotor(asked: Inputs):
    nearest = nearest_trim(asked, converges, solve(asked.design()).message)
    assert nearest is not None
    assert nearest == replace(asked, mass_t=17.2)


@pytest.mark.parametrize("value", [0.13, 0.16])
def test_a_free_rotor_is_led_to_the_loading_that_its_sentence_names(value: float):
    free = with_rotor(Inputs(law="builtin"), "pca2")
    assert free.stand is not None
    asked = replace(free, advance_ratio=0.5, stand=replace(free.stand, value=value))
    sentence = solve(asked.design()).message
    nearest = nearest_trim(asked, converges, sentence)
    assert nearest is not None
    assert nearest.stand is not None
    found = re.search(r"C_T/σ (\d\.\d+) at this advance ratio", sentence)
    assert found
    assert 0.0 <= float(found[1]) - nearest.stand.value < stand_slider("ct_over_sigma", asked).step


def test_of_two_values_the_one_that_is_less_below_what_was_asked_for_is_nearest():
    asked = Inputs(mass_t=16.0, advance_ratio=0.3)
    words = "The largest that trim are {} kg at this speed and advance ratio {} at this mass."
    for mass, mu, nearest in (
        (13150, 0.175, replace(asked, mass_t=13.15)),
        (8000, 0.281, replace(asked, advance_ratio=0.28)),
    ):
        assert nearest_trim(asked, lambda _: True, words.format(mass, mu)) == nearest
    # The other one where that does not trim.
    other = nearest_trim(asked, lambda inputs: inputs.mass_t < 16.0, words.format(8000, 0.281))
    assert other == replace(asked, mass_t=8.0)


def test_where_a_sentence_names_nothing_no_design_is_nearest():
    asked = Inputs(mass_t=16.0, advance_ratio=0.3)
    assert nearest_trim(asked, lambda _: True, "Not trimmed: lower the mass.") is None


def test_the_nearest_design_that_trims_has_what_its_sentence_names():
    """By the solver's own sentence: less mass, though the altitude was moved; in the slider's unit and on its steps."""
    good = Inputs(advance_ratio=0.3, mass_t=10.0)
    wanted = replace(good, altitude_m=3000.0)
    sentence = solve(wanted.design()).message
    found = re.search(r"(\d+) kg at this speed", sentence)
    assert found
    nearest = nearest_trim(wanted, converges, sentence)
    assert nearest is not None
    assert (nearest.altitude_m, nearest.advance_ratio) == (3000.0, 0.3)
    assert 0.0 <= 1e-3 * float(found[1]) - nearest.mass_t < slider("mass_t", SI).step
    assert f"{math.floor(0.1 * float(found[1])) / 100.0:.2f} t at this speed" in SI.in_sliders(
        sentence
    )
    assert f"{math.floor(0.1 * float(found[1]) - 10.0) / 100.0:.2f} t at" in SI.in_sliders(
        sentence, 100.0
    )
    assert "lb at this speed" in UNITS["Aviation"].in_sliders(sentence)
