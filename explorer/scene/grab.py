"""The reference blade of one client as something that can be grabbed: a press tells where along the blade.

What follows is drawn by the page, seen from the tip (`explorer/web/rubber.js`), and moves the design as the handles of
the twist curve do (`explorer.tabs.twist_curve`).
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import viser


class BladeGrab:
    """Turns a press of viser's into the r/R that was pressed."""

    def __init__(self, blade: viser.MeshHandle, radius: Callable[[], float], take: Callable[[float], None]) -> None:
        """`radius`: of the rotor that is shown [m]. `take`: called with r/R."""
        self._radius, self._take = radius, take
        blade.on_drag("left")(self._dragged)

    async def _dragged(self, event: viser.SceneNodeDragEvent[Any]) -> None:
        if event.phase == "start":
            self._take(float(np.linalg.norm(event.start_position)) / self._radius())
