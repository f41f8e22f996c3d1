"""The top bar: rotor, mode, drawer, steps of undo, and A of A/B."""

from explorer.model.inputs import menu_titles
from explorer.parts.frame import BarPart, PinnedRow
from explorer.text.design_words import flight_name, title_words
from explorer.views.page_state import Effect, PageState, Panel, PinOrder


def bar(now: PageState) -> dict[str, BarPart]:
    undo, redo = now.steps
    part = BarPart(
        rotors=list(menu_titles(now.inputs.own_rotor).items()),
        rotor=now.inputs.rotor,
        mode=now.ui.mode,
        drawer=now.ui.drawer,
        undo=undo,
        redo=redo,
        pinned=_pinned(now),
    )
    return {"bar": part}


def _pinned(now: PageState) -> PinnedRow | None:
    pinned, answer = now.pins.pinned, now.pins.answer
    if pinned is None:
        return None
    power = "no trim at this condition"
    if answer is not None and answer.converged:
        power = now.units.watts(answer.power.total)
    where = "" if now.pins.along else f" at {flight_name(pinned.inputs)}"
    return PinnedRow(title_words(pinned.solution.design), power + where, now.pins.along)


def pin(now: PageState, _: None) -> tuple[Effect, ...]:
    """Make the design on the sliders A, or remove A."""
    return (PinOrder("pin" if now.pins.pinned is None else "unpin"),)


BAR = Panel(
    bar,
    presses={
        "pin": pin,
        "swap": lambda now, _: (PinOrder("swap"),),
        "back": lambda now, _: (PinOrder("back"),),
        "along": lambda now, along: (PinOrder("along" if along else "apart"),),
    },
    keys=("pin", "swap", "back"),
)
