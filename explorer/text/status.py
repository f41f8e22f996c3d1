"""Status and trust: how a solve ended, its caveats, how it was computed, and how well this rotor is validated here."""

import math
import re
from dataclasses import dataclass

from explorer.model.stand import SHORT, airload_cases, as_measured, flight_powers, place_of
from explorer.model.units import SI, Units, number
from explorer.text.design_words import inflow_words, physics_words
from explorer.text.glossary import SECTIONS, tip
from rotor import Solution
from rotor.aero.problem import grid_of
from rotor.support.compiled import compiling
from rotor.support.markup import Content, Markup, tag
from rotor.support.units import typographic
from rotor.validation import MeasuredSet, TrustRow, sets_of, trust_rows
from rotor.validation.airloads import PITCH_LINK, REPORTS
from rotor.validation.compare import page_of
from rotor.validation.flown import POWER_REPORTS
from rotor.validation.trust import KINDS


def status_panel(
    solution: Solution | None,
    problem: str | None = None,
    pinned: Solution | None = None,
    units: Units = SI,
) -> Markup:
    """A box of constant height: convergence, caveats, and the models used.

    `pinned`: A, whose caveats are added where two designs are compared.
    """
    if problem is None and solution is not None and not solution.converged:
        problem = solution.message
    if problem is not None:
        # In full, even if it is a line longer than the box: the numbers below are out of date anyway.
        return _status(
            "problem",
            tag("div.rx-sentence", f"{problem.rstrip('.')}. Greyed: last converged solution."),
        )
    if solution is None:
        return _status("waiting", f"{compiling() or 'Computing the first trim'} …")
    caveats = [
        tag("div.rx-care", tag("span", "▲"), tag("span", text))
        for text in cautions(solution, pinned, units)
    ]
    count = f"{solution.passes} iteration{'' if solution.passes == 1 else 's'}"
    residual = f"Force residual < {tiny(solution.residual)} of the weight, {count}."
    text = tag("div", tag("span.rx-good", "●"), f" {solution.message} ", residual)
    sentence = units.in_power_unit(validated(solution).sentence)
    measured = tag("div.rx-small", sentence, data_explorer="measurement")
    return _status("converged", text, caveats, measured, provenance(solution))


def cautions(solution: Solution, pinned: Solution | None, units: Units = SI) -> list[str]:
    """Caveats of a solution; with A pinned, those of both, and the other differences between the two."""
    sentences = _own_cautions(solution, units)
    if pinned is None:
        return sentences
    if not pinned.converged:
        return [f"A: {pinned.message}", *sentences]
    other = _own_cautions(pinned, units)
    a, b = pinned.design, solution.design
    apart = []
    if a.condition != b.condition:
        apart.append(
            "A and B fly in different conditions, so the design alone does not explain the difference."
        )
    if (a.preset, a.models) != (b.preset, b.models):
        apart.append(
            "A and B use different models, so the blade alone does not explain the difference."
        )
    return [
        *apart,
        *(sentence for sentence in sentences if sentence in other),
        *(f"A: {sentence}" for sentence in other if sentence not in sentences),
        *(f"B: {sentence}" for sentence in sentences if sentence not in other),
    ]


def _own_cautions(solution: Solution, units: Units) -> list[str]:
    return [typographic(units.in_power_unit(caveat.sentence)) for caveat in solution.caveats]


