"""What the thesis leaves open of its section data and unit of twist, and which of its statements each reading gives.

Every reading is the `thesis` preset with other section data or another unit of twist, judged by the one rule of
figures 3.11–3.14.
"""

from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from rotor.airfoil.polynomial import THESIS_NAME, PolynomialReading, parse_reading
from rotor.design.blade import with_airfoils
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.reproduce.report import TOLERANCE, Agreement, Report, TableCell, table
from rotor.reproduce.runs import FIVE_RATES, CachedFunction, Call
from rotor.reproduce.twist_effect import DOCUMENT_HOVER, DOCUMENT_STRONG, HIGH, LOW, MEDIUM, by_parabola
from rotor.trim.solve import solve

RANGES = ((-10.0, 15.0), (-10.0, 18.0), (-10.0, 20.0))
"""Ranges of the fit [deg]. The thesis says only that its polynomials represent stall, too."""
SECTIONS = (
    *(PolynomialReading("free", 0.3, ends).name for ends in RANGES),
    # The tripped polars end at 18°.
    *(PolynomialReading("tripped", mach, ends).name for mach in (0.1, 0.3, 0.4) for ends in RANGES[:2]),
    "sc1095",
)
"""Section names of the readings: polynomials of one Mach number, and the table with Mach number."""
UNITS = ("per radius", "root to tip")
STATEMENTS = (
    "hover: −13.5° best (3.11)",
    "hover: −16° past it (3.11)",
    "low speed: −16° no more than 0° (3.12)",
    "beyond µ 0.18: −8° best (3.13)",
    "high speed: −4° best (3.14)",
)


@dataclass(frozen=True)
class Judgement:
    """What one reading gives of the five statements."""

    section: str
    unit: str
    optimum_deg: float
    """Best linear twist in hover, in the unit of the reading [°]."""
    excess: tuple[float, ...]
    """Part of power by which each statement is missed, or for the second the part by which −16° exceeds the least."""
    overtakes: float
    """µ at which −8° begins to need less power than −12°; NaN where it does not between 0.075 and 0.25."""

    @property
    def holds(self) -> tuple[bool, ...]:
        """Each statement, by the tolerance of all figures."""
        return tuple((value > TOLERANCE) if k == 1 else (value <= TOLERANCE) for k, value in enumerate(self.excess))


def reading_design(section: str, rate: float, mu: float) -> Design:
    """The `thesis` preset with these section data and a linear twist [°/R]."""
    design = make_design(preset="thesis", twist=f"linear:{rate:.12g}", mu=mu)
    design = replace(design, rotor=with_airfoils(design.rotor, (section,), ()))
    if section.startswith(THESIS_NAME):
        return design
    # Equation (3.3) has one lift curve for the whole blade; with Mach number the annulus balance takes its place.
    return replace(design, models=replace(design.models, hover_inflow="annulus"))


@CachedFunction
def judge(section: str, unit: str) -> Judgement:
    root = make_design(preset="thesis").rotor.blade.root_cutout
    per_unit = 1.0 if unit == UNITS[0] else 1.0 / (1.0 - root)

    @cache
    def power(angle: float, mu: float) -> float:
        return solve(reading_design(section, angle * per_unit, mu)).require().power.main_rotor

    def cost(angle: float, mu: float) -> float:
        return power(angle, mu) / min(power(float(rate), mu) for rate in FIVE_RATES) - 1.0

    rates = np.arange(-24.0, -7.0, 2.0)
    best, least = by_parabola(rates, np.array([power(float(rate), 0.0) for rate in rates]))
    speeds = (*LOW, *MEDIUM[1:])
    gaps = [power(-12.0, mu) - power(-8.0, mu) for mu in speeds]
    rises = [j for j in range(len(gaps) - 1) if gaps[j] < 0.0 <= gaps[j + 1]]
    return Judgement(
        section,
        unit,
        best,
        (
            power(DOCUMENT_HOVER, 0.0) / least - 1.0,
            power(DOCUMENT_STRONG, 0.0) / least - 1.0,
            max(power(-16.0, mu) / power(0.0, mu) for mu in LOW) - 1.0,
            max(cost(-8.0, mu) for mu in MEDIUM if mu > 0.18),
            max(cost(-4.0, mu) for mu in HIGH),
        ),
        float(np.interp(0.0, gaps[rises[0] : rises[0] + 2], speeds[rises[0] :][:2])) if rises else float("nan"),
    )


