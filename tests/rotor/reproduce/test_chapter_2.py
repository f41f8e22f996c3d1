"""The statements behind the figures of chapter 2. Physical statements, not pictures; bounds come from outside the
code."""

import math
from collections.abc import Callable

import numpy as np
from numpy.testing import assert_allclose

from rotor.reproduce import Agreement, Report
from rotor.reproduce.sections import PRESSURE_CASES, read_pressure

Make = Callable[[str], Report]


def test_figure_2_3(report: Make):
    """The arrows sum to the lift of XFOIL, to its four printed digits of cl."""
    numbers = report("2.3").numbers
    assert_allclose(numbers["cl_integrated"], numbers["cl"], atol=5e-4)
    assert 0.3 < numbers["cl"] < 2.0 * math.pi * math.radians(3.0 + 1.7) / math.sqrt(1.0 - 0.3**2) * 1.1


def test_figure_2_4(report: Make):
    """Suction on the upper side; the largest Cp is that of air at rest, (1 + M²/4 + …) = 1.023 at M 0.3."""
    numbers = report("2.4").numbers
    assert numbers["cp_min"] < -1.0
    # The nose has a panel every per cent of chord or so: none sits on the stagnation point itself.
    assert_allclose(numbers["stagnation"], 1.0 + 0.3**2 / 4.0 + 0.3**4 / 40.0, atol=0.02)


def test_pressure_files_are_closed_contours():
    for case in PRESSURE_CASES:
        pressure = read_pressure(case)
        assert len(pressure.x) == 160
        assert_allclose((pressure.x[0], pressure.x[-1]), 1.0, atol=1e-3)
        area = 0.5 * float((pressure.x * np.roll(pressure.y, -1) - pressure.y * np.roll(pressure.x, -1)).sum())
        assert 0.04 < area < 0.12  # counter-clockwise, and as thick as a section of 9–15 %
        assert_allclose(pressure.integrated_moment(), pressure.cm, atol=5e-4)


def test_figure_2_6(report: Make):
    """In hover U_T = r at every azimuth."""
    numbers = report("2.6").numbers
    assert numbers["spread_over_azimuth"] == 0.0
    assert_allclose(numbers["slope"], 1.0, rtol=1e-12)
    assert report("2.6").verdict is Agreement.ALONE


def test_figure_2_7(report: Make):
    """Most thrust between 0.5 R and 0.9 R, and less at the very tip than at the peak."""
    one = report("2.7")
    assert one.verdict is Agreement.AGREES
    for preset in ("thesis", "flight"):
        assert one.numbers[f"{preset}_share"] > 0.5
        assert 0.5 < one.numbers[f"{preset}_peak"] < 0.9
        # A load ∝ r² has 27 % of itself beyond 0.9 R: the tip factor leaves less.
        assert one.numbers[f"{preset}_tip_share"] < 1.0 - 0.9**3


def test_figure_2_8(report: Make):
    """Reverse flow is the circle r = −µ sin ψ outside the root; ψ = 90° meets r + µ_x."""
    numbers = report("2.8").numbers
    # 40 × 120 cells; the circle's border is 0.9 R long, a cell about 0.02 R wide: counting errs by a few per cent.
    assert_allclose(numbers["reverse_area"], numbers["circle_area"], rtol=0.05)
    whole = 0.3**2 / 4.0
    assert 0.5 * whole < numbers["circle_area"] < whole
    assert 1.2 < numbers["largest"] < 1.3
