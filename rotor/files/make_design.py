"""A design from names: preset, aircraft, twist SPEC."""

import tomllib
from dataclasses import replace
from functools import cache
from typing import Any

from rotor.aero.momentum import ideal_tip_pitch
from rotor.assets import SHIPPED_ROTORS, asset_path
from rotor.design.aircraft import Aircraft
from rotor.design.blade import Rotor, parse_airfoils
from rotor.design.design import Design, Models
from rotor.design.flight import FlightCondition
from rotor.design.presets import FLIGHT_MODELS, THESIS_MODELS, check_preset
from rotor.design.twist import TwistLaw
from rotor.design.twist_spec import parse_twist
from rotor.files.shipped import shipped_aircraft


@cache
def uh60a_data() -> dict[str, Any]:
    """The parsed `assets/uh60a.toml`."""
    return tomllib.loads(asset_path("uh60a.toml").read_text(encoding="utf-8"))


def uh60a_rotor(preset: str) -> Rotor:
    """The UH-60A's main rotor as flown (`flight`) or as the document states it (`thesis`)."""
    check_preset(preset)
    return shipped_aircraft("uh60a").rotor_for(preset)


def uh60a_twist() -> TwistLaw:
    """The UH-60A's nonlinear built-in twist."""
    return shipped_aircraft("uh60a").rotor.builtin_twist


def baseline_twist(preset: str, aircraft: Aircraft | None = None) -> TwistLaw:
    """The twist that changes count from: the rotor's own, or the document's −16° (`thesis`, UH-60A)."""
    check_preset(preset)
    return (aircraft or shipped_aircraft(SHIPPED_ROTORS[0])).twist_for(preset)


def make_design(
    preset: str = "flight",
    *,
    aircraft: Aircraft | str | None = None,
    twist: TwistLaw | str | None = None,
    advance_ratio: float = 0.2,
    mass: float | None = None,
    altitude: float = 0.0,
    models: Models | None = None,
) -> Design:
    """A design: preset, aircraft (UH-60A by default, or a shipped name), twist law or SPEC (default: the baseline).

    On another rotor than the UH-60A `thesis` means the document's models on that rotor as it is: its own sections over
    Mach, planform and hinge, its built-in twist as the baseline.
    `mass` [kg] defaults to the reference mass; `altitude` [m]; `models` replaces the preset's own choices.
    Raises ValueError with one sentence for a value it cannot use.
    """
    check_preset(preset)
    craft = aircraft if isinstance(aircraft, Aircraft) else shipped_aircraft(aircraft or SHIPPED_ROTORS[0])
    rotor = craft.rotor_for(preset)
    draft = Design(
        preset=preset,
        aircraft=craft,
        rotor=rotor,
        twist=craft.twist_for(preset),
        condition=FlightCondition(advance_ratio, craft.mass if mass is None else mass, altitude),
        fuselage=craft.fuselage,
        tail_rotor=craft.tail_rotor,
        models=models or (FLIGHT_MODELS if preset == "flight" else THESIS_MODELS),
    )
    if twist is None:
        return draft
    if isinstance(twist, str):
        slope = float(rotor.blade.installed(rotor.blade.spans[0].section).table.lift_slope(0.3))
        tip_pitch = ideal_tip_pitch(draft.weight_coefficient, rotor.solidity, slope)
        twist = parse_twist(twist, builtin=rotor.builtin_twist, ideal_tip_pitch=tip_pitch, named=_named_twist)
    return replace(draft, twist=twist)


def _named_twist(name: str) -> TwistLaw | None:
    """The built-in twist of a shipped rotor, which a SPEC may put on another one too."""
    return shipped_aircraft(name).rotor.builtin_twist if name in SHIPPED_ROTORS else None


def change_airfoils(rotor: Rotor, spec: str) -> Rotor:
    """The rotor with the airfoils of a SPEC (`parse_airfoils`); ValueError also for a section not held."""
    changed = parse_airfoils(rotor, spec)
    for span in changed.blade.spans:
        changed.blade.installed(span.section)
    return changed
