"""What the thesis would have found: its main statement, its own assumptions, today's, and what was measured.

`today` is one page to show: the ladder of `rotor.reproduce.ladder` as a picture, and five sentences. `literature` is
what the thesis quotes from other works, and what this program gives."""

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from rotor.aero.inflow import INFLOW_MODELS
from rotor.chart import Axis, Chart, Series
from rotor.design.active_twist import ActiveTwist, Harmonic
from rotor.files.make_design import make_design
from rotor.reproduce.actuation import BLADES, fitted_blade
from rotor.reproduce.ladder import (
    FAST,
    FAST_KMH,
    HOVER,
    RUNGS,
    STRONG,
    TRIM,
    WEAK,
    calls,
    climb,
    strong_over_weak,
)
from rotor.reproduce.report import Agreement, Report, TableCell, curve, table
from rotor.reproduce.runs import Call
from rotor.trim.solve import solve

SHOWN = (0.0, 0.2, 0.35)
"""µ in the picture: hover, near least power, fast."""
SOURCES = (
    "M. Lonoce, Helicopter Blade Twist Optimization in Forward Flight, MSc thesis, IST Lisbon 2016. "
    "Keys et al. 1987: its reference 42, as it quotes it. All other numbers: python -m rotor ladder."
)


def needed() -> list[Call]:
    """The searches, made once."""
    return [call for group in calls() for call in group]


