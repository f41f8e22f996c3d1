"""What lies on the marked blade: the ghost of another blade, and colours. Made once, then moved."""

from dataclasses import dataclass

import numpy as np
import viser
from numpy.typing import NDArray

from explorer.picture.meshes import ghost_segments
from explorer.pinned import Pinned
from explorer.theme import colours
from rotor.design.blade import Rotor
from rotor.design.design import Design
from rotor.design.twist import TwistLaw

_BLADE = "/rotor/blade_0"


@dataclass(frozen=True)
class OtherBlade:
    """A blade to compare the marked one with."""

    rotor: Rotor
    twist: TwistLaw
    colour: colours.Rgb


def ghost_of(begun: Design | None, pinned: Pinned | None) -> OtherBlade | None:
    """The blade that the marked one is seen against: that a shown search began from, else A's, else none."""
    if begun is not None:
        return OtherBlade(begun.rotor, begun.twist, colours.GHOST)
    if pinned is None:
        return None
    design = pinned.solution.design
    return OtherBlade(design.rotor, design.twist, colours.PINNED_GHOST)


class Ghost:
    """Outlines in the marked blade's own axes, so that only twist tells the two apart."""

    def __init__(self, api: viser.SceneApi, rotor: Rotor) -> None:
        self._shown: tuple[OtherBlade, float] | None = None
        self._lines = api.add_line_segments(
            f"{_BLADE}/ghost",
            ghost_segments(rotor, rotor.builtin_twist).astype(np.float32),
            colours.GHOST,
            thickness=1.6,
            thickness_units="screen",
            visible=False,
        )

    def show(self, blade: OtherBlade | None, exaggeration: float) -> None:
        """Show the ghost of a blade; None hides it."""
        wanted = None if blade is None else (blade, exaggeration)
        if wanted == self._shown:
            return
        self._shown = wanted
        if blade is not None:
            self._lines.points = ghost_segments(blade.rotor, blade.twist, exaggeration).astype(np.float32)
            # One colour for all, as when it was made: a colour for each point would leave the page's lines white.
            self._lines.colors = np.array(blade.colour, dtype=np.uint8)
        self._lines.visible = blade is not None


class Strip:
    """Coloured points along the marked blade."""

    def __init__(self, api: viser.SceneApi) -> None:
        self._points = api.add_point_cloud(
            f"{_BLADE}/strip",
            np.zeros((1, 3), dtype=np.float32),
            np.zeros((1, 3), dtype=np.uint8),
            point_size=0.075,
            point_shape="square",
            visible=False,
        )

    def show(self, points: NDArray[np.float32], colours_of: NDArray[np.uint8]) -> None:
        self._points.points = points
        self._points.colors = colours_of
        self._points.visible = True

    def hide(self) -> None:
        self._points.visible = False
