"""`optimise` and `schedule` as scripts see them."""

import csv
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from numpy.testing import assert_allclose

import rotor.command.optimise as command
from rotor import make_design
from rotor.optimisation import standard_mission
from rotor.optimisation.results import Progress
from tests.solved import SAME

CONTRACT = [
    "status", "concept", "parameters", "twist", "power_w", "baseline_power_w", "saving_percent", "band",
    "local_minima", "evaluations", "elapsed_s",
]  # fmt: skip


Answer = Callable[..., Any]


def test_optimise_json(answer: Answer):
    found = answer("optimise", "--concept", "two-segment", "--mu", "0.25", "--starts", "2")
    assert list(found)[: len(CONTRACT)] == CONTRACT
    assert found["status"] == "converged"
    assert (
        list(found["parameters"])
        == list(found["band"])
        == ["inboard_rate_deg", "outboard_rate_deg"]
    )
    for name, value in found["parameters"].items():
        assert found["band"][name][0] <= value <= found["band"][name][1]
    assert found["local_minima"][0]["power_w"] == found["power_w"]
    assert_allclose(
        found["saving_percent"],
        100 * (1 - found["power_w"] / found["baseline_power_w"]),
        rtol=1e-12,
    )
    # The SPEC is the answer: `solve` takes it and finds the same power.
    again = answer("solve", "--mu", "0.25", "--twist", found["twist"])
    assert_allclose(again["power_w"]["total"], found["power_w"], rtol=1e-7)


def test_least_vibration(printed: Callable[..., str], answer: Answer):
    case = ("--mu", "0.3", "--bending", "--inflow", "pitt-peters")
    flags = ("optimise", *case, "--objective", "vibration", "--starts", "2")
    found = answer(*flags)
    assert found["index_percent"] < found["baseline_index_percent"]
    low, high = found["index_band_percent"]
    assert low - 1e-6 <= found["index_percent"] <= high + 1e-6
    again = answer("solve", *case, "--twist", found["twist"])
    assert_allclose(again["hub_loads"]["index_percent"], found["index_percent"], rtol=1e-5)
    out = printed(*flags)
    for words in (
        "°/R",
        "; the best ",
        "within 0.1 % of the index",
        "over inflow models: for comparison, not an absolute level",
    ):
        assert words in out


@pytest.mark.slow
def test_two_airfoils_are_also_compared_on_their_own_sections(answer: Answer):
    flags = ("--preset", "thesis", "--mu", "0.2", "--starts", "1", "--no-band")
    found = answer("optimise", "--concept", "two-segment-two-airfoils", *flags)
    assert any("not by their airfoils" in one for one in found["caveats"])
    same = answer("optimise", *flags)
    # That of all other concepts.
    assert found["baseline_power_w"] == pytest.approx(same["baseline_power_w"], rel=SAME)
    assert same["same_airfoils_power_w"] is None
    alone = answer("solve", "--preset", "thesis", "--mu", "0.2", "--airfoils", found["airfoils"])
    assert_allclose(found["same_airfoils_power_w"], alone["power_w"]["total"], rtol=1e-9)


@pytest.mark.slow
def test_flags_set_the_search(answer: Answer, tmp_path: Path):
    mission = tmp_path / "mission.csv"
    mission.write_text("mu,hours\n0,1\n0.3,1\n")
    base = ("optimise", "--mu", "0.2", "--starts", "1", "--no-band")
    answers = [answer(*base, *flags) for flags in (
        [], ["--objective", "induced"], ["--objective", "hover-cruise", "--hover-share", "0.3"],
        ["--mission", str(mission)], ["--rate-deg=-8,0"], ["--bound", "rate=-6,-2"],
        ["--change-deg", "1", "--on-top"],
        ["--actuator", "MFC_P1", "--plies", "1", "--on-top"],
        ["--preset", "thesis"], ["--inflow", "uniform"],
    )]  # fmt: skip
    assert len({one["power_w"] for one in answers}) == len(answers)
    assert_allclose(answers[4]["parameters"]["rate_deg"], -8.0, atol=0.01)
    assert answers[5]["active"] == ["rate low"]
    assert answers[6]["active"] == answers[7]["active"] == ["change"]


