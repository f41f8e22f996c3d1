"""Momentum theory, the linear inflow family, eqs. (2.29)–(2.33), (3.4), and momentum theory point by point."""

import math
from itertools import product

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import make_design, solve
from rotor.aero.disk import build_disk
from rotor.aero.inflow import DiskFlow
from rotor.aero.inflow.interface import Losses
from rotor.aero.inflow.linear import MODELS
from rotor.aero.inflow.local_momentum import GAIN, LocalMomentumInflow
from rotor.aero.momentum import glauert_inflow
from rotor.aero.problem import build_problem
from rotor.engine.waves import waves_at
from rotor.support.arrays import Array

R = np.linspace(0.13, 1.0, 9)
PSI = 2.0 * np.pi * np.arange(24) / 24
LINEAR = {model.name: model for model in MODELS}
WAKES = [
    DiskFlow(0.002, 0.0, 0.055),
    DiskFlow(0.1, 0.01, 0.03),
    DiskFlow(0.3, 0.04, 0.011),
    DiskFlow(0.4, -0.01, 0.02),
]
DISK = build_disk(make_design().rotor, elements=12, azimuths=24)


FLOWS = [
    *product((1e-4, 0.006, 0.013), (0.0, 0.05, 0.2, 0.45), (-0.01, 0.0, 0.03, 0.1)),
    *product((0.0065,), (0.04, 0.06, 0.2), (-0.2, -0.15, -0.1, -0.06)),
]
"""C_T, µ_x and µ_z: level flight and climb, and fast descent."""


@pytest.mark.parametrize(("ct", "mu_x", "mu_z"), FLOWS)
def test_glauert_closes_and_slope_is_exact(ct: float, mu_x: float, mu_z: float):
    """Eq. (2.30); less thrust than nothing gives the mirror image."""
    inflow, slope = glauert_inflow(ct, mu_x, mu_z)
    assert_allclose(2.0 * inflow * math.hypot(mu_x, mu_z + inflow), ct, rtol=1e-12)
    h = 1e-6 * ct
    difference = (glauert_inflow(ct + h, mu_x, mu_z)[0] - glauert_inflow(ct - h, mu_x, mu_z)[0]) / (
        2.0 * h
    )
    assert_allclose(slope, difference, rtol=1e-6)
    assert_allclose(glauert_inflow(-ct, mu_x, -mu_z), (-inflow, slope), rtol=1e-14)


@pytest.mark.parametrize("mu_x", [0.0, 0.05, 0.2, 0.45])
@pytest.mark.parametrize("mu_z", [-0.01, 0.0, 0.03, 0.1])
def test_the_mass_flow_is_that_of_pitt_and_peters(mu_x: float, mu_z: float):
    """V D = (µ² + λ(λ + ν))/V; momentum theory's dλ0/dC_T is 1/(2 V D); D has a mirror image."""
    ct = 0.006
    inflow, slope = glauert_inflow(ct, mu_x, mu_z)
    flow = DiskFlow(mu_x, mu_z, inflow)
    through = mu_z + inflow
    published = (mu_x**2 + through * (through + inflow)) / math.hypot(mu_x, through)
    assert flow.speed * flow.mass_flow == pytest.approx(published, rel=1e-14)
    assert slope == pytest.approx(0.5 / (flow.speed * flow.mass_flow), rel=1e-12)
    assert DiskFlow(mu_x, -mu_z, -inflow).mass_flow == flow.mass_flow


def test_the_mass_flow_in_hover_at_speed_and_without_flow():
    assert DiskFlow(0.0, 0.0, 0.05).mass_flow == 2.0
    assert DiskFlow(1e-12, 0.0, 1e-12).mass_flow == pytest.approx(1.5)
    assert DiskFlow(0.35, 0.05, 0.01).mass_flow == pytest.approx(1.0, abs=5e-3)
    assert DiskFlow(0.0, 0.0, 0.0).mass_flow == 1.0


