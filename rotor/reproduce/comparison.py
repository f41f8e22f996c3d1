"""Blades and concepts compared: figures 4.9 and 4.11–4.13, and Table 4.1.

Figures 4.9, 4.11, 4.12: planform and twist of the UH-60A blade; the best three-segment blade beside public data.
Figure 4.13 and Table 4.1: all concepts side by side, and how much of their saving a fixed blade would have.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from rotor.airfoil.sections import load_installed
from rotor.files.make_design import make_design, uh60a_rotor, uh60a_twist
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.search import Search, run_search
from rotor.reproduce.optimum_twist import NOTE, SHORT, Variants, by_model, model_panels, spread
from rotor.reproduce.report import Agreement, Curve, PlotPanel, Report, ReportTable, caption_only, curve, judged, table
from rotor.reproduce.runs import (
    CONCEPTS,
    EVERY_VARIANT,
    FULL,
    VARIANT_TITLES,
    VARIANTS,
    CachedFunction,
    Scope,
    best,
    best_fixed,
    choices,
    comparable_kw,
    variant,
)
from rotor.trim.solve import solve
from rotor.units import KNOT
from rotor.validation.uh60a import HORSEPOWER_KW, public_data


def figure_4_9() -> Report:
    """The blade's planform."""
    rotor = uh60a_rotor("flight")
    blade = rotor.blade
    curves: list[Curve] = []
    rows: list[tuple[str | float, ...]] = []
    titles = {"sc1095": "SC1095", "sc1094r8": "SC1094 R8", "blended": "blended"}
    blends = [(inner.end, outer.start) for inner, outer in pairwise(blade.spans) if inner.end < outer.start]
    for section, start, end in (*((one.section, one.start, one.end) for one in blade.spans),
                                *(("blended", *ends) for ends in blends)):  # fmt: skip
        ratio = 1.0 if section == "blended" else load_installed(section).chord_ratio
        chord = float(blade.chord(0.5 * (start + end))) * ratio / rotor.radius
        kink = [blade.tip_sweep_start] if start < blade.tip_sweep_start < end else []
        along = np.array([start, *kink, end])
        swept = -np.maximum(along - blade.tip_sweep_start, 0.0) * math.tan(blade.tip_sweep)
        outline = np.concatenate([swept + 0.25 * chord, (swept - 0.75 * chord)[::-1]])
        label = "" if section in [row[0] for row in rows] else titles[section]
        rows.append((section, start, end, chord * rotor.radius))
        colour = {"sc1095": 0, "sc1094r8": 1}.get(section, 7)
        curves.append(curve(label, (*along, *along[::-1], start), (*outline, outline[0]), "fill", colour=colour))
    shares = {name: sum(float(r[2]) - float(r[1]) for r in rows if r[0] == name) for name in ("sc1095", "sc1094r8")}
    return Report(
        number="4.9",
        kind="figure",
        caption="Planform of the UH-60A blade in the flight preset: sections, chord, root cut-out and swept tip; above "
        "to scale, below with the chord enlarged. The trailing-edge tab is left out.",
        statement=caption_only("Figure 4.9"),
        ours=f"SC1095 over {100 * shares['sc1095']:.0f} % of the radius, SC1094 R8 over "
        f"{100 * shares['sc1094r8']:.0f} %, "
        "blended between; "
        f"the tip is swept by {math.degrees(blade.tip_sweep):.0f}° from {blade.tip_sweep_start:.3f} R.",
        verdict=Agreement.ALONE,
        because="Numbers and sources: assets/uh60a.toml.",
        tables=(table("spans", ("section", "start_r", "end_r", "chord_m"), rows),),
        panels=(
            PlotPanel("", "", tuple(replace(one, label="") for one in curves), equal=True, drawing=True),
            PlotPanel("r/R", "x/R", tuple(curves)),
        ),
        numbers={**shares, "sweep_deg": math.degrees(blade.tip_sweep)},
        stacked=True,
        legend_below=True,
    )


def figure_4_11() -> Report:
    """The flown twist and −16°."""
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
    """Three segments and public data."""
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
        statement=caption_only("Figure 4.12"),
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


_SAME_BASELINE = (
    " Two airfoils in the thesis preset: the gain of the second airfoil, found with decks, on top of the two segments "
    "with polynomials; so every concept has the same baseline."
)


