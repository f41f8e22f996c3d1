"""The one sentence on top of the page, of its picture and of the report: aircraft, flight, blade, power, against what.

Its pieces are words, and handles of what the hand has set: numbers, which are sliders, and words with a menu.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from explorer.model.inputs import (
    FLIGHT,
    HELD,
    INFLOW_MENUS,
    LAWS,
    NOT_ALWAYS,
    OWN,
    ROWS,
    TWISTS,
    Inputs,
    inputs_of,
    law_titles,
)
from explorer.model.sliders import STAND_SLIDERS, slider, stand_slider
from explorer.model.stand import LOAD_TITLES, StandInputs
from explorer.model.units import Units, number, shown
from explorer.parts.results import Kind, LineControl, LineMenu, LineOption, LinePiece
from explorer.text.design_words import AS_BUILT, listed, twist_name
from explorer.text.readout import change_sizes, fineness, total_size
from rotor import Design, Solution
from rotor.actuator.catalogue import find_actuator
from rotor.actuator.installation import read_actuator
from rotor.actuator.section import HostBlade, Placement, default_placement
from rotor.design import Harmonic
from rotor.design.blade import Carried
from rotor.design.design import preset_models
from rotor.design.quantities import OPTIONS, PRESETS, QUANTITIES, SWITCHES
from rotor.design.quantity import Slider
from rotor.support.user_input import shorten
from rotor.trim.doubt import Doubt, decimals, sure_words, sureness
from rotor.validation import coverage

_STANDS = {
    "wind-tunnel": "in the wind tunnel",
    "free-rotor": "turning freely",
    "controls": "with given controls",
}
WIDE = "wide"
"""The part of names that a telephone can do without."""
AIRSPEED = "airspeed"
"""What says the advance ratio once more, which the longest sentences can do without where they have little room."""
BESIDE = "beside"
"""The part of the answer that it can do without."""
MODELS = "models"
"""The part of words that say how the answer is computed."""
_COUNTED = ("no", "one", "two", "three", "four", "five")
_MOST_NAMED = 2
"""Effects that are switched, or limits, that the line names; of more it says how many, and its tooltip which."""


def control(
    name: str, form: Slider, value: float, text: str = "", *, sign: bool = False
) -> LinePiece:
    """A number that is dragged as its slider is; `text`: in place of the number."""
    label, _, bracket = form.label.partition(" [")
    unit = bracket.rstrip("]")
    text = text or number(value, form.digits, sign)
    is_number = any(digit in text for digit in "0123456789")
    handle = LineControl(
        name=name,
        slider=name,
        label=label,
        words=f"{text} {unit}".rstrip() if is_number else text,
        unit=unit,
        value=value,
        low=form.low,
        high=form.high,
        step=form.step,
        digits=form.digits,
        signed=sign,
    )
    return LinePiece(text, control=handle)


def flight_pieces(inputs: Inputs, units: Units, carried_kg: float = 0.0) -> list[LinePiece]:
    """Aircraft and flight, or the test of the rotor alone. `carried_kg`: mass of an actuator, which the slider of mass
    does not count."""
    aircraft, stand, speed = (
        inputs.aircraft,
        inputs.stand,
        slider("advance_ratio", units, inputs.aircraft),
    )
    the = [] if aircraft.isolated or inputs.rotor == OWN else [LinePiece("The ", WIDE)]
    pieces = [*the, LinePiece(shorten(aircraft.name, 40))]
    if stand is None:
        weight = slider("mass_t", units, aircraft)
        pieces += [
            LinePiece(" of "),
            control("mass_t", weight, shown(ROWS["mass_t"], inputs.mass_t, units)),
        ]
        added = number(units.mass.of(carried_kg), weight.digits)
        plus = f" + {added}" if carried_kg else ""
        pieces.append(LinePiece(f"{plus} {units.mass.symbol}"))
    else:
        where = (
            _STANDS[stand.trim]
            if inputs.advance_ratio or stand.trim != "wind-tunnel"
            else "on the test stand"
        )
        pieces.append(
            LinePiece(f"{' rotor' if the else ',' if ',' in aircraft.name else ''} {where}")
        )
    if inputs.advance_ratio:
        pieces += [LinePiece(" at µ "), control("advance_ratio", speed, inputs.advance_ratio)]
        pieces += [] if stand is not None else _airspeed_pieces(inputs, units)
    else:
        pieces += [LinePiece(" in "), control("advance_ratio", speed, 0.0, "hover")]
    for name, row in FLIGHT.items():
        value = getattr(inputs, name)
        if name in ("advance_ratio", "mass_t") or not inputs.counts(row) or value == row.default:
            continue
        form, falls = slider(name, units, aircraft), bool(row.below) and value < 0.0
        at = shown(row, value, units)
        text = number(abs(at) if falls else at, form.digits)
        unit = form.unit or form.label.partition("[")[2].rstrip("]")
        pieces += [
            LinePiece(f", {row.below if falls else row.short or 'altitude'} "),
            control(name, form, at, text),
        ]
        pieces.append(LinePiece(f" {unit}".rstrip()))
    if stand is not None:
        form, unit = (
            stand_slider(stand.load, inputs),
            {"thrust_n": " N", "collective_deg": "°"}.get(stand.load, ""),
        )
        title = LOAD_TITLES[stand.load].rpartition(" ")[2]
        pieces += [
            LinePiece(f", {title if unit == '' else title.lower()} "),
            control(stand.load, form, stand.value),
        ]
        pieces += [LinePiece(unit)] if unit else []
        pieces += _test_pieces(stand)
    pieces += [
        LinePiece(f", {units.in_words(row, value)}")
        for name, row in HELD.items()
        if inputs.counts(row) and (value := getattr(inputs, name)) is not None
    ]
    return pieces


def _airspeed_pieces(inputs: Inputs, units: Units) -> list[LinePiece]:
    """The airspeed, another number of the slider of advance ratio: ` (159 km/h)`."""
    form = slider("advance_ratio", units, inputs.aircraft)
    unit = units.speed[0]
    per_mu = unit.of(inputs.tip_speed)
    text = number(per_mu * inputs.advance_ratio)
    handle = LineControl(
        name="airspeed",
        slider="advance_ratio",
        label="Airspeed",
        words=f"{text} {unit.symbol}",
        unit=unit.symbol,
        value=inputs.advance_ratio,
        low=form.low,
        high=form.high,
        step=form.step,
        digits=0,
        factor=per_mu,
    )
    return [
        LinePiece(" (", AIRSPEED),
        LinePiece(text, AIRSPEED, control=handle),
        LinePiece(f" {unit.symbol})", AIRSPEED),
    ]


def _test_pieces(stand: StandInputs) -> list[LinePiece]:
    """What a test gives beside its load, where it is not as usual: `, tilt 5.0°, tip Mach 0.620`."""
    usual = StandInputs().with_trim(stand.trim)
    named = {"shaft_tilt_deg": (", tilt ", "°")}
    if stand.flapping == "free":
        named["cyclic_1c_deg"] = (", θ1c ", "°")
        named["cyclic_1s_deg"] = (", θ1s ", "°")
    named["tip_mach"] = (", tip Mach ", "")
    named["density"] = (", air ", " kg/m³")
    if stand.trim == "free-rotor":
        # Its tilt is found.
        del named["shaft_tilt_deg"]
    pieces = list[LinePiece]()
    for name, (before, after) in named.items():
        value = getattr(stand, name)
        if not value:
            continue
        pieces += [LinePiece(before), control(name, STAND_SLIDERS[name], value)]
        pieces += [LinePiece(after)] if after else []
    if stand.flapping == "hub-moments":
        roll = number(stand.hub_roll_nm)
        pitch = number(stand.hub_pitch_nm)
        pieces.append(LinePiece(f", hub moments {roll}/{pitch} N m"))
    elif stand.flapping != usual.flapping:
        pieces.append(LinePiece(f", flapping {stand.flapping}"))
    return pieces


def blade_pieces(inputs: Inputs, design: Design | None) -> list[LinePiece]:
    """The twist and all else that decides the power, without an actuator: ` with twist −12.0 °/R, no tip loss,`."""
    twist = twist_pieces(inputs, design)
    models = model_pieces(inputs)
    return [*twist, *models, LinePiece(",")] if models else twist


def carrying_pieces(
    inputs: Inputs, design: Design | None, actuator: Sequence[LinePiece]
) -> list[LinePiece]:
    """The same of a blade with an actuator: `, twist as built, with MFC P1 at 77 % voltage,`.

    `actuator`: the words for it.
    """
    twist = [LinePiece(", "), *_named_law(inputs, design), LinePiece(",")]
    return [*twist, *actuator, *_waves(design), *model_pieces(inputs), LinePiece(",")]


def twist_pieces(inputs: Inputs, design: Design | None) -> list[LinePiece]:
    """The built-in twist: the turns and bends of its law, or the name of one that has none. `design`: of the inputs,
    None where they mean none."""
    pieces = _named_law(inputs, design)
    before = " with its " if pieces[-1].text == AS_BUILT else " with "
    return [LinePiece(before), *pieces, *_waves(design)]


def _named_law(inputs: Inputs, design: Design | None) -> list[LinePiece]:
    """The built-in twist behind the word that chooses its law: `twist −14.0/−8.0 °/R`; a law without numbers is that
    word itself."""
    law = _law_pieces(inputs, design)
    if _is_named(inputs) and law[0].text != AS_BUILT:
        return [replace(law[0], menu=law_menu(inputs)), *law[1:]]
    return [LinePiece("twist", menu=law_menu(inputs)), LinePiece(" "), *law]


def law_menu(inputs: Inputs) -> LineMenu:
    """The twist laws that these inputs can have, as in the menu of the rail."""
    titles = law_titles(inputs)
    options = [LineOption(title, "law", law, law == inputs.law) for law, title in titles.items()]
    return LineMenu("law", "Twist law", options)


def _law_pieces(inputs: Inputs, design: Design | None) -> list[LinePiece]:
    """The numbers of the twist law: `−14.0/−8.0 °/R, break 0.50 R`; of a law without, its name."""
    law = LAWS[inputs.law]
    rows = list(zip(law.inputs, law.parameters, strict=True))
    turns = [(name, one) for name, one in rows if one.angular]
    if _is_named(inputs):
        return [LinePiece(law.title.lower() if design is None else _design_name(design))]
    built = inputs.law == "builtin"
    if built and not any(getattr(inputs, name) for name, _ in turns):
        outer = turns[-1][0]
        return [control(outer, _form(outer), 0.0, AS_BUILT, sign=True)]
    pieces = [LinePiece(f"{AS_BUILT}, ", WIDE), LinePiece("Δ ")] if built else []
    last = {one.shown_unit: name for name, one in turns}
    alike = len(last) == 1
    for k, (name, one) in enumerate(turns):
        # Rates from root to tip need no names.
        if k:
            pieces.append(LinePiece("/" if alike else ", "))
        pieces.append(control(name, _form(name), getattr(inputs, name), sign=built))
        space = "" if one.shown_unit == "°" else "\u00a0"
        unit = f"{space}{one.shown_unit}" if last[one.shown_unit] == name else ""
        place = "" if alike else one.short.lower()
        pieces += [LinePiece(words)] if (words := f"{unit} {place}".rstrip()) else []
    return pieces + _break_pieces(inputs, [name for name, one in rows if not one.angular])


def _break_pieces(inputs: Inputs, names: Sequence[str]) -> list[LinePiece]:
    """Where the segments of a law meet: `, breaks 0.40/0.75 R`."""
    pieces = list[LinePiece]()
    for name in names:
        before = f", break{'s' if len(names) > 1 else ''} "
        pieces.append(LinePiece("/" if pieces else before))
        pieces.append(control(name, _form(name), getattr(inputs, name)))
    return [*pieces, LinePiece(" R")] if pieces else []


def _is_named(inputs: Inputs) -> bool:
    """Whether the twist law has no number to drag, so that the line has its name."""
    law = LAWS[inputs.law]
    return inputs.law in NOT_ALWAYS or not any(one.angular for one in law.parameters)


def _design_name(design: Design) -> str:
    """The name of a twist without its harmonics, which the line has in words of its own."""
    return twist_name(replace(design, active_twist=None, pitch_per_rev=()))


def _form(name: str) -> Slider:
    form = TWISTS[name].slider
    assert form is not None
    return form


def _waves(design: Design | None) -> list[LinePiece]:
    """Active twist and root pitch at harmonics: `, 3/rev twist 1.00° at 180°`."""
    if design is None:
        return []
    given = "" if design.active_twist is None or design.linear_active_twist else " of given shape"
    twists = [f", {_wave('twist', wave)}{given}" for wave in design.active_waves]
    pitches = [f", {_wave('pitch', wave)}" for wave in design.pitch_per_rev]
    return [LinePiece(words) for words in (*twists, *pitches)]


def _wave(kind: str, wave: Harmonic) -> str:
    amplitude = number(math.degrees(wave.amplitude), 2)
    phase = number(math.degrees(wave.phase))
    return f"{wave.per_rev}/rev {kind} {amplitude}° at {phase}°"


def model_pieces(inputs: Inputs) -> list[LinePiece]:
    """How the answer is computed, where it is not as usual: `, no tip loss, inflow: Drees`."""
    effects = _effect_words(inputs)
    if len(effects) <= _MOST_NAMED:
        pieces = [LinePiece(f", {one}", MODELS) for one in effects]
    else:
        # Each one more or less is another number.
        title = f"{listed(effects).capitalize()}."
        pieces = [LinePiece(f", {len(effects)} effects switched", MODELS, title=title)]
    preset = [] if inputs.preset == PRESETS[0] else [f"preset {inputs.preset}"]
    others = [*preset, *_inflow_words(inputs), *_grid_words(inputs)]
    return pieces + [LinePiece(f", {one}", MODELS) for one in others]


def _effect_words(inputs: Inputs) -> list[str]:
    """Effects that are not as the preset has them: `no tip loss`."""
    usual = preset_models(inputs.preset)
    words = list[str]()
    for name, switch in SWITCHES.items():
        if getattr(inputs, name) != getattr(usual, name):
            words.append(f"{'' if getattr(inputs, name) else 'no '}{switch.title.lower()}")
    return words + [QUANTITIES[name].short for name in OPTIONS if getattr(inputs, name)]


def _inflow_words(inputs: Inputs) -> list[str]:
    """Choices of the inflow that are not the preset's: `inflow: Drees`."""
    usual = preset_models(inputs.preset)
    words = list[str]()
    for name, titles in INFLOW_MENUS.items():
        chosen = getattr(inputs, name)
        if chosen != getattr(usual, name):
            words.append(f"{QUANTITIES[name].title.lower()}: {titles[chosen]}")
    return words


