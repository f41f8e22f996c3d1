"""The power card: the parts of power and why it changed; and whether the answer can be trusted."""

from dataclasses import replace
from typing import Any

from explorer.model.inputs import baseline_title
from explorer.model.session_state import SessionState
from explorer.model.units import Units, number
from explorer.parts.results import HandPart, LineStatus, PowerPart, PowerShare
from explorer.text.readout import banded, fineness, ideal_induced, part_change, part_titles
from explorer.text.status import cautions, validated
from explorer.text.why import why
from explorer.views.page_state import PageState, Panel, PanelWork
from explorer.views.work import doubt_work, shown_doubt
from rotor.trim.doubt import Doubt, decimals

_TELLING = 0.1
"""In descent and autorotation total power is near zero: below this part of its positive parts it has no percentage."""
_STALLED = 0.01
"""Part of the thrust, or a fifth of that of the disk, from which separated flow is named beside the power: near the
root much of the disk may be separated without weight.
"""


def power_card(now: PageState) -> dict[str, Any]:
    """The parts of the last trim, and why its power changed; of each part how sure that is, once it is known."""
    state = now.state
    if state is None:
        return {"power": PowerPart()}
    solution, reference = state.solution, state.reference
    same = solution.design == reference.design or not reference.converged
    band = now.answers.get(shown_doubt(now)[0].key)
    words = "" if same else why(reference, solution, now.units, band)
    return {"power": replace(_numbers(state, now.units, band), why=words)}


def _numbers(state: SessionState, units: Units, band: Doubt | None) -> PowerPart:
    """Power and its parts, beside those of the reference."""
    solution, power = state.solution, state.solution.power
    reference = state.reference.power if state.reference.converged else None
    unit, digits = units.power[0], fineness(power, units)
    against = "A"
    if state.pinned is None:
        against = baseline_title(solution.design, state.reference.design)
    whole = sum(max(getattr(power, name), 0.0) for name in part_titles(solution.design))
    parts = list[PowerShare]()
    for name, words in part_titles(solution.design).items():
        value = getattr(power, name)
        title = f"{words} power {units.watts(value, digits)}"
        if reference is not None and solution.design != state.reference.design:
            change, word = part_change(name, power, reference, band, units)
            title += f", {change} {unit.symbol} vs. {against}{word and f': {word}'}"
        share = round(value / whole, 5) if whole > 0.0 else 0.0
        parts.append(
            PowerShare(
                name, words.removesuffix(" rotor"), number(unit.of(value), digits), share, title
            )
        )
    ideal = ideal_induced(solution)
    return PowerPart(
        parts=parts,
        ideal=None if ideal is None or whole <= 0.0 else round(ideal / whole, 5),
        ideal_title=""
        if ideal is None
        else f"Least induced power at this lift: {units.watts(ideal)}",
    )


def status(state: SessionState, units: Units) -> LineStatus:
    """The end of the line: engines, separated area or number of caveats, empty where there is nothing to say.

    Its title says how well the answer is validated.
    """
    reasons = cautions(state.solution, state.pinned, units)
    stalled, installed = state.solution.stalled_area, state.solution.design.aircraft.installed_power
    record = validated(state.solution)
    measured = units.in_power_unit(record.sentence)
    title = " ".join([*reasons, measured])
    power = state.solution.power
    if power.total < 0.0:
        words = (
            "autorotation"
            if power.total > -_TELLING * (power.induced + power.profile)
            else "driven by the air"
        )
    elif installed is not None and any(
        caveat.name == "installed-power" for caveat in state.solution.caveats
    ):
        words = f"engines give only {units.watts(installed)}"
    elif max(state.solution.stalled_thrust, 0.2 * stalled) >= _STALLED:
        thrust = number(100.0 * state.solution.stalled_thrust, 1)
        words = f"{number(100.0 * stalled, 1)} % of disk, {thrust} % of thrust separated"
    elif reasons:
        words = "1 note" if len(reasons) == 1 else f"{len(reasons)} notes"
    else:
        title = f"{state.solution.message} {measured} Click to see how far to trust it."
        return LineStatus("converged", "", title)
    return LineStatus("care", words, title)


def station_doubt(now: PageState) -> tuple[PanelWork, ...]:
    """How sure the change since the blade was taken is."""
    before, state = now.station and now.station.before, now.state
    if before is None or state is None or before.design == state.solution.design:
        return ()
    return (doubt_work("held", state.solution, before, now.analyses),)


def station_power(now: PageState) -> dict[str, Any]:
    """Power and its least beside the blade, while a station of it is held; with bands while it rests."""
    if now.state is None or now.station is None:
        return {"hand": None}
    power, change, unit = now.state.solution.power, now.change or 0.0, now.units.power[0]
    digits, band = (
        fineness(power, now.units),
        next((now.answers.get(work.key) for work in station_doubt(now)), None),
    )
    within = None if band is None else band.change_band
    around = (
        ""
        if band is None
        else f" ± {number(unit.of(band.band), max(digits, decimals(unit.of(band.band))))}"
    )
    words = unit.text(change, digits, sign=True)
    if within and round(unit.of(change), 1):
        words = banded(change, within, now.units, sign=True).replace(":", ",")
    shown = HandPart(
        power=f"{number(unit.of(power.total), digits)}{around} {unit.symbol}",
        change=words,
        now=round(unit.of(power.total), 2),
        before=round(unit.of(power.total - change), 2),
        digits=digits,
        place=now.station.place,
        best=now.station.best
        and replace(now.station.best, power=round(unit.of(now.station.best.power), 2)),
        optimised=None if now.game is None else round(unit.of(now.game.least.power.total), 2),
    )
    return {"hand": shown}


POWER = Panel(power_card, works=shown_doubt)
HAND = Panel(station_power, works=station_doubt)
