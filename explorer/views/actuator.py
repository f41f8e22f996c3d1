"""The rail of Actuate: what stands between its widgets, what they are called, and how the blade in the hand moves them.

Above the widgets stands why there is no verdict; below them twist now, reach, limits, modes and all actuators.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from explorer.model.actuator_inputs import MOST_SEGMENTS, ActuatorInputs, Outcome, Question
from explorer.model.units import Units, number
from explorer.text.readout import balance, mass_parts
from explorer.views import actuator_words as words
from explorer.views.actuated import built, in_actuate, problem
from explorer.views.flight import BY_HAND
from explorer.views.now import Asked, Effect, Now, Panel, SetHand
from rotor.actuator.catalogue import Actuator, ExtensionTwist, PiezoPly, TorqueTube, actuators, find_actuator
from rotor.actuator.installation import InstalledActuator
from rotor.actuator.verdict import Verdict
from rotor.dynamics.structure import KNOWN_BLADE
from rotor.files.make_design import uh60a_rotor
from rotor.markup import Content, Markup, tag

_STILL = 0.4
"""How long a question must stand before it is worked on [s], so that a dragged slider starts nothing."""
_IDLE = 2.5
"""How long the page must have been still before work is begun that nobody asked for [s]."""
_FULL = 100.0
"""The whole voltage on its slider [%]."""
DRIVES = tuple(f"drive {k}" for k in range(MOST_SEGMENTS))
"""Names of the sliders of voltage."""


def asks(now: Now) -> tuple[Asked, ...]:
    """The chosen actuator's verdict comes behind searches and maps; what is folded at first, behind its flight."""
    if (one := built(now)) is None:
        return ()
    first, *others = one.tasks.values()
    if one.outcome is None or (one.flight_task is not None and one.flight is None):
        others = []
    modes = (one.modes_task,) if others and one.modes_task is not None else ()
    return Asked(3, (first,), _STILL), Asked(7, tuple(others), _IDLE), Asked(8, modes, _IDLE)


def view(now: Now) -> dict[str, Any]:
    """Texts of the rail; where there is no such design, why, all else as it was."""
    one, state, inputs = built(now), now.state, now.hand.actuator
    if one is None or state is None or now.problem:
        return {"actuator.verdict": words.problem_panel(problem(now))} | _form_elsewhere(now)
    installed, verdict = one.installed, one.verdict
    return {
        "actuator.form": form_look(inputs, installed),
        "actuator.verdict": words.problem_panel(one.outcome),
        "actuator.bar": words.voltage_bar(installed.actuator),
        "actuator.now": words.now_panel(inputs, installed),
        "actuator.numbers": words.fit_panel(installed, verdict),
        "actuator.section": words.section_svg(installed, inputs.drive_shares(installed)),
        "actuator.limits": words.limits_panel(verdict),
        "actuator.modes": words.modes_panel(one.modes),
        "actuator.table": table_panel(one.outcomes, one.question, now.units),
    }


@dataclass(frozen=True)
class FormLook:
    """Which widgets of the actuator there are, and what they are called."""

    seen: Mapping[str, bool]
    labels: Mapping[str, str]


def form_look(inputs: ActuatorInputs, installed: InstalledActuator) -> FormLook:
    actuator, count = installed.actuator, len(installed.shapes)
    ply, passive = isinstance(actuator, PiezoPly), isinstance(actuator, ExtensionTwist)
    word = "Voltage" if ply else "Drive"
    return FormLook(
        {
            **{name: k < count for k, name in enumerate(DRIVES)},
            "plies": not passive,
            "span": not passive,
            "chord": ply,
            "crossed": ply,
            "stiffness": inputs.blade == "new",
        },
        {
            **{name: f"{word} {k + 1} [%]" if count > 1 else f"{word} [%]" for k, name in enumerate(DRIVES)},
            "plies": "Tubes" if isinstance(actuator, TorqueTube) else "Plies per side",
            "span": "Span {:.2f}–{:.2f}".format(*inputs.span),
            "chord": "Chord {:.2f}–{:.2f}".format(*inputs.chord),
            "advance_ratios": "µ {:.2f} – {:.2f}".format(*inputs.advance_ratios),
        },
    )


