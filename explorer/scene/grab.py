"""The reference blade of one client as something that can be grabbed; `explorer.grab` says what a drag means."""

from collections.abc import Callable
from typing import Any

import numpy as np
import viser

from explorer.grab import Grab, begin, movement
from explorer.interface import TabContext
from explorer.state import Inputs


class BladeGrab:
    """Turns viser's drag events into inputs. Everything happens on viser's event loop, in order."""

    def __init__(
        self,
        blade: viser.MeshHandle,
        context: TabContext,
        free: Callable[[], bool],
        changed: Callable[[bool], None],
    ) -> None:
        """`free`: whether the design is the user's to move. `changed`: the blade was taken (True) or let go."""
        self._context, self._free, self._changed = context, free, changed
        self._grab: Grab | None = None
        self._place = ""
        self._start: tuple[float, float, float] = (0.0, 0.0, 0.0)
        self._radius = 1.0
        blade.on_drag("left")(self._dragged)
        blade.on_drag("left", modifier="shift")(self._dragged)

    @property
    def place(self) -> str:
        """Where the hand is, in words; empty while nothing is held."""
        return self._place

    async def _dragged(self, event: viser.SceneNodeDragEvent[Any]) -> None:
        match event.phase:
            case "start":
                self._begin(event)
            case "update":
                self._move(event)
            case _:
                self._move(event)
                self._end()

    def _begin(self, event: viser.SceneNodeDragEvent[Any]) -> None:
        state = self._context.state()
        if state is None or not self._free():
            return
        self._start, self._radius = event.start_position, state.solution.design.rotor.radius
        r = float(np.linalg.norm(self._start)) / self._radius
        self._grab = begin(self._context.inputs(), r, event.modifier == "shift")
        if self._grab is not None:
            self._place = self._grab.place(self._grab.inputs)
            self._changed(True)

    def _move(self, event: viser.SceneNodeDragEvent[Any]) -> None:
        if self._grab is None:
            return
        camera = event.client.camera
        sight = np.asarray(camera.look_at) - np.asarray(camera.position)
        # The point that was pressed stays where it was in the world; the blade bends away from under it.
        move = movement(self._start, event.end_position, self._start, sight, self._radius)
        self._grab = self._grab.decided(move, event.modifier == "shift")
        inputs: Inputs = self._grab.moved(move)
        self._place = self._grab.place(inputs if self._grab.slides is not None else self._grab.inputs)
        if inputs != self._context.inputs():
            self._context.set_inputs(inputs)

    def _end(self) -> None:
        if self._grab is not None:
            self._grab, self._place = None, ""
            self._changed(False)
