"""The flight bar of Actuate without a browser: what the page draws, and what a place of the bar sets."""

import math
import pickle
from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import viser
from numpy.testing import assert_allclose

from explorer.model.actuator_inputs import (
    MOST_SEGMENTS,
    ActuatorInputs,
    flight_legs,
    flight_of,
    lean_verdict,
    question_of,
)
from explorer.model.inputs import Inputs
from explorer.model.units import AVIATION, SI, number
from explorer.tabs.actuator.actuator_controls import ActuatorControls
from explorer.tabs.actuator.flight_bar import HALVES, FlightBar, condition_at, earns_state, flight_state, place_of
from rotor.actuator.flight import ActuatorFlight, standard_flight
from rotor.actuator.verdict import Verdict
from rotor.chart import DrawnBand, DrawnLine
from rotor.files.make_design import make_design

RIGID = replace(make_design(mu=0.2), models=replace(make_design(mu=0.2).models, elastic_twist=False))
QUESTION = question_of(ActuatorInputs(), RIGID)
LEGS = flight_legs(RIGID)


@pytest.fixture(scope="module")
def verdict() -> Verdict:
    return lean_verdict(QUESTION)


@pytest.fixture(scope="module")
def flight(verdict: Verdict) -> ActuatorFlight:
    return flight_of(pickle.loads(pickle.dumps(verdict)))


def test_the_bar_goes_through_the_standard_flight_and_half_way_between_its_legs():
    assert LEGS[::HALVES] == standard_flight(RIGID)
    for k, leg in enumerate(standard_flight(RIGID)):
        assert condition_at(LEGS, float(k)) == (leg.advance_ratio, leg.climb_speed)
        assert place_of(LEGS, leg.advance_ratio) == pytest.approx(k)
    (mu, climb), (one, two) = condition_at(LEGS, 0.5), standard_flight(RIGID)[:2]
    assert mu == pytest.approx(0.5 * (one.advance_ratio + two.advance_ratio), abs=5e-4)
    assert climb == pytest.approx(0.5 * (one.climb_speed + two.climb_speed), abs=5e-3)
    assert condition_at(LEGS, 1.5)[1] == 0.0  # Level again, as a flight at that speed is that one enters with.
    assert place_of(LEGS, 0.5) == len(standard_flight(RIGID)) - 1  # Faster than the flight: its end.


def test_the_page_draws_the_flight_as_it_was_computed(flight: ActuatorFlight):
    state = flight_state(LEGS, flight, True, 0.2, RIGID.rotor.tip_speed, SI)
    assert state["kind"] == "ready"
    lines: dict[str, Any] = {one.label: one.y for one in state["chart"].series if isinstance(one, DrawnLine)}
    assert_allclose(lines["wanted"], np.degrees(flight.wanted), atol=6e-4)
    assert_allclose(lines["reached"], np.degrees(flight.reached), atol=6e-4)
    low, high = state["chart"].y.range
    for angles in (flight.wanted, flight.reached, flight.reach):
        assert low < math.degrees(min(angles)) <= math.degrees(max(angles)) < high
    bands: list[Any] = [one for one in state["chart"].series if isinstance(one, DrawnBand) and len(one.x) == 2]
    assert [bands[0].x[0], bands[-1].x[-1]] == [0.0, 3.0]
    for band in bands:  # Green where the flight gains.
        net = np.interp(np.mean(band.x), np.arange(len(LEGS)) / HALVES, flight.net_saving)
        assert ("gain" in band.colour) == (net > 0.0)
    assert [name for name, _ in state["legs"]] == ["hover", "climb", "cruise", "fast"]
    assert condition_at(LEGS, state["at"])[0] == pytest.approx(0.2, abs=2e-3)
    other = flight_state(LEGS, flight, True, 0.2, RIGID.rotor.tip_speed, AVIATION, tip=1.29, flown=True)
    assert (other["tip"], other["flown"]) == ("+1.29°", True)
    assert "kt" in other["legs"][1][1]


