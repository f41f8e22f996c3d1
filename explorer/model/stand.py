"""The test stand of the page: what is given in place of weight and drag; and what was measured of a rotor and where."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

from rotor import Aircraft, Design, Solution, make_design
from rotor.design import Flapping, Harmonic, Stand
from rotor.design.aircraft import read_stand
from rotor.design.quantities import LOAD_KEYS, STAND, STAND_TRIMS, UNUSUAL, StandTrim
from rotor.validation import (
    CASES,
    FlownCase,
    MeasuredCurve,
    design_at,
    inflow,
    measured_curves,
    sets_of,
)
from rotor.validation.airloads import PITCH_LINK
from rotor.validation.flown import MeasuredPower, measured_powers

TRIM_TITLES: dict[str, str] = {
    "flight": "Flight",
    "wind-tunnel": "Test stand: wind tunnel",
    "free-rotor": "Test stand: free rotor",
    "controls": "Test stand: controls",
}
"""The menu: flight, and the trims of a test stand."""
LOAD_TITLES = {name: row.title for name, row in STAND.items() if name in LOAD_KEYS}
"""What the rotor is given, by key of a record."""
_ANGLE_DECIMALS = 9
"""Decimals of angles that were radians."""

_FIELDS = {
    name: row.input or name for name, row in STAND.items() if row.numeric and name not in LOAD_KEYS
}
"""Field of `StandInputs` by key of a record, but for what is given and flapping."""
_GIVEN_WITH: dict[Flapping, tuple[str, ...]] = {
    "free": ("cyclic_1c_deg", "cyclic_1s_deg"),
    "hub-moments": ("hub_roll_nm", "hub_pitch_nm"),
}
"""Keys of a record that only one kind of flapping is given with."""


@dataclass(frozen=True)
class StandInputs:
    """A test as the page holds it: degrees, and None where the standard atmosphere holds."""

    trim: StandTrim = "wind-tunnel"
    load: str = "ct_over_sigma"
    """Which of `LOAD_KEYS` is given."""
    value: float = 0.07
    shaft_tilt_deg: float | None = None
    """Positive forward; None is 0. Of a free rotor it is found, and this is only where the search begins."""
    cyclic_1c_deg: float = 0.0
    cyclic_1s_deg: float = 0.0
    flapping: Flapping = "trimmed"
    hub_roll_nm: float = 0.0
    hub_pitch_nm: float = 0.0
    tip_mach: float | None = None
    density: float | None = None

    def stand(self) -> Stand:
        """The inputs of the trim; ValueError with one sentence for values that no test has."""
        record: dict[str, Any] = {self.load: self.value, "flapping": self.flapping}
        unused = {
            name
            for flapping, names in _GIVEN_WITH.items()
            if flapping != self.flapping
            for name in names
        }
        record |= {key: getattr(self, name) for key, name in _FIELDS.items() if key not in unused}
        return read_stand(
            {key: value for key, value in record.items() if value is not None}, self.trim
        )

    def with_trim(self, trim: StandTrim, collective_deg: float | None = None) -> "StandInputs":
        """A test with another trim: given controls need a collective and free flapping."""
        if trim != "controls":
            return replace(self, trim=trim, flapping="trimmed" if trim == "wind-tunnel" else "free")
        changed = replace(self, trim=trim, flapping="free")
        if self.load == "collective_deg":
            return changed
        return replace(
            changed, load="collective_deg", value=8.0 if collective_deg is None else collective_deg
        )


def stand_of(design: Design) -> StandInputs | None:
    """The test of a design; None in flight."""
    stand = design.condition.stand
    if stand is None:
        return None
    record = {
        key: round(float(value), _ANGLE_DECIMALS) if STAND[key].unit == "°" else value
        for key, value in stand.record().items()
    }
    load = next(key for key in LOAD_KEYS if key in record)
    values = {name: record[key] for key, name in _FIELDS.items() if key in record}
    trim: StandTrim = next(trim for trim in STAND_TRIMS if trim == design.models.trim)
    return StandInputs(trim=trim, load=load, value=record[load], flapping=stand.flapping, **values)


def load_of(solution: Solution, load: str) -> float:
    """What a solution has of one of `LOAD_KEYS`, in its unit, rounded to what a slider shows."""
    match load:
        case "ct_over_sigma":
            return round(solution.ct_over_sigma, 4)
        case "thrust_n":
            thrust = solution.ct * solution.design.thrust_unit
            return round(thrust, 4 - math.ceil(math.log10(max(thrust, 1.0))))
        case _:
            return round(math.degrees(solution.controls.collective), 2)


def equivalent_stand(solution: Solution) -> StandInputs:
    """The wind tunnel in which the rotor does what it does in this flight."""
    design = solution.design
    return StandInputs(
        value=load_of(solution, "ct_over_sigma"),
        shaft_tilt_deg=None
        if design.hovering
        else round(math.degrees(solution.controls.shaft_tilt), 2),
        tip_mach=round(design.tip_mach, 4),
        density=round(design.condition.density, 4),
    )


def flight_powers(rotor: str) -> tuple[MeasuredPower, ...]:
    """The powers of a shipped rotor measured in flight, by its name; none for a rotor without."""
    return tuple(measured for measured in measured_powers() if measured.rotor == rotor)


def airload_cases(rotor: str) -> tuple[FlownCase, ...]:
    """The conditions in which airloads of a shipped rotor were measured."""
    return tuple(case for case in CASES if case.rotor == rotor)


@cache
def airload_curves(rotor: str) -> tuple[MeasuredCurve, ...]:
    """All that was measured over the azimuth on a shipped rotor."""
    return (
        tuple(curve for curve in measured_curves() if curve.case.rotor == rotor)
        if airload_cases(rotor)
        else ()
    )


def as_measured(design: Design) -> bool:
    """Whether a design has the blade of the tests: its twist as built and none driven."""
    return design.twist == design.rotor.builtin_twist and design.active_twist is None


@cache
def _design_of(case: FlownCase) -> Design:
    return case.design()


def is_at(case: FlownCase, design: Design) -> bool:
    """Whether a design is in this condition, whatever its blade; on a stand whatever its mass."""
    test, here = _design_of(case), design.condition
    if here.stand is not None:
        here = replace(here, mass=test.condition.mass)
    return (test.condition, test.models.trim, test.pitch_per_rev) == (
        here,
        design.models.trim,
        design.pitch_per_rev,
    )


def nearest_case(design: Design) -> FlownCase | None:
    """The measured condition that is most like that of a design: the same, else that nearest in advance ratio.

    In flight one of those flown, on a stand one of a stand; None for a rotor without.
    """

    def apart(case: FlownCase) -> tuple[bool, bool, float]:
        test = _design_of(case)
        mu = abs(test.condition.advance_ratio - design.condition.advance_ratio)
        return not is_at(case, design), test.pitch_per_rev != design.pitch_per_rev, mu

    on_stand = design.condition.stand is not None
    cases = [
        case
        for case in airload_cases(design.aircraft.key)
        if ("stand" in case.conditions) == on_stand
    ]
    return min(cases, key=apart, default=None)


@dataclass(frozen=True)
class MeasuredCondition:
    """One measured point of a rotor, as the page can be set to it."""

    test: str
    label: str
    advance_ratio: float
    stand: StandInputs | None
    """None: flown, with the mass and the altitude below."""
    mass: float = 0.0
    """[kg]"""
    altitude: float = 0.0
    """[m]"""
    pitch_per_rev: tuple[Harmonic, ...] = ()
    first: bool = False
    """Whether a rotor begins with it; where none says so, with the middle one of the first test."""

    @property
    def inputs(self) -> dict[str, Any]:
        """What it sets of the page's inputs, by name."""
        shared = {
            "advance_ratio": self.advance_ratio,
            "stand": self.stand,
            "pitch_per_rev": self.pitch_per_rev,
        }
        tested = self.stand is not None
        shared |= {
            row.input: row.default
            for row in UNUSUAL.values()
            if row.applies(tested=tested, axial=True)
        }
        return (
            shared
            if tested
            else {**shared, "mass_t": round(self.mass / 1e3, 6), "altitude_m": self.altitude}
        )


