"""Every inflow model in both presets, side by side: the companion pictures and the tables of chapter 4."""

import math
from collections.abc import Callable, Sequence

from rotor.aero.inflow import INFLOW_MODELS
from rotor.reproduce.optima import Best, Scope
from rotor.reproduce.report import Cell, Curve, Panel, Table, curve, table
from rotor.reproduce.runs import PRESETS, choices

LINEAR = tuple(name for name, model in INFLOW_MODELS.items() if not model.load_dependent)
"""Models whose inflow does not answer to where the lift is; they lie on one another."""
REACTING = tuple(name for name, model in INFLOW_MODELS.items() if model.load_dependent)
NOTE = "In hover every model gives the same: there the annuli balance themselves."

Value = Callable[[str, int], float]
"""Of a variant, at a place in the list of speeds."""


def model_panels(y_label: str, value: Value, variants: Sequence[str], scope: Scope, *, key: bool) -> tuple[Panel, ...]:
    """One panel a preset, a line a model, over the speeds of forward flight; `key`: whether the lines are named."""
    flying = [k for k, mu in enumerate(scope.speeds) if mu > 0.0]
    speeds = [scope.speeds[k] for k in flying]
    panels: list[Panel] = []
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
        panels.append(Panel("advance ratio µ", y_label, tuple(curves), title=f"{preset} preset, every inflow model"))
    return tuple(panels)


def by_model(title: str, cell: Callable[[str, int], Cell], variants: Sequence[str], scope: Scope) -> Table:
    """A row a model, a column a speed."""
    columns = ("preset", "inflow", *("hover" if mu == 0.0 else f"mu_{mu:.3g}" for mu in scope.speeds))
    places = range(len(scope.speeds))
    return table(title, columns, [(*choices(name), *(cell(name, k) for k in places)) for name in variants])


def with_band(one: Best, key: str) -> str:
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

    words = ((of(LINEAR), "with the linear models"), (of(REACTING), "with those that answer to the load"))
    return ", ".join(f"{found} {kind}" for found, kind in words if found)
