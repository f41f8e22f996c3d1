"""Prandtl's tip factor for models that smear the blades over the disk, from the disk's mean inflow."""

import numpy as np
from numpy.typing import ArrayLike

from rotor.aero.inflow.wake_state import Wake
from rotor.aero.losses import prandtl
from rotor.arrays import Array

SMALLEST = 0.1
"""Floor of F: at the very tip λ/F would have no bound."""


def tip_factor(r: ArrayLike, wake: Wake, blades: int) -> tuple[Array, Array]:
    """F = (2/π) arccos exp(−N_b (1 − r)/(2λ)), λ = |µ_z + λ0|, at least 0.1; and ∂F/∂(µ_z + λ0), 0 at the floor.

    The blade sees λ_i/F: inflow where the blades are, above the mean around the azimuth. Tip only; shapes of r.
    """
    axial = wake.axial
    size = max(abs(axial), 1e-9)
    f = np.minimum(0.5 * blades * (1.0 - np.asarray(r, dtype=float)) / size, 700.0)
    factor, slope = prandtl(np.maximum(f, 1e-12))
    free = factor > SMALLEST
    return np.where(free, factor, SMALLEST), np.where(free, slope * (-f / size) * np.sign(axial), 0.0)
