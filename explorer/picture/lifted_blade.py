"""The blade lifted out of the rotor, as arrays: skin, spar, web and actuator from the true sections, and its camera.

Axes of a blade: x outward, y to the leading edge, z up. It is drawn `CHORD_EXAGGERATION` times as wide as it is long.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from explorer.picture.actuator_drawings import (
    DRAWINGS,
    RING,
    SIDES,
    BladePart,
    Span,
    side_line,
    stations,
)
from explorer.picture.blade_mesh import Mesh, section_ring
from explorer.picture.camera_views import (
    FIELD_OF_VIEW,
    USUAL_COVER,
    Camera,
    between_cards,
    direction,
    framed,
    seen_at,
)
from explorer.picture.picture import Pose, axis_rotation, composed_rotation, rotate
from rotor import Rotor
from rotor.actuator import InstalledActuator
from rotor.dynamics.structure import structure_data
from rotor.support.arrays import Array

CHORD_EXAGGERATION = 2.7
"""A blade is sixteen times as long as it is wide: drawn so, its plies would be threads."""
ORIGIN_R = 0.55
"""r/R of the origin."""


@dataclass(frozen=True, eq=False)
class LiftedBlade:
    """The blade without twist."""

    parts: tuple[BladePart, ...]
    rings: Array
    """Section outlines from the upper trailing edge over the nose, (stations, points, 2)."""
    r: Array
    """Stations r/R of the rings, (stations,)."""
    box: Span
    """Where the electronics sit, r/R."""
    radius: float
    """R [m]."""

    def outward(self, r: Array | float) -> Array:
        """x of a station [m]."""
        return self.radius * (np.asarray(r, dtype=float) - ORIGIN_R)

    @property
    def spans(self) -> list[Span]:
        """Driven stretches, root to tip."""
        numbers = sorted({part.segment for part in self.parts if part.segment >= 0})
        stations = [[part.r for part in self.parts if part.segment == number] for number in numbers]
        return [
            (min(float(r[0]) for r in each), max(float(r[-1]) for r in each)) for each in stations
        ]


@lru_cache(maxsize=8)
def lifted_blade(installed: InstalledActuator, rotor: Rotor) -> LiftedBlade:
    """The pieces for an actuator on a blade."""
    data = structure_data()["section"]
    web = float(data["spar_web_c"] if installed.host.kind == "retrofit" else data["box_end_c"])
    r = stations((rotor.blade.root_cutout, 1.0), 32)
    rings = np.stack([section_ring(rotor, float(at), RING) for at in r])
    drawing = DRAWINGS[type(installed.actuator)]
    pieces = [
        BladePart("skin", -1, r, rings),
        _web(rotor, web, r),
        *drawing.pieces(installed, rotor),
    ]
    if not drawing.in_spar:
        spar = np.stack([_within(rotor, float(at), web) for at in r])
        pieces.insert(1, BladePart("spar", -1, r, spar))
    return LiftedBlade(tuple(pieces), rings, r, installed.electronics_span, rotor.radius)


def _web(rotor: Rotor, at: float, r: Array) -> BladePart:
    """The wall across the section at x/c."""
    lines = []
    for station in r:
        top, bottom = (
            side_line(rotor, float(station), side, (at, at + 1e-6), 2)[0] for side in SIDES
        )
        lines.append(bottom + np.linspace(0.0, 1.0, 3)[:, None] * (top - bottom))
    rear = np.stack(lines)
    return BladePart("web", -1, r, rear, rear + np.array([0.012, 0.0]))


def _within(rotor: Rotor, r: float, web: float) -> Array:
    """The spar, a little inside the skin so that the two do not share a surface, (points, 2)."""
    upper, lower = (side_line(rotor, r, side, (0.0, web), 12) for side in SIDES)
    ring = np.concatenate((upper[::-1], lower[1:]))
    return ring.mean(axis=0) + 0.95 * (ring - ring.mean(axis=0))


def part_mesh(blade: LiftedBlade, part: BladePart, twist: Array) -> Mesh:
    """The piece with the blade's twist [rad] at its stations: a sheet with its tip closed, or a closed solid."""
    outer = _turned(blade, part.r, part.outer, twist)
    if part.inner is None:
        half = outer.shape[1] // 2
        tip = np.stack((outer[-1, : half + 1], outer[-1, half:][::-1]))
        return _grids([outer, tip])
    inner = _turned(blade, part.r, part.inner, twist)
    sides = [np.stack((outer[:, k], inner[:, k]), axis=1) for k in (0, -1)]
    return _grids([outer, inner, *sides, *(np.stack((outer[k], inner[k])) for k in (0, -1))])


