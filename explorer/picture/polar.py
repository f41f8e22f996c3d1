"""From the solver's (elements, azimuths) grid to a finer polar grid: smooth, periodic, sums of four neighbours.

Regions marked on it are codes: separated, past the static stall angle, reverse flow, drag divergence.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from rotor import Solution
from rotor.aero.display import STALLED
from rotor.aero.problem import LOW_MACH
from rotor.aero.section import arctangent
from rotor.airfoil.section_table import DRAG_DIVERGENCE
from rotor.airfoil.sections import Section
from rotor.airfoil.stall_delay import delay_gain, delayed_stall
from rotor.design.blade import Rotor
from rotor.support.arrays import Array, Booleans
from rotor.support.compiled import compiled
from rotor.trim import DiskFields

Single = NDArray[np.float32]
Places = NDArray[np.int32]
_compile = compiled(error_model="numpy", fastmath={"contract"})


@dataclass(frozen=True, eq=False)
class PolarGrid:
    """A refined polar grid that covers the whole blade, cut-out to tip, and the whole turn."""

    r: Array
    """y/R, shape (radii,), from the inner edge of the first element to the outer edge of the last."""
    psi: Array
    """Azimuth [rad], shape (azimuths,), 2π not repeated: the grid is periodic."""
    along: Array
    """Interpolation in radius, shape (radii, elements)."""
    around: Array
    """Interpolation in azimuth, shape (solver azimuths, azimuths)."""

    @property
    def shape(self) -> tuple[int, int]:
        """Radii and azimuths."""
        return len(self.r), len(self.psi)

    def refine(self, field: Array) -> Array:
        """`field` of shape (elements, solver azimuths) on this grid, shape (radii, azimuths)."""
        return self._double([field])[0]

    def refine_all(self, fields: Sequence[Array]) -> Single:
        """Several fields at once in single precision, shape (fields, radii, azimuths): for pictures, in half the
        time."""
        return self._single(fields)

    @cached_property
    def _double(self) -> "WeightedSums":
        return WeightedSums(self.along, self.around, np.float64)

    @cached_property
    def _single(self) -> "WeightedSums":
        return WeightedSums(self.along, self.around, np.float32)


class WeightedSums:
    """A field of the solver's grid between two matrices, such as those of a `PolarGrid`, which are mostly zeros."""

    def __init__(
        self, along: Array, around: Array, precision: "type[np.float32 | np.float64]"
    ) -> None:
        self._precision = precision
        self._rows, self._columns = _terms(along, precision), _terms(around.T, precision)

    def __call__(self, fields: Sequence[Array]) -> Any:
        """Several fields of shape (elements, solver azimuths), made (fields, radii, azimuths)."""
        return weighted_sums(np.array(fields, dtype=self._precision), *self._rows, *self._columns)


def _terms(
    matrix: Array, precision: "type[np.float32 | np.float64]"
) -> tuple[Places, NDArray[Any]]:
    """Columns of the entries of each row that are not zero, and these entries, shape (terms, rows)."""
    most = int(np.count_nonzero(matrix, axis=1).max())
    places = np.argsort(matrix == 0.0, axis=1, kind="stable")[:, :most]
    entries = np.take_along_axis(matrix, places, axis=1)
    return np.ascontiguousarray(places.T, np.int32), np.ascontiguousarray(entries.T, precision)


@_compile
def weighted_sums(fields: Any, rows: Places, along: Any, columns: Places, around: Any) -> Any:
    """Several fields of shape (fields, n, m) at other points, (fields, radii, azimuths), of the same type.

    Each point is a sum over few rows and columns: their places, (terms, radii) and (terms, azimuths), and weights
    `along` and `around` of the same shapes.
    """
    count, n, _ = fields.shape
    turned = np.zeros((count, n, columns.shape[1]), fields.dtype)
    sums = np.zeros((count, rows.shape[1], columns.shape[1]), fields.dtype)
    for field in range(count):
        for i in range(n):
            for k in range(len(columns)):
                for j in range(columns.shape[1]):
                    turned[field, i, j] += around[k, j] * fields[field, i, columns[k, j]]
        for i in range(rows.shape[1]):
            for k in range(len(rows)):
                weight, row = along[k, i], rows[k, i]
                for j in range(columns.shape[1]):
                    sums[field, i, j] += weight * turned[field, row, j]
    return sums


def polar_grid(
    disk: DiskFields, radii: int, azimuths: int, ends: tuple[float, float] | None = None
) -> PolarGrid:
    """The grid of `radii` × `azimuths` points over `disk`; kept for the next frame.

    `ends`: first and last y/R, where they are not those of `disk` itself; beyond them values are extrapolated.
    """
    ends = ends or (float(disk.edges[0]), float(disk.edges[-1]))
    return _build(tuple(disk.r.tolist()), len(disk.psi), float(disk.psi[0]), radii, azimuths, ends)


