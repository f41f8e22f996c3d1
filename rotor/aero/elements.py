"""Blade elements: the velocities at the section and the loads.

A trim unknown acts on a blade element only through the pitch θ, U_T, U_P and the loss factor. So one evaluation of the
loads with their pointwise derivatives gives every sum over the disk and its exact derivatives (`rotor.aero.sums`).
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from rotor.aero import kernel
from rotor.aero.disk import Disk, build_disk, every_azimuth
from rotor.aero.elastic import (
    BladeTorsion,
    TorsionState,
    air_moments,
    build_torsion,
    highest_harmonic,
    torsion_on_every_azimuth,
)
from rotor.aero.inflow import InflowModel, Wake, inflow_model
from rotor.aero.inflow.interface import InflowBasis, InflowResponse
from rotor.aero.inflow.linear import PrescribedResponse
from rotor.aero.losses import mean_loss_factor
from rotor.aero.momentum import glauert_inflow
from rotor.aero.radial_flow import RadialFriction, skin_friction
from rotor.aero.trim_state import TrimState
from rotor.arrays import Array, Booleans
from rotor.compiled import compiled
from rotor.design.design import Design
from rotor.dynamics.flapping import FlapDynamics, flap_dynamics

LOW_MACH = 0.3
"""Mach number of the section data when compressibility is switched off: that of the document's polar (Re 3.68 million).
Lift is within 5 % of incompressible there (Prandtl–Glauert), and far from drag rise."""

LEAST_AZIMUTHS = 40
"""Azimuths on which derivatives are evaluated, and first steps made: the power of a trim on 40 agrees with that on 120
to 1e-5, and a step with its derivatives leaves 1e-5 to 6e-3 of an error on 120 (tested)."""

LOSS_AZIMUTHS = 24
"""Azimuths over which the loss factor is averaged; 24 agree with 360 to 1e-4 in F (tested)."""

FREE_ROTOR_DRAG = 0.011
"""Mean section drag coefficient for a first estimate of a free rotor's shaft tilt."""

_LOSS_PSI = 2.0 * np.pi * np.arange(LOSS_AZIMUTHS) / LOSS_AZIMUTHS
_LOSS_COS, _LOSS_SIN = np.cos(_LOSS_PSI), np.sin(_LOSS_PSI)
_NO_LOAD = np.zeros((0, 0))
_NO_SLOPES = np.zeros((0, 0, 0))
_RIGID = np.zeros((0, 0)), np.zeros((0, 0)), np.zeros((0, 0))
"""Shapes, coordinates around the azimuth and their rates of a blade without torsion modes."""


