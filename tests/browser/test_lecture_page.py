"""The lecture and the presenter on the real page."""

import re
from typing import TYPE_CHECKING

import pytest
from test_session_page import design_in_address, shown_kw
from watched import COARSE, WAIT, opened

from explorer.app import App
from explorer.tabs.lecture.steps import STEPS

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = pytest.mark.browser


def stands_at(page: "Page", step: int) -> None:
    page.wait_for_selector(f'[data-explorer="lecture"][data-step="{step}"]', timeout=WAIT)
    page.wait_for_function(
        """() => /\\d/.test(document.querySelector('[data-explorer="said"]').innerText)""", timeout=WAIT
    )


def test_the_lecture_sets_the_page_and_says_what_is_seen(browser: "Browser", app: App):
    watched = opened(browser, app.address)
    page = watched.page
    page.get_by_role("tab", name="Lecture").click()
    page.get_by_role("button", name="Start the lecture").click()
    stands_at(page, 1)
    design_in_address(watched, "d=1;uh60a")
    page.get_by_role("button", name="Next").click()
    stands_at(page, 2)
    design_in_address(watched, "linear:-16;mu=0")
    said = watched.text("said")
    assert said.startswith("Induced power: A ")
    page.get_by_role("tab", name="Design").click()
    watched.type("Rate", -10)
    assert watched.until_changed(lambda: watched.text("said"), said).startswith("Induced power: A ")
    page.keyboard.press("Escape")
    for k in range(3, len(STEPS) + 1):
        page.keyboard.press("PageDown")
        stands_at(page, k)
    assert page.get_by_role("tab", name="Actuator").get_attribute("aria-selected") == "true"
    page.keyboard.press("PageUp")
    stands_at(page, len(STEPS) - 1)
    page.get_by_role("button", name="End", exact=True).click()
    page.wait_for_selector('[data-explorer="lecture"]', state="detached", timeout=WAIT)
    page.get_by_role("tab", name="Lecture").click()
    page.get_by_label("Big type").check()
    page.wait_for_function(
        """() => parseFloat(getComputedStyle(document.querySelector('[data-explorer="total-power"]')).fontSize) > 30""",
        timeout=WAIT,
    )
    assert watched.complaints == []
    watched.close()


def test_the_caption_leaves_a_tablets_rotor_and_controls_in_sight(browser: "Browser", app: App):
    watched = opened(browser, app.address, size=(1024, 768))
    page = watched.page
    page.keyboard.press("t")
    stands_at(page, 1)
    page.keyboard.press("PageDown")
    stands_at(page, 2)
    page.wait_for_function(  # Wanted before there was an A.
        """() => document.evaluate("//label[.='Show B − A']/ancestor::div[contains(@class,'Flex-root')][1]//input",
            document, null, 9).singleNodeValue?.checked""",
        timeout=WAIT,
    )
    # At its middle each is what is seen there: nothing lies over it.
    seen = """e => { const box = e.getBoundingClientRect();
        return e.contains(document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2)); }"""
    for label in ("Rate", "Adv. ratio"):
        assert watched.row(label).get_by_role("slider").evaluate(seen), label
    assert page.locator(".rx-said").evaluate(seen)
    assert page.get_by_role("button", name="Next", exact=True).evaluate(seen)
    scene, caption = page.locator("canvas[data-engine]"), page.locator('[data-explorer="lecture"]')
    reaches = scene.evaluate("e => e.getBoundingClientRect().right")
    assert caption.evaluate("e => e.getBoundingClientRect().left") >= reaches
    watched.close()


def test_with_four_blades_a_step_compares_four_with_four(browser: "Browser", app: App):
    """What the step says of them must be seen: the same twist costs nothing."""
    watched = opened(browser, app.address)
    page = watched.page
    page.keyboard.press("t")
    for k in range(1, 5):
        stands_at(page, k)
        page.keyboard.press("PageDown")
    stands_at(page, 5)
    before = watched.at_rest(lambda: watched.text("said"))
    assert "(+1" in before
    page.get_by_label("Infinite blades").uncheck()
    watched.until_changed(lambda: watched.text("said"), before)
    after = watched.at_rest(lambda: watched.text("said"))
    change = re.search(r"\(([+−][\d.]+)", after)
    assert change is not None
    assert float(change[1].replace("−", "-")) < 1.0
    assert "different models" not in watched.text("status")
    watched.close()


def test_others_follow_the_presenter_and_may_leave(browser: "Browser", app: App):
    presenter = opened(browser, app.address)
    page = presenter.page
    page.get_by_role("tab", name="Lecture").click()
    page.get_by_role("button", name="Present", exact=True).click()
    page.wait_for_function("() => location.search.includes('present=')", timeout=WAIT)
    link = presenter.page.locator('[data-explorer="presence"] a').get_attribute("href")
    assert link is not None
    name = link.removeprefix("?follow=")
    assert name not in page.url  # The address holds the presenter's secret, the link does not.
    follower = opened(browser, app.address, COARSE + f"&follow={name}")
    other = follower.page
    assert "moves by itself" in follower.text("presence")
    page.wait_for_function(
        """() => document.querySelector('[data-explorer="presence"]').innerText.includes('1 follows')""", timeout=WAIT
    )
    before = shown_kw(follower)
    page.get_by_role("tab", name="Design").click()
    presenter.type("Adv. ratio", 0.3)
    assert follower.until_changed(lambda: shown_kw(follower), before) == presenter.until_changed(
        lambda: shown_kw(presenter), before
    )
    follower.type("Adv. ratio", 0.2)  # Read-only: it goes back.
    here = shown_kw(presenter)
    other.wait_for_timeout(1500)
    other.wait_for_function(
        "text => document.querySelector('[data-explorer=\"total-power\"]').innerText.startsWith(text)",
        arg=here,
        timeout=WAIT,
    )
    design_in_address(follower, "mu=0.3")
    other.keyboard.press("Escape")
    for key in ("h", "t", "p"):  # Nor do its keys move it, nor its buttons.
        other.keyboard.press(key)
    assert not other.get_by_role("button", name="Pin as A").is_visible()
    other.wait_for_timeout(1500)
    assert other.locator('[data-explorer="lecture"]').count() == 0
    assert "mu=0.3" in other.url
    assert "&a=" not in other.url
    other.get_by_role("button", name="Leave, and go on alone").click()
    other.wait_for_function("() => !location.search.includes('follow=')", timeout=WAIT)
    there = shown_kw(follower)
    presenter.type("Adv. ratio", 0.1)
    presenter.until_changed(lambda: shown_kw(presenter), there)
    other.wait_for_timeout(500)
    assert shown_kw(follower) == there
    follower.type("Adv. ratio", 0.2)
    follower.until_changed(lambda: shown_kw(follower), there)
    assert presenter.complaints == follower.complaints == []
    follower.close()
    presenter.close()
