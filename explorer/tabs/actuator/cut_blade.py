"""The blade cut open, as arrays: walls, web and plies lofted from the true sections, and the camera for it."""

import math
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from explorer.picture.camera_views import Camera, framed
from explorer.picture.solids import Mesh
from rotor.actuator.catalogue import PiezoPly, TorqueTube
from rotor.actuator.installation import InstalledActuator
from rotor.actuator.pictures import electronics_station
from rotor.actuator.section import SectionSpec, passive_skin, passive_wall, section_spec, skin
from rotor.arrays import Array
from rotor.design.blade import Rotor
from rotor.dynamics.structure import structure_data, uh60a_structure

THICKER = 3.5
"""Walls and plies are drawn this much thicker, or they would be lines."""
SIDES = ("upper", "lower")


@dataclass(frozen=True, eq=False)
class CutPart:
    """One piece: a line across the chord, thickened, at each station."""

    role: str
    """spar, skin, web, ply or tube."""
    segment: int
    """The electrical segment that a ply belongs to; −1 for all else."""
    r: Array
    """(stations,)."""
    outer: Array
    """(stations, points, 2): y, z."""
    inner: Array


def skin_part(
    spec: SectionSpec,
    rotor: Rotor,
    role: str,
    side: str,
    chord: tuple[float, float],
    span: tuple[float, float],
    near: float,
    far: float,
) -> CutPart:
    """A strip of skin between two distances from the contour [m], outward positive, drawn `THICKER`."""
    r = stations(span)
    points = 30 if chord[0] == 0.0 else 20
    lines = np.stack([_line(spec, rotor, float(at), side, chord, points) for at in r])
    along = np.gradient(lines, axis=1)
    normal = np.stack((-along[..., 1], along[..., 0]), axis=-1)
    normal /= np.maximum(np.hypot(normal[..., 0], normal[..., 1]), 1e-12)[..., None]
    # Towards the outside: up on the upper side; the line runs aft, to −y.
    normal *= -1.0 if side == "upper" else 1.0
    # Thick walls may not meet inside the thin rear of the blade.
    room = np.minimum(np.abs(far) * THICKER, 0.3 * _thickness(spec, rotor, r, chord, points))
    outward = room if far > 0.0 else -room
    return CutPart(role, -1, r, lines + near * normal, lines + outward[..., None] * normal)


def web_part(spec: SectionSpec, rotor: Rotor, at: float, span: tuple[float, float], wall: float) -> CutPart:
    """The wall across the section at x/c."""
    r = stations(span)
    lines = []
    for station in r:
        top, bottom = (_line(spec, rotor, float(station), side, (at, at + 1e-6), 2)[0] for side in SIDES)
        lines.append(bottom + np.linspace(0.0, 1.0, 6)[:, None] * (top - bottom))
    rear = np.stack(lines)
    return CutPart("web", -1, r, rear, rear + np.array([THICKER * wall, 0.0]))


def tube_part(radius: float, span: tuple[float, float], number: int) -> CutPart:
    """A torque tube about the quarter chord."""
    r = stations(span)
    angle = np.linspace(0.0, 2.0 * np.pi, 25)
    circle = np.stack((np.cos(angle), np.sin(angle)), axis=1)
    size = min(radius, 0.02)
    outer = np.broadcast_to(size * circle, (len(r), 25, 2))
    return CutPart("tube", number, r, outer, 0.8 * outer)


def outline(spec: SectionSpec, rotor: Rotor, r: float) -> Array:
    """From the upper trailing edge over the nose to the lower one, (points, 2)."""
    upper, lower = (_line(spec, rotor, r, side, (0.0, 1.0), 24) for side in SIDES)
    return np.concatenate((upper[::-1], lower[1:]))


def stations(span: tuple[float, float]) -> Array:
    """r/R at which a stretch is drawn."""
    return np.linspace(*span, max(2, round(40.0 * (span[1] - span[0])) + 1))


def without(spans: tuple[tuple[float, float], ...], gap: tuple[float, float]) -> tuple[tuple[float, float], ...]:
    """What is left of stretches of span when one is cut out."""
    kept: list[tuple[float, float]] = []
    for low, high in spans:
        edges = [(low, min(high, gap[0])), (max(low, gap[1]), high)]
        kept += [(a, b) for a, b in edges if b - a > 1e-6]
    return tuple(kept)


def _line(spec: SectionSpec, rotor: Rotor, r: float, side: str, chord: tuple[float, float], points: int) -> Array:
    """One side of the section at r/R from x/c to x/c: y forward of the quarter chord, z up [m], (points, 2)."""
    inner, outer, weight = rotor.blade.section_at(r)
    scale = float(rotor.blade.chord(r)) / spec.chord
    line = np.zeros((points, 2))
    for name, share in ((inner, 1.0 - weight), (outer, weight)):
        if share:
            own = replace(spec, contour=_contour(name))
            line += share * skin(own, side, *chord, points)
    return scale * np.stack((0.25 * spec.chord - line[:, 0], line[:, 1]), axis=1)


