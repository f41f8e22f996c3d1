"""The command line as scripts see it: flags, ranges, JSON and its keys, CSV, exit codes, completion, bad input."""

import csv
import io
import math
import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from numpy.testing import assert_allclose

from rotor import make_design, solve
from rotor.__main__ import build_parser
from rotor.design.quantities import CONDITION
from rotor.study.series import SHARED_COLUMNS, sweep_columns
from rotor.support.user_input import parse_range
from rotor.trim.doubt import sureness
from rotor.trim.export import SCHEMA

KEYS = [
    "schema", "version", "rotor",
    "status", "message", "caveats", "mu", "speed_m_s", "mass_kg", "altitude_m",
    "climb_m_s", "preset", "inflow", "twist", "power_w", "ct", "cp",
    "ct_over_sigma", "cq", "cq_over_sigma", "shaft_torque_nm", "rotor_lift_n", "rotor_drag_n",
    "collective_deg", "cyclic_1c_deg", "cyclic_1s_deg", "coning_deg", "flap_1c_deg", "flap_1s_deg",
    "shaft_tilt_deg", "lambda0", "reverse_flow_area_percent", "stalled_area_percent", "dynamic_stall",
    "stalled_percent", "past_static_percent",
    "elastic_twist_deg", "torsion_frequencies_per_rev", "pitch_link_load_n", "control_power_w",
    "elapsed_ms",
]  # fmt: skip

VIBRATION = ["hub_loads", "hub_loads_note", "blade_frequencies_per_rev"]


QUICK = ("--inflow", "uniform", "--elements", "12", "--azimuths", "24")
FORMATS = (Path(__file__).parents[3] / "docs" / "formats.md").read_text(encoding="utf-8")
Answer = Callable[..., Any]
Printed = Callable[..., str]


def test_json_keys_and_power(answer: Answer):
    found = answer("solve", "--mu", "0.2", "--twist", "linear:-8")
    assert list(found) == [*KEYS, *VIBRATION]
    power = found["power_w"]
    assert list(power) == ["total", "main_rotor", "induced", "profile", "parasite", "climb", "tail"]
    assert_allclose(
        power["main_rotor"], power["induced"] + power["profile"] + power["parasite"], rtol=1e-12
    )
    assert_allclose(power["total"], power["main_rotor"] + power["tail"], rtol=1e-12)
    assert (found["status"], found["twist"]) == ("converged", "linear:-8")
    assert_allclose(found["speed_m_s"], 0.2 * 27.0 * 8.1788, rtol=1e-12)
    loads = found["hub_loads"]
    assert list(loads) == [
        "per_rev",
        "fx_n",
        "fy_n",
        "fz_n",
        "mx_nm",
        "my_nm",
        "index_percent",
        "band_percent",
    ]
    assert loads["band_percent"][0] <= loads["index_percent"] <= loads["band_percent"][1]
    force = math.hypot(0.5 * loads["fx_n"], 0.67 * loads["fy_n"], loads["fz_n"])
    moment = math.hypot(loads["mx_nm"], loads["my_nm"]) / 8.1788
    weight = make_design().condition.weight
    assert_allclose(loads["index_percent"], 100.0 * (force + moment) / weight, rtol=1e-9)
    assert list(found["blade_frequencies_per_rev"]) == ["flap", "lag", "torsion"]


def test_without_hub_loads_a_note_says_why(printed: Printed, answer: Answer):
    slow, unknown = (
        answer("solve", "--mu", "0.1"),
        answer("solve", "--rotor", "r22", "--mu", "0.25"),
    )
    assert slow["hub_loads"] is unknown["hub_loads"] is unknown["blade_frequencies_per_rev"] is None
    assert "Hub loads are not shown below µ 0.2" in slow["hub_loads_note"]
    assert "blade in flap and lag is not known" in unknown["hub_loads_note"]
    assert slow["caveats"] == [one.sentence for one in solve(make_design(mu=0.1)).caveats]
    out = printed("solve", "--mu", "0.3", "--bending")
    for words in (
        "converged: Trimmed.",
        "induced",
        "kW",
        "collective",
        "L/D_e",
        "σ 0.0821",
        "hub loads at 4/rev: fx",
    ):
        assert words in out


@pytest.mark.slow
def test_distribution(printed: Printed, answer: Answer):
    whole = answer("solve", "--mu", "0.2", "--distribution")
    assert list(whole) == [*KEYS, "distribution", *VIBRATION]
    found = whole["distribution"]
    assert len(found["lift_n_per_m"]) == len(found["cm"]) == len(found["r"])
    assert len(found["lift_n_per_m"][0]) == len(found["psi_deg"])
    assert "lift of one blade\n   r/R  mean N/m   max N/m   at ψ" in printed(
        "solve", "--distribution"
    )
    heavy = ("solve", "--mu", "0.5", "--mass-kg", "11000", "--distribution")
    assert answer(*heavy, code=1)["distribution"] is None
    assert "lift of one blade" not in printed(*heavy, code=1)


