"""Readings of the thesis: section data, losses, unit of twist, count of power."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.airfoil.polynomial import THESIS_NAME, THESIS_READING, parse_reading, thesis_polar
from rotor.airfoil.sections import load_section
from rotor.files.make_design import make_design
from rotor.validation.thesis import readings
from rotor.validation.thesis.twist_effect import hover_optimum


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


def test_the_preset_is_one_of_the_readings():
    preset = readings.reading_design(THESIS_READING.name, "inflow", -8.0, 0.2)
    assert preset == make_design(preset="thesis", twist="linear:-8", mu=0.2)
    before = readings.reading_design(THESIS_NAME, "lift", -8.0, 0.2)
    assert before == make_design(preset="thesis", twist="linear:-8", mu=0.2, loss_on="lift", airfoils=THESIS_NAME)


@pytest.mark.slow
def test_the_preset_is_the_reading_that_holds_most():
    """The numbers decide what is said to hold; units of twist scale, and torque less parts is what the disk takes."""
    found = readings.judged_readings()
    assert len(found) == 80
    most = max(sum(judgement.holds) for judgement in found)
    preset = readings.ThesisReading(THESIS_READING.name, "inflow", "root to tip", "sum")
    assert found[0].reading == preset
    assert sum(found[0].holds) == most
    radius, _, tip, torque = readings.judge(THESIS_READING.name, "inflow")
    assert_allclose(radius.optimum_deg, hover_optimum("thesis")[0], atol=0.2)
    root = make_design(preset="thesis").rotor.blade.root_cutout
    assert_allclose(tip.optimum_deg, radius.optimum_deg * (1.0 - root), atol=0.2)
    assert_allclose(tip.excess[0], torque.excess[0], rtol=1e-9)  # In hover torque and parts are the same.
    assert_allclose(radius.overtakes, 0.18, atol=0.005)
