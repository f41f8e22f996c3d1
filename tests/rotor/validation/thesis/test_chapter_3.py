"""The statements behind the figures and tables of chapter 3, as the thesis makes them, or as our numbers contradict
them."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.validation.thesis.disk_figures import line_error, linear_errors
from rotor.validation.thesis.report import Agreement, Report, ReportTable
from rotor.validation.thesis.twist_effect import crossings

Make = Callable[[str], Report]


def column(table: ReportTable, name: str) -> np.ndarray:
    k = table.columns.index(name)
    return np.array([float(row[k]) for row in table.rows])


def test_figure_3_3(report: Make):
    """Order 10 fits lift to 1 % of its range, but the knee of the error lies at a lower order."""
    one = report("3.3")
    assert one.verdict is Agreement.DIFFERS
    assert one.numbers["knee"] < 10
    assert one.numbers["share_of_spread"] < 0.01
    assert one.numbers["last_step_-10_18"] > one.numbers["next_step_-10_18"]
    errors = column(one.tables[0], "rms_-10_15_deg")
    assert (np.diff(errors) < 1e-12).all()  # Nested spaces: least squares cannot get worse.


def test_figure_3_4(report: Make):
    """Order 12 fits drag to 1 % of its range, ten times better than a parabola; the knee lies at a lower order."""
    one = report("3.4")
    assert one.verdict is Agreement.DIFFERS
    assert one.numbers["knee"] < 12
    assert one.numbers["share_of_spread"] < 0.01
    assert one.numbers["from_2_-10_15"] > 10.0


def test_figures_3_5_and_3_6(report: Make):
    """The lift fit is accurate only inside its range: extrapolated, it is wrong at 30°."""
    one = report("3.5")
    assert one.verdict is Agreement.NO_REFERENCE  # The statement has no number.
    assert abs(one.numbers["unheld_at_30"]) > 100.0
    # The drag fit: a few per cent in the flight range, wrong outside, on either side of zero.
    numbers = report("3.6").numbers
    assert numbers["attached_rms"] < 0.03
    assert abs(numbers["unheld_at_30"]) > 100.0


def test_figure_3_7(report: Make):
    """Hover power converges with elements, with an order between 1 and the midpoint rule's 2 and a half."""
    one = report("3.7")
    # The number is in the figure, which is not available.
    assert one.verdict is Agreement.NO_REFERENCE
    for preset in ("thesis", "flight-linear"):
        assert one.numbers[f"{preset}_error_at_40"] < 5e-3
        assert 1.0 < one.numbers[f"{preset}_order"] < 3.0
        steps = np.abs(np.diff(column(one.tables[0], preset)))
        assert steps[-1] < 0.1 * steps[0]


def test_figure_3_8(report: Make):
    """Power in forward flight converges with elements; λ_i/F, without bound at the tip, settles without an order."""
    one = report("3.8")
    for preset in ("thesis", "flight-linear"):
        assert one.numbers[f"{preset}_error_at_40"] < 5e-3
    assert 1.0 < one.numbers["flight-linear_order"] < 3.0
    assert one.numbers["thesis_error_at_40"] < 1e-3


def test_figure_3_9(report: Make):
    """A hundred azimuths are enough to 0.1 %; fewer are, too, which the thesis does not say."""
    one = report("3.9")
    for preset in ("thesis", "flight-linear"):
        assert one.numbers[f"{preset}_error_at_100"] < 2e-5
        assert one.numbers[f"{preset}_needed"] < 100
    assert one.verdict is Agreement.DIFFERS


def test_the_grid_of_the_default_model():
    """What the trust page says of it: 0.6 per cent at µ 0.1, where its azimuths are coarse, and less at speed."""
    assert abs(line_error(0.1)) < 7e-3
    assert abs(line_error(0.2)) < 1e-3


def test_the_grid_of_linear_inflow():
    """What the trust page says of it: less than 0.05 % of the power, and 1 kW where twists are compared."""
    at_speed = [linear_errors(mu) for mu in (0.2, 0.35)]
    for power, added in at_speed:
        assert abs(power) < 5e-4
        assert abs(added) < 1.0
    assert any(power for power, _ in at_speed)


def test_table_3_1(report: Make):
    assert report("table 3.1").numbers["largest_difference"] == 0.0
    assert report("table 3.1").verdict is Agreement.INPUT


def test_table_3_2(report: Make):
    assert report("table 3.2").numbers["largest_difference"] == 0.0


def test_tail_rotor(report: Make):
    """About 5 %, but not constant: largest in hover, decreasing with speed."""
    numbers = report("tail rotor").numbers
    assert_allclose(numbers["mean"], 0.05, atol=0.01)
    shares = column(report("tail rotor").tables[0], "share_percent")
    assert (np.diff(shares) < 0.0).all()


def test_figure_3_10(report: Make):
    """Minimum power between hover and fast flight; within 15 % of a public model's curve; near the hover points."""
    one = report("3.10")
    assert one.verdict is Agreement.INDICATIVE
    total = {name: column(one.tables[0], name) for name in ("flight", "thesis")}
    for power in total.values():
        assert power.min() < 0.7 * power[0]
        assert power[-1] > power[0]
    assert (total["thesis"] < total["flight"]).all()
    assert one.numbers["rms_to_model_curve"] < 0.15
    # The points scatter by 3.2 % about their own fit, and a fifth of their gap was drag: now the best lies above.
    assert -0.10 < one.numbers["hover_least"] < one.numbers["hover_largest"] < 0.033


