"""Walls, web and plies of the cut blade: lines across the true sections, thickened. Metres.

Axes as of a blade: y to the leading edge, z up, the quarter chord at the origin of each section.
"""

from dataclasses import dataclass, replace

import numpy as np

from rotor.actuator.section import SectionSpec, skin
from rotor.arrays import Array
from rotor.design.blade import Rotor

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
    made = np.zeros((points, 2))
    for name, share in ((inner, 1.0 - weight), (outer, weight)):
        if share:
            own = replace(spec, contour=_contour(name))
            made += share * skin(own, side, *chord, points)
    return scale * np.stack((0.25 * spec.chord - made[:, 0], made[:, 1]), axis=1)


def _thickness(spec: SectionSpec, rotor: Rotor, r: Array, chord: tuple[float, float], points: int) -> Array:
    found = [
        _line(spec, rotor, float(at), "upper", chord, points)[:, 1]
        - _line(spec, rotor, float(at), "lower", chord, points)[:, 1]
        for at in r
    ]
    return np.maximum(np.array(found), 0.0)


def _contour(section: str) -> str:
    return "sc1094r8" if section.startswith("sc1094r8") else "sc1095"
