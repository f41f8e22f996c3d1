"""How long from a key on a slider to the frame that shows the new answer; printed, and bounded loosely."""

import statistics
from pathlib import Path

import pytest
from chromium import DRAW_NOTHING
from playwright.sync_api import Browser
from watched import Watched

from explorer.app import App

pytestmark = [pytest.mark.slow, pytest.mark.nightly]

_WATCH = """
() => {
  // The picture on the disk that is drawn, not the message that brings it.
  const picture = () => {
    return rotorDisk.drawn('/rotor').version;
  };
  const {scene} = __viserMutable, own = scene.onAfterRender;
  window.__times = []; let pressed = null, before = picture();
  window.addEventListener('keydown', () => { pressed = performance.now(); before = picture(); }, true);
  scene.onAfterRender = (...all) => {
    own.apply(scene, all);
    if (pressed !== null && picture() !== before) { window.__times.push(performance.now() - pressed); pressed = null; }
  };
}
"""


@pytest.mark.parametrize("label", ["Adv. ratio", "Rate"])
def test_slider_to_frame(browser: Browser, artefacts: Path, label: str):
    app = App("127.0.0.1", 0)
    context = browser.new_context(viewport={"width": 1500, "height": 940})
    context.add_init_script(DRAW_NOTHING)
    page = context.new_page()
    try:
        watched = Watched(page)
        watched.open(app.address, query="")
        if label == "Rate":
            watched.choose("Twist concept", "Linear")
        watched.answered(wholly=True)
        watched.row(label).get_by_role("slider").focus()
        page.evaluate(_WATCH)
        for k in range(40):
            page.keyboard.press("ArrowRight" if k % 20 < 10 else "ArrowLeft")
            page.wait_for_function("k => window.__times.length > k", arg=k)
            page.wait_for_timeout(150)
        times = sorted(page.evaluate("() => window.__times"))
    finally:
        context.close()
        app.stop()
    late = times[int(0.95 * len(times))]
    line = f"{label}: {len(times)} frames, p50 {statistics.median(times):.0f} ms, p95 {late:.0f} ms"
    print(line)
    with (artefacts / "latency.txt").open("a", encoding="utf-8") as file:
        file.write(line + "\n")
    # The target is 60 ms for the median. Machines that run tests are busy, but not at every key: the best tenth counts.
    assert times[len(times) // 10] < 250.0
