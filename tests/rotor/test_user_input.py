"""Files and text of any kind become a value or one short sentence, at once."""

import os
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from rotor.__main__ import main
from rotor.design.twist import read_twist_table
from rotor.files.design_file import load_design, parse_design
from rotor.files.rotor_file import load_rotor
from rotor.optimisation.objective import read_mission
from rotor.study.study_file import read_study
from rotor.support.user_input import (
    check_writable,
    did_you_mean,
    make_folder,
    read_text,
    refusing,
    write_whole,
)

READERS = {
    "design": load_design,
    "rotor": load_rotor,
    "study": read_study,
    "mission": lambda path: read_mission(path, parse_design(b"{}", "a.json")),
    "twist": read_twist_table,
}
DIGITS = "9" * 400
LONG_TWISTS = (
    "+".join(["linear:-1"] * 2000), "segments:" + ",".join(["1"] * 5000), "spline:" + ",".join(["1"] * 5000),
    "linear:" + DIGITS, "x" * 7000, "table:" + "x" * 7000,
)  # fmt: skip


def sentence_of(read, *arguments: object) -> str:
    """The sentence of the refusal, which must come within seconds and not repeat the input at length."""
    begun = time.process_time()
    with pytest.raises(ValueError, match=": ") as refusal:
        read(*arguments)
    assert time.process_time() - begun < 4.0
    sentence = str(refusal.value)
    assert len(sentence) <= 400
    assert "\n" not in sentence
    return sentence


@pytest.mark.parametrize("reader", READERS)
def test_devices_and_pipes_are_refused_without_waiting(reader: str, tmp_path: Path):
    if not hasattr(os, "mkfifo"):
        pytest.skip("this system has no named pipes")
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    for path in (pipe, Path("/dev/zero")):
        assert "is a device or a pipe" in sentence_of(READERS[reader], path)


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize(
    "name", ["a" * 300, "a" * 300 + ".toml", "a/" * 3000 + "b.json", "a\0b.toml", "."]
)
def test_names_that_no_file_can_have_are_refused(reader: str, name: str):
    sentence_of(READERS[reader], Path(name))


@pytest.mark.parametrize("reader", READERS)
def test_a_file_that_is_too_large_is_refused_without_being_read(reader: str, tmp_path: Path):
    path = tmp_path / "large"
    with path.open("wb") as file:
        file.truncate(2**40)  # A sparse file of a terabyte.
    assert "has more than" in sentence_of(READERS[reader], path)


DEEP = {
    "design": [
        "[" * 100_000 + "]" * 100_000,
        '{"rotor":' * 1500 + "1" + "}" * 1500,
        f'{{"mass_kg": {DIGITS}}}',
    ],
    "rotor": ["a = " + "[" * 1500 + "]" * 1500, f'name = "a"\n[main_rotor]\nradius_m = {DIGITS}'],
    "study": ["a = " + "[" * 1500 + "]" * 1500, f"[study]\ntitle = {DIGITS}"],
    "mission": [f"mu\n{DIGITS}"],
    "twist": ["0 0\n" * 300_000, f"0 {DIGITS}\n1 0"],
}


@pytest.mark.parametrize(
    ("reader", "text"), [(name, text) for name, texts in DEEP.items() for text in texts]
)
def test_deep_nesting_and_long_numbers_are_refused(reader: str, text: str, tmp_path: Path):
    path = tmp_path / "deep"
    path.write_text(text, encoding="utf-8")
    assert "9" * 100 not in sentence_of(READERS[reader], path)


@pytest.mark.parametrize("value", ["9" * 5000, DIGITS, "NaN", "Infinity", "-Infinity", "1e400"])
def test_a_design_file_holds_finite_numbers(value: str):
    sentence_of(parse_design, f'{{"mass_kg": {value}}}'.encode(), "a.json")


def test_a_byte_order_mark_and_windows_lines_are_read(tmp_path: Path):
    path = tmp_path / "a.txt"
    path.write_bytes(b"\xef\xbb\xbf0.2 1\r\n1.0 -3\r\n")
    assert read_text(path, "table", "…") == "0.2 1\n1.0 -3\n"
    assert read_twist_table(path).stations == (0.2, 1.0)


@pytest.mark.parametrize("error", [RecursionError(), MemoryError(), IndexError("x" * 999)])
def test_every_failure_becomes_a_sentence(error: Exception):
    @refusing("file 'a'", "check its values")
    def read() -> None:
        raise error

    assert sentence_of(read).startswith("file 'a' ")


