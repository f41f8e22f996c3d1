"""Closed surfaces from lofts and tubes, and the blade: lofted from its sections, its overlay, its sections end-on for
the inset.

Arrays, in metres.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from explorer.parts.results import InsetBlade, InsetSection
from rotor import Rotor
from rotor.airfoil.contour import resample
from rotor.airfoil.sections import Section
from rotor.design import REFERENCE_RADIUS, TwistLaw
from rotor.support.arrays import Array

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


def joined_meshes(meshes: Iterable[Mesh]) -> Mesh:
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
    near_end = np.stack((k, following, np.full(points, first)), 1)
    far_end = np.stack((tip + following, tip + k, np.full(points, last)), 1)
    faces = np.concatenate((ring_faces(count, points), near_end, far_end)).astype(np.uint32)
    vertices = np.concatenate((rings.reshape(-1, 3), rings[[0, -1]].mean(axis=1)))
    return Mesh(vertices, faces if _volume(vertices, faces) > 0.0 else faces[:, ::-1])


def ring_faces(rings: int, points: int) -> NDArray[np.intp]:
    """Triangles between neighbouring rings of so many points, numbered ring by ring, (triangles, 3)."""
    start = np.arange(rings - 1)[:, None] * points
    a = (start + np.arange(points)).ravel()
    b = (start + (np.arange(points) + 1) % points).ravel()
    return np.concatenate(
        (np.stack((a, b + points, b), 1), np.stack((a, a + points, b + points), 1))
    )


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


def tube(start: ArrayLike, end: ArrayLike, radius: float, end_radius: float | None = None) -> Mesh:
    """A round bar between two points, conical where `end_radius` is given; lengths [m]."""
    a, b = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    along = (b - a) / np.linalg.norm(b - a)
    across = np.cross(b - a, np.eye(3)[int(np.argmin(np.abs(b - a)))])
    across /= np.linalg.norm(across)
    up = np.cross(along, across)
    angle = 2.0 * math.pi * np.arange(14)[:, None] / 14
    ring = np.cos(angle) * across + np.sin(angle) * up
    return loft([a + radius * ring, b + (radius if end_radius is None else end_radius) * ring])


@lru_cache(maxsize=32)
def blade_axes_outline(section: Section, points: int) -> Array:
    """The outline about the quarter chord, y to the leading edge and z up, in reference chords; shape (points, 2).

    Starts at the upper trailing edge and runs over the nose.
    """
    outline = resample(section.outline, points).points
    y, z = 0.25 - outline[:, 0], outline[:, 1]
    cos, sin = np.cos(section.incidence_offset), np.sin(section.incidence_offset)
    return section.chord_ratio * np.stack((y * cos + z * sin, z * cos - y * sin), axis=1)


_SHANK_RADIUS = 0.16
"""A plausible round root shank, in reference chords; the flown cuff's own shape is not in the data."""
_SHANK_END = 0.70
"""Where the shank begins to fair into the blade, as a fraction of the distance from hinge to root cut-out."""
_SHANK_RINGS = 6
SWEPT_TIPS = {"UH-60A": (0.929, math.radians(20.0))}
"""r/R from which the quarter chord is swept back, and the sweep, by name of the rotor (Howlett, NASA CR-166309)."""


@dataclass(frozen=True)
class LoftDetail:
    points: int = 29
    """Round a section (odd)."""
    stations: int = 31
    """Sections from root cut-out to tip; those where the blade's own sections change come on top."""
    also: tuple[float, ...] = ()
    """r/R of further sections, such as kinks of the twist."""


PAGE = LoftDetail()
"""Coarse enough to be shaped anew at every step of a slider: about 1,300 vertices."""


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

    def pitch(self, twist: TwistLaw, exaggeration: float) -> Array:
        """Drawn twist of each ring [rad]; the shank keeps the root's."""
        return drawn_pitch(twist, np.maximum(self.r, self.r[_SHANK_RINGS]), exaggeration)


def drawn_pitch(twist: TwistLaw, r: ArrayLike, exaggeration: float) -> Array:
    """Twist at r/R as it is drawn [rad]: true at 0.75 R, larger relative to it."""
    datum = float(twist([REFERENCE_RADIUS])[0])
    return np.asarray(datum + exaggeration * (twist(r) - datum), dtype=np.float64)


def swept_back(rotor: Rotor, r: ArrayLike) -> Array:
    """How far the quarter chord lies behind the pitch axis at r/R [m]; 0 for a straight blade."""
    start, sweep = SWEPT_TIPS.get(rotor.name, (1.0, 0.0))
    return np.maximum(np.asarray(r, dtype=np.float64) - start, 0.0) * rotor.radius * math.tan(sweep)


