"""The tail rotor as built."""

from dataclasses import dataclass

FIXED_SHARE = 0.05
"""Tail rotor over main rotor power as the document has it in every flight state (thesis §3.2, p. 25)."""


@dataclass(frozen=True)
class TailRotor:
    """A tail rotor in edgewise flow."""

    radius: float
    """[m]"""
    angular_speed: float
    """[rad/s]"""
    chord: float
    """[m]"""
    blades: int
    arm: float
    """Distance from the main-rotor shaft [m]."""
    cant: float
    """Tilt of the thrust out of the horizontal [rad]; only the horizontal part balances torque."""
    tip_loss: float
    """Effective radius factor B."""
    drag_polar: tuple[float, float, float]
    """c_d = δ0 + δ1 α + δ2 α² with α [rad]."""
    lift_slope: float
    """[1/rad]"""
