"""One design evaluated, as the descents see it."""

import math
from dataclasses import dataclass

from rotor.arrays import Array

FEASIBLE = 1e-3
"""Accepted violation of a limit: a thousandth of a degree, or of a per cent of the disk."""


@dataclass(frozen=True, eq=False)
class Record:
    """A design evaluated. x: parameters scaled to 0…1 over their bounds."""

    x: Array
    power: float | None
    """[W]; None when it does not trim."""
    slope: Array
    """∂power/∂x [W]"""
    margins: Array
    """What is left of each limit, scaled, (limits,)."""
    margin_slopes: Array
    """(limits, parameters)"""

    @property
    def feasible(self) -> bool:
        """Whether it trims and keeps all limits."""
        return self.power is not None and bool((self.margins >= -FEASIBLE).all())

    @property
    def watts(self) -> float:
        """Power, infinite where it does not trim, for comparing."""
        return math.inf if self.power is None else self.power