@lru_cache(maxsize=4)
def blade_shape(rotor: Rotor, detail: LoftDetail = PAGE) -> BladeShape:
    """The untwisted loft: round shank from the hinge, a fairing, then the blade's own sections to the tip."""
    blade = rotor.blade
    hinge, cutout = blade.flap_hinge, blade.root_cutout
    knots = [edge for span in blade.spans for edge in (span.start, span.end)] + list(detail.also)
    if rotor.name in SWEPT_TIPS:
        knots.append(SWEPT_TIPS[rotor.name][0])
    even = np.linspace(cutout, 1.0, detail.stations)
    lifting = np.unique(np.round(np.concatenate((even, np.clip(knots, cutout, 1.0))), 5))
    shank = hinge + (cutout - hinge) * np.array([0.0, _SHANK_END, 0.76, 0.82, 0.88, 0.94])
    # Half a step short of closing: the ring's last side stands for the blunt trailing edge.
    points = detail.points
    angle = 2.0 * math.pi * (np.arange(points) + 0.5) / points
    root = section_ring(rotor, cutout, points)
    # The circle runs as the outlines do: from the trailing edge over the upper side to the nose.
    circle = (
        _SHANK_RADIUS * rotor.reference_chord * np.stack((-np.cos(angle), np.sin(angle)), axis=1)
    )
    fairing = np.clip((shank - shank[1]) / (cutout - shank[1]), 0.0, 1.0)
    fairing = fairing**2 * (3.0 - 2.0 * fairing)
    rings = [(1.0 - f) * circle + f * root for f in fairing]
    rings += [section_ring(rotor, float(r), points) for r in lifting]
    r = np.concatenate((shank, lifting))
    outlines = np.array(rings)
    outlines[:, :, 0] -= swept_back(rotor, r)[:, None]
    return BladeShape(r, outlines, (r - hinge) * rotor.radius, _loft_faces(len(r), points))


def section_ring(rotor: Rotor, r: float, points: int) -> Array:
    """The section at r/R about its quarter chord, (y, z) [m], shape (points, 2); y to the leading edge, untwisted."""
    inner, outer, weight = rotor.blade.section_at(r)
    at_inner, at_outer = (
        blade_axes_outline(rotor.blade.installed(name), points) for name in (inner, outer)
    )
    return float(rotor.blade.chord(r)) * ((1.0 - weight) * at_inner + weight * at_outer)


@dataclass(frozen=True, eq=False)
class BladeForm:
    """What changes of a blade's shape from frame to frame: how its rings lie."""

    pitch: Array
    """Drawn pitch of each ring, nose up [rad], (rings,)."""
    bent: Array | None = None
    """How far each ring is moved [m], (rings, 3)."""
    size: Array | None = None
    """Of each ring about the axis, 1 for whole, (rings,)."""

    def vertices(self, shape: BladeShape) -> Array:
        """Shape (n, 3). The page works them out by itself: `formed` in `scene.js`."""
        rings = _turned(shape, self.pitch)
        if self.size is not None:
            rings[:, :, 1:] *= self.size[:, None, None]
        return _with_ends(rings if self.bent is None else rings + self.bent[:, None])


def straight(rotor: Rotor) -> Mesh:
    """The blade without twist."""
    shape = blade_shape(rotor)
    return Mesh(BladeForm(np.zeros_like(shape.r)).vertices(shape), shape.faces)


def blade_vertices(shape: BladeShape, twist: TwistLaw, exaggeration: float = 1.0) -> Array:
    """The twisted blade's vertices, shape (n, 3); `exaggeration` multiplies the twist relative to that at 0.75 R."""
    return BladeForm(shape.pitch(twist, exaggeration)).vertices(shape)


def overlay_form(
    shape: BladeShape,
    overlay: TwistLaw,
    twist: TwistLaw,
    exaggeration: float,
    least: float,
    bent: Array | None = None,
) -> BladeForm:
    """The straight blade with twist `overlay`, shown only where it differs from one with `twist`, and `bent` where
    given.

    Rings shrink to the axis where the difference is below half of `least` [rad] and are whole above one and a half:
    two surfaces in one place would flicker.
    """
    apart = np.abs(shape.pitch(overlay, 1.0) - shape.pitch(twist, 1.0))
    size = np.clip(apart / least - 0.5, 0.0, 1.0)
    if bent is not None:  # Whole where the blade is bent away by half of its thickness.
        thick = np.ptp(shape.rings[:, :, 1], axis=1)
        size = np.maximum(size, np.clip(2.0 * np.linalg.norm(bent, axis=1) / thick - 0.5, 0.0, 1.0))
    return BladeForm(shape.pitch(overlay, exaggeration), size=size)


