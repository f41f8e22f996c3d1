"""Foreign decks on the run-time grid: its half-degree angles, its Machs in steps of 0.05, the whole circle.

Decks of other codes have knots where they like, and some end at stall. Values between knots are taken along PCHIP
curves, as `bicubic` does between its own; angles that are missing are filled by the closed form of `wrap`.
"""

import numpy as np
from scipy.interpolate import PchipInterpolator

from rotor.airfoil.bicubic import MACH_STEP, N_MACH
from rotor.airfoil.c81 import C81Block, C81Deck
from rotor.airfoil.wrap import BLEND_END_DEG, BLEND_START_DEG, wrap_coefficients
from rotor.arrays import Array

_LEAST_RANGE_DEG = 8.0
"""A deck must at least cover −8…8°: what lies inside no formula can guess."""


def on_run_time_grid(deck: C81Deck) -> C81Deck:
    """The deck with lift and drag on the run-time grid over ±180°; the same values where its knots already fit.

    Raises ValueError with one sentence for a deck that covers too little.
    """
    return C81Deck(deck.title, _block(deck.title, deck.cl, 0), _block(deck.title, deck.cd, 1), deck.cm)


def _block(title: str, block: C81Block, kind: int) -> C81Block:
    alpha, mach, values = block.alpha_deg, block.mach, block.values
    if alpha[0] > -_LEAST_RANGE_DEG or alpha[-1] < _LEAST_RANGE_DEG:
        raise ValueError(
            f"{title}: {'cl' if kind == 0 else 'cd'} covers {alpha[0]:g}…{alpha[-1]:g} deg: "
            f"give at least −{_LEAST_RANGE_DEG:g}…{_LEAST_RANGE_DEG:g} deg"
        )
    if mach[0] < 0.0 or mach[-1] > 1.5 or alpha[0] < -180.0 - 1e-9 or alpha[-1] > 180.0 + 1e-9:
        raise ValueError(
            f"{title}: angles {alpha[0]:g}…{alpha[-1]:g} deg at Mach {mach[0]:g}…{mach[-1]:g}: "
            "keep angles within ±180 deg and Mach within 0…1.5"
        )
    on_angles = np.all(np.abs(alpha * 2.0 - np.round(alpha * 2.0)) < 1e-9)
    closed = abs(alpha[0] + 180.0) < 1e-9 and abs(alpha[-1] - 180.0) < 1e-9
    if not (on_angles and closed):
        alpha, values = _whole_circle(alpha, values, kind)
    ends = 0.5 * (values[0] + values[-1])
    values = np.concatenate((ends[None], values[1:-1], ends[None]))
    steps = mach / MACH_STEP
    if np.any(np.abs(steps - np.round(steps)) > 1e-9) or mach[-1] > 1.0 + 1e-9:
        grid = MACH_STEP * np.arange(
            round(mach[0] / MACH_STEP + 0.499), min(int(mach[-1] / MACH_STEP + 1e-9), N_MACH) + 1
        )
        if len(grid) < 2:
            raise ValueError(f"{title}: Mach {mach[0]:g}…{mach[-1]:g} covers too little: give at least 0.1 of Mach")
        values = np.asarray(PchipInterpolator(mach, values, axis=1)(grid))
        mach = grid.astype(np.float64)
    return C81Block(mach, alpha, values)


def _whole_circle(alpha: Array, values: Array, kind: int) -> tuple[Array, Array]:
    """Values at every half degree: the deck within its angles, faded into the closed form beyond them."""
    nodes = np.linspace(-180.0, 180.0, 721)
    curve = PchipInterpolator(alpha, values, axis=0)
    own = np.asarray(curve(np.clip(nodes, alpha[0], alpha[-1])), dtype=np.float64)
    edge = np.where(nodes < 0.0, float(-alpha[0]), float(alpha[-1])).astype(np.float64)
    fade = np.maximum(edge + BLEND_END_DEG - BLEND_START_DEG, BLEND_END_DEG) - edge
    t: Array = np.clip((np.abs(nodes) - edge) / fade, 0.0, 1.0)
    weight: Array = (t * t * (3.0 - 2.0 * t))[:, None]
    far = wrap_coefficients(np.deg2rad(nodes).astype(np.float64))[kind][:, None]
    if kind == 0:
        return nodes, (1.0 - weight) * own + weight * far
    # In the logarithm, so that drag stays positive. Short of 20 deg the closed form is too low, even negative.
    return nodes, np.exp((1.0 - weight) * np.log(own) + weight * np.log(np.maximum(far, own.min())))
