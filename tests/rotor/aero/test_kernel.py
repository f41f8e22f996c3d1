"""The compiled loops over blade elements at their borders: `test_elements` has the formulas."""

import math

import numpy as np
from numpy.testing import assert_array_equal

from rotor.aero import kernel
from rotor.aero.disk import build_disk
from rotor.aero.torsion_balance import propeller_moment
from rotor.arrays import Array
from rotor.compiled import compiled
from rotor.files.make_design import make_design


@compiled()
def angles(p: Array, t: Array) -> Array:
    out = np.empty_like(p)
    for k in range(len(p)):
        out[k] = kernel.arctangent(p[k], t[k])
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


def test_propeller_moment_to_rounding():
    """½ sin 2θ and cos 2θ against the C library, over several turns."""
    theta = np.random.default_rng(3).uniform(-10.0, 10.0, (100, 1000))
    theta[0, :5] = 0.0, 0.25 * math.pi, -0.25 * math.pi, 0.5 * math.pi, -math.pi
    sine, cosine = propeller_moment(np.ones(100), theta)
    assert np.abs(2.0 * sine - np.sin(2.0 * theta)).max() < 1.5e-15
    assert np.abs(cosine - np.cos(2.0 * theta)).max() < 1.5e-15
    small = propeller_moment(np.ones(1), np.full((1, 1), 1e-9))[0]
    assert abs(small[0, 0] / 1e-9 - 1.0) < 1e-15


def test_what_is_not_a_number_stays_so():
    """A pitch that is not a number reads no memory outside the tables, and no other element is touched."""
    disk = build_disk(make_design(mu=0.2).rotor, 6, 8)
    theta, u_p = np.full(disk.shape, 0.1), np.full(disk.shape, 0.02)
    u_t = disk.r[:, None] + 0.2 * disk.sin
    common = (
        0.2 * disk.cos, np.ones(6), 0.65, disk.half_solidity, disk.section, disk.weight, disk.offset, disk.tables,
        disk.cos_sweep, disk.sin_sweep,
    )  # fmt: skip
    whole = kernel.element_loads(theta, u_t, u_p, *common)
    theta[2, 3] = u_t[4, 5] = np.nan
    broken = kernel.element_loads(theta, u_t, u_p, *common)
    bad = np.isnan(broken[kernel.FZ])
    assert np.argwhere(bad).tolist() == [[2, 3], [4, 5]]
    assert_array_equal(broken[:, ~bad], whole[:, ~bad])
