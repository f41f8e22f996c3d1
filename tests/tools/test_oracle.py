"""The oracle of bits: what is masked, what differs, names, and that two runs of one tree are equal."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.tools.oracle.compare import difference, first_difference, read
from tests.tools.oracle.masks import masked
from tests.tools.oracle.plant import KindFailedError, faults_of, plant
from tests.tools.oracle.record import Record, exact, flattened
from tests.tools.oracle.run import KINDS, run_kind

ROOT = Path(__file__).parents[2]
QUICK = ("physics", "text")
"""Kinds of values that take some ten seconds."""


class TestMasks:
    @pytest.mark.parametrize(
        ("one", "other"),
        [
            ("24 × 24 grid, 38 ms.", "24 × 24 grid, 1.2 s."),
            ("22 evaluations, 1.3 s", "22 evaluations, 0.87 s"),
            ('{\\"elapsed_ms\\": 26.78, \\"a\\": 1}', '{\\"elapsed_ms\\": 3.1e-5, \\"a\\": 1}'),
            ("Progress(elapsed=0.045, start=1)", "Progress(elapsed=1e-05, start=1)"),
            ("584 kB (2.4 s).", "584 kB (12 s)."),
            ("30 November 2026, 07:55 · 0.5", "1 May 2024, 23:00 · 0.5"),
            ("12 points in 3 s on 1 worker: 166/min", "12 points in 8 s on 1 worker: 90/min"),
            ("at http://127.0.0.1:8080/", "at http://127.0.0.1:41233/"),
            ("<object at 0x7f12ab34cd56>", "<object at 0x7f99ab34cd00>"),
            ("made 2026-11-30 04:51", "made 2024-01-02 23:00"),
            ("from commit c694ad48", "from commit 9b82d63c+"),
            ('{"commit": "c694ad48"}', '{"commit": "9b82d63c"}'),
            ("30 November 2026, 07:40", "1 December 2026, 00:01"),
            ("Progress(start=1, elapsed=0.33927, n=2)", "Progress(start=1, elapsed=1.2e-05, n=2)"),
        ],
    )
    def test_what_differs_from_run_to_run_is_taken_out(self, one: str, other: str):
        assert one != other
        assert masked(one) == masked(other)

    @pytest.mark.parametrize(
        "text",
        ["902.9 kW", "5 m/s, 30 s of arc", "µ 0.2 at 8 322 kg", "0.3 s", "segments:-14,-8@0.5"],
    )
    def test_numbers_of_the_program_stay(self, text: str):
        assert masked(text) == text

    def test_folders_are_taken_out_the_inner_one_first(self):
        assert masked("/a/b/c.csv in /a", ("/a", "/a/b")) == "…/c.csv in …"

    def test_packed_data_have_a_digest(self):
        one, other = ("data " + letter * 5000 for letter in "xy")
        assert masked(one) != masked(other)
        assert len(masked(one)) < 100


@dataclass(frozen=True)
class Named:
    name: str
    numbers: tuple[float, ...]
    elapsed: float = 0.3


class TestValues:
    def test_one_bit_shows(self):
        field = np.linspace(0.0, 1.0, 50)
        moved = field.copy()
        moved[7] = np.nextafter(moved[7], 2.0)
        assert exact(field) == exact(field.copy())
        assert exact(field) != exact(moved)
        assert exact(field) != exact(field.astype(np.float32))
        assert exact(field) != exact(field.reshape(5, 10))
        assert exact(0.1 + 0.2) != exact(0.3)

    def test_a_file_of_text_is_equal_without_the_commit_that_wrote_it(self):
        assert exact(b"# commit c694ad48\n1,2\n") == exact(b"# commit 9b82d63c\n1,2\n")
        assert exact(b"# commit c694ad48\n1,2\n") != exact(b"# commit c694ad48\n1,3\n")
        assert exact(b"\xff\x001") != exact(b"\xff\x002")

    def test_a_record_has_a_line_for_each_field_and_times_are_masked(self):
        lines = dict(flattened("a", {"b": Named("c", (1.0, 2.0)), "d": {}}))
        assert lines == {
            "a/b/name": '"c"',
            "a/b/numbers": "[1.0, 2.0]",
            "a/b/elapsed": "…",
            "a/d": "{}",
        }

    def test_a_value_is_one_line(self):
        assert "\n" not in exact("two\nlines")

    def test_names_are_kept_once_and_without_a_colon(self):
        record = Record()
        record.keep("a", 1)
        with pytest.raises(ValueError, match="kept twice"):
            record.keep("a", 2)
        with pytest.raises(ValueError, match="colon"):
            record.keep("b: c", 2)

    def test_failures_are_values_and_keep_nothing_else_from_its_answer(self):
        record = Record()
        assert record.ask("gone", "rotor.trim.no_such_module.solve") is None
        assert record.ask("never", "rotor.no_such_name") is None
        assert record.ask("renamed", "math.no_such_name|math.sqrt", 4.0) == 2.0
        record.ask("wrong", "math.sqrt", -1.0)
        record.scenario("whole", _half_a_scenario)
        assert record.lines() == [
            "before: 1",
            "gone: absent from this tree: rotor.trim.no_such_module.solve",
            "never: absent from this tree: rotor.no_such_name",
            "renamed: 2.0",
            "whole/whole: failed: KeyError \"'key'\"",
            'wrong: failed: ValueError "math domain error"',
        ]


def _half_a_scenario(record: Record) -> None:
    record.keep("before", 1)
    raise KeyError("key")


class TestDifferences:
    def test_each_kind_of_difference_is_named(self):
        found = difference("text", {"a": "1", "b": "2", "c": "3"}, {"a": "1", "b": "5", "d": "4"})
        assert (found.changed, found.gone, found.new) == ({"b": ("2", "5")}, ["c"], ["d"])
        words = found.words()
        assert "text: 1 changed, 1 gone, 1 new" in words
        assert all(name in words for name in ("b", "gone: c", "new: d"))
        assert not difference("text", {"a": "1"}, {"a": "1"})

    def test_a_value_with_a_separator_of_its_own_is_one_value(self, tmp_path: Path):
        (tmp_path / "text.txt").write_text("a: 1\x852\nb: 3\n", "utf-8")
        assert read(tmp_path, "text") == {"a": "1\x852", "b": "3"}

    def test_the_first_character_that_differs_is_marked(self):
        there, here = first_difference(f"{'x' * 100} 3.0 kW", f"{'x' * 100} 3.1 kW")
        assert there == f"- …{'x' * 57} 3.⟦0 kW⟧"
        assert here == f"+ …{'x' * 57} 3.⟦1 kW⟧"

    def test_a_text_that_ends_sooner_differs_there(self):
        assert first_difference("ab", "abc") == ("- ab⟦⟧", "+ ab⟦c⟧")


def test_faults_are_small_and_drawn_alike():
    first = faults_of(ROOT, ["explorer/text/line.py"], 8, 1)
    again = faults_of(ROOT, ["explorer/text/line.py"], 8, 1)
    other = faults_of(ROOT, ["explorer/text/line.py"], 8, 2)
    assert list(map(str, first)) == list(map(str, again)) != list(map(str, other))
    assert len({one.text for one in first}) == 8


def kinds() -> list[Any]:
    """All kinds of values; those that take minutes are left to `make nightly`."""
    longer = [kind for kind in KINDS if kind not in QUICK]
    return [*QUICK, *(pytest.param(kind, marks=pytest.mark.nightly) for kind in longer)]


class TestPlant:
    @pytest.fixture
    def root(self, tmp_path: Path) -> Path:
        (tmp_path / "sums.py").write_text("total = 1 + 2\n", "utf-8")
        return tmp_path

    @pytest.mark.parametrize("shows", [True, False])
    def test_a_fault_that_changes_no_value_is_missed(self, root: Path, shows: bool):
        def run(checkout: Path, kind: str, out: Path) -> bool:
            text = (checkout / "sums.py").read_text("utf-8") if shows else "3"
            (out / f"{kind}.txt").write_text(f"total: {text}", "utf-8")
            return True

        missed = plant(root, ["sums.py"], 2, 1, ["text"], run)
        assert len(missed) == (0 if shows else 2)

    def test_a_kind_that_fails_without_a_fault_notices_none(self, root: Path):
        with pytest.raises(KindFailedError, match="text cannot be run"):
            plant(root, ["sums.py"], 1, 1, ["text"], lambda *_: False)


@pytest.mark.slow
@pytest.mark.parametrize("kind", kinds())
def test_two_runs_of_one_tree_are_equal(kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Also with another order of sets; every name that is asked for exists."""
    for seed in ("1", "2"):
        monkeypatch.setenv("PYTHONHASHSEED", seed)
        out = tmp_path / seed
        out.mkdir()
        done, words = run_kind(ROOT, kind, out)
        assert done, words
    first = read(tmp_path / "1", kind)
    second = read(tmp_path / "2", kind)
    between = difference(kind, first, second)
    assert not between, between.words()
    assert [
        name for name, value in first.items() if value.startswith("absent from this tree")
    ] == []
