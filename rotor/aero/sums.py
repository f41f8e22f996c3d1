"""Sums over the disk, and their exact derivatives by the trim unknowns.

Everything an unknown does to a blade element it does through θ, U_T, U_P and the loss factor: collective and cyclic are
columns in θ; coning and flapping are columns in U_P; tilt and λ0 move the velocities and the inflow. The inflow's
answer to the changed load comes on top where the model gives one.
"""

from dataclasses import dataclass

import numpy as np

from rotor.aero import kernel
from rotor.aero.elements import (
    COLLECTIVE,
    CONING,
    CYCLIC_1C,
    CYCLIC_1S,
    FLAP_1C,
    FLAP_1S,
    LAMBDA0,
    SHAFT_TILT,
    Pass,
    Problem,
    by_tilt,
    skewed,
)
from rotor.aero.inflow.interface import InflowFeedback
from rotor.arrays import Array


@dataclass(frozen=True)
class Sums:
    """Sums over the disk, as coefficients of ρA(ΩR)²."""

    thrust: float
    """C_T along the shaft, eq. (3.12)."""
    drag: float
    """C_H, aft in the hub plane: Σ (dF_x sin ψ − β dF_z cos ψ)."""
    moment: tuple[float, float, float]
    """Flap moment Σ (r − e) dF_z: mean, cos ψ and sin ψ parts."""


def sums(problem: Problem, one: Pass) -> Sums:
    """Thrust, H-force and flap moments of a pass."""
    thrust, drag, *moments = weigh(problem, one, one.loads[kernel.FZ][None], one.loads[kernel.FX][None])[:, 0].tolist()
    return Sums(thrust, drag, (moments[0], moments[1], moments[2]))


def weigh(problem: Problem, one: Pass, lift: Array, push: Array) -> Array:
    """(C_T, C_H, M0, M1c, M1s) of stacks of F_z and F_x fields, (5, stack): the sums are linear in the loads."""
    disk = problem.disk
    n = len(disk.psi)
    thrust = disk.dr * lift.sum(axis=1)
    moment = disk.dr * ((disk.r - problem.flap.hinge) @ lift)
    drag = (disk.dr * push.sum(axis=1) @ disk.sin - (one.beta * thrust) @ disk.cos) / n
    cosine, sine = 2.0 * (moment @ disk.cos) / n, 2.0 * (moment @ disk.sin) / n
    return np.stack([thrust.mean(axis=1), drag, moment.mean(axis=1), cosine, sine])


def unweigh(problem: Problem, one: Pass, shares: Array) -> tuple[Array, Array]:
    """The transpose of `weigh`: fields that weight F_z and F_x in shares · (C_T, C_H, M0, M1c, M1s)."""
    disk = problem.disk
    arm = (disk.r - problem.flap.hinge)[:, None]
    thrust, drag, mean, cosine, sine = shares.tolist()
    moment = arm * (mean + 2.0 * (cosine * disk.cos + sine * disk.sin))
    cell = disk.dr / len(disk.psi)
    lift: Array = cell * (thrust - drag * one.beta * disk.cos + moment)
    push: Array = np.broadcast_to(cell * drag * disk.sin, disk.shape)
    return lift, push


@dataclass(frozen=True, eq=False)
class Slopes:
    """What the chosen unknowns do to a pass, the inflow's answer included. Stacks lead with the unknowns."""

    unknowns: tuple[int, ...]
    inflow: Array | None
    """∂λ_i, (unknowns, elements, azimuths); None where no model answers."""
    lift: Array
    """∂F_z"""
    push: Array
    """∂F_x"""
    sums: Array
    """∂(C_T, C_H, M0, M1c, M1s), (5, unknowns)."""


