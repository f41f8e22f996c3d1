"""Undo, history, kept designs, the address, and design files, on the real page."""

import json
from pathlib import Path

import pytest
from watched import COARSE, Visit, Watched

from explorer.model.inputs import Inputs
from rotor import load_design, make_design

START = Inputs()


def design_in_address(watched: Watched, text: str) -> None:
    watched.page.wait_for_function("text => location.search.includes(text)", arg=text)


def shown_kw(watched: Watched) -> str:
    return watched.text("total-power").removesuffix("kW").strip()


def test_undo_redo_and_history(visit: Visit):
    watched = visit()
    page, begun = watched.page, watched.text("total-power")
    watched.type("Inboard", -14.4)
    design_in_address(watched, "segments:-14.4,-8@0.5")
    watched.type("Adv. ratio", 0.22)
    design_in_address(watched, "mu=0.22")
    watched.until(lambda: watched.text("total-power") != begun)
    page.keyboard.press("Escape")  # In a field of numbers, keys are the field's own.
    page.keyboard.press("Control+z")
    page.wait_for_function("() => !location.search.includes('mu=')")
    assert "segments:-14.4" in page.url
    page.keyboard.press("Control+z")
    design_in_address(watched, "segments:-14,-8@0.5")
    watched.says("total-power", begun)
    page.keyboard.press("Control+Shift+z")
    page.keyboard.press("Control+Shift+z")
    design_in_address(watched, "mu=0.22")
    watched.drawer("open")
    watched.section("History")
    page.get_by_role("button", name="Keep this design").click()
    page.locator('[data-explorer="kept"]').wait_for()
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+z")
    design_in_address(watched, "segments:-14,-8@0.5")
    page.locator('[data-explorer="kept"] .rx-kept').click()
    design_in_address(watched, "segments:-14.4,-8@0.5;mu=0.22")
    page.locator('[data-explorer="kept"] a').click()
    page.locator('[data-explorer="kept"]').wait_for(state="detached")


@pytest.mark.slow
def test_save_and_load(visit: Visit, tmp_path: Path):
    watched = visit(COARSE + "&d=1;spline:9,6,0,-5@0.13,0.4,0.75,1;mu=0.1;airfoils=sc1095")
    page = watched.page
    watched.drawer("share")
    with page.expect_download() as download:
        page.get_by_role("button", name="Design file").click()
    saved = tmp_path / download.value.suggested_filename
    download.value.save_as(saved)
    design = load_design(saved)
    assert design.twist.spec() == "spline:9,6,0,-5@0.13,0.4,0.75,1"
    assert design.condition.advance_ratio == 0.1
    before, other = shown_kw(watched), tmp_path / "other.json"
    other.write_text(
        json.dumps({**make_design(twist="linear:-6").to_dict(), "advance_ratio": 0.25}),
        encoding="utf-8",
    )
    watched.drawer("open")
    watched.section("Files")
    file = page.get_by_role("button", name="Load design").locator("xpath=../input[@type='file']")
    file.set_input_files(other)
    design_in_address(watched, "linear:-6;mu=0.25")
    watched.answered()
    loaded = shown_kw(watched)
    assert loaded != before
    bad = tmp_path / "bad.json"
    bad.write_text('{"twist": "linear:-6", "wings": 2}', encoding="utf-8")
    file.set_input_files(bad)
    page.get_by_text("unknown key 'wings'").first.wait_for()
    assert shown_kw(watched) == loaded
    file.set_input_files(saved)
    design_in_address(watched, "spline:9,6,0,-5@0.13,0.4,0.75,1;mu=0.1")
    watched.until(lambda: shown_kw(watched) == before)
