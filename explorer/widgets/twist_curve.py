"""The twist curves of the rail, jig and flown: handles on the jig curve, and what dragging one does to the inputs."""

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from explorer.charts.strip import LOOKS, Role, role_line
from explorer.model.inputs import Inputs
from explorer.model.session_state import SessionState
from explorer.model.sliders import (
    BestTurn,
    StationDrag,
    drag_from,
    grabbed_inputs,
    place_of,
    slid,
    slider,
    stations,
    turn_ends,
)
from explorer.model.units import SI
from explorer.parts.presses import KnotMove, KnotPress
from explorer.parts.results import LeastPower
from explorer.parts.stage import Knot, RoleLines, TwistingPart, TwistPart
from explorer.views.page_state import HeldStation
from explorer.widgets.context import TabContext
from rotor import Design, Solution
from rotor.design import REFERENCE_RADIUS as DATUM
from rotor.support.arrays import Array
from rotor.support.chart import Axis, Band, Chart, Series, drawn_chart

FLOWN = LOOKS["flown"][0]
_POINTS = 70
_LEAST_RESPONSE = 0.15
"""Below it [°] a station at the end of its slider does not answer to a degree."""
_AT = 0.08
"""A turn this close [°] to the best one is held there: sliders move in steps of 0.1°/R."""
_LEAST_SPAN = 14.0
"""Degrees that the axis shows at least."""


