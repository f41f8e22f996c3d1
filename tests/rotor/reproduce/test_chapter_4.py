"""Chapter 4: no number of the thesis is known, so the tests are conditions of any optimum."""

from collections.abc import Callable

import pytest
from numpy.testing import assert_allclose

from rotor.aero.inflow import INFLOW_MODELS
from rotor.reproduce import Agreement, Report
from rotor.reproduce import comparison as side_by_side
from rotor.reproduce import optimum_twist as figures
from rotor.reproduce.optimum_twist import LINEAR
from rotor.reproduce.runs import (
    CONCEPTS,
    EVERY_VARIANT,
    PRESETS,
    QUICK,
    SC1095_DECKS,
    VARIANTS,
    best,
    choices,
    comparable_kw,
    linear_twin,
    variant,
    with_inflow,
)
from rotor.trim.solve import solve

Make = Callable[[str], Report]


def check(one: Report, concept: str, variants: tuple[str, ...] = EVERY_VARIANT) -> None:
    """No reference; converged; optimum within its band; never worse than the baseline or one linear twist."""
    assert one.verdict is Agreement.ALONE
    long = next(table for table in one.tables if table.name == "optimum")
    assert {row[:2] for row in long.rows} == {choices(name) for name in variants}
    for name in variants:
        for mu in QUICK.speeds:
            found = best(name, concept, mu, QUICK)
            assert found.converged, found.message
            assert found.power_kw <= found.baseline_kw * (1.0 + 1e-9)
            # The linear models coincide: only one of a preset measures its band, and the others lie within it.
            measured = best(linear_twin(name) or name, concept, mu, QUICK)
            for value, (low, high) in zip(found.values, measured.band, strict=True):
                assert low - 1e-6 <= value <= high + 1e-6
            if concept != "two airfoils":  # Those fly another baseline.
                assert found.power_kw <= best(name, "linear", mu, QUICK).power_kw * (1.0 + 1e-5)


def test_both_presets_have_every_inflow_model():
    """Includes the four with their own figures; in hover the model has no effect but by its grid, and is not used."""
    assert {choices(name) for name in EVERY_VARIANT} == {(preset, name) for preset in PRESETS for name in INFLOW_MODELS}
    assert set(VARIANTS) < set(EVERY_VARIANT)
    for name in EVERY_VARIANT:
        assert with_inflow(*choices(name)) == name
        design = variant(name)
        assert (design.preset, design.models.inflow) == choices(name)
    powers = [solve(variant(with_inflow("flight", name), mu=0.0)).require().power.total for name in INFLOW_MODELS]
    assert max(powers[:-1]) == min(powers[:-1])
    assert_allclose(powers[-1], powers[0], rtol=2e-3)


@pytest.mark.slow
def test_figure_4_1():
    """One linear twist: large in hover, smaller in forward flight, in every variant."""
    check(figures.figure_4_1(QUICK, VARIANTS), "linear", VARIANTS)
    for name in VARIANTS:
        assert best(name, "linear", 0.0, QUICK).values[0] < best(name, "linear", 0.15, QUICK).values[0]


@pytest.mark.slow
def test_figure_4_1_every_inflow():
    """The same with every model; the linear ones agree, and those that respond to loading give a larger saving."""
    check(figures.figure_4_1(QUICK), "linear")
    for preset in PRESETS:
        flat = [best(with_inflow(preset, name), "linear", 0.15, QUICK) for name in LINEAR]
        rates = [one.values[0] for one in flat]
        assert max(rates) - min(rates) < 0.5
        for name in EVERY_VARIANT:
            if choices(name)[0] == preset:
                assert best(name, "linear", 0.0, QUICK).values[0] < best(name, "linear", 0.15, QUICK).values[0]


def test_figure_4_1_decreases_steadily_with_the_wake():
    """The thesis' idea on its own rotor: with a wake that responds to loading, optimum twist decreases with speed."""
    rates = [best("thesis-wake", "linear", mu, QUICK).values[0] for mu in QUICK.speeds]
    assert rates[0] < rates[1] - 1.5 < rates[2] - 3.0


@pytest.mark.slow
def test_figure_4_2():
    check(figures.figure_4_2(QUICK), "quadratic")


@pytest.mark.slow
def test_figure_4_3():
    """With a = 0 the quadratic is the linear law, so it must never need more power."""
    check(figures.figure_4_3(QUICK), "quadratic")


@pytest.mark.slow
def test_figure_4_4():
    check(figures.figure_4_4(QUICK), "two 40-60")


@pytest.mark.slow
def test_figure_4_5():
    check(figures.figure_4_5(QUICK), "two 50-50")


@pytest.mark.slow
def test_figure_4_6():
    check(figures.figure_4_6(QUICK), "two 60-40")


@pytest.mark.slow
def test_figure_4_7():
    check(figures.figure_4_7(QUICK), "two 70-30")


@pytest.mark.slow
def test_figure_4_8():
    check(figures.figure_4_8(QUICK), "two airfoils")


def test_figure_4_9(report: Make):
    """Two thirds of the lifting blade are SC1095, and nothing overlaps."""
    shares = report("4.9").numbers
    assert 0.3 < shares["sc1094r8"] < shares["sc1095"]
    assert shares["sc1094r8"] + shares["sc1095"] < 1.0 - 0.13


@pytest.mark.slow
def test_figure_4_10():
    check(figures.figure_4_10(QUICK), "three")


def test_figure_4_11(report: Make):
    """−16° is the straight line through the flown twist."""
    one = report("4.11")
    assert one.verdict is Agreement.AGREES
    assert one.numbers["unweighted"] < -16.0 < one.numbers["weighted"]


@pytest.mark.slow
def test_figure_4_12():
    """Variable twist of three segments saves little: much less than the difference from any data."""
    numbers = side_by_side.figure_4_12(QUICK, ("flight",)).numbers
    assert 0.0 < numbers["flight_least_saving"] <= numbers["flight_largest_saving"] < 0.05


@pytest.mark.slow
def test_figure_4_12_every_inflow():
    """With any model; the one without wake losses (local momentum) gives the largest saving."""
    numbers = side_by_side.figure_4_12(QUICK).numbers
    for name in EVERY_VARIANT:
        assert 0.0 < numbers[f"{name}_least_saving"] <= numbers[f"{name}_largest_saving"] < 0.10


@pytest.mark.slow
def test_figure_4_13():
    """More parameters never save less; beyond one linear twist they save under a per cent."""
    numbers = side_by_side.figure_4_13(QUICK).numbers
    for name in EVERY_VARIANT:
        assert 0.0 <= numbers[f"{name}_three_over_linear"] < 0.01
    for name in VARIANTS:
        assert all(numbers[f"{name}_{concept}_largest"] > 0.0 for concept in CONCEPTS)
    for mu in QUICK.speeds:  # A second airfoil adds what it adds on equal data, not the difference of two polars.
        one, decks, two = (best("thesis", key, mu, QUICK) for key in ("two 50-50", SC1095_DECKS, "two airfoils"))
        gain = comparable_kw("thesis", "two airfoils", mu, QUICK) / one.power_kw
        assert_allclose(gain, two.power_kw / decks.power_kw, rtol=1e-12)
        assert 0.9 < gain < 1.05


@pytest.mark.slow
def test_table_4_1():
    """Variable twist is never worse than the best fixed blade, and a fixed blade has part of every saving."""
    numbers = side_by_side.table_4_1(QUICK).numbers
    for name in EVERY_VARIANT:
        assert numbers[f"{name}_fixed"] >= 0.0
        assert -1e-6 <= numbers[f"{name}_moving"] < 0.03