def edge_segments(blade: LiftedBlade, twist: Array) -> Array:
    """Both edges, root and tip section of the blade with this twist at its rings [rad], (segments, 2, 3)."""
    rings = _turned(blade, blade.r, blade.rings, twist)
    nose = rings.shape[1] // 2
    return segments_of([rings[:, nose], rings[:, 0], rings[0], rings[-1]])


def fibre_segments(blade: LiftedBlade, part: BladePart, twist: Array, crossed: bool) -> Array:
    """Fibres on the outside of a ply or laminate, at 45° in the drawing, `crossed` at −45°, (segments, 2, 3)."""
    surface = _turned(blade, part.r, part.outer, twist)
    length = float(surface[-1, 0, 0] - surface[0, 0, 0])
    width = float(np.linalg.norm(np.diff(surface[0], axis=0), axis=1).sum())
    share, lines = np.linspace(0.0, 1.0, 9), list[Array]()
    for start in np.arange(-width, length, _FIBRE_STEP):
        along = start + width * (1.0 - share if crossed else share)
        inside = (along >= 0.0) & (along <= length)
        if inside.sum() > 1:
            lines.append(_on(surface, along[inside] / length, share[inside]))
    return segments_of(lines)


_FIBRE_STEP = 0.13
"""[m], along the span."""


def _on(surface: Array, along: Array, across: Array) -> Array:
    """Points of a grid (stations, points, 3) at shares of its rows and columns."""
    rows, columns = surface.shape[:2]
    i, j = along * (rows - 1), across * (columns - 1)
    a, b = np.minimum(i.astype(int), rows - 2), np.minimum(j.astype(int), columns - 2)
    u, v = (i - a)[:, None], (j - b)[:, None]
    near = (1.0 - v) * surface[a, b] + v * surface[a, b + 1]
    far = (1.0 - v) * surface[a + 1, b] + v * surface[a + 1, b + 1]
    raised = (1.0 - u) * near + u * far
    return raised + np.array([0.0, 0.0, 0.004])


def root_parts(blade: LiftedBlade, rotor: Rotor, twist: float) -> tuple[Mesh, Mesh]:
    """Shank and black box."""
    start, end = rotor.blade.flap_hinge, rotor.blade.root_cutout
    angle = np.linspace(0.0, 2.0 * np.pi, 25)
    circle = 0.05 * np.stack((np.cos(angle), np.sin(angle)), axis=1)
    rings = _turned(
        blade, np.array([start, end + 0.004]), np.stack((circle, circle)), np.full(2, twist)
    )
    hub_side = np.stack((rings[0], np.broadcast_to(rings[0].mean(axis=0), rings[0].shape)))
    corner = np.array([[-0.10, 0.052], [0.09, 0.052], [0.09, 0.10], [-0.10, 0.10], [-0.10, 0.052]])
    ends = _turned(
        blade,
        np.array([blade.box[0], _box_end(blade)]),
        np.stack((corner, corner)),
        np.full(2, twist),
    )
    caps = [np.stack((end[[0, 1]], end[[3, 2]])) for end in ends]
    return _grids([rings, hub_side]), _grids([*(ends[:, k : k + 2] for k in range(4)), *caps])