class TwistCurveEditor:
    """One session's: the handles of the curve, and the blade that is twisted by hand, move the same stations."""

    def __init__(self, context: TabContext, changed: Callable[[bool], None]) -> None:
        """`changed`: a station was taken (True) or let go."""
        self._context, self._changed = context, changed
        self._grab: StationDrag | None = None
        """While a station is held."""
        self._before: tuple[Inputs, Solution | None] | None = None
        """The inputs and their answer when it was taken."""
        self._shown = False
        """Whether the page shows the held blade from the tip, beside the disk."""
        self._best = BestTurn()
        self._place = ""
        self._range: tuple[float, float] | None = None
        self._presses = 0
        bridge = context.bridge
        bridge.on("knot", self._act)
        bridge.on("grab_at", lambda r: self.grab(float(r)))
        bridge.on("twist_by_hand", lambda r: self.grab(float(r), by_key=True))
        context.keyboard.bind("twist", partial(self.grab, 1.0, by_key=True))

    @property
    def held(self) -> HeldStation | None:
        """The station in the hand; None while none is."""
        before = None if self._before is None else self._before[1]
        return (
            None
            if self._grab is None
            else HeldStation(self._place, self._least(self._grab), before)
        )

    @property
    def before(self) -> Solution | None:
        """The answer when the station was taken; None while the page does not show the blade from the tip."""
        return self._before[1] if self._shown and self._before is not None else None

    def grab(self, r: float, by_key: bool = False) -> None:
        """The blade was pressed at r/R, or is to be twisted by key: the page shows it from the tip."""
        grab = drag_from(self._context.inputs(), r)
        if grab is None:
            return
        self._begin(grab)
        self._show_blade(grab, "key" if by_key else "hand")

    def _show_blade(self, grab: StationDrag, by: str) -> None:
        """`by`: a "hand" on the blade, a "key", or a handle of the "curve"."""
        self._presses, self._shown = self._presses + 1, True
        places = stations(grab.inputs)
        before, response = self._response(grab)
        ends = sorted(
            (before + response * turn, slider(name, SI).label)
            for turn, name in turn_ends(grab.inputs, grab.station)
        )
        self._context.bridge.set(
            twisting=TwistingPart(
                press=self._presses,
                knot=str(grab.station.index),
                by=by,
                stations=[place.r for place in places],
                titles=[place.title for place in places],
                ends=ends,
            )
        )

    def learn(self, inputs: Inputs, power: float, by_input: Mapping[str, float]) -> None:
        """Take the power [W] of these inputs, and its change with a unit of each, which is empty until the page rests:
        they tell where the station is best."""
        if self._grab is None:
            return
        turn, slope = self._grab.turn_to(inputs), self._grab.power_slope(by_input)
        if turn is not None:
            self._best = (
                self._best.with_power(turn, power)
                if slope is None
                else self._best.with_turn(turn, power, slope)
            )

    def _least(self, grab: StationDrag) -> LeastPower | None:
        """The twist of least power of the held station; None while not known, or past the end of a slider."""
        turn, power = self._best.turn, self._best.power
        if turn is None or power is None:
            return None
        (lowest, _), (highest, _) = turn_ends(grab.inputs, grab.station)
        if not lowest <= turn <= highest:
            return None
        now = grab.turn_to(self._context.inputs())
        before, response = self._response(grab)
        held = now is not None and abs(now - turn) < _AT
        return LeastPower(round(before + turn * response, 2), power, held)

    def _act(self, press: KnotPress) -> None:
        name, change = press.name, press.change
        if change == "start":
            start = grabbed_inputs(self._context.inputs())
            station = next(
                (station for station in stations(start) if str(station.index) == name), None
            )
            if station is not None:
                self._begin(StationDrag(start, station))
        elif change in ("end", "undo"):
            if self._grab is not None:
                if change == "undo" and self._before is not None:
                    self._context.drag_to(self._before[0])
                self._grab, self._place, self._shown = None, "", False
                self._context.bridge.set(twisting=None)
                self._changed(False)
        elif isinstance(change, KnotMove):
            self._move(name, change)

    def _begin(self, grab: StationDrag) -> None:
        state = self._context.state()
        self._grab, self._best, self._place = grab, BestTurn(), place_of(grab.inputs, grab.station)
        self._before = self._context.inputs(), None if state is None else state.solution
        self._changed(True)

    def _move(self, name: str, place: KnotMove) -> None:
        start = self._grab.inputs if self._grab is not None else self._context.inputs()
        station = next((station for station in stations(start) if str(station.index) == name), None)
        if station is None:
            return
        grab, r = StationDrag(start, station), place.r
        if self._grab is not None and not self._shown:
            self._show_blade(self._grab, "curve")
        before, response = self._response(grab)
        near = self._best.turn if r is None and self._grab is not None else None
        moved = grab.turned((place.theta - before) / response, near)
        if r is not None and station.division is not None:
            moved = slid(moved, station, r)
        if self._grab is not None:
            self._place = place_of(moved, stations(moved)[station.index])
        if moved != self._context.inputs():
            self._context.drag_to(moved)

    @staticmethod
    def _response(grab: StationDrag) -> tuple[float, float]:
        """Twist [°] of the station less that at 0.75 R when it was taken, and its change with a degree of turn.

        The curve is drawn about 0.75 R, which may turn as well: so much more that the handle meets the pointer.
        """
        at, (_, (highest, _)) = np.array([grab.station.r]), turn_ends(grab.inputs, grab.station)
        turn = 1.0 if highest >= 1.0 else -1.0  # Away from the end of its slider.
        before, after = (
            float(shown_twist(inputs.design())(at)[0])
            for inputs in (grab.inputs, grab.turned(turn))
        )
        return before, (after - before) / turn if abs(after - before) > _LEAST_RESPONSE else 1.0

    def show(self, state: SessionState) -> None:
        """Draw the jig twist over what it is compared with, as the pitch less that at 0.75 R, and the flown twist."""
        design = state.solution.design
        r = np.linspace(design.rotor.blade.root_cutout, 1.0, _POINTS)
        angles, other = shown_twist(design)(r), shown_twist(state.reference.design)(r)
        flown = flown_band(state.solution, r)
        seen = np.concatenate((angles, other, *(flown or ())))
        axis = self._axis(float(seen.min()), float(seen.max()))
        compared: Role = "reference" if state.pinned is None else "pinned"
        parts: list[Series] = [
            role_line(compared, r, other),
            role_line("this", r, angles, label="jig"),
        ]
        if flown is not None:
            mean, low, high = flown
            parts = [
                Band("", r, low, high, FLOWN),
                parts[0],
                role_line("flown", r, mean, label="flown"),
                parts[1],
            ]
        along = Axis("r/R", (0.1, 1.03), (0.1, 1.0), ("root", "tip"))
        chart = Chart("Twist", along, Axis(range=axis, unit="°"), tuple(parts))
        twist = shown_twist(design)
        movable = stations(state.inputs) if design.twist == state.inputs.design().twist else ()
        handles = [
            Knot(str(k.index), k.title, k.r, round(float(twist(np.array([k.r]))[0]), 2))
            for k in movable
        ]
        places = RoleLines(this=len(parts) - 1, reference=1 if flown is not None else 0)
        self._context.bridge.set(twist=TwistPart(drawn_chart(chart), handles, places))

    def _axis(self, low: float, high: float) -> tuple[float, float]:
        """Room for what is shown; held while it fits and is not far too large."""
        held, span = self._range, max(high - low, _LEAST_SPAN)
        if (
            held is not None
            and held[0] <= low - 0.5
            and high + 0.5 <= held[1]
            and held[1] - held[0] < 2.2 * span
        ):
            return held
        middle, half = 0.5 * (low + high), max(0.5 * (high - low) + 2.0, 0.5 * _LEAST_SPAN)
        self._range = (float(math.floor(middle - half)), float(math.ceil(middle + half)))
        return self._range


def flown_band(solution: Solution, r: Array) -> tuple[Array, Array, Array] | None:
    """Flown twist [°] at r/R, jig, active and elastic: mean, least and greatest over azimuth; None without the two.

    Relative to the jig twist at 0.75 R, as the jig curve, so that the two are apart by active and elastic twist.
    """
    disk, design = solution.disk, solution.design
    active = (
        None
        if design.active_twist is None or design.hovering
        else design.active_twist(disk.r, disk.psi)
    )
    added = [twist for twist in (disk.elastic_twist, active) if twist is not None]
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
