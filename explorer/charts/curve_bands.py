"""The band of power over µ, or of its change from a reference, in a worker process: at few speeds, since each takes two
trims and, for a change, two more with another inflow model."""

import numpy as np
from scipy.interpolate import PchipInterpolator

from explorer.charts.plots import SWEEP, any_speed, slowest_swept
from rotor import Design, Solution, doubt, solve
from rotor.support.arrays import Array
from rotor.trim.low_speed import vortex_ring

Bands = tuple[tuple[float, float], ...]
"""Advance ratios, and the band there [W]."""
_BANDED = (0, 2, 4, 6, 8, 12, 16)
"""Places in `SWEEP`. Between them a cubic is within 1.5 kW of the band of the UH-60A's change, as a test holds."""


def curve_bands(design: Design, reference: Design | None) -> Bands:
    """Bands [W] of the change from the reference at the speeds where both trim; without a reference, of the power."""
    found, before = list[tuple[float, float]](), list[Solution]()
    family = any_speed(design), *(() if reference is None else (any_speed(reference),))
    for mu in (SWEEP[k] for k in _BANDED):
        if 0.0 < mu < slowest_swept(family[0]) or vortex_ring(family[0].at(mu=mu)):
            continue
        starts = before or [None] * len(family)
        trims = [solve(one.at(mu=mu), start) for one, start in zip(family, starts, strict=True)]
        if not all(trim.converged for trim in trims):
            break
        before, sure = trims, doubt(*trims)
        band = sure.band if reference is None else sure.change_band
        found.append((mu, band or 0.0))
    return tuple(found)


def band_along(bands: Bands, mu: Array) -> Array:
    """The band at other advance ratios [W]; NaN beyond those that are known."""
    if len(bands) < 2:
        return np.full(len(mu), np.nan)
    return PchipInterpolator(*np.array(bands).T, extrapolate=False)(mu)
