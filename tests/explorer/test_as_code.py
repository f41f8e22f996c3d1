"""A design copied as Python or as a command line runs, and has the page's power."""

import contextlib
import io
import json
import math
import os
import shlex
import subprocess
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from explorer.export.as_code import CASE_FILE, as_command_line, as_python, exact_spec
from explorer.model.inputs import Inputs, preset_inflow
from rotor.__main__ import main
from rotor.design.active_twist import ActiveTwist, Harmonic
from rotor.design.design import Design
from rotor.design.twist import LinearTwist, QuadraticTwist, SplineTwist, SumTwist, TableTwist
from rotor.files.make_design import change_airfoils, make_design
from rotor.trim.solve import solve
from rotor.units import degrees_text

ROOT = Path(__file__).parent.parent.parent
SPLINE = SplineTwist((0.13, 0.4, 0.75, 1.0), (0.1234567891234, 0.05, -0.01, -1.0 / 30.0))
DESIGNS = {
    "sliders": Inputs().design(),
    "hover, ideal": Inputs(law="ideal", advance_ratio=0.0).design(),
    "closed form": Inputs(advance_ratio=0.0, hover_inflow="closed-form").design(),
    "forward wake alone": Inputs(advance_ratio=0.05, low_speed="wake").design(),
    "thesis, high": Inputs(preset="thesis", law="three", altitude_m=1500.0, **preset_inflow("thesis")).design(),
    "other inflow": Inputs(law="quadratic", inflow="pitt-peters", mass_t=7.35).design(),
    "descent": Inputs(climb_m_s=-3.5).design(),
    "built-in": Inputs(law="builtin", advance_ratio=0.3).design(),
    "found": Inputs(law="found", found=SPLINE, airfoils="sc1094r8,sc1095@0.5").design(),
    "switches": Inputs(tip_loss=False, reverse_flow=False).design(),
    "on top of another": make_design(twist=SumTwist(make_design().twist, LinearTwist(math.radians(-2.0)))),
    "active": replace(Inputs().design(), active_twist=ActiveTwist((Harmonic(2, 0.02, 0.4),))),
    "other grid": replace(make_design(), models=replace(make_design().models, elements=30, azimuths=72)),
}
BEYOND_FLAGS = {"active"}
ONLY_PYTHON = {"other grid"}


@cache
def power_of(name: str) -> float:
    """[W]"""
    return solve(DESIGNS[name]).power.total


def power_of_script(script: str) -> float:
    """[W], from what the script prints."""
    printed = io.StringIO()
    names: dict[str, object] = {}
    with contextlib.redirect_stdout(printed):
        exec(compile(script, "copied", "exec"), names)
    return 1e3 * float(printed.getvalue().split()[1])


@pytest.mark.parametrize("name", DESIGNS)
def test_the_script_has_the_same_power(name: str):
    names: dict[str, object] = {}
    with contextlib.redirect_stdout(io.StringIO()):
        exec(compile(as_python(DESIGNS[name]), "copied", "exec"), names)
    assert names["design"] == DESIGNS[name]
    assert names["solution"].power.total == pytest.approx(power_of(name), rel=1e-9)  # pyright: ignore[reportAttributeAccessIssue]


@pytest.mark.parametrize("name", sorted(DESIGNS.keys() - ONLY_PYTHON))
def test_the_command_has_the_same_power(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
):
    made = as_command_line(DESIGNS[name])
    monkeypatch.chdir(tmp_path)
    assert (made.case is not None) == (name in BEYOND_FLAGS)
    if made.case is not None:
        (tmp_path / CASE_FILE).write_text(made.case, encoding="utf-8")
        assert "design file" in made.note
    words = shlex.split(made.command.replace("\\\n", " "))
    assert words[:3] == ["python", "-m", "rotor"]
    assert main([*words[3:], "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["power_w"]["total"] == pytest.approx(power_of(name), rel=1e-9)


def test_what_no_flag_and_no_file_holds_is_refused_in_a_sentence():
    for name in ONLY_PYTHON:
        with pytest.raises(ValueError, match="copy it as Python"):
            as_command_line(DESIGNS[name])


def test_a_table_stays_a_table_and_the_reader_is_told_about_its_file(tmp_path: Path):
    path = tmp_path / "twist.txt"
    path.write_text("0.2 5\n0.6 1\n1.0 -4.125\n", encoding="utf-8")
    design = make_design(twist=f"table:{path}")
    assert isinstance(design.twist, TableTwist)
    assert "is read from a file" in as_command_line(design).text
    script = as_python(design)
    path.unlink()  # The script holds the numbers and needs no file.
    assert power_of_script(script) == pytest.approx(solve(design).power.total, abs=1e-3)


def test_specs_are_exact_and_short():
    assert exact_spec(QuadraticTwist(math.radians(8.0), math.radians(-14.1))) == "quadratic:8,-14.1"
    assert degrees_text(math.radians(-12.0)) == "-12"
    assert math.radians(float(degrees_text(1.0 / 30.0))) == pytest.approx(1.0 / 30.0, rel=1e-15)


def test_a_design_with_other_airfoils_says_so_in_flags():
    design = make_design()
    changed = replace(design, rotor=change_airfoils(design.rotor, "sc1094r8,sc1095@0.5"))
    assert "--airfoils sc1094r8,sc1095@0.5" in as_command_line(changed).command


def test_a_long_command_is_broken_into_lines():
    command = as_command_line(DESIGNS["found"]).command
    assert " \\\n" in command
    assert max(map(len, command.splitlines())) < 130


@pytest.mark.slow
@pytest.mark.parametrize("name", ["found", "active"])
def test_a_shell_and_an_interpreter_of_their_own(name: str, tmp_path: Path):
    """As a user pastes them, in new processes."""
    elsewhere: Any = {"cwd": tmp_path, "env": {**os.environ, "PYTHONPATH": str(ROOT)}}
    design: Design = DESIGNS[name]
    power = solve(design).power.total
    (tmp_path / "copied.py").write_text(as_python(design), encoding="utf-8")
    done = subprocess.run([sys.executable, "copied.py"], **elsewhere, capture_output=True, text=True, check=True)
    assert 1e3 * float(done.stdout.split()[1]) == pytest.approx(power, rel=1e-9)
    pasted = as_command_line(design).text.rstrip("\n").replace("python -m", f"{sys.executable} -m") + " --json\n"
    done = subprocess.run(["sh", "-c", pasted], **elsewhere, capture_output=True, text=True, check=True)
    assert json.loads(done.stdout)["power_w"]["total"] == pytest.approx(power, rel=1e-9)
