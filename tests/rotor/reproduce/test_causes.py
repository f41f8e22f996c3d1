"""Sentences that name a cause, in the page of a lecture, the README and the documentation, and the switch behind each.

A sentence is found in its file, and what it says is computed here: with the cause switched off, the effect is gone or
as large as the sentence says. Most of those of the lecture's steps are in `tests/explorer/test_lecture.py`.
"""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rotor
from rotor.aero.inflow import INFLOW_MODELS
from rotor.reproduce.ladder import (
    FAST_KMH,
    RUNGS,
    TRIM,
    least,
    moving_twist,
    strong_over_weak,
    twice_the_blades,
    without_drag,
)
from rotor.reproduce.ladder import SPEEDS as FLOWN
from rotor.reproduce.twist_effect import keys_1987

ROOT = Path(__file__).parents[3]
ALL = tuple(RUNGS)
FAST = 0.35


@cache
def total(twist: str, mu: float, **changed: Any) -> rotor.PowerBudget:
    return rotor.solve(rotor.make_design(twist=twist, mu=mu, **changed)).require().power


def best(on: tuple[str, ...], mu: float = FAST) -> float:
    return least(on, mu, None).rate_deg


def without(*names: str) -> tuple[str, ...]:
    return tuple(name for name in ALL if name not in names)


def moves(*names: str, mu: float = FAST) -> set[float]:
    """The move of the best twist in the ladder, alone on thesis and alone off flight, to a tenth."""
    end = ALL.index(names[-1]) + 1
    ways = (
        best(ALL[:end], mu) - best(ALL[: end - len(names)], mu),
        best(names, mu) - best((), mu),
        best(ALL, mu) - best(without(*names), mu),
    )
    return {round(way, 1) for way in ways if abs(way) > 1e-6}


def ends(*names: str, mu: float = FAST) -> tuple[float, float]:
    return min(moves(*names, mu=mu)), max(moves(*names, mu=mu))


def gain(on: tuple[str, ...], inflow: str | None = None) -> float:
    return round(100.0 * moving_twist(on, FLOWN, inflow).gain, 1)


def retreating_angle() -> tuple[float, float, float]:
    """r/R of the largest angle of attack at ψ = 270° and µ 0.35, that angle, and the tip's [°]."""
    disk = rotor.solve(rotor.make_design(mu=FAST)).disk
    angle, own = np.degrees(disk.alpha[:, np.abs(disk.psi - 1.5 * np.pi).argmin()]), disk.r > 0.5
    largest, tip = angle[own].max(), disk.r > 0.99
    return (
        round(disk.r[angle == largest][0], 1),
        round(largest, 1),
        round(np.average(angle[tip], weights=disk.dr[tip]), 0),
    )


