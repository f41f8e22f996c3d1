"""The exact gradient of power by the pitch at every blade station: one linear solve for any number of stations.

The trim makes the residuals R(x) zero. For a measure P, with Jᵀ a = ∂P/∂x, the slope of P − a·R by the pitch channel at
an element, summed over the azimuths, is the gradient by the pitch of that element: the trim follows. For an elastic
blade the tension on its twist, which is in R, adds to it; where the inflow is joined with that of hover, so does what
the hovering rotor answers. The chain rule gives the gradient by any twist parameter:
dP/dp = Σ_r dP/dθ(r) ∂θ_tw(r)/∂p.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from rotor.aero.elements import BladeElements
from rotor.aero.inflow.local_momentum import BALANCED
from rotor.aero.section import FX, FZ, RATE, TH, UP, UR, UT
from rotor.columns.flight import SWIRL, SWIRL_SLOPE
from rotor.columns.hover import turning_of
from rotor.design.twist import SpecTwist, TwistLaw
from rotor.engine.linearise import MeasureSlopes, jacobian, transposed, with_slopes
from rotor.engine.newton import KRYLOV_TOLERANCE, Factors, solve_transposed
from rotor.engine.terms import Terms
from rotor.support.arrays import Array, ShortRepr
from rotor.support.blas_threads import one_blas_thread
from rotor.support.bytes_cache import bytes_cache
from rotor.trim.low_speed import HoverDifference, joined_hover
from rotor.trim.newton import FactorBox, LinearisedTrim
from rotor.trim.power import tail_power
from rotor.trim.solution import Solution

Objective = Literal["total", "induced"]


@dataclass(frozen=True, eq=False, repr=False)
class PitchGradient(ShortRepr):
    """Change of power with pitch along the blade, while trim and inflow adjust: exact, by the adjoint of the trim.

    Equations: docs/theory.md, §13.
    """

    r: Array
    """Element centres y/R, (elements,)."""
    dr: Array
    """Element widths over R, (elements,)."""
    by_element: Array
    """∂P/∂θ of each element's pitch [W/rad], (elements,)."""

    @property
    def density(self) -> Array:
        """∂P/∂θ per unit of r [W/rad], (elements,), independent of the grid."""
        return self.by_element / self.dr

    def along(self, twist: Array | TwistLaw) -> Array:
        """∂P by twist parameters, from ∂θ_tw(r)/∂p, (parameters, elements) → (parameters,).

        Of a twist law the change of power [W] if it were added to the blade's twist, to first order, ().
        """
        return (twist(self.r) if callable(twist) else twist) @ self.by_element

    def by_parameters(self, law: TwistLaw) -> Array:
        """∂P by each number of a twist law, in the order of its SPEC [W/rad; W for a station r/R], (numbers,).

        For `linear`, `quadratic`, `segments` and `spline` laws; TypeError for others.
        """
        if not isinstance(law, SpecTwist) or type(law).slopes is SpecTwist.slopes:
            raise TypeError(
                f"twist {law.spec()} has no numbers to change: give linear, quadratic, segments or spline"
            )
        return law.slopes(self.r) @ self.by_element


@dataclass(frozen=True, eq=False)
class ElementSlopes:
    """Derivatives of a measure at each element, (elements, azimuths) or 0."""

    fz: Array | float = 0.0
    """By F_z."""
    fx: Array | float = 0.0
    """By F_x."""
    inflow: Array | float = 0.0
    """By λ_i at the same velocities."""
    theta: Array | float = 0.0
    """By θ at the same loads, as the next three."""
    u_t: Array | float = 0.0
    """By U_T."""
    u_p: Array | float = 0.0
    """By U_P."""
    u_r: Array | float = 0.0
    """By U_R, the flow along the blade."""
    rate: Array | float = 0.0
    """By θ'."""
    swirl: Array | float = 0.0
    """By the swirl at the same velocities."""

    def over(self, shape: tuple[int, int]) -> list[Array]:
        """All weights as arrays."""
        return [np.broadcast_to(weight, shape) for weight in vars(self).values()]


_FEW = 12
"""Equations up to which what forces remember is formed for a gradient: products take longer. Our choice."""
_MANY_PASSES = 9
"""Passes of a trim beyond which its factors are too far: made at the trim they spare more later than they take. Our
choice: over sliders' steps trims take as long with 8 and gradients longer, with 10 trims take longer."""


