"""The Studies section in a real browser: a result opened, a click on a point flown, charts changed."""

import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from watched import WAIT, Watched, opened

from explorer.app import App
from explorer.hosting.limits import ServerLimits
from explorer.session import Session
from rotor.assets import package_version
from rotor.study.chunks import Store, StudyProvenance, evaluate_chunk
from rotor.study.results import read_results
from rotor.study.study_file import StudyFile, parse_study
from tests.rotor.study.test_study import BLADES as STUDY

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = [pytest.mark.browser, pytest.mark.slow]
POINTS = "[data-explorer=study-chart] circle[data-value]"


@pytest.fixture(scope="module")
def studies(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with one finished study."""
    folder = tmp_path_factory.mktemp("studies")
    whence = StudyProvenance(package_version(), None, "0")
    store = Store(folder / "blades", StudyFile(parse_study(STUDY), STUDY, "study.toml"), whence)
    store.keep(0, evaluate_chunk(store.study, 0, whence).content)
    store.close()
    return folder


@pytest.fixture(scope="module")
def page(browser: "Browser", studies: Path) -> Iterator[tuple[Watched, Session]]:
    app = App("127.0.0.1", 0, limits=ServerLimits(studies=studies))
    watched = opened(browser, app.address, size=(1280, 900))
    watched.drawer("open")
    yield watched, app.sessions[-1]
    watched.close()
    app.stop()


def test_a_click_on_a_point_puts_it_on_the_sliders(page: tuple[Watched, Session], studies: Path):
    watched, session = page
    tab = watched.page
    watched.choose("Result", "blades")
    tab.wait_for_selector('[data-explorer="study-state"][data-kind="done"]', timeout=WAIT)
    watched.reads("study-state", "36 of 36 points")
    dots = tab.locator(POINTS)
    dots.first.wait_for(timeout=WAIT)
    assert 2 <= dots.count() <= 12  # Blades near the front: each a pair of hover and cruise.
    before = watched.text("total-power")
    dots.last.click(force=True)
    tab.locator("[data-explorer=study-point]", has_text=re.compile("^Applied")).wait_for(timeout=WAIT)
    row = int(watched.text("study-point").split("point ")[1].split()[0])
    results = read_results(studies / "blades")
    inputs = watched.at_rest(session.page.controls.inputs)
    assert (inputs.law, inputs.inflow) == ("two", "pitt-peters")
    assert inputs.advance_ratio == results.columns["mu"][row] == 0.3
    assert inputs.two_inner == pytest.approx(results.columns["inboard_rate_deg"][row])
    assert inputs.two_outer == pytest.approx(results.columns["outboard_rate_deg"][row])
    assert inputs.two_division == pytest.approx(results.columns["division"][row])
    watched.until_changed(lambda: watched.text("total-power"), before)
    assert watched.complaints == []


def test_other_charts_and_a_point_by_its_number(page: tuple[Watched, Session], artefacts: Path):
    watched, session = page
    tab = watched.page
    watched.choose("Chart", "Scatter")
    watched.choose("Horizontal", "break point r/R")
    tab.wait_for_function(f"() => document.querySelectorAll('{POINTS}').length === 36")
    watched.choose("Chart", "Hover against cruise")
    tab.wait_for_function(f"() => document.querySelectorAll('{POINTS}').length <= 12")
    tab.screenshot(path=artefacts / "studies.png")
    watched.type("Point no.", 0)
    tab.wait_for_function("() => document.querySelector('[data-explorer=study-point]')?.innerText.includes('point 0')")
    watched.until(lambda: session.page.controls.inputs().advance_ratio == 0.0)
    watched.type("Point no.", 99)
    tab.wait_for_function("() => document.querySelector('[data-explorer=study-point]')?.innerText.includes('0…35')")
    assert watched.complaints == []


def test_a_file_that_is_no_result_is_one_sentence(page: tuple[Watched, Session], tmp_path: Path):
    watched, _ = page
    tab = watched.page
    wrong = tmp_path / "wrong.parquet"
    wrong.write_bytes(os.urandom(100))
    tab.get_by_text("Not in the list?").click()
    with tab.expect_file_chooser() as chooser:
        tab.get_by_role("button", name="Open a Parquet file").click()
    chooser.value.set_files(wrong)
    tab.wait_for_selector('[data-explorer="study-state"][data-kind="problem"]', timeout=WAIT)
    assert "wrong.parquet" in watched.text("study-state")
    assert watched.complaints == []
