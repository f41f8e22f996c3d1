"""The power a tail rotor takes to balance the main rotor's torque."""

import math

from rotor.aero.momentum import glauert_inflow
from rotor.design.tail_rotor import TailRotor


def tail_rotor_power(tail: TailRotor, torque: float, airspeed: float, density: float) -> tuple[float, float]:
    """Power [W] that balances a main-rotor torque [N m] at an airspeed [m/s], and its slope dP/dQ [W/(N m)].

    Energy method: induced power T v_i of the effective disk (radius B R), profile power σ c_d/8 (1 + 3µ²) of the
    dissipation form with the polar taken at the mean angle of attack 6 C_T/(σ a).
    """
    tip_speed = tail.angular_speed * tail.radius
    area = math.pi * tail.radius**2
    unit = density * area * tip_speed**2
    solidity = tail.blades * tail.chord / (math.pi * tail.radius)
    mu = airspeed / tip_speed
    ct_slope = 1.0 / (tail.arm * math.cos(tail.cant) * unit)
    ct = max(torque, 0.0) * ct_slope

    effective = ct / tail.tip_loss**2
    inflow, inflow_slope = glauert_inflow(effective, mu, 0.0)
    alpha_slope = 6.0 / (solidity * tail.lift_slope)
    alpha = alpha_slope * ct
    d0, d1, d2 = tail.drag_polar
    profile = solidity / 8.0 * (1.0 + 3.0 * mu**2)
    cp = ct * inflow + profile * (d0 + d1 * alpha + d2 * alpha**2)
    cp_slope = (
        inflow + ct * inflow_slope / tail.tip_loss**2 + profile * (d1 + 2.0 * d2 * alpha) * alpha_slope
    ) * ct_slope
    return cp * unit * tip_speed, cp_slope * unit * tip_speed
