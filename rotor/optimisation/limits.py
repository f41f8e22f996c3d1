"""Limits of a search as smooth functions that are positive inside, with exact gradients.

What is limited is the area past the static stall angle, separated or attached. Each cell counts by a logistic function
of its margin to the stall angle of its section, half where the margin is zero, and fades out towards reverse flow. As
both widths go to zero the measure becomes the count of cells beyond that angle: `stalled_area` plus `past_static_area`
of a `Solution`, but for cells where separated flow has come back below the angle.
"""

import math
from dataclasses import InitVar, dataclass, replace
from typing import Any

import numpy as np

from rotor.aero.elements import BladeElements
from rotor.aero.problem import Problem
from rotor.aero.unsteady_section import slopes_ahead
from rotor.airfoil.section_table import MACH_STEP
from rotor.design.quantity import number
from rotor.design.twist import TwistLaw
from rotor.optimisation.concepts import Concept, Parameter, Values
from rotor.support.arrays import Array
from rotor.trim.adjoint import Adjoint, ElementSlopes

_DEGREE = math.radians(1.0)
PERCENT = 0.01
CHANGE_STATIONS = 33
"""Number of radii at which the change limit is enforced, root cut-out to tip."""


@dataclass(frozen=True)
class ChangeLimit:
    """The largest allowed change of twist from a reference law, relative to the clamped root."""

    reference: TwistLaw
    stations: tuple[float, ...]
    """r/R, ascending."""
    largest: tuple[float, ...]
    """Largest change of pitch relative to the root there [rad]; linear between, constant beyond."""

    def __post_init__(self) -> None:
        if len(self.stations) != len(self.largest) or not self.stations or min(self.largest) < 0.0:
            raise ValueError(
                f"change limit of {len(self.largest)} angle(s) at {len(self.stations)} station(s): "
                "give one angle of 0 or more for each"
            )


def even_change_limit(reference: TwistLaw, tip: float, root: float = 0.0) -> ChangeLimit:
    """A change limit that grows linearly along the blade: zero at `root` (r/R), `tip` [rad] at the tip."""
    return ChangeLimit(reference, (root, 1.0), (0.0, tip))


@dataclass(frozen=True)
class Limits:
    """Limits of a search in addition to the bounds of its concept.

    In degrees and per cent: `Limits(rate_deg=(-20, 0), stalled_percent=2, change_deg=4, index_percent=3)`.
    Raises TypeError or ValueError for a limit that cannot be used.
    """

    bounds: tuple[tuple[str, float, float], ...] = ()
    """Parameter, low, high (SI): the rate of one segment, for example."""
    rate: tuple[float, float] | None = None
    """Steepest and flattest twist rate of every segment [rad/R]."""
    stalled: float | None = None
    """Largest part of the disk past the static stall angle, separated or still attached, on every condition (0…1), as
    `stalled_share` has it."""
    change: ChangeLimit | None = None
    index: float | None = None
    """Largest vibration index on every condition [%], see `rotor.trim.hub_loads`; of blades that bend."""
    change_deg: float | None = None
    """Largest change of the tip from the design's own twist [°], relative to the root and linear along the blade."""
    rate_deg: InitVar[tuple[float, float] | None] = None
    """`rate` in degrees per radius."""
    stalled_percent: InitVar[float | None] = None
    """`stalled` in per cent."""
    index_percent: InitVar[float | None] = None
    """`index`."""

    def __post_init__(
        self,
        rate_deg: tuple[float, float] | None,
        stalled_percent: float | None,
        index_percent: float | None,
    ) -> None:
        given: dict[str, Any] = {}
        if rate_deg is not None:
            if isinstance(rate_deg, int | float | str) or len(rate_deg) != 2:
                raise TypeError(
                    f"rate_deg is {rate_deg!r}: give the steepest and the flattest, for example (-20, 0)"
                )
            given["rate"] = tuple(
                math.radians(number("rate_deg", end, "(-20, 0)")) for end in rate_deg
            )
        if stalled_percent is not None:
            given["stalled"] = PERCENT * number("stalled_percent", stalled_percent, "2")
        if index_percent is not None:
            given["index"] = number("index_percent", index_percent, "3")
        for name, value in given.items():
            object.__setattr__(self, name, value)
        if self.change_deg is not None and number("change_deg", self.change_deg, "4") < 0.0:
            raise ValueError(f"change limit {self.change_deg:g}° is negative: give 0 or more")
        if self.rate is not None and not self.rate[0] < self.rate[1]:
            low, high = (math.degrees(value) for value in self.rate)
            raise ValueError(
                f"rate limits {low:g}…{high:g}°/R allow no rate: give the steepest first, e.g. -20,0"
            )
        if self.stalled is not None and not 0.0 <= self.stalled <= 1.0:
            raise ValueError(
                f"stalled_percent {100 * self.stalled:g} % is outside 0…100 %: choose a value inside"
            )
        if self.index is not None and not 0.0 < self.index < math.inf:
            raise ValueError(
                f"limit {self.index:g} % of the vibration index is not positive: give more than 0"
            )

    def about(self, twist: TwistLaw, root: float) -> "Limits":
        """These limits with `change_deg` counted from this twist, for a blade that begins at `root` (r/R)."""
        if self.change_deg is None:
            return self
        if self.change is not None:
            raise ValueError(
                "change and change_deg both limit the change of twist: give one of them"
            )
        return replace(
            self,
            change=even_change_limit(twist, math.radians(self.change_deg), root),
            change_deg=None,
        )

    def largest(self, conditions: int) -> Array:
        """Largest value of each quantity in `ObjectiveValue.limited` [%]."""
        values: Array = np.zeros(0)
        for limit in (None if self.stalled is None else self.stalled / PERCENT, self.index):
            values = values if limit is None else np.append(values, np.full(conditions, limit))
        return values

    def bounds_of(self, concept: Concept) -> tuple[tuple[float, float], ...]:
        """Low and high of each parameter; ValueError for a name the concept lacks or a range that is empty."""
        known = {parameter.name: parameter for parameter in concept.parameters}
        bounds = {name: (parameter.low, parameter.high) for name, parameter in known.items()}
        for name, low, high in self.bounds:
            if name not in known:
                raise ValueError(
                    f"concept {concept.name} has no parameter {name!r}: it has {', '.join(known)}"
                )
            if not low < high:
                parameter: Parameter = known[name]
                raise ValueError(
                    f"bounds {parameter.shown(low):g}…{parameter.shown(high):g} of {name} allow no value: "
                    "give the lower one first"
                )
            bounds[name] = (low, high)
        return tuple(bounds.values())


