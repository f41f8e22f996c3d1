"""The oracle of bits: it masks what differs by chance, shows every other difference, and repeats itself."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tests.tools.oracle.__main__ import KINDS, ROOT
from tests.tools.oracle.compare import difference, first_difference
from tests.tools.oracle.masks import masked
from tests.tools.oracle.plant import first_change
from tests.tools.oracle.record import Record


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("trimmed in 12.5 ms", "trimmed in 9 ms"),
        ("saved 2026-11-30 at 127.0.0.1:8080", "saved 2027-01-02 at 127.0.0.1:43121"),
        ("<object at 0x7f001122aa>", "<object at 0x7f99bb0011>"),
        ('{"elapsed_s": 0.25}', '{"elapsed_s": 1.5e-3}'),
        ("written to /tmp/a1/sweep.csv", "written to /tmp/b22/sweep.csv"),
    ],
)
def test_times_dates_ports_and_paths_are_masked(one: str, other: str):
    folders = ("/tmp/a1", "/tmp/b22")
    assert masked(one, folders) == masked(other, folders)


@pytest.mark.parametrize(
    ("one", "other"), [("903 kW", "904 kW"), ("less, sure", "more, sure"), ("µ 0.2", "µ 0.20")]
)
def test_numbers_and_words_are_not_masked(one: str, other: str):
    assert masked(one) != masked(other)


def values(power: float, count: int) -> dict[str, str]:
    """What a record keeps of an array with one value of its own."""
    record = Record()
    array = np.ones(count)
    array[-1] = power
    record.keep("power", array)
    return record.values


@pytest.mark.parametrize("count", [3, 500])
def test_the_last_bit_of_an_array_shows(count: int):
    assert values(2.0, count) == values(2.0, count)
    assert values(2.0, count) != values(float(np.nextafter(2.0, 3.0)), count)


def test_a_failure_and_an_absent_name_are_values():
    record = Record()
    record.ask("solve", "rotor.no_such_function")
    record.call("divide", lambda: 1 / 0)
    assert record.values["solve"] == "absent from this tree: rotor.no_such_function"
    assert record.values["divide"] == 'failed: ZeroDivisionError "division by zero"'


def test_each_value_has_a_name_of_its_own():
    record = Record()
    record.keep("power", 1.0)
    with pytest.raises(ValueError, match="kept twice"):
        record.keep("power", 2.0)


def test_a_difference_names_what_changed_and_shows_where():
    there = {"same": "1", "power": "903 kW", "old": "x"}
    here = {"same": "1", "power": "904 kW", "new": "y"}
    found = difference("text", there, here)
    assert found
    assert found.changed == {"power": ("903 kW", "904 kW")}
    assert (found.gone, found.new) == (["old"], ["new"])
    assert first_difference("903 kW", "904 kW") == ("- 90⟦3 kW⟧", "+ 90⟦4 kW⟧")
    assert not difference("text", there, there)


def test_a_fault_is_seen_by_a_value_or_by_a_kind_that_cannot_be_run():
    right = {"text": {"line": "less"}}
    assert first_change(right, {"text": {"line": "more"}}, ["text"]) == "text, line"
    assert first_change(right, {}, ["text"]) == "text could not be run"
    assert first_change(right, right, ["text"]) == ""


@pytest.mark.slow
def test_two_runs_of_a_tree_are_equal(tmp_path: Path):
    """With other hashes of texts, too, on which the order of sets depends."""
    assert "search" in KINDS
    command = [sys.executable, "-m", "tests.tools.oracle", "--only", "search"]
    for seed in ("1", "2"):
        environment = os.environ | {"PYTHONHASHSEED": seed}
        subprocess.run([*command, str(tmp_path / seed)], cwd=ROOT, env=environment, check=True)
    first = (tmp_path / "1" / "search.txt").read_bytes()
    second = (tmp_path / "2" / "search.txt").read_bytes()
    assert first.count(b"\n") > 1000
    assert first == second
