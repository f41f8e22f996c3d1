"""Figures 3.12–3.15: five linear twists over speed, and where they cross."""

from itertools import pairwise

import numpy as np

from rotor.reproduce.report import Curve, Panel, Report, Table, Verdict, curve, judged, table
from rotor.reproduce.runs import (
    FIVE_RATES,
    THESIS_TRIMMED,
    THESIS_WAKE,
    VARIANT_TITLES,
    main_rotor_kw,
)

NAMES = ("thesis", THESIS_WAKE, "flight")
LOW = (0.075, 0.09, 0.105, 0.12, 0.135, 0.15)
MEDIUM = (0.15, 0.17, 0.18, 0.19, 0.21, 0.23, 0.25)
HIGH = (0.25, 0.27, 0.29, 0.31, 0.33, 0.35)
"""Advance ratios of the document's low, medium and high speed. It states 0.18 only; the borders are ours."""


def figure_3_12() -> Report:
    """Five twists at low speed."""
    best = {name: [best_of_five(name, mu) for mu in LOW] for name in NAMES}
    slow, fast = best["thesis"][0], best["thesis"][-1]
    saves = {name: main_rotor_kw(name, 0, LOW[0]) / main_rotor_kw(name, -16, LOW[0]) - 1.0 for name in NAMES}
    costs = [mu for mu in LOW if main_rotor_kw("thesis", -16, mu) > main_rotor_kw("thesis", 0, mu)]
    return _speeds(
        "3.12", "low", LOW,
        "At low speed highly twisted blades need less power (p. 28).",
        not costs,
        f"At µ {LOW[0]:g}, −16° against 0° saves {100 * saves['thesis']:.1f} % in the thesis preset"
        + (f", and from µ {costs[0]:g} on it costs power" if costs else "")
        + f": its linear inflow cannot see twist, so its best goes from {slow}° to {fast}° by profile drag alone. Once "
        f"the wake answers, twist saves {100 * saves[THESIS_WAKE]:.1f} % on the same blade, "
        f"{100 * saves['flight']:.1f} % in the flight preset.",
        {f"{name}_saving": value for name, value in saves.items()},
    )  # fmt: skip


def figure_3_13() -> Report:
    """Five twists at medium speed."""
    beyond = [mu for mu in MEDIUM if mu > 0.18]
    after = {name: [best_of_five(name, mu) for mu in beyond] for name in NAMES}
    cost = {name: max(_cost(name, -8, mu) for mu in beyond) for name in NAMES}
    return _speeds(
        "3.13", "medium", MEDIUM,
        "Beyond µ 0.18 the twist of −8° needs the least power (p. 28).",
        set(after["thesis"]) == {-8},
        f"Beyond 0.18 the best of the five is {_best_words(after)}; −8° costs at most {_cost_words(cost)}. Linear "
        "inflow leaves the choice to profile drag, on a flat curve"
        + (
            "; with the wake in its place the same blade does what the document says."
            if set(after[THESIS_WAKE]) == {-8}
            else "."
        ),
        {
            **{f"{name}_cost_of_8": value for name, value in cost.items()},
            **{f"{name}_always_8": float(set(rates) == {-8}) for name, rates in after.items()},
        },
    )  # fmt: skip


def figure_3_14() -> Report:
    """Five twists at high speed."""
    last = HIGH[-1]
    best = {name: [best_of_five(name, last)] for name in NAMES}
    cost = {name: _cost(name, -4, last) for name in NAMES}
    trimmed = best_of_five(THESIS_TRIMMED, last)
    anywhere = max(_cost("thesis", -4, mu) for mu in HIGH)
    return _speeds(
        "3.14", "high", HIGH,
        "At high speed −4° gives better results (p. 28).",
        best["thesis"] == [-4] and anywhere < 2e-3,
        f"At µ {last:g} the best of the five is {_best_words(best)}; −4° costs {_cost_words(cost)}, and in "
        f"the thesis preset nowhere from µ {HIGH[0]:g} on more than {100 * anywhere:.2f} %. "
        f"The document's blade and section with the wake and a trim by cyclic, with µ sin α in U_P, prefers {trimmed}°"
        + (
            ": it is the trim and the term missing from (3.6), not the section or Mach number, that make −4° win."
            if trimmed == best["flight"][0]
            else "."
        ),
        {
            **{f"{name}_best": float(rates[0]) for name, rates in best.items()},
            **{f"{name}_cost_of_4": value for name, value in cost.items()},
            "thesis-trimmed_best": float(trimmed),
        },
    )  # fmt: skip