class _Linear:
    """A linearised trim with its factors: what every adjoint of one solution shares."""

    def __init__(self, trim: LinearisedTrim, box: FactorBox | None = None, passes: int = 0) -> None:
        """box: factors of a Jacobian nearby, of the same equations; passes: that the trim took with them."""
        self.trim, self.problem, self.point = trim, trim.problem, with_slopes(trim.point)
        self._box = FactorBox() if box is None else box
        self._far = passes > _MANY_PASSES

    @property
    def elements(self) -> BladeElements:
        """The blade elements at the trim."""
        return self.trim.elements

    @property
    def power_terms(self) -> Terms:
        """Induced and profile power in terms of the trim's equations."""
        return self.point.system.structure.sums["power"]

    @cached_property
    def _linearised(self) -> tuple[Factors, Array]:
        """Factors of the trim, and the slopes of induced and profile power by the states, (equations,)."""
        matrix, power = jacobian(self.point, self.power_terms)
        return Factors.of_matrix(matrix), power[0]

    def multipliers(self, measure: MeasureSlopes, tolerance: float = KRYLOV_TOLERANCE) -> Array:
        """a of Jᵀ a = ∂(measure)/∂x, (equations,); tolerance: of what an iteration leaves, over the right side."""
        point = self.point
        none = np.zeros(len(point.system.free))
        if not len(none):
            return none
        if point.system.nodes is not None or (point.memory is not None and len(none) > _FEW):
            return self._by_iteration(transposed(point, none, measure)[0], tolerance)
        factors, power = self._linearised
        slopes = power if measure.terms is self.power_terms else transposed(point, none, measure)[0]
        return factors.solve(slopes, transposed=True)

    @property
    def total_terms(self) -> Terms:
        """What of the rotor's power a twist changes: on a stand the shaft's less the work on bending."""
        on_stand = self.problem.design.condition.stand is not None
        return (
            self.point.system.structure.sums["power on a stand"] if on_stand else self.power_terms
        )

    @cached_property
    def of_total(self) -> Array:
        """The multipliers of `total_terms`, (equations,)."""
        return self.multipliers(MeasureSlopes(terms=self.total_terms))

    @property
    def induced_weights(self) -> ElementSlopes:
        """Of induced power, in its unit."""
        e, cell = self.elements, self.problem.disk.dr[:, None] / len(self.problem.disk.psi)
        return ElementSlopes(
            fz=cell * e.induced, fx=cell * e.swirl[:, None], inflow=cell * e.fz, swirl=cell * e.fx
        )

    def slopes(self, measure: MeasureSlopes) -> tuple[Array, Array]:
        """∂(measure)/∂θ by element, and slopes by every channel at every element, the states following."""
        point, structure = self.point, self.point.system.structure
        multipliers = (
            self.of_total if measure.terms is self.total_terms else self.multipliers(measure)
        )
        by_channel = transposed(point, -multipliers, measure)[1].sum(axis=2)
        by_pitch, torsion = by_channel[TH], self.problem.torsion
        if torsion is None:
            return by_pitch, by_channel
        steady = [structure.equations["twist", k, 0] for k in range(len(torsion.gain))]
        return by_pitch - multipliers[steady] @ (
            torsion.gain[:, None] * torsion.tension
        ), by_channel

    @one_blas_thread()
    def _by_iteration(self, slopes: Array, tolerance: float) -> Array:
        """J⁻ᵀ times slopes, from factors nearby; from those made here where these are too far; else directly."""
        kept = self._box
        if kept.factors is not None and kept.factors.usable and (kept.at_trim or not self._far):
            found = solve_transposed(self.point, slopes, kept.factors, tolerance)
            if found is not None:
                return found
        if not kept.at_trim:
            kept.factors, kept.at_trim = Factors.of(self.point.forgetful), True
            return self._by_iteration(slopes, tolerance)
        return np.asarray(np.linalg.solve(jacobian(self.point)[0].T, slopes), dtype=np.float64)

    def measure(self, weights: ElementSlopes) -> MeasureSlopes:
        """Weights as the engine takes them; in annuli U_T and U_P follow the inflow that they balance by themselves."""
        terms = self.problem.inflow_terms
        given = weights.over(self.problem.disk.shape)
        if self.problem.design.hovering:
            fz, fx, inflow, theta, u_t, u_p, _, _, swirl = (
                weight.sum(axis=1)[:, None] for weight in given
            )
            balanced = inflow + u_p + (swirl - u_t) * turning_of(self.point)[:, None]
            return MeasureSlopes(forces={FZ: fz, FX: fx, BALANCED: balanced}, channels={TH: theta})
        fz, fx, inflow, theta, u_t, u_p, u_r, rate, swirl = given
        forces = {FZ: fz, FX: fx}
        if terms.interface.balanced is not None:
            forces[terms.interface.balanced] = u_p + inflow
        channels = {TH: theta, UT: u_t, UP: u_p, UR: u_r, RATE: rate}
        parts = [(UP, list(terms.names), inflow), (UT, [SWIRL, SWIRL_SLOPE], -swirl)]
        nodes = None if self.point.system.nodes is None else inflow
        return MeasureSlopes(forces=forces, channels=channels, parts=parts, nodes=nodes)


