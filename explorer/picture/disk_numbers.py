"""The field on the disk and the margins of its marked regions as numbers; the page colours them by `disk.js`.

A text holds numbers 0…255, row by row: each as its difference from the one before, of which the small ones are low
characters, so that what compresses the messages makes a quarter of it.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from explorer.colours import VOID, DiskInk, Scheme, colour_map, greyed
from explorer.picture.disk_image import half_width
from explorer.picture.fields import Field
from explorer.picture.polar import (
    CLEAR_OF_REVERSE,
    NO_MARKS,
    DrawnSolution,
    RegionMarks,
    divergence_margin,
    polar_grid,
)
from rotor import Solution

_GRID = 72, 240
"""Radii and azimuths: three to an element, two to a step of the solver. In between the page interpolates."""
_ZERO, _MOST = 128, 127
"""What stands for a margin of zero, and what is added for the largest that is told apart."""
_LIMITS = {"u_t": 0.1, "attached": 0.1, "diverging": 0.05}
"""The largest margins that are told apart: U_T/ΩR, [rad] or f\u2033, ∂C_d/∂M."""


def disk_numbers(
    solution: Solution,
    field: Field,
    colour_range: tuple[float, float],
    marks: RegionMarks = NO_MARKS,
) -> dict[str, Any]:
    """What the page draws a disk from: 1…255 over the colour range, 0 where the field does not exist; margins."""
    grid = polar_grid(solution.disk, *_GRID)
    drawn, (low, high) = DrawnSolution(solution), colour_range
    flow = drawn.flow(grid)
    values = 1.0 + 254.0 * np.clip((field.sample(drawn, grid) - low) / (high - low), 0.0, 1.0)
    past_static = flow.past_static if marks.past_static else None
    absent = None if field.absent is None else field.absent(drawn, grid)
    if not field.exists(drawn):
        absent = np.ones(grid.shape, dtype=bool)
    if absent is not None:
        values[absent] = 0.0
    return {
        "grid": [*grid.shape, round(float(grid.r[0]), 6), half_width(1.0)],
        "clear": _ZERO + _MOST * CLEAR_OF_REVERSE / _LIMITS["u_t"],
        "void": field.void_in_reverse_flow,
        "absent": absent is not None,
        "reverse": marks.reverse_flow,
        "texts": [
            _text(values),
            _margin("u_t", flow.u_t),
            _margin("attached", flow.attached) if marks.stall else None,
            _margin("diverging", divergence_margin(drawn, grid)) if marks.drag_divergence else None,
        ],
        "past": _margin("attached", past_static) if past_static is not None else None,
    }


def _margin(name: str, values: NDArray[np.float32]) -> str:
    return _text(_ZERO + np.clip(values * (_MOST / _LIMITS[name]), -_MOST, _MOST))


def _text(numbers: NDArray[Any]) -> str:
    steps = (
        np.diff(np.rint(numbers).astype(np.uint8).ravel(), prepend=np.uint8(0))
        .view(np.int8)
        .astype(np.int16)
    )
    # 0, −1, 1, −2, … from the first character that no string needs to escape, but for one.
    return (
        (ord("#") + np.where(steps < 0, -2 * steps - 1, 2 * steps))
        .astype("<u2")
        .tobytes()
        .decode("utf-16-le")
    )


def disk_ink(scheme: Scheme, ink: DiskInk, faded: bool) -> dict[str, Any]:
    """Colours of the disk: of the field from low to high as hexadecimal digits, and of what is marked on it.

    `faded`: of a solution that no longer holds.
    """
    colours = colour_map(scheme, 256)
    marked = ink.stall, ink.reverse_flow, ink.reverse_flow_rim, ink.drag_divergence, VOID
    return {
        "map": (greyed(colours) if faded else colours).tobytes().hex(),
        "marked": [[channel / 255 for channel in colour] for colour in marked],
        "opacity": [ink.opacity, 0.55 if faded else 1.0],
    }