CAUSES: tuple[tuple[str, str, Callable[[], bool]], ...] = (
    (
        "docs/notebooks/09_three_questions.py",
        "read as most of its statements hold, give −16.6, −8.5 and −3.8°",
        lambda: [round(best((), mu), 1) for mu in (0.0, 0.2, FAST)] == [-16.6, -8.5, -3.8],
    ),
    (
        "docs/notebooks/09_three_questions.py",
        "moves that most: −7.0 to −8.1° at µ 0.35, −2.1 to −2.8° at 0.2, where drag rise, torsion and section data "
        "move it as far",
        lambda: (ends(*TRIM), ends(*TRIM, mu=0.2)) == ((-8.1, -7.0), (-2.8, -2.1))
        and all(max(abs(way) for way in moves(name, mu=0.2)) > 1.5 for name in ("mach", "elastic", "table")),
    ),
    (
        "docs/notebooks/09_three_questions.py",
        "The best linear twist is −16.5° per radius in hover, −11.2° at µ 0.2 and −11.5° at 0.35 (−9.7 to −12.4° over",
        lambda: [round(best(ALL, mu), 1) for mu in (0.0, 0.2, FAST)] == [-16.5, -11.2, -11.5]
        and {round(f(least(ALL, FAST, name).rate_deg for name in INFLOW_MODELS), 1) for f in (min, max)}
        == {-12.4, -9.7},
    ),
    (
        "docs/notebooks/09_three_questions.py",
        "saves 0.1 % beyond the best fixed one, 0.1 to 0.3 % over the inflow models",
        lambda: (gain(ALL), gain(ALL, "uniform"), gain(ALL, "local-momentum")) == (0.1, 0.1, 0.3),
    ),
    (
        "docs/notebooks/09_three_questions.py",
        "Ours gives −0.2 % with the drag of the UH-60A and +3.2 % (3.1 to 5.7 over models) at the usual propulsive "
        "force of a tunnel test; −0.5 % in hover",
        lambda: [round(100 * strong_over_weak(ALL, kmh), 1) for kmh in (FAST_KMH, 0.0)] == [-0.2, -0.5]
        and [round(100 * keys_1987().numbers[f"usual_{end}"], 1) for end in ("force", "low", "high")]
        == [3.2, 3.1, 5.7],
    ),
    (
        "docs/theory.md",
        "together they move it by −7.0 to −8.1° at $\\mu$ = 0.35, by −2.1 to −2.8° at 0.2",
        lambda: (ends(*TRIM), ends(*TRIM, mu=0.2)) == ((-8.1, -7.0), (-2.8, -2.1)),
    ),
    (
        "docs/theory.md",
        "At 0.35 the lifting line moves it by −0.8 to −1.9°, the section table by +0.1 to +2.6°, drag rise by −0.1 to "
        "−1.4°, the elastic blade by +1.7°",
        lambda: (ends("wake"), ends("table"), ends("mach"), ends("elastic"))
        == ((-1.9, -0.8), (0.1, 2.6), (-1.4, -0.1), (1.7, 1.7)),
    ),
    (
        "docs/tutorials/drag.md",
        "switch *Fuselage drag* off in *Model* at µ 0.35: the best twist goes from −11.5° to −6.8°",
        lambda: (round(best(ALL), 1), round(without_drag(FAST).rate_deg, 1)) == (-11.5, -6.8),
    ),
    (
        "docs/tutorials/drag.md",
        "Without drag rise (*Compressibility*) it stays within 0.2°",
        lambda: abs(best(ALL) - best(without("mach"))) < 0.2,
    ),
    (
        "docs/tutorials/drag.md",
        "In hover, twist makes the inflow more uniform, which by momentum theory takes the least",
        lambda: total("linear:-16", 0.0).induced < 0.95 * total("linear:0", 0.0).induced,
    ),
    (
        "docs/tutorials/actuator.md",
        "−16.5° and −11.5° per radius at µ 0.35",
        lambda: (round(best(ALL, 0.0), 1), round(best(ALL), 1)) == (-16.5, -11.5),
    ),
    (
        "docs/tutorials/disk.md",
        "the angle of attack is largest, 11.6°, at 0.6 R and falls to 2° at the tip",
        lambda: retreating_angle() == (0.6, 11.6, 2.0),
    ),
    (
        "docs/notebooks/05_inflow_models.py",
        "and so in the best twist, by some degrees",
        lambda: 2.0 < np.ptp([least(ALL, 0.2, name).rate_deg for name in ("local-momentum", "lifting-line")]) < 5.0,
    ),
    (
        "explorer/story/text/hover_twist.md",
        "A blade rigid in torsion would need {best_rigid}: airloads add the rest",
        lambda: best(without("elastic"), 0.0) < best(ALL, 0.0) - 1.0,
    ),
    (
        "explorer/story/text/fast_twist.md",
        "The trim decides. Cyclic pitch and the air that comes through the tilted disk move the best twist",
        lambda: [round(value) for value in ends(*TRIM)] == [-8, -7]
        and max(abs(value) for value in moves("mach")) < 1.5
        and abs(twice_the_blades(FAST).rate_deg - best(without("elastic"))) < 1.5,
    ),
)  # fmt: skip
"""File, the words that name a cause or its size, and what they say, computed."""


@pytest.mark.slow
@pytest.mark.parametrize(("file", "words", "holds"), CAUSES, ids=[words for _, words, _ in CAUSES])
def test_a_sentence_that_names_a_cause_is_true(file: str, words: str, holds: Callable[[], bool]):
    lines = (ROOT / file).read_text(encoding="utf-8").splitlines()
    text = " ".join(" ".join(line.removeprefix("# ") for line in lines).split())
    assert words in text, f"{file} no longer says so: change the list with the sentence"
    assert holds()
