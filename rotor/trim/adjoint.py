"""The exact gradient of power by the pitch at every blade station: one linear solve for any number of stations.

The trim makes the residuals R(x, d, λ) zero, and the inflow is λ = A d + b. For an elastic blade R and x include the
torsion equations and their coordinates. For a measure P, with a = J⁻ᵀ ∂P/∂x, the weights w = ∂P/∂F − a·∂R/∂F on the
loads, and the part u = Aᵀ(I − K Aᵀ)⁻¹(K w_z + ∂F_x/∂λ w_x + ∂P/∂λ) of the inflow,

    dP/dθ(r) = Σ_ψ [ (w_z + u) ∂F_z/∂θ + w_x ∂F_x/∂θ + ∂P/∂θ ].

The chain rule then gives the gradient by any twist parameter: dP/dp = Σ_r dP/dθ(r) ∂θ_tw(r)/∂p.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, Literal

import numpy as np

from rotor.aero import kernel
from rotor.aero.elements import BladeElements, Problem, evaluate_elements
from rotor.aero.free_wake.system import WakeState
from rotor.aero.sums import radial_drag
from rotor.arrays import Array
from rotor.blas_threads import one_blas_thread
from rotor.compiled import compiled
from rotor.trim.forward import guess_of
from rotor.trim.hover import Annuli, AnnulusSlopes
from rotor.trim.hover_wake import LineWeights, WakeAdjoint
from rotor.trim.low_speed import HoverDifference, HoverMatched, trim_problem
from rotor.trim.newton import KEPT, KeptTrim, differentiate
from rotor.trim.power import tail_power
from rotor.trim.solution import Solution
from rotor.trim.transposed import BY_INFLOW, BY_THETA, BY_UT, TENSION, Given, TransposedTrim

Objective = Literal["total", "induced"]


@dataclass(frozen=True, eq=False)
class PitchGradient:
    """Change of power with pitch along the blade; trim and inflow adjust."""

    r: Array
    """Element centres y/R, (elements,)."""
    dr: float
    """Element width over R."""
    by_element: Array
    """∂P/∂θ of each element's pitch [W/rad], (elements,)."""

    @property
    def density(self) -> Array:
        """∂P/∂θ per unit of r [W/rad], (elements,), independent of the grid."""
        return self.by_element / self.dr

    def along(self, twist_slopes: Array) -> Array:
        """∂P by twist parameters, from ∂θ_tw(r)/∂p, (parameters, elements) → (parameters,)."""
        return twist_slopes @ self.by_element


@dataclass(frozen=True, eq=False)
class Weights:
    """Derivatives of a measure at each element, (elements, azimuths) or 0."""

    fz: Array | float = 0.0
    """By F_z."""
    fx: Array | float = 0.0
    """By F_x."""
    inflow: Array | float = 0.0
    """By λ_i at the same velocities."""
    theta: Array | float = 0.0
    """By θ at the same loads, as the next two."""
    u_t: Array | float = 0.0
    """By U_T."""
    u_p: Array | float = 0.0
    """By U_P."""
    u_r: Array | float = 0.0
    """By U_R, the flow along the blade."""
    swirl: Array | float = 0.0
    """By the swirl at the same velocities."""
    tilt: float = 0.0
    """By the shaft tilt at the same loads and velocities."""

    def on(self, shape: tuple[int, int]) -> Given:
        """As `TransposedTrim.with_nearby` takes them."""
        given = {name: getattr(self, name) for name in Given._fields}
        return Given(**{name: _on(field, shape) for name, field in given.items() if not isinstance(field, float)})


def _on(field: Array, shape: tuple[int, int]) -> Array:
    """A field for compiled code: itself where it may."""
    return field if field.shape == shape and field.flags.c_contiguous else np.broadcast_to(field, shape).copy()


