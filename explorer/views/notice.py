"""The bar over the scene, for a search or for the optimiser's blade beside the one in the hand; what to do first."""

from typing import Any

from explorer.model.units import Units, number
from explorer.parts.frame import NoticePart
from explorer.parts.stage import SceneLabel
from explorer.text.readout import banded
from explorer.views.page_state import PageState, Panel, PanelWork
from explorer.views.work import doubt_work
from rotor import Solution
from rotor.trim.doubt import Doubt

_EQUAL = 50.0
"""Changes of power below this [W] are none."""


def optimised_doubt(now: PageState) -> tuple[PanelWork, ...]:
    """How sure the difference from the optimiser's blade is."""
    state, optimised = now.state, now.optimised
    return (
        ()
        if state is None or optimised is None
        else (doubt_work("optimised", state.solution, optimised, now.analyses),)
    )


def notice(now: PageState) -> dict[str, Any]:
    """While the blade moves, the difference of the two powers has the band of the step before."""
    words, state, optimised = now.searching, now.state, now.optimised
    if words is None and state is not None and optimised is not None:
        band, _ = now.latest(optimised_doubt(now)[0])
        actions = [("rival_take", "Take its twist"), ("rival_end", "End")]
        words = NoticePart(comparison(state.solution, optimised, band, now.units), actions)
    return {"notice": words}


def comparison(own: Solution, other: Solution, band: Doubt | None, units: Units) -> str:
    """One's own power against the optimiser's, with the band of the difference where it is known."""
    unit, change = units.power[0], own.power.total - other.power.total
    power, way = f"Optimiser {units.watts(other.power.total, 1)}", "more" if change > 0.0 else "less"
    if abs(change) < _EQUAL:
        return f"{power}, yours the same"
    if band is None:
        return f"{power}, yours {number(unit.of(abs(change)), 1)} {unit.symbol} {way}"
    amount, sure = banded(abs(change), band.change_band or 0.0, units, least=1).rsplit(":", 1)
    return f"{power}, yours {amount} {way}:{sure}"


def prompt(now: PageState) -> dict[str, SceneLabel | None]:
    """What to do first, until something was done."""
    tip = [0.97 * now.inputs.aircraft.rotor_for(now.inputs.preset).radius, 0.0, 0.0]
    label = SceneLabel("Pull the blade tip up or down", "/rotor/blade_0", tip)
    return {"prompt": None if any(now.steps) else label}


NOTICE = Panel(notice, works=optimised_doubt)
PROMPT = Panel(prompt, lambda ui: ui.mode == "explore" and not ui.held)
