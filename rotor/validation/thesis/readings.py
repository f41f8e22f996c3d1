"""What the thesis leaves open of its model, and which of its statements each reading gives.

A reading is the `thesis` preset with other section data, Prandtl's factors elsewhere, another unit of twist or power
counted otherwise. All combinations are judged by the one rule of figures 3.11–3.14.
"""

from dataclasses import dataclass, replace
from functools import cache
from itertools import product
from typing import NamedTuple

import numpy as np

from rotor.airfoil.polynomial import THESIS_NAME, PolynomialReading, parse_reading
from rotor.design.blade import with_airfoils
from rotor.design.design import Design, with_models
from rotor.design.quantities import LOSS_ON, LossOn
from rotor.files.make_design import make_design
from rotor.trim.solve import solve
from rotor.validation.thesis.report import TOLERANCE
from rotor.validation.thesis.runs import FIVE_RATES
from rotor.validation.thesis.twist_effect import (
    DOCUMENT_HOVER,
    DOCUMENT_STRONG,
    HIGH,
    LOW,
    MEDIUM,
    by_parabola,
)

RANGES = ((-10.0, 15.0), (-10.0, 18.0), (-10.0, 20.0))
"""Ranges of the fit [deg]. The thesis says only that its polynomials represent stall, too."""
SECTIONS = (
    *(PolynomialReading("free", 0.3, ends).name for ends in RANGES),
    # The tripped polars end at 18°.
    *(
        PolynomialReading("tripped", mach, ends).name
        for mach in (0.1, 0.3, 0.4)
        for ends in RANGES[:2]
    ),
    "sc1095",
)
"""Section names of the readings: polynomials of one Mach number, and the table with Mach number."""
UNITS = ("per radius", "root to tip")
COUNTS = ("sum", "torque")
"""Power: induced + profile + parasite (p. 25), or torque × Ω + parasite (3.10)."""
OVERTAKES = 0.18
"""Advance ratio after which −8° needs the least power (p. 28)."""
STATEMENTS = (
    "hover: −13.5° best (3.11)",
    "hover: −16° past it (3.11)",
    "low speed: −16° no more than 0° (3.12)",
    "beyond µ 0.18: −8° best (3.13)",
    "high speed: −4° best (3.14)",
)


class ThesisReading(NamedTuple):
    """One way to read the thesis."""

    section: str
    loss_on: LossOn
    unit: str
    counted: str


@dataclass(frozen=True)
class Judgement:
    """What one reading gives of the five statements."""

    reading: ThesisReading
    optimum_deg: float
    """Best linear twist in hover, in the unit of the reading [°]."""
    excess: tuple[float, ...]
    """Part of power by which each statement is missed, or for the second the part by which −16° exceeds the least."""
    overtakes: float
    """µ at which −8° begins to need less power than −12°; NaN where it does not between 0.075 and 0.25."""

    @property
    def holds(self) -> tuple[bool, ...]:
        """Each statement, by the tolerance of all figures."""
        return tuple(
            (value > TOLERANCE) if k == 1 else (value <= TOLERANCE)
            for k, value in enumerate(self.excess)
        )


def reading_design(section: str, loss_on: LossOn, rate: float, mu: float) -> Design:
    """The `thesis` preset with these section data, Prandtl's factors there, and a linear twist [°/R]."""
    design = make_design(preset="thesis", twist=f"linear:{rate:.12g}", mu=mu)
    design = with_models(
        replace(design, rotor=with_airfoils(design.rotor, (section,), ())), loss_on=loss_on
    )
    if section.startswith(THESIS_NAME):
        return design
    # Equation (3.3) has one lift curve for the whole blade; with Mach number the annulus balance takes its place.
    return with_models(design, hover_inflow="annulus")


def judge(section: str, loss_on: LossOn) -> tuple[Judgement, ...]:
    """These section data and loss, for every unit of twist and count of power."""
    root = make_design(preset="thesis").rotor.blade.root_cutout

    @cache
    def powers(rate: float, mu: float) -> tuple[float, ...]:
        budget = solve(reading_design(section, loss_on, rate, mu)).require().power
        return budget.main_rotor, budget.shaft + budget.parasite

    def judged(unit: str, count: str) -> Judgement:
        per_unit, which = 1.0 if unit == UNITS[0] else 1.0 / (1.0 - root), COUNTS.index(count)

        def power(angle: float, mu: float) -> float:
            return powers(angle * per_unit, mu)[which]

        def cost(angle: float, mu: float) -> float:
            return power(angle, mu) / min(power(float(rate), mu) for rate in FIVE_RATES) - 1.0

        rates = np.arange(-24.0, -7.0, 2.0)
        best, least = by_parabola(rates, np.array([power(float(rate), 0.0) for rate in rates]))
        speeds = (*LOW, *MEDIUM[1:])
        gaps = [power(-12.0, mu) - power(-8.0, mu) for mu in speeds]
        rises = [j for j in range(len(gaps) - 1) if gaps[j] < 0.0 <= gaps[j + 1]]
        excess = (
            power(DOCUMENT_HOVER, 0.0) / least - 1.0,
            power(DOCUMENT_STRONG, 0.0) / least - 1.0,
            max(power(-16.0, mu) / power(0.0, mu) for mu in LOW) - 1.0,
            max(cost(-8.0, mu) for mu in MEDIUM if mu > OVERTAKES),
            max(cost(-4.0, mu) for mu in HIGH),
        )
        met = (
            float(np.interp(0.0, gaps[rises[0] : rises[0] + 2], speeds[rises[0] :][:2]))
            if rises
            else float("nan")
        )
        return Judgement(ThesisReading(section, loss_on, unit, count), best, excess, met)

    return tuple(judged(unit, count) for unit, count in product(UNITS, COUNTS))


def described(section: str) -> str:
    """Section data in words."""
    if not section.startswith(THESIS_NAME):
        return "table over Mach number"
    reading = parse_reading(section)
    low, high = reading.range_deg
    transition = "free" if reading.transition == "free" else "at 5 % chord"
    return f"{transition}, M {reading.mach:g}, {low:g}…{high:g}°"


def shortfall(judgement: Judgement) -> float:
    """The sum of what the statements that do not hold miss the tolerance by, over power [-]."""
    return sum(
        abs(one - TOLERANCE)
        for one, held in zip(judgement.excess, judgement.holds, strict=True)
        if not held
    )


def judged_readings() -> list[Judgement]:
    """Every reading with these section data: first the one that most statements hold of, or that misses least."""
    found = [judgement for pair in product(SECTIONS, LOSS_ON) for judgement in judge(*pair)]
    return sorted(found, key=lambda judgement: (-sum(judgement.holds), shortfall(judgement)))
