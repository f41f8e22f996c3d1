"""Figures 3.11–3.15 and Keys et al. 1987: the effect of linear twist on power in hover and over speed.

One file, because all of them compare the same five twists: the powers are solved once, and the best of the five, the
cost of a twist and the crossings of two are used by every figure.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache, partial
from itertools import pairwise

import numpy as np

from rotor.files.make_design import make_design
from rotor.support.arrays import Array
from rotor.support.chart import Chart, Series
from rotor.trim.solve import solve
from rotor.validation.thesis.ladder import (
    FAST,
    FAST_KMH,
    HOVER,
    RUNGS,
    STRONG,
    TRIM,
    WEAK,
    linear_optimum,
    rung_design,
    strong_over_weak,
)
from rotor.validation.thesis.report import (
    TOLERANCE,
    Agreement,
    Report,
    ReportTable,
    by_name,
    curve,
    judged,
    panel,
    report,
    table,
)
from rotor.validation.thesis.runs import (
    FIVE_RATES,
    FULL,
    THESIS_WAKE,
    VARIANT_TITLES,
    main_rotor_kw,
    solve_variant,
)

MASSES = (4000.0, 5000.0, 6000.0, 7000.0, 8322.4, 9000.0)
DOCUMENT_HOVER, DOCUMENT_STRONG = -13.5, -16.0
"""The optimum in hover that the thesis states, and the twist that it says lies past it [°]."""


def by_parabola(rates: Array, powers: Array) -> tuple[float, float]:
    """Place and value of the least of powers at rates, by the parabola through the lowest and its neighbours."""
    k = int(np.clip(powers.argmin(), 1, len(rates) - 2))
    near = slice(k - 1, k + 2)
    a, b, c = np.asarray(
        np.polyfit(rates[near] - rates[k], powers[near], 2), dtype=np.float64
    ).tolist()
    return float(rates[k]) - b / (2 * a), c - b**2 / (4 * a)


@lru_cache(maxsize=8)
def hover_optimum(name: str) -> tuple[float, float, float, float]:
    """Best linear twist in hover [°], its band within 0.1 % of the power [°] and its power [kW]."""
    rates = np.arange(-24.0, -8.0, 0.5)
    powers = np.array([main_rotor_kw(name, float(rate), 0.0) for rate in rates])
    best, least = by_parabola(rates, powers)
    inside = rates[powers <= least * (1.0 + TOLERANCE)]
    return best, float(inside[0]), float(inside[-1]), least


def figure_3_11() -> Report:
    """Five twists in hover."""
    tables: list[ReportTable] = []
    panels: list[Chart] = []
    numbers: dict[str, float] = {}
    for name in ("thesis", "flight"):
        sigma = make_design(preset=name).rotor.solidity
        powers = {
            rate: [solve_variant(name, f"linear:{rate}", 0.0, mass).require() for mass in MASSES]
            for rate in FIVE_RATES
        }
        loading = [solution.ct / sigma for solution in powers[0]]
        least = [
            min(row)
            for row in zip(*([one.cp for one in powers[rate]] for rate in FIVE_RATES), strict=True)
        ]
        title = f"{name} preset"
        panels += [
            panel(title, "C_T/σ", "C_P", _five(loading, lambda rate, k, of=powers: of[rate][k].cp)),
            panel(
                title,
                "C_T/σ",
                "relative to the best of the five [%]",
                _five(
                    loading,
                    lambda rate, k, of=powers, low=least: 100.0 * (of[rate][k].cp / low[k] - 1.0),
                ),
            ),
        ]
        rows = [
            (mass, loading[k], *(powers[rate][k].power.main_rotor / 1e3 for rate in FIVE_RATES))
            for k, mass in enumerate(MASSES)
        ]
        tables.append(
            table(
                f"{name}_kw",
                ("mass_kg", "ct_over_sigma", *(f"linear_{r}" for r in FIVE_RATES)),
                rows,
            )
        )
        best, low, high, least = hover_optimum(name)
        numbers |= {
            f"{name}_optimum": best,
            f"{name}_low": low,
            f"{name}_high": high,
            f"{name}_cost_of_13_5": main_rotor_kw(name, DOCUMENT_HOVER, 0.0) / least - 1.0,
            f"{name}_cost_of_16": main_rotor_kw(name, -16, 0.0) / least - 1.0,
            f"{name}_cost_of_0": main_rotor_kw(name, 0, 0.0) / least - 1.0,
        }
    span = 1.0 - make_design(preset="thesis").rotor.blade.root_cutout
    best, _, _, least = hover_optimum("thesis")
    tip, tip_strong = (
        main_rotor_kw("thesis", twist / span, 0.0) / least - 1.0
        for twist in (DOCUMENT_HOVER, DOCUMENT_STRONG)
    )
    strong = solve_variant("thesis", "linear:-16", 0.0).require()
    numbers |= {
        "root_to_tip_optimum": best * span,
        "cost_of_13_5_root_to_tip": tip,
        "cost_of_16_root_to_tip": tip_strong,
        "largest_alpha_deg": float(np.degrees(strong.disk.alpha.max())),
        "stalled_area": strong.stalled_area,
    }
    agrees = numbers["thesis_cost_of_13_5"] <= TOLERANCE < numbers["thesis_cost_of_16"]
    return report("3.11", judged(agrees), tables=tables, panels=panels, numbers=numbers)


FIVE_NAMES = ("thesis", THESIS_WAKE, "flight")
LOW = (0.075, 0.09, 0.105, 0.12, 0.135, 0.15, 0.1635)
MEDIUM = (0.15, 0.17, 0.18, 0.19, 0.21, 0.23, 0.25)
HIGH = (0.25, 0.27, 0.29, 0.31, 0.33, 0.35)
"""Advance ratios of the thesis' low, medium and high speed. It states 130 km/h for the first, which is µ 0.1635, and
0.18; the other borders are this project's."""


