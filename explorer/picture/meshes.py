"""Shapes as arrays: the blade lofted from its true sections, hub and mast, the rotation arrow. Metres."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from explorer.picture.section_outline import blade_axes_outline
from rotor.arrays import Array
from rotor.design.blade import Rotor
from rotor.design.twist import TwistLaw

Faces = NDArray[np.uint32]

_RING = 45
"""Points round a section of the page's blade (odd)."""
_DRAWN_FOR = 8.1788
"""Radius [m] that hub and mast are drawn for; on other rotors they grow and shrink with it."""
_SHANK_RADIUS = 0.16
"""A plausible round root shank, in reference chords; the flown cuff's own shape is not in the data."""
_SHANK_END = 0.70
"""Where the shank begins to fair into the blade, as a part of the stretch from hinge to root cut-out."""


@dataclass(frozen=True, eq=False)
class Mesh:
    vertices: Array
    """Shape (n, 3)."""
    faces: Faces
    """Shape (m, 3), counter-clockwise seen from outside."""


@dataclass(frozen=True)
class Detail:
    """How finely a blade is lofted."""

    points: int = _RING
    """Round a section (odd)."""
    stations: int = 43
    """Sections from root cut-out to tip; those where the blade's own sections change come on top."""
    also: tuple[float, ...] = ()
    """r/R of further sections, such as kinks of the twist."""


PAGE = Detail()
"""What a slider can drag."""


@dataclass(frozen=True, eq=False)
class BladeShape:
    """A blade without twist, in its own axes: x outward from the flap hinge, y to the leading edge, z up."""

    r: Array
    """y/R of each ring, shape (rings,)."""
    rings: Array
    """Section outlines about the quarter chord, (y, z) [m], shape (rings, points, 2)."""
    outward: Array
    """Distance of each ring from the hinge [m], shape (rings,)."""
    faces: Faces


@lru_cache(maxsize=4)
def blade_shape(rotor: Rotor, detail: Detail = PAGE) -> BladeShape:
    """The untwisted loft: round shank from the hinge, a fairing, then the blade's own sections to the tip."""
    blade = rotor.blade
    hinge, cutout = blade.flap_hinge, blade.root_cutout
    knots = [edge for span in blade.spans for edge in (span.start, span.end)] + list(detail.also)
    even = np.linspace(cutout, 1.0, detail.stations)
    lifting = np.unique(np.round(np.concatenate((even, np.clip(knots, cutout, 1.0))), 5))
    shank = hinge + (cutout - hinge) * np.array([0.0, _SHANK_END, 0.76, 0.82, 0.88, 0.94])
    # Half a step short of closing: the ring's last side stands for the blunt trailing edge.
    points = detail.points
    angle = 2.0 * math.pi * (np.arange(points) + 0.5) / points
    root = _section_ring(rotor, cutout, points)
    # The circle runs as the outlines do: from the trailing edge over the upper side to the nose.
    circle = _SHANK_RADIUS * rotor.reference_chord * np.stack((-np.cos(angle), np.sin(angle)), axis=1)
    fairing = np.clip((shank - shank[1]) / (cutout - shank[1]), 0.0, 1.0)
    fairing = fairing**2 * (3.0 - 2.0 * fairing)
    rings = [(1.0 - f) * circle + f * root for f in fairing]
    rings += [_section_ring(rotor, float(r), points) for r in lifting]
    r = np.concatenate((shank, lifting))
    return BladeShape(r, np.array(rings), (r - hinge) * rotor.radius, _loft_faces(len(r), points))


def _section_ring(rotor: Rotor, r: float, points: int) -> Array:
    inner, outer, weight = rotor.blade.section_at(r)
    one, two = (blade_axes_outline(rotor.blade.installed(name), points) for name in (inner, outer))
    return float(rotor.blade.chord(r)) * ((1.0 - weight) * one + weight * two)


