"""The dial of twist at n/rev in a browser."""

import pytest
from watched import MEDIUM, Watched

from explorer.model.inputs import Inputs

pytestmark = pytest.mark.browser
START = Inputs(law="builtin", advance_ratio=0.3, bending=True)
SIZE = MEDIUM

FORESEEN = "() => RX.state.dial_matrix && RX.state.dial?.settled"
NOW = "() => RX.state.dial.now"


def centre(watched: Watched) -> tuple[float, float, float]:
    """Middle of the dial and its radius [px]."""
    place = watched.page.locator("[data-dial] .rxd-round").first
    place.scroll_into_view_if_needed()
    box = place.bounding_box()
    assert box is not None
    return box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"], 0.5 * box["width"] - 22.0


@pytest.mark.slow
def test_a_drag_on_the_dial_is_foreseen_trimmed_and_one_undo(watched: Watched):
    page = watched.page
    watched.mode("actuate")
    page.wait_for_function(FORESEEN, timeout=240_000)
    x, y, radius = centre(watched)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 0.25 * radius, y - 0.433 * radius, steps=6)
    watched.until(lambda: "foreseen" in watched.text("dial-read"))
    assert "Vibration" in watched.text("dial-read")
    assert "voltage" in watched.text("verdict")
    page.mouse.up()
    watched.answered()
    ((order, size, phase),) = page.evaluate(NOW)
    assert order == 3
    assert size == pytest.approx(0.75, abs=0.03)
    assert phase == pytest.approx(60.0, abs=2.0)
    page.wait_for_function(FORESEEN, timeout=240_000)
    settled, foreseen = page.evaluate(
        """() => { const x = [0, 0, 0, 0, 0, 0, 0, 0], [[, a, p]] = RX.state.dial.now;
        x[2] = a * Math.cos(p * Math.PI / 180); x[3] = a * Math.sin(p * Math.PI / 180);
        const {dial, dial_matrix: matrix} = RX.state, [power, index] = RX.foresee(matrix, x);
        const trimmed = 100 * dial.settled.power[0] / dial.per_watt / matrix.power;
        return [[trimmed, dial.settled.index[0]], [power, index]]; }"""
    )
    assert foreseen[0] == pytest.approx(settled[0], abs=0.3)
    assert foreseen[1] == pytest.approx(settled[1], abs=6.0)
    page.evaluate("RX.send('undo')")
    watched.until(lambda: page.evaluate(NOW) == [])
    watched.answered(wholly=True)  # An answer draws the dot anew.
    page.locator("[data-dial] [data-dot]").first.press("Shift+ArrowUp")
    watched.until(lambda: page.evaluate(NOW) and page.evaluate(NOW)[0][1] == 0.25)
    page.wait_for_function("() => RX.state.dial_front?.series.length > 9", timeout=240_000)
    dots = page.locator("[data-dial] [data-do=dial_front]")
    for press in (lambda: dots.nth(2).press("Enter"), lambda: dots.nth(0).click()):
        before = page.evaluate(NOW)
        press()
        watched.until(lambda before=before: page.evaluate(NOW) not in (before, []))
        watched.answered(wholly=True)
