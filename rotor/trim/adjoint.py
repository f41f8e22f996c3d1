"""The exact gradient of power by the pitch at every blade station: one linear solve, whatever the number of stations.

The trim makes residuals R(x, d, λ) zero and the inflow answers λ = A d + b. The adjoint takes from what the loads do to
a measure P what the trim gives back: with a = J⁻ᵀ ∂P/∂x, weights w = ∂P/∂F − a·∂R/∂F on the loads, and the inflow's
answer u = Aᵀ(I − K Aᵀ)⁻¹(K w_z + ∂F_x/∂λ w_x + ∂P/∂λ),

    dP/dθ(r) = Σ_ψ [ (w_z + u) ∂F_z/∂θ + w_x ∂F_x/∂θ + ∂P/∂θ ].

The chain rule then gives the gradient by any twist parameter: dP/dp = Σ_r dP/dθ(r) ∂θ_tw(r)/∂p.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from rotor.aero import kernel
from rotor.aero.elements import COLLECTIVE, CYCLIC_1C, CYCLIC_1S, Pass, Problem, lay_out, run_pass
from rotor.aero.inflow.interface import InflowFeedback
from rotor.aero.sums import Slopes, slopes, unweigh, velocity_columns
from rotor.arrays import Array
from rotor.blas_threads import one_blas_thread
from rotor.trim.equations import combine_sums, jacobian, unknowns_of
from rotor.trim.forward import guess_of
from rotor.trim.hover import Annuli
from rotor.trim.power import tail_power
from rotor.trim.solution import Solution

Objective = Literal["total", "induced"]


@dataclass(frozen=True, eq=False)
class PitchGradient:
    """How power answers to pitch along the blade, trim and inflow following."""

    r: Array
    """Element centres y/R, (elements,)."""
    dr: float
    """Element width over R."""
    by_element: Array
    """∂P/∂θ of each element's pitch [W/rad], (elements,)."""

    @property
    def density(self) -> Array:
        """∂P/∂θ per unit of r [W/rad], (elements,): what a picture shows, whatever the grid."""
        return self.by_element / self.dr

    def along(self, twist_slopes: Array) -> Array:
        """∂P by twist parameters, from ∂θ_tw(r)/∂p, (parameters, elements) → (parameters,)."""
        return twist_slopes @ self.by_element


@dataclass(frozen=True, eq=False)
class Weights:
    """How a measure answers to each element: its derivatives by what it is made of, (elements, azimuths) or 0."""

    lift: Array | float = 0.0
    """By F_z."""
    push: Array | float = 0.0
    """By F_x."""
    inflow: Array | float = 0.0
    """By λ_i at the same velocities."""
    pitch: Array | float = 0.0
    """By θ at the same loads, as the next two."""
    across: Array | float = 0.0
    """By U_T."""
    down: Array | float = 0.0
    """By U_P."""


