"""Screen readers, the keyboard alone, and fingers: the page as used without a mouse."""

from typing import Any

import pytest
from chromium import DRAW_NOTHING
from playwright.sync_api import Browser, CDPSession
from watched import ON_SCREEN, Watched

from explorer.app import App

SIZE = (1500, 940)
FOCUS = """() => {
    const e = document.activeElement, style = getComputedStyle(e);
    return e === document.body ? null : {
        name: e.ariaLabel || e.innerText?.trim() || e.labels?.[0]?.textContent || '',
        seen: parseFloat(style.outlineWidth) >= 2 && style.outlineStyle === 'solid' || e.matches('.rxp-curve circle')
            || e.matches('[data-mark]')
                && parseFloat(getComputedStyle(e.querySelector('circle + circle')).strokeWidth) > 2.5,
        left: e.getBoundingClientRect().left, top: e.getBoundingClientRect().top,
    };
}"""


@pytest.mark.slow
def test_the_tab_key_walks_the_whole_page_with_visible_focus(watched: Watched):
    page = watched.page
    watched.answered(wholly=True)  # What is drawn anew gets the focus back a frame later.
    page.locator(".rxf-rotor").focus()
    reached: list[dict[str, Any]] = []
    for _ in range(90):
        page.keyboard.press("Tab")
        focus = page.evaluate(FOCUS)
        if focus is None:
            watched.drawn()
            focus = page.evaluate(FOCUS)
        if focus is None:
            break  # Past the last control: back to the browser, so nothing held the focus.
        reached.append(focus)
    else:
        pytest.fail(f"the focus never leaves the page: {reached[-3:]}")
    assert [one for one in reached if not one["seen"]] == []
    names = [one["name"] for one in reached]
    order = [
        "Explore",
        "Settings",
        "Aircraft",
        "Turn the rotor",
        "tip",
        "Δ outboard [°/R]",
        "Mass [t]",
        "Model",
    ]
    assert [name for name in names if name in order] == [
        "Explore",
        "Settings",
        "Aircraft",
        "Turn the rotor",
        "tip",
        *["Δ outboard [°/R]"] * 2,  # The slider and its number.
        *["Mass [t]"] * 2,
        "Model",
    ]


def test_focus_stays_where_a_key_was_pressed(watched: Watched):
    page = watched.page
    page.locator("[data-do=view]", has_text="Disk").focus()
    page.keyboard.press("Enter")
    page.wait_for_selector("[data-do=view][aria-pressed=true] >> text=Disk")
    page.wait_for_function("() => document.activeElement.innerText === 'Disk'")
    page.locator("[data-do=view]", has_text="Aircraft").click()


def test_power_is_spoken_once_a_slider_rests(watched: Watched):
    watched.press("Adv. ratio", "ArrowRight", 3)
    watched.answered()
    power = watched.text("total-power")
    watched.until(lambda: power in (watched.page.locator(".rxf-said").text_content() or ""))


def test_a_drawer_opened_by_key_takes_the_focus_and_escape_gives_it_back(watched: Watched):
    page = watched.page
    page.get_by_role("button", name="Share").focus()
    page.keyboard.press("Enter")
    page.wait_for_function("() => document.activeElement.ariaLabel === 'Close'")
    page.keyboard.press("Escape")
    page.wait_for_selector('[data-explorer="drawer"]', state="detached")
    page.wait_for_function("() => document.activeElement.dataset.value === 'share'")


def swipe(
    session: CDPSession, watched: Watched, start: tuple[float, float], way: tuple[float, float]
) -> None:
    """A finger set down, moved and lifted."""
    for k in range(13):
        point = {"x": start[0] + way[0] * k / 12, "y": start[1] + way[1] * k / 12}
        session.send(
            "Input.dispatchTouchEvent",
            {"type": "touchMove" if k else "touchStart", "touchPoints": [point]},
        )
        watched.page.wait_for_timeout(40 if k else 250)
    watched.answered()
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})


def on_a_phone(browser: Browser, address: str) -> Watched:
    """A page that nothing is drawn on, 390 × 844 pixels wide and high; its context is the caller's to close."""
    context = browser.new_context(
        viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True
    )
    context.add_init_script(DRAW_NOTHING)
    watched = Watched(context.new_page())
    watched.open(address)
    return watched


