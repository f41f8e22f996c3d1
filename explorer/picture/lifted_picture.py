"""The lifted blade as a picture: its meshes, lines and labels."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from explorer.colours import Rgb
from explorer.model.actuator_inputs import ActuatorInputs
from explorer.model.units import number
from explorer.picture import lifted_blade as lifted
from explorer.picture.actuator_drawings import DRAWINGS, Glow, PieceStyle
from explorer.picture.blade_mesh import Mesh
from explorer.text.readout import mass_parts
from rotor import Design, Solution
from rotor.actuator import Actuator, InstalledActuator
from rotor.support.arrays import Array

SURFACES = {
    "skin": PieceStyle((92, 106, 130), 0.34),
    "spar": PieceStyle((44, 50, 60), 0.42),
    "web": PieceStyle((30, 34, 42)),
    "shank": PieceStyle((40, 44, 52)),
    "box": PieceStyle((14, 42, 30)),
}
EDGE: Rgb = (178, 20, 6)
"""Colour of the lifted blade's edge, as of the reference blade."""
OVERLAY: Rgb = (128, 133, 140)
LEAD: Rgb = (214, 136, 24)
FIBRE: tuple[Rgb, Rgb] = ((150, 84, 36), (255, 160, 70))
"""At rest, and at full voltage."""
ARROW: Rgb = (6, 48, 190)
LEADER: Rgb = (128, 136, 150)
_LABEL_OUT = 1.15
"""Labels stand so far behind the pitch axis, over the distance of the trailing edge, which is nearest to the camera."""
TWIST_EXAGGERATION = 8.0
"""By how much the actuator's part of the twist is exaggerated; the numbers stay true."""


@dataclass(frozen=True, eq=False)
class StyledMesh:
    mesh: Mesh
    surface: PieceStyle
    glow: Glow | None = None


@dataclass(frozen=True, eq=False)
class LiftedPicture:
    """Solids and lines (segments, 2, 3) by name; labels: kind, text and where it stands [m]; the fibres shine 0…1."""

    solids: dict[str, StyledMesh]
    lines: dict[str, Array]
    labels: tuple[tuple[str, str, Array], ...]
    lit: float


@dataclass(frozen=True, eq=False)
class FlownTwist:
    """Twist of an elastic blade at one azimuth [rad], (stations,)."""

    r: Array
    still: Array
    """Elastic twist without voltage."""
    moved: Array
    """What voltage changes: twist of the plies and what the blade answers, zero at the root."""


def flown_twist(solution: Solution, undriven: Solution, psi: float) -> FlownTwist | None:
    """From trims with and without the actuator; None for a rigid blade."""
    driven, alone = solution.disk.elastic_twist, undriven.disk.elastic_twist
    if driven is None or alone is None:
        return None
    r, design = solution.disk.r, solution.design
    at = int(np.abs(np.angle(np.exp(1j * (solution.disk.psi - psi)))).argmin())
    moved = driven[:, at] - alone[:, at] + design.twist(r) - undriven.design.twist(r)
    waves = (design.active_twist, undriven.design.active_twist)
    given = [np.zeros(len(r)) if wave is None else wave(r, np.array([psi]))[:, 0] for wave in waves]
    moved = moved + given[0] - given[1]
    return FlownTwist(r, alone[:, at] + given[1], moved - moved[0])


