"""The card of the actuator as set: a row of what it moves, weighs and earns, and the scale of power."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from explorer.model.actuator_inputs import AGAINST, ActuatorInputs
from explorer.model.units import Units, number
from explorer.parts.actuate import AssessedPart
from explorer.text.readout import kilograms, limit_words, mass_parts, mission_words, more_words
from explorer.views.actuated import (
    ActuatedBlade,
    actuated_blade,
    against_words,
    blade_out,
    no_verdict,
)
from explorer.views.dial_answer import FittedBlade, peak_of
from explorer.views.page_state import (
    Effect,
    PageState,
    Panel,
    PanelMemory,
    Questions,
    SetHand,
)
from explorer.views.pay import mass_that_pays
from explorer.views.power_scale import power_scale, remember_powers, scale_calls
from rotor.actuator import OtherStroke
from rotor.actuator.kind import MOST_BOUNDS, Limit
from rotor.actuator.limits import limits, why_immovable
from rotor.actuator.verdict import Against
from rotor.dynamics.structure import structure_data
from rotor.trim.doubt import sure_words

_URGENCY, _DELAY_S = 6, 1.0
"""Of what would make it pay, behind all verdicts' chosen one; how long the question must stand [s]."""
_SCALE_URGENCY, _SCALE_DELAY_S = 4, 0.4
"""Of the powers on the scale: with the flight, behind the chosen verdict."""


def asks(now: PageState) -> tuple[Questions, ...]:
    call = one.line_task if (one := actuated_blade(now)) is not None else None
    return (
        Questions(_SCALE_URGENCY, scale_calls(now), _SCALE_DELAY_S),
        Questions(_URGENCY, () if call is None else (call,), _DELAY_S),
    )


def remember(now: PageState, shown: Mapping[str, Any]) -> PanelMemory:
    """The powers on the scale."""
    return replace(now.memory, latest={**now.memory.latest, **remember_powers(now)})


def _angle(radians: float) -> str:
    return f"{number(math.degrees(radians), 2, sign=True)}°"


def _reach(one: ActuatedBlade) -> str:
    """Both ends of the range of tip twist; empty for an actuator that hardly moves."""
    if one.installed.too_weak:
        return ""
    return "…".join(map(_angle, one.inputs.reach(one.installed))).replace("°…", "…")


def _end(one: ActuatedBlade) -> str:
    """The end of the range on the side of the tip twist, of a tip at rest the larger; empty as `_reach`."""
    if one.installed.too_weak:
        return ""
    tip = one.inputs.tip(one.installed)
    low, high = one.inputs.reach(one.installed)
    if not tip:
        return _angle(max(low, high, key=abs))
    return _angle(high if tip > 0.0 else low)


def _buildable(one: ActuatedBlade, over: Sequence[str]) -> str:
    """Whether it can be built, and what is in the way: `not buildable: 3 limits`; empty until that is known.

    `over`: the limits that are exceeded.
    """
    reason = why_immovable(one.installed)
    if reason:
        return f"not buildable: {reason}"
    if one.verdict is None:
        return ""
    if not over:
        return "buildable"
    return f"not buildable: {len(over)} limit{'s' if len(over) > 1 else ''}"


def _earns(one: ActuatedBlade, units: Units) -> tuple[str, str]:
    """Its change of power over the mission, and how sure that is: `18 ± 4 kW more`, `likely, from estimated data`."""
    verdict = one.verdict
    if verdict is None:
        return "", ""
    saving = verdict.net_saving
    band = verdict.net_band
    sure = "" if band is None else sure_words(saving, band, sourced=one.sourced)
    if one.installed.actuator.forbidden:
        sure = ", ".join(filter(None, (sure, "if it could work")))
    return more_words(saving, band, units), sure


def _vibration(one: ActuatedBlade) -> str:
    """The change of vibration here: mean and ends over inflow models."""
    if not one.vibration:
        return "" if one.vibration is None else "no vibration data here"
    ends, middle = (
        (min(one.vibration), max(one.vibration)),
        math.fsum(one.vibration) / len(one.vibration),
    )
    mean, low, high = (number(change, 0, sign=True) for change in (middle, *ends))
    if ends[0] * ends[1] <= 0.0:
        return f"vibration unclear ({low}…{high} %)"
    return f"vibration {mean} % ({low}…{high})"


def _pays(one: ActuatedBlade) -> tuple[str, ...]:
    """What would make it pay: words, and every second one a number to drag."""
    flight = one.over_flight
    mass = None if one.verdict is None else one.verdict.mass_allowed
    if flight is None or mass is None or one.installed.too_weak:
        return ()
    if not mass:
        return ("It would not pay, however light.",)
    pays = "pays" if flight.power < 0.0 else "would pay"
    return _pays_where(one, one.line, mass, pays)


