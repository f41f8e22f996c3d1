"""Forward-flight inflow that passes over to the hover model as the speed falls to zero.

A skewed wake at zero speed and a hover model give the same rotor different inflow. Their difference c(r), at the loads
of the hovering rotor, is added to the inflow in forward flight times s(µ), which is 1 at µ = 0:

    λ_i = A d + s c,    c = λ_hover − A_0 d_hover,    s = ((λ̄ − λ̄_e)/(1 − λ̄_e))³,    s = 0 for λ̄ < λ̄_e,
    λ̄² = √(µ̄⁴/4 + 1) − µ̄²/2,    µ̄ = µ/√(C_W/2).

A d is all that the model makes of the load; of a lifting line λ0 + (AΓ − λ0)/D, and A_0 with D = 2 and λ0 = C_T/2V. Its
power at no speed is 1.3, 1.0 and 0.4 % below that of annuli for UH-60A, Bo 105 and R22.

Hover stays with annuli, since the same wake in hover is no closer to measured power: rms 7.8 and 6.1 % for 8.8 and 7.2
(Knight and Hefner, three and four blades), 15.7 and 21.0 for 16.0 and 20.0 (Castles and Gray, tables I and III), 5.1
for 4.6 (UH-60A), 2.0 for 1.9 (XV-15). It makes −12° of twist worth −13.0 and −10.7 % at C_T 0.004 and 0.005, annuli
−11.1 and −9.1; no usable measurement decides. Climb, descent and the vortex ring's edge rest on annuli too.

λ̄ is Glauert's inflow over that of hover. With it cos²χ of the wake's skew χ is λ̄⁴, the share of the axial transport in
the squared velocity through the disk; c falls faster than with it and with the inflow itself, as λ̄⁵, for the wake of a
lifting line skews by itself. λ̄_e belongs to µ̄ = 1.5, where the wake trails at 68° to the shaft: beyond it s is 0 and
hover is not computed. So hover and forward flight have one limit, and neither power nor its slope has a kink. In a
climb hover is that at the same rate of climb.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from rotor.aero.inflow import DiskFlow, inflow_model
from rotor.aero.lifting_line import WakeCourse
from rotor.aero.momentum import FASTEST_RING, axial_flow_is_steady, vortex_ring_edge
from rotor.aero.problem import Problem, build_problem, swirl_of
from rotor.columns.blade import Freedom
from rotor.design.design import Design
from rotor.design.gust import Gust
from rotor.support.arrays import Array, fix
from rotor.support.bytes_cache import bytes_cache
from rotor.trim.forward import SLOWEST, found_course, with_course
from rotor.trim.hover import hover
from rotor.trim.newton import TrimResult

FASTEST = 1.5
"""µ̄ from which on forward flight owes nothing to hover: µ 0.086 for a UH-60A at sea level. Our choice."""


@dataclass(frozen=True, eq=False)
class HoverDifference:
    """The hovering rotor of a design, and what the forward-flight model lacks there; over ΩR, (elements,)."""

    hover: TrimResult
    axial: Array
    """A_0, from the load of hover to the mean inflow, (elements, elements)."""
    by_speed: Array
    """∂(A_0 d)/∂U_T, (elements, elements)."""
    inflow: Array
    """c, λ_hover − A_0 d_hover."""
    swirl: Array
    """The constant c of the swirl."""


@bytes_cache
def hover_difference(design: Design, course: WakeCourse | None) -> HoverDifference | None:
    """The difference for a hovering design with the course of its wake at `SLOWEST`; None where it does not hover."""
    problem = build_problem(design)
    hovering = hover(problem)
    if not hovering.converged:
        return None
    elements, disk = hovering.linear.elements, problem.disk
    flow = DiskFlow(0.0, design.vertical_ratio, elements.state.lambda0)
    load = elements.fz[:, 0]
    flown = problem if course is None else replace(problem, course=course)
    axial, slope = flown.inflow_terms.axial(flow, elements.u_t[:, 0])
    uniform, _ = swirl_of(
        disk.r, flow.lambda0**2 + flow.lambda0 * flow.mu_z if design.models.has("swirl") else 0.0
    )
    inflow = elements.induced[:, 0] - axial @ load
    difference = axial, slope * load, inflow, elements.swirl - uniform
    fix(difference)
    return HoverDifference(hovering, *difference)


def axial_share(mu: float, thrust: float) -> float:
    """s(µ) for the C_T of hover: 1 at µ = 0, falling to 0 at µ = FASTEST √(C_T/2). Our choice."""
    end = inflow_ratio(FASTEST)
    share = max(0.0, (inflow_ratio(mu / math.sqrt(0.5 * thrust)) - end) / (1.0 - end))
    return share * share * share


def inflow_ratio(mu: float) -> float:
    """λ̄ by Glauert's (2.30) for a level disk: mean inflow over that of hover, at µ̄: µ over the inflow of hover."""
    half = 0.5 * mu**2
    return math.sqrt(1.0 / (math.sqrt(half**2 + 1.0) + half))


