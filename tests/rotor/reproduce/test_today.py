"""The ladder and the last chapter: conditions that hold whatever the numbers are."""

import csv
import io
import json
import re
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.__main__ import main
from rotor.files.make_design import make_design
from rotor.reproduce.catalogue import find_entry
from rotor.reproduce.ladder import RUNGS, TRIM, Ladder, built, climb
from rotor.reproduce.page import TALK, write_report, write_talk
from rotor.trim.solve import solve


@pytest.fixture(scope="module")
def ladder() -> Ladder:
    return climb((0.0, 0.35))


@pytest.mark.parametrize("mu", [0.0, 0.2, 0.35])
def test_the_ladder_begins_at_thesis_and_ends_at_flight(mu: float):
    thesis = make_design(preset="thesis", twist="linear:-16", mu=mu)
    assert_allclose(solve(built((), mu)).require().power.total, solve(thesis).require().power.total, rtol=1e-12)
    assert built(tuple(RUNGS), mu) == make_design(twist="linear:-16", mu=mu)


@pytest.mark.parametrize("name", RUNGS)
def test_each_rung_changes_something(name: str):
    """Each is a change of its own, by its power at µ 0.35 in the ladder."""
    place = tuple(RUNGS).index(name)
    before, after = (solve(built(tuple(RUNGS)[: place + k], 0.35)).require().power.total for k in (0, 1))
    assert abs(after / before - 1.0) > 1e-4


@pytest.mark.slow
def test_the_moves_add_up_and_the_best_is_a_least(ladder: Ladder):
    first, last = ladder.steps[0], ladder.steps[-1]
    moved = sum(one.moves[-1].in_ladder for one in ladder.steps if one.moves)
    assert_allclose(moved, last.best[-1].rate_deg - first.best[-1].rate_deg, atol=1e-9)
    assert ladder.named == (0.35,)
    both = sum(ladder.moves(name, 0.35).in_ladder for name in TRIM)
    assert_allclose(ladder.moves("trim", 0.35).in_ladder, both, atol=1e-9)
    for one in (first, ladder.step("axial"), last):  # By trims of their own, without the search.
        rates = np.array(one.best[-1].band_deg)
        on = tuple(RUNGS)[: len(RUNGS) if one is last else 5 if one.name == "axial" else 0]
        edges = [solve(built(on, 0.35, f"linear:{rate:.9f}")).require().power.total / 1e3 for rate in rates]
        assert_allclose(edges, 1.001 * one.best[-1].power_kw, rtol=2e-4)
    assert all(-1e-9 <= one.moving.gain < 0.02 for one in ladder.steps)


@pytest.mark.slow
def test_the_ladder_on_the_command_line(ladder: Ladder, capsys: pytest.CaptureFixture[str]):
    assert main(["ladder", "--mu", "0,0.35", "--processes", "1", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["speeds_mu"] == [0.0, 0.35]
    assert [one["step"] for one in found["steps"]] == ["thesis", *RUNGS]
    assert_allclose(
        [one["best_twist_deg"][1] for one in found["steps"]], [one.best[1].rate_deg for one in ladder.steps]
    )
    assert main(["ladder", "--mu", "0,0.35", "--processes", "1"]) == 0
    printed = capsys.readouterr().out
    assert all(words in printed for words in RUNGS.values())
    assert main(["ladder", "--mu", "0,0.35", "--processes", "1", "--csv", "-"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    fast = [row for row in rows if row["mu"] == "0.35"]
    assert [row["step"] for row in fast] == ["thesis", *RUNGS, *(one["inflow"] for one in found["wakes"])]
    assert_allclose(float(fast[0]["best_twist_deg"]), ladder.steps[0].best[1].rate_deg, atol=5e-4)
    assert {row["in_ladder_deg"] for row in rows if row["mu"] == "0"} == {""}
    assert_allclose(float(fast[1]["in_ladder_deg"]), ladder.steps[1].moves[0].in_ladder, atol=5e-4)
    moves = found["trim"]["moves"][0]
    assert moves["in_ladder_deg"] == found["trim"]["moves_deg"] == ladder.moves("trim", 0.35).in_ladder
    assert main(["ladder", "--mu", "0.03,0.2"]) == 2
    assert "0.03 is outside 0.075…0.45" in capsys.readouterr().err
    assert main(["ladder", "--mu", "0.2"]) == 2
    assert "two speeds" in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.nightly
def test_the_page_of_one_screen(tmp_path: Path):
    """Every number of the page is the ladder's; the quotations are the thesis' words."""
    report = find_entry("today").make()
    numbers, found = report.numbers, climb()
    assert numbers["flight_fast"] == found.at("elastic", 0.35).rate_deg
    assert numbers["thesis_hover"] == found.at("thesis", 0.0).rate_deg
    assert 0.0 < numbers["flight_beyond_fixed"] < numbers["thesis_beyond_fixed"]
    write_report(report, tmp_path)
    write_talk([(find_entry("today"), report)], tmp_path)
    page = (tmp_path / TALK).read_text(encoding="utf-8")
    words = re.sub(r"<[^>]+>", " ", page[page.index("<dl>") : page.index("</dl>")])
    assert "What the thesis would have found" in page
    assert "the optimized solution is −13.5°" in words
    answers = [str(answer) for question, answer in report.tables[0].rows if str(question).endswith("?")]
    assert len(answers) == 3
    assert all(len(answer.split()) <= 100 for answer in answers)
    assert len(words.split()) - sum(len(answer.split()) for answer in answers) < 220  # Aloud in about a minute.
    assert 'src="http' not in page
