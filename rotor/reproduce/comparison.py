"""Figure 4.13 and Table 4.1: all concepts side by side, and how much of their saving a fixed blade would have."""

from rotor.reproduce.optima import CONCEPTS, FULL, Scope, best, best_fixed
from rotor.reproduce.optimum_twist import SHORT, UNKNOWN, Variants, by_model, model_panels
from rotor.reproduce.report import Agreement, Curve, PlotPanel, Report, ReportTable, curve, table
from rotor.reproduce.runs import EVERY_VARIANT, VARIANT_TITLES, VARIANTS, choices


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
        "−16°. Below it, with every inflow model: what one linear twist saves, and what three segments add to it.",
        statement=UNKNOWN,
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
        "(equal time at every speed).",
        statement=UNKNOWN,
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
    return 100.0 * best(name, concept, mu, scope).saving


def _mean_savings(scope: Scope, variants: Variants) -> ReportTable:
    """A row a model, a column a concept: mean power over the speeds against the mean of the baseline's [%]."""
    rows: list[tuple[str | float, ...]] = []
    for name in variants:
        row: list[float] = []
        for concept in CONCEPTS:
            found = [best(name, concept, mu, scope) for mu in scope.speeds]
            row.append(100.0 * (1.0 - sum(one.power_kw for one in found) / sum(one.baseline_kw for one in found)))
        rows.append((*choices(name), *row))
    return table("mean_saving_percent", ("preset", "inflow", *CONCEPTS), rows)


def _savings_table(scope: Scope, variants: Variants) -> ReportTable:
    rows = [
        (*choices(name), concept, *(_percent(name, concept, mu, scope) for mu in scope.speeds))
        for name in variants
        for concept in CONCEPTS
    ]
    return table("saving_percent", ("preset", "inflow", "concept", *(f"mu_{mu:g}" for mu in scope.speeds)), rows)
