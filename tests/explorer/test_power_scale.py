"""The scale of power in Actuate: what is known at once, what is on its way, and what stands for it meanwhile."""

import math
from dataclasses import replace

import pytest

from explorer.model.actuator_inputs import MOST_SEGMENTS, ActuatorInputs
from explorer.parts.actuate import PowerMark, PowerScale
from explorer.views.assessed import ACTUATOR_CARD
from explorer.views.page_state import PageState
from explorer.views.power_scale import power_scale, scale_calls
from rotor.actuator import powers
from rotor.files.make_design import make_design
from tests.actuate import INPUTS, actuate, run, solved

DRIVEN = ActuatorInputs(drives=(50.0,) * MOST_SEGMENTS)


@pytest.fixture(scope="module")
def driven() -> PageState:
    """The page with a driven actuator, before anything else is known."""
    return actuate(INPUTS, actuator=DRIVEN)


def scale_of(now: PageState) -> PowerScale:
    scale = power_scale(now)
    assert scale is not None
    return scale


def marks_of(now: PageState) -> dict[str, PowerMark]:
    return {mark.name: mark for mark in scale_of(now).marks}


def with_answers(now: PageState) -> PageState:
    return replace(now, answers={**now.answers, **{call: run(call) for call in scale_calls(now)}})


def test_what_the_page_has_trimmed_stands_there_at_once_and_the_rest_is_on_its_way(
    driven: PageState,
):
    assert driven.state is not None
    marks = marks_of(driven)
    flown = driven.state.solution.power.total
    without = driven.state.baseline.power.total
    assert marks["as set"].at == pytest.approx(1e-3 * flown, abs=1e-3)
    assert marks["as set"].value == f"{1e-3 * flown:.0f}"
    assert marks["without it"].at == pytest.approx(1e-3 * without, abs=1e-3)
    assert [name for name, mark in marks.items() if mark.flown] == ["as set"]
    late = [name for name, mark in marks.items() if mark.at is None]
    assert late == ["at rest", "by schedule", "best fixed blade"]
    sentence = scale_of(driven).sentence
    assert sentence.endswith("; computing: at rest, by schedule, best fixed blade.")
    assert sentence.startswith("Power in this flight, kW: without it ")
    # Of the three only the one at rest is a design already.
    (call,) = scale_calls(driven)
    assert call.function is powers


def test_the_axis_holds_every_mark_with_its_band_in_the_order_of_power(driven: PageState):
    scale = scale_of(with_answers(driven))
    known = [mark for mark in scale.marks if mark.at is not None]
    places = [mark.at or math.nan for mark in known]
    assert places == sorted(places)
    low, high = scale.ends
    for mark, at in zip(known, places, strict=True):
        assert low < at - mark.band
        assert at + mark.band < high
    at_rest = next(mark for mark in known if mark.name == "at rest")
    assert at_rest.band > 0.0
    assert high - low >= 0.01 * max(places)


def test_blades_that_are_one_design_have_one_mark():
    now = with_answers(actuate(INPUTS, actuator=ActuatorInputs()))
    marks = marks_of(now)
    assert marks["at rest, as set"].flown
    assert scale_calls(now) == ()


def test_powers_of_the_inputs_before_stand_there_marked_until_their_own_come(driven: PageState):
    known = with_answers(driven)
    memory = ACTUATOR_CARD.remember(known, {})
    faster = replace(INPUTS, advance_ratio=0.3)
    moved = solved(replace(driven, inputs=faster, memory=memory))
    marks = marks_of(moved)
    assert marks["at rest"].stale
    assert marks["at rest"].value == marks_of(known)["at rest"].value
    assert not marks["as set"].stale
    assert "at rest" in scale_of(moved).sentence
    assert "(out of date)" in scale_of(moved).sentence
    fresh = marks_of(with_answers(moved))
    assert not fresh["at rest"].stale
    assert fresh["at rest"].value != marks["at rest"].value


def test_a_blade_that_does_not_trim_is_no_mark(driven: PageState):
    (call,) = scale_calls(driven)
    marks = marks_of(replace(driven, answers={call: "Not trimmed."}))
    assert "at rest" not in marks
    assert "as set" in marks


def test_a_stopped_actuator_is_a_mark_of_its_own_state(driven: PageState):
    stopped = replace(driven, hand=replace(driven.hand, stopped=True))
    marks = marks_of(stopped)
    assert marks["as set, stopped"].flown


def test_there_is_no_scale_without_an_actuator(driven: PageState):
    other = replace(driven, sliders=make_design(rotor="s61"))
    assert power_scale(other) is None
    assert scale_calls(other) == ()
