"""A design from names: preset, aircraft, twist SPEC, models."""

from collections.abc import Mapping
from dataclasses import replace
from inspect import cleandoc
from numbers import Integral
from typing import Any, Unpack

from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.problem import check_azimuths
from rotor.aero.switches import parse_switches
from rotor.design.active_twist import PerRev, linear_active_twist, read_harmonics
from rotor.design.aircraft import Aircraft, FlightCondition, Stand, changed_condition, read_stand
from rotor.design.blade import Rotor, with_airfoils
from rotor.design.design import Design, Models, check_preset, preset_models, with_grid, with_numbers
from rotor.design.quantities import (
    ARGUMENTS,
    HOVER_INFLOWS,
    LOAD_KEYS,
    OPTIONS,
    PRESETS,
    STAND_TRIMS,
    SWEPT,
    Flight,
)
from rotor.design.quantity import check_names
from rotor.design.twist import TwistLaw
from rotor.files.rotor_file import ISOLATED_LOADING, find_aircraft, shipped_aircraft
from rotor.support.assets import SHIPPED_ROTORS
from rotor.support.user_input import check_known

ADVANCE_RATIO = 0.2
"""Advance ratio of a design whose speed is not given."""


def uh60a_rotor(preset: str) -> Rotor:
    """The UH-60A's main rotor as flown (`flight`) or as the document states it (`thesis`)."""
    check_preset(preset)
    return shipped_aircraft("uh60a").rotor_for(preset)


def _other_way(name: str) -> str:
    """How to ask for a temperature, by whatever name it was asked for; empty for other names."""
    warmer = {"isa", "temperature", "temp", "oat"} & set(name.lower().split("_"))
    return "isa_offset_c=20, the difference from the standard atmosphere in °C" if warmer else ""


def make_design(
    *,
    case: Design | None = None,
    rotor: Aircraft | str | None = None,
    twist: TwistLaw | str | None = None,
    twist_per_rev: PerRev | None = None,
    pitch_per_rev: PerRev | None = None,
    mu: float | None = None,
    hover: bool = False,
    preset: str | None = None,
    inflow: str | None = None,
    low_speed: str | None = None,
    loss_on: str | None = None,
    airfoils: str | None = None,
    off: str | None = None,
    bending: bool = False,
    elements: int | None = None,
    azimuths: int | None = None,
    models: Models | None = None,
    trim: str | None = None,
    stand: Stand | Mapping[str, Any] | None = None,
    **flight: Unpack[Flight[float | None]],
) -> Design:
    """A design from names and numbers; left out, it is the UH-60A with its built-in twist at µ = 0.2.

    The command line has a flag for each argument but `models`, with the same words.

    Parameters:
        {arguments}

    Returns:
        The design, which `solve`, `sweep` and `optimise` take. Nothing is solved yet.

    Raises:
        TypeError: a value is of another kind than the argument takes.
        ValueError: a value is outside its range, a name is not known, or two arguments exclude each other.

    Example:
        >>> design = rotor.make_design(mu=0.3, twist="linear:-12", mass_kg=8000)
        >>> design
        Design(UH-60A, twist linear:-12, mu=0.3, 8000 kg, 0 m, preset flight, inflow lifting-line)
        >>> high = rotor.make_design(case=design, altitude_m=1500)
        >>> high.condition.altitude, high.twist == design.twist
        (1500.0, True)
    """
    check_names(make_design, flight, SWEPT, _other_way)
    asked = {"mu": mu, "hover": hover, "bending": bending, **flight}
    _check_type(
        str, "a text", preset=preset, inflow=inflow, low_speed=low_speed, loss_on=loss_on, trim=trim
    )
    _check_type(str, "a text", airfoils=airfoils, off=off)
    _check_type(Integral, "a whole number", elements=elements, azimuths=azimuths)
    _check_type(Design, "a design: give what rotor.load_design or make_design returns", case=case)
    _check_type(Models, "rotor.Models", models=models)
    _check_type((Stand, Mapping), "a dictionary of what the test gives, or a Stand", stand=stand)
    if bending not in (True, False):
        raise TypeError(f"bending is {bending!r:.40}: write bending=True or leave it out")
    name = preset or (case.preset if case else PRESETS[0])
    check_preset(name)
    aircraft = _aircraft(rotor, case)
    kept, blade = _kept(case, rotor, name)
    own = kept.twist if kept and kept.twist != aircraft.twist_for(kept.preset) else None
    models = models or (case.models if case and name == case.preset else preset_models(name))
    models, stand = _test(aircraft, models, trim, stand, kept)
    chosen = {
        "low_speed": low_speed,
        "loss_on": loss_on,
        **{option: True for option in OPTIONS if asked[option]},
    }
    blades, body = aircraft.rotor_for(name), kept or aircraft
    before = case.condition if case else FlightCondition(ADVANCE_RATIO, aircraft.mass, stand=stand)
    overrides = {"stand": stand} if rotor is None else {"stand": stand, "mass": aircraft.mass}
    active, pitch = blade.active_twist if blade else None, case.pitch_per_rev if case else ()
    if twist_per_rev is not None:
        active = linear_active_twist(
            read_harmonics(twist_per_rev, "twist_per_rev"), blades.blade.root_cutout
        )
    design = Design(
        preset=name,
        aircraft=aircraft,
        rotor=blades,
        twist=own or aircraft.twist_for(name),
        condition=changed_condition(before, blades.tip_speed, asked, **overrides),
        fuselage=body.fuselage,
        tail_rotor=body.tail_rotor,
        models=with_grid(_changed(models, inflow, off, chosen), elements, azimuths),
        active_twist=active,
        gust=case.gust if case else None,
        pitch_per_rev=pitch
        if pitch_per_rev is None
        else read_harmonics(pitch_per_rev, "pitch_per_rev"),
    )
    design = with_numbers(design, asked)
    if twist is not None:
        design = design.with_twist(twist)
    if blade:
        design = replace(design, rotor=blade.rotor)
    check_azimuths(design)
    return replace(design, rotor=change_airfoils(design.rotor, airfoils)) if airfoils else design


