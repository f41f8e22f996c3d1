"""Blade elements: the velocities at the section and the loads.

A trim unknown acts on a blade element only through the pitch θ, U_T, U_P and the loss factor. So one evaluation of the
loads with their pointwise derivatives gives every sum over the disk and its exact derivatives (`rotor.aero.sums`).
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from rotor.aero import kernel
from rotor.aero.disk import Disk, build_disk
from rotor.aero.inflow import InflowModel, Wake, inflow_model
from rotor.aero.inflow.interface import InflowResponse
from rotor.aero.losses import loss_factor
from rotor.aero.momentum import glauert_inflow
from rotor.aero.trim_state import TrimState
from rotor.arrays import Array, Booleans
from rotor.design.design import Design
from rotor.dynamics.flapping import FlapDynamics, flap_dynamics

LOW_MACH = 0.3
"""Mach number of the section data when compressibility is switched off: that of the document's polar (Re 3.68 million).
Lift is within 5 % of incompressible there (Prandtl–Glauert), and far from drag rise."""

LOSS_AZIMUTHS = 24
"""Azimuths over which the loss factor is averaged; 24 agree with 360 to 1e-4 in F (tested)."""

_LOSS_PSI = 2.0 * np.pi * np.arange(LOSS_AZIMUTHS) / LOSS_AZIMUTHS
_NO_LOAD = np.zeros((0, 0))


@dataclass(frozen=True, eq=False)
class Problem:
    """A design on its grid: the arrays and coefficients that no iteration changes."""

    design: Design
    disk: Disk
    loss_disk: Disk
    """The same radii at the few azimuths over which the loss factor is averaged."""
    twist: Array
    """θ_tw at the elements [rad]."""
    active: Array
    """θ_act [rad], (elements, azimuths), or (1, 1) without active twist."""
    flap: FlapDynamics
    tip_mach: float
    weight: float
    """C_W"""
    drag: float
    """Fuselage drag over ρA(ΩR)²."""
    inflow: InflowModel
    unloaded: Booleans | None
    """Elements that carry no load, (elements, azimuths): the reverse-flow region r < −µ sin ψ, where it is switched
    off. Its border is drawn with µ, not µ cos α, so that it stays fixed during the trim and derivatives stay exact."""


def build_problem(design: Design) -> Problem:
    """The design on its grid."""
    rotor, condition, models = design.rotor, design.condition, design.models
    drag = design.drag / design.thrust_unit
    disk = build_disk(rotor, models.elements, models.azimuths, None if models.compressibility else LOW_MACH)
    inflow = inflow_model(models.inflow)
    if not models.tip_loss:
        inflow = inflow.without_tip_loss()
    return Problem(
        design=design,
        disk=disk,
        loss_disk=replace(disk, psi=_LOSS_PSI, cos=np.cos(_LOSS_PSI), sin=np.sin(_LOSS_PSI)),
        twist=design.twist(disk.r),
        active=design.active_twist(disk.r, disk.psi) if design.active_twist else np.zeros((1, 1)),
        flap=flap_dynamics(rotor, condition.density, blade_weight=models.blade_weight),
        tip_mach=rotor.tip_speed / condition.sound_speed,
        weight=design.weight_coefficient,
        drag=drag,
        inflow=inflow.with_wake_geometry(expected_wake(design, drag)),
        unloaded=None if models.reverse_flow else disk.r[:, None] + condition.advance_ratio * disk.sin < 0.0,
    )


def expected_wake(design: Design, drag: float) -> Wake:
    """The wake of momentum theory when the disk is normal to the resultant of weight and drag (a coefficient)."""
    weight, mu = design.weight_coefficient, design.condition.advance_ratio
    tilt = math.atan2(drag, weight)
    mu_x, mu_z = mu * math.cos(tilt), mu * math.sin(tilt)
    return Wake(mu_x, mu_z, glauert_inflow(math.hypot(weight, drag), mu_x, mu_z)[0])


@dataclass(frozen=True, eq=False)
class BladeElements:
    """The blade elements at a trim state. Fields are (elements, azimuths)."""

    state: TrimState
    flow: Wake
    """µ_x, µ_z as the blade elements see them, and λ0."""
    theta: Array
    """Pitch with twist [rad]."""
    u_t: Array
    u_p: Array
    induced: Array
    """λ_i"""
    response: InflowResponse | None
    """Response of the inflow model to the loads; None in hover, where each annulus balances itself."""
    loss: Array
    """F on lift, (elements,)."""
    loss_slopes: Array
    """∂F by (α, λ0), (2, elements)."""
    beta: Array
    """β(ψ), (azimuths,)."""
    loads: Array
    """As `kernel.element_loads` returns."""


def wake_at(problem: Problem, state: TrimState) -> Wake:
    """The wake of a trim state: µ cos α, µ sin α, λ0."""
    mu, tilt = problem.design.condition.advance_ratio, state.shaft_tilt
    return Wake(mu * math.cos(tilt), mu * math.sin(tilt), state.lambda0)


def evaluate_elements(problem: Problem, state: TrimState, induced: Array | None = None) -> BladeElements:
    """Velocities of eqs. (3.5), (3.6) and the loads they cause.

    U_T = r + µ_x sin ψ; U_P = µ_z + λ_i + (r − e) β' + µ_x β cos ψ. Where the models leave out the axial flow of the
    tilted disk, as (3.6) prints it, µ_z is absent; λ_i is then still skewed by the tilt, eq. (2.31). A load-dependent
    inflow model needs a trial field `induced`, (elements, azimuths); its response gives the field for those loads.
    """
    disk, models = problem.disk, problem.design.models
    cos, sin = disk.cos, disk.sin
    wake = wake_at(problem, state)
    flow = wake if models.disk_axial_flow else Wake(problem.design.condition.advance_ratio, 0.0, wake.lambda0)
    if problem.inflow.load_dependent:
        assert induced is not None
        response = None
        loss, loss_slopes = np.ones_like(disk.r), np.zeros((2, len(disk.r)))
    else:
        response = problem.inflow.respond(disk, wake, _NO_LOAD)
        induced = response.induced
        loss, loss_slopes = _lift_loss(problem, wake, flow)

    beta = state.coning + state.flap_1c * cos + state.flap_1s * sin
    beta_rate = state.flap_1s * cos - state.flap_1c * sin
    theta = (problem.twist + state.collective)[:, None] + (state.cyclic_1c * cos + state.cyclic_1s * sin)
    theta += problem.active
    u_t = disk.r[:, None] + flow.mu_x * sin
    u_p = induced + (disk.r - problem.flap.hinge)[:, None] * beta_rate + (flow.mu_z + flow.mu_x * beta * cos)
    loads = kernel.element_loads(
        theta, u_t, u_p, loss, problem.tip_mach,
        disk.half_solidity, disk.section, disk.weight, disk.offset, disk.tables,
    )  # fmt: skip
    if problem.unloaded is not None:
        loads[: kernel.ALPHA, problem.unloaded] = 0.0
        loads[kernel.CL :, problem.unloaded] = 0.0
    if response is None:
        response = problem.inflow.respond(disk, wake, loads[kernel.FZ])
    return BladeElements(state, flow, theta, u_t, u_p, induced, response, loss, loss_slopes, beta, loads)


def by_tilt_and_lambda0(by_wake: Array, mu_x: float, mu_z: float) -> Array:
    """Derivatives by (µ_x, µ_z, λ0) to derivatives by (α, λ0): µ_x = µ cos α, µ_z = µ sin α."""
    return np.stack([mu_x * by_wake[1] - mu_z * by_wake[0], by_wake[2]])


def _lift_loss(problem: Problem, wake: Wake, flow: Wake) -> tuple[Array, Array]:
    """Loss factor on lift, averaged over azimuth (thesis p. 24), (elements,), and slopes by (α, λ0)."""
    models, rotor = problem.design.models, problem.design.rotor
    response = problem.inflow.respond(problem.loss_disk, wake, _NO_LOAD)
    factor, slope = loss_factor(
        problem.loss_disk.r[:, None],
        flow.mu_z + response.induced,
        rotor.blades,
        rotor.blade.root_cutout,
        tip=models.tip_loss,
        hub=models.hub_loss,
    )
    slopes = by_tilt_and_lambda0(response.by_wake, wake.mu_x, wake.mu_z)
    if models.disk_axial_flow:
        slopes[0] += wake.mu_x
    return factor.mean(axis=1), (slope * slopes).mean(axis=2)