def lead_segments(blade: LiftedBlade, twist: Array) -> Array:
    """Leads from the black box along the nose to the inner end of each segment, (segments, 2, 3).

    `twist` at the blade's rings.
    """
    starts = sorted({float(part.r[0]) for part in blade.parts if part.segment >= 0})
    lines: list[Array] = []
    for number, start in enumerate(starts):
        end = _box_end(blade)
        r = np.unique(np.concatenate(([end, start], blade.r[(blade.r > end) & (blade.r < start)])))
        y = 0.09 + 0.012 * number
        top = np.interp(r, blade.r, [_top(ring, y) for ring in blade.rings])
        path = np.stack((np.full(len(r), y), top + 0.006), axis=1)[:, None]
        lines.append(_turned(blade, r, path, np.interp(r, blade.r, twist))[:, 0])
    return segments_of(lines)


def _box_end(blade: LiftedBlade) -> float:
    return min(blade.box[1], float(blade.r[0]) - 0.004)


def arc_segments(blade: LiftedBlade, still: float, now: float) -> Array:
    """An arrow at the tip's trailing edge from the angle it has at rest to the one it has now [rad], (segments, 2, 3);
    empty where they are too close to be seen."""
    if abs(now - still) < math.radians(0.5):
        return np.zeros((0, 2, 3))
    reach = 1.16 * float(blade.rings[-1, 0, 0])
    angles = np.linspace(still, now, 17)
    line = _arc(blade, reach, angles)
    back = angles[-1] - math.copysign(min(math.radians(3.0), 0.6 * abs(now - still)), now - still)
    barbs = [
        np.stack((line[-1], _arc(blade, reach * side, np.array([back]))[0]))
        for side in (0.955, 1.045)
    ]
    return segments_of([line, *barbs])


def _arc(blade: LiftedBlade, reach: float, angles: Array) -> Array:
    return _turned(
        blade,
        np.full(len(angles), 1.004),
        np.tile([[reach, 0.0]], (len(angles), 1))[:, None],
        angles,
    )[:, 0]


def twisted_point(blade: LiftedBlade, r: float, y: float, z: float, twist: float) -> Array:
    """A point of the twisted blade [m], (3,); y and z [m] in the section, twist [rad]."""
    return _turned(blade, np.array([r]), np.array([[[y, z]]]), np.array([twist]))[0, 0]


def _turned(blade: LiftedBlade, r: Array, lines: Array, twist: Array) -> Array:
    """(stations, points, 2) with a nose-up twist at each → (stations, points, 3), drawn wider."""
    cos, sin = np.cos(twist)[:, None], np.sin(twist)[:, None]
    y, z = CHORD_EXAGGERATION * lines[..., 0], CHORD_EXAGGERATION * lines[..., 1]
    x = np.broadcast_to(blade.outward(r)[:, None], y.shape)
    return np.stack((x, y * cos - z * sin, y * sin + z * cos), axis=-1)


def segments_of(lines: list[Array]) -> Array:
    """Polylines, (points, 3) each, as pairs of points, (segments, 2, 3)."""
    pairs = [np.stack((line[:-1], line[1:]), axis=1) for line in lines if len(line) > 1]
    return np.concatenate(pairs) if pairs else np.zeros((0, 2, 3))


def _grids(grids: list[Array]) -> Mesh:
    """Sheets of quadrilaterals, (rows, columns, 3) each, that share no vertices: their edges stay sharp."""
    vertices, faces, count = [], [], 0
    for grid in grids:
        rows, columns = grid.shape[:2]
        index = count + np.arange(rows * columns).reshape(rows, columns)
        a, b, c, d = index[:-1, :-1], index[:-1, 1:], index[1:, :-1], index[1:, 1:]
        faces += [
            np.stack((a.ravel(), b.ravel(), d.ravel()), 1),
            np.stack((a.ravel(), d.ravel(), c.ravel()), 1),
        ]
        vertices.append(grid.reshape(-1, 3))
        count += rows * columns
    return Mesh(np.concatenate(vertices), np.concatenate(faces).astype(np.uint32))


