"""Passive laminates that twist with rotor speed."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from rotor.actuator.kind import Actuator, InstalledActuator, Limit, Swings
from rotor.actuator.section import Placement
from rotor.dynamics.torsion import TorsionBeam
from rotor.support.arrays import Array
from rotor.trim.solution import Solution


@dataclass(frozen=True, kw_only=True)
class ExtensionTwist(Actuator):
    """A laminate that twists under centrifugal tension: passive, so only rotor speed changes its twist."""

    twist: float
    """Tip twist between standstill and full speed [rad]."""
    speed_change: float
    """Share by which the rotor may be slowed in flight."""

    noun = "laminate", "laminates"
    settings = ("crossed",)
    forbidden = "forbidden by constant rotor speed"

    @property
    def mode(self) -> str:
        return f"rotor speed, {math.degrees(self.twist):.2f}°"

    def count(self, placement: Placement) -> str:
        return "passive"

    @property
    def attainable(self) -> float:
        """Change of tip twist between full and lowered speed [rad]: twist goes with Ω²."""
        return self.twist * (1.0 - (1.0 - self.speed_change) ** 2)

    def shapes(self, moments: Array, units: Array, beam: TorsionBeam) -> Array:
        """Twist of a uniform laminate [rad], (segments, nodes): rate ∝ F_c ∝ 1 − r²."""
        x = beam.r / beam.r[-1]
        shape = x - x**3 / 3.0
        shape = shape - shape[0]
        return (self.attainable * shape / shape[-1])[None, :]

    def limits(
        self, installed: InstalledActuator, swings: Swings, solutions: Sequence[Solution]
    ) -> tuple[Limit, ...]:
        percent = 100.0 * self.speed_change
        sentence = (
            f"Only rotor speed changes the twist: {percent:.0f} % slower for the full change, and this rotor runs at "
            "constant speed."
        )
        return (Limit("rotor-speed", False, 0.0, percent, "% of Ω", sentence),)
