"""Main-rotor power by parts, tail-rotor power, hub moment, and the textbook closed form of profile power.

Induced Σ (λ_i dF_z + u dF_x) with the swirl u, profile Σ U dD (dissipation, friction of the flow along the blade
included), parasite D·V. With periodic flapping and forces in balance their sum is the shaft power Σ Ωy dF_x (3.10),
(3.13) as an identity of the discretised equations: from U_T dF_x + U_R dF_r = U_P dF_z + U dD and
r = U_T + u − µ_x sin ψ,

    P_shaft = Σ (λ_i dF_z + u dF_x + U dD) + µ_z C_T − µ_x C_H,    and    µ_z T − µ_x H = D·V + W V_c.

The parasite power D·V is that of all air loads on the airframe: in a climb the download is pushed up as well. It is the
weight alone that gains height, W V_c.

On a test stand nothing balances the rotor's forces, and µ_z T − µ_x H is the power with which it pulls against its
mount, negative where it drags; it takes the place of D·V.

The twist of an elastic blade changes the angle of attack only, so the identity holds with it as without. What the air
takes from blades through their rate of pitch, −Σ dC_M θ', is not in it, for rigid blades neither: below 0.1 % of power,
and `ElasticTwist.control_power` states it.

Without the axial flow of the tilted disk (3.6 as printed) the torque lacks D·V and more, so there the sum of parts *is*
the power.
"""

import math
from typing import Any

from rotor.aero import kernel
from rotor.aero.elements import BladeElements, Problem
from rotor.aero.momentum import glauert_inflow
from rotor.aero.sums import DiskSums
from rotor.compiled import compiled
from rotor.design.aircraft import FIXED_SHARE, TailRotor
from rotor.design.design import Design
from rotor.trim.solution import HubMoment, PowerBudget


def power_budget(problem: Problem, elements: BladeElements, total: DiskSums) -> PowerBudget:
    """Power [W] by parts, and torque × Ω; total: the sums over the disk."""
    design, disk, loads = problem.design, problem.disk, elements.loads
    watts, weight = design.power_unit, design.weight_coefficient
    unit = watts * disk.dr / len(disk.psi)
    induced, profile, shaft = _powers(
        loads[kernel.FZ], loads[kernel.FX], loads[kernel.CD], elements.u_t, elements.u_p, elements.induced,
        elements.swirl, disk.r, disk.half_solidity,
    )  # fmt: skip
    if elements.friction is not None:
        profile += _rubbing(elements.u_t, elements.flow.mu_x * disk.cos, elements.friction.fx, elements.friction.radial)
    induced, profile, shaft = unit * induced, unit * profile, unit * shaft
    pressed = problem.weight - weight
    parasite = (problem.drag * design.condition.advance_ratio + pressed * problem.climb) * watts
    climb = weight * problem.climb * watts
    if design.condition.stand is not None:
        parasite = -wind_forces(elements, total)[1] * design.condition.advance_ratio * watts
    main = induced + profile + parasite + climb
    tail, _ = tail_power(design, main)
    return PowerBudget(induced=induced, profile=profile, parasite=parasite, tail=tail, shaft=shaft, climb=climb)


# Sums in any order, so that the compiler makes vector code of them.
_compile = compiled(error_model="numpy", fastmath={"contract", "reassoc"})


@_compile
def _powers(
    fz: Any, fx: Any, cd: Any, u_t: Any, u_p: Any, induced: Any, swirl: Any, r: Any, half_solidity: Any
) -> Any:  # fmt: skip
    """Sums over the disk of λ_i dF_z + u dF_x, of U dD = ½σ U³ C_d, and of r dF_x."""
    by_inflow, dissipation, torque = 0.0, 0.0, 0.0
    for i in range(len(r)):
        turning, dragging, along = 0.0, 0.0, 0.0
        for j in range(fz.shape[1]):
            square = u_t[i, j] * u_t[i, j] + u_p[i, j] * u_p[i, j]
            along += induced[i, j] * fz[i, j]
            dragging += square * math.sqrt(square) * cd[i, j]
            turning += fx[i, j]
        by_inflow += along + swirl[i] * turning
        dissipation += half_solidity[i] * dragging
        torque += r[i] * turning
    return by_inflow, dissipation, torque


@_compile
def _rubbing(u_t: Any, along: Any, fx: Any, radial: Any) -> Any:
    """Sum over the disk of U_T dF_x + U_R dF_r of the friction of radial flow."""
    total = 0.0
    for i in range(len(u_t)):
        for j in range(len(along)):
            total += u_t[i, j] * fx[i, j] + along[j] * radial[i, j]
    return total


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
    tail, slope = tail_rotor_power(design.tail_rotor, main / speed, design.flight_speed, design.condition.density)
    return tail, slope / speed


def profile_power_coefficient(solidity: float, drag_coefficient: float, advance_ratio: float) -> float:
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
    moment = disk.r @ elements.loads[kernel.FZ] * (design.thrust_unit * design.rotor.radius * disk.dr / len(disk.psi))
    return HubMoment(roll=float(moment @ disk.sin), pitch=-float(moment @ disk.cos))


def tail_rotor_power(tail: TailRotor, torque: float, airspeed: float, density: float) -> tuple[float, float]:
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
        inflow + ct * inflow_slope / tail.tip_loss**2 + profile * (d1 + 2.0 * d2 * alpha) * alpha_slope
    ) * ct_slope
    return cp * unit * tip_speed, cp_slope * unit * tip_speed
