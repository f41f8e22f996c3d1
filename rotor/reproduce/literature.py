"""Numbers of other works that the thesis quotes in §1.2 and §3.3, each beside what this program gives."""

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from rotor.design.active_twist import ActiveTwist, Harmonic
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.reproduce.actuation import BLADES, fitted_blade
from rotor.reproduce.report import Agreement, Report, TableCell, table
from rotor.reproduce.twist_effect import STRONG, WEAK
from rotor.trim.solve import solve

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
