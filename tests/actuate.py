"""Actuate without a page: what its panels are functions of, and what a press does to it."""

import math
from collections.abc import Hashable, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from explorer.model.actuator_inputs import ActuatorInputs, ActuatorState, HandSettings
from explorer.model.inputs import Inputs, ViewState, baseline_of
from explorer.model.session_state import SessionState
from explorer.parts.actuate import DialNumbers
from explorer.views.actuated import counted_from
from explorer.views.actuator import ACTUATOR
from explorer.views.assessed import ACTUATOR_CARD
from explorer.views.dial import DIAL
from explorer.views.flight import FLIGHT
from explorer.views.line import works
from explorer.views.page_state import Effect, MoveSliders, OpenPanels, PageState, Panel, SetHand
from explorer.workers.call import Call, at_once
from rotor.actuator.verdict import Against
from rotor.design import Harmonic
from rotor.trim.solve import solve

INPUTS = Inputs(law="builtin", advance_ratio=0.2, inflow="drees")


def actuate(
    inputs: Inputs, answers: Mapping[Hashable, Any] | None = None, **hand: Any
) -> PageState:
    """The page in Actuate with this design, the blade lifted out; `hand`: fields of `HandSettings`."""
    own = HandSettings(**hand, on_board=True)
    now = PageState(
        inputs, None, None, ui=OpenPanels("actuate", lifted=True), hand=own, answers=answers or {}
    )
    return solved(now)


def solved(now: PageState) -> PageState:
    """As the session has it after its next update."""
    design = now.inputs.design()
    now = replace(now, sliders=design)
    solution = solve(now.hand.fit(design)).require()
    baseline = solve(counted_from(now) or baseline_of(design)).require()
    return replace(now, state=SessionState(now.inputs, ViewState(), solution, baseline, None))


@cache
def run(call: Call) -> Any:
    return call.run()


def answered(
    against: Against,
    drives: tuple[float, ...],
    state: ActuatorState = "set",
    id: str = "MFC_P1",
    inputs: Inputs = INPUTS,
) -> PageState:
    """The page in a state of the actuator once all that the value waits for is known."""
    now = actuate(inputs, actuator=ActuatorInputs(id, against=against, drives=drives))
    for name in ("lean_verdict", "flight_of"):
        now = told(ACTUATOR, now, **{name: run(asked(ACTUATOR, now)[name])})
    now = solved(done(now, FLIGHT.presses["state"](now, state)))
    now = told(ACTUATOR_CARD, now, other_stroke=run(asked(ACTUATOR_CARD, now)["other_stroke"]))
    effects = {call: run(call) for call in DIAL.asks(now)[0].calls}
    now = replace(now, answers={**now.answers, **effects})
    scale = {call: run(call) for call in ACTUATOR_CARD.asks(now)[0].calls}
    now = worked(ACTUATOR_CARD, worked(DIAL, replace(now, answers={**now.answers, **scale})))
    doubts = {task.key: at_once(task.run(lambda: None)) for task in works(now)}
    now = replace(now, answers={**now.answers, **doubts})
    flown = replace(now, hand=done(now, FLIGHT.presses["balance"](now, "here")).hand)
    return replace(
        now, answers=told(FLIGHT, flown, powers=run(asked(FLIGHT, flown)["powers"])).answers
    )


def asked(panel: Panel, now: PageState) -> dict[str, Call]:
    """What is asked, by the names of the functions; the first of each."""
    calls = [call for one in panel.asks(now) for call in one.calls]
    return {call.function.__name__: call for call in reversed(calls)}


def told(panel: Panel, now: PageState, **answers: Any) -> PageState:
    """With answers to what it asks, by the names of the functions."""
    calls = asked(panel, now)
    return replace(
        now, answers={**now.answers, **{calls[name]: answer for name, answer in answers.items()}}
    )


def worked(panel: Panel, now: PageState) -> PageState:
    """With what it has the page's own thread compute."""
    results = {work.key: at_once(work.run(lambda: None)) for work in panel.works(now)}
    return replace(now, answers={**now.answers, **results})


def done(now: PageState, effects: tuple[Effect, ...]) -> PageState:
    """What effects leave behind: sliders, the hand, widgets of the actuator in whole per cent."""
    for effect in effects:
        match effect:
            case MoveSliders(inputs):
                now = replace(now, inputs=inputs)
            case SetHand(changes, moved):
                whole = {"drives": tuple(map(round, moved["drives"]))} if "drives" in moved else {}
                actuator: ActuatorInputs = replace(now.hand.actuator, **{**moved, **whole})
                now = replace(now, hand=replace(now.hand, **changes, actuator=actuator))
            case _:
                pass
    return now


def vector(waves: tuple[Harmonic, ...]) -> np.ndarray:
    """Cosine and sine part of each harmonic of the dial [°]."""
    x = np.zeros((4, 2))
    for one in waves:
        x[one.per_rev - 2] = math.degrees(one.amplitude) * np.array(
            [math.cos(one.phase), math.sin(one.phase)]
        )
    return x.ravel()


def foreseen(answer: DialNumbers, waves: tuple[Harmonic, ...]) -> tuple[float, float]:
    """Changes of power and index [%], by the formulas of `dial.js`, written again."""
    x = vector(waves)
    base, slopes, second, gains = (
        np.array(one) for one in (answer.base, answer.slopes, answer.second, answer.gains)
    )
    values = base + slopes @ x + 0.5 * np.einsum("kij,i,j->k", second, x, x)
    sizes = (gains * np.hypot(values[0:10:2], values[1:10:2])) ** 2
    index = math.sqrt(sizes[:3].sum()) + math.sqrt(sizes[3:].sum())
    return 100.0 * (values[10] / answer.power - 1.0), 100.0 * (index / answer.index - 1.0)
