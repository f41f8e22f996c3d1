"""The twist curve of the rail with its handles, and what dragging a handle does to the inputs."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from explorer.charts.strip import StripChart, StripLine
from explorer.interface import SessionState, TabContext
from explorer.overlay.bridge import Bridge
from explorer.power_tracker import PowerTracker
from explorer.sliders import SLIDERS
from explorer.state import LAWS, Inputs
from rotor.design.design import Design
from rotor.design.twist import REFERENCE_RADIUS as DATUM

_POINTS = 70
_LEAST_SPAN = 14.0
"""Degrees that the axis shows at least."""


@dataclass(frozen=True)
class Knot:
    """A handle of the curve: where it is, and the inputs that moving it changes."""

    name: str
    title: str
    r: float
    rate: str | None = None
    """Field of `Inputs` that its height changes."""
    lever: float = 1.0
    """Degrees of the handle per degree per radius of the rate."""
    division: str | None = None
    """Field of `Inputs` that its place changes."""


def knots(inputs: Inputs) -> tuple[Knot, ...]:
    """Handles of the law on the sliders, from root to tip; none for a law without them."""
    root = inputs.aircraft.rotor_for(inputs.preset).blade.root_cutout
    names = LAWS[inputs.law].inputs
    match inputs.law:
        case "linear":
            ends = ("Twist rate, at the root", "Twist rate, at the tip")
            return tuple(
                Knot(f"end{r:g}", title, r, names[0], _lever(r, root, 1.0))
                for title, r in zip(ends, (root, 1.0), strict=True)
            )
        case "builtin" | "two":
            at = getattr(inputs, names[2])
            return (
                Knot("root", "Inboard twist rate, at the root", root, names[0], _lever(root, root, at)),
                Knot("division", "Division of the two segments", at, division=names[2]),
                Knot("tip", "Outboard twist rate, at the tip", 1.0, names[1], _lever(1.0, at, 1.0)),
            )
        case "three":
            first, second = getattr(inputs, names[3]), getattr(inputs, names[4])
            return (
                Knot("root", "Inboard twist rate, at the root", root, names[0], _lever(root, root, first)),
                Knot(
                    "first",
                    "First division and middle twist rate",
                    first,
                    names[1],
                    _lever(first, first, second),
                    names[3],
                ),
                Knot("second", "Second division", second, division=names[4]),
                Knot("tip", "Outboard twist rate, at the tip", 1.0, names[2], _lever(1.0, second, 1.0)),
            )
        case _:
            return ()


def _lever(r: float, low: float, high: float) -> float:
    """Degrees at r, as drawn about 0.75 R, per degree per radius of the segment low…high; never next to nothing."""
    shared = max(min(max(r, DATUM), high) - max(min(r, DATUM), low), 0.05)
    return math.copysign(shared, r - DATUM)


def moved(inputs: Inputs, knot: Knot, r: float, turned: float) -> Inputs:
    """The inputs with a handle at another place and turned by so many degrees, as far as the sliders go."""
    values: dict[str, Any] = {}
    if knot.division is not None:
        values[knot.division] = _onto(knot.division, r)
    if knot.rate is not None:
        values[knot.rate] = _onto(knot.rate, getattr(inputs, knot.rate) + turned / knot.lever)
    return replace(inputs, **values)


class TwistCurveEditor:
    """One session's."""

    def __init__(self, bridge: Bridge, tracker: PowerTracker) -> None:
        self._bridge, self._tracker = bridge, tracker
        self._held: Inputs | None = None
        """The inputs when a handle was taken."""
        self._range: tuple[float, float] | None = None

    def bind(self, context: TabContext, free: Callable[[], bool]) -> None:
        """Let handles move the design; `free`: whether the design is the user's to move."""

        def act(value: list[Any]) -> None:
            name, change = value
            if change == "start":
                self._held = context.inputs()
                self._tracker.grab()
            elif change == "end":
                self._held = None
                self._tracker.release()
                context.wake()
            elif free():
                self._move(context, name, float(change[0]), float(change[1]))

        self._bridge.on("knot", act)

    def _move(self, context: TabContext, name: str, r: float, theta: float) -> None:
        start = self._held or context.inputs()
        knot = next((one for one in knots(start) if one.name == name), None)
        if knot is not None:
            before = shown_twist(start.design())(np.array([knot.r]))[0]
            context.set_inputs(moved(start, knot, r, theta - before))

    def show(self, state: SessionState) -> None:
        """Draw this design over what it is compared with, as the pitch less that at 0.75 R."""
        design = state.solution.design
        root = design.rotor.blade.root_cutout
        r = np.linspace(root, 1.0, _POINTS)
        own, other = shown_twist(design)(r), shown_twist(state.reference.design)(r)
        axis = self._axis(float(min(own.min(), other.min())), float(max(own.max(), other.max())))
        lines = (StripLine(r, other, "reference"), StripLine(r, own, "this"))
        chart = StripChart("Twist", "°", (0.1, 1.03), axis, lines).as_dict()
        handles = [
            {
                "name": k.name,
                "title": k.title,
                "r": k.r,
                "theta": round(float(shown_twist(design)(np.array([k.r]))[0]), 2),
            }
            for k in (knots(state.inputs) if design.twist == state.inputs.design().twist else ())
        ]
        self._bridge.set(twist={**chart, "pinned": state.pinned is not None, "knots": handles})

    def _axis(self, low: float, high: float) -> tuple[float, float]:
        """Room for what is shown; held while it fits and is not far too large."""
        held, span = self._range, max(high - low, _LEAST_SPAN)
        if held is not None and held[0] <= low - 0.5 and high + 0.5 <= held[1] and held[1] - held[0] < 2.2 * span:
            return held
        middle, half = 0.5 * (low + high), max(0.5 * (high - low) + 2.0, 0.5 * _LEAST_SPAN)
        self._range = (float(math.floor(middle - half)), float(math.ceil(middle + half)))
        return self._range


def shown_twist(design: Design) -> Callable[[Any], Any]:
    """Twist [°] over r/R less its value at 0.75 R: the rest is collective pitch."""
    datum = float(design.twist(np.array([DATUM]))[0])
    return lambda r: np.degrees(design.twist(r) - datum)


def _onto(name: str, value: float) -> float:
    """The nearest place that the slider has."""
    form = SLIDERS[name]
    return round(min(max(form.step * round(value / form.step), form.low), form.high), 4)
