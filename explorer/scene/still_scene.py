"""Rotors recorded as scenes that viser's viewer shows without a server."""

from collections.abc import Sequence

from explorer.hosting import viser_compat
from explorer.picture.camera_views import FIELD_OF_VIEW, fit
from explorer.picture.picture import make_picture
from explorer.picture.scene_theme import scene_theme
from explorer.scene.embedded_viewer import EmbeddedViewer, embedded_viewer
from explorer.scene.scene import Scene
from explorer.state import ViewState
from rotor.trim.solution import Solution

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
