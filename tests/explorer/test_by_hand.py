"""What a hand does to a page, sent as a browser sends it: drags and their undo, presses, a game, links."""

import asyncio
import logging
from collections.abc import Callable, Coroutine, Iterator
from dataclasses import replace
from itertools import pairwise
from typing import Any

import pytest

from explorer.app import App
from explorer.model import undo
from explorer.model.inputs import OPENING, Inputs
from explorer.page import Page
from explorer.parts.presses import PRESSES
from explorer.sharing.game import Game
from explorer.sharing.share import DESIGN, code_of, with_parameter
from explorer.widgets.lecture.lecture_panel import LecturePanel
from explorer.widgets.optimise.hand_game import GAME
from rotor import make_design
from rotor.optimisation.mission import ASSUMED_HOURS
from tests.tools.visitor import Visitor, arrived, part_of, ran

SENT: dict[str, Any] = {
    "along": False, "hold": True, "field": "Lift", "region": "stall", "mode": "actuate", "drawer": "open",
    "task": "Map", "opened": "History", "rotor": "r22", "flown": "dnw", "default": "Δ inboard [°/R]", "story": 2,
    "guess": 0, "stop": 1, "dial_front": 2, "grab_at": 1.0, "twist_by_hand": 1.0, "slide": ["advance_ratio", 0.3],
    "difference": "on",
    "more": "on", "ride": [0.8, 90.0], "riding": 120.0, "azimuth": 30.0, "fly": 1.5, "suppose": "on", "balance": "here",
    "against": "best-fixed", "state": "stopped", "section": [0.8, 90.0], "map_at": [0.2, 0.8], "pull": 0.5,
    "covered": [0.1, 0.2, 0.3, 0.0], "view": "disk", "colours": "Rescale", "lecture": "next",
    "knot": ["2", [None, -5.0]], "dial": [[3, 1.0, 60.0]],
    "kind": "AFC", "law": "linear", "compare": "this", "hours": [2, 1.5], "scene": "lost", "seen": True,
}  # fmt: skip
"""A value for each press that has one."""
BEGUN = "Δ inboard [°/R]"


@pytest.fixture(scope="module")
def app() -> Iterator[App]:
    app = App("127.0.0.1", 0)
    yield app
    app.stop()


def visited(
    app: App, act: Callable[[Visitor, Page], Coroutine[Any, Any, None]], query: str = ""
) -> None:
    """Do this on a page of the server."""

    async def visit() -> None:
        visitor = await arrived(app.address, query=query)
        await visitor.idle(wholly=False)
        try:
            await act(visitor, app.sessions[-1].page)
        finally:
            await visitor.close()
        while app.sessions:
            await asyncio.sleep(0.02)

    ran(visit)


def test_undo_takes_back_what_no_update_has_read_yet(app: App):
    """On a busy machine it did nothing, for the step was not known yet."""

    async def stands(page: Page, rate: float) -> None:
        for _ in range(500):
            if page.context.controls.inputs().built_inner == rate:
                return
            await asyncio.sleep(0.02)
        assert page.context.controls.inputs().built_inner == rate

    async def hurry(visitor: Visitor, page: Page) -> None:
        with page.context.whole:  # No update reads, and none sends anything.
            await visitor.move(BEGUN, -4.0)
            await stands(page, -4.0)
            await visitor.press("undo")
            await stands(page, 0.0)

    visited(app, hurry)