def test_an_optimum_beyond_autorotation_is_refused(printed: Printed):
    out = printed(
        "optimise", "--mu", "0.2", "--climb-m-s=-14", "--starts", "1", "--no-band", code=1
    )
    assert "descend more slowly, or use the objective induced" in " ".join(out.split())


def test_not_converged_is_exit_1_with_nulls(answer: Answer):
    found = answer("solve", "--hover", "--mass-kg", "20000", "--altitude-m", "4000", code=1)
    assert list(found) == [*KEYS, *VIBRATION]
    assert (found["status"], found["power_w"]["total"]) == ("not-converged", None)
    assert "lower the mass" in found["message"]


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        (["--twist", "linear:-30"], "built with about 20"),
        (["--twist", "linear:8"], "give the opposite sign, as in linear:-8"),
        (["--airfoils", "sc1094r8,sc1095-thesis@0.5"], "by their data, not by their airfoils"),
    ],
)
def test_caveats_of_blades_that_nobody_builds(flags: list[str], words: str, answer: Answer):
    def caveats(*flags: str) -> str:
        return " ".join(answer("solve", "--inflow", "uniform", *flags)["caveats"])

    assert words in caveats(*flags)
    assert words not in caveats("--twist", "linear:-18", "--airfoils", "sc1095-thesis")


def test_sweep_table_and_csv(printed: Printed, answer: Answer, tmp_path: Path):
    path = tmp_path / "sweep.csv"
    out = printed(
        "sweep", "--mu", "0.1:0.3:0.1", "--twist", "linear:-8", "linear:-16", "--csv", str(path)
    )
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    assert [row["mu"] for row in rows] == ["0.1", "0.2", "0.3"] * 2
    assert {row["twist"] for row in rows} == {"linear:-8", "linear:-16"}
    assert out.count("\n") == 7
    columns = [name for name in sweep_columns([make_design()]) if name not in SHARED_COLUMNS]
    left_out = "climb_m_s", "power_climb_w", "status", "caveats", "message"
    level = [name.removeprefix("power_") for name in columns if name not in left_out]
    heads = re.split(" {2,}", out.splitlines()[0])  # Headings stand apart.
    assert [head.replace(" kW", "_w").replace(" ", "_") for head in heads] == level
    assert max(map(len, out.splitlines())) <= 100
    compared = printed(
        "sweep", "--mu", "0.2", "--twist", "linear:-8", "--relative-to", "linear:-8", *QUICK
    )
    assert re.split(" {2,}", compared.splitlines()[0])[-3:] == ["change %", "± %", "sureness"]
    changed = printed(
        "sweep", "--mu", "0.2:0.3:0.1", "--twist", "linear:-8", "linear:-12", "--relative-to",
        "linear:-8", *QUICK,
    )  # fmt: skip
    pairs = re.findall(r"([+-][\d.]+) +([\d.]+) +(sure|likely|unclear)$", changed, re.MULTILINE)
    assert len(pairs) == 2
    for change, band, word in pairs:
        assert sureness(float(change), float(band)) == word
        behind = band.partition(".")[2]
        assert len(change.partition(".")[2]) == len(behind)
        assert not behind or len(band.replace(".", "").lstrip("0")) <= 2
    single = answer("solve", "--mu", "0.2", "--twist", "linear:-8")
    assert_allclose(float(rows[1]["power_total_w"]), single["power_w"]["total"], rtol=1e-9)


def test_airfoil_as_table_and_as_json(printed: Printed, answer: Answer):
    show = "airfoil", "show"
    point = answer(*show, "sc1095", "--mach", "0.7", "--alpha", "4")
    assert list(point) == ["cl", "cd", "cm"]
    # The C81 deck.
    assert_allclose([point["cl"], point["cd"], point["cm"]], [0.72, 0.036, 0.001], atol=0.06)
    assert answer(*show, "sc1095-thesis", "--mach", "0.3", "--alpha", "4")["cm"] is None
    found = answer(*show, "sc1094r8")
    assert found["incidence_offset_deg"] == 1.0
    k = found["mach"].index(0.3)
    # McCroskey's, as in the data tests
    assert_allclose(found["cl_alpha_per_deg"][k], 0.1104, rtol=0.01)
    assert_allclose(found["cm_at_0_deg"][k], -0.0236, atol=1e-3)
    for name in ("sc1095", "sc1095-thesis"):
        shown = printed(*show, name)
        assert "nan" not in shown
        assert len(shown.splitlines()) in (13, 14)  # A long source takes two lines.


def test_ranges():
    assert parse_range("0.4:0.1:-0.1") == parse_range("0.1:0.4:0.1")[::-1]
    assert parse_range("0.05:0.40:0.05") == [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4]
    assert parse_range("0:0.1:0.03") == [0.0, 0.03, 0.06, 0.09]
    assert parse_range("0.2") == [0.2]
    assert parse_range("0.1,0.3") == [0.1, 0.3]


