"""Figure 4.12: the best three-segment blade at each speed, beside public data of the flown one."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.search import Search, run_search
from rotor.reproduce import every_inflow
from rotor.reproduce.aircraft import HORSEPOWER_KW, public_data
from rotor.reproduce.optima import FULL, Scope
from rotor.reproduce.optimum_twist import SHORT, UNKNOWN, Variants
from rotor.reproduce.remember import Remembered
from rotor.reproduce.report import Curve, Panel, Report, Verdict, curve, table
from rotor.reproduce.runs import EVERY_VARIANT, VARIANT_TITLES, VARIANTS, choices, variant
from rotor.trim.solve import solve
from rotor.units import KNOT

SLOWEST = 0.075
"""µ below which no inflow model is proven."""
FEW = 3
"""Speeds in a test."""


@dataclass(frozen=True)
class Row:
    """One speed of the public curve; powers of the main rotor [kW]."""

    mu: float
    public_kw: float
    flown_kw: float
    """Built-in twist."""
    moved_kw: float
    """Best three segments."""
    twist: str
    """SPEC of these"""

    @property
    def saving(self) -> float:
        """Part of the flown blade's power."""
        return 1.0 - self.moved_kw / self.flown_kw


@Remembered
def three_beside(name: str, scope: Scope) -> tuple[Row, ...]:
    """The rows of a variant at mass and altitude of the public curve."""
    forward = public_data()["forward"]
    tip_speed = make_design().rotor.tip_speed
    concept = find_concept("three-segment")
    rows: list[Row] = []
    guess: tuple[tuple[float, ...], ...] = ()
    for knots, horsepower in zip(forward["speed_kt"], forward["main_rotor_hp"], strict=True):
        mu = knots * KNOT / tip_speed
        if 0.0 < mu < SLOWEST or (scope != FULL and len(rows) == FEW):
            continue
        design = variant(name, twist="uh60a", mu=mu, mass=forward["mass_kg"])
        design = replace(design, condition=replace(design.condition, altitude=forward["altitude_m"]))
        found = run_search(Search(design, concept, starts=1, guesses=guess, band=False))
        assert found.best is not None, f"{name}, µ {mu:g}: {found.message}"
        guess = (found.best.parameters,)
        flown, moved = (solve(one).require().power.main_rotor / 1e3 for one in (design, found.design))
        rows.append(Row(mu, HORSEPOWER_KW * horsepower, flown, moved, found.best.twist))
    return tuple(rows)


def figure_4_12(scope: Scope = FULL, variants: Variants = EVERY_VARIANT) -> Report:
    """Three segments beside public data."""
    found = {name: three_beside(name, scope) for name in variants}
    savings = {name: [row.saving for row in found[name]] for name in variants}
    own = [name for name in VARIANTS if name in variants]
    speeds = replace(scope, speeds=tuple(row.mu for row in found[own[0]]))
    ranges = ", ".join(
        f"{100 * min(savings[name]):.1f} to {100 * max(savings[name]):.1f} % ({SHORT[name]})" for name in own
    )
    place = len(speeds.speeds) // 2

    def percent(name: str, k: int) -> float:
        return 100.0 * savings[name][k]

    return Report(
        number="4.12",
        kind="figure",
        caption="Main-rotor power of the flown twist and of the best three-segment blade at each speed, beside a "
        "public model curve of the UH-60A (7257.5 kg, 1600 m; indicative, not flight test). Below it, the saving with "
        f"every inflow model. {every_inflow.NOTE}",
        statement=UNKNOWN,
        ours=f"The best three segments save, of main-rotor power against the built-in twist, {ranges}; at µ "
        f"{speeds.speeds[place]:.2f} {every_inflow.spread(percent, variants, place, ' %')}.",
        verdict=Verdict.ALONE,
        because="A saving by twist is smaller than the distance between model and data, so only differences between "
        "our own curves mean something.",
        tables=(
            every_inflow.by_model("saving_percent_by_inflow", percent, variants, speeds),
            table(
                "main_rotor_kw",
                ("preset", "inflow", "mu", "public_model_curve", "built_in_twist", "three_segments", "twist"),
                [
                    (*choices(name), row.mu, row.public_kw, row.flown_kw, row.moved_kw, row.twist)
                    for name in variants
                    for row in found[name]
                ],
            ),
        ),
        panels=tuple(_panel(name, found[name], named=name == own[0]) for name in own),
        companion=every_inflow.model_panels("saving of main-rotor power [%]", percent, variants, speeds, key=True),
        numbers={
            **{f"{name}_least_saving": min(savings[name]) for name in variants},
            **{f"{name}_largest_saving": max(savings[name]) for name in variants},
        },
    )


def _panel(name: str, rows: Sequence[Row], *, named: bool) -> Panel:
    curves: list[Curve] = []
    # Between hover and the slowest flight no inflow model is proven: a gap, not a line.
    labels = ("built-in twist", "three segments, moving", "public model curve (indicative)")
    for part in ([row for row in rows if row.mu > 0.0], [row for row in rows if row.mu == 0.0]):
        speeds = [row.mu for row in part]
        built, best, public = labels if named and part[0].mu > 0.0 else ("", "", "")
        curves += [
            curve(built, speeds, [row.flown_kw for row in part], "both", colour=0),
            curve(best, speeds, [row.moved_kw for row in part], "both", colour=1),
            curve(public, speeds, [row.public_kw for row in part], "points", colour=7),
        ]
    return Panel("advance ratio µ", "main-rotor power [kW]", tuple(curves), title=VARIANT_TITLES[name])
