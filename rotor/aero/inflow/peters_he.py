"""The Peters–He dynamic wake: shape functions, inflow influence [L], apparent mass [M], flow parameters [V], response.

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
from functools import cache, cached_property, lru_cache
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


@dataclass(frozen=True, eq=False)
class FamilyResponse:
    """T of the cosines or of the sines. States of a family are (rotor harmonics 1 + 2k, modes).

    a = ½ L (V + iqM L)⁻¹ τ for the amplitudes a = x_c − i x_s of a load τ = p_c − i p_s with cos qψ and sin qψ. [L]⁻¹,
    singular for edgewise flight, is never formed.
    """

    influence: Array
    """L"""
    influence_slope: Array
    """∂L/∂X"""
    flow: Array
    """Diagonal of V."""
    uniform: Array
    mass: Array
    """Diagonal of M."""
    harmonics: Array
    """q"""

    @classmethod
    def solve(cls, family: Family, flow: FlowParameters, harmonics: tuple[int, ...]) -> "FamilyResponse":
        """At these parameters of the flow."""
        influence, slope = family.influence(flow.half_skew)
        diagonal = flow.mass_flow + (flow.speed - flow.mass_flow) * family.uniform
        return cls(influence, slope, diagonal, family.uniform, family.mass, _numbers(harmonics))

    def respond(self, p: Array) -> Array:
        """T p of one load, (states of the family,)."""
        loads = p.reshape(1 + 2 * len(self.harmonics), -1)
        return _respond(self.influence, self.flow, self.mass, self.harmonics, loads).ravel()

    @cached_property
    def blocks(self) -> Array:
        """½ L (V + iqM L)⁻¹ for q = 0 and every harmonic, complex, (1 + k, modes, modes)."""
        return _blocks(self.influence, self.flow, self.mass, self.harmonics)

    def slopes(self, p: Array) -> Array:
        """∂(T p) by X, V_T and V̄, (3, states of the family)."""
        loads = p.reshape(1 + 2 * len(self.harmonics), -1)
        out = _slopes(
            self.blocks, self.influence_slope, self.flow, self.uniform, self.mass, self.harmonics, loads
        )  # fmt: skip
        return out.reshape(3, -1)


@cache
def _numbers(harmonics: tuple[int, ...]) -> Array:
    return np.array(harmonics, dtype=np.float64)


_compile = compiled(error_model="numpy", fastmath={"contract"})


@_compile
def _respond(influence: Any, flow: Any, mass: Any, harmonics: Any, loads: Any) -> Any:
    """T p, steady, then cosine and sine of every q: a = ½ L (V + iqM L)⁻¹ τ with a = x_c − i x_s, τ = p_c − i p_s.

    As in `_blocks`, a = ½ L (z − iq B z) with (I + q²B²) z = V⁻¹ τ, so only real equations are solved.
    """
    out = np.empty_like(loads)
    modes = len(flow)
    out[0] = 0.5 * _times(influence, loads[0] / flow)
    scaled = _scaled(influence, flow, mass)
    square = scaled @ scaled
    system = np.empty((modes, modes + 2))
    for k in range(len(harmonics)):
        q, cosine, sine = harmonics[k], 1 + 2 * k, 2 + 2 * k
        for i in range(modes):
            for j in range(modes):
                system[i, j] = q * q * square[i, j]
            system[i, i] += 1.0
            system[i, modes], system[i, modes + 1] = loads[cosine, i] / flow[i], loads[sine, i] / flow[i]
        _eliminate(system)
        real, imaginary = system[:, modes].copy(), system[:, modes + 1].copy()  # z is real − i imaginary.
        out[cosine] = 0.5 * _times(influence, real - q * _times(scaled, imaginary))
        out[sine] = 0.5 * _times(influence, imaginary + q * _times(scaled, real))
    return out


@_compile
def _scaled(influence: Any, flow: Any, mass: Any) -> Any:
    """B = V⁻¹M L."""
    out = np.empty_like(influence)
    for i in range(len(flow)):
        for j in range(len(flow)):
            out[i, j] = mass[i] / flow[i] * influence[i, j]
    return out


@_compile
def _bring_pivot(a: Any, k: int) -> int:
    """Exchange row k for that row from k on with the largest number in column k; its place."""
    best = k
    for i in range(k + 1, len(a)):
        if abs(a[i, k]) > abs(a[best, k]):
            best = i
    if best != k:
        for j in range(a.shape[1]):
            a[k, j], a[best, j] = a[best, j], a[k, j]
    return best


@_compile
def _eliminate(system: Any) -> None:
    """Solve equations with their right sides beside them, (n, n + columns), in place: Gaussian elimination.

    LAPACK takes twice as long for few right sides of 25 unknowns.
    """
    n = len(system)
    for k in range(n):
        _bring_pivot(system, k)
        pivot = 1.0 / system[k, k]
        for i in range(k + 1, n):
            factor = system[i, k] * pivot
            for j in range(k + 1, system.shape[1]):
                system[i, j] -= factor * system[k, j]
    for k in range(n - 1, -1, -1):
        for j in range(n, system.shape[1]):
            total = system[k, j]
            for i in range(k + 1, n):
                total -= system[k, i] * system[i, j]
            system[k, j] = total / system[k, k]


@_compile
def _blocks(influence: Any, flow: Any, mass: Any, harmonics: Any) -> Any:
    """`FamilyResponse.blocks`: ½ (L − iq L B)(I + q²B²)⁻¹V⁻¹ with B = V⁻¹M L, without complex arithmetic."""
    modes, scaled = len(flow), _scaled(influence, flow, mass)
    out = np.empty((1 + len(harmonics), modes, modes), np.complex128)
    for i in range(modes):
        for j in range(modes):
            out[0, i, j] = 0.5 * influence[i, j] / flow[j]
    square, turned = scaled @ scaled, influence @ scaled
    for k in range(len(harmonics)):
        q = harmonics[k]
        inverse = _inverse_beside_one(q * q * square)
        real, imaginary = influence @ inverse, turned @ inverse
        for i in range(modes):
            for j in range(modes):
                out[1 + k, i, j] = complex(0.5 * real[i, j] / flow[j], -0.5 * q * imaginary[i, j] / flow[j])
    return out


@_compile
def _inverse_beside_one(matrix: Any) -> Any:
    """(I + A)⁻¹ by Gauss and Jordan's elimination in place."""
    n = len(matrix)
    a, place = matrix.copy(), np.arange(n)
    for k in range(n):
        a[k, k] += 1.0
    for k in range(n):
        best = _bring_pivot(a, k)
        place[k], place[best] = place[best], place[k]
        pivot = 1.0 / a[k, k]
        a[k, k] = 1.0
        for j in range(n):
            a[k, j] *= pivot
        for i in range(n):
            if i != k:
                factor = a[i, k]
                a[i, k] = 0.0
                for j in range(n):
                    a[i, j] -= factor * a[k, j]
    out = np.empty((n, n))
    for k in range(n):
        for i in range(n):
            out[i, place[k]] = a[i, k]
    return out