@lru_cache(maxsize=16)
def _build(
    elements: tuple[float, ...],
    n_psi: int,
    first_psi: float,
    radii: int,
    azimuths: int,
    ends: tuple[float, float],
) -> PolarGrid:
    r = np.linspace(*ends, radii)
    psi = 2.0 * np.pi * np.arange(azimuths) / azimuths
    along = _along(r, np.array(elements))
    return PolarGrid(
        r=r, psi=psi, along=along, around=_around((psi - first_psi) * n_psi / (2.0 * np.pi), n_psi)
    )


def _weights(fraction: Array) -> Array:
    """Catmull–Rom weights of the four neighbours, shape (points, 4)."""
    t = fraction[:, None]
    return 0.5 * np.hstack(
        (-t + 2 * t**2 - t**3, 2 - 5 * t**2 + 3 * t**3, t + 4 * t**2 - 3 * t**3, -(t**2) + t**3)
    )


def _around(position: Array, n: int) -> Array:
    base = np.floor(position).astype(int)
    matrix = np.zeros((n, len(position)))
    for offset, weight in zip(range(-1, 3), _weights(position - base).T, strict=True):
        np.add.at(matrix, ((base + offset) % n, np.arange(len(position))), weight)
    return matrix


def _along(points: Array, r: Array) -> Array:
    """Interpolation from the elements at `r`, even or not, to points along the blade, (points, elements).

    Between two elements the cubic with the slope there of the parabola through each and its neighbours: on even
    elements that of Catmull and Rom.
    """
    n, rows, gap = len(r), np.arange(len(points)), np.diff(r)
    base = np.clip(np.searchsorted(r, points, "right") - 1, 0, n - 2)
    matrix = np.zeros((len(points), n))
    # Beyond the element centres at both ends, and in the first and last gap, straight lines: a cubic needs a neighbour.
    inner = (base >= 1) & (base <= n - 3)
    linear = (points - r[base]) / gap[base]
    np.add.at(matrix, (rows[~inner], base[~inner]), 1.0 - linear[~inner])
    np.add.at(matrix, (rows[~inner], base[~inner] + 1), linear[~inner])
    at, base, t = rows[inner], base[inner], linear[inner]
    rising = t * t * (3.0 - 2.0 * t)
    np.add.at(matrix, (at, base), 1.0 - rising)
    np.add.at(matrix, (at, base + 1), rising)
    for middle, share in ((base, t * (1.0 - t) ** 2), (base + 1, -(t**2) * (1.0 - t))):
        before, after = gap[middle - 1], gap[middle]
        change = share * gap[base] / (before + after)
        outer, inwards = change * before / after, change * after / before
        np.add.at(matrix, (at, middle + 1), outer)
        np.add.at(matrix, (at, middle - 1), -inwards)
        np.add.at(matrix, (at, middle), inwards - outer)
    return matrix


def stall_angles(solution: Solution) -> tuple[Array, Array]:
    """Negative and positive stall angle [rad] about the blade's reference line, (elements, azimuths) each."""
    disk, design = solution.disk, solution.design
    lower, upper = np.zeros_like(disk.mach), np.zeros_like(disk.mach)
    if not design.models.stall:
        return lower - math.pi, upper + math.pi
    mach = disk.mach if design.models.compressibility else np.full_like(disk.mach, LOW_MACH)
    sections = _sections(
        design.rotor,
        tuple(disk.r.tolist()),
        design.reynolds_per_metre,
        delays=design.models.has("stall_delay"),
    )
    for section, rows, shares, knots in sections:
        negative, positive = _between_machs(knots, mach[rows])
        lower[rows] += shares * (negative + section.incidence_offset)
        upper[rows] += shares * (positive + section.incidence_offset)
    return lower, upper


def _between_machs(knots: Array, mach: Array) -> Array:
    """Stall angles at Mach numbers (elements, azimuths), linear between the knots, (2, elements, azimuths)."""
    last = knots.shape[2] - 1
    place = np.minimum(mach * last, last - 1e-9)
    cell = place.astype(np.int64)
    below = np.take_along_axis(knots, cell[:, None], axis=2)
    above = np.take_along_axis(knots, cell[:, None] + 1, axis=2)
    angles = below + (place - cell)[:, None] * (above - below)
    return angles.swapaxes(0, 1)


