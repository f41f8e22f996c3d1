"""What the thesis would have found: one page to show.

The ladder of `rotor.reproduce.ladder` as a picture, the answers to its three questions and what they rest on.
"""

from rotor.chart import Axis, Chart, Series
from rotor.reproduce.actuation import COMPARED, compared, table_5_2
from rotor.reproduce.ladder import RUNGS, calls, climb
from rotor.reproduce.optimum_twist import table_4_1
from rotor.reproduce.report import Report, curve, filled_rows, report, table
from rotor.reproduce.runs import CONCEPTS, Call, searches
from rotor.reproduce.twist_effect import keys_1987

MOVED = {
    "table": "section table for polynomials",
    "mach": "drag rise",
    "wake": "lifting line",
    "trim": "trim by cyclic with µ sin α in U_P",
    "blade": "blade as built",
    "losses": "swirl, friction, download",
    "elastic": "torsion",
}
"""Steps of the ladder, in words."""
SHOWN = (0.0, 0.2, 0.35)
"""µ in the picture: hover, near least power, fast."""
ENDS = ("hover", "middle", "fast")


def needed() -> list[Call]:
    """The searches, made once."""
    return [*(call for group in calls() for call in group), *searches(CONCEPTS), COMPARED]


def today() -> Report:
    """One picture, five sentences and their numbers."""
    ladder = climb()
    first, last = (ladder.step(name) for name in ("thesis", tuple(RUNGS)[-1]))
    places = range(len(ladder.steps))
    curves: list[Series] = []
    for k, mu in enumerate(SHOWN):
        row = [ladder.at(step.name, mu) for step in ladder.steps]
        low, high = zip(*(least.band_deg for least in row), strict=True)
        curves += [
            curve("", places, low, "band", upper=high, colour=k),
            curve("hover" if mu == 0.0 else f"µ {mu:g}", [least.rate_deg for least in row], places, "both", colour=k),
        ]
    gains = [row.moving.gain for row in ladder.inflows]
    keys, tested, others = last.strong_over_weak, keys_1987().numbers, [row.best[-1].rate_deg for row in ladder.inflows]
    concepts, actuators, pair = table_4_1().numbers, table_5_2().numbers, compared("flight").rows[0]

    def moves(mu: float) -> str:
        ways = {words: ladder.moves(name, mu).in_ladder for name, words in MOVED.items()}
        return ", ".join(f"{words} {ways[words]:+.1f}°" for words in sorted(ways, key=lambda words: -abs(ways[words])))

    numbers = {
        **{f"thesis_{end}": ladder.at("thesis", mu).rate_deg for end, mu in zip(ENDS, SHOWN, strict=True)},
        **{f"flight_{end}": ladder.at(last.name, mu).rate_deg for end, mu in zip(ENDS, SHOWN, strict=True)},
        "thesis_beyond_fixed": first.moving.gain,
        "flight_beyond_fixed": last.moving.gain,
    }
    rows = filled_rows(
        "today", **{**concepts, **actuators, **tested, **numbers},
        weakest=min(others), strongest=max(others), models=len(gains), without_drag=ladder.without_drag_deg,
        fixed=last.moving.fixed_deg, least_gain=100.0 * min(gains), largest_gain=max(gains),
        actuator=pair[0].partition(",")[0], concept=pair[1], costs=-actuators["best_kw"],
        moves_middle=moves(SHOWN[1]), moves_fast=moves(SHOWN[2]), keys_hover=keys[0], keys_fast=keys[1],
    )  # fmt: skip
    return report(
        "today",
        tables=(
            table("answer", ("", ""), rows, shown=True),
            table(
                "ladder",
                ("change", *(f"mu_{mu:g}" for mu in ladder.speeds),
                 *(f"{way} at µ {mu:g}" for mu in ladder.named
                   for way in ("moves", "alone on thesis", "alone off flight")),
                 "moving saves [%]", "−17.3/−11.5 [%]"),
                [
                    (step.words, *(x.rate_deg for x in step.best),
                     *(x for ways in step.moves or ((("",) * 3),) * len(ladder.named) for x in ways),
                     100 * step.moving.gain, 100 * step.strong_over_weak[1])
                    for step in (*ladder.steps, ladder.trim)
                ],
            ),
        ),
        panels=(
            Chart(
                "", Axis("best linear twist [°/R]"), Axis(names=tuple(step.words for step in ladder.steps)),
                tuple(curves),
            ),
        ),
        numbers=numbers,
    )  # fmt: skip
