"""The frame of the page: opening, prompt, modes, drawers, the twist curve, keyboard and spoken names."""

import re

import pytest
from watched import Visit, Watched

from explorer.widgets.layout import DRAWERS

SIZE = (1500, 940)


def test_it_opens_as_built_with_one_prompt_that_the_first_edit_ends(visit: Visit):
    watched = visit(size=SIZE)
    as_built = watched.reads(
        "line",
        r"^The UH-60A of 8\.32 t at µ 0\.200 \(159 km/h\) with its twist as built needs \d+ ± \d+ kW",
    )
    watched.says("prompt", "Drag the blade tip up or down")
    watched.press("Δ outboard", "ArrowRight", 3)
    watched.page.wait_for_selector('[data-explorer="prompt"]', state="hidden")
    watched.reads(
        "line", r": [\d.]+ ± [\d.]+ kW (more|less) than as built \(\d+\), (sure|likely|unclear)"
    )
    watched.page.get_by_role("button", name="Undo").click()
    watched.until(lambda: watched.text("line") == as_built)
    assert watched.page.locator('[data-explorer="prompt"]').is_hidden()


@pytest.mark.slow
def test_each_drawer_opens_beside_the_scene_and_escape_closes_it(watched: Watched):
    page = watched.page
    for name, title in DRAWERS.items():
        watched.drawer(name)
        watched.until(lambda title=title: watched.text("drawer").startswith(title))
        page.wait_for_function(
            "() => document.querySelector('canvas').getBoundingClientRect().left > 300"
        )
        page.keyboard.press("Escape")
        page.wait_for_selector('[data-explorer="drawer"]', state="detached")
        page.wait_for_function(
            "() => document.querySelector('canvas').getBoundingClientRect().left < 2"
        )
    # The status opens trust, and the parts of power open the numbers.
    for press, name, part in (
        ("[data-explorer=within]", "trust", "provenance"),
        (".rxf-parts", "details", "trim"),
    ):
        page.locator(press).click()
        page.wait_for_selector(f'[data-explorer="drawer"][data-name="{name}"]')
        page.wait_for_selector(f'[data-explorer="{part}"]')
    page.get_by_role("button", name="Close").click()
    page.wait_for_selector('[data-explorer="drawer"]', state="detached")


def test_the_twist_curve_is_dragged_beside_the_live_disk(watched: Watched):
    page = watched.page
    x, y = watched.middle('[data-knot="2"]')
    before = watched.text("total-power")
    watched.hold(x, y)
    for step in range(1, 9):
        page.mouse.move(x, y - 3 * step)
        page.wait_for_timeout(60)
    page.wait_for_function("() => RX.state.hand?.place.startsWith('tip 1.00 R')")
    page.wait_for_function(
        "() => RX.state.plan?.held === 'before' && RX.part('twisting').textContent.includes('before')"
    )
    page.mouse.up()
    page.wait_for_function("() => RX.state.hand === null")
    watched.until_changed(lambda: watched.text("total-power"), before)
    # Up is nose-up: less washout.
    assert 2.0 < watched.at_rest(lambda: watched.number("Δ outboard")) < 20.0
    watched.reads("moved", r"^[\d.]+$")
    x, y = watched.middle('[data-knot="1"]')
    watched.drag(x, y, by=(40.0, 0.0))
    watched.until(lambda: watched.number("Break point") > 0.55)


def kilowatts(watched: Watched, part: str) -> int:
    """The number that a part of the page begins with."""
    found = re.match(r"[+−]?[\d\u2009]+", watched.text(part))
    assert found, watched.text(part)
    return int(found[0].replace("\u2009", "").replace("−", "-"))


def pause(watched: Watched) -> None:
    """All is answered; then longer than the pause that ends a step of the keyboard."""
    watched.answered()
    watched.page.wait_for_timeout(1200)
    watched.answered()


@pytest.mark.slow
def test_one_drag_of_a_slider_with_pauses_is_one_undo(watched: Watched):
    page = watched.page
    watched.answered()
    before = kilowatts(watched, "total-power")
    x, y = watched.thumb("Adv. ratio")
    watched.hold(x, y)
    page.mouse.move(x - 40, y, steps=5)
    pause(watched)
    page.mouse.move(x + 60, y, steps=5)
    pause(watched)
    page.mouse.move(x + 30, y, steps=3)
    page.mouse.up()
    pause(watched)
    assert kilowatts(watched, "total-power") > before
    page.get_by_role("button", name="Undo").click()
    watched.until(lambda: kilowatts(watched, "total-power") == before)


@pytest.mark.slow
def test_less_motion_is_respected(watched: Watched):
    watched.page.emulate_media(reduced_motion="reduce")
    moving = """() => [...document.querySelectorAll('#rx *, [data-dock-region]')]
        .filter(e => parseFloat(getComputedStyle(e).transitionDuration) > 0).length"""
    assert watched.page.evaluate(moving) == 0
    watched.page.emulate_media(reduced_motion="no-preference")
    assert watched.page.evaluate(moving) > 0


@pytest.mark.slow
def test_in_a_narrow_window_the_rail_is_a_drawer(watched: Watched):
    page, rail = watched.page, watched.page.locator("[data-dock-region=right]")
    page.set_viewport_size({"width": 1000, "height": 768})
    rail.wait_for(state="hidden")
    width = "() => document.querySelector('canvas').getBoundingClientRect().width"
    page.wait_for_function(f"() => ({width})() === 1000")
    page.get_by_role("button", name="Controls").click()
    page.wait_for_function(
        "() => document.querySelector('[data-dock-region=right]').checkVisibility()"
    )
    page.wait_for_function(  # Once it has slid in.
        "() => Math.abs(document.querySelector('[data-dock-region=right]').getBoundingClientRect().right - 1000) <= 1"
    )
    page.wait_for_function(  # The scene ends where the rail begins: no card lies under it.
        """() => Math.abs(document.querySelector('canvas').getBoundingClientRect().width
            - document.querySelector('[data-dock-region=right]').getBoundingClientRect().left) <= 1"""
    )
    before = watched.text("total-power")
    watched.press("Δ outboard", "PageUp", 3)
    watched.until_changed(lambda: watched.text("total-power"), before)
    page.get_by_role("button", name="Controls").click()
    rail.wait_for(state="hidden")
    page.wait_for_function(f"() => ({width})() === 1000")
    page.set_viewport_size({"width": SIZE[0], "height": SIZE[1]})
    rail.wait_for(state="visible")
