"""How each kind of actuator is drawn on the lifted blade, and the true sections that it is drawn on.

The kind says how deep it is (`Actuator.depth`), its placement where it lies; `DRAWINGS` has the rest.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from explorer.colours import Rgb
from explorer.picture.blade_mesh import section_ring
from rotor import Rotor
from rotor.actuator import Actuator, ExtensionTwist, InstalledActuator, PiezoPly, TorqueTube
from rotor.support.arrays import Array

PLY_EXAGGERATION = 5.0
"""Plies are drawn this much thicker, or they would be lines."""
SIDES = ("upper", "lower")
PLY_CLEARANCE = 0.0008
"""Plies are drawn this far off the wall [m], so that they do not share a surface with it."""
RING = 39
"""Points round a section, from the upper trailing edge over the nose."""
Span = tuple[float, float]
Glow = tuple[Rgb, float]
"""Colour and strength, 0…1."""


@dataclass(frozen=True)
class PieceStyle:
    """How a piece of the lifted blade looks; albedos are dark, for the page's lights bleach."""

    colour: Rgb
    opacity: float | None = None
    """None: opaque."""


@dataclass(frozen=True, eq=False)
class BladePart:
    """One piece: a line across the chord, thickened, at each station."""

    role: str
    """skin, spar, web or driven."""
    segment: int
    """The electrical segment that it belongs to; −1 for a piece that is not driven."""
    r: Array
    """(stations,)."""
    outer: Array
    """(stations, points, 2): y, z."""
    inner: Array | None = None
    """None for a sheet."""


@dataclass(frozen=True)
class Drawing:
    pieces: Callable[[InstalledActuator, Rotor], list[BladePart]]
    """What is driven, without twist."""
    style: PieceStyle
    glow: Callable[[float], Glow] | None
    """Its light at −1…1 of the drive; None: it has none."""
    fibres: bool = False
    """Whether fibres are drawn on it."""
    in_spar: bool = False
    """Whether the spar would hide it, and is left out."""


def _plies(installed: InstalledActuator, rotor: Rotor) -> list[BladePart]:
    """On both sides, from `PLY_CLEARANCE` off the contour."""
    placement, parts = installed.placement, list[BladePart]()
    far = PLY_CLEARANCE + PLY_EXAGGERATION * installed.actuator.depth(placement)
    for segment, r in _driven(installed):
        for side in SIDES:
            lines = np.stack([side_line(rotor, float(at), side, placement.chord, 14) for at in r])
            along = np.gradient(lines, axis=1)
            normal = np.stack((-along[..., 1], along[..., 0]), axis=-1)
            normal /= np.maximum(np.hypot(normal[..., 0], normal[..., 1]), 1e-12)[..., None]
            # Towards the outside: up on the upper side; the line runs aft, to −y.
            normal *= -1.0 if side == "upper" else 1.0
            parts.append(
                BladePart(
                    "driven", segment, r, lines + far * normal, lines + PLY_CLEARANCE * normal
                )
            )
    return parts


def _tubes(installed: InstalledActuator, rotor: Rotor) -> list[BladePart]:
    """About the quarter chord."""
    angle = np.linspace(0.0, 2.0 * np.pi, 21)
    circle = min(0.5 * installed.actuator.depth(installed.placement), 0.02) * np.stack(
        (np.cos(angle), np.sin(angle)), 1
    )
    rings = [
        (segment, r, np.broadcast_to(circle, (len(r), 21, 2))) for segment, r in _driven(installed)
    ]
    return [BladePart("driven", segment, r, outer, 0.8 * outer) for segment, r, outer in rings]


def _whole_skin(installed: InstalledActuator, rotor: Rotor) -> list[BladePart]:
    r = stations((rotor.blade.root_cutout, 1.0), 32)
    return [
        BladePart(
            "driven", 0, r, 1.012 * np.stack([section_ring(rotor, float(at), RING) for at in r])
        )
    ]


def _by_sign(share: float) -> Glow:
    """Amber, and blue for negative voltage."""
    return ((255, 78, 0) if share >= 0.0 else (0, 66, 255)), min(abs(share), 1.0)


def _heat(share: float) -> Glow:
    strength = min(abs(share), 1.0)
    return (255, round(30 + 60 * strength), 0), strength


DRAWINGS: dict[type[Actuator], Drawing] = {
    PiezoPly: Drawing(_plies, PieceStyle((70, 40, 22)), _by_sign, fibres=True),
    TorqueTube: Drawing(_tubes, PieceStyle((60, 34, 24)), _heat, in_spar=True),
    ExtensionTwist: Drawing(_whole_skin, PieceStyle((90, 84, 60), 0.5), None, fibres=True),
}


def _driven(installed: InstalledActuator) -> list[tuple[int, Array]]:
    spans = enumerate(installed.placement.segments)
    return [(segment, stations(span, 28)) for segment, span in spans if span[1] - span[0] > 1e-6]


def stations(span: Span, whole: int) -> Array:
    """r/R at which a stretch is drawn; `whole`: how many a blade would have from hub to tip."""
    return np.linspace(*span, max(2, round(whole * (span[1] - span[0])) + 1))


def side_line(rotor: Rotor, r: float, side: str, span: Span, points: int) -> Array:
    """One side of the section at r/R from x/c to x/c: y forward of the quarter chord, z up [m], (points, 2)."""
    ring, (front, rear) = section_ring(rotor, r, RING), span
    nose_to_tail = ring[RING // 2 :: -1] if side == "upper" else ring[RING // 2 :]
    x = front + (rear - front) * np.linspace(0.0, 1.0, points) ** (2.0 if front == 0.0 else 1.0)
    y = (0.25 - x) * float(rotor.blade.chord(r))
    return np.stack((y, np.interp(-y, -nose_to_tail[:, 0], nose_to_tail[:, 1])), axis=1)
