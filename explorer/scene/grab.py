"""The reference blade of one client as something that can be grabbed; `explorer.model.drag` says what a drag means."""

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import viser

from explorer.model.drag import BestTurn, Grab, begin, movement
from explorer.model.inputs import Inputs, ViewState
from explorer.model.session_state import DesignAccess
from explorer.model.units import number
from explorer.picture.blade_mesh import drawn_pitch
from explorer.picture.poses import flown_twist
from explorer.scene.scene import ROTOR
from rotor.trim.solution import Solution

_ARC = 3.0
"""Radius of the arc about the pitch axis, in reference chords: a degree can be seen."""
_OWN = 0.3
"""A station whose twist changes by a smaller part of its turn shows the turn against its neighbours."""
_AT = 0.08
"""A turn this close [°] to the best one is held there: sliders move in steps of 0.1°/R."""


class BladeGrab:
    """Turns viser's drag events into inputs. Everything but `learn` happens on viser's event loop, in order."""

    def __init__(
        self,
        blade: viser.MeshHandle,
        access: DesignAccess,
        changed: Callable[[bool], None],
    ) -> None:
        """`changed`: the blade was taken (True) or let go."""
        self._access, self._changed = access, changed
        self._grab: Grab | None = None
        self._best = BestTurn()
        self._place = ""
        self._start: tuple[float, float, float] = (0.0, 0.0, 0.0)
        self._radius = 1.0
        blade.on_drag("left")(self._dragged)
        blade.on_drag("left", modifier="shift")(self._dragged)

    @property
    def place(self) -> str:
        """Where the hand is, in words; empty while nothing is held."""
        return self._place

    def learn(self, inputs: Inputs, by_input: Mapping[str, float]) -> None:
        """Power [W] of these inputs changes by so much for a unit of each: tells where the station is best."""
        grab = self._grab
        if grab is None or grab.slides:
            return
        turn, slope = grab.turn_to(inputs), grab.power_slope(by_input)
        if turn is not None and slope is not None:
            self._best = self._best.with_slope(turn, slope)

    def arc(self, solution: Solution, view: ViewState) -> dict[str, Any] | None:
        """The turn of the grabbed station of the drawn blade, in its own axes, as the frame draws it; None: no turn.

        Angles are those of the drawn blade [°], `words` those of the real one.
        """
        grab = self._grab
        if grab is None or grab.slides is not False:
            return None
        design, exaggeration, r = solution.design, view.exaggeration, grab.station.r
        rotor = design.rotor
        before, now = (
            math.degrees(float(twist(np.array([r]))[0])) for twist in (grab.inputs.design().twist, design.twist)
        )
        best, turn = self._best.turn, grab.turn_to(self._access.inputs())
        if turn is None:
            return None
        # Twist is measured from 0.75 R: a station near it turns against its neighbours without turning itself.
        own = abs(now - before) > _OWN * abs(turn) or r > 0.95
        ratio = (now - before) / turn if own and turn else 1.0
        start = before if own else now - turn
        # The blade is drawn as flown, the turn is of its jig twist.
        flown = float(drawn_pitch(flown_twist(solution, math.radians(view.azimuth_deg)), [r], exaggeration)[0])
        apart = math.degrees(flown - float(drawn_pitch(design.twist, [r], exaggeration)[0]))
        return {
            "node": f"{ROTOR}/blade_0",
            "x": round((r - rotor.blade.flap_hinge) * rotor.radius, 4),
            "radius": round(_ARC * rotor.reference_chord, 4),
            "times": exaggeration,
            "from": round(apart + exaggeration * start, 3),
            "to": round(apart + exaggeration * now, 3),
            "best": None if best is None else round(apart + exaggeration * (start + ratio * best), 3),
            "held": best is not None and abs(turn - best) < _AT,
            "words": f"{number(now - start, 1, sign=True)}°{'' if own else ' to its neighbours'}",
        }

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
        state = self._access.state()
        if state is None or self._access.held:
            return
        self._start, self._radius = event.start_position, state.solution.design.rotor.radius
        r = float(np.linalg.norm(self._start)) / self._radius
        self._grab = begin(self._access.inputs(), r, event.modifier == "shift")
        if self._grab is not None:
            self._best = BestTurn()
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
        inputs: Inputs = self._grab.moved(move, self._best.turn)
        self._place = self._grab.place(inputs if self._grab.slides is not None else self._grab.inputs)
        if inputs != self._access.inputs():
            self._access.drag_to(inputs)

    def _end(self) -> None:
        if self._grab is not None:
            self._grab, self._place = None, ""
            self._changed(False)