@pytest.mark.parametrize("name", LINEAR)
@pytest.mark.parametrize("wake", WAKES)
def test_the_mean_is_lambda0_and_slopes_are_exact(name: str, wake: DiskFlow):
    def field(at: Array) -> Array:
        return LINEAR[name].field(R, waves_at(3, PSI), DiskFlow(*at.tolist()))

    base = np.array([wake.mu_x, wake.mu_z, wake.lambda0])
    assert_allclose(field(base)[0].mean(axis=1), wake.lambda0, rtol=1e-13)
    for k, step in enumerate(1e-7 * np.eye(3)):
        difference = (field(base + step)[0] - field(base - step)[0]) / 2e-7
        assert_allclose(field(base)[1 + k], difference, rtol=1e-6, atol=1e-7)


def gradient(name: str, wake: DiskFlow) -> tuple[float, float]:
    """(k_x, k_y) read off the field at the disk edge over the tail, ψ = 0, and at ψ = 90°."""
    field = LINEAR[name].field(np.array([1.0]), waves_at(3, np.array([0.0, 0.5 * math.pi])), wake)[
        0
    ]
    return field[0, 0] / wake.lambda0 - 1.0, field[0, 1] / wake.lambda0 - 1.0


@pytest.mark.parametrize("wake", WAKES)
def test_published_gradients(wake: DiskFlow):
    """The published forms, written with the skew angle itself; none in hover."""
    chi = math.atan2(wake.mu_x, wake.mu_z + wake.lambda0)
    half = math.tan(chi / 2.0)
    drees = 4.0 / 3.0 * (1.0 - math.cos(chi) - 1.8 * wake.mu_x**2) / math.sin(chi)
    expected = {
        "uniform": (0.0, 0.0),
        "coleman": (half, 0.0),
        "drees": (drees, -2.0 * wake.mu_x),
        "white-blake": (math.sqrt(2.0) * math.sin(chi), 0.0),
        "pitt-peters": (15.0 * math.pi / 32.0 * half, 0.0),
        "pitt-peters-15pi/23": (15.0 * math.pi / 23.0 * half, 0.0),
    }
    assert set(expected) == set(LINEAR)
    for name, pair in expected.items():
        assert_allclose(gradient(name, wake), pair, rtol=1e-9, atol=1e-12)
        assert_allclose(gradient(name, DiskFlow(0.0, 0.0, 0.05)), 0.0, atol=1e-14)


def test_a_trim_has_the_first_harmonics_of_its_model():
    """λ_i = λ0 (1 + k_x r cos ψ + k_y r sin ψ), eq. (2.29)."""
    solution = solve(make_design(mu=0.2, inflow="drees"))
    disk, state = solution.disk, solution.controls
    wake = DiskFlow(
        0.2 * math.cos(state.shaft_tilt), 0.2 * math.sin(state.shaft_tilt), state.lambda0
    )
    for wave, strength in zip(
        (np.cos(disk.psi), np.sin(disk.psi)), gradient("drees", wake), strict=True
    ):
        assert_allclose(
            2.0 * (disk.induced * wave).mean(axis=1), state.lambda0 * strength * disk.r, atol=1e-9
        )


def local_momentum(load: Array, wake: DiskFlow) -> Array:
    """λ_i of a load, without tip loss."""
    terms = LocalMomentumInflow().on(DISK, build_problem(make_design()).course, Losses(False, True))
    followed = terms.follow(wake, wake.mu_z, sees_tilt=True)
    along = followed.atoms["lambda0 kx"][0] * np.outer(DISK.r, DISK.cos)
    return followed.live[GAIN, "gain"][0][:, None] * load[:, None] + along


def test_local_momentum_of_known_loads():
    """d = 4λ²r (2.24): the load of a uniform inflow λ, with V = λ0 = λ, answers that inflow."""
    assert_allclose(
        local_momentum(4.0 * 0.06**2 * DISK.r, DiskFlow(0.0, 0.0, 0.06)), 0.06, rtol=1e-14
    )
    # p = C_T everywhere, d = 2 r p: λ0 of eq. (2.30) and the gradient 15π/32 tan(χ/2) on it.
    ct = 0.0065
    lambda0, _ = glauert_inflow(ct, 0.2, 0.01)
    wake = DiskFlow(0.2, 0.01, lambda0)
    chi = math.atan2(wake.mu_x, wake.axial)
    expected = lambda0 * (
        1.0 + 15.0 * math.pi / 32.0 * math.tan(chi / 2.0) * np.outer(DISK.r, DISK.cos)
    )
    assert_allclose(local_momentum(2.0 * DISK.r * ct, wake), expected, rtol=1e-12)