def test_what_is_being_computed_is_said_and_keeps_its_place(flight: ActuatorFlight, verdict: Verdict):
    """Its keys are those of an answer, so that nothing jumps; the curves of the question before stay, marked."""
    speed = RIGID.rotor.tip_speed
    first, before = (flight_state(LEGS, one, False, 0.2, speed, SI) for one in (None, flight))
    wrong = flight_state(LEGS, None, False, 0.2, speed, SI, "hover: does not trim")
    assert (first["kind"], first["words"]) == ("computing", "computing…")
    assert first["chart"].series == []
    assert before["kind"] == "computing"
    assert before["chart"] == flight_state(LEGS, flight, True, 0.2, speed, SI)["chart"]
    assert (wrong["kind"], wrong["words"]) == ("problem", "hover: does not trim")
    assert earns_state(None, False, SI).keys() == earns_state(verdict, True, SI).keys()
    assert earns_state(None, False, SI)["kind"] == earns_state(verdict, False, SI)["kind"] == "computing"
    assert earns_state(None, False, SI, "no blade")["problem"] == "no blade"


def test_the_bars_of_the_balance_add_up_to_the_verdict(verdict: Verdict):
    state = earns_state(verdict, True, SI)
    *parts, total = state["bars"]
    assert sum(bar["value"] for bar in parts) == pytest.approx(total["value"], abs=5e-3)
    assert total["value"] == pytest.approx(-1e-3 * verdict.net_saving, abs=1e-3)
    assert total["total"]
    size = abs(total["value"])
    told = f"{size:.0f} kW" if size >= 10.0 else f"{size:.1f} kW"
    assert (f"needs {told} more" if total["value"] > 0.0 else f"saves {told}") in state["mission"]
    assert state["mass"] == f"{verdict.installed.masses.aircraft:.0f} kg on board"
    assert f"{verdict.installed.masses.blade:.1f} kg" in state["mass_note"]
    for bar in state["bars"]:  # Red is loss and green is gain.
        assert bar["kind"] == ("" if abs(bar["value"]) < 0.05 else "loss" if bar["value"] > 0.0 else "gain")
    assert verdict.fuel_saving is not None
    burnt = -3600.0 * verdict.fuel_saving
    assert state["fuel"].replace("−", "-") == f"{burnt:+.1f} kg of fuel an hour"
    assert state["fuel_kind"] == ("loss" if burnt > 0.0 else "gain")


def degrees_text(angle: float) -> str:
    return f"{number(math.degrees(angle), 2, sign=True)}°"


class Stage:
    """A bar with true widgets, and the page and sliders as a test sees them."""

    def __init__(self, server: viser.ViserServer) -> None:
        self.shown: dict[str, Any] = {}
        self.actions: dict[str, Callable[[Any], None]] = {}
        self.inputs = Inputs()
        self.woken = 0
        bridge = SimpleNamespace(set=self.shown.update, on=self.actions.__setitem__)
        self.context: Any = SimpleNamespace(
            bridge=bridge,
            held=False,
            units=SI,
            inputs=lambda: self.inputs,
            drag_to=self._drag,
            gui=server.gui,
            wake=self._wake,
        )
        self.controls = ActuatorControls(server.gui, lambda: None, lambda: self.bar.leave_to_hand())
        self.bar = FlightBar(self.context, self.controls)

    def _wake(self) -> None:
        self.woken += 1

    def _drag(self, inputs: Inputs) -> None:
        self.inputs = inputs

    def show(self, verdict: Verdict | None, flight: ActuatorFlight | None) -> None:
        installed = self.controls.inputs().installed(RIGID.rotor)
        self.bar.show(self.inputs, RIGID, installed, verdict, flight, math.degrees(self.tip()))

    def stop(self, on: bool) -> None:
        """Tick the box, or take the tick away, by hand."""
        self.bar._stopped.value = on
        self.bar._follow()

    def tip(self) -> float:
        """What the sliders make of the blade [rad]."""
        now = self.controls.inputs()
        return now.tip(now.installed(RIGID.rotor), RIGID)


@pytest.fixture
def stage(server: viser.ViserServer) -> Stage:
    return Stage(server)


