"""What the wake's direction and strength depend on."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Wake:
    """Flow through the disk as momentum theory sees it; all over ΩR."""

    mu_x: float
    """Advance ratio in the disk plane, µ cos α."""
    mu_z: float
    """Advance ratio through the disk, µ sin α, positive down."""
    lambda0: float
    """Mean induced inflow of momentum theory."""

    @property
    def axial(self) -> float:
        return self.mu_z + self.lambda0

    @property
    def speed(self) -> float:
        return math.hypot(self.mu_x, self.axial)
