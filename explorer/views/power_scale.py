"""The powers of this flight on one scale: without the actuator, with it, and of the best fixed blade.

Powers of the page's own trims are read there; the others are computed in worker processes, each with the band of its
change from the blade that changes count from. Until they come, those of the inputs before stand there, marked.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from explorer.model.actuator_inputs import AT_REST, ActuatorInputs, schedule_at
from explorer.model.units import Units
from explorer.parts.actuate import PowerMark, PowerScale
from explorer.text.readout import total_size
from explorer.views.actuated import ActuatedBlade, actuated_blade, counted_from
from explorer.views.flight import POINTS_PER_LEG, STATES, position_of
from explorer.views.page_state import PageState
from explorer.workers.call import Call
from rotor import Design
from rotor.actuator import ActuatorFlight, powers

_MARGIN = 0.06
"""Room beyond the outer bands, as a part of the axis between them."""
_LEAST_SPAN = 0.01
"""Least length of the axis, as a part of the power: with less, marks that agree would stand apart."""
_SHOWN = "powers on the scale"
"""Name of the last powers in what is remembered."""


@dataclass(frozen=True)
class _BladePower:
    """One blade in this flight; its design and power [W] are None while they are not known."""

    name: str
    design: Design | None
    power: float | None = None
    band: float = 0.0
    stale: bool = False


def power_scale(now: PageState) -> PowerScale | None:
    """The scale as the page draws it; None where the blade carries no actuator, or nothing is known."""
    known = [each for each in now.of(_powers) if each.power is not None]
    if not known:
        return None
    units = now.units
    waiting = [each for each in now.of(_powers) if each.power is None]
    ordered = sorted(known, key=lambda each: each.power or 0.0)
    marks = [_mark(group, now) for group in _grouped(ordered)]
    ends = _ends(known, units)
    symbol = units.power[0].symbol
    said = "; ".join(f"{mark.name} {mark.value}{_staleness(mark)}" for mark in marks)
    late = ", ".join(each.name for each in waiting)
    return PowerScale(
        unit=symbol,
        ends=ends,
        marks=(*marks, *(PowerMark(each.name, "", None) for each in waiting)),
        sentence=f"Power in this flight, {symbol}: {said}{late and f'; computing: {late}'}.",
    )


def scale_calls(now: PageState) -> tuple[Call, ...]:
    """What the worker processes are asked: the powers that no trim of the page has."""
    calls = dict.fromkeys(
        _call(now, each.design)
        for each in now.of(_blades)
        if each.design is not None and _trimmed(now, each.design) is None
    )
    return tuple(call for call in calls if call is not None)


def remember_powers(now: PageState) -> Mapping[str, Any]:
    """The powers by name, with their bands, to stand until those of other inputs are known."""
    known = {each.name: (each.power, each.band) for each in now.of(_powers)}
    return {_SHOWN: {name: pair for name, pair in known.items() if pair[0] is not None}}


def _blades(now: PageState) -> tuple[_BladePower, ...]:
    """The blades that are compared, in this flight; without one of which it is known that there is none."""
    blade = actuated_blade(now)
    if blade is None:
        return ()
    bare = replace(blade.design, active_twist=None, pitch_per_rev=())
    at_rest = replace(blade.inputs, drives=AT_REST)
    by_hand = _by_hand(now)
    found = [
        _BladePower("without it", bare),
        _BladePower("at rest", at_rest.apply(bare)),
        _BladePower(STATES["set"], by_hand.apply(blade.design)),
    ]
    if not isinstance(blade.flight, str) and not isinstance(blade.outcome, str):
        found.append(_BladePower(STATES["schedule"], _scheduled(blade)))
    if now.hand.stopped:
        found.append(_BladePower(STATES["stopped"], blade.inputs.apply(blade.design)))
    if not isinstance(blade.outcome, str):
        found.append(_BladePower("best fixed blade", _best_fixed(blade, bare)))
    return tuple(found)


def _by_hand(now: PageState) -> ActuatorInputs:
    """The actuator as a hand set it, also where its voltages follow the flight."""
    hand = now.hand
    if hand.flown is None:
        return hand.actuator
    return replace(hand.actuator, drives=hand.by_hand.drives, crossed=hand.by_hand.crossed)


def _scheduled(blade: ActuatedBlade) -> Design | None:
    """The design with the voltages of the schedule in this flight; None until they are known."""
    flight = blade.flight
    if not isinstance(flight, ActuatorFlight):
        return None
    place = position_of(blade.legs, blade.now.inputs.advance_ratio)
    drives = schedule_at(flight, blade.installed, POINTS_PER_LEG * place)
    return replace(blade.inputs, **drives).apply(blade.design)


def _best_fixed(blade: ActuatedBlade, bare: Design) -> Design | None:
    """The design with the best fixed twist of the mission; None until that is known."""
    if blade.verdict is None:
        return None
    return replace(bare, twist=blade.verdict.baseline.fixed_twist)


def _powers(now: PageState) -> tuple[_BladePower, ...]:
    """The blades with their powers; where one is not known, with the last of its name."""
    last = now.memory.latest.get(_SHOWN, {})
    found = list[_BladePower]()
    for each in now.of(_blades):
        pair = _power(now, each.design)
        if pair is not None:
            power, band = pair
            found.append(replace(each, power=power, band=band))
        elif _failed(now, each.design):
            continue
        elif each.name in last:
            power, band = last[each.name]
            found.append(replace(each, power=power, band=band, stale=True))
        else:
            found.append(each)
    return tuple(found)


def _power(now: PageState, design: Design | None) -> tuple[float, float] | None:
    """Power of a design and the band of its change from the reference [W]; None until they are known."""
    if design is None:
        return None
    trimmed = _trimmed(now, design)
    if trimmed is not None:
        return trimmed
    answer = now.answers.get(_call(now, design))
    return answer[-1] if isinstance(answer, tuple) else None


def _failed(now: PageState, design: Design | None) -> bool:
    """Whether a design has no trim."""
    return design is not None and isinstance(now.answers.get(_call(now, design)), str)


def _trimmed(now: PageState, design: Design) -> tuple[float, float] | None:
    """The same where the page itself has the trim: of what flies, and of the blade that changes count from."""
    state = now.state
    if state is None or now.problem:
        return None
    if state.solution.design == design and state.solution.converged:
        blade = actuated_blade(now)
        change = None if blade is None else blade.here
        band = None if change is None else change.band
        return state.solution.power.total, band or 0.0
    if state.baseline.design == design and state.baseline.converged:
        return state.baseline.power.total, 0.0
    return None


def _call(now: PageState, design: Design | None) -> Call | None:
    reference = now.of(counted_from)
    if reference is None or design is None:
        return None
    return Call(powers, ((reference, design),))


def _grouped(ordered: list[_BladePower]) -> list[list[_BladePower]]:
    """Blades that are one design, together."""
    groups = list[list[_BladePower]]()
    for each in ordered:
        same = [group for group in groups if group[0].design == each.design and not each.stale]
        if each.design is not None and same and not same[0][0].stale:
            same[0].append(each)
        else:
            groups.append([each])
    return groups


def _mark(group: list[_BladePower], now: PageState) -> PowerMark:
    """The mark of blades that are one design."""
    unit = now.units.power[0]
    first = group[0]
    power = first.power or 0.0
    names = [each.name for each in group]
    return PowerMark(
        name=", ".join(names),
        value=total_size(power, now.units),
        at=round(unit.of(power), 3),
        band=round(unit.of(first.band), 3),
        stale=first.stale,
        flown=STATES[now.hand.state] in names,
    )


def _ends(known: list[_BladePower], units: Units) -> tuple[float, float]:
    """Ends of the axis, in the unit of the page."""
    unit = units.power[0]
    low = min(unit.of((each.power or 0.0) - each.band) for each in known)
    high = max(unit.of((each.power or 0.0) + each.band) for each in known)
    missing = max(_LEAST_SPAN * abs(high) - (high - low), 0.0)
    margin = _MARGIN * (high - low) + 0.5 * missing
    return round(low - margin, 3), round(high + margin, 3)


def _staleness(mark: PowerMark) -> str:
    return " (out of date)" if mark.stale else ""
