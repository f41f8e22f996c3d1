"""The command line as scripts see it: flags, JSON keys, exit codes, one line for bad input."""

import csv
import json
import math
from pathlib import Path

import pytest
from numpy.testing import assert_allclose

from rotor import make_design, solve
from rotor.__main__ import main
from rotor.study.series import SHARED_COLUMNS, sweep_columns
from rotor.support.user_input import parse_range

KEYS = [
    "schema", "version", "rotor",
    "status", "message", "caveats", "mu", "speed_m_s", "mass_kg", "altitude_m",
    "climb_m_s", "preset", "inflow", "twist", "power_w", "ct", "cp",
    "ct_over_sigma", "cq", "cq_over_sigma", "shaft_torque_nm", "rotor_lift_n", "rotor_drag_n",
    "collective_deg", "cyclic_1c_deg", "cyclic_1s_deg", "coning_deg", "flap_1c_deg", "flap_1s_deg",
    "shaft_tilt_deg", "lambda0", "reverse_flow_area_percent", "stalled_area_percent", "dynamic_stall",
    "stalled_percent", "elastic_twist_deg", "torsion_frequencies_per_rev", "pitch_link_load_n", "control_power_w",
    "elapsed_ms",
]  # fmt: skip

VIBRATION = ["hub_loads", "hub_loads_note", "blade_frequencies_per_rev"]


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    code = main(list(arguments))
    out, err = capsys.readouterr()
    return code, out, err


