"""Panels on their way to a page, without one: asked, viewed, sent and pressed."""

from collections import deque
from collections.abc import Callable, Generator, Mapping
from dataclasses import replace
from functools import partial
from types import SimpleNamespace
from typing import Any

import pytest
from fake_bridge import PanelPage

from explorer.model.inputs import OPENING
from explorer.views.page_state import (
    Effect,
    MoveSliders,
    OpenPanels,
    PageState,
    Panel,
    PanelWork,
    Questions,
    SetGrabbed,
    Tell,
)
from explorer.workers.background import PoolAnswers
from explorer.workers.call import Call

NOW = PageState(OPENING, None, None)
LENGTH = Call(len, ("four",))


def shown(now: PageState) -> Mapping[str, Any]:
    """A part that follows the speed, a text that follows the answer, and a part that stays."""
    return {
        "power": now.inputs.advance_ratio,
        "notice": "",
        "words": now.answers.get(LENGTH, "computing"),
    }


def pressed(now: PageState, value: Any) -> tuple[Effect, ...]:
    return (
        SetGrabbed(False),
        MoveSliders(replace(now.inputs, advance_ratio=value)),
        MoveSliders(now.inputs, by_hand=False),
    )


def page_of(*panels: Panel) -> PanelPage:
    return PanelPage(*panels, texts=("words",))


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[tuple[int, tuple[Call, ...], float]]:
    """What is asked of worker processes; the clock stands still."""
    all_asked: list[tuple[int, tuple[Call, ...], float]] = []
    monkeypatch.setattr("explorer.views.panel_updater.time", SimpleNamespace(monotonic=lambda: 7.0))
    monkeypatch.setattr(
        PoolAnswers, "ask", lambda self, *how: all_asked.append((self._urgency, *how))
    )
    return all_asked


def test_only_what_changed_is_sent():
    page = page_of(Panel(shown))
    page.follow(NOW)
    page.follow(NOW)
    assert (page.bridge.sent, page.words) == (
        [{"power": OPENING.advance_ratio, "notice": ""}],
        ["computing"],
    )
    page.follow(replace(NOW, inputs=replace(OPENING, advance_ratio=0.1), answers={LENGTH: "4"}))
    assert (page.bridge.sent[1:], page.words) == ([{"power": 0.1}], ["computing", "4"])


def test_only_panels_that_are_seen_are_called(asked: list[Any]):
    """The parts of a hidden one are sent as absent, once; what it had asked is asked no longer. Opened again, one is
    whole."""
    panel = Panel(
        shown, lambda ui: ui.drawer == "details", lambda now: (Questions(4, (LENGTH,), 0.2),)
    )
    page = page_of(panel)
    page.follow(NOW)
    assert (page.bridge.sent, asked) == ([], [])
    opened = replace(NOW, ui=OpenPanels(drawer="details"))
    page.follow(opened)
    page.follow(replace(opened, answers={LENGTH: 4}))
    for _ in range(2):
        page.follow(replace(NOW, inputs=replace(OPENING, advance_ratio=0.1)))
    assert asked == [(4, (LENGTH,), 0.2), (4, (LENGTH,), 0.2), (4, (), 0.0), (4, (), 0.0)]
    assert page.bridge.sent[1:] == [{"power": None, "notice": None}]
    page.follow(replace(opened, inputs=replace(OPENING, advance_ratio=0.1)))
    assert page.bridge.sent[2:] == [{"power": 0.1, "notice": ""}]
    assert page.words == ["computing", 4, "computing"]


def test_a_question_waits_only_as_long_as_hands_have_not_been_still(
    asked: list[Any], monkeypatch: pytest.MonkeyPatch
):
    """Opened on a page at rest, it is worked on at once; what lifts the blade out is no hand."""
    clock = iter((7.0, 7.05, 9.0, 9.1, 9.2))
    page = page_of(Panel(shown, asks=lambda now: (Questions(4, (LENGTH,), 0.2),)))
    monkeypatch.setattr(
        "explorer.views.panel_updater.time", SimpleNamespace(monotonic=lambda: next(clock))
    )
    page.follow(NOW)
    page.follow(replace(NOW, ui=OpenPanels(lifted=True)))
    page.follow(replace(NOW, inputs=replace(OPENING, advance_ratio=0.1)))
    assert [round(delay, 3) for _, _, delay in asked] == [0.15, 0.0, 0.1]