def _grid_words(inputs: Inputs) -> list[str]:
    """Elements, azimuths and airfoils where a design asks for its own: `24 elements`."""
    words = list[str]()
    for name in ("elements", "azimuths"):
        count = getattr(inputs, name)
        if count is not None:
            words.append(f"{count} {name}")
    if inputs.law in NOT_ALWAYS and inputs.airfoils:
        words.append(f"airfoils {shorten(inputs.airfoils, 40)}")
    return words


def carried_layout(carried: Carried) -> str:
    """As `layout_words`, of an actuator that a design carries."""
    actuator = read_actuator(carried.spec)
    return layout_words(actuator.id, actuator.placement, actuator.host, crossed=actuator.crossed)


def layout_words(id: str, placement: Placement, host: HostBlade, *, crossed: bool) -> str:
    """How an actuator is laid out, where it is not as it comes: ` (4 plies, 0.30…0.90 R)`; else empty."""
    usual = default_placement()
    words = list[str]()
    if placement.plies != usual.plies:
        words.append(find_actuator(id).count(placement))
    if placement.span != usual.span:
        words.append("{:.2f}…{:.2f} R".format(*placement.span))
    if placement.chord != usual.chord:
        words.append("{:.2f}…{:.2f} c".format(*placement.chord))
    if host.kind == "new":
        words.append(host.label)
    if crossed:
        words.append("crossed")
    return f" ({', '.join(words)})" if words else ""


