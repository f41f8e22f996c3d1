"""The flight envelope of a rotor: largest load factor and mass over speed, top speed and ceiling, by stall and engines.

A limit by stall is where the solver refuses: nothing balances, or stalled sections carry more of the thrust than on any
rotor that was measured (`rotor.trim.validity.MOST_STALLED`). A limit by engines is where the power of all rotors is
that of the rotor file, which is of sea level on a standard day, gearboxes and accessories left out; so it is an upper
bound.

The largest mass needs no search: n times the weight of one mass is the weight of n times the mass, at the same drag.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Any

from scipy.optimize import brentq

from rotor.design.design import Design, require_design
from rotor.design.quantities import CONDITION
from rotor.design.twist import LinearTwist
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.search import Search, run_search
from rotor.support.chart import Axis, Chart, Line
from rotor.support.units import KNOT
from rotor.trim.newton import DEFAULT_OPTIONS, SolverOptions
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from rotor.trim.validity import MOST_STALLED

SPEEDS = (0.0, 0.1, 0.2, 0.3, 0.4)
"""Advance ratios of an envelope."""
_FROM = {"load_factor": 0.5, "mu": 0.15, "altitude_m": 0.0}
"""Where a search begins: light, near the speed of least power, at sea level."""
_STEP = {"load_factor": 0.1, "mu": 0.05, "altitude_m": 1000.0}
_WITHIN = {"load_factor": 0.01, "mu": 1e-3, "altitude_m": 20.0}
"""How near a limit is found."""
_MARCH = SolverOptions(continuation_steps=0)
"""Each trim starts from its neighbour, so continuation from a light rotor would repeat the march."""
_EDGE = 1e-6
_NO_TRIM = -0.1
"""Margin where nothing balances, in place of a part of the disk."""


@dataclass(frozen=True)
class LimitReached:
    """The largest value of one quantity, in the unit of its name, by stall and by engines."""

    stall: float | None
    """Until the solver refuses; None where nothing trims, and where no limit was met."""
    engines: float | None
    """Until the rotors take the power of the engines; None where stall comes first, or their power is not known, 0
    where they take more from the start. Where dynamic stall sets in, power may step over that of the engines."""

    @property
    def value(self) -> float | None:
        """The first of both."""
        return self.stall if self.engines is None else self.engines

    @property
    def limit(self) -> str:
        """`engines`, `stall`, or empty where nothing is known."""
        return "engines" if self.engines is not None else "" if self.stall is None else "stall"


@dataclass(frozen=True)
class EnvelopePoint:
    """The largest load factor at one speed."""

    design: Design
    """At this speed, with the twist flown there."""
    load_factor: LimitReached

    @property
    def mu(self) -> float:
        """Advance ratio."""
        return self.design.condition.advance_ratio

    @property
    def mass_kg(self) -> float | None:
        """The largest mass in straight flight [kg]."""
        largest = self.load_factor.value
        return None if largest is None else largest * self.design.condition.mass

    def record(self) -> dict[str, Any]:
        """A row of a table."""
        n = self.load_factor
        return {
            "mu": self.mu,
            "speed_kt": self.design.airspeed / KNOT,
            "twist": self.design.twist.spec(),
            "load_factor": n.value,
            "limit": n.limit,
            "load_factor_stall": n.stall,
            "load_factor_engines": n.engines,
            "mass_kg": self.mass_kg,
        }


@dataclass(frozen=True)
class Envelope:
    """The flight envelope of a design, as `rotor.envelope` returns it."""

    design: Design
    moving: bool
    """Whether the twist is the best linear one of each speed, in place of the design's."""
    points: tuple[EnvelopePoint, ...]
    top_speed: LimitReached
    """Advance ratio at the load factor, mass and altitude of the design."""
    ceiling: LimitReached
    """Pressure altitude at its speed [m]."""

    @property
    def label(self) -> str:
        return "best moving twist" if self.moving else self.design.twist.spec()

    def record(self) -> dict[str, Any]:
        """Texts, numbers and lists, for JSON."""
        return {
            "twist": "moving" if self.moving else self.design.twist.spec(),
            "engines_w": self.design.aircraft.installed_power,
            "top_speed_mu": self.top_speed.value,
            "top_speed_kt": self._knots(self.top_speed.value),
            "top_speed_limit": self.top_speed.limit,
            "ceiling_m": self.ceiling.value,
            "ceiling_limit": self.ceiling.limit,
            "points": [point.record() for point in self.points],
        }

    def _knots(self, mu: float | None) -> float | None:
        return None if mu is None else mu * self.design.rotor.tip_speed / KNOT

    def chart(self, *others: "Envelope") -> Chart:
        """Largest load factor over µ, of others too; dashed by engines, which counts where it is the lower."""
        lines: list[Line] = []
        for colour, curve in enumerate((self, *others), start=1):
            for name, dashes in (("stall", False), ("engines", True)):
                mus, values = limit_line(curve.points, name, curve.top_speed, curve.design.condition.load_factor)
                if any(map(math.isfinite, values)):
                    label = f"{curve.label}, {name}"
                    lines.append(Line(label, mus, values, colour, dashes, dots=not dashes))
        return Chart("Largest load factor", Axis("µ"), Axis("n"), tuple(lines))


