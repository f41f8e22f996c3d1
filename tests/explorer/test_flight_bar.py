"""The flight bar of Actuate without a browser: what the page draws, and what a place of the bar sets."""

import math
import pickle
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.model.actuator_inputs import (
    MOST_SEGMENTS,
    ActuatorInputs,
    flight_legs,
    flight_of,
    hours_text,
    hours_with,
    lean_verdict,
    read_hours,
    verdict_inputs_of,
)
from explorer.model.inputs import Inputs, ViewState
from explorer.model.units import SI
from explorer.parts.actuate import FlightPart
from explorer.text.readout import needs_words
from explorer.views.actuator import ACTUATOR
from explorer.views.flight import (
    FLIGHT,
    POINTS_PER_LEG,
    after_flight,
    choose_state,
    condition_at,
    earns_state,
    fly_to,
    position_of,
)
from explorer.views.page_state import PageState
from rotor.actuator.flight import ActuatorFlight
from rotor.actuator.verdict import Verdict
from rotor.optimisation import standard_flight
from rotor.support.chart import DrawnBand, DrawnLine
from rotor.trim.doubt import ESTIMATED, sureness
from tests.actuate import actuate, asked, done, told

INPUTS = Inputs(advance_ratio=0.2, elastic_twist=False)
RIGID = INPUTS.design()
QUESTION = verdict_inputs_of(ActuatorInputs(), RIGID)
LEGS = flight_legs(RIGID)
BY_HAND = ActuatorInputs(drives=(77.0,) * MOST_SEGMENTS)


@pytest.fixture(scope="module")
def verdict() -> Verdict:
    return lean_verdict(QUESTION)


@pytest.fixture(scope="module")
def flight(verdict: Verdict) -> ActuatorFlight:
    return flight_of(pickle.loads(pickle.dumps(verdict)))


def test_the_bar_goes_through_the_standard_flight_and_half_way_between_its_legs():
    assert LEGS[::POINTS_PER_LEG] == standard_flight(RIGID)
    for k, leg in enumerate(standard_flight(RIGID)):
        assert condition_at(LEGS, float(k)) == (leg.advance_ratio, leg.climb_speed)
        assert position_of(LEGS, leg.advance_ratio) == pytest.approx(k)
    (mu, climb), (one, two) = condition_at(LEGS, 0.5), standard_flight(RIGID)[:2]
    assert mu == pytest.approx(0.5 * (one.advance_ratio + two.advance_ratio), abs=5e-4)
    assert climb == pytest.approx(0.5 * (one.climb_speed + two.climb_speed), abs=5e-3)
    # Level again, as a flight at that speed is that one enters with.
    assert condition_at(LEGS, 1.5)[1] == 0.0
    # Faster than the flight: its end.
    assert position_of(LEGS, 0.5) == len(standard_flight(RIGID)) - 1


@pytest.fixture(scope="module")
def waiting() -> PageState:
    """Nothing is known yet."""
    return actuate(INPUTS)


@pytest.fixture(scope="module")
def ready(waiting: PageState, verdict: Verdict, flight: ActuatorFlight) -> PageState:
    """Verdict and flight are known, and remembered."""
    now = told(ACTUATOR, told(ACTUATOR, waiting, lean_verdict=verdict), flight_of=flight)
    return replace(now, memory=FLIGHT.remember(now, FLIGHT.view(now)))


def shown(now: PageState) -> FlightPart:
    flown = FLIGHT.view(now)["flight"]
    assert isinstance(flown, FlightPart)
    return flown


def tip(now: PageState) -> float:
    """What the widgets make of the blade [rad]."""
    actuator = now.hand.actuator
    return actuator.tip(actuator.installed(RIGID.rotor))


def test_the_page_draws_the_flight_as_it_was_computed(ready: PageState, flight: ActuatorFlight):
    assert FLIGHT.view(ready) == FLIGHT.view(replace(ready))
    state = shown(ready)
    assert state.kind == "ready"
    lines: dict[str, Any] = {
        one.label: one.y for one in state.chart.series if isinstance(one, DrawnLine)
    }
    assert list(lines) == ["by schedule", "as set"]
    assert_allclose(lines["by schedule"], np.degrees(flight.reached), atol=6e-4)
    assert_allclose(lines["as set"], 0.0)
    low, high = state.chart.y.range
    for angles in (flight.reached, flight.reach):
        assert low < math.degrees(min(angles)) <= math.degrees(max(angles)) < high
    reach: Any = next(one for one in state.chart.series if isinstance(one, DrawnBand))
    assert_allclose(
        [reach.low, reach.high], np.degrees([[end] * len(LEGS) for end in flight.reach]), atol=6e-4
    )
    assert [name for name, _ in state.legs] == ["hover", "climb", "cruise", "fast"]
    assert condition_at(LEGS, state.at)[0] == pytest.approx(0.2, abs=2e-3)
    assert (state.tip, state.state) == ("0.00°", "set")
    assert ready.state is not None
    aviation = replace(ready, state=replace(ready.state, view=ViewState(units="Aviation")))
    assert "kt" in shown(aviation).legs[1][1]