def power_pieces(
    solution: Solution, units: Units, band: Doubt | None, known: bool = True
) -> list[LinePiece]:
    """What it needs, with its band; where that is not `known` of this design, it is of the one before."""
    power, unit = solution.power, units.power[0]
    if solution.design.models.trim == "free-rotor" and (ratio := solution.lift_to_drag) is not None:
        # Its shaft has no power: the band is that of drag times speed.
        within, drag = "", number(solution.lift_and_drag[1])
        if band is not None and band.power:
            within = f" ± {number(ratio * band.band / band.power, 1)}"
        title = _band_sentence(band, units)
        verb, shown = (
            LinePiece(" has lift-to-drag ", "verb"),
            LinePiece(number(ratio, 1), "total-power", title=title),
        )
        return [
            verb,
            shown,
            LinePiece(within, "within", stale=not known),
            LinePiece(f", drag {drag} N", BESIDE),
        ]
    total = number(abs(unit.of(power.total)), fineness(power, units))
    driven = power.total < 0.0 and any(digit in total for digit in "123456789")
    shown = LinePiece(total, "total-power", title=_band_sentence(band, units))
    pieces = [LinePiece(" takes " if driven else " needs ", "verb"), shown]
    if band is not None and band.of == "Power":
        within = unit.of(band.band)
        digits = max(fineness(power, units), decimals(within))
        pieces.append(
            LinePiece(
                f" ± {number(within, digits)}",
                "within",
                stale=not known,
                title=f"{coverage_words()}.",
            )
        )
    return [*pieces, LinePiece(f" {unit.symbol}{' from the air' if driven else ''}", "verb")]


