"""The blade's cross section with active plies, their placement, and the blade that carries them.

The section has the true contour and a spar web, and is calibrated on the published GJ. Plies are placed in the middle
of their wall. Outside they have a larger arm: 2 % more twist on a 2 mm skin, 13 % on 4.5 mm by finite elements, so the
model is conservative.
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Literal

import numpy as np
import scipy

from rotor.airfoil.contour import leading_edge_index, load_contour, resample
from rotor.dynamics.structure import BendingStructure, glass, structure_data, titanium
from rotor.dynamics.thin_wall import Layer, WallPanel, build_section, torsional_stiffness
from rotor.support.arrays import Array, read_only

BladeKind = Literal["retrofit", "new"]


@dataclass(frozen=True)
class Placement:
    """Active part of span and chord, both skins, and its plies."""

    span: tuple[float, float] = (0.2433, 0.9292)
    """r/R, inner and outer end."""
    chord: tuple[float, float] = (0.05, 0.80)
    """x/c, front and rear end."""
    plies: int = 2
    """Per skin; for a torque tube the number of tubes."""
    angle: float = math.pi / 4.0
    """Angle of the fibres from the span [rad]."""
    divisions: tuple[float, ...] = ()
    """r/R where one electrical segment ends and the next begins; each segment has a voltage of its own."""

    def __post_init__(self) -> None:
        low, high = self.span
        front, rear = self.chord
        if not 0.05 <= low < high <= 1.0:
            raise ValueError(
                f"active span {low:g}…{high:g} is not inside 0.05…1 R: give inner < outer as r/R"
            )
        if not 0.0 <= front < rear <= 0.95:
            raise ValueError(
                f"active chord {front:g}…{rear:g} is not inside 0…0.95 c: give front < rear as x/c"
            )
        if not 1 <= self.plies <= 12:
            raise ValueError(
                f"{self.plies} plies are outside 1…12: choose a number inside (six weigh as much as half a blade)"
            )
        if any(a >= b for a, b in pairwise((0.0, *self.divisions, 1.0))):
            raise ValueError(
                f"segment divisions {list(self.divisions)} must ascend between 0 and 1"
            )

    @property
    def segments(self) -> tuple[tuple[float, float], ...]:
        """Active spans of the segments, root to tip, r/R; a segment without active span is (a, a)."""
        edges = (0.0, *self.divisions, 1.0)
        low, high = self.span
        return tuple((min(max(a, low), high), min(max(b, low), high)) for a, b in pairwise(edges))


@dataclass(frozen=True)
class HostBlade:
    """The blade that carries the actuator."""

    kind: BladeKind = "retrofit"
    """`retrofit`: outside the skins of the existing blade; `new`: in the torsion skin of a new blade."""
    stiffness: float = 1.0
    """GJ relative to the existing blade; 1 for a retrofit."""

    def __post_init__(self) -> None:
        if not 0.1 <= self.stiffness <= 2.0:
            raise ValueError(
                f"blade stiffness {self.stiffness:g} is outside 0.1…2: give GJ relative to the existing blade"
            )
        if self.kind == "retrofit" and self.stiffness != 1.0:
            raise ValueError(
                f"a retrofit keeps the blade, so its stiffness cannot be {self.stiffness:g}: use 1, or a new blade"
            )

    @property
    def label(self) -> str:
        """The blade in words, for example `new blade, GJ × 0.5`."""
        if self.kind == "retrofit":
            return "retrofit"
        return "new blade" if self.stiffness == 1.0 else f"new blade, GJ × {self.stiffness:g}"


def default_placement(plies: int = 2, divisions: tuple[float, ...] = ()) -> Placement:
    """The placement of the worked example: full section to swept tip, 5–80 % chord, ±45°."""
    data = structure_data()["placement"]
    low, high = data["span_r"]
    front, rear = data["chord_c"]
    return Placement((low, high), (front, rear), plies, math.pi / 4.0, divisions)


POINTS = 60
"""Per stretch of skin; 200 move GJ by less than 1e-3 (tested)."""


@dataclass(frozen=True)
class SectionSpec:
    """Passive data of a section."""

    host: HostBlade
    chord: float
    """[m]"""
    stiffness: float
    """GJ [N m²] to calibrate on."""
    contour: str = "sc1095"


@lru_cache(maxsize=32)
def passive_wall(spec: SectionSpec) -> float:
    """Wall thickness [m] (spar of the flown blade, skin of a new one) that gives the wanted GJ without plies."""
    return calibrate(spec, None, None)


def calibrate(spec: SectionSpec, placement: Placement | None, active: Layer | None) -> float:
    """Passive wall thickness [m] for the wanted GJ with an active layer, or None; ValueError for plies too stiff."""

    def excess(thickness: float) -> float:
        section = build_section(panels(spec, thickness, placement, active))
        return torsional_stiffness(section) / spec.stiffness - 1.0

    thinnest, thickest = 5e-5, 2e-2
    if excess(thinnest) > 0.0:
        raise ValueError(
            f"the plies are stiffer than the required {spec.stiffness:.0f} N·m²: use fewer plies or a stiffer blade"
        )
    return float(scipy.optimize.brentq(excess, thinnest, thickest, xtol=1e-8))


def panels(
    spec: SectionSpec, wall: float, placement: Placement | None, active: Layer | None
) -> tuple[WallPanel, ...]:
    """Walls of thickness `wall` [m], from the upper trailing edge around the nose: the inside is on the left."""
    data = structure_data()["section"]
    retrofit = spec.host.kind == "retrofit"
    web = float(data["spar_web_c"])
    end = 1.0 if retrofit else float(data["box_end_c"])
    front_skin = (Layer(titanium(), wall, 0.0),) if retrofit else _glass(wall)
    rear_skin = _glass(1e-3 * float(data["aft_skin_mm"])) if retrofit else front_skin
    edges = {0.0, end, *((web,) if retrofit else ()), *(placement.chord if placement else ())}
    cuts = sorted(edge for edge in edges if edge <= end)
    panels: list[WallPanel] = []
    for side in ("upper", "lower"):
        for front, rear in pairwise(cuts):
            in_front = not retrofit or rear <= web
            layers = front_skin if in_front else rear_skin
            if active and placement and placement.chord[0] <= front and rear <= placement.chord[1]:
                layers = (*layers, active)
            points = skin(spec, side, front, rear)
            panels.append(
                WallPanel(
                    points if side == "lower" else points[::-1], layers, (1,) if in_front else (2,)
                )
            )
    if retrofit:
        panels.append(WallPanel(web_line(spec, web), front_skin, (1, -2)))
    panels.append(WallPanel(web_line(spec, end), rear_skin, (2,) if retrofit else (1,)))
    return tuple(panels)


def _glass(thickness: float) -> tuple[Layer, ...]:
    """Balanced ±45°."""
    half = 0.5 * thickness
    return (Layer(glass(), half, np.pi / 4.0), Layer(glass(), half, -np.pi / 4.0))


def skin(spec: SectionSpec, side: str, front: float, rear: float, points: int = POINTS) -> Array:
    """(y, z) of one skin from x/c = front to rear [m], dense at the nose."""
    x = front + (rear - front) * np.linspace(0.0, 1.0, points) ** (2.0 if front == 0.0 else 1.0)
    outline = _sides(spec.contour)[side == "lower"]
    return spec.chord * np.column_stack([x, np.interp(x, outline[:, 0], outline[:, 1])])


def web_line(spec: SectionSpec, at: float, points: int = 12) -> Array:
    """(y, z) of a web from lower to upper skin at x/c [m]."""
    bottom, top = (skin(spec, side, at, at + 1e-9, 2)[0] for side in ("lower", "upper"))
    return bottom + np.linspace(0.0, 1.0, points)[:, None] * (top - bottom)


@lru_cache(maxsize=4)
@read_only
def _sides(name: str) -> tuple[Array, Array]:
    """Upper and lower outline, nose to trailing edge, chords."""
    fine = resample(load_contour(name), 401)
    nose = leading_edge_index(fine)
    return fine.points[nose::-1], fine.points[nose:]


def section_spec(structure: BendingStructure, host: HostBlade) -> SectionSpec:
    """The section of a blade, calibrated on its GJ times the host's share."""
    return SectionSpec(host, structure.chord, host.stiffness * structure.section_stiffness)
