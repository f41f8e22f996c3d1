"""Camera positions that fit the rotor or a blade into the canvas, and the section that a click means."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from explorer.model.inputs import ViewState
from explorer.picture.blade_mesh import blade_shape
from explorer.picture.picture import (
    composed_rotation,
    disk_drop,
    flown_form,
    rotate,
    rotor_pose,
    tip_path_pose,
    turned_blades,
)
from rotor import Solution
from rotor.support.arrays import Array

View = Literal["3d", "disk", "top", "blade", "side"]
"""The aircraft from behind and starboard; the disk from behind and above; the plan; along the reference blade; level,
from the advancing side."""

FIELD_OF_VIEW = math.radians(26.0)
"""Vertical [rad]: narrow, so that the near side of the disk is not blown up."""
_MARGIN = 0.955
_USUAL_TILT = math.radians(3.0)
_FOLLOWS_TILT = 0.8
"""How much of a further shaft tilt the camera rises with, so that it keeps its angle to the disk."""
_ELEVATION = {"disk": math.radians(89.9), "top": math.radians(89.9), "side": math.radians(9.0)}
"""Above the horizon; not quite 90° for the plan, where "up" would be undefined."""
_BEHIND, _ABOVE = math.radians(38.0), math.radians(24.0)
"""The blade is seen from beyond its tip, so far towards its trailing edge, so far above."""

_STAND = math.radians(34.0), math.radians(24.0)
"""From where the camera of "3d" looks: azimuth from behind the tail, and elevation."""
_STAND_RIM = 1.13
"""Radius of the circle on which the words round the rim begin [R]."""
_STAND_AIRFRAME = ((1.26, 0.0, 0.14), (1.26, 0.0, -0.30), (-0.65, 0.0, -0.45), (0.55, 0.0, -0.50))
"""Tail rotor, tail wheel, nose and main wheels, from the hub [R]."""


@dataclass(frozen=True, eq=False)
class Camera:
    position: Array
    """[m], shape (3,)."""
    look_at: Array
    """[m], shape (3,)."""


@dataclass(frozen=True)
class Covered:
    """Fractions of the canvas that cards cover along its edges: of its height above and below, of its width left and
    right. The subject stands in the rectangle between them."""

    above: float = 0.16
    """The usual ones are those of a screen of 1500 × 940 pixels."""
    below: float = 0.27
    left: float = 0.0
    right: float = 0.0

    @property
    def free(self) -> float:
        """The fraction of the height that is left."""
        return 1.0 - self.above - self.below

    @property
    def lift(self) -> float:
        """How far the middle of the free part lies above the middle of the canvas, over its height."""
        return 0.5 * (self.below - self.above)

    @property
    def aside(self) -> float:
        """How far the middle of the free part lies right of the middle of the canvas, over its width."""
        return 0.5 * (self.left - self.right)

    def free_aspect(self, aspect: float) -> float:
        """Width over height of the free part of a canvas with this width over height."""
        return aspect * (1.0 - self.left - self.right) / self.free


@dataclass(frozen=True)
class CameraShot:
    """A camera from any side on a part of the rotor."""

    azimuth_deg: float
    """From where; 0 is behind the tail, 90 the advancing side."""
    elevation_deg: float
    centre: tuple[float, float, float]
    """Centre of the box that fills the canvas, from the hub [R]."""
    half: tuple[float, float, float]
    """Half its size [R]."""

    def fit(self, radius: float, aspect: float) -> Camera:
        """For a rotor of this radius [m] and a canvas of this width over height, without cards."""
        backward = direction(math.radians(self.azimuth_deg), math.radians(self.elevation_deg))
        corners = np.array(
            [[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)]
        )
        return framed(
            radius * (np.array(self.centre) + corners * np.array(self.half)), backward, aspect
        )


def direction(azimuth: float, elevation: float) -> Array:
    """From the rotor towards a camera, a unit vector; azimuth and height above the horizon [rad]."""
    level = math.cos(elevation)
    return np.array([math.cos(azimuth) * level, math.sin(azimuth) * level, math.sin(elevation)])


USUAL_COVER = Covered()
UNCOVERED = Covered(0.04, 0.04)
"""A margin: for pictures without cards."""


def fit(
    view: View,
    radius: float,
    aspect: float,
    azimuth: float = 0.0,
    tilt: float = _USUAL_TILT,
    cover: Covered = USUAL_COVER,
    towards: Array | None = None,
) -> Camera:
    """The camera of a view, as close as its subject, words included, allows between the cards.

    `aspect`: canvas width over height. `azimuth`: ψ [rad] of the reference blade, for "blade". `tilt`: of the shaft
    [rad]. `cover`: what cards hide of the canvas. `towards`: a unit vector, to a viewer who stands elsewhere. In "disk"
    and "top" the nose is up and the advancing side right; in "side" the nose is right.
    """
    if view == "blade":
        points, backward = _blade(radius, azimuth), direction(azimuth - _BEHIND, _ABOVE)
    elif view == "3d" and towards is None:
        backward = direction(_STAND[0], _STAND[1] + _FOLLOWS_TILT * (tilt - _USUAL_TILT))
        points = _aircraft(radius)
    else:
        psi = np.linspace(0.0, 2.0 * math.pi, 73)  # The rim with the words round it.
        points = 1.2 * radius * np.stack((np.cos(psi), np.sin(psi), np.zeros_like(psi)), axis=1)
        backward = direction(
            math.radians(90.0) if view == "side" else 0.0, _ELEVATION.get(view, 0.0)
        )
        # The airframe, coning and tilt need height where the disk has none.
        if view in (
            "side",
            "3d",
        ):
            more = [[0.0, 0.0, -0.5], [1.45, 0.0, -0.2], [1.0, 0.0, 0.2]]
            points = np.concatenate((points, radius * np.array(more)))
    subject = framed(
        points,
        backward if towards is None else towards,
        cover.free_aspect(aspect),
        _MARGIN * cover.free,
    )
    return _shifted(subject, cover, aspect)


def seen_at(camera: Camera, points: Array, aspect: float) -> Array:
    """Where points (n, 3) [m] stand in a picture of this width over height, (n, 2): fractions from the left and from
    above; outside 0…1 they are not in it."""
    right, down, forward = camera_axes(camera)
    away = points - camera.position
    sight = 2.0 * math.tan(FIELD_OF_VIEW / 2.0) * (away @ forward)
    return 0.5 + np.stack((away @ right / (aspect * sight), away @ down / sight), axis=1)


def camera_axes(camera: Camera) -> tuple[Array, Array, Array]:
    """Right, down and forward of an upright camera, unit vectors."""
    forward = camera.look_at - camera.position
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    return right, np.cross(forward, right), forward


def _aircraft(radius: float) -> Array:
    """The circle round the rim on which its words stand, and the ends of the airframe below it."""
    psi = np.linspace(0.0, 2.0 * math.pi, 73)
    rim = _STAND_RIM * np.stack((np.cos(psi), np.sin(psi), np.zeros_like(psi)), axis=1)
    return radius * np.concatenate((rim, np.array(_STAND_AIRFRAME)))


def between_cards(camera: Camera, cover: Covered, aspect: float) -> Camera:
    """From a camera that fills a canvas of the size of the free part to one that fills that part of the whole canvas.

    `aspect`: width over height of the whole canvas.
    """
    sight = (camera.position - camera.look_at) / cover.free
    return _shifted(Camera(camera.look_at + sight, camera.look_at), cover, aspect)


def _shifted(camera: Camera, cover: Covered, aspect: float) -> Camera:
    """What the camera shows in the middle of the canvas, in the middle of the free part."""
    right, down, _ = camera_axes(camera)
    distance = float(np.linalg.norm(camera.position - camera.look_at))
    height = 2.0 * distance * math.tan(FIELD_OF_VIEW / 2.0)
    shift = height * (cover.lift * down - cover.aside * aspect * right)
    return Camera(camera.position + shift, camera.look_at + shift)


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


RIDE_VIEW = math.radians(60.0)
"""Vertical [rad] of the camera that rides with a section: wide, so that horizon and disk are in sight."""
RIDE_EYE, RIDE_LOOK = (-0.06, -0.40, 0.16), (0.04, 0.35, -0.113)
"""Where it stands and looks, from the section: out, ahead and up [R]. Behind the trailing edge, the horizon above."""


_CONJUGATE = np.array([1.0, -1.0, -1.0, -1.0])
"""Times a unit quaternion: the rotation back."""
_REACH_MARGIN = 0.02
"""A click this far [R] beside the blade's reach still means its end."""


