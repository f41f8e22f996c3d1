"""Chapter 4: the optimum of each concept over speed (figures 4.1–4.10), and all compared (4.11–4.13, Table 4.1)."""

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from rotor.design.twist import shipped_twist
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.objective import POWERS, at_condition
from rotor.optimisation.search import Search, run_search
from rotor.support.chart import Chart, Series
from rotor.support.units import KNOT
from rotor.trim.solve import solve
from rotor.validation.thesis import runs
from rotor.validation.thesis.ladder import RUNGS, moving_twist
from rotor.validation.thesis.report import (
    Report,
    by_name,
    curve,
    judged,
    panel,
    report,
    table,
    with_gap,
)
from rotor.validation.uh60a import HORSEPOWER_KW, SLOWEST, public_data

NAMES = {
    "rate_deg": "twist rate [°/R]",
    "curvature_deg": "parameter a [°/R²]",
    "difference_deg": "root to tip [°]",
    "inboard_rate_deg": "inboard rate [°/R]",
    "middle_rate_deg": "middle rate [°/R]",
    "outboard_rate_deg": "outboard rate [°/R]",
}
BOUND_DEG = 30.0
"""Bound of every rate in the search [°/R]."""
_TWO = ("inboard_rate_deg", "outboard_rate_deg")
FIGURES: dict[str, tuple[str, tuple[str, ...]]] = {
    "4.1": ("linear", ("rate_deg",)),
    "4.2": ("quadratic", ("curvature_deg",)),
    "4.3": ("quadratic", ("difference_deg",)),
    **{f"4.{k}": (f"two {10 * k}-{100 - 10 * k}", _TWO) for k in (4, 5, 6, 7)},
    "4.8": ("two airfoils", _TWO),
    "4.10": ("three", ("inboard_rate_deg", "middle_rate_deg", "outboard_rate_deg")),
}
"""By number: the concept, and the parameters shown."""


def optimum_figure(number: str, speeds: tuple[float, ...] = runs.FULL) -> Report:
    """The optimum of one concept over speed, in both presets; `number` is one of `FIGURES`."""
    concept, shown = FIGURES[number]
    optima = {
        name: [runs.best(name, concept, mu, speeds) for mu in speeds] for name in runs.VARIANTS
    }
    largest = {name: max(optimum.saving for optimum in row) for name, row in optima.items()}
    widths = [
        high - low
        for row in optima.values()
        for optimum in row
        for low, high in [_band(optimum, shown[0])]
    ]
    widest = max(width for width in widths if math.isfinite(width))
    settled = all(optimum.converged for row in optima.values() for optimum in row)
    columns = [column for key in shown for column in (key, f"{key}_low", f"{key}_high")]
    kinds = _by_kind(0.2) if number == "4.1" else {}
    rows = [
        (
            name,
            optimum.mu,
            *(cell for key in shown for cell in (_value(optimum, key), *_band(optimum, key))),
            optimum.power_kw,
            100.0 * optimum.saving,
        )
        for name, row in optima.items()
        for optimum in row
    ]
    return report(
        number,
        tables=[table("optimum", ("variant", "mu", *columns, "total_kw", "saving_percent"), rows)],
        panels=[_panel(name, row, shown) for name, row in optima.items()],
        largest=by_name(largest),
        widest=widest,
        on_bound=_on_bound(optima, shown),
        settled="" if settled else " Not every search converged.",
        induced=kinds.get("induced", math.nan),
        total=kinds.get("total", math.nan),
    )


def _by_kind(mu: float) -> dict[str, float]:
    """Best linear twist [°] of the flight preset for each power: the abstract minimises induced power."""
    linear, design = find_concept("linear"), runs.variant("flight", mu=mu)
    optima = {
        kind: run_search(Search(design, linear, at_condition(design, kind), starts=1))
        for kind in POWERS
    }
    return {
        kind: math.degrees(optimum.best.parameters[0])
        for kind, optimum in optima.items()
        if optimum.best
    }


