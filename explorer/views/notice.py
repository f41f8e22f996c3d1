"""The bar over the scene, for a search or for a game against what it found; what to do first."""

from typing import Any

from explorer.model.units import Units, number
from explorer.parts.frame import NoticePart
from explorer.parts.stage import SceneLabel
from explorer.text.readout import banded, total_words
from explorer.views.page_state import PageState, Panel, PanelWork
from explorer.views.work import doubt_work
from rotor import Solution
from rotor.trim.doubt import Doubt

_EQUAL = 50.0
"""Changes of power below this [W] are none."""


def game_doubt(now: PageState) -> tuple[PanelWork, ...]:
    """How sure the difference from what the search found is."""
    state, game = now.state, now.game
    return (
        ()
        if state is None or game is None
        else (doubt_work("game", state.solution, game.least, now.analyses),)
    )


def notice(now: PageState) -> dict[str, Any]:
    """While the blade moves, the difference of the two powers has the band of the step before."""
    words, state, game, units = now.searching, now.state, now.game, now.units
    if words is None and state is not None and game is not None:
        band, _ = now.latest(game_doubt(now)[0])
        link = (
            []
            if game.best is game.start
            else [
                ("game_link", f"Copy link: I reached {total_words(game.best.power.total, units)}")
            ]
        )
        actions = [*link, ("game_take", "Take it"), ("game_end", "End")]
        sentence = comparison(state.solution, game.least, band, units)
        if game.to_beat is not None:
            sentence = f"{score(game.best, game.to_beat, units)} · {sentence}"
        words = NoticePart(sentence, actions)
    return {"notice": words}


def score(best: Solution, to_beat: Solution, units: Units) -> str:
    """Whether somebody else's score is beaten."""
    gain = to_beat.power.total - best.power.total
    words = total_words(to_beat.power.total, units)
    return f"To beat {words}" if gain < _EQUAL else f"{words} beaten"


def comparison(own: Solution, other: Solution, band: Doubt | None, units: Units) -> str:
    """One's own power against what the search found, with the band of the difference where it is known."""
    unit, change = units.power[0], own.power.total - other.power.total
    power, way = (
        f"The search found {total_words(other.power.total, units)}",
        "more" if change > 0.0 else "less",
    )
    if abs(change) < _EQUAL:
        return f"{power}, yours the same"
    if band is None:
        return f"{power}, yours {number(unit.of(abs(change)), 1)} {unit.symbol} {way}"
    amount, sure = banded(abs(change), band.change_band or 0.0, units).rsplit(":", 1)
    return f"{power}, yours {amount} {way}:{sure}"


def prompt(now: PageState) -> dict[str, SceneLabel | None]:
    """What to do first, until something was done."""
    tip = [0.97 * now.inputs.aircraft.rotor_for(now.inputs.preset).radius, 0.0, 0.0]
    return {
        "prompt": None
        if any(now.steps)
        else SceneLabel("Drag the blade tip up or down", "/rotor/blade_0", tip)
    }


NOTICE = Panel(notice, works=game_doubt)
PROMPT = Panel(prompt, lambda ui: ui.mode == "explore")
