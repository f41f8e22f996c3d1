"""The disk as a plan for the page: field, outlines of regions, shares and values under the pointer, as JSON."""

import base64
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from explorer.colours import VOID, colour_map
from explorer.model.inputs import ViewState
from explorer.model.units import UNITS, number
from explorer.parts.stage import PackedTable, PlanDisk, PlanPart, PlanRegion, StationValues
from explorer.picture.disk_image import sides
from explorer.picture.disk_numbers import disk_numbers
from explorer.picture.fields import Field
from explorer.picture.polar import (
    DrawnSolution,
    PolarGrid,
    RefinedFlow,
    Single,
    divergence_margin,
    polar_grid,
    stall_angles,
)
from rotor import Solution
from rotor.aero.display import STALLED, Regions
from rotor.support.arrays import Array
from rotor.support.chart import AZIMUTH, Axis, Chart, drawn_chart

_OUTLINED = 80, 240
"""Radii and azimuths between which an outline is looked for."""


def to_plane(r: Array, psi: Array) -> Array:
    """Points (x aft, y starboard) in radii, shape (..., 2)."""
    return np.stack((r * np.cos(psi), r * np.sin(psi)), axis=-1)


def reverse_flow_segments(solution: Solution) -> Array:
    """The circle of reverse flow r = −µ sin ψ outside the root cut-out, with µ along the disk; (n, 2, 2), in radii."""
    mu = _advance_ratio_along_disk(solution)
    if mu <= 0.0:
        return np.zeros((0, 2, 2))
    psi = np.linspace(math.pi, 2.0 * math.pi, 181)
    r = -mu * np.sin(psi)
    points = to_plane(r, psi)
    cutout = solution.design.rotor.blade.root_cutout
    keep = (r[:-1] >= cutout) & (r[1:] >= cutout)
    return np.stack((points[:-1], points[1:]), axis=1)[keep]


def separated_segments(solution: Solution) -> Array:
    """The edge of separated flow at positive or negative angles of attack, reverse flow left out; (n, 2, 2), in radii.

    That is the stall angle, or with dynamic stall the separation point of static stall.
    """
    grid = polar_grid(solution.disk, *_OUTLINED)
    margin = RefinedFlow(solution, grid).attached
    return _outside_reverse_flow(contour(grid, margin.astype(np.float64), 0.0), solution, 0.0)


def past_static_segments(solution: Solution) -> Array:
    """The edge of the region past the static stall angle with the flow still attached; (n, 2, 2), in radii.

    Reverse flow is left out. Steady sections have none.
    """
    grid = polar_grid(solution.disk, *_OUTLINED)
    past = RefinedFlow(solution, grid).past_static
    if past is None:
        return np.zeros((0, 2, 2))
    return _outside_reverse_flow(contour(grid, past.astype(np.float64), 0.0), solution, 0.0)


def drag_divergence_segments(solution: Solution) -> Array:
    """The edge of drag divergence, reverse flow left out; (n, 2, 2), in radii."""
    disk = solution.disk
    grid = polar_grid(disk, *_OUTLINED)
    slope = divergence_margin(DrawnSolution(solution), grid).astype(np.float64)
    # An element and a half clear of reverse flow: nearer, the line would only trace the elements' steps.
    return _outside_reverse_flow(contour(grid, slope, 0.0), solution, 1.5)


def _outside_reverse_flow(segments: Array, solution: Solution, elements: float) -> Array:
    """Segments that are some elements' widths clear of the reverse-flow circle."""
    mu = _advance_ratio_along_disk(solution)
    if mu <= 0.0:
        return segments
    middle = segments.mean(axis=1)
    r = np.hypot(*middle.T)
    psi = np.arctan2(middle[:, 1], middle[:, 0])
    clearance = elements * np.interp(r, solution.disk.r, solution.disk.dr)
    return segments[r + mu * np.sin(psi) > clearance]


def _advance_ratio_along_disk(solution: Solution) -> float:
    """µ of the velocity along the disk, which its tilt makes smaller."""
    return solution.design.condition.advance_ratio * math.cos(solution.controls.shaft_tilt)


def contour(grid: PolarGrid, values: Array, level: float) -> Array:
    """Where polar `values` cross `level`, round the turn; segments of shape (n, 2, 2), in radii."""
    around = np.concatenate((values, values[:, :1]), axis=1)
    polar = crossings(grid.r, np.append(grid.psi, 2.0 * math.pi + grid.psi[0]), around - level)
    return to_plane(polar[:, :, 0], polar[:, :, 1])