@lru_cache(maxsize=8)
def _sections(
    rotor: Rotor, r: tuple[float, ...], per_metre: float, *, delays: bool
) -> tuple[tuple[Section, Places, Array, Array], ...]:
    """Each section with the elements at r = y/R that have it, its share of each, (elements, 1), and its stall angles at
    the Mach numbers of its table, (elements, 2, Mach numbers); delays: whether rotation delays stall."""
    found: dict[Section, list[tuple[int, float]]] = {}
    gain: Array = np.zeros(len(r))
    for i, at in enumerate(r):
        parts = rotor.blade.mixture(at, per_metre)
        for section, share in parts:
            found.setdefault(section, []).append((i, share))
        if delays:
            gain[i] = delay_gain(chord_of(rotor, parts, at) / (at * rotor.radius))
    sections: list[tuple[Section, Places, Array, Array]] = []
    for section, of in found.items():
        rows = np.array([i for i, _ in of], np.int32)
        shares = np.array([[share] for _, share in of])
        sections.append((section, rows, shares, delayed_stall(section.table, gain[rows])))
    return tuple(sections)


def chord_of(rotor: Rotor, parts: Sequence[tuple[Section, float]], r: float) -> float:
    """The chord [m] at r = y/R of a blade whose sections there have these shares."""
    ratio = sum(share * section.chord_ratio for section, share in parts)
    return float(rotor.blade.chord(r)) * ratio


@_compile
def angles_of_attack(theta: Single, u_t: Single, u_p: Single) -> Single:
    """α = θ − atan2(U_P, U_T) [rad], not wrapped, in the shape of all three."""
    alpha = np.empty_like(theta)
    for i in range(theta.shape[0]):
        for j in range(theta.shape[1]):
            alpha[i, j] = theta[i, j] - arctangent(u_p[i, j], u_t[i, j])
    return alpha


class RefinedFlow:
    """What pictures read of the flow of a solution on a polar grid, (radii, azimuths) each; not to be written into.

    All but U_T is worked out when it is first read.
    """

    def __init__(self, solution: Solution, grid: PolarGrid) -> None:
        self._solution, self._grid, disk = solution, grid, solution.disk
        self._pitch, self.u_t, self._u_p = grid.refine_all(
            (disk.pitch_of_alpha, disk.u_t, disk.u_p)
        )
        """U_T/ΩR is negative in reverse flow."""

    @cached_property
    def alpha(self) -> Single:
        """Angle of attack [rad], from refined θ, U_T, U_P: these are smooth where α itself runs through ±180°.

        Not wrapped: only reverse flow, where it is not shown, goes beyond half a turn.
        """
        return angles_of_attack(self._pitch, self.u_t, self._u_p)

    @cached_property
    def limits(self) -> Single:
        """Negative and positive stall angle [rad], (2, radii, azimuths)."""
        return self._grid.refine_all(stall_angles(self._solution))

    @cached_property
    def attached(self) -> Single:
        """Negative where the flow is separated: the margin, or with dynamic stall how far f″ is above that of static
        stall."""
        unsteady = self._solution.disk.unsteady
        if unsteady is None:
            return self.margin
        return self._grid.refine_all((unsteady.separation,))[0] - np.float32(STALLED)

    @cached_property
    def past_static(self) -> Single | None:
        """Negative past the static stall angle where the flow is still attached; None for steady
        sections, where it never is.

        It is zero along the whole edge of that region, also where it ends at separated flow.
        """
        if self._solution.disk.unsteady is None:
            return None
        return np.maximum(self.margin, -self.attached)

    @cached_property
    def margin(self) -> Single:
        """Angle left before the static stall angle [rad]; negative past it.

        It falls by a radian within one element beside reverse flow; the stall angles do not.
        """
        lower, upper = self.limits
        return np.minimum(upper - self.alpha, self.alpha - lower)


class DrawnSolution:
    """A solution as one picture reads it: the field and the marked regions on it share its flow."""

    def __init__(self, solution: Solution) -> None:
        self.solution, self.disk, self.design = solution, solution.disk, solution.design
        self._flows = dict[PolarGrid, RefinedFlow]()

    def flow(self, grid: PolarGrid) -> RefinedFlow:
        if grid not in self._flows:
            self._flows[grid] = RefinedFlow(self.solution, grid)
        return self._flows[grid]


Bytes = NDArray[np.uint8]

_SLOPE_LIMIT = 0.5
"""Steeper slopes belong to stall and are cut off before smoothing."""
_SMOOTHING = (0.7, 1.2)
"""Smoothing of ∂C_d/∂M, in elements and azimuths: the table's slope jumps from cell to cell."""
CLEAR_OF_REVERSE = 0.055
"""U_T/ΩR below which only reverse flow is marked: there is no lift to lose."""
_DASHES = 96
_DASH_SHARE = 0.58
_DOTS = 160
_DOT_SHARE = 0.45


class MarkedRegion(IntEnum):
    NONE = 0
    SEPARATED = 1
    SEPARATED_RIM = 2
    DASH = 3
    REVERSE = 4
    REVERSE_RIM = 5


