"""The rail of Actuate: what stands between its widgets, what they are called, and how the blade in the hand moves them.

Above the widgets stands why there is no verdict; below them twist now, reach and limits.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from explorer.model.actuator_inputs import MOST_SEGMENTS
from explorer.views import actuator_words as words
from explorer.views.actuated import (
    ActuatedBlade,
    actuated_blade,
    immovable_kinds,
    in_actuate,
    no_carrier,
    problem,
)
from explorer.views.flight import BY_HAND
from explorer.views.page_state import Effect, PageState, Panel, Questions, SetHand
from rotor.actuator.catalogue import actuators
from rotor.support.markup import Markup

_DELAY_S = 0.4
"""How long a question must stand before it is worked on [s], so that a dragged slider starts nothing."""
_IDLE_DELAY_S = 2.5
"""How long the page must have been still before work is begun that nobody asked for [s]."""
_FULL_DRIVE = 100.0
"""The whole voltage on its slider [%]."""
DRIVES = tuple(f"drive {k}" for k in range(MOST_SEGMENTS))
"""Names of the sliders of voltage."""
_WIDGETS = (
    "actuator",
    "plies",
    "span",
    *DRIVES,
    "chord",
    "blade",
    "stiffness",
    "crossed",
    "concept",
)
"""Names of all widgets of the actuator, the sliders of voltage among them."""
_TEXTS = "actuator.weak", "actuator.bar", "actuator.now"
"""Names of the texts between them that are in no folder."""


def asks(now: PageState) -> tuple[Questions, ...]:
    """The chosen actuator's verdict comes behind searches and maps, then its flight; others once what would pay shows
    them beside it."""
    if (one := actuated_blade(now)) is None:
        return ()
    first, *_ = one.tasks.values()
    chosen = one.question.actuator
    hidden = {chosen, *now.of(immovable_kinds)}
    others = [task for id, task in one.tasks.items() if id not in hidden]
    flown = one.flight is not None or isinstance(one.outcome, str)
    flight = () if one.flight_task is None else (one.flight_task,)
    beside = tuple(others) if flown and now.hand.on_stage else ()
    return (
        Questions(3, (first,), _DELAY_S),
        Questions(4, flight, 0.0),
        Questions(7, beside, _IDLE_DELAY_S),
    )


def view(now: PageState) -> dict[str, Any]:
    """Texts of the rail; where there is no such design, why, all else as it was.

    A rotor that carries no actuator has the sentence that says why, and no widgets.
    """
    one, state, inputs = actuated_blade(now), now.state, now.hand.actuator
    carrier = no_carrier(now)
    if carrier:
        empty = dict.fromkeys(_TEXTS, Markup())
        return {
            "actuator.verdict": words.problem_panel(carrier),
            **empty,
            "actuator.form": FormLook(dict.fromkeys(_WIDGETS, False), {}, carried=False),
        }
    form = {} if one is None else {"actuator.form": form_look(one, tuple(now.of(immovable_kinds)))}
    if one is None or state is None or now.problem:
        return {"actuator.verdict": words.problem_panel(problem(now))} | form
    installed, verdict = one.installed, one.verdict
    return {
        "actuator.verdict": words.problem_panel(one.outcome),
        "actuator.weak": words.immovable_panel(now.of(immovable_kinds), inputs.actuator),
        "actuator.bar": words.voltage_bar(installed.actuator),
        "actuator.now": words.now_panel(inputs, installed, now.inputs.twist_per_rev),
        "actuator.numbers": words.fit_panel(installed, verdict, now.units),
        "actuator.limits": words.limits_panel(verdict),
    } | form


@dataclass(frozen=True)
class FormLook:
    """Which widgets of the actuator there are, what they are called, and which kinds their menu offers."""

    seen: Mapping[str, bool]
    labels: Mapping[str, str]
    kinds: tuple[str, ...] = ()
    carried: bool = True
    """Whether this rotor carries an actuator: else there are no folders either."""


def form_look(blade: ActuatedBlade, immovable: Sequence[str] = ()) -> FormLook:
    """The widgets for the actuator on the blade.

    `immovable`: kinds that cannot move it, which the menu does not offer unless one of them is chosen.
    """
    inputs = blade.inputs
    installed = blade.installed
    actuator = installed.actuator
    count = len(installed.shapes)
    word = actuator.drive_noun.capitalize()
    return FormLook(
        seen={
            **dict.fromkeys(_WIDGETS, True),
            **{name: k < count for k, name in enumerate(DRIVES)},
            **{name: name in actuator.settings for name in ("plies", "span", "chord", "crossed")},
            "stiffness": inputs.blade == "new",
        },
        labels={
            **{
                name: f"{word} {k + 1} [%]" if count > 1 else f"{word} [%]"
                for k, name in enumerate(DRIVES)
            },
            "crossed": "Fibres at −45°" if actuator.on_skin else "Turns the tip down",
            "plies": f"{actuator.noun[1].capitalize()}{' per side' if actuator.on_skin else ''}",
            "span": "Span {:.2f}–{:.2f}".format(*inputs.span),
            "chord": "Chord {:.2f}–{:.2f}".format(*inputs.chord),
        },
        kinds=tuple(id for id in actuators() if id == inputs.actuator or id not in immovable),
    )


def pull(now: PageState, share: float | None) -> tuple[Effect, ...]:
    """The lifted blade was taken (None), or its trailing edge is pulled up by this share of the full drive."""
    one, inputs = actuated_blade(now), now.hand.actuator
    if one is None:
        return ()
    if share is None:
        nose_up = replace(inputs, drives=(_FULL_DRIVE,) * MOST_SEGMENTS).tip(one.installed)
        return (SetHand({"pulled": (inputs.drives, -math.copysign(_FULL_DRIVE, nose_up))}),)
    start, whole = now.hand.pulled
    if not start:  # It was not taken.
        return ()
    drives = tuple(
        min(max(drive + share * whole, inputs.least_drive), _FULL_DRIVE) for drive in start
    )
    return (SetHand(BY_HAND, {"drives": drives}),)


def actuator_titles() -> dict[str, str]:
    return {id: f"{id.replace('_', ' ')}: {actuator.mode}" for id, actuator in actuators().items()}


ACTUATOR = Panel(view, in_actuate, asks, presses={"pull": pull})
