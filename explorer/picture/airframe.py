"""The helicopter without blades: hub, cuffs, swashplate, pitch links and mast, and the airframe below them.

The airframe is read from `assets/airframe.glb`, a UH-60A by its published dimensions or a generic one, which gets the
length and tail rotor of its helicopter as far as they are known. Metres, hub at the origin, level attitude: x aft, y
starboard, z up.
"""

import math
from dataclasses import dataclass
from functools import cache, lru_cache

import numpy as np
import trimesh

from explorer.picture.blade_mesh import Mesh, joined_meshes, revolved, tube
from rotor import Rotor
from rotor.design.aircraft import TailRotor
from rotor.support.assets import asset_path, toml_asset

_DRAWN_FOR = 8.1788
"""Radius [m] that the fixed measures are given for; on other rotors they grow and shrink with it."""
_LEAST_HINGE = 0.30
"""A teetering rotor's hub still has arms this long [m, at that radius]."""
_ABSORBERS = ("UH-60A",)
"""Rotors with a bifilar vibration absorber above the hub."""
_SWASHPLATE = [
    [0.0, -0.63],
    [0.38, -0.63],
    [0.40, -0.58],
    [0.38, -0.52],
    [0.20, -0.49],
    [0.0, -0.49],
]


def size(radius: float) -> float:
    """How large a rotor of this radius [m] is beside the one that fixed measures are given for."""
    return radius / _DRAWN_FOR


@lru_cache(maxsize=4)
def rotor_head(rotor: Rotor) -> Mesh:
    """Everything that turns with the blades; its first arm points along x, as a blade at ψ = 0 does."""
    scale = size(rotor.radius)
    hinge = max(rotor.blade.flap_hinge * rotor.radius / scale, _LEAST_HINGE)
    parts = [_hub(hinge), revolved(_SWASHPLATE, 36)]
    for k in range(rotor.blades):
        parts += _arm(2.0 * math.pi * k / rotor.blades, hinge)
    if rotor.name in _ABSORBERS:
        parts += _absorber(rotor.blades)
    return joined_meshes(parts).scaled(scale)


def mast(radius: float) -> Mesh:
    """The shaft below the hub of a rotor of this radius [m]."""
    return revolved(
        [[0.0, -1.3], [0.21, -1.3], [0.17, -0.75], [0.13, -0.09], [0.0, -0.09]], 28
    ).scaled(size(radius))


def _hub(hinge: float) -> Mesh:
    """A plate with a raised cap."""
    rim = 0.82 * hinge
    outline = [
        [0.0, -0.12],
        [rim, -0.12],
        [1.02 * rim, -0.05],
        [1.02 * rim, 0.05],
        [0.8 * rim, 0.10],
        [0.17, 0.14],
    ]
    return revolved([*outline, [0.15, 0.24], [0.0, 0.24]])


def _arm(psi: float, hinge: float) -> list[Mesh]:
    """One blade's arm, hinge pin, cuff and pitch link; the link stands ahead of the blade."""
    out = np.array([math.cos(psi), math.sin(psi), 0.0])
    ahead = np.array([-out[1], out[0], 0.0])
    below = np.array([0.0, 0.0, -1.0])
    horn = (hinge + 0.16) * out + 0.25 * ahead
    return [
        tube(0.4 * hinge * out, 1.06 * hinge * out, 0.125, 0.105),
        tube(hinge * out - 0.14 * ahead, hinge * out + 0.14 * ahead, 0.085),
        tube(1.02 * hinge * out, (hinge + 0.30) * out, 0.115, 0.10),
        tube((hinge + 0.16) * out, horn, 0.045),
        tube(0.36 * out + 0.16 * ahead + 0.55 * below, horn, 0.026),
    ]


def _absorber(blades: int) -> list[Mesh]:
    parts, rise = [], np.array([0.0, 0.0, 0.055])
    for k in range(blades):
        psi = 2.0 * math.pi * (k + 0.5) / blades
        out = np.array([math.cos(psi), math.sin(psi), 0.0])
        start, end = (
            0.10 * out + np.array([0.0, 0.0, 0.21]),
            0.47 * out + np.array([0.0, 0.0, 0.21]),
        )
        parts.append(tube(start, end, 0.05, 0.035))
        parts.append(tube(end - rise, end + rise, 0.085))
    return parts


SHAFT_FORWARD = math.radians(3.0)
"""How far the shaft leans forward in the airframe [rad]: the airframe pitches by the shaft tilt less this. UH-60A."""
_WHEELS_ABOVE_M = 6.0
"""Rotor radius [m] above which a generic airframe has wheels instead of skids."""