def figure_4_13(scope: Scope = FULL, variants: Variants = EVERY_VARIANT) -> Report:
    """All concepts side by side."""
    panels: list[PlotPanel] = []
    numbers: dict[str, float] = {}
    for name in VARIANTS:
        curves: list[Curve] = []
        for k, concept in enumerate(CONCEPTS):
            savings = [_percent(name, concept, mu, scope) for mu in scope.speeds]
            label = concept if name == VARIANTS[1] else ""
            # No inflow model is validated between hover and the lowest speed: leave a gap.
            for part, words in ([mu for mu in scope.speeds if mu > 0.0], label), ([0.0], ""):
                shown = [_percent(name, concept, mu, scope) for mu in part]
                curves.append(curve(words, part, shown, "both", colour=k))
            numbers[f"{name}_{concept}_largest"] = max(savings) / 100.0
        panels.append(
            PlotPanel("advance ratio µ", "saving of total power [%]", tuple(curves), title=VARIANT_TITLES[name])
        )

    def gain(name: str, place: int) -> float:
        mu = scope.speeds[place]
        return _percent(name, "three", mu, scope) - _percent(name, "linear", mu, scope)

    largest = {name: max(gain(name, k) for k in range(len(scope.speeds))) for name in variants}
    return Report(
        number="4.13",
        kind="figure",
        caption="Saving of total power by each concept at its optimum for each speed, relative to a fixed linear "
        f"−16°.{_SAME_BASELINE} Below it, with every inflow model: what one linear twist saves, and what three "
        "segments add to it.",
        statement=caption_only("Figure 4.13"),
        ours="Three segments save more than one linear twist by at most "
        + ", ".join(f"{largest[name]:.2f} % ({SHORT[name]})" for name in VARIANTS)
        + f"; {max(largest.values()):.2f} % with any inflow model.",
        verdict=Agreement.ALONE,
        because="One variable linear twist gives most of the saving of steady twist.",
        tables=(
            by_model("three_beyond_linear_percent", gain, variants, scope),
            _savings_table(scope, variants),
        ),
        panels=tuple(panels),
        companion=(
            *model_panels(
                "one linear twist saves [%]",
                lambda name, k: _percent(name, "linear", scope.speeds[k], scope),
                variants,
                scope,
                key=True,
            ),
            *model_panels("three segments add [%]", gain, variants, scope, key=False),
        ),
        numbers={**numbers, **{f"{name}_three_over_linear": value / 100.0 for name, value in largest.items()}},
    )


def table_4_1(scope: Scope = FULL, variants: Variants = EVERY_VARIANT) -> Report:
    """Reduction of power, and how much of it a better fixed blade would have had too."""
    rows: list[tuple[str | float, ...]] = []
    numbers: dict[str, float] = {}
    words: dict[str, str] = {}
    for name in variants:
        one = best_fixed(name, scope)
        moving = sum(best(name, "linear", mu, scope).power_kw for mu in scope.speeds) / len(scope.speeds)
        baseline, fixed = one.baseline_kw, one.power_kw
        rows.append((
            *choices(name), baseline, one.rate_deg, fixed, moving, 100 * (1 - fixed / baseline),
            100 * (1 - moving / fixed),
        ))  # fmt: skip
        numbers |= {f"{name}_fixed": 1 - fixed / baseline, f"{name}_moving": 1 - moving / fixed}
        if name in VARIANTS:
            words[name] = (
                f"{SHORT[name]}: variable linear twist saves {100 * (1 - moving / baseline):.1f} % of mean power "
                f"relative to −16°, a fixed {one.rate_deg:.1f}° saves {100 * (1 - fixed / baseline):.1f} %; the "
                "additional "
                f"saving from variable twist is {100 * (1 - moving / fixed):.1f} %"
            )
    most = max(numbers[f"{name}_moving"] for name in variants)
    return Report(
        number="4.1",
        kind="table",
        caption="Reduction of total power between a fixed linear −16° and each concept, mean over the speeds and speed "
        "by speed, with every inflow model; and the part of it that the best fixed linear blade would give "
        f"(equal time at every speed).{_SAME_BASELINE}",
        statement=caption_only("Table 4.1"),
        ours="; ".join(words[name] for name in VARIANTS)
        + f". With every inflow model it is at most {100 * most:.1f} %.",
        verdict=Agreement.ALONE,
        because="Part of every saving relative to −16° arises because −16° is not the best fixed blade for these "
        "speeds.",
        tables=(
            _mean_savings(scope, variants),
            table(
                "fixed_and_moving",
                ("preset", "inflow", "baseline_kw", "best_fixed_deg", "best_fixed_kw", "moving_kw",
                 "fixed_saves_percent", "moving_saves_beyond_percent"),
                rows,
            ),
            _savings_table(scope, variants),
        ),
        numbers=numbers,
    )  # fmt: skip


def _percent(name: str, concept: str, mu: float, scope: Scope) -> float:
    baseline = best(name, "linear", mu, scope).baseline_kw
    return 100.0 * (1.0 - comparable_kw(name, concept, mu, scope) / baseline)


def _mean_savings(scope: Scope, variants: Variants) -> ReportTable:
    """A row a model, a column a concept: mean power over the speeds against the mean of the baseline's [%]."""
    rows: list[tuple[str | float, ...]] = []
    for name in variants:
        row: list[float] = []
        for concept in CONCEPTS:
            baseline = sum(best(name, "linear", mu, scope).baseline_kw for mu in scope.speeds)
            row.append(100.0 * (1.0 - sum(comparable_kw(name, concept, mu, scope) for mu in scope.speeds) / baseline))
        rows.append((*choices(name), *row))
    return table("mean_saving_percent", ("preset", "inflow", *CONCEPTS), rows, shown=True)


def _savings_table(scope: Scope, variants: Variants) -> ReportTable:
    rows = [
        (*choices(name), concept, *(_percent(name, concept, mu, scope) for mu in scope.speeds))
        for name in variants
        for concept in CONCEPTS
    ]
    return table("saving_percent", ("preset", "inflow", "concept", *(f"mu_{mu:g}" for mu in scope.speeds)), rows)
