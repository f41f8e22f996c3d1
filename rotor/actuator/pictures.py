"""Arrays for drawings and charts: section with plies, twist under voltage, required and attainable twist."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotor.actuator.catalogue import PiezoPly, TorqueTube
from rotor.actuator.installation import InstalledActuator
from rotor.actuator.pay import BreakEven
from rotor.actuator.section import passive_skin, passive_wall, section_spec, skin, web_line
from rotor.arrays import Array
from rotor.chart import Axis, Chart, Line
from rotor.dynamics.structure import structure_data, uh60a_structure


@dataclass(frozen=True, eq=False)
class Part:
    """A filled polygon of the cut through the blade."""

    role: str
    """outline, spar, skin, web, ply or tube."""
    points: Array
    """(y aft, z up) from the leading edge [m], (points, 2), closed by its ends."""
    label: str


@dataclass(frozen=True, eq=False)
class SectionPicture:
    """Parts of the section cut, in drawing order."""

    parts: tuple[Part, ...]
    chord: float
    """[m]"""


def section_picture(installed: InstalledActuator, *, exaggerate: float = 1.0) -> SectionPicture:
    """Outline, walls and plies; wall and ply thickness times `exaggerate`, to make 0.3 mm visible."""
    structure = uh60a_structure(float(installed.beam.r[-1]))
    spec, placement, actuator = section_spec(structure, installed.host), installed.placement, installed.actuator
    data = structure_data()["section"]
    retrofit = installed.host.kind == "retrofit"
    outline = np.concatenate([skin(spec, "upper", 0.0, 1.0)[::-1], skin(spec, "lower", 0.0, 1.0)[1:]])
    parts = [Part("outline", outline, "SC1095")]
    rear = float(data["spar_web_c"] if retrofit else data["box_end_c"])
    plies_inside = not retrofit and isinstance(actuator, PiezoPly)
    wall = exaggerate * (passive_skin(spec, actuator, placement) if plies_inside else passive_wall(spec))
    name = "titanium spar" if retrofit else "glass torsion box"
    role = "spar" if retrofit else "skin"
    for side in ("upper", "lower"):
        parts.append(Part(role, ribbon(skin(spec, side, 0.0, rear), wall, inward=side), f"{name}, {side}"))
        if retrofit:
            thin = 1e-3 * float(data["aft_skin_mm"]) * exaggerate
            parts.append(Part("skin", ribbon(skin(spec, side, rear, 1.0), thin, inward=side), f"aft skin, {side}"))
    web = web_line(spec, rear)
    parts.append(Part("web", np.concatenate([web, (web - [wall, 0.0])[::-1]]), "web"))
    if isinstance(actuator, PiezoPly):
        thickness = placement.plies * actuator.thickness * exaggerate
        for side in ("upper", "lower"):
            line = skin(spec, side, *placement.chord)
            out = "lower" if side == "upper" else "upper"
            ply = ribbon(line, thickness, inward=out if retrofit else side)
            degrees = math.degrees(placement.angle)
            parts.append(Part("ply", ply, f"{placement.plies} × {actuator.name}, ±{degrees:.0f}°, {side}"))
    elif isinstance(actuator, TorqueTube):
        turn = np.linspace(0.0, 2.0 * np.pi, 49)
        middle = skin(spec, "upper", 0.25, 0.26, 2)[0] + skin(spec, "lower", 0.25, 0.26, 2)[0]
        ring = 0.5 * middle + 0.5 * actuator.diameter * np.column_stack([np.cos(turn), np.sin(turn)])
        parts.append(Part("tube", ring, actuator.name))
    return SectionPicture(tuple(parts), spec.chord)


def ribbon(line: Array, thickness: float, *, inward: str) -> Array:
    """A line thickened to one side: `inward` of the upper skin is down, of the lower skin up."""
    along = np.column_stack([np.gradient(line[:, 0]), np.gradient(line[:, 1])])
    normal = np.column_stack([-along[:, 1], along[:, 0]]) / np.hypot(*along.T)[:, None]
    normal *= np.where(normal[:, 1] > 0.0, 1.0, -1.0)[:, None]  # Up.
    offset = line + (thickness if inward == "lower" else -thickness) * normal
    return np.concatenate([line, offset[::-1]])


@dataclass(frozen=True, eq=False)
class TwistCurve:
    """Change of twist along the blade."""

    r: Array
    """r/R, (stations,)."""
    twist: Array
    """[rad], (stations,)."""


def twist_under_voltage(installed: InstalledActuator, voltages: Sequence[float]) -> TwistCurve:
    """The blade's twist with each segment at its voltage [V], zero volts being the jig twist.

    Voltages beyond the range raise ValueError. For a tube, "voltage" is the share of its torque, −1…1.
    """
    if len(voltages) != len(installed.shapes):
        raise ValueError(f"{len(voltages)} voltages for {len(installed.shapes)} segments: give one for each")
    if isinstance(installed.actuator, PiezoPly):
        low, high = installed.actuator.voltage_range
        unit = installed.actuator.voltage_swing
    else:
        low, high, unit = -1.0, 1.0, 1.0
    for voltage in voltages:
        if not low - 1e-9 <= voltage <= high + 1e-9:
            raise ValueError(f"voltage {voltage:g} is outside {low:g}…{high:g}: choose a value inside")
    r = np.linspace(float(installed.r[0]), 1.0, 61)
    return TwistCurve(r, installed.change(np.asarray(voltages, dtype=float) / unit, r))


def electronics_station(installed: InstalledActuator) -> tuple[float, float]:
    """Inner and outer end of the drive electronics, r/R (figure 5.8), between flap hinge and active span."""
    return float(installed.r[0]) + 0.02, installed.placement.span[0] - 0.02


def break_even_chart(even: BreakEven) -> Chart:
    """Mass that just pays over twist, without drive power and with half of what unlimited twist saves."""
    half, degrees = 0.5 * even.ideal_saving, tuple(np.degrees(even.twists).tolist())
    driven = tuple(even.mass_allowed(twist, half) for twist in even.twists.tolist())
    lines = (
        Line("no drive power", degrees, tuple(even.masses.tolist()), 1),
        Line(f"{half:.0f} W of drive", degrees, driven, 1, dashes=True),
    )
    return Chart("Pays below the line", Axis("range of linear twist [°]"), Axis("mass of all blades [kg]"), lines)
