"""The blade's tip in the hand is drawn about as often as what a slider moves, also once a hint was shown."""

import math
import time

import pytest
from watched import LARGE, Watched

SIZE = LARGE

# Pictures drawn, of the disk in the scene or of its plan beside the blade in the hand; and a hint as the client shows.
_WATCH = """() => {
    document.body.insertAdjacentHTML('beforeend', '<div class="mantine-Tooltip-tooltip" hidden></div>');
    const now = () => [rotorDisk.drawn('/rotor').version, RX.state.plan];
    let before = now();
    window.__pictures = 0;
    const look = () => {
        const here = now();
        if (here.some((value, k) => value !== before[k])) window.__pictures++;
        before = here;
        requestAnimationFrame(look);
    };
    look();
}"""


def drawn(watched: Watched, x: float, y: float, across: float, down: float) -> float:
    """Pictures a second while the pointer that is held at x, y swings so far [px] about it."""
    page = watched.page
    before, begun = page.evaluate("() => window.__pictures"), time.monotonic()
    for k in range(60):
        swing = math.sin(4.0 * math.pi * k / 60.0)
        page.mouse.move(x + swing * across, y + swing * down)
        page.wait_for_timeout(16)
    return (page.evaluate("() => window.__pictures") - before) / (time.monotonic() - begun)


@pytest.mark.nightly
def test_a_tip_drag_is_drawn_about_as_often_as_that_of_a_slider(watched: Watched):
    """On a busy machine plan and sections, which have more to draw, fall back to about .6."""
    page = watched.page
    page.evaluate(_WATCH)
    slider, tip = list[float](), list[float]()
    for _ in range(2):  # In turn, since other work of the machine changes.
        x, y = watched.thumb("Δ outboard")
        watched.hold(x, y)
        slider.append(drawn(watched, x, y, 25.0, 0.0))
        page.mouse.up()
        watched.reset()
        x, y = watched.grab_tip()
        page.wait_for_timeout(600)  # The blade has come to the hand.
        tip.append(drawn(watched, x, y + 12.0, 0.0, 30.0))
        page.mouse.up()
        watched.reset()
    print(f"pictures a second: slider {sum(slider) / 2:.1f}, tip {sum(tip) / 2:.1f}")
    assert sum(slider) > 2.0
    assert sum(tip) > 0.4 * sum(slider)