def limit_line(
    points: Iterable[EnvelopePoint], name: str, top_speed: LimitReached | None = None, flown: float = 1.0
) -> tuple[list[float], list[float]]:
    """µ and largest load factor by `stall` or `engines`, NaN where there is none.

    top_speed: a further point of the line, at the load factor `flown` of which it is.
    """
    line = {point.mu: getattr(point.load_factor, name) for point in points}
    if top_speed is not None and (mu := getattr(top_speed, name)):
        line.setdefault(mu, flown)
    return sorted(line), [math.nan if line[mu] is None else line[mu] for mu in sorted(line)]


def envelope(
    design: Design,
    mu: Iterable[float] = SPEEDS,
    *,
    moving: bool = False,
    tell: Callable[[EnvelopePoint], None] | None = None,
) -> Envelope:
    """The largest load factor and mass at each speed, the top speed and the ceiling, by stall and by engines.

    The load factor is that of a steady turn: lift n W, and the propulsive force of straight flight at that speed.

    Parameters:
        design: the design that flies. The top speed is that of its load factor, mass and altitude; the ceiling is
            that of its speed.
        mu: advance ratios.
        moving: whether the twist moves: at each speed the linear twist of least power replaces the design's own, as
            with an actuator without limits. It is interpolated linearly between speeds.
        tell: called with each point as it is found.

    Returns:
        The envelope, its points in ascending order of speed. A limit that is not reached is None.

    Raises:
        TypeError: the argument is not a design.
        ValueError: a speed cannot be used, or the rotor is on a test stand.

    Example:
        >>> small = rotor.make_design(inflow="uniform", elements=12, azimuths=24, mu=0.2)
        >>> envelope = rotor.envelope(small, [0.1])
        >>> 1.0 < envelope.points[0].load_factor.value < 4.0
        True
    """
    if require_design(design).condition.stand is not None:
        raise ValueError("a design on a test stand has no flight envelope: give a design in flight")
    flights = [design.at(mu=speed) for speed in sorted(set(mu))]
    if not flights:
        raise ValueError("an envelope needs a speed: give for example mu=[0.1, 0.2, 0.3]")
    twists: dict[float, float] = {}

    def flown(at: Design) -> Design:
        """With the best linear twist of the two nearest speeds."""
        if not moving:
            return at
        speeds = [flight.condition.advance_ratio for flight in flights]
        here = min(max(at.condition.advance_ratio, speeds[0]), speeds[-1])
        above = next(k for k, speed in enumerate(speeds) if speed >= here)
        low, high = flights[max(above - 1, 0)], flights[above]
        for flight in (low, high):
            if (speed := flight.condition.advance_ratio) not in twists:
                search = Search(flight, find_concept("linear"), starts=1, band=False)
                law = run_search(search).twist
                twists[speed] = law.rate if isinstance(law, LinearTwist) else 0.0
        a, b = low.condition.advance_ratio, high.condition.advance_ratio
        share = 1.0 if a == b else (here - a) / (b - a)
        return replace(at, twist=LinearTwist(twists[a] + share * (twists[b] - twists[a])))

    points: list[EnvelopePoint] = []
    for flight in map(flown, flights):
        points.append(EnvelopePoint(flight, find_limit(flight, "load_factor", both=True)))
        if tell is not None:
            tell(points[-1])
    return Envelope(
        design, moving, tuple(points), find_limit(design, "mu", flown), find_limit(design, "altitude_m", flown)
    )


def find_limit(
    design: Design, name: str, flown: Callable[[Design], Design] = lambda design: design, *, both: bool = False
) -> LimitReached:
    """How far a quantity of the flight condition can rise; `flown` chooses the twist at each condition.

    name: `load_factor`, `mu` or `altitude_m`. both: beyond the engines too, until stall. A march in steps finds the
    first limit of each kind, Brent's method its place; every trim starts from the nearest one that balanced.
    """
    row, available = CONDITION[name], design.aircraft.installed_power or math.inf
    known: dict[float, Solution] = {}

    def trim(value: float) -> Solution:
        if value not in known:
            good = [at for at, there in known.items() if there.converged]
            near = min(good, key=lambda at: abs(at - value), default=None)
            start, options = (None, DEFAULT_OPTIONS) if near is None else (known[near], _MARCH)
            known[value] = solve(flown(row.put(design, value)), start, options)
        return known[value]

    def stall(value: float) -> float:
        """Part of the thrust that may stall before the solver refuses, never zero."""
        here, left = trim(value), MOST_STALLED - trim(value).stalled_thrust
        return max(left, _EDGE) if here.converged else left if left < -_EDGE else _NO_TRIM

    def power(value: float) -> float:
        """Share of the engines' power that is left."""
        here = trim(value)
        return 1.0 - here.power.total / available if here.converged else _NO_TRIM

    value = _FROM[name]
    if not trim(value).converged:
        return LimitReached(None, None)
    ahead = value
    while trim(ahead).converged and ahead < row.high and (both or power(ahead) >= 0.0):
        value, ahead = ahead, min(ahead + _STEP[name], row.high)
    stalls = None
    if not trim(ahead).converged:
        brentq(stall, value, ahead, xtol=_WITHIN[name])
        stalls = max(at for at, there in known.items() if there.converged)
    good = sorted(at for at, there in known.items() if there.converged)
    over = next((k for k, at in enumerate(good) if power(at) < 0.0), None)
    if over is None:
        return LimitReached(stalls, None)
    if over == 0:
        return LimitReached(stalls, 0.0)
    return LimitReached(stalls, float(brentq(power, good[over - 1], good[over], xtol=1e-2 * _WITHIN[name])))