def _on_bound(optima: dict[str, list[runs.ConceptOptimum]], shown: Sequence[str]) -> str:
    """Names the optima that lie on the bound of the search, where the true optimum may lie beyond."""
    places = [
        f"{_word(key)} at {'hover' if optimum.mu == 0.0 else f'µ {optimum.mu:g}'} ({name})"
        for name, row in optima.items()
        for optimum in row
        for key in shown
        if key.endswith("rate_deg") and abs(_value(optimum, key)) > BOUND_DEG - 0.05
    ]
    if not places:
        return ""
    return f" These lie on the bound of the search, {BOUND_DEG:g}° per radius, and are not optima: {', '.join(places)}."


def _panel(name: str, row: list[runs.ConceptOptimum], shown: Sequence[str]) -> Chart:
    curves: list[Series] = []
    speeds = [optimum.mu for optimum in row]
    for k, key in enumerate(shown):
        low, high = zip(*(_band(optimum, key) for optimum in row), strict=True)
        curves += with_gap("", speeds, low, "band", upper=high, colour=k)
        curves += with_gap(
            _word(key) if len(shown) > 1 else "optimum",
            speeds,
            [_value(optimum, key) for optimum in row],
            colour=k,
        )
    y_label = NAMES[shown[0]] if len(shown) == 1 else "twist rate [°/R]"
    return panel(runs.VARIANT_TITLES[name], "advance ratio µ", y_label, tuple(curves))


def _word(key: str) -> str:
    return NAMES[key].partition(" [")[0]


def _value(optimum: runs.ConceptOptimum, key: str) -> float:
    return optimum.values[optimum.names.index(key)]


def _band(optimum: runs.ConceptOptimum, key: str) -> tuple[float, float]:
    return optimum.band[optimum.names.index(key)]


def figure_4_11() -> Report:
    """The flown twist and −16°."""
    law = shipped_twist("uh60a")
    r = np.linspace(0.2, 1.0, 321)
    angle = np.degrees(law(r))
    plain = float(np.polyfit(r, angle, 1)[0])
    weighted = float(np.polyfit(r, angle, 1, w=r)[0])  # polyfit squares its weights: r² here.
    line = -16.0 * (r - 0.75)
    curves = curve("UH-60A", r, angle), curve("linear −16°", r, line, "dashed")
    return report(
        "4.11",
        judged(min(abs(plain + 16.0), abs(weighted + 16.0)) < 0.5),
        tables=[
            table("twist", ("r", "uh60a_deg", "linear_16_deg"), zip(r, angle, line, strict=True))
        ],
        panels=[panel("", "r/R", "twist, zero at 0.75 R [°]", curves)],
        numbers={"unweighted": plain, "weighted": weighted},
        unweighted_root_to_tip=(1.0 - r[0]) * plain,
        weighted_root_to_tip=(1.0 - r[0]) * weighted,
    )


SpeedRow = tuple[float, float, float, float, str]
"""µ; main-rotor power of the public curve, of the built-in twist, of the best three segments [kW]; SPEC of these."""


@runs.CachedFunction
def three_segment_rows(preset: str, most: int | None) -> tuple[SpeedRow, ...]:
    """The rows of a preset at mass and altitude of the public curve; at most so many, from hover on."""
    forward = public_data()["forward"]
    tip_speed = make_design().rotor.tip_speed
    concept = find_concept("three-segment")
    rows: list[SpeedRow] = []
    guess: tuple[tuple[float, ...], ...] = ()
    for knots, horsepower in zip(forward["speed_kt"], forward["main_rotor_hp"], strict=True):
        mu = knots * KNOT / tip_speed
        if 0.0 < mu < SLOWEST or len(rows) == most:
            continue
        design = runs.variant(preset, twist="uh60a", mu=mu, mass=forward["mass_kg"])
        design = replace(
            design, condition=replace(design.condition, altitude=forward["altitude_m"])
        )
        optimum = run_search(Search(design, concept, starts=1, guesses=guess, band=False))
        assert optimum.best is not None, f"{preset}, µ {mu:g}: {optimum.message}"
        guess = (optimum.best.parameters,)
        flown, moved = (
            solve(flight).require().power.main_rotor / 1e3 for flight in (design, optimum.design)
        )
        rows.append((mu, HORSEPOWER_KW * horsepower, flown, moved, optimum.best.twist))
    return tuple(rows)


