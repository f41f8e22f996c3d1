"""One function for each quantity on screen: all places that show it have the same number, to the digits shown."""

import csv
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from explorer.model.actuator_inputs import ActuatorInputs
from explorer.model.inputs import Inputs
from explorer.views.actuator import ACTUATOR
from explorer.views.assessed import ACTUATOR_CARD
from explorer.views.pay import PAY
from rotor import Design, Solution, make_design, solve
from rotor.actuator import with_actuator
from rotor.actuator.stopped import numbers_of
from rotor.trim.control_stops import rigged_collective
from tests.actuate import INPUTS, actuate, asked, run, told
from tests.tools import quantities
from tests.tools.quantities import (
    ACTUATORS,
    QUANTITIES,
    ROTORS,
    agrees,
    disagreeing,
    first_number,
    main,
    shown,
)
from tests.tools.screens import Screen, actuated, explored

STALLED = Inputs(law="linear", linear=-2.0, advance_ratio=0.35, mass_t=9.5)
DESIGNS = {
    **{f"{inputs.rotor} µ {inputs.advance_ratio}": inputs for inputs in ROTORS},
    "stalled": STALLED,
    "little reverse flow": Inputs(law="builtin", built_outer=-0.1, advance_ratio=0.25),
    "a change as small as is reported": Inputs(law="builtin", built_outer=-0.04),
    "bending": Inputs(
        law="builtin", built_outer=-3.0, advance_ratio=0.3, bending=True, inflow="drees"
    ),
    "page that travels": Inputs(
        rotor="bo105", law="linear", linear=-10.0, mass_t=2.2, advance_ratio=0.2, inflow="drees"
    ),
    "elastic in hover": Inputs(law="linear", linear=-10.0, advance_ratio=0.0),
    "climbing": Inputs(law="builtin", built_outer=-2.0, advance_ratio=0.1, climb_m_s=3.0),
}
ON_A_PAGE_ONLY = {("separated area", "key of the disk")}
"""tests/explorer/test_modes.py reads it."""


@cache
def screen(name: str) -> Screen:
    return actuated(name, INPUTS) if name in ACTUATORS else explored(DESIGNS[name])


@pytest.mark.parametrize("name", [*DESIGNS, *ACTUATORS])
def test_every_place_shows_the_number_of_rotor(name: str):
    assert disagreeing(screen(name)) == []


def test_every_place_of_the_table_is_read():
    """So that a place whose words are others does not leave the comparison."""
    read = {
        (quantity.name, place.name)
        for name in (*DESIGNS, *ACTUATORS)
        for quantity, place, _ in shown(screen(name))
    }
    known = {(quantity.name, place.name) for quantity in QUANTITIES for place in quantity.places}
    assert known - read == ON_A_PAGE_ONLY


def test_another_number_is_noticed_in_its_last_digit():
    """Of every place, for each quantity of a screen."""
    here = screen("stalled")
    for quantity, _, text in shown(here):
        digits = len(text.partition(".")[2])
        other = quantities.value_of(text) + 1.6 * 10.0**-digits
        if digits < 6:
            assert not agrees(quantity, f"{other:.{digits}f}", here)


def test_the_table_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(quantities, "ROTORS", ROTORS[2:])
    monkeypatch.setattr(quantities, "ACTUATORS", ())
    main(str(tmp_path / "table.csv"))
    with (tmp_path / "table.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    powers = [row for row in rows if row["quantity"] == "total power"]
    assert {row["design"] for row in rows} == {"Sikorsky S-61"}
    assert len(powers) > 8
    assert {
        float(row["shown"].replace("\u2009", "")) for row in powers if row["place"] == "line"
    } == {round(float(powers[0]["value"]))}


def test_card_and_stage_name_the_same_mass_that_pays():
    """One ply of AFC: a place on the stage has two decimals of a degree, which is 2 % of its range."""
    now = actuate(INPUTS, actuator=ActuatorInputs("AFC", plies=1))
    now = told(ACTUATOR, now, lean_verdict=run(asked(ACTUATOR, now)["lean_verdict"]))
    now = told(ACTUATOR_CARD, now, other_stroke=run(asked(ACTUATOR_CARD, now)["other_stroke"]))
    now = told(ACTUATOR, now, flight_of=run(asked(ACTUATOR, now)["flight_of"]))
    card = "".join(ACTUATOR_CARD.view(now)["assessed"].pays)
    staged = replace(now, hand=replace(now.hand, on_stage=True))
    note = PAY.view(staged)["suppose"].note
    assert first_number("below #", card) == first_number("below #", note) != ""


@cache
def with_tube(mu: float) -> Solution:
    base = make_design(mu=mu, mass_kg=7000.0, inflow="drees")
    return solve(with_actuator(base, "SMA_tube,drive=100")).require()


@pytest.mark.parametrize("mu", [0.38, 0.4])
def test_a_control_is_beyond_its_stop_where_none_of_its_range_is_left(mu: float):
    """The tube turns the blade between the root, which the control holds, and 0.75 R, where collective is given."""
    trim = with_tube(mu)
    design: Design = trim.design
    left = numbers_of(trim, design.jig).controls_left
    stops = design.aircraft.controls
    assert left is not None
    assert stops is not None
    collective = rigged_collective(design, trim.controls)
    assert abs(collective - trim.controls.collective) > 0.01
    assert left == stops.left(collective, trim.controls.cyclic_1c, trim.controls.cyclic_1s)
    assert (left < 0.0) == ("controls" in {caveat.name for caveat in trim.caveats})
