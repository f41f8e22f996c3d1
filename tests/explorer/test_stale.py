"""What belongs to other inputs than those that are set has one mark, from the change of an input to its answer."""

import re
from collections.abc import Callable, Coroutine, Iterator
from pathlib import Path
from typing import Any

import pytest

from explorer.app import App
from explorer.page import Page
from explorer.text.readout import outdated
from rotor.support.markup import Markup
from tests.tools.visitor import Visitor, arrived, ran

EXPLORER = Path(__file__).parents[2] / "explorer"
SPAN = "Δ outboard [°/R]"


@pytest.fixture(scope="module")
def app() -> Iterator[App]:
    app = App("127.0.0.1", 0)
    yield app
    app.stop()


def visited(app: App, act: Callable[[Visitor, Page], Coroutine[Any, Any, None]]) -> None:
    """Do this on a page that rests."""

    async def visit() -> None:
        visitor = await arrived(app.address)
        await visitor.idle(wholly=False)
        try:
            await act(visitor, app.sessions[-1].page)
        finally:
            await visitor.close()

    ran(visit)


def words(visitor: Visitor) -> str:
    return "".join(piece["text"] for piece in visitor.frame["line"]["pieces"])


async def marked(
    visitor: Visitor, page: Page, change: Callable[[], Coroutine[Any, Any, None]], new: str
) -> None:
    """After a change all has the mark before anything is computed, and none once the answer is there."""
    assert visitor.frame.get("stale", False) is False
    before = words(visitor)
    assert new not in before
    with page.context.whole:  # No update reads what is set.
        await change()
        await visitor.until(lambda: visitor.frame.get("stale") is True)
        assert words(visitor) == before
    await visitor.until(lambda: visitor.frame["stale"] is False)
    assert new in words(visitor)
    await visitor.idle(wholly=False)
    assert visitor.frame["stale"] is False
    assert new in words(visitor)


def test_the_mark_is_there_from_the_change_to_the_answer(app: App):
    async def act(visitor: Visitor, page: Page) -> None:
        await marked(visitor, page, lambda: visitor.move(SPAN, -2.0), "−2.0")
        # Undo, and a view that no answer depends on.
        await marked(visitor, page, lambda: visitor.press("undo"), "as built needs")
        await visitor.press("field", "Lift")
        await visitor.press("azimuth", 30.0)
        await visitor.idle(wholly=False)
        assert visitor.frame["stale"] is False
        await visitor.press("mode", "actuate")
        await visitor.idle(wholly=False)
        assert "with MFC P1 at" in words(visitor)
        await marked(visitor, page, lambda: visitor.press("kind", "AFC"), "with AFC at")
        await marked(visitor, page, lambda: visitor.press("slide", ["drive 0", 40]), "at 40")

    visited(app, act)


def test_until_a_band_is_known_the_last_one_has_the_mark(app: App):
    async def act(visitor: Visitor, page: Page) -> None:
        seen = list[tuple[str, bool]]()

        def within() -> tuple[str, bool]:
            return next(
                ((one["text"], one["stale"]) for one in visitor.frame["line"]["pieces"] if one["part"] == "within"),
                ("", True),
            )  # fmt: skip

        first = within()
        assert not first[1]
        await visitor.move("Adv. ratio µ", 0.3)
        await visitor.until(lambda: "µ 0.300" in words(visitor))

        def follow() -> bool:
            seen.append(within())
            return not seen[-1][1]

        await visitor.until(follow)
        await visitor.idle(wholly=False)
        assert within()[0] != first[0]
        # What stood there before its own came is the band of µ 0.2, and says so.
        assert all(stale == (text == first[0]) for text, stale in seen)

    visited(app, act)


def test_there_is_one_mark_and_one_function_that_sets_it():
    sources = {path: path.read_text() for path in (EXPLORER / "web").glob("*.*")}
    setters = (
        "toggleAttribute('data-stale'",
        "setAttribute('data-stale'",
        " data-stale aria-description",
    )
    found = {path.name for path, text in sources.items() if any(one in text for one in setters)}
    assert found == {"common.js"}
    word = re.search(r"const STALE = '(.+)';", sources[EXPLORER / "web" / "common.js"])
    assert word is not None
    assert outdated(Markup("x")) == (
        f'<div data-stale role="group" aria-description="{word[1]}">x</div>'
    )
    python = "".join(path.read_text() for path in EXPLORER.rglob("*.py"))
    assert not re.search(r"rxf-faded|rxf-stale|rx-faded", python + "".join(sources.values()))
