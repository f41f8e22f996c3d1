"""The Peters–He dynamic wake: shape functions, inflow influence [L], apparent mass [M] and flow parameters [V].

The shapes are radial functions φ_n^m(r) times cos mψ and sin mψ. φ_n^m is the normalised Legendre function
P̄_n^m(ν)/ν on the disk, ν = √(1 − r²), n − m odd, so that ν φ_n^m of one m are orthonormal on 0 ≤ ν ≤ 1.
With states α (cosines) and β (sines) and loads τ, λ_i = Σ φ_j^r (α_j^r cos rψ + β_j^r sin rψ) and

    [M] α' + [V] [Lc]⁻¹ α = ½ τc,      the same with Ls, β, τs;      ' = d/dψ.

Sources: Peters, Boyd & He, J. AHS 34(4), 1989; Peters & He, J. Aircraft 32(2), 1995. Written from memory and checked
against tables, closed forms of the actuator disk and identities (see the tests).
The skew χ is that of |µ_z + λ0|: in upflow the wake above the disk is the mirror image of one below, and induces the
same. The mass flow keeps the sign of the flow.
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import eval_jacobi

from rotor.aero.inflow.interface import Wake
from rotor.arrays import Array
from rotor.compiled import compiled

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
    """φ_n^m at r = y/R, shape of r; positive near the centre.

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


def gain(r: int, j: int, m: int, n: int) -> float:
    """Γ_jn^rm, the influence of pressure mode (m, n) on inflow mode (r, j) before the skew of the wake."""
    h = math.sqrt(norm(m, n) * norm(r, j))
    width = math.sqrt((2 * n + 1) * (2 * j + 1))
    if (r + m) % 2 == 0:
        sign = -1.0 if ((n + j - 2 * r) // 2) % 2 else 1.0
        return sign * 2.0 * width / (h * (n + j) * (n + j + 2) * ((n - j) ** 2 - 1))
    if abs(n - j) == 1:
        return math.copysign(math.pi / (2.0 * h * width), r - m)
    return 0.0


@dataclass(frozen=True, eq=False)
class Family:
    """The cosine or the sine modes of an order. Matrices are (inflow modes, pressure modes)."""

    modes: tuple[Mode, ...]
    gain: Array
    """Γ"""
    direct: NDArray[np.int64]
    """|m − r|, power of X."""
    mirrored: NDArray[np.int64]
    """m + r, power of X."""
    mirror_sign: Array
    """±(−1)^min(r, m); 0 in row r = 0, which has one term only."""
    mass: Array
    """Diagonal of [M] = 2H/π."""
    uniform: Array
    """1 at the mode (0, 1), whose flow parameter is V_T, else 0."""

    def influence(self, half_skew: float) -> tuple[Array, Array]:
        """[L] at X = tan(χ/2), and its exact derivative by X.

        L^0m = X^m Γ;  L^rm = [X^|m−r| ± (−1)^min(r,m) X^(m+r)] Γ for r ≥ 1, + for cosines, − for sines.
        """
        both = _influence(self.gain, self.direct, self.mirrored, self.mirror_sign, half_skew)
        return both[0], both[1]


@compiled()
def _influence(gain: Any, direct: Any, mirrored: Any, mirror_sign: Any, half_skew: float) -> Any:
    """`Family.influence`: [L] and its derivative, (2, modes, modes)."""
    modes = len(gain)
    highest = 0
    for i in range(modes):
        highest = max(highest, mirrored[i, i])
    powers, slopes = np.ones(highest + 1), np.zeros(highest + 1)
    for k in range(1, highest + 1):
        powers[k] = half_skew * powers[k - 1]
        slopes[k] = k * powers[k - 1]
    out = np.empty((2, modes, modes))
    for i in range(modes):
        for j in range(modes):
            near, far, sign = direct[i, j], mirrored[i, j], mirror_sign[i, j]
            out[0, i, j] = gain[i, j] * (powers[near] + sign * powers[far])
            out[1, i, j] = gain[i, j] * (slopes[near] + sign * slopes[far])
    return out


@lru_cache(maxsize=16)
def families(order: int) -> tuple[Family, Family]:
    """Cosines and sines with n − 1 ≤ order."""
    return _family(mode_set(order), 1.0), _family(mode_set(order, 1), -1.0)


def _family(modes: tuple[Mode, ...], sign: float) -> Family:
    m = np.array([mode[0] for mode in modes], dtype=np.int64)
    row, column = m[:, None], m[None, :]
    parity = np.where(np.minimum(row, column) % 2 == 0, 1.0, -1.0)
    return Family(
        modes=modes,
        gain=np.array([[gain(r, j, *pressure) for pressure in modes] for r, j in modes]),
        direct=np.abs(row - column),
        mirrored=row + column,
        mirror_sign=np.where(row == 0, 0.0, sign * parity),
        mass=np.array([2.0 * norm(*mode) / math.pi for mode in modes]),
        uniform=np.array([1.0 if mode == (0, 1) else 0.0 for mode in modes]),
    )


@dataclass(frozen=True, eq=False)
class FlowParameters:
    """The parameters of the matrices, with slopes by (µ_x, µ_z, λ0), each (3,)."""

    half_skew: float
    """X = tan(χ/2) = µ_x/(V_T + |µ_z + λ0|), regular from hover to edgewise flight and on to upflow."""
    speed: float
    """V_T = √(µ_x² + (µ_z + λ0)²): the flow parameter of the mode (0, 1)."""
    mass_flow: float
    """V̄ = [µ_x² + (µ_z + 2λ0)(µ_z + λ0)]/V_T: that of every other mode; 2λ0 in hover."""
    slopes: Array
    """(3, 3): rows X, V_T, V̄; columns µ_x, µ_z, λ0."""


def flow_parameters(wake: Wake) -> FlowParameters:
    """X, V_T, V̄ of a wake and their exact slopes."""
    mu, axial, speed = wake.mu_x, wake.axial, wake.speed
    total = speed + abs(axial)
    mixed = mu**2 + (axial + wake.lambda0) * axial
    mass_flow = mixed / speed
    x_mu, x_axial = abs(axial) / (speed * total), -math.copysign(mu / (speed * total), axial)
    v_mu, v_axial = mu / speed, axial / speed
    m_mu = 2.0 * mu / speed - mass_flow * v_mu / speed
    m_axial = (2.0 * axial + wake.lambda0) / speed - mass_flow * v_axial / speed
    slopes = np.array([[x_mu, x_axial, x_axial], [v_mu, v_axial, v_axial], [m_mu, m_axial, m_axial + axial / speed]])
    return FlowParameters(mu / total, speed, mass_flow, slopes)
