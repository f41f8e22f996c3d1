"""The least induced power: over every circulation the blades could carry, and over every steady twist.

Both make a given thrust with no roll or pitch moment, on the vortex lattice with the wake's direction given, where

    C_T = ⟨∫ d dr⟩,   C_Pi = ⟨∫ w d dr⟩,   d = (N_b/π) U_T Γ,   w = A Γ

are linear and quadratic in Γ. No load can beat the first, no fixed blade with that section the second (linear
aerodynamics, no profile drag).
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.polynomial.chebyshev import chebvander
from scipy.optimize import nnls

from rotor.aero.inflow.interface import Wake
from rotor.aero.inflow.vortex_lattice import Lattice, shared_azimuths
from rotor.arrays import Array

RADIAL_SHAPES = 7
"""Chebyshev polynomials over the span."""
BOUND_LATTICE = Lattice(panels=20, azimuths=72, bare_from=0.0)
"""Fine enough for the bound to 0.2 %. No core in a blade's own young wake: the optimum would exploit it.
Of the UH-60A; `bound_lattice` for others."""
REVERSE_FLOW_BLEND = 0.05
"""U_T over which the linear blade's lift fades out into the reverse-flow region."""


def bound_lattice(blades: int, root: float) -> Lattice:
    """The same for a rotor of other blades and another root, r/R."""
    azimuths = shared_azimuths(BOUND_LATTICE.azimuths, blades)
    return replace(BOUND_LATTICE, blades=blades, root=root, azimuths=azimuths)


@dataclass(frozen=True, eq=False)
class InducedPower:
    """A load and what it costs. Fields are (panels, azimuths) of the lattice."""

    circulation: Array
    """Γ over ΩR²."""
    induced: Array
    """w = A Γ over ΩR."""
    coefficient: float
    """C_Pi"""
    amounts: Array
    """How much of each shape or control; what they are, the function says."""


def least_induced_power(
    lattice: Lattice,
    wake: Wake,
    thrust: float,
    harmonics: int = 8,
    *,
    chord: float | None = None,
    cl_range: tuple[float, float] = (-0.6, 1.2),
) -> InducedPower:
    """The circulation of least induced power at C_T = thrust; with chord c/R given, within `cl_range` everywhere.

    Γ = max(U_T, 0) × √(1 − r²) × Chebyshev(r) × harmonics 0 … H: smooth, and no lift in reverse flow. Without that
    window the panels there make the power's form indefinite and the "least" a saddle. At µ 0.3 reverse-flow lift would
    lower the bound by 4–5 %; with more harmonics or higher µ it has not settled there.
    """
    u_t = np.maximum(lattice.tangential(wake.mu_x), 0.0)
    shapes = _smooth_shapes(lattice, harmonics)
    circulation = shapes * u_t.ravel()[:, None]
    form, equations = _power_form(lattice, wake, circulation)
    wanted = np.array([thrust, 0.0, 0.0])
    if chord is None:
        amounts = _minimise(form, np.zeros(len(form)), equations, wanted)
    else:
        # Γ = ½ c U_T C_l, so Γ/U_T is ½ c C_l.
        inside = u_t.ravel() > 0.0
        low, high = (0.5 * chord * limit for limit in cl_range)
        bounds = np.concatenate([shapes[inside], -shapes[inside]])
        least = np.concatenate([np.full(int(inside.sum()), low), np.full(int(inside.sum()), -high)])
        amounts = _minimise_within(form, equations, wanted, bounds, least)
    return _evaluate(lattice, wake, circulation @ amounts, amounts)


@dataclass(frozen=True)
class LinearBlade:
    """A blade with a straight lift curve and no drag."""

    chord: float = 0.5273 / 8.1778
    """c/R (thesis tables 3.1, 3.2)."""
    lift_slope: float = 5.9
    """dC_l/dα [1/rad]."""
    coning: float = 0.06
    """β0 [rad]"""


def least_twisted_power(
    lattice: Lattice, wake: Wake, thrust: float, blade: LinearBlade, twist: Array, shapes: Array | None = None
) -> InducedPower:
    """The least induced power over steady twist: `twist` (panels,) [rad] plus free amounts of `shapes` (n, panels).

    Without shapes: the power of that twist. Collective and cyclic trim thrust and moments; amounts are [θ0, θ1c, θ1s,
    shapes …] in radians. Γ = ½ c a s (U_T θ − U_P), s = U_T/0.05 within 0 … 1, U_P = µ_z + λ_i + µ_x β0 cos ψ.
    """
    u_t = lattice.tangential(wake.mu_x)
    gain = 0.5 * blade.lift_slope * blade.chord * np.clip(u_t / REVERSE_FLOW_BLEND, 0.0, 1.0)
    cos, sin, ones = np.cos(lattice.psi), np.sin(lattice.psi), np.ones_like(lattice.psi)
    controls = [np.outer(np.ones_like(lattice.r), column) for column in (ones, cos, sin)]
    controls += [np.outer(shape, ones) for shape in (shapes if shapes is not None else ())]
    given = u_t * twist[:, None] - wake.mu_z - wake.mu_x * blade.coning * cos
    pushes = np.stack([(gain * push).ravel() for push in [given, *(u_t * control for control in controls)]], axis=1)
    # The inflow answers: Γ + gain A Γ = gain (U_T θ − U_P without λ_i).
    system = np.eye(len(pushes)) + gain.ravel()[:, None] * lattice.on_wake(wake)
    circulation: Array = np.linalg.solve(system, pushes).astype(np.float64)
    form, equations = _power_form(lattice, wake, circulation)
    wanted = np.array([thrust, 0.0, 0.0]) - equations[:, 0]
    amounts = _minimise(form[1:, 1:], form[1:, 0], equations[:, 1:], wanted)
    return _evaluate(lattice, wake, circulation[:, 0] + circulation[:, 1:] @ amounts, amounts)


