"""What the thesis would have found: its main results with its own assumptions and with today's best physics.

Both halves are this program: the `thesis` preset is the document as printed, the `flight` preset has real sections,
drag rise, a wake that responds to loading, trim by cyclic and a blade that twists under load.

Beside it what the thesis quotes from other works, and what this program gives."""

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from rotor.design.active_twist import ActiveTwist, Harmonic
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.reproduce.actuation import BLADES, fitted_blade
from rotor.reproduce.report import Agreement, Curve, PlotPanel, Report, TableCell, curve, table
from rotor.reproduce.runs import FIVE_RATES, FULL, Call, Scope, best, best_fixed, main_rotor_kw, searches, solved
from rotor.reproduce.twist_effect import STRONG, WEAK, best_of_five
from rotor.trim.solve import solve

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


SPEED = 0.3
"""µ at which active twist is tried; the works that the thesis quotes flew other rotors at other speeds."""
PHASES = tuple(range(0, 360, 60))
"""[deg]"""


@lru_cache(maxsize=8)
def gain_of_2_per_rev(amplitude_deg: float, mu: float = SPEED) -> tuple[float, float]:
    """Part of main-rotor power that 2/rev of an amplitude saves at its best phase, and that phase [deg].

    Power over phase is nearly one cosine; its least is found by the cosine and sine of six phases, and solved there.
    """
    design = make_design(mu=mu)
    start = solve(design).require()

    def power(phase_deg: float) -> float:
        harmonic = Harmonic(2, math.radians(amplitude_deg), math.radians(phase_deg))
        driven = replace(design, active_twist=ActiveTwist((harmonic,)))
        return solve(driven, start=start).require().power.main_rotor

    angles = np.radians(PHASES)
    powers = np.array([power(phase) for phase in PHASES])
    best = math.degrees(math.atan2(-(powers * np.sin(angles)).sum(), -(powers * np.cos(angles)).sum())) % 360.0
    return 1.0 - power(best) / start.power.main_rotor, best


@lru_cache(maxsize=1)
def mass_for_equal_power() -> float:
    """Part by which mass grows from −11.5° to −17.3° per radius at equal power in hover (flight preset)."""
    mass = make_design().condition.mass
    wanted = _hover(WEAK, mass)
    low, high = mass, 1.05 * mass
    # Power over mass is smooth: the secant through two masses leaves less than a thousandth of the difference.
    a, b = _hover(STRONG, low), _hover(STRONG, high)
    return (wanted - a) / (b - a) * (high - low) / mass


def _hover(rate: float, mass: float) -> float:
    design: Design = make_design(twist=f"linear:{rate:g}", mu=0.0, mass_kg=mass)
    return solve(design).require().power.main_rotor


def literature() -> Report:
    """The quoted numbers beside ours."""
    attained = {name: math.degrees(fitted_blade(*BLADES[name]).attainable) / 2.0 for name in BLADES}
    small, phase_small = gain_of_2_per_rev(1.5)
    middle, _ = gain_of_2_per_rev(2.5)
    large, phase_large = gain_of_2_per_rev(4.0)
    mass = make_design().condition.mass
    hover = _hover(STRONG, mass) / _hover(WEAK, mass) - 1.0
    heavier = mass_for_equal_power()
    lo, hi = (f(attained.values()) for f in (min, max))
    rows: tuple[tuple[TableCell, ...], ...] = (
        (
            "Chen and Chopra, 1990s: twist of a model blade with embedded plies (p. 3)",
            "±0.5°; wanted ±2°",
            f"±{lo:.1f}° (flown blade, 1 ply) to ±{hi:.1f}° (new blade)",
            "macro fibre composite on a full-scale blade, half its voltage range",
        ),
        (
            "Cheng and Celi, Sikorsky: higher-harmonic twist in the wind tunnel (p. 3)",
            "1…2 % less power",
            f"{100 * small:.1f} % less",
            f"2/rev of 1.5° at µ {SPEED:g}, best phase {phase_small:.0f}°, flight preset",
        ),
        (
            "Chopra: UH-60A, fluid and structure coupled, 4° (p. 3)",
            "3.3 % less power",
            f"{100 * large:.1f} % less",
            f"2/rev of 4° at µ {SPEED:g}, best phase {phase_large:.0f}°, flight preset",
        ),
        (
            "Keys et al. 1987: −17.3° for −11.5°, hover (p. 26)",
            "2.4 % less power",
            f"{-100 * hover:.1f} % less",
            "UH-60A, flight preset, degrees per radius",
        ),
        (
            "Keys et al.: useful load at equal power (p. 26)",
            "+5 % of useful load",
            f"+{100 * heavier:.1f} % of mass, {heavier * mass:.0f} kg",
            "the thesis gives no useful load; ours is a part of the whole mass",
        ),
        (
            "Keys et al.: download on the fuselage (p. 26)",
            "+6 %; takes 15 % of the gain",
            "not computed",
            "download is a fixed part of thrust here, the same for every twist, so our gain in hover is too large by "
            "about that",
        ),
    )
    return Report(
        number="Literature",
        kind="claim",
        caption="Numbers of other works that the thesis quotes, beside ours. They are other rotors, other actuators "
        "and other speeds: only sign and size can be compared.",
        statement="Active twist reaches 0.5° of 2° wanted; 1–2 % less power measured, 3.3 % computed with 4°; strong "
        "twist saves 2.4 % in hover (p. 3, 26).",
        ours=f"2/rev at µ {SPEED:g}: {100 * small:.1f} % less power with 1.5°, {100 * large:.1f} % with 4°. Twist "
        f"within reach ±{lo:.1f}…±{hi:.1f}°. Strong twist in hover {-100 * hover:.1f} % less.",
        verdict=Agreement.INDICATIVE,
        because=f"Ours is a steady section model on a torsionally elastic blade, where the gain does not grow with "
        f"amplitude throughout: {100 * small:.1f} % at 1.5°, {100 * middle:.1f} % at 2.5°, {100 * large:.1f} % at 4°.",
        tables=(table("quoted_and_ours", ("source", "quoted", "ours", "how ours is made"), rows, shown=True),),
        numbers={
            "gain_1_5": small,
            "gain_2_5": middle,
            "gain_4": large,
            "hover": hover,
            "heavier": heavier,
            "least_twist_deg": lo,
            "largest_twist_deg": hi,
        },
    )