@dataclass(frozen=True, eq=False)
class Problem:
    """A design on its grid: the arrays and coefficients that no iteration changes."""

    design: Design
    disk: Disk
    twist: Array
    """θ_tw at the elements [rad]."""
    active: Array
    """θ_act [rad], (elements, azimuths), or (1, 1) without active twist."""
    flap: FlapDynamics
    tip_mach: float
    weight: float
    """C_W with the download and the vertical part of the drag, which the rotor carries; on a test stand the C_T given,
    or an estimate where the collective is given."""
    scale: float
    """What residuals are measured by: C_W, and on a test stand C_T, at least 0.02 σ."""
    drag: float
    """Horizontal part of the fuselage drag over ρA(ΩR)²."""
    climb: float
    """V_c/(ΩR)"""
    inflow: InflowModel
    friction: float
    """c_f for the flow along the blade; 0 where it is left out."""
    unloaded: Booleans | None
    """Elements that carry no load, (elements, azimuths): the reverse-flow region r < −µ sin ψ, where it is switched
    off. Its border is drawn with µ, not µ cos α, so that it stays fixed during the trim and derivatives stay exact."""
    torsion: BladeTorsion | None
    """The blade in torsion; None for a rigid blade."""
    active_rates: tuple[Array, Array]
    """First and second derivative of θ_act by ψ, shaped as `active`."""
    given_torsion: Array
    """Residual of the torsion equations by the twist of the blade as built and by active twist alone, scaled to
    radians, (modes, functions)."""
    added_swirl: Array | float = 0.0
    """What is added to the swirl of momentum theory, (elements,)."""

    @cached_property
    def arm(self) -> Array:
        """r − e, from the hinge, (elements,)."""
        return self.disk.r - self.flap.hinge

    @cached_property
    def no_loss(self) -> tuple[Array, Array]:
        """F = 1 and its slopes, of load-dependent inflow."""
        return np.ones_like(self.disk.r), np.zeros((2, len(self.disk.r)))

    @cached_property
    def inflow_basis(self) -> InflowBasis:
        """Of the inflow model on this disk."""
        return self.inflow.basis(self.disk)

    @cached_property
    def thinned(self) -> "Problem":
        """The same on a part of the azimuths, at least `LEAST_AZIMUTHS`; itself where no smaller part will do.

        Sums over evenly spaced azimuths of a smooth periodic field converge faster than any power of their number.
        """
        azimuths = len(self.disk.psi)
        for step in range(azimuths // LEAST_AZIMUTHS, 1, -1):
            if azimuths % step == 0 and self._resolved_by(azimuths // step):
                return self._every(step)
        return self

    def _resolved_by(self, azimuths: int) -> bool:
        return not self.inflow.load_dependent or self.inflow_basis.resolved_by(azimuths)

    def _every(self, step: int) -> "Problem":
        torsion, unloaded = self.torsion, self.unloaded
        active, *rates = (
            field[:, ::step].copy() if field.size > 1 else field for field in (self.active, *self.active_rates)
        )
        return replace(
            self,
            disk=every_azimuth(self.disk, step),
            active=active,
            active_rates=(rates[0], rates[1]),
            unloaded=None if unloaded is None else unloaded[:, ::step].copy(),
            torsion=None if torsion is None else torsion_on_every_azimuth(torsion, step),
        )


def build_problem(design: Design) -> Problem:
    """The design on its grid."""
    rotor, condition, models = design.rotor, design.condition, design.models
    drag, down = design.drag_parts
    disk = build_disk(
        rotor,
        models.elements,
        models.azimuths,
        None if models.compressibility else LOW_MACH,
        models.has("swept_tip"),
        models.has("surface_drag"),
    )
    wake = expected_wake(design)
    download = design.fuselage.hover_download if models.has("download") and condition.stand is None else 0.0
    weight = design.weight_coefficient
    if download:
        weight *= 1.0 + download * (max(wake.axial, 0.0) / wake.speed) ** 2
    weight += down
    inflow = inflow_model(models.inflow)
    if not models.tip_loss:
        inflow = inflow.without_tip_loss()
    twist = design.twist(disk.r)
    active = design.active_twist if not design.hovering else None
    still = np.zeros((1, 1))
    active_field, *rates = [active(disk.r, disk.psi, order) if active else still for order in range(3)]
    torsion = None
    if models.has("elastic_twist") and rotor.blade.structure is not None:
        torsion = build_torsion(
            rotor,
            disk,
            condition.density,
            None if models.compressibility else LOW_MACH,
            models.has("swept_tip"),
            highest_harmonic(active),
        )
    return Problem(
        design=design,
        disk=disk,
        twist=twist,
        active=active_field,
        flap=flap_dynamics(rotor, condition.density, blade_weight=models.blade_weight),
        tip_mach=design.tip_mach,
        weight=weight,
        scale=weight if condition.stand is None else max(weight, 0.02 * rotor.solidity),
        drag=drag,
        climb=design.climb_ratio,
        inflow=inflow.with_wake_geometry(wake),
        friction=skin_friction(_reynolds(design)) if models.has("radial_friction") else 0.0,
        unloaded=None if models.reverse_flow else disk.r[:, None] + condition.advance_ratio * disk.sin < 0.0,
        torsion=torsion,
        active_rates=(rates[0], rates[1]),
        given_torsion=np.zeros(0)
        if torsion is None
        else _given_torsion(torsion, twist, active_field if active else None, rates[1]),
    )


def _given_torsion(torsion: BladeTorsion, twist: Array, active: Array | None, acceleration: Array) -> Array:
    """Tension on the built-in and the active twist, and the inertia of the latter, (modes, functions)."""
    shapes = torsion.shapes
    found = np.zeros((len(torsion.gain), len(shapes.waves)))
    found[:, 0] = torsion.tension @ twist
    if active is not None:
        found += shapes.harmonics(torsion.tension @ active)
        found += shapes.project(torsion.inertia[:, None] * acceleration)
    return torsion.gain[:, None] * found


def _reynolds(design: Design) -> float:
    """Reynolds number of the chord at 0.75 R in hover."""
    condition, rotor = design.condition, design.rotor
    return condition.density * 0.75 * rotor.tip_speed * rotor.reference_chord / condition.viscosity


def expected_wake(design: Design) -> Wake:
    """The wake of momentum theory when the disk is normal to the resultant of weight and drag.

    On a test stand: at the shaft tilt given. A free rotor's that is not given follows from its drag-to-lift ratio,
    µ tan α = −C_P/C_T with C_P = σ C_d0/8 (1 + 4.65 µ²) + C_T²/2µ.
    """
    drag, down = design.drag_parts
    weight, mu = design.weight_coefficient + down, design.condition.advance_ratio
    tilt = math.atan2(drag, weight)
    stand = design.condition.stand
    if stand is not None:
        tilt = stand.tilt
        if stand.shaft_tilt is None and design.models.trim == "free-rotor":
            profile = design.rotor.solidity * FREE_ROTOR_DRAG / 8.0 * (1.0 + 4.65 * mu**2)
            tilt = -math.atan2(profile + weight**2 / (2.0 * mu), mu * weight)
    mu_x, mu_z = _in_disk_axes(mu, design.climb_ratio, tilt)
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
    """As `kernel.element_loads` returns, with the friction of radial flow in F_x."""
    swirl: Array
    """Swirl of the air in the disk, over ΩR, in the direction of rotation: U_T is less by it, (elements,)."""
    friction: RadialFriction | None
    """Of the flow along the blade; None where it is left out, and in hover."""
    torsion: TorsionState | None = None
    """Elastic twist and moments of the air; None for a rigid blade."""


def wake_at(problem: Problem, state: TrimState) -> Wake:
    """The wake of a trim state: µ cos α − µ_c sin α, µ sin α + µ_c cos α with µ_c = V_c/ΩR, and λ0."""
    mu_x, mu_z = _in_disk_axes(problem.design.condition.advance_ratio, problem.climb, state.shaft_tilt)
    return Wake(mu_x, mu_z, state.lambda0)


def _in_disk_axes(mu: float, climb: float, tilt: float) -> tuple[float, float]:
    """Flight velocity along the disk and through it, µ_x and µ_z."""
    cos, sin = math.cos(tilt), math.sin(tilt)
    return mu * cos - climb * sin, mu * sin + climb * cos


class BladeMotion(NamedTuple):
    """How the blade moves through the air at a trim state."""

    wake: Wake
    flow: Wake
    """As in `BladeElements`."""
    induced: Array
    response: InflowResponse | None
    """Of a model that does not depend on the load."""
    loss: Array
    loss_slopes: Array
    """Zero where no slopes were asked for."""
    swirl: Array
    arguments: tuple[Any, ...]
    """Those of `kernel.velocities`."""


def blade_motion(
    problem: Problem, state: TrimState, induced: Array | None, elastic: Array | None, *, slopes: bool = False
) -> BladeMotion:
    """What the velocities of a trim state follow from; arguments as in `evaluate_elements`.

    slopes: whether those of the loss factor are asked for.
    """
    disk, models = problem.disk, problem.design.models
    wake = wake_at(problem, state)
    flow = wake if models.disk_axial_flow else Wake(problem.design.condition.advance_ratio, 0.0, wake.lambda0)
    response, (loss, loss_slopes) = None, problem.no_loss
    if not problem.inflow.load_dependent:
        response = problem.inflow.respond(disk, wake, _NO_LOAD)
        assert isinstance(response, PrescribedResponse)
        induced = response.induced
        loss, loss_slopes = _lift_loss(problem, wake, flow, response, slopes)
    assert induced is not None
    swirl = swirl_of(disk.r, flow.lambda0 * flow.axial if models.has("swirl") else 0.0)[0] + problem.added_swirl
    twisting = _RIGID
    if problem.torsion is not None:
        coordinates = elastic if elastic is not None else np.zeros_like(problem.given_torsion)
        shapes = problem.torsion.shapes
        twisting = shapes.radial, coordinates @ shapes.waves, coordinates @ shapes.rates
    arguments = (
        problem.twist,
        disk.r - swirl,
        problem.arm,
        disk.cos,
        disk.sin,
        (state.collective, state.cyclic_1c, state.cyclic_1s),
        (state.coning, state.flap_1c, state.flap_1s),
        flow.mu_x,
        flow.mu_z,
        induced,
        *twisting,
    )
    return BladeMotion(wake, flow, induced, response, loss, loss_slopes, swirl, arguments)


def evaluate_elements(
    problem: Problem,
    state: TrimState,
    induced: Array | None = None,
    elastic: Array | None = None,
    response: InflowResponse | None = None,
) -> BladeElements:
    """Velocities of eqs. (3.5), (3.6) and the loads they cause.

    U_T = r − u + µ_x sin ψ with the swirl u; U_P = µ_z + λ_i + (r − e) β' + µ_x β cos ψ. Where the models leave out
    the axial flow of the tilted disk, as (3.6) prints it, µ_z is absent; λ_i is then still skewed by the tilt, eq.
    (2.31). A load-dependent inflow model needs a trial field `induced`, (elements, azimuths); its response gives the
    field for those loads, where it is not given. `elastic`: trial coordinates of the elastic twist, (modes, functions);
    none: untwisted.
    """
    disk = problem.disk
    motion = blade_motion(problem, state, induced, elastic, slopes=True)
    (theta, u_t, u_p, *twisting), beta = kernel.velocities(*motion.arguments)
    if problem.active.size > 1:
        theta += problem.active
        if twisting:
            twisting[1] += problem.active_rates[0]
    u_r = motion.flow.mu_x * disk.cos
    loads = kernel.element_loads(theta, u_t, u_p, u_r, motion.loss, problem.tip_mach, *disk.section_data)
    friction = None
    if problem.friction:
        friction = RadialFriction(disk, motion.flow.mu_x, problem.friction, problem.unloaded)
        loads[kernel.FX] += friction.fx
    if problem.unloaded is not None:
        loads[: kernel.ALPHA, problem.unloaded] = 0.0
        loads[kernel.CL :, problem.unloaded] = 0.0
    torsion = None
    if problem.torsion is not None:
        moments = air_moments(problem.torsion, disk, problem.tip_mach, u_t, u_p, u_r, twisting[1], loads)
        if problem.unloaded is not None:
            moments[:, problem.unloaded] = 0.0
        coordinates = elastic if elastic is not None else np.zeros_like(problem.given_torsion)
        torsion = TorsionState(coordinates, twisting[0], twisting[1], moments)
    response = motion.response or response or problem.inflow.respond(disk, motion.wake, loads[kernel.FZ])
    return BladeElements(
        state, motion.flow, theta, u_t, u_p, motion.induced, response, motion.loss, motion.loss_slopes, beta, loads,
        motion.swirl, friction, torsion,
    )  # fmt: skip


@compiled(error_model="numpy")
def swirl_of(r: Any, product: Any) -> Any:
    """Swirl in the disk over ΩR and its slope by `product` = λ_i λ, the induced times the total axial flow; shape of r.

    The air leaves turning with the rotor: torque and thrust of an annulus give u = λ_i λ/r at the disk, half of what is
    far below (Johnson, Helicopter Theory, §2-3; Glauert 1935). u = q r/(r² + q) with q = λ_i λ is the same for r² ≫ q
    and stays below r at the centre. In forward flight λ_i is the mean inflow λ0 and λ is µ_z + λ0, and the swirl all
    but disappears.
    """
    below = r * r + product
    return product * r / below, r * r * r / (below * below)


def _lift_loss(
    problem: Problem, wake: Wake, flow: Wake, response: PrescribedResponse, slopes: bool
) -> tuple[Array, Array]:  # fmt: skip
    """Loss factor on lift, averaged over azimuth (thesis p. 24), (elements,), and slopes by (α, λ0)."""
    disk, models = problem.disk, problem.design.models
    around = response.around(_LOSS_COS, _LOSS_SIN)
    found = mean_loss_factor(
        disk.r, flow.mu_z + around.induced, around.by_wake if slopes else _NO_SLOPES, disk.blades, disk.root,
        models.tip_loss, models.hub_loss,
    )  # fmt: skip
    if not slopes:
        return found[0], problem.no_loss[1]
    # By λ itself, µ_x, µ_z and λ0, of which ∂µ_x/∂α = −µ_z, ∂µ_z/∂α = µ_x.
    by_tilt = [wake.mu_x if models.disk_axial_flow else 0.0, -wake.mu_z, wake.mu_x, 0.0]
    return found[0], np.array([by_tilt, [0.0, 0.0, 0.0, 1.0]]) @ found[1:]
