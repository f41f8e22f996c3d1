"""Where the tip vortices of HART II lay, beside the wake course of a lifting line."""

import math
from dataclasses import dataclass

import numpy as np

from rotor.aero.lifting_line.geometry import WakeCourse
from rotor.arrays import Array
from rotor.assets import asset_path, csv_rows


@dataclass(frozen=True, eq=False)
class Vortices:
    """Centres of tip vortices over R in axes of the hub: x aft, y to starboard, z up; (points,) each."""

    case: str
    x: Array
    y: Array
    z: Array


def measured_vortices(case: str) -> Vortices:
    """Those of one case, `BL` or `MN`."""
    rows = [row for row in csv_rows(asset_path("measured/hart2_vortices.csv")) if row["case"] == case]
    x, y, z = (np.array([float(row[name]) for row in rows]) for name in "xyz")
    return Vortices(case, x, y, z)


def height(course: WakeCourse, x: Array, y: Array) -> Array:
    """z/R of the tip vortices that left the front edge of the disk, where they pass over x, y inside it, (points,).

    A vortex moves along x alone; what passes one place in the disk has left at one azimuth.
    """
    found = np.empty_like(x)
    for k, (aft, side) in enumerate(zip(x.tolist(), y.tolist(), strict=True)):
        released = math.pi - math.asin(side)
        age = (aft - math.cos(released)) / course.mu_x
        found[k] = course.nodes(np.array([released + age]), np.array([age]), np.ones(1))[0, 0, 0, 2]
    return found
