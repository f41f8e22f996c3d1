"""Chapter 5: its numbers are not known to us, so the tests are conditions of any piezoelectric sheet and blade."""

from collections.abc import Callable

import pytest
from rotor.reproduce.actuated_blade import BLADES, fitted_blade
from rotor.reproduce.actuator_sheets import sheet

from rotor.actuator.electrical import thermal_coefficients
from rotor.actuator.pictures import twist_under_voltage
from rotor.reproduce import Agreement, Report

Make = Callable[[str], Report]


def alone(report: Make, number: str) -> Report:
    """No comparison without reference numbers."""
    one = report(number)
    assert one.verdict is Agreement.ALONE
    assert one.tables
    return one


def test_figure_5_2(report: Make):
    """d33: longer and thinner at positive voltage. d31: shorter both ways. At 45° the difference gives shear."""
    numbers = alone(report, "5.2").numbers
    assert numbers["MFC_P1_along_1"] > 0.0 > numbers["MFC_P1_across_1"]
    assert numbers["MFC_P2_along_1"] < 0.0
    assert numbers["MFC_P2_across_1"] < 0.0
    expected = numbers["MFC_P1_along_1"] - numbers["MFC_P1_across_1"]
    assert numbers["shear_at_45"] == pytest.approx(expected, rel=1e-9)


def test_figure_5_3(report: Make):
    """The field is along the fibres between fingers, across them between plates."""
    numbers = alone(report, "5.3").numbers
    assert numbers["MFC_P1_along_share"] > 0.99
    assert numbers["MFC_P2_along_share"] < 0.01


def test_figure_5_4(report: Make):
    """Halfway between fingers the field is weaker than V/gap, because its lines bulge; between plates it is V/gap."""
    numbers = alone(report, "5.4").numbers
    assert 0.6 * numbers["MFC_P1_mean"] < numbers["MFC_P1_middle"] < numbers["MFC_P1_mean"]
    assert numbers["MFC_P2_middle"] == pytest.approx(numbers["MFC_P2_mean"])


def test_figure_5_5(report: Make):
    """Interdigitated electrodes strain the same fibres three to four times as much: 1800 against 500 ppm."""
    numbers = alone(report, "5.5").numbers
    assert 3.0 < numbers["MFC_P1"] / numbers["MFC_P2"] < 4.0
    assert numbers["MFC_P1"] == max(numbers.values())


def test_figure_5_6(report: Make):
    """α = d/ΔES lies at the high end of what the maker measures, within 3 %."""
    numbers = alone(report, "5.6").numbers
    assert numbers["alpha"] == thermal_coefficients(sheet("MFC_P1"))[0]
    assert numbers["low_per_volt"] < numbers["per_volt"] < numbers["alpha"] < 1.03 * numbers["per_volt"]


def test_figure_5_7(report: Make):
    """Against the poling direction the field stays below the coercive field of PZT-5A, 1.2 kV/mm."""
    numbers = alone(report, "5.7").numbers
    assert all(value > -1.2 for name, value in numbers.items() if name.endswith("_low"))
    assert numbers["MFC_P1_high"] == pytest.approx(3.0)


def test_figure_5_8(report: Make):
    """The box ends before the plies begin; two plies are 15 % of the blade (worked example, 14.6 kg)."""
    numbers = alone(report, "5.8").numbers
    assert numbers["box_end"] < numbers["active_start"]
    assert numbers["ply_kg"] == pytest.approx(14.6, rel=0.01)


def test_figure_5_9(report: Make):
    """Bredt's section of the worked example: 400 N·m for two plies on a GJ 7 % above the blade's."""
    numbers = alone(report, "5.9").numbers
    assert numbers["moment"] == pytest.approx(400.0, rel=0.05)
    assert numbers["stiffness"] == pytest.approx(1.07 * 7.0e4, rel=0.05)


def test_figure_5_10(report: Make):
    """Up at positive voltage, three times as far as down at −500 V; the worked example's tips within 10 %."""
    numbers = alone(report, "5.10").numbers
    for (name, (plies, host)), expected in zip(BLADES.items(), (0.92, 1.66, 2.84, 4.16), strict=True):
        assert numbers[name] == pytest.approx(expected, rel=0.1)
        up, down = (twist_under_voltage(fitted_blade(plies, host), [volts]).twist[-1] for volts in (1500.0, -500.0))
        assert up == pytest.approx(-3.0 * down)


def test_table_5_1(report: Make):
    """Recalled numbers are marked."""
    rows = alone(report, "table 5.1").tables[0].rows
    assert {row[0] for row in rows} >= {"MFC_P1", "MFC_P2", "AFC", "SMA_tube"}
    assert "recalled" in str(next(row for row in rows if row[0] == "AFC")[-1])


@pytest.mark.slow
def test_table_5_2(report: Make):
    """No net benefit if it needs more than it saves; attainable twist never saves more than a free twist of the best
    concept and the change of the blade together."""
    one = alone(report, "table 5.2")
    table = one.tables[0]
    gross, net = (table.columns.index(name) for name in ("gross kW", "net kW"))
    assert one.numbers["rows"] == 24.0
    assert all(float(row[net]) < float(row[gross]) for row in table.rows)
    assert [float(row[net]) for row in table.rows] == sorted((float(row[net]) for row in table.rows), reverse=True)