def test_a_drag_with_pauses_is_one_undo(app: App, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(undo, "PAUSE", 0.1)

    async def drag(visitor: Visitor, page: Page) -> None:
        await visitor.press("hold", True)
        for value in (-1.0, -2.0, -1.5):
            await visitor.move(BEGUN, value)
            await visitor.idle(wholly=False)
            await asyncio.sleep(0.3)
        await visitor.press("hold", False)
        await asyncio.sleep(0.3)
        for value in (-2.0, -2.5, -3.0):  # Another drag, by keys that follow each other.
            await visitor.move(BEGUN, value)
            await asyncio.sleep(0.02)
        await visitor.idle(wholly=False)
        for left in (-1.5, 0.0):
            assert visitor.frame["bar"]["undo"]
            await visitor.press("undo")
            await visitor.idle(wholly=False)
            assert page.context.controls.inputs().built_inner == left
        assert not visitor.frame["bar"]["undo"]

    visited(app, drag)


def flown(page: Page) -> tuple[object, ...]:
    """Design, actuator, field, A and what is made with them."""
    view, hand = page.context.display.view, page.actuator.hand()
    run, optimised, place = (
        page.optimise.run,
        page.optimise.hand.standing,
        part_of(page, LecturePanel).place,
    )
    return (page.context.controls.inputs(), page.context.pinboard.pinned, run, optimised, hand.on_stage,
            hand.actuator.drives, view.field, view.difference, place)  # fmt: skip


def test_no_press_fails(app: App, caplog: pytest.LogCaptureFixture):
    """Each acts on what those before it have left."""
    assert {name for name, kind in PRESSES.items() if kind is not None} == {*SENT, "idle"}

    async def press(visitor: Visitor, page: Page) -> None:
        for name in PRESSES:
            caplog.clear()
            if name != "idle":
                await visitor.press(name, SENT.get(name))
            await visitor.idle(wholly=False)
            said = [one.getMessage() for one in caplog.records if one.levelno >= logging.WARNING]
            assert (name, said) == (name, [])
            assert (name, visitor.frame.get("stale", False)) == (name, False)

    visited(app, press)


def test_presses_change_the_page(app: App):
    async def press(visitor: Visitor, page: Page) -> None:
        for name in ("pin", "slide", "rotor", "undo", "mode", "suppose"):
            before = flown(page)
            await visitor.press(name, SENT.get(name))
            await visitor.idle(wholly=False)
            assert name == "mode" or (name, flown(page)) != (name, before)

    visited(app, press)


def test_each_choice_in_the_line_is_one_step_however_soon_they_follow(app: App):
    """Also what is compared with: undo unpins A, and pins it again."""

    async def choose(visitor: Visitor, page: Page) -> None:
        def stands() -> tuple[str, Inputs | None, str]:
            actuator = page.actuator.inputs().actuator
            return page.context.inputs().law, page.context.pinboard.inputs, actuator

        chosen: list[tuple[str, str | int]] = [
            ("law", "linear"),
            ("law", "two"),
            ("compare", "this"),
        ]
        chosen += [("law", "linear"), ("compare", "built"), ("kind", "AFC"), ("kind", "SMA_tube")]
        seen = [stands()]
        await visitor.press("mode", "actuate")
        for name, value in chosen:
            for press in (("hold", True), (name, value), ("hold", False)):
                await visitor.press(*press)
            await visitor.idle(wholly=False)
            seen.append(stands())
        assert all(one != other for one, other in pairwise(seen))
        for before in reversed(seen[:-1]):
            await visitor.press("undo")
            await visitor.idle(wholly=False)
            assert stands() == before
        assert not visitor.frame["bar"]["undo"]
        for after in seen[1:]:
            await visitor.press("redo")
            await visitor.idle(wholly=False)
            assert stands() == after

    visited(app, choose)


@pytest.mark.slow
def test_without_a_trim_the_last_numbers_stay_and_one_press_leads_back(app: App):
    async def lose(visitor: Visitor, page: Page) -> None:
        await visitor.move("Adv. ratio µ", 0.44)
        await visitor.idle(wholly=False)
        lost = page.context.controls.inputs()
        assert visitor.text("status") == "problem"
        assert visitor.text("total-power") == ""
        assert all(one["stale"] for one in visitor.frame["strip"] if one)
        await visitor.press("nearest")
        await visitor.idle(wholly=False)
        assert visitor.text("status") == "converged"
        await visitor.press("undo")
        await visitor.idle(wholly=False)
        assert visitor.text("status") == "problem"
        assert page.context.controls.inputs() == lost

    visited(app, lose, f"?d={code_of(replace(OPENING, mass_t=11.0, altitude_m=2000.0).design())}")


def test_a_swap_by_one_press_is_one_swap(app: App):
    async def swap(visitor: Visitor, page: Page) -> None:
        await visitor.press("pin")
        await visitor.idle(wholly=False)
        await visitor.move(BEGUN, -3.0)
        await visitor.idle(wholly=False)
        for a, b in ((-3.0, 0.0), (0.0, -3.0)):
            await visitor.press("swap")
            await visitor.idle()
            assert (
                page.context.pinboard.pinned.inputs.built_inner,
                page.context.controls.inputs().built_inner,
            ) == (
                a,
                b,
            )

    visited(app, swap)


def test_a_typed_mass_that_reads_as_the_opening_is_that_design(app: App):
    """It was 8,320 kg, and the page had opened with 8,322.4, shown as 8.32 t too."""

    async def typed(visitor: Visitor, page: Page) -> None:
        for mass, same in ((9.0, False), (8.32, True), (8.33, False), (8.32, True)):
            await visitor.move("Mass [t]", mass)
            await visitor.idle(wholly=False)
            assert (page.context.controls.inputs() == OPENING) == same

    visited(app, typed)


def test_a_page_loaded_again_has_its_design_and_its_steps(app: App):
    async def load(visitor: Visitor, page: Page) -> None:
        await visitor.press("pin")
        await visitor.move(BEGUN, -3.0)
        await visitor.idle(wholly=False)
        shown = visitor.text("total-power")
        # An address is not written more often than a browser allows.
        await visitor.until(lambda: "&a=" in visitor.query)
        again = visitor.again()
        await again.open(app.address)
        await again.until(lambda: again.text("status") == "converged")
        await again.idle(wholly=False)
        loaded = app.sessions[-1].page
        assert loaded is not page
        assert loaded.context.controls.inputs() == page.context.controls.inputs()
        assert again.text("total-power") == shown
        assert again.frame["bar"]["pinned"]
        await again.press("undo")
        await again.idle(wholly=False)
        assert loaded.context.controls.inputs() == OPENING
        await again.close()

    visited(app, load)


def test_a_game_is_played_by_its_link(app: App):
    design = replace(OPENING, inflow="drees", elements=20, azimuths=36).design()
    start, least = (
        replace(design, twist=make_design(twist=spec).twist) for spec in ("linear:-4", "linear:-12")
    )
    query = with_parameter("", DESIGN, code_of(start))

    async def play(visitor: Visitor, page: Page) -> None:
        standing = page.optimise.hand.standing
        assert standing is not None
        assert standing.best is standing.start
        await visitor.move("Rate [°/R]", -8.0)
        await visitor.idle(wholly=False)
        standing = page.optimise.hand.standing
        assert standing is not None
        assert standing.best.design == page.context.inputs().design()
        assert standing.least.power.total < standing.best.power.total < standing.start.power.total
        assert visitor.frame["notice"]["text"].startswith("The search found")
        (link, *_) = visitor.frame["notice"]["actions"]
        assert link[1].startswith("Copy link: I reached ")
        await visitor.press("game_take")
        await visitor.idle(wholly=False)
        assert page.context.inputs().design().twist == least.twist
        assert page.optimise.hand.game is None
        await visitor.until(lambda: f"{GAME}=" not in visitor.query)

    visited(app, play, with_parameter(query, GAME, Game(start, least).code()))


@pytest.mark.parametrize(
    ("part", "sentence"),
    [
        ("follow=3f1c2d5e8a90", "'follow' was left out: a page no longer follows another."),
        ("present=a-secret", "'present' was left out: a page no longer leads others."),
    ],
)
@pytest.mark.parametrize("before", [True, False])
def test_a_link_of_an_earlier_version_opens_and_says_what_was_left_out(
    app: App, part: str, sentence: str, before: bool
):
    design = "d=1;linear:-8;mu=0.3"

    async def look(visitor: Visitor, page: Page) -> None:
        inputs = page.context.inputs()
        assert (inputs.law, inputs.linear, inputs.advance_ratio) == ("linear", -8.0, 0.3)
        (notice,) = visitor.notices
        assert notice.endswith(f": {sentence}")
        # Nor does the link of this page hold it.
        await visitor.until(lambda: visitor.query == f"?{design}")
        await visitor.move("Rate [°/R]", -9.0)
        await visitor.until(lambda: "linear:-9" in visitor.query)

    visited(app, look, f"?{part}&{design}" if before else f"?{design}&{part}")


def test_a_voltage_is_a_step_of_its_own(app: App):
    """Undo moved the advance ratio in its place, which had been set before."""

    async def volts(visitor: Visitor, page: Page) -> None:
        await visitor.move("Adv. ratio µ", 0.25)
        await visitor.idle()
        await visitor.press("mode", "actuate")
        await visitor.move("Voltage [%]", 50.0)
        await visitor.idle()
        await visitor.press("mode", "explore")
        await visitor.idle()
        await visitor.press("undo")
        await visitor.until(lambda: not any(page.actuator.inputs().drives))
        await visitor.idle()
        assert page.context.layout.mode == "explore"
        assert page.context.inputs().advance_ratio == 0.25
        await visitor.press("redo")
        await visitor.until(lambda: page.actuator.inputs().drives[0] == 50.0)
        await visitor.press("undo")
        await visitor.press("undo")
        await visitor.until(lambda: page.context.inputs().advance_ratio == OPENING.advance_ratio)

    visited(app, volts)


def test_link_and_undo_have_the_hours_of_the_mission_in_any_mode(app: App):
    async def set_and_undo(visitor: Visitor, page: Page) -> None:
        await visitor.press("mode", "optimise")
        await visitor.press("hours", [0, 2.0])
        await visitor.until(lambda: "h=2,0.25,1,0.25" in visitor.query)
        await visitor.press("undo")
        await visitor.until(lambda: "h=2" not in visitor.query)
        assert page.actuator.inputs().hours == ASSUMED_HOURS
        await visitor.press("redo")
        await visitor.until(lambda: "h=2,0.25,1,0.25" in visitor.query)
        assert page.context.layout.mode == "optimise"

    visited(app, set_and_undo)


def test_an_actuator_of_a_link_leaves_the_hours_of_the_link(app: App):
    async def opened(visitor: Visitor, page: Page) -> None:
        assert page.actuator.inputs().hours == (1.0, 1.0, 0.0, 2.0)
        assert page.actuator.inputs().drives[0] == 50.0

    visited(app, opened, "?actuator=MFC_P1,drive=50&h=1,1,0,2")


def test_the_nearest_that_trims_is_what_the_sentence_names_or_is_said_to_be_unknown(app: App):
    """In the vortex ring state no mass and no speed is named; in hover at 4000 m the largest mass is."""

    async def act(visitor: Visitor, page: Page) -> None:
        await visitor.press("slide", ["advance_ratio", 0.0])
        await visitor.press("slide", ["climb_m_s", -10.0])
        await visitor.until(lambda: "vortex ring" in visitor.frame["line"]["problem"])
        await visitor.press("nearest")
        await visitor.until(lambda: bool(visitor.notices))
        assert visitor.notices[-1].startswith("No nearest design is known: ")
        assert page.context.controls.inputs().climb_m_s == -10.0
        await visitor.press("slide", ["climb_m_s", 0.0])
        await visitor.press("slide", ["mass_t", 11.0])
        await visitor.press("slide", ["isa_offset_c", 35.0])
        await visitor.press("slide", ["altitude_m", 4000.0])
        await visitor.until(lambda: " t in hover" in visitor.frame["line"]["problem"])
        await visitor.press("nearest")
        await visitor.until(lambda: not visitor.frame["line"]["problem"])
        assert page.context.controls.inputs().mass_t < 11.0

    visited(app, act)