def figure_3_12() -> Report:
    """Five twists at low speed."""
    best = {name: [best_of_five(name, mu) for mu in LOW] for name in FIVE_NAMES}
    slow, fast = best["thesis"][0], best["thesis"][-1]
    saves = {
        name: main_rotor_kw(name, 0, LOW[0]) / main_rotor_kw(name, -16, LOW[0]) - 1.0
        for name in FIVE_NAMES
    }
    costs = [
        mu
        for mu in LOW
        if main_rotor_kw("thesis", -16, mu) > (1 + TOLERANCE) * main_rotor_kw("thesis", 0, mu)
    ]
    numbers = {f"{name}_saving": value for name, value in saves.items()}
    beyond = f", and from µ {costs[0]:g} on it costs power" if costs else ""
    return _speeds("3.12", LOW, judged(not costs), numbers, costs=beyond, slow=slow, fast=fast)


def figure_3_13() -> Report:
    """Five twists at medium speed."""
    beyond = [mu for mu in MEDIUM if mu > 0.18]
    after = {name: [best_of_five(name, mu) for mu in beyond] for name in FIVE_NAMES}
    cost = {name: max(_cost(name, -8, mu) for mu in beyond) for name in FIVE_NAMES}
    numbers = {f"{name}_cost_of_8": value for name, value in cost.items()}
    numbers |= {f"{name}_always_8": float(set(rates) == {-8}) for name, rates in after.items()}
    agreement = judged(cost["thesis"] <= TOLERANCE)
    return _speeds(
        "3.13", MEDIUM, agreement, numbers, best=_best_words(after), cost=by_name(cost, "{:.2f} %")
    )


def figure_3_14() -> Report:
    """Five twists at high speed."""
    last = HIGH[-1]
    best = {name: [best_of_five(name, last)] for name in FIVE_NAMES}
    cost = {name: _cost(name, -4, last) for name in FIVE_NAMES}
    trim, section = (linear_optimum(on, last, None).rate_deg for on in (TRIM, ("table", "mach")))
    anywhere = max(_cost("thesis", -4, mu) for mu in HIGH)
    numbers = {f"{name}_best": float(rates[0]) for name, rates in best.items()}
    numbers |= {f"{name}_cost_of_4": value for name, value in cost.items()}
    numbers |= {"with_trim": trim, "with_section": section}
    words = {"best": _best_words(best), "cost": by_name(cost, "{:.2f} %")}
    optimum = linear_optimum((), last, None).rate_deg
    agreement = judged(anywhere <= TOLERANCE)
    return _speeds(
        "3.14", HIGH, agreement, numbers, **words, anywhere=anywhere, thesis_optimum=optimum
    )


