"""Actuators for in-flight twist change: attainable twist, limits, mass, and net power saving (thesis chapter 5).

Fibre angles are measured from the span axis towards the direction in which the wall runs around the section. Section
axes are y aft and z up from the leading edge of the chord line [m]; twist is nose-up positive. Only the table of
contents of chapter 5 is known, so its numbers are not compared.
"""

from rotor.actuator.catalogue import Actuator, ExtensionTwist, PiezoPly, TorqueTube, actuators, find_actuator
from rotor.actuator.harmonic import DynamicTwist, PowerMap, phase_sweep, power_map
from rotor.actuator.installation import InstalledActuator, install
from rotor.actuator.optimum import ConditionPair
from rotor.actuator.section import Host, Placement, default_placement
from rotor.actuator.verdict import Verdict, judge, try_actuator, verdict_sentence

__all__ = (
    "Actuator",
    "ConditionPair",
    "DynamicTwist",
    "ExtensionTwist",
    "Host",
    "InstalledActuator",
    "PiezoPly",
    "Placement",
    "PowerMap",
    "TorqueTube",
    "Verdict",
    "actuators",
    "default_placement",
    "find_actuator",
    "install",
    "judge",
    "phase_sweep",
    "power_map",
    "try_actuator",
    "verdict_sentence",
)