@dataclass(frozen=True, eq=False)
class Airframe:
    """Three meshes, one for each colour."""

    body: Mesh
    glass: Mesh
    """Open patches just off the hull."""
    dark: Mesh
    """Wheels or skids, and the tail rotor."""
    ground: float
    """Height of the ground below the hub [m], negative."""


_NOSE, _CABIN, _TAIL, _END = -4.1, (-1.7, 3.0), 9.7, 10.34
"""Of the generic airframe along x: nose, cabin from the shaft on that keeps its shape, tail rotor, end of the fin."""


@lru_cache(maxsize=4)
def airframe(rotor: Rotor, tail: TailRotor | None = None) -> Airframe:
    """The airframe that goes with a rotor, as large as the rotor asks for; `tail`: its tail rotor, if open."""
    parts, ground = _shipped()
    scale = size(rotor.radius)
    if rotor.name == "UH-60A":
        body, glass, black = (
            parts[f"uh60a-{part}"].scaled(scale) for part in ("body", "glass", "dark")
        )
        return Airframe(body, glass, black, scale * ground["uh60a"])
    wheels = rotor.radius > _WHEELS_ABOVE_M
    body = (
        joined_meshes((parts["generic-body"], parts["generic-legs"]))
        if wheels
        else parts["generic-body"]
    )
    *gear, blade = _open_tail_rotor(parts["generic-wheels" if wheels else "generic-skids"])
    own = toml_asset("airframes.toml").get(rotor.name, {})
    end = own.get("tail_m", tail.arm + scale * (_END - _TAIL) if tail else scale * _END) / scale
    nose = end - own["length_m"] / scale if own else _NOSE

    def fitted(mesh: Mesh) -> Mesh:
        x, y, z = mesh.vertices.T
        x = np.interp(x, (_NOSE, *_CABIN, _TAIL, _END), (nose, *_CABIN, end - (_END - _TAIL), end))
        return Mesh(np.column_stack([x, y, z]), mesh.faces).scaled(scale)

    dark = [fitted(part) for part in gear]
    if tail is not None:
        dark += _tail_rotor(blade, tail, scale)
    return Airframe(
        fitted(body), fitted(parts["generic-glass"]), joined_meshes(dark), scale * ground["generic"]
    )


def _open_tail_rotor(dark: Mesh) -> list[Mesh]:
    """Gear, part by part, and last one blade of the tail rotor; its hub and other blades are left out."""
    parts = trimesh.Trimesh(dark.vertices, dark.faces, process=False).split(only_watertight=False)
    meshes = [
        Mesh(np.asarray(part.vertices, dtype=float), np.asarray(part.faces, dtype=np.uint32))
        for part in parts
    ]
    turning = [
        mesh
        for mesh in meshes
        if mesh.vertices[:, 0].min() > 0.8 * _TAIL and mesh.vertices[:, 1].min() > 0.3
    ]
    blade = max(turning, key=lambda mesh: mesh.vertices[:, 0].max())
    return [*(mesh for mesh in meshes if mesh not in turning), blade]


def _tail_rotor(blade: Mesh, tail: TailRotor, scale: float) -> list[Mesh]:
    """Hub and blades at their published place, on starboard. `blade`: of the generic airframe."""
    hub = np.array([_TAIL, 0.43, -0.62])
    out = blade.vertices - hub
    to = np.array([tail.arm, scale * hub[1], scale * hub[2]])
    factor = tail.radius / np.linalg.norm(out, axis=1).max()
    blades = list[Mesh]()
    for k in range(tail.blades):
        turn = trimesh.transformations.rotation_matrix(
            2.0 * math.pi * k / tail.blades, [0.0, 1.0, 0.0]
        )[:3, :3]
        blades.append(Mesh(to + factor * out @ turn.T, blade.faces))
    across = 0.11 * tail.radius * np.array([0.0, 1.0, 0.0])
    return [tube(to - across, to + across, 0.1 * tail.radius), *blades]


@cache
def _shipped() -> tuple[dict[str, Mesh], dict[str, float]]:
    """The meshes of the file by name, and the heights of the ground."""
    scene = trimesh.load_scene(asset_path("airframe.glb"), process=False)
    meshes = {
        name: Mesh(np.asarray(mesh.vertices, dtype=float), np.asarray(mesh.faces, dtype=np.uint32))
        for name, mesh in scene.geometry.items()
        if isinstance(mesh, trimesh.Trimesh)
    }
    return meshes, dict(scene.metadata["ground_m"])
