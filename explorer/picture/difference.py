"""B − A over the disk as a field of its own: both answers on one polar grid, void where either has none."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from explorer.picture.fields import FIELDS, Field, round_up
from explorer.picture.polar import PolarGrid, polar_grid
from explorer.state import ViewState
from rotor.arrays import Array
from rotor.trim.solution import Solution

_PART = 0.1
"""Of a field's own range, to either side, that a difference is first shown over."""
_NAMES = ("Mach", "M²")
"""What begins a title and stays capital within one."""


def shown_field(view: ViewState, pinned: Solution | None) -> Field:
    """The field that the disk shows: as it is, or B − A once a design is pinned and the difference wanted."""
    field = FIELDS[view.field]
    return difference(field, pinned) if view.difference and pinned is not None else field


def difference(field: Field, pinned: Solution) -> Field:
    """`field` of a solution minus that of the pinned one, centred on zero."""

    def sample(solution: Solution, grid: PolarGrid) -> Array:
        if not pinned.converged:
            return np.zeros((len(grid.r), len(grid.psi)))
        return field.sample(solution, grid) - field.sample(pinned, _over(pinned, grid))

    def absent(solution: Solution, grid: PolarGrid) -> NDArray[np.bool_]:
        del solution
        return _absent(field, pinned, grid)

    name = field.title if field.title.startswith(_NAMES) else field.title[0].lower() + field.title[1:]
    half = round_up(_PART * (field.high - field.low))
    return replace(
        field,
        title=f"Δ {name}",
        low=-half,
        high=half,
        colours="margin" if field.colours == "margin" else "diverging",
        sample=sample,
        absent=absent,
        note=", B − A",
    )


def _absent(field: Field, pinned: Solution, grid: PolarGrid) -> NDArray[np.bool_]:
    """Where A has no such quantity, on B's grid: beyond its blade, in its reverse flow, everywhere without a trim."""
    if not pinned.converged:
        return np.ones((len(grid.r), len(grid.psi)), dtype=bool)
    disk = pinned.disk
    margin = 1e-9 + 0.5 * disk.dr
    beyond = (grid.r < disk.r[0] - margin) | (grid.r > disk.r[-1] + margin)
    void = field.void(pinned, _over(pinned, grid))
    beyond = np.repeat(beyond[:, None], len(grid.psi), axis=1)
    return beyond if void is None else beyond | void


def _over(pinned: Solution, grid: PolarGrid) -> PolarGrid:
    """B's points, interpolated from A's elements and azimuths, which may be others."""
    return polar_grid(pinned.disk, len(grid.r), len(grid.psi), (float(grid.r[0]), float(grid.r[-1])))
