"""The flight bar of Actuate: tip twist from hover to fast flight, and the one balance of power, as the page draws them.

`explorer/web/flight.js` draws both; the bar sets the flight condition by the inputs of the sliders, and the voltages.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from explorer.model.actuator_inputs import ActuatorState, HandSettings, schedule_at
from explorer.model.units import Units, number
from explorer.parts.actuate import EarnsPart, FlightPart, Kind, PowerBar, Sign
from explorer.text.readout import balance, change_kind, fuel_words
from explorer.views.actuated import (
    ActuatedBlade,
    actuated_blade,
    blade_out,
    compared_trims,
    parts_call,
    saving_parts,
)
from explorer.views.page_state import (
    Effect,
    MoveSliders,
    PageState,
    Panel,
    PanelMemory,
    Questions,
    SetHand,
)
from rotor.actuator import ActuatorFlight, Verdict
from rotor.actuator.stopped import numbers_of
from rotor.optimisation import FlightLeg
from rotor.support.chart import Axis, Band, Chart, Line, Series, drawn_chart
from rotor.trim.doubt import sureness

BY_HAND: Mapping[str, Any] = {"flown": None, "stopped": False}
"""What of `HandSettings` a voltage set by hand ends: that it follows the flight, and that it follows nothing."""
POINTS_PER_LEG = 2
"""Points of the curve for each leg of the flight; every `POINTS_PER_LEG`-th is a leg with a name."""
_SAME_PLACE = 0.02
"""Places of the bar less apart are one: advance ratios have three decimals."""
_MIN_HEIGHT_DEG = 1.5
"""Least height of the chart either way [°]: with little twist the curves do not fill it."""


def condition_at(legs: Sequence[FlightLeg], x: float) -> tuple[float, float]:
    """µ and rate of climb [m/s] at a place of the bar, which counts named legs from 0; between legs straight."""
    at = np.arange(len(legs)) / POINTS_PER_LEG
    mu = float(np.interp(x, at, [leg.advance_ratio for leg in legs]))
    climb = float(np.interp(x, at, [leg.climb_speed for leg in legs]))
    return round(mu, 3), round(climb, 2)


def position_of(legs: Sequence[FlightLeg], advance_ratio: float) -> float:
    """Where on the bar an advance ratio is: it grows from leg to leg."""
    return float(
        np.interp(
            advance_ratio,
            [leg.advance_ratio for leg in legs],
            np.arange(len(legs)) / POINTS_PER_LEG,
        )
    )


def view(now: PageState) -> dict[str, FlightPart | EarnsPart | None]:
    """Flight and balance; those of the question before stay, marked, while one is worked on."""
    if (one := _on_stage(now)) is None:
        return {}
    wrong = one.outcome if isinstance(one.outcome, str) else ""
    verdict = None if wrong else one.verdict or now.memory.latest.get("verdict")
    earns = (
        _balance(now, wrong)
        if now.hand.here
        else earns_state(verdict, one.verdict is not None, now.units, wrong)
    )
    return {"flight": _flight(now, one, wrong), "earns": earns}


def _on_stage(now: PageState) -> ActuatedBlade | None:
    """None also where the present inputs have no solution: all stays as it was."""
    return actuated_blade(now) if blade_out(now.ui) and not now.problem else None


def remember(now: PageState, shown: Mapping[str, Any]) -> PanelMemory:
    """The last flight and the last verdict."""
    if (one := _on_stage(now)) is None:
        return now.memory
    known = {"verdict": one.verdict} if one.verdict is not None else {}
    known |= {"flight": one.flight} if isinstance(one.flight, ActuatorFlight) else {}
    return replace(now.memory, latest={**now.memory.latest, **known})


def _last(now: PageState) -> ActuatorFlight | None:
    return now.memory.latest.get("flight")


def _flight(now: PageState, one: ActuatedBlade, wrong: str) -> FlightPart:
    """`wrong`: why there is no verdict."""
    hand, legs, rotor = now.hand, one.legs, one.design.rotor
    known = one.flight if isinstance(one.flight, ActuatorFlight) else None
    problem = one.flight if isinstance(one.flight, str) else wrong
    shown = None if problem else known or _last(now)
    tip = math.degrees(one.inputs.tip(one.installed))
    state, words = hand.state, ""
    if now.of(compared_trims) is not None and now.state is not None:
        there = numbers_of(now.state.solution, one.design.twist)
        left = (
            ""
            if there.controls_left is None
            else f", {number(100.0 * there.controls_left)} % control left"
        )
        stalled = f"{number(100.0 * there.stalled_area, 1)} % of the disk separated"
        words = f"{STATES[state]}: {now.units.watts(there.power)}, {stalled}{left}"
    return FlightPart(
        legs=tuple(
            (leg.name, _condition(leg, rotor.tip_speed, now.units))
            for leg in legs[::POINTS_PER_LEG]
        ),
        hours=one.inputs.hours,
        assumed=one.question.mission.assumed,
        at=round(position_of(legs, now.inputs.advance_ratio), 3),
        kind="ready" if known else "problem" if problem else "computing",
        words="; ".join(filter(None, (words, problem))),
        state=state,
        states=tuple(STATES.items()),
        tip=f"{number(tip, 2, sign=True)}°",
        chart=drawn_chart(flight_chart(shown, (len(legs) - 1) / POINTS_PER_LEG, state, tip)),
    )


_SIGNS: Mapping[str, Sign] = {"": "", "less": "gain", "more": "loss"}
STATES: Mapping[ActuatorState, str] = {
    "set": "as set",
    "schedule": "by schedule",
    "stopped": "stopped",
}
"""States of the actuator, as they are called."""


def flight_chart(
    flight: ActuatorFlight | None, last: float, state: ActuatorState, tip: float
) -> Chart:
    """Tip twist over the legs, counted from 0 to `last`: within reach, by schedule, and that of another state [°]."""
    series: list[Series] = []
    low, high = -_MIN_HEIGHT_DEG, _MIN_HEIGHT_DEG
    if flight is not None:
        reached, reach = (np.degrees(angles) for angles in (flight.reached, flight.reach))
        low, high = (
            float(end) for end in (min(low, *reached, *reach), max(high, *reached, *reach))
        )
        at = np.arange(len(reached)) / POINTS_PER_LEG
        series += [
            Band("", at, np.full(len(at), reach[0]), np.full(len(at), reach[1]), "var(--rx-dim)"),
            Line(
                "by schedule",
                at,
                reached,
                "var(--rx-accent)",
                "" if state == "schedule" else "2 5",
                width=3.0,
            ),
        ]
    if state != "schedule":
        low, high = min(low, tip), max(high, tip)
        colour = "var(--rxa-loss)" if state == "stopped" else "var(--rx-accent)"
        series.append(
            Line(
                STATES[state],
                (0.0, last),
                (tip, tip),
                colour,
                "6 4" if state == "stopped" else "",
                width=3.0,
            )
        )
    margin = 0.06 * (high - low)
    return Chart(
        "Tip twist",
        Axis("", (0.0, last)),
        Axis("", (low - margin, high + margin), unit="°"),
        tuple(series),
    )


def _condition(leg: FlightLeg, tip_speed: float, units: Units) -> str:
    if leg.advance_ratio == 0.0 and leg.climb_speed == 0.0:
        return "0 kt" if units.speed[0].symbol == "kt" else "µ 0"
    speed = units.speed[0].text(leg.advance_ratio * tip_speed)
    return (
        f"{speed}, {units.climb.text(leg.climb_speed, 1, sign=True)}" if leg.climb_speed else speed
    )


def earns_state(verdict: Verdict | None, known: bool, units: Units, problem: str = "") -> EarnsPart:
    """What the page draws the balance from, as power that the actuator needs.

    `known`: the verdict is that of the present question, else one before.
    """
    kind: Kind = "ready" if known and verdict else "problem" if problem else "computing"
    state = EarnsPart(kind, units.power[0].symbol)
    if verdict is None:
        return state
    assumed = " (hours assumed)" if verdict.baseline.mission.assumed else ""
    saved, band = verdict.fuel_saving, verdict.fuel_band
    fuel = (
        change_kind(-saved, sureness(saved, band)) if saved is not None and band is not None else ""
    )
    return replace(
        state,
        where=f"by schedule, mean of legs{assumed}",
        bars=_bars(
            verdict.savings,
            units,
            verdict.net_band,
            verdict.bands,
            verdict.buildable,
            verdict.sourced,
        ),
        fuel=fuel_words(verdict),
        fuel_kind="" if fuel == "less" and not verdict.buildable else _SIGNS[fuel],
        fuel_note=" ".join(text for text in verdict.caveats if "uel" in text),
    )


def _balance(now: PageState, problem: str) -> EarnsPart:
    """The same in this flight; nothing is drawn until it is known."""
    parts, hovers = now.of(saving_parts), now.inputs.advance_ratio == 0.0
    here = None if (one := actuated_blade(now)) is None else one.here
    how = (True, True) if one is None else (one.built, one.sourced)
    speed = 0.0 if now.sliders is None else now.inputs.advance_ratio * now.sliders.rotor.tip_speed
    return EarnsPart(
        "ready" if parts else "problem" if problem else "computing",
        now.units.power[0].symbol,
        here=True,
        where="in hover" if hovers else f"at {now.units.speed[0].text(speed)}",
        bars=_bars(
            [part[:2] for part in parts],
            now.units,
            here and here.band,
            [part[2] for part in parts],
            *how,
        ),
    )


def _bars(
    savings: Sequence[tuple[str, float]],
    units: Units,
    band: float | None,
    bands: Sequence[float],
    built: bool,
    sourced: bool,
) -> tuple[PowerBar, ...]:
    rows = balance(savings, units, band, bands, sourced) if savings else []
    kinds: list[Sign] = [_SIGNS[row.kind] for row in rows]
    if kinds and kinds[-1] == "gain" and not built:
        kinds[-1] = ""
    return tuple(
        PowerBar(
            row.name,
            round(row.value, 3),
            row.text,
            kind,
            row is rows[-1],
            round(row.band, 3),
            row.words,
        )
        for row, kind in zip(rows, kinds, strict=True)
    )


def asks(now: PageState) -> tuple[Questions, ...]:
    parts = now.of(parts_call) if now.hand.here else None
    return (Questions(4, (parts,), 0.0),) if parts else ()


def choose(now: PageState, which: str) -> tuple[Effect, ...]:
    """The balance of power here, or over the mission."""
    return (SetHand({"here": which == "here"}),)


def fly_to(now: PageState, x: float) -> tuple[Effect, ...]:
    """The bar was moved: fly there, by schedule with the voltages of that place."""
    if (one := actuated_blade(now)) is None:
        return ()
    flown = min(max(float(x), 0.0), (len(one.legs) - 1) / POINTS_PER_LEG)
    mu, climb = condition_at(one.legs, flown)
    there = MoveSliders(replace(now.inputs, advance_ratio=mu, climb_m_s=climb))
    if now.hand.state != "schedule":
        return (there,)
    return SetHand({"flown": flown}, _driven(now, flown)), there


def choose_state(now: PageState, state: ActuatorState) -> tuple[Effect, ...]:
    """The voltage follows the flight, or is as a hand set it, or stays where the actuator stopped."""
    one, hand = actuated_blade(now), now.hand
    if one is None or state not in STATES or state == hand.state:
        return ()
    if state == "stopped":
        return (SetHand({"stopped": True}),)
    if state == "schedule":
        flown = position_of(one.legs, now.inputs.advance_ratio)
        own = hand.actuator if hand.flown is None else hand.by_hand
        return (SetHand({"stopped": False, "flown": flown, "by_hand": own}, _driven(now, flown)),)
    return (after_flight(hand),)


def after_flight(hand: HandSettings) -> SetHand:
    """As set: no schedule and no stop any more, and the voltages are those that a hand set."""
    before = {"drives": hand.by_hand.drives, "crossed": hand.by_hand.crossed}
    return SetHand(BY_HAND, {} if hand.flown is None else before)


def follow_flight(now: PageState) -> tuple[Effect, ...]:
    """Voltages of a flight that has come meanwhile, and of the place to which an undo or another control has flown."""
    one, flown = _on_stage(now), now.hand.flown
    if one is None or flown is None or now.hand.stopped:
        return ()
    there = position_of(one.legs, now.inputs.advance_ratio)
    if abs(there - flown) > _SAME_PLACE:
        return (SetHand({"flown": there}, _driven(now, there)),)
    come = isinstance(one.flight, ActuatorFlight) and one.flight is not _last(now)
    drives = _driven(now, flown) if come else {}
    return (SetHand(actuator=drives),) if drives else ()


def _driven(now: PageState, x: float | None) -> dict[str, Any]:
    """Voltages as the last flight has them there; nothing where none is known."""
    if (one := actuated_blade(now)) is None or x is None:
        return {}
    flight = one.flight if isinstance(one.flight, ActuatorFlight) else _last(now)
    return {} if flight is None else schedule_at(flight, one.installed, POINTS_PER_LEG * x)


_PRESSES = {"fly": fly_to, "state": choose_state, "balance": choose}
FLIGHT = Panel(
    view, blade_out, asks=asks, remember=remember, reacts=follow_flight, presses=_PRESSES
)
