"""Blades whose twist follows the azimuth: each has a shape of its own."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rotor.arrays import Array
from rotor.design.active_twist import ActiveTwist
from rotor.design.design import Design
from rotor.design.twist import TwistLaw


@dataclass(frozen=True)
class TwistAt:
    """A law with the active twist of one azimuth on top; not zero at 0.75 R."""

    law: TwistLaw
    active: ActiveTwist
    psi: float

    def __call__(self, r: ArrayLike) -> Array:
        stations = np.atleast_1d(np.asarray(r, dtype=float))
        made: Array = self.law(stations) + self.active(stations, np.array([self.psi]))[:, 0]
        return made

    def spec(self) -> str:
        return self.law.spec()


def blade_twists(design: Design, azimuths: tuple[float, ...]) -> tuple[TwistLaw, ...]:
    """The twist of each blade [azimuths in rad]; empty when one shape does for all."""
    if design.active_twist is None or design.hovering:
        return ()
    return tuple(TwistAt(design.twist, design.active_twist, psi) for psi in azimuths)
