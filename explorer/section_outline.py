"""Section outlines in blade axes: a drooped or stretched section lies in the blade as it is built."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rotor.airfoil.contour import SECTION_NAMES, load_contour, resample
from rotor.airfoil.sections import load_installed

Array = NDArray[np.float64]


@lru_cache(maxsize=16)
def blade_axes_outline(section: str, points: int) -> Array:
    """The outline about the quarter chord, y to the leading edge and z up, in reference chords; shape (points, 2).

    Starts at the upper trailing edge and runs over the nose.
    """
    name = next(known for known in sorted(SECTION_NAMES, key=len, reverse=True) if section.startswith(known))
    outline = resample(load_contour(name), points).points
    y, z = 0.25 - outline[:, 0], outline[:, 1]
    installed = load_installed(section)
    cos, sin = np.cos(installed.incidence_offset), np.sin(installed.incidence_offset)
    return installed.chord_ratio * np.stack((y * cos + z * sin, z * cos - y * sin), axis=1)
