"""Figures 3.11–3.15: five linear twists in hover and over speed, their crossings, the hover optimum."""

from functools import lru_cache

import numpy as np

from rotor.presets import make_design
from rotor.reproduce.report import Curve, Panel, Report, Table, Verdict, curve, judged, table
from rotor.reproduce.runs import (
    FIVE_RATES,
    THESIS_WAKE,
    VARIANT_TITLES,
    main_rotor_kw,
    solved,
)

NAMES = ("thesis", THESIS_WAKE, "flight")
LOW = (0.075, 0.09, 0.105, 0.12, 0.135, 0.15)
MEDIUM = (0.15, 0.17, 0.18, 0.19, 0.21, 0.23, 0.25)
HIGH = (0.25, 0.27, 0.29, 0.31, 0.33, 0.35)
"""Advance ratios of the document's low, medium and high speed. It states 0.18 only; the borders are ours."""
MASSES = (4000.0, 5000.0, 6000.0, 7000.0, 8322.4, 9000.0)
DOCUMENT_HOVER = -13.5
FLAT = 1e-3
"""Part of the power within which twists count as equally good."""


@lru_cache(maxsize=8)
def hover_optimum(name: str) -> tuple[float, float, float, float]:
    """Best linear twist in hover [°], the ends of the band within 0.1 % [°], and its power [kW]; parabola on 0.5° steps."""
    rates = np.arange(-24.0, -8.0, 0.5)
    powers = np.array([main_rotor_kw(name, float(rate), 0.0) for rate in rates])
    k = int(powers.argmin())
    a, b, c = np.polyfit(rates[k - 1 : k + 2] - rates[k], powers[k - 1 : k + 2], 2)
    best, least = float(rates[k] - b / (2 * a)), float(c - b**2 / (4 * a))
    inside = rates[powers <= least * (1.0 + FLAT)]
    return best, float(inside[0]), float(inside[-1]), least


def figure_3_11() -> Report:
    """Five twists in hover."""
    tables: list[Table] = []
    panels: list[Panel] = []
    numbers: dict[str, float] = {}
    words: list[str] = []
    for name in ("thesis", "flight"):
        sigma = make_design(name).rotor.solidity
        powers = {rate: [solved(name, f"linear:{rate}", 0.0, mass).require() for mass in MASSES] for rate in FIVE_RATES}
        loading = [one.ct / sigma for one in powers[0]]
        curves = [curve(f"{rate}°", loading, [one.cp for one in powers[rate]]) for rate in FIVE_RATES]
        panels.append(Panel("C_T/σ", "C_P", tuple(curves), title=VARIANT_TITLES[name]))
        rows = [
            (mass, loading[k], *(powers[rate][k].power.main_rotor / 1e3 for rate in FIVE_RATES))
            for k, mass in enumerate(MASSES)
        ]
        tables.append(table(f"{name}_kw", ("mass_kg", "ct_over_sigma", *(f"linear_{r}" for r in FIVE_RATES)), rows))
        best, low, high, least = hover_optimum(name)
        at_document = main_rotor_kw(name, DOCUMENT_HOVER, 0.0) / least - 1.0
        numbers |= {
            f"{name}_optimum": best, f"{name}_band_low": low, f"{name}_band_high": high,
            f"{name}_cost_of_13_5": at_document,
            f"{name}_cost_of_16": main_rotor_kw(name, -16, 0.0) / least - 1.0,
            f"{name}_cost_of_0": main_rotor_kw(name, 0, 0.0) / least - 1.0,
        }  # fmt: skip
        words.append(
            f"{name}: optimum {best:.1f}° (within 0.1 % from {low:.1f} to {high:.1f}°); −13.5° costs "
            f"{100 * at_document:.2f} %, −16° {100 * numbers[f'{name}_cost_of_16']:.2f} %, no twist "
            f"{100 * numbers[f'{name}_cost_of_0']:.1f} %"
        )
    best = numbers["thesis_optimum"]
    agrees = abs(best - DOCUMENT_HOVER) < 0.5
    return Report(
        number="3.11",
        kind="figure",
        caption="Power in hover against thrust for five linear twists.",
        statement="Power falls with more twist down to an optimum of −13.5°; −16° lies past it, because the inner blade "
        "stalls (p. 27).",
        ours="; ".join(words) + ".",
        verdict=judged(agrees),
        because="There is one shallow optimum"
        + ("." if agrees else f", but ours lies at {best:.1f}°, so −16° ")
        + ("" if agrees else ("is not past it" if best < -16.0 else "is past it"))
        + f": the document's −13.5° costs {100 * numbers['thesis_cost_of_13_5']:.2f} % here. Where the inner blade stalls "
        "rests on the polar and its fit, which the document does not state.",
        tables=tuple(tables),
        panels=tuple(panels),
        numbers=numbers,
    )


def figure_3_12() -> Report:
    """Five twists at low speed."""
    best = {name: [best_of_five(name, mu) for mu in LOW] for name in NAMES}
    slow, fast = best["thesis"][0], best["thesis"][-1]
    saves = {name: main_rotor_kw(name, 0, LOW[0]) / main_rotor_kw(name, -16, LOW[0]) - 1.0 for name in NAMES}
    return _speeds(
        "3.12", "low", LOW,
        "At low speed highly twisted blades need less power (p. 28).",
        saves["thesis"] > 0.0,
        f"At µ {LOW[0]:g}, −16° against 0° saves {100 * saves['thesis']:+.1f} % in the thesis preset: its linear inflow "
        f"cannot see twist, so its best goes from {slow}° to {fast}° by profile drag alone. Once the wake answers, twist "
        f"saves {100 * saves[THESIS_WAKE]:.1f} % on the same blade, {100 * saves['flight']:.1f} % in the flight preset.",
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
        f"Beyond 0.18 the best of the five is {_best_words(after)}; −8° costs at most {_cost_words(cost)}. Linear inflow "
        "leaves the choice to profile drag, on a flat curve"
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
    return _speeds(
        "3.14", "high", HIGH,
        "At high speed −4° gives better results (p. 28).",
        best["thesis"] == [-4],
        f"At µ {last:g} the best of the five is {_best_words(best)}; −4° costs {_cost_words(cost)}. Where −4° does not win, "
        "drag rise on the advancing tip, which the document leaves out, asks for more twist.",
        {
            **{f"{name}_best": float(rates[0]) for name, rates in best.items()},
            **{f"{name}_cost_of_4": value for name, value in cost.items()},
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
        caption="Five linear twists over speed, as power over that of −8°. The document shows here a figure of Han et al. "
        "2015 (elastic blades, variable twist), which cannot be rebuilt with rigid blades; this is its subject.",
        statement="A figure of another work, whose numbers the text we hold does not give (p. 29).",
        ours="Largest spread between the five: " + ", ".join(f"{100 * spread[name]:.1f} % ({name})" for name in NAMES) + ".",
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
        for first, second in zip(FIVE_RATES, FIVE_RATES[1:], strict=False):
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
