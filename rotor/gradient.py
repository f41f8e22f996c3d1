"""The exact gradient of power by the pitch at every blade station: one linear solve, whatever the number of stations.

The trim makes residuals R(x, d, λ) zero and the inflow answers λ = A d + b. The adjoint takes from what the loads do to
power what the trim gives back: with a = J⁻ᵀ ∂P/∂x, weights w = ∂P/∂F − a·∂R/∂F on the loads, and the inflow's answer
u = Aᵀ(I − K Aᵀ)⁻¹(K w_z + ∂F_x/∂λ w_x + ∂P/∂λ),

    dP/dθ(r) = Σ_ψ [ (w_z + u) ∂F_z/∂θ + w_x ∂F_x/∂θ ].

The chain rule then gives the gradient by any twist parameter: dP/dp = Σ_r dP/dθ(r) ∂θ_tw(r)/∂p.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rotor import kernel
from rotor.elements import Pass, Problem, lay_out, run_pass
from rotor.equilibrium import UNKNOWNS, combine_sums, jacobian
from rotor.hover import Annuli
from rotor.solution import Solution
from rotor.sums import slopes, unweigh, velocity_columns
from rotor.tail_rotor import FIXED_SHARE
from rotor.trim import guess_of

Array = NDArray[np.float64]

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
class _Weights:
    """∂P by F_z, F_x and λ_i, fields in units of power_unit."""

    lift: Array
    push: Array
    inflow: Array
    gain: float
    """What one watt at the shaft costs in all, the tail rotor included."""


def power_gradient(solution: Solution, objective: Objective = "total") -> PitchGradient:
    """∂P/∂θ(r) of a converged solution, for total power or for induced power alone.

    Raises RuntimeError with the solution's sentence when it is not converged.
    """
    solution.require()
    problem = lay_out(solution.design)
    by_element = (
        _in_hover(problem, solution, objective) if solution.design.hovering else _forward(problem, solution, objective)
    )
    return PitchGradient(problem.disk.r, problem.disk.dr, by_element * solution.design.power_unit)


def _weights(problem: Problem, one: Pass, solution: Solution, objective: Objective) -> _Weights:
    """Main-rotor power is Σ (λ_i dF_z + U dD) + D·V, and U dD = U_T dF_x − U_P dF_z."""
    cell = problem.disk.dr / len(problem.disk.psi)
    if objective == "induced":
        nothing = np.zeros_like(one.theta)
        return _Weights(cell * one.induced, nothing, cell * one.loads[kernel.FZ], 1.0)
    design = solution.design
    gain = 1.0 + FIXED_SHARE
    if design.models.tail_rotor_solved:
        torque = solution.power.main_rotor / design.rotor.angular_speed
        _, slope = design.tail_rotor.power(torque, design.airspeed, design.condition.density)
        gain = 1.0 + slope / design.rotor.angular_speed
    # λ_i adds F_z as induced power and takes it away again as dissipation.
    return _Weights(cell * (one.induced - one.u_p), cell * one.u_t, np.zeros_like(one.theta), gain)


def _forward(problem: Problem, solution: Solution, objective: Objective) -> Array:
    guess = guess_of(solution)
    one = run_pass(problem, guess.state, guess.induced)
    loads = one.loads
    unknowns = UNKNOWNS[problem.design.models.trim]
    reacts = problem.inflow.reacts and one.response is not None
    loop = one.response.loop(loads[kernel.FZ_UP]) if reacts and one.response is not None else None
    made = slopes(problem, one, unknowns, loop)

    weights = _weights(problem, one, solution, objective)
    by_unknown = np.tensordot(made.lift, weights.lift, 2) + np.tensordot(made.push, weights.push, 2)
    if made.inflow is not None:
        by_unknown += np.tensordot(made.inflow, weights.inflow, 2)
    if objective == "total":
        cell = problem.disk.dr / len(problem.disk.psi)
        for k, unknown in enumerate(unknowns):
            across, down = velocity_columns(problem, one, unknown)
            by_unknown[k] += cell * float((loads[kernel.FX] * across - loads[kernel.FZ] * down).sum())

    adjoint = np.linalg.solve(jacobian(problem, one, made).T, by_unknown)
    on_lift, on_push = unweigh(problem, one, adjoint @ combine_sums(problem, one, np.eye(5)))
    lift, push = weights.lift - on_lift, weights.push - on_push
    if loop is not None and one.response is not None:
        back = loads[kernel.FZ_UP] * lift + loads[kernel.FX_UP] * push + weights.inflow
        lift = lift + one.response.drive_transposed(loop.solve_transposed(back))
    return weights.gain * (lift * loads[kernel.FZ_THETA] + push * loads[kernel.FX_THETA]).sum(axis=1)


def _in_hover(problem: Problem, solution: Solution, objective: Objective) -> Array:
    """Annuli stand alone but for the collective that keeps the thrust."""
    one, answer = Annuli(problem).at(solution.controls.collective)
    loads = one.loads
    weights = _weights(problem, one, solution, objective)
    lift = loads[kernel.FZ_THETA] + loads[kernel.FZ_UP] * answer[:, None]
    push = loads[kernel.FX_THETA] + loads[kernel.FX_UP] * answer[:, None]
    power = weights.lift * lift + weights.push * push + weights.inflow * answer[:, None]
    thrust = lift.sum(axis=1)
    by_pitch = power.sum(axis=1)
    return weights.gain * (by_pitch - by_pitch.sum() / thrust.sum() * thrust)
