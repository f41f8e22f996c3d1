"""The rail of Actuate: what stands between its widgets, what they are called, and how the blade in the hand moves them.

Above the widgets stands why there is no verdict; below them twist now, reach and limits.
"""

import math
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

from explorer.model.actuator_inputs import MOST_SEGMENTS, ActuatorInputs
from explorer.views import actuator_words as words
from explorer.views.actuated import ActuatedBlade, actuated_blade, in_actuate, problem
from explorer.views.flight import BY_HAND
from explorer.views.page_state import Effect, PageState, Panel, Questions, SetHand
from rotor.actuator.catalogue import actuators
from rotor.actuator.installation import InstalledActuator
from rotor.dynamics.structure import KNOWN_BLADE
from rotor.files.make_design import uh60a_rotor

_DELAY_S = 0.4
"""How long a question must stand before it is worked on [s], so that a dragged slider starts nothing."""
_IDLE_DELAY_S = 2.5
"""How long the page must have been still before work is begun that nobody asked for [s]."""
_FULL_DRIVE = 100.0
"""The whole voltage on its slider [%]."""
DRIVES = tuple(f"drive {k}" for k in range(MOST_SEGMENTS))
"""Names of the sliders of voltage."""


def asks(now: PageState) -> tuple[Questions, ...]:
    """The chosen actuator's verdict comes behind searches and maps, then its flight; others once what would pay shows
    them beside it."""
    if (one := actuated_blade(now)) is None:
        return ()
    first, *others = one.tasks.values()
    flown = one.flight is not None or isinstance(one.outcome, str)
    flight = () if one.flight_task is None else (one.flight_task,)
    beside = tuple(others) if flown and now.hand.on_stage else ()
    return (
        Questions(3, (first,), _DELAY_S),
        Questions(4, flight, 0.0),
        Questions(7, beside, _IDLE_DELAY_S),
    )


def view(now: PageState) -> dict[str, Any]:
    """Texts of the rail; where there is no such design, why, all else as it was."""
    one, state, inputs = actuated_blade(now), now.state, now.hand.actuator
    form = _form(now, one)
    if one is None or state is None or now.problem:
        return {"actuator.verdict": words.problem_panel(problem(now))} | form
    installed, verdict = one.installed, one.verdict
    return {
        "actuator.verdict": words.problem_panel(one.outcome),
        "actuator.bar": words.voltage_bar(installed.actuator),
        "actuator.now": words.now_panel(inputs, installed, now.inputs.twist_per_rev),
        "actuator.numbers": words.fit_panel(installed, verdict, now.units),
        "actuator.limits": words.limits_panel(verdict),
    } | form


@dataclass(frozen=True)
class FormLook:
    """Which widgets of the actuator there are, and what they are called."""

    seen: Mapping[str, bool]
    labels: Mapping[str, str]
    inert: bool = False
    """Whether nobody may move them: no actuator fits this rotor."""


def form_look(inputs: ActuatorInputs, installed: InstalledActuator) -> FormLook:
    actuator, count = installed.actuator, len(installed.shapes)
    word = actuator.drive_noun.capitalize()
    return FormLook(
        {
            **{name: k < count for k, name in enumerate(DRIVES)},
            **{name: name in actuator.settings for name in ("plies", "span", "chord", "crossed")},
            "stiffness": inputs.blade == "new",
        },
        {
            **{
                name: f"{word} {k + 1} [%]" if count > 1 else f"{word} [%]"
                for k, name in enumerate(DRIVES)
            },
            "crossed": "Fibres at −45°" if actuator.on_skin else "Turns the tip down",
            "plies": f"{actuator.noun[1].capitalize()}{' per side' if actuator.on_skin else ''}",
            "span": "Span {:.2f}–{:.2f}".format(*inputs.span),
            "chord": "Chord {:.2f}–{:.2f}".format(*inputs.chord),
        },
    )


def _form(now: PageState, one: ActuatedBlade | None) -> dict[str, FormLook]:
    """The widgets; for a rotor that carries no actuator as on the blade that does, and inert."""
    design, inputs, installed = (
        now.sliders,
        now.hand.actuator,
        None if one is None else one.installed,
    )
    fits = design is None or design.aircraft.key == KNOWN_BLADE
    if design is not None and not fits:
        with suppress(ValueError):
            installed = inputs.installed(uh60a_rotor(design.preset))
    if installed is None:
        return {}
    return {"actuator.form": replace(form_look(inputs, installed), inert=not fits)}


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