def _band_sentence(band: Doubt | None, units: Units) -> str:
    """The power with its band and what the design saves; empty without a band."""
    if band is None:
        return ""
    unit = units.power[0]
    return band.in_words("It", (unit.symbol, unit.size))


def coverage_words() -> str:
    """How often a measured power lies in the band, of rotors that had no part in its size."""
    part, of = (
        _COUNTED[k]
        for k in Fraction(coverage()).limit_denominator(len(_COUNTED) - 1).as_integer_ratio()
    )
    return f"{part.capitalize()} of {of} measured powers lie in such a band"


def change_pieces(
    change: float,
    band: float | None,
    than: str,
    reference: float,
    units: Units,
    known: bool = True,
    note: str = "",
    *,
    menu: LineMenu | None = None,
    sourced: bool = True,
    built: bool = True,
) -> list[LinePiece]:
    """By how much [W] that is more or less than `than`, which needs `reference` [W], its band, and whether its sign is
    known. `menu`: what else it can be compared with. `sourced`: as of `sureness`; `built`: whether it could be, or less
    power is not green."""
    against = LinePiece(than, "against", menu=menu)
    power = f" ({total_size(reference, units)})"
    size, beside = change_sizes(change, band, units)
    if band is None and not any(digit in size for digit in "123456789"):
        return [LinePiece(": no change from ", "than"), against, LinePiece(power, "reference")]
    word = "" if band is None else sureness(change, band, sourced=sourced)
    said = "" if band is None else sure_words(change, band, sourced=sourced)
    cap = said.removeprefix(word)
    kind: Kind = (
        "" if word in ("", "unclear") else "bad" if change > 0.0 else "good" if built else ""
    )
    return [
        LinePiece(": ", "sign"),
        LinePiece(size, "moved", kind),
        LinePiece(beside, "sure-band", kind, not known),
        LinePiece(f" {units.power[0].symbol}", BESIDE, kind),
        LinePiece(" more" if change > 0.0 else " less", "more", kind),
        LinePiece(" than ", "than"),
        against,
        LinePiece(f"{power}{note}", "reference"),
        *([LinePiece(f", {word}", "sure", "", not known, cap.strip(", "))] if word else []),
        *([LinePiece(cap, "cap", "", not known)] if cap else []),
    ]


