"""Readings of the thesis' section data and unit of twist."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.airfoil.polynomial import THESIS_NAME, PolynomialReading, parse_reading, thesis_polar
from rotor.airfoil.sections import load_section
from rotor.files.make_design import make_design
from rotor.reproduce import readings
from rotor.reproduce.report import Agreement
from rotor.reproduce.twist_effect import hover_optimum
from rotor.trim.solve import solve


@pytest.mark.parametrize("section", [name for name in readings.SECTIONS if name.startswith(THESIS_NAME)])
def test_a_reading_is_its_own_polar_and_range(section: str):
    """The table of each name follows the points of its own polar, and ends where its own fit ends."""
    reading = parse_reading(section)
    assert reading.name == section
    table, polar = load_section(section), thesis_polar(reading)
    assert table.fit_range is not None
    assert_allclose(np.degrees(table.fit_range), reading.range_deg)
    attached = (polar.alpha_deg >= -4.0) & (polar.alpha_deg <= 8.0)
    made = table(np.deg2rad(polar.alpha_deg[attached]), 0.3).cl
    assert_allclose(made, polar.cl[attached], atol=0.03)


def test_unknown_readings_are_refused():
    for name in ("sc1095-thesis:", "sc1095-thesis:free:x:1:2", "sc1095-thesis:glued:0.3:-10:15", "sc1095-thesis2"):
        with pytest.raises(ValueError, match="no polynomials named"):
            load_section(name)
    with pytest.raises(ValueError, match=r"Mach 0\.55"):
        load_section("sc1095-thesis:tripped:0.55:-10:15")


def test_the_first_reading_is_the_preset():
    assert readings.SECTIONS[0] == THESIS_NAME == PolynomialReading().name
    own = solve(make_design(preset="thesis", twist="linear:-8", mu=0.2)).require().power.total
    assert solve(readings.reading_design(THESIS_NAME, -8.0, 0.2)).require().power.total == own


@pytest.mark.slow
def test_statements_by_reading():
    """The preset's reading agrees with figure 3.11, and the numbers decide what is said to hold."""
    one = readings.judge(THESIS_NAME, "per radius")
    assert_allclose(one.optimum_deg, hover_optimum("thesis")[0], atol=0.2)
    assert one.holds[1] is (one.excess[1] > 1e-3)
    other = readings.judge(THESIS_NAME, "root to tip")
    root = make_design(preset="thesis").rotor.blade.root_cutout
    assert_allclose(other.optimum_deg, one.optimum_deg * (1.0 - root), atol=0.2)
    report = readings.readings((THESIS_NAME, "sc1095-thesis:free:0.3:-10:18", "sc1095"))
    assert report.verdict is Agreement.INDICATIVE
    assert report.numbers["most"] == max(value for key, value in report.numbers.items() if key != "most")
    assert len(report.tables[0].rows) == 6
