"""Studies on the page without a page: what is found on disk, the front, charts, and a row flown again."""

import os
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from explorer.tabs import study_charts
from explorer.tabs.studies_panel import find_studies, numbers, open_study, point_line, summary
from rotor.assets import package_version
from rotor.study.chunks import Store, StudyProvenance, evaluate_chunk
from rotor.study.results import HoverCruisePairs, Results, cruise_speeds, design_of_row, hover_cruise_pairs, read_file
from rotor.study.study_file import StudyFile, parse_study
from rotor.trim.solve import solve

TRIMS = """
chunk = 10
[axes]
mu = [0, 0.2]
outboard_rate_deg = [-16, -8]
division = [0.4, 0.6]
[fixed]
concept = "two-segment"
inboard_rate_deg = -12
[models]
inflow = "pitt-peters"
elements = 12
azimuths = 24
"""
OPTIMA = """
[axes]
concept = ["linear", "two-segment-two-airfoils"]
[fixed]
hover_share = 0.5
[models]
inflow = "pitt-peters"
elements = 12
azimuths = 24
[optimum]
starts = 1
"""
WHENCE = StudyProvenance(package_version(), None, "0")


def finished(folder: Path, text: str) -> Results:
    store = Store(folder, StudyFile(parse_study(text), text, "study.toml"), WHENCE)
    for chunk in range(store.study.chunks):
        store.keep(chunk, evaluate_chunk(store.study, chunk, WHENCE).content)
    store.close()
    return open_study(folder)


@pytest.fixture(scope="module")
def trims(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Results]:
    folder = tmp_path_factory.mktemp("page") / "deep" / "trims"
    return folder, finished(folder, TRIMS)


@pytest.fixture(scope="module")
def optima(tmp_path_factory: pytest.TempPathFactory) -> Results:
    return finished(tmp_path_factory.mktemp("page") / "optima", OPTIMA)


def test_results_are_found_beneath_a_folder_but_not_too_deep(trims: tuple[Path, Results]):
    folder, _ = trims
    root = folder.parent.parent
    assert find_studies(root) == find_studies(folder) == {folder: "study"}
    assert find_studies(root / "nowhere") == {}
    buried = root / "a" / "b" / "c" / "d"
    buried.mkdir(parents=True)
    (buried / "_study.json").write_text("{}")
    assert len(find_studies(root)) == 1


def test_a_result_that_has_gone_on_is_read_again(tmp_path: Path):
    store = Store(tmp_path, StudyFile(parse_study(TRIMS.replace("10", "4")), TRIMS, "study.toml"), WHENCE)
    store.keep(0, evaluate_chunk(store.study, 0, WHENCE).content)
    assert open_study(tmp_path).rows == 4
    store.keep(1, evaluate_chunk(store.study, 1, WHENCE).content)
    assert open_study(tmp_path).rows == 8


@pytest.mark.parametrize("row", range(8))
def test_a_row_is_a_design_again(trims: tuple[Path, Results], row: int):
    _, results = trims
    design = design_of_row(results, row)
    assert_allclose(solve(design).power.total, results.columns["power_total_w"][row], rtol=1e-8)


def test_an_optimum_brings_its_blade_with_it(optima: Results):
    for row in range(2):
        design = design_of_row(optima, row)
        assert_allclose(solve(design).power.total, optima.columns["power_total_w"][row], rtol=1e-7)
    assert {span.section for span in design_of_row(optima, 1).rotor.blade.spans} == {"sc1094r8", "sc1095"}


def test_a_single_file_says_enough(trims: tuple[Path, Results]):
    folder, results = trims
    alone = read_file((folder / "chunk-000000.parquet").read_bytes(), "chunk-000000.parquet")
    assert design_of_row(alone, 3) == design_of_row(results, 3)
    with pytest.raises(ValueError, match=r"letter\.txt"):
        read_file(b"dear", "letter.txt")


def test_points_go_by_their_numbers_where_some_are_missing(tmp_path: Path):
    text = TRIMS.replace("chunk = 10", "chunk = 3")
    store = Store(tmp_path, StudyFile(parse_study(text), text, "study.toml"), WHENCE)
    for chunk in (0, 2):
        store.keep(chunk, evaluate_chunk(store.study, chunk, WHENCE).content)
    results = open_study(tmp_path)
    assert [results.row_of(point) for point in (0, 3, 6)] == [0, None, 3]
    assert numbers(results) == "0…7, some not computed yet"
    assert "point 6" in point_line(results, 3, "Taken")
    points = drawn(study_charts.scatter(results, "mu", "power_total_w", "division", None))
    assert sorted(points) == [0, 1, 2, 6, 7]
    assert (points[6].findtext("title") or "").startswith("point 6")


