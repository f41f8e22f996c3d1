"""Main-rotor power by parts, and the textbook closed form of profile power.

Induced Σ λ_i dF_z, profile Σ U dD (dissipation), parasite D·V. With periodic flapping and forces in balance their sum
is the shaft power Σ Ωy dF_x (3.10), (3.13) as an identity of the discretised equations: from U_T dF_x = U_P dF_z + U dD
and r = U_T − µ_x sin ψ,

    P_shaft = Σ (λ_i dF_z + U dD) + µ_z C_T − µ_x C_H,    and    µ_z T − µ_x H = D·V.

Without the axial flow of the tilted disk (3.6 as printed) the torque lacks D·V and more, so there the sum of parts *is*
the power.
"""

import numpy as np

from rotor.aero import kernel
from rotor.aero.elements import Pass, Problem
from rotor.aero.tail_rotor import tail_rotor_power
from rotor.arrays import Array
from rotor.design.design import Design
from rotor.design.tail_rotor import FIXED_SHARE
from rotor.trim.solution import PowerBudget


def power_budget(problem: Problem, one: Pass) -> PowerBudget:
    """Power [W] by parts, torque × Ω beside them."""
    design, disk, loads = problem.design, problem.disk, one.loads
    unit = design.power_unit * disk.dr / len(disk.psi)
    cubed: Array = np.hypot(one.u_t, one.u_p) ** 3 * loads[kernel.CD]
    dissipation: Array = disk.half_solidity @ cubed
    induced = float((one.induced * loads[kernel.FZ]).sum()) * unit
    profile = float(dissipation.sum()) * unit
    parasite = problem.drag * design.condition.advance_ratio * design.power_unit
    shaft = float((disk.r @ loads[kernel.FX]).sum()) * unit
    main = induced + profile + parasite
    tail, _ = tail_power(design, main)
    return PowerBudget(induced=induced, profile=profile, parasite=parasite, tail=tail, shaft=shaft)


def tail_power(design: Design, main: float) -> tuple[float, float]:
    """Tail rotor power [W] beside a main rotor's [W], and its slope by that: solved, or the document's fixed share.

    The share also stands where the aircraft has no tail rotor, or an unknown one.
    """
    if design.tail_rotor is None or not design.models.tail_rotor_solved:
        return FIXED_SHARE * main, FIXED_SHARE
    speed = design.rotor.angular_speed
    tail, slope = tail_rotor_power(design.tail_rotor, main / speed, design.airspeed, design.condition.density)
    return tail, slope / speed


def profile_power_coefficient(solidity: float, drag_coefficient: float, advance_ratio: float) -> float:
    """C_P0 = σC_d0/8 (1 + 3µ² + ⅜µ⁴) of a blade from the centre with constant drag, reverse flow included.

    It is eq. (3.15) integrated, with its first coefficient σC_d0/4π: printed as σC_d0/2π it would double the σC_d0/8 of
    hover. The second, σC_d0/2π over the reverse-flow region, is right: it turns −∫ there into +∫.
    """
    mu = advance_ratio
    return solidity * drag_coefficient / 8.0 * (1.0 + 3.0 * mu**2 + 0.375 * mu**4)
