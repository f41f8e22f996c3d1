"""Pictures of the page for people to look at, in both schemes and sizes, and what no page may show."""

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from watched import LARGE, MEDIUM, WAIT, Watched, painted

from explorer.app import App

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = [pytest.mark.browser, pytest.mark.slow, pytest.mark.nightly]


def plain(watched: Watched) -> None:
    watched.type("Adv. ratio", 0.3)


def pinned(watched: Watched) -> None:
    watched.page.keyboard.press("p")
    watched.page.wait_for_function("() => RX.state.bar.pinned", timeout=WAIT)
    watched.choose("Twist concept", "Two segments")
    for label, value in (("Inboard", -20), ("Outboard", -2), ("Break point", 0.6)):
        watched.type(label, value)
    watched.page.get_by_role("button", name="Show B − A").click()


def cut(watched: Watched) -> None:
    watched.mode("actuate")
    watched.page.get_by_label("Show blade cut").first.click()
    watched.type("Voltage", 60)
    watched.page.wait_for_selector('[data-explorer="verdict"][data-kind="ready"]', timeout=4 * WAIT)
    watched.page.mouse.move(640, 360)


def stand(watched: Watched) -> None:
    watched.page.locator(".rxf-rotor").select_option(label="XV-15 metal blade")


def probe(watched: Watched, r: float, psi: float, view: str) -> None:
    watched.type("Adv. ratio", 0.37)
    watched.drawer("probe")
    watched.type("Radius r/R", r)
    watched.type("Azimuth", psi)
    watched.page.keyboard.press("Escape")
    watched.page.keyboard.press(view)


SCENES: dict[str, Callable[[Watched], None]] = {
    "explorer": plain,
    "ab": pinned,
    "actuator": cut,
    "stand": stand,
    "probe-advancing": lambda watched: probe(watched, 0.8, 90.0, "1"),
    "probe-retreating": lambda watched: probe(watched, 0.75, 270.0, "3"),
    "probe-reverse": lambda watched: probe(watched, 0.25, 270.0, "4"),
}


def looks(watched: Watched) -> Iterator[str]:
    """An open page in each scheme and size: their names."""
    page = watched.page
    for scheme in ("light", "dark"):
        if scheme == "dark":
            page.evaluate("() => document.activeElement?.blur()")
            page.keyboard.press("n")
        page.wait_for_selector(f"html[data-mantine-color-scheme={scheme}]", state="attached")
        for width, height in (LARGE, MEDIUM):
            page.set_viewport_size({"width": width, "height": height})
            watched.answered(wholly=True)
            page.wait_for_timeout(2000)  # A card that slides in, and software that draws.
            yield f"{scheme}-{width}x{height}"


@pytest.mark.parametrize("name", SCENES)
def test_screenshots(browser: "Browser", app: App, artefacts: Path, name: str):
    watched = painted(browser, app.address, "light")
    watched.quiet()
    SCENES[name](watched)
    for look in looks(watched):
        path = artefacts / f"{name}-{look}.png"
        watched.page.screenshot(path=path)
        assert path.stat().st_size > 50_000
        beside = "() => document.querySelector('canvas').getBoundingClientRect().width <= innerWidth - 330"
        assert watched.page.evaluate(beside)  # The rail is not on the canvas.
        assert not re.search(r"\b(NaN|nan|inf|undefined)\b", watched.page.inner_text("body"))
    if name == "probe-reverse":
        assert "reverse flow" in watched.text("probe-region")
    assert watched.complaints == []
    watched.close()


def test_screenshots_of_report_and_pictures(browser: "Browser", app: App, artefacts: Path, tmp_path: Path):
    from test_export import saved

    watched = painted(browser, app.address, "light", MEDIUM)
    watched.drawer("share")
    watched.page.keyboard.press("m")
    watched.choose("Picture", "3D view")
    saved(watched, "PNG", tmp_path).rename(artefacts / "export-view-light.png")
    report = Watched(watched.page.context.new_page())
    report.page.goto(saved(watched, "Report of this session", tmp_path).as_uri())
    for scheme in ("light", "dark"):
        report.page.emulate_media(color_scheme=scheme)
        report.page.wait_for_timeout(6000)
        report.page.screenshot(path=artefacts / f"report-{scheme}.png", full_page=True)
        assert not re.search(r"\b(NaN|nan|inf|undefined)\b", report.page.inner_text("body"))
    watched.page.keyboard.press("n")
    watched.page.wait_for_selector("html[data-mantine-color-scheme=dark]", state="attached")
    saved(watched, "PNG", tmp_path).rename(artefacts / "export-view-dark.png")
    assert watched.complaints == report.complaints == []
    watched.close()