def test_what_is_being_computed_is_said_and_keeps_its_place(
    waiting: PageState, ready: PageState, verdict: Verdict
):
    """Nothing jumps: the curves and the balance of the question before stay, marked."""
    assert (shown(waiting).kind, [one.label for one in shown(waiting).chart.series]) == (
        "computing",
        ["as set"],
    )
    assert asked(FLIGHT, waiting) == {}
    assert "flight_of" not in asked(ACTUATOR, waiting)
    moved = replace(ready, hand=replace(ready.hand, actuator=ActuatorInputs(plies=3)))
    assert (shown(moved).kind, shown(moved).chart) == ("computing", shown(ready).chart)
    before = FLIGHT.view(moved)["earns"]
    assert before == replace(earns_state(verdict, True, SI), kind="computing")
    judged = told(ACTUATOR, waiting, lean_verdict=verdict)
    wrong = told(ACTUATOR, judged, flight_of="hover: does not trim")
    assert (shown(wrong).kind, shown(wrong).words.endswith("; hover: does not trim")) == (
        "problem",
        True,
    )
    refused = FLIGHT.view(told(ACTUATOR, moved, lean_verdict="no blade"))
    assert refused["earns"] == earns_state(None, False, SI, "no blade")
    assert shown(told(ACTUATOR, moved, lean_verdict="no blade")).words.endswith("; no blade")


def test_the_bars_of_the_balance_add_up_to_the_verdict(verdict: Verdict):
    state = earns_state(verdict, True, SI)
    *parts, total = state.bars
    assert sum(bar.value for bar in parts) == pytest.approx(total.value, abs=5e-3)
    assert total.value == pytest.approx(-1e-3 * verdict.net_saving, abs=1e-3)
    assert total.total
    written = [float(bar.text.replace("−", "-")) for bar in state.bars]
    assert sum(written[:-1]) == written[-1]
    # Red is loss and green is gain, where that is known.
    for bar, value in zip(state.bars, written, strict=True):
        assert bar.value == pytest.approx(value, abs=1.0)
        known = bar.value and (not bar.band or sureness(bar.value, bar.band) != "unclear")
        assert bar.kind == ("" if not known else "loss" if bar.value > 0.0 else "gain")
    bands = {bar.name: bar.band for bar in state.bars}
    assert bands.pop("drive") == 0.0
    assert verdict.net_band is not None
    assert bands["total"] == pytest.approx(1e-3 * verdict.net_band, abs=1e-3)
    assert bands["mass"] == pytest.approx(
        1e-3 * verdict.bands[[name for name, _ in verdict.savings].index("mass")], abs=1e-3
    )
    assert all(bands.values())
    assert (
        total.title
        == f"total {needs_words(verdict.net_saving, verdict.net_band, SI, sourced=False)}"
    )
    assert verdict.fuel_saving is not None
    burnt = -3600.0 * verdict.fuel_saving
    fuel, _, reason = state.fuel.replace("−", "-").partition(", ")
    assert reason in ("", ESTIMATED)
    used, word = re.findall(r"^([+-][\d.]+) ± [\d.]+ kg/h of fuel: (\w+)$", fuel)[0]
    digits = len(used.partition(".")[2])
    assert float(used) == pytest.approx(burnt, abs=10.0**-digits)
    assert word == sureness(verdict.net_saving, verdict.net_band, sourced=False) == "likely"
    assert state.fuel_kind == ("loss" if burnt > 0.0 else "gain")


def scheduled(now: PageState) -> PageState:
    return done(now, choose_state(now, "schedule"))


