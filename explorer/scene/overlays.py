"""What lies on and about the rotor: the overlay of another blade, and tip vortices.

Handles are made once, then moved.
"""

import math
from dataclasses import dataclass

import numpy as np
import viser
from numpy.typing import NDArray

from explorer import colours
from explorer.colours import SceneTheme
from explorer.model.inputs import ViewState
from explorer.model.session_state import Pinned
from explorer.picture.blade_mesh import (
    BladeForm,
    blade_shape,
    overlay_form,
    overlay_segments,
    straight,
)
from explorer.picture.picture import drawn_bending, drawn_times, flown_twist, overlay_twist
from explorer.picture.wake import tip_vortices
from explorer.scene.scene import ROTOR, add_solid, set_mesh
from rotor import Design, Rotor, Solution
from rotor.design import TwistLaw

_BLADE, VORTICES = f"{ROTOR}/blade_0", f"{ROTOR}/vortices"
OTHER = f"{_BLADE}/other"
_LEAST = math.radians(0.25)
"""An overlay is drawn where its twist differs by about this [rad]."""
_OPACITY = 0.38


@dataclass(frozen=True)
class OtherBlade:
    """A blade as built to compare the reference blade with, in a colour or the grey of the page's theme."""

    rotor: Rotor
    twist: TwistLaw
    colour: colours.Rgb | None


def overlay_of(begun: Design | None, pinned: Pinned | None) -> OtherBlade | None:
    """The blade that the reference blade is seen against: what a shown search began from, else A's; None: as built."""
    if begun is not None:
        return OtherBlade(begun.rotor, begun.twist, None)
    if pinned is None:
        return None
    design = pinned.solution.design
    return OtherBlade(design.rotor, design.twist, colours.PINNED_OVERLAY)


class Overlay:
    """A translucent blade in the reference blade's own axes, so that only twist tells the two apart; edges at rest."""

    def __init__(self, api: viser.SceneApi, rotor: Rotor, theme: SceneTheme) -> None:
        self._theme = theme
        self._rotor = rotor
        self._surface = add_solid(api, OTHER, straight(rotor), theme.overlay)
        self._surface.opacity = _OPACITY
        self._surface.visible = False
        self._lines = _unseen_lines(api, f"{_BLADE}/overlay", 1.4)

    def set_theme(self, theme: SceneTheme) -> None:
        self._theme = theme

    def show(
        self, other: OtherBlade, solution: Solution, view: ViewState, at_rest: bool
    ) -> dict[str, BladeForm]:
        """Show the overlay of another blade, or of the jig shape, where it differs from the reference blade as flown.

        The form of its surface by the name of the node, where it is seen.
        """
        if view.wipe:  # A itself is seen, left of the handle.
            self._surface.visible = self._lines.visible = False
            return {}
        psi, shape = math.radians(view.azimuth_deg), blade_shape(other.rotor)
        exaggeration = drawn_times(solution.design, view)
        twist, bent = flown_twist(solution, psi), drawn_bending(solution, shape.r, psi)
        differs = other.twist != solution.design.twist
        # Where only bending differs, the straight blade as flown: its jig shape would hide it.
        overlay = overlay_twist(solution, other.twist, psi) if differs or bent is None else twist
        # Only the edges of the blade's own jig shape: its surface cuts the flown one at small angles and would flicker.
        self._surface.visible = overlay is not None and (differs or bent is not None)
        self._lines.visible = overlay is not None and (at_rest or bent is not None)
        if overlay is None:
            return {}
        if other.rotor != self._rotor:
            self._rotor = other.rotor
            set_mesh(self._surface, straight(other.rotor))
        colour = other.colour if other.colour is not None and differs else self._theme.overlay
        self._surface.color = colour
        if at_rest or bent is not None:  # All edges of the straight blade beside the bent one.
            least = _LEAST if bent is None else -1.0
            segments = overlay_segments(other.rotor, overlay, twist, exaggeration, least).astype(
                np.float32
            )
            self._lines.visible = len(segments) > 0
            if len(segments):
                dark: colours.Rgb = (colour[0] // 2, colour[1] // 2, colour[2] // 2)
                self._lines.points, self._lines.colors = segments, even_colours(dark, len(segments))
        if not self._surface.visible:
            return {}
        return {OTHER: overlay_form(shape, overlay, twist, exaggeration, _LEAST, bent)}


class AirLines:
    """Tip vortices of the rotor of the sliders; drawn once nothing moves."""

    def __init__(self, api: viser.SceneApi) -> None:
        self._vortices = _unseen_lines(api, VORTICES, 1.7)

    def show(self, solution: Solution, view: ViewState, theme: SceneTheme) -> None:
        """Show what belongs to this solution, as far as the view wants them."""
        rotor = solution.design.rotor
        if view.wake:
            step = 2.0 * math.pi / rotor.blades
            azimuths = [math.radians(view.azimuth_deg) + k * step for k in range(rotor.blades)]
            points, age = tip_vortices(solution, azimuths)
            share = age[:, :, None] ** 0.8
            fading = (1.0 - share) * np.array(theme.vortex) + share * np.array(theme.vortex_end)
            self._vortices.points, self._vortices.colors = (
                points.astype(np.float32),
                fading.astype(np.uint8),
            )
        self._vortices.visible = view.wake

    def hide_vortices(self) -> None:
        """Remove the vortices: they belong to blades that have moved on."""
        self._vortices.visible = False


def _unseen_lines(api: viser.SceneApi, name: str, width: float) -> viser.LineSegmentsHandle:
    """Lines to be assigned later. Each point has a colour: the page cannot change from one for all to one for each."""
    nothing, black = np.zeros((1, 2, 3), dtype=np.float32), np.zeros((1, 2, 3), dtype=np.uint8)
    return api.add_line_segments(
        name, nothing, black, thickness=width, thickness_units="screen", visible=False
    )


def even_colours(colour: colours.Rgb, count: int) -> NDArray[np.uint8]:
    """One colour for each end of `count` segments, (count, 2, 3): the page cannot change from one colour to that."""
    return np.tile(np.array(colour, dtype=np.uint8), (count, 2, 1))
