"""Velocities of filaments and vortex cylinders, against theory and against each other."""

import math

import numpy as np
import pytest

from rotor.aero.free_wake.biot_savart import cylinder_velocity, filament_slopes, filament_velocity


def test_straight_segment_follows_the_law_of_biot_and_savart():
    """v = Γ/4πh (cos a − cos b) beside a segment, here from −1 to 2 at distance 0.5."""
    velocity = np.zeros(3)
    filament_velocity((0.5, 0.0, 0.0), np.zeros(2), np.array([-1.0, 2.0]), np.zeros(2), np.zeros(1), 0, velocity)
    exact = (1.0 / math.hypot(1.0, 0.5) + 2.0 / math.hypot(2.0, 0.5)) / (4.0 * math.pi * 0.5)
    assert velocity == pytest.approx([0.0, 0.0, -exact], abs=1e-14)


def test_vatistas_core_has_its_greatest_speed_at_the_core_radius():
    """n = 2: v = Γ/2π h/√(h⁴ + r_c⁴), greatest at h = r_c, beside an endless vortex."""
    distances = np.linspace(0.05, 0.2, 301)
    speeds = []
    for h in distances:
        velocity = np.zeros(3)
        line = np.array([-1e3, 1e3])
        filament_velocity((h, 0.0, 0.0), np.zeros(2), line, np.zeros(2), np.full(1, 0.1**2), 0, velocity)
        speeds.append(-velocity[2])
    assert speeds == pytest.approx(distances / np.sqrt(distances**4 + 0.1**4) / (2.0 * math.pi), rel=1e-5)
    assert distances[int(np.argmax(speeds))] == pytest.approx(0.1, abs=1e-3)


def test_endless_helix_induces_what_kawada_and_hardin_found():
    """On its axis a helix of pitch 2πp induces Γ/2πp along it (Hardin, Phys. Fluids 25, 1982)."""
    pitch, radius, turns, steps = 0.08, 0.8, 60, 72
    angle = np.linspace(-turns * math.pi, turns * math.pi, turns * steps + 1)
    velocity = np.zeros(3)
    filament_velocity(
        (0.0, 0.0, 0.0), radius * np.cos(angle), -radius * np.sin(angle), -pitch * angle,
        np.zeros(len(angle) - 1), 0, velocity,
    )  # fmt: skip
    assert velocity[2] == pytest.approx(-1.0 / (2.0 * math.pi * pitch), rel=2e-3)


@pytest.mark.parametrize("r", [0.0, 0.3, 0.6, 1.1])
def test_vortex_cylinder_is_a_sum_of_rings(r: float):
    radius, zeta = 0.75, 0.4
    found = cylinder_velocity(r, zeta, radius, 48)
    spacing, rings = 0.02, 4000
    angle = 2.0 * math.pi * np.arange(361) / 360.0
    total = np.zeros(3)
    for k in range(rings):
        velocity = np.zeros(3)
        depth = np.full(361, -spacing * (k + 0.5))
        filament_velocity(
            (r, zeta, 0.0), radius * np.cos(angle), -radius * np.sin(angle), depth, np.zeros(360), 0, velocity
        )
        total += spacing * velocity
    assert found[:2] == pytest.approx([total[0], total[2]], abs=2e-4)


def test_slopes_of_a_cylinder_agree_with_differences():
    h = 1e-6
    at = np.array([0.6, 0.3, 0.8])
    found = cylinder_velocity(*at, 16)
    for k in range(3):
        step = h * np.eye(3)[k]
        ahead, behind = (cylinder_velocity(*(at + sign * step), 16) for sign in (1.0, -1.0))
        assert found[2 + 2 * k] == pytest.approx((ahead[0] - behind[0]) / (2 * h), abs=1e-8)
        assert found[3 + 2 * k] == pytest.approx((ahead[1] - behind[1]) / (2 * h), abs=1e-8)


def test_filament_with_slopes_has_the_same_velocity():
    rng = np.random.default_rng(1)
    radius, z, angle = 0.5 + 0.5 * rng.random(9), -rng.random(9), np.linspace(0.3, -2.0, 9)
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    source = np.full(8, 0.01)
    plain, velocity = np.zeros(3), np.zeros(3)
    filament_velocity((0.7, -0.1, 0.0), x, y, z, source, 0, plain)
    start, end = np.zeros((6, 8)), np.zeros((6, 8))
    filament_slopes(
        (0.7, -0.1, 0.0), x, y, z, np.cos(angle), np.sin(angle), source, 0, velocity, np.zeros(6), np.zeros(3),
        np.zeros(8), start, end,
    )  # fmt: skip
    assert velocity == pytest.approx(plain, abs=1e-15)