class HoverAdjoint:
    """The linearised balance of a hovering rotor: annuli, or a free wake."""

    def __init__(self, problem: Problem, collective: float, elastic: Array | None, wake: WakeState | None) -> None:
        """elastic: coordinates of the elastic twist, (modes, functions); wake: the unknowns of a free wake."""
        self.problem = problem
        self._annuli: tuple[Array, AnnulusSlopes | None] | None = None
        self._wake: WakeAdjoint | None = None
        if wake is not None:
            self._wake = WakeAdjoint(problem, wake, elastic[:, 0] if elastic is not None else None)
            self.elements: BladeElements = self._wake.elements
            return
        annuli = Annuli(problem)
        if elastic is not None:
            annuli.elastic = elastic[:, 0]
        self.elements, response, twisting = annuli.at(collective)
        self._annuli = response, twisting

    def by_pitch(self, weights: Weights) -> Array:
        """∂(measure)/∂θ of each element's pitch, the balance following, (elements,)."""
        if self._wake is not None:
            return self._with_free_wake(weights, self._wake)
        assert self._annuli is not None
        return self._in_hover(weights, *self._annuli)

    def _with_free_wake(self, weights: Weights, wake: WakeAdjoint) -> Array:
        shape = self.problem.disk.shape
        fields = (weights.fz, weights.fx, weights.inflow, weights.u_t, weights.u_p, weights.swirl, weights.theta)
        return wake.by_pitch(LineWeights(*(np.broadcast_to(field, shape).sum(axis=1) for field in fields)))

    def _in_hover(self, weights: Weights, annuli: Array, slopes: AnnulusSlopes | None) -> Array:
        """Annuli are independent but for the collective that keeps the thrust, and the twist of an elastic blade.

        `annuli`: ∂λ/∂θ of each.
        """
        loads, inflow = self.elements.loads, annuli[:, None]
        turning = Annuli(self.problem).swirl(self.elements.induced[:, 0])[1][:, None] * inflow
        fz = loads[kernel.FZ_THETA] + loads[kernel.FZ_UP] * inflow - loads[kernel.FZ_UT] * turning
        fx = loads[kernel.FX_THETA] + loads[kernel.FX_UP] * inflow - loads[kernel.FX_UT] * turning
        measure = weights.fz * fz + weights.fx * fx + (weights.inflow + weights.u_p) * inflow + weights.theta
        measure = measure + (weights.swirl - weights.u_t) * turning
        thrust = fz.sum(axis=1)
        by_pitch = np.broadcast_to(measure, fz.shape).sum(axis=1)
        stand = self.problem.design.condition.stand
        given = stand is not None and stand.collective is not None
        torsion = self.problem.torsion
        if slopes is None or torsion is None:
            return by_pitch if given else by_pitch - by_pitch.sum() / thrust.sum() * thrust
        by_unknown: Array = slopes.columns @ by_pitch
        adjoint: Array = np.zeros(len(by_unknown))
        free = slice(1 if given else 0, None)  # With the collective given, the thrust follows the pitch.
        adjoint[free] = np.linalg.solve(slopes.matrix[free, free].T, by_unknown[free])
        balance = slopes.torsion + torsion.gain[:, None] * torsion.tension
        return by_pitch - adjoint[0] * slopes.thrust - adjoint[1:] @ balance


class Adjoint:
    """The linearised trim of a converged solution: the gradient of any measure by the pitch along the blade."""

    def __init__(self, solution: Solution) -> None:
        """Raises RuntimeError with the solution's sentence when it is not converged."""
        solution.require()
        self.solution = solution
        self._hover: HoverAdjoint | None = None
        self._kept = kept = KEPT.of(solution.disk.induced)
        same = kept is not None and kept.problem is not None and kept.problem.design is solution.design
        self.problem: Problem = kept.problem if kept and kept.problem and same else trim_problem(solution.design)
        guess = guess_of(solution)
        with one_blas_thread():
            if solution.design.hovering:
                wake = solution.wake and solution.wake.state
                self._hover = HoverAdjoint(self.problem, guess.state.collective, guess.elastic, wake)
                self.elements: BladeElements = self._hover.elements
            elif self._kept is not None and self._kept.elements is not None:
                self.elements = self._kept.elements
            else:
                self.elements = evaluate_elements(self.problem, guess.state, guess.induced, guess.elastic)

    def by_pitch(self, weights: Weights) -> Array:
        """∂(measure)/∂θ of each element's pitch, trim and inflow following, (elements,)."""
        with one_blas_thread():
            return self._forward(weights) if self._hover is None else self._hover.by_pitch(weights)

    @cached_property
    def _transposed(self) -> TransposedTrim:
        return TransposedTrim(self.problem, self.elements)

    def _forward(self, weights: Weights) -> Array:
        problem, trim = self.problem, self._transposed
        shape = problem.disk.shape
        swirl = np.broadcast_to(weights.swirl, shape).sum(axis=1)
        slopes = self._slopes(weights.on(shape), trim.direct(swirl, weights.tilt))
        found = slopes[BY_THETA] + slopes[TENSION]
        if not isinstance(problem.inflow, HoverMatched):
            return found
        return found + self._by_difference(problem.inflow, slopes[BY_INFLOW], swirl - slopes[BY_UT])

    def _slopes(self, given: Given, direct: Array) -> Array:
        """As `TransposedTrim.with_nearby`, with the derivatives kept or, where these do not serve, with new ones."""
        problem, trim, kept = self.problem, self._transposed, self._kept
        near = kept.derivatives if kept is not None else None
        if near is not None and near.serve(problem, trim.unknowns):
            found = trim.with_nearby(near, given, direct)
            if found is not None:
                return found
        exact = differentiate(problem, self.elements, trim.unknowns)[1]
        self._kept = KeptTrim(self.solution.disk.induced, exact, self.elements, problem)
        KEPT.keep(self._kept)
        return trim.with_own(exact, given, direct)

    def _by_difference(self, inflow: HoverMatched, on_inflow: Array, on_swirl: Array) -> Array:
        """The part of the gradient through the hovering rotor, whose inflow is carried over to low speed."""
        difference, share = inflow.difference, inflow.share
        fz, by_inflow, by_swirl = difference.by_hover(share * on_inflow, share * on_swirl)
        return _hover_adjoint(difference).by_pitch(Weights(fz=fz, inflow=by_inflow, swirl=by_swirl))