def test_what_only_some_points_have_comes_last(optima: Results):
    names = study_charts.choices(optima)
    whole = [bool(np.isfinite(optima.columns[name]).all()) for name in names]
    assert whole == sorted(whole, reverse=True)
    assert not all(whole)


def test_a_single_point_can_be_drawn(tmp_path: Path):
    results = finished(tmp_path, "[axes]\nmu = [0.2]\n" + TRIMS[TRIMS.index("[models]") :])
    assert study_charts.choices(results)[:2] == ("mu", "power_total_w")
    assert set(drawn(study_charts.scatter(results, "mu", "power_total_w", "mu", None))) == {0}


def test_the_front_is_what_none_beats_in_both():
    hover, cruise = np.array([3.0, 2.0, 1.0, 2.0, 4.0]), np.array([1.0, 2.0, 4.0, 3.0, 1.0])
    assert_array_equal(HoverCruisePairs(hover, cruise, np.arange(5)).best, [True, True, True, False, False])


def test_hover_goes_with_the_cruise_of_the_same_blade(trims: tuple[Path, Results], optima: Results):
    _, results = trims
    assert cruise_speeds(results) == (0.2,)
    pairs = hover_cruise_pairs(results, 0.2)
    assert len(pairs.row) == 4
    for hover, row in zip(pairs.hover, pairs.row, strict=True):
        same = np.flatnonzero(
            (results.columns["mu"] == 0.0)
            & (results.columns["division"] == results.columns["division"][row])
            & (results.columns["outboard_rate_deg"] == results.columns["outboard_rate_deg"][row])
        )
        assert hover == results.columns["power_total_w"][same[0]]
    known = hover_cruise_pairs(optima, cruise_speeds(optima)[0])
    assert_array_equal(known.hover, optima.columns["hover_power_w"])
    assert_allclose(0.5 * (known.hover + known.cruise), optima.columns["mean_power_w"], rtol=1e-7)


def drawn(chart: str) -> dict[int, ElementTree.Element]:
    """The points of a chart by the number that a click writes."""
    circles = ElementTree.fromstring(chart).iter("circle")
    return {int(one.get("data-value") or ""): one for one in circles if one.get("data-write")}


def test_charts_hold_the_points_that_a_click_applies(trims: tuple[Path, Results]):
    _, results = trims
    assert study_charts.choices(results)[:4] == ("mu", "outboard_rate_deg", "division", "power_total_w")
    scatter = study_charts.scatter(results, "mu", "power_total_w", "division", 3)
    points = drawn(scatter)
    assert len(points) == 8
    assert scatter.count('stroke-width="2.5"') == 1  # The ring about the row applied last.
    low, high = (
        points[int(results.columns["point"][k(results.columns["power_total_w"])])] for k in (np.argmin, np.argmax)
    )
    assert float(low.get("cy") or "") > float(high.get("cy") or "")
    pairs = hover_cruise_pairs(results, 0.2)
    front = drawn(study_charts.front(results, pairs, 0.2, None))
    assert (
        set(results.columns["point"][pairs.row[pairs.best]]) <= set(front) <= set(results.columns["point"][pairs.row])
    )
    assert "nan" not in scatter.lower()


def test_many_points_are_thinned_but_the_taken_one_stays():
    count = 10_000
    columns: dict[str, Any] = {"point": np.arange(count, dtype=float), "power_total_w": np.ones(count)}
    columns["status"] = np.array(["converged"] * count, dtype=object)
    results = Results({"title": "Many", "points": 20_000}, (), columns)
    rows = study_charts.picked(np.flatnonzero(results.good), 7)
    assert study_charts.MOST_POINTS <= len(rows) <= study_charts.MOST_POINTS + 1
    assert 7 in rows
    assert "10\u2009000 of 20\u2009000 points" in summary(results)


def test_folders_that_cannot_be_read_are_passed_over(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """As lost+found of a disk, for a service without rights."""
    (tmp_path / "lost").mkdir()
    real = os.stat

    def stat(path: Any, *rest: Any, **more: Any) -> Any:
        if "lost/_" in str(path):
            raise PermissionError(13, "Permission denied", str(path))
        return real(path, *rest, **more)

    monkeypatch.setattr(os, "stat", stat)
    assert find_studies(tmp_path) == {}
