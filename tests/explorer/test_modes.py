"""Every mode after every other: each number on the screen is that of the design on the sliders."""

from collections.abc import Callable
from contextlib import suppress
from functools import cache
from typing import Any

import msgspec

from explorer.app import App
from explorer.model.actuator_inputs import MOST_SEGMENTS
from explorer.page import Page
from explorer.story.steps import STEPS
from explorer.views.actuated import actuated_blade, drive_power
from explorer.views.assessed import ACTUATOR_CARD
from rotor import Design, Solution, solve
from tests.tools.quantities import disagreeing, shown
from tests.tools.screens import Screen
from tests.tools.visitor import Visitor, arrived, ran

MODES = "explore", "optimise", "actuator", "rotor", "lecture"
"""Of Actuate the view of the actuator and those of the rotor; the lecture goes to its end, which is in Actuate."""
WALK = [MODES[k] for i in range(len(MODES)) for j in range(i + 1, len(MODES)) for k in (i, j)] + [
    MODES[0]
]
"""Each ordered pair once."""
PLACES = {
    ("total power", "line"),
    ("total power", "power and trim"),
    ("total power", "flight bar"),
    ("band of power", "line"),
    ("change of power", "line"),
    ("induced power", "power card"),
    ("reverse flow", "power and trim"),
    ("separated area", "power and trim"),
    ("separated area", "key of the disk"),
    ("separated area", "flight bar"),
}
"""Quantities, and places of the page that are compared on the way."""
DRIVEN = (77.0,) + (0.0,) * (MOST_SEGMENTS - 1)


TEXTS = {
    "details.power": 'data-explorer="power"',
    "details.trim": 'data-explorer="trim"',
}
"""Marks of the widgets of the drawer of power and trim."""


@cache
def trimmed(design: Design) -> Solution:
    return solve(design).require()


def kilowatts(design: Design) -> float:
    return trimmed(design).power.total / 1e3


def design_of(page: Page) -> Design:
    """What the sliders mean and, in Actuate, the voltages."""
    sliders = page.context.controls.inputs().design()
    return (
        page.actuator.inputs().apply(sliders) if page.context.layout.mode == "actuate" else sliders
    )


def screen_of(visitor: Visitor, page: Page, design: Design) -> Screen:
    """What the page was sent, beside trims of our own; its texts as far as their drawer is open."""
    state = page.latest.state
    assert state is not None
    texts = dict[str, str]()
    if visitor.frame["bar"]["drawer"] == "details":
        contents = [str(widget.get("content", "")) for widget in visitor.widgets.values()]
        for name, mark in TEXTS.items():
            texts[name] = next((text for text in contents if mark in text), "")
    reference = trimmed(state.reference.design)
    now = page.now()
    blade = actuated_blade(now) if page.context.layout.mode == "actuate" else None
    return Screen(
        trimmed(design),
        reference,
        visitor.frame,
        texts,
        documented=False,
        verdict=None if blade is None else blade.verdict,
        drive=0.0 if blade is None else drive_power(now) or 0.0,
    )


def wrong(visitor: Visitor, page: Page, mode: str, look: str | None) -> dict[str, Any]:
    """What of the screen is not that of the mode, of the view of Actuate and of the design on the sliders.

    Where the blade is out of the rotor a card with the verdict stands in place of the power.
    """
    frame, design = visitor.frame, design_of(page)
    line, card, parts = frame["line"], frame.get("assessed"), {"flight", "earns", "assessed"}
    shown = float(visitor.text("total-power").replace("\u2009", ""))
    speaks = "drive 0" if mode == "actuate" else "built_outer"
    verdict = ACTUATOR_CARD.view(page.now())["assessed"] if look == "actuator" else None
    seen = {name for name in parts | {"dial"} if frame.get(name) is not None}
    right = {
        "mode": frame["bar"]["mode"] == mode,
        "look": look in (None, frame["views"]["now"]),
        "line": speaks
        in {piece["control"]["name"] for piece in line["pieces"] if piece["control"]},
        "power": not line["problem"]
        and abs(shown - kilowatts(design)) < 0.5 + 1e-3,  # To the digit shown.
        "parts": seen
        == (parts if look == "actuator" else set()) | ({"dial"} if mode == "actuate" else set()),
        "verdict": card == msgspec.json.decode(msgspec.json.encode(verdict)),
    }
    others = disagreeing(screen_of(visitor, page, design)) if all(right.values()) else []
    found = {
        name: (shown, kilowatts(design), card, seen) for name, same in right.items() if not same
    }
    return found | ({"quantities": others} if others else {})


async def told(visitor: Visitor, what: Callable[[dict[str, Any]], bool]) -> None:
    await visitor.until(lambda: what(visitor.frame))