def blade_vertices(shape: BladeShape, twist: TwistLaw, exaggeration: float = 1.0) -> Array:
    """The twisted blade's vertices, shape (n, 3); only these change when the twist does.

    `exaggeration` multiplies the twist about its zero at 0.75 R. The shank keeps the root's twist.
    """
    lifting = shape.r[6:]
    angle = exaggeration * np.concatenate((np.full(6, twist(lifting[:1])[0]), twist(lifting)))
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    y, z = shape.rings[:, :, 0], shape.rings[:, :, 1]
    outward = np.broadcast_to(shape.outward[:, None], y.shape)
    rings = np.stack((outward, y * cos - z * sin, y * sin + z * cos), axis=-1)
    # The end rings come twice, so that the caps keep a sharp edge when normals are averaged; then the cap centres.
    ends = [rings[0], rings[-1], rings[0].mean(axis=0)[None], rings[-1].mean(axis=0)[None]]
    return np.concatenate([rings.reshape(-1, 3), *ends])


def ghost_segments(rotor: Rotor, twist: TwistLaw, exaggeration: float = 1.0) -> Array:
    """A twisted blade as lines: a few sections, and edges and back from root to tip; shape (n, 2, 3)."""
    shape = blade_shape(rotor)
    count = len(shape.r)
    rings = blade_vertices(shape, twist, exaggeration)[: count * _RING].reshape(count, _RING, 3)
    sections = np.unique(np.linspace(6, count - 1, 12).astype(int))
    around = np.stack((rings[sections], np.roll(rings[sections], -1, axis=1)), axis=2)
    nose = _RING // 2
    along = rings[6:, [0, nose // 2, nose, nose + nose // 2]]
    lengthwise = np.stack((along[:-1], along[1:]), axis=2)
    return np.concatenate((around.reshape(-1, 2, 3), lengthwise.reshape(-1, 2, 3)))


def _loft_faces(rings: int, points: int) -> Faces:
    start = np.arange(rings - 1)[:, None] * points + np.arange(points)[None, :]
    following = np.arange(rings - 1)[:, None] * points + (np.arange(points)[None, :] + 1) % points
    a, b = start.ravel(), following.ravel()
    sides = np.concatenate((np.stack((a, b + points, b), 1), np.stack((a, a + points, b + points), 1)))
    root, tip = rings * points, (rings + 1) * points
    root_centre, tip_centre = (rings + 2) * points, (rings + 2) * points + 1
    around = np.arange(points)
    after = (around + 1) % points
    root_cap = np.stack((root + around, root + after, np.full(points, root_centre)), 1)
    tip_cap = np.stack((tip + after, tip + around, np.full(points, tip_centre)), 1)
    return np.concatenate((sides, root_cap, tip_cap)).astype(np.uint32)


def revolved(profile: Array, segments: int = 40) -> Mesh:
    """A body of revolution about z from a (radius, height) profile that starts and ends on the axis."""
    angle = 2.0 * np.pi * np.arange(segments) / segments
    ring = np.stack((np.cos(angle), np.sin(angle)), axis=1)
    inner = profile[1:-1]
    rings = np.concatenate(
        (inner[:, None, :1] * ring[None], np.broadcast_to(inner[:, None, 1:], (len(inner), segments, 1))), axis=2
    )
    poles = np.array([[0.0, 0.0, profile[0, 1]], [0.0, 0.0, profile[-1, 1]]])
    k, nxt = np.arange(segments), (np.arange(segments) + 1) % segments
    faces = [np.stack((np.full(segments, len(inner) * segments), nxt, k), 1)]
    for row in range(len(inner) - 1):
        low, high = row * segments, (row + 1) * segments
        faces += [np.stack((low + k, low + nxt, high + nxt), 1), np.stack((low + k, high + nxt, high + k), 1)]
    last = (len(inner) - 1) * segments
    faces.append(np.stack((last + k, last + nxt, np.full(segments, len(inner) * segments + 1)), 1))
    return Mesh(np.concatenate((rings.reshape(-1, 3), poles)), np.concatenate(faces).astype(np.uint32))


def hub(rotor: Rotor) -> Mesh:
    """A hub that reaches the flap hinges."""
    scale = size(rotor.radius)
    reach = max(rotor.blade.flap_hinge * rotor.radius / scale, 0.3)
    outline = [[0.0, -0.14], [reach, -0.14], [reach, -0.12], [1.06 * reach, 0.0], [reach, 0.1], [0.6 * reach, 0.17]]
    return revolved(scale * np.array([*outline, [0.25 * reach, 0.22], [0.0, 0.22]]))


def mast(radius: float) -> Mesh:
    """The shaft below the hub of a rotor of this radius [m]."""
    return revolved(size(radius) * np.array([[0.0, -1.9], [0.26, -1.9], [0.15, -0.9], [0.15, -0.1], [0.0, -0.1]]), 28)


def size(radius: float) -> float:
    """How large a rotor of this radius [m] is beside the one that fixed measures were drawn for."""
    return radius / _DRAWN_FOR


def rotation_arrow(radius: float) -> Mesh:
    """A flat curved arrow outside the rim, from ψ 22° to 52° in the sense of rotation, seen from both sides."""
    inner, outer, tip_reach = 1.055 * radius, 1.085 * radius, 0.028 * radius
    psi = np.radians(np.linspace(20.0, 46.0, 27))
    ring = np.stack((np.cos(psi), np.sin(psi), np.zeros_like(psi)), axis=1)
    middle, end, head = 0.5 * (inner + outer), psi[-1], math.radians(53.0)

    def point(r: float, at: float) -> list[float]:
        return [r * math.cos(at), r * math.sin(at), 0.0]

    tip = np.array([point(inner - tip_reach, end), point(outer + tip_reach, end), point(middle, head)])
    n = len(psi)
    k = np.arange(n - 1)
    faces = np.concatenate(
        (np.stack((k, k + n, k + n + 1), 1), np.stack((k, k + n + 1, k + 1), 1), [[2 * n, 2 * n + 1, 2 * n + 2]])
    )
    return Mesh(np.concatenate((inner * ring, outer * ring, tip)), faces.astype(np.uint32))


def circle_segments(radius: float, count: int = 180) -> Array:
    """A circle in the plane z = 0 as segments, shape (count, 2, 3)."""
    angle = np.linspace(0.0, 2.0 * np.pi, count + 1)
    ring = radius * np.stack((np.cos(angle), np.sin(angle), np.zeros_like(angle)), axis=1)
    return np.stack((ring[:-1], ring[1:]), axis=1)


def tick_segments(radius: float) -> Array:
    """Azimuth ticks outside the rim, every 10°, longer every 30° and longest every 90°; shape (36, 2, 3)."""
    degrees = np.arange(0, 360, 10)
    reach = np.where(degrees % 90 == 0, 0.035, np.where(degrees % 30 == 0, 0.022, 0.011))
    psi = np.radians(degrees)
    ray = np.stack((np.cos(psi), np.sin(psi), np.zeros_like(psi)), axis=1)
    return radius * np.stack((1.006 * ray, (1.006 + reach)[:, None] * ray), axis=1)


def flight_arrow(radius: float) -> Mesh:
    """A flat arrow ahead of the disk that points the way of flight (−x), in the horizon plane."""
    tail, neck, tip = -1.16 * radius, -1.25 * radius, -1.31 * radius
    half, head = 0.012 * radius, 0.030 * radius
    outline = [[tail, -half], [tail, half], [neck, half], [neck, -half], [neck, head], [neck, -head], [tip, 0.0]]
    vertices = np.concatenate((np.array(outline), np.zeros((7, 1))), axis=1)
    return Mesh(vertices, np.array([[0, 2, 1], [0, 3, 2], [4, 6, 5]], dtype=np.uint32))