@lru_cache(maxsize=4)
def _hover_adjoint(difference: HoverDifference) -> HoverAdjoint:
    """The same for all measures, and for all conditions that share the hovering rotor."""
    torsion = difference.elements.torsion
    return HoverAdjoint(
        difference.problem,
        difference.elements.state.collective,
        torsion.coordinates if torsion is not None else None,
        difference.wake,
    )


def power_gradient(solution: Solution, objective: Objective = "total") -> PitchGradient:
    """∂P/∂θ(r) of a converged solution, for total power or for induced power alone.

    Raises RuntimeError with the solution's sentence when it is not converged.
    """
    return power_along(Adjoint(solution), objective)


def power_along(adjoint: Adjoint, objective: Objective = "total") -> PitchGradient:
    """The same from an adjoint that is used for other measures as well.

    Main-rotor power is Σ (λ_i dF_z + u dF_x + U dD) + D·V, and U dD = U_T dF_x − U_P dF_z + U_R dF_r.
    Raises RuntimeError for the total power of a free rotor, which is zero.
    """
    problem, elements = adjoint.problem, adjoint.elements
    cell = problem.disk.dr / len(problem.disk.psi)
    fz, fx = elements.loads[kernel.FZ], elements.loads[kernel.FX]
    on_stand = problem.design.condition.stand is not None
    if problem.design.models.trim == "free-rotor" and objective == "total":
        raise RuntimeError(
            "A free rotor takes no power from its shaft, so shaft power has no gradient: use the objective induced, or "
            "trim wind-tunnel."
        )
    if on_stand and objective == "total":  # The mount takes any force: power is the shaft's, Σ r dF_x.
        weights = Weights(fx=cell * problem.disk.r[:, None] + 0.0 * fx)
        gain = 1.0
    elif objective == "induced":
        weights = Weights(
            fz=cell * elements.induced, fx=cell * elements.swirl[:, None] + 0.0 * fx, inflow=cell * fz, swirl=cell * fx
        )
        gain = 1.0
    else:
        by_fz, by_fx, lift, drag, lifted = _power_weights(
            elements.u_t, elements.u_p, elements.induced, elements.swirl, fz, fx, cell
        )
        weights = Weights(
            fz=by_fz,
            fx=by_fx,
            inflow=lift,
            u_t=drag,
            u_p=lifted,
            swirl=drag,
            tilt=-elements.flow.mu_z * _radial_dissipation_slope(adjoint),
        )
        gain = _tail_gain(adjoint.solution)
    by_element = adjoint.by_pitch(weights) * gain * problem.design.power_unit
    return PitchGradient(problem.disk.r, problem.disk.dr, by_element)


@compiled(error_model="numpy", fastmath={"contract"})
def _power_weights(u_t: Any, u_p: Any, induced: Any, swirl: Any, fz: Any, fx: Any, cell: float) -> Any:
    """Slopes of power by F_z, F_x, λ_i, U_T and U_P at the same F_z and F_x, (5, elements, azimuths)."""
    n, m = fz.shape
    out = np.empty((5, n, m))
    for i in range(n):
        for j in range(m):
            out[0, i, j] = cell * (induced[i, j] - u_p[i, j])
            out[1, i, j] = cell * (u_t[i, j] + swirl[i])
        for j in range(m):
            out[2, i, j] = cell * fz[i, j]
            out[3, i, j] = cell * fx[i, j]
            out[4, i, j] = -cell * fz[i, j]
    return out


def _radial_dissipation_slope(adjoint: Adjoint) -> float:
    """Slope of Σ U_R dF_r by µ_x, over ρA(ΩR)²: U_R = µ_x cos ψ."""
    problem, friction = adjoint.problem, adjoint.elements.friction
    if friction is None:
        return 0.0
    by_speed = radial_drag(problem, friction.radial_slope)
    return radial_drag(problem, friction.radial) + adjoint.elements.flow.mu_x * by_speed


def _tail_gain(solution: Solution) -> float:
    """Total power per watt at the shaft, the tail rotor included."""
    return 1.0 + tail_power(solution.design, solution.last_power.main_rotor)[1]
