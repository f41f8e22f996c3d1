"""Rotors recorded as scenes, and viser's viewer embedded to show them without a server."""

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass

from explorer.hosting import viser_compat
from explorer.picture.camera_views import FIELD_OF_VIEW, fit
from explorer.picture.picture import make_picture
from explorer.picture.scene_theme import scene_theme
from explorer.scene.scene import Scene
from explorer.state import ViewState
from rotor.trim.solution import Solution

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

    @property
    def json(self) -> str:
        """For a script element: no `<` in it, so that nothing ends the element."""
        parts = {"before": self.before, "between": self.between, "after": self.after, "scenes": self.scenes}
        return json.dumps(parts).replace("<", "\\u003c")


def embedded_viewer(pages: Sequence[str]) -> EmbeddedViewer:
    """What viser's stand-alone pages share, once, and what each has of its own."""
    parts = [_parts(page) for page in pages]
    first = parts[0]
    return EmbeddedViewer(first["before"], first["between"], first["after"], tuple(part["scene"] for part in parts))


def _parts(page: str) -> dict[str, str]:
    found = _SEAMS.fullmatch(page)
    if found is None:
        raise ValueError("viser's viewer is not laid out as it was: the report has no 3D picture until it is adapted.")
    return found.groupdict()


_ASPECT = 16.0 / 9.0
"""Of the window that the camera is fitted to."""
_PIXELS = 640
"""Along each edge of the disk's picture: a file should be small."""


def make_stage(solutions: Sequence[Solution], view: ViewState, colour_range: tuple[float, float]) -> EmbeddedViewer:
    """The rotors of converged solutions as the page shows them, their cameras fitted."""
    return embedded_viewer([_still(solution, view, colour_range) for solution in solutions])


def _still(solution: Solution, view: ViewState, colour_range: tuple[float, float]) -> str:
    """One as a page of its own; from a server that nobody else sees, for only servers can record."""
    server = viser_compat.quiet_server("127.0.0.1", 0, "still")
    try:
        camera = fit("3d", solution.design.rotor.radius, _ASPECT)
        server.initial_camera.position = camera.position
        server.initial_camera.look_at = camera.look_at
        server.initial_camera.fov = FIELD_OF_VIEW
        scene = Scene(server.scene, solution.design.rotor, scene_theme(view.dark))
        scene.show(make_picture(solution, view, colour_range, pixels=_PIXELS))
        return server.scene.as_html()
    finally:
        viser_compat.quiet_stop(server)
