"""What the thesis would have found: the answers to its three questions, and from its assumptions to today's.

`today` is one page to show: the ladder of `rotor.reproduce.ladder` as a picture, the answers and what they rest on.
`literature` is what the thesis quotes from other works, and what this program gives."""

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from rotor.chart import Axis, Chart, Series
from rotor.design.active_twist import ActiveTwist, Harmonic
from rotor.files.make_design import make_design
from rotor.reproduce.actuation import BLADES, COMPARED, compared, fitted_blade, table_5_2
from rotor.reproduce.actuation import SPEEDS as ACTUATED
from rotor.reproduce.ladder import (
    FAST,
    FAST_KMH,
    HOVER,
    RUNGS,
    STRONG,
    WEAK,
    calls,
    climb,
)
from rotor.reproduce.optimum_twist import table_4_1
from rotor.reproduce.report import Agreement, Report, TableCell, curve, report, table
from rotor.reproduce.runs import CONCEPTS, Call, searches
from rotor.reproduce.twist_effect import keys_1987
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

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


def needed() -> list[Call]:
    """The searches, made once."""
    return [*(call for group in calls() for call in group), *searches(CONCEPTS), COMPARED]


def today() -> Report:
    """One picture, five sentences and their numbers."""
    ladder = climb()
    slow, middle, fast = SHOWN
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
    keys, tested = last.strong_over_weak, keys_1987().numbers
    concepts, actuators, pair = table_4_1().numbers, table_5_2().numbers, compared("flight").rows[0]
    others = [row.best[-1].rate_deg for row in ladder.inflows]

    def best(name: str) -> str:
        there = [ladder.at(name, mu).rate_deg for mu in SHOWN]
        return f"{there[0]:.1f}° in hover, {there[1]:.1f}° at µ {middle:g}, {there[2]:.1f}° at µ {fast:g}"

    def moves(mu: float) -> str:
        rows = {words: ladder.moves(name, mu) for name, words in MOVED.items()}
        ordered = sorted(rows.items(), key=lambda row: -abs(row[1].in_ladder))
        return ", ".join(f"{words} {ways.in_ladder:+.1f}°" for words, ways in ordered)

    rows = (
        (
            "How should twist change with speed?",
            f"It should weaken from hover, {ladder.at(last.name, slow).rate_deg:.1f}° per radius, to "
            f"{ladder.at(last.name, middle).rate_deg:.1f}° at µ {middle:g} and hardly change beyond: "
            f"{ladder.at(last.name, fast).rate_deg:.1f}° at µ {fast:g}, {min(others):.1f} to {max(others):.1f}° "
            f"over {len(gains)} inflow models, {ladder.without_drag_deg:.1f}° without fuselage drag. A blade that "
            "follows "
            f"saves {_saves(last.moving.gain)} beyond the best fixed one, {last.moving.fixed_deg:.1f}° "
            f"({100 * min(gains):.1f} to {_saves(max(gains))} over the models): the models differ by as much as it is "
            "worth. What uncertain inputs leave of it: python -m rotor schedule.",
        ),
        (
            "Which concept has advantages?",
            "None that can be told. Against one linear twist that moves, two segments save "
            f"{_saves(concepts['two'])} more, three {_saves(concepts['three'])}, a quadratic twist "
            f"{_saves(concepts['quadratic'])}: mean power over speed, each at its best at every speed. SC1094 R8 "
            "inboard "
            f"and SC1095 outboard save {_saves(concepts['airfoils'])} against the airfoils as built, with section drag "
            "uncertain by 10 %. Differences are known to a few tenths of a per cent. One good fixed twist in place of "
            f"−16° saves {_saves(concepts['flight_fixed'])}.",
        ),
        (
            "Which actuator?",
            f"None of {actuators['actuators']:.0f} on the blade as it is: between hover and µ {ACTUATED[1]:g} the "
            "best of "
            f"{actuators['rows']:.0f} pairs of actuator and concept, {pair[0].partition(',')[0]} with a {pair[1]} "
            "twist, "
            f"costs {-actuators['best_kw']:.0f} kW on balance. Macro fibre composite (MFC P1, 2 plies) reaches "
            f"{actuators['reach']:.1f}° of the {actuators['needed']:.1f}° wanted. The gain with unlimited twist, "
            f"{actuators['ideal_kw']:.0f} kW, is far below the cost of mass. No measured gain of a moving twist in "
            "flight is known to us.",
        ),
        (
            "The thesis says",
            "“the optimized solution is −13.5°” in hover; “after µ = 0.18 the linear twist distribution with −8° of "
            "slope becomes the solution that requires less power”; “a linear twist behaviour of −4° presents better "
            "results” in fast flight (p. 27, 28).",
        ),
        (
            "Its assumptions give",
            f"{best('thesis')}; a twist that moves saves {_saves(first.moving.gain)}.",
        ),
        *((f"What moves it at µ {mu:g}", f"One after another: {moves(mu)}.") for mu in ladder.named),
        (
            "Measured",
            f"Another rotor (Keys et al.), −17.3° over −11.5°: {100 * FAST:+.0f} % power at {FAST_KMH:.0f} km/h, "
            f"{100 * HOVER:+.1f} % in hover. Ours: {_signed(keys[1])} with the drag of the UH-60A, "
            f"{_signed(tested['usual_force'])} ({_signed(tested['usual_low'])} to {_signed(tested['usual_high'])}) at "
            f"the usual propulsive force of a tunnel test; {_signed(keys[0])} in hover.",
        ),
    )
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
        numbers={
            "thesis_hover": ladder.at("thesis", slow).rate_deg,
            "flight_hover": ladder.at(last.name, slow).rate_deg,
            "flight_fast": ladder.at(last.name, fast).rate_deg,
            "thesis_beyond_fixed": first.moving.gain,
            "flight_beyond_fixed": last.moving.gain,
        },
    )  # fmt: skip


