"""Figures 4.1–4.8 and 4.10: the optimum twist of each concept over speed, with every inflow model. Our results only."""

import math
from collections.abc import Callable, Sequence

from rotor.aero.inflow import INFLOW_MODELS
from rotor.reproduce.report import (
    Agreement,
    Curve,
    PlotPanel,
    Report,
    ReportTable,
    TableCell,
    caption_only,
    curve,
    table,
)
from rotor.reproduce.runs import (
    CONCEPTS,
    EVERY_VARIANT,
    FULL,
    PRESETS,
    VARIANT_TITLES,
    VARIANTS,
    ConceptOptimum,
    Scope,
    best,
    choices,
)

LINEAR = tuple(name for name, model in INFLOW_MODELS.items() if not model.load_dependent)
"""Models that do not respond to the load distribution; their results coincide."""
REACTING = tuple(name for name, model in INFLOW_MODELS.items() if model.load_dependent)
NOTE = "In hover every model gives the same: hover uses the annulus balance."

Value = Callable[[str, int], float]
"""Of a variant, at a place in the list of speeds."""


def model_panels(
    y_label: str, value: Value, variants: Sequence[str], scope: Scope, *, key: bool
) -> tuple[PlotPanel, ...]:
    """One panel a preset, a line a model, over the speeds of forward flight; `key`: whether the lines are named."""
    flying = [k for k, mu in enumerate(scope.speeds) if mu > 0.0]
    speeds = [scope.speeds[k] for k in flying]
    panels: list[PlotPanel] = []
    for preset in PRESETS:
        curves: list[Curve] = []
        for name in variants:
            if choices(name)[0] != preset:
                continue
            inflow = choices(name)[1]
            load_dependent = inflow in REACTING
            label = INFLOW_MODELS[inflow].title if load_dependent else f"linear models ({len(LINEAR)})"
            first = load_dependent or all(one.label != label for one in curves)
            curves.append(
                curve(
                    label if key and first and preset == PRESETS[0] else "",
                    speeds,
                    [value(name, k) for k in flying],
                    "both" if load_dependent else "thin",
                    colour=REACTING.index(inflow) if load_dependent else 7,
                )
            )
        panels.append(
            PlotPanel("advance ratio µ", y_label, tuple(curves), title=f"{preset} preset, every inflow model")
        )
    return tuple(panels)


def by_model(title: str, cell: Callable[[str, int], TableCell], variants: Sequence[str], scope: Scope) -> ReportTable:
    """A row a model, a column a speed."""
    columns = ("preset", "inflow", *("hover" if mu == 0.0 else f"mu_{mu:.3g}" for mu in scope.speeds))
    places = range(len(scope.speeds))
    return table(title, columns, [(*choices(name), *(cell(name, k) for k in places)) for name in variants])


def with_band(one: ConceptOptimum, key: str) -> str:
    """`-8.5 (-9.8…-7.2)`."""
    place = one.names.index(key)
    value, (low, high) = one.values[place], one.band[place]
    return f"{value:.1f} ({low:.1f}…{high:.1f})" if math.isfinite(low) else f"{value:.1f}"


def spread(value: Value, variants: Sequence[str], place: int, unit: str = "°") -> str:
    """Least to largest over the models of each kind and preset, as a part of a sentence."""

    def of(models: Sequence[str]) -> str:
        parts: list[str] = []
        for preset in PRESETS:
            mine = [name for name in variants if choices(name)[0] == preset and choices(name)[1] in models]
            found = [value(name, place) for name in mine]
            if found:
                ends = dict.fromkeys(f"{end:.1f}" for end in (min(found), max(found)))
                parts.append(f"{'…'.join(ends)}{unit} ({preset})")
        return ", ".join(parts)

    words = ((of(LINEAR), "with the linear models"), (of(REACTING), "with the models that respond to loading"))
    return ", ".join(f"{found} {kind}" for found, kind in words if found)


SHORT = {
    "thesis": "thesis",
    "thesis-wake": "thesis + wake",
    "flight": "flight",
    "flight-linear": "flight, linear inflow",
}
NAMES = {
    "rate_deg": "twist rate [°/R]",
    "curvature_deg": "parameter a [°/R²]",
    "difference_deg": "root to tip [°]",
    "inboard_rate_deg": "inboard rate [°/R]",
    "middle_rate_deg": "middle rate [°/R]",
    "outboard_rate_deg": "outboard rate [°/R]",
}

Variants = Sequence[str]
"""Which to search; those of VARIANTS are among them."""


