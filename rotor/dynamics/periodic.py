"""Eigenvalues of linear equations with periodic coefficients, by Hill's matrix.

With z = (q, q') and a lag state x where there are any, z' = A(ψ) z, A of period 2π. By Floquet's theorem
z = e^{λψ} Σ_n u_n e^{inψ}, and with A = Σ_n A_n e^{inψ}

    λ u_m = Σ_n A_{m−n} u_n − i m u_m,    |m|, |n| ≤ H

an ordinary eigenvalue problem once the series is cut (Hill, Acta Math. 8, 1886; Johnson, Helicopter Theory, §8-6). Each
exponent comes 2H + 1 times, λ + ni: each is found once, by the mode with the mean of A that its u_0 is nearest to, and
has the frequency nearest to that of this mode. With constant coefficients H = 0 is exact.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eig, eigvals

from rotor.support.arrays import Array, Integers
from rotor.support.blas_threads import one_blas_thread

Complexes = NDArray[np.complex128]
_COPY = 0.006
"""Within which two exponents are taken for copies of one: those far from n = 0 suffer from the cut."""


def first_order(mass: Array, damping: Array, stiffness: Array) -> Array:
    """A of M q'' + C q' + K q = 0, (azimuths, 2n, 2n) from (azimuths, n, n) each."""
    n = mass.shape[-1]
    out = np.zeros((len(stiffness), 2 * n, 2 * n))
    out[:, :n, n:] = np.eye(n)
    out[:, n:, :n] = -np.linalg.solve(mass, stiffness)
    out[:, n:, n:] = -np.linalg.solve(mass, damping)
    return out


@dataclass(frozen=True, eq=False)
class Exponents:
    """Exponents of a periodic system and how it then moves."""

    values: Complexes
    """λ per radian of ψ: real part growth, imaginary part frequency over Ω, (states,)."""
    motion: Complexes
    """Modes with the mean of A, to one of which each belongs, (states, exponents)."""


def exponents(system: Array, harmonics: int = 0) -> Exponents:
    """The exponents of z' = A(ψ) z; system: A at evenly spaced azimuths, (azimuths, states, states)."""
    n, count = system.shape[1], 2 * harmonics + 1
    with one_blas_thread():
        mean, right = _eigen(system.mean(axis=0))
        if not harmonics:
            return Exponents(mean, right)
        series, highest = np.fft.fft(system, axis=0) / len(system), (len(system) - 1) // 2
        order = np.arange(-harmonics, harmonics + 1)
        apart = order[:, None] - order
        blocks = np.where(np.abs(apart)[:, :, None, None] <= highest, series[apart % len(system)], 0.0)
        matrix = blocks.transpose(0, 2, 1, 3).reshape(count * n, count * n)
        matrix[np.diag_indices(count * n)] -= 1j * np.repeat(order, n)
        values, vectors = _eigen(matrix)
        steady = vectors.reshape(count, n, -1)[harmonics]
        shares: Array = np.abs(np.linalg.solve(right, steady))  # Of one unit of motion, harmonics and all.
    chosen: Complexes = values[_one_of_each(values, shares)]
    return Exponents(chosen + 1j * np.round(mean.imag - chosen.imag), right)


def _one_of_each(values: Complexes, near: Array) -> Integers:
    """For each mode with the mean of A the exponent nearest to it, the nearest pairs first, and none's copy, (modes,).

    near: of modes and exponents, (modes, exponents).
    """
    chosen = np.full(len(near), -1)
    for place in np.argsort(-near, axis=None, kind="stable").tolist():
        mode, k = divmod(place, near.shape[1])
        if chosen[mode] >= 0:
            continue
        taken = chosen[chosen >= 0]
        apart = values[k] - values[taken]
        turns = np.round(apart.imag)
        if not np.any((taken == k) | ((turns != 0.0) & (np.abs(apart - 1j * turns) < _COPY))):
            chosen[mode] = k
            if np.all(chosen >= 0):
                break
    return chosen


def _eigen(matrix: Array | Complexes) -> tuple[Complexes, Complexes]:
    """Eigenvalues and right eigenvectors."""
    values, vectors = eig(matrix)
    return np.asarray(values, dtype=np.complex128), np.asarray(vectors, dtype=np.complex128)


def growth(system: Array, harmonics: int = 0) -> float:
    """The largest real part of an exponent: positive where the system is unstable [per radian]."""
    with one_blas_thread():
        if not harmonics:
            return float(np.max(eigvals(system.mean(axis=0)).real))
    return float(exponents(system, harmonics).values.real.max())