class Adjoint:
    """A converged solution, ready to say how any measure of it answers to the pitch along the blade."""

    def __init__(self, solution: Solution) -> None:
        """Raises RuntimeError with the solution's sentence when it is not converged."""
        solution.require()
        self.solution = solution
        self.problem: Problem = lay_out(solution.design)
        self._annuli: Array | None = None
        if solution.design.hovering:
            self.one, self._annuli = Annuli(self.problem).at(solution.controls.collective)
        else:
            guess = guess_of(solution)
            self.one: Pass = run_pass(self.problem, guess.state, guess.induced)

    def by_pitch(self, weights: Weights) -> Array:
        """∂(measure)/∂θ of each element's pitch, trim and inflow following, (elements,)."""
        return self._forward(weights) if self._annuli is None else self._in_hover(weights, self._annuli)

    @cached_property
    def _linear(self) -> tuple[Slopes, InflowFeedback | None, Array]:
        """What the unknowns do to the pass, the inflow's loop, and the Jacobian of the trim."""
        problem, one = self.problem, self.one
        loop = (
            one.response.feedback(one.loads[kernel.FZ_UP]) if problem.inflow.load_dependent and one.response else None
        )
        made = slopes(problem, one, unknowns_of(problem.design.models), loop)
        return made, loop, jacobian(problem, one, made)

    def _forward(self, weights: Weights) -> Array:
        problem, one, loads = self.problem, self.one, self.one.loads
        made, loop, matrix = self._linear
        by_unknown = _dot(made.lift, weights.lift) + _dot(made.push, weights.push)
        answer = weights.inflow + weights.down
        if made.inflow is not None:
            by_unknown += _dot(made.inflow, answer)
        disk = problem.disk
        turned = {COLLECTIVE: np.ones_like(disk.cos), CYCLIC_1C: disk.cos, CYCLIC_1S: disk.sin}
        for k, unknown in enumerate(made.unknowns):
            if unknown in turned:
                by_unknown[k] += float(np.sum(weights.pitch * turned[unknown]))
            else:
                across, down = velocity_columns(problem, one, unknown)
                by_unknown[k] += float(np.sum(weights.across * across + weights.down * down))

        given_back = np.linalg.solve(matrix.T, by_unknown)
        on_lift, on_push = unweigh(problem, one, given_back @ combine_sums(problem, one, np.eye(5)))
        lift, push = weights.lift - on_lift, weights.push - on_push
        if loop is not None and one.response is not None:
            back = loads[kernel.FZ_UP] * lift + loads[kernel.FX_UP] * push + answer
            lift = lift + one.response.apply_transposed(loop.solve_transposed(back))
        return (lift * loads[kernel.FZ_THETA] + push * loads[kernel.FX_THETA] + weights.pitch).sum(axis=1)

    def _in_hover(self, weights: Weights, annuli: Array) -> Array:
        """Annuli stand alone but for the collective that keeps the thrust. `annuli`: ∂λ/∂θ of each."""
        loads, answer = self.one.loads, annuli[:, None]
        lift = loads[kernel.FZ_THETA] + loads[kernel.FZ_UP] * answer
        push = loads[kernel.FX_THETA] + loads[kernel.FX_UP] * answer
        measure = weights.lift * lift + weights.push * push + (weights.inflow + weights.down) * answer + weights.pitch
        thrust = lift.sum(axis=1)
        by_pitch = np.broadcast_to(measure, lift.shape).sum(axis=1)
        return by_pitch - by_pitch.sum() / thrust.sum() * thrust


def power_gradient(solution: Solution, objective: Objective = "total") -> PitchGradient:
    """∂P/∂θ(r) of a converged solution, for total power or for induced power alone.

    Raises RuntimeError with the solution's sentence when it is not converged.
    """
    return power_along(Adjoint(solution), objective)


@one_blas_thread()
def power_along(adjoint: Adjoint, objective: Objective = "total") -> PitchGradient:
    """The same from an adjoint that serves other measures as well.

    Main-rotor power is Σ (λ_i dF_z + U dD) + D·V, and U dD = U_T dF_x − U_P dF_z.
    """
    problem, one = adjoint.problem, adjoint.one
    cell = problem.disk.dr / len(problem.disk.psi)
    lift, push = one.loads[kernel.FZ], one.loads[kernel.FX]
    if objective == "induced":
        weights, gain = Weights(lift=cell * one.induced, inflow=cell * lift), 1.0
    else:
        weights = Weights(
            lift=cell * (one.induced - one.u_p),
            push=cell * one.u_t,
            inflow=cell * lift,
            across=cell * push,
            down=-cell * lift,
        )
        gain = _tail_gain(adjoint.solution)
    by_element = adjoint.by_pitch(weights) * gain * problem.design.power_unit
    return PitchGradient(problem.disk.r, problem.disk.dr, by_element)


def _tail_gain(solution: Solution) -> float:
    """What one watt at the shaft costs in all, the tail rotor included."""
    return 1.0 + tail_power(solution.design, solution.last_power.main_rotor)[1]


def _dot(stack: Array, weight: Array | float) -> Array:
    """Σ over the disk of a stack of fields times a weight, (stack,)."""
    return np.tensordot(stack, weight, 2) if isinstance(weight, np.ndarray) else weight * stack.sum(axis=(1, 2))