def needed() -> list[Call]:
    """The calls to make ahead."""
    return [(judge, (section, unit)) for section in SECTIONS for unit in UNITS]


def described(section: str) -> str:
    if not section.startswith(THESIS_NAME):
        return "table over Mach number"
    reading = parse_reading(section)
    low, high = reading.range_deg
    transition = "free" if reading.transition == "free" else "at 5 % chord"
    return f"{transition}, M {reading.mach:g}, {low:g}…{high:g}°"


def readings(sections: tuple[str, ...] = SECTIONS) -> Report:
    """Reading × statement."""
    found = [judge(section, unit) for unit in UNITS for section in sections]
    count = {(one.section, one.unit): sum(one.holds) for one in found}
    best = max(found, key=lambda one: sum(one.holds))
    rows: list[tuple[TableCell, ...]] = []
    for one in found:
        cells = [
            f"{'yes' if held else 'no'} {100.0 * value:.2f} %"
            for held, value in zip(one.holds, one.excess, strict=True)
        ]
        overtakes = f"{one.overtakes:.3f}" if np.isfinite(one.overtakes) else "–"
        rows.append(
            (described(one.section), one.unit, f"{one.optimum_deg:.1f}", *cells, overtakes, f"{sum(one.holds)} of 5")
        )
    polar = described(best.section).rpartition(",")[0]
    kin = [one for one in sections if one != best.section and described(one).rpartition(",")[0] == polar]
    neighbours = " and ".join(f"{count[one, best.unit]} ({described(one).rpartition(', ')[2]})" for one in kin)
    most = max(sum(one.holds) for one in found)
    several = sum(sum(one.holds) == most for one in found)
    words, words_deck = (
        ", ".join(f"{count[one, unit]} {unit}" for unit in UNITS) for one in (sections[0], sections[-1])
    )
    return Report(
        number="Readings",
        kind="claim",
        caption="Which of five statements of §3.3 each reading of the thesis gives: section data (transition, Mach "
        "number and range of the fit of order 10 and 12, or a table over Mach number) and unit of twist. The number is "
        "the power by which the statement is missed; for −16° in hover, the power above the least.",
        statement="Section data from XFOIL, fitted by order 10 and 12, without compressibility (p. 17–24). Transition, "
        "Mach number, range of the fit and unit of twist are not stated.",
        ours=f"The most is {most} of 5, by {several} of {len(found)} readings; the first is {described(best.section)}, "
        f"{best.unit}. The preset's own reading gives {words}; the table over Mach number {words_deck}.",
        verdict=Agreement.INDICATIVE,
        because="The preset keeps its reading. "
        + (f"The same polar over other ranges of the fit gives {neighbours} of 5: " if neighbours else "")
        + "the ripple of a polynomial of order 12, of the size of the differences between the twists, decides, and a "
        "range chosen among many for its answers is no evidence. The table over Mach number orders the twists by "
        "speed as figures 3.12 and 3.13 do, but the thesis has one curve for all Mach numbers (p. 18) and leaves "
        "compressibility out (p. 23). To see any row: --preset thesis --airfoils NAME, with the names in the CSV.",
        tables=(
            table(
                "statements",
                ("section data", "unit of twist", "optimum in hover [°]", *STATEMENTS, "−8° overtakes −12° at µ",
                 "gives"),
                rows, shown=True,
            ),
            table(
                "readings",
                ("name", "unit", "optimum_deg", "cost_13_5", "cost_16", "excess_low", "cost_8", "cost_4",
                 "overtakes_mu"),
                [(one.section, one.unit, one.optimum_deg, *one.excess, one.overtakes) for one in found],
            ),
        ),
        numbers={"most": float(most), **{f"{one.section} {one.unit}": float(sum(one.holds)) for one in found}},
    )  # fmt: skip