def _top(ring: Array, y: float) -> float:
    upper = ring[: len(ring) // 2 + 1]
    return float(np.interp(y, upper[:, 0], upper[:, 1]))


_AROUND, _ABOVE = math.radians(62.0), math.radians(15.0)
"""The helicopter is seen from starboard, so far from behind, so far above."""
_NEARER, _RISING, _ROLLED = math.radians(27.0), math.radians(2.0), math.radians(18.0)
"""The lifted blade: its tip towards the viewer, its tip up, its upper side towards the viewer."""
_FROM_HUB = (-1.55, -1.55, 7.0)
"""Place of the lifted blade from the hub, in radii: right, up and towards the viewer."""
_MARGIN = 0.96
_ASIDE = np.radians(np.arange(1.0, 31.0))
"""The viewer goes so far round to the left until a narrow canvas has room for the whole helicopter."""


def _view(aside: float = 0.0) -> tuple[Array, Array, Array]:
    """Right, up and towards the viewer, who went so far round to the left [rad]."""
    around = _AROUND - aside
    backward = direction(around, _ABOVE)
    right = np.array([-math.sin(around), math.cos(around), 0.0])
    return right, np.cross(backward, right), backward


def lifted_pose(radius: float) -> Pose:
    """Where the blade of a rotor of this radius [m] is held, in the world."""
    heading = _AROUND + 0.5 * math.pi - _NEARER
    turn = composed_rotation(
        axis_rotation(2, heading), axis_rotation(1, -_RISING), axis_rotation(0, _ROLLED)
    )
    place = sum(share * axis for share, axis in zip(_FROM_HUB, _view(), strict=True))
    return Pose(turn, radius * np.asarray(place))


def fit_lifted(radius: float, aspect: float) -> Camera:
    """The nearest view of the lifted blade: root at the far left, tip at the near right, the helicopter beyond.

    The two are in the middle of the height, and no part of the blade is below it.
    """
    psi = np.linspace(0.0, 2.0 * math.pi, 25)
    rim = radius * np.stack((np.cos(psi), np.sin(psi), np.zeros_like(psi)), axis=1)
    camera = _fit_from(radius, aspect, 0.0)
    for aside in _ASIDE:
        # Between cards the camera stands further back, and what is far away further out.
        if (
            seen_at(
                between_cards(camera, USUAL_COVER, USUAL_COVER.free * aspect),
                rim,
                USUAL_COVER.free * aspect,
            )[:, 0].max()
            <= _MARGIN
        ):
            break
        camera = _fit_from(radius, aspect, aside)
    return camera


def _fit_from(radius: float, aspect: float, aside: float) -> Camera:
    """The same from so far round to the left [rad]."""
    pose, (_, upward, toward) = lifted_pose(radius), _view(aside)
    ends = [radius * (r - ORIGIN_R) for r in (0.03, 1.02)]
    box = np.array(
        [
            [x, y, z]
            for x in ends
            for y in (-0.20 * radius, 0.06 * radius)
            for z in (-0.05 * radius, 0.12 * radius)
        ]
    )
    camera = framed(rotate(pose.wxyz, box) + pose.position, toward, aspect, _MARGIN)
    blade = (
        rotate(pose.wxyz, radius * np.array([[x / radius, -0.15, 0.0] for x in ends]))
        + pose.position
    )
    craft = radius * np.array([[1.3, 0.0, 0.45], [-1.0, 0.0, 0.15], [0.4, 0.0, -0.5]])
    top, low = (
        float(seen_at(camera, craft, aspect)[:, 1].min()),
        float(seen_at(camera, blade, aspect)[:, 1].max()),
    )
    # Turned up: a camera that rose would move the blade, which is near, and hardly the helicopter.
    sight = math.dist(camera.position, camera.look_at)
    up = min(0.5 - 0.5 * (top + low), _MARGIN - low) * 2.0 * sight * math.tan(FIELD_OF_VIEW / 2.0)
    return Camera(camera.position, camera.look_at + up * upward)
