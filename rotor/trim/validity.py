"""The limits of validity of a solution, and why a design did not trim, in sentences for the user."""

import math

from rotor.aero import kernel
from rotor.aero.elements import BladeElements, Problem
from rotor.aero.switches import switched_off
from rotor.design.aircraft import FIXED_SHARE
from rotor.design.design import Design
from rotor.trim.forward import easier_condition
from rotor.trim.solution import Caveat, HubMoment

LOW_SPEED = 0.075
"""Below this advance ratio linear inflow is not trusted (thesis p. 26)."""
LOWEST_SPEED = 0.05
"""Below it the dynamic wake has not been compared with a vortex wake; a real wake rolls up there."""
HIGH_SPEED = 0.40
"""Above it reverse flow and unsteady stall dominate, and quasi-steady section data no longer suffice."""
STALL_SHARE = 0.02
"""Stalled part of the disk above which dynamic stall would change the results."""


def caveats(problem: Problem, elements: BladeElements, stalled: float, moment: HubMoment) -> tuple[Caveat, ...]:
    """The limits of validity that a converged solution exceeds."""
    design, disk = problem.design, problem.disk
    mu = design.condition.advance_ratio
    found: list[Caveat] = []

    def add(name: str, sentence: str) -> None:
        found.append(Caveat(name, sentence))

    for remark in design.aircraft.remarks:
        add("rotor-file", remark)
    if design.aircraft.hub == "teetering":
        add(
            "teetering",
            "A teetering hub has built-in coning; here the blades cone as if each were hinged at the shaft.",
        )
    if design.tail_rotor is None and design.models.tail_rotor_solved:
        add(
            "no-tail-rotor",
            f"The rotor file has no tail rotor: {100.0 * FIXED_SHARE:.0f} % of main-rotor power is used instead.",
        )
    if design.preset == "thesis" and design.aircraft.stated is None:
        add(
            "thesis-models",
            f"The document does not treat the {design.aircraft.name}: these are its models with this rotor's blade.",
        )
    off = switched_off(design.models)
    if off:
        names = ", ".join(switch.title.lower() for switch in off)
        add("switched-off", f"Switched off: {names}. The result is for teaching, not for the aircraft.")
    if not design.models.flapping and mu > 0.0:
        add("rigid-blades", _rigid(moment))
        if not problem.inflow.load_dependent:
            add(
                "rigid-blades-linear-inflow",
                "Linear inflow does not respond to unequal lift: the induced power of rigid blades is too low.",
            )
    if design.active_twist and design.hovering:
        add("active-twist-rests", "Active twist is off in hover, where only the twist law acts.")
    if 0.0 < mu < LOW_SPEED and not problem.inflow.load_dependent:
        add("low-speed-inflow", f"Linear inflow is not valid below advance ratio {LOW_SPEED:g}; this is {mu:.3f}.")
    elif 0.0 < mu < LOWEST_SPEED:
        add(
            "low-speed-inflow",
            f"No skewed-wake model is validated below advance ratio {LOWEST_SPEED:g}; this is {mu:.3f}.",
        )
    if mu > HIGH_SPEED:
        add(
            "high-speed",
            f"Above advance ratio {HIGH_SPEED:.2f} quasi-steady sections and rigid blades are a rough approximation.",
        )
    if stalled > STALL_SHARE:
        add(
            "stall",
            f"{100.0 * stalled:.1f} % of the disk is stalled; section data are steady, without dynamic stall.",
        )
    top_mach = float(elements.loads[kernel.MACH].max())
    if disk.fit_range is not None:
        if top_mach > 0.5:
            add(
                "no-compressibility",
                f"The section polar holds for one Mach number (0.3); the tip reaches Mach {top_mach:.2f}.",
            )
        clamped = _outside_fit(problem, elements, disk.fit_range)
        if clamped > 0.0:
            add(
                "polynomial-clamped",
                f"{100.0 * clamped:.1f} % of the disk is outside the fitted range of the polynomials and clamped.",
            )
    elif top_mach > disk.mach_limit:
        add(
            "mach-outside-data",
            f"The tip reaches Mach {top_mach:.2f}; section data end at {disk.mach_limit:.2f} and are constant above.",
        )
    return tuple(found)


def _rigid(moment: HubMoment) -> str:
    side = "retreating" if moment.roll >= 0.0 else "advancing"
    nose = "up" if moment.pitch >= 0.0 else "down"
    return (
        f"Rigid blades without cyclic: the hub carries {abs(moment.roll) / 1e3:.0f} kN m rolling to the {side} side "
        f"and {abs(moment.pitch) / 1e3:.0f} kN m nose-{nose}."
    )


def failure_sentence(design: Design, reached: float, stalled: float) -> str:
    """Why a design did not trim, and the remedy."""
    condition = design.condition
    share = f" {100.0 * stalled:.0f} % of the disk is stalled in the last attempt." if stalled > STALL_SHARE else ""
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


def _outside_fit(problem: Problem, elements: BladeElements, fit_range: tuple[float, float]) -> float:
    """Part of πR², reverse flow not counted, where a polynomial polar is clamped."""
    disk = problem.disk
    low, high = fit_range
    alpha = elements.loads[kernel.ALPHA]
    outside = ((alpha < low) | (alpha > high)) & (elements.u_t >= 0.0)
    return float((2.0 * disk.r[:, None] * disk.dr / len(disk.psi) * outside).sum())
