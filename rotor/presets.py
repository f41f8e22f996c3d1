"""The two presets: `flight`, what we believe, and `thesis`, what the document states. Values, not branches."""

import math
import tomllib
from dataclasses import replace
from functools import cache
from typing import Any

from rotor.airfoil.sections import load_installed
from rotor.assets import asset_path
from rotor.blade import Blade, Rotor, Span, parse_airfoils
from rotor.design import Design, Models
from rotor.flight import FlightCondition, Fuselage
from rotor.momentum import ideal_tip_pitch
from rotor.tail_rotor import TailRotor
from rotor.twist import LinearTwist, TableTwist, TwistLaw
from rotor.twist_spec import parse_twist

PRESETS = ("flight", "thesis")

FLIGHT_MODELS = Models(
    inflow="dynamic-wake",
    hover_inflow="annulus",
    trim="propulsive",
    disk_axial_flow=True,
    blade_weight=True,
    tail_rotor_solved=True,
)
THESIS_MODELS = Models(
    inflow="pitt-peters-15pi/23",
    hover_inflow="closed-form",
    trim="thrust",
    disk_axial_flow=False,
    blade_weight=False,
    tail_rotor_solved=False,
)


@cache
def uh60a_data() -> dict[str, Any]:
    """The parsed `assets/uh60a.toml`."""
    return tomllib.loads(asset_path("uh60a.toml").read_text(encoding="utf-8"))


@cache
def uh60a_rotor(preset: str) -> Rotor:
    """The main rotor as flown (`flight`) or as the document states it (`thesis`)."""
    check_preset(preset)
    main = uh60a_data()["main_rotor"]
    given = main["flown" if preset == "flight" else "document"]
    radius = main["radius_m"]
    if "mass_per_length_kg_m" in given:
        # A uniform blade from the hinge outward: eqs. (2.35), (2.37) with e = 0.
        mass_per_length = given["mass_per_length_kg_m"]
        mass = mass_per_length * radius
        static_moment = mass * radius / 2.0
        inertia = mass * radius**2 / 3.0
    else:
        mass = given["blade_mass_kg"]
        static_moment = given["flap_static_moment_kg_m"]
        inertia = given["flap_inertia_kg_m2"]
    return Rotor(
        name=uh60a_data()["name"],
        blade=Blade(
            root_cutout=main["root_cutout_r"],
            chord_stations=tuple(given["chord_r"]),
            chords=tuple(given["chord_m"]),
            spans=tuple(Span(span["start_r"], span["end_r"], span["section"]) for span in given["spans"]),
            flap_hinge=given["flap_hinge_m"] / radius,
            flap_inertia=inertia,
            flap_static_moment=static_moment,
            mass=mass,
        ),
        blades=main["blades"],
        radius=radius,
        angular_speed=main["angular_speed_rad_s"],
        reference_chord=main["reference_chord_m"],
        builtin_twist=uh60a_twist(),
    )


@cache
def uh60a_twist() -> TableTwist:
    """The UH-60A's nonlinear built-in twist."""
    flown = uh60a_data()["main_rotor"]["flown"]
    return TableTwist(tuple(flown["twist_r"]), tuple(math.radians(angle) for angle in flown["twist_deg"]), name="uh60a")


def baseline_twist(preset: str) -> TwistLaw:
    """The twist that changes are measured against: UH-60A table (`flight`) or linear −16° (`thesis`)."""
    check_preset(preset)
    if preset == "flight":
        return uh60a_twist()
    return LinearTwist(math.radians(uh60a_data()["main_rotor"]["document"]["linear_twist_deg"]))


def make_design(
    preset: str = "flight",
    *,
    twist: TwistLaw | str | None = None,
    advance_ratio: float = 0.2,
    mass: float | None = None,
    altitude: float = 0.0,
    models: Models | None = None,
) -> Design:
    """A UH-60A design: preset, twist law or SPEC (default: the preset's baseline), condition.

    `mass` [kg] defaults to the reference mass; `altitude` [m]; `models` replaces the preset's own choices.
    Raises ValueError with one sentence for a value it cannot use.
    """
    rotor = uh60a_rotor(preset)
    airframe = uh60a_data()["airframe"]
    condition = FlightCondition(advance_ratio, airframe["mass_kg"] if mass is None else mass, altitude)
    chosen = models or (FLIGHT_MODELS if preset == "flight" else THESIS_MODELS)
    draft = Design(
        preset=preset,
        rotor=rotor,
        twist=baseline_twist(preset),
        condition=condition,
        fuselage=Fuselage(airframe["drag_area_m2"]),
        tail_rotor=_tail_rotor(),
        models=chosen,
    )
    if twist is None:
        return draft
    if isinstance(twist, str):
        slope = float(load_installed(rotor.blade.spans[0].section).table.lift_slope(0.3))
        tip_pitch = ideal_tip_pitch(draft.weight_coefficient, rotor.solidity, slope)
        twist = parse_twist(twist, builtin=rotor.builtin_twist, ideal_tip_pitch=tip_pitch)
    return replace(draft, twist=twist)


def change_airfoils(rotor: Rotor, spec: str) -> Rotor:
    """The rotor with the airfoils of a SPEC (`rotor.blade.parse_airfoils`); ValueError also for a section not held."""
    changed = parse_airfoils(rotor, spec)
    for span in changed.blade.spans:
        load_installed(span.section)
    return changed


def check_preset(preset: str) -> None:
    """Raise ValueError for a preset that does not exist."""
    if preset not in PRESETS:
        raise ValueError(f"preset {preset!r} is not known: use {' or '.join(PRESETS)}")


@cache
def _tail_rotor() -> TailRotor:
    tail = uh60a_data()["tail_rotor"]
    d0, d1, d2 = tail["drag_polar"]
    return TailRotor(
        radius=tail["radius_m"],
        angular_speed=tail["angular_speed_rad_s"],
        chord=tail["chord_m"],
        blades=tail["blades"],
        arm=tail["arm_m"],
        cant=math.radians(tail["cant_deg"]),
        tip_loss=tail["tip_loss"],
        drag_polar=(d0, d1, d2),
        lift_slope=tail["lift_slope_per_rad"],
    )