SLOWER = 90.0
"""Rotor speed in figure 3.15 beside 100 % [%]; that of the thesis varied it too."""


@lru_cache(maxsize=64)
def slower_kw(rate: float, mu: float) -> float:
    """Main-rotor power of a linear twist at the lower rotor speed, at the airspeed that µ means at 100 % [kW].

    NaN where so much of the disk is stalled that there is none.
    """
    solution = solve(
        make_design(twist=f"linear:{rate:g}", mu=100.0 * mu / SLOWER, rotor_speed_percent=SLOWER)
    )
    return solution.power.main_rotor / 1e3 if solution.converged else math.nan


def figure_3_15() -> Report:
    """Five twists from hover to fast flight, at two rotor speeds."""
    best = [best_of_five("flight", mu) for mu in FULL]
    flown = tuple(
        mu for mu in FULL if all(math.isfinite(slower_kw(rate, mu)) for rate in FIVE_RATES)
    )
    slow = [min(FIVE_RATES, key=lambda rate, mu=mu: slower_kw(rate, mu)) for mu in flown]
    rates = zip(flown, slow, best, strict=False)
    gain = {
        mu: 1.0 - slower_kw(rate, mu) / main_rotor_kw("flight", saving, mu)
        for mu, rate, saving in rates
    }
    beyond = "" if flown == FULL else f" beyond µ {flown[-1]:g} too much of the disk is separated,"
    spread = [max(_percent("flight", rate, mu) for rate in FIVE_RATES) for mu in FULL]
    return report(
        "3.15",
        tables=[_kw_table("flight", FULL)],
        panels=[
            panel(title, "advance ratio µ at 100 %", label, _five(FULL, partial(_at, kw)))
            for title, label, kw in (
                ("100 % rotor speed", "main-rotor power [kW]", partial(main_rotor_kw, "flight")),
                (f"{SLOWER:.0f} % rotor speed", "main-rotor power [kW]", slower_kw),
                (
                    "100 % rotor speed",
                    "relative to the best of the five [%]",
                    partial(_percent, "flight"),
                ),
            )
        ],
        numbers={
            "hover_best": float(best[0]),
            "fast_best": float(best[-1]),
            "slower_saves": gain[0.2],
        },
        best=_path(best, FULL),
        slow=_path(slow, flown),
        beyond=beyond,
        fastest=flown[-1],
        hover_spread=spread[0],
        least_spread=min(spread[1:]),
        largest_spread=max(spread[1:]),
        slow_changes=-gain[0.2],
        fast_changes=-gain[flown[-1]],
        neighbours=", ".join(f"{_neighbours(mu)} % at µ {mu:g}" for mu in (0.2, 0.35)),
    )


def _at(value: Callable[[float, float], float], rate: int, place: int) -> float:
    """The value of a twist at one of the speeds of chapter 4."""
    return value(rate, FULL[place])


def _neighbours(mu: float) -> str:
    """What the two twists beside the best of the five cost [%]."""
    k = FIVE_RATES.index(best_of_five("flight", mu))
    return " and ".join(
        f"{_percent('flight', rate, mu):.1f}"
        for rate in (*FIVE_RATES[max(k - 1, 0) : k], *FIVE_RATES[k + 1 : k + 2])
    )


def _five(x: Sequence[float], value: Callable[[int, int], float]) -> tuple[Series, ...]:
    """A curve for each of the five twists; `value` of a twist at a place in x."""
    return tuple(
        curve(f"{rate}°", x, [value(rate, k) for k in range(len(x))]) for rate in FIVE_RATES
    )


def best_of_five(name: str, mu: float) -> int:
    """The best of the thesis' five twists [°/R]."""
    return min(FIVE_RATES, key=lambda rate: main_rotor_kw(name, rate, mu))


def _kw_table(name: str, speeds: Sequence[float]) -> ReportTable:
    """The powers of the five twists over speed, and the best of them."""
    rows = [
        (mu, *(main_rotor_kw(name, rate, mu) for rate in FIVE_RATES), best_of_five(name, mu))
        for mu in speeds
    ]
    return table(f"{name}_kw", ("mu", *(f"linear_{rate}" for rate in FIVE_RATES), "best"), rows)