@pytest.mark.parametrize(
    "flags",
    [
        (
            "--trim",
            "wind-tunnel",
            "--shaft-tilt-deg",
            "5",
            "--ct-over-sigma",
            "0.075",
            "--tip-mach",
            "0.6",
        ),
        ("--trim", "free-rotor", "--collective-deg", "2", "--mu", "0.3"),
        (
            "--trim",
            "controls",
            "--collective-deg",
            "7",
            "--cyclic-1s-deg",
            "-4",
            "--density",
            "1.1",
        ),
        ("--trim", "wind-tunnel", "--thrust-n", "60000", "--hover"),
    ],
)
def test_trims_of_a_test_stand(answer: Answer, flags: tuple[str, ...]):
    found = answer("solve", *flags)
    assert found["trim"] == flags[1]
    for key in {"ct_over_sigma", "collective_deg"} & found["stand"].keys():
        assert_allclose(found[key], found["stand"][key], rtol=1e-9)
    assert_allclose(
        found["power_w"]["total"], found["shaft_torque_nm"] * 27.02, rtol=2e-3, atol=1.0
    )
    assert_allclose(
        found["cq_over_sigma"], found["cq"] * found["ct_over_sigma"] / found["ct"], rtol=1e-9
    )


def test_a_sweep_goes_over_any_quantity_of_flight_and_hover(printed: Printed, answer: Answer):
    rows = [
        *csv.DictReader(
            io.StringIO(printed("sweep", "--speed-kt", "60:100:20", "--csv", "-", *QUICK))
        )
    ]
    assert [float(row["speed_kt"]) for row in rows] == [60.0, 80.0, 100.0]
    rows = answer("sweep", "--mu", "0.2", "--mass-kg", "7000,8000", *QUICK)
    assert [row["mass_kg"] for row in rows] == [7000.0, 8000.0]
    assert rows[0]["power_total_w"] < rows[1]["power_total_w"]
    rows = answer("sweep", "--hover", "--isa-offset-c", "0:20:20", *QUICK)
    assert [(row["mu"], row["isa_offset_c"]) for row in rows] == [(0.0, 0.0), (0.0, 20.0)]


def test_a_stand_says_its_altitude_and_a_model_rotor_its_torque(printed: Printed):
    out = printed(
        "solve",
        "--rotor",
        "knight-hefner-3",
        "--hover",
        "--ct-over-sigma",
        "0.01",
        "--altitude-m",
        "900",
    )
    assert "flapping trimmed, 900 m" in out
    assert re.search(r"torque 0\.\d{3} N m", out)


def test_keys_of_the_json_are_documented(answer: Answer):
    found = answer("solve", "--mu", "0.3", "--bending", "--doubt")
    assert (found["schema"], found["rotor"], found["mass_kg"], found["altitude_m"]) == (
        SCHEMA,
        "UH-60A",
        8322.4,
        0.0,
    )
    assert found["version"]
    documented = set(re.findall(r"`([a-z][a-z0-9_]*)`", FORMATS[FORMATS.index("(solve-json)=") :]))
    assert set(found) <= documented


def test_the_ranges_of_the_flight_condition_are_documented():
    for name, row in CONDITION.items():
        stand = f" (on a test stand {row.high_on_stand:g})" if row.high_on_stand else ""
        assert f"`{name}` {row.low:g}…{row.high:g}{stand}" in FORMATS


def test_hub_loads_without_bending_say_whose_they_are(answer: Answer):
    found = answer("solve", "--mu", "0.3")
    assert found["hub_loads"]
    assert "hub loads are those of bending blades" in found["hub_loads_note"]


def test_a_list_that_begins_with_a_minus_is_a_value():
    args = build_parser().parse_args(["optimise", "--mu", "0.2", "--rate-deg", "-20,0"])
    assert args.rate_deg == "-20,0"


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
def test_bash_completes_commands_and_flags(printed: Printed):
    script = printed("completion")
    for words, expected in (("rotor so", "solve"), ("rotor solve --dou", "--doubt")):
        last = len(words.split()) - 1
        program = (
            f'{script}\nCOMP_WORDS=({words})\nCOMP_CWORD={last}\n_rotor\necho "${{COMPREPLY[@]}}"'
        )
        done = subprocess.run(["bash", "-c", program], capture_output=True, text=True, check=True)
        assert done.stdout.split() == [expected]


def test_a_sweep_prints_each_caveat_once_and_none_is_lost(printed: Printed):
    """Two remarks on sections have one name; what differs in numbers alone is one caveat."""
    lines = printed("sweep", "--rotor", "s61", "--mu", "0.1,0.2", "--twist", "linear:-30", *QUICK)
    words = re.sub(r"\s+", " ", lines)
    coarse: Any = {"inflow": "uniform", "elements": 12, "azimuths": 24}
    designs = (make_design(rotor="s61", mu=mu, twist="linear:-30", **coarse) for mu in (0.1, 0.2))
    solutions = list(map(solve, designs))
    first = {
        re.sub(r"[\d.]+", "", one.sentence): one.sentence
        for each in reversed(solutions)
        for one in each.caveats
    }
    assert len(first) > 2
    assert words.count("caveat: ") == len(first)
