"""Coefficients over ±180°: the closed form beyond stall, the blend, and other codes' decks on the run-time grid.

Nine constants fitted by this project to the NACA 0012 measurements over 0..180 deg of NACA TN 3361 (Critzos, Heyson
and Boswinkle 1955), symmetrised; four more for the moment. A 9.5 % section with a sharp trailing edge behaves
similarly there: at 90° like a flat plate, and in reverse flow it stalls early at its sharp edge. The fit is within
0.039 (cl) and 0.014 (cd) rms of the measurements; it is not independent evidence of them.

Decks of other codes have their own knots, and some end at stall. Values between knots follow PCHIP curves, as in
`bicubic`; missing angles are filled by the closed form.
"""

import numpy as np
import scipy

from rotor.airfoil.bicubic import MACH_STEP, N_MACH
from rotor.airfoil.c81 import C81Block, C81Deck
from rotor.arrays import Array

BLEND_START_DEG = 16.0  # |alpha| below which only the polar is used.
BLEND_END_DEG = 26.0  # |alpha| above which only the closed form is used.

# cl = sum s_k sin(k a) - P (x/w) exp((1 - (x/w)^2)/2), x = 180 deg - |a|: the last term is reverse-flow lift.
_CL_SIN = (0.07290562895790871, 1.0548966550216816)
_REVERSE_PEAK = 0.4137752069896611
_REVERSE_WIDTH_DEG = 7.719281370720392
_CD_COS = (1.1279, -0.0264, -1.03951, -0.02516, -0.0966)  # cd = sum c_k cos(k a), k from 0.
_CM_SIN = (-0.58524, 0.14099, -0.03031, 0.04132)  # cm = sum m_k sin(k a), k from 1, about the quarter chord.


def wrap_coefficients(alpha: Array) -> tuple[Array, Array, Array]:
    """(cl, cd, cm) [-] of the closed form at `alpha` [rad], within -pi..pi; for 20..180 deg either way.

    cl and cm are odd, cd is even; cd lies between 0.043 (at 180 deg) and 2.1 (at 90 deg).
    """
    size = np.abs(alpha)
    x = (np.pi - size) / np.deg2rad(_REVERSE_WIDTH_DEG)
    cl = sum((s * np.sin(k * size) for k, s in enumerate(_CL_SIN, start=1)), np.zeros_like(size))
    cl = np.sign(alpha) * (cl - _REVERSE_PEAK * x * np.exp(0.5 * (1.0 - x * x)))
    cd = sum((c * np.cos(k * size) for k, c in enumerate(_CD_COS)), np.zeros_like(size))
    cm = sum((m * np.sin(k * alpha) for k, m in enumerate(_CM_SIN, start=1)), np.zeros_like(size))
    return cl, cd, cm


def blend_weight(alpha: Array) -> Array:
    """Share of the closed form at `alpha` [rad]: 0 below 16 deg, 1 above 26 deg, a smoothstep between."""
    t = np.clip((np.rad2deg(np.abs(alpha)) - BLEND_START_DEG) / (BLEND_END_DEG - BLEND_START_DEG), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def blend(alpha: Array, cl: Array, cd: Array, cm: Array) -> tuple[Array, Array, Array]:
    """Polar values blended into the closed form: cl and cm linearly, cd in its logarithm so that it stays positive."""
    weight = blend_weight(alpha)
    far_cl, far_cd, far_cm = wrap_coefficients(alpha)
    # A cd of zero weight has no effect: there the polar may have any value, and the series is negative.
    log_near, log_far = np.log(np.where(weight < 1.0, cd, 1.0)), np.log(np.where(weight > 0.0, far_cd, 1.0))
    log_cd = (1.0 - weight) * log_near + weight * log_far
    return (1.0 - weight) * cl + weight * far_cl, np.exp(log_cd), (1.0 - weight) * cm + weight * far_cm


_LARGEST = 5.0
_LEAST_RANGE_DEG = 8.0
"""A deck must at least cover −8…8°: no formula can replace data within it."""


def on_run_time_grid(deck: C81Deck) -> C81Deck:
    """The deck with lift and drag on the run-time grid over ±180°; the same values where its knots already fit.

    Raises ValueError with one sentence for a deck whose lift or drag covers too little. A moment that covers too
    little stays as it is.
    """
    try:
        moment = _block(deck.title, deck.cm, 2)
    except ValueError:
        moment = deck.cm
    return C81Deck(deck.title, _block(deck.title, deck.cl, 0), _block(deck.title, deck.cd, 1), moment)


def _block(title: str, block: C81Block, kind: int) -> C81Block:
    alpha, mach, values = block.alpha_deg, block.mach, block.values
    if alpha[0] > -_LEAST_RANGE_DEG or alpha[-1] < _LEAST_RANGE_DEG:
        raise ValueError(
            f"{title}: {('cl', 'cd', 'cm')[kind]} covers {alpha[0]:g}…{alpha[-1]:g} deg: "
            f"give at least −{_LEAST_RANGE_DEG:g}…{_LEAST_RANGE_DEG:g} deg"
        )
    if mach[0] < 0.0 or mach[-1] > 1.5 or alpha[0] < -180.0 - 1e-9 or alpha[-1] > 180.0 + 1e-9:
        raise ValueError(
            f"{title}: angles {alpha[0]:g}…{alpha[-1]:g} deg at Mach {mach[0]:g}…{mach[-1]:g}: "
            "keep angles within ±180 deg and Mach within 0…1.5"
        )
    largest = float(np.abs(values).max())
    if kind < 2 and largest > _LARGEST:
        raise ValueError(
            f"{title}: {('cl', 'cd')[kind]} reaches {largest:g}, more than any section has: check the digits"
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
        values = np.asarray(scipy.interpolate.PchipInterpolator(mach, values, axis=1)(grid))
        mach = grid.astype(np.float64)
    return C81Block(mach, alpha, values)


def _whole_circle(alpha: Array, values: Array, kind: int) -> tuple[Array, Array]:
    """Values at every half degree: the deck within its angles, blended into the closed form beyond them."""
    nodes = np.linspace(-180.0, 180.0, 721)
    curve = scipy.interpolate.PchipInterpolator(alpha, values, axis=0)
    own = np.asarray(curve(np.clip(nodes, alpha[0], alpha[-1])), dtype=np.float64)
    edge = np.where(nodes < 0.0, float(-alpha[0]), float(alpha[-1])).astype(np.float64)
    fade = np.maximum(edge + BLEND_END_DEG - BLEND_START_DEG, BLEND_END_DEG) - edge
    t: Array = np.clip((np.abs(nodes) - edge) / fade, 0.0, 1.0)
    weight: Array = (t * t * (3.0 - 2.0 * t))[:, None]
    far = wrap_coefficients(np.deg2rad(nodes).astype(np.float64))[kind][:, None]
    if kind != 1:
        return nodes, (1.0 - weight) * own + weight * far
    # In the logarithm, so that drag stays positive. Short of 20 deg the closed form is too low, even negative.
    return nodes, np.exp((1.0 - weight) * np.log(own) + weight * np.log(np.maximum(far, own.min())))