def _cost(name: str, rate: float, mu: float) -> float:
    """Part of the power that a twist costs beyond the best of the five."""
    return main_rotor_kw(name, rate, mu) / main_rotor_kw(name, best_of_five(name, mu), mu) - 1.0


def _percent(name: str, rate: float, mu: float) -> float:
    return 100.0 * _cost(name, rate, mu)


def _best_words(best: dict[str, list[int]]) -> str:
    return ", ".join(
        f"{' and '.join(f'{rate}°' for rate in dict.fromkeys(rates))} ({name})"
        for name, rates in best.items()
    )


def crossings(name: str, first: int, second: int, speeds: tuple[float, ...]) -> list[float]:
    """Advance ratios where two twists need the same power, linear between the speeds."""
    gap = np.array(
        [main_rotor_kw(name, first, mu) - main_rotor_kw(name, second, mu) for mu in speeds]
    )
    crossed: list[float] = []
    for k in np.flatnonzero(gap[:-1] * gap[1:] < 0.0):
        crossed.append(
            float(speeds[k] + (speeds[k + 1] - speeds[k]) * gap[k] / (gap[k] - gap[k + 1]))
        )
    return crossed


def _speeds(
    number: str,
    speeds: tuple[float, ...],
    verdict: Agreement,
    numbers: dict[str, float],
    **words: str | float,
) -> Report:
    panels = tuple(
        panel(
            VARIANT_TITLES[name],
            "advance ratio µ",
            label,
            _five(speeds, lambda rate, k, of=of, name=name: of(name, rate, speeds[k])),
        )
        for label, of in (
            ("main-rotor power [kW]", main_rotor_kw),
            ("relative to the best of the five [%]", _percent),
        )
        for name in FIVE_NAMES
    )
    paths = "; ".join(
        f"{name}: best of five " + _path([best_of_five(name, mu) for mu in speeds], speeds)
        for name in FIVE_NAMES
    )
    crossed: list[tuple[str | float, ...]] = []
    for name in FIVE_NAMES:
        for first, second in pairwise(FIVE_RATES):
            crossed += [(name, first, second, mu) for mu in crossings(name, first, second, speeds)]
    met = [
        f"{first}° and {second}° at µ {mu:.3f}"
        for name, first, second, mu in crossed
        if name == "thesis"
    ]
    tables = [
        *(_kw_table(name, speeds) for name in FIVE_NAMES),
        table("crossings", ("variant", "first_deg", "second_deg", "mu"), crossed),
    ]
    paths += ". " + (f"Crossings (thesis): {', '.join(met)}." if met else "No crossings (thesis).")
    return report(
        number, verdict, tables=tables, panels=panels, numbers=numbers, paths=paths, **words
    )


def _path(values: list[int], speeds: tuple[float, ...]) -> str:
    """`−12°, −8° from µ 0.09`."""
    steps = zip(values, values[1:], speeds[1:], strict=False)
    parts = [
        f"{values[0]}°",
        *(f"{value}° from µ {mu:g}" for before, value, mu in steps if value != before),
    ]
    return ", ".join(parts)


SPEEDS_KMH = (0.0, 80.0, 160.0, 240.0, 280.0, 300.0, FAST_KMH)
CLOSE = 0.5
"""Part of a measured effect of twist by which the computed one may be off and agree: another rotor's."""


AREAS = (0.0, 0.5, 1.1, 2.0, 3.27)
"""Drag areas [m²] that give a rotor on a test stand its propulsive force; the last is that of the UH-60A."""
USUAL_FORCE = 0.05
"""X/(q d² σ) that tunnel tests of helicopter rotors usually set; the thesis does not state that of Keys et al."""


@lru_cache(maxsize=64)
def over_drag_area(
    area: float, elastic: bool, bending: bool, inflow: str | None
) -> tuple[float, float]:
    """Power of −17.3° over −11.5° at 330 km/h less 1, and what speed that costs −17.3° at equal power [km/h].

    Flight preset with a drag area [m²], which the rotor pulls.
    """

    def power(rate: float, kmh: float) -> float:
        on = tuple(RUNGS) if elastic else tuple(RUNGS)[:-1]
        design = rung_design(
            on, kmh / 3.6 / make_design().rotor.tip_speed, f"linear:{rate}", inflow
        )
        models, fuselage = (
            replace(design.models, bending=bending),
            replace(design.fuselage, drag_area=area),
        )
        return solve(replace(design, models=models, fuselage=fuselage)).require().power.main_rotor

    strong, weak, slower = (
        power(STRONG, FAST_KMH),
        power(WEAK, FAST_KMH),
        power(STRONG, FAST_KMH - 10.0),
    )
    return strong / weak - 1.0, 10.0 * (strong - weak) / (strong - slower)


