"""A row of a study is a design again: in Python, and by `solve --row`."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from numpy.testing import assert_allclose

from rotor import load_design, solve
from rotor.study.chunks import StudyFolder, StudyProvenance, arrow_modules, evaluate_chunk
from rotor.study.results import Results, design_at, design_of_row, read_file, read_results
from rotor.study.study_file import StudyFile, parse_study
from rotor.support.assets import package_version
from tests.solved import assert_same_trim

TRIMS = """
chunk = 3
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


def computed(folder: Path, text: str, *chunks: int) -> Results:
    """The results of a study of which these chunks are finished; all without."""
    store = StudyFolder(folder, StudyFile(parse_study(text), text, "study.toml"), WHENCE)
    for chunk in chunks or range(store.study.chunks):
        store.keep(chunk, evaluate_chunk(store.study, chunk, WHENCE).content)
    store.close()
    return read_results(folder)


@pytest.fixture(scope="module")
def trims(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Results]:
    folder = tmp_path_factory.mktemp("rows") / "trims"
    return folder, computed(folder, TRIMS)


@pytest.mark.parametrize("row", range(8))
def test_a_row_is_a_design_again(trims: tuple[Path, Results], row: int):
    _, results = trims
    design = design_of_row(results, row)
    assert_allclose(solve(design).power.total, results.columns["power_total_w"][row], rtol=1e-8)


def test_an_optimum_brings_its_blade_with_it(tmp_path: Path):
    optima = computed(tmp_path / "optima", OPTIMA)
    for row in range(2):
        design = design_of_row(optima, row)
        assert_allclose(solve(design).power.total, optima.columns["power_total_w"][row], rtol=1e-7)
    assert {span.section for span in design_of_row(optima, 1).rotor.blade.spans} == {
        "sc1094r8",
        "sc1095",
    }


def test_a_single_file_says_enough(trims: tuple[Path, Results], tmp_path: Path):
    folder, results = trims
    file = folder / "chunk-000001.parquet"
    alone = read_file(file)
    point = int(alone.columns["point"][0])
    assert design_of_row(alone, 0) == design_at(f"{folder}:{point}") == design_at(f"{file}:{point}")
    row = results.row_of(point)
    assert row is not None
    assert design_of_row(results, row) == design_of_row(alone, 0)
    other = tmp_path / "letter.parquet"
    arrow, parquet = arrow_modules()
    parquet.write_table(arrow.table({"point": [0]}), other)
    for path in (other, Path(__file__)):
        with pytest.raises(ValueError, match="is not a study result"):
            design_at(f"{path}:0")


def test_points_go_by_their_numbers_where_some_are_missing(tmp_path: Path):
    results = computed(tmp_path / "some", TRIMS, 0, 2)
    assert [results.row_of(point) for point in (0, 3, 6)] == [0, None, 3]
    with pytest.raises(ValueError, match="no finished point 3: give one of 0…7"):
        design_at(f"{tmp_path / 'some'}:3")


def test_the_command_solves_and_saves_a_row(
    trims: tuple[Path, Results], tmp_path: Path, answer: Callable[..., Any]
):
    folder, results = trims
    file, row = tmp_path / "row.json", results.row_of(5)
    found = answer("solve", "--row", f"{folder}:5", "--save", str(file))
    assert_allclose(found["power_w"]["total"], results.columns["power_total_w"][row], rtol=1e-8)
    assert_same_trim(solve(load_design(file)), solve(design_at(f"{folder}:5")))
    heavy = answer("solve", "--row", f"{folder}:5", "--mass-kg", "9000")
    assert heavy["power_w"]["total"] > found["power_w"]["total"]
