"""Waves around the azimuth against their values on a grid."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.engine.waves import (
    COS,
    SIN,
    STEADY,
    harmonic_of,
    products,
    rate_of,
    times_wave,
    wave_grid,
    wave_number,
)

GRID = wave_grid(25, 60)
WAVES = range(13)


def test_order_and_values():
    psi = GRID.psi
    expected = [np.ones_like(psi), np.cos(psi), np.sin(psi), np.cos(2.0 * psi), np.sin(2.0 * psi)]
    assert_allclose(GRID.at[:5], expected, atol=1e-15)
    assert (0, wave_number(1, sine=False), wave_number(1, sine=True)) == (STEADY, COS, SIN)
    for wave in range(1, 25):
        assert wave_number(harmonic_of(wave), sine=wave % 2 == 0) == wave
    assert wave_number(0, sine=False) == harmonic_of(STEADY) == 0


@pytest.mark.parametrize("p", WAVES)
@pytest.mark.parametrize("s", WAVES)
def test_product_of_two_waves(p: int, s: int):
    found = sum((share * GRID.at[wave] for wave, share in times_wave(p, s)), np.zeros(60))
    assert_allclose(found, GRID.at[p] * GRID.at[s], atol=1e-14)
    number, factor = products(len(WAVES))
    both = (factor[:, p, s, None] * GRID.at[number[:, p, s]]).sum(axis=0)
    assert_allclose(both, found, atol=1e-15)


@pytest.mark.parametrize("wave", WAVES)
def test_rate(wave: int):
    """The derivative by ψ, by a Fourier transform."""
    other, factor = rate_of(wave)
    slope = np.fft.irfft(1j * np.arange(31) * np.fft.rfft(GRID.at[wave]), 60)
    assert_allclose(factor * GRID.at[other], slope, atol=1e-12)


def test_means():
    """1, ½, ½ … with each other; those of products hold two waves times a field."""
    assert_allclose(GRID.at @ GRID.mean, np.diag([1.0] + 24 * [0.5]), atol=1e-15)
    field = np.random.default_rng(2).standard_normal(60)
    moments = GRID.mean_of_products @ field
    number, factor = products(25)
    expected = (GRID.at * field / 60.0) @ GRID.at.T
    assert_allclose((factor * moments[number]).sum(axis=0), expected, atol=1e-15)