@pytest.mark.parametrize(
    "arguments",
    [
        ["solve", "--case", ""], ["solve", "--rotor", ""], ["solve", "--twist", " "], ["solve", "--preset", ""],
        ["solve", "--save", ""], ["actuator", "--what-would-pay", "--plot", ""],
        ["sweep", "--mu", "0.2", "--csv", ""], ["sweep", "--mu", "0.2", "--twist", "linear:-8", ""], ["study", ""],
        ["solve", "--mu", DIGITS], ["solve", "--mass-kg", DIGITS], ["sweep", "--mu", DIGITS],
        ["solve", "--case", "a" * 300], ["solve", "--rotor", "a" * 300], ["solve", "--rotor", "a\0b"],
        ["x" * 7000], *(["solve", "--twist", spec] for spec in LONG_TWISTS),
    ],
    ids=lambda arguments: " ".join(arguments)[:40],
)  # fmt: skip
def test_the_command_line_refuses_in_one_short_line(
    arguments: list[str], refused: Callable[..., str]
):
    assert len(refused(*arguments)) <= 410


DESIGNS = {
    b"": "is not JSON (it is empty): give",
    b" \r\n": "is not JSON (it is empty): give",
    b"mu,power\n0.1,2\n": "is not JSON (line 1, column 1: Expecting value): give",
    '{"mass_kg": 8000, "é": 1}'.encode("cp1252"): "(not UTF-8 text): give",
    b'{"mass_kg": "\\ud800"}': "'\\ud800' holds half of a character: write it whole",
    b'{"a\\ud800": 1}': "holds half of a character: write it whole",
    b'{"mu": 0.2}': "unknown key 'mu': write advance_ratio",
    b'{"speed_kt": 90}': "unknown key 'speed_kt': write advance_ratio",
}


@pytest.mark.parametrize("content", DESIGNS)
def test_a_design_file_is_refused_with_what_is_wrong_in_it(content: bytes):
    assert DESIGNS[content] in sentence_of(parse_design, content, "a.json")


def test_the_name_that_begins_as_given_is_meant():
    assert did_you_mean("lin", ("spline", "linear", "points")) == "; did you mean 'linear'?"
    assert did_you_mean("MFC", ("MFC_P2", "AFC")) == "; did you mean 'MFC_P2'?"
    assert did_you_mean("", ("linear",)) == ""


@pytest.mark.parametrize("command", ["sweep --mu 0.1:0.3:0.01", "schedule --concept all"])
def test_a_file_that_cannot_be_written_is_reported_before_the_work(
    command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    begun = time.process_time()
    assert main([*command.split(), "--csv", str(tmp_path / "none" / "a.csv")]) == 2
    assert time.process_time() - begun < 2.0
    out, err = capsys.readouterr()
    assert out == ""
    assert "cannot write" in err
    assert list(tmp_path.iterdir()) == []


def test_no_folder_is_left_where_nothing_can_be_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    def full(**_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("rotor.support.user_input.tempfile.TemporaryFile", full)
    with pytest.raises(ValueError, match="No space left"):
        make_folder(tmp_path / "a" / "b")
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "own").mkdir()
    with pytest.raises(ValueError, match="No space left"):
        make_folder(tmp_path / "own")
    assert (tmp_path / "own").is_dir()
    with pytest.raises(ValueError, match="cannot write"):
        check_writable(tmp_path / "own")
    with pytest.raises(ValueError, match="cannot write"):
        make_folder("a" * 300)


def test_a_file_that_can_be_written_stays_as_it_is(tmp_path: Path):
    path = tmp_path / "a.csv"
    check_writable(path)
    assert not path.exists()
    path.write_text("kept", encoding="utf-8")
    check_writable(path)
    assert path.read_text(encoding="utf-8") == "kept"
    assert make_folder(tmp_path / "x" / "y").is_dir()


def test_a_save_on_a_full_disk_leaves_the_earlier_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    path = tmp_path / "design.json"
    write_whole(path, "earlier")
    path.chmod(0o640)

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        parse_design(b"{}", "a.json").save(path)
    assert path.read_text(encoding="utf-8") == "earlier"
    assert list(tmp_path.iterdir()) == [path]
    monkeypatch.undo()
    parse_design(b"{}", "a.json").save(path)
    assert load_design(path) == parse_design(b"{}", "a.json")
    assert path.stat().st_mode & 0o777 == 0o640
