"""A and B on the real page: pin, move, read the difference, see it on the disk, swap, go back, let go."""

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from watched import WAIT, Watched, for_people, opened, painted

from explorer.app import App

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = pytest.mark.browser


def ghost_seen(watched: Watched) -> bool:
    return watched.page.evaluate("() => window.__viserMutable.nodeRefFromName['/rotor/blade_0/ghost'].visible")


def total_row(watched: Watched) -> list[str]:
    """A, B, Δ kW, Δ % of the total."""
    cells = watched.page.locator('[data-explorer="ab"] tr', has_text="Total").locator("td").all_inner_texts()
    return [text.strip() for text in cells[1:]]


def press(watched: Watched, name: str) -> None:
    watched.page.get_by_role("button", name=name, exact=True).click()


def test_pin_move_compare_swap_back_and_let_go(browser: "Browser", app: App):
    watched = opened(browser, app.address)
    page = watched.page
    begun = watched.text("total-power")
    assert page.get_by_label("Show B − A").count() == 0

    press(watched, "Pin as A")
    page.wait_for_selector('[data-explorer="pinned"]', timeout=WAIT)
    assert re.search(r"A:\s*Two segments −14/−8 at 0\.5\s+" + begun, watched.text("pinned"))
    assert total_row(watched)[2:] == ["0.0", "0.0"]
    watched.until_changed(lambda: ghost_seen(watched), False)
    page.wait_for_function("() => Object.keys(window.__viserTestpoints.uplots).length === 5", timeout=WAIT)

    disk = watched.node("/rotor/disk/field")
    watched.press("Inner", "PageUp", 4)
    moved = watched.until_changed(lambda: total_row(watched)[2], "0.0")
    a, b, apart, percent = watched.at_rest(lambda: total_row(watched))
    assert f"{a} kW" == begun
    assert f"{b} kW" == watched.text("total-power")
    assert re.fullmatch(r"[+−]\d+\.\d", moved)
    assert watched.text("change").startswith(percent)
    watched.until_changed(lambda: watched.node("/rotor/disk/field"), disk)
    plain = watched.at_rest(lambda: watched.node("/rotor/disk/field"))

    page.get_by_label("Show B − A").check()
    watched.until_changed(lambda: watched.node("/rotor/disk/field"), plain)
    assert "Δ angle of attack [°], B − A" in watched.text("colour-bar")

    press(watched, "Swap A and B")
    watched.until_changed(lambda: watched.text("total-power"), f"{b} kW")
    watched.until_changed(lambda: total_row(watched)[2], apart)
    swapped = watched.at_rest(lambda: total_row(watched))
    assert swapped[:2] == [b, a]
    assert swapped[2].lstrip("+−") == apart.lstrip("+−")

    press(watched, "Back to A")
    watched.until_changed(lambda: total_row(watched)[2], swapped[2])
    assert watched.at_rest(lambda: total_row(watched)) == [b, b, "0.0", "0.0"]

    press(watched, "Unpin")
    page.wait_for_selector('[data-explorer="ab"]', state="detached", timeout=WAIT)
    page.wait_for_selector('[data-explorer="pinned"]', state="detached", timeout=WAIT)
    watched.until_changed(lambda: ghost_seen(watched), True)
    assert "vs. UH-60A as built" in watched.text("power")
    assert watched.text("colour-bar").startswith("Angle of attack [°]\n")
    assert page.get_by_label("Show B − A").count() == 0
    page.wait_for_function("() => Object.keys(window.__viserTestpoints.uplots).length === 4", timeout=WAIT)
    assert not re.search(r"\b(NaN|nan|inf|undefined)\b", page.inner_text("body"))
    assert watched.complaints == []
    watched.close()


@for_people
def test_screenshots(browser: "Browser", app: App, artefacts: Path, scheme: Any, size: tuple[int, int]):
    watched = painted(browser, app.address, scheme, size)
    press(watched, "Pin as A")
    watched.page.wait_for_selector('[data-explorer="pinned"]', timeout=WAIT)
    for label, value in (("Inner", -20), ("Outer", -2), ("Division", 0.6)):
        watched.type(label, value)
        watched.page.wait_for_timeout(300)
    watched.page.get_by_label("Show B − A").check()
    watched.page.wait_for_timeout(2500)
    watched.quiet()
    path = artefacts / f"ab-{scheme}-{size[0]}x{size[1]}.png"
    watched.page.screenshot(path=path)
    assert path.stat().st_size > 50_000
    assert watched.complaints == []
    watched.close()