class Adjoint(_Linear):
    """The linearised trim of a converged solution: the gradient of any measure by the pitch along the blade."""

    def __init__(self, solution: Solution, linear: LinearisedTrim) -> None:
        """Of `rotor.trim.Analysis`."""
        self.solution, start = solution, solution.start
        same = start.structure == linear.point.system.structure.name
        super().__init__(linear, start.box if same else None, solution.passes)

    def by_pitch(self, weights: ElementSlopes | Terms) -> Array:
        """∂(measure)/∂θ of each element's pitch, trim and inflow following, (elements,).

        Of weighted fields, or of a sum of terms of the trim's own equations.
        """
        with one_blas_thread():
            of_terms = isinstance(weights, Terms)
            gradient, by_channel = self.slopes(
                MeasureSlopes(terms=weights) if of_terms else self.measure(weights)
            )
            joined = joined_hover(self.solution.design)
            if joined is None:
                return gradient
            return gradient + self._by_difference(
                *joined, ElementSlopes() if of_terms else weights, by_channel
            )

    def _by_difference(
        self, share: float, difference: HoverDifference, weights: ElementSlopes, by_channel: Array
    ) -> Array:
        """The part of the gradient through the hovering rotor, whose inflow is carried over to low speed."""
        shape = self.problem.disk.shape
        on_inflow = share * (by_channel[UP] + np.broadcast_to(weights.inflow, shape).sum(axis=1))
        on_swirl = share * (np.broadcast_to(weights.swirl, shape).sum(axis=1) - by_channel[UT])
        around = np.ones(shape) / shape[1]
        hovering = ElementSlopes(
            fz=-(on_inflow @ difference.axial)[:, None] * around,
            inflow=on_inflow[:, None] * around,
            u_t=-(on_inflow @ difference.by_speed)[:, None] * around,
            swirl=on_swirl[:, None] * around,
        )
        adjoint = _difference_adjoint(difference)
        return adjoint.slopes(adjoint.measure(hovering))[0]


@bytes_cache
def _difference_adjoint(difference: HoverDifference) -> _Linear:
    """Adjoint for all measures, and for all conditions that share the hovering rotor."""
    return _Linear(difference.hover.linear)


def power_along(adjoint: Adjoint, objective: Objective = "total") -> PitchGradient:
    """Gradient of the power from an adjoint that is used for other measures as well.

    Main-rotor power is induced and profile power and D·V, which no twist changes; on a stand it is the shaft's.
    Raises RuntimeError for the total power of a free rotor, which is zero.
    """
    problem = adjoint.problem
    if problem.design.models.trim == "free-rotor" and objective == "total":
        raise RuntimeError(
            "A free rotor takes no power from its shaft, so shaft power has no gradient: use the objective induced, or "
            "trim wind-tunnel."
        )
    if objective == "induced":
        by_element = adjoint.by_pitch(adjoint.induced_weights)
    else:
        by_element = adjoint.by_pitch(adjoint.total_terms) * tail_gain(adjoint.solution)
    by_element = by_element * problem.design.power_unit
    return PitchGradient(problem.disk.r, problem.disk.dr, by_element)


def tail_gain(solution: Solution) -> float:
    """Total power per watt at the shaft [W/W], the tail rotor included; 1 on a stand."""
    return 1.0 + tail_power(solution.design, solution.last_power.main_rotor)[1]
