"""README and CONTRIBUTING: short, and every number in them is one that the program gives."""

import re
import shlex
from functools import partial
from pathlib import Path

import numpy as np
import pytest

import rotor
from explorer.__main__ import main as explorer_main
from rotor.__main__ import main as rotor_main
from rotor.trim.doubt import banded
from rotor.validation.thesis.actuation import table_5_2
from rotor.validation.thesis.optimum_twist import table_4_1
from tests.tools import readme

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
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
        sizes = re.search(r"\[(\w.*): ([\d.]+) %, target ([\d.]+) %\]", line)
        if sizes:
            assert (float(sizes[2]) <= float(sizes[3])) == (sizes[1] == "met")


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


@pytest.mark.parametrize(
    ("where", "given"),
    [("per radius in hover", {"hover": True}), ("at µ 0.35", {"mu": 0.35})],
    ids=["hover", "fast"],
)
def test_the_best_twist_and_its_band(where: str, given: dict):
    found = rotor.optimise(rotor.make_design(**given), "linear")
    (band,) = found.doubt_band
    best, *ends = (
        f"{np.degrees(x):.1f}".replace("-", "−")
        for x in (*found.best.parameters, band.low, band.high)
    )
    said(f"{best}° {where} ({ends[0]} to {ends[1]})")


@pytest.mark.slow
def test_what_a_twist_that_moves_saves():
    found = rotor.schedule(rotor.make_design(), mu=np.arange(8) * 0.05).gain_doubt("linear")
    assert found.change is not None
    assert found.change_band is not None
    low, high = (f"{(-found.change + sign * found.change_band) / 1e3:.0f}" for sign in (-1.0, 1.0))
    said(f"saves {low} to {high} kW over the best fixed twist: {found.sureness}")


@pytest.mark.slow
@pytest.mark.nightly
def test_concepts_and_actuators():
    concepts, actuators = table_4_1().numbers, table_5_2().numbers
    said(
        f"more segments or a curve save {100 * max(concepts[key] for key in ('two', 'three', 'quadratic')):.1f} % more"
    )
    cost, _, word = banded(
        -actuators["best_kw"], actuators["best_band_kw"], "kW", sourced=False
    ).partition(":")
    said(
        f"the best of {actuators['rows']:.0f} combinations of actuator and twist law costs {cost} more than the best "
        f"fixed twist:{word}"
    )