def over_pieces(names: Sequence[str]) -> list[LinePiece]:
    """The limits that are exceeded: `; over its limits in voltage and mass`; of many, how many."""
    if not names:
        return []
    said = f"over its limits in {listed(names)}"
    if len(names) <= _MOST_NAMED:
        return [LinePiece(f"; {said}", "exceeded", "bad")]
    title = f"{said[0].upper()}{said[1:]}."
    return [LinePiece(f"; over {len(names)} limits", "exceeded", "bad", title=title)]


def plain(pieces: Sequence[LinePiece], note: str = "") -> str:
    """The sentence as text; `note`: how far to trust it."""
    return "".join(piece.text for piece in pieces) + (f"; {note}" if note else "") + "."


def sentence(
    solution: Solution,
    units: Units,
    reference: Solution | None = None,
    band: Doubt | None = None,
    *,
    models: bool = True,
) -> str:
    """The line of a solution without a page. `band`: of its power and of the change from the reference. `models`:
    whether it says how the answer is computed."""
    design = solution.design
    pieces = [piece for piece in design_pieces(design, units) if models or piece.part != MODELS]
    pieces += power_pieces(solution, units, band)
    if reference is not None and reference.design != design:
        within = None if band is None else band.change_band
        change = solution.power.total - reference.power.total
        than, sourced = (
            than_words(design, reference.design, pinned=False),
            band is None or band.sourced,
        )
        pieces += change_pieces(change, within, than, reference.power.total, units, sourced=sourced)
    return plain(pieces)


def design_pieces(design: Design, units: Units) -> list[LinePiece]:
    """All that decides the power of a design: its flight, its blade, its actuator, its models."""
    inputs = inputs_of(design)
    carried = design.rotor.blade.carried
    if carried is None:
        return flight_pieces(inputs, units) + blade_pieces(inputs, design)
    words = f" with {carried.name}{carried_layout(carried)}"
    flight = flight_pieces(inputs, units, carried.aircraft_kg)
    return flight + carrying_pieces(inputs, design.bare, [LinePiece(words)])


def than_words(design: Design, reference: Design, pinned: bool) -> str:
    """What a change counts from, as the line names it."""
    if pinned:
        return "A"
    if design.rotor.blade.carried is not None:
        return "without it" if reference.twist == design.jig else "the best fixed blade"
    built = reference.twist == design.rotor.builtin_twist
    return AS_BUILT if built else f"with {twist_name(reference)}"
