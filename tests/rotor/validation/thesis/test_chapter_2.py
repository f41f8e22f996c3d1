"""The statements behind the figures of chapter 2. Physical statements, not pictures; bounds come from outside the
code."""

from collections.abc import Callable

from numpy.testing import assert_allclose

from rotor.validation.thesis.report import Agreement, Report

Make = Callable[[str], Report]


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
