"""Matrices of the Peters–He dynamic wake: inflow influence [L], apparent mass [M] and flow parameters [V].

With states α (cosines) and β (sines) and loads τ, λ_i = Σ φ_j^r (α_j^r cos rψ + β_j^r sin rψ) and

    [M] α' + [V] [Lc]⁻¹ α = ½ τc,      the same with Ls, β, τs;      ' = d/dψ.

Peters & He, J. Aircraft 32(2), 1995; recalled, and checked by tables, closed forms of the actuator disk and identities.
The wake leaves downwards: valid for µ_z + λ0 > 0, so 0 ≤ χ < 90°.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rotor.aero.inflow.wake_modes import Mode, mode_set, norm
from rotor.aero.inflow.wake_state import Wake
from rotor.arrays import Array


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
        powers = half_skew ** np.arange(int(self.mirrored.max()) + 1)
        slopes = np.arange(len(powers)) * np.concatenate(([0.0], powers[:-1]))
        value = powers[self.direct] + self.mirror_sign * powers[self.mirrored]
        slope = slopes[self.direct] + self.mirror_sign * slopes[self.mirrored]
        return self.gain * value, self.gain * slope


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
    """What the matrices depend on, with slopes by (µ_x, µ_z, λ0), each (3,)."""

    half_skew: float
    """X = tan(χ/2) = µ_x/(V_T + µ_z + λ0), regular from hover to edgewise flight."""
    speed: float
    """V_T = √(µ_x² + (µ_z + λ0)²): the flow parameter of the mode (0, 1)."""
    mass_flow: float
    """V̄ = [µ_x² + (µ_z + 2λ0)(µ_z + λ0)]/V_T: that of every other mode; 2λ0 in hover."""
    slopes: Array
    """(3, 3): rows X, V_T, V̄; columns µ_x, µ_z, λ0."""


def flow_parameters(wake: Wake) -> FlowParameters:
    """X, V_T, V̄ of a wake and their exact slopes."""
    mu, axial, speed = wake.mu_x, wake.axial, wake.speed
    total = speed + axial
    mixed = mu**2 + (axial + wake.lambda0) * axial
    mass_flow = mixed / speed
    x_mu, x_axial = axial / (speed * total), -mu / (speed * total)
    v_mu, v_axial = mu / speed, axial / speed
    m_mu = 2.0 * mu / speed - mass_flow * v_mu / speed
    m_axial = (2.0 * axial + wake.lambda0) / speed - mass_flow * v_axial / speed
    slopes = np.array([[x_mu, x_axial, x_axial], [v_mu, v_axial, v_axial], [m_mu, m_axial, m_axial + axial / speed]])
    return FlowParameters(mu / total, speed, mass_flow, slopes)
