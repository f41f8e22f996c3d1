"""From a click to a point of the disk: the ray of sight meets the plane the blade tips run in."""

import math

import numpy as np
from numpy.typing import ArrayLike

from explorer.picture.picture import disk_drop
from explorer.picture.poses import compose, rotate, rotor_pose, tip_path_pose
from rotor.trim.solution import Solution

_BESIDE = 0.02
"""A click this far [R] beside the blade's reach still means its end."""


def pick(solution: Solution, origin: ArrayLike, direction: ArrayLike) -> tuple[float, float] | None:
    """(r/R, ψ [rad]) where a ray of the world meets the drawn disk; None where it misses the blades' annulus."""
    rotor, controls = solution.design.rotor, solution.controls
    shaft, disk = rotor_pose(controls), tip_path_pose(controls, disk_drop(rotor))
    turn = compose(shaft.wxyz, disk.wxyz)
    centre = shaft.position + rotate(shaft.wxyz, disk.position)
    start, along = np.asarray(origin, dtype=np.float64), np.asarray(direction, dtype=np.float64)
    back = turn * np.array([1.0, -1.0, -1.0, -1.0])
    start, along = rotate(back, start - centre), rotate(back, along)
    if abs(along[2]) < 1e-9 * float(np.linalg.norm(along)):
        return None  # Along the plane: it is seen edge-on.
    distance = -start[2] / along[2]
    if distance <= 0.0:
        return None  # The disk is behind the viewer.
    x, y, _ = (start + distance * along) / rotor.radius
    r, cutout = math.hypot(x, y), rotor.blade.root_cutout
    if not cutout - _BESIDE <= r <= 1.0 + _BESIDE:
        return None
    return min(max(r, cutout), 1.0), math.atan2(y, x) % (2.0 * math.pi)
