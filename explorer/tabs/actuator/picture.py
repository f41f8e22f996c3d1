"""The cut blade of one moment: meshes, colours, labels; arrays and text only."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from explorer.picture.solids import Mesh
from explorer.tabs.actuator import cut as actuator_cut
from explorer.tabs.actuator.state import ActuatorInputs
from explorer.text.units import number
from explorer.theme import colours
from rotor.actuator.catalogue import PiezoPly, TorqueTube
from rotor.actuator.installation import InstalledActuator
from rotor.arrays import Array
from rotor.design.design import Design

WALLS: dict[str, colours.Rgb] = {"spar": (70, 76, 86), "skin": (104, 106, 104), "web": (58, 64, 74)}
"""Dark albedos, for the page's lights bleach."""
BOX: colours.Rgb = (30, 32, 38)
SHANK: colours.Rgb = (52, 56, 64)
GHOST: colours.Rgb = (128, 133, 140)
LEAD: colours.Rgb = (200, 120, 20)
_STEPS = 201


@dataclass(frozen=True, eq=False)
class CutPicture:
    """What the scene assigns."""

    solids: tuple[tuple[Mesh, colours.Rgb], ...]
    ghost: Array
    """(segments, 2, 3)."""
    leads: Array
    """(segments, 2, 3)."""
    labels: tuple[tuple[str, Array], ...]
    """Text and where it stands [m]."""


def cut_picture(inputs: ActuatorInputs, installed: InstalledActuator, design: Design, psi: float) -> CutPicture:
    """The blade at azimuth `psi` [rad], the actuator's part of its twist magnified; `design` is without actuator."""
    rotor = design.rotor
    cut = actuator_cut.cut_blade(installed, rotor)

    def still(r: Array) -> Array:
        return design.twist(np.maximum(r, rotor.blade.root_cutout))

    def twist(r: Array) -> Array:
        moved = inputs.change(installed, r) + inputs.harmonic_twist(installed, psi, r)
        return still(r) + inputs.magnified * moved

    shares = voltage_shares(inputs, installed, psi)
    solids = [
        (
            actuator_cut.part_mesh(cut, part, twist(part.r)),
            WALLS[part.role] if part.role in WALLS else lit(share_colour(shares[part.segment])),
        )
        for part in cut.parts
    ]
    root = float(twist(np.array([rotor.blade.root_cutout]))[0])
    shank, box = actuator_cut.root_parts(cut, rotor, root)
    solids += [(shank, SHANK), (box, BOX)]
    edge_twist = twist(cut.edge_r)
    return CutPicture(
        solids=tuple(solids),
        ghost=actuator_cut.ghost_segments(cut, still(cut.edge_r)),
        leads=actuator_cut.lead_segments(cut, rotor, edge_twist),
        labels=_labels(inputs, installed, cut, twist),
    )


def voltage_shares(inputs: ActuatorInputs, installed: InstalledActuator, psi: float) -> tuple[float, ...]:
    """Of each segment, −1…1 of its positive or negative side, with the harmonic at this azimuth."""
    steady = inputs.drive_shares(installed)
    if not inputs.per_rev or not isinstance(installed.actuator, PiezoPly):
        return steady
    wave = 0.01 * inputs.amplitude * math.cos(inputs.per_rev * psi - math.radians(inputs.phase))
    low, high = installed.actuator.voltage_range
    found = []
    for volts in inputs.volts(installed):
        now = volts + 0.5 * installed.actuator.voltage_swing * (-wave if inputs.crossed else wave)
        found.append(now / high if now >= 0.0 else now / -low if low < 0.0 else -1.0)
    return tuple(min(max(share, -1.0), 1.0) for share in found)


def share_colour(share: float) -> colours.Rgb:
    """Of a voltage from −1 to 1, blue over pale to rust."""
    scheme = colours.colour_map("diverging", _STEPS)
    red, green, blue = scheme[round(0.5 * (min(max(share, -1.0), 1.0) + 1.0) * (_STEPS - 1))].tolist()
    return red, green, blue


def lit(colour: colours.Rgb) -> colours.Rgb:
    """An albedo that looks like `colour` under the page's lights, nearly."""
    red, green, blue = (round(255.0 * 0.82 * (channel / 255.0) ** 1.45) for channel in colour)
    return red, green, blue


def drive_text(inputs: ActuatorInputs, installed: InstalledActuator, segment: int) -> str:
    """What drives a segment, in words."""
    if isinstance(installed.actuator, PiezoPly):
        return f"{number(inputs.volts(installed)[segment], sign=True)} V"
    return f"{number(100.0 * inputs.drive_shares(installed)[segment], sign=True)} %"


def _labels(
    inputs: ActuatorInputs, installed: InstalledActuator, cut: actuator_cut.Cut, twist: Callable[[Array], Array]
) -> tuple[tuple[str, Array], ...]:
    def at(r: float, y: float, z: float) -> Array:
        return actuator_cut.anchor(cut, r, y, z, float(twist(np.array([r]))[0]))

    labels = [("drive electronics", at(0.5 * (cut.box[0] + 0.12), -0.01, 0.2))]
    window = cut.windows[0]
    tip = math.degrees(float(inputs.change(installed, 1.0)))
    if round(tip, 2):
        labels.append((f"tip {number(tip, 2, sign=True)}°, drawn × {inputs.magnified:g}", at(0.80, -0.50, -0.05)))
    labels.append(("spar web", at(0.5 * sum(window), -0.02, 0.13)))
    if isinstance(installed.actuator, (PiezoPly, TorqueTube)):
        for k, (low, high) in enumerate(actuator_cut.spans_of(cut)):
            word = "segment " if len(installed.shapes) < 4 else ""
            name = f"{word}{k + 1}: " if len(installed.shapes) > 1 else ""
            place = 0.5 * (low + high)
            if window[0] - 0.02 < place < window[1] + 0.02:
                place = 0.5 * (window[1] + high) if high > window[1] + 0.05 else 0.5 * (low + window[0])
            labels.append((name + drive_text(inputs, installed, k), at(place, 0.0, 0.14)))
    return tuple(labels)