@pytest.mark.slow
def test_menu_drawers_lists_and_disk_answer_taps_on_a_phone(browser: Browser, app: App):
    watched = on_a_phone(browser, app.address)
    page = watched.page
    page.locator("[data-page=more]").tap()
    watched.quiet()  # A notification that closes leaves the menu open.
    menu, first = watched.box(".rxf-more"), watched.box("[data-do=pin]")
    assert first["y"] - menu["y"] < 12.0  # No gap where there is nothing to redo.
    page.locator("[data-do=drawer][data-value=settings]").tap()
    page.wait_for_selector('[data-explorer="drawer"][data-name="settings"]')
    assert page.evaluate("""() => [...document.querySelectorAll('[data-dock-region] .mantine-ScrollArea-viewport')]
        .every(sheet => sheet.scrollWidth <= sheet.clientWidth)""")
    # The list of the lowest row reaches below the window: the page stays as wide and the list open.
    page.evaluate(
        "() => { window.resized = 0; window.addEventListener('resize', () => window.resized++); }"
    )
    watched.row("Drawn twist").locator("input").first.tap()
    page.get_by_role("option", name="×2", exact=True).wait_for()
    watched.drawn()
    assert page.evaluate("() => [innerWidth, innerHeight, window.resized]") == [390, 844, 0]
    page.get_by_role("option", name="×2", exact=True).tap()
    # A mode has its controls on the sheet from the first, also where a drawer stood and the controls were moved up.
    panel = (
        "document.querySelector('[data-dock-region=right] .mantine-ScrollArea-viewport').scrollTop"
    )
    assert page.evaluate(f"() => {panel} = 90") == page.evaluate(f"() => {panel}") == 90
    page.locator(".rxf-modes [data-value=optimise]").tap()
    page.wait_for_selector('[data-explorer="drawer"]', state="detached")
    watched.row("Concept").locator("input").first.wait_for()
    assert page.evaluate(f"() => {panel}") == 0
    # The circle of the chart around the disk goes where the disk is tapped.
    page.locator("[data-do=view][data-value=disk]").tap()
    page.wait_for_function("() => RX.state.plan?.values")
    rim = page.locator(".rxf-plan > svg circle").first
    x, y = watched.middle(rim)
    page.touchscreen.tap(x, y - 0.25 * watched.box(rim)["height"])
    page.wait_for_selector('[data-explorer="drawer"][data-name="probe"]')
    page.locator("[data-page=charts]").tap()
    watched.reads("around", r"0\.(49|5\d) R")
    # A telephone whose text is 130 % as large.
    page.set_viewport_size({"width": 300, "height": 650})
    rotor, more = watched.box(".rxf-rotor"), watched.box("[data-page=more]")
    assert rotor["width"] > 55.0
    assert more["x"] + more["width"] <= 300.0
    assert watched.complaints == []
    page.context.close()


@pytest.mark.slow
def test_a_finger_drags_slider_curve_and_blade_on_a_phone(browser: Browser, app: App):
    watched = on_a_phone(browser, app.address)
    page, session = watched.page, watched.page.context.new_cdp_session(watched.page)
    slider = watched.row("Δ outboard").get_by_role("slider")

    def outer() -> float:
        return float(slider.get_attribute("aria-valuenow") or "nan")

    for part in ("total-power", "within"):
        box = watched.box(page.locator(f'[data-explorer="{part}"]').first)
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 390
    assert page.evaluate("() => document.documentElement.scrollWidth") <= 390
    begun = outer()
    slider.scroll_into_view_if_needed()
    swipe(session, watched, watched.middle(slider), (30.0, 2.0))
    watched.until_changed(outer, begun)
    by_slider = watched.at_rest(outer)
    assert 3.0 < by_slider < 12.0
    knot = page.locator('[data-knot="2"]')
    knot.scroll_into_view_if_needed()
    swipe(session, watched, watched.middle(knot), (0.0, 12.0))
    watched.until_changed(outer, by_slider)
    by_curve = watched.at_rest(outer)
    assert -20.0 <= by_curve < by_slider - 2.0
    camera: Any = watched.at_rest(
        lambda: page.evaluate("() => window.__viserMutable.camera.position.toArray()")
    )
    x, y = watched.at_rest(lambda: page.evaluate(ON_SCREEN, 7.2))
    # Seen from the tip, the trailing edge goes down: nose up.
    swipe(session, watched, (x, y), (0.0, 30.0))
    watched.until_changed(outer, by_curve)
    by_blade = watched.at_rest(outer)
    assert by_blade > by_curve + 1.0  # The tip was turned up.
    # The camera follows the shaft tilt; an orbit would have moved it by metres.
    assert page.evaluate("() => window.__viserMutable.camera.position.toArray()") == pytest.approx(
        camera, abs=0.6
    )
    watched.page.wait_for_function("() => RX.state.hand === null")
    watched.close()
