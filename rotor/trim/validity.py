"""Why a design did not trim, or a trim is refused, in sentences for the user."""

import math

import numpy as np

from rotor.aero.elements import BladeElements, DiskSums
from rotor.aero.momentum import FASTEST_RING, vortex_ring_edge
from rotor.aero.problem import Problem
from rotor.design.aircraft import Stand
from rotor.design.design import Design
from rotor.trim.caveats import STALL_SHARE
from rotor.trim.forward import easier_condition

HOVER_LIMIT = 0.17
"""Largest C_T/σ: every blade element at its maximum lift, as tests show (Prouty, Helicopter Performance, Stability, and
Control, 1986, figure 5.2; Bousman, NASA TM-2000-209601, is quoted with 0.18 for SC1095 at tip Mach 0.65)."""
LARGEST_FLAPPING = math.radians(20.0)
"""Coning and flapping, whose equations are those of small angles."""
LARGEST_CONTROL = math.radians(35.0)
"""Collective at 0.75 R and cyclic: no rotor's controls reach further."""
LARGEST_TILT = math.radians(40.0)
"""Shaft tilt: beyond it the rotor flies as a propeller."""


def vortex_ring(design: Design) -> str:
    """Why a descent has no steady wake, as a sentence; empty where it has one."""
    if design.condition.climb_speed >= 0.0:
        return ""
    inflow, mu = math.sqrt(0.5 * design.weight_coefficient), design.condition.advance_ratio
    edge = vortex_ring_edge(mu / inflow)
    if design.climb_ratio >= edge * inflow:
        return ""
    speed = design.rotor.tip_speed
    return (
        f"Not trimmed: in descent at {-design.condition.climb_speed:g} m/s and advance ratio {mu:.3f} the rotor is in "
        "or beyond the vortex ring state, where its wake is not steady and momentum theory has no valid answer: "
        f"descend at less than {math.floor(-10.0 * edge * inflow * speed) / 10.0:.1f} m/s, or fly faster than advance "
        f"ratio {math.ceil(1e3 * FASTEST_RING * inflow) / 1e3:.3f}."
    )


def implausible(problem: Problem, elements: BladeElements, total: DiskSums) -> str:
    """Why a trim that closes is refused all the same, as a sentence; empty where nothing speaks against it."""
    state, design = elements.state, problem.design
    lighter = "lower the mass, the altitude or the speed"
    checks = (
        ("coning", state.coning, LARGEST_FLAPPING, "check the blade's mass and flap inertia, or lower the mass"),
        ("flapping", math.hypot(state.flap_1c, state.flap_1s), LARGEST_FLAPPING, lighter),
        ("collective", state.collective, LARGEST_CONTROL, lighter),
        ("cyclic", math.hypot(state.cyclic_1c, state.cyclic_1s), LARGEST_CONTROL, lighter),
        ("shaft tilt", state.shaft_tilt, LARGEST_TILT, "raise the mass, or lower the speed or the drag area"),
        ("elastic twist", _largest_twist(elements), LARGEST_FLAPPING, "stiffen the blade, or lower the mass"),
    )
    for name, value, largest, remedy in checks:
        if not abs(value) <= largest:
            return (
                f"Not trimmed: the forces balance at a {name} of {math.degrees(value):,.0f}°, beyond "
                f"±{math.degrees(largest):.0f}°, where these equations no longer hold: {remedy}."
            )
    loading = total.thrust / design.rotor.solidity
    if design.hovering and loading > HOVER_LIMIT:
        return (
            f"Not trimmed: hover needs C_T/σ {loading:.3f}, and rotors have reached about {HOVER_LIMIT:g} with every "
            "blade element at its maximum lift: lower the mass or the altitude."
        )
    return ""


def _largest_twist(elements: BladeElements) -> float:
    """Elastic twist of the largest size [rad]; 0 for a rigid blade."""
    if elements.torsion is None:
        return 0.0
    twist = elements.torsion.twist
    return float(twist.flat[np.abs(twist).argmax()])


def _share(stalled: float, reached: float) -> str:
    """How much of the disk is stalled: at the nearest trim found, or where the last attempt ended."""
    where = "there" if 0.0 < reached < 1.0 else "in the last attempt"
    return f" {100.0 * stalled:.0f} % of the disk is stalled {where}." if stalled > STALL_SHARE else ""


def failure_sentence(design: Design, reached: float, stalled: float) -> str:
    """Why a design did not trim, and the remedy."""
    condition = design.condition
    if condition.stand is not None:
        return _stand_failure(design, condition.stand, reached, stalled)
    share = _share(stalled, reached)
    if design.hovering:
        return (
            f"Not trimmed: the hovering rotor produces at most {100.0 * reached:.0f} % of the thrust that "
            f"{condition.mass:.0f} kg at {condition.altitude:.0f} m needs; lower the mass or the altitude."
        )
    near = easier_condition(design, reached)
    how_far = ""
    if reached > 0.0 and near.advance_ratio == condition.advance_ratio:
        how_far = f" A trim exists only up to {math.floor(near.mass)} kg."
    elif reached > 0.0:
        how_far = f" The nearest trim found is at {near.mass:.0f} kg and advance ratio {near.advance_ratio:.3f}."
    return (
        f"Not trimmed: {condition.mass:.0f} kg at {condition.altitude:.0f} m and advance ratio "
        f"{condition.advance_ratio:.3f} is beyond this rotor.{how_far}{share} "
        f"Lower the mass, the altitude or the speed{'' if design.models.flapping else ', or let the blades flap'}."
    )


def _stand_failure(design: Design, stand: Stand, reached: float, stalled: float) -> str:
    """Why a rotor on a test stand did not trim."""
    share = _share(stalled, reached)
    mu = design.condition.advance_ratio
    what = f"the rotor on the stand has no equilibrium at advance ratio {mu:.3f}"
    if stand.collective is not None:
        return (
            f"Not trimmed: {what} with collective {math.degrees(stand.collective):.2f}° and positive thrust.{share} "
            "Change the collective or the advance ratio."
        )
    wanted = design.weight_coefficient / design.rotor.solidity
    how_far = ""
    if 0.0 < reached < 1.0 and not design.hovering:  # In hover it is the share of the thrust.
        near = easier_condition(design, reached).stand
        how_far = f" The nearest trim found is at C_T/σ {near.ct_over_sigma:.4f}." if near is not None else ""
    return f"Not trimmed: {what} with C_T/σ {wanted:.4f}.{how_far}{share} Lower the thrust or the advance ratio."
