"""`python -m rotor reproduce`: pictures and numbers as files, and what it gives to the trust page."""

import csv
import json
from collections.abc import Callable
from pathlib import Path

import pytest

from rotor.__main__ import main
from rotor.validation.thesis.catalogue import DRAWINGS, ENTRIES, find_entry, trust_sets
from rotor.validation.thesis.report import Report
from rotor.validation.trust import trust_rows
from tests.shipped_rows import still_true

THESIS = {
    *(f"{chapter}.{k}" for chapter, last in ((2, 9), (3, 15), (4, 13), (5, 10)) for k in range(1, last + 1)),
    "table 3.1", "table 3.2", "table 4.1", "table 5.1", "table 5.2",
}  # fmt: skip


def test_every_figure_of_the_thesis_is_rebuilt_or_listed_as_a_drawing():
    rebuilt = {entry.number for entry in ENTRIES}
    assert not rebuilt & set(DRAWINGS)
    assert rebuilt | set(DRAWINGS) == THESIS | {"tail rotor", "keys 1987"}


@pytest.mark.slow
def test_one_figure(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    out = tmp_path / "made" / "here"
    assert main(["reproduce", str(out), "--figure", "3.11"]) == 0
    assert "Figure 3.11" in capsys.readouterr().out
    names = {path.name for path in out.iterdir()}
    assert {"results.json", "figure-3_11-thesis_kw.csv", "figure-3_11-flight_kw.csv"} <= names
    assert "misprints.csv" not in names
    assert (out / "figure-3_11.svg").read_text(encoding="utf-8").count("<svg") == 1
    assert (out / "figure-3_11.png").read_bytes().startswith(b"\x89PNG")
    (result,) = json.loads((out / "results.json").read_text(encoding="utf-8"))
    assert "−13.5°" in result["statement"]
    assert result["numbers"]
    assert {*result["tables"], *result["pictures"]} <= names
    lines = (out / "figure-3_11-thesis_kw.csv").read_text(encoding="utf-8").splitlines()
    rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    assert rows[0][:2] == ["mass_kg", "ct_over_sigma"]
    assert all(len(row) == len(rows[0]) for row in rows)


def test_figures_are_in_the_order_of_the_document_without_repeats(
    tmp_path: Path, printed: Callable[..., str]
):
    assert find_entry("Figure 3.11") is find_entry("3.11")
    asked = [
        "--table",
        "5.1",
        "--figure",
        "Table 3.2",
        "--figure",
        "table 5.1",
        "--figure",
        "table 3.1",
    ]
    said = printed("reproduce", str(tmp_path), *asked)
    results = json.loads((tmp_path / "results.json").read_text(encoding="utf-8"))
    found = [(one["title"], one["verdict"]) for one in results]
    reproduced = [(f"Table 3.{k}", "input reproduced") for k in (1, 2)]
    assert found == [*reproduced, ("Table 5.1", "no reference")]
    assert all(one["statement"] in said for one in results)


@pytest.mark.slow
def test_rows_and_verdicts_of_the_trust_page_are_reproduced(report: Callable[[str], Report]):
    """Verdicts on the thesis' statements; what is only captioned has no row."""
    shipped = {row.what: row.shown for row in trust_rows() if row.kind == "document"}
    *sets, statements = trust_sets(report(entry.number) for entry in ENTRIES if not entry.slow)
    for one in sets:
        for row in one.rows:
            still_true(row)
    assert {
        row.what for row in statements.rows
    } == shipped.keys()  # None that is slow is checkable.
    for row in statements.rows:
        assert shipped[row.what] == row.shown, row.what