def cheap_margins(
    limits: Limits, concept: Concept, values: Values, root: float
) -> tuple[Array, Array]:
    """Margins of rate and change limits [°], positive inside, (margins,), and gradients (margins, parameters)."""
    n = len(concept.parameters)
    margins: list[Array] = [np.zeros(0)]
    slopes: list[Array] = [np.zeros((0, n))]
    if limits.rate is not None:
        rows = np.array(concept.rate_rows)
        rates = rows @ np.asarray(values)
        margins += [rates - limits.rate[0], limits.rate[1] - rates]
        slopes += [rows, -rows]
    if limits.change is not None:
        r = np.linspace(root, 1.0, CHANGE_STATIONS)
        change = concept.twist(values)(r) - limits.change.reference(r)
        change -= change[0]
        by = concept.slopes(values, r)
        by = (by - by[:, :1]).T[1:]
        largest = np.interp(r, limits.change.stations, limits.change.largest)
        margins += [(largest - change)[1:], (largest + change)[1:]]
        slopes += [-by, by]
    return np.concatenate(margins) / _DEGREE, np.concatenate(slopes) / _DEGREE


WIDTH = math.radians(0.5)
"""Margin [rad] about the static stall angle over which a cell comes to count (logistic scale)."""
REVERSE_WIDTH = 0.02
"""U_T over which cells fade out next to the reverse-flow region."""


def stalled_share(adjoint: Adjoint) -> tuple[float, Array]:
    """Part of πR² past the static stall angle, without reverse flow; its gradient by each element's pitch [1/rad]."""
    problem, elements = adjoint.problem, adjoint.elements
    disk = problem.disk
    ring = disk.cells[:, None]
    margin, by_alpha, by_mach = _margin(problem, elements)
    counted = 0.5 * (1.0 - np.tanh(0.5 * margin / WIDTH))
    by_margin = -counted * (1.0 - counted) / WIDTH
    x = np.clip(elements.u_t / REVERSE_WIDTH, 0.0, 1.0)
    window, window_slope = x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x) / REVERSE_WIDTH

    # α = θ − atan2(U_P, U_T), in unsteady flow of three quarters of the chord.
    square = elements.u_t**2 + elements.u_p**2 + 1e-30
    over_t, over_p = elements.u_t / square, elements.u_p / square
    # Normal to the sweep: M² = M_tip² ((U_T cos Λ − U_R sin Λ)² + U_P²).
    cos, sin = disk.cos_sweep[:, None], disk.sin_sweep[:, None]
    normal = elements.u_t * cos - elements.u_r * sin
    scale = problem.tip_mach**2 / elements.mach
    slope = ring * window * by_margin
    weights = ElementSlopes(
        theta=slope * by_alpha,
        u_t=slope * (by_alpha * over_p + by_mach * scale * normal * cos)
        + ring * window_slope * counted,
        u_p=slope * (-by_alpha * over_t + by_mach * scale * elements.u_p),
        u_r=slope * by_mach * scale * -normal * sin,
    )
    if problem.unsteady:
        e = elements
        ahead = slopes_ahead(
            np.stack((e.theta, e.u_t, e.u_p, e.u_r, e.loss, e.rate)), problem.half_chord
        )
        turned = slope * by_alpha * ahead
        weights = replace(
            weights, u_t=weights.u_t + turned[0], u_p=weights.u_p + turned[1], rate=turned[2]
        )
    return float((ring * window * counted).sum()), adjoint.by_pitch(weights)


def _margin(problem: Problem, elements: BladeElements) -> tuple[Array, Array, Array]:
    """Angle of attack left before stall [rad], and its slopes by α and Mach: `section.stall_margins` differentiated."""
    disk = problem.disk
    alpha, mach = elements.alpha, elements.mach
    top = disk.stall.shape[3] - 1
    x = np.minimum(mach / MACH_STEP, top - 1e-9)
    k = x.astype(np.int64)
    v = x - k
    inside = (mach / MACH_STEP < top) / MACH_STEP
    ends: list[Array] = []
    slopes: list[Array] = []
    for end in (0, 1):
        angle, slope = np.zeros_like(alpha), np.zeros_like(alpha)
        for which in (0, 1):
            share = (disk.weight if which else 1.0 - disk.weight)[:, None]
            row = disk.stall[:, which, end]
            here, ahead = np.take_along_axis(row, k, axis=1), np.take_along_axis(row, k + 1, axis=1)
            angle += share * (here + v * (ahead - here) + disk.offset[:, which][:, None])
            slope += share * (ahead - here) * inside
        ends.append(angle)
        slopes.append(slope)
    above, below = ends[1] - alpha, alpha - ends[0]
    upper = above < below
    margin: Array = np.minimum(above, below)
    by_alpha: Array = np.where(upper, -1.0, 1.0)
    by_mach: Array = np.where(upper, slopes[1], -slopes[0])
    return margin, by_alpha, by_mach
