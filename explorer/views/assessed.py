"""The card that says what the actuator as set moves, costs and gives."""

import math

from explorer.model.actuator_inputs import AGAINST
from explorer.model.units import Units, number
from explorer.parts.actuate import AssessedPart
from explorer.text.readout import mass_parts, needs_words
from explorer.views.actuated import ActuatedBlade, actuated_blade, against_words, blade_out, here_problem
from explorer.views.page_state import Effect, PageState, Panel, Questions, SetHand
from rotor.actuator.verdict import Against
from rotor.trim.doubt import sureness

_URGENCY, _DELAY_S = 6, 1.0
"""Of what would make it pay, behind all verdicts' chosen one; how long the question must stand [s]."""


def asks(now: PageState) -> tuple[Questions, ...]:
    call = one.line_task if (one := actuated_blade(now)) is not None else None
    return (Questions(_URGENCY, () if call is None else (call,), _DELAY_S),)


def _angle(radians: float) -> str:
    return f"{number(math.degrees(radians), 2, sign=True)}°"


def _reach(one: ActuatedBlade) -> str:
    return "…".join(map(_angle, one.inputs.reach(one.installed))).replace("°…", "…")


def _title(one: ActuatedBlade) -> str:
    """What it is, and its drive as on the sliders."""
    installed, inputs = one.installed, one.inputs
    shares = ", ".join(number(100.0 * share) for share in inputs.drive_shares(installed))
    driven = f"at {shares} % of its {installed.actuator.drive_noun}" if inputs.driven else "at rest"
    return f"{one.name}, {installed.count}{' a side' if installed.actuator.on_skin else ''}, {driven}"


def _vibration(one: ActuatedBlade) -> str:
    """The change of vibration here, with its band over inflow models."""
    if one.vibration is None:
        return "" if one.here is None else "no vibration data here"
    own, band = number(one.vibration.index[0], 0, sign=True), one.vibration.index_band
    within = "" if band is None else f" ± {number(band)}"
    word = "" if band is None else f" ({sureness(one.vibration.index[0], band)})"
    return f"vibration {own}{within} %{word}"


def _sentences(one: ActuatedBlade, units: Units) -> tuple[str, tuple[str, ...]]:
    """What it moves, costs and gives; and what would make it pay: words, and every second one a number to drag."""
    total, flight, verdict = mass_parts(one.installed)["in all"], one.over_flight, one.verdict
    known = [change for change in (one.here, flight) if change]
    powers = [needs_words(-change.power, change.band, units) for change in known]
    if len(powers) == 2 and known[0].power * known[1].power > 0.0:  # One verb and one unit serve both.
        powers[1] = powers[1].partition(" ")[2].replace(f" {units.power[0].symbol}", "").replace(" more", "")
    places = (["here"] if one.here else []) + ["over the flight"]
    parts = ", ".join(f"{power} {place}" for power, place in zip(powers, places, strict=False))
    moves = f"{one.name} moves the tip by {_reach(one)} in flight for {total}{': it ' if parts else ''}{parts}."
    mass = None if verdict is None else verdict.mass_allowed
    if flight is None or mass is None:
        return moves, ()
    if not mass:
        return moves, ("It would not pay, however light.",)
    wide = None if one.line is None else one.line.twist_for(one.mass)
    pays = f"It {'pays' if flight.power < 0.0 else 'would pay'} below ", f"{number(mass, 0 if mass >= 10.0 else 1)} kg"
    if wide is not None:
        return moves, (*pays, " or with a range above ", f"{number(math.degrees(wide), 1)}°", ".")
    return moves, (*pays, "." if one.line is None else f"; no twist pays at {total}.")


def card(now: PageState) -> dict[str, AssessedPart | None]:
    """Three columns and the sentence."""
    if (one := actuated_blade(now)) is None:
        return {} if now.problem else {"assessed": None}
    units, against = now.units, one.inputs.against
    *parts, (_, total) = mass_parts(one.installed).items()
    sentence, pays = _sentences(one, units)
    both = one.here, one.over_flight
    here, flight = ("" if each is None else needs_words(-each.power, each.band, units) for each in both)
    part = AssessedPart(
        title=_title(one),
        tip=_angle(one.inputs.tip(one.installed)),
        reach=_reach(one),
        wanted="" if one.wanted is None else _angle(one.wanted),
        mass=total,
        masses=tuple(parts),
        here=here,
        kind="" if one.here is None else one.here.kind,
        flight=flight,
        vibration=_vibration(one),
        problem=here_problem(now),
        against=against,
        baselines=tuple((each, against_words(one, each)) for each in AGAINST),
        sentence=sentence,
        pays=pays,
        range=round(math.degrees(one.range), 2),
        kilograms=round(one.mass, 1),
    )
    return {"assessed": part}


def choose(now: PageState, against: Against) -> tuple[Effect, ...]:
    """Count every change from this blade."""
    return (SetHand(actuator={"against": against}),) if against in AGAINST else ()


ACTUATOR_CARD = Panel(card, blade_out, asks, presses={"against": choose})
