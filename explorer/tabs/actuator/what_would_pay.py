"""What would pay: the break-even line of this rotor on the stage, where real actuators and a supposed one stand.

The supposed actuator is dragged (`explorer/web/flight.js`) and stays in the address; what it saves is read off the line
until its own trims are known.
"""

import math
import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from explorer.hosting.messages import SupposePress
from explorer.model.units import SI, Units, number
from explorer.sharing.share import Address
from explorer.tabs.background import Call, PoolAnswers
from explorer.tabs.context import TabContext
from explorer.text.readout import fuel_words, needs, needs_words
from rotor.actuator import BreakEven, ConditionPair, Supposed, Verdict, break_even, pay_sentence, suppose
from rotor.chart import Axis, Band, Chart, Line, Points, Series, drawn_chart
from rotor.trim.doubt import sureness

_URGENCY = 4
"""Asked for by hand, so before the verdicts on the other actuators."""
SUPPOSED = "i"
"""Name of the supposed actuator in the address, as `4.2,12`: degrees and kilograms."""
MOST_TWIST, MOST_MASS = 90.0, 1e4
"""Largest twist [°] and mass [kg] of a supposed actuator that a link may hold."""
_PLACE = re.compile(",".join([r"\d{1,5}(?:\.\d{1,4})?"] * 2), re.ASCII)
_STILL = 0.25
"""How long the supposed actuator must stand before it is trimmed [s]."""


class WhatWouldPay:
    """One client's, where the context stands."""

    def __init__(self, context: TabContext, address: Address, problems: list[tuple[str, str]]) -> None:
        """`problems` get a title and a sentence where the address cannot be read."""
        self._context, self._address, self._bridge = context, address, context.bridge
        self._pair: ConditionPair | None = None
        """Conditions of the design on the sliders; None where it carries no actuator."""
        self._lines = PoolAnswers(context.pool, _URGENCY, context.wake)
        self._trims = PoolAnswers(context.pool, _URGENCY, context.wake)
        self._place = address.read(SUPPOSED, place_of, None, "Not the supposed actuator of the link", problems)
        """Range of twist [°] and mass of all blades [kg]; None until it is dragged."""
        self.on_stage = self._place is not None
        """Whether the stage shows the line in place of the balance of power."""
        self.pays = False
        """Whether the supposed actuator pays: its blade lights green."""
        context.bridge.on("suppose", self._suppose)

    def stop(self) -> None:
        """The browser has left."""
        self._lines.stop()
        self._trims.stop()

    def rest(self) -> None:
        """Nothing is trimmed and nothing said until the next `refresh`."""
        self.pays = False
        for answers in (self._lines, self._trims):
            answers.ask((), 0.0)

    def refresh(self, pair: ConditionPair | None, verdicts: Sequence[Verdict] = ()) -> None:
        """Follow the design; `verdicts` on actuators, as far as there are any, the chosen one's first."""
        self._pair = pair
        self._bridge.set(suppose=self._stage(verdicts))

    def _suppose(self, value: str | SupposePress) -> None:
        """The stage shows the line or no longer, or the supposed actuator is dragged there."""
        if self._context.held:
            return
        if isinstance(value, str):
            self.on_stage = value == "on"
        else:
            self._place = round(value.tip, 2), float(f"{value.mass:.3g}")
        place = self._place if self.on_stage else None
        self._address[SUPPOSED] = None if place is None else "{:g},{:g}".format(*place)
        self._context.wake()

    def _stage(self, verdicts: Sequence[Verdict]) -> dict[str, Any] | None:
        """What the page draws; None where it shows the balance of power."""
        self.pays, pair = False, self._pair
        if not self.on_stage or pair is None:
            return None
        task = Call(break_even, (pair,))
        self._lines.ask((task,), _STILL)
        even = self._lines.answer(task)
        if not isinstance(even, BreakEven) or not even.worthwhile:
            words = even or "Trimming the break-even line…"
            return {"words": words if isinstance(words, str) else pay_sentence(words), "kind": ""}
        degrees, mass = self._place or _first_place(even, verdicts)
        twist = math.radians(degrees)
        question = Call(suppose, (pair, even.rates_at(twist), mass))
        self._trims.ask((question,), _STILL)
        found, units = self._trims.answer(question), self._context.units
        trimmed = found if isinstance(found, Supposed) else None
        saving = even.net(twist, mass) if trimmed is None else trimmed.saving
        # Neither colour where the sign cannot be told.
        told = trimmed is None or trimmed.band is None or sureness(saving, trimmed.band) != "cannot be told"
        kind = "" if not told else "gain" if saving > 0.0 else "loss"
        self.pays = kind == "gain"
        size = f"{number(degrees, 1)}° for {number(mass, 0 if mass >= 10.0 else 1)} kg"
        words = f"{size} {needs_words(saving, None if trimmed is None else trimmed.band, units)}"
        more = " …" if trimmed is None else f", {fuel_words(trimmed.fuel_saving)}"
        most = even.mass_allowed(twist)
        note = (
            f"With this twist it pays up to {number(most, 0 if most >= 10.0 else 1)} kg, less what its drive takes. "
            f"{pay_sentence(even)}"
        )
        if isinstance(found, str):
            note = found
        return {
            "chart": drawn_chart(mass_chart(even, verdicts, units)),
            "at": [degrees, mass],
            "words": words + more,
            "note": note,
            "kind": kind,
        }


def place_of(text: str) -> tuple[float, float]:
    """Twist [°] and mass [kg] of a link; ValueError with one sentence for anything else."""
    parts = list(map(float, text.split(","))) if _PLACE.fullmatch(text) else []
    if not parts or parts[0] > MOST_TWIST or not 0.0 < parts[1] <= MOST_MASS:
        raise ValueError(f"The supposed actuator {text[:40]!r} is not a twist in degrees and a mass in kg: write 4,12.")
    return parts[0], parts[1]


def _first_place(even: BreakEven, verdicts: Sequence[Verdict]) -> tuple[float, float]:
    """Where the supposed actuator stands at first: at the chosen one, to be dragged from there to where it pays."""
    if verdicts and verdicts[0].installed.masses.aircraft:
        return math.degrees(verdicts[0].installed.attainable), verdicts[0].installed.masses.aircraft
    return math.degrees(0.5 * float(even.twists[-1])), 2.0 * float(even.masses[-1])


_LINE, _PAYS = "#1c7ed6", "#0ca678"


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
