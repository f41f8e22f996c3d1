"""What lies on the marked blade: the ghost of the blade a search began from. Made once, then moved and shown."""

import numpy as np
import viser

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
