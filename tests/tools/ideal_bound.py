"""The least induced power over every circulation the blades could carry, and over every steady twist.

`python -m tests.tools.ideal_bound` makes its table of the UH-60A, `assets/ideal_bound.csv`, in some minutes. Both
bounds make a given thrust without roll or pitch moment, on the lifting lines and in the wake of the inflow model of
that name, where

    C_T = ⟨∫ d dr⟩,   C_Pi = ⟨∫ w d dr⟩,   d = (N_b/π) U_T Γ,   w = A Γ/D + (1 − 1/D) λ0

are linear and, at a given C_T, quadratic in Γ. No load beats the first, no fixed blade with that section the second
(linear aerodynamics, no profile drag). `find_bound` gives both as factors κ on C_T λ0 of momentum theory.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.polynomial.chebyshev import chebvander

from rotor import Design, make_design
from rotor.aero.inflow.lifting_line import LiftingLineInflow, mean_share
from rotor.aero.lifting_line import LiftingLine, WakeCourse, influence
from rotor.aero.problem import build_problem
from rotor.support.arrays import Array, fixed_property
from rotor.support.assets import asset_path
from rotor.support.blas_threads import one_blas_thread
from rotor.support.user_input import csv_text
from rotor.trim.forward import with_course

RADIAL_SHAPES = 7
"""Chebyshev polynomials over the span."""
PANELS, AZIMUTHS = 24, 48
"""With 32 × 96 the bound is less than 1 % lower up to µ 0.3 (tested)."""
LIFT_SLOPE = 5.9
"""dC_l/dα of the linear blade [1/rad]."""
REVERSE_FLOW_BLEND = 0.05
"""U_T over which the linear blade's lift fades out into the reverse-flow region."""


