"""Camera positions that fit the rotor, or one blade of it, into whatever canvas is left between the panels."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from rotor.arrays import Array

View = Literal["3d", "top", "blade", "side"]
"""From behind and above; the plan; along the marked blade; level, from the advancing side."""

FIELD_OF_VIEW = math.radians(30.0)
"""Vertical [rad]: narrow, so that the near side of the disk is not blown up."""
_MARGIN = 0.955
_ELEVATION = {"3d": math.radians(57.0), "top": math.radians(89.9), "side": math.radians(9.0)}
"""Above the horizon; not quite 90° for the plan, where "up" would be undefined."""
_BEHIND, _ABOVE = math.radians(38.0), math.radians(24.0)
"""The blade is seen from beyond its tip, so far towards its trailing edge, so far above."""


@dataclass(frozen=True, eq=False)
class Camera:
    position: Array
    """[m], shape (3,)."""
    look_at: Array


def fit(view: View, radius: float, aspect: float, azimuth: float = 0.0) -> Camera:
    """The camera of a view, as close as its subject, labels included, allows.

    `aspect`: canvas width over height. `azimuth`: ψ [rad] of the marked blade, for "blade". In "3d" and "top" the nose
    is up and the advancing side right; in "side" the nose is right.
    """
    if view == "blade":
        cos, sin = math.cos(azimuth - _BEHIND), math.sin(azimuth - _BEHIND)
        backward = np.array([cos * math.cos(_ABOVE), sin * math.cos(_ABOVE), math.sin(_ABOVE)])
        return framed(_blade(radius, azimuth), backward, aspect)
    elevation = _ELEVATION[view]
    aside = np.array([0.0, 1.0, 0.0]) if view == "side" else np.array([1.0, 0.0, 0.0])
    backward = math.cos(elevation) * aside + np.array([0.0, 0.0, math.sin(elevation)])
    points = _outline(radius)
    if view == "side":  # Mast, coning and tilt need height where the disk has none; the speed, room ahead.
        points = np.concatenate((points, radius * np.array([[0.0, 0.0, -0.24], [-1.42, 0.0, -0.1], [1.0, 0.0, 0.2]])))
    return framed(points, backward, aspect)


def framed(points: Array, backward: Array, aspect: float, margin: float = _MARGIN) -> Camera:
    """The camera that looks along −`backward`, centred on `points`, as near as they allow within a part of the canvas.

    `backward`: a unit vector, not upright. What it looks at, and turns about, lies in the middle of their depth.
    """
    right = np.cross([0.0, 0.0, 1.0], backward)
    right /= np.linalg.norm(right)
    up = np.cross(backward, right)
    tan_v = margin * math.tan(FIELD_OF_VIEW / 2.0)
    tan_h = tan_v * max(aspect, 0.2)
    reach = points @ backward
    middle, distance = 0.5 * (reach.min() + reach.max()) * backward, 0.0
    for _ in range(30):  # Centre what is seen, then come as near as it allows.
        depth = (points - middle) @ backward
        across, height = (points - middle) @ right, (points - middle) @ up
        distance = float(np.max(np.maximum(np.abs(across) / tan_h, np.abs(height) / tan_v) + depth))
        seen = np.stack((across, height), 1) / (distance - depth)[:, None]
        shift = 0.5 * (seen.max(axis=0) + seen.min(axis=0)) * distance
        middle = middle + 0.7 * (shift[0] * right + shift[1] * up)
    return Camera(middle + distance * backward, middle)


def _outline(radius: float) -> Array:
    psi = np.linspace(0.0, 2.0 * math.pi, 73)
    ring = 1.16 * radius * np.stack((np.cos(psi), np.sin(psi), np.zeros_like(psi)), axis=1)
    # The flight arrow ahead, and room for the labels to either side.
    beyond = np.array([[-1.32, 0.0, 0.0], [0.0, 1.25, 0.0], [0.0, -1.25, 0.0]])
    return np.concatenate((ring, radius * beyond))


def _blade(radius: float, azimuth: float) -> Array:
    """Corners of what a blade at ψ sweeps in height: hub to tip, coned and flapped."""
    out = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
    ahead = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
    return np.array(
        [
            radius * r * out + y * ahead + np.array([0.0, 0.0, height])
            for r, heights in ((0.02, (-0.3, 0.3)), (1.01, (-0.1, 0.75)))
            for y in (-0.45, 0.25)
            for height in heights
        ]
    )