def pick_blade(
    solution: Solution, view: ViewState, origin: ArrayLike, direction: ArrayLike
) -> tuple[float, float] | None:
    """(r/R, ψ [deg]) of the section that a ray of the world meets first on a blade as it is drawn: twisted, flapped,
    bent. None where it misses all blades."""
    rotor = solution.design.rotor
    cutout, hinge = rotor.blade.root_cutout, rotor.blade.flap_hinge * rotor.radius
    shaft, shape = rotor_pose(solution.controls).wxyz, blade_shape(rotor)
    nearest, found = math.inf, None
    for k, pose in enumerate(turned_blades(solution, view, each=False).poses):
        psi_deg = (view.azimuth_deg + 360.0 * k / rotor.blades) % 360.0
        back = composed_rotation(shaft, pose.wxyz) * _CONJUGATE
        start = rotate(back, np.asarray(origin, dtype=np.float64) - rotate(shaft, pose.position))
        along = rotate(back, np.asarray(direction, dtype=np.float64))
        vertices = flown_form(solution, view, math.radians(psi_deg)).vertices(shape)
        distance = _first_hit(vertices[shape.faces], start, along)
        if distance < nearest:
            r = (
                float((start + distance * along)[0]) + hinge
            ) / rotor.radius  # Sections stand across the blade's x.
            nearest, found = distance, (min(max(r, cutout), 1.0), psi_deg)
    return found