def overlay_segments(
    rotor: Rotor, overlay: TwistLaw, twist: TwistLaw, exaggeration: float, least: float
) -> Array:
    """The blade's leading and trailing edge as lines, where the twists differ by `least` [rad]; (n, 2, 3).

    A section closes each stretch at both ends.
    """
    shape = blade_shape(rotor)
    rings = _turned(shape, shape.pitch(overlay, exaggeration))
    apart = np.abs(shape.pitch(overlay, 1.0) - shape.pitch(twist, 1.0)) > least
    apart[:_SHANK_RINGS] = False
    points = rings.shape[1]
    both = apart[:-1] & apart[1:]
    padded = np.concatenate(([False], apart, [False]))
    ends = apart & ~(padded[:-2] & padded[2:])
    around = np.stack((rings[ends], np.roll(rings[ends], -1, axis=1)), axis=2)
    along = rings[:, [0, points // 2]]
    lengthwise = np.stack((along[:-1], along[1:]), axis=2)[both]
    return np.concatenate((around.reshape(-1, 2, 3), lengthwise.reshape(-1, 2, 3)))


def _turned(shape: BladeShape, angle: Array) -> Array:
    """The rings in space, each turned nose up by its angle; shape (rings, points, 3)."""
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    y, z = shape.rings[:, :, 0], shape.rings[:, :, 1]
    outward = np.broadcast_to(shape.outward[:, None], y.shape)
    return np.stack((outward, y * cos - z * sin, y * sin + z * cos), axis=-1)


def _with_ends(rings: Array) -> Array:
    """All vertices: the end rings come twice, so that the caps keep a sharp edge when normals are averaged."""
    ends = [rings[0], rings[-1], rings[0].mean(axis=0)[None], rings[-1].mean(axis=0)[None]]
    return np.concatenate([rings.reshape(-1, 3), *ends])


def _loft_faces(rings: int, points: int) -> Faces:
    root, tip = rings * points, (rings + 1) * points
    root_centre, tip_centre = (rings + 2) * points, (rings + 2) * points + 1
    around = np.arange(points)
    after = (around + 1) % points
    root_cap = np.stack((root + around, root + after, np.full(points, root_centre)), 1)
    tip_cap = np.stack((tip + after, tip + around, np.full(points, tip_centre)), 1)
    return np.concatenate((ring_faces(rings, points), root_cap, tip_cap)).astype(np.uint32)


def circle_segments(radius: float, count: int = 180) -> Array:
    """A circle in the plane z = 0 as segments, shape (count, 2, 3)."""
    angle = np.linspace(0.0, 2.0 * np.pi, count + 1)
    ring = radius * np.stack((np.cos(angle), np.sin(angle), np.zeros_like(angle)), axis=1)
    return np.stack((ring[:-1], ring[1:]), axis=1)


_SPANWISE = (0.01, 0.16, 0.31, 0.46, 0.61, 0.76, 0.905, 1.0)
"""Places of the sections from root cut-out to tip: one before the bend of the UH-60A's tip, one at its end."""
_EDGE_POINTS = 40
_OUTLINE_POINTS = 25


def inset_sections(
    rotor: Rotor, twist: TwistLaw, overlay: TwistLaw | None, exaggeration: float
) -> InsetBlade:
    """What the page draws the inset from, about 4 kB: eight sections, and edges between them."""
    r, cuts = inset_places(rotor)
    places = np.concatenate((r, cuts, [REFERENCE_RADIUS]))
    *angles, datum = _degrees(twist, places)
    behind = None if overlay is None else _degrees(overlay, places)
    other = [None] * len(cuts) if behind is None else behind[len(r) : -1]
    return InsetBlade(
        times=exaggeration,
        r=[round(float(at), 4) for at in r],
        datum=datum,
        overlay_datum=0.0 if behind is None else behind[-1],
        theta=angles[: len(r)],
        overlay=None if behind is None else behind[: len(r)],
        cuts=[
            InsetSection(float(at), outline, angle, before)
            for at, outline, angle, before in zip(
                cuts, _outlines(rotor), angles[len(r) :], other, strict=True
            )
        ],
    )


def inset_places(rotor: Rotor) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """r/R along the edges, and of the sections."""
    cutout = rotor.blade.root_cutout
    return np.linspace(cutout, 1.0, _EDGE_POINTS), np.round(
        cutout + (1.0 - cutout) * np.array(_SPANWISE), 2
    )


@lru_cache(maxsize=4)
def _outlines(rotor: Rotor) -> tuple[list[list[float]], ...]:
    chord = rotor.reference_chord
    rings = [section_ring(rotor, float(r), _OUTLINE_POINTS) / chord for r in inset_places(rotor)[1]]
    return tuple(np.round(ring, 3).tolist() for ring in rings)


def _degrees(twist: TwistLaw, r: NDArray[np.float64]) -> list[float]:
    return [round(float(angle), 2) for angle in np.degrees(twist(r))]