def _smooth_shapes(lattice: Lattice, harmonics: int) -> Array:
    """√(1 − r²) Chebyshev × 1, cos ψ, sin ψ, …, (panels·azimuths, shapes)."""
    r = lattice.r
    across = (2.0 * r - 1.0 - lattice.root) / (1.0 - lattice.root)
    radial = np.sqrt(1.0 - np.square(r))[:, None] * chebvander(across, RADIAL_SHAPES - 1)
    angle = np.outer(lattice.psi, np.arange(1, harmonics + 1))
    around = np.concatenate([np.ones((len(angle), 1)), np.cos(angle), np.sin(angle)], axis=1)
    return np.einsum("ia,jb->ijab", radial, around).reshape(len(r) * len(angle), -1)


def _power_form(lattice: Lattice, wake: Wake, circulation: Array) -> tuple[Array, Array]:
    """C_Pi as a symmetric form in the amounts of given circulations (points, n), and C_T and moments as rows (3, n)."""
    u_t = lattice.tangential(wake.mu_x)
    weight = lattice.load(np.ones_like(u_t), u_t) * lattice.dr[:, None] / lattice.azimuths
    load = circulation * weight.ravel()[:, None]
    form = load.T @ (lattice.on_wake(wake) @ circulation)
    arms = [np.outer(np.ones_like(lattice.r), np.ones_like(lattice.psi))]
    arms += [np.outer(lattice.r, trig) for trig in (np.cos(lattice.psi), np.sin(lattice.psi))]
    return 0.5 * (form + form.T), np.stack([arm.ravel() @ load for arm in arms])


def _minimise(form: Array, slope: Array, equations: Array, wanted: Array) -> Array:
    """Least xᵀ form x + 2 slope x subject to equations x = wanted, by the stationary point of the Lagrangian."""
    n, k = len(form), len(equations)
    scale = math.sqrt(float(np.abs(form).max()))  # Brings both kinds of rows to one size.
    system = np.zeros((n + k, n + k))
    system[:n, :n] = form / scale**2
    system[:n, n:] = equations.T
    system[n:, :n] = equations
    solution = np.linalg.lstsq(system, np.concatenate([-slope / scale**2, wanted]), rcond=1e-14)[0]
    return solution[:n].astype(np.float64)


def _minimise_within(form: Array, equations: Array, wanted: Array, bounds: Array, least: Array) -> Array:
    """Least xᵀ form x subject to equations x = wanted and bounds x ≥ least.

    On the null space of the equations and in coordinates where the form is a sum of squares this is the point of a
    polyhedron nearest to the origin, which Lawson & Hanson (1974) solve by non-negative least squares.
    """
    particular = _minimise(form, np.zeros(len(form)), equations, wanted)
    _, _, right = np.linalg.svd(equations)
    null = right[len(equations) :].T
    factor = np.linalg.cholesky(null.T @ form @ null)
    # x = particular + null factor⁻ᵀ y; at the particular point the form's slope along the null space vanishes.
    along = np.linalg.solve(factor, null.T).T
    sides = bounds @ along
    gaps = least - bounds @ particular
    scale = float(np.abs(gaps).max())
    system = np.concatenate([sides, gaps[:, None] / scale], axis=1).T
    size = np.linalg.norm(system[:-1], axis=0)
    wish = np.zeros(len(system))
    wish[-1] = 1.0
    weights, left = nnls(system / size, wish, maxiter=20 * len(system))
    if left < 1e-9:
        raise ValueError("no circulation within the lift limit makes this thrust without moments: allow a higher C_l")
    residual = system / size @ weights - wish
    return particular - along @ residual[:-1] / residual[-1] * scale


def _evaluate(lattice: Lattice, wake: Wake, circulation: Array, amounts: Array) -> InducedPower:
    field = circulation.reshape(lattice.panels, lattice.azimuths)
    induced = (lattice.on_wake(wake) @ circulation).reshape(field.shape)
    power = lattice.mean(induced * lattice.load(field, lattice.tangential(wake.mu_x)))
    return InducedPower(field, induced, power, amounts)
