"""The exact gradient of power by the pitch at every blade station: one linear solve for any number of stations.

The trim makes the residuals R(x, d, λ) zero, and the inflow is λ = A d + b. For a measure P, with a = J⁻ᵀ ∂P/∂x, the
weights w = ∂P/∂F − a·∂R/∂F on the loads, and the part u = Aᵀ(I − K Aᵀ)⁻¹(K w_z + ∂F_x/∂λ w_x + ∂P/∂λ) of the inflow,

    dP/dθ(r) = Σ_ψ [ (w_z + u) ∂F_z/∂θ + w_x ∂F_x/∂θ + ∂P/∂θ ].

The chain rule then gives the gradient by any twist parameter: dP/dp = Σ_r dP/dθ(r) ∂θ_tw(r)/∂p.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from rotor.aero import kernel
from rotor.aero.elements import BladeElements, Problem, build_problem, evaluate_elements
from rotor.aero.inflow.interface import InflowFeedback
from rotor.aero.sums import Slopes, integrate_transposed, slopes, velocity_slopes
from rotor.arrays import Array
from rotor.blas_threads import one_blas_thread
from rotor.trim.equations import combine_sums, jacobian, unknowns_of
from rotor.trim.forward import guess_of
from rotor.trim.hover import Annuli
from rotor.trim.newton import inflow_feedback
from rotor.trim.power import tail_power
from rotor.trim.solution import Solution

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


class Adjoint:
    """The linearised trim of a converged solution: the gradient of any measure by the pitch along the blade."""

    def __init__(self, solution: Solution) -> None:
        """Raises RuntimeError with the solution's sentence when it is not converged."""
        solution.require()
        self.solution = solution
        self.problem: Problem = build_problem(solution.design)
        self._annuli: Array | None = None
        if solution.design.hovering:
            with one_blas_thread():
                self.elements, self._annuli = Annuli(self.problem).at(solution.controls.collective)
        else:
            guess = guess_of(solution)
            with one_blas_thread():
                self.elements: BladeElements = evaluate_elements(self.problem, guess.state, guess.induced)

    def by_pitch(self, weights: Weights) -> Array:
        """∂(measure)/∂θ of each element's pitch, trim and inflow following, (elements,)."""
        with one_blas_thread():
            return self._forward(weights) if self._annuli is None else self._in_hover(weights, self._annuli)

    @cached_property
    def _linear(self) -> tuple[Slopes, InflowFeedback | None, Array]:
        """Derivatives by the unknowns, the feedback of the inflow, and the Jacobian of the trim."""
        problem, elements = self.problem, self.elements
        feedback = inflow_feedback(problem, elements)
        by_unknown = slopes(problem, elements, unknowns_of(problem.design.models), feedback)
        return by_unknown, feedback, jacobian(problem, elements, by_unknown)

    def _forward(self, weights: Weights) -> Array:
        problem, elements, loads = self.problem, self.elements, self.elements.loads
        by_unknown, feedback, matrix = self._linear
        measure = _dot(by_unknown.fz, weights.fz) + _dot(by_unknown.fx, weights.fx)
        by_inflow = weights.inflow + weights.u_p
        if by_unknown.inflow is not None:
            measure += _dot(by_unknown.inflow, by_inflow)
        disk = problem.disk
        pitch = {"collective": np.ones_like(disk.cos), "cyclic_1c": disk.cos, "cyclic_1s": disk.sin}
        for k, unknown in enumerate(by_unknown.unknowns):
            if unknown in pitch:
                measure[k] += float(np.sum(weights.theta * pitch[unknown]))
            else:
                u_t, u_p = velocity_slopes(problem, elements, unknown)
                measure[k] += float(np.sum(weights.u_t * u_t + weights.u_p * u_p))

        adjoint = np.linalg.solve(matrix.T, measure)
        trim_fz, trim_fx = integrate_transposed(problem, elements, adjoint @ combine_sums(problem, elements, np.eye(5)))
        fz, fx = weights.fz - trim_fz, weights.fx - trim_fx
        if feedback is not None and elements.response is not None:
            source = loads[kernel.FZ_UP] * fz + loads[kernel.FX_UP] * fx + by_inflow
            fz = fz + elements.response.apply_transposed(feedback.solve_transposed(source))
        return (fz * loads[kernel.FZ_THETA] + fx * loads[kernel.FX_THETA] + weights.theta).sum(axis=1)

    def _in_hover(self, weights: Weights, annuli: Array) -> Array:
        """Annuli are independent but for the collective that keeps the thrust. `annuli`: ∂λ/∂θ of each."""
        loads, inflow = self.elements.loads, annuli[:, None]
        fz = loads[kernel.FZ_THETA] + loads[kernel.FZ_UP] * inflow
        fx = loads[kernel.FX_THETA] + loads[kernel.FX_UP] * inflow
        measure = weights.fz * fz + weights.fx * fx + (weights.inflow + weights.u_p) * inflow + weights.theta
        thrust = fz.sum(axis=1)
        by_pitch = np.broadcast_to(measure, fz.shape).sum(axis=1)
        return by_pitch - by_pitch.sum() / thrust.sum() * thrust


def power_gradient(solution: Solution, objective: Objective = "total") -> PitchGradient:
    """∂P/∂θ(r) of a converged solution, for total power or for induced power alone.

    Raises RuntimeError with the solution's sentence when it is not converged.
    """
    return power_along(Adjoint(solution), objective)


def power_along(adjoint: Adjoint, objective: Objective = "total") -> PitchGradient:
    """The same from an adjoint that is used for other measures as well.

    Main-rotor power is Σ (λ_i dF_z + U dD) + D·V, and U dD = U_T dF_x − U_P dF_z.
    """
    problem, elements = adjoint.problem, adjoint.elements
    cell = problem.disk.dr / len(problem.disk.psi)
    fz, fx = elements.loads[kernel.FZ], elements.loads[kernel.FX]
    if objective == "induced":
        weights, gain = Weights(fz=cell * elements.induced, inflow=cell * fz), 1.0
    else:
        weights = Weights(
            fz=cell * (elements.induced - elements.u_p),
            fx=cell * elements.u_t,
            inflow=cell * fz,
            u_t=cell * fx,
            u_p=-cell * fz,
        )
        gain = _tail_gain(adjoint.solution)
    by_element = adjoint.by_pitch(weights) * gain * problem.design.power_unit
    return PitchGradient(problem.disk.r, problem.disk.dr, by_element)


def _tail_gain(solution: Solution) -> float:
    """Total power per watt at the shaft, the tail rotor included."""
    return 1.0 + tail_power(solution.design, solution.last_power.main_rotor)[1]


def _dot(stack: Array, weight: Array | float) -> Array:
    """Σ over the disk of a stack of fields times a weight, (stack,)."""
    return np.tensordot(stack, weight, 2) if isinstance(weight, np.ndarray) else weight * stack.sum(axis=(1, 2))
