"""The flight envelope: limits by hand, identities, and that both kinds of limit are where they are said to be."""

import csv
import io
import math
from collections.abc import Callable
from typing import Any

import pytest
from numpy.testing import assert_allclose

import rotor
from rotor.design.design import Design
from rotor.design.quantities import CONDITION
from rotor.study.envelope import find_limit
from rotor.trim.validity import HOVER_LIMIT, MOST_STALLED

SMALL: dict[str, Any] = {
    "elements": 16, "azimuths": 32, "inflow": "drees", "twist": "linear:-10",
}  # fmt: skip


def small(**more: Any) -> Design:
    return rotor.make_design(**SMALL | more)


def test_engines_limit_where_power_is_theirs():
    design = small(mu=0.1)
    for name in ("load_factor", "mu", "altitude_m"):
        found = find_limit(design, name)
        if found.engines is None:
            assert name == "altitude_m"
            continue
        at = rotor.solve(CONDITION[name].put(design, found.engines)).require()
        assert_allclose(at.power.total, design.aircraft.installed_power or 0.0, rtol=1e-3)
        assert found.value == found.engines
        assert found.limit == "engines"


def test_stall_limits_where_the_solver_refuses():
    design = small(mu=0.3)
    stall = find_limit(design, "load_factor", both=True).stall or 0.0
    assert rotor.solve(design.at(load_factor=stall)).stalled_thrust <= MOST_STALLED
    assert not rotor.solve(design.at(load_factor=stall + 0.03)).converged


def test_hover_by_hand():
    """No rotor hovers beyond the largest blade loading that was measured: n = (C_T/σ)max σ ρ A (ΩR)²/W, download apart.

    By engines: P = P_i n^1.5 + P_0 bounds n from above, since profile power rises too.
    """
    design = small(hover=True, off="download")
    found = find_limit(design, "load_factor", both=True)
    largest = HOVER_LIMIT * design.rotor.solidity / design.weight_coefficient
    assert 0.75 * largest < (found.stall or 0.0) <= largest * 1.001
    one = rotor.solve(design).require().power
    available = design.aircraft.installed_power or 0.0
    bound = ((available - one.total + one.induced) / one.induced) ** (2.0 / 3.0)
    assert 0.9 * bound < (found.engines or 0.0) < bound


def test_mass_altitude_and_speed():
    """A lighter aircraft turns harder by just its mass; thin air and speed take from it."""
    design = small(mu=0.1)
    here = rotor.envelope(design, [0.1]).points[0]
    half = rotor.envelope(design.at(mass_kg=0.8 * design.condition.mass), [0.1]).points[0]
    assert_allclose(half.load_factor.engines or 0.0, (here.load_factor.engines or 0.0) / 0.8, rtol=1e-4)
    assert_allclose(half.mass_kg or 0.0, here.mass_kg or 0.0, rtol=0.02)
    heaviest = rotor.solve(design.at(mass_kg=here.mass_kg)).require()
    assert_allclose(heaviest.power.total, design.aircraft.installed_power or 0.0, rtol=1e-3)
    stalls = [
        find_limit(design.at(altitude_m=height), "load_factor", both=True).stall or 0.0 for height in (0, 2000, 4000)
    ]
    assert stalls[0] > stalls[1] > stalls[2]


def test_a_moving_twist_flies_the_best_of_each_speed():
    found = rotor.envelope(small(mu=0.2), [0.15, 0.3], moving=True)
    for point in found.points:
        best = rotor.optimise(point.design, "linear", starts=1)
        assert_allclose(best.baseline_power or 0.0, best.best.power if best.best else math.nan, rtol=1e-5)
    assert found.points[0].design.twist != found.points[1].design.twist
    assert found.label == "best moving twist"
    chart = found.chart()
    assert [line.label for line in chart.series] == ["best moving twist, stall", "best moving twist, engines"]


def test_what_has_none():
    with pytest.raises(ValueError, match="has no flight envelope"):
        rotor.envelope(small(stand={"ct_over_sigma": 0.07}))
    with pytest.raises(ValueError, match="needs a speed"):
        rotor.envelope(small(), [])
    heavy = find_limit(small(mu=0.2, mass_kg=50_000), "load_factor")
    assert heavy.value is None
    assert heavy.limit == ""


@pytest.mark.slow
def test_the_command(printed: Callable[..., str], answer: Callable[..., Any]):
    flags = ["envelope", "--mu", "0.2", "--twist", "linear:-10", "--inflow=drees", "--elements=16", "--azimuths=32"]
    assert "top speed  µ 0." in printed(*flags)
    (found,) = answer(*flags)
    (row,) = csv.DictReader(io.StringIO(printed(*flags, "--csv", "-")))
    assert float(row["load_factor"]) == found["points"][0]["load_factor"]
    assert row["limit"] in ("stall", "engines")
    assert_allclose(float(row["mass_kg"]), float(row["load_factor"]) * rotor.make_design().condition.mass, rtol=1e-12)
