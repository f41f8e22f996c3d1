"""`optimise` and `schedule` as scripts see them."""

import csv
import json
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from numpy.testing import assert_allclose

import rotor.command.optimise as command
from rotor.optimisation.results import Progress
from tests.rotor.command.test_command import run
from tests.solved import SAME

CONTRACT = [
    "status", "concept", "parameters", "twist", "power_w", "baseline_power_w", "saving_percent", "band",
    "local_minima", "evaluations", "elapsed_s",
]  # fmt: skip


def no_constant(name: str) -> None:
    pytest.fail(f"{name} in JSON")


def test_optimise_json(capsys: pytest.CaptureFixture[str]):
    code, out, err = run(capsys, "optimise", "--concept", "two-segment", "--mu", "0.25", "--starts", "2", "--json")
    assert (code, err) == (0, "")
    answer = json.loads(out, parse_constant=no_constant)
    assert list(answer)[: len(CONTRACT)] == CONTRACT
    assert answer["status"] == "converged"
    assert list(answer["parameters"]) == list(answer["band"]) == ["inboard_rate_deg", "outboard_rate_deg"]
    for name, value in answer["parameters"].items():
        assert answer["band"][name][0] <= value <= answer["band"][name][1]
    assert answer["local_minima"][0]["power_w"] == answer["power_w"]
    assert_allclose(answer["saving_percent"], 100 * (1 - answer["power_w"] / answer["baseline_power_w"]), rtol=1e-12)
    # The SPEC is the answer: `solve` takes it and finds the same power.
    code, out, _ = run(capsys, "solve", "--mu", "0.25", "--twist", answer["twist"], "--json")
    assert code == 0
    assert_allclose(json.loads(out)["power_w"]["total"], answer["power_w"], rtol=1e-7)


def test_least_vibration(capsys: pytest.CaptureFixture[str]):
    case = ("--mu", "0.3", "--bending", "--inflow", "pitt-peters")
    flags = ("optimise", *case, "--objective", "vibration", "--starts", "2")
    code, out, _ = run(capsys, *flags, "--json")
    answer = json.loads(out, parse_constant=no_constant)
    assert code == 0
    assert answer["index_percent"] < answer["baseline_index_percent"]
    low, high = answer["index_band_percent"]
    assert low - 1e-6 <= answer["index_percent"] <= high + 1e-6
    code, out, _ = run(capsys, "solve", *case, "--twist", answer["twist"], "--json")
    assert_allclose(json.loads(out)["hub_loads"]["index_percent"], answer["index_percent"], rtol=1e-5)
    code, out, _ = run(capsys, *flags)
    for words in (
        "°/R",
        "saving ",
        "within 0.1 % of the index",
        "over inflow models: for comparison, not an absolute level",
    ):
        assert words in out


@pytest.mark.slow
def test_two_airfoils_are_also_compared_on_their_own_sections(capsys: pytest.CaptureFixture[str]):
    flags = ("--preset", "thesis", "--mu", "0.2", "--starts", "1", "--no-band", "--json")
    code, out, _ = run(capsys, "optimise", "--concept", "two-segment-two-airfoils", *flags)
    found = json.loads(out)
    assert code == 0
    assert any("not by their airfoils" in one for one in found["caveats"])
    _, out, _ = run(capsys, "optimise", *flags)
    same = json.loads(out)
    assert found["baseline_power_w"] == pytest.approx(same["baseline_power_w"], rel=SAME)  # That of all other concepts.
    assert same["same_airfoils_power_w"] is None
    thesis = ("--preset", "thesis", "--mu", "0.2", "--airfoils", found["airfoils"], "--json")
    _, out, _ = run(capsys, "solve", *thesis)
    assert_allclose(found["same_airfoils_power_w"], json.loads(out)["power_w"]["total"], rtol=1e-9)


