"""The flight bar of Actuate: tip twist from hover to fast flight, and the one balance of power, as the page draws them.

`explorer/web/flight.js` draws both; the bar sets the flight condition by the inputs of the sliders, and the voltages.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from explorer.model.actuator_inputs import flight_legs
from explorer.model.inputs import Inputs
from explorer.model.units import Units, number
from explorer.tabs.actuator.actuator_controls import ActuatorControls
from explorer.tabs.context import TabContext
from explorer.tabs.layout import by_hand
from explorer.text.glossary import hint
from explorer.text.readout import fuel_used, fuel_words, mass_words, needs, pair_words, signed
from rotor import Design
from rotor.actuator import ActuatorFlight, FlightLeg, InstalledActuator, Verdict
from rotor.actuator.verdict import reference
from rotor.arrays import Array
from rotor.chart import Axis, Band, Chart, Line, Points, Series, drawn_chart

HALVES = 2
"""Points of the curve for each leg of the flight; every `HALVES`-th is a leg with a name."""
_LEAST = 1.5
"""Least height of the chart either way [°]: with little twist the curves do not fill it."""
_SHORT = 0.15
"""What is wanted beyond reach [°] and not worth a word."""
_COMPUTING = "Computing what the actuator saves and what it costs…"
_GAIN, _LOSS = "var(--rxa-fill-gain)", "var(--rxa-fill-loss)"


def condition_at(legs: Sequence[FlightLeg], x: float) -> tuple[float, float]:
    """µ and rate of climb [m/s] at a place of the bar, which counts named legs from 0; between legs straight."""
    at = np.arange(len(legs)) / HALVES
    mu = float(np.interp(x, at, [leg.advance_ratio for leg in legs]))
    climb = float(np.interp(x, at, [leg.climb_speed for leg in legs]))
    return round(mu, 3), round(climb, 2)


def place_of(legs: Sequence[FlightLeg], advance_ratio: float) -> float:
    """Where on the bar an advance ratio is: it grows from leg to leg."""
    return float(np.interp(advance_ratio, [leg.advance_ratio for leg in legs], np.arange(len(legs)) / HALVES))


def flight_state(
    legs: Sequence[FlightLeg],
    flight: ActuatorFlight | None,
    known: bool,
    advance_ratio: float,
    tip_speed: float,
    units: Units,
    problem: str = "",
    *,
    tip: float = 0.0,
    flown: bool = False,
    stopped: bool = False,
) -> dict[str, Any]:
    """What the page draws the tip twist from: a chart of degrees over the legs.

    `known`: the flight is that of the present question, else one before. `tip`: twist by the actuator now [°];
    `flown`: its voltages follow the flight; `stopped`: they stay as they are, wherever it flies.
    """
    frozen = tip if stopped else None
    state: dict[str, Any] = {
        "legs": [[leg.name, _condition(leg, tip_speed, units)] for leg in legs[::HALVES]],
        "at": round(place_of(legs, advance_ratio), 3),
        "kind": "ready" if known and flight else "problem" if problem else "computing",
        "words": problem or ("computing…" if not known else ""),
        "flown": flown and not stopped,
        "frozen": frozen,
        "tip": f"{number(tip, 2, sign=True)}°",
        "chart": drawn_chart(flight_chart(flight, (len(legs) - 1) / HALVES, frozen)),
    }
    return state


def flight_chart(flight: ActuatorFlight | None, last: float, frozen: float | None = None) -> Chart:
    """Tip twist over the legs, counted from 0 to `last`: wanted, reached, within reach; green where flown at a gain.

    `frozen`: twist of an actuator that has stopped [°], the same wherever it flies.
    """
    series: list[Series] = []
    low, high = -_LEAST, _LEAST
    if flight is not None:
        wanted, reached, reach = (np.degrees(angles) for angles in (flight.wanted, flight.reached, flight.reach))
        curves = np.concatenate((wanted, reached, reach))
        low, high = min(low, float(curves.min())), max(high, float(curves.max()))
        at, held = np.arange(len(wanted)) / HALVES, np.clip(wanted, *reach)
        for a, b, gains in _stretches(at, flight.net_saving):
            series.append(Band("", (a, b), (reach[0],) * 2, (reach[1],) * 2, _GAIN if gains else "var(--rx-dim)"))
        above = bool(wanted[-1] > reached[-1])
        series += [
            Band("", at, held, wanted, _LOSS),
            Line("reached", at, reached, "var(--rx-accent)", width=4.0),
            Line("wanted", at, wanted, "var(--rx-ink)"),
            _named("wanted", last, wanted[-1], "var(--rx-ink)", above),
            _named("reached", last, reached[-1], "var(--rx-accent)", not above),
            _named("within reach", 0.0, reach[1], "var(--rx-dim)", above=False),
        ]
        worst = int(np.argmax(np.abs(wanted - held)))
        if (short := abs(float(wanted[worst] - held[worst]))) > _SHORT:
            words = f"short by {number(short, 1)}°"
            series.append(_named(words, at[worst], 0.5 * (wanted[worst] + held[worst]), "var(--rxa-loss)", above=False))
    if frozen is not None:
        low, high = min(low, frozen), max(high, frozen)
        series.append(Line("stopped", (0.0, last), (frozen, frozen), "var(--rxa-loss)", "6 4", width=2.4))
        series.append(_named("stopped", 0.5 * last, frozen, "var(--rxa-loss)", above=True))
    margin = 0.06 * (high - low)
    return Chart("Tip twist", Axis("", (0.0, last)), Axis("", (low - margin, high + margin), unit="°"), tuple(series))


def _stretches(at: Array, net: Array) -> list[tuple[float, float, bool]]:
    """Where the flight gains and where it does not, from place to place."""
    changes = [k for k in range(len(at) - 1) if (net[k] > 0.0) != (net[k + 1] > 0.0)]
    ends = [at[0], *(at[k] + (at[k + 1] - at[k]) * net[k] / (net[k] - net[k + 1]) for k in changes), at[-1]]
    return [(a, b, bool(np.interp(0.5 * (a + b), at, net) > 0.0)) for a, b in pairwise(ends)]


def _named(name: str, x: float, y: float, colour: str, above: bool) -> Points:
    """A name alone, at a place of the chart."""
    return Points("", (x,), (y,), colour, size=0.0, names=(name,), beside="above" if above else "below")


def _condition(leg: FlightLeg, tip_speed: float, units: Units) -> str:
    if leg.advance_ratio == 0.0 and leg.climb_speed == 0.0:
        return "0 kt" if units.speed[0].symbol == "kt" else "µ 0"
    speed = units.speed[0].text(leg.advance_ratio * tip_speed)
    return f"{speed}, {units.climb.text(leg.climb_speed, 1, sign=True)}" if leg.climb_speed else speed


def earns_state(verdict: Verdict | None, known: bool, units: Units, problem: str = "") -> dict[str, Any]:
    """What the page draws the balance from, as power that the actuator needs.

    `known`: the verdict is that of the present question, else one before.
    """
    unit = units.power[0]
    state: dict[str, Any] = {
        "kind": "ready" if known and verdict else "problem" if problem else "computing",
        "unit": unit.symbol,
        "where": "",
        "bars": [],
        "against": "best fixed blade",
        "fuel": "",
        "fuel_kind": "",
        "fuel_note": "",
        "mass": "",
        "mass_note": "",
        "problem": problem,
        "mission": "" if problem else _COMPUTING,
    }
    if verdict is None:
        return state
    used, masses = fuel_used(verdict), verdict.installed.masses
    parts = [("its twist" if name == "gross" else name, -power) for name, power in verdict.savings]
    where = pair_words(verdict)
    return state | {
        "where": where,
        "bars": [*(_bar(*part, units) for part in parts), _bar("in all", -verdict.net_saving, units, total=True)],
        "against": reference(verdict).removeprefix("the "),
        "fuel": fuel_words(verdict.fuel_saving),
        "fuel_kind": "" if used is None or abs(used) < 0.05 else "loss" if used > 0.0 else "gain",
        "fuel_note": " ".join(text for text in verdict.caveats if "uel" in text),
        "mass": f"{number(masses.aircraft)} kg on board",
        "mass_note": mass_words(masses),
        "mission": f"{where[:1].upper()}{where[1:]}: {needs(verdict, units)}.",
    }


def _bar(name: str, power: float, units: Units, total: bool = False) -> dict[str, Any]:
    text = signed(power, units)
    kind = {"+": "loss", "−": "gain"}.get(text[0], "")
    return {"name": name, "value": round(units.power[0].of(power), 3), "text": text, "kind": kind, "total": total}


class FlightBar:
    """One client's."""

    def __init__(self, context: TabContext, controls: ActuatorControls) -> None:
        self._context, self._controls = context, controls
        self._flight: ActuatorFlight | None = None
        """The last one known."""
        self._verdict: Verdict | None = None
        self._legs: tuple[FlightLeg, ...] = ()
        self._installed: InstalledActuator | None = None
        self._flown: float | None = None
        """Where on the bar the voltages follow the flight; None where a hand set them."""
        self._stopped = context.gui.add_checkbox("Actuator stops here", False, hint=hint("stops_here"))
        """While it is set, voltages stay as they are and the flight goes on."""
        by_hand(self._stopped, lambda _: self._follow())
        context.bridge.on("fly", self._fly)

    def show(
        self,
        inputs: Inputs,
        design: Design,
        installed: InstalledActuator,
        verdict: Verdict | str | None,
        flight: ActuatorFlight | str | None,
        tip: float,
    ) -> None:
        """Follow the session. Verdict and flight: the sentence that says why there is none, or None on their way.

        `tip`: twist by the actuator now [°].
        """
        self._legs, self._installed = flight_legs(design), installed
        known = isinstance(flight, ActuatorFlight)
        if isinstance(flight, ActuatorFlight) and flight is not self._flight:
            self._flight = flight
            if self._flown is not None:
                self._drive(self._flown)
        if isinstance(verdict, Verdict):
            self._verdict = verdict
        units, speed = self._context.units, design.rotor.tip_speed
        problem = flight if isinstance(flight, str) else verdict if isinstance(verdict, str) else ""
        wrong = verdict if isinstance(verdict, str) else ""
        self._context.bridge.set(
            flight=flight_state(
                self._legs,
                None if problem else self._flight,
                known,
                inputs.advance_ratio,
                speed,
                units,
                problem,
                tip=tip,
                flown=self._flown is not None,
                stopped=self._stopped.value,
            ),
            earns=earns_state(None if wrong else self._verdict, isinstance(verdict, Verdict), units, wrong),
        )

    def hide(self) -> None:
        """The blade is back in the rotor: what the flight drove is at rest again."""
        self._context.bridge.set(flight=None, earns=None)
        self._stopped.value = False
        if self._flown is not None:
            self.leave_to_hand()
            self._controls.undrive()

    def leave_to_hand(self) -> None:
        """A hand moved a voltage: it stays until the bar moves again."""
        self._flown = None

    def _fly(self, x: Any) -> None:
        if self._context.held or not self._legs:
            return
        self._flown = min(max(float(x), 0.0), (len(self._legs) - 1) / HALVES)
        mu, climb = condition_at(self._legs, self._flown)
        self._drive(self._flown)
        self._context.drag_to(replace(self._context.inputs(), advance_ratio=mu, climb_m_s=climb))

    def _follow(self) -> None:
        """Stop, or work again where the flight is now."""
        if self._flown is not None:
            self._drive(self._flown)
        self._context.wake()

    def _drive(self, x: float) -> None:
        """Voltages as the flight has them there, unless the actuator has stopped."""
        flight, installed = self._flight, self._installed
        if not self._stopped.value and flight is not None and installed is not None and flight.swings:
            self._controls.drive_through(installed, flight.swings, flight.voltages, HALVES * x)
