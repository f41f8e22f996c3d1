"""Main-rotor power by parts, tail-rotor power, hub moment, and the textbook closed form of profile power.

Induced Σ (λ_i dF_z + u dF_x) with the swirl u, profile Σ V dD (dissipation, with V the whole velocity at the section),
parasite D·V. With periodic flapping and forces in balance their sum is the shaft power Σ Ωy dF_x (3.10),
(3.13) as an identity of the discretised equations: from U_T dF_x + U_R dF_r = U_P dF_z + V dD and
r = U_T + u − µ_x sin ψ,

    P_shaft = Σ (λ_i dF_z + u dF_x + V dD) + µ_z C_T − µ_x C_H,    and    µ_z T − µ_x H = D·V + W V_c.

A gust w(r, ψ), which is in U_P, adds Σ w dF_z.

The parasite power D·V is that of all air loads on the airframe: in a climb the download is pushed up as well. It is the
weight alone that gains height, W V_c.

On a test stand nothing balances the rotor's forces, and µ_z T − µ_x H is the power with which it pulls against its
mount, negative where it drags; it takes the place of D·V.

The twist of an elastic blade changes the angle of attack only, so the identity holds with it as without. What the air
takes from blades through their rate of pitch, −Σ dC_M θ', is not in it, for rigid blades neither: below 0.1 % of power
with cyclic alone, up to 2 % with some degrees of n/rev pitch. `ElasticTwist.control_power` states it.

Without the axial flow of the tilted disk (3.6 as printed) the torque lacks D·V and more, so there the sum of parts *is*
the power.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from rotor.aero.elements import BladeElements, DiskSums
from rotor.aero.momentum import glauert_inflow
from rotor.aero.problem import Problem
from rotor.design.aircraft import FIXED_SHARE, TailRotor
from rotor.design.design import Design
from rotor.engine.waves import wave_grid
from rotor.support.arrays import Array


@dataclass(frozen=True)
class PowerBudget:
    """Power by parts [W]. `total` is the sum of `main_rotor` and `tail`."""

    induced: float
    """Σ λ_i dF_z: the work of the induced velocity."""
    profile: float
    """Σ V dD: what the drag of the sections dissipates."""
    parasite: float
    """D·V of the airframe; in a climb also the power that lifts the download."""
    tail: float
    """Of the tail rotor."""
    shaft: float
    """Torque × Ω. In the flight preset it equals `main_rotor` to rounding where all forces balance, which trim `thrust`
    leaves to the lift alone; in the thesis preset it is not power."""
    climb: float = 0.0
    """W V_c, negative in descent; with a gust Σ w dF_z as well, w down."""
    damping: float = 0.0
    """What the dampers of `Solution.freedoms` dissipate."""

    @property
    def main_rotor(self) -> float:
        """Power of the main rotor [W]."""
        return self.induced + self.profile + self.parasite + self.climb + self.damping

    @property
    def total(self) -> float:
        """Power of main rotor and tail rotor together [W]."""
        return self.main_rotor + self.tail


@dataclass(frozen=True)
class HubMoment:
    """Steady moments of the hub on the shaft [N m]."""

    roll: float
    """Positive towards the retreating side, as from lift on the advancing side."""
    pitch: float
    """Positive nose-up."""

    @property
    def size(self) -> float:
        """Magnitude of the hub moment [N m]."""
        return math.hypot(self.roll, self.pitch)


def power_budget(problem: Problem, elements: BladeElements, total: DiskSums) -> PowerBudget:
    """Power [W] by parts, and torque × Ω; total: the sums over the disk.

    V dD = U_T dF_x − U_P dF_z + U_R dF_r: the velocity at the section times the force on it.
    """
    design, disk = problem.design, problem.disk
    watts = design.power_unit
    width = disk.dr / len(disk.psi)
    e = elements
    induced = induced_power(problem, (e.induced, e.swirl), e.fz, e.fx)
    profile = (
        float(width @ (_around(e.u_t, e.fx) - _around(e.u_p, e.fz) + _around(e.u_r, e.fr))) * watts
    )
    parasite, climb = outside_power(problem)
    if design.condition.stand is not None:
        lift, drag = wind_forces(elements, total)
        parasite, climb = (
            -drag * design.condition.advance_ratio * watts,
            lift * design.vertical_ratio * watts,
        )
    if problem.air.gust is not None:
        climb += float(width @ _around(problem.air.gust, e.fz)) * watts
    damping = total.damping * watts
    tail, _ = tail_power(design, induced + profile + parasite + climb + damping)
    return PowerBudget(
        induced, profile, parasite, tail, shaft=total.torque * watts, climb=climb, damping=damping
    )


def power_around(problem: Problem, elements: BladeElements, budget: PowerBudget) -> Array:
    """Total power [W] over the azimuth, (azimuths,), whose mean is `total` of the budget.

    Induced and profile power are where the blades spend them. All else has no azimuth: it is the same at each.
    """
    e = elements
    width = problem.disk.dr * problem.design.power_unit
    swirl = e.swirl[:, None]
    induced = e.induced * e.fz + swirl * e.fx
    profile = e.u_t * e.fx - e.u_p * e.fz + e.u_r * e.fr
    elsewhere = budget.total - budget.induced - budget.profile
    return width @ (induced + profile) + elsewhere


def induced_power(problem: Problem, air: tuple[Array, Array], fz: Array, fx: Array) -> float:
    """Σ (λ_i dF_z + u dF_x) [W]; air: λ_i and u."""
    (induced, swirl), width = air, problem.disk.dr / len(problem.disk.psi)
    return (
        float(width @ (_around(induced, fz) + swirl * fx.sum(axis=1))) * problem.design.power_unit
    )


def outside_power(problem: Problem) -> tuple[float, float]:
    """Power [W] that no state of the trim changes: D·V with the download pushed up, and W V_c; none on a stand."""
    design = problem.design
    if design.condition.stand is not None:
        return 0.0, 0.0
    watts, weight = design.power_unit, design.weight_coefficient / design.condition.load_factor
    # The rotor pushes up more than the weight: the downward part of the drag and, in a turn, (n − 1) W. `drag_parts`
    # has taken (n − 1) W sin γ off the drag along the path, so that the sum is drag times speed.
    pressed = problem.weight - weight
    parasite = (
        problem.drag * design.condition.advance_ratio + pressed * design.vertical_ratio
    ) * watts
    return parasite, weight * design.vertical_ratio * watts


def _around(array: Array, other: Array) -> Array:
    """Sums of a product around the azimuth, (elements,)."""
    return np.einsum("ij,ij->i", array, other)


def wind_forces(elements: BladeElements, total: DiskSums) -> tuple[float, float]:
    """Vertical and horizontal force of the rotor over ρA(ΩR)², up and aft: lift and drag in level wind."""
    cos, sin = math.cos(elements.state.shaft_tilt), math.sin(elements.state.shaft_tilt)
    return total.thrust * cos + total.drag * sin, total.drag * cos - total.thrust * sin


def tail_power(design: Design, main: float) -> tuple[float, float]:
    """Tail-rotor power [W] for a main-rotor power [W], and its slope: solved, or the document's fixed share.

    The share is also used where the aircraft has no tail rotor, or an unknown one. A test stand has none.
    """
    if design.condition.stand is not None:
        return 0.0, 0.0
    if design.tail_rotor is None or not design.models.tail_rotor_solved:
        return FIXED_SHARE * abs(main), math.copysign(FIXED_SHARE, main)
    speed = design.rotor.angular_speed
    share = design.condition.rotor_speed_percent / 100.0
    geared = replace(design.tail_rotor, angular_speed=design.tail_rotor.angular_speed * share)
    tail, slope = tail_rotor_power(
        geared, main / speed, design.flight_speed, design.condition.density
    )
    return tail, slope / speed


def profile_power_coefficient(
    solidity: float, drag_coefficient: float, advance_ratio: float
) -> float:
    """C_P0 = σC_d0/8 (1 + 3µ² + ⅜µ⁴) of a blade from the centre with constant drag, reverse flow included.

    It is eq. (3.15) integrated, with its first coefficient σC_d0/4π: printed as σC_d0/2π it would double the σC_d0/8 of
    hover. The second, σC_d0/2π over the reverse-flow region, is right: it turns −∫ there into +∫.
    """
    mu = advance_ratio
    return solidity * drag_coefficient / 8.0 * (1.0 + 3.0 * mu**2 + 0.375 * mu**4)


def hub_moment(problem: Problem, elements: BladeElements) -> HubMoment:
    """Steady moments about the hub, first harmonics of Σ r dF_z.

    True with and without hinge offset: about the hub, the inertia and the centrifugal force of a blade that flaps once
    per revolution cancel. Blades hinged at the centre transfer no moment, because flapping balances the lift.
    """
    design, disk = problem.design, problem.disk
    moment = (
        disk.r * disk.dr @ elements.fz * (design.thrust_unit * design.rotor.radius / len(disk.psi))
    )
    return HubMoment(roll=float(moment @ disk.sin), pitch=-float(moment @ disk.cos))


def tail_rotor_power(
    tail: TailRotor, torque: float, airspeed: float, density: float
) -> tuple[float, float]:
    """Power [W] that balances a main-rotor torque [N m] of either sign at an airspeed [m/s], and its slope dP/dQ [1/s].

    Energy method: induced power T v_i of the effective disk (radius B R), profile power σ c_d/8 (1 + 3µ²) of the
    dissipation form with the polar taken at the mean angle of attack 6 C_T/(σ a).
    """
    tip_speed = tail.angular_speed * tail.radius
    area = math.pi * tail.radius**2
    unit = density * area * tip_speed**2
    solidity = tail.blades * tail.chord / (math.pi * tail.radius)
    mu = airspeed / tip_speed
    ct_slope = math.copysign(1.0, torque) / (tail.arm * math.cos(tail.cant) * unit)
    ct = torque * ct_slope

    effective = ct / tail.tip_loss**2
    inflow, inflow_slope = glauert_inflow(effective, mu, 0.0)
    alpha_slope = 6.0 / (solidity * tail.lift_slope)
    alpha = alpha_slope * ct
    d0, d1, d2 = tail.drag_polar
    profile = solidity / 8.0 * (1.0 + 3.0 * mu**2)
    cp = ct * inflow + profile * (d0 + d1 * alpha + d2 * alpha**2)
    cp_slope = (
        inflow
        + ct * inflow_slope / tail.tip_loss**2
        + profile * (d1 + 2.0 * d2 * alpha) * alpha_slope
    ) * ct_slope
    return cp * unit * tip_speed, cp_slope * unit * tip_speed


def control_loads(problem: Problem, elements: BladeElements) -> tuple[Array, float]:
    """Moment of the control system on one blade, and the power that moves the pitching blades.

    The moment [N m], nose up, (azimuths,), is what balances all loads on the blade. The power, over ρA(ΩR)³, is that of
    pitch links and actuators. With cyclic alone the links take it from the shaft, because the swashplate does not move.
    Inertia, propeller moment, tension and elasticity store energy and give it back, so once torsion is in balance it is
    what the air takes, −Σ dC_M θ'.
    """
    torsion, blade = problem.torsion, elements.torsion
    assert torsion is not None
    assert blade is not None
    disk, state = problem.disk, elements.state
    loads = _loads(problem, elements)
    total = disk.dr @ loads
    moment = -torsion.moment_unit * total
    cyclic = state.cyclic_1s * disk.cos - state.cyclic_1c * disk.sin
    work = -float(total @ cyclic)
    if problem.wave_rates[0].size > 1:
        work -= float(disk.dr @ _around(loads, problem.wave_rates[0]))
        twist = problem.twist[:, None] + problem.waves
        modal = torsion.tension.T @ (
            blade.coordinates @ wave_grid(torsion.functions, len(disk.psi)).at
        )
        work += float(((torsion.own_tension @ twist + modal) * problem.wave_rates[0]).sum())
    return moment, work / len(disk.psi)


def _loads(problem: Problem, elements: BladeElements) -> Array:
    """All moments per unit of r about the pitch axis, M − j θ'' + w β0 (bent: w (w' + w''/r)), (elements, azimuths)."""
    torsion, blade = problem.torsion, elements.torsion
    assert torsion is not None
    assert blade is not None
    disk, state = problem.disk, elements.state
    harmonic = (np.arange(torsion.functions) + 1) // 2
    elastic = (blade.coordinates * -(harmonic**2)) @ wave_grid(torsion.functions, len(disk.psi)).at
    acceleration = torsion.radial.T @ elastic - (
        state.cyclic_1c * disk.cos + state.cyclic_1s * disk.sin
    )
    if problem.wave_rates[1].size > 1:
        acceleration = acceleration + problem.wave_rates[1]
    lifted: Array | float = state.coning
    if elements.bent is not None:
        lifted = elements.bent.channels[0] + elements.bent.lift / disk.r[:, None]
    return (
        blade.moment - torsion.inertia[:, None] * acceleration + torsion.tip_mass[:, None] * lifted
    )
