"""The sentence that says why power changed, on cases whose cause is known."""

import re
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.model.units import AVIATION
from explorer.text.why import lift_centroid, why
from rotor import Design, Solution, make_design, solve
from rotor.aero.switches import with_switches


@cache
def solved(design: Design) -> Solution:
    return solve(design)


def flown(
    mu: float = 0.2, twist: str | None = None, mass: float | None = None, altitude: float = 0.0,
    inflow: str | None = None,
) -> Solution:  # fmt: skip
    return solved(make_design(mu=mu, twist=twist, mass_kg=mass, altitude_m=altitude, inflow=inflow))


def lifting(solution: Solution, dct: np.ndarray) -> Solution:
    disk = replace(solution.disk, dct=np.broadcast_to(dct, solution.disk.dct.shape))
    return replace(solution, find_shown=lambda _: replace(solution.shown, disk=disk))


class TestWhereTheLiftIs:
    def test_the_centroid_of_known_loadings(self):
        solution = flown(inflow="drees")
        middle = 0.5 * (solution.design.rotor.blade.root_cutout + 1.0)
        assert lift_centroid(lifting(solution, np.ones(()))) == pytest.approx(
            (middle, 0.0), abs=1e-12
        )
        swayed = lift_centroid(lifting(solution, 1.0 + np.sin(solution.disk.psi)))
        assert swayed == pytest.approx((middle, 0.5), abs=1e-12)
        still = lifting(
            replace(solution, design=solution.design.with_twist("linear:-3")), np.zeros(())
        )
        assert lift_centroid(still) is None
        assert why(solution, still).startswith("A new twist: ")


def test_another_test_or_flight_is_named():
    stands: list[dict[str, Any]] = [
        {"ct_over_sigma": load, "shaft_tilt_deg": 0.0} for load in (0.07, 0.08)
    ]
    first, second = (solved(make_design(mu=0.2, trim="wind-tunnel", stand=one)) for one in stands)
    assert why(flown(), first).startswith("The rotor alone, on a test stand: ")
    assert why(first, flown()).startswith("Flight instead of a test: ")
    assert why(first, second).startswith("Another test: ")
    climbing = solved(make_design(mu=0.2, climb_m_s=4.0))
    slower = solved(make_design(mu=0.2, rotor_speed_percent=95.0))
    assert why(flown(), climbing).startswith("Climb 4.0 m/s: climb +")
    assert why(climbing, flown()).startswith("Level flight: climb −")
    assert why(flown(), slower).startswith("Rotor speed 95.0 %: profile −")
    moved = solved(make_design(mu=0.2, twist_per_rev="3:0.75:60"))
    assert why(flown(), moved).startswith("Active twist at 3/rev: ")
    assert why(moved, flown()).startswith("No n/rev active twist: ")


UNTWISTED, TWISTED = {"mu": 0.0, "twist": "linear:0"}, {"mu": 0.0, "twist": "linear:-8"}
SLOW: dict[str, Any] = {"mu": 0.2}
FAST: dict[str, Any] = {"mu": 0.3}
HEAVY, LIGHT = {"mass": 9000.0}, {"mass": 8000.0}


@pytest.mark.parametrize(
    ("before", "after", "said"),
    [
        (UNTWISTED, TWISTED, r"^Lift moved inboard: induced −\d+, tail rotor −"),
        (TWISTED, UNTWISTED, r"^Lift moved outboard: induced \+"),
        # Beyond the optimum twist costs induced power, although the lift moves inboard.
        (
            {"mu": 0.0, "twist": "linear:-20"},
            {"mu": 0.0, "twist": "linear:-28"},
            r"^Lift moved inboard: induced \+",
        ),
        (
            {"mu": 0.35, "twist": "segments:-17.4,-4@0.5"},
            {"mu": 0.35, "twist": "segments:-17.4,-16.6@0.5"},
            r"^Lift moved inboard and towards the advancing side: induced −.*drag divergence shrank",
        ),
        (
            LIGHT,
            HEAVY,
            r"^12 % more weight: induced \+.*; separation appeared inboard on the retreating side",
        ),
        (HEAVY, LIGHT, r"^11 % less weight: induced −"),
        (SLOW, FAST, r"^Faster \(µ 0\.3\): parasite \+"),
        ({"mu": 0.1}, {"mu": 0.15}, r"^Faster \(µ 0\.15\): induced −"),
        ({"mu": 0.1}, {"mu": 0.0}, r"^Hover: induced \+"),
        (SLOW, FAST, "drag divergence appeared near the tip on the advancing side"),
        ({"mu": 0.25}, FAST, "drag divergence grew near the tip on the advancing side"),
        (FAST, {"mu": 0.25}, "drag divergence shrank"),
        (
            {"mu": 0.3, "mass": 9.8e3},
            {"mu": 0.42, "mass": 9.8e3},
            "separation grew .*on the retreating side",
        ),
        (
            {"mu": 0.0, **HEAVY},
            {"mu": 0.15, **HEAVY},
            "separation appeared inboard on the retreating side",
        ),
        (SLOW, {"altitude": 2000.0}, r"^Thinner air \(−18 %\): induced \+.*parasite −"),
        ({"altitude": 2000.0}, SLOW, r"^Denser air \(\+22 %\): induced −"),
        (SLOW, {"mu": 0.25, "twist": "linear:-5", "mass": 9000.0}, "^Several changes at once: "),
        (SLOW, {"twist": "linear:-5", "mass": 9000.0}, r"^8\.1 % more weight and a new twist: "),
        (SLOW, SLOW, r"^Nothing has changed\.$"),
        (
            {"twist": "linear:-8"},
            {"twist": "linear:-8.001"},
            r"^Lift hardly moved: no change in power\.$",
        ),
        ({"mu": 0.45, "mass": 14_000.0}, SLOW, "no trim"),
    ],
)
def test_a_known_cause_is_named(before: dict[str, Any], after: dict[str, Any], said: str):
    assert re.search(said, why(flown(**before), flown(**after)))


