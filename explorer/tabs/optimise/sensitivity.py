"""Where to twist: the change of power by pitch along the blade, as a chart and as colours on the blade."""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from explorer.charts.plots import Plot, Range, held_range
from explorer.picture.blade_mesh import BladeShape, blade_vertices
from explorer.theme.colours import colour_map
from rotor.design.twist import TwistLaw
from rotor.trim.adjoint import Adjoint, PitchGradient, power_along
from rotor.trim.solution import Solution

_KILOWATT_PER_DEGREE = math.radians(1.0) / 1e3
_ALONG, _ACROSS = 150, 9
_COLOURS = 127


def sensitivity_plot(solution: Solution, previous: Range | None, pinned: Solution | None = None) -> Plot:
    """Series: zero, induced power alone, total power of A, total power. Trim kept throughout.

    All in kW per degree per unit of r/R; that of A is empty where none is pinned or it has no trim.
    """
    adjoint = Adjoint(solution)
    total, induced = power_along(adjoint, "total"), power_along(adjoint, "induced")
    other = np.full_like(total.r, np.nan)
    if pinned is not None and pinned.converged:
        along = _of_pinned(pinned)
        other = np.interp(total.r, along.r, along.density, left=np.nan, right=np.nan)
    lines = [density * _KILOWATT_PER_DEGREE for density in (induced.density, other, total.density)]
    seen = np.concatenate(lines)
    low, high = min(float(np.nanmin(seen)), -1.0), max(float(np.nanmax(seen)), 1.0)
    return Plot((total.r, np.zeros_like(total.r), *lines), held_range(previous, low, high))


@lru_cache(maxsize=4)
def _of_pinned(solution: Solution) -> PitchGradient:
    """A stays while the sliders move: half the work of a round."""
    return power_along(Adjoint(solution), "total")


def blank_sensitivity() -> Plot:
    """The chart before the first answer; its range is none that an answer has."""
    none = np.full(2, np.nan)
    return Plot((np.array([0.13, 1.0]), none, none, none, none), (-1e-3, 1e-3))


def strip(
    shape: BladeShape, twist: TwistLaw, exaggeration: float, plot: Plot
) -> tuple[NDArray[np.float32], NDArray[np.uint8]]:
    """Points just above the reference blade, in blade axes, (n, 3), and their colours: rust costs power, blue saves."""
    count, around = shape.rings.shape[:2]
    rings = blade_vertices(shape, twist, exaggeration)[: count * around].reshape(count, around, 3)[6:]
    upper = rings[:, : around // 2 + 1]  # From the trailing edge over the upper side to the nose.
    r = np.linspace(float(shape.r[6]), 1.0, _ALONG)
    columns = np.linspace(1, upper.shape[1] - 2, _ACROSS).astype(int)
    points = np.stack(
        [[np.interp(r, shape.r[6:], upper[:, column, axis]) for axis in range(3)] for column in columns], axis=0
    )
    points[:, 2] += 0.03
    values = np.interp(r, plot.data[0], plot.data[-1])
    half = max(abs(plot.y_range[0]), abs(plot.y_range[1]))
    signed = np.sign(values) * np.sqrt(np.minimum(np.abs(values) / half, 1.0))  # The tip would outshine all else.
    shades = np.rint((0.5 + 0.5 * signed) * (_COLOURS - 1)).astype(int)
    colours = np.broadcast_to(colour_map("diverging", _COLOURS)[shades], (len(columns), _ALONG, 3))
    return points.transpose(0, 2, 1).reshape(-1, 3).astype(np.float32), colours.reshape(-1, 3).copy()


def explanation(plot: Plot) -> str:
    """What to do, in a line, under the chart."""
    r, values = plot.data[0], plot.data[-1]
    if not np.isfinite(values).all():
        return ""
    up, down = float(r[np.argmin(values)]), float(r[np.argmax(values)])
    if max(abs(values)) < 1.0:
        return _box("No local change of pitch saves power: the twist is near its optimum.")
    return _box(
        f"Power falls fastest with more pitch near {up:.2f} R and less pitch near {down:.2f} R, retrimmed. "
        "Uniform pitch is absorbed by collective."
    )


def _box(text: str) -> str:
    return f'<div class="rx rx-dim rx-small rx-where" data-explorer="sensitivity">{text}</div>'
