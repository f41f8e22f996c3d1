"""Rotors with measured airloads or with power measured in flight: what was measured, for the page to set and draw."""

import math
from dataclasses import dataclass
from functools import cache

from rotor.assets import asset_path, csv_rows
from rotor.design.design import Design
from rotor.validation.airloads import CASES, FlownCase, MeasuredCurve, measured_curves

POWER_REPORTS = {
    "gazelle": "NASA TM-88351 (1987), digitised by the authors of HEROES",
    "bo105": "DLR flight test in Padfield, Helicopter Flight Dynamics (1996), figure 4.11; its mass is not stated, "
    "2200 kg assumed",
}
"""Sources of the powers, by rotor."""


@dataclass(frozen=True)
class MeasuredPower:
    """Main-rotor power of one flight in level flight."""

    case: str
    mu: float
    mass: float
    """[kg]"""
    altitude: float
    """Pressure altitude [m]."""
    power: float
    """[W]"""

    def same_air(self, design: Design) -> bool:
        """Whether a design has this mass and altitude and neither climbs nor descends."""
        here = design.condition
        pairs = ((here.mass, self.mass), (here.altitude, self.altitude), (here.climb_speed, 0.0))
        return here.stand is None and all(math.isclose(one, other, abs_tol=1e-6) for one, other in pairs)

    def same_flight(self, design: Design) -> bool:
        """The same at this advance ratio too."""
        return self.same_air(design) and math.isclose(design.condition.advance_ratio, self.mu, abs_tol=1e-9)

    @property
    def title(self) -> str:
        """The flight in words."""
        return f"{self.case}: µ {self.mu:g}, {self.mass:g} kg, {self.altitude:g} m"


@cache
def measured_powers(rotor: str) -> tuple[MeasuredPower, ...]:
    """The powers of a shipped rotor in flight, by its name; none for a rotor without."""
    return tuple(
        MeasuredPower(
            row["case"], float(row["mu"]), float(row["mass_kg"]), float(row["altitude_m"]), 1e3 * float(row["power_kw"])
        )
        for row in csv_rows(asset_path("measured/flown_power.csv"))
        if row["rotor"] == rotor
    )


@cache
def airload_cases(rotor: str) -> tuple[FlownCase, ...]:
    """The conditions in which airloads of a shipped rotor were measured."""
    return tuple(case for case in CASES if case.rotor == rotor)


@cache
def airload_curves(rotor: str) -> tuple[MeasuredCurve, ...]:
    """All that was measured over the azimuth on a shipped rotor."""
    return tuple(curve for curve in measured_curves() if curve.case.rotor == rotor) if airload_cases(rotor) else ()


def as_measured(design: Design) -> bool:
    """Whether a design has the blade of the tests: its twist as built and none driven."""
    return design.twist == design.rotor.builtin_twist and design.active_twist is None


@cache
def _design_of(case: FlownCase) -> Design:
    return case.design()


def is_at(case: FlownCase, design: Design) -> bool:
    """Whether a design is in this condition, whatever its blade."""
    test = _design_of(case)
    return (test.condition, test.models.trim, test.pitch_per_rev) == (
        design.condition, design.models.trim, design.pitch_per_rev,
    )  # fmt: skip


def nearest_case(design: Design) -> FlownCase | None:
    """The measured condition that is most like that of a design: the same, else that nearest in advance ratio.

    None for a rotor without measured airloads.
    """

    def apart(case: FlownCase) -> tuple[bool, bool, float]:
        test = _design_of(case)
        mu = abs(test.condition.advance_ratio - design.condition.advance_ratio)
        return not is_at(case, design), test.pitch_per_rev != design.pitch_per_rev, mu

    return min(airload_cases(design.aircraft.key), key=apart, default=None)
