"""The Peters–He dynamic wake: shape functions, inflow influence [L], apparent mass [M], flow parameters [V], response.

The shapes are radial functions φ_n^m(r) times cos mψ and sin mψ. φ_n^m is the normalised Legendre function
P̄_n^m(ν)/ν on the disk, ν = √(1 − r²), n − m odd, so that ν φ_n^m of one m are orthonormal on 0 ≤ ν ≤ 1.
With states α (cosines) and β (sines) and loads τ, λ_i = Σ φ_j^r (α_j^r cos rψ + β_j^r sin rψ) and

    [M] α' + [V] [Lc]⁻¹ α = ½ τc,      the same with Ls, β, τs;      ' = d/dψ.

A load that N_b identical blades repeat has harmonics q = 0, N_b, 2N_b, … in the fixed frame. The amplitudes a, τ of
each, α = Re a exp iqψ, answer as a = ½ L (V + iqM L)⁻¹ τ; [L]⁻¹, singular for edgewise flight, is never formed.

Sources: Peters, Boyd & He, J. AHS 34(4), 1989; Peters & He, J. Aircraft 32(2), 1995. Written from memory and checked
against tables, closed forms of the actuator disk and identities (see the tests).
The skew χ is that of |µ_z + λ0|: in upflow the wake above the disk is the mirror image of one below, and induces the
same. The mass flow keeps the sign of the flow.
"""

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import eval_jacobi

from rotor.aero.inflow.interface import Wake
from rotor.arrays import Array, Integers
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


_compile = compiled(error_model="numpy", fastmath={"contract"})


@dataclass(frozen=True, eq=False)
class Family:
    """The cosine or the sine modes of an order. Matrices are (inflow modes, pressure modes)."""

    modes: tuple[Mode, ...]
    m: Integers
    """(modes,)"""
    gain: Array
    """Γ"""
    sign: float
    """1 for cosines, −1 for sines."""
    mass: Array
    """Diagonal of [M] = 2H/π."""
    uniform: Array
    """1 at the mode (0, 1), whose flow parameter is V_T, else 0."""

    def influence(self, half_skew: float) -> tuple[Array, Array]:
        """[L] at X = tan(χ/2), and its exact derivative by X.

        L^0m = X^m Γ;  L^rm = [X^|m−r| ± (−1)^min(r,m) X^(m+r)] Γ for r ≥ 1, + for cosines, − for sines.
        """
        powers, slopes = powers_of_skew(half_skew, 2 * int(self.m[-1]))
        return self.gain * _skew_factors(self.m, self.sign, powers), self.gain * _skew_factors(
            self.m, self.sign, slopes
        )


@_compile
def powers_of_skew(half_skew: float, highest: int) -> Any:
    """X^k and its derivative by X, k = 0 … highest, (2, highest + 1)."""
    out = np.zeros((2, highest + 1))
    out[0, 0] = 1.0
    for k in range(1, highest + 1):
        out[0, k] = half_skew * out[0, k - 1]
        out[1, k] = k * out[0, k - 1]
    return out


@_compile
def _skew_factors(m: Any, sign: float, powers: Any) -> Any:
    """[L] over Γ from the powers of X, and their derivatives from those of the powers, (modes, modes)."""
    n = len(m)
    out = np.empty((n, n))
    for i in range(n):
        for j in range(n):
            factor = powers[abs(m[j] - m[i])]
            if m[i] > 0:
                mirrored = sign * powers[m[i] + m[j]]
                factor += -mirrored if min(m[i], m[j]) % 2 else mirrored
            out[i, j] = factor
    return out


@lru_cache(maxsize=16)
def families(order: int) -> tuple[Family, Family]:
    """Cosines and sines with n − 1 ≤ order."""
    return _family(mode_set(order), 1.0), _family(mode_set(order, 1), -1.0)


def _family(modes: tuple[Mode, ...], sign: float) -> Family:
    return Family(
        modes=modes,
        m=np.array([mode[0] for mode in modes], dtype=np.int64),
        gain=np.array([[gain(r, j, *pressure) for pressure in modes] for r, j in modes]),
        sign=sign,
        mass=np.array([2.0 * norm(*mode) / math.pi for mode in modes]),
        uniform=np.array([1.0 if mode == (0, 1) else 0.0 for mode in modes]),
    )


