"""What charts draw: finite arrays with a held axis range, angles along the blade, and the power curve.

A gap is NaN inside an array and never a number on screen. Power against advance ratio is swept after the frame and
abandoned when newer input waits.
"""

import math
import time
from collections.abc import Callable, Generator
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import PchipInterpolator

from explorer.model.units import KILOWATT, Unit
from explorer.picture.picture import at_azimuth
from explorer.picture.polar import stall_angles
from explorer.text.readout import ideal_induced
from explorer.workers.newest_wins import UPDATES
from rotor import Design, Solution, solve
from rotor.support.arrays import Array
from rotor.trim import Guess
from rotor.trim.low_speed import passes_over, vortex_ring
from rotor.trim.validity import LOW_SPEED

Range = tuple[float, float]


def held_range(previous: Range | None, low: float, high: float) -> Range:
    """A round axis range, in the unit of the data, that is kept while they fit into it and fill it reasonably."""
    if not (math.isfinite(low) and math.isfinite(high)):
        return previous or (0.0, 1.0)
    if (
        previous is not None
        and previous[0] <= low
        and high <= previous[1] <= previous[0] + 2.5 * (high - low)
    ):
        return previous
    # Leave a margin, but not below zero where no value is negative.
    span = max(high - low, 1e-6)
    foot = 0.0 if low == 0.0 else 0.04 * span
    step = 10.0 ** math.floor(math.log10(span / 2.0))
    step = next(factor * step for factor in (1.0, 2.0, 5.0, 10.0) if factor * step >= span / 4.0)
    return step * math.floor((low - foot) / step), step * math.ceil((high + 0.04 * span) / step)


def angles_along(solution: Solution, azimuth_deg: float) -> tuple[Array, Array, Array]:
    """Negative and positive stall angle, and α [°], at the elements of one azimuth; NaN in reverse flow."""
    alpha, psi = alpha_along(solution, azimuth_deg), math.radians(azimuth_deg)
    limits = (np.degrees(at_azimuth(solution, values, psi)) for values in stall_angles(solution))
    lower, upper = (np.where(np.isnan(alpha), np.nan, limit) for limit in limits)
    return lower, upper, alpha


def alpha_along(solution: Solution, azimuth_deg: float) -> Array:
    """α [°] at the elements of one azimuth; NaN in reverse flow."""
    fields = (solution.disk.pitch_of_alpha, solution.disk.u_t, solution.disk.u_p)
    theta, u_t, u_p = (at_azimuth(solution, values, math.radians(azimuth_deg)) for values in fields)
    return np.where(u_t > 0.0, np.degrees(theta - np.arctan2(u_p, u_t)), np.nan)


def lift_along(solution: Solution, azimuth_deg: float) -> Array:
    """C_l at the elements of one azimuth, reverse flow included."""
    return at_azimuth(solution, solution.disk.cl, math.radians(azimuth_deg))


SWEEP = tuple(round(0.025 * k, 3) for k in range(19))
"""Advance ratios of the power curve."""
OLD_CURVE_S = 0.6
"""A curve older than this [s] is swept coarsely even while a slider moves, so that it follows a long drag."""
COARSE_SWEEP_S = 0.08
"""[s] that such a sweep may take once a slider has moved; if it needs longer, frames come first."""
_FEW = (0, 1, 3, 6, 9, 12, 15, 18)
"""Places in `SWEEP` computed first; a smooth line joins them where time is short."""
_FEWEST = (0, 6, 12, 15, 18)
"""Places in `SWEEP` computed first where a like design's curve is known: a line joins the differences from it."""
_KEPT = 200
"""Curves remembered per session."""


@dataclass(frozen=True, eq=False)
class PowerCurve:
    """Total power [kW] over `SWEEP` of this design and its reference; NaN where there is no trim or no valid inflow."""

    design: Array
    reference: Array
    """A when one is pinned, else the baseline."""
    ideal: Array
    """This design's power with the least induced power that any circulation could have."""
    current: bool = True
    """Whether `design` has been swept; else it is the curve of the design before it."""
    main_rotor: Array | None = None
    """Main-rotor power of `design`, as flight tests measure it."""

    def in_unit(self, unit: Unit) -> "PowerCurve":
        """The curve in a unit other than kW."""
        powers = {
            name: getattr(self, name) for name in ("design", "reference", "ideal", "main_rotor")
        }
        factor = KILOWATT.size / unit.size
        return replace(
            self, **{name: factor * power for name, power in powers.items() if power is not None}
        )


