"""A design in words: the name of its twist, the same in titles, lists and names of files; its flight condition and
models."""

import math
from collections.abc import Sequence

from explorer.model.inputs import INFLOW_MENUS, PRESET_TITLES, Inputs, baseline_of, baseline_title
from explorer.model.stand import TRIM_TITLES, StandInputs, stand_of
from explorer.model.units import METRE_PER_SECOND, SI, TONNE, Units, number
from rotor import Design, Rotor
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.switches import SWITCHES, switched_off
from rotor.design import (
    Harmonic,
    IdealTwist,
    LinearTwist,
    PiecewiseLinearTwist,
    SumTwist,
    TableTwist,
    TwistLaw,
)
from rotor.design.quantities import OPTIONS, QUANTITIES, UNUSUAL
from rotor.design.twist import SpecTwist
from rotor.files.rotor_file import shipped_aircraft
from rotor.support.assets import MEASURED_ROTORS, SHIPPED_ROTORS
from rotor.support.user_input import shorten

AS_BUILT = "as built"
FEW_SEGMENTS = 3
"""As many as the sliders have: a twist of more has its numbers in its file."""
LONGEST_TITLE = 70
"""Characters."""


def against(design: Design, reference: Design, pinned: bool) -> str:
    """What changes are measured against, in words."""
    if pinned:
        return "A"
    if design.rotor.blade.carried is not None:
        return baseline_title(design, reference)
    built = baseline_of(design).twist == design.rotor.builtin_twist
    return (
        f"{design.aircraft.name} as built" if built else design.aircraft.twist_title(design.preset)
    )


def wave_words(design: Design) -> str:
    """Active twist and root pitch that follow the azimuth; empty without, and in hover."""
    return "" if design.hovering else harmonic_words(design.active_waves, design.pitch_per_rev)


def harmonic_words(twist: tuple[Harmonic, ...], pitch: tuple[Harmonic, ...]) -> str:
    """Harmonics of active twist and root pitch."""

    def words(harmonic: Harmonic) -> str:
        amplitude, phase = number(math.degrees(harmonic.amplitude), 2), math.degrees(harmonic.phase)
        return f"{amplitude}° at {harmonic.per_rev}/rev (phase {phase:.0f}°)"

    kinds = (("active twist", twist), ("root pitch", pitch))
    return " and ".join(
        f"{kind} of {listed([words(wave) for wave in waves])}" for kind, waves in kinds if waves
    )


def title_words(design: Design) -> str:
    """Rotor and twist, in one line of a page."""
    rotor, words = shorten(design.rotor.name, 24), twist_name(design)
    title = f"{rotor} {words}" if words.startswith(AS_BUILT) else f"{rotor} · {words}"
    return title if len(title) <= LONGEST_TITLE else shorten(title, LONGEST_TITLE)


def twist_name(design: Design) -> str:
    """The twist in a few words, without the numbers that only a program sets: `as built + MFC P1 at 1 155 V`,
    `segments −14/−8 at 0.5`, `40 segments, −12.3° root to tip`; then its harmonics."""
    waves = wave_names(design)
    few, carried = (
        waves if len(waves) < 3 else [f"{len(waves)} harmonics"],
        design.rotor.blade.carried,
    )
    rests = "" if carried is None or design.twist != design.jig else f" + {carried.name}"
    return ", ".join((_law_name(design.twist, design.rotor) + rests, *few))


def wave_names(design: Design) -> list[str]:
    """Active twist and root pitch, a wave each."""
    return [
        f"{wave.per_rev}/rev {kind} {number(math.degrees(wave.amplitude), 2)}°"
        for kind, harmonics in (("twist", design.active_waves), ("pitch", design.pitch_per_rev))
        for wave in harmonics
    ]


def _law_name(law: TwistLaw, rotor: Rotor) -> str:
    turn = math.degrees(float(law(1.0) - law(rotor.blade.root_cutout)))
    angle = f"{number(turn, 1, sign=True)}° root to tip"
    match law:
        case _ if law == rotor.builtin_twist:
            return AS_BUILT
        case SumTwist(base, change, name):
            return f"{_law_name(base, rotor)} + {name or _law_name(change, rotor)}"
        case LinearTwist(rate):
            return f"linear {_degrees(rate)}\u00a0°/R"
        case PiecewiseLinearTwist(rates, breaks) if len(rates) <= FEW_SEGMENTS:
            places = "/".join(f"{place:.2f}".rstrip("0") for place in breaks)
            return f"segments {'/'.join(map(_degrees, rates))}" + (
                f" at {places}" if places else ""
            )
        case PiecewiseLinearTwist(rates):
            return f"{len(rates)} segments, {angle}"
        case IdealTwist(tip_pitch):
            return f"ideal {_degrees(tip_pitch)}°/r"
        case TableTwist(name=name) if name in (*SHIPPED_ROTORS, *MEASURED_ROTORS):
            return f"twist of the {shipped_aircraft(name).name}"
        case _:
            return f"{law.noun if isinstance(law, SpecTwist) else 'custom twist'}, {angle}"


