"""Words, numbers and the drawn section of the Actuate mode; degrees, volts and kW begin here."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from explorer.colours import css
from explorer.model.actuator_inputs import ActuatorInputs, Outcome
from explorer.model.units import SI, Units, number
from explorer.picture.lifted_picture import drive_colour
from explorer.text.readout import limit_words
from rotor.actuator.kind import Actuator, InstalledActuator, Limit
from rotor.actuator.verdict import Verdict
from rotor.design import Harmonic
from rotor.support.markup import Markup, tag
from rotor.support.units import typographic

TIP = "Twist that the actuator adds at the tip in flight, positive nose up; airloads reduce it by 1 to 10 %."
_SHIFT = {0.0: ";transform:none", 100.0: ";transform:translateX(-100%)"}
"""The outer numbers stay within the bar."""


def voltage_bar(actuator: Actuator) -> Markup:
    """The colours that it is drawn in: each side of its drive to its own end."""
    low, high = actuator.drive_range
    stops = ",".join(css(drive_colour(actuator, k / 8.0)) for k in range(-8 if low else 0, 9))
    marks = ((0.0, low), (50.0, 0.5 * high), (100.0, high))
    marks = (
        ((0.0, low), (25.0, 0.5 * low), (50.0, 0.0), (75.0, 0.5 * high), (100.0, high))
        if low
        else marks
    )
    ticks: list[Markup] = []
    for at, value in marks:
        words = f"{number(value)} {actuator.drive_unit}" if at == 100.0 else number(value)
        shift = f"left:{at:g}%{_SHIFT.get(at, '')};white-space:nowrap"
        ticks += [tag("i", style=f"left:{at:g}%"), tag("span", words, style=shift)]
    colours = tag("div.rx-gradient", style=f"background:linear-gradient(90deg,{stops})")
    return tag("div.rx.rx-scale", colours, tag("div.rx-ticks", ticks), data_explorer="voltage-bar")


def wave_words(waves: Sequence[Harmonic]) -> str:
    """Active twist as `3/rev 0.75°`; empty where there is none."""
    return ", ".join(
        f"{wave.per_rev}/rev {number(math.degrees(wave.amplitude), 2)}°" for wave in waves
    )


def now_panel(
    inputs: ActuatorInputs, installed: InstalledActuator, waves: Sequence[Harmonic] = ()
) -> Markup:
    """What the sliders make of the blade at this moment."""
    tip = math.degrees(inputs.tip(installed))
    drives = " · ".join(inputs.drive_text(installed, k) for k in range(len(installed.shapes)))
    words = f"tip twist at {drives}" if inputs.driven or waves else "tip twist, at rest"
    words += f", with {wave_words(waves)}" if waves else ""
    twist = tag("b", f"{number(tip, 2, sign=True)}°", data_explorer="actuator-twist")
    return tag(
        "div.rx",
        tag("div.rxa-now", twist, tag("span.rx-dim", words), title=TIP, data_answers=True),
        data_explorer="actuator-now",
    )


def fit_panel(installed: InstalledActuator, verdict: Verdict | None, units: Units = SI) -> Markup:
    """What the actuator is on this blade: known at once, but for what the verdict needs."""
    rest = math.degrees(float(np.abs(installed.rest_shapes[:, -1]).sum()))
    facts = [
        f"range of tip twist {number(math.degrees(installed.attainable), 2)}° in flight, {number(rest, 2)}° at rest",
        f"first torsion at {number(installed.frequency, 2)}/rev",
        *([f"moment {number(installed.moment)} N·m"] if installed.moment else ()),
        *(
            []
            if verdict is None
            else [f"twist required {number(math.degrees(verdict.required), 2)}°"]
        ),
        *([] if verdict is None else [f"slewing power {units.watts(verdict.drive.slew_power, 2)}"]),
    ]
    words = f"{'; '.join(facts)}."
    return tag("div.rx.rx-dim.rx-small", words, data_explorer="actuator-numbers", data_answers=True)


def problem_panel(outcome: Outcome | None) -> Markup:
    """Why there is no verdict; nothing where there is one or it is on its way."""
    if not isinstance(outcome, str):
        return Markup()
    return tag("div.rxa-box.rxa-wrong", outcome, data_explorer="no-verdict")


def immovable_panel(kinds: Mapping[str, str], chosen: str) -> Markup:
    """The kinds that cannot move this blade, folded: why not, and a press that takes one all the same.

    `kinds`: the reasons by kind; the `chosen` one stands in the menu.
    """
    others = {id: reason for id, reason in kinds.items() if id != chosen}
    if not others:
        return Markup()
    many = len(others) > 1
    summary = f"{len(others)} kind{'s' if many else ''} cannot move this blade"
    rows = [
        tag(
            "li",
            tag(
                "button.rx-link", id.replace("_", " "), data_do="kind", data_value=id, type="button"
            ),
            f": {reason}",
        )
        for id, reason in others.items()
    ]
    return tag(
        "details.rx.rxa-weak", tag("summary", summary), tag("ul", rows), data_explorer="weak-kinds"
    )


def limits_panel(verdict: Verdict | None) -> Markup:
    """Every limit: those broken with their sentence, its own first, the others by name; and the data to be wary of."""
    if verdict is None:
        return Markup()
    kept = ", ".join(limit_words(limit.name) for limit in verdict.limits if limit.ok)
    good = (
        tag("div", tag("span.rx-good", "✓"), tag("span.rx-dim", f"met: {kept}")) if kept else None
    )
    reach = verdict.installed.actuator.range_limits
    own, asked = (
        [limit for limit in verdict.broken if (limit.name in reach) == short]
        for short in (False, True)
    )
    more = tag(
        "div.rx-care", tag("span", "▲"), tag("span", "The best twist needs more than it has:")
    )
    cares = [
        tag("div.rx-care", tag("span", "▲"), tag("span", caveat)) for caveat in verdict.caveats
    ]
    beyond = (more, *map(_limit, asked)) if asked else ()
    rows = map(_limit, own), beyond, good, cares
    return tag("div.rx.rxa-limits", *rows, data_explorer="limits", data_answers=True)


def _limit(limit: Limit) -> Markup:
    sentence = tag("span", tag("b", limit_words(limit.name)), f" {typographic(limit.sentence)}")
    return tag("div", tag("span.rxa-bad", "✕"), sentence)