def test_not_converged_is_exit_1_with_nulls(answer: Answer):
    found = answer(
        "optimise", "--hover", "--mass-kg", "20000", "--altitude-m", "4000", "--starts", "1", code=1
    )
    assert (found["status"], found["twist"], found["power_w"]) == ("not-converged", None, None)


@pytest.mark.slow
def test_schedule_json_and_csv(answer: Answer, tmp_path: Path):
    table = tmp_path / "schedule.csv"
    found = answer(
        "schedule", "--concept", "two-segment", "linear", "--mu", "0,0.2", "--climb-m-s", "2", "--starts", "1",
        "--processes", "1", "--csv", str(table),
    )  # fmt: skip
    assert list(found) == ["status", "concepts", "objective", "conditions", "fixed", "worth"]
    # Simple ones first, whatever the order of the flags.
    assert found["concepts"] == [
        "linear",
        "two-segment",
    ]
    assert [(condition["mu"], condition["climb_m_s"]) for condition in found["conditions"]] == [
        (0.0, 2.0),
        (0.2, 2.0),
    ]
    for name in found["concepts"]:
        worth = found["worth"][name]
        moving = [condition["optima"][name]["power_w"] for condition in found["conditions"]]
        assert_allclose(worth["moving_w"], sum(moving) / 2, rtol=1e-12)
        assert_allclose(worth["gain_w"], worth["fixed_w"] - worth["moving_w"], rtol=1e-12)
        assert 0.0 <= worth["gain_percent"] < 1.0
    with table.open(newline="") as file:
        assert [row["climb_m_s"] for row in csv.DictReader(file)] == [*["2"] * 4, "", ""]


def test_ctrl_c_prints_the_best_so_far(answer: Answer, monkeypatch: pytest.MonkeyPatch):
    heard: list[float | None] = []

    def interrupting(progress: Progress) -> str:
        heard.append(progress.best_power)
        if len(heard) == 15:
            signal.raise_signal(signal.SIGINT)
        return ""

    monkeypatch.setattr(command, "_words", interrupting)
    before = signal.getsignal(signal.SIGINT)
    found = answer("optimise", "--concept", "three-segment-free", "--starts", "100", code=130)
    assert len(heard) == 15
    assert signal.getsignal(signal.SIGINT) is before
    assert (found["status"], found["power_w"]) == ("stopped", heard[-1])
    assert found["twist"].startswith("segments:")


def test_a_schedule_flies_the_standard_mission_unless_another_is_given(answer: Answer):
    flags = "--inflow uniform --elements 12 --azimuths 24 --concept linear --starts 1 --processes 1"
    found = answer("schedule", *flags.split())
    mission = standard_mission(make_design())
    assert [
        (condition["mu"], condition["climb_m_s"], condition["hours"])
        for condition in found["conditions"]
    ] == [
        (flown.flight.advance_ratio, flown.flight.climb_speed, flown.hours)
        for flown in sorted(mission.conditions, key=lambda one: one.flight.advance_ratio)
    ]


@pytest.mark.parametrize(("chosen", "assumed"), [("", True), ("--mu 0.1,0.2", False)])
def test_the_text_of_a_schedule_calls_hours_assumed_that_are(
    printed: Callable[..., str], chosen: str, assumed: bool
):
    flags = "--inflow uniform --elements 12 --azimuths 24 --concept linear --starts 1 --processes 1"
    text = printed("schedule", *flags.split(), *chosen.split())
    assert ("The hours of the mission are assumed" in text) == assumed


def test_ctrl_c_on_a_schedule_prints_the_results_so_far(
    answer: Answer, monkeypatch: pytest.MonkeyPatch
):
    @contextmanager
    def bar(*_: object) -> Iterator[Callable[[str], None]]:
        yield (
            lambda words: (
                signal.raise_signal(signal.SIGINT) if words == "linear condition 2" else None
            )
        )

    monkeypatch.setattr("rotor.command.common.bar", bar)
    flags = ("--mu", "0.1:0.3:0.1", "--inflow", "uniform", "--starts", "1", "--processes", "1")
    found = answer("schedule", "--concept", "linear", *flags, code=130)
    assert found["status"] == "stopped"
    assert [one["optima"]["linear"] is not None for one in found["conditions"]] == [
        True,
        True,
        False,
    ]
