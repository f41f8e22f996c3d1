"""The cut blade: its meshes and labels, its section as a drawing, and its handles in the scene."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from html import escape

import numpy as np
import viser

from explorer.hosting.bridge import Bridge
from explorer.model.units import number
from explorer.picture.solids import Mesh
from explorer.tabs.actuator import cut_blade as actuator_cut
from explorer.tabs.actuator.actuator_inputs import ActuatorInputs
from explorer.theme import colours
from explorer.theme.colours import css
from rotor.actuator.catalogue import PiezoPly, TorqueTube
from rotor.actuator.installation import InstalledActuator
from rotor.actuator.pictures import Part, section_picture
from rotor.arrays import Array
from rotor.design.design import Design
from rotor.trim.solution import Solution

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
    given = [np.zeros(len(r)) if one is None else one(r, np.array([psi]))[:, 0]
             for one in (design.active_twist, undriven.design.active_twist)]  # fmt: skip
    moved = moved + given[0] - given[1]
    return FlownTwist(r, alone[:, at] + given[1], moved - moved[0])


def cut_picture(
    inputs: ActuatorInputs, installed: InstalledActuator, design: Design, psi: float, flown: FlownTwist | None = None
) -> CutPicture:
    """The blade at azimuth `psi` [rad], the actuator's part of its twist magnified; `design` is without actuator.

    With `flown` solid and ghost have their elastic twist; the ghost is the blade without voltage.
    """
    rotor = design.rotor
    cut = actuator_cut.cut_blade(installed, rotor)

    def still(r: Array) -> Array:
        jig = design.twist(np.maximum(r, rotor.blade.root_cutout))
        return jig if flown is None else jig + np.interp(r, flown.r, flown.still)

    def moved(r: Array) -> Array:
        if flown is not None:
            return np.interp(r, flown.r, flown.moved)
        return inputs.change(installed, r) + inputs.harmonic_twist(installed, psi, r)

    def twist(r: Array) -> Array:
        return still(r) + inputs.magnified * moved(r)

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
        labels=_labels(inputs, installed, cut, twist, float(moved(np.ones(1))[0])),
    )


def voltage_shares(inputs: ActuatorInputs, installed: InstalledActuator, psi: float) -> tuple[float, ...]:
    """Of each segment, −1…1 of its positive or negative side, with the harmonic at this azimuth."""
    steady = inputs.drive_shares(installed)
    if not inputs.per_rev or not isinstance(installed.actuator, PiezoPly):
        return steady
    wave = 0.01 * inputs.amplitude * math.cos(inputs.per_rev * psi - math.radians(inputs.phase))
    low, high = installed.actuator.voltage_range
    shares = []
    for volts in inputs.volts(installed):
        now = volts + 0.5 * installed.actuator.voltage_swing * (-wave if inputs.crossed else wave)
        shares.append(now / high if now >= 0.0 else now / -low if low < 0.0 else -1.0)
    return tuple(min(max(share, -1.0), 1.0) for share in shares)


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
    inputs: ActuatorInputs,
    installed: InstalledActuator,
    cut: actuator_cut.Cut,
    twist: Callable[[Array], Array],
    moved: float,
) -> tuple[tuple[str, Array], ...]:
    def at(r: float, y: float, z: float) -> Array:
        return actuator_cut.anchor(cut, r, y, z, float(twist(np.array([r]))[0]))

    labels = [("drive electronics", at(0.5 * (cut.box[0] + 0.12), -0.01, 0.2))]
    window = cut.windows[0]
    tip = math.degrees(moved)
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


_WIDTH, _HEIGHT = 312.0, 92.0
_MIDDLE = 46.0
_PLY = 3.4
"""Plies are drawn this thick [px]; to scale they would be half a pixel."""
_GAP = 0.2
_FILLS = {"spar": "#5c6b80", "skin": "#9aa3ad", "web": "#3f4b5c", "tube": "#b7791f"}


@lru_cache(maxsize=32)
def section_svg(installed: InstalledActuator, shares: tuple[float, ...]) -> str:
    """The cut through the blade at its middle segment; `shares` −1…1 colour the plies as they do on the blade."""
    middle = len(shares) // 2
    share = shares[middle]
    picture = section_picture(installed, exaggerate=1.6)
    scale = (_WIDTH - 12.0) / picture.chord
    marks: list[str] = []
    for part in picture.parts:
        if part.role == "outline":
            marks.append(_polygon(part, scale, 'fill="rgba(128,128,128,.14)" stroke="currentColor" stroke-width=".7"'))
        elif part.role == "ply":
            marks.append(_ply(part, scale, share))
        elif part.role == "tube":
            fill = f'fill="{css(share_colour(share))}" stroke="currentColor" stroke-width=".6"'
            marks.append(_polygon(part, scale, fill))
        else:
            marks.append(_polygon(part, scale, f'fill="{_FILLS[part.role]}"'))
    return (
        f'<div class="rx" data-explorer="section"><svg viewBox="0 0 {_WIDTH:g} {_HEIGHT:g}" width="100%" '
        f'role="img" aria-label="Section of the blade with its plies">{"".join(marks)}{_scale(installed)}</svg>'
        f'<div class="rx-dim rx-small">{escape(_caption(installed, middle + 1))}</div></div>'
    )


def _ply(part: Part, scale: float, share: float) -> str:
    """A band outside the contour along the ply's own line."""
    line = part.points[: len(part.points) // 2] * scale
    upper = "upper" in part.label.rsplit(",", 1)[-1]
    offset = (_GAP + 0.5 * _PLY) * (1.0 if upper else -1.0)
    points = " ".join(f"{6.0 + x:.1f},{_MIDDLE - y - offset:.1f}" for x, y in line)
    red, green, blue = share_colour(share)
    return (
        f'<polyline class="rx-ply" points="{points}" fill="none" stroke="currentColor" stroke-width="{_PLY + 1.2:g}"/>'
        f'<polyline points="{points}" fill="none" stroke="rgb({red},{green},{blue})" stroke-width="{_PLY:g}"/>'
    )


def _polygon(part: Part, scale: float, style: str) -> str:
    points = " ".join(f"{6.0 + scale * y:.1f},{_MIDDLE - scale * z:.1f}" for y, z in part.points)
    return f'<polygon points="{points}" {style}/>'


def _scale(installed: InstalledActuator) -> str:
    front, rear = installed.placement.chord
    ends = (0.0, front, rear, 1.0) if isinstance(installed.actuator, PiezoPly) else (0.0, 1.0)
    marks = []
    for end in ends:
        x = 6.0 + (_WIDTH - 12.0) * end
        marks.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="76" y2="80" stroke="currentColor" stroke-width=".8"/>')
        place = "start" if end < 0.03 else "end" if end > 0.97 else "middle"
        if not (0.0 < end < 0.08 or 0.9 < end < 1.0):
            look = f'font-size="12.5" fill="currentColor" text-anchor="{place}"'
            marks.append(f'<text x="{x:.1f}" y="90" {look}>{end:g} c</text>')
    marks.append(f'<line x1="6" x2="{_WIDTH - 6.0:g}" y1="78" y2="78" stroke="currentColor" stroke-width=".5"/>')
    return "".join(marks)


def _caption(installed: InstalledActuator, segment: int) -> str:
    labels = [part.label for part in section_picture(installed).parts]
    walls = next((label.split(",")[0] for label in labels if "spar" in label or "box" in label), "")
    plies = next((label.rsplit(",", 1)[0] for label in labels if "±" in label), installed.actuator.name)
    front, rear = installed.placement.chord
    where = f" per side, {100 * front:.0f}–{100 * rear:.0f} % chord" if isinstance(installed.actuator, PiezoPly) else ""
    shown = f" Segment {segment}." if len(installed.shapes) > 1 else ""
    return f"SC1095 with {walls} and web; {plies}{where}.{shown} Wall and ply thickness exaggerated."


_NOTHING = np.zeros((1, 2, 3), dtype=np.float32)


class CutScene:
    """Under its own frame, which is seen or not."""

    def __init__(self, api: viser.SceneApi, bridge: Bridge) -> None:
        """`bridge`: of the frame, which draws the labels."""
        self._api, self._bridge = api, bridge
        self._frame = api.add_frame("/cut", show_axes=False, visible=False)
        self._solids: list[viser.MeshHandle] = []
        self._ghost = self._line("ghost", GHOST, 1.6)
        self._leads = self._line("leads", LEAD, 2.4)

    def show(self, picture: CutPicture) -> None:
        """Assign one frame; call it inside `client.atomic()`."""
        self._frame.visible = True
        for k, (mesh, colour) in enumerate(picture.solids):
            vertices = mesh.vertices.astype(np.float32)
            if k == len(self._solids):
                self._solids.append(
                    self._api.add_mesh_simple(
                        f"/cut/part_{k}", vertices, mesh.faces, color=colour, side="double",
                        cast_shadow=False, receive_shadow=False,
                    )
                )  # fmt: skip
                continue
            handle = self._solids[k]
            if not np.array_equal(handle.faces, mesh.faces):
                # Never faces without their vertices: of two sizes, the page must not draw a mixture.
                handle.visible = False
                handle.vertices, handle.faces = vertices, mesh.faces
            handle.vertices, handle.color, handle.visible = vertices, colour, True
        for handle in self._solids[len(picture.solids) :]:
            handle.visible = False
        for handle, segments in ((self._ghost, picture.ghost), (self._leads, picture.leads)):
            handle.visible = len(segments) > 0
            if len(segments):
                handle.points = segments.astype(np.float32)
        labels = [{"text": text, "node": "/cut", "at": np.round(at, 3).tolist()} for text, at in picture.labels]
        self._bridge.set(cut_labels=labels)

    def hide(self) -> None:
        self._frame.visible = False
        self._bridge.set(cut_labels=[])

    def _line(self, name: str, colour: tuple[int, int, int], pixels: float) -> viser.LineSegmentsHandle:
        return self._api.add_line_segments(
            f"/cut/{name}", _NOTHING, colour, thickness=pixels, thickness_units="screen", visible=False
        )
