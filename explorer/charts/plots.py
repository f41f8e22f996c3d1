"""Solution → chart data: finite arrays and axis ranges; a gap is NaN inside an array and never a number on screen."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from explorer.picture.polar import stall_angles
from explorer.text.units import KILOWATT, Unit
from rotor.arrays import Array
from rotor.design.design import Design
from rotor.trim.solution import Solution

Range = tuple[float, float]

SWEEP = tuple(round(0.025 * k, 3) for k in range(19))
"""Advance ratios of the power curve."""


@dataclass(frozen=True, eq=False)
class Plot:
    """The content of one chart."""

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

    def in_unit(self, unit: Unit) -> "PowerCurve":
        """The curve in a unit other than kW."""
        factor = KILOWATT.size / unit.size
        return PowerCurve(factor * self.design, factor * self.reference, factor * self.ideal, self.current)


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


def power_plot(curve: PowerCurve, mu: float, power: float | None, previous: Range | None, pinned: bool = False) -> Plot:
    """Series: ideal for this lift; baseline, A, this design; hover points of these three; the present point.

    Where forward flight does not pass over to hover, hover is a point and the line starts at µ 0.075. `pinned`: the
    reference of the curve is A, which takes the baseline's place.
    """
    x = _with_point(mu)
    lines = (_line(x, curve.reference), _line(x, curve.design))
    hovers = (_single(x, 0.0, curve.reference[0]), _single(x, 0.0, curve.design[0]))
    now = _single(x, mu, math.nan if power is None else power)
    data = (x, _line(x, curve.ideal), *_placed(pinned, *lines), *_placed(pinned, *hovers), now)
    return Plot(data, _range_of(_flown(data, mu), previous, floor=0.0))


def apart_plot(curve: PowerCurve, mu: float, apart_now: float | None, previous: Range | None) -> Plot:
    """Series: zero, B − A over µ, its hover point, the present point."""
    x = _with_point(mu)
    apart = curve.design - curve.reference
    now = _single(x, mu, math.nan if apart_now is None else apart_now)
    data = (x, np.zeros(len(x)), _line(x, apart), _single(x, 0.0, apart[0]), now)
    seen = np.concatenate([values[np.isfinite(values)] for values in _flown(data, mu)])
    return Plot(data, held_range(previous, min(float(seen.min()), -1.0), max(float(seen.max()), 1.0)))


def _with_point(mu: float) -> Array:
    """The advance ratios of the sweep and the present one."""
    return np.array(sorted({*SWEEP, mu}))


def _line(x: Array, values: Array) -> Array:
    """A curve over `SWEEP` at x, with its gaps."""
    return np.interp(x, np.array(SWEEP), values, left=math.nan, right=math.nan)


def _single(x: Array, at: float, value: float) -> Array:
    y = np.full(len(x), math.nan)
    y[x == at] = value
    return y


def _placed(pinned: bool, reference: Array, design: Array) -> tuple[Array, Array, Array]:
    """Series of the baseline, of A, of the design: a chart has them all from the start, and one is empty."""
    none = np.full_like(reference, math.nan)
    return (none, reference, design) if pinned else (reference, none, design)


def _flown(data: tuple[Array, ...], mu: float) -> list[Array]:
    """The values that a range must hold; the last points rise so steeply that they would flatten all others."""
    flown = data[0] <= max(0.4, mu)
    return [values[flown] for values in data[1:]]


def twist_plot(design: Design, reference: Design, previous: Range | None, pinned: bool = False) -> Plot:
    """Series: baseline, A, this design [°]. `pinned`: the reference is A."""
    r = np.linspace(design.rotor.blade.root_cutout, 1.0, 120)
    one = np.degrees(reference.twist(r))
    one[r < reference.rotor.blade.root_cutout] = math.nan
    series = _placed(pinned, one, np.degrees(design.twist(r)))
    return Plot((r, *series), _range_of(series, previous))


def alpha_plot(solution: Solution, azimuth_deg: float, pinned: Solution | None = None) -> Plot:
    """Series: negative and positive stall angle, α [°] along the blade at one azimuth; gaps in reverse flow.

    The α of the reference blade alone, or of A and of B when A is pinned.
    """
    low, high = -15.0, 20.0

    def shown(angles: Array) -> Array:
        # Points far outside are pulled to just beyond the axis, where the chart cuts them off.
        return np.clip(angles, low - 5.0, high + 5.0)

    def alpha(one: Solution) -> Array:
        return shown(angles_along(one, azimuth_deg)[2])

    limits = (shown(limit) for limit in angles_along(solution, azimuth_deg)[:2])
    return Plot((solution.disk.r, *limits, *_marked(solution, pinned, alpha)), (low, high))


def angles_along(solution: Solution, azimuth_deg: float) -> tuple[Array, Array, Array]:
    """Negative and positive stall angle, and α [°], at the elements of one azimuth; NaN in reverse flow."""
    disk = solution.disk
    theta, u_t, u_p = (_at_azimuth(solution, values, azimuth_deg) for values in (disk.theta, disk.u_t, disk.u_p))
    lower, upper = (_at_azimuth(solution, limit, azimuth_deg) for limit in stall_angles(solution))
    outside, alpha = np.where(u_t > 0.0, 1.0, np.nan), theta - np.arctan2(u_p, u_t)
    return outside * np.degrees(lower), outside * np.degrees(upper), outside * np.degrees(alpha)


def lift_plot(solution: Solution, azimuth_deg: float, pinned: Solution | None = None) -> Plot:
    """Series: Cl along the reference blade at one azimuth, or of A and of B when A is pinned; reverse flow included."""
    series = _marked(solution, pinned, lambda one: _at_azimuth(one, one.disk.cl, azimuth_deg))
    return Plot((solution.disk.r, *series), (-0.5, 1.5))


def _marked(
    solution: Solution, pinned: Solution | None, read: Callable[[Solution], Array]
) -> tuple[Array, Array, Array]:
    """Series of the reference blade, of A, of B, on the elements of `solution`; those that do not apply are empty."""
    own, r = read(solution), solution.disk.r
    none = np.full_like(own, math.nan)
    if pinned is None:
        return own, none, none
    if not pinned.converged:
        return none, none, own
    other = read(pinned)
    if not np.array_equal(r, pinned.disk.r):  # Beyond its own root and tip there is none of A.
        other = np.interp(r, pinned.disk.r, other, left=math.nan, right=math.nan)
    return none, other, own


def _at_azimuth(solution: Solution, values: Array, azimuth_deg: float) -> Array:
    """A column of (elements, azimuths) between two stations, periodic."""
    n = values.shape[1]
    position = (math.radians(azimuth_deg) - float(solution.disk.psi[0])) * n / (2.0 * math.pi)
    base = math.floor(position)
    weight = position - base
    return (1.0 - weight) * values[:, base % n] + weight * values[:, (base + 1) % n]


def _range_of(series: Sequence[Array], previous: Range | None, floor: float | None = None) -> Range:
    finite = np.concatenate([values[np.isfinite(values)] for values in series])
    if not len(finite):
        return previous or (0.0, 1.0)
    low = float(finite.min()) if floor is None else min(floor, float(finite.min()))
    return held_range(previous, low, float(finite.max()))


def blank() -> tuple[Plot, Plot, Plot, Plot, Plot]:
    """Empty charts for a page that waits for its first solution: power, B − A, twist, α, Cl.

    No answer has their ranges, so that the first one makes the page build each chart anew: viser's
    charts start with no width, and one that is fed while it gets its width would stay without axis numbers.
    """
    none = np.full(2, np.nan)
    mu, ends = np.array([0.0, 0.45]), np.array([0.13, 1.0])
    waiting = (-1e-3, 1e-3)
    return (
        Plot((mu, *(none,) * 8), waiting),
        Plot((mu, *(none,) * 4), waiting),
        Plot((ends, *(none,) * 3), waiting),
        Plot((ends, *(none,) * 5), waiting),
        Plot((ends, *(none,) * 3), waiting),
    )
