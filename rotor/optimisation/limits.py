"""What an optimised twist may not do, as smooth functions that stay positive, with exact slopes."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotor.arrays import Array
from rotor.design.twist import TwistLaw
from rotor.optimisation.concepts import Concept, Parameter, Values

_DEGREE = math.radians(1.0)
_PERCENT = 0.01
WATCHED = 33
"""Radii at which the change of twist is held to its limit, root cut-out to tip."""


@dataclass(frozen=True)
class ChangeLimit:
    """How far an actuator can turn the blade away from a reference, seen from its clamped root."""

    reference: TwistLaw
    stations: tuple[float, ...]
    """r/R, ascending."""
    largest: tuple[float, ...]
    """Largest change of pitch relative to the root there [rad]; linear between, held beyond."""

    def __post_init__(self) -> None:
        if len(self.stations) != len(self.largest) or not self.stations or min(self.largest) < 0.0:
            raise ValueError(
                f"change limit of {len(self.largest)} angle(s) at {len(self.stations)} station(s): "
                "give one angle of 0 or more for each"
            )


def reach(reference: TwistLaw, tip: float, root: float = 0.0) -> ChangeLimit:
    """The limit of an actuator that twists evenly along the blade: zero at `root` (r/R), `tip` [rad] at the tip."""
    return ChangeLimit(reference, (root, 1.0), (0.0, tip))


@dataclass(frozen=True)
class Limits:
    """All limits on a search; none by default but the concept's own bounds."""

    bounds: tuple[tuple[str, float, float], ...] = ()
    """Parameter, low, high (SI): the rate of one segment, for example."""
    rate: tuple[float, float] | None = None
    """Steepest and flattest twist rate of every segment [rad/R]."""
    stalled: float | None = None
    """Largest stalled share of the disk on every leg (0…1), as `rotor.optimisation.stall_limit` measures it."""
    change: ChangeLimit | None = None

    def __post_init__(self) -> None:
        if self.rate is not None and not self.rate[0] < self.rate[1]:
            low, high = (math.degrees(value) for value in self.rate)
            raise ValueError(f"rate limits {low:g}…{high:g}°/R leave nothing: give the steepest first, as -20,0")
        if self.stalled is not None and not 0.0 <= self.stalled <= 1.0:
            raise ValueError(f"stalled-area limit {100 * self.stalled:g} % is outside 0…100 %: choose a value inside")

    def bounds_of(self, concept: Concept) -> tuple[tuple[float, float], ...]:
        """Low and high of each parameter; ValueError for a name the concept lacks or a range that is empty."""
        known = {parameter.name: parameter for parameter in concept.parameters}
        found = {name: (parameter.low, parameter.high) for name, parameter in known.items()}
        for name, low, high in self.bounds:
            if name not in known:
                raise ValueError(f"concept {concept.name} has no parameter {name!r}: it has {', '.join(known)}")
            if not low < high:
                parameter: Parameter = known[name]
                raise ValueError(
                    f"bounds {parameter.shown(low):g}…{parameter.shown(high):g} of {name} leave nothing: "
                    "give low, then high"
                )
            found[name] = (low, high)
        return tuple(found.values())


def cheap_margins(limits: Limits, concept: Concept, values: Values, root: float) -> tuple[Array, Array]:
    """What is left of rate and change limits [degrees], positive inside, (margins,); slopes (margins, parameters)."""
    n = len(concept.parameters)
    margins: list[Array] = [np.zeros(0)]
    slopes: list[Array] = [np.zeros((0, n))]
    if limits.rate is not None:
        rows = np.array(concept.rate_rows)
        rates = rows @ np.asarray(values)
        margins += [rates - limits.rate[0], limits.rate[1] - rates]
        slopes += [rows, -rows]
    if limits.change is not None:
        r = np.linspace(root, 1.0, WATCHED)
        change = concept.twist(values)(r) - limits.change.reference(r)
        change -= change[0]
        by = concept.slopes(values, r)
        by = (by - by[:, :1]).T[1:]
        largest = np.interp(r, limits.change.stations, limits.change.largest)
        margins += [(largest - change)[1:], (largest + change)[1:]]
        slopes += [-by, by]
    return np.concatenate(margins) / _DEGREE, np.concatenate(slopes) / _DEGREE


def stall_margins(limits: Limits, stalled: Sequence[float], by_value: Array | None) -> tuple[Array, Array]:
    """What is left of the stalled-area limit on every leg [per cent], and slopes by the values."""
    if limits.stalled is None or by_value is None:
        return np.zeros(0), np.zeros((0, 0))
    return (limits.stalled - np.asarray(stalled)) / _PERCENT, -by_value / _PERCENT