FORCE_MODELS: dict[str, tuple[bool, bool, str | None]] = {
    "flight": (True, False, None),
    "rigid in torsion": (False, False, None),
    "bending": (True, True, None),
    "Pitt–Peters": (True, False, "pitt-peters"),
    "local momentum": (True, False, "local-momentum"),
}


RUNGS_OF = {"thesis": (), THESIS_WAKE: ("wake",), "flight": tuple(RUNGS)}


def keys_1987() -> Report:
    """Two twists, hover to fast flight, and over propulsive force."""
    percent = {
        name: [100.0 * strong_over_weak(on, kmh) for kmh in SPEEDS_KMH]
        for name, on in RUNGS_OF.items()
    }
    hover, fast = percent["flight"][0], percent["flight"][-1]
    near = [
        abs(here - 100.0 * of) <= 100.0 * CLOSE * abs(of)
        for here, of in ((hover, HOVER), (fast, FAST))
    ]
    rotor = make_design().rotor
    force = [area / ((2.0 * rotor.radius) ** 2 * rotor.solidity) for area in AREAS]
    over = {
        words: [over_drag_area(area, *model) for area in AREAS]
        for words, model in FORCE_MODELS.items()
    }
    ratio = {words: [100.0 * point[0] for point in row] for words, row in over.items()}
    lowest, highest = (
        np.array([f(column) for column in zip(*ratio.values(), strict=True)]) for f in (min, max)
    )
    usual, low, high = (
        float(np.interp(USUAL_FORCE, force, row)) for row in (ratio["flight"], lowest, highest)
    )
    slower = float(np.interp(USUAL_FORCE, force, [point[1] for point in over["flight"]]))
    by_speed = (
        *(
            curve(name, SPEEDS_KMH, row, "both", colour=k)
            for k, (name, row) in enumerate(percent.items())
        ),
        curve("Keys et al. 1987", (0.0, FAST_KMH), (100 * HOVER, 100 * FAST), "points", colour=7),
    )
    by_force = (
        curve("", force, lowest, "band", upper=highest, colour=2),
        *(
            curve(words, force, row, "both", colour=k)
            for k, (words, row) in enumerate(ratio.items(), 2)
        ),
        curve(
            "measured, force not stated",
            (force[0], force[-1]),
            (100 * FAST,) * 2,
            "dashed",
            colour=7,
        ),
    )
    return report(
        "keys 1987",
        judged(all(near)),
        tables=(
            table(
                "over_propulsive_force",
                ("X_over_qd2sigma", *(f"{words} [%]" for words in over), "slower [km/h]"),
                [
                    (x, *(row[k] for row in ratio.values()), over["flight"][k][1])
                    for k, x in enumerate(force)
                ],
            ),
            table(
                "over_speed_percent",
                ("speed_kmh", *percent),
                [(kmh, *row) for kmh, *row in zip(SPEEDS_KMH, *percent.values(), strict=True)],
            ),
        ),
        panels=(
            panel("", "speed [km/h]", "power of −17.3° over −11.5° [%]", by_speed),
            panel("", "X/qd²σ", "power of −17.3° over −11.5° at 330 km/h [%]", by_force),
        ),
        numbers={
            **{f"{name}_hover": row[0] / 100.0 for name, row in percent.items()},
            **{f"{name}_fast": row[-1] / 100.0 for name, row in percent.items()},
            "usual_force": usual / 100.0,
            "usual_low": low / 100.0,
            "usual_high": high / 100.0,
            "slower_kmh": slower,
        },
        lowest=lowest[-1],
        highest=highest[-1],
        models=len(over),
        usual_low_percent=low,
        usual_high_percent=high,
        ends="both ends of the range are"
        if all(near)
        else "the two ends of the range are not both",
        without_force=ratio["flight"][0],
        with_drag=ratio["flight"][-1],
        force=force[-1],
    )
