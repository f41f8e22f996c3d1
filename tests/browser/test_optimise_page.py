"""The optimiser in a real browser: to the end and applied, beaten by hand, and the map of power."""

import re
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Browser
from watched import WAIT, Watched, opened

from explorer.app import App
from explorer.charts.power_map import place_on
from explorer.model.inputs import Inputs, with_optimum
from explorer.session import Session
from explorer.widgets.optimise.map_panel import MapPanel
from rotor.trim.solve import solve
from tests.tools.visitor import part_of

START = Inputs()


def arrive(browser: Browser, app: App) -> tuple[Watched, Session]:
    known = app.sessions
    watched = opened(browser, app.address, size=(1280, 900))
    (new,) = (session for session in app.sessions if session not in known)
    return watched, new


@pytest.fixture(scope="module")
def shared(browser: Browser, app: App) -> "Iterator[tuple[Watched, Session]]":
    watched, session = arrive(browser, app)
    yield watched, session
    watched.close()


@pytest.fixture
def page(shared: tuple[Watched, Session]) -> Iterator[tuple[Watched, Session]]:
    """The shared page on its first design, no search under way, on the Optimise tab."""
    watched, session = shared
    watched.reset()
    watched.until(lambda: session.page.context.controls.inputs() == START)
    watched.page.wait_for_function("() => RX.state.notice === null")
    watched.mode("optimise")
    watched.section("Search")
    yield watched, session
    assert watched.complaints == []


def until(watched: Watched, *kinds: str) -> None:
    """Wait until a search stands so: its worker may have to be started first, which a busy machine does slowly."""
    selector = ", ".join(f'[data-explorer="search"][data-kind="{kind}"]' for kind in kinds)
    watched.page.wait_for_selector(selector, timeout=4 * WAIT)


def press(watched: Watched, name: str) -> None:
    """A button of the rail or of the bar over the scene, not the mode of the same name."""
    rail = watched.page.locator("[data-dock-region=right], [data-part=notice]")
    rail.get_by_role("button", name=name, exact=True).first.click()


def optimise(watched: Watched, session: Session) -> None:
    """Begin a search: what the page says from then on is not of the last one."""
    watched.answered()  # Another concept has other rows: the button moves with them.
    before = session.page.optimise.run
    press(watched, "Optimise")
    watched.until(lambda: session.page.optimise.run is not before)
    watched.drawn()


def run_of(session: Session) -> Any:
    run = session.page.optimise.run
    assert run is not None
    return run


@pytest.mark.slow
def test_an_optimum_is_shown_applied_and_has_the_power_that_solve_gives(
    page: tuple[Watched, Session],
):
    watched, session = page
    before, blade = watched.text("total-power"), watched.node("/rotor/blade_0")
    law = session.page.context.controls.inputs().law
    watched.choose("Concept", "Two segments")
    optimise(watched, session)
    until(watched, "done")
    # The picture and the sliders follow the search; the design is the user's own until it is applied.
    watched.until_changed(lambda: watched.text("total-power"), before)
    watched.until_changed(lambda: watched.node("/rotor/blade_0"), blade)
    assert session.page.context.controls.inputs().law == law
    run = run_of(session)
    watched.page.wait_for_function("() => RX.state.notice?.text.startsWith('Previewing optimum')")
    watched.mode("explore")
    shown = with_optimum(session.page.context.controls.inputs(), run.frames[-1].design)
    watched.until(lambda: watched.number("Inboard") == pytest.approx(shown.two_inner, abs=0.06))
    watched.mode("optimise")
    last = len(run.frames) - 1
    watched.page.wait_for_function(
        f"() => document.body.innerText.includes('step {last} of {last}')"
    )
    press(watched, "Apply")
    watched.page.wait_for_function("() => RX.state.notice === null")
    watched.until(
        lambda: session.page.context.controls.inputs().two_inner == pytest.approx(shown.two_inner)
    )
    design = session.page.context.controls.inputs().design()
    assert session.page.context.controls.inputs().law == "two"
    power = solve(design).power.total
    assert power == pytest.approx(run.optimum.best.power, rel=1e-6)
    assert power < run.start_power
    watched.until(lambda: watched.text("total-power").startswith(f"{power / 1e3:.0f}"))


