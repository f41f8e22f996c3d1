"""Where the wake of a blade lies: on the blade when young, and along the velocities of the formula."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.aero.lifting_line import WakeCourse
from rotor.support.arrays import Array

COURSE = WakeCourse(0.25, 0.02, 0.015, coning=0.06, flap_1c=0.02, flap_1s=-0.03, core=(1e-4, 1e-5))


def track(course: WakeCourse, released: float, r: float, t: float) -> Array:
    """Where what left the blade at an azimuth and radius is at a time after."""
    return course.nodes(np.array([released + t]), np.array([t]), np.array([r]))[0, 0, 0]


def test_what_has_just_left_lies_on_the_blade():
    psi, r = np.array([0.3, 2.0, 5.0]), np.array([0.2, 0.7, 1.0])
    beta = 0.06 + 0.02 * np.cos(psi) - 0.03 * np.sin(psi)
    found = COURSE.nodes(psi, np.zeros(1), r)[:, 0]
    expected = np.stack([np.outer(np.cos(psi), r), np.outer(np.sin(psi), r), np.outer(beta, r)], axis=-1)
    assert_allclose(found, expected, atol=1e-15)


def test_without_flight_it_sinks_as_the_helix_of_momentum_theory():
    course = replace(COURSE, mu_x=0.0, mu_z=0.0)
    for t in (0.1, 3.0, 20.0):
        begin, now = track(course, 1.0, 0.8, 0.0), track(course, 1.0, 0.8, t)
        assert_allclose(now - begin, [0.0, 0.0, -course.lambda0 * t], atol=1e-14)


@pytest.mark.parametrize(("released", "r"), [(math.pi, 0.9), (2.5, 0.6), (4.0, 1.0)])
def test_it_follows_the_inflow_inside_the_disk_and_behind_it(released: float, r: float):
    """Differences of z along the track against Beddoes' inflow, with χ = atan2(µ_x, µ_z + λ0)."""
    skew, step = 0.5 * math.atan2(COURSE.mu_x, COURSE.mu_z + COURSE.lambda0), 1e-5
    y = r * math.sin(released)
    leaves = (math.sqrt(1.0 - y * y) - r * math.cos(released)) / COURSE.mu_x
    assert COURSE.skewed == 1.0
    for t in (0.2 * leaves, 0.7 * leaves, 1.2 * leaves, 2.0 * leaves):
        before, after = track(COURSE, released, r, t - step), track(COURSE, released, r, t + step)
        x = r * math.cos(released) + COURSE.mu_x * t
        outward = skew * abs(y) ** 3
        induced = 1.0 + skew * x - outward if t < leaves else 2.0 * (1.0 - outward)
        velocity = [COURSE.mu_x, 0.0, -COURSE.mu_z - COURSE.lambda0 * induced]
        assert_allclose((after - before) / (2.0 * step), velocity, atol=1e-8)


def test_the_helix_of_hover_passes_over_to_the_skewed_wake_smoothly():
    """Nothing jumps, and nothing turns: the share of the skewed wake grows from 0 to 1 at µ_x = 2.5 √(C_T/2)."""
    thrust = 0.006
    mu = np.linspace(0.0, 0.15, 301)
    share: list[float] = []
    for one in mu:
        inflow = math.sqrt(0.5 * thrust)
        for _ in range(100):  # λ0 = C_T/2V
            inflow = 0.5 * (inflow + 0.5 * thrust / math.hypot(one, inflow))
        share.append(replace(COURSE, mu_x=float(one), mu_z=0.0, lambda0=inflow).skewed)
    slope = np.diff(share)
    assert share[0] == 0.0
    assert np.all(slope >= 0.0)
    assert slope.max() < 0.02
    assert_allclose(mu[share.index(1.0)], 2.5 * math.sqrt(0.5 * thrust), atol=1e-3)
