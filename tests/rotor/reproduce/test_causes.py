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


def moves(*names: str) -> set[float]:
    """The move of the best twist at µ 0.35 in the ladder, alone on thesis and alone off flight, to a tenth."""
    end = ALL.index(names[-1]) + 1
    ways = (
        best(ALL[:end]) - best(ALL[: end - len(names)]), best(names) - best(()), best(ALL) - best(without(*names)),
    )  # fmt: skip
    return {round(way, 1) for way in ways if abs(way) > 1e-6}


def ends(*names: str) -> tuple[float, float]:
    return min(moves(*names)), max(moves(*names))


def gain(on: tuple[str, ...], inflow: str | None = None) -> float:
    return round(100.0 * moving_twist(on, FLOWN, inflow).gain, 1)


CAUSES: tuple[tuple[str, str, Callable[[], bool]], ...] = (
    (
        "README.md",
        "Its own assumptions give −15.6° per radius in hover, −2.8° at µ 0.2, −2.2° at 0.35",
        lambda: [round(best((), mu), 1) for mu in (0.0, 0.2, FAST)] == [-15.6, -2.8, -2.2],
    ),
    (
        "README.md",
        "µ sin α in U_P moves the best twist at µ 0.35 by −7.2 to −9.9°",
        lambda: ends(*TRIM) == (-9.9, -7.2),
    ),
    ("README.md", "drag rise moves it by −0.1 to −1.2°", lambda: ends("mach") == (-1.2, -0.1)),
    (
        "README.md",
        "eight blades for four by +0.9°",
        lambda: round(twice_the_blades(FAST).rate_deg - best(without("elastic")), 1) == 0.9,
    ),
    (
        "README.md",
        "Today the best is −16.5, −11.2 and −11.5°",
        lambda: [round(best(ALL, mu), 1) for mu in (0.0, 0.2, FAST)] == [-16.5, -11.2, -11.5],
    ),
    (
        "README.md",
        "saves 0.1 % beyond the best fixed one, 0.1 to 0.3 % over the inflow models (0.6 % with",
        lambda: (gain(ALL), gain(ALL, "uniform"), gain(ALL, "local-momentum"), gain(())) == (0.1, 0.1, 0.3, 0.6),
    ),
    (
        "README.md",
        "−0.2 and −0.5 %, and the change of trim is what turns it",
        lambda: [round(100 * strong_over_weak(ALL, kmh, None), 1) for kmh in (FAST_KMH, 0.0)] == [-0.2, -0.5]
        and strong_over_weak(ALL[:3], FAST_KMH, None) > 0.03 > 0.0 > strong_over_weak(ALL[:5], FAST_KMH, None),
    ),
    (
        "docs/theory.md",
        "together they move it by −7.2 to −9.9° at $\\mu$ = 0.35",
        lambda: ends(*TRIM) == (-9.9, -7.2),
    ),
    (
        "docs/theory.md",
        "The lifting line moves it by +0.8 to −2.7°, the section table by −1.8 to +1.8°, drag "
        "rise by −0.1 to −1.2°, the elastic blade by +1.7°",
        lambda: (ends("wake"), ends("table"), ends("mach"), ends("elastic"))
        == ((-2.7, 0.8), (-1.8, 1.8), (-1.2, -0.1), (1.7, 1.7)),
    ),
    (
        "docs/tutorials/drag.md",
        "switch *Fuselage drag* off in *Model* at µ 0.35: the best twist goes from −11.5° to −7.0°",
        lambda: (round(best(ALL), 1), round(without_drag(FAST).rate_deg, 1)) == (-11.5, -7.0),
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
        lambda: [round(value) for value in ends(*TRIM)] == [-10, -7]
        and max(abs(value) for value in moves("mach")) < 1.5
        and abs(twice_the_blades(FAST).rate_deg - best(without("elastic"))) < 1.5,
    ),
)  # fmt: skip
"""File, the words that name a cause or its size, and what they say, computed."""


@pytest.mark.parametrize(("file", "words", "holds"), CAUSES, ids=[words for _, words, _ in CAUSES])
def test_a_sentence_that_names_a_cause_is_true(file: str, words: str, holds: Callable[[], bool]):
    text = " ".join((ROOT / file).read_text(encoding="utf-8").split())
    assert words in text, f"{file} no longer says so: change the list with the sentence"
    assert holds()