@pytest.mark.parametrize(
    ("flight", "switch", "said"),
    [
        (SLOW, "tip_loss", r"no change in power \(included in the wake\)\.$"),
        ({"inflow": "local-momentum"}, "tip_loss", "^Without tip loss: induced −"),
        ({"mu": 0.37}, "compressibility", r"drag divergence disappeared\.$"),
        (SLOW, "hub_loss", r"^Without root loss: no change in power \("),
        ({"mu": 0.0}, "fuselage", "^Without fuselage drag: no change in power"),
    ],
)
def test_a_switch_says_what_it_does_or_why_nothing(flight: dict[str, Any], switch: str, said: str):
    solution = flown(**flight)
    assert re.search(said, why(solution, solved(with_switches(solution.design, [switch]))))


def test_another_model_or_rotor_is_named():
    cases: tuple[tuple[dict[str, Any], dict[str, Any], str], ...] = (
        (SLOW, {"inflow": "uniform"}, "Uniform instead of Lifting line: "),
        (
            {"mu": 0.0},
            {"hover_inflow": "closed-form"},
            "Closed form instead of annulus balance in hover: ",
        ),
        ({"mu": 0.05}, {"low_speed": "wake"}, "Without transition to hover at low speed: "),
        ({"mu": 0.0}, {"elements": 20}, "Another model: "),
        (FAST, {"bending": True}, "With blade bending: "),
    )
    for flight, models, said in cases:
        solution = flown(**flight)
        other = solved(replace(solution.design, models=replace(solution.design.models, **models)))
        assert why(solution, other).startswith(said)
    other = solved(make_design(rotor="s61"))
    assert why(flown(), other).startswith(f"{other.design.aircraft.name} instead of UH-60A: ")


def test_a_design_without_trim_gives_the_first_sentence_of_its_message():
    lost = flown(0.45, mass=14_000.0)
    assert not lost.converged
    sentence = why(flown(), lost)
    assert sentence.endswith("beyond this rotor.")
    assert sentence.count(". ") == 0
    assert lost.message.startswith(sentence[:-1])


class TestNumbers:
    @pytest.mark.parametrize("mu", [0.1, 0.3])
    def test_parts_come_in_order_of_size_and_are_those_of_the_solutions(self, mu: float):
        before, after = flown(mu), flown(mu, "linear:-4", 9500.0)
        named = re.findall(
            r"(induced|profile|parasite|tail rotor) ([+−][\d\u2009.]+)", why(before, after)
        )
        sizes = [float(value.replace("−", "-").replace("\u2009", "")) for _, value in named]
        assert sizes == sorted(sizes, key=abs, reverse=True)
        for (name, _), size in zip(named, sizes, strict=True):
            field = "tail" if name == "tail rotor" else name
            change = 1e-3 * (getattr(after.power, field) - getattr(before.power, field))
            assert_allclose(size, change, atol=0.51)

    def test_the_unit_stands_once_behind_the_last_part(self):
        before, after = flown(0.3), flown(0.3, "linear:-4", 9500.0)
        for sentence, unit in ((why(before, after), "kW"), (why(before, after, AVIATION), "hp")):
            assert re.search(rf": induced [+−]\d+(, [a-z ]+ [+−]\d+)+ {unit}[.;]", sentence)
            assert sentence.count(unit) == 1
