"""The dial of twist at n/rev without a page: every stage of it, what it asks, and what its presses do."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from explorer.model.actuator_inputs import AGAINST, ActuatorInputs
from explorer.model.inputs import Inputs, with_rotor
from explorer.parts.actuate import DialMatrix, DialNumbers, DialPart, ModelChanges
from explorer.parts.presses import WavePress
from explorer.views.dial import DIAL, move_dot, take_dot
from explorer.views.dial_answer import DialAnswer
from explorer.views.page_state import MoveSliders, PageState, SetGrabbed
from rotor.actuator import (
    EffectInFlight,
    HostBlade,
    default_placement,
    find_actuator,
    install,
    tip_amplitude,
    with_actuator,
)
from rotor.actuator.harmonic import pitching_power
from rotor.design.active_twist import Harmonic, read_harmonics
from rotor.files.make_design import make_design
from rotor.optimisation.vibration import with_harmonics
from rotor.trim.solve import solve
from tests.actuate import actuate, asked, worked

BENDING = Inputs(law="builtin", advance_ratio=0.3, bending=True)
SAME = ActuatorInputs(against="same-blade")

STEP = (0.804, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0)
"""A twist of the front: cosines and sines [°]."""


def numbers(slope: float, power: float = 1e4) -> DialNumbers:
    """A force of 1 N, which changes by `slope` for 1° of cos 2ψ, and 1000 kW, `power` W more for 1° of sin 3ψ."""
    slopes = np.zeros((11, 8))
    slopes[0, 0], slopes[10, 3] = slope, power
    return DialNumbers(
        [1.0, *[0.0] * 9, 1e6], slopes.tolist(), np.zeros((11, 8, 8)).tolist(), [1.0] * 5, 1e6, 1.0
    )


OWN, OTHER = numbers(-0.5), numbers(0.25, -2e3)
MOVED = EffectInFlight((1500.0, 900.0), (-20.004, 3.0))


def fitted_losses(now: PageState) -> float:
    """Heat of the plies at the twist of the page [W], by `rotor` alone."""
    installed = install(
        find_actuator("MFC_P1"), default_placement(), HostBlade(), BENDING.design().rotor
    )
    share = WAVES[0].amplitude / tip_amplitude(installed)
    return 4.0 * installed.actuator.harmonic_loss(installed, 3, 1.0) * share**2


def dial(now: PageState) -> DialPart:
    return DIAL.view(now)["dial"]


WAVES = read_harmonics("3:0.75:60", "test")


@pytest.fixture(scope="module")
def asking() -> PageState:
    """With 3/rev, against the same blade, which needs no verdict."""
    return actuate(replace(BENDING, twist_per_rev=WAVES), actuator=SAME)


@pytest.fixture(scope="module")
def answered(asking: PageState) -> PageState:
    """By the own inflow model, by two of the others, and by one that does not trim."""
    own, *others = [call for one in DIAL.asks(asking)[1:] for call in one.calls]
    given = {
        own: DialAnswer(OWN, ((0.0,) * 8, STEP)),
        **dict.fromkeys(others, DialAnswer(OTHER, ())),
    }
    calls = DIAL.asks(asking)[0].calls
    known = worked(DIAL, asking).answers
    return replace(asking, answers={**given, others[-1]: "No trim.", calls[-1]: MOVED, **known})


def test_it_says_what_twist_at_n_per_rev_alone_changes(asking: PageState):
    """Zero at zero, at any voltage and against any blade, with nothing to trim; else as set with it and without."""
    for against in AGAINST:
        still = actuate(BENDING, actuator=ActuatorInputs(against=against, drives=(77.0,) * 5))
        assert (dial(still).settled, dial(still).computing) == (ModelChanges((0.0,), (0.0,)), True)
        assert [name for name in asked(DIAL, still) if name == "effect"] == ["effect"] * (
            against == "same-blade"
        )
    assert dial(asking).settled is None
    assert dial(asking).against == "the same without n/rev"
    assert [(one.urgency, len(one.calls)) for one in DIAL.asks(asking)] == [(4, 2), (7, 2), (8, 2)]
    designs: Any = DIAL.asks(asking)[0].calls[1].arguments
    flown, still = designs
    assert (flown.active_twist.harmonics, still) == (WAVES, replace(flown, active_twist=None))
    assert still == with_actuator(make_design(mu=0.3, bending=True), "MFC_P1")


def test_what_is_answered_is_shown(answered: PageState):
    shown = DIAL.view(answered)
    assert shown == DIAL.view(replace(answered))
    assert shown["dial_matrix"] == DialMatrix(**vars(OWN), inflows=(OTHER, OTHER))
    one = dial(answered)
    heat = 1e-3 * fitted_losses(answered)
    assert one.settled is not None
    design = with_actuator(make_design(mu=0.3, bending=True), "MFC_P1")
    flown, still = (solve(with_harmonics(design, waves)).require() for waves in (WAVES, ()))
    own = flown.power.total - still.power.total + pitching_power(flown) - pitching_power(still)
    assert one.settled.power == pytest.approx((1e-3 * own + heat, 0.9 + heat), abs=2e-3)
    assert one.settled.index == (-20.0, 3.0)
    assert (one.computing, one.words, one.problem) == (False, "", "")
    assert [[round(value, 6) for value in dot[:2]] for dot in one.front] == [[0.0, 0.0], [0.5, 0.0]]
    assert [dot[2] for dot in one.front] == [(0.0,) * 8, STEP]
    words = [
        word
        for one in shown["dial_front"].series
        for word in getattr(one, "words", ())
        if "over inflow" in word
    ]
    assert (
        "power +0.5 % (−0.1 to +0.5, unclear), vibration 0 % (−40 to +20, unclear) over inflow models"
        in words[1]
    )
    # Its own model and one more.
    waits = replace(answered, answers=dict([*answered.answers.items()][:2]))
    assert (dial(waits).computing, dial(waits).front) == (True, ())
    assert DIAL.view(waits)["dial_matrix"] == DialMatrix(**vars(OWN), inflows=(OTHER,))
    assert one.whole > 0.5
    assert one.room == 1.0


def test_voltage_takes_of_the_room_and_twist_beyond_the_dial_widens_it(answered: PageState):
    driven = replace(
        answered, hand=replace(answered.hand, actuator=replace(SAME, drives=(50.0,) * 4))
    )
    assert dial(driven).room < 1.0
    wide = replace(
        answered, inputs=replace(BENDING, twist_per_rev=read_harmonics("3:2.2:60", "test"))
    )
    assert dial(wide).reach == 3.0
    assert dial(wide).now == ((3, 2.2, 60.0),)


def test_what_fails_is_a_sentence(answered: PageState):
    calls = asked(DIAL, answered)
    moved = DIAL.asks(answered)[0].calls[1]
    failed = replace(answered, answers={moved: "No trim.", calls["dial_answer"]: "No response."})
    assert (dial(failed).problem, dial(failed).words, dial(failed).computing) == (
        "No trim.",
        "No response.",
        False,
    )
    slow = actuate(replace(BENDING, advance_ratio=0.02), actuator=SAME)
    assert "Hub loads are not shown below" in dial(slow).words
    assert list(asked(DIAL, slow)) == ["effect"]
    untrimmed = replace(answered, problem="No trim there.")
    assert list(DIAL.view(untrimmed)) == ["actuator.per_rev"]  # The last answer stays.
    assert asked(DIAL, untrimmed) == {}


def test_a_blade_that_carries_no_actuator_has_a_dial_too():
    other = actuate(replace(with_rotor(BENDING, "s61"), twist_per_rev=WAVES))
    assert (dial(other).whole, dial(other).room) == (0.0, 0.0)
    assert "effect" in asked(DIAL, other)


def test_it_says_what_is_set_that_it_does_not_show(asking: PageState):
    """By a file too, at harmonics that the dial does not have."""
    assert "Active" not in DIAL.view(asking)["actuator.per_rev"]
    waves, pitch = read_harmonics("8:15:20", "test"), read_harmonics("3:1.5:180", "test")
    shaped = replace(
        BENDING, twist_per_rev=waves, pitch_per_rev=pitch, active_shape=((0.3, 1.0), (0.0, 1.0))
    )
    words = DIAL.view(replace(asking, inputs=shaped))["actuator.per_rev"]
    for part in (
        "Active twist of 15.00° at 8/rev",
        "root pitch of 1.50° at 3/rev",
        "shape given in its design file",
    ):
        assert part in words


def test_the_dot_is_taken_dragged_and_let_go(asking: PageState):
    assert move_dot(asking, "start") == (SetGrabbed(True),)
    # The dial has no 7/rev.
    (drag,) = move_dot(asking, [WavePress(3, 0.5, 40.0), WavePress(7, 1.0, 0.0)])
    assert isinstance(drag, MoveSliders)
    assert drag.by_hand
    assert drag.inputs == replace(
        asking.inputs, twist_per_rev=(Harmonic(3, math.radians(0.5), math.radians(40.0)),)
    )
    assert move_dot(replace(asking, inputs=drag.inputs), [WavePress(3, 0.5, 40.0)]) == ()
    assert move_dot(asking, "end") == (SetGrabbed(False),)


def test_a_dot_of_the_front_is_put_with_the_digits_shown(answered: PageState, asking: PageState):
    (put,) = take_dot(answered, 1)
    assert isinstance(put, MoveSliders)
    assert not put.by_hand
    assert [round(math.degrees(wave.amplitude), 6) for wave in put.inputs.twist_per_rev] == [
        0.8,
        0.5,
    ]
    assert take_dot(answered, 2) == take_dot(asking, 0) == ()
