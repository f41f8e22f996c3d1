"""Regions marked on the disk: stall, reverse flow, drag divergence; as codes on a polar grid."""

import math
from dataclasses import dataclass
from enum import IntEnum
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from explorer.picture.fields import filled
from explorer.picture.polar import PolarGrid, Single, Sums, refined
from rotor import Solution
from rotor.arrays import Array, Booleans
from rotor.compiled import compiled

Bytes = NDArray[np.uint8]
_compile = compiled(error_model="numpy", fastmath={"contract"})

DRAG_DIVERGENCE = 0.1
"""∂C_d/∂M that marks drag divergence."""
_SLOPE_LIMIT = 0.5
"""Steeper slopes belong to stall and are cut off before smoothing."""
_SMOOTHING = (0.7, 1.2)
"""Smoothing of ∂C_d/∂M, in elements and azimuths: the table's slope jumps from cell to cell."""
_CLEAR_OF_REVERSE = 0.055
"""U_T/ΩR below which neither stall nor drag divergence is marked: there is no lift to lose."""
_DASHES = 96
_DASH_SHARE = 0.58


class MarkedRegion(IntEnum):
    """What a polar point is marked as."""

    NONE = 0
    STALLED = 1
    STALL_RIM = 2
    DASH = 3
    REVERSE = 4
    REVERSE_RIM = 5


@dataclass(frozen=True)
class Marks:
    stall: bool = True
    reverse_flow: bool = True
    drag_divergence: bool = True


ALL_MARKS, NO_MARKS = Marks(), Marks(False, False, False)


def region_codes(solution: Solution, grid: PolarGrid, marks: Marks, half_width: float) -> Bytes | None:
    """A `MarkedRegion` for each polar point, shape (radii, azimuths); None where nothing is to be marked.

    `half_width`: of the lines, in radii.
    """
    if marks == NO_MARKS:
        return None
    flow = refined(solution, grid)
    clear = flow.u_t > _CLEAR_OF_REVERSE
    codes = np.zeros(flow.u_t.shape, dtype=np.uint8)

    def line(region: MarkedRegion, values: Single, where: Booleans, part: float) -> None:
        mark_line(codes, region.value, values, where, part * half_width, grid.r)

    if marks.stall:
        attached = flow.attached
        mark_below(codes, MarkedRegion.STALLED.value, attached, clear)
        line(MarkedRegion.STALL_RIM, attached, clear, 0.8)
    if marks.drag_divergence:
        line(MarkedRegion.DASH, divergence_margin(solution, grid), clear & _dashes(grid), 1.0)
    if marks.reverse_flow:
        everywhere = np.ones_like(clear)
        mark_below(codes, MarkedRegion.REVERSE.value, flow.u_t, everywhere)
        line(MarkedRegion.REVERSE_RIM, flow.u_t, everywhere, 0.9)
    return codes


@lru_cache(maxsize=4)
def _dashes(grid: PolarGrid) -> Booleans:
    """Where a dashed line is drawn, also where it runs along a radius; not at the very tip."""
    dash = (grid.psi * (_DASHES / (2.0 * math.pi)) + 0.5 * _DASHES / math.pi * grid.r[:, None]) % 1.0 < _DASH_SHARE
    return dash & (grid.r[:, None] < 0.995)


def divergence_margin(solution: Solution, grid: PolarGrid) -> Single:
    """∂C_d/∂M less the value that marks drag divergence, smoothed on the solver's grid; positive beyond it."""
    slope = filled(solution.disk, np.clip(solution.disk.cd_mach, -_SLOPE_LIMIT, _SLOPE_LIMIT))
    return _smoothing(grid)([slope])[0] - np.float32(DRAG_DIVERGENCE)


@lru_cache(maxsize=4)
def _smoothing(grid: PolarGrid) -> Sums:
    """Smoothing on the solver's grid and interpolation in one."""
    along, around = _SMOOTHING
    rows = ndimage.gaussian_filter1d(np.eye(grid.along.shape[1]), along, axis=0, mode="nearest", truncate=3.0)
    columns = ndimage.gaussian_filter1d(np.eye(grid.around.shape[0]), around, axis=1, mode="wrap", truncate=3.0)
    return Sums(grid.along @ rows, columns @ grid.around, np.float32)


@_compile
def mark_below(codes: Bytes, code: int, values: Single, where: Booleans) -> None:
    """Mark the points `where` values are below zero."""
    for i in range(values.shape[0]):
        for j in range(values.shape[1]):
            if where[i, j] and values[i, j] < 0.0:
                codes[i, j] = code


@_compile
def mark_line(codes: Bytes, code: int, values: Single, where: Booleans, half_width: float, r: Array) -> None:
    """Mark, within `where`, the line along which `values` are zero, as wide everywhere: the distance is the value over
    its gradient. `half_width` in radii; `r`: r/R of the rows.

    Only points near a change of sign belong to it: one where values just touch zero has no sides.
    """
    radii, azimuths = values.shape
    spacing = r[1] - r[0]
    reach = 0 if half_width < 0.6 * spacing else math.ceil(half_width / spacing) + 1
    near = np.zeros(values.shape, np.bool_)
    for i in range(radii):
        outer, before = min(i + 1, radii - 1), values[i, azimuths - 1] > 0.0
        for j in range(azimuths):
            positive = values[i, j] > 0.0
            if positive != before or positive != (values[outer, j] > 0.0):
                for row in range(max(i - reach, 0), min(i + reach, radii - 1) + 1):
                    for column in range(j - reach, j + reach + 1):
                        near[row, column % azimuths] = True
            before = positive
    step = 4.0 * math.pi / azimuths
    for i in range(radii):
        inner, outer = max(i - 1, 0), min(i + 1, radii - 1)
        for j in range(azimuths):
            if near[i, j] and where[i, j]:
                along = (values[outer, j] - values[inner, j]) / (r[outer] - r[inner])
                around = (values[i, (j + 1) % azimuths] - values[i, j - 1]) / (step * r[i])
                # Without reach the line is no wider than the points are apart.
                if reach == 0 or abs(values[i, j]) < half_width * math.hypot(along, around):
                    codes[i, j] = code


def region_masks(solution: Solution, grid: PolarGrid, slowest: float = 0.0) -> dict[str, Booleans]:
    """Where each region lies on the polar grid, shape (radii, azimuths), by name; none of them in reverse flow but
    that itself. Stall and drag divergence count where U_T/ΩR is above `slowest`.
    """
    flow = refined(solution, grid)
    stalled, up = (flow.attached < 0.0) & (flow.u_t > slowest), flow.alpha > 0.5 * (flow.upper + flow.lower)
    return {
        "stall": stalled & up,
        "negative_stall": stalled & ~up,
        "reverse_flow": flow.u_t < 0.0,
        "drag_divergence": (divergence_margin(solution, grid) > 0.0) & (flow.u_t > _CLEAR_OF_REVERSE),
    }
