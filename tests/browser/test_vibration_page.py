"""Blade bending in a browser: the switch, the row of the power card, words in the scene, and chart."""

import pytest
from watched import MEDIUM, Watched

from explorer.model.inputs import Inputs

pytestmark = [pytest.mark.browser, pytest.mark.slow]
START = Inputs(law="builtin", advance_ratio=0.3)
SIZE = MEDIUM


def charts(watched: Watched) -> list[str]:
    return watched.page.evaluate("() => RX.state.strip.map(one => one.name)")


def switch(watched: Watched) -> None:
    """Turn bending on or off, on a page at rest: once in a full run on a busy machine a press was lost."""
    watched.answered(wholly=True)
    box = watched.row("Blade bending").locator("input[type=checkbox]")
    if not box.is_visible():
        watched.page.get_by_text("Model", exact=True).click()
    before = box.is_checked()
    box.click()
    watched.until(lambda: box.is_checked() != before)


def test_bending_brings_the_hub_loads_and_takes_them_away(watched: Watched):
    assert "vibration" not in charts(watched)
    straight = watched.node("/rotor/blade_0")
    switch(watched)
    watched.reads("index", r"^\d\.\d$")
    watched.answered(wholly=True)
    watched.reads("index-band", r"^\d\.\d to \d\.\d over inflow models$")
    assert watched.node("/rotor/blade_0") != straight
    assert charts(watched) == ["power", "vibration", "alpha"]
    gap = watched.page.locator(".rxf-chart[data-name=vibration] [data-gap] + text")
    assert gap.text_content() == "none below µ 0.2"
    labels = watched.page.locator(".rxf-label:visible")
    watched.until(lambda: labels.all_inner_texts() == ["bending × 10"])
    spoken = watched.page.locator('[data-explorer="vibration"]').get_attribute("aria-label") or ""
    assert spoken.startswith("Vibration: ")
    assert "0.67 to starboard" in spoken
    assert watched.reads("bending", "kW here$")
    watched.type("Adv. ratio", 0.15)
    watched.reads("vibration", "^Vibration\\s+No hub loads below µ 0.2")
    watched.until(lambda: labels.count() == 1)
    switch(watched)
    watched.page.wait_for_selector('[data-explorer="vibration"]', state="detached")
    watched.answered(wholly=True)
    assert "vibration" not in charts(watched)
    assert labels.count() == 0


def test_the_index_follows_twist_at_n_per_rev(watched: Watched):
    switch(watched)
    before = float(watched.reads("index", r"^\d\.\d$"))
    watched.mode("actuate")
    watched.page.wait_for_function("() => RX.state.dial?.settled", timeout=240_000)
    for change in ("start", [[3, 1.0, 60.0]], "end"):
        watched.page.evaluate("change => RX.send('dial', change)", change)
    settled = "() => RX.state.dial?.now.length === 1 && RX.state.dial.settled"
    watched.page.wait_for_function(settled, timeout=240_000)
    assert watched.page.evaluate("() => RX.state.dial.settled.index[0]") < -30.0  # [%] That of the design's own inflow.
    watched.mode("explore")
    watched.reads("index-change", r"^−\d+ % vs\. as built")
    assert float(watched.text("index")) < 0.7 * before
