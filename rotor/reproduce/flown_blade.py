"""Figures 4.9, 4.11, 4.12: planform and twist of the UH-60A blade; the best three-segment blade beside public data."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotor.airfoil.sections import load_installed
from rotor.files.make_design import make_design, uh60a_rotor, uh60a_twist
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.search import Search, run_search
from rotor.reproduce.aircraft import HORSEPOWER_KW, public_data
from rotor.reproduce.optima import FULL, Scope
from rotor.reproduce.optimum_twist import NOTE, SHORT, UNKNOWN, Variants, by_model, model_panels, spread
from rotor.reproduce.report import Agreement, Curve, PlotPanel, Report, curve, judged, table
from rotor.reproduce.runs import EVERY_VARIANT, VARIANT_TITLES, VARIANTS, CachedFunction, choices, variant
from rotor.trim.solve import solve
from rotor.units import KNOT


def figure_4_9() -> Report:
    """The blade's planform."""
    rotor = uh60a_rotor("flight")
    blade = rotor.blade
    curves: list[Curve] = []
    rows: list[tuple[str | float, ...]] = []
    for span in blade.spans:
        ratio = load_installed(span.section).chord_ratio
        chord = float(blade.chord(0.5 * (span.start + span.end))) * ratio / rotor.radius
        rows.append((span.section, span.start, span.end, chord * rotor.radius))
        x = (span.start, span.end, span.end, span.start, span.start)
        front, back = 0.25 * chord, -0.75 * chord
        colour = 0 if span.section == "sc1095" else 1
        label = span.section.upper() if span.section not in [str(row[0]) for row in rows[:-1]] else ""
        curves.append(curve(label, x, (front, front, back, back, front), colour=colour))
    shares = {name: sum(float(r[2]) - float(r[1]) for r in rows if r[0] == name) for name in ("sc1095", "sc1094r8")}
    return Report(
        number="4.9",
        kind="figure",
        caption="Planform of the UH-60A blade in the flight preset: sections, chord, root cut-out; the 20° "
        "sweep of the tip and the trailing-edge tab are not modelled.",
        statement=UNKNOWN,
        ours=f"SC1095 over {100 * shares['sc1095']:.0f} % of the radius, SC1094 R8 over "
        f"{100 * shares['sc1094r8']:.0f} %, "
        "blended between.",
        verdict=Agreement.ALONE,
        because="Numbers and sources: assets/uh60a.toml.",
        tables=(table("spans", ("section", "start_r", "end_r", "chord_m"), rows),),
        panels=(PlotPanel("r/R", "from the quarter chord, over R", tuple(curves), equal=True),),
        numbers=shares,
    )


def figure_4_11() -> Report:
    """The flown twist beside −16°."""
    law = uh60a_twist()
    r = np.linspace(0.2, 1.0, 321)
    angle = np.degrees(law(r))
    plain = float(np.polyfit(r, angle, 1)[0])
    weighted = float(np.polyfit(r, angle, 1, w=r)[0])  # polyfit squares its weights: r² here.
    return Report(
        number="4.11",
        kind="figure",
        caption="Built-in twist of the UH-60A and its linear approximation.",
        statement="The nonlinear twist is approximated by a linear −16° (p. 25).",
        ours=f"Straight line through it from 0.2 R to the tip: {plain:.1f}° unweighted, {weighted:.1f}° weighted by "
        "r².",
        verdict=judged(min(abs(plain + 16.0), abs(weighted + 16.0)) < 0.5),
        because="−16° is its linear equivalent; the often quoted −18° is a nominal value.",
        tables=(
            table("twist", ("r", "uh60a_deg", "linear_16_deg"), zip(r, angle, -16.0 * (r - 0.75), strict=True)),
        ),
        panels=(
            PlotPanel(
                "r/R", "twist, zero at 0.75 R [°]",
                (curve("UH-60A", r, angle), curve("linear −16°", r, -16.0 * (r - 0.75), "dashed")),
            ),
        ),
        numbers={"unweighted": plain, "weighted": weighted},
    )  # fmt: skip


SLOWEST = 0.075
"""µ below which no inflow model is validated."""
FEW = 3
"""Speeds in a test."""


@dataclass(frozen=True)
class SpeedRow:
    """One speed of the public curve; powers of the main rotor [kW]."""

    mu: float
    public_kw: float
    flown_kw: float
    """Built-in twist."""
    moved_kw: float
    """With the best three segments."""
    twist: str
    """SPEC of these"""

    @property
    def saving(self) -> float:
        """Part of the flown blade's power."""
        return 1.0 - self.moved_kw / self.flown_kw


@CachedFunction
def three_segment_rows(name: str, scope: Scope) -> tuple[SpeedRow, ...]:
    """The rows of a variant at mass and altitude of the public curve."""
    forward = public_data()["forward"]
    tip_speed = make_design().rotor.tip_speed
    concept = find_concept("three-segment")
    rows: list[SpeedRow] = []
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
        rows.append(SpeedRow(mu, HORSEPOWER_KW * horsepower, flown, moved, found.best.twist))
    return tuple(rows)


def figure_4_12(scope: Scope = FULL, variants: Variants = EVERY_VARIANT) -> Report:
    """Three segments beside public data."""
    found = {name: three_segment_rows(name, scope) for name in variants}
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
        f"every inflow model. {NOTE}",
        statement=UNKNOWN,
        ours=f"Relative to the built-in twist the best three segments save {ranges} of main-rotor power; at µ "
        f"{speeds.speeds[place]:.2f} {spread(percent, variants, place, ' %')}.",
        verdict=Agreement.ALONE,
        because="The saving is smaller than the difference between model and data, so only differences between our "
        "own curves are meaningful.",
        tables=(
            by_model("saving_percent_by_inflow", percent, variants, speeds),
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
        companion=model_panels("saving of main-rotor power [%]", percent, variants, speeds, key=True),
        numbers={
            **{f"{name}_least_saving": min(savings[name]) for name in variants},
            **{f"{name}_largest_saving": max(savings[name]) for name in variants},
        },
    )


def _panel(name: str, rows: Sequence[SpeedRow], *, named: bool) -> PlotPanel:
    curves: list[Curve] = []
    # No inflow model is validated between hover and the lowest speed: leave a gap.
    labels = ("built-in twist", "three segments, variable", "public model curve (indicative)")
    for part in ([row for row in rows if row.mu > 0.0], [row for row in rows if row.mu == 0.0]):
        speeds = [row.mu for row in part]
        built, best, public = labels if named and part[0].mu > 0.0 else ("", "", "")
        curves += [
            curve(built, speeds, [row.flown_kw for row in part], "both", colour=0),
            curve(best, speeds, [row.moved_kw for row in part], "both", colour=1),
            curve(public, speeds, [row.public_kw for row in part], "points", colour=7),
        ]
    return PlotPanel("advance ratio µ", "main-rotor power [kW]", tuple(curves), title=VARIANT_TITLES[name])
