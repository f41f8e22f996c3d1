"""Arrays for drawings and charts: twist under voltage, where the electronics are, what would pay."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotor.actuator.kind import InstalledActuator
from rotor.actuator.pay import BreakEven
from rotor.support.arrays import Array
from rotor.support.chart import Axis, Chart, Line


@dataclass(frozen=True, eq=False)
class TwistCurve:
    """Change of twist along the blade."""

    r: Array
    """r/R, (stations,)."""
    twist: Array
    """[rad], (stations,)."""


def twist_under_voltage(installed: InstalledActuator, voltages: Sequence[float]) -> TwistCurve:
    """The blade's twist with each segment at its voltage [V], zero volts being the jig twist.

    Voltages beyond the range raise ValueError. Without voltage they are drives in the unit of the actuator.
    """
    if len(voltages) != len(installed.shapes):
        raise ValueError(f"{len(voltages)} voltages for {len(installed.shapes)} segments: give one for each")
    actuator = installed.actuator
    low, high = actuator.drive_range
    for voltage in voltages:
        if not low - 1e-9 <= voltage <= high + 1e-9:
            raise ValueError(f"{actuator.drive_noun} {voltage:g} is outside {low:g}…{high:g}: choose a value inside")
    r = np.linspace(float(installed.r[0]), 1.0, 61)
    return TwistCurve(r, installed.change(np.asarray(voltages, dtype=float) / actuator.drive_swing, r))


def electronics_station(installed: InstalledActuator) -> tuple[float, float]:
    """Inner and outer end of the drive electronics, r/R (figure 5.8), between flap hinge and active span."""
    return float(installed.r[0]) + 0.02, installed.placement.span[0] - 0.02


def break_even_chart(even: BreakEven) -> Chart:
    """Mass that just pays over twist, without drive power and with half of what unlimited twist saves."""
    half, degrees = 0.5 * even.ideal_saving, tuple(np.degrees(even.twists).tolist())
    driven = tuple(even.mass_allowed(twist, half) for twist in even.twists.tolist())
    lines = (
        Line("no drive power", degrees, tuple(even.masses.tolist()), 1),
        Line(f"{half:.0f} W of drive", degrees, driven, 1, dashes=True),
    )
    return Chart("Pays below the line", Axis("range of linear twist [°]"), Axis("mass of all blades [kg]"), lines)
