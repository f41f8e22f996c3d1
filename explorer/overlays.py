"""What lies on the marked blade: the ghost of the blade a search began from, and colours. Made once, then moved."""

import numpy as np
import viser
from numpy.typing import NDArray

from explorer import colours
from explorer.meshes import ghost_segments
from rotor.blade import Rotor
from rotor.twist import TwistLaw

_BLADE = "/rotor/blade_0"


class Ghost:
    """Outlines in the marked blade's own axes, so that only twist tells the two apart."""

    def __init__(self, api: viser.SceneApi, rotor: Rotor) -> None:
        self._shown: tuple[TwistLaw, float] | None = None
        self._lines = api.add_line_segments(
            f"{_BLADE}/ghost",
            ghost_segments(rotor, rotor.builtin_twist).astype(np.float32),
            colours.GHOST,
            thickness=1.6,
            thickness_units="screen",
            visible=False,
        )

    def show(self, rotor: Rotor, twist: TwistLaw | None, exaggeration: float) -> None:
        """Show the ghost of a twist; None hides it."""
        wanted = None if twist is None else (twist, exaggeration)
        if wanted == self._shown:
            return
        self._shown = wanted
        if twist is not None:
            self._lines.points = ghost_segments(rotor, twist, exaggeration).astype(np.float32)
        self._lines.visible = twist is not None


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
