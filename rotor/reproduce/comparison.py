"""Figures 4.9, 4.11–4.13 and Table 4.1: the flown blade, three segments beside public data, all concepts side by "
"side."""

from functools import lru_cache

import numpy as np

from rotor.airfoil.sections import load_installed
from rotor.concepts import find_concept
from rotor.optimise import Search, optimise
from rotor.presets import make_design, uh60a_rotor, uh60a_twist
from rotor.reproduce.aircraft import HORSEPOWER_KW, KNOT, public_data
from rotor.reproduce.optima import CONCEPTS, FULL, Scope, best
from rotor.reproduce.optimum_twist import SHORT, UNKNOWN
from rotor.reproduce.report import Curve, Panel, Report, Table, Verdict, curve, judged, table
from rotor.reproduce.runs import VARIANT_TITLES, VARIANTS, solved
from rotor.solve import solve

RATES = tuple(range(-24, 5, 2))
"""Fixed linear blades among which the best is looked for [°/R]."""


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
        caption="Planform of the UH-60A blade as the flight preset has it: sections, chord, root cut-out; the 20° "
        "sweep of the tip and the trailing-edge tab are not modelled.",
        statement=UNKNOWN,
        ours=f"SC1095 over {100 * shares['sc1095']:.0f} % of the radius, SC1094 R8 over "
        f"{100 * shares['sc1094r8']:.0f} %, "
        "blended between.",
        verdict=Verdict.ALONE,
        because="Numbers and sources stand in assets/uh60a.toml.",
        tables=(table("spans", ("section", "start_r", "end_r", "chord_m"), rows),),
        panels=(Panel("r/R", "from the quarter chord, over R", tuple(curves), equal=True),),
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
        caption="Built-in twist of the UH-60A and the linear twist that stands for it.",
        statement="The nonlinear twist is approximated by a linear −16° (p. 25).",
        ours=f"Straight line through it from 0.2 R to the tip: {plain:.1f}° unweighted, {weighted:.1f}° weighted by "
        "r².",
        verdict=judged(min(abs(plain + 16.0), abs(weighted + 16.0)) < 0.5),
        because="−16° is its linear equivalent; the often quoted −18° is a nominal value.",
        tables=(
            table("twist", ("r", "uh60a_deg", "linear_16_deg"), zip(r, angle, -16.0 * (r - 0.75), strict=True)),
        ),
        panels=(
            Panel(
                "r/R", "twist, zero at 0.75 R [°]",
                (curve("UH-60A", r, angle), curve("linear −16°", r, -16.0 * (r - 0.75), "dashed")),
            ),
        ),
        numbers={"unweighted": plain, "weighted": weighted},
    )  # fmt: skip


def figure_4_12(scope: Scope = FULL) -> Report:
    """Three segments beside public data."""
    forward = public_data()["forward"]
    tip_speed = make_design().rotor.tip_speed
    rows: list[tuple[float | str, ...]] = []
    concept = find_concept("three-segment")
    guess: tuple[tuple[float, ...], ...] = ()
    for knots, horsepower in zip(forward["speed_kt"], forward["main_rotor_hp"], strict=True):
        mu = knots * KNOT / tip_speed
        if 0.0 < mu < 0.075:
            continue
        design = make_design(advance_ratio=mu, mass=forward["mass_kg"], altitude=forward["altitude_m"])
        found = optimise(Search(design, concept, starts=1, guesses=guess, band=False))
        assert found.best is not None, found.message
        guess = (found.best.parameters,)
        flown = solve(design).require().power.main_rotor / 1e3
        moved = solve(found.design).require().power.main_rotor / 1e3
        rows.append((mu, HORSEPOWER_KW * horsepower, flown, moved, found.best.twist))
        if len(rows) == 3 and scope is not FULL:
            break
    speeds, theirs, flown_kw, moved_kw = ([float(row[k]) for row in rows] for k in range(4))
    savings = 1.0 - np.array(moved_kw) / np.array(flown_kw)
    return Report(
        number="4.12",
        kind="figure",
        caption="Main-rotor power of the flown blade and of the best three-segment blade at each speed, beside a "
        "public model curve of the UH-60A (7257.5 kg, 1600 m; indicative, not flight test).",
        statement=UNKNOWN,
        ours=f"The best three segments save {100 * savings.min():.1f} to {100 * savings.max():.1f} % of main-rotor "
        "power against the built-in twist.",
        verdict=Verdict.ALONE,
        because="A saving by twist is smaller than the distance between model and data, so only differences between "
        "our own curves mean something.",
        tables=(
            table("main_rotor_kw", ("mu", "public_model_curve", "built_in_twist", "three_segments", "twist"), rows),
        ),
        panels=(
            Panel(
                "advance ratio µ", "main-rotor power [kW]",
                (
                    curve("built-in twist", speeds, flown_kw, "both"),
                    curve("three segments, moving", speeds, moved_kw, "both"),
                    curve("public model curve (indicative)", speeds, theirs, "points", colour=7),
                ),
            ),
        ),
        numbers={"least_saving": float(savings.min()), "largest_saving": float(savings.max())},
    )  # fmt: skip