def test_a_place_of_the_bar_sets_condition_and_voltages(stage: Stage, flight: ActuatorFlight, verdict: Verdict):
    """By the inputs of the sliders; the blade has the twist that the chart says is reached there."""
    stage.show(verdict, flight)
    for x, leg in enumerate(standard_flight(RIGID)):
        stage.actions["fly"](x)
        assert (stage.inputs.advance_ratio, stage.inputs.climb_m_s) == (leg.advance_ratio, leg.climb_speed)
        assert_allclose(stage.tip(), flight.reached[HALVES * x], atol=math.radians(0.02))  # In whole per cent.
    stage.actions["fly"](0.25)
    assert_allclose(stage.tip(), np.interp(0.5, [0, 1], flight.reached[:2]), atol=math.radians(0.02))
    stage.actions["fly"](99)
    assert stage.inputs.advance_ratio == LEGS[-1].advance_ratio


def test_the_voltages_follow_once_the_flight_is_known(stage: Stage, flight: ActuatorFlight, verdict: Verdict):
    stage.show(None, None)
    stage.actions["fly"](3)
    assert stage.inputs.advance_ratio == LEGS[-1].advance_ratio  # The condition needs no answer.
    assert stage.tip() == 0.0
    stage.show(verdict, flight)
    assert_allclose(stage.tip(), flight.reached[-1], atol=math.radians(0.02))


def test_leaving_puts_the_flight_to_rest_but_not_a_voltage_set_by_hand(
    stage: Stage, flight: ActuatorFlight, verdict: Verdict
):
    stage.show(verdict, flight)
    stage.actions["fly"](3)
    stage.bar.hide()
    assert stage.tip() == 0.0
    assert stage.shown["flight"] is stage.shown["earns"] is None
    stage.actions["fly"](3)
    stage.bar.leave_to_hand()
    stage.bar.hide()
    assert stage.tip() != 0.0


def test_an_actuator_that_stops_flies_on_with_its_twist_frozen(stage: Stage, flight: ActuatorFlight, verdict: Verdict):
    stage.show(verdict, flight)
    stage.actions["fly"](0)
    frozen = stage.tip()
    stage.stop(True)
    stage.show(verdict, flight)
    drawn = stage.shown["flight"]
    assert (drawn["flown"], drawn["frozen"], drawn["tip"]) == (False, math.degrees(frozen), degrees_text(frozen))
    line: Any
    (line,) = [one for one in drawn["chart"].series if one.label == "stopped"]
    assert_allclose(line.y, math.degrees(frozen), atol=6e-4)
    stage.actions["fly"](3)
    stage.show(verdict, flight)
    assert stage.inputs.advance_ratio == LEGS[-1].advance_ratio
    assert stage.tip() == frozen != 0.0
    assert stage.shown["flight"]["tip"] == degrees_text(frozen)
    stage.stop(False)
    assert_allclose(stage.tip(), flight.reached[-1], atol=math.radians(0.02))
    stage.show(verdict, flight)
    drawn = stage.shown["flight"]
    assert (drawn["flown"], drawn["frozen"]) == (True, None)
    assert "stopped" not in [one.label for one in drawn["chart"].series]
    stage.stop(True)
    stage.bar.hide()
    assert not stage.bar._stopped.value


def test_a_stop_shows_at_once_where_a_hand_set_the_voltage(stage: Stage, flight: ActuatorFlight, verdict: Verdict):
    stage.show(verdict, flight)
    stage.controls.drive((60.0,) * MOST_SEGMENTS, by_hand=True)
    woken = stage.woken
    stage.stop(True)
    assert stage.woken == woken + 1
    stage.show(verdict, flight)
    assert stage.shown["flight"]["tip"] == degrees_text(stage.tip()) != degrees_text(0.0)
    stage.bar.hide()
    assert not stage.bar._stopped.value


def test_a_follower_does_not_fly(stage: Stage, flight: ActuatorFlight, verdict: Verdict):
    stage.show(verdict, flight)
    stage.context.held = True
    before = stage.inputs
    stage.actions["fly"](3)
    assert stage.inputs == before
    assert stage.tip() == 0.0
