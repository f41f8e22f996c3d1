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
from rotor.reproduce.ladder import (
    RUNGS,
    STRONG,
    WEAK,
    calls,
    climb,
)
from rotor.reproduce.optimum_twist import table_4_1
from rotor.reproduce.report import Agreement, Report, curve, filled_rows, report, table
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
    attained = [math.degrees(fitted_blade(*BLADES[name]).attainable) / 2.0 for name in BLADES]
    small, phase_small, _ = gain_of_2_per_rev(1.5)
    middle, *_ = gain_of_2_per_rev(2.5)
    large, phase_large, lift_over_drag = gain_of_2_per_rev(4.0)
    download, of_gain = download_of_twist()
    free, held = shear_tube()
    heavier = mass_for_equal_power()
    values = {
        "mu": SPEED,
        "small": small,
        "middle": middle,
        "large": large,
        "low": min(attained),
        "high": max(attained),
    }
    rows = filled_rows(
        "literature", **values, phase_small=phase_small, phase_large=phase_large, lift_over_drag=lift_over_drag,
        heavier=heavier, heavier_kg=heavier * make_design().condition.mass, download=download, of_gain=of_gain,
        width=FUSELAGE_WIDTH, free=free, held=held,
    )  # fmt: skip
    quoted = table("quoted_and_ours", ("source", "quoted", "ours", "how ours is made"), rows, shown=True)
    return report("literature", Agreement.INDICATIVE, tables=[quoted], numbers=values)
