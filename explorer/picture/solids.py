"""Closed surfaces from a few primitives: lofts, bodies of revolution, tubes. Metres."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rotor.arrays import Array

Faces = NDArray[np.uint32]


@dataclass(frozen=True, eq=False)
class Mesh:
    vertices: Array
    """Shape (n, 3)."""
    faces: Faces
    """Shape (m, 3), counter-clockwise seen from outside."""

    def scaled(self, factor: float) -> "Mesh":
        """This shape, `factor` times as large about the origin."""
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
    first, last = count * points, count * points + 1
    tip = (count - 1) * points
    faces = np.concatenate(
        (
            sides(count, points),
            np.stack((k, following, np.full(points, first)), 1),
            np.stack((tip + following, tip + k, np.full(points, last)), 1),
        )
    ).astype(np.uint32)
    vertices = np.concatenate((rings.reshape(-1, 3), rings[[0, -1]].mean(axis=1)))
    return Mesh(vertices, faces if _volume(vertices, faces) > 0.0 else faces[:, ::-1])


def sides(rings: int, points: int) -> NDArray[np.intp]:
    """Triangles between neighbouring rings of so many points, numbered ring by ring."""
    start = np.arange(rings - 1)[:, None] * points
    a = (start + np.arange(points)).ravel()
    b = (start + (np.arange(points) + 1) % points).ravel()
    return np.concatenate((np.stack((a, b + points, b), 1), np.stack((a, a + points, b + points), 1)))


def _volume(vertices: Array, faces: Faces) -> float:
    """Volume of a closed surface [m³]; negative when its faces look inward."""
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