@dataclass(frozen=True, eq=False)
class CommonBasis:
    """The matrices of the cosines for g_k in place of φ_n^m; those of the sines are their parts with m ≥ 1.

    g_k is the φ of m = k with the highest n. All φ_n^m of one m are sums of as many of g_m, g_m+2, …, φ = E g, with a
    condition number of 4. Amplitudes of g are Eᵀ a, and τ = E τ_g: so Eᵀ L E, E⁻¹ M E⁻ᵀ and E⁻¹ V E take the places
    of L, M and V. The powers of X depend on m alone, which E keeps.
    """

    m: Integers
    """(modes,)"""
    order: Integers
    """k of the g of each mode, (modes,)."""
    gain: Array
    """Eᵀ Γ E"""
    mass: Array
    """E⁻¹ M E⁻ᵀ"""
    driven: Array
    """Their product, M L where X = 1."""
    uniform: Array
    """u = E⁻¹ e and w = Eᵀ e of the uniform mode e, (2, modes): V = V̄ + (V_T − V̄) u wᵀ."""
    steady: int
    """Number of modes with m = 0."""


@lru_cache(maxsize=16)
def common_basis(order: int) -> CommonBasis:
    """Of the modes with n − 1 ≤ order. E follows from values at more radii than needed: all are polynomials."""
    cosines = families(order)[0]
    m = cosines.m
    k = m + 2 * (np.arange(len(m)) - np.searchsorted(m, m))
    r = np.sqrt(1.0 - np.square(np.linspace(0.02, 0.98, 4 * order)))
    g, expansion = radial_functions(highest_modes(order), r), np.zeros((len(m), len(m)))
    for i, mode in enumerate(cosines.modes):
        same = m == mode[0]
        expansion[i, same] = np.linalg.lstsq(g[k[same]].T, radial_function(*mode, r))[0]
    back = np.linalg.inv(expansion)
    influence, mass = expansion.T @ cosines.gain @ expansion, back @ (cosines.mass[:, None] * back.T)
    uniform = np.stack([back @ cosines.uniform, expansion.T @ cosines.uniform])
    return CommonBasis(m, k, influence, mass, mass @ influence, uniform, int(np.count_nonzero(m == 0)))


def highest_modes(order: int) -> tuple[Mode, ...]:
    """The modes of g_0 … g_S: the highest n of every m."""
    return tuple((m, order + (order - m + 1) % 2) for m in range(order + 1))


@dataclass(frozen=True, eq=False)
class FlowParameters:
    """The parameters of the matrices, with slopes by (µ_x, µ_z, λ0)."""

    half_skew: float
    """X = tan(χ/2) = µ_x/(V_T + |µ_z + λ0|), regular from hover to edgewise flight and on to upflow."""
    speed: float
    """V_T = √(µ_x² + (µ_z + λ0)²): the flow parameter of the mode (0, 1)."""
    mass_flow: float
    """V̄ = [µ_x² + (µ_z + 2λ0)(µ_z + λ0)]/V_T: that of every other mode; 2λ0 in hover."""
    wake: Wake

    @cached_property
    def slopes(self) -> Array:
        """(3, 3): rows X, V_T, V̄; columns µ_x, µ_z, λ0."""
        mu, axial, speed = self.wake.mu_x, self.wake.axial, self.speed
        total = speed + abs(axial)
        x_mu, x_axial = abs(axial) / (speed * total), -math.copysign(mu / (speed * total), axial)
        v_mu, v_axial = mu / speed, axial / speed
        m_mu = 2.0 * mu / speed - self.mass_flow * v_mu / speed
        m_axial = (2.0 * axial + self.wake.lambda0) / speed - self.mass_flow * v_axial / speed
        return np.array([[x_mu, x_axial, x_axial], [v_mu, v_axial, v_axial], [m_mu, m_axial, m_axial + axial / speed]])


