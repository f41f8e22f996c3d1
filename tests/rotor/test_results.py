"""What notebooks and tables get of results: rotor files by path, twist as numbers, short representations."""

import re
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotor
import rotor.command.validate
from rotor.__main__ import main
from rotor.design.twist import parse_twist
from rotor.trim.analysis import power_gradient

WANTS = "a picture needs matplotlib: pip install 'rotor-explorer[plot]'"
QUICK: dict[str, Any] = {"inflow": "uniform", "elements": 12, "azimuths": 24}


def test_twist_is_a_number_in_tables():
    designs = [rotor.make_design(twist=f"linear:{rate}", **QUICK) for rate in (-4, -12)]
    table = rotor.sweep(designs, mu=[0.2]).to_dict()
    assert_allclose(np.array(table["twist_deg_per_r"], dtype=float), [-4.0, -12.0])


def test_a_chart_over_knots_has_knots():
    import matplotlib

    matplotlib.use("Agg")
    axes = rotor.plot_power(rotor.sweep(rotor.make_design(**QUICK), speed_kt=[60, 90]))
    assert axes.get_xlabel() == "Airspeed [kt]"
    assert_allclose(axes.get_lines()[0].get_xdata(), [60.0, 90.0])


def test_a_picture_without_matplotlib_is_one_sentence(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
):
    """The commands say it before they compute."""
    solution = rotor.solve(rotor.make_design(**QUICK))
    monkeypatch.setattr(rotor.command.validate, "compare", None)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    for name in ("matplotlib.figure", "matplotlib.pyplot"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    with pytest.raises(ImportError, match=re.escape(WANTS)):
        rotor.plot_field(solution)
    for words in (["validate", "xv15-hover", "--plot", str(tmp_path)], ["reproduce", str(tmp_path / "out")]):
        assert main(words) == 2
        assert capsys.readouterr().err.endswith(f"{WANTS}\n")
    assert not (tmp_path / "out").exists()


def test_gradient_along_a_twist_law():
    design = rotor.make_design(mu=0.2, twist="linear:-4")
    slope = power_gradient(rotor.solve(design)).along(parse_twist("linear:1"))
    ends = [rotor.solve(design.with_twist(f"linear:{rate}")).power.total for rate in (-4.05, -3.95)]
    assert_allclose(slope, (ends[1] - ends[0]) / 0.1, rtol=1e-3)


def test_representations_are_short():
    design = rotor.make_design(mu=0.3, **QUICK)
    solution = rotor.solve(design)
    shown = (
        design, solution, rotor.distribution(solution), rotor.sweep(design, mu=[0.1, 0.2]), rotor.doubt(solution),
        rotor.optimise(design, "linear", starts=1), solution.disk, solution.power, solution.controls,
        solution.elastic, power_gradient(solution), rotor.schedule(design, mu=[0.2], starts=1),
    )  # fmt: skip
    for value in shown:
        assert len(repr(value).splitlines()) <= 10, type(value).__name__
        assert len(repr(value)) <= 1200, type(value).__name__
