"""A vortex wake of finite blades: lifting lines with rigid, skewed, helical wakes. The reference for the other models.

Undistorted: no roll-up, no contraction, no fuselage; the wake leaves with µ_x and µ_z + λ0. Circulation Γ is over ΩR².
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from rotor.aero.inflow.biot_savart import downwash_matrix
from rotor.aero.inflow.wake_state import Wake
from rotor.arrays import Array

LEAST_REVOLUTIONS = 3.0
SLOWEST = 0.1
"""|U_T| below which lift is no longer turned into circulation as L/U_T, which has no bound."""


@dataclass(frozen=True)
class Lattice:
    """Panels of the lifting line and azimuth steps of its wake."""

    blades: int = 4
    root: float = 0.13
    panels: int = 16
    azimuths: int = 36
    length: float = 12.0
    """How far from the disk the wake's end is carried, in R. Cut at 6 the induced power is 0.4 % higher up to µ 0.3; in
    axial flow 6 leaves 1.4 % of the inflow out, 12 0.3 %."""
    core: float = 0.02
    """Vortex core radius over R. Of no account for a few blades; smooths the wakes of dozens."""
    bare_from: float = 0.6
    """Radius outboard of which a blade's own young trailers have no core. Inboard, where the wake passes back over the
    blade in reverse flow, the core keeps filaments that meet a control point by chance from shaking the answer."""

    def __post_init__(self) -> None:
        if self.azimuths % self.blades:
            raise ValueError(
                f"{self.azimuths} azimuths do not divide among {self.blades} blades: use a multiple of {self.blades}"
            )

    @property
    def edges(self) -> Array:
        """Radii of the trailers, (panels + 1,): by a sine, fine at the tip only; fine at the root too would breed
        near-singular rows in reverse flow."""
        return self.root + (1.0 - self.root) * np.sin(np.linspace(0.0, 0.5 * math.pi, self.panels + 1))

    @property
    def r(self) -> Array:
        """Control points, (panels,): midway in the angle of the sine."""
        angle = (np.arange(self.panels) + 0.5) * (0.5 * math.pi / self.panels)
        return self.root + (1.0 - self.root) * np.sin(angle)

    @property
    def dr(self) -> Array:
        """Panel widths, (panels,)."""
        return np.diff(self.edges)

    @property
    def psi(self) -> Array:
        """Azimuths [rad], (azimuths,)."""
        return 2.0 * math.pi * np.arange(self.azimuths) / self.azimuths

    def tangential(self, mu_x: float) -> Array:
        """U_T = r + µ_x sin ψ, (panels, azimuths)."""
        return self.r[:, None] + mu_x * np.sin(self.psi)

    def mean(self, field: Array) -> float:
        """⟨∫ field dr⟩."""
        return float((self.dr @ field).mean())

    def load(self, circulation: Array, u_t: Array) -> Array:
        """d = (N_b/π) U_T Γ, Kutta–Joukowski."""
        return self.blades / math.pi * u_t * circulation

    def circulation(self, d: Array, u_t: Array) -> Array:
        """Γ of a load: (π/N_b) d U_T/max(U_T², 0.01), and 0 in reverse flow, where no lifting line can speak."""
        floored = math.pi / self.blades * d * u_t / np.maximum(np.square(u_t), SLOWEST**2)
        return np.where(u_t > 0.0, floored, 0.0)

    def downwash(self, mu_x: float, axial: float) -> Array:
        """A with w = A Γ at the blade, (points, points), points row-major in (radius, azimuth); axial = µ_z + λ0.

        Takes 0.05 … 0.5 s; remembered for the last few wakes, so round what you ask for.
        """
        return _downwash(self, mu_x, axial)

    def on_wake(self, wake: Wake) -> Array:
        """A for a wake's direction."""
        return _downwash(self, wake.mu_x, wake.axial)


def shared_azimuths(least: int, blades: int) -> int:
    """The fewest azimuths, `least` or more, that the blades can share."""
    return -(-least // blades) * blades


@lru_cache(maxsize=8)
def _downwash(lattice: Lattice, mu_x: float, axial: float) -> Array:
    speed = math.hypot(mu_x, axial)
    revolutions = max(LEAST_REVOLUTIONS, lattice.length / (2.0 * math.pi * speed))
    steps = math.ceil(revolutions * lattice.azimuths)
    matrix: Array = downwash_matrix(
        lattice.edges, lattice.r, lattice.azimuths, lattice.blades, mu_x, axial, steps, lattice.core, lattice.bare_from
    )
    size = lattice.panels * lattice.azimuths
    return np.ascontiguousarray(matrix.transpose(1, 0, 3, 2)).reshape(size, size)