def _pays_where(
    one: ActuatedBlade, line: OtherStroke | None, mass: float, pays: str
) -> tuple[str, ...]:
    """The mass [kg] and the range with which it pays: words, and every second one a number to drag. A mass within its
    band is none, and a range far beyond its own is not named."""
    if line is None:
        return f"It {pays} below ", kilograms(mass), "."
    light = mass_that_pays(line, one.range, mass)
    wide = line.twist_for(one.mass)
    near = wide is not None and wide <= MOST_BOUNDS * one.range
    if light is None and wide is not None and near:
        return (
            f"It {pays} with a range above ",
            f"{number(math.degrees(wide), 1)}°",
            "; with its own, no mass is sure to pay.",
        )
    if light is None:
        return ("With its range no mass is sure to pay.",)
    size, band = light
    if wide is None:
        return f"It {pays} below ", size, f" (± {band}); no twist pays at {kilograms(one.mass)}."
    if not near:
        return f"It {pays} below ", size, f" (± {band})."
    return (
        f"It {pays} below ",
        size,
        f" (± {band}) or with a range above ",
        f"{number(math.degrees(wide), 1)}°",
        ".",
    )


def _over(one: ActuatedBlade) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Each limit that is exceeded, with value and bound: its own, and those that only the best twist would exceed."""
    broken = () if one.verdict is None else one.verdict.broken
    reach = one.installed.actuator.range_limits
    own, required = (
        [_limit(each) for each in broken if (each.name in reach) == short]
        for short in (False, True)
    )
    peak = peak_of(one.now.inputs.twist_per_rev)
    room = FittedBlade(one.installed, one.inputs.driven_at(one.installed)).room
    own += (
        [f"twist at n/rev {number(peak, 2)} of {number(room, 2)}°"] if peak > room + 0.005 else []
    )
    return tuple(own), tuple(required)


def _limit(limit: Limit) -> str:
    digits = 0 if max(limit.value, limit.bound) >= 20.0 else 2
    if limit.far_above:
        return _far_above(limit, digits)
    value, bound = (number(end, digits) for end in (limit.value, limit.bound))
    least = "at least " if limit.value < limit.bound else ""
    return f"{limit_words(limit.name)} {value} of {least}{bound} {limit.unit}"


def _far_above(limit: Limit, digits: int) -> str:
    name = limit_words(limit.name)
    if not limit.bound:
        return f"no {name}"
    return f"{name} far above {number(limit.bound, digits)} {limit.unit}"


def card(now: PageState) -> dict[str, AssessedPart | None]:
    """The row, the scale, and what is behind them."""
    if (one := actuated_blade(now)) is None:
        return {} if now.problem else {"assessed": None}
    against = one.inputs.against
    over, required = _over(one)
    earns, sure = _earns(one, now.units)
    part = AssessedPart(
        buildable=_buildable(one, over),
        tip=_angle(one.inputs.tip(one.installed)),
        end=_end(one),
        reach=_reach(one),
        mass=mass_parts(one.installed)["in all"],
        earns=earns,
        sure=sure,
        mission="" if one.verdict is None else mission_words(one.question.mission),
        vibration=_vibration(one),
        problem=no_verdict(now),
        over=over,
        required=required,
        feasible=_change_words(one, now.of(feasible)),
        against=against,
        baselines=tuple((each, against_words(one, each)) for each in AGAINST),
        scale=power_scale(now),
        pays=_pays(one),
        range=round(math.degrees(one.range), 2),
        kilograms=round(one.mass, 1),
    )
    return {"assessed": part}


def choose(now: PageState, against: Against) -> tuple[Effect, ...]:
    """Count every change from this blade."""
    return (SetHand(actuator={"against": against}),) if against in AGAINST else ()


def feasible(now: PageState) -> ActuatorInputs | None:
    """The nearest actuator of this kind on this blade whose own limits all hold: as many plies as may be, clear of the
    heated nose. None where those hold, or where there is none."""
    one = actuated_blade(now)
    if one is None or one.verdict is None or one.verdict.buildable:
        return None
    kept, nose = (
        one.installed.actuator.range_limits,
        float(structure_data()["limits"]["de_ice_end_c"]),
    )
    for plies in range(one.inputs.plies, 0, -1):
        for front in dict.fromkeys((one.inputs.chord[0], max(one.inputs.chord[0], nose))):
            other = replace(one.inputs, plies=plies, chord=(front, one.inputs.chord[1]))
            try:
                installed = other.installed(one.design.rotor)
            except ValueError:
                continue
            if all(
                limit.ok or limit.name in kept
                for limit in limits(installed, (1.0,) * len(installed.shapes))
            ):
                return other
    return None


def _change_words(one: ActuatedBlade, other: ActuatorInputs | None) -> str:
    if other is None:
        return ""
    plies = (
        ""
        if other.plies == one.inputs.plies
        else f"{other.plies} {one.installed.actuator.noun[other.plies > 1]}"
    )
    chord = "" if other.chord == one.inputs.chord else f"chord from {number(other.chord[0], 2)}"
    return ", ".join(filter(None, (plies, chord)))


def make_feasible(now: PageState, _: Any) -> tuple[Effect, ...]:
    """Set the actuator that could be built."""
    other = now.of(feasible)
    return (
        () if other is None else (SetHand(actuator={"plies": other.plies, "chord": other.chord}),)
    )


ACTUATOR_CARD = Panel(
    card,
    blade_out,
    asks,
    remember=remember,
    presses={"feasible": make_feasible},
)
