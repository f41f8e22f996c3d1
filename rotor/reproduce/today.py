"""What the thesis would have found: its main results with its own assumptions and with today's best physics.

Both halves are this program: the `thesis` preset is the document as printed, the `flight` preset has real sections,
drag rise, a wake that responds to loading, trim by cyclic and a blade that twists under load.
"""

from rotor.reproduce.report import Agreement, Curve, PlotPanel, Report, TableCell, curve, table
from rotor.reproduce.runs import FIVE_RATES, FULL, Call, Scope, best, best_fixed, main_rotor_kw, searches, solved
from rotor.reproduce.twist_effect import best_of_five

TWO = ("thesis", "flight")
NAMES = {"thesis": "as the thesis assumes", "flight": "with today's physics"}
HOVER_RATES = tuple(float(rate) for rate in range(-28, -3, 2))
SHOWN = (0.10, 0.20, 0.30, 0.35)
"""µ of the table of five twists."""


def needed(name: str) -> list[Call]:
    """The searches of one variant."""
    if name not in TWO:
        return []
    return [*searches(("linear", "three"), name, FULL), (best_fixed, (name, FULL))]


def today(scope: Scope = FULL) -> Report:
    """Four pictures and one table."""
    hover = {name: [main_rotor_kw(name, rate, 0.0) for rate in HOVER_RATES] for name in TWO}
    over: list[Curve] = [
        curve(NAMES[name], HOVER_RATES, [100.0 * (power / min(hover[name]) - 1.0) for power in hover[name]], colour=k)
        for k, name in enumerate(TWO)
    ]
    fixed = {name: best_fixed(name, scope) for name in TWO}
    flying = [mu for mu in scope.speeds if mu > 0.0]
    twist: list[Curve] = []
    saved: list[Curve] = []
    beyond: list[Curve] = []
    numbers: dict[str, float] = {}
    for k, name in enumerate(TWO):
        found = [best(name, "linear", mu, scope) for mu in flying]
        low, high = ([one.band[0][end] for one in found] for end in (0, 1))
        twist += [
            curve("", flying, low, "band", upper=high, colour=k),
            curve(NAMES[name], flying, [one.values[0] for one in found], "both", colour=k),
        ]
        saved += [
            curve(f"one linear twist, {NAMES[name]}", flying, [100 * one.saving for one in found], "both", colour=k),
            curve(
                f"three segments, {NAMES[name]}", flying,
                [100 * best(name, "three", mu, scope).saving for mu in flying], "dashed", colour=k,
            ),
        ]  # fmt: skip
        cost = [100 * (1 - one.power_kw / _total_kw(name, fixed[name].rate_deg, one.mu)) for one in found]
        beyond.append(curve(NAMES[name], flying, cost, "both", colour=k))
        every = [best(name, "linear", mu, scope) for mu in scope.speeds]
        moving = sum(one.power_kw for one in every) / len(every)
        numbers |= {
            f"{name}_hover": every[0].values[0],
            f"{name}_fast": every[-1].values[0],
            f"{name}_saving": 1 - moving / fixed[name].baseline_kw,
            f"{name}_fixed_deg": fixed[name].rate_deg,
            f"{name}_beyond_fixed": 1 - moving / fixed[name].power_kw,
            f"{name}_three": 1
            - sum(best(name, "three", mu, scope).power_kw for mu in scope.speeds)
            / sum(one.baseline_kw for one in every),
        }
    rows: list[tuple[TableCell, ...]] = [
        ("Best linear twist in hover", *(f"{numbers[f'{name}_hover']:.1f}° per radius" for name in TWO)),
        (
            f"Best linear twist at µ {scope.speeds[-1]:g}",
            *(f"{numbers[f'{name}_fast']:.1f}° per radius" for name in TWO),
        ),
        *(
            (f"Best of the five twists at µ {mu:g}", *(f"{best_of_five(name, mu)}°" for name in TWO))
            for mu in SHOWN
        ),
        ("Moving one linear twist, against a fixed −16°", *(_saves(numbers[f"{name}_saving"]) for name in TWO)),
        (
            "of it beyond the best fixed linear blade",
            *(f"{_saves(numbers[f'{name}_beyond_fixed'])} ({numbers[f'{name}_fixed_deg']:.1f}°)" for name in TWO),
        ),
        ("Moving three segments, against a fixed −16°", *(_saves(numbers[f"{name}_three"]) for name in TWO)),
    ]  # fmt: skip
    spread = {
        name: max(main_rotor_kw(name, rate, 0.35) for rate in FIVE_RATES)
        / min(main_rotor_kw(name, rate, 0.35) for rate in FIVE_RATES)
        - 1
        for name in TWO
    }
    numbers |= {f"{name}_spread": value for name, value in spread.items()}
    return Report(
        number="Today",
        kind="claim",
        caption="The main results with the thesis' assumptions (one polar without Mach number, linear inflow, rigid "
        "blade, collective only) and with today's physics (section tables, lifting line, full trim, elastic blade). "
        "UH-60A, 8322.4 kg, sea level; speeds from hover to µ 0.35, equal time at each. Twist is jig twist, as built.",
        statement="Twist should fall from hover (−13.5°) to fast flight (−4°), so a blade that moves its twist saves "
        "induced power in every flight condition (abstract, §3.3).",
        ours=f"With today's physics the best twist goes from "
        f"{numbers['flight_hover']:.1f}° in hover to {numbers['flight_fast']:.1f}° at µ {scope.speeds[-1]:g}, and "
        f"moving it saves {_saves(numbers['flight_beyond_fixed'])} beyond the best fixed blade, "
        f"{numbers['flight_fixed_deg']:.1f}° ({_saves(numbers['thesis_beyond_fixed'])} with the thesis' assumptions). "
        f"Between the five fixed twists power differs by {100 * spread['flight']:.1f} % at µ 0.35 "
        f"({100 * spread['thesis']:.1f} %).",
        verdict=Agreement.ALONE,
        because="Drag rise on the advancing tip asks for twist at speed, which a polar of one Mach number cannot see; "
        "a wake that responds to loading lets twist act on induced power, which linear inflow cannot; the elastic "
        "blade adds nose-down twist by itself. The numbers of chapter 4 are not known, so nothing is compared.",
        tables=(table("then_and_now", ("", "as the thesis assumes", "with today's physics"), rows, shown=True),),
        panels=(
            PlotPanel(
                "linear twist [°/R]", "hover power above the least [%]", tuple(over), title="Hover",
                y_limits=(-0.3, 6.0),
            ),
            PlotPanel("advance ratio µ", "best linear twist [°/R]", tuple(twist), title="The best twist over speed"),
            PlotPanel("advance ratio µ", "saving against −16° [%]", tuple(saved), title="What moving it saves"),
            PlotPanel(
                "advance ratio µ", "saving [%]", tuple(beyond), title="Beyond the best fixed linear blade",
            ),
        ),
        numbers=numbers,
    )  # fmt: skip


def _total_kw(name: str, rate: float, mu: float) -> float:
    return solved(name, f"linear:{rate:.9g}", mu).require().power.total / 1e3


def _saves(part: float) -> str:
    return f"{100 * part:.1f} %"
