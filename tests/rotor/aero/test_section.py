"""The compiled loops over blade elements at their borders: `test_elements` has the formulas."""

import math
from dataclasses import replace

import numpy as np
from numpy.testing import assert_array_equal

from rotor.aero.problem import build_problem
from rotor.aero.section import FZ, LOSS, TH, UP, UR, UT, arctangent, section
from rotor.files.make_design import make_design
from rotor.support.arrays import Array
from rotor.support.compiled import compiled


@compiled()
def angles(p: Array, t: Array) -> Array:
    out = np.empty_like(p)
    for k in range(len(p)):
        out[k] = arctangent(p[k], t[k])
    return out


def test_arctangent_to_rounding():
    """Against the arctangent of the C library: all quadrants, sixteen orders of magnitude, and both axes."""
    random = np.random.default_rng(1)
    p = random.normal(size=400_000) * 10.0 ** random.uniform(-8.0, 8.0, 400_000)
    t = random.normal(size=400_000)
    found, exact = angles(p, t), np.arctan2(p, t)
    assert np.abs((found - exact) / np.spacing(np.abs(exact))).max() <= 3.0
    axes = np.array([0.0, 1.0, -1.0, 0.0, 0.0]), np.array([1.0, 0.0, 0.0, -1.0, 0.0])
    assert_array_equal(angles(*axes), [0.0, 0.5 * math.pi, -0.5 * math.pi, math.pi, 0.0])


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
