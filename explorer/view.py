"""Camera positions that fit the rotor into whatever canvas is left between the panels."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
View = Literal["3d", "top"]

FIELD_OF_VIEW = math.radians(30.0)
"""Vertical [rad]: narrow, so that the near side of the disk is not blown up."""
_ELEVATION = {"3d": math.radians(57.0), "top": math.radians(89.9)}
"""Above the horizon; not quite 90° for the plan, where "up" would be undefined."""
_MARGIN = 0.955


@dataclass(frozen=True, eq=False)
class Camera:
    position: Array
    """[m], shape (3,)."""
    look_at: Array


def fit(view: View, radius: float, aspect: float) -> Camera:
    """The camera behind and above the rotor, close enough that disk, labels and arrow just fill the canvas.

    `aspect`: canvas width over height. Nose up, tail down, advancing side to the right.
    """
    elevation = _ELEVATION[view]
    backward = np.array([math.cos(elevation), 0.0, math.sin(elevation)])
    up = np.array([-math.sin(elevation), 0.0, math.cos(elevation)])
    right = np.array([0.0, 1.0, 0.0])
    tan_v = math.tan(FIELD_OF_VIEW / 2.0) * _MARGIN
    tan_h = tan_v * max(aspect, 0.2)
    points = _outline(radius)
    across, height, depth = points @ right, points @ up, points @ backward
    low, high = -2.0 * radius, 2.0 * radius
    distance = 0.0
    # The height at which top and bottom need the same distance centres the picture.
    for _ in range(40):
        centre = 0.5 * (low + high)
        above = float(np.max((height - centre) / tan_v + depth))
        below = float(np.max((centre - height) / tan_v + depth))
        low, high = (centre, high) if above > below else (low, centre)
        distance = max(above, below, float(np.max(np.abs(across) / tan_h + depth)))
    look_at = 0.5 * (low + high) * up
    return Camera(look_at + distance * backward, look_at)


def _outline(radius: float) -> Array:
    psi = np.linspace(0.0, 2.0 * math.pi, 73)
    ring = 1.16 * radius * np.stack((np.cos(psi), np.sin(psi), np.zeros_like(psi)), axis=1)
    # The flight arrow ahead, and room for the labels to either side.
    beyond = np.array([[-1.32, 0.0, 0.0], [0.0, 1.25, 0.0], [0.0, -1.25, 0.0]])
    return np.concatenate((ring, radius * beyond))