def _form_elsewhere(now: Now) -> dict[str, FormLook]:
    """The widgets as on the blade that carries actuators, where another rotor is on the sliders."""
    design, inputs = now.sliders, now.hand.actuator
    if design is None or design.aircraft.key == KNOWN_BLADE:
        return {}
    try:
        return {"actuator.form": form_look(inputs, inputs.installed(uh60a_rotor(design.preset)))}
    except ValueError:
        return {}


def pull(now: Now, share: float | None) -> tuple[Effect, ...]:
    """The lifted blade was taken (None), or its trailing edge is pulled up by this share of the full drive."""
    one, inputs = built(now), now.hand.actuator
    if one is None:
        return ()
    if share is None:
        nose_up = replace(inputs, drives=(_FULL,) * MOST_SEGMENTS).tip(one.installed)
        return (SetHand({"pulled": (inputs.drives, -math.copysign(_FULL, nose_up))}),)
    start, whole = now.hand.pulled
    drives = tuple(min(max(drive + share * whole, -_FULL), _FULL) for drive in start)
    return (SetHand(BY_HAND, {"drives": drives}),)


def table_panel(outcomes: Mapping[str, Outcome | None], question: Question, units: Units) -> Markup:
    """All actuators on this blade for this question, one row each; those in `outcomes` have an answer."""
    rows = [_row(id, outcomes.get(id), id == question.actuator, units) for id in actuators()]
    needs = "needs", tag("br"), units.power[0].symbol
    titles = "Actuator", ("range", tag("br"), "°"), ("kg in", tag("br"), "all"), needs, "verdict"
    head = tag("tr", [tag("th", title) for title in titles])
    first, second = question.pair.advance_ratios
    note = (
        f"µ {first:g} ↔ {second:g}, {question.host.label}, half the time each. Range: twist from end to end. "
        "▲: some data not verified."
    )
    table = tag("table.rxa-table", head, rows)
    return tag("div.rx", table, tag("div.rx-dim.rx-small", note), data_explorer="actuator-table")


def _row(id: str, outcome: Outcome | None, chosen: bool, units: Units) -> Markup:
    actuator = find_actuator(id)
    care = " ", tag("span.rxa-bad", "▲", title="some data not verified")
    cells: Content = tag("td.rx-num.rx-dim", "computing…", colspan=4)
    if isinstance(outcome, str):
        cells = tag("td.rx-num.rxa-bad", "cannot be built", colspan=4, title=outcome)
    elif outcome is not None:
        words, kind = _short_verdict(outcome)
        numbers = (
            number(math.degrees(outcome.attainable), 1),
            mass_parts(outcome.installed)["in all"].removesuffix(" kg"),
            balance(outcome, units)[-1][-1],
        )
        verdict = tag("td.rx-num", words, class_=kind)
        cells = [*(tag("td.rx-num", text) for text in numbers), verdict]
    name = tag("td", id.replace("_", " "), care if actuator.provenance.recalled else None, title=actuator.name)
    return tag("tr", name, cells, class_="rxa-chosen" if chosen else None)


def _short_verdict(verdict: Verdict) -> tuple[str, str]:
    """A few words, and the class that colours them."""
    if verdict.pays:
        return "pays", "rx-less"
    if not verdict.feasible:
        return "too weak", "rxa-bad"
    return "costs more" if verdict.net_saving <= 0.0 else "cannot be built", "rxa-bad"


def actuator_titles() -> dict[str, str]:
    """Titles of the menu of actuators, by id."""
    return {id: f"{id.replace('_', ' ')}: {_kind(actuator)}" for id, actuator in actuators().items()}


def _kind(actuator: Actuator) -> str:
    if isinstance(actuator, PiezoPly):
        return "d33 fibres" if actuator.electrodes == "interdigitated" else "d31 sheet"
    return "heated tube" if isinstance(actuator, TorqueTube) else "passive"


ACTUATOR = Panel(view, in_actuate, asks, presses={"pull": pull})
