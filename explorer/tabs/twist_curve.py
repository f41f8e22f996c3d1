"""The twist curves of the rail, jig and flown: handles on the jig curve, and what dragging one does to the inputs."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from explorer.charts.strip import StripChart, StripLine
from explorer.model.drag import place_of, slid, stations, turned
from explorer.model.inputs import Inputs
from explorer.model.session_state import SessionState
from explorer.tabs.context import TabContext
from rotor.arrays import Array
from rotor.design.design import Design
from rotor.design.twist import REFERENCE_RADIUS as DATUM
from rotor.trim.solution import Solution

_POINTS = 70
_LEAST_RESPONSE = 0.15
"""Below it [°] a station at the end of its slider does not answer to a degree."""
_LEAST_SPAN = 14.0
"""Degrees that the axis shows at least."""


class TwistCurveEditor:
    """One session's."""

    def __init__(self, context: TabContext, changed: Callable[[bool], None]) -> None:
        """`changed`: a handle was taken (True) or let go."""
        self._context, self._changed = context, changed
        self._held: Inputs | None = None
        """The inputs when a handle was taken."""
        self._place = ""
        self._range: tuple[float, float] | None = None
        context.bridge.on("knot", self._act)

    def _act(self, value: list[Any]) -> None:
        name, change = value
        if change == "start":
            self._held, self._place = self._context.inputs(), ""
            self._changed(True)
        elif change == "end":
            self._held = None
            self._changed(False)
        elif not self._context.held:
            self._move(name, float(change[0]), float(change[1]))

    @property
    def place(self) -> str:
        """The handle that is held, in words; empty while none is."""
        return self._place if self._held is not None else ""

    def _move(self, name: str, r: float, theta: float) -> None:
        start = self._held or self._context.inputs()
        station = next((one for one in stations(start) if str(one.index) == name), None)
        if station is None:
            return
        at = np.array([station.r])
        before, after = (float(shown_twist(one.design())(at)[0]) for one in (start, turned(start, station, 1.0)))
        # The curve is drawn about 0.75 R, which may turn as well: so much more that the handle meets the pointer.
        response = after - before if abs(after - before) > _LEAST_RESPONSE else 1.0
        inputs = turned(start, station, (theta - before) / response)
        moved = inputs if station.division is None else slid(inputs, station, r)
        if self._held is not None:
            self._place = place_of(moved, stations(moved)[station.index])
        self._context.drag_to(moved)

    def show(self, state: SessionState) -> None:
        """Draw the jig twist over what it is compared with, as the pitch less that at 0.75 R, and the flown twist."""
        design = state.solution.design
        root = design.rotor.blade.root_cutout
        r = np.linspace(root, 1.0, _POINTS)
        own, other = shown_twist(design)(r), shown_twist(state.reference.design)(r)
        flown = flown_band(state.solution, r)
        seen = np.concatenate((own, other, *(flown or ())))
        axis = self._axis(float(seen.min()), float(seen.max()))
        lines = [StripLine(r, other, "reference"), StripLine(r, own, "this")]
        key, band = [["jig", "this"]], None
        if flown is not None:
            mean, low, high = flown
            lines.insert(1, StripLine(r, mean, "flown"))
            key.append(["flown", "flown"])
            band = {name: [round(float(y), 2) for y in values] for name, values in (("low", low), ("high", high))}
        chart = StripChart("Twist", "°", (0.1, 1.03), axis, tuple(lines)).as_dict
        twist = shown_twist(design)
        movable = stations(state.inputs) if design.twist == state.inputs.design().twist else ()
        handles = [
            {"name": str(k.index), "title": k.title, "r": k.r, "theta": round(float(twist(np.array([k.r]))[0]), 2)}
            for k in movable
        ]
        self._context.bridge.set(
            twist={**chart, "pinned": state.pinned is not None, "knots": handles, "key": key, "band": band}
        )

    def _axis(self, low: float, high: float) -> tuple[float, float]:
        """Room for what is shown; held while it fits and is not far too large."""
        held, span = self._range, max(high - low, _LEAST_SPAN)
        if held is not None and held[0] <= low - 0.5 and high + 0.5 <= held[1] and held[1] - held[0] < 2.2 * span:
            return held
        middle, half = 0.5 * (low + high), max(0.5 * (high - low) + 2.0, 0.5 * _LEAST_SPAN)
        self._range = (float(math.floor(middle - half)), float(math.ceil(middle + half)))
        return self._range


def flown_band(solution: Solution, r: Array) -> tuple[Array, Array, Array] | None:
    """Flown twist [°] at r/R, jig, active and elastic: mean, least and greatest over azimuth; None without the two.

    Relative to the jig twist at 0.75 R, as the jig curve, so that the two are apart by active and elastic twist.
    """
    disk, design = solution.disk, solution.design
    active = None if design.active_twist is None or design.hovering else design.active_twist(disk.r, disk.psi)
    added = [one for one in (disk.elastic_twist, active) if one is not None]
    if not added:
        return None
    both, jig, stations = sum(added[1:], start=added[0]), shown_twist(design)(r), disk.r
    ends = (both.mean(axis=1), both.min(axis=1), both.max(axis=1))
    mean, low, high = (jig + np.degrees(np.interp(r, stations, angles)) for angles in ends)
    return mean, low, high


def shown_twist(design: Design) -> Callable[[Any], Any]:
    """Twist [°] over r/R less its value at 0.75 R: the rest is collective pitch."""
    datum = float(design.twist(np.array([DATUM]))[0])
    return lambda r: np.degrees(design.twist(r) - datum)
