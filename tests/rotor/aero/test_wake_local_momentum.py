"""Sector momentum: what it must share with momentum theory, and exact slopes."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.aero.inflow.interface import Wake
from rotor.aero.inflow.local_momentum import sector_operator
from rotor.aero.momentum import annulus_thrust, glauert_inflow

R = np.linspace(0.15, 0.98, 12)
COS = np.cos(2.0 * np.pi * np.arange(24) / 24)


def test_hover_is_the_annulus_balance():
    """d = 4λ²r (2.24): the load of a uniform inflow λ, with V = λ0 = λ, answers that inflow."""
    load = np.repeat(annulus_thrust(R, 0.06)[:, None], 24, axis=1)
    response = sector_operator(R, COS, Wake(0.0, 0.0, 0.06), 4, tip=False)
    assert_allclose(response.induced(load), 0.06, rtol=1e-14)


def test_uniformly_loaded_disk_in_forward_flight_is_glauerts():
    """p = C_T everywhere, d = 2 r p: λ0 of eq. (2.30) and the gradient 15π/32 tan(χ/2) on it."""
    ct = 0.0065
    lambda0, _ = glauert_inflow(ct, 0.2, 0.01)
    wake = Wake(0.2, 0.01, lambda0)
    response = sector_operator(R, COS, wake, 4, tip=False)
    chi = math.atan2(wake.mu_x, wake.axial)
    expected = lambda0 * (1.0 + 15.0 * math.pi / 32.0 * math.tan(chi / 2.0) * np.outer(R, COS))
    assert_allclose(response.induced(np.repeat((2.0 * R * ct)[:, None], 24, axis=1)), expected, rtol=1e-12)


@pytest.mark.parametrize("wake", [(0.2, 0.01, 0.017), (0.0, 0.0, 0.06), (0.38, 0.05, 0.008)])
def test_slopes(wake: tuple[float, float, float]):
    d = np.random.default_rng(1).normal(size=(12, 24))
    exact = sector_operator(R, COS, Wake(*wake), 4).induced_by_wake(d)
    for k in range(3):
        step = np.zeros(3)
        step[k] = 1e-6
        ahead, behind = (sector_operator(R, COS, Wake(*(np.array(wake) + s * step)), 4).induced(d) for s in (1.0, -1.0))
        # Central differences: truncation 1e-12/V² relative, rounding 1e-10.
        assert_allclose(exact[k], (ahead - behind) / 2e-6, rtol=0, atol=1e-8 * np.abs(exact).max())


def test_feedback_is_solved():
    response = sector_operator(R, COS, Wake(0.2, 0.01, 0.017), 4)
    slope = -np.abs(np.random.default_rng(2).normal(size=(12, 24)))
    f = np.random.default_rng(3).normal(size=(12, 24))
    inflow = response.feedback(slope) * f
    assert_allclose(inflow - response.gain[:, None] * slope * inflow, f, rtol=0, atol=1e-12)
