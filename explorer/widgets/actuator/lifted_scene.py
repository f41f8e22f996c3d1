"""The handles of the lifted blade in the scene."""

import threading

import numpy as np
import viser

from explorer.colours import Rgb, css
from explorer.hosting import viser_compat
from explorer.hosting.browser import Bridge, call
from explorer.parts.stage import SceneLabel
from explorer.picture import lifted_blade as lifted
from explorer.picture.lifted_picture import (
    ARROW,
    EDGE,
    FIBRE,
    LEAD,
    LEADER,
    OVERLAY,
    LiftedPicture,
    mixed_colour,
)
from explorer.picture.picture import rotate
from explorer.scene.overlays import even_colours
from rotor.support.arrays import Array

NODE = "/lifted"
"""Name of the lifted blade in the scene."""
_NO_LINES = np.zeros((1, 2, 3), dtype=np.float32)
_LINES: dict[str, tuple[Rgb, float]] = {
    "edges": (EDGE, 2.2),
    "overlay": (OVERLAY, 1.6),
    "leads": (LEAD, 3.0),
    "fibres": (FIBRE[0], 1.1),
    "arrow": (ARROW, 5.0),
    "leaders": (LEADER, 1.2),
}
"""Colours and widths [px] by name."""
FLIGHT_SECONDS = 0.9
"""How long the blade flies out of the rotor or back [s]."""


class LiftedScene:
    """Under its own frame. The page moves it from the rotor to its place and back (`rotorScene.lift`)."""

    def __init__(self, client: viser.ClientHandle, bridge: Bridge) -> None:
        """`bridge`: of the frame, which draws the labels."""
        self._client, self._api, self._bridge = client, client.scene, bridge
        self._frame = self._api.add_frame(NODE, show_axes=False, visible=False)
        self._solids: dict[str, viser.MeshHandle] = {}
        self._lines = {
            name: self._api.add_line_segments(
                f"{NODE}/{name}",
                _NO_LINES,
                even_colours(colour, 1),
                thickness=pixels,
                thickness_units="screen",
                visible=False,
            )
            for name, (colour, pixels) in _LINES.items()
        }
        self._held, self._radius = False, 0.0
        self._labels: list[tuple[str, Array]] = []
        self._leaving: threading.Timer | None = None

    def hold(self, radius: float) -> None:
        """Lift the blade of a rotor of this radius [m] out, or leave it where it is held."""
        if self._leaving is not None:
            self._leaving.cancel()
        if radius != self._radius:  # Only then: on its way the page moves it.
            self._radius, pose = radius, lifted.lifted_pose(radius)
            viser_compat.set_pose(self._frame, pose.wxyz, pose.position)
        if not self._held:
            self._held = True
            self._move(True, radius)
        self._frame.visible = True

    def show(self, picture: LiftedPicture) -> None:
        """Assign one frame; call it inside `client.atomic()`."""
        for name, solid in picture.solids.items():
            vertices, surface = solid.mesh.vertices.astype(np.float32), solid.surface
            if name not in self._solids:
                self._solids[name] = self._api.add_mesh_simple(
                    f"{NODE}/{name}",
                    vertices,
                    solid.mesh.faces,
                    color=surface.colour,
                    opacity=surface.opacity,
                    side="double",
                    cast_shadow=False,
                    receive_shadow=False,
                )
                continue
            handle = self._solids[name]
            if not np.array_equal(handle.faces, solid.mesh.faces):
                # Never faces without their vertices: of two sizes, the page must not draw a mixture.
                handle.visible = False
                handle.vertices, handle.faces = vertices, solid.mesh.faces
            handle.vertices, handle.color, handle.opacity = (
                vertices,
                surface.colour,
                surface.opacity,
            )
            handle.visible = True
        for name in self._solids.keys() - picture.solids.keys():
            self._solids[name].visible = False
        for name, handle in self._lines.items():
            segments = picture.lines[name]
            handle.visible = len(segments) > 0
            if len(segments):
                colour = mixed_colour(*FIBRE, picture.lit) if name == "fibres" else _LINES[name][0]
                handle.points, handle.colors = (
                    segments.astype(np.float32),
                    even_colours(colour, len(segments)),
                )
        lit = {name: solid.glow for name, solid in picture.solids.items() if solid.glow is not None}
        glow = {
            f"{NODE}/{name}": [css(colour), strength] for name, (colour, strength) in lit.items()
        }
        call(self._client, "rotorScene.glow", glow)
        labels = [
            SceneLabel(text, NODE, np.round(at, 3).tolist(), kind=kind)
            for kind, text, at in picture.labels
        ]
        self._bridge.set(lifted_labels=labels)
        self._labels = [(text, at) for _, text, at in picture.labels]

    @property
    def labels(self) -> list[tuple[str, Array]]:
        """Words and their places in the world [m], while the blade is held."""
        pose = lifted.lifted_pose(self._radius)
        return (
            [(text, rotate(pose.wxyz, at) + pose.position) for text, at in self._labels]
            if self._held
            else []
        )

    def release(self, radius: float) -> None:
        """Let the blade fly back; then nothing of it is left."""
        if not self._held:
            return
        self._held = False
        self._bridge.set(lifted_labels=[])
        self._move(False, radius)
        self._leaving = threading.Timer(FLIGHT_SECONDS, self._hide)
        self._leaving.daemon = True
        self._leaving.start()

    def stop(self) -> None:
        if self._leaving is not None:
            self._leaving.cancel()

    def _hide(self) -> None:
        if not self._held:
            self._frame.visible = False

    def _move(self, out: bool, radius: float) -> None:
        pose = lifted.lifted_pose(radius)
        held = {"wxyz": pose.wxyz.tolist(), "position": pose.position.tolist()}
        call(
            self._client,
            "rotorScene.lift",
            NODE,
            out,
            1e3 * FLIGHT_SECONDS,
            held,
            lifted.ORIGIN_R * radius,
        )