def _first_hit(triangles: Array, start: Array, along: Array) -> float:
    """How many times `along` from `start` a ray meets the first of the triangles, (n, 3, 3); ∞ where it meets none.

    Möller and Trumbore, Journal of Graphics Tools 2 (1997) 21.
    """
    corner, one, other = (
        triangles[:, 0],
        triangles[:, 1] - triangles[:, 0],
        triangles[:, 2] - triangles[:, 0],
    )
    across = np.cross(along, other)
    with np.errstate(divide="ignore", invalid="ignore"):  # Triangles seen edge-on.
        scale = 1.0 / np.einsum("ij,ij->i", one, across)
        u = scale * ((start - corner) * across).sum(axis=1)
        turned = np.cross(start - corner, one)
        v, distance = scale * (turned @ along), scale * (other * turned).sum(axis=1)
        met = distance[(u >= 0.0) & (v >= 0.0) & (u + v <= 1.0) & (distance > 0.0)]
    return float(met.min(initial=math.inf))


def pick(solution: Solution, origin: ArrayLike, direction: ArrayLike) -> tuple[float, float] | None:
    """(r/R, ψ [rad]) where a ray of the world meets the drawn disk; None where it misses the blades' annulus."""
    rotor, controls = solution.design.rotor, solution.controls
    shaft, disk = rotor_pose(controls), tip_path_pose(controls, disk_drop(rotor))
    turn = composed_rotation(shaft.wxyz, disk.wxyz)
    centre = shaft.position + rotate(shaft.wxyz, disk.position)
    start, along = np.asarray(origin, dtype=np.float64), np.asarray(direction, dtype=np.float64)
    back = turn * _CONJUGATE
    start, along = rotate(back, start - centre), rotate(back, along)
    if abs(along[2]) < 1e-9 * float(np.linalg.norm(along)):
        return None  # Along the plane: it is seen edge-on.
    distance = -start[2] / along[2]
    if distance <= 0.0:
        return None  # The disk is behind the viewer.
    x, y, _ = (start + distance * along) / rotor.radius
    r, cutout = math.hypot(x, y), rotor.blade.root_cutout
    if not cutout - _REACH_MARGIN <= r <= 1.0 + _REACH_MARGIN:
        return None
    return min(max(r, cutout), 1.0), math.atan2(y, x) % (2.0 * math.pi)
