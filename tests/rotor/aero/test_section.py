"""The compiled loops over blade elements at their borders: `test_elements` has the formulas."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.polynomial import polynomial
from numpy.testing import assert_allclose, assert_array_equal

from rotor.aero.look_up import surface
from rotor.aero.problem import build_problem
from rotor.aero.section import FZ, LOSS, TH, UP, UR, UT, arctangent, of_double_angle, section
from rotor.files.make_design import make_design
from rotor.support.arrays import Array
from rotor.support.compiled import compiled


@compiled()
def angles(p: Array, t: Array) -> Array:
    out = np.empty_like(p)
    for k in range(len(p)):
        out[k] = arctangent(p[k], t[k])
    return out


@compiled()
def doubled(angle: Array) -> Array:
    out = np.empty((2, len(angle)))
    for k in range(len(angle)):
        out[0, k], out[1, k] = of_double_angle(angle[k])
    return out


@compiled()
def polynomials(cell: Any, u: Any, v: Any) -> Any:
    out = np.empty((3, len(u)))
    for k in range(len(u)):
        out[0, k], out[1, k], out[2, k] = surface(cell, u[k], v[k])
    return out


def test_the_polynomial_of_a_cell_is_that_of_numpy():
    random = np.random.default_rng(2)
    u, v = random.uniform(0.0, 1.0, (2, 500))
    cell = random.standard_normal((2, 4, 4))[1]
    found = polynomials(cell, u, v)
    assert_allclose(found[0], polynomial.polyval2d(u, v, cell), rtol=0, atol=1e-14)
    for axis in range(2):
        slope = polynomial.polyval2d(u, v, polynomial.polyder(cell, axis=axis))
        assert_allclose(found[1 + axis], slope, rtol=0, atol=3e-14)


def test_arctangent_to_rounding():
    """Against the arctangent of the C library: all quadrants, sixteen orders of magnitude, and both axes."""
    random = np.random.default_rng(1)
    p = random.normal(size=400_000) * 10.0 ** random.uniform(-8.0, 8.0, 400_000)
    t = random.normal(size=400_000)
    found, exact = angles(p, t), np.arctan2(p, t)
    assert np.abs((found - exact) / np.spacing(np.abs(exact))).max() <= 3.0
    axes = np.array([0.0, 1.0, -1.0, 0.0, 0.0]), np.array([1.0, 0.0, 0.0, -1.0, 0.0])
    assert_array_equal(angles(*axes), [0.0, 0.5 * math.pi, -0.5 * math.pi, math.pi, 0.0])


def test_double_angle_to_rounding():
    """sin 2θ and cos 2θ against the C library, over several turns."""
    theta = np.random.default_rng(3).uniform(-10.0, 10.0, 100_000)
    theta[:5] = 0.0, 0.25 * math.pi, -0.25 * math.pi, 0.5 * math.pi, -math.pi
    sine, cosine = doubled(theta)
    assert np.abs(sine - np.sin(2.0 * theta)).max() < 1.5e-15
    assert np.abs(cosine - np.cos(2.0 * theta)).max() < 1.5e-15
    assert abs(doubled(np.full(1, 1e-9))[0, 0] / 2e-9 - 1.0) < 1e-15


def test_what_is_not_a_number_stays_so():
    """A pitch that is not a number reads no memory outside the tables, and no other element is touched."""
    design = make_design(mu=0.2, inflow="pitt-peters")
    problem = build_problem(replace(design, models=replace(design.models, elements=6, azimuths=8)))
    disk, data = problem.disk, problem.section_data()
    channels = np.zeros((6, *disk.shape))
    channels[TH], channels[UP], channels[UR], channels[LOSS] = 0.1, 0.02, 0.2 * disk.cos, 1.0
    channels[UT] = disk.r[:, None] + 0.2 * disk.sin
    whole = section(channels, data, True, True)
    channels[TH, 2, 3] = channels[UT, 4, 5] = np.nan
    broken = section(channels, data, True, True)
    bad = np.isnan(broken[0][FZ])
    assert np.argwhere(bad).tolist() == [[2, 3], [4, 5]]
    for found, before in zip(broken, whole, strict=True):
        assert_array_equal(found[:, ~bad], before[:, ~bad])