class PowerCurves:
    """The curves of one session, total and ideal power; a curve belongs to a design at any speed."""

    def __init__(self, haste: float = COARSE_SWEEP_S) -> None:
        self._haste = haste
        self._curves: dict[Design, Array] = {}
        """(3, points): total, ideal and main-rotor power [kW]."""
        self._coarse: set[Design] = set()
        """Curves swept coarsely, to be swept again once there is time."""
        self._last: Design | None = None
        self._tried = -math.inf
        """When the last sweep ended, also one that was abandoned: the next would be as slow."""
        self._starts: dict[int, Guess] = {}
        """The trims of the last sweep by their place in `SWEEP`: the next one belongs to a design much like it."""
        self._fine: tuple[Design, Array] | None = None
        """The last curve that was swept to its end."""

    @property
    def recent(self) -> bool:
        """Whether the last sweep is so fresh that the next can wait until a drag ends."""
        return time.monotonic() - self._tried < OLD_CURVE_S

    def known(self, design: Design, reference: Design) -> PowerCurve:
        """The curves of a design and of its reference; until the design is swept, the curve before it."""
        blank = np.full((3, len(SWEEP)), math.nan)
        last = self._last
        alike = last is not None and last.aircraft == design.aircraft
        before = self._curves.get(last, blank) if last is not None and alike else blank
        family = any_speed(design)
        total, ideal, main_rotor = self._curves.get(family, before)
        reference_total = self._curves.get(any_speed(reference), blank)[0]
        return PowerCurve(total, reference_total, ideal, family in self._curves, main_rotor)

    def sweep(
        self,
        design: Design,
        reference: Design,
        superseded: Callable[[], bool] = lambda: False,
        known: Callable[[], None] = lambda: None,
    ) -> Generator[None, None, bool]:
        """Sweep the curves of a design and its reference; returns False when abandoned half way.

        Yields before each trim for which another page would wait. `known`: called after each curve that was not known
        before.
        """
        patient = self.recent
        for family in dict.fromkeys((any_speed(design), any_speed(reference))):
            swept = family not in self._curves or family in self._coarse
            if swept:
                values, coarse = yield from self._swept(family, superseded, patient)
                self._tried = time.monotonic()
                if values is None:
                    return False
                if len(self._curves) >= _KEPT:
                    del self._curves[next(iter(self._curves))]
                self._curves[family] = values
                self._coarse = (self._coarse | {family}) if coarse else (self._coarse - {family})
            if family == any_speed(design):
                self._last = family
            if swept:
                known()
        return True

    def _swept(
        self, family: Design, superseded: Callable[[], bool], patient: bool
    ) -> Generator[None, None, tuple[Array | None, bool]]:
        """Total, ideal and main-rotor power over `SWEEP`, and whether coarse; None when abandoned for newer input."""
        begun, slow = time.monotonic(), int(slowest_swept(family) > 0.0)
        values = np.full((3, len(SWEEP)), math.nan)
        points: dict[int, Guess] = {}
        before = (
            self._starts if self._last is not None and _same_unknowns(self._last, family) else {}
        )
        base = (
            self._fine[1]
            if self._fine is not None and _same_unknowns(self._fine[0], family)
            else None
        )
        end, lost = len(SWEEP), 0
        few = _FEW if base is None else _FEWEST
        for k in (*few, *(k for k in range(end) if k not in few)):
            if k >= end or (slow and 0.0 < SWEEP[k] < LOW_SPEED):
                continue
            if superseded():
                if k not in few or end < len(SWEEP):
                    self._starts = before | points
                    return _bridged(values, slow, base), True
                if patient or UPDATES.waiting or time.monotonic() - begun > self._haste:
                    return None, False
            elif UPDATES.crowded:
                yield
            try:
                design = family.at(mu=SWEEP[k])
            except ValueError:  # A free rotor in hover.
                continue
            # In descent slow flight has no answer, while faster flight has.
            if vortex_ring(design):
                continue
            starts = before if k in before else points
            point = solve(
                design, starts[min(starts, key=lambda known: abs(known - k))] if starts else None
            )
            if point.converged:
                # Drop the derivatives, which take much memory.
                points[k], values[:, k] = replace(point.start, box=None), _powers(point)
                continue
            lost += 1
            if lost == 2 or (points and k in few):
                end = k  # Faster flight will not trim either, and each failed trim is slow.
        self._starts, self._fine = points, (family, values)
        return values, False


def any_speed(design: Design) -> Design:
    """One design for every advance ratio; a test may have no hover, so there it is another one."""
    mu = 0.0 if design.condition.stand is None else 0.2
    return replace(design, condition=replace(design.condition, advance_ratio=mu))


def slowest_swept(design: Design) -> float:
    """Least advance ratio beside hover of which there is an answer."""
    return 0.0 if passes_over(design) else LOW_SPEED


def _same_unknowns(design: Design, other: Design) -> bool:
    """Whether trims of one design are starts for the other: the same unknowns on the same grid."""
    return (design.rotor, design.models, design.condition.stand) == (
        other.rotor,
        other.models,
        other.condition.stand,
    )


def _powers(point: Solution) -> tuple[float, float, float]:
    """Total power, that with the least induced power at this lift, NaN at low speed, and main-rotor power [kW]."""
    total, slow = point.power.total / 1e3, 0.0 < point.design.condition.advance_ratio < LOW_SPEED
    ideal = None if slow else ideal_induced(point)
    least = math.nan if ideal is None else total - (point.power.induced - ideal) / 1e3
    return total, least, point.power.main_rotor / 1e3


def _bridged(values: Array, first: int, base: Array | None) -> Array:
    """Fill the points left out of a coarse sweep, from `first` on, by a smooth line of the values less those of a base.

    values, base: (powers, points).
    """
    base = np.zeros_like(values) if base is None else base
    k = np.arange(values.shape[1])
    have = np.isfinite(values - base) & (k >= first)
    filled = values.copy()
    for row, known in enumerate(have):
        if known.sum() >= 2:
            line = PchipInterpolator(k[known], (values - base)[row, known], extrapolate=False)
            filled[row] = np.where(
                np.isfinite(values[row]) | (k < first), values[row], base[row] + line(k)
            )
    return filled
