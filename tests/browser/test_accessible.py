"""In any mode or drawer, light or dark, wide or narrow: no violation of the rules of axe-core, by Deque Systems, no
text below 12 px, and contrast by WCAG 2.1 AA (1.4.3) wherever it is known, in drawings too."""

import sys
from pathlib import Path
from typing import Any, Literal

import pytest
from playwright.sync_api import Browser
from watched import WAIT, Visit, Watched, opened

from explorer.app import App

pytestmark = pytest.mark.slow

AXE = next(Path(sys.prefix).glob("axe-core-*/node_modules/axe-core/axe.min.js"), None)
"""`make page` brings it."""
LEGIBLE = (Path(__file__).parent / "legible.js").read_text(encoding="utf-8")
CHECK = """async () => (await axe.run(document, {resultTypes: ['violations']})).violations
    .map(({id, nodes}) => `${id}: ${nodes.slice(0, 3).map(node => node.html.slice(0, 120)).join(' | ')}`)"""
UNREAD = f"""() => {{
    const {{small, faint}} = ({LEGIBLE})();
    return [...small, ...faint];
}}"""
SPOKEN: tuple[tuple[str, Any, str], ...] = (
    ("optimise", "checkbox", "Limit past static angle"),
    ("actuate", "slider", "Voltage [%]"),
    ("explore", "slider", "Δ outboard [°/R]"),
)
"""In each mode the role and name of a control, as a screen reader has them; axe sees to it that all have a name."""


def violations(watched: Watched) -> list[str]:
    """Of what stays: what is stale, or fades in, is faint for a moment."""
    found = ["not asked"]
    for _ in range(20):
        watched.answered()
        watched.page.wait_for_function(
            "() => !document.querySelector('[data-stale]')", timeout=4 * WAIT
        )
        if not (found := watched.page.evaluate(CHECK) + watched.page.evaluate(UNREAD)):
            break
        watched.page.wait_for_timeout(500)
    return found


def with_axe(watched: Watched) -> Watched:
    assert AXE is not None, "axe-core is not installed: run `make page`"
    watched.page.evaluate(AXE.read_text(encoding="utf-8"))
    return watched


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_hard_to_reach(browser: Browser, app: App, scheme: Literal["light", "dark"]):
    watched = with_axe(opened(browser, app.address, scheme=scheme, size=(1500, 940)))
    page = watched.page

    def disk() -> None:
        page.locator("[data-do=view][data-value=disk]").click()
        page.wait_for_selector("html[data-plan]", state="attached")
        assert violations(watched) == [], "disk"
        page.locator("[data-do=view]").first.click()

    for mode, role, name in SPOKEN:
        watched.mode(mode)
        watched.unfold(name)
        page.get_by_role(role, name=name, exact=True).first.wait_for()
        assert violations(watched) == [], mode
    for name in ("mass_t", "law"):
        page.locator(f"[data-handle={name}]").press("Enter")
        page.locator(".rxf-values").wait_for()
        assert violations(watched) == [], name
        page.keyboard.press("Escape")
    disk()
    for drawer in ("open", "share", "details", "probe", "trust", "lecture", "settings"):
        watched.drawer(drawer)
        assert violations(watched) == [], drawer
    page.keyboard.press("Escape")
    page.set_viewport_size({"width": 390, "height": 844})
    for mode in ("optimise", "actuate", "explore"):
        watched.mode(mode)
        assert violations(watched) == [], f"{mode} on a telephone"
    disk()
    watched.close()


def test_what_is_checked_can_fail(visit: Visit):
    watched = with_axe(visit())
    watched.page.wait_for_selector("#rx-veil", state="hidden")
    look = "position: fixed; inset: 0 auto auto 0; background: #fff; color: #999; font-size: 11px"
    added = f'<img src="data:,"><p style="{look}">too small</p>'
    watched.page.evaluate("html => document.body.insertAdjacentHTML('beforeend', html)", added)
    found = watched.page.evaluate(CHECK) + watched.page.evaluate(UNREAD)
    assert any(each.startswith("image-alt") for each in found)
    assert {"too small (11.0 px)", "too small (2.85)"} <= {*found}
