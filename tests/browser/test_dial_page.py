"""The dial of twist at n/rev under a hand. What it shows, asks and does is tested without a browser: `test_dial.py`."""

import math
from dataclasses import fields

import pytest
from watched import MEDIUM, Watched

from explorer.model.inputs import Inputs
from explorer.parts.actuate import DialNumbers
from rotor.design import Harmonic
from tests.actuate import foreseen

START = Inputs(law="builtin", advance_ratio=0.3, bending=True)
SIZE = MEDIUM

NOW = "() => RX.state.dial.now"


def centre(watched: Watched) -> tuple[float, float, float]:
    """Middle of the dial and its radius [px]."""
    place = watched.page.locator("[data-dial] .rxd-round").first
    place.scroll_into_view_if_needed()
    box = watched.box(place)
    return box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"], 0.5 * box["width"] - 22.0


@pytest.mark.slow
def test_a_drag_on_the_dial_is_foreseen_and_one_undo(watched: Watched):
    page = watched.page
    watched.mode("actuate")
    page.get_by_text("Twist at n/rev", exact=True).click()
    page.wait_for_function("() => RX.state.dial?.front.length > 2", timeout=240_000)
    x, y, radius = centre(watched)
    watched.hold(x, y)
    page.mouse.move(x + 0.25 * radius, y - 0.433 * radius, steps=6)
    watched.until(lambda: "predicted" in watched.text("dial-read"))
    assert "Vibration" in watched.text("dial-read")
    page.mouse.up()
    watched.answered()
    ((order, size, phase),) = page.evaluate(NOW)
    assert order == 3
    assert size == pytest.approx(0.75, abs=0.03)
    assert phase == pytest.approx(60.0, abs=2.0)
    matrix = page.evaluate("() => RX.state.dial_matrix")
    numbers = DialNumbers(**{one.name: matrix[one.name] for one in fields(DialNumbers)})
    expected = foreseen(numbers, (Harmonic(3, math.radians(0.8), math.radians(60.0)),))
    parts = [0.0, 0.0, 0.4, 0.8 * math.sin(math.radians(60.0)), 0.0, 0.0, 0.0, 0.0]
    assert page.evaluate("x => RX.foresee(RX.state.dial_matrix, x)", parts) == pytest.approx(
        expected
    )
    page.evaluate("RX.send('undo')")
    watched.until(lambda: page.evaluate(NOW) == [])
    watched.answered()  # A dial that is drawn anew between focus and key would lose the key.
    page.locator("[data-dial] [data-dot]").first.press("Shift+ArrowUp")
    watched.until(lambda: page.evaluate(NOW) and page.evaluate(NOW)[0][1] == 0.25)
    before = page.evaluate(NOW)
    page.locator("[data-dial] [data-do=dial_front]").nth(2).press("Enter")
    watched.until(lambda: page.evaluate(NOW) not in (before, []))
