"""Electric field, free strain, capacitance and drive power of piezoelectric plies.

Strain along the fibres is d·E with E = V/gap. Interdigitated electrodes lay the field along the fibres (d33, gap =
electrode pitch), continuous electrodes through the thickness (d31, gap = thickness). Figures 5.4–5.7 of the thesis.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rotor.actuator.catalogue import PiezoPly, TorqueTube
from rotor.actuator.installation import InstalledActuator
from rotor.arrays import Array
from rotor.dynamics.structure import structure_data


def electric_field(ply: PiezoPly, voltage: ArrayLike) -> Array:
    """E = V/gap [V/m]."""
    return np.asarray(voltage, dtype=float) / ply.electrode_gap


def free_strain(ply: PiezoPly, voltage: ArrayLike) -> Array:
    """Free strain along and across the fibres [-], (2, …), linear between the ends of the range, zero at 0 V.

    Measured swing over the voltage swing, not the coefficient d: the two differ by the material's non-linearity.
    """
    per_volt = np.array(ply.swing) / ply.voltage_swing
    return np.multiply.outer(per_volt, np.asarray(voltage, dtype=float))


@dataclass(frozen=True)
class Drive:
    """Drive power of the actuators of all blades."""

    capacitance: float
    """Capacitance of one blade's actuators [F]; 0 for a tube."""
    hold_power: float
    """[W], all blades: only leakage for a ply."""
    slew_power: float
    """Mean [W] while changing the twist of all blades by the swing, amplifier losses included."""
    slew_time: float
    """[s]"""


def capacitance(installed: InstalledActuator) -> float:
    """C = c_A A n of one blade [F]."""
    actuator = installed.actuator
    per_area = actuator.capacitance_per_area if isinstance(actuator, PiezoPly) else 0.0
    return per_area * installed.skin_area * installed.placement.plies


def drive(installed: InstalledActuator, swings: tuple[float, ...]) -> Drive:
    """Holding, and slewing by each segment's share of the whole range: ½C ΔV² over the time, per segment."""
    data = structure_data()["electrical"]
    blades = installed.masses.blades
    actuator = installed.actuator
    if isinstance(actuator, TorqueTube):
        tubes = blades * installed.placement.plies * len(installed.placement.segments)
        return Drive(0.0, tubes * actuator.hold_power, tubes * actuator.move_power, actuator.move_time)
    if not isinstance(actuator, PiezoPly):
        return Drive(0.0, 0.0, 0.0, 0.0)
    per_area = actuator.capacitance_per_area * installed.placement.plies
    energy = sum(
        0.5 * per_area * area * (swing * actuator.voltage_swing) ** 2
        for area, swing in zip(installed.segment_areas, swings, strict=True)
    )
    time = float(data["slew_s"])
    slew = blades * energy / time / float(data["amplifier_efficiency"])
    return Drive(capacitance(installed), 0.0, slew, time)


def harmonic_loss(installed: InstalledActuator, per_rev: float, amplitude: float, angular_speed: float) -> float:
    """Heat in the plies of one blade driven at a harmonic, π f C V_a² tan δ [W]; amplitude: V_a over half the range."""
    actuator = installed.actuator
    if not isinstance(actuator, PiezoPly):
        return 0.0
    frequency = per_rev * angular_speed / (2.0 * math.pi)
    voltage = 0.5 * amplitude * actuator.voltage_swing
    loss_tangent = float(structure_data()["electrical"]["loss_tangent"])
    return math.pi * frequency * capacitance(installed) * voltage**2 * loss_tangent
