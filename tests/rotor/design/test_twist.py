"""Twist laws and their SPEC."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from rotor.design.twist import (
    IdealTwist,
    LinearTwist,
    PiecewiseLinearTwist,
    TwistLaw,
    ideal_tip_pitch,
    parse_twist,
    shipped_twist,
)
from rotor.files.make_design import make_design

R = np.linspace(0.13, 1.0, 88)
BUILTIN = shipped_twist("uh60a")


def parse(spec: str) -> TwistLaw:
    return parse_twist(spec, builtin=BUILTIN, ideal_tip_pitch=lambda: math.radians(6.4))


SPECS = [
    "linear:-8",
    "quadratic:6,-14",
    "segments:-12,-4@0.5",
    "segments:-4,-12,-20@0.4,0.75",
    "ideal:6.4",
    "uh60a",
]


@pytest.mark.parametrize("spec", SPECS)
def test_zero_at_three_quarter_radius_and_round_trip(spec: str):
    law = parse(spec)
    assert_allclose(law(0.75), 0.0, atol=1e-15)
    assert law.spec() == spec
    assert parse(law.spec()) == law
    assert hash(parse(spec)) == hash(law)


def test_laws_by_hand():
    """−8° per radius: root at 0.25 is 4° up, tip 2° down."""
    assert_allclose(np.degrees(parse("linear:-8")(np.array([0.25, 1.0]))), [4.0, -2.0], rtol=1e-13)
    law = parse("quadratic:6,-14")
    assert_allclose(np.degrees(law(1.0) - law(0.0)), -14.0, rtol=1e-13)
    second = law(0.2) - 2.0 * law(0.5) + law(0.8)
    assert_allclose(np.degrees(second) / 0.3**2 / 2.0, 6.0, rtol=1e-10)
    law = parse("segments:-12,-4@0.5")
    assert_allclose(np.degrees(law(0.4) - law(0.3)) / 0.1, -12.0, rtol=1e-10)
    assert_allclose(np.degrees(law(0.9) - law(0.8)) / 0.1, -4.0, rtol=1e-10)
    assert_allclose(law(0.5 - 1e-9), law(0.5 + 1e-9), atol=1e-8)
    # θ + θ_tip/0.75 = θ_tip/r, eq. (1.1).
    law = IdealTwist(0.11)
    assert_allclose((law(R) + 0.11 / 0.75) * R, 0.11, rtol=1e-13)


@given(rate=st.floats(-24, 5), division=st.floats(0.2, 0.9), second=st.floats(0.01, 0.09))
def test_equal_rates_are_linear(rate: float, division: float, second: float):
    law = PiecewiseLinearTwist((rate, rate, rate), (division, division + second))
    assert_allclose(law(R), LinearTwist(rate)(R), atol=1e-12)


def test_ideal_twist_without_a_number_is_for_hover_at_the_weight():
    light, heavy = (make_design(twist="ideal", mass_kg=mass).twist for mass in (5000.0, 11000.0))
    assert isinstance(light, IdealTwist)
    assert isinstance(heavy, IdealTwist)
    assert 0.05 < light.tip_pitch < heavy.tip_pitch < 0.25


def test_uh60a_table_agrees_with_genhel_and_a_line():
    """GenHel TWSTMR (NASA CR-166309) relative to 0.75 R, from two transcriptions; the deck is within 0.12°."""
    stations = [0.25, 0.30, 0.40, 0.50, 0.60, 0.70, 0.80, 0.90, 0.95]
    genhel = [8.70, 7.85, 6.10, 4.35, 2.55, 0.85, -0.65, -2.65, -3.45]
    assert_allclose(np.degrees(BUILTIN(stations)), genhel, atol=0.13)
    # r²-weighted least squares over 0.2…1: −15.9°, which supports the document's −16°.
    r = np.linspace(0.2, 1.0, 801)
    slope, _ = np.polyfit(r, np.degrees(BUILTIN(r)), 1, w=r)
    assert_allclose(slope, -15.9, atol=0.15)


def test_table_file(tmp_path: Path):
    path = tmp_path / "own.txt"
    path.write_text("r/R, deg  # heading\n0.2, 8\n0.75 1\n1.0,-3 # tip\n", encoding="utf-8")
    law = parse(f"table:{path}")
    assert_allclose(np.degrees(law(np.array([0.2, 0.75, 1.0]))), [7.0, 0.0, -4.0], atol=1e-12)
    assert law.spec() == f"table:{path}"


def test_ideal_tip_pitch_carries_the_thrust():
    """½σa(θ_tip − λ) r integrated over 0…1 is ¼σa(θ_tip − λ) = C_T with λ = √(C_T/2)."""
    ct, solidity, slope = 0.0065, 0.0821, 5.9
    pitch = ideal_tip_pitch(ct, solidity, slope)
    assert_allclose(0.25 * solidity * slope * (pitch - math.sqrt(ct / 2.0)), ct, rtol=1e-14)
