"""Waves around the azimuth, numbered 1, cos ψ, sin ψ, cos 2ψ, …: products of two, rates, and their values on a grid."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from rotor.support.arrays import Array, Integers, fixed_property, read_only

STEADY, COS, SIN = range(3)
"""The first three waves."""


def wave_number(harmonic: int, *, sine: bool) -> int:
    """The number of cos hψ or sin hψ; 0 for harmonic 0."""
    return 2 * harmonic - 1 + sine if harmonic else 0


def harmonic_of(wave: int) -> int:
    """h of a wave."""
    return (wave + 1) // 2


def rate_of(wave: int) -> tuple[int, float]:
    """The derivative of a wave by ψ: another wave, and its factor."""
    h = harmonic_of(wave)
    return (0, 0.0) if wave == 0 else (wave + 1, -float(h)) if wave % 2 else (wave - 1, float(h))


def times_wave(p: int, s: int) -> list[tuple[int, float]]:
    """w_p w_s as a sum of at most two waves with their factors."""
    a, b, sine_a, sine_b = (
        harmonic_of(p),
        harmonic_of(s),
        p > 0 and p % 2 == 0,
        s > 0 and s % 2 == 0,
    )
    if sine_a != sine_b:  # sin A cos B = ½ sin(A + B) + ½ sin(A − B)
        a, b = (a, b) if sine_a else (b, a)
        parts = [(a + b, True, 0.5), (abs(a - b), True, 0.5 if a > b else -0.5)]
    else:  # cos A cos B and sin A sin B = ½ cos(A − B) ± ½ cos(A + B)
        parts = [(abs(a - b), False, 0.5), (a + b, False, -0.5 if sine_a else 0.5)]
    return [(wave_number(h, sine=sine), factor) for h, sine, factor in parts if h or not sine]


@lru_cache(maxsize=16)
@read_only
def products(waves: int) -> tuple[Integers, Array]:
    """Numbers and factors of `times_wave` for all pairs of waves, (2, waves, waves) both."""
    number, factor = np.zeros((2, waves, waves), dtype=np.int64), np.zeros((2, waves, waves))
    for p in range(waves):
        for s in range(waves):
            for side, (wave, share) in enumerate(times_wave(p, s)):
                number[side, p, s], factor[side, p, s] = wave, share
    return number, factor


def waves_at(count: int, psi: Array) -> Array:
    """The first waves at azimuths [rad], (count, azimuths); count is odd."""
    phase = np.outer(np.arange(1, (count + 1) // 2), psi)
    pairs = np.stack([np.cos(phase), np.sin(phase)], axis=1).reshape(-1, len(psi))
    return np.concatenate([np.ones((1, len(psi))), pairs])


@dataclass(frozen=True)
class WaveGrid:
    """The waves on evenly spaced azimuths."""

    waves: int
    azimuths: int

    @fixed_property
    def psi(self) -> Array:
        """[rad], (azimuths,)"""
        return 2.0 * np.pi * np.arange(self.azimuths) / self.azimuths

    @fixed_property
    def at(self) -> Array:
        """(waves, azimuths)"""
        return waves_at(self.waves, self.psi)

    @fixed_property
    def mean(self) -> Array:
        """By which a function of azimuth becomes its means with the waves, (azimuths, waves)."""
        return np.ascontiguousarray(self.at.T / self.azimuths)

    @fixed_property
    def mean_of_products(self) -> Array:
        """Means with all waves in products of two, one in a row, (2 waves − 1, azimuths)."""
        return waves_at(2 * self.waves - 1, self.psi) / self.azimuths


@lru_cache(maxsize=64)
def wave_grid(waves: int, azimuths: int) -> WaveGrid:
    """The grid of so many waves and azimuths, made once."""
    return WaveGrid(waves, azimuths)