def test_by_schedule_a_place_of_the_bar_sets_condition_and_voltages(
    ready: PageState, flight: ActuatorFlight
):
    """By the inputs of the sliders; the blade has the twist that the chart says is reached there. As set it flies
    alone."""
    for x, leg in enumerate(standard_flight(RIGID)):
        there = done(ready, fly_to(scheduled(ready), x))
        assert (there.inputs.advance_ratio, there.inputs.climb_m_s) == (
            leg.advance_ratio,
            leg.climb_speed,
        )
        # In whole per cent.
        assert_allclose(tip(there), flight.reached[POINTS_PER_LEG * x], atol=math.radians(0.02))
        alone = done(ready, fly_to(ready, x))
        assert (alone.inputs, alone.hand) == (there.inputs, ready.hand)
    between = done(ready, fly_to(scheduled(ready), 0.25))
    assert_allclose(
        tip(between), np.interp(0.5, [0, 1], flight.reached[:2]), atol=math.radians(0.02)
    )
    assert done(ready, fly_to(ready, 99)).inputs.advance_ratio == LEGS[-1].advance_ratio
    untrimmed = replace(ready, problem="No trim there.")  # It can be flown out of.
    assert FLIGHT.view(untrimmed) == {}
    assert (
        done(untrimmed, fly_to(untrimmed, 1)).inputs.advance_ratio
        == LEGS[POINTS_PER_LEG].advance_ratio
    )


def test_the_voltages_follow_once_the_flight_is_known(
    waiting: PageState, ready: PageState, flight: ActuatorFlight
):
    begun = scheduled(waiting)
    flown = done(begun, fly_to(begun, 3))
    assert flown.inputs.advance_ratio == LEGS[-1].advance_ratio  # The condition needs no answer.
    assert tip(flown) == 0.0
    assert FLIGHT.reacts(flown) == ()
    known = replace(flown, answers=ready.answers)
    assert_allclose(
        tip(done(known, FLIGHT.reacts(known))), flight.reached[-1], atol=math.radians(0.02)
    )
    # Once: then a hand may move them.
    assert FLIGHT.reacts(replace(known, memory=ready.memory)) == ()
    assert FLIGHT.reacts(replace(known, hand=replace(known.hand, flown=None))) == ()


@pytest.mark.parametrize("actuator", [ActuatorInputs(), BY_HAND])
def test_the_three_states_and_the_way_back_to_what_the_hand_had_set(
    ready: PageState, flight: ActuatorFlight, actuator: ActuatorInputs
):
    """A stop freezes what there is; a voltage set by hand comes back whatever lay between, and on leaving."""
    by_hand = replace(ready, hand=replace(ready.hand, actuator=actuator))
    assert choose_state(by_hand, "set") == ()
    flown = scheduled(by_hand)
    there = done(flown, fly_to(flown, 3))
    stopped = done(there, choose_state(there, "stopped"))
    back = done(stopped, fly_to(stopped, 0))
    assert back.inputs.advance_ratio == 0.0
    assert_allclose([tip(there), tip(back)], flight.reached[-1], atol=math.radians(0.02))
    (line,) = [
        one
        for one in shown(back).chart.series
        if isinstance(one, DrawnLine) and one.label == "stopped"
    ]
    assert_allclose(np.array(line.y, dtype=float), math.degrees(tip(back)), atol=6e-4)
    assert [shown(now).state for now in (by_hand, there, back)] == ["set", "schedule", "stopped"]
    assert shown(back).tip == shown(there).tip
    again = scheduled(back)
    assert_allclose(tip(again), flight.reached[0], atol=math.radians(0.02))
    alone = done(by_hand, choose_state(by_hand, "stopped"))
    for one in (by_hand, there, back, again, alone):
        for effects in (choose_state(one, "set"), (after_flight(one.hand),)):
            after = done(one, effects)
            assert (after.hand.actuator, after.hand.state) == (actuator, "set")


def test_hours_of_a_link_are_read_and_two_legs_always_stay():
    assert read_hours(hours_text((0.5, 0.25, 0.0, 2.0))) == (0.5, 0.25, 0.0, 2.0)
    for text in ("", "1,1,1", "1,1,1,fast", "0,0,0,1", "1,1,1,-1", "1,1,1,nan", "1,1,1,100"):
        with pytest.raises(ValueError, match="is not the hours of 4 legs: write"):
            read_hours(text)
    assert hours_with((0.5, 0.25, 1.0, 0.25), 2, 3.0) == (0.5, 0.25, 3.0, 0.25)
    assert hours_with((0.5, 0.0, 0.0, 0.25), 0, 0.0) == (0.5, 0.0, 0.0, 0.25)