def figure_4_13(scope: Scope = FULL) -> Report:
    """All concepts side by side."""
    panels: list[Panel] = []
    numbers: dict[str, float] = {}
    for name in VARIANTS:
        curves: list[Curve] = []
        for k, concept in enumerate(CONCEPTS):
            savings = [100.0 * best(name, concept, mu, scope).saving for mu in scope.speeds]
            curves.append(curve(concept if name == VARIANTS[1] else "", scope.speeds, savings, "both", colour=k))
            numbers[f"{name}_{concept}_largest"] = max(savings) / 100.0
        panels.append(Panel("advance ratio µ", "saving of total power [%]", tuple(curves), title=VARIANT_TITLES[name]))
    gain = {
        name: max(best(name, "three", mu, scope).saving - best(name, "linear", mu, scope).saving for mu in scope.speeds)
        for name in VARIANTS
    }
    return Report(
        number="4.13",
        kind="figure",
        caption="Saving of total power by each concept, moved to its optimum at each speed, against a fixed linear "
        "−16°.",
        statement=UNKNOWN,
        ours="Three segments save beyond one linear twist at most "
        + ", ".join(f"{100 * gain[name]:.2f} % ({SHORT[name]})" for name in VARIANTS)
        + ".",
        verdict=Verdict.ALONE,
        because="One linear twist, moved, takes most of what steady twist can give.",
        tables=(_savings_table(scope),),
        panels=tuple(panels),
        numbers={**numbers, **{f"{name}_three_over_linear": value for name, value in gain.items()}},
    )


def table_4_1(scope: Scope = FULL) -> Report:
    """Reduction of power, and how much of it a better fixed blade would have had too."""
    rows: list[tuple[str | float, ...]] = []
    numbers: dict[str, float] = {}
    words: list[str] = []
    for name in VARIANTS:
        rate, fixed = best_fixed_linear(name, scope.speeds)
        moving = float(np.mean([best(name, "linear", mu, scope).power_kw for mu in scope.speeds]))
        baseline = float(np.mean([best(name, "linear", mu, scope).baseline_kw for mu in scope.speeds]))
        rows.append((name, baseline, rate, fixed, moving, 100 * (1 - fixed / baseline), 100 * (1 - moving / fixed)))
        numbers |= {f"{name}_fixed": 1 - fixed / baseline, f"{name}_moving": 1 - moving / fixed}
        words.append(
            f"{SHORT[name]}: moving one linear twist saves {100 * (1 - moving / baseline):.1f} % of mean power against "
            f"−16°, but a fixed {rate:g}° saves {100 * (1 - fixed / baseline):.1f} %, so moving is worth "
            f"{100 * (1 - moving / fixed):.1f} %"
        )
    return Report(
        number="4.1",
        kind="table",
        caption="Reduction of total power between a fixed linear −16° and each concept; below, how much of it the best "
        "fixed linear blade would take without moving (every speed flown equally long).",
        statement=UNKNOWN,
        ours="; ".join(words) + ".",
        verdict=Verdict.ALONE,
        because="Against −16° a part of every saving is only that −16° is not the best fixed blade for these speeds.",
        tables=(
            _savings_table(scope),
            table(
                "fixed_and_moving",
                ("variant", "baseline_kw", "best_fixed_deg", "best_fixed_kw", "moving_kw", "fixed_saves_percent",
                 "moving_saves_beyond_percent"),
                rows,
            ),
        ),
        numbers=numbers,
    )  # fmt: skip


@lru_cache(maxsize=16)
def best_fixed_linear(name: str, speeds: tuple[float, ...]) -> tuple[float, float]:
    """The linear rate [°/R], in whole pairs of degrees, with the least mean total power [kW] over the speeds."""
    means = {
        rate: float(np.mean([solved(name, f"linear:{rate}", mu).require().power.total / 1e3 for mu in speeds]))
        for rate in RATES
    }
    rate = min(means, key=lambda one: means[one])
    return float(rate), means[rate]


def _savings_table(scope: Scope) -> Table:
    rows = [
        (name, concept, *(100.0 * best(name, concept, mu, scope).saving for mu in scope.speeds))
        for name in VARIANTS
        for concept in CONCEPTS
    ]
    return table("saving_percent", ("variant", "concept", *(f"mu_{mu:g}" for mu in scope.speeds)), rows)
