"""Blade elements: velocities at the section, loads, and their sums over the disk.

Everything a trim unknown does to a blade element it does through the pitch θ, U_T and U_P, so one pass of loads with
their pointwise derivatives gives every sum and its exact derivatives.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotor.aero import kernel
from rotor.aero.disk import Disk, build_disk
from rotor.aero.inflow import InflowModel, Wake, inflow_model
from rotor.aero.inflow.interface import InflowResponse
from rotor.aero.losses import loss_factor
from rotor.aero.momentum import glauert_inflow
from rotor.arrays import Array
from rotor.design.design import Design
from rotor.dynamics.flapping import FlapDynamics, flap_dynamics

COLLECTIVE, CYCLIC_1C, CYCLIC_1S, SHAFT_TILT, CONING, FLAP_1C, FLAP_1S, LAMBDA0 = range(8)
"""Places of the trim unknowns in a state vector; angles in radians, λ0 over ΩR."""

N_STATE = 8

LOW_MACH = 0.3
"""Where sections are read with compressibility switched off: the document's own polar (Re 3.68 million); lift is within
5 % of incompressible there (Prandtl–Glauert), drag rise is far."""

LOSS_AZIMUTHS = 24
"""Azimuths over which the loss factor is averaged; 24 agree with 360 to 1e-4 in F (tested)."""

_RING = 2.0 * np.pi * np.arange(LOSS_AZIMUTHS) / LOSS_AZIMUTHS
_NO_LOAD = np.zeros((0, 0))


@dataclass(frozen=True, eq=False)
class Problem:
    """A design laid out for computing: arrays and coefficients that no iteration changes."""

    design: Design
    disk: Disk
    ring: Disk
    """The same radii at the few azimuths over which the loss factor is averaged."""
    twist: Array
    """θ_tw at the elements [rad]."""
    active: Array
    """θ_act [rad], (elements, azimuths), or (1, 1) where there is none."""
    flap: FlapDynamics
    tip_mach: float
    weight: float
    """C_W"""
    drag: float
    """Fuselage drag over ρA(ΩR)²."""
    inflow: InflowModel
    idle: NDArray[np.bool_] | None
    """Where elements carry no load, (elements, azimuths): the reverse-flow circle r < −µ sin ψ, where it is left out.
    Drawn with µ, not µ cos α: so the trim does not move it while it is being found, and derivatives stay exact."""


def lay_out(design: Design) -> Problem:
    """The problem a design poses."""
    rotor, condition, models = design.rotor, design.condition, design.models
    drag = design.drag / design.thrust_unit
    disk = build_disk(rotor, models.elements, models.azimuths, None if models.compressibility else LOW_MACH)
    inflow = inflow_model(models.inflow)
    if not models.tip_loss:
        inflow = inflow.without_tip_loss()
    return Problem(
        design=design,
        disk=disk,
        ring=replace(disk, psi=_RING, cos=np.cos(_RING), sin=np.sin(_RING)),
        twist=design.twist(disk.r),
        active=design.active_twist(disk.r, disk.psi) if design.active_twist else np.zeros((1, 1)),
        flap=flap_dynamics(rotor, condition.density, blade_weight=models.blade_weight),
        tip_mach=rotor.tip_speed / condition.sound_speed,
        weight=design.weight_coefficient,
        drag=drag,
        inflow=inflow.with_wake_geometry(expected_wake(design, drag)),
        idle=None if models.reverse_flow else disk.r[:, None] + condition.advance_ratio * disk.sin < 0.0,
    )


def expected_wake(design: Design, drag: float) -> Wake:
    """The wake of momentum theory when the disk is normal to the resultant of weight and drag (a coefficient)."""
    weight, mu = design.weight_coefficient, design.condition.advance_ratio
    tilt = math.atan2(drag, weight)
    mu_x, mu_z = mu * math.cos(tilt), mu * math.sin(tilt)
    return Wake(mu_x, mu_z, glauert_inflow(math.hypot(weight, drag), mu_x, mu_z)[0])


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
    response: InflowResponse | None
    """What the inflow model answers to the loads; None in hover, whose annuli balance themselves."""
    loss: Array
    """F on lift, (elements,)."""
    loss_slopes: Array
    """∂F by (α, λ0), (2, elements)."""
    beta: Array
    """β(ψ), (azimuths,)."""
    loads: Array
    """As `kernel.element_loads` returns."""


def skewed(problem: Problem, state: Array) -> Wake:
    """The wake a state leaves: µ cos α, µ sin α, λ0."""
    mu, tilt = problem.design.condition.advance_ratio, float(state[SHAFT_TILT])
    return Wake(mu * math.cos(tilt), mu * math.sin(tilt), float(state[LAMBDA0]))


def run_pass(problem: Problem, state: Array, induced: Array | None = None) -> Pass:
    """Velocities of eqs. (3.5), (3.6) and the loads they make.

    U_T = r + µ_x sin ψ; U_P = µ_z + λ_i + (r − e) β' + µ_x β cos ψ. µ_z is absent where the models leave out the axial
    flow of the tilted disk, as (3.6) prints it; λ_i is then still skewed by the tilt, eq. (2.31). A model that responds
    to the load needs the induced field to try; its response says what it should have been.
    """
    disk, models = problem.disk, problem.design.models
    cos, sin = disk.cos, disk.sin
    skew = skewed(problem, state)
    flow = skew if models.disk_axial_flow else Wake(problem.design.condition.advance_ratio, 0.0, skew.lambda0)
    if problem.inflow.load_dependent:
        assert induced is not None
        response = None
        loss, loss_slopes = np.ones_like(disk.r), np.zeros((2, len(disk.r)))
    else:
        response = problem.inflow.respond(disk, skew, _NO_LOAD)
        induced = response.induced
        loss, loss_slopes = _lift_loss(problem, skew, flow)

    beta = state[CONING] + state[FLAP_1C] * cos + state[FLAP_1S] * sin
    beta_rate = state[FLAP_1S] * cos - state[FLAP_1C] * sin
    theta = (problem.twist + state[COLLECTIVE])[:, None] + (state[CYCLIC_1C] * cos + state[CYCLIC_1S] * sin)
    theta += problem.active
    u_t = disk.r[:, None] + flow.mu_x * sin
    u_p = induced + (disk.r - problem.flap.hinge)[:, None] * beta_rate + (flow.mu_z + flow.mu_x * beta * cos)
    loads = kernel.element_loads(
        theta, u_t, u_p, loss, problem.tip_mach,
        disk.half_solidity, disk.section, disk.weight, disk.offset, disk.tables,
    )  # fmt: skip
    if problem.idle is not None:
        loads[: kernel.ALPHA, problem.idle] = 0.0
        loads[kernel.CL :, problem.idle] = 0.0
    if response is None:
        response = problem.inflow.respond(disk, skew, loads[kernel.FZ])
    return Pass(state, flow, theta, u_t, u_p, induced, response, loss, loss_slopes, beta, loads)


def by_tilt(by_wake: Array, mu_x: float, mu_z: float) -> Array:
    """Derivatives by (µ_x, µ_z, λ0) to derivatives by (α, λ0): µ_x = µ cos α, µ_z = µ sin α."""
    return np.stack([mu_x * by_wake[1] - mu_z * by_wake[0], by_wake[2]])


def _lift_loss(problem: Problem, skew: Wake, flow: Wake) -> tuple[Array, Array]:
    """Loss factor on lift, averaged over azimuth (thesis p. 24), (elements,), and slopes by (α, λ0)."""
    models, rotor = problem.design.models, problem.design.rotor
    around = problem.inflow.respond(problem.ring, skew, _NO_LOAD)
    factor, slope = loss_factor(
        problem.ring.r[:, None],
        flow.mu_z + around.induced,
        rotor.blades,
        rotor.blade.root_cutout,
        tip=models.tip_loss,
        hub=models.hub_loss,
    )
    slopes = by_tilt(around.by_wake, skew.mu_x, skew.mu_z)
    if models.disk_axial_flow:
        slopes[0] += skew.mu_x
    return factor.mean(axis=1), (slope * slopes).mean(axis=2)
