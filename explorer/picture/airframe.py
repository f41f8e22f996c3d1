"""The helicopter below the rotor, from `assets/airframe.glb`: a UH-60A, a generic one for every other rotor.

Metres, hub at the origin, level attitude: x aft, y starboard, z up. `tests/tools/airframe.py` makes the file from
published dimensions.
"""

import math
from dataclasses import dataclass
from functools import cache, lru_cache

import numpy as np
import trimesh

from explorer.picture.rotor_head import size
from explorer.picture.solids import Mesh, joined
from rotor.assets import asset_path
from rotor.design.blade import Rotor

SHAFT_FORWARD = math.radians(3.0)
"""How far the shaft leans forward in the airframe [rad]: the airframe pitches by the shaft tilt less this. UH-60A."""
_LARGE = 6.0
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


@lru_cache(maxsize=4)
def airframe(rotor: Rotor) -> Airframe:
    """The airframe that goes with a rotor, as large as the rotor asks for."""
    parts, ground = _shipped()
    scale = size(rotor.radius)
    if rotor.name == "UH-60A":
        name, body, dark = "uh60a", parts["uh60a-body"], parts["uh60a-dark"]
    elif rotor.radius > _LARGE:
        name, body, dark = "generic", joined((parts["generic-body"], parts["generic-legs"])), parts["generic-wheels"]
    else:
        name, body, dark = "generic", parts["generic-body"], parts["generic-skids"]
    glass = parts[f"{name}-glass"]
    return Airframe(body.scaled(scale), glass.scaled(scale), dark.scaled(scale), scale * ground[name])


@cache
def _shipped() -> tuple[dict[str, Mesh], dict[str, float]]:
    """The meshes of the file by name, and the heights of the ground."""
    scene = trimesh.load_scene(asset_path("airframe.glb"), process=False)
    meshes = {
        name: Mesh(np.asarray(one.vertices, dtype=float), np.asarray(one.faces, dtype=np.uint32))
        for name, one in scene.geometry.items()
        if isinstance(one, trimesh.Trimesh)
    }
    return meshes, dict(scene.metadata["ground_m"])
