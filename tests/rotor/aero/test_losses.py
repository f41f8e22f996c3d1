"""Prandtl's loss factors, eqs. (3.16)–(3.18), on the lift and on the inflow."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.testing import assert_allclose

from rotor import Solution, make_design, solve
from rotor.aero.losses import HUB_FACTOR, loss_factor, mean_loss_factor
from rotor.design.quantities import LOSS_ON, LossOn
from rotor.support.arrays import Array
from rotor.trim.analysis import Analysis


def test_tip_and_hub_factors_by_hand():
    """Four blades, r = 0.95, λ = 0.05: f = ½·4·0.05/0.05 = 2, F = (2/π) arccos(e⁻²) = 0.913578."""
    factor, _ = loss_factor(0.95, 0.05, 4, 0.13, hub=False)
    assert_allclose(factor, 2.0 / math.pi * math.acos(math.exp(-2.0)), rtol=1e-14)
    assert_allclose(factor, 0.913578, atol=1e-6)
    # (3.17) with B = 0.95, not the number of blades: at r − r_min = 0.1, λ = 0.05, f = 0.95.
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
    difference = (
        loss_factor(r, inflow + h, 4, 0.13)[0] - loss_factor(r, inflow - h, 4, 0.13)[0]
    ) / (2.0 * h)
    assert_allclose(slope, difference, rtol=1e-5, atol=1e-6)
    assert ((factor > 0.0) & (factor <= 1.0)).all()
    still, _ = loss_factor(r, 0.0, 4, 0.13)
    assert_allclose(still, 1.0)


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


def with_loss(on: LossOn, mu: float, preset: str = "flight", **models: Any) -> Solution:
    design = make_design(preset=preset, mu=mu, twist="linear:-8", inflow="pitt-peters-15pi/23")
    return solve(replace(design, models=replace(design.models, loss_on=on, **models))).require()


def test_without_losses_it_does_not_matter_where_they_act():
    """F = 1 at both ends, and hover, where the annulus balance (3.3) holds F in either case."""
    whole = [with_loss(on, 0.2, tip_loss=False, hub_loss=False).power for on in LOSS_ON]
    hover = [with_loss(on, 0.0, "thesis").power for on in LOSS_ON]
    for one, other in (whole, hover):
        assert_allclose(one.main_rotor, other.main_rotor, rtol=1e-12)


def test_loss_on_the_inflow_is_that_of_the_annulus_in_fast_flight():
    """λ_i at the blades against dC_T = 4 F λ_i √(µ² + λ²) r dr, with the load that has λ_i0 at F = 1: λ_i0/F where µ is
    large, with an error of (λ/µ)²; and against λ0(1 + k_x r cos ψ)/F by hand, with F averaged over 360 azimuths."""
    errors: list[float] = []
    for mu in (0.15, 0.35):
        one = with_loss("inflow", mu, "thesis")
        disk, state = one.disk, Analysis(one).linear.elements.state
        psi = np.radians(np.arange(360.0))
        tilt = 15.0 * math.pi / 23.0 * math.tan(0.5 * math.atan2(mu * math.cos(state.shaft_tilt), mu * math.sin(
            state.shaft_tilt) + state.lambda0))  # fmt: skip
        at = disk.r[:, None]
        plain = state.lambda0 * (1.0 + tilt * at * np.cos(psi))
        factor = loss_factor(at, plain, 4, 0.1304)[0].mean(axis=1)
        by_hand = state.lambda0 * (1.0 + tilt * at * np.cos(disk.psi)) / factor[:, None]
        assert_allclose(disk.induced, by_hand, rtol=1e-3)
        free, lost = state.lambda0, disk.induced.mean(axis=1)

        def annulus(
            inflow: Array, mu: float = mu, factor: Array = factor, free: float = free
        ) -> Array:
            return factor * inflow * np.hypot(mu, inflow) / (free * math.hypot(mu, free)) - 1.0

        errors.append(float(np.abs(annulus(lost)).max()))
        assert errors[-1] < (lost.max() / mu) ** 2
    assert errors[1] < 0.2 * errors[0]


def test_the_parts_of_power_are_the_torque_with_loss_on_the_inflow():
    """Energy: without the axial flow of the disk, as (3.6) prints it, P_shaft lacks drag times speed and µ H, the force
    that drags the disk aft times speed; with it, P_shaft is the sum of parts: `test_the_energy_closes`."""
    stated = with_loss("inflow", 0.25, "thesis")
    e, psi = Analysis(stated).linear.elements, stated.disk.psi
    aft = (e.fx * np.sin(psi) - e.fz * e.beta * np.cos(psi)).mean(axis=1)
    lacking = 0.25 * float(stated.disk.dr @ aft) * stated.design.power_unit
    assert_allclose(
        stated.power.shaft, stated.power.induced + stated.power.profile - lacking, rtol=1e-6
    )