def solved(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict:
    code, out, err = run(capsys, "solve", "--json", *arguments)
    assert (code, err) == (0, "")
    return json.loads(out)


def test_json_keys_and_power(capsys: pytest.CaptureFixture[str]):
    answer = solved(capsys, "--mu", "0.2", "--twist", "linear:-8")
    assert list(answer) == [*KEYS, *VIBRATION]
    power = answer["power_w"]
    assert list(power) == ["total", "main_rotor", "induced", "profile", "parasite", "climb", "tail"]
    assert_allclose(power["main_rotor"], power["induced"] + power["profile"] + power["parasite"], rtol=1e-12)
    assert_allclose(power["total"], power["main_rotor"] + power["tail"], rtol=1e-12)
    assert answer["status"] == "converged"
    assert answer["twist"] == "linear:-8"
    assert_allclose(answer["speed_m_s"], 0.2 * 27.0 * 8.1788, rtol=1e-12)
    loads = answer["hub_loads"]
    assert list(loads) == ["per_rev", "fx_n", "fy_n", "fz_n", "mx_nm", "my_nm", "index_percent", "band_percent"]
    assert loads["band_percent"][0] <= loads["index_percent"] <= loads["band_percent"][1]
    force = math.hypot(0.5 * loads["fx_n"], 0.67 * loads["fy_n"], loads["fz_n"])
    moment = math.hypot(loads["mx_nm"], loads["my_nm"]) / 8.1788
    weight = make_design().condition.weight
    assert_allclose(loads["index_percent"], 100.0 * (force + moment) / weight, rtol=1e-9)
    assert list(answer["blade_frequencies_per_rev"]) == ["flap", "lag", "torsion"]


def test_without_hub_loads_a_note_says_why(capsys: pytest.CaptureFixture[str]):
    slow, unknown = solved(capsys, "--mu", "0.1"), solved(capsys, "--rotor", "r22", "--mu", "0.25")
    assert slow["hub_loads"] is unknown["hub_loads"] is unknown["blade_frequencies_per_rev"] is None
    assert "Hub loads are not shown below µ 0.2" in slow["hub_loads_note"]
    assert "blade in flap and lag is not known" in unknown["hub_loads_note"]
    assert slow["caveats"] == [one.sentence for one in solve(make_design(mu=0.1)).caveats]
    code, out, _ = run(capsys, "solve", "--mu", "0.3", "--bending")
    assert code == 0
    for words in ("converged: Trimmed.", "induced", "kW", "collective", "L/D_e", "σ 0.0821", "hub loads at 4/rev: fx"):
        assert words in out


@pytest.mark.slow
def test_distribution(capsys: pytest.CaptureFixture[str]):
    answer = solved(capsys, "--mu", "0.2", "--distribution")
    assert list(answer) == [*KEYS, "distribution", *VIBRATION]
    found = answer["distribution"]
    assert len(found["lift_n_per_m"]) == len(found["cm"]) == len(found["r"])
    assert len(found["lift_n_per_m"][0]) == len(found["psi_deg"])
    assert "lift of one blade\n   r/R  mean N/m   max N/m   at ψ" in run(capsys, "solve", "--distribution")[1]
    heavy = ("solve", "--mu", "0.5", "--mass-kg", "11000", "--distribution")
    code, out, _ = run(capsys, *heavy, "--json")
    assert (code, json.loads(out)["distribution"]) == (1, None)
    assert "lift of one blade" not in run(capsys, *heavy)[1]


def test_an_optimum_beyond_autorotation_is_refused(capsys: pytest.CaptureFixture[str]):
    code, out, _ = run(capsys, "optimise", "--mu", "0.2", "--climb-m-s=-14", "--starts", "1", "--no-band")
    assert code == 1
    assert "descend more slowly, or use the objective induced" in " ".join(out.split())


def test_not_converged_is_exit_1_with_nulls(capsys: pytest.CaptureFixture[str]):
    code, out, err = run(capsys, "solve", "--json", "--hover", "--mass-kg", "20000", "--altitude-m", "4000")
    answer = json.loads(out, parse_constant=lambda name: pytest.fail(f"{name} in JSON"))
    assert (code, err) == (1, "")
    assert list(answer) == [*KEYS, *VIBRATION]
    assert answer["status"] == "not-converged"
    assert answer["power_w"]["total"] is None
    assert "lower the mass" in answer["message"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["solve", "--mu", "0.2", "--hover"], "--hover"),
        (["optimize", "--hover"], "did you mean 'optimise'?"),
        (["solve", "--twst", "linear:-8"], "did you mean '--twist'?"),
        (["sweep", "--mu", "0.4:0.1:0.1"], "write 0.4:0.1:-0.1 or 0.1:0.4:0.1"),
        (["schedule", "--hover"], "--hover is not a flag of this command; see"),
        (["sweep", "--mu", "0.1", "--twist", "linear:-8", "--relative-to", "builtin"], "use linear:-8"),
        (["solve", "--trim", "controls", "--thrust-n", "20"], "needs a collective"),
        (["solve", "--ct-over-sigma", "0.07"], "add --trim wind-tunnel"),
        (["solve", "--preset", "thesis", "--climb-m-s", "4"], "leave the rate of climb out"),
        (["airfoil", "show", "sc1095", "--mach", "0.7"], "needs both --mach and --alpha"),
        (["airfoil", "build", "sc1095"], "'build' is not a known value: use show"),
        (["optimise", "--concept", "two-segment", "--division", "half"], "'half' is not understood"),
        (["optimise", "--hover-share", "0.5"], "add --objective hover-cruise"),
        (["optimise", "--bound", "angle=1,2"], "does not name a parameter"),
        (["optimise", "--change-deg", "1", "--actuator", "MFC_P1"], "give one of them"),
        (["schedule", "--plies", "3"], "add --actuator"),
        (["schedule", "--processes", "0"], "0 processes"),
        (["study", "nowhere.toml"], "two_segment.toml"),
        (["study", "two_segment.toml", "DIR"], "study show DIR"),
        (["study", "two_segment.toml", "--workers", "0"], "1…1024"),
        (["study", "show", "nowhere"], "nowhere"),
    ],
)
def test_bad_input_is_exit_2_and_one_line(capsys: pytest.CaptureFixture[str], arguments: list[str], words: str):
    code, out, err = run(capsys, *arguments)
    assert (code, out) == (2, "")
    assert err.startswith("rotor: ")
    assert err.count("\n") == 1
    assert words in err


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        (["--twist", "linear:-30"], "built with about 20"),
        (["--twist", "linear:8"], "give the opposite sign, as in linear:-8"),
        (["--airfoils", "sc1094r8,sc1095-thesis@0.5"], "by their data, not by their airfoils"),
    ],
)
def test_caveats_of_blades_that_nobody_builds(flags: list[str], words: str, capsys: pytest.CaptureFixture[str]):
    def caveats(*flags: str) -> str:
        return " ".join(solved(capsys, "--inflow", "uniform", *flags)["caveats"])

    assert words in caveats(*flags)
    assert words not in caveats("--twist", "linear:-18", "--airfoils", "sc1095-thesis")