def _saves(part: float) -> str:
    return f"{100 * part:.1f} %"


def _signed(part: float) -> str:
    return f"{100 * part:+.1f} %"


SPEED = 0.3
"""µ at which active twist is tried; the works that the thesis quotes flew other rotors at other speeds."""
PHASES = tuple(range(0, 360, 60))
"""[deg]"""


@lru_cache(maxsize=8)
def gain_of_2_per_rev(amplitude_deg: float, mu: float = SPEED) -> tuple[float, float, float]:
    """Part of main-rotor power that 2/rev of an amplitude saves at its best phase, that phase [deg], and the part by
    which the rotor's L/D, lift times speed over the power less that of its propulsive force, grows.

    Power over phase is nearly one cosine; its least is found by the cosine and sine of six phases, and solved there.
    """
    design = make_design(mu=mu, unsteady="on")  # With and without 2/rev alike.
    start = solve(design).require()

    def power(phase_deg: float) -> float:
        harmonic = Harmonic(2, math.radians(amplitude_deg), math.radians(phase_deg))
        driven = replace(design, active_twist=ActiveTwist((harmonic,)))
        return solve(driven, start=start).require().power.main_rotor

    angles = np.radians(PHASES)
    powers = np.array([power(phase) for phase in PHASES])
    best = math.degrees(math.atan2(-(powers * np.sin(angles)).sum(), -(powers * np.cos(angles)).sum())) % 360.0
    least, pulled = power(best), start.power.parasite
    return 1.0 - least / start.power.main_rotor, best, (start.power.main_rotor - pulled) / (least - pulled) - 1.0


@lru_cache(maxsize=1)
def mass_for_equal_power() -> float:
    """Part by which mass grows from −11.5° to −17.3° per radius at equal power in hover (flight preset)."""

    def power(rate: float, mass: float) -> float:
        return solve(make_design(twist=f"linear:{rate:g}", mu=0.0, mass_kg=mass)).require().power.main_rotor

    mass = make_design().condition.mass
    low, high = mass, 1.05 * mass
    # Power over mass is smooth: the secant through two masses leaves less than a thousandth of the difference.
    a, b = power(STRONG, low), power(STRONG, high)
    return (power(WEAK, mass) - a) / (b - a) * (high - low) / mass


FUSELAGE_WIDTH = 2.36
"""Width of the fuselage of the UH-60 [m]: 7 ft 9 in, specification by Army and manufacturer."""


