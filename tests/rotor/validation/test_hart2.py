"""HART II: definitions against facts and closed forms, and what the trust page says of it."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.aero.lifting_line import WakeCourse
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from rotor.validation import hart2
from rotor.validation.airloads import agreement, computed_curve, harmonics
from rotor.validation.hart2 import height, measured_vortices

CURVES = hart2.curves()
CASES = {case.name: case for case in hart2.cases()}


@pytest.fixture(scope="module")
def solutions() -> dict[str, Solution]:
    return {name: solve(case.design()).require() for name, case in CASES.items()}


def test_amplitude_and_phase_of_a_known_curve(solutions: dict[str, Solution]):
    """2 cos(3ψ − 40°) beside our twist: its amplitude, its phase, and how late ours is."""
    psi = np.linspace(0.0, 2.0 * math.pi, 30, endpoint=False)
    curve = replace(CURVES["MN", "tip_twist_deg"], psi=psi, values=2.0 * np.cos(3.0 * psi - math.radians(40.0)))
    one = agreement(curve, solutions["MN"])
    assert_allclose(one.amplitude(3, measured=True), 2.0)
    assert_allclose(one.phase_deg(3, measured=True), 40.0)
    assert_allclose(one.late_deg(3), one.phase_deg(3) - 40.0)
    assert_allclose(one.ratio(3), 0.5 * one.amplitude(3) - 1.0)


def test_measured_motion_and_vortices_are_those_of_the_source():
    """23 flap positions a case, a mean of −0.006 R; 46 and 43 vortices above the hub, most in the disk."""
    for name, points in (("BL", 46), ("MN", 43)):
        flap = CURVES[name, "tip_flap"]
        assert len(flap.psi) == 23
        assert_allclose(flap.waves[0], -0.006, atol=4e-4)
        x, y, z = measured_vortices(name)
        assert len(x) == points
        assert (np.hypot(x, y) > 1.0).sum() <= 2
        assert 0.0 < z.min() < z.max() < 0.14
    twist = CURVES["MN", "tip_twist_deg"].waves
    assert_allclose(np.hypot(twist[1:4], twist[4:]), [0.28, 0.42, 1.28], atol=0.03)


def test_height_of_a_vortex_that_no_inflow_moves():
    """Then it rises along a straight line: β0 above the hub at the edge, −µ_z t above that."""
    course = WakeCourse(0.15, -0.0113, 0.0, coning=0.04, flap_1c=0.0, flap_1s=0.0, core=(1e-4, 1e-6))
    x, y = np.array([-0.8, 0.0, 0.6]), np.array([0.6, 0.0, -0.7])
    age = (x + np.sqrt(1.0 - y * y)) / 0.15
    assert_allclose(height(course, x, y), 0.04 + 0.0113 * age, atol=1e-12)


def test_moment_of_the_pitch_rate(solutions: dict[str, Solution]):
    """C_m of MN at 3/rev, −(π/4) c θ̇/U at 0.87 R with U = ΩR (0.87 + µ sin ψ) over the section's own by hand."""
    solution = solutions["MN"]
    disk, psi = solution.disk, solution.disk.psi
    i = int(np.argmin(np.abs(disk.r - 0.87)))
    theta = harmonics(psi, disk.theta[i], 8)
    order = np.arange(1, 9)
    rate = order * theta[9:] @ np.cos(np.outer(order, psi)) - order * theta[1:9] @ np.sin(np.outer(order, psi))
    speed = disk.r[i] + solution.design.condition.advance_ratio * np.sin(psi)
    mach = 2.0 * 109.01 / 342.2
    by_hand = -0.25 * math.pi * 0.0605 * rate * speed * mach**2
    curve = replace(CURVES["MN", "cm_m2"], r=float(disk.r[i]))
    whole = harmonics(*computed_curve(curve, solution), 3)
    expected = harmonics(psi, by_hand, 3)
    assert math.hypot(expected[3], expected[6]) > 0.001
    rest = whole - expected  # The section's own moment, a fifth of it, and that of d²θ/dt².
    assert math.hypot(rest[3], rest[6]) < 0.0007