def tiny(value: float) -> str:
    """The power of ten just above a small positive number."""
    exponent = min(math.floor(-math.log10(value)), 15) if 0.0 < value < 1.0 else 15
    return "10⁻" + str(exponent).translate(str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹"))


def provenance(solution: Solution) -> Markup:
    """The models used, and the kind of result."""
    design = solution.design
    took = solution.elapsed
    time = f"{number(1e3 * took, 1)} ms" if took < 1.0 else f"{number(took, 1)} s"
    sections = dict.fromkeys(section_title(span.section) for span in design.rotor.blade.spans)
    words = (
        f": {inflow_words(design)}, {' / '.join(sections)}, {physics_words(design)}, "
        f"{' × '.join(map(str, grid_of(design)))} grid, {time}. Indicative: a model, not a measurement."
    )
    return tag(
        "div.rx-small.rx-dim", "Preset ", tag("i", design.preset), words, data_explorer="provenance"
    )


def section_title(section: str) -> str:
    return SECTIONS.get(section) or (
        "SC1095 polynomials" if section.startswith("sc1095-thesis") else section
    )


def _status(kind: str, *content: Content) -> Markup:
    attributes = {"data_explorer": "status", "data_kind": kind, "title": tip("status")}
    return tag(f"div.rx-status.rx-{kind}", *content, **attributes)


def trust_page() -> Markup:
    """Comparisons by kind."""
    hint = tag("div.rx-dim", "Point at a row to see the test that verifies it.")
    rows = {kind: [_trust_row(row) for row in trust_rows() if row.kind == kind] for kind in KINDS}
    parts = [[tag("h2", title), rows[kind]] for kind, title in KINDS.items()]
    return tag("div.rx.rx-small.rx-trust", hint, parts, data_explorer="trust")


def _trust_row(row: TrustRow) -> Markup:
    hint = ". ".join(part.rstrip(".") for part in (row.remark, row.test) if part)
    compared = tag("span", _printed(row.what), " ", tag("span.rx-dim", _printed(row.against)))
    return tag("div.rx-trust-row", compared, tag("b", _printed(row.shown)), title=hint)


@dataclass(frozen=True)
class ValidationRecord:
    """What measurement says about a rotor here."""

    words: str
    sentence: str
    measured: MeasuredSet | None = None
    """The set that is nearest; None where nothing was measured."""


def validated(solution: Solution) -> ValidationRecord:
    """The nearest measured set of this rotor, and how far the program was from it."""
    design = solution.design
    sets = sets_of(design.aircraft.key)
    kind = "hover" if design.hovering else "forward"
    where = "in hover" if design.hovering else "in forward flight"
    alike = [record for record in sets if record.kind == kind]
    if not alike and (flown := _flown(solution)) is not None:
        return flown
    if not alike:
        note = f"We found no measured power of this rotor {where}."
        if sets:
            note += f" It was measured in {'forward flight' if design.hovering else 'hover'} only."
        return ValidationRecord("no test data at this condition", note)
    measured = nearest(alike, solution)
    row = row_of(measured, design.models.hover_inflow if design.hovering else design.models.inflow)
    report = f"{measured.title}, {measured.report}"
    if row is None:
        sentence = _printed(
            f"Not compared with this inflow model. Measured: {report}.", measured.remarks
        )
        return ValidationRecord("not compared with this inflow", sentence, measured)
    outside = beyond(measured, solution)
    parts = [f"Compared with measurement: {row.shown} ({report}).", row.remark]
    if outside:
        parts.insert(0, f"Outside the tested range: {outside}.")
    if design.twist != design.rotor.builtin_twist or design.active_twist is not None:
        parts.append(
            "The measured blade has the twist as built; we know of no measurement with this twist."
        )
    if design.pitch_per_rev:
        parts.append("The test used collective and cyclic only.")
    parts.append(measured.remarks)
    error = 0.0 if row.error is None else abs(row.error)
    words = "outside the test range" if outside else f"measured: rms {number(100.0 * error, 1)} %"
    return ValidationRecord(words, _printed(*parts), measured)


def _printed(*parts: str) -> str:
    """In a line, with minus signs, coefficients without underscores, and no number apart from its per cent."""
    text = typographic(" ".join(filter(None, parts)))
    return re.sub(r"(?<=[Cc])_(?=[A-Za-z])", "", text).replace(" %", "\u00a0%")


def _flown(solution: Solution) -> ValidationRecord | None:
    """What was measured of this rotor in flight, or of its airloads in a tunnel; None where neither was."""
    design = solution.design
    key, blade = (
        design.aircraft.key,
        "" if as_measured(design) else " The measured blade has the twist as built.",
    )
    powers, cases = flight_powers(key), airload_cases(key)
    what = "pitch-link load" if cases and cases[0].test == PITCH_LINK else "airloads"
    airloads = "" if not cases else f" The probe shows its measured {what}."
    if powers and not design.hovering and design.condition.stand is None:
        report = POWER_REPORTS[key]
        count = (
            f"{len(powers)} flights at µ {powers[0].mu:g} to {max(power.mu for power in powers):g}"
        )
        here = next((power for power in powers if power.same_flight(design)), None)
        if here is None or blade:
            return ValidationRecord(
                "measured in flight", f"Power was measured in {count}: {report}.{blade}{airloads}"
            )
        words = f"measured: {number(100.0 * here.error(solution), 1, sign=True)} % ({here.case})"
        kilowatts = f"{number(solution.power.main_rotor / 1e3, 1)} kW, measured {number(here.power / 1e3, 1)} kW"
        return ValidationRecord(words, f"Main rotor: computed {kilowatts} ({report}).{airloads}")
    if cases and design.condition.stand is not None and not design.hovering:
        report = REPORTS[cases[0].test]
        sentence = (
            f"Its power was not measured. {what[0].upper()}{what[1:]}: {report}.{blade}{airloads}"
        )
        return ValidationRecord(f"{what} measured", sentence)
    return None


def nearest(sets: list[MeasuredSet], solution: Solution) -> MeasuredSet:
    """The set whose test is most like the solution's: trim, then shaft tilt, then one with a target before others."""
    stand = solution.design.condition.stand
    trim = solution.design.models.trim

    def apart(measured: MeasuredSet) -> tuple[bool, float, bool]:
        tilts = (
            [point["shaft_tilt_deg"] for point in measured.points]
            if "shaft_tilt_deg" in measured.given
            else [0.0]
        )
        tilt = math.degrees(solution.controls.shaft_tilt if stand is None else stand.tilt)
        return measured.trim != trim, min(abs(tilt - other) for other in tilts), measured.indicative

    return min(sets, key=apart)


def beyond(measured: MeasuredSet, solution: Solution) -> str:
    """What of a solution lies outside the points that the row counts, in words; empty where nothing does."""
    climb = solution.design.condition.climb_speed
    if climb:
        return f"rate of climb {climb:g} m/s, tested in level flight"
    points = [point for point in measured.points if measured.counts(point)]
    for name, value in place_of(solution).items():
        if name not in measured.given:
            continue
        values = [point[name] for point in points]
        low, high = min(values), max(values)
        margin = 0.05 * max(abs(high), abs(low))
        if not low - margin <= value <= high + margin:
            return f"{SHORT[name]} {value:.3g}, tested {low:.3g}…{high:.3g}"
    return ""


def row_of(measured: MeasuredSet, inflow: str) -> TrustRow | None:
    """The row of a set with an inflow model; None where that was not compared."""
    rows = [row for row in trust_rows() if row.set == page_of(measured.name)]
    own = [row for row in rows if row.what.startswith(f"{measured.title}: ")]
    return next((row for row in own if row.what.endswith(f", inflow {inflow}")), None)
