"""Units and numbers in print, beside what a hand writes."""

import math
import re
from pathlib import Path

import pytest

import explorer
import rotor
from rotor.support import units
from rotor.support.units import (
    degrees_text,
    digits_text,
    power_text,
    power_unit,
    seconds_text,
    typographic,
    unit_of,
)


def test_constants_by_definition():
    """The nautical mile an hour, the international foot and pound, and the standard gravity of ISO 2533."""
    assert math.isclose(3600.0 * units.KNOT, 1852.0, rel_tol=1e-15)
    assert [units.FOOT, units.POUND, units.GRAVITY] == [0.3048, 0.45359237, 9.80665]


@pytest.mark.parametrize(
    ("degrees", "text"),
    [(0.0, "0"), (-0.0, "0"), (8.0, "8"), (-12.5, "-12.5"), (0.1, "0.1"), (57.123456789, "57.123456789"),
     (360.0, "360")],
)  # fmt: skip
def test_degrees_are_the_shortest_that_are_the_angle_again(degrees: float, text: str):
    assert degrees_text(math.radians(degrees)) == text


def test_degrees_of_an_angle_without_a_short_number_have_all_digits():
    """Of these no degrees with 14 decimals are the angle again; 1 rad is 57.29577951308232°."""
    assert float(degrees_text(1.0)) == pytest.approx(57.29577951308232, rel=1e-15)
    angles = [k / 997.0 for k in range(-2000, 2000)]
    assert [float(degrees_text(angle)) for angle in angles] == pytest.approx(
        [math.degrees(a) for a in angles], rel=1e-15
    )


@pytest.mark.parametrize(
    ("power", "digits", "text"),
    [(412.4, 0, "412 W"), (999.0, 0, "999 W"), (1000.0, 0, "1 kW"), (-1230.0, 2, "-1.23 kW"),
     (901_240.0, 1, "901.2 kW"), (-0.4, 0, "0 W"), (0.0, 0, "0 W")],
)  # fmt: skip
def test_a_power_is_in_watts_below_a_kilowatt(power: float, digits: int, text: str):
    assert power_text(power, digits) == text
    assert digits or power_text(power) == text


def test_powers_side_by_side_have_one_unit():
    assert [power_unit(), power_unit(3.0, -999.0), power_unit(3.0, -2e3)] == [
        ("W", 1.0),
        ("W", 1.0),
        ("kW", 1e3),
    ]


def test_the_unit_is_the_end_of_a_name():
    known = {"cutout_r": "", "rate_deg": "°", "rate_deg_per_r": "°/R", "speed_m_s": "m/s", "chord_m": "m",
             "torque_nm": "N m", "power_total_w": "W", "saving_kw": "kW", "wide_percent": "%"}  # fmt: skip
    assert {name: unit_of(name) for name in known} == known


def test_a_hyphen_before_a_number_is_a_minus_and_one_within_a_word_is_not():
    assert typographic("linear:-8, -0.5 to 40-60, 1e-12, 2.-3, two-segment") == (
        "linear:−8, −0.5 to 40-60, 1e-12, 2.-3, two-segment"
    )


def test_digits():
    assert [digits_text(value) for value in (8.0, -3.0, 0.25, 1e-7)] == ["8", "-3", "0.25", "1e-07"]


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(0.04, "0.0 s"), (4.23, "4.2 s"), (9.96, "10 s"), (437.6, "438 s"), (86_400.0, "86400 s")],
)
def test_seconds_are_digits_and_no_power_of_ten(seconds: float, text: str):
    assert seconds_text(seconds) == text


def test_no_text_prints_seconds_with_an_exponent():
    """`.2g` of 440 s is 4.4e+02 s."""
    exponent = re.compile(r":\.?\d*g\} s\b")
    for package in (rotor, explorer):
        for path in Path(str(package.__file__)).parent.rglob("*.py"):
            assert not exponent.search(path.read_text(encoding="utf-8")), path