@lru_cache(maxsize=1)
def download_of_twist() -> tuple[float, float]:
    """Part by which −17.3° presses more on the fuselage in hover than −11.5°, and the part of its gain that this takes.

    Download as drag of strips below the blades (Prouty, Helicopter Performance, Stability, and Control, ch. 4): the
    square of the induced velocity over that part of each annulus that lies above a fuselage of this width and as long
    as the disk, without contraction of the wake. Its size is the rotor file's; a difference of twist changes it.
    """

    def hover(rate: float, share: float = 1.0) -> Solution:
        design = make_design(twist=f"linear:{rate:g}", mu=0.0)
        download = share * design.fuselage.hover_download
        return solve(replace(design, fuselage=replace(design.fuselage, hover_download=download))).require()

    def pressed(solution: Solution) -> float:
        r, half = solution.disk.r, 0.5 * FUSELAGE_WIDTH / solution.design.rotor.radius
        return float((solution.disk.dr * r * np.arcsin(np.minimum(half / r, 1.0))) @ solution.disk.induced[:, 0] ** 2)

    weak, strong = hover(WEAK), hover(STRONG)
    share = pressed(strong) / pressed(weak)
    loaded = hover(STRONG, share).power.main_rotor - strong.power.main_rotor
    return share - 1.0, loaded / (weak.power.main_rotor - strong.power.main_rotor)


SHEAR = {"d15_m_per_v": 741e-12, "field_v_per_m": 5e5, "radius_m": 0.02, "wall_m": 2e-3, "shear_modulus_pa": 2.3e10}
"""A tube of PZT-5H segments poled along its axis, as thick as the blade leaves room for; d15 from makers' sheets, field
below the coercive one."""


def shear_tube() -> tuple[float, float]:
    """Twist [°] of such a tube from root to tip, free and in parallel with the blade's torsional stiffness.

    γ = d15 E turns a tube by γ l/R (Glazounov, Zhang and Kim, Appl. Phys. Lett. 72, 1998); G 2πR³t beside the blade.
    """
    blade, radius = make_design().rotor.blade, make_design().rotor.radius
    assert blade.structure is not None
    median = float(np.median(blade.structure.torsional_stiffness))
    free = SHEAR["d15_m_per_v"] * SHEAR["field_v_per_m"] * (1.0 - blade.root_cutout) * radius / SHEAR["radius_m"]
    stiffness = SHEAR["shear_modulus_pa"] * 2.0 * math.pi * SHEAR["radius_m"] ** 3 * SHEAR["wall_m"]
    return math.degrees(free), math.degrees(free * stiffness / (stiffness + median))


def literature() -> Report:
    """The quoted numbers beside ours."""
    attained = {name: math.degrees(fitted_blade(*BLADES[name]).attainable) / 2.0 for name in BLADES}
    small, phase_small, _ = gain_of_2_per_rev(1.5)
    middle, *_ = gain_of_2_per_rev(2.5)
    large, phase_large, lift_over_drag = gain_of_2_per_rev(4.0)
    heavier_load, of_gain = download_of_twist()
    free, held = shear_tube()
    mass = make_design().condition.mass
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
            "3.3 % less power, L/D +7.3 %",
            f"{100 * large:.1f} % less, L/D {100 * lift_over_drag:+.1f} %",
            f"2/rev of 4° at µ {SPEED:g}, best phase {phase_large:.0f}°, flight preset",
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
            f"{100 * heavier_load:+.1f} %; takes {100 * of_gain:.0f} % of the gain",
            f"induced velocity squared over a fuselage {FUSELAGE_WIDTH:g} m wide; in the trims of this program "
            "download "
            "is a fixed part of thrust, so our gain of twist in hover is too large by that",
        ),
        (
            "Shear-mode plies and circular, rotary actuators (p. 3)",
            "provide rotation and torque",
            f"{free:.1f}° free, {held:.2f}° in the blade",
            "tube of 20 mm radius of PZT-5H segments in shear, root to tip, beside the torsional stiffness of the "
            "blade",
        ),
    )
    return report(
        "literature",
        Agreement.INDICATIVE,
        tables=[table("quoted_and_ours", ("source", "quoted", "ours", "how ours is made"), rows, shown=True)],
        mu=SPEED,
        small=small,
        middle=middle,
        large=large,
        low=lo,
        high=hi,
    )
