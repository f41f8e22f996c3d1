"""Solution → chart data: finite arrays and axis ranges; a gap is NaN inside an array and never a number on screen."""

import math
from dataclasses import dataclass, replace

import numpy as np

from explorer.model.units import KILOWATT, Unit
from explorer.picture.polar import stall_angles
from explorer.picture.poses import at_azimuth
from rotor import Solution
from rotor.arrays import Array

Range = tuple[float, float]

SWEEP = tuple(round(0.025 * k, 3) for k in range(19))
"""Advance ratios of the power curve."""


@dataclass(frozen=True, eq=False)
class Plot:
    data: tuple[Array, ...]
    """Abscissa, then one array per series, all of one length."""
    y_range: Range
    x_range: Range | None = None
    """None: the range that the chart was made with."""


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
    """Of `design`, as flight tests measure it."""
    band: Array | None = None
    """Power of `design` with the lowest and the highest drag area of its sources, (2, speeds); None until it is known,
    and where the sources give one value."""

    def in_unit(self, unit: Unit) -> "PowerCurve":
        """The curve in a unit other than kW."""
        factor = KILOWATT.size / unit.size
        return replace(
            self,
            design=factor * self.design,
            reference=factor * self.reference,
            ideal=factor * self.ideal,
            main_rotor=None if self.main_rotor is None else factor * self.main_rotor,
            band=None if self.band is None else factor * self.band,
        )


def held_range(previous: Range | None, low: float, high: float) -> Range:
    """A round axis range that is kept while the data fit into it and fill it reasonably."""
    if not (math.isfinite(low) and math.isfinite(high)):
        return previous or (0.0, 1.0)
    if previous is not None and previous[0] <= low and high <= previous[1] <= previous[0] + 2.5 * (high - low):
        return previous
    # A little room, except below a zero that is a floor.
    span = max(high - low, 1e-6)
    foot = 0.0 if low == 0.0 else 0.04 * span
    step = 10.0 ** math.floor(math.log10(span / 2.0))
    step = next(factor * step for factor in (1.0, 2.0, 5.0, 10.0) if factor * step >= span / 4.0)
    return step * math.floor((low - foot) / step), step * math.ceil((high + 0.04 * span) / step)


def angles_along(solution: Solution, azimuth_deg: float) -> tuple[Array, Array, Array]:
    """Negative and positive stall angle, and α [°], at the elements of one azimuth; NaN in reverse flow."""
    disk = solution.disk
    fields = (disk.theta, disk.u_t, disk.u_p, *stall_angles(solution))
    theta, u_t, u_p, lower, upper = (at_azimuth(solution, values, math.radians(azimuth_deg)) for values in fields)
    outside, alpha = np.where(u_t > 0.0, 1.0, np.nan), theta - np.arctan2(u_p, u_t)
    return outside * np.degrees(lower), outside * np.degrees(upper), outside * np.degrees(alpha)


def lift_along(solution: Solution, azimuth_deg: float) -> Array:
    """C_l at the elements of one azimuth, reverse flow included."""
    return at_azimuth(solution, solution.disk.cl, math.radians(azimuth_deg))
