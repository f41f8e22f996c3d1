"""Chapter 5: its numbers are not known to us, so the tests are conditions of any piezoelectric sheet and blade."""

from collections.abc import Callable

import pytest

from rotor.validation.thesis.report import Agreement, Report

Make = Callable[[str], Report]


def alone(report: Make, number: str) -> Report:
    """No comparison without reference numbers."""
    one = report(number)
    assert one.verdict is Agreement.NO_REFERENCE
    assert one.tables
    return one


def test_figure_5_5(report: Make):
    """Interdigitated electrodes strain the same fibres three to four times as much: 1800 against 500 ppm."""
    numbers = alone(report, "5.5").numbers
    assert 3.0 < numbers["MFC_P1"] / numbers["MFC_P2"] < 4.0
    assert numbers["MFC_P1"] == max(numbers.values())


def test_figure_5_7(report: Make):
    """4 kV/mm over 2000 V across a gap of 0.5 mm."""
    numbers = alone(report, "5.7").numbers
    assert numbers["MFC_P1"] == pytest.approx(2000.0 / 0.5 / 1e3)
    assert numbers["MFC_P2"] < numbers["MFC_P1"]


def test_figure_5_10(report: Make):
    """Up at positive voltage, three times as far as down at −500 V; the worked example's tips within 10 %."""
    one = alone(report, "5.10")
    for (name, up, down), expected in zip(
        one.tables[0].rows, (0.92, 1.66, 2.84, 4.16), strict=True
    ):
        assert one.numbers[str(name)] == pytest.approx(expected, rel=0.1)
        assert float(up) == pytest.approx(-3.0 * float(down))


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
    gross, net = (
        [
            float(str(row[table.columns.index(f"{name} kW")]).partition(" ± ")[0])
            for row in table.rows
        ]
        for name in ("gross", "net")
    )
    assert one.numbers["rows"] == 24.0
    assert all(less < more for less, more in zip(net, gross, strict=True))
    assert net == sorted(net, reverse=True)