def crossings(x: Array, y: Array, above: Array) -> Array:
    """Where values of shape (x, y) change their sign, by marching squares: segments of shape (n, 2, 2).

    Not in cells with a corner that is NaN.
    """
    corners = (above[:-1, :-1], above[1:, :-1], above[1:, 1:], above[:-1, 1:])
    positive = np.stack([corner > 0.0 for corner in corners])
    known = np.isfinite(corners).all(axis=0)
    row, column = np.nonzero(positive.any(axis=0) & ~positive.all(axis=0) & known)
    value = [corner[row, column] for corner in corners]
    places = [
        np.stack((x[row + (k in (1, 2))], y[column + (k in (2, 3))]), axis=-1) for k in range(4)
    ]
    # The point at which each of a cell's four sides is crossed; a cell has two such sides, a saddle four.
    sides = [(0, 1), (1, 2), (2, 3), (3, 0)]
    points = np.full((len(row), 4, 2), np.nan)
    for side, (a, b) in enumerate(sides):
        cut = (value[a] > 0.0) != (value[b] > 0.0)
        t = (value[a][cut] / (value[a][cut] - value[b][cut]))[:, None]
        points[cut, side] = (1.0 - t) * places[a][cut] + t * places[b][cut]
    is_cut = ~np.isnan(points[:, :, 0])
    order = np.argsort(~is_cut, axis=1, kind="stable")
    ordered = np.take_along_axis(points, order[:, :, None], axis=1)
    saddle = is_cut.sum(axis=1) == 4
    return np.concatenate((ordered[:, :2], ordered[saddle, 2:]))


def joined_lines(segments: Array) -> list[Array]:
    """Segments (n, 2, 2) joined to lines where they share an end."""
    keys = [tuple(map(tuple, np.rint(segment / 1e-6).astype(int))) for segment in segments]
    at: dict[tuple[int, ...], list[int]] = {}
    for k, ends in enumerate(keys):
        for end in ends:
            at.setdefault(end, []).append(k)
    left, lines = set(range(len(keys))), []
    for first in range(len(keys)):
        if first not in left:
            continue
        left.discard(first)
        line = [segments[first][0], segments[first][1]]
        for forward in (True, False):
            end = keys[first][1 if forward else 0]
            joined = _first_left(at[end], left)
            while joined is not None:
                left.discard(joined)
                ahead = 1 if keys[joined][0] == end else 0
                end = keys[joined][ahead]
                line.insert(len(line) if forward else 0, segments[joined][ahead])
                joined = _first_left(at[end], left)
        lines.append(np.array(line))
    return lines


def _first_left(candidates: list[int], left: set[int]) -> int | None:
    """The first of the segments at an end that is in no line yet; None where there is none."""
    return next((k for k in candidates if k in left), None)


_RADII, _AZIMUTHS = 40, 120
"""Points of the field under the pointer."""


@dataclass(frozen=True)
class Region:
    """A region of the disk: title, outline, and its parts of disk and thrust."""

    title: str
    outline: Callable[[Solution], Array]
    """Segments (n, 2, 2), in radii."""
    share: Callable[[Regions], tuple[float, float]]
    """Parts of the disk πR² and of the thrust."""


REGIONS = {
    "stall": Region(
        "Separated",
        separated_segments,
        lambda of: (of.separated, of.separated_thrust),
    ),
    "past_static": Region(
        "Past static",
        past_static_segments,
        lambda of: (of.past_static, of.past_static_thrust),
    ),
    "reverse_flow": Region(
        "Reverse flow",
        reverse_flow_segments,
        lambda of: (of.reverse_flow, of.reverse_flow_thrust),
    ),
    "drag_divergence": Region(
        "Drag divergence",
        drag_divergence_segments,
        lambda of: (of.drag_divergence, of.drag_divergence_thrust),
    ),
}
"""By the switch of `ViewState` that shows it."""


