"""Regions marked on the disk: stall, reverse flow, drag divergence; as codes on a polar grid, and their labels."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from explorer.picture.fields import filled
from explorer.picture.polar import PolarGrid, Single, Sums, polar_grid, refined
from rotor.arrays import Array, Booleans
from rotor.compiled import compiled
from rotor.trim.solution import Solution

Bytes = NDArray[np.uint8]
_compile = compiled(error_model="numpy", fastmath={"contract"})

DRAG_DIVERGENCE = 0.1
"""∂C_d/∂M that marks drag divergence."""
_SLOPE_LIMIT = 0.5
"""Steeper slopes belong to stall and are cut off before smoothing."""
_SMOOTHING = (0.7, 1.2)
"""Of ∂C_d/∂M, in elements and azimuths: the table's slope jumps from cell to cell."""
_CLEAR_OF_REVERSE = 0.055
"""U_T/ΩR below which neither stall nor drag divergence is marked: there is no lift to lose."""
_DASHES = 96
_DASH_SHARE = 0.58
_LABEL_RADII, _LABEL_AZIMUTHS = 40, 180
_PLANE = 90
"""Points a side of the square on which the widest place of a region is looked for."""
LETTER = 0.046
"""Width of the letters' em on the disk, in radii."""
_LEAST_AREA = 0.006
"""Of the disk: a smaller region is not labelled."""


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
    """Which regions are marked."""

    stall: bool = True
    reverse_flow: bool = True
    drag_divergence: bool = True


ALL_MARKS, NO_MARKS = Marks(), Marks(False, False, False)


@dataclass(frozen=True)
class RegionLabel:
    """A word on the disk."""

    text: str
    r: float
    """r/R"""
    psi: float
    """[rad]"""

    @property
    def place(self) -> tuple[float, float]:
        """To starboard and aft of the hub, in radii."""
        return self.r * math.sin(self.psi), self.r * math.cos(self.psi)

    @property
    def size(self) -> tuple[float, float]:
        """Its width and height on the disk, in radii."""
        return (0.65 * len(self.text) + 1.2) * LETTER, 2.0 * LETTER


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
        margin = flow.margin
        mark_below(codes, MarkedRegion.STALLED.value, margin, clear)
        line(MarkedRegion.STALL_RIM, margin, clear, 0.8)
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
    clear = flow.u_t > slowest
    return {
        "stall": (flow.alpha > flow.upper) & clear,
        "negative_stall": (flow.alpha < flow.lower) & clear,
        "reverse_flow": flow.u_t < 0.0,
        "drag_divergence": (divergence_margin(solution, grid) > 0.0) & (flow.u_t > _CLEAR_OF_REVERSE),
    }


def region_labels(solution: Solution, marks: Marks) -> tuple[RegionLabel, ...]:
    """The words for the regions large enough to name, each near the widest place of its region, none over another."""
    grid = polar_grid(solution.disk, _LABEL_RADII, _LABEL_AZIMUTHS)
    clear = refined(solution, grid).u_t > _CLEAR_OF_REVERSE
    masks = region_masks(solution, grid, _CLEAR_OF_REVERSE)
    regions: list[tuple[str, Booleans]] = []
    if marks.reverse_flow:
        regions.append(("REVERSE FLOW", masks["reverse_flow"]))
    if marks.stall:
        regions += [("STALL", masks["stall"]), ("NEGATIVE STALL", masks["negative_stall"])]
    labels: list[RegionLabel] = []
    for text, inside in regions:
        label = _widest(text, _on_plane(grid, inside), float(grid.r[0]), labels)
        labels += [label] if label else []
    if marks.drag_divergence:
        labels += _divergence_label(solution, grid, clear, labels)
    return tuple(labels)


def _on_plane(grid: PolarGrid, inside: Booleans) -> Booleans:
    """A polar mask on a square of _PLANE points a side: rows run aft, columns to starboard."""
    place = (2.0 * np.arange(_PLANE) + 1.0) / _PLANE - 1.0
    starboard, aft = np.meshgrid(place, place)
    r = np.hypot(aft, starboard)
    row = np.rint((r - grid.r[0]) / (grid.r[1] - grid.r[0])).astype(int)
    column = np.rint(np.arctan2(starboard, aft) / (2.0 * math.pi) * len(grid.psi)).astype(int) % len(grid.psi)
    within = (row >= 0) & (row < len(grid.r))
    return within & inside[np.clip(row, 0, len(grid.r) - 1), column]


def _widest(text: str, inside: Booleans, cutout: float, others: Sequence[RegionLabel]) -> RegionLabel | None:
    """A label for a region, clear of the hub; None where the region is too small to name."""
    if np.count_nonzero(inside) < _LEAST_AREA * 0.25 * math.pi * _PLANE**2:
        return None
    depth = np.asarray(ndimage.distance_transform_edt(inside))
    for index in np.argsort(depth, axis=None)[::-1][: np.count_nonzero(depth)]:
        row, column = divmod(int(index), _PLANE)
        aft, starboard = (2.0 * row + 1.0) / _PLANE - 1.0, (2.0 * column + 1.0) / _PLANE - 1.0
        width, height = RegionLabel(text, 0.0, 0.0).size
        if abs(aft) < cutout + 0.5 * height:
            starboard = math.copysign(max(abs(starboard), cutout + 0.5 * width), starboard)
        label = RegionLabel(text, math.hypot(aft, starboard), math.atan2(starboard, aft) % (2.0 * math.pi))
        if not any(_overlap(label, other) for other in others):
            return label
    return None


def _divergence_label(
    solution: Solution, grid: PolarGrid, clear: Booleans, others: Sequence[RegionLabel]
) -> list[RegionLabel]:
    """Inboard of the line on the advancing side, where it stands clear of the reference blade."""
    beyond = (divergence_margin(solution, grid) > 0.0) & clear
    column = int(np.argmin(np.abs(grid.psi - math.radians(122.0))))
    outside = np.flatnonzero(~beyond[:, column])
    if not len(outside) or not 0.45 < grid.r[outside[-1]] < 0.97:
        return []
    label = RegionLabel("DRAG DIVERGENCE", float(grid.r[outside[-1]]), float(grid.psi[column]))
    half = 0.5 * label.size[0] + 0.03
    label = RegionLabel(label.text, label.r - half, label.psi)
    return [] if any(_overlap(label, other) for other in others) else [label]


def _overlap(one: RegionLabel, other: RegionLabel) -> bool:
    apart = [abs(a - b) for a, b in zip(one.place, other.place, strict=True)]
    return all(gap < 0.5 * (a + b) for gap, a, b in zip(apart, one.size, other.size, strict=True))