def flight_words(design: Design, units: Units = SI) -> str:
    """Speed, climb, rotor speed, mass and altitude in one line."""
    condition = design.condition
    speeds = " · ".join(
        unit.text(design.airspeed) for unit in units.speed if unit is not METRE_PER_SECOND
    )
    where = "Hover" if design.hovering else f"µ {number(condition.advance_ratio, 3)} · {speeds}"
    beside = units.unusual(design)
    if (stand := stand_of(design)) is not None:
        return " · ".join((where, *beside, stand_words(stand)))
    mass = units.mass.text(condition.mass, 2 if units.mass is TONNE else 0)
    return " · ".join((where, *beside, mass, units.altitude.text(condition.altitude)))


def stand_words(stand: StandInputs) -> str:
    """A test in one line: what is given, without what the standard atmosphere sets."""
    trim = TRIM_TITLES[stand.trim].partition(": ")[2]
    load = {"ct_over_sigma": f"CT/σ {stand.value:.4g}", "thrust_n": f"{stand.value:.5g} N"}
    words = [trim, load.get(stand.load, f"collective {number(stand.value, 2)}°")]
    if stand.shaft_tilt_deg is not None and stand.trim != "free-rotor":
        words.append(f"tilt {number(stand.shaft_tilt_deg, 1)}°")
    if stand.flapping == "free" and (stand.cyclic_1c_deg or stand.cyclic_1s_deg):
        words.append(f"cyclic {number(stand.cyclic_1c_deg, 1)}°, {number(stand.cyclic_1s_deg, 1)}°")
    if stand.flapping == "hub-moments":
        words.append(f"hub moments {stand.hub_roll_nm:.4g}, {stand.hub_pitch_nm:.4g} N m")
    words += [f"tip Mach {stand.tip_mach:.4g}"] if stand.tip_mach is not None else []
    words += [f"{stand.density:.4g} kg/m³"] if stand.density is not None else []
    return ", ".join(words)


def model_words(design: Design) -> str:
    """Preset, inflow and physics in one line."""
    preset = PRESET_TITLES.get(design.preset, design.preset)
    return f"{preset}: {inflow_words(design)}, {physics_words(design)}"


def inflow_words(design: Design) -> str:
    """The inflow model in use: that of hover, or that of forward flight."""
    if design.hovering:
        title = INFLOW_MENUS["hover_inflow"][design.models.hover_inflow].lower()
        return f"{title}, eq. (3.3)" if design.models.hover_inflow == "closed-form" else title
    return INFLOW_MODELS[design.models.inflow].title


def physics_words(design: Design) -> str:
    """The effects that are switched off; with none, the losses included."""
    off = [f"no {switch.title.lower()}" for switch in switched_off(design.models)]
    return ", ".join(off) or "tip and root loss"


def flight_name(inputs: Inputs, units: Units = SI) -> str:
    """The flight condition: `µ 0.25, 8.32 t`, altitude above sea level, and the effects switched off."""
    speed = f"µ {inputs.advance_ratio:g}" if inputs.advance_ratio else "hover"
    off = "".join(
        f", no {switch.title.lower()}"
        for name, switch in SWITCHES.items()
        if not getattr(inputs, name)
    )
    off += "".join(f", {QUANTITIES[name].short}" for name in OPTIONS if getattr(inputs, name))
    beside = [
        units.in_words(row, getattr(inputs, row.input))
        for row in UNUSUAL.values()
        if inputs.counts(row)
    ]
    speed = ", ".join(filter(None, (speed, *beside)))
    if inputs.stand is not None:
        return f"{speed}, {stand_words(inputs.stand)}{off}"
    high = f", {units.altitude.text(inputs.altitude_m)}" if inputs.altitude_m else ""
    tonnes = round(inputs.mass_t, 2 if inputs.mass_t > 1.0 else 3)  # As its slider shows it.
    mass = f"{tonnes:g} t" if units.mass is TONNE else units.mass.text(1e3 * inputs.mass_t)
    return f"{speed}, {mass}{high}{off}"


def _degrees(angle: float) -> str:
    """With one decimal, left out where it is zero."""
    return number(math.degrees(angle), 1).removesuffix(".0")


def listed(names: Sequence[str]) -> str:
    """`fibre strain, temperature and mass`"""
    return " and ".join(filter(None, (", ".join(names[:-1]), *names[-1:])))
