"""A design in words: its twist, flight condition and models in full, or its name in a few words for lists."""

import math

from explorer.model.inputs import INFLOW_MENUS, LAWS, PRESET_TITLES, Inputs, baseline_of
from explorer.model.session_state import Pinned
from explorer.model.stand import TRIM_TITLES, StandInputs, stand_of
from explorer.model.units import METRE_PER_SECOND, SI, TONNE, Units, number
from rotor import Design
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.switches import SWITCHES, switched_off
from rotor.assets import MEASURED_ROTORS, SHIPPED_ROTORS
from rotor.design import (
    Harmonic,
    IdealTwist,
    LinearTwist,
    PiecewiseLinearTwist,
    QuadraticTwist,
    SplineTwist,
    SumTwist,
    TableTwist,
    TwistLaw,
)
from rotor.design.quantities import BESIDE, OPTIONS, QUANTITIES
from rotor.files.rotor_file import shipped_aircraft

_COUNT = {1: "One segment", 2: "Two segments", 3: "Three segments", 4: "Four segments"}


def against(design: Design, pinned: bool) -> str:
    """What changes are measured against, in words."""
    if pinned:
        return "A"
    built = baseline_of(design).twist == design.rotor.builtin_twist
    return f"{design.aircraft.name} as built" if built else design.aircraft.twist_title(design.preset)


def twist_words(law: TwistLaw) -> str:
    """A twist law in words, with its numbers."""
    match law:
        case LinearTwist(rate):
            return f"Linear, {_degrees(rate)}\u00a0°/R"
        case QuadraticTwist(curvature, difference):
            return (
                f"Quadratic, tip {_degrees(difference)}° relative to centre, curvature {_degrees(curvature)}\u00a0°/R²"
            )
        case PiecewiseLinearTwist(rates, breaks):
            divided = f", divided at {_joined([f'{place:.2f}' for place in breaks])}\u00a0R" if breaks else ""
            count = _COUNT.get(len(rates), f"{len(rates)} segments")
            return f"{count}, {_joined([_degrees(rate) for rate in rates])}\u00a0°/R{divided}"
        case IdealTwist(tip_pitch):
            return f"Ideal, {_degrees(tip_pitch)}°\u00a0/\u00a0r"
        case SplineTwist(_, angles):
            return f"Smooth curve through {len(angles)} angles, {_degrees(angles[-1] - angles[0])}° root to tip"
        case SumTwist(base, change):
            later = twist_words(change)
            return f"{twist_words(base)}, plus {later[:1].lower()}{later[1:]}"
        case TableTwist(name=name) if name in (*SHIPPED_ROTORS, *MEASURED_ROTORS):
            return f"{shipped_aircraft(name).name} twist as built"
        case TableTwist(name="builtin"):
            return "Twist as built"
        case TableTwist():
            return "Twist from a table"
        case _:
            return law.spec()


def wave_words(design: Design) -> str:
    """Active twist and root pitch that follow the azimuth; empty without, and in hover."""
    active = () if design.active_twist is None else design.active_twist.harmonics
    return "" if design.hovering else harmonic_words(active, design.pitch_per_rev)


def harmonic_words(twist: tuple[Harmonic, ...], pitch: tuple[Harmonic, ...]) -> str:
    """Harmonics of active twist and root pitch."""

    def words(harmonic: Harmonic) -> str:
        amplitude, phase = number(math.degrees(harmonic.amplitude), 2), math.degrees(harmonic.phase)
        return f"{amplitude}° at {harmonic.per_rev}/rev (phase {phase:.0f}°)"

    kinds = (("active twist", twist), ("root pitch", pitch))
    return " and ".join(f"{kind} of {_joined([words(wave) for wave in waves])}" for kind, waves in kinds if waves)


def title_words(design: Design) -> str:
    """Rotor and twist."""
    words = twist_words(design.twist)
    return words if words.startswith(design.rotor.name) else f"{design.rotor.name} · {words}"


def flight_words(design: Design, units: Units = SI) -> str:
    """Speed, climb, rotor speed, mass and altitude in one line."""
    condition = design.condition
    speeds = " · ".join(unit.text(design.airspeed) for unit in units.speed if unit is not METRE_PER_SECOND)
    where = "Hover" if design.hovering else f"µ {number(condition.advance_ratio, 3)} · {speeds}"
    beside = units.beside(condition)
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


def twist_name(inputs: Inputs) -> str:
    """The twist: `Two segments −14/−8 at 0.5`, after the rotor's name where it is not the UH-60A, and harmonics."""
    rotor = "" if inputs.rotor == SHIPPED_ROTORS[0] else f"{inputs.aircraft.name}, "
    given = (("twist", inputs.twist_per_rev), ("pitch", inputs.pitch_per_rev))
    waves = "".join(
        f", {harmonic.per_rev}/rev {kind} {number(math.degrees(harmonic.amplitude), 2)}°"
        for kind, harmonics in given
        for harmonic in harmonics
    )
    if inputs.law == "builtin" and inputs.built_inner == inputs.built_outer == 0.0:
        return rotor + "As built" + waves
    law = LAWS[inputs.law]
    values = "/".join(number(getattr(inputs, name), 1).removesuffix(".0") for name in law.angles)
    places = "/".join(f"{getattr(inputs, name):g}" for name in law.breaks)
    name = law.title
    if values:
        name += f" {values}" + ("°" if inputs.law == "linear" else "")
    return rotor + name + (f" at {places}" if places else "") + waves


def flight_name(inputs: Inputs, units: Units = SI) -> str:
    """The flight condition: `µ 0.25, 8.32 t`, altitude above sea level, and the effects switched off."""
    speed = f"µ {inputs.advance_ratio:g}" if inputs.advance_ratio else "hover"
    off = "".join(f", no {switch.title.lower()}" for name, switch in SWITCHES.items() if not getattr(inputs, name))
    off += "".join(f", {QUANTITIES[name].short}" for name in OPTIONS if getattr(inputs, name))
    beside = [units.said(row, getattr(inputs, row.input)) for row in BESIDE.values() if inputs.counts(row)]
    speed = ", ".join(filter(None, (speed, *beside)))
    if inputs.stand is not None:
        return f"{speed}, {stand_words(inputs.stand)}{off}"
    high = f", {units.altitude.text(inputs.altitude_m)}" if inputs.altitude_m else ""
    mass = f"{inputs.mass_t:g} t" if units is SI else units.mass.text(1e3 * inputs.mass_t)
    return f"{speed}, {mass}{high}{off}"


def pinned_name(pinned: Pinned) -> str:
    """A short name of A's blade."""
    return twist_name(pinned.inputs) + (", driven" if pinned.driven else "")


def _degrees(angle: float) -> str:
    """With one decimal, left out where it is zero."""
    return number(math.degrees(angle), 1).removesuffix(".0")


def _joined(parts: list[str]) -> str:
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"
