"""How well a rotor has been validated in the region of a solution, in words, from the rows of the trust page."""

import math
import re
from dataclasses import dataclass

from explorer.model.stand import airload_cases, as_measured, flight_powers
from explorer.model.units import number
from rotor.reproduce.report import typographic
from rotor.trim.solution import Solution
from rotor.validation.airloads import REPORTS
from rotor.validation.flown import POWER_REPORTS
from rotor.validation.measured import MeasuredSet, sets_of
from rotor.validation.trust import TrustRow, trust_rows

_DIGITISED = "uh60a-hover"
"""The set whose rows give the worst and the best of its points, in hover by annuli."""


@dataclass(frozen=True)
class ValidationRecord:
    """What measurement says about a rotor here."""

    words: str
    """For the chip."""
    sentence: str
    measured: MeasuredSet | None = None
    """The set that is nearest; None where nothing was measured."""


def validated(solution: Solution) -> ValidationRecord:
    """The nearest measured set of this rotor, and how far the program was from it."""
    design = solution.design
    sets = sets_of(design.aircraft.key)
    kind = "hover" if design.hovering else "forward"
    where = "in hover" if design.hovering else "in forward flight"
    alike = [one for one in sets if one.kind == kind]
    if not alike and (flown := _flown(solution)) is not None:
        return flown
    if not alike:
        note = f"No measured power of this rotor {where} could be reached."
        if sets:
            note += f" It was measured in {'forward flight' if design.hovering else 'hover'} only."
        return ValidationRecord("no test data at this condition", note)
    measured = nearest(alike, solution)
    row = row_of(measured, _inflow(solution))
    report = f"{measured.title}, {measured.report}"
    if row is None:
        words = f"Not compared with this inflow model. Measured: {report}."
        return ValidationRecord("not compared with this inflow", words, measured)
    outside = beyond(measured, solution)
    parts = [f"Against measurement: {row.shown} ({report}).", row.remark]
    if outside:
        parts.insert(0, f"Outside what was compared: {outside}.")
    if design.twist != design.rotor.builtin_twist or design.active_twist is not None:
        parts.append("Measured with the twist as built; no measurement of this twist is known.")
    if design.pitch_per_rev:
        parts.append("Measured with collective and cyclic alone.")
    words = f"measured: {_short(row, measured)}" if not outside else "outside the test range"
    sentence = typographic(" ".join(part for part in parts if part))
    return ValidationRecord(words, re.sub(r"\bC_(?=[TPQ])", "C", sentence), measured)


def _flown(solution: Solution) -> ValidationRecord | None:
    """What was measured of this rotor in flight, or of its airloads in a tunnel; None where neither was."""
    design = solution.design
    key, blade = design.aircraft.key, "" if as_measured(design) else " Measured with the twist as built."
    powers, cases = flight_powers(key), airload_cases(key)
    airloads = "" if not cases else " The probe shows its measured airloads."
    if powers and not design.hovering and design.condition.stand is None:
        report = POWER_REPORTS[key]
        count = f"{len(powers)} flights at µ {powers[0].mu:g} to {max(one.mu for one in powers):g}"
        here = next((one for one in powers if one.same_flight(design)), None)
        if here is None or blade:
            return ValidationRecord("measured in flight", f"Power was measured in {count}: {report}.{blade}{airloads}")
        percent = 100.0 * (solution.power.main_rotor / here.power - 1.0)
        words = f"measured: {number(percent, 1, sign=True)} % ({here.case})"
        kilowatts = f"{number(solution.power.main_rotor / 1e3, 1)} kW, measured {number(here.power / 1e3, 1)} kW"
        return ValidationRecord(words, f"Main rotor {kilowatts} ({report}).{airloads}")
    if cases and design.condition.stand is not None and not design.hovering:
        report = REPORTS[cases[0].test]
        return ValidationRecord("airloads measured", f"Its power was not measured; its airloads were: {report}.{blade}"
                                f"{airloads}")  # fmt: skip
    return None


def nearest(sets: list[MeasuredSet], solution: Solution) -> MeasuredSet:
    """The set whose test is most like the solution's: trim, then shaft tilt, then one with a target before others."""
    stand = solution.design.condition.stand
    trim = solution.design.models.trim

    def apart(one: MeasuredSet) -> tuple[bool, float, bool]:
        tilts = [point["shaft_tilt_deg"] for point in one.points] if "shaft_tilt_deg" in one.given else [0.0]
        tilt = math.degrees(solution.controls.shaft_tilt if stand is None else stand.tilt)
        return one.trim != trim, min(abs(tilt - other) for other in tilts), one.indicative

    return min(sets, key=apart)


def beyond(measured: MeasuredSet, solution: Solution) -> str:
    """What of a solution lies outside the points that the row counts, in words; empty where nothing does."""
    climb = solution.design.condition.climb_speed
    if climb:
        return f"rate of climb {climb:g} m/s, compared in level flight"
    points = [point for point in measured.points if measured.is_judged(point)] or list(measured.points)
    found = {"mu": solution.design.condition.advance_ratio, "ct": solution.ct, "ct_over_sigma": solution.ct_over_sigma}
    for name, value in found.items():
        if name not in measured.given:
            continue
        values = [point[name] for point in points]
        low, high = min(values), max(values)
        margin = 0.05 * max(abs(high), abs(low))
        if not low - margin <= value <= high + margin:
            return f"{_SHORT[name]} {value:.3g}, compared {low:.3g}…{high:.3g}"
    return ""


def row_of(measured: MeasuredSet, inflow: str) -> TrustRow | None:
    """The row of a set with an inflow model; None where that was not compared."""
    rows = [row for row in trust_rows() if row.set == measured.name]
    if measured.name == _DIGITISED:
        return rows[0] if inflow == "annulus" else None
    return next((row for row in rows if row.what.endswith(f", inflow {inflow}")), None)


def _short(row: TrustRow, measured: MeasuredSet) -> str:
    error = 0.0 if row.error is None else 100.0 * abs(row.error)
    size = "within" if measured.name == _DIGITISED else "rms"
    return f"{size} {number(error, 1)} %"


def _inflow(solution: Solution) -> str:
    models = solution.design.models
    return models.hover_inflow if solution.design.hovering else models.inflow


_SHORT = {"mu": "µ", "ct": "CT", "ct_over_sigma": "CT/σ"}
