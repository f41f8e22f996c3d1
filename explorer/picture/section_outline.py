"""Section outlines in blade axes: a drooped or stretched section lies in the blade as it is built."""

from functools import lru_cache

import numpy as np

from rotor.airfoil.contour import resample
from rotor.airfoil.sections import Section
from rotor.arrays import Array


@lru_cache(maxsize=32)
def blade_axes_outline(section: Section, points: int) -> Array:
    """The outline about the quarter chord, y to the leading edge and z up, in reference chords; shape (points, 2).

    Starts at the upper trailing edge and runs over the nose.
    """
    outline = resample(section.outline, points).points
    y, z = 0.25 - outline[:, 0], outline[:, 1]
    cos, sin = np.cos(section.incidence_offset), np.sin(section.incidence_offset)
    return section.chord_ratio * np.stack((y * cos + z * sin, z * cos - y * sin), axis=1)
