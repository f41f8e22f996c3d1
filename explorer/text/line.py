"""The one sentence on top of the page, of its picture and of the report: aircraft, flight, blade, power, against what.

Its pieces are words, or controls: the sliders of what the hand has set.
"""

from collections.abc import Sequence
from fractions import Fraction

from explorer.model.inputs import FLIGHT, LAWS, NOT_ALWAYS, OWN, ROWS, TWISTS, Inputs, inputs_of
from explorer.model.sliders import slider, stand_slider
from explorer.model.stand import LOAD_TITLES
from explorer.model.units import Units, number, shown
from explorer.parts.results import Kind, LineControl, LinePiece
from explorer.text.design_words import AS_BUILT, listed, twist_name, wave_names
from explorer.text.readout import change_sizes, fineness
from rotor import Design, Solution
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
"""The part of words that a telephone can do without."""
_COUNTED = ("no", "one", "two", "three", "four", "five")


def control(
    name: str, form: Slider, value: float, text: str = "", *, sign: bool = False
) -> LinePiece:
    """A number that is dragged as its slider is; `text`: in place of the number."""
    label, _, unit = form.label.partition(" [")
    text = text or number(value, form.digits, sign)
    words = " ".join(filter(None, (text, unit.rstrip("]"))))
    return LinePiece(
        text, control=LineControl(name, label, words, value, form.low, form.high, form.step)
    )


def flight_pieces(inputs: Inputs, units: Units) -> list[LinePiece]:
    """Aircraft and flight, or the test of the rotor alone."""
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
        pieces.append(LinePiece(f" {weight.label.partition('[')[2].rstrip(']')}"))
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
    else:
        pieces += [LinePiece(" in "), control("advance_ratio", speed, 0.0, "hover")]
    for name, row in FLIGHT.items():
        value = getattr(inputs, name)
        if name in ("advance_ratio", "mass_t") or not inputs.counts(row) or value == row.default:
            continue
        if stand is not None and row.in_place:
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
        if stand.shaft_tilt_deg and stand.trim != "free-rotor":
            form = stand_slider("shaft_tilt_deg", inputs)
            pieces += [
                LinePiece(", tilt "),
                control("shaft_tilt_deg", form, stand.shaft_tilt_deg),
                LinePiece("°"),
            ]
    return pieces


def twist_pieces(inputs: Inputs, design: Design | None) -> list[LinePiece]:
    """The built-in twist: the turns and bends of its law, or the name of one that has none. `design`: of the inputs,
    None where they mean none."""
    law = LAWS[inputs.law]
    turns = [
        (name, one) for name, one in zip(law.inputs, law.parameters, strict=True) if one.angular
    ]
    if inputs.law in NOT_ALWAYS or not turns:
        name = law.title.lower() if design is None else twist_name(design)
        return [LinePiece(f" with {'its twist ' if name == AS_BUILT else ''}{name}")]
    built = inputs.law == "builtin"
    if built and not any(getattr(inputs, name) for name, _ in turns):
        outer = turns[-1][0]
        return [
            LinePiece(" with its twist "),
            control(outer, _form(outer), 0.0, AS_BUILT),
            *_waves(design),
        ]
    pieces = [
        LinePiece(" with twist "),
        *([LinePiece(f"{AS_BUILT}, ", WIDE), LinePiece("Δ ")] if built else []),
    ]
    last = {one.shown_unit: name for name, one in turns}
    for k, (name, one) in enumerate(turns):
        pieces += [LinePiece(", ")] if k else []
        pieces.append(control(name, _form(name), getattr(inputs, name), sign=built))
        place = one.short.removeprefix("Δ ").lower()
        space = "" if one.shown_unit == "°" else "\u00a0"
        unit = f"{space}{one.shown_unit}" if last[one.shown_unit] == name else ""
        pieces.append(LinePiece(f"{unit} {place}".rstrip()))
    return pieces + _waves(design)


def _form(name: str) -> Slider:
    form = TWISTS[name].slider
    assert form is not None
    return form


def _waves(design: Design | None) -> list[LinePiece]:
    """Active twist and root pitch at harmonics."""
    return [] if design is None else [LinePiece(f", {wave}") for wave in wave_names(design)]


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
            LinePiece(f", drag {drag} N", WIDE),
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
    units: Units,
    known: bool = True,
    note: str = "",
    *,
    sourced: bool = True,
    built: bool = True,
) -> list[LinePiece]:
    """By how much [W] that is more or less than `than`, its band, and whether its sign is known. `sourced`: as of
    `sureness`; `built`: whether it could be, or less power is not green."""
    size, beside = change_sizes(change, band, units)
    if band is None and not any(digit in size for digit in "123456789"):
        return [LinePiece(f": no change from {than}", "against")]
    word = "" if band is None else sureness(change, band, sourced=sourced)
    sure = "" if band is None else sure_words(change, band, sourced=sourced)
    kind: Kind = (
        "" if word in ("", "unclear") else "bad" if change > 0.0 else "good" if built else ""
    )
    return [
        LinePiece(": ", "sign"),
        LinePiece(size, "moved", kind),
        LinePiece(beside, "sure-band", kind, not known),
        LinePiece(f" {units.power[0].symbol}", WIDE, kind),
        LinePiece(" more" if change > 0.0 else " less", "more", kind),
        LinePiece(f" than {than}{note}", "against"),
        *([LinePiece(f", {sure}", "sure", "", not known)] if sure else []),
    ]


def over_pieces(names: Sequence[str]) -> list[LinePiece]:
    return [LinePiece(f"; over its limits in {listed(names)}", "exceeded", "bad")] if names else []


def plain(pieces: Sequence[LinePiece], note: str = "") -> str:
    """The sentence as text; `note`: how far to trust it."""
    return "".join(piece.text for piece in pieces) + (f"; {note}" if note else "") + "."


def sentence(
    solution: Solution, units: Units, reference: Solution | None = None, band: Doubt | None = None
) -> str:
    """The line of a solution without a page. `band`: of its power and of the change from the reference."""
    design, inputs = solution.design, inputs_of(solution.design)
    carried = design.rotor.blade.carried
    blade = (
        twist_pieces(inputs, design)
        if carried is None
        else [LinePiece(f" with {carried.name}"), *_waves(design)]
    )
    pieces = [*flight_pieces(inputs, units), *blade, *power_pieces(solution, units, band)]
    if reference is not None and reference.design != design:
        within = None if band is None else band.change_band
        change = solution.power.total - reference.power.total
        than, sourced = (
            than_words(design, reference.design, pinned=False),
            band is None or band.sourced,
        )
        pieces += change_pieces(change, within, than, units, sourced=sourced)
    return plain(pieces)


def than_words(design: Design, reference: Design, pinned: bool) -> str:
    """What a change counts from, as the line names it."""
    if pinned:
        return "A"
    if design.rotor.blade.carried is not None:
        return "without it" if reference.twist == design.jig else "the best fixed blade"
    built = reference.twist == design.rotor.builtin_twist
    return AS_BUILT if built else f"with {twist_name(reference)}"
