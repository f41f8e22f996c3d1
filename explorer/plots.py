"""Solution → chart data: finite arrays and axis ranges; a gap is NaN inside an array and never a number on screen."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from explorer.stall import stall_angles
from rotor.design import Design
from rotor.solution import Solution
from rotor.validity import LOW_SPEED

Array = NDArray[np.float64]
Range = tuple[float, float]

SWEEP = (0.0, *(round(LOW_SPEED + 0.025 * k, 3) for k in range(16)))
"""Advance ratios of the power curve: hover, then from where forward inflow is trusted."""


@dataclass(frozen=True, eq=False)
class Plot:
    """One chart's content."""

    data: tuple[Array, ...]
    """Abscissa, then one array per series, all of one length."""
    y_range: Range
    x_range: Range | None = None
    """None: as the chart was made."""


@dataclass(frozen=True, eq=False)
class PowerCurve:
    """Total power [kW] over `SWEEP` for this design and the baseline; NaN where a point did not converge."""

    design: Array
    baseline: Array
    ideal: Array
    """This design's power were its induced power the least that any circulation could have."""


def held_range(previous: Range | None, low: float, high: float) -> Range:
    """A round axis range that stays as it is while the data fit it and fill it reasonably."""
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


def power_plot(curve: PowerCurve, mu: float, power_kw: float | None, previous: Range | None) -> Plot:
    """Series: ideal for this lift, baseline, this design, hover points of both, the present point.

    Hover and forward flight are two models, so the line starts at µ 0.075 and hover stands alone.
    """
    x = np.array(sorted({*SWEEP, mu}))
    forward = np.array(SWEEP[1:])

    def line(values: Array) -> Array:
        y = np.interp(x, forward, values[1:], left=math.nan, right=math.nan)
        y[x < LOW_SPEED] = math.nan
        return y

    def single(at: float, value: float) -> Array:
        y = np.full(len(x), math.nan)
        y[x == at] = value
        return y

    now = single(mu, math.nan if power_kw is None else power_kw)
    data = (
        x,
        line(curve.ideal),
        line(curve.baseline),
        line(curve.design),
        single(0.0, curve.baseline[0]),
        single(0.0, curve.design[0]),
        now,
    )
    # Ranged on what is flown: the last points climb so steeply that they would flatten everything else.
    flown = x <= max(0.4, mu)
    return Plot(data, _range_of([values[flown] for values in data[1:]], previous, floor=0.0))


def twist_plot(design: Design, baseline: Design, previous: Range | None) -> Plot:
    """Series: baseline, this design [°]."""
    r = np.linspace(design.rotor.blade.root_cutout, 1.0, 120)
    series = (np.degrees(baseline.twist(r)), np.degrees(design.twist(r)))
    return Plot((r, *series), _range_of(series, previous))


def alpha_plot(solution: Solution, azimuth_deg: float) -> Plot:
    """Series: negative and positive stall angle, α [°] along the blade at one azimuth; gaps in reverse flow."""
    disk = solution.disk
    theta, u_t, u_p = (_at_azimuth(solution, values, azimuth_deg) for values in (disk.theta, disk.u_t, disk.u_p))
    lower, upper = (_at_azimuth(solution, limit, azimuth_deg) for limit in stall_angles(solution))
    low, high = -15.0, 20.0
    # Points far outside are pulled to just beyond the axis, where the chart cuts them off.
    series = (
        np.where(u_t > 0.0, np.clip(np.degrees(values), low - 5.0, high + 5.0), np.nan)
        for values in (lower, upper, theta - np.arctan2(u_p, u_t))
    )
    return Plot((disk.r, *series), (low, high))


def lift_plot(solution: Solution, azimuth_deg: float) -> Plot:
    """Series: Cl along the blade at one azimuth, reverse flow included."""
    cl = _at_azimuth(solution, solution.disk.cl, azimuth_deg)
    return Plot((solution.disk.r, cl), (-0.5, 1.5))


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


def blank() -> tuple[Plot, Plot, Plot, Plot]:
    """Empty charts for a page that waits for its first answer: power, twist, α, Cl.

    Their ranges are none that an answer has, so that the first answer makes the page build each chart anew: viser's
    charts start with no width, and one that is fed while it gets its width would stay without axis numbers.
    """
    none = np.full(2, np.nan)
    ends = np.array([0.13, 1.0])
    waiting = (-1e-3, 1e-3)
    return (
        Plot((np.array([0.0, 0.45]), *(none,) * 6), waiting),
        Plot((ends, none, none), waiting),
        Plot((ends, none, none, none), waiting),
        Plot((ends, none), waiting),
    )
