"""Browsers that do less: no WebGL, a context that is lost, nothing stored."""

import re

import pytest
from chromium import DRAW_NOTHING, LAUNCH_ARGUMENTS
from playwright.sync_api import Browser, Page
from watched import COARSE, Watched

from explorer.app import App

FORBID_STORAGE = """
const get = () => { throw new DOMException('denied', 'SecurityError'); };
for (const name of ['localStorage', 'sessionStorage']) Object.defineProperty(window, name, {get, configurable: true});
"""
"""As Chromium does where cookies are blocked."""
SENTENCE = ".rxf-views p"


def change_power(watched: Watched) -> None:
    """A slider that is moved changes the power that is read."""
    before = watched.text("total-power")
    watched.press("Adv. ratio", "ArrowRight", 5)
    watched.until_changed(lambda: watched.text("total-power"), before)


def plan_is_drawn(page: Page) -> bool:
    """Whether the plan of the disk has outlines and colours."""
    return page.evaluate(
        """() => {
            const plan = document.querySelector('[data-part=plan]');
            const [canvas] = plan.querySelector('[data-colours]').shadowRoot.children;
            const {data} = canvas.getContext('2d').getImageData(canvas.width / 2, canvas.height / 4, 9, 1);
            return !plan.hidden && plan.querySelectorAll('svg path').length > 5 && data.some(value => value);
        }"""
    )


@pytest.mark.parametrize("size", [(1280, 720), (390, 844)])
def test_without_webgl_all_but_the_scene_works(
    browser: Browser, chromium_path: str, app: App, size: tuple[int, int]
):
    arguments = [*LAUNCH_ARGUMENTS, "--disable-3d-apis"]
    poor = browser.browser_type.launch(executable_path=chromium_path, args=arguments)
    try:
        watched = Watched(poor.new_page(viewport={"width": size[0], "height": size[1]}))
        page = watched.page
        watched.open(app.address)
        assert "No 3D: this browser has no WebGL." in page.inner_text(SENTENCE)
        watched.until(lambda: plan_is_drawn(page))
        change_power(watched)
        watched.mode("optimise")
        watched.mode("actuate")
        watched.reads("line", r"with MFC")
        watched.until(lambda: plan_is_drawn(page))
        assert re.search(r"(?s)moves [+−]?\d.*\d+ kg", page.inner_text("[data-part=verdict]"))
        watched.drawer("share")
        page.get_by_role("button", name="Picture", exact=True).click()
        page.get_by_text("This browser draws no 3D").wait_for()
        assert not watched.complaints
    finally:
        poor.close()


def test_a_lost_context_is_said_and_comes_back(browser: Browser, app: App):
    watched = Watched(browser.new_page())
    page = watched.page
    watched.open(app.address)
    page.evaluate(
        "() => (window.__taken = window.__viserMutable.canvas.getContext('webgl2').getExtension('WEBGL_lose_context'))"
        ".loseContext()"
    )
    page.wait_for_selector(SENTENCE)
    assert "lost the 3D view" in page.inner_text(SENTENCE)
    watched.until(lambda: plan_is_drawn(page))
    change_power(watched)
    page.evaluate("() => window.__taken.restoreContext()")
    page.wait_for_selector(SENTENCE, state="detached")
    page.wait_for_selector(".rxf-views [data-value=blade]")
    page.wait_for_function("() => document.querySelector('[data-part=plan]').hidden")
    watched.answered()
    assert page.evaluate("() => rotorScene.drawn") == "drawn"
    assert not watched.complaints
    page.close()


def test_where_nothing_is_stored_the_page_works_and_says_what_is_lost(browser: Browser, app: App):
    context = browser.new_context()
    context.add_init_script(DRAW_NOTHING)
    context.add_init_script(FORBID_STORAGE)
    watched = Watched(context.new_page())
    watched.open(app.address, COARSE)
    note = watched.page.locator(".mantine-Notification-root", has_text="Nothing is stored")
    note.wait_for()
    assert "keeps the design in the address" in note.inner_text()
    change_power(watched)
    assert not watched.complaints
    context.close()


def test_touch_and_forced_colours_leave_each_control_usable(browser: Browser, app: App):
    """At the size of a desktop: a narrow window has other rules."""
    context = browser.new_context(
        viewport={"width": 1280, "height": 800}, has_touch=True, forced_colors="active"
    )
    context.add_init_script(DRAW_NOTHING)
    watched = Watched(context.new_page())
    watched.open(app.address)
    heights = """() => [...document.querySelectorAll('.rxf-line [data-slide]')].map(number => {
        const {left, top, width, height} = number.getBoundingClientRect(), x = left + width / 2, y = top + height / 2;
        return [-20, 20].every(off => document.elementFromPoint(x, y + off) === number) && height;
    })"""
    assert all(height >= 44 for height in watched.page.evaluate(heights))
    colours = "name => [...document.querySelectorAll(name)].map(one => getComputedStyle(one).backgroundColor)"
    modes, parts = (
        watched.page.evaluate(colours, name)
        for name in (".rxf-modes button", ".rxf-parts > div:first-child > *")
    )
    assert modes[0] not in modes[1:]
    assert len(set(parts)) > 3
    watched.answered(wholly=True)
    heads = """() => [...document.querySelectorAll('.rxp-worth > i')].map(
        one => getComputedStyle(one, '::after').borderTopColor)"""
    assert set(watched.page.evaluate(heads)) == {"rgba(0, 0, 0, 0)"}  # Arrows, not squares.
    context.close()