def _thickness(spec: SectionSpec, rotor: Rotor, r: Array, chord: tuple[float, float], points: int) -> Array:
    heights = [
        _line(spec, rotor, float(at), "upper", chord, points)[:, 1]
        - _line(spec, rotor, float(at), "lower", chord, points)[:, 1]
        for at in r
    ]
    return np.maximum(np.array(heights), 0.0)


def _contour(section: str) -> str:
    return "sc1094r8" if section.startswith("sc1094r8") else "sc1095"


SPAN_SCALE = 0.22
"""The blade is sixteen times as long as it is wide: drawn so, it would be a thread."""
LIFT = 0.0006
"""Plies are drawn this far off the wall [m], so that they do not share a surface with it."""
_NOSE = 0.12
"""The upper wall stays closed in front of this x/c where the blade is opened."""


@dataclass(frozen=True, eq=False)
class Cut:
    """The blade without twist."""

    parts: tuple[CutPart, ...]
    edge: Array
    """Nose, trailing edge and tip outline for the ghost of the blade at rest, (stations, points, 2)."""
    edge_r: Array
    box: tuple[float, float]
    """Where the electronics sit, r/R."""
    radius: float
    windows: tuple[tuple[float, float], ...]
    """Stretches of the upper side that are left out, r/R."""

    def outward(self, r: Array | float) -> Array:
        """x of a station [m]."""
        return SPAN_SCALE * self.radius * (np.asarray(r, dtype=float) - 0.55)


@lru_cache(maxsize=8)
def cut_blade(installed: InstalledActuator, rotor: Rotor) -> Cut:
    """The pieces for an actuator on a blade."""
    spec = section_spec(uh60a_structure(rotor.radius), installed.host)
    data = structure_data()["section"]
    placement, actuator = installed.placement, installed.actuator
    retrofit = installed.host.kind == "retrofit"
    web = float(data["spar_web_c"] if retrofit else data["box_end_c"])
    ply = isinstance(actuator, PiezoPly)
    wall = passive_skin(spec, actuator, placement) if ply and not retrofit else passive_wall(spec)
    thin = max(1e-3 * float(data["aft_skin_mm"]), 0.0005)
    whole = ((rotor.blade.root_cutout, 1.0),)
    low, high = placement.span
    window = (low + 0.34 * (high - low), low + 0.56 * (high - low))
    opened = without(whole, window)
    box = "spar" if retrofit else "skin"
    pieces: list[CutPart] = []

    def add(role: str, side: str, chord: tuple[float, float], spans: tuple[tuple[float, float], ...], t: float) -> None:
        pieces.extend(skin_part(spec, rotor, role, side, chord, span, 0.0, -t) for span in spans)

    add(box, "lower", (0.0, web), whole, wall)
    add(box, "upper", (0.0, _NOSE), whole, wall)
    add(box, "upper", (_NOSE, web), opened, wall)
    add("skin", "lower", (web, 1.0), whole, thin)
    add("skin", "upper", (web, 1.0), opened, thin)
    pieces.append(web_part(spec, rotor, web, whole[0], wall))
    if ply:
        far = LIFT + placement.plies * actuator.thickness
        for number, span in enumerate(placement.segments):
            if span[1] - span[0] > 1e-6:
                for side in SIDES:
                    for part in without((span,), window) if side == "upper" else (span,):
                        piece = skin_part(spec, rotor, "ply", side, placement.chord, part, LIFT, far)
                        pieces.append(replace(piece, segment=number))
    elif isinstance(actuator, TorqueTube):
        for number, span in enumerate(placement.segments):
            if span[1] - span[0] > 1e-6:
                pieces.append(tube_part(0.5 * actuator.diameter, span, number))
    edge_r = stations(whole[0])
    edge = np.stack([outline(spec, rotor, float(r)) for r in edge_r])
    return Cut(tuple(pieces), edge, edge_r, electronics_station(installed), rotor.radius, (window,))


def part_mesh(cut: Cut, part: CutPart, twist: Array) -> Mesh:
    """The piece with the blade's twist [rad] at its stations, as a closed solid of flat-edged grids."""
    outer, inner = (_turned(cut, part.r, lines, twist) for lines in (part.outer, part.inner))
    grids = [
        outer,
        inner,
        np.stack((outer[:, 0], inner[:, 0]), axis=1),
        np.stack((outer[:, -1], inner[:, -1]), axis=1),
        np.stack((outer[0], inner[0])),
        np.stack((outer[-1], inner[-1])),
    ]
    return _grids(grids)


def ghost_segments(cut: Cut, twist: Array) -> Array:
    """The blade's outline without the actuator's twist: both edges and the tip, (segments, 2, 3)."""
    rings = _turned(cut, cut.edge_r, cut.edge, twist)
    nose = rings.shape[1] // 2
    lines = [np.stack((line[:-1], line[1:]), axis=1) for line in (rings[:, nose], rings[:, 0], rings[-1])]
    return np.concatenate(lines)


