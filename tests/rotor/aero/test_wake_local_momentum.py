"""Sector momentum: what it must share with momentum theory, and exact slopes."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.aero.disk import build_disk
from rotor.aero.inflow.interface import Wake
from rotor.aero.inflow.local_momentum import GAIN, LocalMomentumInflow
from rotor.aero.momentum import annulus_thrust, glauert_inflow
from rotor.aero.problem import build_problem
from rotor.arrays import Array
from rotor.files.make_design import make_design

DISK = build_disk(make_design().rotor, 12, 24)
COURSE = build_problem(make_design()).course


def answer(load: Array, wake: Wake, *, tip: bool = False) -> tuple[Array, Array]:
    """λ_i of a load, and its slopes by (µ_x, µ_z, λ0)."""
    followed = LocalMomentumInflow(tip).on(DISK, COURSE, (True, True)).follow(wake, wake.mu_z, sees_tilt=True)
    strength, by_wake = followed.atoms["lambda0 kx"]
    gain, gain_by_wake = followed.live[GAIN, "gain"]
    along = np.outer(DISK.r, DISK.cos)
    slopes = gain_by_wake[:, :, None] * load + np.multiply.outer(by_wake, along)
    return gain[:, None] * load + strength * along, slopes


def test_hover_is_the_annulus_balance():
    """d = 4λ²r (2.24): the load of a uniform inflow λ, with V = λ0 = λ, answers that inflow."""
    load = np.repeat(annulus_thrust(DISK.r, 0.06)[:, None], 24, axis=1)
    assert_allclose(answer(load, Wake(0.0, 0.0, 0.06))[0], 0.06, rtol=1e-14)


def test_uniformly_loaded_disk_in_forward_flight_is_glauerts():
    """p = C_T everywhere, d = 2 r p: λ0 of eq. (2.30) and the gradient 15π/32 tan(χ/2) on it."""
    ct = 0.0065
    lambda0, _ = glauert_inflow(ct, 0.2, 0.01)
    wake = Wake(0.2, 0.01, lambda0)
    chi = math.atan2(wake.mu_x, wake.axial)
    expected = lambda0 * (1.0 + 15.0 * math.pi / 32.0 * math.tan(chi / 2.0) * np.outer(DISK.r, DISK.cos))
    assert_allclose(answer(np.repeat((2.0 * DISK.r * ct)[:, None], 24, axis=1), wake)[0], expected, rtol=1e-12)


@pytest.mark.parametrize("wake", [(0.2, 0.01, 0.017), (0.0, 0.0, 0.06), (0.38, 0.05, 0.008)])
def test_slopes(wake: tuple[float, float, float]):
    d = np.random.default_rng(1).normal(size=(12, 24))
    exact = answer(d, Wake(*wake), tip=True)[1]
    for k in range(3):
        step = np.zeros(3)
        step[k] = 1e-6
        ahead, behind = (answer(d, Wake(*(np.array(wake) + s * step)), tip=True)[0] for s in (1.0, -1.0))
        # Central differences: truncation 1e-12/V² relative, rounding 1e-10.
        assert_allclose(exact[k], (ahead - behind) / 2e-6, rtol=0, atol=1e-8 * np.abs(exact).max())
