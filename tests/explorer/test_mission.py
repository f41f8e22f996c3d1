"""The mission of a page: where its hours are shown, and how they are set."""

import re
from dataclasses import replace

import pytest

from explorer.model.actuator_inputs import ActuatorInputs, HandSettings
from explorer.model.inputs import OPENING, Inputs, StandInputs, with_rotor
from explorer.views.mission import TEXT, set_hours, view
from explorer.views.page_state import PageState, SetHand
from rotor.optimisation.mission import ASSUMED_HOURS
from rotor.support.assets import SHIPPED_ROTORS

HOURS = (0.5, 0.0, 3.0, 0.25)


def page_of(inputs: Inputs, hours: tuple[float, ...] = HOURS) -> PageState:
    hand = HandSettings(actuator=ActuatorInputs(hours=hours))
    return PageState(inputs, inputs.design(), None, hand=hand)


def test_where_there_is_a_flight_bar_the_words_name_it():
    assert (
        "cruise 3 h, fast 0.25 h. Set the hours on the flight bar" in view(page_of(OPENING))[TEXT]
    )


@pytest.mark.parametrize("rotor", [key for key in SHIPPED_ROTORS if key != "uh60a"])
def test_any_other_rotor_has_a_field_for_the_hours_of_each_leg(rotor: str):
    shown = view(page_of(with_rotor(OPENING, rotor)))[TEXT]
    assert re.findall('value="([^"]*)" data-hours="([^"]*)"', shown) == [
        ("0.5", "0"), ("0", "1"), ("3", "2"), ("0.25", "3"),
    ]  # fmt: skip


def test_the_hours_of_a_leg_change_those_alone():
    now = page_of(OPENING)
    assert set_hours(now, 1, 2.0) == (SetHand(actuator={"hours": (0.5, 2.0, 3.0, 0.25)}),)
    assert set_hours(now, 9, 2.0) == ()


def test_a_free_rotor_says_that_it_does_not_hover_and_flies_without_that_leg():
    free = replace(OPENING, inflow="uniform", stand=StandInputs("free-rotor", tip_mach=0.6))
    refused = view(page_of(free, ASSUMED_HOURS))[TEXT]
    assert "a free rotor needs wind to turn it" in refused
    assert 'data-hours="0"' in refused
    assert "slow 0.25 h, cruise 1 h" in view(page_of(free, (0.0, 0.25, 1.0, 0.25)))[TEXT]