def test_a_press_does_what_it_says_but_where_its_panel_is_not_seen_it_only_lets_go():
    page = page_of(Panel(shown, lambda ui: ui.mode == "explore", presses={"pull": pressed}))
    page.bridge.press("pull", 0.2)
    assert page.done == [
        SetGrabbed(False),
        MoveSliders(replace(OPENING, advance_ratio=0.2)),
        MoveSliders(OPENING, by_hand=False),
    ]
    page.done.clear()
    page.now = replace(NOW, ui=OpenPanels("optimise"))
    page.bridge.press("pull", 0.2)
    assert page.done == [SetGrabbed(False)]


def test_answers_are_those_of_every_page_and_failures_those_of_this_one(
    monkeypatch: pytest.MonkeyPatch,
):
    page = page_of(Panel(shown, asks=lambda now: (Questions(4, (LENGTH,), 60.0),)))
    page.follow(NOW)
    assert LENGTH not in page.updater.answers()
    monkeypatch.setattr(PoolAnswers, "failures", {LENGTH: "It cannot be told."})
    assert page.updater.answers()[LENGTH] == "It cannot be told."
    monkeypatch.setattr("explorer.views.panel_updater.all_known", lambda: {LENGTH: 4})
    assert page.updater.answers()[LENGTH] == 4
    page.updater.stop()


def counting(name: str, of: float, soon: bool, steps: list[str]) -> PanelWork:
    """Work of three steps, each of which is written down."""

    def run(tell: Tell) -> Generator[None, None, float]:
        for _ in range(3):
            yield
            steps.append(name)
            tell()
        return of

    return PanelWork(name, (of,), run, soon)


class TestWork:
    @pytest.fixture
    def steps(self) -> list[str]:
        return []

    @pytest.fixture
    def page(self, steps: list[str]) -> PanelPage:
        """Of two panels: one whose work comes late, one in a drawer, whose work comes soon."""

        def panel(
            name: str, soon: bool, seen: Callable[[OpenPanels], bool] = lambda ui: True
        ) -> Panel:
            def works(now: PageState) -> tuple[PanelWork, ...]:
                return (counting(name, now.inputs.advance_ratio, soon, steps),)

            def view(now: PageState) -> Mapping[str, Any]:
                (asked,) = works(now)
                return {name: (*now.latest(asked), steps.count(name))}

            return Panel(view, seen, works=works)

        page = page_of(
            panel("strip", False), panel("power", True, lambda ui: ui.drawer == "details")
        )
        page.now = replace(NOW, ui=OpenPanels(drawer="details"))
        return page

    def test_what_comes_soon_comes_first_and_every_step_is_shown(
        self, page: PanelPage, steps: list[str]
    ):
        deque(page.updater.work(soon=True))
        assert steps == ["power"] * 3
        deque(page.updater.work(soon=False))
        assert steps == ["power"] * 3 + ["strip"] * 3
        mu = OPENING.advance_ratio
        told = [(None, False, 1), (None, False, 2), (None, False, 3), (mu, True, 3)]
        assert page.bridge.sent == [{name: value} for name in ("power", "strip") for value in told]

    def test_every_panel_that_wants_it_shows_what_was_done_once(self, steps: list[str]):
        work = counting("power", 1.0, True, steps)
        views = [
            partial(lambda name, now: {name: work.key in now.answers}, name)
            for name in ("power", "strip")
        ]
        page = page_of(*(Panel(view, works=lambda now: (work,)) for view in views))
        page.updater._now = lambda: replace(NOW, answers=page.updater.answers())
        deque(page.updater.work(soon=True))
        assert steps == ["power"] * 3
        assert page.bridge.sent[-1] == {"power": True, "strip": True}

    def test_what_is_interrupted_goes_on_and_what_is_done_is_not_done_again(
        self, page: PanelPage, steps: list[str]
    ):
        interrupted = page.updater.work(soon=True)
        next(interrupted)
        next(interrupted)
        del interrupted
        assert steps == ["power"]
        for _ in range(2):
            deque(page.updater.work(soon=True))
            assert steps == ["power"] * 3

    def test_a_result_is_kept_while_it_is_wanted_and_the_last_one_remembered(
        self, page: PanelPage, steps: list[str]
    ):
        deque(page.updater.work(soon=True))
        at = "power", OPENING.advance_ratio
        assert page.updater.answers()[at] == OPENING.advance_ratio
        page.now = replace(page.now, inputs=replace(OPENING, advance_ratio=0.1))
        next(page.updater.work(soon=False))
        assert at not in page.updater.answers()
        (asked,) = page.updater._panels[1].works(page._now())
        assert page._now().latest(asked) == (OPENING.advance_ratio, False)
        deque(page.updater.work(soon=True))
        assert page._now().latest(asked) == (0.1, True)
