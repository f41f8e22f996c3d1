"""Lift of a section on a turning blade, which stalls later than in two dimensions.

    C_l ← C_l + g (C_l* − C_l),    g = min(3 (c/r)², 0.9)

After Snel, Houwink and Bosschers (Sectional prediction of lift coefficients on rotating wind turbine blades in stall,
ECN-C--93-052, 1994; Snel and others, ECWEC 1993, p. 395–399): where the chord is a large part of the radius, rotation
drives the air of a separated boundary layer outwards, and the flow stays on the blade. Neither text could be obtained.
Independent statements of the formula, in blade-element codes and their documents, agree that lift goes towards that of
attached flow and that C_d stays. The factor is 3 in some of them and 3.1 in others: they differ by 3 %, and ours is 3.
None of them changes C_m, and it stays here, too. One leaves the outer fifth of the blade out; there g is below 0.02.

C_l* is C_lα sin x, with the section's own slope and x from its own zero lift, where that exceeds C_l in size. Within 2°
of zero lift the flow is attached, and C_l* is C_l. Nothing is fitted. C_l* goes smoothly back to C_l from 30° to 60°,
because later users of the formula let it fade (C. Lindenburg, ECN-C--03-025, 2003, by recollection; one code fades it
linearly from 30° to 50°): the shape is our choice. So is the limit of 0.9, with which lift stays below that of attached
flow.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from rotor.airfoil.c81 import C81Block
from rotor.airfoil.section_table import (
    N_ALPHA,
    SEARCH_OUTWARD,
    SectionTable,
    bicubic_coefficients,
    first_quarter_slope,
    mach_nodes,
)
from rotor.support.arrays import Array, read_only
from rotor.support.bytes_cache import bytes_cache

_SNEL_FACTOR = 3.0
_LARGEST_GAIN = 0.9
_ATTACHED_SPAN = np.deg2rad(2.0)
"""Angle from zero lift within which nothing is added: the span of `SectionTable.lift_slope`."""
_FADE_START = np.deg2rad(30.0)
"""Angle from zero lift up to which all of the missing lift is added."""
_FADE_END = np.deg2rad(60.0)
"""Angle from zero lift from which on nothing is added."""


def delay_gain(chord_over_radius: ArrayLike) -> Array:
    """The part g of the missing lift that a blade element keeps; chord_over_radius: c/r with its own radius r."""
    ratio = np.asarray(chord_over_radius, dtype=np.float64)
    return np.minimum(_SNEL_FACTOR * np.square(ratio), _LARGEST_GAIN)


@bytes_cache
@read_only
def fully_delayed(table: SectionTable) -> SectionTable:
    """The section with C_l* in place of C_l, itself where it has no lift. Its stall angles are those of C_l.

    Where nothing is added its cells are those of the section to the last bit.
    """
    if not table.lifts:
        return table
    mach = mach_nodes()
    degrees = np.linspace(-180.0, 180.0, N_ALPHA + 1)
    alpha = np.deg2rad(degrees)[:, None]
    x = alpha - table.zero_lift_alpha(mach)
    missing = table.lift_slope(mach) * np.sin(x) - table(alpha, mach).cl
    larger = np.where(x > 0.0, np.maximum(missing, 0.0), np.minimum(missing, 0.0))
    added = np.where(np.abs(x) > _ATTACHED_SPAN, larger * _added_share(x), 0.0)
    coefficients = table.coefficients.copy()
    coefficients[:, :, 0] += bicubic_coefficients(C81Block(mach, degrees, added))
    return replace(table, coefficients=coefficients)


def delayed_lift(table: SectionTable, gain: float, alpha: ArrayLike, mach: ArrayLike) -> Array:
    """C_l of a blade element with this g; alpha [rad] about the section's chord, mach as for the table."""
    own = table(alpha, mach).cl
    if gain == 0.0:
        return own
    return own + gain * (fully_delayed(table)(alpha, mach).cl - own)


def delayed_stall(table: SectionTable, gain: Array) -> Array:
    """Stall angles of the lift curves with each g [rad], negative and positive end, (gains, 2, Mach nodes).

    A section that never stalls keeps its ±π.
    """
    mach = mach_nodes()
    if not gain.any() or (table.alpha_stall_positive == np.pi).all():
        return np.broadcast_to(table.stall_alpha(mach), (len(gain), 2, len(mach))).copy()
    zero = table.zero_lift_alpha(mach)
    # The search takes one curve a row: all Mach nodes of the first gain, then those of the next.
    attached = np.tile(table.lift_slope(mach), len(gain))
    ends: list[Array] = []
    for side, (own, added) in zip((-1.0, 1.0), _slopes_outward(table), strict=True):
        slopes = own + gain[:, None, None] * added
        distance = first_quarter_slope(slopes.reshape(-1, len(SEARCH_OUTWARD)), attached)
        ends.append(zero + side * distance.reshape(len(gain), len(mach)))
    return np.stack(ends, axis=1)


@bytes_cache
@read_only
def _slopes_outward(table: SectionTable) -> Array:
    """Slopes of C_l and of C_l* − C_l from zero lift outward, (2 ends, 2, Mach nodes, steps): kept for all rotors."""
    mach = mach_nodes()[:, None]
    zero = table.zero_lift_alpha(mach)
    slopes: list[Array] = []
    for side in (-1.0, 1.0):
        alpha = zero + side * SEARCH_OUTWARD
        own = table(alpha, mach).cl_alpha
        slopes.append(np.stack([own, fully_delayed(table)(alpha, mach).cl_alpha - own]))
    return np.stack(slopes)


def _added_share(x: Array) -> Array:
    """The part of the missing lift that is added at x from zero lift: 1 up to 30°, 0 from 60° on, smooth between."""
    t = np.clip((_FADE_END - np.abs(x)) / (_FADE_END - _FADE_START), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)
