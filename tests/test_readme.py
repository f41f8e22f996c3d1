"""README and CONTRIBUTING: short, and every number in them is one that the program gives."""

import re
import shlex
from functools import partial
from pathlib import Path

import pytest

import rotor
from explorer.__main__ import main as explorer_main
from explorer.model.actuator_inputs import ActuatorInputs
from explorer.model.inputs import OPENING
from explorer.views.actuator import ACTUATOR
from explorer.views.assessed import ACTUATOR_CARD
from rotor.__main__ import main as rotor_main
from rotor.optimisation import mission_at
from rotor.validation.thesis.actuation import SPEEDS, table_5_2
from tests.actuate import actuate, asked, told
from tests.tools import answers, readme

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
ANSWERS = answers.stored()
PLAIN = " ".join(README.split())


def test_the_table_of_trust_is_that_of_the_trust_page():
    assert readme.with_section(README) == README, "python -m tests.tools.readme writes it anew"
    assert len(README.split()) <= 700


def verdicts_on_pages() -> dict[tuple[str, str], set[str]]:
    """The verdicts on each measured quantity by page and name, as the tables of the pages show them."""
    trust = (ROOT / "docs/validation.md").read_text(encoding="utf-8")
    measurements = trust.partition("## Measurement")[2].partition("## Indicative")[0]
    found: dict[tuple[str, str], set[str]] = {}
    for page in re.findall(r"\]\(validation/([\w-]+)\.md\)", measurements):
        text = (ROOT / f"docs/validation/{page}.md").read_text(encoding="utf-8")
        row = r"^\| (.+?)(?:, inflow [\w-]+)? \|.* \| (met|\*\*missed\*\*) \|"
        for quantity, verdict in re.findall(row, text, re.MULTILINE):
            found.setdefault((page, quantity), set()).add(verdict)
    return found


def test_rotors_and_verdicts_are_those_of_the_trust_pages():
    """Every measured rotor has a line; no quantity that misses its target is hidden by others of its page."""
    shown = {row.what for row in readme.trust_rows() if row.set == "doubt"}
    assert {what for what in shown if not what.startswith("Mean")} == {*readme.ROTORS}
    verdicts = verdicts_on_pages()
    met = [words == {"met"} for words in verdicts.values()]
    assert {"met"} < set().union(*verdicts.values())
    said(f"The error of {met.count(True)} of {len(met)} measured quantities is within its target")
    for what, page in readme.ROTORS.items():
        own = [words == {"met"} for (name, _), words in verdicts.items() if name == page]
        (line,) = (line for line in README.splitlines() if line.startswith(f"| {what} |"))
        cell = re.sub(r"\[(.*)\]\(.*\)", r"\1", line.split("|")[-2].strip())
        missed = own.count(False)
        verdict = cell.partition(":")[0]
        if not own:
            assert cell == "none"
        elif not missed:
            assert verdict == "met"
        else:
            several = f"{missed} of {len(own)} missed, worst"
            assert verdict == ("missed" if len(own) == 1 else several)


def test_an_error_of_the_table_is_met_where_it_is_within_its_target():
    for line in README.splitlines():
        sizes = re.findall(r"(\w+): ([\d.]+) %, target ([\d.]+) %", line)
        for word, error, target in sizes:
            assert (float(error) <= float(target)) == (word == "met")


def test_the_part_within_the_band_is_that_of_the_rows_below_it():
    """The mean over rotors: a rotor in hover and in forward flight is one."""
    points: dict[str, list[int]] = {}
    for what in readme.ROTORS:
        (line,) = (line for line in README.splitlines() if line.startswith(f"| {what} |"))
        inside, every = re.search(r"\| (\d+) of (\d+), ±", line).groups()  # type: ignore[union-attr]
        counts = points.setdefault(what.rpartition(", ")[0], [0, 0])
        counts[0] += int(inside)
        counts[1] += int(every)
    share = sum(inside / every for inside, every in points.values()) / len(points)
    said(f"{100 * share:.0f} % of measured powers, in the mean over rotors")


def blocks(language: str = "") -> list[str]:
    fenced = re.findall(r"^```(\w*)\n(.*?)^```", README, re.DOTALL | re.MULTILINE)
    return [text for name, text in fenced if name == language]


def test_the_lines_of_python_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    (code,) = blocks("python")
    assert len([line for line in code.splitlines() if line]) <= 6
    monkeypatch.chdir(tmp_path)
    coarse = partial(rotor.make_design, inflow="uniform", elements=12, azimuths=24)
    monkeypatch.setattr(rotor, "make_design", coarse)
    exec(code, {})
    assert len((tmp_path / "power.csv").read_text(encoding="utf-8").splitlines()) == 4


