"""Figures 4.1–4.8 and 4.10: the optimum twist of each concept over speed. Our results only."""

import math
from collections.abc import Sequence

from rotor.reproduce.report import Curve, PlotPanel, Report, card, table, with_gap
from rotor.reproduce.runs import CONCEPTS, FULL, VARIANT_TITLES, VARIANTS, ConceptOptimum, Scope, best

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
BOUND_DEG = 30.0
"""Of every rate in the search [°/R]."""
_TWO = ("inboard_rate_deg", "outboard_rate_deg")
FIGURES: dict[str, tuple[str, tuple[str, ...], str]] = {
    "4.1": ("linear", ("rate_deg",), ""),
    "4.2": ("quadratic", ("curvature_deg",), ""),
    "4.3": ("quadratic", ("difference_deg",), ""),
    **{f"4.{k}": (f"two {10 * k}-{100 - 10 * k}", _TWO, "") for k in (4, 5, 6, 7)},
    "4.8": (
        "two airfoils", _TWO,
        " SC1094 R8 inboard, SC1095 outboard, changing at the division (our order; that of the thesis is not known). "
        "In the thesis preset decks replace the polynomials and the annulus balance eq. (3.3), in the baseline too: "
        "the R8 exists as a deck only, and (3.3) has one lift curve for a whole blade.",
    ),
    "4.10": (
        "three", ("inboard_rate_deg", "middle_rate_deg", "outboard_rate_deg"),
        " Breaks where the UH-60A changes its airfoils.",
    ),
}  # fmt: skip
"""By number: the concept, the parameters shown, and a remark."""


def optimum_figure(number: str, scope: Scope = FULL) -> Report:
    """The optimum of one concept over speed, in every variant; `number` is one of `FIGURES`."""
    concept, shown, note = FIGURES[number]
    found = {name: [best(name, concept, mu, scope) for mu in scope.speeds] for name in VARIANTS}
    largest = {name: max(row, key=lambda one: one.saving) for name, row in found.items()}
    widths = [high - low for row in found.values() for one in row for low, high in [_band(one, shown[0])]]
    widest = max(width for width in widths if math.isfinite(width))
    settled = all(one.converged for row in found.values() for one in row)
    columns = [column for key in shown for column in (key, f"{key}_low", f"{key}_high")]
    return card(
        number,
        f"Twist of least total power over speed: {CONCEPTS[concept][0]}. Shaded: within 0.1 % of that power, the "
        f"other parameters re-optimised.{note}",
        f"From hover to µ {scope.speeds[-1]:g}: "
        + "; ".join(
            f"{SHORT[name]}: "
            + ", ".join(f"{_word(key)} {_value(row[0], key):.1f}° to {_value(row[-1], key):.1f}°" for key in shown)
            + f", saving at most {100 * largest[name].saving:.1f} % (µ {largest[name].mu:g})"
            for name, row in found.items()
        )
        + ".",
        f"The optimum is flat (up to {widest:.0f}° of twist for 0.1 % of power): read the band, not the line. "
        "With linear inflow only profile power moves it; with a model that responds to loading, induced power does too."
        + _on_bound(found, shown)
        + ("" if settled else " Not every search converged."),
        table(
            "optimum",
            ("variant", "mu", *columns, "total_kw", "saving_percent"),
            [
                (name, one.mu, *(cell for key in shown for cell in (_value(one, key), *_band(one, key))), one.power_kw,
                 100.0 * one.saving)
                for name, row in found.items()
                for one in row
            ],
        ),
        tuple(_panel(name, row, shown) for name, row in found.items()),
    )  # fmt: skip


def _on_bound(found: dict[str, list[ConceptOptimum]], shown: Sequence[str]) -> str:
    """Names the optima that lie on the bound of the search, where the true optimum may lie beyond."""
    places = [
        f"{_word(key)} at {'hover' if one.mu == 0.0 else f'µ {one.mu:g}'} ({SHORT[name]})"
        for name, row in found.items()
        for one in row
        for key in shown
        if key.endswith("rate_deg") and abs(_value(one, key)) > BOUND_DEG - 0.05
    ]
    if not places:
        return ""
    return f" On the bound of the search, {BOUND_DEG:g}° per radius, and so not optima: {', '.join(places)}."


def _panel(name: str, row: list[ConceptOptimum], shown: Sequence[str]) -> PlotPanel:
    curves: list[Curve] = []
    speeds = [one.mu for one in row]
    for k, key in enumerate(shown):
        low, high = zip(*(_band(one, key) for one in row), strict=True)
        curves += with_gap("", speeds, low, "band", upper=high, colour=k)
        curves += with_gap(
            _word(key) if len(shown) > 1 else "optimum", speeds, [_value(one, key) for one in row], colour=k
        )
    y_label = NAMES[shown[0]] if len(shown) == 1 else "twist rate [°/R]"
    return PlotPanel("advance ratio µ", y_label, tuple(curves), title=VARIANT_TITLES[name])


def _word(key: str) -> str:
    return NAMES[key].partition(" [")[0]


def _value(one: ConceptOptimum, key: str) -> float:
    return one.values[one.names.index(key)]


def _band(one: ConceptOptimum, key: str) -> tuple[float, float]:
    return one.band[one.names.index(key)]