@pytest.mark.slow
def test_the_search_is_beaten_by_hand_and_a_link_has_the_score(
    page: tuple[Watched, Session], browser: Browser, app: App
):
    watched, session = page
    begun = session.page.context.controls.inputs()
    watched.choose("Concept", "Two segments, free break point")
    optimise(watched, session)
    until(watched, "done")
    press(watched, "Beat it by hand")
    words = said(watched, r"^The search found \d+ kW, yours [\d.]+ ± [\d.]+ kW more")
    assert session.page.context.controls.inputs() == begun  # Where the page was.
    assert watched.page.locator("[data-do=game_link]").count() == 0  # Nothing is reached yet.
    watched.press("Outboard", "PageDown" if too_flat(session) else "PageUp", 1)
    watched.until(lambda: gap(said(watched, "more|less")) < gap(words))
    copied = watched.page.evaluate_handle(
        "() => { const said = []; RX.copy = text => said.push(text); return said; }"
    )
    watched.page.locator("[data-do=game_link]").click()
    watched.until(lambda: copied.evaluate("said => said.length"))
    reached = session.page.optimise.hand.standing
    assert reached is not None
    other = opened(browser, copied.evaluate("said => said[0]"), size=(1280, 900), query="")
    try:
        score = f"{reached.best.power.total / 1e3:.0f}"
        beaten = said(other, rf"^To beat {score} kW · The search found.* ± ")
        assert gap(beaten) == pytest.approx(gap(words), abs=0.11)
        other.press("Adv. ratio", "ArrowRight", 1)  # In another flight there is nothing to compare.
        other.page.wait_for_function("() => RX.state.notice === null")
        other.press("Adv. ratio", "ArrowLeft", 1)
        said(other, "more|less")
        other.page.locator("[data-do=game_take]").click()
        other.page.wait_for_function(
            "() => RX.state.notice === null && !location.search.includes('game=')"
        )
        least = reached.least.power.total
        other.until(lambda: other.text("total-power").startswith(f"{least / 1e3:.0f}"))
    finally:
        other.close()
    press(watched, "End")
    watched.page.wait_for_function(
        "() => RX.state.notice === null && !location.search.includes('game=')"
    )


def too_flat(session: Session) -> bool:
    """Whether the blade at which the game begins is flatter outboard than the search's."""
    standing = session.page.optimise.hand.standing
    assert standing is not None
    start, least = (
        np.ptp(one.design.twist(np.array([0.75, 1.0]))) for one in (standing.start, standing.least)
    )
    return bool(start < least)


def notice(watched: Watched) -> str:
    """The bar over the scene."""
    return str(watched.page.evaluate("() => RX.state.notice?.text ?? ''"))


def said(watched: Watched, words: str) -> str:
    """What it says, once it matches."""
    watched.until(lambda: re.search(words, notice(watched)))
    return notice(watched)


def gap(words: str) -> float:
    """[kW] that one's own blade needs more."""
    return float(re.findall(r"yours (\d+(?:\.\d)?)", words)[0])  # Its band may come later.


@pytest.mark.slow
def test_a_map_says_its_least_power_is_clicked_and_is_begun_anew(page: tuple[Watched, Session]):
    watched, session = page
    watched.choose("Concept", "Two segments, free break point")
    watched.section("Map")
    press(watched, "Compute map")
    watched.reads("map-least", r"Least [\d\s.]+ kW at")
    watched.reads("map-state", r"^\d+ × \d+ points, at µ")
    power_map = part_of(session.page, MapPanel)
    first = power_map.map
    assert first is not None
    watched.page.locator("[data-map]").click(position={"x": 80.0, "y": 60.0})
    watched.until(lambda: session.page.context.controls.inputs() != START)
    place = place_on(first, session.page.context.controls.inputs().design().twist)
    assert place is not None
    box = watched.box("[data-map]")
    assert place == pytest.approx((80.0 / box["width"], 1.0 - 60.0 / box["height"]), abs=0.01)
    press(watched, "Compute map")
    watched.until(
        lambda: power_map.map is not first and not session.page.context.work["map"].under_way
    )