@cache
def measured_conditions(rotor: str) -> tuple[MeasuredCondition, ...]:
    """The measured points of a shipped rotor, by its name; none for a rotor that was not measured."""
    conditions: list[MeasuredCondition] = []
    for measured in sets_of(rotor):
        if measured.against is not None:
            continue  # The conditions belong to another measured set.
        names = [name for name in measured.given if name != "tip_mach"]
        several = [name for name in names if len({point[name] for point in measured.points}) > 1]
        for number, point in enumerate(measured.points, 1):
            words = ", ".join(f"{SHORT[name]} {point[name]:.4g}" for name in several)
            conditions.append(
                _condition(measured.menu, f"{number}: {words}", design_at(measured, point))
            )
    if rotor == inflow.ROTOR:
        for number, (mu, (tilt, ct)) in enumerate(inflow.CONDITIONS.items(), 1):
            solidity = make_design(rotor=rotor).rotor.solidity
            stand = StandInputs(value=ct / solidity, shaft_tilt_deg=tilt)
            conditions.append(
                MeasuredCondition(
                    "Inflow, laser velocimeter", f"{number}: µ {mu:g}, tilt {tilt:g}°", mu, stand
                )
            )
    powers = flight_powers(rotor)
    flown = {measured.case for measured in powers}
    conditions.extend(
        MeasuredCondition(
            "Flight",
            measured.title,
            measured.mu,
            None,
            mass=measured.mass,
            altitude=measured.altitude,
        )
        for measured in powers
    )
    for number, case in enumerate(case for case in airload_cases(rotor) if case.name not in flown):
        title, label = _CASES.get(case.name, (case.test, case.name))
        conditions.append(replace(_condition(title, label, case.design()), first=number == 0))
    return tuple(conditions)


