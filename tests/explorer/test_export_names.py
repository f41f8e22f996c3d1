"""Twists that a program made have a name in titles and names of files, and their numbers in the files."""

import io
import json
import re
import zipfile
from dataclasses import replace
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image, ImageFont

from explorer.charts.plots import SWEEP, PowerCurve
from explorer.export.contents import DesignReport, ReportEntry
from explorer.export.provenance import file_name, tables_zip
from explorer.export.report import report_html
from explorer.export.view_picture import CARDS, HEIGHT, SHAPES, font_path, headline, view_png
from explorer.model.actuator_inputs import ActuatorInputs
from explorer.model.inputs import Inputs, ViewState, baseline_of
from explorer.model.units import SI
from explorer.text.design_words import LONGEST_TITLE, title_words
from explorer.text.line import sentence
from rotor import Design, Solution, doubt, make_design, solve

PLAIN = make_design(inflow="drees", elements=16, azimuths=36)
RATES = ",".join(f"{-8 - 0.1 * k:g}" for k in range(40))
BREAKS = ",".join(f"{k / 40:g}" for k in range(1, 40))
SEGMENTS = f"segments:{RATES}@{BREAKS}"
DRIVEN = ActuatorInputs(drives=(77.0,) * 5)
APART = replace(DRIVEN, concept="three-segment", drives=(77.0, -20.0, 10.0, 0.0, 0.0))
CHANGED = replace(
    PLAIN, twist=Inputs(law="builtin", built_inner=-2.5, built_outer=1.3).design().twist
)
DESIGNS: dict[str, tuple[Design, str]] = {
    "driven": (DRIVEN.apply(PLAIN), "UH-60A as built + MFC P1 at 1 155 V"),
    "apart": (
        APART.apply(CHANGED),
        "UH-60A as built + segments −2.5/1.3 at 0.5 + MFC P1 at −100…1 155 V",
    ),
    "segments": (PLAIN.with_twist(SEGMENTS), "UH-60A · 40 segments, −8.9° root to tip"),
    "own": (
        replace(PLAIN, rotor=replace(PLAIN.rotor, name="An own rotor/of <many> words " * 4)),
        "An own rotor/o … > words as built",
    ),
}


@cache
def solution(name: str) -> Solution:
    return solve(DESIGNS[name][0]).require()


@pytest.mark.parametrize("name", DESIGNS)
def test_a_title_is_a_line_and_the_numbers_are_in_the_files(name: str):
    one, (design, said) = solution(name), DESIGNS[name]
    title = title_words(design)
    assert title.replace("\u2009", " ").startswith(said)
    assert len(title) <= LONGEST_TITLE
    for ending in ("-report.html", "-tables.zip", "-as-built.stl", ".json", ".png"):
        assert re.fullmatch(r"[a-z0-9][a-z0-9._-]*", file := file_name(design, ending))
        assert file.endswith(f"-mu0.200{ending}")
        assert len(file) <= 60
    report = DesignReport(
        ReportEntry("Baseline", solve(baseline_of(design))), [ReportEntry("Now", one)], ViewState()
    )
    page = report_html(report, None)
    law = design.to_dict()["twist"]
    assert f'"twist": "{law}"' in page
    assert "segments:" not in law or page.count(law) == 1, "in the design file alone"
    known = np.ones(len(SWEEP))
    with zipfile.ZipFile(
        io.BytesIO(tables_zip(one, PLAIN, PowerCurve(known, known, known), 65.0))
    ) as tables:
        assert tables.namelist() == ["disk.csv", "blade.csv", "power.csv"]
        for table in tables.namelist():
            assert f"twist {design.twist.spec()}" in tables.read(table).decode().splitlines()[0]


@pytest.mark.parametrize("width", SHAPES.values())
@pytest.mark.parametrize("name", DESIGNS)
def test_words_of_the_picture_stay_within_it_above_the_scene(name: str, width: int):
    """The line, however long; a ground that is transparent is nowhere but under words."""
    one = solution(name)
    scene = np.zeros((HEIGHT, width, 4), np.uint8)
    line = f"{sentence(one, SI)} It needs 12 ± 2 kW more than without it, sure; over its limits in voltage and mass."
    with Image.open(
        io.BytesIO(view_png(scene, one, None, line, False, transparent=True))
    ) as picture:
        assert picture.size == (width, HEIGHT)
        assert json.loads(picture.text["Design"])["twist"] == one.design.to_dict()["twist"]  # pyright: ignore[reportAttributeAccessIssue]
        inked = np.asarray(picture)[..., 3] > 0
    rows, columns = (np.flatnonzero(inked.any(axis=axis)) for axis in (1, 0))
    assert rows[0] >= 20
    assert columns[0] >= 38  # A letter may reach over its place.
    assert columns[-1] < width - 39
    assert not inked[round(CARDS.above * HEIGHT) : round((1.0 - CARDS.below) * HEIGHT)].any()


def test_the_line_of_the_picture_has_the_power_and_its_band():
    one = solution("segments")
    words = sentence(one, SI, band=doubt(one))
    assert words.endswith(f"needs {one.power.total / 1e3:.0f} ± {doubt(one).band / 1e3:.0f} kW.")


# The font of the picture's words


def test_without_matplotlib_the_system_has_a_font(monkeypatch: pytest.MonkeyPatch):
    """A base installation: the font is found by its name, and where there is none, a sentence says so."""
    real, asked = ImageFont.truetype, []

    def truetype(name: str, *more: float) -> SimpleNamespace:
        asked.append(name)
        if name != "Arial.ttf":
            raise OSError(name)
        return SimpleNamespace(path="/fonts/Arial.ttf")

    monkeypatch.setattr("explorer.export.view_picture.find_spec", lambda _: None)
    monkeypatch.setattr(ImageFont, "truetype", truetype)
    assert font_path.__wrapped__() == "/fonts/Arial.ttf"
    monkeypatch.setattr(ImageFont, "truetype", lambda *_: real("no such font"))
    with pytest.raises(ValueError, match="install DejaVu Sans, or pip install"):
        font_path.__wrapped__()
    assert asked[0] == "DejaVuSans.ttf"


def test_no_line_of_a_picture_is_but_a_unit():
    line = "The UH-60A of 8.32 t at µ 0.200 (159 km/h) with its twist as built needs 903 ± 76 kW."
    (first, second), _ = headline(line, SHAPES["4:3"] - 80)
    assert f"{first} {second}" == line
    assert len(second) > 0.7 * len(first)
    assert headline(line, SHAPES["16:9"] - 80)[0] == [line]
    assert headline("", 100.0)[0] == [""]
