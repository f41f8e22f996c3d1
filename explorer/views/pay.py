"""What would pay: the break-even line of this rotor on the stage, where real actuators and a supposed one stand.

The supposed actuator is dragged (`explorer/web/flight.js`) and stays in the address; what it saves is read off the line
until its own trims are known.
"""

import math
import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from explorer.model.units import SI, Units, number
from explorer.parts.actuate import SupposePart
from explorer.parts.presses import SupposePress
from explorer.text.readout import fuel_words, needs, needs_words
from explorer.views.actuated import built, in_actuate
from explorer.views.now import Asked, Effect, Now, Panel, SetAddress, SetHand
from explorer.workers.call import Call
from rotor.actuator import BreakEven, Supposed, Verdict, break_even, pay_sentence, suppose
from rotor.chart import Axis, Band, Chart, Line, Points, Series, drawn_chart
from rotor.trim.doubt import sureness

_URGENCY = 4
"""Asked for by hand, so before the verdicts on the other actuators."""
SUPPOSED = "i"
"""Name of the supposed actuator in the address, as `4.2,12`: degrees and kilograms."""
MOST_TWIST, MOST_MASS = 90.0, 1e4
"""Largest twist [°] and mass [kg] of a supposed actuator that a link may hold."""
_PLACE = re.compile(",".join([r"\d{1,5}(?:\.\d{1,4})?"] * 2), re.ASCII)
_LINE, _PAYS = "#1c7ed6", "#0ca678"
_STILL = 0.25
"""How long the supposed actuator must stand before it is trimmed [s]."""


def _line_asked(now: Now) -> Call | None:
    """None where the stage shows the balance of power, or the design carries no actuator."""
    one = built(now) if now.hand.on_stage else None
    return None if one is None else Call(break_even, (one.question.pair,))


def _trim_asked(now: Now) -> Call | None:
    """Of the supposed actuator, once the line is known."""
    even, one = now.answers.get(now.of(_line_asked)), built(now)
    if one is None or not isinstance(even, BreakEven) or not even.worthwhile:
        return None
    degrees, mass = _place(now, even)
    return Call(suppose, (one.question.pair, even.rates_at(math.radians(degrees)), mass))


def _place(now: Now, even: BreakEven) -> tuple[float, float]:
    """Where the supposed actuator stands; at first at the chosen one, to be dragged from there to where it pays."""
    chosen, *_ = (*_verdicts(now), None)
    if now.hand.place is not None:
        return now.hand.place
    if chosen is not None and chosen.installed.masses.aircraft:
        return math.degrees(chosen.installed.attainable), chosen.installed.masses.aircraft
    return math.degrees(0.5 * float(even.twists[-1])), 2.0 * float(even.masses[-1])


def _verdicts(now: Now) -> list[Verdict]:
    """As far as there are any, the chosen actuator's first."""
    outcomes = {} if (one := built(now)) is None else one.outcomes
    return [outcome for outcome in outcomes.values() if isinstance(outcome, Verdict)]


def asks(now: Now) -> tuple[Asked, ...]:
    calls = tuple(call for call in (now.of(_line_asked), now.of(_trim_asked)) if call is not None)
    return (Asked(_URGENCY, calls, _STILL),)


def view(now: Now) -> dict[str, Any]:
    """The stage, and whether the supposed actuator pays: its blade lights green."""
    shown = None if now.problem else _stage(now)
    return {} if now.problem else {"suppose": shown, "actuator.pays": shown is not None and shown.kind == "gain"}


