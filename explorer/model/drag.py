"""Twisting the blade by hand: from a drag in the scene to the inputs on the sliders. Values only.

The stations that can be grabbed are the root, the divisions and the tip. Turning one twists the pieces on both sides of
it, so the station turns by that angle relative to its neighbours. Sliding a division moves it along the blade.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from explorer.model.inputs import LAWS, Inputs
from explorer.model.sliders import limits, slider
from explorer.model.units import SI

_GAP = 0.02
"""Least distance of two divisions [R]."""
DETENT = 0.35
"""Half the width of the hold at the best angle of the grabbed station [°]."""
_FARTHEST = 12.0
"""A best angle further away than this [°] is not foreseen."""
PIECES = {name: (LAWS[name].angles, LAWS[name].breaks) for name in ("linear", "builtin", "two", "three")}
"""Rates and divisions, root to tip, of the laws made of straight pieces: fields of `Inputs`."""


@dataclass(frozen=True)
class Station:
    """A place of the blade that can be grabbed."""

    index: int
    """From 0 at the root."""
    r: float
    """r/R"""
    title: str
    division: str | None = None
    """Field of `Inputs` that sliding it changes."""


def grabbed_inputs(inputs: Inputs) -> Inputs:
    """The inputs with a law that can be grabbed: any other is replaced by the nearest two segments."""
    if inputs.law in PIECES or inputs.law == "quadratic":
        return inputs
    root = inputs.aircraft.rotor_for(inputs.preset).blade.root_cutout
    twist, division = inputs.design().twist, 0.5
    rates = {}
    for name, ends in (("two_inner", (root, division)), ("two_outer", (division, 1.0))):
        r = np.linspace(*ends, 30)
        rates[name] = _onto(name, math.degrees(np.polyfit(r, twist(r), 1)[0]))
    return replace(
        inputs, law="two", two_division=division, given=None, optimised=None, airfoils=inputs.airfoils, **rates
    )


def stations(inputs: Inputs) -> tuple[Station, ...]:
    """Where the law on the sliders can be grabbed, root to tip; none for a law without sliders."""
    root = inputs.aircraft.rotor_for(inputs.preset).blade.root_cutout
    if inputs.law == "quadratic":
        return Station(0, root, "root"), Station(1, 0.5 * (root + 1.0), "middle"), Station(2, 1.0, "tip")
    if inputs.law not in PIECES:
        return ()
    divisions = PIECES[inputs.law][1]
    middle = [Station(k + 1, getattr(inputs, name), "break point", name) for k, name in enumerate(divisions)]
    return Station(0, root, "root"), *middle, Station(len(divisions) + 1, 1.0, "tip")


def turned(inputs: Inputs, station: Station, degrees: float) -> Inputs:
    """The inputs with a station turned nose up relative to its neighbours, as far as the sliders go."""
    slopes = turn_slopes(inputs, station)
    (lowest, _), (highest, _) = turn_ends(inputs, station)
    degrees = min(max(degrees, lowest), highest)
    values: dict[str, Any] = {name: _onto(name, getattr(inputs, name) + s * degrees) for name, s in slopes.items()}
    return replace(inputs, **values)


def turn_ends(inputs: Inputs, station: Station) -> tuple[tuple[float, str], tuple[float, str]]:
    """The least and the greatest turn [°] of a station, each with the input that meets its limit there first."""
    ends = [
        sorted(((end - getattr(inputs, name)) / slope, name) for end in limits(name))
        for name, slope in turn_slopes(inputs, station).items()
    ]
    return max(low for low, _ in ends), min(high for _, high in ends)


def turn_slopes(inputs: Inputs, station: Station) -> dict[str, float]:
    """By how much each input moves for a degree that a station is turned nose up."""
    if inputs.law == "quadratic":
        root = inputs.aircraft.rotor_for(inputs.preset).blade.root_cutout
        if station.index == 1:  # A parabola lies a quarter of its coefficient times its span squared below its chord.
            return {"quadratic_curvature": -4.0 / (1.0 - root) ** 2}
        # The slider holds the difference over the whole radius, of which the blade covers a part.
        return {"quadratic_difference": (1.0 if station.index else -1.0) / (1.0 - root)}
    rates = PIECES[inputs.law][0]
    places = [station.r for station in stations(inputs)]
    # Degrees per radius that a degree of this station means for the piece inboard of it and the one outboard.
    slopes: dict[str, float] = {}
    if station.index > 0:
        slopes[rates[station.index - 1]] = 1.0 / (places[station.index] - places[station.index - 1])
    if station.index < len(rates):
        slopes[rates[station.index]] = -1.0 / (places[station.index + 1] - places[station.index])
    return slopes


def place_of(inputs: Inputs, station: Station) -> str:
    """A station and its twist, in words."""
    twist = LAWS[inputs.law].make(inputs)
    law = inputs.design().twist if isinstance(twist, str) else twist
    angle = math.degrees(float(law(np.array([station.r]))[0]))
    return f"{station.title} {station.r:.2f} R · θ {angle:+.1f}°".replace("-", "−")


def slid(inputs: Inputs, station: Station, r: float) -> Inputs:
    """The inputs with a division at another r/R, between its neighbours and within its slider."""
    if station.division is None:
        return inputs
    others = [placed.r for placed in stations(inputs)]
    low, high = limits(station.division)
    inboard, outboard = others[station.index - 1], others[station.index + 1]
    value = min(max(r, low, inboard + _GAP), high, outboard - _GAP)
    return replace(inputs, **{station.division: _onto(station.division, value)})  # pyright: ignore[reportArgumentType]


@dataclass(frozen=True)
class Grab:
    """One drag of a station, from the press to the release."""

    inputs: Inputs
    """When it began, with a law that can be grabbed."""
    station: Station

    def turned(self, degrees: float, best: float | None = None) -> Inputs:
        """The inputs with the station turned so far; `best`: a turn [°] at which it is held for a while."""
        held = best is not None and abs(degrees - best) < DETENT
        return turned(self.inputs, self.station, best if best is not None and held else degrees)

    def turn_to(self, inputs: Inputs) -> float | None:
        """By how much the station has been turned in `inputs` [°]; None where they have another law."""
        if inputs.law != self.inputs.law:
            return None
        name, slope = next(iter(turn_slopes(self.inputs, self.station).items()))
        return (getattr(inputs, name) - getattr(self.inputs, name)) / slope

    def power_slope(self, by_input: Mapping[str, float]) -> float | None:
        """Change of power for a degree of turn, from that by each input; None where one is missing."""
        slopes = turn_slopes(self.inputs, self.station)
        if not slopes.keys() <= by_input.keys():
            return None
        return sum(slope * by_input[name] for name, slope in slopes.items())


@dataclass(frozen=True)
class BestTurn:
    """The turn of least power of one station, foreseen from the exact slope of power at the turns seen so far."""

    seen: tuple[tuple[float, float], ...] = ()
    """Turn [°] and slope of power by it, the latest last."""

    def with_slope(self, turn: float, slope: float) -> "BestTurn":
        """This search with one more turn seen."""
        others = tuple(point for point in self.seen if abs(point[0] - turn) > 1e-6)
        return BestTurn((*others, (turn, slope))[-40:])

    @property
    def turn(self) -> float | None:
        """[°]; None while it is not known, or no minimum is near."""
        if len(self.seen) < 2:
            return None
        now = self.seen[-1][0]
        below = [point for point in self.seen if point[1] < 0.0]
        above = [point for point in self.seen if point[1] >= 0.0]
        if below and above:
            # Between the two closest turns on either side of the minimum.
            pair = min(((a, b) for a in below for b in above), key=lambda two: abs(two[0][0] - two[1][0]))
        else:
            near = sorted(self.seen, key=lambda point: abs(point[1]))
            pair = near[0], next((point for point in near[1:] if abs(point[0] - near[0][0]) > 0.15), near[1])
        (t1, s1), (t2, s2) = pair
        if not (s2 - s1) * (t2 - t1) > 0.0:
            return None  # Power does not curve upward: no minimum is this way.
        best = t1 - s1 * (t2 - t1) / (s2 - s1)
        return best if abs(best - now) < _FARTHEST else None


def begin(inputs: Inputs, r: float) -> Grab | None:
    """A press on the blade at r/R takes the nearest station. None where there is nothing to grab."""
    ready = grabbed_inputs(inputs)
    choice = stations(ready)
    return Grab(ready, min(choice, key=lambda station: abs(station.r - r))) if choice else None


def _onto(name: str, value: float) -> float:
    """The nearest place that the slider has."""
    step = slider(name, SI).step
    low, high = limits(name)
    return round(min(max(step * round(value / step), low), high), 4)
