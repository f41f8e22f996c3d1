"""How different two blades are, for the error of the difference of their powers in hover.

Errors of equal blades cancel in a difference. Those of blades that differ in planform do not, as measured pairs of
rotors show (`docs/validation/doubt.md`). Between them lie blades that differ in twist alone. Their errors are taken to
part in proportion to the twist, up to the difference of the one measured pair with two twists.
"""

import math

import numpy as np

from rotor.design.design import Design
from rotor.support.arrays import Array

FAR_TWIST = math.radians(12.0)
"""Difference in linear twist of the measured pair [rad per radius], from which on blades are wholly different."""
_RINGS = 40
"""Rings of equal width on which two blades are compared. Our choice."""


def blade_distance(one: Design, other: Design) -> float:
    """Distance of two blades: 0 for equal ones, 1 where planform or sections differ, in between by twist."""
    if not _equal_but_for_twist(one, other):
        return 1.0
    return min(float(np.linalg.norm(twist_difference(one, other))), 1.0)


def twist_difference(one: Design, other: Design) -> Array:
    """Difference in twist along the blades about its mean, (rings,); of length 1 for `FAR_TWIST`, 0 for equal twists.

    A ring counts by its radius, as in the area of the disk. The mean is left out because the collective trims it.
    """
    r = _radii(one, other)
    weights = r / r.sum()
    difference = _about_mean(one.twist(r) - other.twist(r), weights)
    far = _about_mean(FAR_TWIST * r, weights)
    return difference / float(np.linalg.norm(far))


def _about_mean(twist: Array, weights: Array) -> Array:
    """Deviations of a twist from its mean over the disk, times the roots of the weights: their length is the rms."""
    return np.sqrt(weights) * (twist - weights @ twist)


def _radii(one: Design, other: Design) -> Array:
    """r/R of the middles of rings over the span that both blades have."""
    root = max(one.rotor.blade.root_cutout, other.rotor.blade.root_cutout)
    edges = np.linspace(root, 1.0, _RINGS + 1)
    return 0.5 * (edges[1:] + edges[:-1])


def _equal_but_for_twist(one: Design, other: Design) -> bool:
    """Whether number, radius, root cut-out, chord and sections of the blades are equal."""
    first = one.rotor
    second = other.rotor
    if first.blades != second.blades or first.radius != second.radius:
        return False
    if first.blade.root_cutout != second.blade.root_cutout:
        return False
    if first.blade.spans != second.blade.spans:
        return False
    if first.blade.own_sections != second.blade.own_sections:
        return False
    r = _radii(one, other)
    return bool(np.allclose(first.blade.chord(r), second.blade.chord(r), rtol=1e-9, atol=0.0))
