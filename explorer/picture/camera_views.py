"""Camera positions that fit the rotor or a blade into the canvas, and from a click to a point of the disk."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from explorer.picture.picture import disk_drop
from explorer.picture.poses import compose, rotate, rotor_pose, tip_path_pose
from rotor.arrays import Array
from rotor.trim.solution import Solution

View = Literal["3d", "disk", "top", "blade", "side"]
"""The aircraft from behind and starboard; the disk from behind and above; the plan; along the reference blade; level,
from the advancing side."""

FIELD_OF_VIEW = math.radians(26.0)
"""Vertical [rad]: narrow, so that the near side of the disk is not blown up."""
_MARGIN = 0.955
_DRAWN_FOR = 8.1788
"""Radius [m] that the fixed measures below are given for."""
_USUAL_TILT = math.radians(3.0)
_FOLLOWS_TILT = 0.8
"""How much of a further shaft tilt the camera rises with, so that it keeps its angle to the disk."""
_ELEVATION = {"top": math.radians(89.9), "side": math.radians(9.0)}
"""Above the horizon; not quite 90° for the plan, where "up" would be undefined."""
_BEHIND, _ABOVE = math.radians(38.0), math.radians(24.0)
"""The blade is seen from beyond its tip, so far towards its trailing edge, so far above."""


@dataclass(frozen=True)
class _Stand:
    """Where a camera stands that is not fitted but composed, for bars and cards along the edges of the canvas."""

    azimuth: float
    """[rad]; 0 is behind the tail."""
    elevation: float
    look_at: tuple[float, float, float]
    """[m] from the hub."""
    distance: float
    """[m]"""
    aspect: float
    """Width over height of the canvas below which the camera stands further back."""


_STANDS = {
    "3d": _Stand(math.radians(34.0), math.radians(24.0), (0.9, 0.3, -2.35), 33.5, 1.6),
    "disk": _Stand(math.radians(0.02), math.radians(46.0), (1.0, 0.0, -2.0), 48.0, 1.05),
}
BESIDE = 1.66
"""How many times as far the camera stands from two rotors side by side."""


@dataclass(frozen=True, eq=False)
class Camera:
    position: Array
    """[m], shape (3,)."""
    look_at: Array


USUALLY_COVERED = 0.27
"""Fraction of the canvas, from below, that cards cover on a screen of 1500 × 940 pixels."""


def fit(
    view: View,
    radius: float,
    aspect: float,
    azimuth: float = 0.0,
    tilt: float = _USUAL_TILT,
    covered: float = USUALLY_COVERED,
) -> Camera:
    """The camera of a view, as close as its subject, words included, allows.

    `aspect`: canvas width over height. `azimuth`: ψ [rad] of the reference blade, for "blade". `tilt`: of the shaft
    [rad]. `covered`: fraction of the canvas that cards cover from below. In "disk" and "top" the nose is up and the
    advancing side right; in "side" the nose is right.
    """
    if view == "blade":
        cos, sin = math.cos(azimuth - _BEHIND), math.sin(azimuth - _BEHIND)
        backward = np.array([cos * math.cos(_ABOVE), sin * math.cos(_ABOVE), math.sin(_ABOVE)])
        return framed(_blade(radius, azimuth), backward, aspect)
    if view in _STANDS:
        return _above_cards(_standing(_STANDS[view], radius / _DRAWN_FOR, aspect, tilt), covered)
    elevation = _ELEVATION[view]
    aside = np.array([0.0, 1.0, 0.0]) if view == "side" else np.array([1.0, 0.0, 0.0])
    backward = math.cos(elevation) * aside + np.array([0.0, 0.0, math.sin(elevation)])
    points = _outline(radius)
    if view == "side":  # The airframe, coning and tilt need height where the disk has none.
        points = np.concatenate((points, radius * np.array([[0.0, 0.0, -0.5], [1.35, 0.0, -0.2], [1.0, 0.0, 0.2]])))
    return framed(points, backward, aspect)


def reader(view: View) -> tuple[float, float]:
    """For words that lie on the disk: the azimuth [rad] a view is seen from, and how much taller they should be."""
    stand = _STANDS.get(view, _STANDS["disk"])
    return stand.azimuth, min(0.85 / math.sin(stand.elevation), 2.2)


def _standing(stand: _Stand, size: float, aspect: float, tilt: float) -> Camera:
    elevation = stand.elevation + _FOLLOWS_TILT * (tilt - _USUAL_TILT)
    level = math.cos(elevation)
    backward = np.array([math.cos(stand.azimuth) * level, math.sin(stand.azimuth) * level, math.sin(elevation)])
    look_at = size * np.array(stand.look_at)
    return Camera(look_at + size * stand.distance * max(1.0, stand.aspect / max(aspect, 0.2)) * backward, look_at)


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
    """The rim with the words round it."""
    psi = np.linspace(0.0, 2.0 * math.pi, 73)
    return 1.2 * radius * np.stack((np.cos(psi), np.sin(psi), np.zeros_like(psi)), axis=1)


def _above_cards(camera: Camera, covered: float) -> Camera:
    """The same composition in the part of the canvas that is free, where cards cover more of it than usual."""
    if covered <= USUALLY_COVERED:
        return camera
    sight = (camera.position - camera.look_at) * (1.0 - USUALLY_COVERED) / (1.0 - covered)
    backward = sight / np.linalg.norm(sight)
    up = np.array([0.0, 0.0, 1.0]) - backward[2] * backward
    height = 2.0 * float(np.linalg.norm(sight)) * math.tan(FIELD_OF_VIEW / 2.0)
    lower = 0.5 * (covered - USUALLY_COVERED) * height * up / np.linalg.norm(up)
    return Camera(camera.look_at - lower + sight, camera.look_at - lower)


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
