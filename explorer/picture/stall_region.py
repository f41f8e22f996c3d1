"""Where the blade stalls: both stall angles of every element, and the margin between them on any grid."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from explorer.picture.polar import PolarGrid, Single
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


@dataclass(frozen=True, eq=False)
class Refined:
    """What pictures read of the flow on a polar grid, shape (radii, azimuths) each; not to be written into."""

    u_t: Single
    """U_T/ΩR; negative in reverse flow."""
    alpha: Single
    """Angle of attack [rad], from refined θ, U_T, U_P: these are smooth where α itself runs through ±180°.

    Not wrapped: only reverse flow, where it is not shown, goes beyond half a turn.
    """
    lower: Single
    """Negative stall angle [rad]."""
    upper: Single
    """Positive stall angle [rad]."""

    @property
    def margin(self) -> Single:
        """Angle left before stall [rad]; negative where stalled."""
        return np.minimum(self.upper - self.alpha, self.alpha - self.lower)


@lru_cache(maxsize=3)  # The field and the marked regions of one picture share it.
def refined(solution: Solution, grid: PolarGrid) -> Refined:
    """The flow and the stall angles of a solution on a polar grid.

    The margin itself falls by a radian within one element beside reverse flow; the stall angles do not.
    """
    disk = solution.disk
    lower, upper = stall_angles(solution)
    theta, u_t, u_p, low, high = grid.refine_all((disk.theta, disk.u_t, disk.u_p, lower, upper))
    return Refined(u_t, theta - np.arctan2(u_p, u_t), low, high)


def angle_of_attack(solution: Solution, grid: PolarGrid) -> Array:
    """α [rad] on a polar grid in full precision, shape (radii, azimuths)."""
    disk = solution.disk
    return grid.refine(disk.theta) - np.arctan2(grid.refine(disk.u_p), grid.refine(disk.u_t))


def stall_margin(solution: Solution, grid: PolarGrid) -> Array:
    """Angle left before stall [rad] on a polar grid in full precision, shape (radii, azimuths)."""
    lower, upper = stall_angles(solution)
    alpha = angle_of_attack(solution, grid)
    return np.minimum(grid.refine(upper) - alpha, alpha - grid.refine(lower))
