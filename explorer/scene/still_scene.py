"""Rotors recorded as scenes, and viser's viewer embedded to show them without a server."""

import base64
import io
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from PIL import Image

from explorer.colours import scene_theme
from explorer.hosting import viser_compat
from explorer.model.inputs import ViewState
from explorer.picture.blade_mesh import BladeShape, blade_vertices
from explorer.picture.camera_views import FIELD_OF_VIEW, UNCOVERED, fit
from explorer.picture.fields import FIELDS
from explorer.picture.picture import flown_twist, follows_azimuth, make_picture, page_disk_png
from explorer.scene.controller import motion_of
from explorer.scene.scene import ROTOR, Scene
from rotor import Solution, parse_twist
from rotor.support.arrays import Array

HARMONICS = 4
"""Harmonics of the elastic twist in the trim."""
UNTWISTED = parse_twist("linear:0")
DISK_PIXELS = 400
"""Along each edge of a picture of the disk."""
_SEAMS = re.compile(
    r'(?P<before>.*window\.__VISER_EMBED_DATA__=")(?P<scene>[^"]*)'
    r'(?P<between>";window\.__VISER_EMBED_CONFIG__=\{darkMode:)(?:true|false)(?P<after>\}.*)',
    re.DOTALL,
)
"""Where viser puts a scene, and whether the page is dark, into its viewer."""


@dataclass(frozen=True)
class EmbeddedViewer:
    """The viewer in parts, and what goes between them: before + scene + between + true or false + after."""

    before: str
    between: str
    after: str
    scenes: tuple[str, ...]
    """Base64."""


def embedded_viewer(pages: Sequence[str]) -> EmbeddedViewer:
    """What viser's stand-alone pages share, once, and what each has of its own."""
    parts = [_parts(page) for page in pages]
    first = parts[0]
    return EmbeddedViewer(first["before"], first["between"], first["after"], tuple(part["scene"] for part in parts))


def _parts(page: str) -> dict[str, str]:
    match = _SEAMS.fullmatch(page)
    if match is None:
        raise ValueError("viser's viewer is not laid out as it was: the report has no 3D picture until it is adapted.")
    return match.groupdict()


_ASPECT = 1.4
"""Aspect ratio that the camera is fitted to: in windows down to it the words beside the disk are whole."""
_PIXELS = 640
"""Along each edge of the disk's picture: a file should be small."""


def make_stage(solutions: Sequence[Solution], view: ViewState, colour_range: tuple[float, float]) -> EmbeddedViewer:
    """The rotors of converged solutions as the page shows them, their cameras fitted."""
    return embedded_viewer([still_page(solution, view, colour_range) for solution in solutions])


def still_page(
    solution: Solution, view: ViewState, colour_range: tuple[float, float], compared: Solution | None = None
) -> str:
    """One as a page of its own; from a server that nobody else sees, for only servers can record.

    `compared`: a second rotor at the same place, for a page that wipes the two.
    """
    server = viser_compat.quiet_server("127.0.0.1", 0, "still")
    try:
        camera = fit("3d", solution.design.rotor.radius, _ASPECT, cover=UNCOVERED)
        server.initial_camera.position = camera.position
        server.initial_camera.look_at = camera.look_at
        server.initial_camera.fov = FIELD_OF_VIEW
        scene = Scene(server.scene, solution.design.rotor, scene_theme(view.dark))
        # A file should be small: elastic twist alone is drawn with one shape for all, that of the reference blade.
        # Nothing in the file could say that bending is drawn larger.
        picture = make_picture(solution, view, solution.design.active_twist is not None, bent=False)
        scene.show(picture)
        nodes = [(scene.rotor, solution, picture)]
        if compared is not None:
            other = make_picture(compared, view, each=False, bent=False)
            nodes.append((scene.show_compared(compared.design.rotor, other), compared, other))
        for rotor, shown, of in nodes:
            png = page_disk_png(shown, FIELDS[view.field], colour_range, view, _PIXELS)
            rotor.record(shown.design.rotor, of.blades, png, _PIXELS)
        return server.scene.as_html()
    finally:
        viser_compat.quiet_stop(server)


def flown_pitch(solution: Solution, shape: BladeShape, exaggeration: float) -> Array:
    """Drawn pitch of each ring in harmonics of azimuth 1, cos ψ, sin ψ, cos 2ψ, … [rad], (harmonics, rings).

    The mean alone where the twist does not change around the disk.
    """
    waves = solution.design.pitch_waves
    highest = (
        max(HARMONICS, *(harmonic.per_rev for wave in waves for harmonic in wave.harmonics)) if waves else HARMONICS
    )
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
        "shape": _base64(blade_vertices(shape, UNTWISTED)),
        "rings": list(shape.rings.shape[:2]),
        "faces": _base64(np.asarray(shape.faces)),
    }


def point_record(
    solution: Solution, shape: BladeShape, view: ViewState, colour_range: tuple[float, float], root: str = ROTOR
) -> dict[str, Any]:
    """One trim: motion and pitch of the blades, poses, and the picture of the disk as WebP."""
    picture = make_picture(solution, view)
    png = page_disk_png(solution, FIELDS[view.field], colour_range, view, DISK_PIXELS)
    image = io.BytesIO()
    Image.open(io.BytesIO(png)).convert("RGBA").save(image, "WEBP", quality=80)
    return {
        "motion": motion_of(solution, root),
        "poses": [
            [pose.wxyz.tolist(), pose.position.tolist()] for pose in (picture.rotor, picture.disk, picture.airframe)
        ],
        "flown": _base64(flown_pitch(solution, shape, view.exaggeration)),
        "disk": base64.b64encode(image.getvalue()).decode("ascii"),
    }


def _base64(values: np.ndarray[Any, Any]) -> str:
    """Vertices [m] as 32-bit floats, faces as 32-bit integers, base64."""
    kind = np.float32 if values.dtype.kind == "f" else np.uint32
    return base64.b64encode(values.astype(kind).tobytes()).decode("ascii")
