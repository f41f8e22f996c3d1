"""Blade elements: velocities at the section, loads, and their sums over the disk.

Everything a trim unknown does to a blade element it does through the pitch θ, U_T and U_P, so one pass of loads with
their pointwise derivatives gives every sum and its exact derivatives.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotor import kernel
from rotor.design import Design
from rotor.disk import Disk, build_disk
from rotor.flapping import FlapDynamics, flap_dynamics
from rotor.inflow import LinearInflow, Wake, inflow_model
from rotor.losses import loss_factor

Array = NDArray[np.float64]

COLLECTIVE, CYCLIC_1C, CYCLIC_1S, SHAFT_TILT, CONING, FLAP_1C, FLAP_1S, LAMBDA0 = range(8)
"""Places of the trim unknowns in a state vector; angles in radians, λ0 over ΩR."""

N_STATE = 8

LOSS_AZIMUTHS = 24
"""Azimuths over which the loss factor is averaged; 24 agree with 360 to 1e-4 in F (tested)."""

_RING = 2.0 * np.pi * np.arange(LOSS_AZIMUTHS) / LOSS_AZIMUTHS
_RING_COS = np.cos(_RING)
_RING_SIN = np.sin(_RING)


@dataclass(frozen=True, eq=False)
class Problem:
    """A design laid out for computing: arrays and coefficients that no iteration changes."""

    design: Design
    disk: Disk
    twist: Array
    """θ_tw at the elements [rad]."""
    flap: FlapDynamics
    tip_mach: float
    weight: float
    """C_W"""
    drag: float
    """Fuselage drag over ρA(ΩR)²."""
    inflow: LinearInflow


def lay_out(design: Design) -> Problem:
    """The problem a design poses."""
    rotor, condition, models = design.rotor, design.condition, design.models
    disk = build_disk(rotor, models.elements, models.azimuths)
    return Problem(
        design=design,
        disk=disk,
        twist=design.twist(disk.r),
        flap=flap_dynamics(rotor, condition.density, blade_weight=models.blade_weight),
        tip_mach=rotor.tip_speed / condition.sound_speed,
        weight=design.weight_coefficient,
        drag=design.fuselage.drag(condition.density, design.airspeed) / design.thrust_unit,
        inflow=inflow_model(models.inflow),
    )


@dataclass(frozen=True, eq=False)
class Pass:
    """One pass over the blade elements at a state. Fields are (elements, azimuths)."""

    state: Array
    flow: Wake
    """µ_x, µ_z as the blade elements see them, and λ0."""
    theta: Array
    u_t: Array
    u_p: Array
    induced: Array
    """λ_i"""
    induced_slopes: Array
    """∂λ_i by (α, λ0), (2, elements, azimuths)."""
    loss: Array
    """F on lift, (elements,)."""
    loss_slopes: Array
    """∂F by (α, λ0), (2, elements)."""
    beta: Array
    """β(ψ), (azimuths,)."""
    loads: Array
    """As `kernel.element_loads` returns."""


def run_pass(problem: Problem, state: Array) -> Pass:
    """Velocities of eqs. (3.5), (3.6) and the loads they make.

    U_T = r + µ_x sin ψ; U_P = µ_z + λ_i + (r − e) β' + µ_x β cos ψ. µ_z is absent where the models leave out the axial
    flow of the tilted disk, as (3.6) prints it; λ_i is then still skewed by the tilt, eq. (2.31).
    """
    disk, models = problem.disk, problem.design.models
    mu, tilt, lambda0 = problem.design.condition.advance_ratio, state[SHAFT_TILT], state[LAMBDA0]
    cos, sin = disk.cos, disk.sin
    mu_x, mu_z = mu * np.cos(tilt), mu * np.sin(tilt)
    flow = Wake(mu_x, mu_z, lambda0) if models.disk_axial_flow else Wake(mu, 0.0, lambda0)

    skew = Wake(mu_x, mu_z, lambda0)
    induced, by_wake = problem.inflow.field(disk.r, cos, sin, skew)
    induced_slopes = _by_tilt(by_wake, mu_x, mu_z)
    loss, loss_slopes = _lift_loss(problem, skew, flow)

    beta = state[CONING] + state[FLAP_1C] * cos + state[FLAP_1S] * sin
    beta_rate = state[FLAP_1S] * cos - state[FLAP_1C] * sin
    theta = (problem.twist + state[COLLECTIVE])[:, None] + (state[CYCLIC_1C] * cos + state[CYCLIC_1S] * sin)
    u_t = disk.r[:, None] + flow.mu_x * sin
    u_p = induced + (disk.r - problem.flap.hinge)[:, None] * beta_rate + (flow.mu_z + flow.mu_x * beta * cos)
    loads = kernel.element_loads(
        theta, u_t, u_p, loss, problem.tip_mach,
        disk.half_solidity, disk.section, disk.weight, disk.offset, disk.tables,
    )  # fmt: skip
    return Pass(state, flow, theta, u_t, u_p, induced, induced_slopes, loss, loss_slopes, beta, loads)


def _by_tilt(by_wake: Array, mu_x: float, mu_z: float) -> Array:
    """Derivatives by (µ_x, µ_z, λ0) to derivatives by (α, λ0): µ_x = µ cos α, µ_z = µ sin α."""
    return np.stack([mu_x * by_wake[1] - mu_z * by_wake[0], by_wake[2]])


def _lift_loss(problem: Problem, skew: Wake, flow: Wake) -> tuple[Array, Array]:
    """Loss factor on lift, averaged over azimuth (thesis p. 24), (elements,), and slopes by (α, λ0)."""
    models, rotor = problem.design.models, problem.design.rotor
    r = problem.disk.r
    induced, by_wake = problem.inflow.field(r, _RING_COS, _RING_SIN, skew)
    factor, slope = loss_factor(
        r[:, None], flow.mu_z + induced, rotor.blades, rotor.blade.root_cutout, tip=models.tip_loss, hub=models.hub_loss
    )
    slopes = _by_tilt(by_wake, skew.mu_x, skew.mu_z)
    if models.disk_axial_flow:
        slopes[0] += skew.mu_x
    return factor.mean(axis=1), (slope * slopes).mean(axis=2)


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
    disk = problem.disk
    lift = disk.dr * one.loads[kernel.FZ].sum(axis=0)
    moment = disk.dr * ((disk.r - problem.flap.hinge) @ one.loads[kernel.FZ])
    push = disk.dr * one.loads[kernel.FX].sum(axis=0)
    n = len(disk.psi)
    return Sums(
        thrust=float(lift.mean()),
        drag=float((push @ disk.sin - (one.beta * lift) @ disk.cos) / n),
        moment=(float(moment.mean()), float(2.0 * (moment @ disk.cos) / n), float(2.0 * (moment @ disk.sin) / n)),
    )


def sums_jacobian(problem: Problem, one: Pass, unknowns: tuple[int, ...]) -> Array:
    """Exact derivatives of (C_T, C_H, M0, M1c, M1s) by the chosen state entries, (5, unknowns)."""
    disk, loads = problem.disk, one.loads
    cos, sin = disk.cos, disk.sin
    arm = (disk.r - problem.flap.hinge)[:, None]
    lift_slopes = np.empty((len(unknowns), *one.theta.shape))
    push_slopes = np.empty_like(lift_slopes)
    for k, unknown in enumerate(unknowns):
        lift, push = lift_slopes[k], push_slopes[k]
        if unknown in (COLLECTIVE, CYCLIC_1C, CYCLIC_1S):
            column = {COLLECTIVE: 1.0, CYCLIC_1C: cos, CYCLIC_1S: sin}[unknown]
            np.multiply(loads[kernel.FZ_THETA], column, out=lift)
            np.multiply(loads[kernel.FX_THETA], column, out=push)
        elif unknown in (CONING, FLAP_1C, FLAP_1S):
            column = {
                CONING: one.flow.mu_x * cos,
                FLAP_1C: one.flow.mu_x * cos**2 - arm * sin,
                FLAP_1S: one.flow.mu_x * sin * cos + arm * cos,
            }[unknown]
            np.multiply(loads[kernel.FZ_UP], column, out=lift)
            np.multiply(loads[kernel.FX_UP], column, out=push)
        else:
            row = 0 if unknown == SHAFT_TILT else 1
            column = one.induced_slopes[row]
            if unknown == SHAFT_TILT and problem.design.models.disk_axial_flow:
                column = column + (one.flow.mu_x - one.flow.mu_z * one.beta * cos)
            scaled = loads[kernel.LIFT] * one.loss_slopes[row][:, None]
            np.multiply(loads[kernel.FZ_UP], column, out=lift)
            np.multiply(loads[kernel.FX_UP], column, out=push)
            lift += scaled * one.u_t
            push += scaled * one.u_p
            if unknown == SHAFT_TILT and problem.design.models.disk_axial_flow:
                lift -= loads[kernel.FZ_UT] * (one.flow.mu_z * sin)
                push -= loads[kernel.FX_UT] * (one.flow.mu_z * sin)
    n = len(disk.psi)
    lift = disk.dr * lift_slopes.sum(axis=1)
    moment = disk.dr * (arm[:, 0] @ lift_slopes)
    push = disk.dr * push_slopes.sum(axis=1)
    drag = (push @ sin - (one.beta * lift) @ cos) / n
    total = disk.dr * loads[kernel.FZ].sum(axis=0)
    for k, unknown in enumerate(unknowns):  # β tilts the lift directly as well.
        if unknown in (CONING, FLAP_1C, FLAP_1S):
            shape = {CONING: cos, FLAP_1C: cos**2, FLAP_1S: sin * cos}[unknown]
            drag[k] -= (total @ shape) / n
    return np.stack([lift.mean(axis=1), drag, moment.mean(axis=1), 2.0 * (moment @ cos) / n, 2.0 * (moment @ sin) / n])