def figure_4_1(scope: Scope = FULL, variants: Variants = EVERY_VARIANT) -> Report:
    """One section."""
    return _figure("4.1", "linear", ("rate_deg",), scope, variants)


def figure_4_2(scope: Scope = FULL, variants: Variants = EVERY_VARIANT) -> Report:
    """Quadratic twist, its second-order parameter."""
    return _figure("4.2", "quadratic", ("curvature_deg",), scope, variants)


def figure_4_3(scope: Scope = FULL, variants: Variants = EVERY_VARIANT) -> Report:
    """Quadratic twist, root to tip."""
    return _figure("4.3", "quadratic", ("difference_deg",), scope, variants)


def figure_4_4(scope: Scope = FULL, variants: Variants = EVERY_VARIANT) -> Report:
    """Two sections 40 – 60."""
    return _figure("4.4", "two 40-60", _TWO, scope, variants)


def figure_4_5(scope: Scope = FULL, variants: Variants = EVERY_VARIANT) -> Report:
    """Two sections 50 – 50."""
    return _figure("4.5", "two 50-50", _TWO, scope, variants)


def figure_4_6(scope: Scope = FULL, variants: Variants = EVERY_VARIANT) -> Report:
    """Two sections 60 – 40."""
    return _figure("4.6", "two 60-40", _TWO, scope, variants)


def figure_4_7(scope: Scope = FULL, variants: Variants = EVERY_VARIANT) -> Report:
    """Two sections 70 – 30."""
    return _figure("4.7", "two 70-30", _TWO, scope, variants)


def figure_4_8(scope: Scope = FULL, variants: Variants = EVERY_VARIANT) -> Report:
    """Two sections, two airfoils."""
    return _figure(
        "4.8", "two airfoils", _TWO, scope, variants,
        " SC1094 R8 inboard, SC1095 outboard, changing at the division (our order; that of the thesis is not known). "
        "In "
        "the thesis preset decks replace the polynomials and the annulus balance eq. (3.3), in the baseline too: the "
        "R8 exists as a deck only, and (3.3) has one lift curve for a whole blade.",
    )  # fmt: skip


def figure_4_10(scope: Scope = FULL, variants: Variants = EVERY_VARIANT) -> Report:
    """Three sections."""
    return _figure(
        "4.10", "three", ("inboard_rate_deg", "middle_rate_deg", "outboard_rate_deg"), scope, variants,
        " Breaks where the UH-60A changes its airfoils.",
    )  # fmt: skip


BOUND_DEG = 30.0
"""Of every rate in the search [°/R]."""
_TWO = ("inboard_rate_deg", "outboard_rate_deg")


def _figure(
    number: str, concept: str, shown: Sequence[str], scope: Scope, variants: Variants, note: str = ""
) -> Report:
    title = CONCEPTS[concept][0]
    found = {name: [best(name, concept, mu, scope) for mu in scope.speeds] for name in variants}
    settled = all(one.converged for row in found.values() for one in row)
    numbers: dict[str, float] = {}
    for name in variants:
        for one in found[name]:
            for key in shown:
                numbers[f"{name}_{key}_at_{one.mu:g}"] = _value(one, key)
            numbers[f"{name}_saving_at_{one.mu:g}"] = one.saving
    largest = {name: max(found[name], key=lambda one: one.saving) for name in VARIANTS}
    words = "; ".join(
        f"{SHORT[name]}: "
        + ", ".join(
            f"{_word(key)} {_value(found[name][0], key):.1f}° in hover to "
            f"{_value(found[name][-1], key):.1f}° at µ {scope.speeds[-1]:g}"
            for key in shown
        )
        + f", saving at most {100 * largest[name].saving:.1f} % (µ {largest[name].mu:g})"
        for name in VARIANTS
    )
    widths = [high - low for name in VARIANTS for one in found[name] for low, high in [_band(one, shown[0])]]
    widest = max(width for width in widths if math.isfinite(width))
    return Report(
        number=number,
        kind="figure",
        caption=f"Twist of least total power over speed: {title}. Shaded: within 0.1 % of that power, the other "
        f"parameters re-optimised.{note} Below it, every inflow model in both presets. {NOTE}",
        statement=caption_only(f"Figure {number}"),
        ours=f"{words}. {_across_models(found, shown, scope)}",
        verdict=Agreement.ALONE,
        because=f"The optimum is flat (up to {widest:.0f}° of twist for 0.1 % of power): read the band, not the line. "
        "With linear inflow only profile power moves it; with a model that responds to loading, induced power does too."
        + _on_bound(found, shown)
        + ("" if settled else " Not every search converged; see the table."),
        tables=(*_by_model(found, shown, scope), _table(found, shown)),
        panels=tuple(_panel(name, found[name], shown) for name in VARIANTS),
        companion=_companion(found, shown, scope),
        numbers=numbers,
    )


