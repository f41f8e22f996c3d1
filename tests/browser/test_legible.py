"""What a person with weak eyes needs: no text below 12 px, and contrast by WCAG 2.1 AA (1.4.3) wherever it is known."""

from pathlib import Path
from typing import Any, Literal

import pytest
from playwright.sync_api import Browser
from watched import Visit, Watched, opened

from explorer.app import App

pytestmark = pytest.mark.slow

MEASURE = (Path(__file__).parent / "legible.js").read_text(encoding="utf-8")


GOOD = {"small": [], "faint": [], "wide": 0}


def found(watched: Watched) -> dict[str, Any]:
    """What is wrong, not only while it comes or goes."""
    watched.answered()
    now = watched.page.evaluate(MEASURE)
    return now if now == GOOD else watched.at_rest(lambda: watched.page.evaluate(MEASURE))


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_text_is_large_and_dark_enough(browser: Browser, app: App, scheme: Literal["light", "dark"]):
    watched = opened(browser, app.address, scheme=scheme)
    page = watched.page
    sizes = ((1920, 1080), (1500, 940), (1280, 720), (768, 1024), (390, 844))
    for wide, high in sizes if scheme == "light" else sizes[1::3]:  # A dark page has other colours, not other sizes.
        page.set_viewport_size({"width": wide, "height": high})
        for mode in ("optimise", "actuate", "explore"):
            watched.mode(mode)
            read = found(watched)
            for _ in range(60):  # What is stale, or fades in, is faint for a moment.
                if read == GOOD:
                    break
                page.wait_for_timeout(250)
                read = found(watched)
            assert read == GOOD, (wide, mode)
        page.locator("[data-do=view][data-value=disk]").click()
        page.wait_for_selector("html[data-plan]", state="attached")
        assert found(watched) == GOOD, (wide, "disk")
        page.locator("[data-do=view]").first.click()
    watched.close()


def test_what_is_measured_can_fail(visit: Visit):
    watched = visit()
    page = watched.page
    page.wait_for_selector("#rx-veil", state="hidden")
    look = "position: fixed; inset: 0 auto auto 0; background: #fff; color: #999; font-size: 11px"
    page.evaluate("html => document.body.insertAdjacentHTML('beforeend', html)", f'<p style="{look}">too small</p>')
    now = found(watched)
    assert now["small"] == ["too small (11.0 px)"]
    assert now["faint"] == ["too small (2.85)"]
