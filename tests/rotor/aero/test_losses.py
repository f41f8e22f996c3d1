"""Prandtl's loss factors, eqs. (3.16)–(3.18)."""

import math

import numpy as np
from numpy.testing import assert_allclose

from rotor.aero import losses
from rotor.aero.losses import HUB_FACTOR, end_factor, loss_factor, mean_loss_factor, prandtl


def test_tip_factor_by_hand():
    """Four blades, r = 0.95, λ = 0.05: f = ½·4·0.05/0.05 = 2, F = (2/π) arccos(e⁻²) = 0.913578."""
    factor, _ = loss_factor(0.95, 0.05, 4, 0.13, hub=False)
    assert_allclose(factor, 2.0 / math.pi * math.acos(math.exp(-2.0)), rtol=1e-14)
    assert_allclose(factor, 0.913578, atol=1e-6)


def test_hub_factor_uses_the_printed_b():
    """(3.17) with B = 0.95, not the number of blades: at r − r_min = 0.1, λ = 0.05, f = 0.95."""
    assert HUB_FACTOR == 0.95
    factor, _ = loss_factor(0.23, 0.05, 4, 0.13, tip=False)
    assert_allclose(factor, 2.0 / math.pi * math.acos(math.exp(-0.95)), rtol=1e-13)
    both, tip = (loss_factor(0.23, 0.05, 4, 0.13, hub=hub)[0] for hub in (True, False))
    assert_allclose(both, tip * factor, rtol=1e-14)


def test_slope_by_inflow_and_finite_at_zero_inflow():
    r = np.linspace(0.14, 0.995, 30)[:, None]
    inflow = np.array([-0.04, -0.005, 0.003, 0.02, 0.08])
    factor, slope = loss_factor(r, inflow, 4, 0.13)
    h = 1e-7
    difference = (loss_factor(r, inflow + h, 4, 0.13)[0] - loss_factor(r, inflow - h, 4, 0.13)[0]) / (2.0 * h)
    assert_allclose(slope, difference, rtol=1e-5, atol=1e-6)
    assert ((factor > 0.0) & (factor <= 1.0)).all()
    still, _ = loss_factor(r, 0.0, 4, 0.13)
    assert_allclose(still, 1.0)


def test_end_factor_to_rounding():
    """1 − e^−f against the C library over fourteen orders of magnitude, and the factor made of it against
    arccos(1 − x) = 2 arcsin √(x/2), which loses no digits at either end."""
    f = np.concatenate([np.geomspace(1e-12, 40.0, 20_000), np.linspace(0.0, 40.0, 20_001)[1:]])
    found = np.array([losses._fall(one) for one in f.tolist()])  # pyright: ignore[reportPrivateUsage]
    assert np.abs(found / -np.expm1(-f) - 1.0).max() < 2e-15
    inflow = -0.05
    factor, slope = np.array([end_factor(one * 0.05, inflow) for one in f.tolist()]).T
    assert_allclose(factor, 4.0 / math.pi * np.arcsin(np.sqrt(-0.5 * np.expm1(-f))), rtol=3e-15)
    assert_allclose(slope, prandtl(f)[1] * -f / inflow, rtol=1e-14, atol=1e-13)


def test_mean_around_the_azimuth():
    """The compiled mean is that of the factor and of its slopes, with either end and with both, upflow included."""
    r = np.linspace(0.14, 0.995, 30)
    inflow = 0.03 + 0.05 * r[:, None] * np.cos(np.arange(24) * math.pi / 12.0)
    ways = np.stack([np.ones_like(inflow), inflow**2])
    for tip, hub in ((True, True), (True, False), (False, True), (False, False)):
        factor, slope = loss_factor(r[:, None], inflow, 4, 0.13, tip=tip, hub=hub)
        found = mean_loss_factor(r, inflow, ways, (4, 0.13), tip, hub)
        assert_allclose(found[0], factor.mean(axis=1), rtol=1e-14)
        assert_allclose(found[1], slope.mean(axis=1), rtol=1e-11, atol=1e-13)
        assert_allclose(found[2:], (slope * ways).mean(axis=2), rtol=1e-11, atol=1e-13)
