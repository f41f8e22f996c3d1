"""Exponents of periodic equations: against Floquet's theorem by integration, a published flutter boundary, Mathieu."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from rotor.dynamics.periodic import exponents, first_order, growth
from rotor.support.arrays import Array

PSI = 2.0 * math.pi * np.arange(64) / 64


def flapping(gamma: float, mu: float, psi: Array) -> tuple[Array, Array]:
    """Damping and stiffness of a rigid blade that flaps, e = 0, no reverse flow (Johnson, Helicopter Theory, ch. 5)."""
    damping = gamma / 8.0 * (1.0 + 4.0 / 3.0 * mu * np.sin(psi))
    return damping, 1.0 + gamma / 8.0 * (4.0 / 3.0 * mu * np.cos(psi) + mu**2 * np.sin(2.0 * psi))


def floquet(gamma: float, mu: float) -> Array:
    """Logarithms of the multipliers over 2π, from one turn of the equation."""

    def rate(psi: float, z: Array) -> Array:
        damping, stiffness = flapping(gamma, mu, np.array(psi))
        return np.array([*z[2:], *(-damping * z[2:] - stiffness * z[:2])])

    turn = solve_ivp(rate, (0.0, 2.0 * math.pi), [1.0, 0.0, 0.0, 1.0], rtol=1e-11, atol=1e-12).y[:, -1]
    return np.log(np.linalg.eigvals(turn.reshape(2, 2)).astype(complex)) / (2.0 * math.pi)


@pytest.mark.parametrize(("gamma", "mu"), [(8.0, 0.2), (8.0, 0.5), (12.0, 0.4), (5.0, 0.8)])
def test_flapping_in_forward_flight_is_that_of_floquet(gamma: float, mu: float):
    """Also where the frequency is locked to 1/2 or 1/rev and the exponents no longer come in pairs."""
    damping, stiffness = (own[:, None, None] for own in flapping(gamma, mu, PSI))
    found = exponents(first_order(np.ones((len(PSI), 1, 1)), damping, stiffness), 10).values
    expected = floquet(gamma, mu)
    assert_allclose(np.sort(found.real), np.sort(expected.real), atol=1e-6)
    multipliers = np.exp(2.0 * math.pi * found)
    for multiplier in np.exp(2.0 * math.pi * expected):
        assert np.abs(multipliers - multiplier).min() < 1e-5


def test_the_series_converges():
    damping, stiffness = (own[:, None, None] for own in flapping(8.0, 0.5, PSI))
    system = first_order(np.ones((len(PSI), 1, 1)), damping, stiffness)
    exact = np.sort(floquet(8.0, 0.5).real)
    errors = [float(np.abs(np.sort(exponents(system, h).values.real) - exact).max()) for h in (1, 3, 6)]
    assert errors[2] < 1e-4
    assert errors[2] < 0.1 * errors[1] + 1e-9 < 0.1 * errors[0]


def test_mathieus_equation_is_unstable_at_half_its_parameters_frequency():
    """q'' + (¼ + ε cos ψ) q = 0 grows by ε/2 to first order; with ¼ + ε/2 < δ it does not (McLachlan, 1947)."""
    ones = np.ones((len(PSI), 1, 1))

    def rate(delta: float, epsilon: float) -> float:
        return growth(first_order(ones, 0.0 * ones, (delta + epsilon * np.cos(PSI))[:, None, None]), 8)

    assert rate(0.25, 0.05) == pytest.approx(0.5 * 0.05, rel=0.02)
    assert rate(0.30, 0.05) == pytest.approx(0.0, abs=1e-8)


def test_flutter_of_the_typical_section_of_hodges_and_pierce():
    """Introduction to Structural Dynamics and Aeroelasticity, 2011, §5.2: steady flow, a −1/5, e −1/10, µ 20, r² 6/25,
    σ 2/5: flutter at U = 1.843 b ω_θ with 0.5568 ω_θ; divergence at r √(µ/(1 + 2a)) = 2.828."""
    a, e, mu, square, sigma = -0.2, -0.1, 20.0, 0.24, 0.4

    def section(speed: float) -> Array:
        mass = np.array([[1.0, e - a], [e - a, square]])
        air = 2.0 * speed**2 / mu * np.array([[0.0, 1.0], [0.0, -(0.5 + a)]])
        return first_order(mass[None], np.zeros((1, 2, 2)), (np.diag([sigma**2, square]) + air)[None])

    flutter = brentq(lambda speed: growth(section(speed)) - 1e-4, 1.0, 2.5)
    assert flutter == pytest.approx(1.843, abs=0.002)
    frequencies = np.abs(exponents(section(flutter)).values.imag)
    assert_allclose(frequencies, 0.5568, atol=0.003)
    assert abs(np.linalg.det(section(math.sqrt(square * mu / (1.0 + 2.0 * a)))[0])) < 1e-12


def test_with_constant_coefficients_it_is_exact():
    """λ² + 2ζνλ + ν² = 0, at any number of harmonics."""
    one = np.ones((16, 1, 1))
    for harmonics in (0, 3):
        found = exponents(first_order(one, 0.6 * one, 4.0 * one), harmonics).values
        assert_allclose(np.sort_complex(found), [-0.3 - 1j * math.sqrt(3.91), -0.3 + 1j * math.sqrt(3.91)], atol=1e-9)