def root_parts(cut: Cut, rotor: Rotor, twist: float) -> tuple[Mesh, Mesh]:
    """Shank and black box."""
    start, end = rotor.blade.flap_hinge, rotor.blade.root_cutout
    angle = np.linspace(0.0, 2.0 * np.pi, 25)
    circle = 0.042 * np.stack((np.cos(angle), np.sin(angle)), axis=1)
    r = np.array([start, end + 0.006])
    rings = _turned(cut, r, np.stack((circle, circle)), np.full(2, twist))
    hub_side = np.stack((rings[0], np.broadcast_to(rings[0].mean(axis=0), rings[0].shape)))
    shank = _grids([rings, hub_side])
    low = cut.box[0]
    high = min(cut.box[1], end - 0.006)
    corner = np.array([[-0.11, 0.046], [0.09, 0.046], [0.09, 0.135], [-0.11, 0.135], [-0.11, 0.046]])
    ends = _turned(cut, np.array([low, high]), np.stack((corner, corner)), np.full(2, twist))
    sides = [ends[:, k : k + 2] for k in range(4)]
    caps = [np.stack((end[[0, 1]], end[[3, 2]])) for end in ends]
    return shank, _grids([*sides, *caps])


def lead_segments(cut: Cut, rotor: Rotor, twist: Array) -> Array:
    """Leads from the black box along the nose to the inner end of each segment, (segments, 2, 3).

    `twist` at `edge_r`.
    """
    starts = sorted({float(part.r[0]) for part in cut.parts if part.segment >= 0})
    if not starts:
        return np.zeros((0, 2, 3))
    box_end = min(cut.box[1], rotor.blade.root_cutout - 0.006)
    lines: list[Array] = []
    for number, start in enumerate(starts):
        r = np.unique(np.concatenate(([box_end, start], cut.edge_r[(cut.edge_r > box_end) & (cut.edge_r < start)])))
        y = 0.105 + 0.006 * number
        top = np.interp(r, cut.edge_r, [_top(ring, y) for ring in cut.edge])
        path = np.stack((np.full(len(r), y), top + 0.004), axis=1)[:, None]
        line = _turned(cut, r, path, np.interp(r, cut.edge_r, twist))[:, 0]
        lines.append(np.stack((line[:-1], line[1:]), axis=1))
    return np.concatenate(lines)


def anchor(cut: Cut, r: float, y: float, z: float, twist: float) -> Array:
    """A point of the twisted blade, (3,)."""
    return _turned(cut, np.array([r]), np.array([[[y, z]]]), np.array([twist]))[0, 0]


def _turned(cut: Cut, r: Array, lines: Array, twist: Array) -> Array:
    """(stations, points, 2) with a nose-up twist at each → (stations, points, 3)."""
    cos, sin = np.cos(twist)[:, None], np.sin(twist)[:, None]
    y, z = lines[..., 0], lines[..., 1]
    x = np.broadcast_to(cut.outward(r)[:, None], y.shape)
    return np.stack((x, y * cos - z * sin, y * sin + z * cos), axis=-1)


def _grids(grids: list[Array]) -> Mesh:
    """Sheets of quadrilaterals, (rows, columns, 3) each, that share no vertices: their edges stay sharp."""
    vertices, faces, count = [], [], 0
    for grid in grids:
        rows, columns = grid.shape[:2]
        index = count + np.arange(rows * columns).reshape(rows, columns)
        a, b, c, d = index[:-1, :-1], index[:-1, 1:], index[1:, :-1], index[1:, 1:]
        faces += [np.stack((a.ravel(), b.ravel(), d.ravel()), 1), np.stack((a.ravel(), d.ravel(), c.ravel()), 1)]
        vertices.append(grid.reshape(-1, 3))
        count += rows * columns
    return Mesh(np.concatenate(vertices), np.concatenate(faces).astype(np.uint32))


def spans_of(cut: Cut) -> list[tuple[float, float]]:
    """Active stretches, root to tip."""
    numbers = sorted({part.segment for part in cut.parts if part.segment >= 0})
    ends: list[tuple[float, float]] = []
    for number in numbers:
        own = [part.r for part in cut.parts if part.segment == number]
        ends.append((min(float(r[0]) for r in own), max(float(r[-1]) for r in own)))
    return ends


def _top(ring: Array, y: float) -> float:
    upper = ring[: len(ring) // 2 + 1]
    return float(np.interp(y, upper[:, 0], upper[:, 1]))


_AROUND = math.radians(46.0)
"""From behind the trailing edge towards the root."""
_ABOVE = math.radians(33.0)
_MARGIN = 0.93


def fit_cut(radius: float, aspect: float) -> Camera:
    """Root at the near left, tip at the far right, trailing edge towards the viewer."""
    backward = np.array(
        [-math.sin(_AROUND) * math.cos(_ABOVE), -math.cos(_AROUND) * math.cos(_ABOVE), math.sin(_ABOVE)]
    )
    inner, outer = (SPAN_SCALE * radius * (r - 0.55) for r in (0.045, 1.01))
    points = np.array([[x, y, z] for x in (inner, outer) for y in (-0.42, 0.2) for z in (-0.12, 0.2)])
    return framed(points, backward, aspect, _MARGIN)