async def right(
    visitor: Visitor, page: Page, mode: str = "explore", look: str | None = None
) -> None:
    try:
        await visitor.until(lambda: not wrong(visitor, page, mode, look))
    except TimeoutError:
        assert wrong(visitor, page, mode, look) == {}


async def to_the_last_step(visitor: Visitor) -> None:
    await visitor.move("Start the lecture", True)
    for step in range(len(STEPS)):
        await told(visitor, lambda frame, step=step: (frame.get("lecture") or {}).get("at") == step)
        if step < len(STEPS) - 1:
            await visitor.press("lecture", "next")


async def go(visitor: Visitor, mode: str, view: str) -> tuple[str, str | None]:
    """Mode and view of Actuate that must be seen then; `view`: of the rotor."""
    if mode == "lecture":
        await to_the_last_step(visitor)
        await visitor.press("lecture", "next")
        await told(visitor, lambda frame: frame["lecture"] is None)
        return "actuate", "actuator"
    if mode in ("explore", "optimise"):
        await visitor.press("mode", mode)
        return mode, None
    look = view if mode == "rotor" else mode
    await visitor.press("mode", "actuate")
    await visitor.press("view", look)
    return "actuate", look


def test_every_mode_after_every_other_shows_the_numbers_of_the_design(app: App):
    async def visit() -> None:
        visitor = await arrived(app.address)
        page = app.sessions[0].page
        read = set[tuple[str, str]]()

        def unread() -> set[tuple[str, str]]:
            """Places that no screen so far has shown."""
            screen = screen_of(visitor, page, design_of(page))
            read.update((quantity.name, one.name) for quantity, one, _ in shown(screen))
            return PLACES - read

        await visitor.press("drawer", "details")
        for k, place in enumerate(WALK):
            mode, look = await go(visitor, place, ("3d", "disk", "side")[k % 3])
            # Once a flight is known, the voltages follow it until Actuate is left.
            if look == "actuator":
                await visitor.press("fly", 1.0 + 0.06 * k)
            else:
                await visitor.press("slide", ["advance_ratio", 0.1 + 0.005 * k])
            await right(visitor, page, mode, look)
            unread()
        # On a busy machine bands may come after the walk has gone on.
        await go(visitor, "explore", "3d")
        await right(visitor, page)
        with suppress(TimeoutError):
            await visitor.until(lambda: not unread())
        assert unread() == set()
        await visitor.close()

    ran(visit)


def test_the_end_of_the_lecture_and_of_a_stop_give_back_what_the_hand_had_set(app: App):
    """Mode, view, design and voltage; the steps of the lecture have a voltage of their own."""

    async def visit() -> None:
        visitor = await arrived(app.address)
        page = app.sessions[0].page
        await visitor.press("mode", "actuate")
        await told(visitor, lambda frame: frame.get("flight") is not None)
        await visitor.move("Voltage [%]", 77.0)
        await visitor.until(lambda: page.actuator.inputs().drives == DRIVEN)
        # What moves by hand is no longer stopped: that has been done.
        await visitor.idle(wholly=False)
        await visitor.press("state", "stopped")
        await visitor.press("fly", 3.0)
        await told(visitor, lambda frame: frame["flight"]["at"] == 3.0)
        for view in ("disk", "actuator"):
            await visitor.press("view", view)
            await told(
                visitor, lambda frame, out=view == "actuator": (frame["flight"] is not None) == out
            )
        assert visitor.frame["flight"]["state"] == "stopped"
        tip = visitor.frame["flight"]["tip"]
        await visitor.press("state", "set")
        await told(visitor, lambda frame: frame["flight"]["state"] == "set")
        assert (page.actuator.inputs().drives, visitor.frame["flight"]["tip"]) == (DRIVEN, tip)
        await visitor.press("view", "disk")
        await told(visitor, lambda frame: frame["views"]["now"] == "disk")
        before = page._views.on_screen()
        assert (before.mode, before.look, before.hand.actuator.drives) == (
            "actuate",
            "disk",
            DRIVEN,
        )
        await to_the_last_step(visitor)
        assert page.actuator.inputs().drives != DRIVEN
        await visitor.press("lecture", "end")
        await visitor.until(lambda: page._views.on_screen() == before)
        await right(visitor, page, "actuate", "disk")
        assert (
            abs(kilowatts(design_of(page)) - kilowatts(page.context.controls.inputs().design()))
            > 1.0
        )
        for mode in ("optimise", "explore"):  # Sliders, link and search know no voltage.
            await visitor.press("mode", mode)
            await right(visitor, page, mode)
        assert page.actuator.inputs().drives == DRIVEN
        await visitor.press("mode", "actuate")
        await right(visitor, page, "actuate", "actuator")
        await visitor.close()

    ran(visit)