def today() -> Report:
    """One picture, five sentences and their numbers."""
    found = climb()
    slow, middle, fast = SHOWN
    first, last = (found.step(name) for name in ("thesis", tuple(RUNGS)[-1]))
    before_trim = found.steps[[one.name for one in found.steps].index(TRIM[0]) - 1]
    places = range(len(found.steps))
    curves: list[Series] = []
    for k, mu in enumerate(SHOWN):
        row = [found.at(one.name, mu) for one in found.steps]
        low, high = zip(*(one.band_deg for one in row), strict=True)
        curves += [
            curve("", places, low, "band", upper=high, colour=k),
            curve("hover" if mu == 0.0 else f"µ {mu:g}", [one.rate_deg for one in row], places, "both", colour=k),
        ]
    gains = [one.moving.gain for one in found.wakes]
    others = [
        strong_over_weak(on, FAST_KMH, wake)
        for on in (tuple(RUNGS), tuple(RUNGS)[:-1])
        for wake in INFLOW_MODELS
    ]  # fmt: skip
    keys = {one.name: one.strong_over_weak for one in (first, before_trim, found.trim, last)}

    def best(name: str) -> str:
        there = [found.at(name, mu).rate_deg for mu in SHOWN]
        return f"{there[0]:.1f}° in hover, {there[1]:.1f}° at µ {middle:g}, {there[2]:.1f}° at µ {fast:g}"

    def moves(name: str) -> str:
        ends = [f"{value:+.1f}" for value in found.moves(name)]
        return f"{ends[0]}°" if ends[0] == ends[1] else f"{ends[0]} to {ends[1]}°"

    rows = (
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
        (
            "One change decides",
            f"Trim by cyclic with µ sin α in U_P: {moves('trim')} at µ {fast:g}. Air comes through the tilted disk; "
            f"without the drag that tilts it, the best today is {found.without_drag_deg:.1f}°. Drag rise: "
            f"{moves('mach')}; lifting line: {moves('wake')}; eight blades for four: {found.eight_blades_deg:+.1f}°.",
        ),
        (
            "A moving twist saves today",
            f"{_saves(last.moving.gain)} beyond the best fixed one, {last.moving.fixed_deg:.1f}°; "
            f"{100 * min(gains):.1f} to {_saves(max(gains))} over {len(gains)} inflow models.",
        ),
        (
            "Measured",
            f"Another rotor (Keys et al.), −17.3° over −11.5°: {100 * FAST:+.0f} % power at {FAST_KMH:.0f} km/h, "
            f"{100 * HOVER:+.1f} % in hover. Ours differs: {_signed(keys[last.name][1])} ({100 * min(others):+.1f} to "
            f"{_signed(max(others))} over models) and {_signed(keys[last.name][0])}. The change of trim leads away "
            f"from it, {_signed(keys[before_trim.name][1])} to {_signed(keys['trim'][1])}. No measured gain of a "
            "moving twist is known to us.",
        ),
    )
    return Report(
        number="Today",
        kind="claim",
        caption="Best linear twist, as the assumptions of the thesis are changed one after another to today's. "
        "UH-60A, 8322.4 kg, sea level; degrees per radius, as built; shaded: within 0.1 % of the power.",
        statement="Twist should fall from hover to fast flight (§3.3), and a blade that moves it saves power.",
        ours=f"The best twist falls from {found.at(last.name, slow).rate_deg:.1f}° in hover to "
        f"{found.at(last.name, fast).rate_deg:.1f}° at µ {fast:g}, but one that moves saves only "
        f"{_saves(last.moving.gain)} beyond the best fixed blade ({_saves(first.moving.gain)} with the thesis' "
        "assumptions).",
        verdict=Agreement.NO_REFERENCE,
        because=SOURCES,
        tables=(
            table("answer", ("", ""), rows, shown=True),
            table(
                "ladder",
                ("change", *(f"mu_{mu:g}" for mu in found.speeds), "moves", "alone on thesis", "alone off flight",
                 "moving saves [%]", "−17.3/−11.5 [%]"),
                [
                    (one.words, *(x.rate_deg for x in one.best),
                     *("" if x is None else x
                       for x in (one.moves_deg, one.alone_on_thesis_deg, one.alone_off_flight_deg)),
                     100 * one.moving.gain, 100 * one.strong_over_weak[1])
                    for one in (*found.steps, found.trim)
                ],
            ),
        ),
        panels=(
            Chart(
                "", Axis("best linear twist [°/R]"), Axis(names=tuple(one.words for one in found.steps)),
                tuple(curves),
            ),
        ),
        numbers={
            "thesis_hover": found.at("thesis", slow).rate_deg,
            "flight_fast": found.at(last.name, fast).rate_deg,
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

    def power(rate: float, mass: float) -> float:
        return solve(make_design(twist=f"linear:{rate:g}", mu=0.0, mass_kg=mass)).require().power.main_rotor

    mass = make_design().condition.mass
    low, high = mass, 1.05 * mass
    # Power over mass is smooth: the secant through two masses leaves less than a thousandth of the difference.
    a, b = power(STRONG, low), power(STRONG, high)
    return (power(WEAK, mass) - a) / (b - a) * (high - low) / mass


def literature() -> Report:
    """The quoted numbers beside ours."""
    attained = {name: math.degrees(fitted_blade(*BLADES[name]).attainable) / 2.0 for name in BLADES}
    small, phase_small = gain_of_2_per_rev(1.5)
    middle, _ = gain_of_2_per_rev(2.5)
    large, phase_large = gain_of_2_per_rev(4.0)
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
            "3.3 % less power",
            f"{100 * large:.1f} % less",
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
        statement="Active twist reaches 0.5° of 2° wanted; 1–2 % less power measured, 3.3 % computed with 4° (p. 3).",
        ours=f"2/rev at µ {SPEED:g}: {100 * small:.1f} % less power with 1.5°, {100 * large:.1f} % with 4°. Twist "
        f"within reach ±{lo:.1f}…±{hi:.1f}°.",
        verdict=Agreement.INDICATIVE,
        because=f"Ours is a steady section model on a torsionally elastic blade, where the gain does not grow with "
        f"amplitude throughout: {100 * small:.1f} % at 1.5°, {100 * middle:.1f} % at 2.5°, {100 * large:.1f} % at 4°.",
        tables=(table("quoted_and_ours", ("source", "quoted", "ours", "how ours is made"), rows, shown=True),),
    )