def figure_4_12(most: int | None = None) -> Report:
    """Three segments and public data."""
    rows = three_segment_rows("flight", most)
    savings = [1.0 - moved / flown for _, _, flown, moved, _ in rows]
    mu, public, flown, moved, _ = zip(*rows, strict=True)
    curves = (
        *with_gap("built-in twist", mu, flown, colour=0),
        *with_gap("three segments, variable", mu, moved, colour=1),
        *with_gap("public model curve (indicative)", mu, public, "points", colour=7),
    )
    return report(
        "4.12",
        tables=[
            table(
                "main_rotor_kw",
                ("mu", "public_model_curve", "built_in_twist", "three_segments", "twist"),
                rows,
            )
        ],
        panels=[panel("", "advance ratio µ", "main-rotor power [kW]", curves)],
        numbers={"least_saving": min(savings), "largest_saving": max(savings)},
        least_saving_percent=100.0 * min(savings),
    )


def figure_4_13(speeds: tuple[float, ...] = runs.FULL) -> Report:
    """All concepts side by side."""
    pairs = product(runs.VARIANTS, runs.CONCEPTS)
    savings = {
        (name, concept): [_percent(name, concept, mu, speeds) for mu in speeds]
        for name, concept in pairs
    }
    panels: list[Chart] = []
    for name in runs.VARIANTS:
        curves: list[Series] = []
        for k, concept in enumerate(runs.CONCEPTS):
            curves += with_gap(concept, speeds, savings[name, concept], colour=k)
        panels.append(
            panel(
                runs.VARIANT_TITLES[name],
                "advance ratio µ",
                "saving of total power [%]",
                tuple(curves),
            )
        )
    gain = {
        name: max(np.subtract(savings[name, "three"], savings[name, "linear"])) / 100.0
        for name in runs.VARIANTS
    }
    largest = [
        (name, *(f"{max(savings[name, concept]):.1f}" for concept in runs.CONCEPTS))
        for name in runs.VARIANTS
    ]
    heads = ("variant", "concept", *(f"mu_{mu:g}" for mu in speeds))
    return report(
        "4.13",
        tables=[
            table("largest saving", ("[%]", *runs.CONCEPTS), largest),
            table("saving_percent", heads, [(*key, *row) for key, row in savings.items()]),
        ],
        panels=panels,
        numbers={
            **{
                f"{name}_{concept}_largest": max(row) / 100.0
                for (name, concept), row in savings.items()
            },
            **{f"{name}_three_over_linear": float(value) for name, value in gain.items()},
        },
    )


def table_4_1(speeds: tuple[float, ...] = runs.FULL) -> Report:
    """Reduction of power, and how much of it a better fixed blade would have had too."""
    rows: list[tuple[str | float, ...]] = []
    numbers: dict[str, float] = {}
    more: dict[str, float] = {}
    for name in runs.VARIANTS:
        variable = moving_twist(tuple(RUNGS) if name == "flight" else (), speeds, None)
        mean = {
            concept: sum(runs.comparable_kw(name, concept, mu, speeds) for mu in speeds)
            / len(speeds)
            for concept in runs.CONCEPTS
        }
        saving = {concept: 1.0 - power / variable.baseline_kw for concept, power in mean.items()}
        fixed, moving = (
            1.0 - variable.fixed_kw / variable.baseline_kw,
            1.0 - mean["linear"] / variable.fixed_kw,
        )
        shares = (f"{100.0 * part:.2f}" for part in saving.values())
        rows.append((name, *shares, f"{100.0 * fixed:.2f} ({variable.fixed_deg:.1f}°)"))
        numbers |= {f"{name}_fixed": fixed, f"{name}_moving": moving}
        # Beyond one linear twist that moves; kept of the last, the flight preset.
        more = {concept: 1.0 - power / mean["linear"] for concept, power in mean.items()}
    numbers |= {
        "two": max(
            more[concept]
            for concept in more
            if concept.startswith("two ") and concept != "two airfoils"
        ),
        "three": more["three"],
        "quadratic": more["quadratic"],
        "airfoils": more["two airfoils"] - more["two 50-50"],
    }
    saved = table("mean_saving_percent", ("variant", *runs.CONCEPTS, "best fixed"), rows)
    return report("table 4.1", tables=[saved], numbers=numbers)


def _percent(name: str, concept: str, mu: float, speeds: tuple[float, ...]) -> float:
    baseline = runs.best(name, "linear", mu, speeds).baseline_kw
    return 100.0 * (1.0 - runs.comparable_kw(name, concept, mu, speeds) / baseline)
