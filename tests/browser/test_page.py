"""The real page in a real browser: sliders move, and power, blade, disk and charts follow."""

import re

import pytest
from watched import Watched

from explorer.model.inputs import Inputs

START = Inputs(law="builtin")


def kilowatts(text: str) -> float:
    return float(re.sub(r"[^\d.]", "", text))


@pytest.mark.slow
def test_speed_is_dragged_by_its_dot_up_to_the_engines(watched: Watched):
    watched.answered(wholly=True)
    page, slider = watched.page, watched.row("Adv. ratio").get_by_role("slider")
    page.wait_for_function(
        "() => RX.state.strip[0].speeds && RX.state.strip[0].chart.rules?.length === 1"
    )

    def mu() -> float:
        return float(slider.get_attribute("aria-valuenow") or "nan")

    fastest = page.evaluate("() => RX.state.strip[0].speeds.fastest")
    x, y = watched.middle("[data-speed]")
    watched.hold(x, y)
    page.mouse.move(x + 200, y, steps=8)  # Beyond the end of the axis.
    watched.until(lambda: mu() == pytest.approx(fastest))
    head = page.locator(".rxf-chart[data-name=power] .rxf-head [data-value]")
    watched.until(lambda: head.inner_text() == "limit: engines")
    page.mouse.up()
    at = watched.middle("[data-speed]")
    watched.drag(*at, by=(x - 100 - at[0], y - at[1]))
    watched.until(lambda: mu() < 0.9 * fastest)
    watched.answered(wholly=True)
    page.mouse.dblclick(*watched.middle("[data-speed]"))
    watched.until(lambda: mu() == pytest.approx(fastest))


def test_a_press_is_not_lost_where_its_button_is_drawn_anew(watched: Watched):
    """Cards are drawn with every answer, also between the press and the release; then the browser makes no click."""
    button, page = watched.page.locator("[data-do=region][data-value=stall]"), watched.page
    watched.answered(wholly=True)
    fold = page.locator("button[data-unfold=field]")
    fold.click()  # The card is folded in this window.
    before = button.get_attribute("aria-pressed")
    for _ in range(2):
        button.hover()
        page.mouse.down()
        page.evaluate(
            "() => { RX.again('field'); return new Promise(done => setTimeout(done, 100)); }"
        )
        page.mouse.up()
        before = watched.until_changed(lambda: button.get_attribute("aria-pressed"), before)
    fold.click()


def test_a_drag_is_live_and_ends_where_it_ends(watched: Watched):
    """The disk follows while the button is still down, and the last answer is that of the last position."""
    page = watched.page
    page.evaluate(
        """() => {
            const held = () => rotorDisk.drawn('/rotor').version;
            window.__seen = new Set();
            const look = () => { window.__seen.add(held()); requestAnimationFrame(look); };
            look();
        }"""
    )
    watched.row("Adv. ratio").get_by_role("slider").scroll_into_view_if_needed()
    x, y = watched.thumb("Adv. ratio")
    watched.hold(x, y)
    seen_while_down, steps = 0, 0
    # As long as a slow machine needs, but never letting go.
    while seen_while_down < 5 and steps < 1000:
        steps += 1
        page.mouse.move(x + steps % 30, y)
        page.wait_for_timeout(40)
        seen_while_down = page.evaluate("() => window.__seen.size")
    page.mouse.up()
    assert seen_while_down >= 5
    watched.answered()
    shown = watched.number("Adv. ratio")
    assert watched.text("speed").startswith(f"{shown * 27.0 * 8.1788 * 3.6:.0f} km/h")


@pytest.mark.slow
def test_a_switch_changes_the_power_and_the_page_says_so(watched: Watched):
    watched.type("Adv. ratio", 0.3)
    watched.answered()
    before, flapping = (
        watched.text("total-power"),
        watched.row("Flapping").locator("input[type=checkbox]"),
    )
    watched.page.get_by_text("Model", exact=True).click()
    flapping.click()
    watched.until(lambda: kilowatts(watched.text("total-power")) > kilowatts(before) + 30.0)
    status = watched.page.wait_for_function(
        "() => (words => words.includes('Switched off') && words)(RX.state.line.status.title)"
    ).json_value()
    assert "Switched off: flapping. The result is for teaching, not for the aircraft." in status
    assert re.search(r"the hub carries 1\d\d kN m rolling to the retreating side", status)
    flapping.click()
    watched.says("total-power", before)


def test_no_number_on_screen_is_not_a_number(watched: Watched):
    for key in ("Home", "End"):
        watched.press("Adv. ratio", key)
        watched.answered()
        assert not re.search(r"\b(NaN|nan|inf|undefined)\b", watched.page.inner_text("body"))
