"""The page that travels, opened from disk: what its sliders show is what a trim gives."""

import math
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Browser, Page
from test_accessible import AXE, CHECK, LEGIBLE
from test_export import foreign, requests_of
from watched import DRAWN, window

from explorer.export.fitted import Fitted, fitted
from explorer.export.live import live_html
from explorer.model.inputs import ViewState
from explorer.picture.picture import flown_twist
from rotor import make_design, solve
from rotor.trim.doubt import LIKELY, MOST_DECIMALS, MOST_OF_SMALL, SURE, rounded_pair, sureness

DESIGN = make_design(mu=0.3, twist="segments:-12,-6@0.5", inflow="drees", elements=16, azimuths=36)


@pytest.fixture(scope="module")
def made() -> Fitted:
    return fitted(solve(DESIGN))


@pytest.fixture(scope="module")
def path(made: Fitted, tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("live") / "page.html"
    file.write_text(live_html(made.solution), encoding="utf-8")
    return file


@pytest.fixture
def page(browser: Browser, path: Path) -> Iterator[Page]:
    page = window(browser).new_page()
    complaints: list[str] = []
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("console", lambda message: complaints.append(message.text))
    asked = requests_of(page)
    page.goto(path.as_uri())
    yield page
    assert complaints == []
    assert foreign(asked) == []
    assert asked.count(path.as_uri()) == 1
    page.close()


def power(page: Page) -> float:
    return float(page.inner_text("[data-live=total]").removesuffix(" kW"))


def test_a_slider_shows_the_power_that_a_trim_has(page: Page, made: Fitted):
    assert power(page) == pytest.approx(made.solution.power.total / 1e3, abs=0.5)
    slider, colours = (
        page.get_by_label("Outboard"),
        "() => document.querySelector('canvas').toDataURL()",
    )
    before = page.evaluate(colours)
    slider.focus()
    for _ in range(30):
        page.keyboard.press("ArrowRight")
    page.wait_for_function("() => document.querySelector('h1').innerText.includes('−3.0')")
    trim = solve(made.family.design(made.family.scaled([-12.0, -3.0, 0.5])))
    twist = flown_twist(trim, math.radians(ViewState().azimuth_deg))
    exact, tip = trim.power.total, math.degrees(twist([1.0])[0])
    assert abs(exact - made.solution.power.total) > 2e3
    assert power(page) == pytest.approx(exact / 1e3, abs=made.error / 1e3 + 0.5)
    assert page.evaluate(colours) != before
    assert page.locator(".inset .rxf-overlay-cut").count() > 0
    assert f"{tip:+.1f}°".replace("-", "−") in page.locator(".inset svg text").all_text_contents()
    line = page.inner_text("h1")
    assert f"needs {power(page):.0f}\u00a0±\u00a0" in line
    change, within, word = re.findall(
        r": ([\d.]+)\u00a0±\u00a0([\d.]+)\u00a0kW \w+ than as shared, (\w+)", line
    )[0]
    # That of the polynomials is in it.
    assert float(within) >= float(np.sqrt(np.mean(made.errors**2))) / 1e3 - 0.05
    assert word == sureness(float(change), float(within))
    behind = within.partition(".")[2]
    assert len(behind) == len(change.partition(".")[2])
    assert not behind or len(within.replace(".", "").lstrip("0")) <= 2


def test_it_rounds_a_change_and_its_band_as_every_other_view(page: Page):
    draw = np.random.default_rng(5)
    bands = 10.0 ** draw.uniform(-4.0, 2.5, 3000)
    changes = bands * draw.choice([1.0, 2.0, 3.7], 3000) * (1.0 + draw.normal(0.0, 0.05, 3000))
    pairs = np.column_stack((changes, bands)).tolist()
    words = [[SURE, "sure"], [LIKELY, "likely"], [0.0, "unclear"]]
    found = page.evaluate(
        "([pairs, words, most]) => pairs.map(pair => Common.roundedPair(...pair, words, most))",
        [pairs, words, [MOST_DECIMALS, MOST_OF_SMALL]],
    )
    for (change, band), one in zip(pairs, found, strict=True):
        pair = rounded_pair(change, band)
        assert one["decimals"] == pair.decimals, (change, band)
        assert one["change"] == pytest.approx(pair.change, abs=1e-9), (change, band)
        assert one["band"] == pytest.approx(pair.band, abs=1e-9), (change, band)
        assert one["word"] == sureness(change, band)


def test_the_best_twist_and_the_way_back(page: Page, made: Fitted):
    values, best = made.best
    page.get_by_role("button", name="Least power in these ranges").click()
    page.wait_for_function(
        "() => document.querySelector('h1').innerText.includes('less than as shared')"
    )
    assert power(page) == pytest.approx(best.power.total / 1e3, abs=made.error / 1e3 + 0.5)
    shown = [float(page.locator(".slider input").nth(k).input_value()) for k in range(len(values))]
    assert shown == pytest.approx(values)
    page.get_by_role("button", name="As shared").click()
    page.wait_for_function("() => !document.querySelector('h1').innerText.includes('as shared')")


def test_another_field_has_other_colours_and_its_scale(page: Page):
    colours = "() => document.querySelector('canvas').toDataURL()"
    before = page.evaluate(colours)
    page.get_by_role("button", name="Induced inflow λi").click()
    page.wait_for_function(
        "was => document.querySelector('canvas').toDataURL() !== was", arg=before
    )
    assert page.locator("[data-scale]:visible").inner_text().startswith("Induced inflow")


def test_no_other_script_runs(browser: Browser, path: Path, tmp_path: Path):
    other = tmp_path / "other.html"
    text = path.read_text(encoding="utf-8").replace(
        "</main>", "<script>document.title = 'changed'</script></main>"
    )
    other.write_text(text, encoding="utf-8")
    page = window(browser).new_page()
    page.goto(other.as_uri())
    assert page.title() != "changed"
    assert "needs" in page.inner_text("h1")
    with pytest.raises(Exception, match="Failed to fetch"):
        page.evaluate("() => fetch('data:,')")
    page.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_it_fits_any_window_and_paper(page: Page, scheme: str):
    page.emulate_media(media="screen", color_scheme=scheme)  # pyright: ignore[reportArgumentType]
    for width in (390, 812, 1500):
        page.set_viewport_size({"width": width, "height": 844})
        page.wait_for_function("width => innerWidth === width", arg=width)
        page.evaluate(DRAWN)  # It draws its charts for the new width.
        assert page.evaluate("() => document.documentElement.scrollWidth") == width
        assert page.evaluate(f"({LEGIBLE})()")["small"] == []
    page.emulate_media(media="print")
    assert not page.get_by_role("button", name="As shared").is_visible()
    assert page.locator(".plan").is_visible()


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_hard_to_reach(browser: Browser, path: Path, scheme: str):
    assert AXE is not None, "axe-core is not installed: run `make page`"
    page = browser.new_page(color_scheme=scheme)  # pyright: ignore[reportArgumentType]
    page.goto(path.as_uri())
    page.evaluate(AXE.read_text(encoding="utf-8"))
    for width in (1500, 390):
        page.set_viewport_size({"width": width, "height": 844})
        assert page.evaluate(CHECK) == []
    page.close()
