"""The Export folder in a real browser: every button saves a file, and the report opens by itself."""

import io
import re
import zipfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Browser, Page
from watched import Visit, Watched, opened, window

from explorer.app import App
from explorer.export.contents import DesignReport, ReportEntry
from explorer.export.report import report_html
from explorer.model.actuator_inputs import ActuatorInputs
from explorer.model.inputs import Inputs, ViewState, baseline_of
from rotor import make_design, solve

pytestmark = pytest.mark.slow
START = Inputs(law="linear", linear=-16.0, advance_ratio=0.41)
"""A design with a caveat."""
AS_LEFT = True


@pytest.fixture(scope="module")
def shared(browser: Browser, app: App) -> Iterator[Watched]:
    watched = opened(browser, app.address)
    watched.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    watched.drawer("share")
    watched.page.wait_for_selector('[data-explorer="export"]')
    yield watched
    watched.close()


def until(watched: Watched, kind: str) -> str:
    watched.page.wait_for_selector(f'[data-explorer="export"][data-kind="{kind}"]')
    return watched.text("export")


def saved(watched: Watched, button: str, folder: Path) -> Path:
    """What a button downloads."""
    with watched.page.expect_download() as download:
        watched.page.get_by_role("button", name=button, exact=True).click()
    path = folder / download.value.suggested_filename
    download.value.save_as(path)
    done = "name => document.querySelector('[data-explorer=export][data-kind=done]')?.innerText.includes(name)"
    watched.page.wait_for_function(done, arg=path.name)
    return path


def requests_of(page: Page) -> list[str]:
    """Addresses that a page asks for, as it does so."""
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    return asked


def foreign(asked: list[str]) -> list[str]:
    """Those that lead beyond the file itself: there must be none."""
    return [url for url in asked if not url.startswith(("file:", "blob:", "data:", "about:"))]


@pytest.mark.slow
def test_the_picture_is_the_same_from_a_window_of_another_shape(
    watched: Watched, visit: Visit, tmp_path: Path
):
    telephone = visit(size=(390, 844))
    telephone.answered()
    pictures = []
    for page in (watched, telephone):
        page.drawer("share")
        with Image.open(saved(page, "Picture", tmp_path)) as picture:
            assert picture.size == (1920, 1080)
            pictures.append(np.asarray(picture.convert("RGB")).astype(int))
    # Drawn by software at two sizes of canvas; a disk that stood a pixel elsewhere would differ along its whole rim.
    assert (np.abs(pictures[0] - pictures[1]).max(axis=-1) > 40).mean() < 1e-3
    scale, line = pictures[0][1022:1030, 50:450], pictures[0][20:70, 40:600]
    assert (np.ptp(scale, axis=-1) > 30).mean() > 0.5
    assert np.ptp(line) > 100


def test_the_page_that_travels_is_small_and_has_its_numbers(watched: Watched, tmp_path: Path):
    text = saved(watched, "Page that travels", tmp_path).read_text(encoding="utf-8")
    assert len(text) < 2_000_000
    assert asks_nobody(text)
    assert 'id="model"' in text
    assert f"needs {watched.text('total-power').replace(chr(0x2009), '')}" in text.replace(
        "\u2009", ""
    )


def asks_nobody(text: str) -> bool:
    """Whether the policy that forbids requests stands before the first script."""
    return 0 < text.find("default-src 'none'") < text.index("<script")