@_compile
def _slopes(
    blocks: Any, influence_slope: Any, flow: Any, uniform: Any, mass: Any, harmonics: Any, loads: Any
) -> Any:  # fmt: skip
    """∂(T p) by X, V_T and V̄, (3, 1 + 2k, modes).

    With a = H τ = L y and (V + iqM L) y = ½ τ:  da = dL y − 2H (dV y + iqM dL y).
    """
    modes = len(flow)
    out = np.empty((3, *loads.shape))
    load, pushed = np.zeros(modes, np.complex128), np.empty((3, modes), np.complex128)
    driven, turned = np.empty(modes, np.complex128), np.zeros(modes, np.complex128)
    for k in range(len(blocks)):
        q = harmonics[k - 1] if k else 0.0
        cosine, sine = max(2 * k - 1, 0), 2 * k
        for i in range(modes):
            load[i] = complex(loads[cosine, i], -loads[sine, i] if k else 0.0)
        answer = _times(blocks[k], load)
        for i in range(modes):
            driven[i] = (0.5 * load[i] - 1j * q * mass[i] * answer[i]) / flow[i]
        turned = _times(influence_slope, driven)
        for i in range(modes):
            pushed[0, i] = 1j * q * mass[i] * turned[i]
            pushed[1, i] = uniform[i] * driven[i]
            pushed[2, i] = (1.0 - uniform[i]) * driven[i]
        for row in range(3):
            change = -2.0 * _times(blocks[k], pushed[row])
            if row == 0:
                change += turned
            for i in range(modes):
                out[row, sine, i] = -change[i].imag
                out[row, cosine, i] = change[i].real
    return out


@compiled(error_model="numpy", fastmath={"contract", "reassoc"})
def _times(matrix: Any, vector: Any) -> Any:
    """Matrix times vector; sums in any order, so that they become vector code."""
    out = np.empty_like(vector)
    for i in range(len(out)):
        total = 0.0 * vector[0]
        for j in range(len(vector)):
            total += matrix[i, j] * vector[j]
        out[i] = total
    return out
