"""Look-up of section data at every azimuth of a row of blade elements: cells of the tables and their polynomials.

A cell's bicubic polynomial Σ a_kl u^k v^l has its sixteen coefficients side by side, the four of u^k in a row.
"""

import math
from typing import Any

import numpy as np

from rotor.airfoil.section_table import ALPHA_STEP, MACH_STEP, N_ALPHA, N_MACH
from rotor.support.compiled import compiled

_PI = math.pi
INVERSE_ALPHA = 1.0 / ALPHA_STEP
INVERSE_MACH = 1.0 / MACH_STEP

_compile = compiled(error_model="numpy")


@_compile
def wrapped(angle: float) -> float:
    """The angle in [−π, π) [rad]."""
    return angle - 2.0 * _PI * math.floor((angle + _PI) * (0.5 / _PI))


@_compile
def places_along_alpha(alpha: Any, offset: float, cell: Any, place: Any) -> None:
    """Cells of the table and the places in them, from 0 to 1, of one row about the section's own chord."""
    for j in range(len(alpha)):
        x = (wrapped(alpha[j] - offset) + _PI) * INVERSE_ALPHA
        # Never outside, also where α is not a number.
        i = max(min(np.int32(x), np.int32(N_ALPHA - 1)), np.int32(0))
        cell[j] = i
        place[j] = x - i


@_compile
def places_along_mach(mach: Any, cell: Any, place: Any, slope: Any) -> None:
    """Places along Mach, and ∂place/∂M: 0 beyond the table, where section data are constant; there is a caveat."""
    for j in range(len(mach)):
        y = min(mach[j] * INVERSE_MACH, N_MACH - 1e-9)
        i = max(min(np.int32(y), np.int32(N_MACH - 1)), np.int32(0))
        cell[j] = i
        place[j] = y - i
        slope[j] = INVERSE_MACH if mach[j] * INVERSE_MACH < N_MACH else 0.0


@_compile
def surface(a: Any, u: float, v: float) -> tuple[float, float, float]:
    """The polynomial of a cell, (4, 4) coefficients, and its slopes by u and v."""
    c0 = ((a[3, 0] * u + a[2, 0]) * u + a[1, 0]) * u + a[0, 0]
    c1 = ((a[3, 1] * u + a[2, 1]) * u + a[1, 1]) * u + a[0, 1]
    c2 = ((a[3, 2] * u + a[2, 2]) * u + a[1, 2]) * u + a[0, 2]
    c3 = ((a[3, 3] * u + a[2, 3]) * u + a[1, 3]) * u + a[0, 3]
    s0 = (3.0 * a[3, 0] * u + 2.0 * a[2, 0]) * u + a[1, 0]
    s1 = (3.0 * a[3, 1] * u + 2.0 * a[2, 1]) * u + a[1, 1]
    s2 = (3.0 * a[3, 2] * u + 2.0 * a[2, 2]) * u + a[1, 2]
    s3 = (3.0 * a[3, 3] * u + 2.0 * a[2, 3]) * u + a[1, 3]
    return (
        ((c3 * v + c2) * v + c1) * v + c0,
        ((s3 * v + s2) * v + s1) * v + s0,
        (3.0 * c3 * v + 2.0 * c2) * v + c1,
    )


@_compile
def _blend(out: Any, row: int, j: int, share: float, value: float) -> None:
    out[row, j] = value if share == 1.0 else out[row, j] + share * (value - out[row, j])


@_compile
def look_up(
    tables: Any,
    kinds: Any,
    which: int,
    cells: Any,
    places: Any,
    share: float,
    slopes: bool,
    out: Any,
    row: int,
) -> None:
    """Blend coefficients kinds[0] to before kinds[1] of a section, with slopes by α [rad] and Mach, from out[row] on.

    tables: (sections, α cells, Mach cells, coefficients, 4, 4). cells, places: along α, then along Mach; the third row
    of places is ∂place/∂M. share: of this section, 1 for the first of two. Slopes only where they are asked for.
    """
    for k in range(*kinds):
        at = row + 3 * (k - kinds[0])
        if slopes:
            for j in range(places.shape[1]):
                value, by_u, by_v = surface(
                    tables[which, cells[0, j], cells[1, j], k], places[0, j], places[1, j]
                )
                _blend(out, at, j, share, value)
                _blend(out, at + 1, j, share, by_u * INVERSE_ALPHA)
                _blend(out, at + 2, j, share, by_v * places[2, j])
        else:
            for j in range(places.shape[1]):
                value, _, _ = surface(
                    tables[which, cells[0, j], cells[1, j], k], places[0, j], places[1, j]
                )
                _blend(out, at, j, share, value)