def test_the_report_opens_without_a_server_and_requests_nothing(watched: Watched, tmp_path: Path):
    shown = watched.text("total-power")
    watched.page.keyboard.press("m")
    path = saved(watched, "Report", tmp_path)
    assert path.stat().st_size < 3_000_000
    assert asks_nobody(path.read_text(encoding="utf-8"))
    report = Watched(watched.page.context.new_page())
    asked = requests_of(report.page)
    with report.page.expect_console_message(lambda message: "Embedded data loaded" in message.text):
        report.page.goto(path.as_uri())
    assert report.page.locator('[data-report="total-power"]').first.inner_text() == f"{shown} kW"
    assert "reverse flow and stall dominate" in report.page.inner_text(".care")
    assert not re.search(r"\b(NaN|nan|inf|undefined)\b", report.page.inner_text("body"))
    ground = "() => getComputedStyle(document.body).backgroundColor"
    light = report.page.evaluate(ground)
    report.page.get_by_role("button", name="Dark / light").click()
    report.until(lambda: report.page.evaluate(ground) != light)
    report.page.wait_for_timeout(500)
    assert foreign(asked) == []
    assert asked.count(path.as_uri()) == 1
    assert report.complaints == []
    report.page.close()


def test_a_report_fills_three_pages_of_a4(browser: Browser, tmp_path: Path):
    """The blade as built, and one compared with it: overview, disks, tables; no page holds but the end of another."""
    drawn = io.BytesIO()
    Image.new("RGB", (1200, 675)).save(drawn, "WEBP")
    page = window(browser).new_page()
    for inputs in (Inputs(law="builtin"), Inputs(law="builtin", built_inner=-1.0)):
        now, before = solve(inputs.design()), solve(baseline_of(inputs.design()))
        report = DesignReport(
            ReportEntry("As built", before), [ReportEntry("Now", now)], ViewState()
        )
        path = tmp_path / "report.html"
        path.write_text(report_html(report, None, rotor=drawn.getvalue()), encoding="utf-8")
        page.goto(path.as_uri())
        printed = page.pdf(format="A4", prefer_css_page_size=True)
        assert len(re.findall(rb"/Type\s*/Page\b", printed)) == 3
    page.close()


@pytest.mark.parametrize("width", [900, 1500])
def test_no_report_is_wider_than_its_page_and_its_line_is_short(
    browser: Browser, tmp_path: Path, width: int
):
    plain = make_design(inflow="drees", elements=16, azimuths=36)
    rates, breaks = ",".join(["-9.25"] * 40), ",".join(f"{k / 40:g}" for k in range(1, 40))
    named = replace(
        plain,
        rotor=replace(plain.rotor, name="A rotor of one's own with a name that has no end at all"),
    )
    page = window(browser).new_page()
    page.set_viewport_size({"width": width, "height": 900})
    for design in (
        ActuatorInputs(drives=(77.0,) * 5).apply(named),
        plain.with_twist(f"segments:{rates}@{breaks}"),
    ):
        now, before = (
            ReportEntry("Now", solve(design)),
            ReportEntry("Baseline", solve(baseline_of(design))),
        )
        path = tmp_path / "report.html"
        path.write_text(
            report_html(DesignReport(before, [now], ViewState()), None), encoding="utf-8"
        )
        page.goto(path.as_uri())
        assert page.evaluate("() => document.documentElement.scrollWidth") == width
        title = page.locator("h1")
        assert (
            title.evaluate(
                "title => title.offsetHeight / parseFloat(getComputedStyle(title).lineHeight)"
            )
            < 2.5
        )
    page.close()


def test_the_key_brings_the_folder_before_the_eyes(watched: Watched):
    watched.page.keyboard.press("Escape")
    watched.page.wait_for_selector('[data-explorer="export"]', state="detached")
    watched.page.keyboard.press("x")
    watched.page.wait_for_selector('[data-explorer="export"]', state="visible")


def test_a_design_without_an_answer_is_said_to_have_none(watched: Watched, tmp_path: Path):
    watched.type("Altitude", 4000.0)
    watched.page.wait_for_selector('[data-explorer="nearest"]')
    watched.drawer("share")
    with zipfile.ZipFile(saved(watched, "Tables", tmp_path)) as tables:
        assert b"8322 kg, 0 m" in tables.read("power.csv")
    assert "the sliders has no trim" in watched.text("export")
