"""The disk as a plan for the page: picture, outlines, shares and the values under the pointer, ready for JSON."""

import base64
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from explorer.model.inputs import ViewState
from explorer.model.units import number
from explorer.picture.disk_image import half_width
from explorer.picture.fields import FIELDS, Field
from explorer.picture.outlines import (
    drag_divergence_segments,
    joined,
    negative_stall_segments,
    positive_stall_segments,
    reverse_flow_segments,
)
from explorer.picture.picture import disk_png
from explorer.picture.polar import Single, polar_grid, refined
from explorer.picture.regions import region_masks
from rotor.arrays import Array
from rotor.trim.solution import Solution

_RADII, _AZIMUTHS = 40, 120
"""Points of the values under the pointer."""
_FINE = 120, 480
"""Points at which shares of area and lift are summed."""
_REGIONS: dict[str, tuple[str, str, Callable[[Solution], Array]]] = {
    "stall": ("Stall", "stall", positive_stall_segments),
    "negative_stall": ("Negative stall", "stall", negative_stall_segments),
    "reverse_flow": ("Reverse flow", "reverse_flow", reverse_flow_segments),
    "drag_divergence": ("Drag divergence", "drag_divergence", drag_divergence_segments),
}
"""Title, switch in `ViewState`, and outline of each region."""
_READ = {"alpha": "Angle of attack", "mach": "Mach number", "cl": "Lift coefficient"}
"""What is read under the pointer in every field, by the name it has in the page."""


def plan(
    solution: Solution,
    view: ViewState,
    field: Field,
    colour_range: tuple[float, float],
    pixels: int,
    at_rest: bool,
    pinned: Solution | None = None,
) -> dict[str, Any]:
    """Everything that the page's plan of the disk is drawn from.

    `picture`: a PNG of `pixels` along each edge, which reaches to `reach` radii. `regions`: title, outline in radii
    (right, down), shares of disk and thrust, and the outline for A. `values`: tables of shape (radii, azimuths) for
    the pointer, only when `at_rest`; `psi` of their columns begins at zero, `r` of their rows goes from `root` to 1.
    """
    content: dict[str, Any] = {
        "picture": base64.b64encode(disk_png(solution, field, colour_range, size=pixels)).decode(),
        "reach": round(half_width(1.0, pixels), 4),
        "root": round(solution.design.rotor.blade.root_cutout, 4),
        "blades": solution.design.rotor.blades,
        "field": field.title,
        "unit": field.unit,
        "regions": _regions(solution, view, pinned),
        "flight": solution.design.airspeed > 0.0,
        "mu": round(solution.design.condition.advance_ratio * math.cos(solution.controls.shaft_tilt), 4),
    }
    if at_rest:
        content["values"] = _values(solution, field)
        if pinned is not None:
            content["alpha_a"] = _packed(
                FIELDS[_READ["alpha"]].sample(pinned, polar_grid(pinned.disk, _RADII, _AZIMUTHS))
            )
    return content


def _regions(solution: Solution, view: ViewState, pinned: Solution | None) -> list[dict[str, Any]]:
    shares = region_shares(solution)
    found: list[dict[str, Any]] = []
    for name, (title, switch, segments) in _REGIONS.items():
        lines = _lines(segments(solution)) if getattr(view, switch) else []
        before = _lines(segments(pinned)) if pinned is not None and getattr(view, switch) else []
        if not lines and not before:
            continue
        area, thrust = shares[name]
        found.append(
            {
                "name": name,
                "title": title,
                "words": f"{number(100.0 * area, 1)} % area · {number(100.0 * thrust, 1)} % thrust",
                "lines": lines,
                "before": before,
            }
        )
    return found


def region_shares(solution: Solution) -> dict[str, tuple[float, float]]:
    """Parts of the disk πR² and of the thrust in each region, by name. Thrust may be negative there."""
    grid = polar_grid(solution.disk, *_FINE)
    thrust = grid.refine(solution.disk.dct)
    area = np.broadcast_to(grid.r[:, None], thrust.shape)
    rings, steps = (grid.r[1] - grid.r[0]), 2.0 * math.pi / len(grid.psi)
    total = float(np.sum(thrust))
    return {
        name: (float(np.sum(area[inside])) * rings * steps / math.pi, float(np.sum(thrust[inside])) / total)
        for name, inside in region_masks(solution, grid).items()
    }


def _lines(segments: Array) -> list[list[list[float]]]:
    """Segments (aft, starboard) as polylines (right, down), in radii."""
    if not len(segments):
        return []
    return [np.round(line[:, ::-1], 3).tolist() for line in joined(segments)]


def _values(solution: Solution, field: Field) -> dict[str, dict[str, Any]]:
    grid = polar_grid(solution.disk, _RADII, _AZIMUTHS)
    tables = {name: FIELDS[title].sample(solution, grid) for name, title in _READ.items()}
    flow = refined(solution, grid)
    tables |= {"lower": np.degrees(flow.lower), "upper": np.degrees(flow.upper), "field": field.sample(solution, grid)}
    return {name: _packed(values) for name, values in tables.items()}


def _packed(values: Array | Single) -> dict[str, Any]:
    """A table as 16-bit steps between its least and its greatest value, little-endian in base 64."""
    low, high = float(values.min()), float(values.max())
    step = max(high - low, 1e-9) / 65535.0
    steps = np.rint((values - low) / step).astype("<u2")
    return {"low": low, "step": step, "data": base64.b64encode(steps.tobytes()).decode()}
