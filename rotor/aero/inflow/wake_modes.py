"""The shapes of the Peters–He generalised dynamic wake: radial functions φ_n^m(r) times cos mψ and sin mψ.

φ_n^m is the normalised Legendre function P̄_n^m(ν)/ν on the disk, ν = √(1 − r²), n − m odd, so that ν φ_n^m of one m are
orthonormal on 0 ≤ ν ≤ 1. Peters, Boyd & He, J. AHS 34(4), 1989; recalled, checked as the tests say.
"""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import eval_jacobi

from rotor.arrays import Array

Mode = tuple[int, int]
"""Harmonic m and degree n = m + 1, m + 3, …"""


def double_factorial(n: int) -> int:
    """n!! with (−1)!! = 0!! = 1."""
    return math.prod(range(n, 1, -2))


def norm(m: int, n: int) -> float:
    """H_n^m = (n + m − 1)!! (n − m − 1)!! / [(n + m)!! (n − m)!!]."""
    above = double_factorial(n + m - 1) * double_factorial(n - m - 1)
    return above / (double_factorial(n + m) * double_factorial(n - m))


@lru_cache(maxsize=32)
def mode_set(order: int, first: int = 0) -> tuple[Mode, ...]:
    """All modes with first ≤ m and n − 1 ≤ order (the triangular set), ordered by m, then n.

    `first` 0 for the cosines, 1 for the sines: order 8 has 25 and 20.
    """
    return tuple((m, n) for m in range(first, order + 1) for n in range(m + 1, order + 2, 2))


def radial_function(m: int, n: int, r: ArrayLike) -> Array:
    """φ_n^m at r = y/R, shape of r; positive where it leaves the centre.

    The published power series Σ_q r^q (−1)^((q−m)/2) … cancels for large n; this is the same polynomial,
    r^m times a Jacobi polynomial P_k^(m, ½)(1 − 2r²) with k = (n − m − 1)/2, evaluated by its recurrence.
    """
    assert n > m >= 0
    assert (n - m) % 2 == 1
    r = np.asarray(r, dtype=float)
    k = (n - m - 1) // 2
    # The series' term q = m, over P_k^(m, ½)(1) = C(k + m, k).
    centre = double_factorial(n + m) / (double_factorial(2 * m) * double_factorial(n - m - 1))
    scale = math.sqrt((2 * n + 1) * norm(m, n)) * centre / math.comb(k + m, k)
    return scale * r**m * np.asarray(eval_jacobi(k, m, 0.5, 1.0 - 2.0 * r**2), dtype=float)


def radial_functions(modes: tuple[Mode, ...], r: ArrayLike) -> Array:
    """φ of several modes, (modes, radii)."""
    return np.stack([radial_function(m, n, r) for m, n in modes])
