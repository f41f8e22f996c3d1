"""Where a section stalls, defined so that it also fits curves which only flatten.

At high Mach the lift of a deck reaches a plateau and has no maximum, and a maximum's angle is ill
determined anyway. So the stall angle is the first angle outward from zero lift at which the lift slope has
fallen to a quarter of its attached value. On curves with a peak that is 0.3 to 1.5 deg before it.
"""

import numpy as np

from rotor.arrays import Array

SLOPE_FRACTION = 0.25
SEARCH_OUTWARD = np.deg2rad(np.arange(20, 301) / 10.0)  # From zero lift: 2 deg, attached for certain, to 30 deg.


def first_quarter_slope(slope: Array, attached: Array) -> Array:
    """Distance from zero lift [rad] at which `slope` first is SLOPE_FRACTION of `attached`, both [1/rad].

    `slope`, shape (curves, SEARCH_OUTWARD.size), is dcl/dalpha of each curve outward from its zero lift, and
    `attached`, shape (curves,), its attached value. Linear between steps of 0.1 deg; 30 deg where the slope
    never falls so far.
    """
    excess = slope - SLOPE_FRACTION * attached[:, None]
    low = excess <= 0.0
    low[:, -1] = True
    after = np.maximum(np.argmax(low, axis=1), 1)
    curve = np.arange(after.size, dtype=np.intp)
    before_value, after_value = excess[curve, after - 1], np.minimum(excess[curve, after], 0.0)
    share = np.where(excess[curve, after] > 0.0, 1.0, before_value / np.maximum(before_value - after_value, 1e-12))
    start = SEARCH_OUTWARD[after - 1]
    return start + np.clip(share, 0.0, 1.0) * (SEARCH_OUTWARD[after] - start)
