"""Names of retired models: every entrance takes them, and says what stands in for them."""

import json
from pathlib import Path

import pytest

from rotor.__main__ import main
from rotor.aero.inflow import INFLOW_MODELS
from rotor.design.design import FLIGHT_MODELS, Models
from rotor.design.quantities import HOVER_INFLOWS
from rotor.files.design_file import design_from_record, load_design, parse_design
from rotor.files.make_design import RETIRED, current_model, make_design
from rotor.study.point import design_of
from rotor.study.study_file import read_study
from rotor.user_input import Notice
from rotor.validation.compare import compare, load_set

QUICK = ("--twist", "linear:-10", "--off", "elastic-twist")
OLD = "dynamic-wake-quick"
"""A retired model of forward flight; all have the same way in."""
SENTENCE = RETIRED[OLD].sentence


def test_what_stands_in_is_there():
    known = {"hover_inflow": tuple(HOVER_INFLOWS), "inflow": tuple(INFLOW_MODELS)}
    names = ["free-wake", "dynamic-wake", "dynamic-wake-quick", "dynamic-wake-infinite-blades", "vortex-wake"]
    assert list(RETIRED) == names
    for name, one in RETIRED.items():
        said: list[str] = []
        assert name not in known[one.option]
        assert current_model(one.option, name, said.append) == one.replacement in known[one.option]
        assert said == [one.sentence]


def test_other_names_stay():
    said: list[str] = []
    assert current_model("inflow", "free-wake", said.append) == "free-wake"
    assert current_model("hover_inflow", "annulus", said.append) == "annulus"
    assert said == []
    with pytest.raises(ValueError, match="'free-wake' is not known: use one of annulus, closed-form"):
        Models(**{**vars(FLIGHT_MODELS), "hover_inflow": "free-wake"})


@pytest.mark.parametrize("name", RETIRED)
def test_design_files(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    """As a record, from disk, uploaded, and on the command line."""
    retired, said = RETIRED[name], list[str]()
    expected, path = make_design(hover=retired.option == "hover_inflow"), tmp_path / "old.json"
    record = {**expected.to_dict(), retired.option: name}
    path.write_text(json.dumps(record), encoding="utf-8")
    assert design_from_record(record, tell=said.append) == expected
    assert parse_design(path.read_bytes(), "old.json", said.append) == expected
    assert said == 2 * [retired.sentence]
    with pytest.warns(Notice, match=retired.sentence):
        assert load_design(path) == expected
    assert main(["solve", "--case", str(path), *QUICK, "--json"]) == 0
    told = capsys.readouterr()
    assert told.err == f"rotor: {retired.sentence}\n"
    assert json.loads(told.out)["inflow"] == retired.replacement


def test_the_thesis_preset_with_the_free_wake():
    """Its own hover is the closed form, but the file asked for a solved one."""
    found = design_from_record({"preset": "thesis", "hover_inflow": "free-wake"}, tell=lambda _: None)
    assert found.models.hover_inflow == "annulus"


@pytest.mark.parametrize("command", [["solve", "--hover"], ["solve", "--speed-kt", "0"], ["sweep", "--mu", "0"]])
def test_the_sentence_is_one_line_on_stderr(command: list[str], capsys: pytest.CaptureFixture[str]):
    code = main([*command, *QUICK, "--inflow", "free-wake"])
    told = capsys.readouterr()
    main([*command, *QUICK, "--inflow", "annulus"])
    plain = capsys.readouterr()
    assert (code, told.err, plain.err) == (0, f"rotor: {RETIRED['free-wake'].sentence}\n", "")
    assert told.out == plain.out


def test_python_and_measured_points():
    with pytest.warns(Notice, match=SENTENCE):
        assert make_design(inflow=OLD).models.inflow == "lifting-line"
    with pytest.warns(Notice, match=SENTENCE):
        assert compare(load_set("xv15-forward-15deg"), OLD).inflow == "lifting-line"


@pytest.mark.parametrize(
    "text",
    [
        f'[axes]\nmu = [0.1, 0.2]\n[models]\ninflow = "{OLD}"\n',
        f'[axes]\nmu = [0.1, 0.2]\ninflow = ["{OLD}", "drees"]\n',
    ],
)
def test_a_study_file(text: str, tmp_path: Path):
    """Its points hold the model that stands in, so that no process of the run says it again."""
    path = tmp_path / "study.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.warns(Notice, match=SENTENCE) as told:
        study = read_study(path).study
    assert len(told) == 1
    assert OLD not in repr(study)


def test_a_row_of_old_results():
    said: list[str] = []
    assert design_of({"inflow": OLD}, {}, said.append).models == FLIGHT_MODELS
    assert said == [SENTENCE]