def test_sweep_table_and_csv(capsys: pytest.CaptureFixture[str], tmp_path: Path):
    path = tmp_path / "sweep.csv"
    code, out, _ = run(capsys, "sweep", "--mu", "0.1:0.3:0.1", "--twist", "linear:-8", "linear:-16", "--csv", str(path))
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    assert code == 0
    assert [row["mu"] for row in rows] == ["0.1", "0.2", "0.3"] * 2
    assert {row["twist"] for row in rows} == {"linear:-8", "linear:-16"}
    assert out.count("\n") == 7
    columns = [name for name in sweep_columns([make_design()]) if name not in SHARED_COLUMNS]
    level = [name for name in columns if not name.startswith("climb") and name not in ("status", "message")]
    assert out.splitlines()[0].split() == level  # Headings stand apart.
    assert max(map(len, out.splitlines())) <= 100
    single = solved(capsys, "--mu", "0.2", "--twist", "linear:-8")
    assert_allclose(float(rows[1]["total_kw"]), single["power_w"]["total"] / 1e3, atol=0.006)


def test_airfoil_as_table_and_as_json(capsys: pytest.CaptureFixture[str]):
    def shown(*words: str) -> str:
        code, out, err = run(capsys, "airfoil", "show", *words)
        assert (code, err) == (0, "")
        return out

    point = json.loads(shown("sc1095", "--mach", "0.7", "--alpha", "4", "--json"))
    assert list(point) == ["cl", "cd", "cm"]
    assert_allclose([point["cl"], point["cd"], point["cm"]], [0.72, 0.036, 0.001], atol=0.06)  # The C81 deck.
    assert json.loads(shown("sc1095-thesis", "--mach", "0.3", "--alpha", "4", "--json"))["cm"] is None
    answer = json.loads(shown("sc1094r8", "--json"))
    assert answer["incidence_offset_deg"] == 1.0
    k = answer["mach"].index(0.3)
    assert_allclose(answer["cl_alpha_per_deg"][k], 0.1104, rtol=0.01)  # McCroskey's, as in the data tests
    assert_allclose(answer["cm_at_0_deg"][k], -0.0236, atol=1e-3)
    for name in ("sc1095", "sc1095-thesis"):
        assert "nan" not in shown(name)
        assert len(shown(name).splitlines()) in (13, 14)  # A long source takes two lines.


def test_ranges():
    assert parse_range("0.4:0.1:-0.1") == parse_range("0.1:0.4:0.1")[::-1]
    assert parse_range("0.05:0.40:0.05") == [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4]
    assert parse_range("0:0.1:0.03") == [0.0, 0.03, 0.06, 0.09]
    assert parse_range("0.2") == [0.2]
    assert parse_range("0.1,0.3") == [0.1, 0.3]


@pytest.mark.parametrize(
    "flags",
    [
        ("--trim", "wind-tunnel", "--shaft-tilt-deg", "5", "--ct-over-sigma", "0.075", "--tip-mach", "0.6"),
        ("--trim", "free-rotor", "--collective-deg", "2", "--mu", "0.3"),
        ("--trim", "controls", "--collective-deg", "7", "--cyclic-1s-deg", "-4", "--density", "1.1"),
        ("--trim", "wind-tunnel", "--thrust-n", "60000", "--hover"),
    ],
)
def test_trims_of_a_test_stand(capsys: pytest.CaptureFixture[str], flags: tuple[str, ...]):
    answer = solved(capsys, *flags)
    assert answer["trim"] == flags[1]
    given = answer["stand"]
    found = {"ct_over_sigma": answer["ct_over_sigma"], "collective_deg": answer["collective_deg"]}
    for key in found.keys() & given.keys():
        assert_allclose(found[key], given[key], rtol=1e-9)
    assert_allclose(answer["power_w"]["total"], answer["shaft_torque_nm"] * 27.02, rtol=2e-3, atol=1.0)
    assert_allclose(answer["cq_over_sigma"], answer["cq"] * answer["ct_over_sigma"] / answer["ct"], rtol=1e-9)
