"""The blade's cross section with active plies: true contour, spar web, calibrated on the published GJ.

Plies are placed in the middle of their wall. Outside they have a larger arm: 2 % more twist on a 2 mm skin, 13 % on
4.5 mm by finite elements, so the model is conservative.
"""

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq

from rotor.actuator.catalogue import PiezoPly
from rotor.actuator.placement import Host, Placement
from rotor.airfoil.contour import leading_edge_index, load_contour, resample
from rotor.arrays import Array
from rotor.dynamics.structure import BladeStructure, glass, structure_data, titanium
from rotor.dynamics.thin_wall import Layer, Panel, WallSection, build_section, torsional_stiffness

POINTS = 60
"""Per stretch of skin; 200 move GJ by less than 1e-3 (tested)."""


@dataclass(frozen=True)
class SectionSpec:
    """Passive data of a section."""

    host: Host
    chord: float
    """[m]"""
    stiffness: float
    """GJ [N m²] to calibrate on."""
    contour: str = "sc1095"


def active_section(spec: SectionSpec, ply: PiezoPly, placement: Placement) -> WallSection:
    """The section with its plies.

    Retrofit: the passive section is calibrated, then plies are bonded outside, so GJ grows. New blade: the plies are
    part of the torsion box, whose passive skin is made as thick as the wanted GJ leaves room for.
    """
    active = ply.layer(placement.plies, placement.angle)
    if spec.host.kind == "retrofit":
        wall = passive_wall(spec)
        return build_section(_panels(spec, wall, placement, active))
    return build_section(_panels(spec, passive_skin(spec, ply, placement), placement, active))


def passive_section(spec: SectionSpec) -> WallSection:
    """The section before anything is bonded to it."""
    return build_section(_panels(spec, passive_wall(spec), None, None))


@lru_cache(maxsize=32)
def passive_wall(spec: SectionSpec) -> float:
    """Wall thickness [m] (spar of the flown blade, skin of a new one) that gives the wanted GJ without plies."""
    return _calibrate(spec, None, None)


@lru_cache(maxsize=64)
def passive_skin(spec: SectionSpec, ply: PiezoPly, placement: Placement) -> float:
    """Passive skin [m] of a new blade that, with the plies in it, has the wanted GJ."""
    return _calibrate(spec, placement, ply.layer(placement.plies, placement.angle))


def _calibrate(spec: SectionSpec, placement: Placement | None, active: Layer | None) -> float:
    def excess(thickness: float) -> float:
        section = build_section(_panels(spec, thickness, placement, active))
        return torsional_stiffness(section) / spec.stiffness - 1.0

    thinnest, thickest = 5e-5, 2e-2
    if excess(thinnest) > 0.0:
        raise ValueError(
            f"the plies alone are stiffer than the GJ of {spec.stiffness:.0f} N·m² required: "
            "use fewer plies or a stiffer blade"
        )
    return float(brentq(excess, thinnest, thickest, xtol=1e-8))


def _panels(spec: SectionSpec, wall: float, placement: Placement | None, active: Layer | None) -> tuple[Panel, ...]:
    """Walls of the section, walked from the upper trailing edge around the nose: the inside is on the left."""
    data = structure_data()["section"]
    retrofit = spec.host.kind == "retrofit"
    web = float(data["spar_web_c"])
    end = 1.0 if retrofit else float(data["box_end_c"])
    front_skin = _spar(wall) if retrofit else _glass(wall)
    rear_skin = _glass(1e-3 * float(data["aft_skin_mm"])) if retrofit else front_skin
    edges = {0.0, end, *((web,) if retrofit else ()), *(placement.chord if placement else ())}
    cuts = sorted(edge for edge in edges if edge <= end)
    panels: list[Panel] = []
    for side in ("upper", "lower"):
        for front, rear in pairwise(cuts):
            in_front = not retrofit or rear <= web
            layers = front_skin if in_front else rear_skin
            if active and placement and placement.chord[0] <= front and rear <= placement.chord[1]:
                layers = (*layers, active)
            points = skin(spec, side, front, rear)
            panels.append(Panel(points if side == "lower" else points[::-1], layers, (1,) if in_front else (2,)))
    if retrofit:
        panels.append(Panel(web_line(spec, web), front_skin, (1, -2)))
    panels.append(Panel(web_line(spec, end), rear_skin, (2,) if retrofit else (1,)))
    return tuple(panels)


def _spar(thickness: float) -> tuple[Layer, ...]:
    return (Layer(titanium(), thickness, 0.0),)


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
def _sides(name: str) -> tuple[Array, Array]:
    """Upper and lower outline, nose to trailing edge, chords."""
    fine = resample(load_contour(name), 401)
    nose = leading_edge_index(fine)
    return fine.points[nose::-1], fine.points[nose:]


def section_spec(structure: BladeStructure, host: Host) -> SectionSpec:
    """The section of a blade, calibrated on its GJ times the host's share."""
    return SectionSpec(host, structure.chord, host.stiffness * structure.section_stiffness)