def test_the_commands_run_as_printed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """In an empty folder, one after another: none needs a file that an earlier one did not write."""
    monkeypatch.chdir(tmp_path)
    lines = [
        shlex.split(line)
        for block in blocks()
        for line in block.splitlines()
        if line.startswith("python -m")
    ]
    assert len(lines) == 4
    for words in lines:
        assert {"rotor": rotor_main, "explorer": explorer_main}[words[2]](words[3:]) == 0
    assert {path.name for path in tmp_path.iterdir()} == {"mine.json", "power.csv", "report.html"}


def said(words: str) -> None:
    assert words in PLAIN, f"README.md does not say: {words}"


@pytest.mark.parametrize("flight", answers.FLIGHTS)
def test_the_best_twist_and_its_band(flight: str):
    assert answers.best_twist(flight) == pytest.approx(ANSWERS["best_twist"][flight], abs=0.03)


@pytest.mark.slow
def test_what_a_twist_that_moves_saves():
    assert answers.twist_follows_speed() == pytest.approx(ANSWERS["twist_follows_speed"], abs=30.0)


@pytest.mark.slow
@pytest.mark.parametrize("place", ["default", "best"])
def test_the_answer_on_actuators_is_that_of_the_page(place: str):
    """The card of Actuate, of a page as it opens, says the same digits and words as README."""
    rows = ANSWERS["same_blade"]
    row = readme.page_default(rows) if place == "default" else rows[0]
    inputs = ActuatorInputs(row["actuator"], concept=row["concept"])
    if place == "default":
        assert inputs == ActuatorInputs()
    now = actuate(OPENING, actuator=inputs)
    verdict = asked(ACTUATOR, now)["lean_verdict"].run()
    (card,) = [ACTUATOR_CARD.view(told(ACTUATOR, now, lean_verdict=verdict))["assessed"]]
    shown = re.fullmatch(r"([\d.]+ ± [\d.]+ kW) more", card.earns)
    assert shown is not None
    said(shown[1])
    said(f"All are {card.sure}.")
    found = answers.row_of(verdict)
    assert found["exceeded"] == row["exceeded"] != []
    assert found["net_saving_w"] == pytest.approx(row["net_saving_w"], abs=30.0)


@pytest.mark.slow
@pytest.mark.nightly
@pytest.mark.parametrize("against", ["same_blade", "best_fixed"])
def test_every_combination_of_actuator_and_twist_law(against: str):
    found = answers.actuators("best-fixed" if against == "best_fixed" else "same-blade")
    by_name = {(row["actuator"], row["concept"]): row for row in ANSWERS[against]}
    assert len(found) == len(by_name) == 24
    for row in found:
        known = by_name[row["actuator"], row["concept"]]
        assert row["exceeded"] == known["exceeded"]
        for name in ("net_saving_w", "band_w"):
            assert row[name] == pytest.approx(known[name], abs=30.0)


@pytest.mark.slow
@pytest.mark.nightly
def test_other_laws_and_the_table_of_the_thesis():
    assert answers.other_laws() == pytest.approx(ANSWERS["other_laws"], abs=0.003)
    row = ANSWERS["best_fixed"][0]
    design = rotor.make_design()
    best = rotor.actuator.try_actuator(
        row["actuator"],
        design,
        mission_at(design, SPEEDS),
        concept=row["concept"],
        against="best-fixed",
    )
    assert 1e3 * table_5_2().numbers["best_kw"] == pytest.approx(best.net_saving, abs=600.0)


def test_pages_that_repeat_an_answer_say_the_same():
    """The notebook of the three questions and the tutorial on actuators."""
    notebook = (ROOT / "docs/notebooks/09_three_questions.py").read_text(encoding="utf-8")
    text = " ".join(notebook.partition("import matplotlib")[0].split())
    best, moving = ANSWERS["best_twist"], ANSWERS["twist_follows_speed"]
    rates = [f"−{-best[flight]['rate_deg']:.1f}" for flight in answers.FLIGHTS]
    assert f"{rates[0]}° per radius in hover" in text
    assert f"{rates[1]}° at 0.35" in text
    assert readme.gain_text(moving) in text
    laws = ANSWERS["other_laws"]
    ends = dict.fromkeys(f"{laws[end]:.1f}" for end in ("least_percent", "most_percent"))
    assert f"save {' to '.join(ends)} % more" in text
    first, best_row = readme.page_default(ANSWERS["same_blade"]), ANSWERS["same_blade"][0]
    for row in (first, best_row, ANSWERS["best_fixed"][0]):
        assert readme.cost_text(row) in text
        assert readme.cost_word(row) in text
    tutorial = (ROOT / "docs/tutorials/actuator.md").read_text(encoding="utf-8")
    assert f"{rates[0]}° per radius in hover and {rates[1]}° at µ 0.35" in tutorial
