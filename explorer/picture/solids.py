"""Closed surfaces from a few primitives: lofts, bodies of revolution, tubes, lifting surfaces. Metres."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import PchipInterpolator

from rotor.arrays import Array

Faces = NDArray[np.uint32]


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles."""

    vertices: Array
    """Shape (n, 3)."""
    faces: Faces
    """Shape (m, 3), counter-clockwise seen from outside."""

    def scaled(self, factor: float) -> "Mesh":
        """The same shape, `factor` times as large about the origin."""
        return Mesh(factor * self.vertices, self.faces)


def joined(meshes: Iterable[Mesh]) -> Mesh:
    """All triangles of several meshes as one mesh; surfaces that cut each other stay separate."""
    parts = list(meshes)
    starts = np.cumsum([0] + [len(part.vertices) for part in parts[:-1]])
    faces = [part.faces + np.uint32(start) for part, start in zip(parts, starts, strict=True)]
    return Mesh(np.concatenate([part.vertices for part in parts]), np.concatenate(faces))


def loft(rings: ArrayLike) -> Mesh:
    """A closed surface through `rings`, shape (rings, points, 3), with a flat fan over each end.

    The order of the points decides nothing: the faces are turned outward.
    """
    rings = np.asarray(rings, dtype=np.float64)
    count, points = rings.shape[:2]
    k = np.arange(points)
    following = (k + 1) % points
    a = (np.arange(count - 1)[:, None] * points + k).ravel()
    b = (np.arange(count - 1)[:, None] * points + following).ravel()
    first, last = count * points, count * points + 1
    tip = (count - 1) * points
    faces = np.concatenate(
        (
            np.stack((a, b + points, b), 1),
            np.stack((a, a + points, b + points), 1),
            np.stack((k, following, np.full(points, first)), 1),
            np.stack((tip + following, tip + k, np.full(points, last)), 1),
        )
    ).astype(np.uint32)
    vertices = np.concatenate((rings.reshape(-1, 3), rings[[0, -1]].mean(axis=1)))
    return Mesh(vertices, faces if _volume(vertices, faces) > 0.0 else faces[:, ::-1])


def _volume(vertices: Array, faces: Faces) -> float:
    """Of a closed surface [m³]; negative when its faces look inward."""
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0


def revolved(profile: ArrayLike, segments: int = 40) -> Mesh:
    """A body of revolution about z from a (radius, height) profile that starts and ends on the axis."""
    profile = np.asarray(profile, dtype=np.float64)
    angle = 2.0 * math.pi * np.arange(segments) / segments
    ring = np.stack((np.cos(angle), np.sin(angle), np.zeros(segments)), axis=1)
    return loft([radius * ring + [0.0, 0.0, height] for radius, height in profile[1:-1]])


def tube(start: ArrayLike, end: ArrayLike, radius: float, end_radius: float | None = None, segments: int = 14) -> Mesh:
    """A round bar between two points, conical where `end_radius` is given."""
    a, b = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    across = _perpendicular(b - a)
    up = np.cross((b - a) / np.linalg.norm(b - a), across)
    angle = 2.0 * math.pi * np.arange(segments)[:, None] / segments
    ring = np.cos(angle) * across + np.sin(angle) * up
    return loft([a + radius * ring, b + (radius if end_radius is None else end_radius) * ring])


def _perpendicular(direction: Array) -> Array:
    """A unit vector across a direction."""
    helper = np.eye(3)[int(np.argmin(np.abs(direction)))]
    across = np.cross(direction, helper)
    return np.asarray(across / np.linalg.norm(across), dtype=np.float64)


def surface(root: ArrayLike, tip: ArrayLike, chords: tuple[float, float], thickness: float, upright: bool) -> Mesh:
    """A tapered fin or stabiliser between two leading-edge points, chords along x.

    `thickness`: as a fraction of the chord, along y for an `upright` surface and along z otherwise.
    """
    angle = 2.0 * math.pi * np.arange(20) / 20
    along, half = 0.5 * (1.0 - np.cos(angle)), 0.5 * thickness * np.sin(angle) * (1.2 + 0.5 * np.cos(angle))
    zero = np.zeros_like(along)
    profile = np.stack((along, half, zero) if upright else (along, zero, half), axis=1)
    ends = np.asarray(root, dtype=np.float64), np.asarray(tip, dtype=np.float64)
    stations = np.linspace(0.0, 1.0, 5)
    return loft([(1 - t) * ends[0] + t * ends[1] + ((1 - t) * chords[0] + t * chords[1]) * profile for t in stations])


class Hull:
    """A body along x whose sections are superellipses, smooth between the given stations.

    `rows`: x, half width, bottom, top and exponent of each station; an exponent of 2 is an ellipse, more is boxier.
    `offset`: y of the middle.
    """

    def __init__(self, rows: Sequence[Sequence[float]], offset: float = 0.0) -> None:
        table = np.asarray(rows, dtype=np.float64)
        self._x, self._offset = table[:, 0], offset
        self._shape = PchipInterpolator(self._x, table[:, 1:])

    def section(self, x: ArrayLike) -> tuple[Array, Array, Array, Array]:
        """Half width, bottom, top and exponent at `x`."""
        width, bottom, top, power = np.moveaxis(self._shape(np.asarray(x, dtype=np.float64)), -1, 0)
        return width, bottom, top, power

    def mesh(self, points: int = 44, between: int = 4) -> Mesh:
        """The closed body, `points` round a section and `between` sections a station."""
        x = np.unique(np.concatenate([np.linspace(a, b, between + 1) for a, b in pairwise(self._x)]))
        angle = 2.0 * math.pi * np.arange(points) / points
        return loft(self._points(x[:, None], angle[None, :], 0.0))

    def patch(self, x: Array, angle: Array, out: float) -> Mesh:
        """An open patch over a grid of `x` and section `angle` (0 at starboard, 90° on top), `out` off the surface."""
        points = self._points(x, angle, out)
        rows, columns = x.shape
        a = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
        below = a + columns
        faces = np.concatenate((np.stack((a, below, a + 1), 1), np.stack((a + 1, below, below + 1), 1)))
        mesh = Mesh(points.reshape(-1, 3), faces.astype(np.uint32))
        middle = np.array([float(x.mean()), self._offset, float(np.mean(self.section(x.mean())[1:3]))])
        corners = mesh.vertices[mesh.faces]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).sum(axis=0)
        outward = float(normal @ (mesh.vertices.mean(axis=0) - middle)) > 0.0
        return mesh if outward else Mesh(mesh.vertices, mesh.faces[:, ::-1])

    def side_angle(self, x: Array, height: Array) -> Array:
        """The section angle at which the starboard side has this height z."""
        _, bottom, top, power = self.section(x)
        sine = np.clip((2.0 * height - top - bottom) / (top - bottom), -0.999, 0.999)
        # z = middle + half · sign(s) |s|^(2/n), turned round.
        return np.asarray(np.arcsin(np.sign(sine) * np.abs(sine) ** (power / 2.0)), dtype=np.float64)

    def _points(self, x: Array, angle: Array, out: float) -> Array:
        width, bottom, top, power = self.section(x)
        cos, sin = np.cos(angle), np.sin(angle)
        y = self._offset + (width + out) * np.sign(cos) * np.abs(cos) ** (2.0 / power)
        z = 0.5 * (top + bottom) + (0.5 * (top - bottom) + out) * np.sign(sin) * np.abs(sin) ** (2.0 / power)
        return np.stack((np.broadcast_to(x, y.shape), y, z), axis=-1)