def _condition(test: str, label: str, design: Design) -> MeasuredCondition:
    here = design.condition
    return MeasuredCondition(
        test,
        label,
        here.advance_ratio,
        stand_of(design),
        here.mass,
        here.altitude,
        design.pitch_per_rev,
    )


def condition_of(rotor: str, case: str) -> MeasuredCondition | None:
    """The measured condition of a flight or of airloads, by the name of the case."""
    label = _CASES.get(case, ("", f"{case}:"))[1]
    return next(
        (
            condition
            for condition in measured_conditions(rotor)
            if condition.label.startswith(label)
        ),
        None,
    )


def opening(conditions: Sequence[MeasuredCondition]) -> MeasuredCondition:
    return next(
        (condition for condition in conditions if condition.first), conditions[len(conditions) // 2]
    )


def first_condition(rotor: str) -> MeasuredCondition | None:
    """The condition that a measured rotor begins with: the middle one of its first test."""
    conditions = measured_conditions(rotor)
    first = [condition for condition in conditions if condition.test == conditions[0].test]
    return opening(first) if first else None


def tested(aircraft: Aircraft) -> tuple[float, StandInputs]:
    """Advance ratio and test that a rotor without an airframe begins with."""
    condition = first_condition(aircraft.key)
    if condition is None or condition.stand is None:
        return 0.0, StandInputs()
    return condition.advance_ratio, condition.stand


def place_of(solution: Solution) -> dict[str, float]:
    """Where a solution is among measured points: what these may be given by, in their units."""
    theta, mu = math.degrees(solution.controls.collective), solution.design.condition.advance_ratio
    return {
        "mu": mu,
        "ct": solution.ct,
        "ct_over_sigma": solution.ct_over_sigma,
        "collective_deg": theta,
    }


SHORT = {
    "mu": "µ",
    "ct": "CT",
    "ct_over_sigma": "CT/σ",
    "shaft_tilt_deg": "tilt",
    "collective_deg": "collective",
}
_CASES = {
    "BL": ("HART II", "Baseline"),
    "MN": ("HART II", "Minimum noise: 3/rev pitch"),
    **{case.name: ("Tunnel, pitch link", case.name) for case in CASES if case.test == PITCH_LINK},
}
"""Title of the test and of the point in the menu, by the name of a case of airloads."""
