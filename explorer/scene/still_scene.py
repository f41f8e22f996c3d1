"""Rotors recorded as scenes, and viser's viewer embedded to show them without a server."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from explorer.colours import scene_theme
from explorer.hosting import viser_compat
from explorer.model.inputs import ViewState
from explorer.picture.camera_views import FIELD_OF_VIEW, UNCOVERED, fit
from explorer.picture.fields import FIELDS
from explorer.picture.picture import make_picture, page_disk_png
from explorer.scene.scene import Scene
from rotor import Solution

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
    return EmbeddedViewer(
        first["before"], first["between"], first["after"], tuple(part["scene"] for part in parts)
    )


def _parts(page: str) -> dict[str, str]:
    match = _SEAMS.fullmatch(page)
    if match is None:
        raise ValueError(
            "viser's viewer is not laid out as it was: the report has no 3D picture until it is adapted."
        )
    return match.groupdict()


_ASPECT = 1.4
"""Aspect ratio that the camera is fitted to: in windows down to it the words beside the disk are whole."""
_PIXELS = 640
"""Along each edge of the disk's picture: a file should be small."""


def make_stage(
    solutions: Sequence[Solution], view: ViewState, colour_range: tuple[float, float]
) -> EmbeddedViewer:
    """The rotors of converged solutions as the page shows them, their cameras fitted."""
    return embedded_viewer([_still_page(solution, view, colour_range) for solution in solutions])


def _still_page(solution: Solution, view: ViewState, colour_range: tuple[float, float]) -> str:
    """One as a page of its own; from a server that nobody else sees, for only servers can record."""
    server = viser_compat.quiet_server("127.0.0.1", 0, "still")
    try:
        camera = fit("3d", solution.design.rotor.radius, _ASPECT, cover=UNCOVERED)
        server.initial_camera.position = camera.position
        server.initial_camera.look_at = camera.look_at
        server.initial_camera.fov = FIELD_OF_VIEW
        scene = Scene(server.scene, solution.design.rotor, scene_theme(view.dark))
        scene.fit(solution.design)
        # A file should be small: elastic twist alone is drawn with one shape for all, that of the reference blade.
        # Nothing in the file could say that bending is drawn larger.
        picture = make_picture(solution, view, solution.design.active_twist is not None, bent=False)
        scene.show(picture)
        png = page_disk_png(solution, FIELDS[view.field], colour_range, view, _PIXELS)
        scene.rotor.record(solution.design.rotor, picture.blades, png, _PIXELS)
        return server.scene.as_html()
    finally:
        viser_compat.quiet_stop(server)
