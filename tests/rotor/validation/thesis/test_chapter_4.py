"""Chapter 4: no number of the thesis is known, so the tests are conditions of any optimum."""

from collections.abc import Callable

import pytest
from numpy.testing import assert_allclose

from rotor.trim.solve import solve
from rotor.validation.thesis import optimum_twist as side_by_side
from rotor.validation.thesis.ladder import linear_optimum
from rotor.validation.thesis.optimum_twist import FIGURES, optimum_figure
from rotor.validation.thesis.report import Agreement, Report
from rotor.validation.thesis.runs import (
    CONCEPTS,
    SC1095_DECKS,
    VARIANTS,
    best,
    comparable_kw,
    variant,
)

Make = Callable[[str], Report]
QUICK = (0.0, 0.15, 0.30)
"""Fewer speeds than the figures have."""


def test_variants():
    """Every variant is its preset but for the inflow; in hover that has no effect but by its grid, and is not used."""
    for name in VARIANTS:
        assert variant(name).preset == name
    assert variant("thesis").models.inflow != variant("thesis-wake").models.inflow == "lifting-line"
    assert variant("flight").models.inflow != variant("flight-linear").models.inflow
    powers = [
        solve(variant(name, mu=0.0)).require().power.total for name in ("flight", "flight-linear")
    ]
    assert_allclose(powers[1], powers[0], rtol=2e-3)


_EACH_NIGHT = {"4.4", "4.6", "4.7", "4.10"}
"""Other divisions than that of 4.5, and a third segment."""


@pytest.mark.slow
@pytest.mark.parametrize(
    "number",
    [pytest.param(one, marks=[pytest.mark.nightly] * (one in _EACH_NIGHT)) for one in FIGURES],
)
def test_optimum(number: str):
    """No reference; converged; optimum within its band; never worse than the baseline or one linear twist."""
    one = optimum_figure(number, QUICK)
    concept = FIGURES[number][0]
    assert one.verdict is Agreement.NO_REFERENCE
    assert [row[:2] for row in one.tables[-1].rows] == [
        (name, mu) for name in VARIANTS for mu in QUICK
    ]
    for name in VARIANTS:
        for mu in QUICK:
            found = best(name, concept, mu, QUICK)
            assert found.converged
            assert found.power_kw <= found.baseline_kw * (1.0 + 1e-9)
            for value, (low, high) in zip(found.values, found.band, strict=True):
                assert low - 1e-6 <= value <= high + 1e-6
            if concept != "two airfoils":  # Those fly another baseline.
                assert found.power_kw <= best(name, "linear", mu, QUICK).power_kw * (1.0 + 1e-5)


@pytest.mark.slow
def test_linear_twist_is_largest_in_hover():
    for name in VARIANTS:
        assert (
            best(name, "linear", 0.0, QUICK).values[0] < best(name, "linear", 0.15, QUICK).values[0]
        )


def test_optimum_decreases_steadily_with_the_wake():
    """The thesis' idea on its own rotor: with a wake that responds to loading, optimum twist decreases with speed."""
    rates = [linear_optimum(("wake",), mu, None).rate_deg for mu in QUICK]
    assert rates[0] < rates[1] - 1.5 < rates[2] - 3.0


def test_figure_4_11(report: Make):
    """−16° is the straight line through the flown twist."""
    one = report("4.11")
    assert one.verdict is Agreement.AGREES
    assert one.numbers["unweighted"] < -16.0 < one.numbers["weighted"]


@pytest.mark.slow
def test_figure_4_12():
    """Variable twist of three segments saves little: much less than the difference from any data."""
    numbers = side_by_side.figure_4_12(3).numbers
    assert 0.0 < numbers["least_saving"] <= numbers["largest_saving"] < 0.05


@pytest.mark.slow
@pytest.mark.nightly
def test_figure_4_13():
    """More parameters never save less; beyond one linear twist they save under a per cent."""
    numbers = side_by_side.figure_4_13(QUICK).numbers
    for name in VARIANTS:
        assert 0.0 <= numbers[f"{name}_three_over_linear"] < 0.01
        assert all(numbers[f"{name}_{concept}_largest"] > 0.0 for concept in CONCEPTS)
    # A second airfoil adds what it adds on equal data, not the difference of two polars.
    for mu in QUICK:
        one, decks, two = (
            best("thesis", key, mu, QUICK) for key in ("two 50-50", SC1095_DECKS, "two airfoils")
        )
        gain = comparable_kw("thesis", "two airfoils", mu, QUICK) / one.power_kw
        assert_allclose(gain, two.power_kw / decks.power_kw, rtol=1e-12)
        assert 0.9 < gain < 1.05


@pytest.mark.slow
@pytest.mark.nightly
def test_table_4_1():
    """Variable twist is never worse than the best fixed blade, and a fixed blade has part of every saving."""
    numbers = side_by_side.table_4_1(QUICK).numbers
    for name in VARIANTS:
        assert numbers[f"{name}_fixed"] >= 0.0
        assert -1e-6 <= numbers[f"{name}_moving"] < 0.03