def flow_parameters(wake: Wake) -> FlowParameters:
    """X, V_T, V̄ of a wake."""
    axial, speed = wake.axial, wake.speed
    mass_flow = (wake.mu_x**2 + (axial + wake.lambda0) * axial) / speed
    return FlowParameters(wake.mu_x / (speed + abs(axial)), speed, mass_flow, wake)


# The functions below are for one family in the common basis. Amplitudes of q = 0 and of k harmonics are real columns,
# (modes, 1 + 2k): Re a_0, then Re a_q, Im a_q. With B = V⁻¹ M L, (1 + iqB)⁻¹ = (1 − iqB)(1 + q²B²)⁻¹, so only real
# equations are solved.


@_compile
def influences(basis_gain: Any, basis_driven: Any, m: Any, sign: float, powers: Any) -> Any:
    """L and M L, or with slopes of the powers their slopes by X, (2, modes, modes)."""
    factors = _skew_factors(m, sign, powers)
    out = np.empty((2, *factors.shape))
    for i in range(len(m)):
        for j in range(len(m)):
            out[0, i, j] = factors[i, j] * basis_gain[i, j]
            out[1, i, j] = factors[i, j] * basis_driven[i, j]
    return out


@_compile
def _over_flow(matrix: Any, flow: Any, uniform: Any) -> Any:
    """V⁻¹ times a matrix, with V⁻¹ = [1 + (V̄/V_T − 1) u wᵀ]/V̄; V⁻ᵀ with u and w exchanged."""
    out = np.empty_like(matrix)
    _, speed, mass_flow = flow
    share = uniform[1] @ matrix
    for i in range(matrix.shape[0]):
        turned = (mass_flow / speed - 1.0) * uniform[0, i]
        for j in range(matrix.shape[1]):
            out[i, j] = (matrix[i, j] + turned * share[j]) / mass_flow
    return out


@_compile
def answer(influence: Any, driven: Any, flow: Any, uniform: Any, harmonics: Any, loads: Any) -> Any:
    """a = ½ L (V + iqM L)⁻¹ τ, (modes, 1 + 2k), at the flow (X, V_T, V̄); `driven` is M L.

    a = ½ L (z − iqB z) with (1 + q²B²) z = V⁻¹ τ.
    """
    modes = len(influence)
    scaled = _over_flow(driven, flow, uniform)
    square = scaled @ scaled
    pushed = _over_flow(loads, flow, uniform)
    system = np.empty((modes, modes + 2))
    for k in range(len(harmonics)):
        q, real, imaginary = harmonics[k], 1 + 2 * k, 2 + 2 * k
        for i in range(modes):
            for j in range(modes):
                system[i, j] = q * q * square[i, j]
            system[i, i] += 1.0
            system[i, modes], system[i, modes + 1] = pushed[i, real], pushed[i, imaginary]
        eliminate(system)
        turned = scaled @ np.ascontiguousarray(system[:, modes:])
        for i in range(modes):
            pushed[i, real] = system[i, modes] + q * turned[i, 1]
            pushed[i, imaginary] = system[i, modes + 1] - q * turned[i, 0]
    return 0.5 * (influence @ pushed)


@_compile
def blocks(influence: Any, driven: Any, flow: Any, uniform: Any, harmonics: Any) -> Any:
    """The transposes of ½ L (V + iqM L)⁻¹, (1 + 2k, pressure modes, inflow modes): that of q = 0, then Re and Im.

    With R = ½ L (1 + q²B²)⁻¹ it is R (1 − iqB) V⁻¹.
    """
    modes = len(influence)
    out = np.empty((1 + 2 * len(harmonics), modes, modes))
    scaled, swapped = _over_flow(driven, flow, uniform), uniform[::-1].copy()
    square, half = scaled @ scaled, 0.5 * influence.T.copy()
    out[0] = _over_flow(half, flow, swapped)
    system = np.empty((modes, 2 * modes))
    for k in range(len(harmonics)):
        q = harmonics[k]
        for i in range(modes):
            for j in range(modes):
                system[i, j] = q * q * square[j, i]
                system[i, modes + j] = half[i, j]
            system[i, i] += 1.0
        eliminate(system)
        real = system[:, modes:].copy()
        out[1 + 2 * k] = _over_flow(real, flow, swapped)
        out[2 + 2 * k] = _over_flow(-q * (scaled.T @ real), flow, swapped)
    return out


