"""Trims as records for files without a server: what `explorer/web/still_rotor.js` draws blades and disk from."""

import base64
import io
from typing import Any

import numpy as np
from PIL import Image

from explorer.model.inputs import ViewState
from explorer.picture.blade_mesh import BladeShape, blade_vertices
from explorer.picture.picture import make_picture
from explorer.picture.poses import flown_twist, follows_azimuth
from explorer.scene.controller import motion_of
from explorer.scene.scene import ROTOR
from rotor import Solution, parse_twist
from rotor.arrays import Array

HARMONICS = 4
"""Of the elastic twist in the trim."""
UNTWISTED = parse_twist("linear:0")
PIXELS = 400
"""Along each edge of a picture of the disk."""


def flown_pitch(solution: Solution, shape: BladeShape, exaggeration: float) -> Array:
    """Drawn pitch of each ring in harmonics of azimuth 1, cos ψ, sin ψ, cos 2ψ, … [rad], (harmonics, rings).

    The mean alone where the twist does not change around the disk.
    """
    waves = solution.design.pitch_waves
    highest = max(HARMONICS, *(one.per_rev for wave in waves for one in wave.harmonics)) if waves else HARMONICS
    count = max(24, 4 * highest) if follows_azimuth(solution) else 1
    psi = 2.0 * np.pi * np.arange(count) / count
    pitch = np.array([shape.pitch(flown_twist(solution, float(at)), exaggeration) for at in psi])
    basis = [np.ones_like(psi)]
    for n in range(1, highest + 1) if count > 1 else ():
        basis += [2.0 * np.cos(n * psi), 2.0 * np.sin(n * psi)]
    return np.array(basis) @ pitch / count


def shape_record(shape: BladeShape) -> dict[str, Any]:
    """What `still_rotor.js` shapes blades from."""
    return {
        "shape": _packed(blade_vertices(shape, UNTWISTED)),
        "rings": list(shape.rings.shape[:2]),
        "faces": _packed(np.asarray(shape.faces)),
    }


def point_record(
    solution: Solution, shape: BladeShape, view: ViewState, colour_range: tuple[float, float], root: str = ROTOR
) -> dict[str, Any]:
    """One trim: motion and pitch of the blades, poses, and the picture of the disk as WebP."""
    picture = make_picture(solution, view, colour_range, pixels=PIXELS)
    image = io.BytesIO()
    Image.open(io.BytesIO(picture.png)).convert("RGBA").save(image, "WEBP", quality=80)
    return {
        "motion": motion_of(solution, root),
        "poses": [
            [pose.wxyz.tolist(), pose.position.tolist()] for pose in (picture.rotor, picture.disk, picture.airframe)
        ],
        "flown": _packed(flown_pitch(solution, shape, view.exaggeration)),
        "disk": base64.b64encode(image.getvalue()).decode("ascii"),
    }


def _packed(values: np.ndarray[Any, Any]) -> str:
    """Vertices [m] as 32-bit floats, faces as 32-bit integers, base64."""
    kind = np.float32 if values.dtype.kind == "f" else np.uint32
    return base64.b64encode(values.astype(kind).tobytes()).decode("ascii")
