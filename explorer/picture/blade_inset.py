"""The blade seen end-on: its true sections at eight stations, a ghost behind them, and the angles, as numbers."""

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from explorer.picture.blade_mesh import section_ring
from rotor.design.blade import Rotor
from rotor.design.twist import REFERENCE_RADIUS, TwistLaw

_SPANWISE = (0.01, 0.16, 0.31, 0.46, 0.61, 0.76, 0.905, 1.0)
"""Places of the sections from root cut-out to tip: one before the bend of the UH-60A's tip, one at its end."""
_EDGE_POINTS = 40
_OUTLINE_POINTS = 25


def inset(rotor: Rotor, twist: TwistLaw, ghost: TwistLaw | None, exaggeration: float) -> dict[str, Any]:
    """Everything the page's inset is drawn from, ready for JSON; about 4 kB.

    `r`: stations along the edges; `theta` and `ghost`: true twist there [°], the latter None without a ghost.
    `datum` and `ghost_datum`: that at 0.75 R, about which it is exaggerated.
    `cuts`: eight sections, each with `r`, `outline` (points [forward, up] about the quarter chord, in reference
    chords), `theta` and `ghost` [°]. `times`: the exaggeration to draw the angles with.
    """
    r, cuts = _places(rotor)
    places = np.concatenate((r, cuts, [REFERENCE_RADIUS]))
    *angles, datum = _degrees(twist, places)
    behind = None if ghost is None else _degrees(ghost, places)
    other = [None] * len(cuts) if behind is None else behind[len(r) : -1]
    return {
        "times": exaggeration,
        "r": [round(float(at), 4) for at in r],
        "datum": datum,
        "ghost_datum": 0.0 if behind is None else behind[-1],
        "theta": angles[: len(r)],
        "ghost": None if behind is None else behind[: len(r)],
        "cuts": [
            {"r": float(at), "outline": outline, "theta": angle, "ghost": before}
            for at, outline, angle, before in zip(cuts, _outlines(rotor), angles[len(r) :], other, strict=True)
        ],
    }


def _places(rotor: Rotor) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """r/R along the edges, and of the sections."""
    cutout = rotor.blade.root_cutout
    return np.linspace(cutout, 1.0, _EDGE_POINTS), np.round(cutout + (1.0 - cutout) * np.array(_SPANWISE), 2)


@lru_cache(maxsize=4)
def _outlines(rotor: Rotor) -> tuple[list[list[float]], ...]:
    chord = rotor.reference_chord
    rings = [section_ring(rotor, float(r), _OUTLINE_POINTS) / chord for r in _places(rotor)[1]]
    return tuple(np.round(ring, 3).tolist() for ring in rings)


def _degrees(twist: TwistLaw, r: NDArray[np.float64]) -> list[float]:
    return [round(float(angle), 2) for angle in np.degrees(twist(r))]