@_compile
def answer_slopes(made: Any, slopes: Any, mass: Any, flow: Any, uniform: Any, harmonics: Any, loads: Any) -> Any:
    """∂a by X, V_T and V̄, (3, modes, 1 + 2k). `made` are `blocks`, `slopes` those of L and M L by X.

    With a = H τ = L y and (V + iqM L) y = ½ τ:  da = dL y − 2H (dV y + iqM dL y).
    """
    modes = len(mass)
    y = 0.5 * loads
    moved = mass @ _times(made, loads)
    for k in range(len(harmonics)):
        for i in range(modes):
            y[i, 1 + 2 * k] += harmonics[k] * moved[i, 2 + 2 * k]
            y[i, 2 + 2 * k] -= harmonics[k] * moved[i, 1 + 2 * k]
    y = _over_flow(y, flow, uniform)
    by_influence, by_driven, share = slopes[0] @ y, slopes[1] @ y, uniform[1] @ y
    pushed = np.zeros((3, *y.shape))
    for i in range(modes):
        for c in range(y.shape[1]):
            pushed[1, i, c] = uniform[0, i] * share[c]
            pushed[2, i, c] = y[i, c] - pushed[1, i, c]
        for k in range(len(harmonics)):
            pushed[0, i, 1 + 2 * k] = -harmonics[k] * by_driven[i, 2 + 2 * k]
            pushed[0, i, 2 + 2 * k] = harmonics[k] * by_driven[i, 1 + 2 * k]
    out = np.empty((3, *y.shape))
    for row in range(3):
        out[row] = -2.0 * _times(made, pushed[row])
    out[0] += by_influence
    return out


@_compile
def _times(made: Any, loads: Any) -> Any:
    """½ L (V + iqM L)⁻¹ τ by its `blocks`, (modes, 1 + 2k)."""
    modes, columns = loads.shape
    given, out = loads.T.copy(), np.zeros((columns, modes))
    for j in range(modes):
        for i in range(modes):
            out[0, i] += made[0, j, i] * given[0, j]
    for real in range(1, columns, 2):
        imaginary = real + 1
        for j in range(modes):
            re, im = given[real, j], given[imaginary, j]
            for i in range(modes):
                out[real, i] += made[real, j, i] * re - made[imaginary, j, i] * im
                out[imaginary, i] += made[real, j, i] * im + made[imaginary, j, i] * re
    return out.T.copy()


@_compile
def eliminate(system: Any) -> None:
    """Solve equations with their right sides beside them, (n, n + columns), in place: Gaussian elimination.

    Two unknowns at a time: rows are then read and written half as often. LAPACK takes twice as long for few right
    sides of 25 unknowns.
    """
    n, width = system.shape
    for k in range(0, n - 1, 2):
        _bring_pivot(system, k)
        pivot = 1.0 / system[k, k]
        for i in range(k + 1, n):
            system[i, k] *= pivot
            system[i, k + 1] -= system[i, k] * system[k, k + 1]
        _bring_pivot(system, k + 1)
        for j in range(k + 2, width):
            system[k + 1, j] -= system[k + 1, k] * system[k, j]
        pivot = 1.0 / system[k + 1, k + 1]
        for i in range(k + 2, n):
            first, second = system[i, k], system[i, k + 1] * pivot
            for j in range(k + 2, width):
                system[i, j] -= first * system[k, j] + second * system[k + 1, j]
    for k in range(n - 1, -1, -1):
        pivot = 1.0 / system[k, k]
        for j in range(n, width):
            system[k, j] *= pivot
        for i in range(k):
            factor = system[i, k]
            for j in range(n, width):
                system[i, j] -= factor * system[k, j]


@_compile
def _bring_pivot(a: Any, k: int) -> None:
    """Exchange row k for that row from k on with the largest number in column k."""
    best, most = k, abs(a[k, k])
    for i in range(k + 1, len(a)):
        if abs(a[i, k]) > most:
            best, most = i, abs(a[i, k])
    if best != k:
        for j in range(a.shape[1]):
            a[k, j], a[best, j] = a[best, j], a[k, j]