@pytest.mark.slow
def test_flags_set_the_search(capsys: pytest.CaptureFixture[str], tmp_path: Path):
    mission = tmp_path / "mission.csv"
    mission.write_text("mu,hours\n0,1\n0.3,1\n")
    base = ("optimise", "--mu", "0.2", "--starts", "1", "--no-band", "--json")
    answers = []
    for flags in (
        [], ["--objective", "induced"], ["--objective", "hover-cruise", "--hover-share", "0.3"],
        ["--mission", str(mission)], ["--rate-deg=-8,0"], ["--bound", "rate=-6,-2"],
        ["--change-deg", "1", "--on-top"],
        ["--actuator", "MFC_P1", "--plies", "1", "--on-top"],
        ["--preset", "thesis"], ["--inflow", "uniform"],
    ):  # fmt: skip
        code, out, _ = run(capsys, *base, *flags)
        assert code == 0, flags
        answers.append(json.loads(out))
    assert len({answer["power_w"] for answer in answers}) == len(answers)
    assert_allclose(answers[4]["parameters"]["rate_deg"], -8.0, atol=0.01)
    assert answers[5]["active"] == ["rate low"]
    assert answers[6]["active"] == answers[7]["active"] == ["change"]


def test_not_converged_is_exit_1_with_nulls(capsys: pytest.CaptureFixture[str]):
    code, out, err = run(
        capsys, "optimise", "--hover", "--mass-kg", "20000", "--altitude-m", "4000", "--starts", "1", "--json"
    )
    answer = json.loads(out, parse_constant=no_constant)
    assert (code, err) == (1, "")
    assert (answer["status"], answer["twist"], answer["power_w"]) == ("not-converged", None, None)


@pytest.mark.slow
def test_schedule_json_and_csv(capsys: pytest.CaptureFixture[str], tmp_path: Path):
    table = tmp_path / "schedule.csv"
    arguments = (
        "schedule", "--concept", "two-segment", "linear", "--mu", "0,0.2", "--climb-m-s", "2", "--starts", "1",
        "--processes", "1", "--csv", str(table), "--json",
    )  # fmt: skip
    code, out, err = run(capsys, *arguments)
    assert (code, err) == (0, "")
    answer = json.loads(out, parse_constant=no_constant)
    assert list(answer) == ["status", "concepts", "objective", "conditions", "fixed", "worth"]
    assert answer["concepts"] == ["linear", "two-segment"]  # Simple ones first, whatever the order of the flags.
    assert [(condition["mu"], condition["climb_m_s"]) for condition in answer["conditions"]] == [(0.0, 2.0), (0.2, 2.0)]
    for name in answer["concepts"]:
        worth = answer["worth"][name]
        moving = [condition["optima"][name]["power_w"] for condition in answer["conditions"]]
        assert_allclose(worth["moving_w"], sum(moving) / 2, rtol=1e-12)
        assert_allclose(worth["gain_w"], worth["fixed_w"] - worth["moving_w"], rtol=1e-12)
        assert 0.0 <= worth["gain_percent"] < 1.0
    with table.open(newline="") as file:
        assert [row["climb_m_s"] for row in csv.DictReader(file)] == [*["2"] * 4, "", ""]


def test_ctrl_c_prints_the_best_so_far(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch):
    heard: list[float | None] = []

    def interrupting(progress: Progress) -> str:
        heard.append(progress.best_power)
        if len(heard) == 15:
            signal.raise_signal(signal.SIGINT)
        return ""

    monkeypatch.setattr(command, "_words", interrupting)
    before = signal.getsignal(signal.SIGINT)
    code, out, err = run(capsys, "optimise", "--concept", "three-segment-free", "--starts", "100", "--json")
    assert (code, err, len(heard)) == (130, "", 15)
    assert signal.getsignal(signal.SIGINT) is before
    answer = json.loads(out, parse_constant=no_constant)
    assert (answer["status"], answer["power_w"]) == ("stopped", heard[-1])
    assert answer["twist"].startswith("segments:")


def test_ctrl_c_on_a_schedule_prints_the_results_so_far(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    @contextmanager
    def bar(*_: object) -> Iterator[Callable[[str], None]]:
        yield lambda words: signal.raise_signal(signal.SIGINT) if words == "linear condition 2" else None

    monkeypatch.setattr("rotor.command.common.bar", bar)
    flags = ("--mu", "0.1:0.3:0.1", "--inflow", "uniform", "--starts", "1", "--processes", "1", "--json")
    code, out, err = run(capsys, "schedule", "--concept", "linear", *flags)
    answer = json.loads(out, parse_constant=no_constant)
    assert (code, err, answer["status"]) == (130, "", "stopped")
    assert [one["optima"]["linear"] is not None for one in answer["conditions"]] == [True, True, False]
