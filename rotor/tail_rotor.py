"""The tail rotor: the power it takes to balance the main rotor's torque."""

import math
from dataclasses import dataclass

from rotor.momentum import glauert_inflow

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

    def power(self, torque: float, airspeed: float, density: float) -> tuple[float, float]:
        """Power [W] that balances a main-rotor torque [N m] at an airspeed [m/s], and its slope dP/dQ [W/(N m)].

        Energy method: induced power T v_i of the effective disk (radius B R), profile power σ c_d/8 (1 + 3µ²) of the
        dissipation form with the polar taken at the mean angle of attack 6 C_T/(σ a).
        """
        tip_speed = self.angular_speed * self.radius
        area = math.pi * self.radius**2
        unit = density * area * tip_speed**2
        solidity = self.blades * self.chord / (math.pi * self.radius)
        mu = airspeed / tip_speed
        ct_slope = 1.0 / (self.arm * math.cos(self.cant) * unit)
        ct = max(torque, 0.0) * ct_slope

        effective = ct / self.tip_loss**2
        inflow, inflow_slope = glauert_inflow(effective, mu, 0.0)
        alpha_slope = 6.0 / (solidity * self.lift_slope)
        alpha = alpha_slope * ct
        d0, d1, d2 = self.drag_polar
        profile = solidity / 8.0 * (1.0 + 3.0 * mu**2)
        cp = ct * inflow + profile * (d0 + d1 * alpha + d2 * alpha**2)
        cp_slope = (
            inflow + ct * inflow_slope / self.tip_loss**2 + profile * (d1 + 2.0 * d2 * alpha) * alpha_slope
        ) * ct_slope
        return cp * unit * tip_speed, cp_slope * unit * tip_speed
