"""Studies on the page without a page: what is found on disk, the front, charts, and a row flown again."""

import json
import math
import os
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from explorer.tabs.studies import charts as study_charts
from explorer.tabs.studies.panel import StudiesPanel, find_studies, numbers, open_study, point_line, summary
from rotor.assets import package_version
from rotor.study.chunks import StudyProvenance, evaluate_chunk
from rotor.study.findings import HoverCruisePairs, cruise_speeds, hover_cruise_pairs
from rotor.study.results import Results, Store, design_of_row, read_file
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
    (found,) = find_studies(root)
    assert (found.path, found.label(root), found.title) == (folder, "deep/trims", "study")
    assert find_studies(folder) == (found,)
    assert find_studies(root / "nowhere") == ()
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
    drawn = study_charts.scatter(results, "mu", "power_total_w", "division", None, dark=False).data[0]
    assert list(drawn.customdata) == [0, 1, 2, 6, 7]
    assert drawn.hovertext[3].startswith("point 6")


def test_what_only_some_points_have_comes_last_and_texts_are_scales(optima: Results):
    names = study_charts.choices(optima)
    whole = [bool(np.isfinite(optima.columns[name]).all()) for name in names]
    assert whole == sorted(whole, reverse=True)
    assert not all(whole)
    scale = study_charts.parallel(optima, "power_total_w", dark=False).data[0].dimensions[0]
    assert (scale.label, list(scale.values), list(scale.ticktext)) == (
        "concept", [0, 1], ["linear", "two-segment-two-airfoils"]
    )  # fmt: skip


def test_a_single_point_can_be_drawn(tmp_path: Path):
    results = finished(tmp_path, "[axes]\nmu = [0.2]\n" + TRIMS[TRIMS.index("[models]") :])
    assert study_charts.choices(results)[:2] == ("mu", "power_total_w")
    assert len(study_charts.scatter(results, "mu", "power_total_w", "mu", None, dark=False).data[0].x) == 1
    assert study_charts.parallel(results, "mu", dark=False).data[0].dimensions


def test_a_range_of_one_chart_is_not_left_to_the_next(trims: tuple[Path, Results]):
    _, results = trims
    front = study_charts.front(results, hover_cruise_pairs(results, 0.2), 0.2, None, dark=False)
    scatter = study_charts.scatter(results, "mu", "power_total_w", "division", None, dark=False)
    for axis in ("xaxis", "yaxis"):
        assert (front.layout[axis].autorange, scatter.layout[axis].autorange) == (False, True)


def test_without_the_packages_the_tab_says_how_to_get_them(monkeypatch: pytest.MonkeyPatch):
    said: list[str] = []
    monkeypatch.setattr("explorer.tabs.studies.panel.find_spec", lambda name: None)
    client: Any = SimpleNamespace(gui=SimpleNamespace(add_html=said.append))
    state: Any = SimpleNamespace(view=SimpleNamespace(dark=True))
    context: Any = None
    panel = StudiesPanel(client, context, Path())
    assert len(said) == 1
    assert "pip install 'rotor-explorer[study]'" in said[0]
    panel.show(state)
    panel.show_failure()
    panel.stop()


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


@pytest.mark.parametrize("dark", [False, True])
def test_charts_hold_the_rows_that_a_click_takes(trims: tuple[Path, Results], dark: bool):
    _, results = trims
    assert study_charts.choices(results)[:4] == ("mu", "outboard_rate_deg", "division", "power_total_w")
    for figure, points in (
        (study_charts.scatter(results, "mu", "power_total_w", "division", 3, dark), 8),
        (study_charts.front(results, hover_cruise_pairs(results, 0.2), 0.2, None, dark), 4),
        (study_charts.parallel(results, "division", dark), 0),
    ):
        made = json.loads(figure.to_json())
        rows = [row for trace in figure.data[:2] for row in (trace.customdata if trace.customdata is not None else ())]
        assert len(set(rows)) == (points if points else 0)
        assert "NaN" not in json.dumps(made)
    assert max(results.columns["power_total_w"]) > 1e5 > max(study_charts.shown(results, "power_total_w"))


def test_many_points_are_thinned_but_the_taken_one_stays():
    count = 10_000
    columns: dict[str, Any] = {"point": np.arange(count, dtype=float), "power_total_w": np.ones(count)}
    columns["status"] = np.array(["converged"] * count, dtype=object)
    results = Results({"title": "Many", "points": 20_000}, (), columns)
    rows = study_charts.picked(results, 7)
    assert study_charts.MOST_POINTS <= len(rows) <= study_charts.MOST_POINTS + 1
    assert 7 in rows
    assert "10\u2009000 of 20\u2009000 points" in summary(results)


def test_numbers_have_the_digits_that_count():
    values = (8322.4, 0.16172, -11.8512, 0.0, 1e-9, math.nan)
    assert [study_charts.plain(value) for value in values] == ["8\u2009322.4", "0.16172", "−11.851", "0", "0", "–"]


def test_what_is_said_of_a_point_is_escaped(trims: tuple[Path, Results]):
    _, results = trims
    assert "&lt;b&gt;" in point_line(results, 0, "<b>")


def test_folders_that_cannot_be_read_are_passed_over(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """As lost+found of a disk, for a service without rights."""
    (tmp_path / "lost").mkdir()
    real = os.stat

    def stat(path: Any, *rest: Any, **more: Any) -> Any:
        if "lost/_" in str(path):
            raise PermissionError(13, "Permission denied", str(path))
        return real(path, *rest, **more)

    monkeypatch.setattr(os, "stat", stat)
    assert find_studies(tmp_path) == ()
