"""A design from names: preset, aircraft, twist SPEC."""

import tomllib
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import Any

from rotor.aero.inflow import inflow_model
from rotor.assets import MEASURED_ROTORS, SHIPPED_ROTORS, asset_path
from rotor.design.active_twist import PerRev, linear_active_twist, read_harmonics
from rotor.design.aircraft import Aircraft, FlightCondition, advance_ratio, number
from rotor.design.blade import Rotor, parse_airfoils
from rotor.design.design import TRIMS, Design, Models, check_preset, preset_models
from rotor.design.retired import current_model
from rotor.design.stand import STAND_TRIMS, Stand, read_stand
from rotor.design.twist import TwistLaw
from rotor.files.rotor_file import ISOLATED_LOADING, shipped_aircraft
from rotor.user_input import did_you_mean

ADVANCE_RATIO = 0.2
"""Of a design whose speed is not given."""


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


def make_design(
    *,
    rotor: Aircraft | str = SHIPPED_ROTORS[0],
    twist: TwistLaw | str | None = None,
    twist_per_rev: PerRev = (),
    pitch_per_rev: PerRev = (),
    mu: float | None = None,
    speed_kt: float | None = None,
    hover: bool = False,
    mass_kg: float | None = None,
    altitude_m: float = 0.0,
    climb_m_s: float = 0.0,
    preset: str = "flight",
    inflow: str | None = None,
    models: Models | None = None,
    trim: str | None = None,
    stand: Stand | Mapping[str, Any] | None = None,
) -> Design:
    """A design from names and numbers; left out, it is the UH-60A with its built-in twist at µ = 0.2.

    rotor: `uh60a`, `r22`, `s61`, or what `load_rotor` returns.
    twist: a law, or a SPEC as `parse_twist` reads it, for example `linear:-12` (degrees per radius); by default the
        twist that the preset compares with.
    twist_per_rev: active twist, linear from the root cut-out, `N:DEG:PHASE[,…]` or a list of (N, DEG, PHASE): DEG of
        the tip relative to the root, as it would be on a blade at rest, most nose-up at ψ = PHASE/N.
    pitch_per_rev: the same of the root pitch, 2 to 8/rev: DEG cos(N ψ − PHASE). Both rest in hover.
    mu, speed_kt, hover: advance ratio V/(ΩR), airspeed in knots, or `hover=True`; one of them at most.
    mass_kg: aircraft mass; by default the rotor's reference mass. altitude_m: pressure altitude.
    climb_m_s: rate of climb, negative in descent; mu and speed_kt are of the horizontal speed.
    preset: `flight`, the best models available, or `thesis`, those of the source document. On a rotor other than the
        UH-60A `thesis` means the document's models with that rotor's own sections, planform, hinge and twist.
    inflow: forward-flight inflow model by name, in place of the preset's. models: all model choices at once.
    trim: `propulsive` or `thrust` in flight; `wind-tunnel`, `free-rotor` or `controls` on a test stand.
    stand: the inputs of the test, a `Stand`, or a mapping such as {"shaft_tilt_deg": 5, "ct_over_sigma": 0.08}; its
        keys: `rotor.design.stand.STAND_KEYS`. A rotor without an airframe is in a wind tunnel at C_T/σ 0.07 by default.

    Raises TypeError or ValueError with one sentence that names the value and the remedy.
    """
    check_preset(preset)
    if isinstance(rotor, str):
        if rotor not in (*SHIPPED_ROTORS, *MEASURED_ROTORS):
            known = (*SHIPPED_ROTORS, *MEASURED_ROTORS)
            hint = did_you_mean(rotor, known) or ":"
            raise ValueError(
                f'rotor {rotor!r} is not known{hint} use {", ".join(known)}, or rotor.load_rotor("mine.toml")'
            )
        rotor = shipped_aircraft(rotor)
    elif not isinstance(rotor, Aircraft):  # pyright: ignore[reportUnnecessaryIsInstance] - notebooks pass anything
        raise TypeError(f'rotor {rotor!r} is not a rotor: use a name such as "uh60a", or rotor.load_rotor("mine.toml")')
    blades = rotor.rotor_for(preset)
    if models is None:
        models = preset_models(preset)
    if inflow is not None:
        inflow = current_model("inflow", inflow)
        inflow_model(inflow)
        models = replace(models, inflow=inflow)
    models, stand = _test(rotor, models, trim, stand)
    speed = advance_ratio(blades.tip_speed, mu, speed_kt, hover)
    condition = FlightCondition(
        ADVANCE_RATIO if speed is None else speed,
        rotor.mass if mass_kg is None else number("mass_kg", mass_kg, "8000"),
        number("altitude_m", altitude_m, "1500"),
        stand=stand,
        climb_speed=number("climb_m_s", climb_m_s, "5"),
    )
    design = Design(
        preset=preset,
        aircraft=rotor,
        rotor=blades,
        twist=rotor.twist_for(preset),
        condition=condition,
        fuselage=rotor.fuselage,
        tail_rotor=rotor.tail_rotor,
        models=models,
        active_twist=linear_active_twist(read_harmonics(twist_per_rev, "twist_per_rev"), blades.blade.root_cutout),
        pitch_per_rev=read_harmonics(pitch_per_rev, "pitch_per_rev"),
    )
    return design if twist is None else design.with_twist(twist)


def _test(
    aircraft: Aircraft, models: Models, trim: str | None, stand: Stand | Mapping[str, Any] | None
) -> tuple[Models, Stand | None]:
    """The models with the trim asked for, and the test stand that goes with it."""
    if trim is None:
        tested = stand is not None or aircraft.isolated
        trim = models.trim if models.trim in STAND_TRIMS or not tested else STAND_TRIMS[0]
    if trim not in TRIMS:
        raise ValueError(f"trim {trim!r} is not known: use one of {', '.join(TRIMS)}")
    if stand is None and aircraft.isolated and trim in STAND_TRIMS[:2]:
        stand = {"ct_over_sigma": ISOLATED_LOADING}
    if stand is not None and not isinstance(stand, Stand):
        stand = read_stand(stand, trim)
    return (models if trim == models.trim else replace(models, trim=trim)), stand


def change_airfoils(rotor: Rotor, spec: str) -> Rotor:
    """The rotor with the airfoils of a SPEC (`parse_airfoils`). Raises ValueError for an unknown SPEC or section."""
    changed = parse_airfoils(rotor, spec)
    for span in changed.blade.spans:
        changed.blade.installed(span.section)
    return changed