@pytest.mark.slow
def test_figure_3_11_by_both_readings(report: Make):
    """Per radius, the unit of figure 4.11, −13.5° misses; root to tip it holds. No stall."""
    one = report("3.11")
    assert one.verdict is Agreement.DIFFERS
    assert one.numbers["root_to_tip_optimum"] > -16.0 > one.numbers["thesis_optimum"]
    assert one.numbers["cost_of_13_5_root_to_tip"] < 1e-3 < one.numbers["thesis_cost_of_13_5"]
    assert "stalled area 0.0 %" in one.because


@pytest.mark.slow
def test_figure_3_11(report: Make):
    """One shallow optimum in hover: −13.5° costs under 0.3 % (flight 0.6), no twist over 5 %. Ours lies lower."""
    one = report("3.11")
    for preset in ("thesis", "flight"):
        assert -18.0 < one.numbers[f"{preset}_optimum"] < -13.0
        # Drag rise by angle of attack in the sections of the flight preset moves the optimum to more twist: −18°.
        assert (
            0.0 <= one.numbers[f"{preset}_cost_of_13_5"] < {"thesis": 3e-3, "flight": 6e-3}[preset]
        )
        assert one.numbers[f"{preset}_cost_of_0"] > 0.05
    # At the thesis' mass and above, more twist helps down to −12°; lighter rotors want less.
    for made in one.tables:
        heavy = column(made, "mass_kg") > 8000.0
        powers = np.array([column(made, f"linear_{rate}")[heavy] for rate in (0, -4, -8, -12)])
        assert (np.diff(powers, axis=0) < 0.0).all()


@pytest.mark.slow
def test_figure_3_12(report: Make):
    """Strong twist is better up to 130 km/h; most if the wake responds to loading all over the disk."""
    made = report("3.12")
    numbers = made.numbers
    assert made.verdict is Agreement.AGREES
    assert "it costs power" not in made.because
    assert 0.01 < numbers["thesis_saving"] < numbers["thesis-wake_saving"]
    assert numbers["thesis-wake_saving"] > 0.05
    assert numbers["flight_saving"] > 0.05


@pytest.mark.slow
def test_figure_3_13(report: Make):
    """−8° is the best of five to 0.1 % beyond µ 0.18 on the thesis' rotor, with the wake and with linear inflow."""
    one = report("3.13")
    assert one.verdict is Agreement.AGREES
    assert 0.0 <= one.numbers["thesis-wake_cost_of_8"] < 1e-3
    assert 0.0 <= one.numbers["thesis_cost_of_8"] < 1e-3
    assert [round(met, 2) for met in crossings("thesis", -8, -12, (0.17, 0.18, 0.19))] == [0.18]


@pytest.mark.slow
def test_figure_3_14(report: Make):
    """−4° is best at µ 0.35 on the thesis' rotor with either inflow, not in `flight`, nor once trimmed by cyclic."""
    assert report("3.14").verdict is Agreement.AGREES
    numbers = report("3.14").numbers
    assert numbers["thesis_best"] == numbers["thesis-wake_best"] == -4.0
    assert numbers["flight_best"] == -12.0
    assert numbers["with_trim"] < -10.0 < -7.0 < numbers["with_section"]
    assert numbers["flight_cost_of_4"] > 0.02


@pytest.mark.slow
def test_figure_3_15(report: Make):
    """Strong twist is best in hover; a slower rotor has less profile drag, and saves where nothing stalls."""
    one = report("3.15")
    assert one.verdict is Agreement.NO_REFERENCE
    assert one.numbers["hover_best"] == -16.0 < one.numbers["fast_best"]
    assert 0.0 < one.numbers["slower_saves"] < 0.2


def test_crossings_are_at_equal_power():
    """Between −12° and −16° on the thesis' rotor; the two costs cross once at low speed."""
    found = crossings("thesis", -12, -16, (0.075, 0.105, 0.135))
    assert len(found) == 1
    assert 0.075 < found[0] < 0.135


@pytest.mark.slow
def test_keys_1987(report: Make):
    """More twist helps in hover in every model; at 330 km/h propulsive force decides, in every model alike."""
    one = report("keys 1987")
    assert one.verdict is Agreement.DIFFERS
    assert all(
        -0.024 < one.numbers[f"{name}_hover"] < 0.0 for name in ("thesis", "thesis-wake", "flight")
    )
    for name in one.tables[0].columns[1:]:
        assert (np.diff(column(one.tables[0], name)) < 0.0).all()
    # Where the delay of stall counts, the default model has the lowest of the ratios.
    assert one.numbers["usual_low"] == one.numbers["usual_force"] < one.numbers["usual_high"]
    assert one.numbers["thesis_fast"] > 0.0
    assert one.numbers["thesis-wake_fast"] > 0.02
    assert abs(one.numbers["flight_fast"] - 0.05) > 0.04
