"""Rotors recorded as scenes, and viser's viewer embedded to show them without a server."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from html import escape

import numpy as np

from explorer import web
from explorer.hosting import viser_compat
from explorer.model.inputs import ViewState
from explorer.picture.camera_views import FIELD_OF_VIEW, UNCOVERED, fit
from explorer.picture.picture import make_picture, turned_blades
from explorer.picture.scene_theme import scene_theme
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
    return EmbeddedViewer(first["before"], first["between"], first["after"], tuple(part["scene"] for part in parts))


def _parts(page: str) -> dict[str, str]:
    found = _SEAMS.fullmatch(page)
    if found is None:
        raise ValueError("viser's viewer is not laid out as it was: the report has no 3D picture until it is adapted.")
    return found.groupdict()


_TITLE = r"<title>[^<]*</title>"
_ASPECT = 16.0 / 9.0
"""Of the window that the camera is fitted to."""
_PIXELS = 640
"""Along each edge of the disk's picture: a file should be small."""


def scene_page(solution: Solution, view: ViewState, colour_range: tuple[float, float], title: str, line: str) -> str:
    """The rotor of a converged solution as one HTML page that opens without a server: turn it with the mouse.

    `title` and `line`: what stands over the scene.
    """
    viewer = make_stage([solution], view, colour_range)
    page = viewer.before + viewer.scenes[0] + viewer.between + ("true" if view.dark else "false") + viewer.after
    words = {"scheme": "dark" if view.dark else "light", "title": escape(title), "line": escape(line)}
    caption = web.styles("still.css") + web.fill("still.html", words)
    if not re.search(_TITLE, page) or page.count("</body>") != 1:
        raise ValueError("viser's viewer is not laid out as it was: there is no 3D file until it is adapted.")
    page = re.sub(_TITLE, lambda _: f"<title>{escape(title)}</title>", page, count=1)
    return page.replace("</body>", f"{caption}</body>")


def make_stage(solutions: Sequence[Solution], view: ViewState, colour_range: tuple[float, float]) -> EmbeddedViewer:
    """The rotors of converged solutions as the page shows them, their cameras fitted."""
    return embedded_viewer([still_page(solution, view, colour_range) for solution in solutions])


def still_page(
    solution: Solution,
    view: ViewState,
    colour_range: tuple[float, float],
    compared: Solution | None = None,
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
        # Nothing in the file could say that bending is drawn larger.
        picture = make_picture(solution, view, colour_range, pixels=_PIXELS, bent=False)
        # A file should be small: elastic twist alone is drawn with one shape for all, that of the reference blade.
        blades = turned_blades(solution, view, solution.design.active_twist is not None, bent=False)
        scene.show(replace(picture, blades=blades))
        if compared is not None:
            other = make_picture(compared, view, colour_range, pixels=_PIXELS, bent=False)
            plain = turned_blades(compared, view, each=False, bent=False)
            scene.show_beside(compared.design.rotor, replace(other, blades=plain), np.zeros(3))
        return server.scene.as_html()
    finally:
        viser_compat.quiet_stop(server)
