"""Make `assets/airframe.glb`, the helicopters below the rotor: `python -m tests.tools.airframe`.

Metres, hub at the origin, level attitude: x aft, y starboard, z up. Drawn quietly: it says where nose and tail are.
UH-60A (Jane's All the World's Aircraft): fuselage 15.26 m long and 2.36 m wide, hub 3.76 m above ground, stabilator
span 4.38 m, tail rotor diameter 3.35 m canted 20°, wheel track 2.705 m, wheel base 8.83 m. A generic helicopter, as
large, with wheels or skids, stands for every other one. Nodes are named by aircraft and colour.
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import cast

import numpy as np
import trimesh
from numpy.typing import ArrayLike
from scipy.interpolate import PchipInterpolator

from explorer.picture.blade_mesh import Mesh, joined, loft, tube
from rotor.arrays import Array

FILE = Path(__file__).parents[2] / "assets" / "airframe.glb"
SOURCE = "UH-60A: dimensions from Jane's All the World's Aircraft. Generic: our own. Made by tests/tools/airframe.py."
"""In the file itself."""
_GLASS_OUT = 0.012
"""How far window panes stand off the hull [m]."""
_Z_UP = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]])
"""From z up, as here, to y up, as in glTF; of the nodes, so that the vertices stay as they are."""


def surface(root: ArrayLike, tip: ArrayLike, chords: tuple[float, float], thickness: float, upright: bool) -> Mesh:
    """A tapered fin or stabiliser between two leading-edge points, chords along x.

    `thickness`: as a fraction of the chord, along y for an `upright` surface and along z otherwise.
    """
    angle = 2.0 * math.pi * np.arange(20) / 20
    along, half = 0.5 * (1.0 - np.cos(angle)), 0.5 * thickness * np.sin(angle) * (1.2 + 0.5 * np.cos(angle))
    zero = np.zeros_like(along)
    profile = np.stack((along, half, zero) if upright else (along, zero, half), axis=1)
    ends = np.asarray(root, dtype=np.float64), np.asarray(tip, dtype=np.float64)
    stations = np.linspace(0.0, 1.0, 5)
    return loft([(1 - t) * ends[0] + t * ends[1] + ((1 - t) * chords[0] + t * chords[1]) * profile for t in stations])


class Hull:
    """A body along x whose sections are superellipses, smooth between the given stations.

    `rows`: x, half width, bottom, top and exponent of each station; an exponent of 2 is an ellipse, more is boxier.
    `offset`: y of the middle.
    """

    def __init__(self, rows: Sequence[Sequence[float]], offset: float = 0.0) -> None:
        table = np.asarray(rows, dtype=np.float64)
        self._x, self._offset = table[:, 0], offset
        self._shape = PchipInterpolator(self._x, table[:, 1:])

    def section(self, x: ArrayLike) -> tuple[Array, Array, Array, Array]:
        """Half width, bottom, top and exponent at `x`."""
        width, bottom, top, power = np.moveaxis(self._shape(np.asarray(x, dtype=np.float64)), -1, 0)
        return width, bottom, top, power

    def mesh(self, points: int = 44, between: int = 4) -> Mesh:
        """The closed body, `points` round a section and `between` sections a station."""
        x = np.unique(np.concatenate([np.linspace(a, b, between + 1) for a, b in pairwise(self._x)]))
        angle = 2.0 * math.pi * np.arange(points) / points
        return loft(self._points(x[:, None], angle[None, :], 0.0))

    def patch(self, x: Array, angle: Array, out: float) -> Mesh:
        """An open patch over a grid of `x` and section `angle` (0 at starboard, 90° on top), `out` off the surface."""
        points = self._points(x, angle, out)
        rows, columns = x.shape
        a = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
        below = a + columns
        faces = np.concatenate((np.stack((a, below, a + 1), 1), np.stack((a + 1, below, below + 1), 1)))
        mesh = Mesh(points.reshape(-1, 3), faces.astype(np.uint32))
        middle = np.array([float(x.mean()), self._offset, float(np.mean(self.section(x.mean())[1:3]))])
        corners = mesh.vertices[mesh.faces]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).sum(axis=0)
        outward = float(normal @ (mesh.vertices.mean(axis=0) - middle)) > 0.0
        return mesh if outward else Mesh(mesh.vertices, mesh.faces[:, ::-1])

    def side_angle(self, x: Array, height: Array) -> Array:
        """The section angle at which the starboard side has this height z."""
        _, bottom, top, power = self.section(x)
        sine = np.clip((2.0 * height - top - bottom) / (top - bottom), -0.999, 0.999)
        # z = middle + half · sign(s) |s|^(2/n), turned round.
        return np.asarray(np.arcsin(np.sign(sine) * np.abs(sine) ** (power / 2.0)), dtype=np.float64)

    def _points(self, x: Array, angle: Array, out: float) -> Array:
        width, bottom, top, power = self.section(x)
        cos, sin = np.cos(angle), np.sin(angle)
        y = self._offset + (width + out) * np.sign(cos) * np.abs(cos) ** (2.0 / power)
        z = 0.5 * (top + bottom) + (0.5 * (top - bottom) + out) * np.sign(sin) * np.abs(sin) ** (2.0 / power)
        return np.stack((np.broadcast_to(x, y.shape), y, z), axis=-1)


GROUND = {"uh60a": -3.76, "generic": -3.95}
"""Height of the ground below the hub [m]."""


def _black_hawk() -> dict[str, Mesh]:
    hull = Hull(
        # x, half width, bottom, top, exponent
        [
            (-4.60, 0.04, -2.66, -2.56, 2.0), (-4.46, 0.36, -2.90, -2.28, 2.1), (-4.10, 0.64, -3.08, -2.00, 2.3),
            (-3.55, 0.88, -3.19, -1.68, 2.6), (-2.95, 1.04, -3.24, -1.34, 2.9), (-2.30, 1.13, -3.26, -1.17, 3.3),
            (-1.15, 1.18, -3.26, -1.12, 3.7), (1.05, 1.18, -3.26, -1.12, 3.7), (2.10, 1.11, -3.21, -1.14, 3.2),
            (2.90, 0.91, -3.03, -1.20, 2.8), (3.60, 0.67, -2.80, -1.28, 2.5), (4.50, 0.52, -2.60, -1.36, 2.4),
            (6.40, 0.40, -2.35, -1.50, 2.3), (8.00, 0.31, -2.17, -1.58, 2.2), (9.05, 0.19, -2.03, -1.63, 2.1),
            (9.62, 0.05, -1.91, -1.74, 2.0),
        ]
    )  # fmt: skip
    deck = Hull(
        [
            (-2.50, 0.10, -1.36, -1.17, 2.2), (-2.05, 0.46, -1.42, -0.98, 2.4), (-1.20, 0.61, -1.42, -0.75, 2.6),
            (-0.30, 0.59, -1.42, -0.60, 2.6), (0.60, 0.55, -1.42, -0.61, 2.6), (1.70, 0.49, -1.42, -0.81, 2.6),
            (2.90, 0.35, -1.50, -1.06, 2.4), (4.20, 0.17, -1.60, -1.31, 2.2), (5.00, 0.05, -1.62, -1.43, 2.0),
        ]
    )  # fmt: skip
    engine = [
        (-0.72, 0.22, -1.14, -0.70, 2.2), (-0.35, 0.33, -1.24, -0.60, 2.3), (0.85, 0.34, -1.25, -0.60, 2.3),
        (1.70, 0.31, -1.22, -0.66, 2.2), (2.50, 0.23, -1.15, -0.75, 2.1),
    ]  # fmt: skip
    tail_hub = np.array([9.95, 0.50, 0.31])
    body = [hull.mesh(36, 3), deck.mesh(26, 3), *(Hull(engine, 0.88 * side).mesh(20) for side in (-1, 1))]
    body.append(surface((7.84, 0.0, -1.95), (9.72, 0.0, 0.34), (1.78, 0.94), 0.13, upright=True))
    body += [surface((8.38, 0.0, -1.86), (8.52, 2.19 * side, -1.86), (1.02, 0.74), 0.12, False) for side in (-1, 1)]
    body.append(tube(tail_hub - [0.0, 0.46, 0.14], tail_hub - [0.0, 0.10, 0.04], 0.20, 0.13))
    wheel = np.array([-1.62, 1.3525, -3.43])
    dark = _tail_rotor(tail_hub, 1.675, 4, math.radians(20.0))
    for side in (-1.0, 1.0):
        place = wheel * [1.0, side, 1.0]
        body.append(tube((-1.32, 0.95 * side, -2.95), place + np.array([0.0, 0.0, 0.08]), 0.085, 0.06))
        body.append(tube((-0.55, 1.05 * side, -2.65), place + np.array([0.04, 0.0, 0.12]), 0.055))
        dark.append(_wheel(place, 0.33, 0.22))
    body.append(tube((6.75, 0.0, -2.20), (7.15, 0.0, -3.30), 0.07, 0.05))
    dark.append(_wheel(np.array([7.21, 0.0, -3.54]), 0.22, 0.16))
    door, cockpit = (-2.28, -1.50), (-2.30, -1.46)
    panes = (((-0.92, 0.04), door, 0.0), ((0.20, 1.16), door, 0.0), ((-2.66, -1.90), cockpit, 0.12))
    glass = _glass(hull, panes, (-3.94, -2.84), 0.42, 0.28)
    return {"uh60a-body": joined(body), "uh60a-glass": glass, "uh60a-dark": joined(dark)}


def _glass(
    hull: Hull,
    panes: Sequence[tuple[tuple[float, float], tuple[float, float], float]],
    front: tuple[float, float],
    lowest: float,
    slant: float,
) -> Mesh:
    """Side panes, each from x to x, from height to height, slanted aft [m], and the windscreen, on each side."""
    found = []
    for port in (False, True):
        for along, height, aft in panes:
            x, z = np.meshgrid(np.linspace(*along, 9), np.linspace(*height, 8), indexing="ij")
            x = x + aft * (z - height[0]) / (height[1] - height[0])
            angle = hull.side_angle(x, z)
            found.append(hull.patch(x, math.pi - angle if port else angle, _GLASS_OUT))
        x, angle = np.meshgrid(np.linspace(*front, 14), np.linspace(lowest, 1.50, 12), indexing="ij")
        x = x + slant * (1.50 - angle)
        found.append(hull.patch(x, math.pi - angle if port else angle, _GLASS_OUT))
    return joined(found)


def _generic() -> dict[str, Mesh]:
    """A cabin, a boom, a fin and a stabiliser; wheels and four tail blades, or skids and two."""
    hull = Hull(
        [
            (-4.10, 0.05, -2.70, -2.58, 2.0), (-3.90, 0.44, -3.00, -2.20, 2.1), (-3.35, 0.82, -3.22, -1.72, 2.3),
            (-2.50, 1.08, -3.32, -1.32, 2.5), (-1.30, 1.20, -3.34, -1.14, 2.7), (0.60, 1.18, -3.32, -1.10, 2.7),
            (1.80, 1.00, -3.16, -1.14, 2.6), (2.90, 0.66, -2.78, -1.26, 2.4), (4.00, 0.40, -2.36, -1.42, 2.2),
            (6.50, 0.29, -2.10, -1.52, 2.1), (9.30, 0.17, -1.88, -1.56, 2.0), (9.80, 0.04, -1.76, -1.66, 2.0),
        ]
    )  # fmt: skip
    fairing = Hull(
        [
            (-1.70, 0.08, -1.30, -1.14, 2.2), (-1.10, 0.50, -1.36, -0.86, 2.4), (0.00, 0.58, -1.36, -0.66, 2.5),
            (1.20, 0.48, -1.36, -0.82, 2.4), (2.60, 0.10, -1.46, -1.20, 2.2),
        ]
    )  # fmt: skip
    tail_hub = np.array([9.70, 0.42, -0.62])
    body = [hull.mesh(36, 3), fairing.mesh(24)]
    body.append(surface((8.40, 0.0, -1.80), (9.62, 0.0, -0.10), (1.35, 0.72), 0.13, upright=True))
    body += [surface((7.40, 0.0, -1.72), (7.55, 1.55 * side, -1.72), (0.80, 0.58), 0.12, False) for side in (-1, 1)]
    body.append(tube(tail_hub - [0.0, 0.40, 0.0], tail_hub - [0.0, 0.08, 0.0], 0.16, 0.11))
    ground = GROUND["generic"]
    legs, wheels = [], _tail_rotor(tail_hub, 1.50, 4, 0.0)
    skids = _tail_rotor(tail_hub, 1.50, 2, 0.0)
    for side in (-1.0, 1.0):
        place = np.array([-1.30, 1.50 * side, ground + 0.34])
        legs.append(tube((-1.10, 0.95 * side, -3.05), place, 0.08, 0.06))
        wheels.append(_wheel(place, 0.34, 0.22))
        skids.append(tube((-2.70, 1.25 * side, ground), (1.60, 1.25 * side, ground), 0.06))
        skids.append(tube((-2.70, 1.25 * side, ground), (-3.10, 1.25 * side, ground + 0.22), 0.06, 0.05))
        skids += [tube((x, 0.75 * side, -3.15), (x, 1.25 * side, ground), 0.045) for x in (-1.60, 0.70)]
    legs.append(tube((6.60, 0.0, -2.00), (6.90, 0.0, ground + 0.24), 0.06, 0.05))
    wheels.append(_wheel(np.array([6.95, 0.0, ground + 0.22]), 0.22, 0.16))
    panes = (((-1.10, 0.20), (-2.50, -1.62), 0.0), ((-2.35, -1.35), (-2.50, -1.62), 0.10))
    return {
        "generic-body": joined(body),
        "generic-glass": _glass(hull, panes, (-3.55, -2.55), 0.10, 0.16),
        "generic-legs": joined(legs),
        "generic-wheels": joined(wheels),
        "generic-skids": joined(skids),
    }


def _wheel(centre: Array, radius: float, width: float) -> Mesh:
    half = np.array([0.0, 0.5 * width, 0.0])
    return tube(centre - half, centre + half, radius, segments=26)


def _tail_rotor(hub: Array, radius: float, blades: int, cant: float) -> list[Mesh]:
    """Flat blades about an axis to starboard, leaning up by `cant` [rad]."""
    axis = np.array([0.0, math.cos(cant), math.sin(cant)])
    aft = np.array([1.0, 0.0, 0.0])
    up = np.cross(axis, aft)
    chord, thickness = 0.15 * radius, 0.015 * radius
    corners = np.array([[-0.25, -0.5], [0.75, -0.5], [0.75, 0.5], [-0.25, 0.5]]) * [chord, thickness]
    parts = [tube(hub - 0.10 * axis, hub + 0.12 * axis, 0.10 * radius, segments=20)]
    for k in range(blades):
        angle = math.radians(24.0) + 2.0 * math.pi * k / blades
        out = math.cos(angle) * aft + math.sin(angle) * up
        section = corners[:, :1] * np.cross(axis, out) + corners[:, 1:] * axis
        parts.append(loft([hub + reach * out + section for reach in (0.16 * radius, radius)]))
    return parts


def parts() -> dict[str, Mesh]:
    """By the name of the node: what there is of each aircraft in one colour."""
    return {**_black_hawk(), **_generic()}


def glb() -> bytes:
    """The file."""
    scene = trimesh.Scene()
    scene.metadata = {"source": SOURCE, "ground_m": GROUND}
    for name, mesh in parts().items():
        solid = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
        scene.add_geometry(solid, node_name=name, geom_name=name, transform=_Z_UP)
    return cast(bytes, scene.export(file_type="glb", include_normals=False))


if __name__ == "__main__":
    FILE.write_bytes(glb())
    print(f"{FILE}: {FILE.stat().st_size / 1e3:.0f} kB")
