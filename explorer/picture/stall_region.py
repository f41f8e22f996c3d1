"""Where the blade stalls: both stall angles of every element, and the margin between them on any grid."""

from functools import lru_cache

import numpy as np

from explorer.picture.polar import PolarGrid
from rotor.aero.elements import LOW_MACH
from rotor.arrays import Array
from rotor.trim.solution import Solution


@lru_cache(maxsize=8)  # A blade that turns asks again and again for the same answer's.
def stall_angles(solution: Solution) -> tuple[Array, Array]:
    """Negative and positive stall angle [rad] about the blade's reference line, (elements, azimuths) each.

    Of the last few solutions they are kept: do not write into them.
    """
    disk, blade = solution.disk, solution.design.rotor.blade
    places = [blade.section_at(float(r)) for r in disk.r]
    lower, upper = np.zeros_like(disk.mach), np.zeros_like(disk.mach)
    mach = disk.mach if solution.design.models.compressibility else np.full_like(disk.mach, LOW_MACH)
    for name in {span.section for span in blade.spans}:
        section = blade.installed(name)
        share = np.array([(1.0 - w) * (inner == name) + w * (outer == name) for inner, outer, w in places])[:, None]
        negative, positive = section.table.stall_alpha(mach)
        lower += share * (negative + section.incidence_offset)
        upper += share * (positive + section.incidence_offset)
    return lower, upper


def angle_of_attack(solution: Solution, grid: PolarGrid) -> Array:
    """α [rad] from refined θ, U_T, U_P: these are smooth where α itself runs through ±180°.

    Not wrapped: only reverse flow, where it is not shown, goes beyond half a turn.
    """
    disk = solution.disk
    return grid.refine(disk.theta) - np.arctan2(grid.refine(disk.u_p), grid.refine(disk.u_t))


def stall_margin(solution: Solution, grid: PolarGrid) -> Array:
    """Angle left before stall [rad], from the refined α and refined stall angles.

    The margin itself falls by a radian within one element beside reverse flow; the stall angles do not.
    """
    lower, upper = stall_angles(solution)
    alpha = angle_of_attack(solution, grid)
    return np.minimum(grid.refine(upper) - alpha, alpha - grid.refine(lower))