def figure_3_15() -> Report:
    """All five over speed."""
    speeds = (*LOW, *MEDIUM[1:], *HIGH[1:])
    tables = tuple(_power_table(name, speeds, f"{name}_kw") for name in NAMES)
    panels = tuple(
        Panel(
            "advance ratio µ",
            "power over that of −8° [%]",
            tuple(
                curve(
                    f"{rate}°", speeds,
                    [100.0 * (main_rotor_kw(name, rate, mu) / main_rotor_kw(name, -8, mu) - 1.0) for mu in speeds],
                    colour=k,
                )
                for k, rate in enumerate(FIVE_RATES)
            ),
            title=VARIANT_TITLES[name],
        )
        for name in NAMES
    )  # fmt: skip
    spread = {name: max(_spread(name, mu) for mu in speeds) for name in NAMES}
    return Report(
        number="3.15",
        kind="figure",
        caption="Five linear twists over speed, as power over that of −8°. The document shows here a figure of Han et "
        "al. 2015 (elastic blades, variable twist), which cannot be rebuilt with rigid blades; this is its subject.",
        statement="A figure of another work, whose numbers the text we hold does not give (p. 29).",
        ours="Largest spread between the five: "
        + ", ".join(f"{100 * spread[name]:.1f} % ({name})" for name in NAMES)
        + ".",
        verdict=Verdict.ALONE,
        because="The text ends with this figure.",
        tables=tables,
        panels=panels,
        numbers={f"{name}_spread": value for name, value in spread.items()},
    )


def best_of_five(name: str, mu: float) -> int:
    """The best of the document's five twists [°/R]."""
    return min(FIVE_RATES, key=lambda rate: main_rotor_kw(name, rate, mu))


def _cost(name: str, rate: float, mu: float) -> float:
    """Part of the power that a twist costs beyond the best of the five."""
    return main_rotor_kw(name, rate, mu) / main_rotor_kw(name, best_of_five(name, mu), mu) - 1.0


def _best_words(best: dict[str, list[int]]) -> str:
    return ", ".join(f"{_several(rates)} ({name})" for name, rates in best.items())


def _cost_words(cost: dict[str, float]) -> str:
    return ", ".join(f"{100 * value:.2f} % ({name})" for name, value in cost.items())


def crossings(name: str, first: int, second: int, speeds: tuple[float, ...]) -> list[float]:
    """Advance ratios where two twists need the same power, linear between the speeds."""
    gap = np.array([main_rotor_kw(name, first, mu) - main_rotor_kw(name, second, mu) for mu in speeds])
    found: list[float] = []
    for k in np.flatnonzero(gap[:-1] * gap[1:] < 0.0):
        found.append(float(speeds[k] + (speeds[k + 1] - speeds[k]) * gap[k] / (gap[k] - gap[k + 1])))
    return found


def _speeds(
    number: str, word: str, speeds: tuple[float, ...], statement: str, agrees: bool, because: str,
    extra: dict[str, float],
) -> Report:  # fmt: skip
    panels: list[Panel] = []
    for name in NAMES:
        curves: list[Curve] = [
            curve(f"{rate}°", speeds, [main_rotor_kw(name, rate, mu) for mu in speeds], colour=k)
            for k, rate in enumerate(FIVE_RATES)
        ]
        panels.append(Panel("advance ratio µ", "main-rotor power [kW]", tuple(curves), title=VARIANT_TITLES[name]))
    words = "; ".join(
        f"{name}: best of five " + _path([best_of_five(name, mu) for mu in speeds], speeds) for name in NAMES
    )
    crossed: list[tuple[str | float, ...]] = []
    for name in NAMES:
        for first, second in pairwise(FIVE_RATES):
            crossed += [(name, first, second, mu) for mu in crossings(name, first, second, speeds)]
    met = [f"{first}° and {second}° at µ {mu:.3f}" for name, first, second, mu in crossed if name == "thesis"]
    return Report(
        number=number,
        kind="figure",
        caption=f"Main-rotor power of five linear twists at {word} speed.",
        statement=statement,
        ours=words + ". " + (f"Crossings (thesis): {', '.join(met)}." if met else "No crossings (thesis)."),
        verdict=judged(agrees),
        because=because,
        tables=(
            *(_power_table(name, speeds, f"{name}_kw") for name in NAMES),
            table("crossings", ("variant", "first_deg", "second_deg", "mu"), crossed),
        ),
        panels=tuple(panels),
        numbers={**{f"{name}_best_last": float(best_of_five(name, speeds[-1])) for name in NAMES}, **extra},
    )


def _power_table(name: str, speeds: tuple[float, ...], title: str) -> Table:
    rows = [(mu, *(main_rotor_kw(name, rate, mu) for rate in FIVE_RATES), best_of_five(name, mu)) for mu in speeds]
    return table(title, ("mu", *(f"linear_{rate}" for rate in FIVE_RATES), "best"), rows)


def _spread(name: str, mu: float) -> float:
    powers = [main_rotor_kw(name, rate, mu) for rate in FIVE_RATES]
    return max(powers) / min(powers) - 1.0


def _several(values: list[int]) -> str:
    return " and ".join(f"{value}°" for value in dict.fromkeys(values))


def _path(values: list[int], speeds: tuple[float, ...]) -> str:
    """`−12° to µ 0.09, then −8°`."""
    parts: list[str] = [f"{values[0]}°"]
    for before, value, mu in zip(values, values[1:], speeds[1:], strict=False):
        if value != before:
            parts.append(f"{value}° from µ {mu:g}")
    return ", ".join(parts)
