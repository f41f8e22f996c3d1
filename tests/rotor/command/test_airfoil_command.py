"""`python -m rotor airfoil`, and errors when XFOIL is missing or writes damaged files."""

import argparse
import json
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.airfoil.build import xfoil
from rotor.airfoil.contour import load_contour
from rotor.assets import asset_path
from rotor.command import airfoil as command


def run(*words: str) -> int:
    parser = argparse.ArgumentParser()
    command.add_parser(parser.add_subparsers())
    args = parser.parse_args(["airfoil", *words])
    return args.run(args)


@pytest.mark.parametrize("name", ["sc1095", "sc1094r8"])
def test_verify_from_the_bundled_polars_agrees(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("verify", name, "--from-polars") == 0
    assert "agrees with the bundled deck" in capsys.readouterr().out


def test_verify_reports_differences(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(command, "CL_TOLERANCE", -1.0)
    assert run("verify", "sc1095", "--from-polars") == 1
    assert "DIFFERS" in capsys.readouterr().out


def test_build_from_polars_writes_the_bundled_deck(tmp_path: Path) -> None:
    assert run("build", "sc1095", "--from-polars", "--out", str(tmp_path)) == 0
    for file in ("sc1095.c81", "sc1095_trip5.polars.csv"):
        assert (tmp_path / file).read_text() == asset_path(f"airfoils/{file}").read_text()


def test_show_as_table_and_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("show", "sc1095", "--mach", "0.7", "--alpha", "4", "--json") == 0
    point = json.loads(capsys.readouterr().out)
    assert list(point) == ["cl", "cd", "cm"]
    assert_allclose([point["cl"], point["cd"], point["cm"]], [0.72, 0.036, 0.001], atol=0.06)  # The C81 deck.
    assert run("show", "sc1095-thesis", "--mach", "0.3", "--alpha", "4", "--json") == 0
    assert json.loads(capsys.readouterr().out)["cm"] is None
    with pytest.raises(ValueError, match="needs both --mach and --alpha"):
        run("show", "sc1095", "--mach", "0.7")
    assert run("show", "sc1094r8", "--json") == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["incidence_offset_deg"] == 1.0
    k = answer["mach"].index(0.3)
    assert_allclose(answer["cl_alpha_per_deg"][k], 0.1104, rtol=0.01)  # McCroskey's, as in the data tests
    assert_allclose(answer["cm_at_0_deg"][k], -0.0236, atol=1e-3)
    for name in ("sc1095", "sc1095-thesis"):
        assert run("show", name) == 0
        text = capsys.readouterr().out
        assert "nan" not in text
        assert len(text.splitlines()) == 13


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("show", "vr12"), "no section named 'vr12': choose one of sc1095"),
        (("build", "vr12"), "no section named 'vr12': choose one of sc1095"),
        (("verify", "sc1095-thesis"), "no section named 'sc1095-thesis'"),
        (("build", "sc1095", "--out", "/no/such/folder"), "'/no/such/folder' is not a folder: create it"),
    ],
)
def test_bad_input_names_value_and_remedy(words: tuple[str, ...], message: str) -> None:
    with pytest.raises(ValueError, match=r"sc1095|folder") as caught:
        run(*words)
    assert message in str(caught.value)


def test_without_xfoil_one_sentence_says_what_to_do(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    with pytest.raises(ValueError, match="bundled decks serve at run time") as caught:
        run("build", "sc1095")
    assert "apt install xfoil" in str(caught.value)
    assert "\n" not in str(caught.value)


# As XFOIL prints them: a NaN row, a cut row and a negative drag must not come through.
POLAR_TEXT = """
   alpha    CL        CD       CDp       CM     Top_Xtr  Bot_Xtr  Top_Itr  Bot_Itr
  ------ -------- --------- --------- -------- -------- -------- -------- --------
   0.000   0.0888   0.00828   0.00032  -0.0144   0.0500   0.0500  82.7079 119.0281
   0.500      NaN       NaN   0.00032  -0.0146   0.0500   0.0500  82.7079 119.0281
   1.000   0.2115  -0.00835   0.00030  -0.0148   0.0500   0.0500  82.7079 119.0281
   1.500   0.2727   0.00840   0.00026  -0.0150   0.0500   0.0500  82.7079 119.0281
   2.000   0.33
"""


def test_damaged_rows_of_a_polar_file_are_dropped() -> None:
    parse = xfoil._parse  # pyright: ignore[reportPrivateUsage]
    assert parse(POLAR_TEXT) == {0.0: (0.0888, 0.00828, -0.0144), 1.5: (0.2727, 0.0084, -0.015)}
    assert parse("nothing here") == {}


def test_gaps_are_grouped_outward() -> None:
    gaps = xfoil._gaps  # pyright: ignore[reportPrivateUsage]
    assert gaps([-8.5, -8.0, 3.0, 9.0, 9.5, 10.0], 0.5) == [(-8.0, -8.5), (3.0, 3.0), (9.0, 10.0)]


@pytest.mark.xfoil
def test_one_real_polar_is_close_to_thin_airfoil_theory() -> None:
    """cl slope of a thin section: 2 pi / beta, plus some 10 % for thickness, less the boundary layer."""
    try:
        xfoil.require_xfoil()
    except xfoil.XfoilMissing as missing:
        pytest.skip(str(missing))
    case = xfoil.XfoilCase(mach=0.3, reynolds=3.681e6, n_crit=9.0, trip=0.05)
    polar = xfoil.run_polar(load_contour("sc1095"), case, np.arange(-2.0, 5.0))
    slope = np.polyfit(np.deg2rad(polar.alpha_deg), polar.cl, 1)[0]
    assert_allclose(slope, 2.0 * np.pi / np.sqrt(1.0 - 0.3**2), rtol=0.1)
    assert polar.alpha_deg.size >= 6


def test_xfoil_that_crashes_is_an_error_not_a_polar(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Replaces XFOIL by a program that is killed by a signal, as Debian's does with its graphics off."""
    for name, body in (("xfoil", "kill -FPE $$"), ("xvfb-run", "exit 136")):
        (tmp_path / name).write_text(f"#!/bin/sh\n{body}\n", encoding="utf-8")
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    case = xfoil.XfoilCase(mach=0.3, reynolds=3.681e6, n_crit=9.0, trip=0.05)
    with pytest.raises(xfoil.XfoilError, match="converged at only 0 of 7"):
        xfoil.run_polar(load_contour("sc1095"), case, np.arange(-2.0, 5.0))


def test_xfoil_that_hangs_is_killed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("xfoil", "xvfb-run"):
        (tmp_path / name).write_text("#!/bin/sh\nsleep 60 & wait\n", encoding="utf-8")
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    monkeypatch.setattr(xfoil, "_TIME_LIMIT", 0.05)
    case = xfoil.XfoilCase(mach=0.3, reynolds=3.681e6, n_crit=9.0, trip=None)
    with pytest.raises(xfoil.XfoilError, match="from-polars"):
        xfoil.run_polar(load_contour("sc1095"), case, np.arange(-2.0, 5.0))