if make_design.__doc__:  # `python -OO` drops docstrings.
    choices = {"inflow": (*INFLOW_MODELS, *HOVER_INFLOWS)}
    words = (
        f"{name}: {row.help_with(choices.get(name, row.choices))}."
        for name, row in ARGUMENTS.items()
    )
    make_design.__doc__ = cleandoc(make_design.__doc__).replace("{arguments}", "\n    ".join(words))


def _check_type(kind: type | tuple[type, ...], words: str, **given: object) -> None:
    """TypeError with one sentence for an argument of another kind; None is an argument that is left out."""
    for name, value in given.items():
        if value is not None and not isinstance(value, kind):
            raise TypeError(f"{name} is {value!r:.40}, not {words}")


def _aircraft(rotor: Aircraft | str | None, case: Design | None) -> Aircraft:
    if rotor is None:
        return case.aircraft if case else shipped_aircraft(SHIPPED_ROTORS[0])
    if isinstance(rotor, str):
        return find_aircraft(rotor)
    if not isinstance(rotor, Aircraft):  # pyright: ignore[reportUnnecessaryIsInstance] - notebooks pass anything
        raise TypeError(
            f'rotor {rotor!r} is not a rotor: use a name such as "uh60a", or a rotor file, "mine.toml"'
        )
    return rotor


def _kept(
    case: Design | None, rotor: Aircraft | str | None, preset: str
) -> tuple[Design | None, Design | None]:
    """The case where its aircraft stays, and where its blade does too: not on another rotor, nor of another preset."""
    kept = case if rotor is None else None
    blade = kept if kept and kept.preset == preset else None
    carried = case.rotor.blade.carried if case and not blade else None
    if carried is not None:
        raise ValueError(
            f"the blades of the case carry {carried.name}: leave rotor and preset as they are"
        )
    return kept, blade


def _changed(
    models: Models, inflow: str | None, off: str | None, chosen: Mapping[str, str | bool | None]
) -> Models:
    """The models with an inflow model by name, choices by field, which they check, and without some effects."""
    if inflow is not None:
        check_known("inflow model", inflow, (*INFLOW_MODELS, *HOVER_INFLOWS))
        models = replace(
            models, **{"inflow" if inflow in INFLOW_MODELS else "hover_inflow": inflow}
        )
    models = replace(
        models, **{field: value for field, value in chosen.items() if value is not None}
    )
    return replace(models, **dict.fromkeys(parse_switches(off), False)) if off else models


def _test(
    aircraft: Aircraft,
    models: Models,
    trim: str | None,
    stand: Stand | Mapping[str, Any] | None,
    case: Design | None,
) -> tuple[Models, Stand | None]:
    """The models with the trim asked for, and the test stand that goes with it, on top of that of a case."""
    if (
        case
        and case.condition.stand
        and trim in (None, case.models.trim)
        and not isinstance(stand, Stand)
    ):
        trim, given = case.models.trim, stand or {}
        loaded = any(key in given for key in LOAD_KEYS)
        before = case.condition.stand.record().items()
        stand = {key: value for key, value in before if not (loaded and key in LOAD_KEYS)} | dict(
            given
        )
    if trim is None:
        tested = stand is not None or aircraft.isolated
        trim = models.trim if models.trim in STAND_TRIMS or not tested else STAND_TRIMS[0]
    ARGUMENTS["trim"].check_choice(trim)
    if stand is None and aircraft.isolated and trim in STAND_TRIMS[:2]:
        stand = {"ct_over_sigma": ISOLATED_LOADING}
    if stand is not None and not isinstance(stand, Stand):
        stand = read_stand(stand, trim)
    return (models if trim == models.trim else replace(models, trim=trim)), stand


def change_airfoils(rotor: Rotor, spec: str) -> Rotor:
    """The rotor with the sections of a SPEC: names root to tip, changes (r/R) after @, as `sc1094r8,sc1095@0.5`.

    Raises ValueError for another SPEC, or a section that is not known.
    """
    names, _, places = spec.strip().partition("@")
    try:
        breaks = [float(item) for item in places.split(",")] if places else []
    except ValueError:
        raise ValueError(
            f"airfoils {spec!r} hold a station that is not a number: write sc1094r8,sc1095@0.5"
        ) from None
    changed = with_airfoils(rotor, [name.strip() for name in names.split(",")], breaks)
    for span in changed.blade.spans:
        changed.blade.installed(span.section)
    return changed