def slopes(problem: Problem, one: Pass, unknowns: tuple[int, ...], loop: InflowFeedback | None) -> Slopes:
    """Exact derivatives of loads and sums by the unknowns. `loop` is the response's, for a load-dependent model."""
    disk, loads = problem.disk, one.loads
    shape = (len(unknowns), *one.theta.shape)
    lift, push = np.empty(shape), np.empty(shape)
    inflow: Array | None = None
    if one.response is not None:
        inflow = np.zeros(shape)
        skew = skewed(problem, one.state)
        by_state = by_tilt(one.response.by_wake, skew.mu_x, skew.mu_z)
        for k, unknown in enumerate(unknowns):
            if unknown in (SHAFT_TILT, LAMBDA0):
                inflow[k] = by_state[0 if unknown == SHAFT_TILT else 1]
    for k, unknown in enumerate(unknowns):
        _direct(problem, one, unknown, lift[k], push[k])
    if inflow is not None:
        if loop is not None and one.response is not None:
            inflow = loop.solve(one.response.apply(lift) + inflow)
            answering = range(len(unknowns))
        else:
            answering = [k for k, unknown in enumerate(unknowns) if unknown in (SHAFT_TILT, LAMBDA0)]
        for k in answering:
            lift[k] += loads[kernel.FZ_UP] * inflow[k]
            push[k] += loads[kernel.FX_UP] * inflow[k]
    total = weigh(problem, one, lift, push)
    load = disk.dr * loads[kernel.FZ].sum(axis=0)
    for k, unknown in enumerate(unknowns):  # β tilts the lift directly as well.
        if unknown in (CONING, FLAP_1C, FLAP_1S):
            bent = {CONING: disk.cos, FLAP_1C: disk.cos**2, FLAP_1S: disk.sin * disk.cos}[unknown]
            total[1, k] -= (load @ bent) / len(disk.psi)
    return Slopes(unknowns, inflow, lift, push, total)


def velocity_columns(problem: Problem, one: Pass, unknown: int) -> tuple[Array | float, Array | float]:
    """∂U_T and ∂U_P by one unknown with the inflow held; broadcast to (elements, azimuths)."""
    cos, sin = problem.disk.cos, problem.disk.sin
    if unknown in (CONING, FLAP_1C, FLAP_1S):
        down = one.flow.mu_x * cos * {CONING: 1.0, FLAP_1C: cos, FLAP_1S: sin}[unknown]
        if unknown != CONING:
            down = down + (problem.disk.r - problem.flap.hinge)[:, None] * (-sin if unknown == FLAP_1C else cos)
        return 0.0, down
    if unknown == SHAFT_TILT and problem.design.models.disk_axial_flow:
        return -one.flow.mu_z * sin, one.flow.mu_x - one.flow.mu_z * one.beta * cos
    return 0.0, 0.0


def _direct(problem: Problem, one: Pass, unknown: int, lift: Array, push: Array) -> None:
    """Write ∂F_z, ∂F_x by one unknown with the inflow held: through θ, U_T, U_P and the loss factor."""
    disk, loads = problem.disk, one.loads
    if unknown in (COLLECTIVE, CYCLIC_1C, CYCLIC_1S):
        column = {COLLECTIVE: 1.0, CYCLIC_1C: disk.cos, CYCLIC_1S: disk.sin}[unknown]
        np.multiply(loads[kernel.FZ_THETA], column, out=lift)
        np.multiply(loads[kernel.FX_THETA], column, out=push)
        return
    across, down = velocity_columns(problem, one, unknown)
    np.multiply(loads[kernel.FZ_UP], down, out=lift)
    np.multiply(loads[kernel.FX_UP], down, out=push)
    if unknown in (SHAFT_TILT, LAMBDA0):
        lift += loads[kernel.FZ_UT] * across
        push += loads[kernel.FX_UT] * across
        scaled = loads[kernel.LIFT] * one.loss_slopes[0 if unknown == SHAFT_TILT else 1][:, None]
        lift += scaled * one.u_t
        push += scaled * one.u_p
