"""Momentum theory against its own closed limits (thesis eqs. 2.1–2.12, 2.20–2.31)."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.aero.momentum import (
    WAKE_CONTRACTION,
    annulus_power,
    annulus_thrust,
    glauert_inflow,
    hover_induced_velocity,
    ideal_power,
    power_coefficient,
    skew_angle,
    thrust_coefficient,
)

RHO, AREA, TIP_SPEED, THRUST = 1.225, 210.1, 220.8, 81_600.0


def test_far_wake_is_half_the_disk():
    """Continuity: A v_h = A∞ w with w = 2 v_h (2.5), so A∞/A = ½ (2.8)."""
    v_h = hover_induced_velocity(THRUST, RHO, AREA)
    wake_velocity = THRUST / (RHO * AREA * v_h)  # (2.6): T = ṁ w
    assert_allclose(wake_velocity, 2.0 * v_h, rtol=1e-14)
    assert_allclose(v_h / wake_velocity, WAKE_CONTRACTION, rtol=1e-14)


def test_ideal_power_forms_agree():
    """(2.10): T v_h = 2ρA v_h³, and (2.7): ½ ṁ w²."""
    v_h = hover_induced_velocity(THRUST, RHO, AREA)
    assert_allclose(ideal_power(THRUST, RHO, AREA), 2.0 * RHO * AREA * v_h**3, rtol=1e-14)
    assert_allclose(ideal_power(THRUST, RHO, AREA), 0.5 * (RHO * AREA * v_h) * (2.0 * v_h) ** 2, rtol=1e-14)


def test_ideal_figure_of_merit_is_one():
    """C_P = C_T^1.5/√2 for the ideal rotor."""
    ct = thrust_coefficient(THRUST, RHO, AREA, TIP_SPEED)
    cp = power_coefficient(ideal_power(THRUST, RHO, AREA), RHO, AREA, TIP_SPEED)
    assert_allclose(ct**1.5 / math.sqrt(2.0) / cp, 1.0, rtol=1e-14)


def test_annulus_integrals_need_the_single_power():
    """(2.26), (2.27) print (λ − λ_c)²; a uniform inflow 0.055 must give C_T = 2λ² = 0.00605, C_P = λ C_T."""
    r = (np.arange(2000) + 0.5) / 2000
    lam = np.full_like(r, 0.055)
    ct = annulus_thrust(r, lam).mean()
    assert_allclose(ct, 2.0 * 0.055**2, rtol=1e-6)  # midpoint rule on a linear integrand
    assert_allclose(annulus_power(r, lam).mean(), 0.055 * ct, rtol=1e-12)
    as_printed = (4.0 * lam * lam**2 * r).mean()
    assert as_printed < 0.1 * ct


def test_annulus_climb_does_work_on_the_climb():
    """With λ_c the power is λ dC_T: induced (λ − λ_c) plus climb λ_c."""
    r = np.array([0.3, 0.7])
    assert_allclose(annulus_power(r, 0.07, 0.02), 0.07 * annulus_thrust(r, 0.07, 0.02), rtol=1e-14)
    assert_allclose(annulus_thrust(r, 0.07, 0.07), 0.0, atol=1e-18)


def test_glauert_hover_limit():
    inflow, slope = glauert_inflow(0.0065, 0.0, 0.0)
    assert_allclose(inflow, math.sqrt(0.0065 / 2.0), rtol=1e-13)
    assert_allclose(slope, 0.25 / inflow, rtol=1e-10)


def test_glauert_fast_limit():
    """At high speed λ0 → C_T/(2µ); the next term is −λ0³/(2µ²)."""
    inflow, _ = glauert_inflow(0.0065, 0.4, 0.0)
    assert_allclose(inflow, 0.0065 / 0.8, rtol=1e-3)


@pytest.mark.parametrize("mu_x", [0.0, 0.05, 0.2, 0.45])
@pytest.mark.parametrize("mu_z", [-0.01, 0.0, 0.03, 0.1])
@pytest.mark.parametrize("ct", [1e-4, 0.006, 0.013])
def test_glauert_closes_and_slope_is_exact(ct: float, mu_x: float, mu_z: float):
    inflow, slope = glauert_inflow(ct, mu_x, mu_z)
    assert_allclose(2.0 * inflow * math.hypot(mu_x, mu_z + inflow), ct, rtol=1e-12)
    h = 1e-6 * ct
    difference = (glauert_inflow(ct + h, mu_x, mu_z)[0] - glauert_inflow(ct - h, mu_x, mu_z)[0]) / (2.0 * h)
    assert_allclose(slope, difference, rtol=1e-6)


def test_glauert_climb_is_the_quadratic():
    """Axial flow: λ0² + µ_z λ0 = C_T/2."""
    inflow, _ = glauert_inflow(0.008, 0.0, 0.05)
    assert_allclose(inflow, -0.025 + math.sqrt(0.025**2 + 0.004), rtol=1e-13)


def test_glauert_odd_in_thrust():
    up, down = glauert_inflow(0.006, 0.1, 0.0), glauert_inflow(-0.006, 0.1, 0.0)
    assert_allclose(down[0], -up[0], rtol=1e-14)
    assert_allclose(down[1], up[1], rtol=1e-14)


def test_skew_angle_limits():
    assert skew_angle(0.0, 0.0, 0.05) == 0.0
    assert_allclose(skew_angle(0.3, 0.0, 0.0), math.pi / 2.0, rtol=1e-15)
