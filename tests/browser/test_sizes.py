"""Nothing lies behind or over anything at the sizes of desks, tablets and telephones, in each mode."""

from pathlib import Path
from typing import Any

import pytest
from watched import LARGE, Visit, Watched

pytestmark = pytest.mark.browser

MEASURE = (Path(__file__).parent / "overlaps.js").read_text(encoding="utf-8")
CLEAN: dict[str, list[str]] = {"hit": [], "outside": [], "hidden": [], "nameless": [], "cut": []}


MOST_NUMBERS, MOST_CONTROLS = 30, 36
"""In the first view of a desk with a pointer, marks of axes and fields too. Other numbers wait for the pointer."""


def found(watched: Watched) -> tuple[dict[str, list[str]], int]:
    """What covers what, and the width of the plan's disk [px]."""
    watched.quiet()
    now: dict[str, Any] = watched.at_rest(lambda: watched.page.evaluate(MEASURE))
    return {name: now[name] for name in CLEAN}, now["disk"] or 0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("width", "height", "least"),
    [(390, 844, 370), (820, 1180, 500), (1180, 820, 360), (1280, 720, 400), (1500, 940, 600)],
)
def test_nothing_lies_over_anything(visit: Visit, width: int, height: int, least: int):
    watched = visit(size=(width, height))
    page = watched.page
    assert found(watched)[0] == CLEAN
    if (width, height) == LARGE:
        first = page.evaluate(MEASURE)
        assert 15 < first["numbers"] <= MOST_NUMBERS
        assert 20 < first["controls"] <= MOST_CONTROLS
    page.locator("[data-do=view][data-value=disk]").click()
    page.wait_for_function("() => RX.state.plan?.values")
    clean, disk = found(watched)
    assert clean == CLEAN
    assert disk >= least
    page.locator("[data-do=view][data-value='3d']").click()
    for mode in ("optimise", "actuate"):
        watched.mode(mode)
        page.wait_for_function("() => document.documentElement.dataset.mode !== 'actuate' || RX.state.earns")
        assert found(watched)[0] == CLEAN, mode
    for drawer in ("share", "lecture"):
        watched.drawer(drawer)
        assert found(watched)[0] == CLEAN, drawer


def test_the_sheet_is_pulled_and_modes_bring_it(visit: Visit):
    watched = visit(size=(390, 844))
    page, grip = watched.page, watched.page.locator(".rxf-grip")
    sheet = "() => innerHeight - document.querySelector('.rxf-grip').getBoundingClientRect().bottom"
    canvas = "() => document.querySelector('canvas').getBoundingClientRect().height"
    half, high = page.evaluate(sheet), page.evaluate(canvas)
    assert half == pytest.approx(0.44 * 844, abs=3)
    box = grip.bounding_box()
    assert box is not None
    x, y = box["x"] + 150, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, y + 120, steps=4)
    assert page.evaluate(sheet) == pytest.approx(half - 120, abs=3)
    assert page.evaluate(canvas) == pytest.approx(high, abs=1)  # Of another size only once it is let go.
    page.mouse.up()
    page.wait_for_function(f"high => ({canvas})() > high + 100", arg=high)
    assert grip.get_attribute("aria-expanded") == "true"
    grip.click()
    page.wait_for_function(f"() => ({sheet})() === 0")
    assert grip.get_attribute("aria-expanded") == "false"
    watched.mode("optimise")
    page.get_by_role("button", name="Optimise", exact=True).last.wait_for(state="visible")
    assert page.evaluate(sheet) == pytest.approx(half - 120, abs=3)  # As high as it was pulled.


def test_on_a_tablet_optimise_shows_its_controls_and_its_search(visit: Visit):
    watched = visit(size=(820, 1180))
    watched.mode("optimise")
    begin = watched.page.locator("[data-dock-region=right]").get_by_role("button", name="Optimise", exact=True)
    assert begin.is_visible()
    begin.click()
    watched.page.locator("[data-explorer=notice]").wait_for(state="visible")
    assert found(watched)[0] == CLEAN


@pytest.mark.slow
def test_what_is_measured_can_fail(visit: Visit):
    page = visit(size=(820, 1180)).page
    page.evaluate("() => document.querySelector('.rxf-views').style.cssText = 'left: 20px; top: 20px; right: auto'")
    assert "power-card × views" in page.evaluate(MEASURE)["hit"]