def trim_problem(design: Design, freedoms: Sequence[Freedom] = ()) -> Problem:
    """The design on its grid with further freedoms, and the inflow that its models choose for low speed."""
    problem, hovering = (
        replace(with_course(build_problem(design)), freedoms=tuple(freedoms)),
        joined_hover(design),
    )
    if hovering is None:
        return problem
    share, difference = hovering
    joined = share * difference.inflow, share * difference.swirl
    return replace(problem, air=replace(problem.air, joined=joined))


def joined_hover(design: Design) -> tuple[float, HoverDifference] | None:
    """s, and the hovering rotor that a design in forward flight passes over to; None at speed and without hover."""
    share = hover_share(design)
    if not share:
        return None
    hovering = replace(in_hover(design), active_twist=None, pitch_per_rev=())
    if design.gust is not None and not design.gust.axisymmetric:
        hovering = replace(hovering, gust=Gust(design.gust.uniform))
    difference = hover_difference(hovering, found_course(hovering.at(mu=SLOWEST)))
    return None if difference is None else (share, difference)


def in_hover(design: Design) -> Design:
    """The design without forward speed, at its rate of climb: in descent at most that of the vortex ring state's edge.

    Faster descents are flown at speed only, where little of hover is left.
    """
    slowest = (
        vortex_ring_edge(0.0) * math.sqrt(0.5 * design.weight_coefficient) * design.rotor.tip_speed
    )
    climb = max(
        design.condition.climb_speed,
        slowest + (design.condition.climb_speed - design.vertical_speed),
    )
    return replace(
        design, condition=replace(design.condition, advance_ratio=0.0, climb_speed=climb)
    )


def passes_over(design: Design) -> bool:
    """Whether forward flight of the design passes over to its hover model as the speed falls."""
    models = design.models
    return (
        models.low_speed == "hover"
        and design.condition.stand is None
        and inflow_model(models.inflow).load_dependent
    )


def hover_share(design: Design) -> float:
    """s of a design in forward flight; 0 where it does not pass over to hover, and at speed."""
    if design.hovering or not passes_over(design):
        return 0.0
    return axial_share(design.condition.advance_ratio, design.weight_coefficient)


def vortex_ring(design: Design) -> str:
    """Why a descent has no steady wake, as a sentence; empty where it has one, or the thrust is not known yet."""
    stand, thrust = design.condition.stand, design.weight_coefficient
    if design.hovering:
        known = stand is None or stand.collective is None
        return (
            axial_ring(design)
            if known and not axial_flow_is_steady(thrust, design.vertical_ratio)
            else ""
        )
    if math.copysign(1.0, thrust) * design.vertical_speed >= 0.0:
        return ""
    inflow, mu = math.sqrt(0.5 * abs(thrust)), design.condition.advance_ratio
    edge = vortex_ring_edge(mu / inflow) if inflow else -math.inf
    if math.copysign(1.0, thrust) * design.vertical_ratio >= edge * inflow:
        return ""
    speed = design.rotor.tip_speed
    return (
        f"Not trimmed: in descent at {abs(design.vertical_speed):g} m/s and advance ratio {mu:.3f} the rotor is in "
        "or beyond the vortex ring state, where its wake is not steady and momentum theory has no valid answer: "
        f"descend at less than {math.floor(-10.0 * edge * inflow * speed) / 10.0:.1f} m/s, or fly faster than advance "
        f"ratio {math.ceil(1e3 * FASTEST_RING * inflow) / 1e3:.3f}."
    )


def axial_ring(design: Design) -> str:
    """Why axial wind against the thrust leaves no steady wake."""
    end, remedy = "", "change the collective or the climb"
    if (stand := design.condition.stand) is None or stand.collective is None:
        speed = math.sqrt(0.5 * abs(design.weight_coefficient)) * design.rotor.tip_speed
        slow, fast = (
            math.floor(-10.0 * vortex_ring_edge(0.0) * speed) / 10.0,
            math.ceil(20.0 * speed) / 10.0,
        )
        lowest = math.ceil(1e3 * FASTEST_RING * speed / design.rotor.tip_speed) / 1e3
        end = f" up to {fast:.1f} m/s or more"
        remedy = f"descend at less than {slow:.1f} m/s, or fly beyond advance ratio {lowest:.3f}"
    return (
        f"Not trimmed: at {abs(design.vertical_speed):g} m/s the air flows against the thrust. All or part of the wake "
        f"is in the vortex ring state or turbulent, where momentum theory has no valid answer{end}: {remedy}."
    )
