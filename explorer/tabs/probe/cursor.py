"""Where the probe is, in the 3D scene: a ray and a ring on the disk with α beside it, and the section on the blade."""

import math

import numpy as np
import viser

from explorer.picture.blade_mesh import circle_segments
from explorer.picture.picture import LINE_LIFT
from explorer.picture.poses import about
from explorer.tabs.probe.drawing import outline
from explorer.tabs.probe.element import Probe
from explorer.text.units import number
from explorer.theme import colours
from rotor.arrays import Array
from rotor.design.blade import Rotor

Cased = tuple[viser.LineSegmentsHandle, viser.LineSegmentsHandle]
"""Casing and line."""

_DISK, _BLADE = "/rotor/disk/probe", "/rotor/blade_0/probe"
_RING = 0.036
"""Radius of the ring [R]."""
_WIDER = 1.12
"""The section's outline stands off the blade by this factor."""


class Cursor:
    """Handles made once; a step of the probe only turns and shifts them, except on the blade."""

    def __init__(self, api: viser.SceneApi) -> None:
        self._rotor: Rotor | None = None
        self._turned = api.add_frame(_DISK, show_axes=False, visible=False)
        self._at = api.add_frame(f"{_DISK}/at", show_axes=False)
        some = circle_segments(0.1, 8)
        self._ray = self._cased(api, f"{_DISK}/ray", some, 1.2, 2.8)
        self._ring = self._cased(api, f"{_DISK}/at/ring", some, 2.2, 5.0)
        self._label = api.add_label(f"{_DISK}/at/label", "", position=(0.0, 0.0, 0.4), anchor="bottom-left")
        self._section = self._cased(api, _BLADE, some, 2.2, 5.0)
        for handle in self._section:
            handle.visible = False
        self._drawn: tuple[object, ...] | None = None

    def show(self, rotor: Rotor, probe: Probe, pitch: float | None) -> None:
        """At the probe; `pitch`: of the blade's own section there, as it is drawn [rad], None: no blade is there."""
        self._scale(rotor)
        self._turned.visible = True
        self._turned.wxyz = about(2, probe.psi)
        self._at.position = np.array([probe.radius, 0.0, 0.0])
        self._label.text = f"α {number(math.degrees(probe.alpha), 1)}°"
        wanted = None if pitch is None else (rotor, probe.r, pitch)
        if wanted == self._drawn:
            return
        self._drawn = wanted
        for handle in self._section:
            handle.visible = pitch is not None
        if pitch is not None:
            _draw(self._section, section_loop(rotor, probe, pitch))

    def hide(self) -> None:
        self._turned.visible, self._drawn = False, None
        for handle in self._section:
            handle.visible = False

    def _scale(self, rotor: Rotor) -> None:
        """Ray and ring of this rotor's size."""
        if rotor == self._rotor:
            return
        self._rotor, radius = rotor, rotor.radius
        ray = np.array([[[rotor.blade.root_cutout * radius, 0.0, 0.0], [(1.0 - _RING) * radius, 0.0, 0.0]]])
        _draw(self._ray, ray)
        _draw(self._ring, circle_segments(_RING * radius, 28))

    def _cased(self, api: viser.SceneApi, name: str, segments: Array, pixels: float, casing: float) -> Cased:
        """A light line in a dark casing, that reads on every colour of the disk and on the blade."""
        under, over = (
            api.add_line_segments(
                name + end, segments.astype(np.float32), colour, thickness=width, thickness_units="screen"
            )
            for end, colour, width in (("_casing", colours.CASING_DARK, casing), ("", colours.CASING_LIGHT, pixels))
        )
        return under, over


def _draw(lines: Cased, segments: Array) -> None:
    for step, handle in enumerate(lines):
        handle.points = (segments + np.array([0.0, 0.0, (2.0 + step) * LINE_LIFT])).astype(np.float32)


def section_loop(rotor: Rotor, probe: Probe, pitch: float) -> Array:
    """The probed section a little widened, in the blade's own axes [m]; segments of shape (n, 2, 3)."""
    middle = np.array([-0.25, 0.0])
    shape = _WIDER * (outline(probe.section) - middle) + middle
    y, z = float(rotor.blade.chord(probe.r)) * shape.T
    cos, sin = math.cos(pitch), math.sin(pitch)
    out = np.full_like(y, probe.radius - rotor.blade.flap_hinge * rotor.radius)
    loop = np.stack((out, y * cos - z * sin, y * sin + z * cos), axis=1)
    return np.stack((loop, np.roll(loop, -1, axis=0)), axis=1)