def plan(
    solution: Solution,
    view: ViewState,
    field: Field,
    colour_range: tuple[float, float],
    at_rest: bool,
    pinned: Solution | None = None,
) -> PlanPart:
    """The page's plan of the disk, with outlines of A where it is pinned.

    It has the values under the pointer only when `at_rest`.
    """
    airspeed = solution.design.airspeed
    values = before = coloured = wiped = None
    if at_rest:
        grid = polar_grid(solution.disk, _RADII, _AZIMUTHS)
        values = _values(solution)
        coloured = packed(field.sample(DrawnSolution(solution), grid))
        if pinned is not None:
            before = _values(pinned)
    if view.wipe and pinned is not None:
        wiped = _disk(pinned, field, colour_range)
    return PlanPart(
        disk=_disk(solution, field, colour_range),
        root=round(solution.design.rotor.blade.root_cutout, 4),
        blades=solution.design.rotor.blades,
        field=field.title,
        unit=field.unit,
        regions=_regions(solution, view, pinned),
        sides=sides(solution.design),
        flight=UNITS[view.units].speed[0].text(airspeed) if airspeed else "",
        around=drawn_chart(around_chart(solution)),
        mu=round(_advance_ratio_along_disk(solution), 4),
        values=values,
        before=before,
        coloured=coloured,
        wiped=wiped,
    )


def _disk(solution: Solution, field: Field, colour_range: tuple[float, float]) -> PlanDisk:
    """The coloured disk of a field."""
    numbers = disk_numbers(solution, field, colour_range)
    radii, azimuths, *_ = numbers["grid"]
    values, flow, *_ = numbers["texts"]
    colours = colour_map(field.colours, 256).tobytes().hex(), bytes(VOID).hex()
    return PlanDisk(radii, azimuths, values, flow if field.void_in_reverse_flow else None, *colours)


def around_chart(solution: Solution) -> Chart:
    """The axes of the angle of attack over azimuth, the same for each radius; the page draws its lines into them."""
    flow = solution.disk.u_t > 0.0
    alpha = np.degrees(solution.disk.alpha[flow])
    low, high = (float(alpha.min()), float(alpha.max())) if len(alpha) else (0.0, 0.0)
    ends = min(-2.0, max(-10.0, low)), max(16.0, min(30.0, high))
    return Chart(
        "Angle of attack over azimuth",
        Axis("ψ", (0.0, 360.0), AZIMUTH, unit="°"),
        Axis("°", ends, unit="°"),
        (),
    )


def _regions(solution: Solution, view: ViewState, pinned: Solution | None) -> list[PlanRegion]:
    """The regions that are shown, those apart that neither the disk nor A has."""
    shown = list[PlanRegion]()
    for name, region in REGIONS.items():
        if not getattr(view, name):
            continue
        lines = outline(region.outline(solution))
        before = [] if pinned is None else outline(region.outline(pinned))
        if not lines and not before:
            continue
        shown.append(PlanRegion(name, region.title, region_words(solution, name), lines, before))
    return shown


def region_words(solution: Solution, name: str) -> str:
    """The parts of the disk and of the thrust in a region: `1.4 % area · −0.1 % thrust`."""
    area, thrust = REGIONS[name].share(solution.regions)
    return f"{number(100.0 * area, 1)} % area · {number(100.0 * thrust, 1)} % thrust"


def outline(segments: Array) -> list[list[list[float]]]:
    """Segments (aft, starboard) as polylines (right, down), in radii."""
    if not len(segments):
        return []
    return [np.round(line[:, ::-1], 3).tolist() for line in joined_lines(segments)]


def _values(solution: Solution) -> StationValues:
    """Angles [°], velocities over ΩR, and coefficients, as `probe` reads them; in unsteady flow also how far the
    separation point is above that of static stall [chords]."""
    disk = solution.disk
    ahead = disk.pitch_of_alpha - disk.theta
    lower, upper = stall_angles(solution)
    angles = {"theta": disk.theta, "ahead": ahead, "lower": lower, "upper": upper}
    tables = {name: np.degrees(each) for name, each in angles.items()}
    tables |= {"u_t": disk.u_t, "u_p": disk.u_p, "mach": disk.mach, "cl": disk.cl}
    if disk.unsteady is not None:
        tables["attached"] = disk.unsteady.separation - STALLED
    steps = {name: packed(np.broadcast_to(each, disk.mach.shape)) for name, each in tables.items()}
    return StationValues(
        [round(r, 6) for r in disk.r.tolist()], round(math.degrees(disk.psi[0]), 6), steps
    )


def packed(values: Array | Single) -> PackedTable:
    """A table as 16-bit steps between its least and its greatest value."""
    low, high = float(values.min()), float(values.max())
    step = max(high - low, 1e-9) / 65535.0
    steps = np.rint((values - low) / step).astype("<u2")
    return PackedTable(low, step, base64.b64encode(steps.tobytes()).decode())