def bound_line(blades: int, root: float) -> LiftingLine:
    """The lifting lines of a rotor, fine enough for the bound; root: r/R."""
    return LiftingLine(blades, root, PANELS, -(-AZIMUTHS // blades) * blades)


@dataclass(frozen=True, eq=False)
class LinesInWake:
    """The lifting lines of a rotor with the wake along a course."""

    line: LiftingLine
    course: WakeCourse

    @fixed_property
    def matrix(self) -> Array:
        """A/D, (points, points)."""
        return influence(self.line, self.course).astype(np.float64) / self.course.mass_flow

    @property
    def mean_inflow(self) -> float:
        """(1 − 1/D) λ0"""
        return mean_share(self.course) * self.course.lambda0

    @fixed_property
    def dr(self) -> Array:
        """Widths of the panels, (panels,)."""
        return np.diff(self.line.edges)

    @fixed_property
    def u_t(self) -> Array:
        """r + µ_x sin ψ, (panels, azimuths)."""
        return self.line.r[:, None] + self.course.mu_x * np.sin(self.line.psi)

    def load(self, circulation: Array) -> Array:
        """d = (N_b/π) U_T Γ, Kutta–Joukowski."""
        return self.line.blades / math.pi * self.u_t * circulation

    def mean(self, field: Array) -> float:
        """⟨∫ field dr⟩ of (panels, azimuths)."""
        return float((self.dr @ field).mean())


@dataclass(frozen=True, eq=False)
class InducedPower:
    """A load and its induced power. Fields are (panels, azimuths)."""

    circulation: Array
    """Γ over ΩR²."""
    induced: Array
    """w over ΩR."""
    coefficient: float
    """C_Pi"""
    amounts: Array
    """Amplitudes of the shapes or controls of the function that returns this."""


def least_induced_power(
    lines: LinesInWake,
    thrust: float,
    harmonics: int = 8,
    *,
    chord: float | None = None,
    cl_range: tuple[float, float] = (-0.6, 1.2),
) -> InducedPower:
    """The circulation of least induced power at C_T = thrust; with chord c/R given, within `cl_range` everywhere.

    Γ = max(U_T, 0) × √(1 − r²) × Chebyshev(r) × harmonics 0 … H: smooth, and no lift in reverse flow. Without that
    window the panels there make the power's form indefinite and the "least" a saddle. At µ 0.3 reverse-flow lift would
    lower the bound by 4–5 %; with more harmonics or higher µ it has not converged there.
    """
    u_t = np.maximum(lines.u_t, 0.0)
    shapes = _smooth_shapes(lines.line, harmonics)
    circulation = shapes * u_t.ravel()[:, None]
    form, equations = _power_form(lines, circulation)
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
    return _evaluate(lines, circulation @ amounts, amounts)


def least_twisted_power(
    lines: LinesInWake, thrust: float, chord: float, twist: Array, shapes: Array | None = None
) -> InducedPower:
    """The least induced power over steady twist: `twist` (panels,) [rad] plus free amounts of `shapes` (n, panels).

    Chord c/R, a straight lift curve and no drag. Without shapes: the power of that twist. Collective and cyclic trim
    thrust and moments; amounts are [θ0, θ1c, θ1s, shapes …] in radians.
    Γ = ½ c a s (U_T θ − U_P), s = U_T/0.05 within 0 … 1, U_P = µ_z + λ_i + µ_x β0 cos ψ.
    """
    line, course, u_t = lines.line, lines.course, lines.u_t
    gain = 0.5 * LIFT_SLOPE * chord * np.clip(u_t / REVERSE_FLOW_BLEND, 0.0, 1.0)
    cos, sin, ones = np.cos(line.psi), np.sin(line.psi), np.ones_like(line.psi)
    controls = [np.outer(np.ones_like(line.r), column) for column in (ones, cos, sin)]
    controls += [np.outer(shape, ones) for shape in (shapes if shapes is not None else ())]
    given = (
        u_t * twist[:, None] - course.mu_z - lines.mean_inflow - course.mu_x * course.coning * cos
    )
    pushes = np.stack(
        [(gain * push).ravel() for push in [given, *(u_t * control for control in controls)]],
        axis=1,
    )
    # The inflow answers: Γ + gain A Γ/D = gain (U_T θ − U_P without A Γ/D).
    system = np.eye(len(pushes)) + gain.ravel()[:, None] * lines.matrix
    circulation: Array = np.linalg.solve(system, pushes).astype(np.float64)
    form, equations = _power_form(lines, circulation)
    wanted = np.array([thrust, 0.0, 0.0]) - equations[:, 0]
    amounts = _minimise(form[1:, 1:], form[1:, 0], equations[:, 1:], wanted)
    return _evaluate(lines, circulation[:, 0] + circulation[:, 1:] @ amounts, amounts)


def _smooth_shapes(line: LiftingLine, harmonics: int) -> Array:
    """√(1 − r²) Chebyshev × 1, cos ψ, sin ψ, …, (panels·azimuths, shapes)."""
    r = line.r
    across = (2.0 * r - 1.0 - line.root) / (1.0 - line.root)
    radial = np.sqrt(1.0 - np.square(r))[:, None] * chebvander(across, RADIAL_SHAPES - 1)
    angle = np.outer(line.psi, np.arange(1, harmonics + 1))
    around = np.concatenate([np.ones((len(angle), 1)), np.cos(angle), np.sin(angle)], axis=1)
    return np.einsum("ia,jb->ijab", radial, around).reshape(len(r) * len(angle), -1)


def _power_form(lines: LinesInWake, circulation: Array) -> tuple[Array, Array]:
    """C_Pi less (1 − 1/D) λ0 C_T as a symmetric form in amounts of circulations (points, n), and C_T and moments as
    rows (3, n).
    """
    line = lines.line
    weight = lines.load(np.ones_like(lines.u_t)) * lines.dr[:, None] / line.azimuths
    load = circulation * weight.ravel()[:, None]
    form = load.T @ (lines.matrix @ circulation)
    arms = [np.outer(np.ones_like(line.r), np.ones_like(line.psi))]
    arms += [np.outer(line.r, trig) for trig in (np.cos(line.psi), np.sin(line.psi))]
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


def _minimise_within(
    form: Array, equations: Array, wanted: Array, bounds: Array, least: Array
) -> Array:
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
    target = np.zeros(len(system))
    target[-1] = 1.0
    weights, left = scipy.optimize.nnls(system / size, target, maxiter=20 * len(system))
    if left < 1e-9:
        raise ValueError(
            "no circulation within the lift limit makes this thrust without moments: allow a higher C_l"
        )
    residual = system / size @ weights - target
    return particular - along @ residual[:-1] / residual[-1] * scale


def _evaluate(lines: LinesInWake, circulation: Array, amounts: Array) -> InducedPower:
    field = circulation.reshape(lines.u_t.shape)
    induced = (lines.matrix @ circulation).reshape(field.shape) + lines.mean_inflow
    power = lines.mean(induced * lines.load(field))
    return InducedPower(field, induced, power, amounts)


LIFT_LIMIT = (-0.6, 1.2)
"""Range of section lift coefficients, for the bound limited by stall."""
TWIST_SHAPES = 6
"""Chebyshev polynomials over the span: more change the least power of any steady twist by less than 0.1 %."""


@dataclass(frozen=True)
class Bound:
    """Induced power over C_T λ0 at one condition, with zero hub moments; linear aerodynamics."""

    mu: float
    ct: float
    lambda0: float
    any_circulation: float
    """Any circulation that varies smoothly over the disk, none in reverse flow."""
    lift_limited: float
    """Circulation within `LIFT_LIMIT`; infinite where none was found."""
    steady_twist: float
    """Any fixed twist."""
    linear_twist: float
    """The best linear twist."""
    linear_rate: float
    """That twist [rad per radius]."""


@one_blas_thread()
def find_bound(design: Design) -> Bound:
    """The bound for a design's rotor, thrust and speed (not for its twist or sections). Takes seconds."""
    rotor = design.rotor
    drag, down = design.drag_parts
    ct = math.hypot(design.weight_coefficient + down, drag)
    models = replace(design.models, inflow=LiftingLineInflow.name)
    problem = with_course(build_problem(replace(design, models=models)))
    lines = LinesInWake(bound_line(rotor.blades, rotor.blade.root_cutout), problem.course)
    line, momentum = lines.line, ct * problem.expected.lambda0
    r = line.r
    chord = rotor.reference_chord / rotor.radius
    across = (2.0 * r - 1.0 - line.root) / (1.0 - line.root)
    shapes = chebvander(across, TWIST_SHAPES).T[1:].astype(float)
    straight = r - 0.75

    def factor(power: InducedPower) -> float:
        return power.coefficient / momentum

    linear = least_twisted_power(lines, ct, chord, 0.0 * r, straight[None])
    try:
        limited = factor(least_induced_power(lines, ct, chord=chord, cl_range=LIFT_LIMIT))
    except ValueError:
        # None carries this thrust, or the form is indefinite, which it can be at µ 0.4.
        limited = math.inf
    return Bound(
        mu=design.condition.advance_ratio,
        ct=ct,
        lambda0=problem.expected.lambda0,
        any_circulation=factor(least_induced_power(lines, ct)),
        lift_limited=limited,
        steady_twist=factor(least_twisted_power(lines, ct, chord, 0.0 * r, shapes)),
        linear_twist=factor(linear),
        linear_rate=float(linear.amounts[3]),
    )


SPEEDS = (0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4)
MASSES = (5000.0, 6500.0, 8322.4, 9600.0, 11000.0)
COLUMNS = (
    "mu", "mass_kg", "ct", "lambda0", "glauert_kw", "any_circulation", "lift_limited", "steady_twist",
    "linear_twist", "linear_deg",
)  # fmt: skip
HEADING = """\
# Least induced power over C_T λ0 (momentum theory, glauert_kw) of the UH-60A at sea level: any circulation;
# any within section lift −0.6…1.2; any steady twist; the best linear twist and its rate in °/R. Lifting
# lines, the wake of the inflow model lifting-line, zero hub moments, linear aerodynamics.
# Made by: python -m tests.tools.ideal_bound
"""


def row(design: Design) -> tuple[str, ...]:
    """A line of the table: `COLUMNS`."""
    bound = find_bound(design)
    glauert = bound.ct * bound.lambda0 * design.power_unit / 1e3
    factors = (bound.any_circulation, bound.lift_limited, bound.steady_twist, bound.linear_twist)
    return (
        f"{bound.mu:.4g}",
        f"{design.condition.mass:.6g}",
        f"{bound.ct:.6f}",
        f"{bound.lambda0:.6f}",
        f"{glauert:.1f}",
        *(f"{factor:.3f}" for factor in factors),
        f"{math.degrees(bound.linear_rate):.1f}",
    )


if __name__ == "__main__":
    made = [row(make_design(mu=mu, mass_kg=mass)) for mu in SPEEDS for mass in MASSES]
    asset_path("ideal_bound.csv").write_text(
        csv_text([COLUMNS, *made], HEADING), encoding="utf-8", newline=""
    )
