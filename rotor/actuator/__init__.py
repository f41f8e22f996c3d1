"""Actuators for in-flight twist change: attainable twist, limits, mass, and net power saving (thesis chapter 5).

Fibre angles are measured from the span axis towards the direction in which the wall runs around the section. Section
axes are y aft and z up from the leading edge of the chord line [m]; twist is nose-up positive. Only the table of
contents of chapter 5 is known, so its numbers are not compared.
"""

from rotor.actuator.catalogue import (
    Actuator,
    Engines,
    ExtensionTwist,
    PiezoPly,
    Programme,
    TorqueTube,
    actuators,
    engines_of,
    find_actuator,
    programmes,
)
from rotor.actuator.flight import ActuatorFlight, fly
from rotor.actuator.harmonic import EffectInFlight, effect, harmonic_share, powers, tip_amplitude
from rotor.actuator.installation import (
    InstalledActuator,
    install,
    with_actuator,
    with_actuator_mass,
)
from rotor.actuator.pay import BreakEven, OtherStroke, break_even, other_stroke, pay_sentence
from rotor.actuator.section import HostBlade, Placement, default_placement
from rotor.actuator.stopped import failure
from rotor.actuator.verdict import Verdict, judge, try_actuator, verdict_details, verdict_sentence

__all__ = (
    "Actuator", "ActuatorFlight", "BreakEven", "EffectInFlight", "Engines", "ExtensionTwist",
    "HostBlade", "InstalledActuator", "OtherStroke", "PiezoPly", "Placement", "Programme", "TorqueTube",
    "Verdict", "actuators", "break_even", "default_placement", "effect", "engines_of", "failure", "find_actuator",
    "fly", "harmonic_share", "install", "judge", "other_stroke", "pay_sentence", "powers", "programmes",
    "tip_amplitude", "try_actuator", "verdict_details", "verdict_sentence", "with_actuator",
    "with_actuator_mass",
)  # fmt: skip