@dataclass(frozen=True)
class RegionMarks:
    stall: bool = True
    past_static: bool = True
    reverse_flow: bool = True
    drag_divergence: bool = True


ALL_MARKS, NO_MARKS = RegionMarks(), RegionMarks(False, False, False, False)


def region_codes(
    drawn: DrawnSolution, grid: PolarGrid, marks: RegionMarks, half_width: float
) -> Bytes | None:
    """A `MarkedRegion` for each polar point, shape (radii, azimuths); None where nothing is to be marked.

    `half_width`: of the lines, in radii.
    """
    if marks == NO_MARKS:
        return None
    flow = drawn.flow(grid)
    clear = flow.u_t > CLEAR_OF_REVERSE
    codes = np.zeros(flow.u_t.shape, dtype=np.uint8)

    def line(region: MarkedRegion, values: Single, where: Booleans, part: float) -> None:
        mark_line(codes, region.value, values, where, part * half_width, grid.r)

    if marks.past_static and flow.past_static is not None:
        line(MarkedRegion.SEPARATED_RIM, flow.past_static, clear & _dots(grid), 0.8)
    if marks.stall:
        attached = flow.attached
        mark_below(codes, MarkedRegion.SEPARATED.value, attached, clear)
        line(MarkedRegion.SEPARATED_RIM, attached, clear, 0.8)
    if marks.drag_divergence:
        line(MarkedRegion.DASH, divergence_margin(drawn, grid), clear & _dashes(grid), 1.0)
    if marks.reverse_flow:
        everywhere = np.ones_like(clear)
        mark_below(codes, MarkedRegion.REVERSE.value, flow.u_t, everywhere)
        line(MarkedRegion.REVERSE_RIM, flow.u_t, everywhere, 0.9)
    return codes


@lru_cache(maxsize=4)
def _dashes(grid: PolarGrid) -> Booleans:
    """Where a dashed line is drawn; not at the very tip."""
    return _broken(grid, _DASHES, _DASH_SHARE) & (grid.r[:, None] < 0.995)


@lru_cache(maxsize=4)
def _dots(grid: PolarGrid) -> Booleans:
    """Where a dotted line is drawn."""
    return _broken(grid, _DOTS, _DOT_SHARE)


def _broken(grid: PolarGrid, marks: int, share: float) -> Booleans:
    """Where a line of so many marks to a turn is drawn, also where it runs along a radius; share: of mark and gap."""
    phase = grid.psi * (marks / (2.0 * math.pi)) + 0.5 * marks / math.pi * grid.r[:, None]
    return phase % 1.0 < share


def divergence_margin(drawn: DrawnSolution, grid: PolarGrid) -> Single:
    """∂C_d/∂M less the value that marks drag divergence, smoothed on the solver's grid; positive beyond it where the
    flow is attached."""
    slope = filled(drawn.disk, np.clip(drawn.disk.cd_mach, -_SLOPE_LIMIT, _SLOPE_LIMIT))
    beyond = _smoothing(grid)([slope])[0] - np.float32(DRAG_DIVERGENCE)
    return np.minimum(beyond, drawn.flow(grid).attached)


def filled(disk: DiskFields, values: Array) -> Array:
    """`values` with the reverse-flow part of each azimuth replaced by its first element outside.

    A quantity that jumps across the reverse-flow circle can then be interpolated up to the circle from outside.
    """
    reverse = disk.u_t < 0.0
    # Reverse flow fills the inner part of an azimuth; beyond the tip of a column that is reversed throughout, the last.
    first_outside = np.minimum(reverse.sum(axis=0), len(disk.r) - 1)
    return np.where(reverse, values[first_outside, np.arange(values.shape[1])], values)


@lru_cache(maxsize=4)
def _smoothing(grid: PolarGrid) -> WeightedSums:
    """Smoothing on the solver's grid and interpolation in one."""
    along, around = _SMOOTHING
    rows = ndimage.gaussian_filter1d(
        np.eye(grid.along.shape[1]), along, axis=0, mode="nearest", truncate=3.0
    )
    columns = ndimage.gaussian_filter1d(
        np.eye(grid.around.shape[0]), around, axis=1, mode="wrap", truncate=3.0
    )
    return WeightedSums(grid.along @ rows, columns @ grid.around, np.float32)


@_compile
def mark_below(codes: Bytes, code: int, values: Single, where: Booleans) -> None:
    for i in range(values.shape[0]):
        for j in range(values.shape[1]):
            if where[i, j] and values[i, j] < 0.0:
                codes[i, j] = code


@_compile
def mark_line(
    codes: Bytes, code: int, values: Single, where: Booleans, half_width: float, r: Array
) -> None:
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
                # With no reach, the line is as wide as the points are apart.
                if reach == 0 or abs(values[i, j]) < half_width * math.hypot(along, around):
                    codes[i, j] = code
