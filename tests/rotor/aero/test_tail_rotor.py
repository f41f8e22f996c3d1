"""The tail rotor."""

import math

import pytest
from numpy.testing import assert_allclose

from rotor.files.make_design import make_design
from rotor.trim.power import tail_rotor_power
from rotor.trim.solve import solve

TAIL = make_design().tail_rotor or pytest.fail("The UH-60A has a tail rotor.")


def test_hover_power_by_hand():
    """T = Q/(l cos 20°); induced T^1.5/√(2ρA)/B; profile σ c̄_d/8 at the mean angle 6C_T/(σa)."""
    torque = 50_000.0
    thrust = torque / (9.926 * math.cos(math.radians(20.0)))
    area, tip = math.pi * 1.6764**2, 124.62 * 1.6764
    unit = 1.225 * area * tip**2
    solidity = 4 * 0.2469 / (math.pi * 1.6764)
    assert_allclose(solidity, 0.1875, atol=1e-4)  # published, TM-85890
    induced = thrust**1.5 / math.sqrt(2.0 * 1.225 * area) / 0.92
    alpha = 6.0 * (thrust / unit) / (solidity * 5.73)
    drag = 0.0087 - 0.0216 * alpha + 0.4 * alpha**2
    profile = solidity * drag / 8.0 * unit * tip
    assert_allclose(tail_rotor_power(TAIL, torque, 0.0, 1.225)[0], induced + profile, rtol=1e-10)


@pytest.mark.parametrize("speed", [0.0, 30.0, 80.0])
@pytest.mark.parametrize("torque", [-4e4, 5e3, 4e4, 9e4])
def test_slope_is_exact(speed: float, torque: float):
    _, slope = tail_rotor_power(TAIL, torque, speed, 1.1)
    difference = (
        tail_rotor_power(TAIL, torque + 1.0, speed, 1.1)[0] - tail_rotor_power(TAIL, torque - 1.0, speed, 1.1)[0]
    ) / 2.0
    assert_allclose(slope, difference, rtol=1e-6)


def test_the_thesis_adds_five_per_cent():
    power = solve(make_design(preset="thesis", mu=0.15)).require().power
    assert_allclose(power.tail, 0.05 * power.main_rotor, rtol=1e-14)