def _stage(now: Now) -> SupposePart | None:
    """What the page draws; None where it shows the balance of power."""
    if now.of(_line_asked) is None:
        return None
    even = now.answers.get(now.of(_line_asked))  # Or the sentence that says why there is none.
    if not isinstance(even, BreakEven) or not even.worthwhile:
        words = even or "Trimming the break-even line…"
        return SupposePart(words if isinstance(words, str) else pay_sentence(words))
    degrees, mass = _place(now, even)
    twist, units = math.radians(degrees), now.units
    found = now.answers.get(now.of(_trim_asked))
    trimmed = found if isinstance(found, Supposed) else None
    saving = even.net(twist, mass) if trimmed is None else trimmed.saving
    # Neither colour where the sign cannot be told.
    told = trimmed is None or trimmed.band is None or sureness(saving, trimmed.band) != "cannot be told"
    size = f"{number(degrees, 1)}° for {number(mass, 0 if mass >= 10.0 else 1)} kg"
    words = f"{size} {needs_words(saving, None if trimmed is None else trimmed.band, units)}"
    more = " …" if trimmed is None else f", {fuel_words(trimmed.fuel_saving)}"
    most = even.mass_allowed(twist)
    note = (
        f"With this twist it pays up to {number(most, 0 if most >= 10.0 else 1)} kg, less what its drive takes. "
        f"{pay_sentence(even)}"
    )
    return SupposePart(
        words=words + more,
        kind="" if not told else "gain" if saving > 0.0 else "loss",
        note=found if isinstance(found, str) else note,
        chart=drawn_chart(mass_chart(even, _verdicts(now), units)),
        at=(degrees, mass),
    )


def place_it(now: Now, value: str | SupposePress) -> tuple[Effect, ...]:
    """The stage shows the line or no longer, or the supposed actuator is dragged there."""
    on_stage, place = now.hand.on_stage, now.hand.place
    if isinstance(value, str):
        on_stage = value == "on"
    else:
        place = round(value.tip, 2), float(f"{value.mass:.3g}")
    kept = "{:g},{:g}".format(*place) if on_stage and place is not None else None
    return SetHand({"on_stage": on_stage, "place": place}), SetAddress(SUPPOSED, kept)


PAY = Panel(view, in_actuate, asks, presses={"suppose": place_it})


def place_of(text: str) -> tuple[float, float]:
    """Twist [°] and mass [kg] of a link; ValueError with one sentence for anything else."""
    parts = list(map(float, text.split(","))) if _PLACE.fullmatch(text) else []
    if not parts or parts[0] > MOST_TWIST or not 0.0 < parts[1] <= MOST_MASS:
        raise ValueError(f"The supposed actuator {text[:40]!r} is not a twist in degrees and a mass in kg: write 4,12.")
    return parts[0], parts[1]


def mass_chart(even: BreakEven, verdicts: Sequence[Verdict] = (), units: Units = SI) -> Chart:
    """Break-even mass over twist, with actuators as points at their own reach and mass; mass is logarithmic.

    The line knows no blade structure: what fitting a real one costs beyond its mass is said in its words.
    """
    largest = float(even.masses[-1])
    real = sorted(verdicts, key=lambda verdict: -verdict.installed.masses.aircraft)
    places = [(math.degrees(one.installed.attainable), one.installed.masses.aircraft) for one in real]
    x_most = 1.08 * max(math.degrees(float(even.twists[-1])), *(degrees for degrees, _ in places), 0.0)
    y_range = 10.0 ** math.floor(math.log10(0.05 * largest)), 3.0 * max(largest, *(mass for _, mass in places), 0.0)
    fine = np.linspace(0.0, float(even.twists[-1]), 60)[1:].tolist()
    x, allowed = [*map(math.degrees, fine), x_most], [*(even.mass_allowed(twist) for twist in fine), largest]
    half = [even.mass_allowed(twist, 0.5 * even.ideal_saving) for twist in fine]
    series: list[Series] = [
        Band("pays", x, (y_range[0],) * len(x), allowed, _PAYS),
        Line("no drive power", x, allowed, _LINE),
        Line("driven", x[:-1], [mass_kg if mass_kg >= y_range[0] else math.nan for mass_kg in half], _LINE, "4 3"),
    ]
    for verdict, (degrees, mass) in zip(real, places, strict=True):
        name = verdict.installed.actuator.id.replace("_", " ")
        words = f"{name}: {degrees:.1f}° for {mass:.0f} kg on this blade {needs(verdict, units)}"
        colour = _PAYS if verdict.pays else "var(--rx-bad)"
        place = (degrees,), (max(mass, y_range[0]),)
        series.append(Points("", *place, colour, size=4.5, words=(words,), names=(name,)))
    return Chart(
        "Mass that pays",
        Axis("range of linear twist [°]", (0.0, x_most)),
        Axis("kg, all blades", y_range, log=True),
        tuple(series),
        note="Driven: half of what unlimited twist saves goes to the drive. Points: real actuators at the reach of "
        "their tip; what fitting them to this blade costs besides is in their words.",
    )
