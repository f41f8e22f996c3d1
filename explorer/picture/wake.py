"""Lines about the rotor as segments in the axes of the shaft [m]: the tip vortices."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotor import Solution
from rotor.aero.disk import azimuths_of
from rotor.aero.lifting_line import WakeCourse
from rotor.support.arrays import Array
from rotor.trim import DiskFields

_TURNS = 0.8
"""Length of a drawn vortex, in turns of the rotor."""
_POINTS = 59
_AGES, _COLUMNS = 21, 12
"""Ages, and azimuths at which a vortex left, for which its path is computed."""
_COURSE_COLUMNS = 72
"""Azimuths along the course of a lifting line, which bends where the vortex leaves the disk."""
_WIDTH = 0.25
"""Part of the radius over which the inflow at a tip vortex is averaged."""
_CONTRACTION, _CONTRACTS_WITHIN = 0.22, 2.2
"""In hover the wake contracts towards 0.78 R (Landgrebe, 1972), by a factor e within this age [rad]."""


@dataclass(frozen=True)
class TipVortexPath:
    """Where the air goes that left a tip: with the stream, and down with the inflow that it meets. All in radii.

    `radius` and `sink` are at equally spaced ages from 0 to the end, linear between.
    """

    along: float
    """Drift aft [R] per radian of age."""
    turns: float
    """Age at the end, in turns of the rotor."""
    points: int
    """Drawn along one vortex."""
    radius: list[float]
    """Distance from the shaft, before the drift, (ages,)."""
    sink: list[list[float]]
    """How far it is below the tip that it left, (azimuths at which it left, equally spaced from 0; ages)."""

    @property
    def age(self) -> Array:
        """ζ of each drawn point [rad]."""
        return 2.0 * math.pi * self.turns * np.linspace(0.0, 1.0, self.points)

    def at(self, left: Array, age: Array) -> tuple[Array, Array]:
        """Radius and sink of what left the tip at azimuths `left` [rad] at an age [rad]; of one shape."""
        radius, sink = np.array(self.radius), np.array(self.sink)
        place = age / (2.0 * math.pi * self.turns) * (len(radius) - 1)
        column = left / (2.0 * math.pi) * len(sink)
        k = np.clip(place.astype(int), 0, len(radius) - 2)
        j = np.floor(column).astype(int)
        u, v, ahead, behind = place - k, column - j, (j + 1) % len(sink), j % len(sink)
        depth = (1.0 - v) * ((1.0 - u) * sink[behind, k] + u * sink[behind, k + 1])
        depth = depth + v * ((1.0 - u) * sink[ahead, k] + u * sink[ahead, k + 1])
        return (1.0 - u) * radius[k] + u * radius[k + 1], depth


def tip_vortex_path(solution: Solution) -> TipVortexPath:
    """The vortices of a solution: where the wake of its lifting line lies, or else where its inflow carries them.

    Such an inflow is averaged over a quarter of the radius, which is about what a tip vortex takes part in.
    """
    age = np.linspace(0.0, 2.0 * math.pi * _TURNS, _AGES)
    if solution.wake_course is not None:
        return _path_on(solution.wake_course, age)
    disk, controls, design = solution.disk, solution.controls, solution.design
    along, axial = design.in_disk_axes(controls.shaft_tilt)
    down = axial + controls.lambda0
    narrowing = abs(down) / max(math.hypot(along, down), 1e-9) * _CONTRACTION
    radius = 1.0 - narrowing * (1.0 - np.exp(-age / _CONTRACTS_WITHIN))
    left = 2.0 * math.pi / _COLUMNS * np.arange(_COLUMNS)[:, None]
    x, y = radius * np.cos(left) + along * age, radius * np.sin(left)
    speed = axial + _mean_inflow(disk, np.hypot(x, y), np.arctan2(y, x))
    steps = 0.5 * (speed[:, 1:] + speed[:, :-1]) * (age[1] - age[0])
    sink = np.concatenate([np.zeros((_COLUMNS, 1)), np.cumsum(steps, axis=1)], axis=1)
    return TipVortexPath(along, _TURNS, _POINTS, radius.round(5).tolist(), sink.round(5).tolist())


def _path_on(course: WakeCourse, age: Array) -> TipVortexPath:
    """The path of tip vortices that lie on a course, at ages [rad]; nothing contracts there."""
    left, tip = azimuths_of(_COURSE_COLUMNS), np.ones(1)
    height = [course.nodes(left + zeta, np.array([zeta]), tip)[:, 0, 0, 2] for zeta in age.tolist()]
    sink = course.flapping(left)[:, None] - np.stack(height, axis=1)
    return TipVortexPath(course.mu_x, _TURNS, _POINTS, [1.0] * len(age), sink.round(5).tolist())


def _mean_inflow(disk: DiskFields, r: Array, psi: Array) -> Array:
    """λ_i over a quarter of the radius about r, moved inwards where that reaches beyond the blade; shape of r and ψ.

    At the nearest azimuth.
    """
    column = np.rint((psi - disk.psi[0]) / (2.0 * math.pi) * len(disk.psi)).astype(int) % len(
        disk.psi
    )
    edges, up_to = disk.edges, np.zeros((len(disk.r) + 1, len(disk.psi)))
    np.cumsum(disk.dr[:, None] * disk.induced, axis=0, out=up_to[1:])
    first = np.clip(r - 0.5 * _WIDTH, edges[0], edges[-1] - _WIDTH)

    def integral(end: Array) -> Array:
        k = np.clip(np.searchsorted(edges, end, "right") - 1, 0, len(disk.r) - 1)
        return up_to[k, column] + (end - edges[k]) * disk.induced[k, column]

    return (integral(first + _WIDTH) - integral(first)) / _WIDTH


def tip_vortices(solution: Solution, azimuths: Sequence[float]) -> tuple[Array, Array]:
    """Segments of the vortices behind tips at `azimuths` [rad], (n, 2, 3), and the age 0…1 of each end, (n, 2)."""
    controls, rotor, path = solution.controls, solution.design.rotor, tip_vortex_path(solution)
    age = path.age
    hinge = rotor.blade.flap_hinge
    lines = []
    for psi in azimuths:
        left = psi - age
        r, sink = path.at(left, age)
        flap = controls.coning + controls.flap_1c * np.cos(left) + controls.flap_1s * np.sin(left)
        x, z = r * np.cos(left) + path.along * age, (1.0 - hinge) * flap - sink
        points = np.stack((x, r * np.sin(left), z), axis=1)
        lines.append(np.stack((points[:-1], points[1:]), axis=1))
    ages = np.stack((age[:-1], age[1:]), axis=1) / age[-1]
    return rotor.radius * np.concatenate(lines), np.tile(ages, (len(lines), 1))