def _on_bound(found: "_Found", shown: Sequence[str]) -> str:
    """Names the optima that lie on the bound of the search, where the true optimum may lie beyond."""
    rates = [key for key in shown if key.endswith("rate_deg")]
    places = [
        f"{_word(key)} at {'hover' if one.mu == 0.0 else f'µ {one.mu:g}'} ({SHORT[name]})"
        for name in VARIANTS
        for one in found[name]
        for key in rates
        if abs(_value(one, key)) > BOUND_DEG - 0.05
    ]
    if not places:
        return ""
    return f" On the bound of the search, {BOUND_DEG:g}° per radius, and so not optima: {', '.join(places)}."


_Found = dict[str, list[ConceptOptimum]]
"""By variant, over the speeds."""


def _across_models(found: _Found, shown: Sequence[str], scope: Scope) -> str:
    """What the choice of inflow model does at the middle of the speeds."""
    place = len(scope.speeds) // 2
    key = shown[-1]
    rates = spread(lambda name, k: _value(found[name][k], key), tuple(found), place)
    savings = spread(lambda name, k: 100.0 * found[name][k].saving, tuple(found), place, " %")
    return f"At µ {scope.speeds[place]:g} the {_word(key)} is {rates}; the saving {savings}."


def _companion(found: _Found, shown: Sequence[str], scope: Scope) -> tuple[PlotPanel, ...]:
    panels: list[PlotPanel] = []
    for row, key in enumerate(shown):
        panels += model_panels(
            NAMES[key], lambda name, k, key=key: _value(found[name][k], key), tuple(found), scope, key=row == 0
        )
    return (
        *panels,
        *model_panels(
            "saving of total power [%]", lambda name, k: 100.0 * found[name][k].saving, tuple(found), scope, key=False
        ),
    )


def _by_model(found: _Found, shown: Sequence[str], scope: Scope) -> tuple[ReportTable, ...]:
    rates = [
        by_model(
            f"{key}_by_inflow",
            lambda name, k, key=key: with_band(found[name][k], key),
            tuple(found),
            scope,
        )
        for key in shown
    ]
    saving = by_model("saving_percent_by_inflow", lambda name, k: 100.0 * found[name][k].saving, tuple(found), scope)
    return (*rates, saving)


def _panel(name: str, row: list[ConceptOptimum], shown: Sequence[str]) -> PlotPanel:
    curves: list[Curve] = []
    hover, flying = [one for one in row if one.mu == 0.0], [one for one in row if one.mu > 0.0]
    for k, key in enumerate(shown):
        label = _word(key) if len(shown) > 1 else "optimum"
        # No inflow model is validated between hover and the lowest speed: leave a gap.
        for part, words in ((flying, label), (hover, "")):
            speeds = [one.mu for one in part]
            low, high = ([_band(one, key)[end] for one in part] for end in (0, 1))
            curves.append(curve("", speeds, low, "band", upper=high, colour=k))
            curves.append(curve(words, speeds, [_value(one, key) for one in part], "both", colour=k))
    y_label = NAMES[shown[0]] if len(shown) == 1 else "twist rate [°/R]"
    return PlotPanel("advance ratio µ", y_label, tuple(curves), title=VARIANT_TITLES[name])


def _table(found: _Found, shown: Sequence[str]) -> ReportTable:
    columns = ["preset", "inflow", "mu", "status"]
    for key in shown:
        columns += [key, f"{key}_low", f"{key}_high"]
    columns += ["twist", "total_kw", "baseline_total_kw", "saving_percent", "local_minima"]
    rows: list[list[str | float]] = []
    for name, bests in found.items():
        for one in bests:
            row: list[str | float] = [*choices(name), one.mu, "converged" if one.converged else one.message]
            for key in shown:
                row += [_value(one, key), *_band(one, key)]
            row += [one.twist, one.power_kw, one.baseline_kw, 100.0 * one.saving, one.minima]
            rows.append(row)
    return table("optimum", columns, rows)


def _word(key: str) -> str:
    return NAMES[key].partition(" [")[0]


def _value(one: ConceptOptimum, key: str) -> float:
    return one.values[one.names.index(key)]


def _band(one: ConceptOptimum, key: str) -> tuple[float, float]:
    return one.band[one.names.index(key)]