def lifted_picture(
    inputs: ActuatorInputs,
    installed: InstalledActuator,
    design: Design,
    flown: FlownTwist | None = None,
    *,
    pays: bool = False,
) -> LiftedPicture:
    """The blade with the actuator's part of its twist `TWIST_EXAGGERATION` as large; `design` is without actuator.

    With `flown` blade and overlay have their elastic twist; the overlay is the blade without voltage. `pays`: a
    supposed actuator does, and what is driven lights green.
    """
    rotor = design.rotor
    blade, drawing = lifted.lifted_blade(installed, rotor), DRAWINGS[type(installed.actuator)]

    def still(r: Array) -> Array:
        jig = design.twist(np.maximum(r, rotor.blade.root_cutout))
        return jig if flown is None else jig + np.interp(r, flown.r, flown.still)

    def moved(r: Array) -> Array:
        return inputs.change(installed, r) if flown is None else np.interp(r, flown.r, flown.moved)

    def twist(r: Array) -> Array:
        return still(r) + TWIST_EXAGGERATION * moved(r)

    shares = inputs.drive_shares(installed)
    solids: dict[str, StyledMesh] = {}
    fibres: list[Array] = []
    for part in blade.parts:
        mesh = lifted.part_mesh(blade, part, twist(part.r))
        if part.segment < 0:
            solids[part.role] = StyledMesh(mesh, SURFACES[part.role])
            continue
        light = _PAYING_GLOW if pays else drawing.glow and drawing.glow(shares[part.segment])
        solids[f"drive_{sum(key.startswith('drive') for key in solids)}"] = StyledMesh(
            mesh, drawing.style, light
        )
        if drawing.fibres:
            fibres.append(lifted.fibre_segments(blade, part, twist(part.r), inputs.crossed))
    root = float(twist(np.array([rotor.blade.root_cutout]))[0])
    shank, box = lifted.root_parts(blade, rotor, root)
    solids["shank"] = StyledMesh(shank, SURFACES["shank"])
    if installed.masses.electronics:
        solids["box"] = StyledMesh(box, SURFACES["box"])
    rings = twist(blade.r)
    ends = float(still(np.ones(1))[0]), float(twist(np.ones(1))[0])
    labels, leaders = _labels(inputs, installed, blade, twist, inputs.tip(installed))
    return LiftedPicture(
        solids,
        {
            "edges": lifted.edge_segments(blade, rings),
            "overlay": lifted.edge_segments(blade, still(blade.r))
            if abs(ends[1] - ends[0]) > 1e-3
            else _NO_SEGMENTS,
            "leads": lifted.lead_segments(blade, rings)
            if installed.masses.wiring
            else _NO_SEGMENTS,
            "fibres": np.concatenate(fibres) if fibres else _NO_SEGMENTS,
            "arrow": lifted.arc_segments(blade, *ends),
            "leaders": leaders,
        },
        labels,
        max((abs(share) for share in shares), default=0.0),
    )


_NO_SEGMENTS = np.zeros((0, 2, 3))
_PAYING_GLOW: Glow = (0, 150, 60), 0.6


def drive_colour(actuator: Actuator, share: float) -> Rgb:
    """Colour in which it is drawn at −1…1 of its drive: its own colour where it is not driven."""
    drawing = DRAWINGS[type(actuator)]
    colour = drawing.style.colour
    return mixed_colour(colour, *drawing.glow(share)) if drawing.glow else colour


def mixed_colour(rgb: Rgb, other: Rgb, share: float) -> Rgb:
    red, green, blue = (round(a + (b - a) * share) for a, b in zip(rgb, other, strict=True))
    return red, green, blue


def _labels(
    inputs: ActuatorInputs,
    installed: InstalledActuator,
    blade: lifted.LiftedBlade,
    twist: Callable[[Array], Array],
    tip: float,
) -> tuple[tuple[tuple[str, str, Array], ...], Array]:
    """Words, and the lines that lead to what they name. `tip`: its twist [rad]."""
    labels: list[tuple[str, str, Array]] = []
    lines: list[Array] = []
    behind = _LABEL_OUT * float(blade.rings[:, 0, 0].min())

    def put(text: str, r: float, y: float, z: float, aside: float = 0.0) -> None:
        here = float(twist(np.array([r]))[0])
        named = lifted.twisted_point(blade, r, y, z, here)
        place = lifted.twisted_point(blade, r + aside, behind, z, here)
        labels.append(("lifted", text, place))
        lines.append(np.stack((named, place)))

    named = {name: f"{mass} kg of {name}" for name, mass in mass_parts(installed).items()}
    what = named.get(installed.actuator.noun[1], installed.actuator.name)
    if installed.actuator.on_skin:
        what += f" at {'−45' if inputs.crossed else '45'}°"
    inner, outer = blade.spans[0][0], blade.spans[-1][1]
    # The first two are near each other: their words stand further apart than they are.
    for name, r, y, z, aside in (
        ("electronics", sum(blade.box) / 2.0, 0.0, 0.1, -0.08),
        ("leads", 0.5 * (blade.box[1] + inner), 0.09, 0.02, 0.06),
        ("nose weight", inner + 0.88 * (outer - inner), 0.12, 0.02, 0.0),
    ):
        if name in named:
            put(named[name], r, y, z, aside)
    for k, (low, high) in enumerate(blade.spans):
        drive = inputs.drive_text(installed, k)
        text = f"{what}, {drive}" if not k else f"{k + 1}: {drive}"
        put(text, low + 0.45 * (high - low), 0.05, 0.03)
    if round(math.degrees(tip), 2):
        words = (
            f"{number(math.degrees(tip), 2, sign=True)}° at the tip, drawn × {TWIST_EXAGGERATION:g}"
        )
        end = lifted.twisted_point(blade, 1.0, -0.52, 0.0, float(twist(np.ones(1))[0]))
        labels.append(("tip", words, end - np.array([0.0, 0.0, 0.45])))
    return tuple(labels), np.stack(lines) if lines else _NO_SEGMENTS
