"""Presentations: who hears what, one presenter, whose secret never stands in what its page shares."""

import asyncio
import re
from dataclasses import replace
from urllib.parse import quote

import pytest

from explorer.app import App
from explorer.hosting import browser
from explorer.model.inputs import OPENING, Inputs, ViewState
from explorer.model.session_state import ScreenState
from explorer.sharing.game import Game
from explorer.sharing.presentation import (
    FOLLOW,
    PRESENT,
    Presentations,
    PresentedView,
    follow_name,
    new_secret,
)
from explorer.sharing.share import DESIGN, code_of
from explorer.widgets.lecture.presentation_banner import PresentationBanner
from explorer.widgets.optimise.hand_game import GAME
from rotor import make_design
from tests.tools.visitor import Visitor, part_of, ran

QUICK = replace(OPENING, inflow="drees", elements=20, azimuths=36)
SHOWN = PresentedView(ScreenState(Inputs(), ViewState()))


@pytest.fixture
def scripts(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What the server has the page run."""
    found: list[str] = []
    monkeypatch.setattr(browser, "run_in_page", lambda client, script: found.append(script))
    return found


def test_no_address_and_no_clipboard_gets_the_secret(app: App, scripts: list[str]):
    async def visit() -> None:
        visitor = Visitor()
        await visitor.open(app.address)
        await visitor.until(lambda: len(app.sessions) == 1)
        page = app.sessions[0].page
        banner = part_of(page, PresentationBanner)
        await asyncio.to_thread(banner.present)
        page.file.copy_link()
        assert banner._secret
        await asyncio.sleep(1.0)
        await visitor.close()

    ran(visit)
    (kept,) = (script for script in scripts if script.startswith(f'RX.keep("{PRESENT}",'))
    secret = re.fullmatch(rf'RX\.keep\("{PRESENT}","([\w-]+)"\)', kept)
    shared = [script for script in scripts if script is not kept]
    assert any(f"?{FOLLOW}={follow_name(secret[1])}" in script for script in shared)
    assert not [script for script in shared if secret[1] in script]


def test_one_page_presents_and_a_duplicate_of_its_tab_follows(app: App):
    """A browser that duplicates a tab copies what it was given to keep, with the secret."""

    async def arrive(page: str) -> Visitor:
        visitor = Visitor(kept={PRESENT: "a-secret"}, page=page)
        await visitor.open(app.address)
        await visitor.until(lambda: "resent" in visitor.text("presentation"))
        return visitor

    async def visit() -> list[str]:
        first = await arrive("one")
        second = await arrive("two")
        said = [first.text("presentation"), second.text("presentation")]
        again = await arrive("one")  # Connected again, before the server knows that it was gone.
        said.append(again.text("presentation"))
        for visitor in (first, again):
            await visitor.close()
        while len(app.sessions) > 1:
            await asyncio.sleep(0.05)
        third = await arrive("three")  # Loaded again after the first was closed.
        said.append(third.text("presentation"))
        for visitor in (second, third):
            await visitor.close()
        return said

    first, second, again, third = ran(visit)
    assert first.startswith("Presenting: 1 follower")  # The second.
    assert second.startswith("Another tab of this browser is presenting; this one follows it.")
    assert again.startswith("Presenting: 1 follower")
    assert third.startswith("Presenting: 1 follower")


def test_followers_play_with_sliders_of_their_own_and_the_presenter_sees_what_they_reach(app: App):
    design = QUICK.design()
    start, least = (
        replace(design, twist=make_design(twist=twist).twist)
        for twist in ("linear:-16", "linear:-7.5")
    )
    game = Game(start, least)
    query = f"?{DESIGN}={quote(code_of(start))}&{GAME}={quote(game.code())}"

    async def visit() -> None:
        presenter = Visitor(query, kept={PRESENT: "a-secret"}, page="one")
        await presenter.open(app.address)
        await presenter.until(lambda: presenter.text("status") == "converged")
        follower = Visitor(f"?{FOLLOW}={follow_name('a-secret')}")
        await follower.open(app.address)
        await follower.until(lambda: "Your turn" in follower.text("presentation"))
        await follower.idle()
        (page,) = (session.page for session in app.sessions if session.page.optimise.hand.game == game and not
                   part_of(session.page, PresentationBanner)._secret)  # fmt: skip
        assert not page.context.held
        assert game.holds(page.context.inputs())
        await follower.move("Rate [°/R]", -8.0)
        await follower.idle()
        assert page.context.inputs().linear == -8.0  # The presenter's sliders do not lead these.
        standing = page.optimise.hand.standing
        assert standing is not None
        assert standing.best.power.total < standing.start.power.total
        reached = app.presentations._results[follow_name("a-secret")][1]
        assert [*reached.values()] == [standing.best.power.total]
        contents = presenter.widgets.values()
        await presenter.until(
            lambda: any("Each player's best" in str(each.get("content")) for each in contents)
        )
        await presenter.press("game_end")
        await follower.until(
            lambda: "the presenter controls this page" in follower.text("presentation")
        )
        await follower.idle()
        assert page.context.held
        assert page.context.inputs().linear == -16.0
        for visitor in (presenter, follower):
            await visitor.close()

    ran(visit)


class TestPresentations:
    def test_followers_hear_until_they_leave(self):
        presentations, secret = Presentations(), new_secret()
        presentations.claim(secret, "page", self)
        heard: list[PresentedView | str] = []
        leave = presentations.follow(follow_name(secret), heard.append)
        counted: list[int] = []
        presentations.watch(secret, lambda count, _: counted.append(count))
        first = SHOWN
        presentations.present(secret, first)
        presentations.present(secret, first)
        late: list[PresentedView | str] = []
        presentations.follow(follow_name(secret), late.append)
        assert heard == late == [first]
        leave()
        presentations.present(secret, PresentedView(ScreenState(Inputs(mass_t=9.0), ViewState())))
        presentations.end(secret)
        assert heard == [first]
        assert late[-1] == "over"
        assert counted == [1, 2, 1]

    def test_what_players_reach_is_told_until_another_game_begins(self):
        presentations, told = Presentations(), list[tuple[int, tuple[float, ...]]]()
        name, design = follow_name("s"), SHOWN.screen.inputs.design()
        first, second = Game(design, design), Game(design, design, design)
        presentations.claim("s", "page", self)
        presentations.watch("s", lambda count, results: told.append((count, tuple(results))))
        presentations.present("s", replace(SHOWN, game=first))
        for player, power in (("one", 9.0), ("two", 8.0), ("one", 7.0), ("one", 7.0)):
            presentations.report(name, player, power)
        assert told[2:] == [(0, (9.0,)), (0, (9.0, 8.0)), (0, (7.0, 8.0))]
        presentations.release(self)  # A presenter who loads the page again goes on with the game.
        presentations.claim("s", "page", self)
        presentations.watch("s", lambda count, results: told.append((count, tuple(results))))
        presentations.present("s", replace(SHOWN, game=first))
        assert told[-1] == (0, (7.0, 8.0))
        presentations.present("s", replace(SHOWN, game=second))
        assert told[-1] == (0, ())

    def test_one_that_fails_does_not_keep_it_from_the_others(
        self, caplog: pytest.LogCaptureFixture
    ):
        presentations, secret = Presentations(), new_secret()
        heard: list[PresentedView | str] = []

        def fails(_: PresentedView | str) -> None:
            raise RuntimeError("its browser has just left")

        presentations.claim(secret, "page", self)
        presentations.follow(follow_name(secret), fails)
        presentations.follow(follow_name(secret), heard.append)
        presentations.present(secret, SHOWN)
        assert heard == [SHOWN]
        assert "could not be updated" in caplog.text

    def test_the_name_does_not_tell_the_secret(self):
        presentations, secret = Presentations(), new_secret()
        heard: list[PresentedView | str] = []
        presentations.follow(follow_name(secret), heard.append)
        presentations.present(follow_name(secret), SHOWN)
        presentations.end(follow_name(secret))
        assert heard == ["away"]

    def test_a_presentation_has_one_presenter(self):
        presentations, one, two = Presentations(), object(), object()
        assert presentations.claim("s", "page", one)
        assert not presentations.claim("s", "other", two)
        assert not presentations.claim("s", "", two)
        assert presentations.claim("other", "other", two)
        presentations.release(one)
        assert presentations.claim("s", "other", two)

    def test_a_presenter_that_has_gone_is_not_kept_and_followers_are_told(self):
        """Its watcher belongs to its page, and so would keep the whole session alive. What it shows when it comes back
        is told again, though it is the same."""
        presentations, one = Presentations(), object()
        presentations.claim("s", "page", one)
        counts = list[int]()
        presentations.watch("s", lambda count, _: counts.append(count))
        heard: list[PresentedView | str] = []
        presentations.follow(follow_name("s"), heard.append)
        presentations.present("s", SHOWN)
        presentations.release(one)
        late: list[PresentedView | str] = []
        presentations.follow(follow_name("s"), late.append)
        assert counts == [0, 1]
        presentations.claim("s", "another", one)
        presentations.present("s", SHOWN)
        assert (heard, late) == ([SHOWN, "away", SHOWN], ["away", SHOWN])
