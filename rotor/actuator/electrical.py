"""Capacitance, energy and power of the plies, quasi-steady and at harmonics of rotor speed."""

import math
from dataclasses import dataclass

from rotor.actuator.catalogue import PiezoPly, TorqueTube
from rotor.actuator.fitted import Fitted
from rotor.dynamics.structure import structure_data


@dataclass(frozen=True)
class Drive:
    """What driving the actuators of all blades takes."""

    capacitance: float
    """Of one blade [F]; 0 for a tube."""
    hold_power: float
    """[W], all blades: nothing but leakage for a ply."""
    slew_power: float
    """Mean [W] while changing the twist of all blades by the swing, amplifier losses included."""
    slew_time: float
    """[s]"""


def capacitance(fitted: Fitted) -> float:
    """C = c_A A n of one blade [F]."""
    actuator = fitted.actuator
    if not isinstance(actuator, PiezoPly):
        return 0.0
    return actuator.capacitance_per_area * fitted.skin_area * fitted.placement.plies


def drive(fitted: Fitted, swings: tuple[float, ...]) -> Drive:
    """Holding, and slewing by each segment's share of the whole range: ½C ΔV² over the time, per segment."""
    data = structure_data()["electrical"]
    blades = fitted.bill.blades
    actuator = fitted.actuator
    if isinstance(actuator, TorqueTube):
        tubes = blades * fitted.placement.plies * len(fitted.placement.segments)
        return Drive(0.0, tubes * actuator.hold_power, tubes * actuator.move_power, actuator.move_time)
    if not isinstance(actuator, PiezoPly):
        return Drive(0.0, 0.0, 0.0, 0.0)
    per_area = actuator.capacitance_per_area * fitted.placement.plies
    energy = sum(
        0.5 * per_area * area * (swing * actuator.voltage_swing) ** 2
        for area, swing in zip(fitted.segment_areas, swings, strict=True)
    )
    time = float(data["slew_s"])
    slew = blades * energy / time / float(data["amplifier_efficiency"])
    return Drive(capacitance(fitted), 0.0, slew, time)


@dataclass(frozen=True)
class Harmonic:
    """Driving the plies at a harmonic of rotor speed, one blade."""

    reactive: float
    """[VA]"""
    loss: float
    """[W], heat in the plies."""


def harmonic_drive(fitted: Fitted, per_rev: float, amplitude: float, angular_speed: float) -> Harmonic:
    """Reactive π f C V_a² and loss π f C V_a² tan δ, at `amplitude` as a share of half the range (V_a)."""
    actuator = fitted.actuator
    if not isinstance(actuator, PiezoPly):
        return Harmonic(0.0, 0.0)
    frequency = per_rev * angular_speed / (2.0 * math.pi)
    voltage = 0.5 * amplitude * actuator.voltage_swing
    reactive = math.pi * frequency * capacitance(fitted) * voltage**2
    return Harmonic(reactive, reactive * float(structure_data()["electrical"]["loss_tangent"]))
