"""Sums over the disk, and their exact derivatives by the trim unknowns.

A trim unknown acts on a blade element only through θ, U_T, U_P and the loss factor: collective and cyclic are columns
in θ; coning and flapping are columns in U_P; tilt and λ0 change the velocities and the inflow. The response of the
inflow to the changed load is added where the model is load-dependent.
"""

from dataclasses import dataclass

import numpy as np

from rotor.aero import kernel
from rotor.aero.elements import BladeElements, Problem, by_tilt_and_lambda0, wake_at
from rotor.aero.inflow.interface import InflowFeedback
from rotor.aero.trim_state import Unknown
from rotor.arrays import Array


@dataclass(frozen=True)
class DiskSums:
    """Sums over the disk, as coefficients of ρA(ΩR)²."""

    thrust: float
    """C_T along the shaft, eq. (3.12)."""
    drag: float
    """C_H, aft in the hub plane: Σ (dF_x sin ψ − β dF_z cos ψ)."""
    moment: tuple[float, float, float]
    """Flap moment Σ (r − e) dF_z: mean, cos ψ and sin ψ parts."""


def disk_sums(problem: Problem, elements: BladeElements) -> DiskSums:
    """Thrust, H-force and flap moments."""
    loads = elements.loads
    thrust, drag, *moments = integrate(problem, elements, loads[kernel.FZ][None], loads[kernel.FX][None])[:, 0].tolist()
    return DiskSums(thrust, drag, (moments[0], moments[1], moments[2]))


def integrate(problem: Problem, elements: BladeElements, fz: Array, fx: Array) -> Array:
    """(C_T, C_H, M0, M1c, M1s) of stacks of F_z and F_x fields, (5, stack): the sums are linear in the loads."""
    disk = problem.disk
    n = len(disk.psi)
    thrust = disk.dr * fz.sum(axis=1)
    moment = disk.dr * ((disk.r - problem.flap.hinge) @ fz)
    drag = (disk.dr * fx.sum(axis=1) @ disk.sin - (elements.beta * thrust) @ disk.cos) / n
    cosine, sine = 2.0 * (moment @ disk.cos) / n, 2.0 * (moment @ disk.sin) / n
    return np.stack([thrust.mean(axis=1), drag, moment.mean(axis=1), cosine, sine])


def integrate_transposed(problem: Problem, elements: BladeElements, weights: Array) -> tuple[Array, Array]:
    """The transpose of `integrate`: ∂(weights · (C_T, C_H, M0, M1c, M1s)) by F_z and by F_x, (elements, azimuths)."""
    disk = problem.disk
    arm = (disk.r - problem.flap.hinge)[:, None]
    thrust, drag, mean, cosine, sine = weights.tolist()
    moment = arm * (mean + 2.0 * (cosine * disk.cos + sine * disk.sin))
    cell = disk.dr / len(disk.psi)
    by_fz: Array = cell * (thrust - drag * elements.beta * disk.cos + moment)
    by_fx: Array = np.broadcast_to(cell * drag * disk.sin, disk.shape)
    return by_fz, by_fx


@dataclass(frozen=True, eq=False)
class Slopes:
    """Derivatives by the chosen unknowns, the response of the inflow included. Stacks lead with the unknowns."""

    unknowns: tuple[Unknown, ...]
    inflow: Array | None
    """∂λ_i, (unknowns, elements, azimuths); None in hover."""
    fz: Array
    """∂F_z"""
    fx: Array
    """∂F_x"""
    sums: Array
    """∂(C_T, C_H, M0, M1c, M1s), (5, unknowns)."""


