"""The linear inflow family, eqs. (2.29)–(2.33), (3.4)."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.aero.inflow import Wake, inflow_model
from rotor.aero.inflow.linear import LINEAR_MODELS, LinearInflow
from rotor.files.make_design import make_design
from rotor.trim.solve import solve

R = np.linspace(0.13, 1.0, 9)
PSI = 2.0 * np.pi * np.arange(24) / 24
COS, SIN = np.cos(PSI), np.sin(PSI)
LINEAR = {model.name: model for model in LINEAR_MODELS}
WAKES = [Wake(0.002, 0.0, 0.055), Wake(0.1, 0.01, 0.03), Wake(0.3, 0.04, 0.011), Wake(0.4, -0.01, 0.02)]


@pytest.mark.parametrize("name", LINEAR)
@pytest.mark.parametrize("wake", WAKES)
def test_mean_is_lambda0(name: str, wake: Wake):
    field = LINEAR[name].field(R, COS, SIN, wake)[0]
    assert_allclose(field.mean(axis=1), wake.lambda0, rtol=1e-13)


@pytest.mark.parametrize("name", LINEAR)
@pytest.mark.parametrize("wake", WAKES)
def test_slopes_are_exact(name: str, wake: Wake):
    model = LINEAR[name]
    slopes = model.field(R, COS, SIN, wake)[1:]
    base = (wake.mu_x, wake.mu_z, wake.lambda0)
    h = 1e-7
    for k in range(3):
        ahead = [v + h * (i == k) for i, v in enumerate(base)]
        behind = [v - h * (i == k) for i, v in enumerate(base)]
        ahead, behind = (model.field(R, COS, SIN, Wake(*there))[0] for there in (ahead, behind))
        difference = (ahead - behind) / (2 * h)
        assert_allclose(slopes[k], difference, rtol=1e-6, atol=1e-7)


def gradient(name: str, wake: Wake) -> tuple[float, float]:
    """(k_x, k_y) read off the field at the disk edge."""
    field = LINEAR[name].field(np.array([1.0]), np.array([1.0, 0.0]), np.array([0.0, 1.0]), wake)[0]
    return field[0, 0] / wake.lambda0 - 1.0, field[0, 1] / wake.lambda0 - 1.0


@pytest.mark.parametrize("wake", WAKES)
def test_published_gradients(wake: Wake):
    """The published forms, written with the skew angle itself."""
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


def test_the_two_gains_by_hand():
    """Edgewise limit χ → 90°: tan 45° = 1, so k_x is the gain itself: 1.4726 (theory) and 2.0489 (as printed)."""
    edgewise = Wake(0.3, 0.0, 1e-12)
    assert_allclose(gradient("pitt-peters", edgewise)[0], 1.4726, atol=5e-4)
    assert_allclose(gradient("pitt-peters-15pi/23", edgewise)[0], 2.0489, atol=5e-4)


@pytest.mark.parametrize("name", LINEAR)
def test_hover_has_no_gradient(name: str):
    assert_allclose(gradient(name, Wake(0.0, 0.0, 0.05)), (0.0, 0.0), atol=1e-14)


def test_upwash_at_the_front_downwash_at_the_back():
    """ψ = 0 is over the tail: more inflow there, less over the nose."""
    model: LinearInflow = LINEAR["pitt-peters"]
    field = model.field(np.array([0.9]), np.array([1.0, -1.0]), np.array([0.0, 0.0]), Wake(0.3, 0.03, 0.012))[0]
    assert field[0, 0] > 0.012 > field[0, 1]


def test_unknown_model_is_one_sentence():
    with pytest.raises(ValueError, match=r"'drela' is not known: use one of uniform, coleman"):
        inflow_model("drela")


def test_a_trim_has_the_first_harmonics_of_its_model():
    """λ_i = λ0 (1 + k_x r cos ψ + k_y r sin ψ), eq. (2.29); Drees: k_x = 4/3 (1 − cos χ − 1.8 µ²)/sin χ, k_y = −2µ."""
    solution = solve(make_design(mu=0.2, inflow="drees"))
    disk, state = solution.disk, solution.controls
    mu_x, mu_z = 0.2 * math.cos(state.shaft_tilt), 0.2 * math.sin(state.shaft_tilt)
    skew = math.atan2(mu_x, mu_z + state.lambda0)
    k_x = 4.0 / 3.0 * (1.0 - math.cos(skew) - 1.8 * mu_x**2) / math.sin(skew)
    for wave, strength in ((np.cos(disk.psi), k_x), (np.sin(disk.psi), -2.0 * mu_x)):
        assert_allclose(2.0 * (disk.induced * wave).mean(axis=1), state.lambda0 * strength * disk.r, atol=1e-9)
