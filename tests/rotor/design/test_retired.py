"""Names of retired models: every entrance takes them, and says what stands in for them."""

import json
from pathlib import Path

import pytest

from rotor.__main__ import main
from rotor.aero.inflow import INFLOW_MODELS
from rotor.design.design import FLIGHT_MODELS, HOVER_INFLOWS, Models, preset_models
from rotor.design.retired import RETIRED, current_model
from rotor.files.design_file import design_from_record, load_design, parse_design
from rotor.files.make_design import make_design
from rotor.study.point import design_of
from rotor.study.study_file import read_study
from rotor.user_input import Notice
from rotor.validation.compare import compare, load_set

SENTENCE = "The free wake in hover was retired; hover is solved by the annulus balance."
QUICK = ("--twist", "linear:-10", "--off", "elastic-twist")


OLD_INFLOWS = [name for name, one in RETIRED.items() if one.option == "inflow"]


@pytest.fixture(params=OLD_INFLOWS)
def old_inflow(request: pytest.FixtureRequest) -> str:
    """The name of a retired model of forward flight."""
    return request.param


def test_what_stands_in_is_there():
    known = {"hover_inflow": tuple(HOVER_INFLOWS), "inflow": tuple(INFLOW_MODELS)}
    assert OLD_INFLOWS == ["dynamic-wake", "dynamic-wake-quick", "dynamic-wake-infinite-blades", "vortex-wake"]
    for name, one in RETIRED.items():
        assert name not in known[one.option]
        assert one.replacement in known[one.option]
        assert current_model(one.option, name, lambda _: None) == one.replacement


def test_a_name_of_another_option_stays():
    said: list[str] = []
    assert current_model("inflow", "free-wake", said.append) == "free-wake"
    assert current_model("hover_inflow", "annulus", said.append) == "annulus"
    assert said == []


def test_models_refuse_an_unknown_name():
    with pytest.raises(ValueError, match="'free-wake' is not known: use one of annulus, closed-form"):
        Models(**{**vars(FLIGHT_MODELS), "hover_inflow": "free-wake"})


class TestDesignFile:
    RECORD = make_design(hover=True).to_dict()

    def test_a_record(self):
        said: list[str] = []
        found = design_from_record({**self.RECORD, "hover_inflow": "free-wake"}, tell=said.append)
        assert found == make_design(hover=True)
        assert said == [SENTENCE]

    def test_with_the_thesis_preset_too(self):
        """Its own hover is the closed form, but the file asked for a solved one."""
        said: list[str] = []
        found = design_from_record({"preset": "thesis", "hover_inflow": "free-wake"}, tell=said.append)
        assert found.models.hover_inflow == "annulus"
        assert preset_models("thesis").hover_inflow == "closed-form"

    def test_a_file_and_an_uploaded_one(self, tmp_path: Path):
        path = tmp_path / "old.json"
        path.write_text(json.dumps({**self.RECORD, "hover_inflow": "free-wake"}), encoding="utf-8")
        with pytest.warns(Notice, match=SENTENCE):
            assert load_design(path) == make_design(hover=True)
        said: list[str] = []
        assert parse_design(path.read_bytes(), "old.json", said.append) == make_design(hover=True)
        assert said == [SENTENCE]

    def test_the_annulus_balance_by_name_needs_no_words(self):
        assert design_from_record({**self.RECORD, "hover_inflow": "annulus"}) == make_design(hover=True)

    def test_a_model_of_forward_flight(self, old_inflow: str):
        said: list[str] = []
        assert design_from_record({"inflow": old_inflow}, tell=said.append).models == FLIGHT_MODELS
        assert said == [RETIRED[old_inflow].sentence]


class TestCommand:
    @pytest.mark.parametrize("command", [["solve", "--hover"], ["solve", "--speed-kt", "0"], ["sweep", "--mu", "0"]])
    def test_the_sentence_is_one_line_on_stderr(self, command: list[str], capsys: pytest.CaptureFixture[str]):
        code = main([*command, *QUICK, "--inflow", "free-wake"])
        told = capsys.readouterr()
        main([*command, *QUICK, "--inflow", "annulus"])
        plain = capsys.readouterr()
        assert (code, told.err, plain.err) == (0, f"rotor: {SENTENCE}\n", "")
        assert told.out == plain.out

    def test_a_model_of_forward_flight(self, old_inflow: str, capsys: pytest.CaptureFixture[str]):
        assert main(["solve", "--mu", "0.2", *QUICK, "--inflow", old_inflow, "--json"]) == 0
        told = capsys.readouterr()
        assert told.err == f"rotor: {RETIRED[old_inflow].sentence}\n"
        assert json.loads(told.out)["inflow"] == "lifting-line"

    def test_a_design_file_of_forward_flight(self, old_inflow: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]):
        path = tmp_path / "old.json"
        path.write_text(json.dumps({"advance_ratio": 0.2, "inflow": old_inflow}), encoding="utf-8")
        assert main(["solve", "--case", str(path), *QUICK, "--json"]) == 0
        told = capsys.readouterr()
        assert told.err == f"rotor: {RETIRED[old_inflow].sentence}\n"
        assert json.loads(told.out)["inflow"] == "lifting-line"

    def test_measured_points_of_forward_flight(self, old_inflow: str):
        with pytest.warns(Notice, match="stands in"):
            found = compare(load_set("xv15-forward-15deg"), old_inflow)
        assert found.inflow == "lifting-line"


def test_python_takes_a_retired_name(old_inflow: str):
    with pytest.warns(Notice, match="stands in"):
        assert make_design(inflow=old_inflow).models.inflow == "lifting-line"


class TestStudy:
    def test_a_study_file(self, old_inflow: str, tmp_path: Path):
        """Its points hold the model that stands in, so that no process of the run says it again."""
        path = tmp_path / "study.toml"
        for text in (
            f'[axes]\nmu = [0.1, 0.2]\n[models]\ninflow = "{old_inflow}"\n',
            f'[axes]\nmu = [0.1, 0.2]\ninflow = ["{old_inflow}", "drees"]\n',
        ):
            path.write_text(text, encoding="utf-8")
            with pytest.warns(Notice, match="stands in") as told:
                study = read_study(path).study
            assert len(told) == 1
            assert old_inflow not in repr(study)

    def test_a_row_of_old_results(self, old_inflow: str):
        said: list[str] = []
        assert design_of({"inflow": old_inflow}, {}, said.append).models == FLIGHT_MODELS
        assert said == [RETIRED[old_inflow].sentence]
