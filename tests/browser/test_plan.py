"""The plan of the disk: read under the pointer, around the circle, and by key."""

import math
import re

import numpy as np
import pytest
from playwright.sync_api import Browser
from watched import MEDIUM, Watched, opened

from explorer.app import App
from explorer.model.inputs import OPENING
from explorer.model.units import number
from explorer.picture.element import probe
from rotor.trim.solve import solve

_READY = "() => RX.state.plan?.values && !document.querySelector('.rxf-plan').hasAttribute('data-moving')"


def _point(watched: Watched, r: float, psi_deg: float) -> tuple[float, float]:
    circle = "['cx', 'cy', 'r'].map(name => +document.querySelector('.rxf-plan svg circle').getAttribute(name))"
    x, y, radius = watched.at_rest(lambda: watched.page.evaluate(circle))
    box = watched.box(".rxf-plan")
    psi = math.radians(psi_deg)
    return box["x"] + x + r * radius * math.sin(psi), box["y"] + y + r * radius * math.cos(psi)


def test_read_open_and_go_round_the_disk(browser: Browser, app: App):
    watched = opened(browser, app.address, size=MEDIUM)
    page = watched.page
    page.get_by_role("button", name="Disk").click()
    page.wait_for_function(_READY)
    solution = solve(OPENING.design())
    disk = solution.disk
    row, column = len(disk.r) - 4, len(disk.psi) // 6
    r, psi = float(disk.r[row]), math.degrees(float(disk.psi[column]))
    page.mouse.move(*_point(watched, r, psi))
    reading = page.locator("[data-reading]")
    reading.wait_for(state="visible")
    shown = dict(
        zip(
            reading.locator("dt").all_inner_texts(),
            reading.locator("dd").all_inner_texts(),
            strict=True,
        )
    )
    assert float(shown["α"].rstrip("°").replace("−", "-")) == pytest.approx(
        math.degrees(disk.alpha[row, column]), abs=0.2
    )
    assert float(shown["Mach"]) == pytest.approx(float(disk.mach[row, column]), abs=0.004)
    assert float(shown["Cl"].replace("−", "-")) == pytest.approx(
        float(disk.cl[row, column]), abs=0.03
    )
    watched.reads("around", f"{r:.2f} R")
    # A click opens its section; the pointer was a fraction of a pixel beside it.
    page.mouse.down()
    page.mouse.up()
    page.wait_for_function(f"() => RX.state.bar.drawer === 'probe' && ({_READY})()")
    fields = [
        watched.row(label).get_by_role("textbox") for label in ("Radius r/R", "Azimuth ψ [°]")
    ]

    def opened_at() -> tuple[float, float]:
        first, second = (float(field.input_value()) for field in fields)
        return first, second

    watched.until(lambda: np.allclose(opened_at(), (r, psi), rtol=0.0, atol=(0.02, 2.0)))
    clicked = opened_at()
    # As the section says it, to the last digit.
    there = probe(solution, clicked[0], math.radians(clicked[1]))
    said = number(math.degrees(there.alpha), 1), number(there.mach, 3), number(there.cl, 3)
    assert (shown["α"].rstrip("°"), shown["Mach"], shown["Cl"]) == said
    assert shown["Stall margin"].rstrip("°") == number(math.degrees(there.stall_margin or 0.0), 1)
    # By key, and spoken.
    page.locator(".rxf-plan").focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    watched.until(lambda: "R · ψ" in page.locator(".rxf-said").inner_text())
    watched.until(lambda: opened_at() != clicked)
    # Another design's values follow; and the scene comes back.
    before = page.evaluate("() => RX.state.plan.values.tables.cl.data")
    watched.press("Mass [t]", "ArrowRight", 5)
    page.wait_for_function(
        f"before => ({_READY})() && RX.state.plan.values.tables.cl.data !== before", arg=before
    )
    page.get_by_role("button", name="Aircraft").click()
    page.wait_for_function("() => !document.documentElement.hasAttribute('data-plan')")
    assert watched.complaints == []
    watched.close()


def test_one_press_shows_the_disk_without_stall(browser: Browser, app: App):
    watched = opened(browser, app.address, size=MEDIUM)
    page = watched.page
    page.get_by_role("button", name="Disk").click()
    regions = "() => RX.state.plan.regions.filter(({lines}) => lines.length).map(({name}) => name)"
    for press, stalls in (("Without stall", True), ("With stall", False)):
        button = page.locator("[data-labels] button", has_text=press)
        button.wait_for()
        page.wait_for_function(_READY)
        watched.until(lambda stalls=stalls: ("stall" in page.evaluate(regions)) == stalls)
        assert (
            re.search("static|separated", page.locator(".rxf-around").inner_text()) is not None
        ) == stalls
        # It stays in reach.
        assert button.bounding_box()["x"] < page.locator(".rxf-views").bounding_box()["x"] / 2.0
        button.click()
    assert watched.complaints == []
    watched.close()