def slopes(
    problem: Problem, elements: BladeElements, unknowns: tuple[Unknown, ...], feedback: InflowFeedback | None
) -> Slopes:
    """Exact derivatives of loads and sums by the unknowns. `feedback`: of the response of a load-dependent model."""
    disk, loads = problem.disk, elements.loads
    shape = (len(unknowns), *elements.theta.shape)
    fz, fx = np.empty(shape), np.empty(shape)
    inflow: Array | None = None
    if elements.response is not None:
        inflow = np.zeros(shape)
        wake = wake_at(problem, elements.state)
        by_tilt, by_lambda0 = by_tilt_and_lambda0(elements.response.by_wake, wake.mu_x, wake.mu_z)
        for k, unknown in enumerate(unknowns):
            if unknown in ("shaft_tilt", "lambda0"):
                inflow[k] = by_tilt if unknown == "shaft_tilt" else by_lambda0
    for k, unknown in enumerate(unknowns):
        _with_inflow_held(problem, elements, unknown, fz[k], fx[k])
    if inflow is not None:
        if feedback is not None and elements.response is not None:
            inflow = feedback.solve(elements.response.apply(fz) + inflow)
            changed = range(len(unknowns))
        else:
            changed = [k for k, unknown in enumerate(unknowns) if unknown in ("shaft_tilt", "lambda0")]
        for k in changed:
            fz[k] += loads[kernel.FZ_UP] * inflow[k]
            fx[k] += loads[kernel.FX_UP] * inflow[k]
    total = integrate(problem, elements, fz, fx)
    lift = disk.dr * loads[kernel.FZ].sum(axis=0)
    for k, unknown in enumerate(unknowns):  # β also tilts the lift itself: −β dF_z cos ψ in C_H.
        if unknown in ("coning", "flap_1c", "flap_1s"):
            beta = {"coning": 1.0, "flap_1c": disk.cos, "flap_1s": disk.sin}[unknown]
            total[1, k] -= (lift @ (beta * disk.cos)) / len(disk.psi)
    return Slopes(unknowns, inflow, fz, fx, total)


def velocity_slopes(problem: Problem, elements: BladeElements, unknown: Unknown) -> tuple[Array | float, Array | float]:
    """∂U_T and ∂U_P by one unknown with the inflow held; broadcast to (elements, azimuths)."""
    cos, sin, flow = problem.disk.cos, problem.disk.sin, elements.flow
    if unknown in ("coning", "flap_1c", "flap_1s"):
        u_p = flow.mu_x * cos * {"coning": 1.0, "flap_1c": cos, "flap_1s": sin}[unknown]
        if unknown != "coning":
            u_p = u_p + (problem.disk.r - problem.flap.hinge)[:, None] * (-sin if unknown == "flap_1c" else cos)
        return 0.0, u_p
    if unknown == "shaft_tilt" and problem.design.models.disk_axial_flow:
        return -flow.mu_z * sin, flow.mu_x - flow.mu_z * elements.beta * cos
    return 0.0, 0.0


def _with_inflow_held(problem: Problem, elements: BladeElements, unknown: Unknown, fz: Array, fx: Array) -> None:
    """Write ∂F_z, ∂F_x by one unknown with the inflow held: through θ, U_T, U_P and the loss factor."""
    disk, loads = problem.disk, elements.loads
    if unknown in ("collective", "cyclic_1c", "cyclic_1s"):
        theta = {"collective": 1.0, "cyclic_1c": disk.cos, "cyclic_1s": disk.sin}[unknown]
        np.multiply(loads[kernel.FZ_THETA], theta, out=fz)
        np.multiply(loads[kernel.FX_THETA], theta, out=fx)
        return
    u_t, u_p = velocity_slopes(problem, elements, unknown)
    np.multiply(loads[kernel.FZ_UP], u_p, out=fz)
    np.multiply(loads[kernel.FX_UP], u_p, out=fx)
    if unknown in ("shaft_tilt", "lambda0"):
        fz += loads[kernel.FZ_UT] * u_t
        fx += loads[kernel.FX_UT] * u_t
        lift = loads[kernel.LIFT] * elements.loss_slopes[0 if unknown == "shaft_tilt" else 1][:, None]
        fz += lift * elements.u_t
        fx += lift * elements.u_p
