"""Between the grid of blade elements and the vortex lattice.

The lattice is coarser around the azimuth and finer at the tip. Around it, Fourier series; along the blade, straight
lines between stations. With these λ_i = B A Γ(d) is one linear map on the grid of blade elements.
"""

from dataclasses import dataclass

import numpy as np

from rotor.aero.inflow.vortex_lattice import Lattice
from rotor.arrays import Array


@dataclass(frozen=True, eq=False)
class LatticeTransfer:
    """Both ways; a field is (elements, azimuths) on the grid, (panels, azimuths) on the lattice."""

    inward: Array
    """Elements → panels, (panels, elements); falls to zero at root and tip as circulation does."""
    outward: Array
    """Panels → elements, (elements, panels); held beyond the last panel."""
    around: Array
    """Azimuths of the grid → of the lattice, (lattice, grid)."""
    back: Array
    """Azimuths of the lattice → of the grid, (grid, lattice)."""

    def circulation_to_lattice(self, field: Array) -> Array:
        return self.inward @ field @ self.around.T

    def inflow_to_grid(self, field: Array) -> Array:
        return self.outward @ field @ self.back.T


def transfer(lattice: Lattice, r: Array, azimuths: int) -> LatticeTransfer:
    """The transfer for elements r, (elements,), and evenly spaced azimuths."""
    own, n = lattice.r, len(r)
    padded = np.concatenate(([lattice.root], r, [1.0]))
    inward = np.stack([np.interp(own, padded, np.pad(unit, 1)) for unit in np.eye(n)], axis=1)
    outward = np.stack([np.interp(r, own, unit) for unit in np.eye(lattice.panels)], axis=1)
    return LatticeTransfer(
        inward, outward, _resampling(azimuths, lattice.azimuths), _resampling(lattice.azimuths, azimuths)
    )


def _resampling(source: int, target: int) -> Array:
    """Fourier interpolation of evenly spaced periodic samples, (target, source): the waves both can hold."""
    highest = (min(source, target) - 1) // 2
    angle = 2.0 * np.pi * (np.arange(target)[:, None] / target - np.arange(source) / source)
    waves = np.arange(1, highest + 1)
    return (1.0 + 2.0 * np.cos(angle[..., None] * waves).sum(axis=-1)) / source
