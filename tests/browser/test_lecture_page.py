"""The lecture and the presenter on the real page."""

from dataclasses import replace
from typing import TYPE_CHECKING

import pytest
from explorer.tabs.lecture.steps import STEPS
from test_session_page import design_in_address, shown_kw
from watched import COARSE, Visit

from explorer.app import App

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = pytest.mark.browser


def stands_at(page: "Page", step: int) -> None:
    page.wait_for_selector(f'[data-explorer="lecture"][data-step="{step}"]')
    page.wait_for_function("""() => /\\d/.test(document.querySelector('[data-explorer="said"]').innerText)""")


def test_the_lecture_sets_the_page_and_says_what_is_seen(visit: Visit):
    watched = visit()
    page = watched.page
    watched.drawer("lecture")
    watched.type("Adv. ratio", 0.22)
    own = "d=1;uh60a;mu=0.22"
    design_in_address(watched, own)
    page.get_by_role("button", name="Start the lecture").click()
    stands_at(page, 1)
    page.wait_for_function("() => !location.search.includes('mu=')")
    page.get_by_role("button", name="Next").click()
    stands_at(page, 2)
    design_in_address(watched, "linear:-16;mu=0")
    watched.answered()
    said = watched.reads("said", "^Induced power: A ")
    page.evaluate("() => RX.send('knot', ['1', [1.0, -3.0]])")  # The curve's handle moves the rate.
    watched.until_changed(lambda: watched.text("said"), said)
    watched.reads("said", "^Induced power: A ")
    for k in range(3, len(STEPS) + 1):
        page.keyboard.press("PageDown")
        stands_at(page, k)
    page.wait_for_function("() => RX.state.bar.mode === 'actuate'")
    page.keyboard.press("PageUp")
    stands_at(page, len(STEPS) - 1)
    page.get_by_role("button", name="End", exact=True).click()
    page.wait_for_selector('[data-explorer="lecture"]', state="hidden")
    design_in_address(watched, own)  # The visitor's own design is back.
    watched.drawer("settings")
    page.get_by_label("Big type").check()
    page.wait_for_function(
        """() => parseFloat(getComputedStyle(document.querySelector('[data-explorer="drawer"]')).fontSize) > 16"""
    )


@pytest.mark.slow
def test_with_another_inflow_a_step_compares_like_with_like(visit: Visit, app: App):
    """What the step says of twist must be seen: with linear inflow it hardly saves."""
    watched = visit()
    page = watched.page
    page.keyboard.press("t")
    for k in range(1, 4):
        stands_at(page, k)
        page.keyboard.press("PageDown")
    stands_at(page, 4)
    inputs = app.sessions[-1].page.context.inputs()
    app.sessions[-1].page.context.set_inputs(replace(inputs, inflow="pitt-peters"))
    watched.reads("said", r"induced [+−]?0\skW")  # First the design, then A has the other inflow.
    page.wait_for_function("() => !RX.state.power.status.title.includes('different models')")


@pytest.mark.slow
def test_others_follow_the_presenter_and_may_leave(visit: Visit):
    presenter = visit()
    page = presenter.page
    presenter.drawer("lecture")
    page.get_by_role("button", name="Present", exact=True).click()
    page.wait_for_selector('[data-explorer="presence"] a')
    link = presenter.page.locator('[data-explorer="presence"] a').get_attribute("href")
    assert link is not None
    name = link.removeprefix("?follow=")
    present = "() => JSON.parse(sessionStorage.getItem('rx-kept') ?? '{}').present"
    secret = page.wait_for_function(present).json_value()
    assert secret not in page.url  # Whoever is sent the address must not become the presenter.
    page.reload()
    page.wait_for_selector('[data-explorer="presence"] a')  # The page itself presents on.
    assert page.locator('[data-explorer="presence"] a').get_attribute("href") == link
    follower = visit(COARSE + f"&follow={name}")
    other = follower.page
    follower.reads("presence", "controlled by the presenter")
    page.wait_for_function(
        """() => document.querySelector('[data-explorer="presence"]').innerText.includes('1 follower')"""
    )
    before = shown_kw(follower)
    presenter.type("Adv. ratio", 0.3)
    presenter.until_changed(lambda: shown_kw(presenter), before)
    design_in_address(presenter, "mu=0.3")
    presenter.answered()
    shown = shown_kw(presenter)
    assert shown != before
    follower.until(lambda: shown_kw(follower) == shown)
    follower.type("Adv. ratio", 0.2)  # Read-only: it goes back.
    here = shown_kw(presenter)
    follower.answered()
    follower.until(lambda: shown_kw(follower) == here)
    design_in_address(follower, "mu=0.3")
    other.keyboard.press("Escape")
    for key in ("h", "t", "p"):  # Nor do its keys move it, nor its buttons.
        other.keyboard.press(key)
    follower.until(other.get_by_role("button", name="Pin A").is_disabled)
    follower.answered()
    assert not other.locator('[data-explorer="lecture"]').is_visible()
    design_in_address(follower, "mu=0.3")
    assert "&a=" not in other.url
    other.get_by_role("button", name="Leave and continue alone").click()
    other.wait_for_function("() => !location.search.includes('follow=')")
    there = shown_kw(follower)
    presenter.type("Adv. ratio", 0.1)
    presenter.until_changed(lambda: shown_kw(presenter), there)
    presenter.answered()
    follower.answered()
    assert shown_kw(follower) == there
    follower.type("Adv. ratio", 0.2)
    follower.until_changed(lambda: shown_kw(follower), there)
