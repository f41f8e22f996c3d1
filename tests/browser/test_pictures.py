"""Pictures of the page for people to look at, in both schemes and sizes, and what no page may show."""

import re
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from watched import LARGE, MEDIUM, WAIT, Watched, painted

from explorer.app import App

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = [pytest.mark.browser, pytest.mark.slow, pytest.mark.nightly]


def show(watched: Watched, scene: str) -> None:
    """Bring the page into one of the scenes."""
    page = watched.page
    if scene == "explorer":
        watched.type("Adv. ratio", 0.3)
    elif scene == "ab":
        page.keyboard.press("p")
        page.wait_for_function("() => RX.state.bar.pinned")
        watched.type("Δ outboard", 6)
        page.get_by_role("button", name="Show B − A").click()
    elif scene == "actuator":
        watched.mode("actuate")
        watched.type("Voltage", 60)
        page.wait_for_selector('[data-explorer="verdict"][data-kind="ready"]', timeout=4 * WAIT)
        page.mouse.move(640, 360)
    elif scene == "stand":
        page.locator(".rxf-rotor").select_option(label="XV-15 metal blade")
    else:
        watched.type("Adv. ratio", 0.37)
        watched.drawer("probe")
        r, psi, view = {"advancing": (0.8, 90, "1"), "retreating": (0.75, 270, "3"), "reverse": (0.25, 270, "4")}[scene]
        watched.type("Radius r/R", r)
        watched.type("Azimuth", psi)
        page.keyboard.press("Escape")
        page.keyboard.press(view)


@pytest.mark.parametrize("scene", ["explorer", "ab", "actuator", "stand", "advancing", "retreating", "reverse"])
def test_screenshots(browser: "Browser", app: App, artefacts: Path, scene: str):
    watched = painted(browser, app.address, "light")
    page = watched.page
    watched.quiet()
    show(watched, scene)
    for scheme in ("light", "dark"):
        page.evaluate("() => document.activeElement?.blur()")
        if scheme == "dark":
            page.keyboard.press("n")
        page.wait_for_selector(f"html[data-mantine-color-scheme={scheme}]", state="attached")
        for width, height in (LARGE, MEDIUM):
            page.set_viewport_size({"width": width, "height": height})
            watched.answered(wholly=True)
            page.wait_for_timeout(2000)  # A card that slides in, and software that draws.
            path = artefacts / f"{scene}-{scheme}-{width}x{height}.png"
            page.screenshot(path=path)
            assert path.stat().st_size > 50_000
            beside = "() => document.querySelector('canvas').getBoundingClientRect().width <= innerWidth - 330"
            assert page.evaluate(beside)  # The rail is not on the canvas.
            assert not re.search(r"\b(NaN|nan|inf|undefined)\b", page.inner_text("body"))
    if scene == "reverse":
        assert "reverse flow" in watched.text("probe-region")
    assert watched.complaints == []
    page.context.close()
