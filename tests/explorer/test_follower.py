"""Panels on their way to a page, without one: asked, viewed, sent and pressed."""

from collections.abc import Mapping
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from explorer.model.inputs import OPENING
from explorer.tabs.background import PoolAnswers
from explorer.tabs.follower import Follower
from explorer.views.now import Asked, Drag, Effect, Grab, Now, Panel, Put, Ui
from explorer.workers.call import Call

NOW = Now(OPENING, None, None)
LENGTH = Call(len, ("four",))


def shown(now: Now) -> Mapping[str, Any]:
    """A part that follows the speed, a text that follows the answer, and a part that stays."""
    return {"power": now.inputs.advance_ratio, "notice": "", "words": now.answers.get(LENGTH, "computing")}


def pressed(now: Now, value: Any) -> tuple[Effect, ...]:
    return Grab(False), Drag(replace(now.inputs, advance_ratio=value)), Put(now.inputs)


class Page:
    """What a follower needs of a page, and what it did there."""

    def __init__(self, *panels: Panel) -> None:
        self.sent: list[dict[str, Any]] = []
        self.words: list[str] = []
        self.done: list[Effect] = []
        self.presses: dict[str, Any] = {}
        self.now = NOW
        bridge: Any = SimpleNamespace(on=self.presses.__setitem__, set=lambda **parts: self.sent.append(parts))
        texts, pool = {"words": self.words.append}, Any

        def now() -> Now:
            return self.now

        self.follower = Follower(panels, bridge, texts, pool, lambda: None, now, now, self.done.append)  # pyright: ignore[reportArgumentType]


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[tuple[int, tuple[Call, ...], float, bool]]:
    """What is asked of worker processes."""
    all_asked: list[tuple[int, tuple[Call, ...], float, bool]] = []
    monkeypatch.setattr(PoolAnswers, "ask", lambda self, *how: all_asked.append((self._urgency, *how)))
    return all_asked


def test_only_what_changed_is_sent():
    page = Page(Panel(shown))
    page.follower.follow(NOW)
    page.follower.follow(NOW)
    assert (page.sent, page.words) == ([{"power": OPENING.advance_ratio, "notice": ""}], ["computing"])
    page.follower.follow(replace(NOW, inputs=replace(OPENING, advance_ratio=0.1), answers={LENGTH: "4"}))
    assert (page.sent[1:], page.words) == ([{"power": 0.1}], ["computing", "4"])


def test_only_panels_that_are_seen_are_called(asked: list[Any]):
    """Opened again, one is whole; what a hidden one had asked is asked no longer."""
    panel = Panel(shown, lambda ui: ui.drawer == "details", lambda now: (Asked(4, (LENGTH,), 0.2),))
    page = Page(panel)
    page.follower.follow(NOW)
    assert (page.sent, asked) == ([], [])
    opened = replace(NOW, ui=Ui(drawer="details"))
    page.follower.follow(opened)
    page.follower.follow(replace(opened, answers={LENGTH: 4}))  # Nothing has moved.
    page.follower.follow(replace(NOW, inputs=replace(OPENING, advance_ratio=0.1)))
    assert asked == [(4, (LENGTH,), 0.2, False), (4, (LENGTH,), 0.2, False), (4, (), 0.0, True)]
    assert len(page.sent) == 1
    page.follower.follow(replace(opened, inputs=replace(OPENING, advance_ratio=0.1)))
    assert page.sent[1:] == [{"power": 0.1}]


def test_a_press_does_what_it_says_but_while_the_page_is_held_it_only_lets_go():
    page = Page(Panel(shown, presses={"speed": pressed}))
    page.presses["speed"](0.2)
    assert page.done == [Grab(False), Drag(replace(OPENING, advance_ratio=0.2)), Put(OPENING)]
    page.done.clear()
    page.now = replace(NOW, ui=Ui(held=True))
    page.presses["speed"](0.2)
    assert page.done == [Grab(False)]


def test_answers_are_those_of_every_page_and_failures_those_of_this_one(monkeypatch: pytest.MonkeyPatch):
    page = Page(Panel(shown, asks=lambda now: (Asked(4, (LENGTH,), 60.0),)))
    page.follower.follow(NOW)
    assert LENGTH not in page.follower.answers()
    monkeypatch.setattr(PoolAnswers, "failures", {LENGTH: "It cannot be told."})
    assert page.follower.answers()[LENGTH] == "It cannot be told."
    monkeypatch.setattr("explorer.tabs.follower.all_known", lambda: {LENGTH: 4})
    assert page.follower.answers()[LENGTH] == 4
    page.follower.stop()
