"""Quoted literature and the last chapter: conditions that hold whatever the numbers are."""

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.files.make_design import make_design
from rotor.reproduce import find_entry
from rotor.reproduce import today as then_and_now
from rotor.reproduce.page import TALK, write_talk
from rotor.reproduce.report import PlotPanel
from rotor.reproduce.runs import QUICK, best
from rotor.reproduce.today import gain_of_2_per_rev, mass_for_equal_power
from rotor.reproduce.twist_effect import STRONG, WEAK
from rotor.trim.solve import solve


@pytest.mark.slow
def test_useful_load_at_equal_power():
    """With the mass that was found, the strong twist needs the weak one's power."""
    mass = make_design().condition.mass
    heavier = mass * (1.0 + mass_for_equal_power())
    powers = [
        solve(make_design(twist=f"linear:{rate}", mu=0.0, mass_kg=kg)).require().power.main_rotor
        for rate, kg in ((STRONG, heavier), (WEAK, mass))
    ]
    assert_allclose(powers[0], powers[1], rtol=2e-4)


@pytest.mark.slow
def test_gain_of_2_per_rev_is_small_and_its_phase_between_the_six():
    """A per cent or two, as measured in tunnels, and nothing without amplitude."""
    saving, phase = gain_of_2_per_rev(1.5)
    assert 0.0 < saving < 0.03
    assert 0.0 <= phase < 360.0
    assert abs(gain_of_2_per_rev(0.0)[0]) < 1e-9


@pytest.mark.slow
def test_then_and_now(tmp_path: Path):
    """A moving blade is never worse than the best fixed one, and three segments never worse than one."""
    report = then_and_now.today(QUICK)
    numbers = report.numbers
    for name in then_and_now.TWO:
        assert numbers[f"{name}_hover"] == best(name, "linear", 0.0, QUICK).values[0]
        assert -1e-6 <= numbers[f"{name}_beyond_fixed"] <= numbers[f"{name}_saving"] + 1e-6
        assert numbers[f"{name}_three"] >= numbers[f"{name}_saving"] - 1e-6
    hover = report.panels[0]
    assert isinstance(hover, PlotPanel)
    for one in hover.curves:
        assert np.min(one.y) == 0.0
    write_talk([(find_entry("today"), report)], tmp_path, pictures=False)
    page = (tmp_path / TALK).read_text(encoding="utf-8")
    assert "What the thesis would have found" in page
    assert 'src="http' not in page
