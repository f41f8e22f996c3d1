"""What commands print and write: ranges of every quantity, JSON and CSV on stdout, keys of the JSON, completion."""

import csv
import io
import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from rotor.__main__ import build_parser, main
from rotor.design.quantities import CONDITION
from rotor.trim.export import SCHEMA

QUICK = ("--inflow", "uniform", "--elements", "12", "--azimuths", "24")
FORMATS = (Path(__file__).parents[3] / "docs" / "formats.md").read_text(encoding="utf-8")


def run(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    assert main(list(words)) == 0
    return capsys.readouterr().out


def test_a_sweep_goes_over_any_quantity_of_flight_and_hover(capsys: pytest.CaptureFixture[str]):
    out = run(capsys, "sweep", "--speed-kt", "60:100:20", "--csv", "-", *QUICK)
    rows = list(csv.DictReader(io.StringIO(out)))
    assert [float(row["speed_kt"]) for row in rows] == [60.0, 80.0, 100.0]
    out = run(capsys, "sweep", "--mu", "0.2", "--mass-kg", "7000,8000", "--json", *QUICK)
    rows = json.loads(out)
    assert [row["mass_kg"] for row in rows] == [7000.0, 8000.0]
    assert rows[0]["total_kw"] < rows[1]["total_kw"]
    rows = json.loads(run(capsys, "sweep", "--hover", "--isa-offset-c", "0:20:20", "--json", *QUICK))
    assert [(row["mu"], row["isa_offset_c"]) for row in rows] == [(0.0, 0.0), (0.0, 20.0)]


def test_a_stand_says_its_altitude_and_a_model_rotor_its_torque(capsys: pytest.CaptureFixture[str]):
    out = run(
        capsys, "solve", "--rotor", "knight-hefner-3", "--hover", "--ct-over-sigma", "0.01", "--altitude-m", "900"
    )
    assert "flapping trimmed, 900 m" in out
    assert re.search(r"torque 0\.\d{3} N m", out)


def test_two_ranges_or_outputs_at_once_are_refused(capsys: pytest.CaptureFixture[str]):
    for words in ([], ["--mu", "0.1:0.3:0.1", "--mass-kg", "7000:8000:500"], ["--mu", "0.1", "--speed-kt", "80"]):
        assert main(["sweep", *words]) == 2
        assert "give one range" in capsys.readouterr().err
    assert main(["sweep", "--mu", "0.1:0.2:0.1", "--csv", "-", "--json"]) == 2
    assert "both print" in capsys.readouterr().err


def test_keys_of_the_json_are_documented(capsys: pytest.CaptureFixture[str]):
    answer = json.loads(run(capsys, "solve", "--mu", "0.3", "--bending", "--doubt", "--json"))
    assert answer["schema"] == SCHEMA
    assert (answer["rotor"], answer["mass_kg"], answer["altitude_m"]) == ("UH-60A", 8322.4, 0.0)
    assert answer["version"]
    documented = set(re.findall(r"`([a-z][a-z0-9_]*)`", FORMATS[FORMATS.index("(solve-json)=") :]))
    assert set(answer) <= documented


def test_the_ranges_of_the_flight_condition_are_documented():
    for name, row in CONDITION.items():
        stand = f" (on a test stand {row.high_on_stand:g})" if row.high_on_stand else ""
        assert f"`{name}` {row.low:g}…{row.high:g}{stand}" in FORMATS


def test_hub_loads_without_bending_say_whose_they_are(capsys: pytest.CaptureFixture[str]):
    answer = json.loads(run(capsys, "solve", "--mu", "0.3", "--json"))
    assert answer["hub_loads"]
    assert "hub loads are those of bending blades" in answer["hub_loads_note"]


def test_a_list_that_begins_with_a_minus_is_a_value():
    args = build_parser().parse_args(["optimise", "--mu", "0.2", "--rate-deg", "-20,0"])
    assert args.rate_deg == "-20,0"


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
def test_bash_completes_commands_and_flags(capsys: pytest.CaptureFixture[str]):
    script = run(capsys, "completion")
    for words, expected in (("rotor so", "solve"), ("rotor solve --dou", "--doubt")):
        last = len(words.split()) - 1
        program = f'{script}\nCOMP_WORDS=({words})\nCOMP_CWORD={last}\n_rotor\necho "${{COMPREPLY[@]}}"'
        done = subprocess.run(["bash", "-c", program], capture_output=True, text=True, check=True)
        assert done.stdout.split() == [expected]
