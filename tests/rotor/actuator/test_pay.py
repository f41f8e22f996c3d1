"""The break-even line against trims of its own, and the command."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import make_design, solve
from rotor.actuator import try_actuator
from rotor.actuator.optimum import best_actuated
from rotor.actuator.pay import (
    WANTED_SHARE,
    BreakEven,
    break_even,
    other_stroke,
    pay_sentence,
    with_mass,
)
from rotor.actuator.tables import pay_table
from rotor.design import LinearTwist
from rotor.optimisation.doubt import difference_doubt
from rotor.optimisation.mission import Mission, mission_at, standard_mission


def mission(rotor: str = "uh60a") -> Mission:
    design = make_design(rotor=rotor, inflow="drees", elements=16, azimuths=36)
    # The standard mission, and one of two legs.
    return standard_mission(design) if rotor == "uh60a" else mission_at(design, (0.0, 0.3))


@cache
def line(rotor: str = "uh60a") -> BreakEven:
    return break_even(mission(rotor))


def flown(even: BreakEven, k: int, mass: float) -> float:
    """Mean power at point k with a mass on the blades, by trims from nothing."""
    span = 1.0 - even.mission.design.rotor.blade.root_cutout
    assert np.ptp(even.rates[k]) * span == pytest.approx(even.twists[k], abs=2e-5)
    return even.mission.mean(
        solve(with_mass(replace(design, twist=LinearTwist(rate)), mass)).power.total
        for design, rate in zip(even.mission.designs(), even.rates[k].tolist(), strict=True)
    )


@pytest.mark.parametrize("rotor", ["uh60a", "s61"])
@pytest.mark.parametrize("k", [2, 5, 8])
def test_on_the_line_nothing_is_saved_and_nothing_lost(rotor: str, k: int):
    """Trimmed anew, without the search that found the line."""
    even = line(rotor)
    assert_allclose(flown(even, k, 0.0), even.fixed_power - even.gross[k], atol=0.1)
    assert_allclose(flown(even, k, float(even.masses[k])), even.fixed_power, atol=0.1)
    assert even.net(float(even.twists[k]), float(even.masses[k])) == pytest.approx(0.0, abs=1e-6)


def test_another_stroke_of_an_actuator_counts_as_its_verdict_counts():
    """Its own stroke and mass save what the verdict says, twice the stroke what an optimum of twice its shapes does."""
    design = make_design(inflow="drees", elements=16, azimuths=36)
    for against in ("same-blade", "best-fixed"):
        judged = try_actuator("MFC_P1", design, against=against)
        other, mass, own = other_stroke(judged), judged.installed.masses.aircraft, judged.attainable
        assert other.net(own, mass) == pytest.approx(judged.net_saving, abs=0.1)
        assert other.net(0.0, 0.0) == pytest.approx(
            judged.reference_power - judged.resting.power, abs=0.1
        )
        assert other.net(own, other.mass_allowed(own)) == pytest.approx(
            min(other.net(own, 0.0), 0.0), abs=0.1
        )
        assert judged.mass_allowed == pytest.approx(other.mass_allowed(own), abs=0.1)
        assert judged.net_band == pytest.approx(other.band(own, mass), rel=1e-6)
        assert other.twist_for(1e4) is None
        twice = replace(judged.installed, shapes=2.0 * judged.installed.shapes)
        twice = replace(twice, rest_shapes=2.0 * twice.rest_shapes)
        found = best_actuated(
            judged.baseline.mission, judged.baseline.concept, twice, starts=[judged.resting.values]
        )
        assert other.net(2.0 * own, 0.0) == pytest.approx(
            judged.reference_power - found.power, abs=20.0
        )
        fixed, built = (
            judged.baseline.fixed.solutions,
            map(solve, judged.baseline.mission.designs()),
        )
        from_trims = fixed if against == "best-fixed" else tuple(built)
        exact = difference_doubt(judged.baseline.mission.shares, found.solutions, from_trims)
        assert other.band(2.0 * own, 0.0) == pytest.approx(exact and exact.change_band, rel=0.01)
        still = difference_doubt(
            judged.baseline.mission.shares, judged.resting.solutions or from_trims, from_trims
        )
        assert other.band(0.0, 0.0) == pytest.approx(still and still.change_band, rel=0.01, abs=1.0)
        paid = 0.5 * float(other.saved[0] + other.saved[-1]) / other.per_kg
        if paid > 0.0:
            assert other.net(other.twist_for(paid) or 0.0, paid) == pytest.approx(0.0, abs=0.1)
    with pytest.raises(ValueError, match="adds no mass"):
        other_stroke(try_actuator("extension_twist", design))


def test_mass_costs_what_momentum_theory_says():
    """ΔP/P_i ≈ 1.5 Δm/m, and a little for profile and tail."""
    even = line()
    solutions = [
        solve(replace(design, twist=LinearTwist(rate)))
        for design, rate in zip(even.mission.designs(), even.rates[8].tolist(), strict=True)
    ]
    induced = even.mission.mean(solution.power.induced for solution in solutions)
    mass = float(even.masses[-1])
    expected = 1.5 * induced * mass / even.mission.design.condition.mass
    assert 1.0 < even.cost(mass) / expected < 1.6
    assert even.cost(2.0 * mass) == pytest.approx(2.0 * even.cost(mass), rel=0.1)


def test_a_requirement_just_pays():
    even = line()
    needed = even.requirement
    assert even.saving(needed.twist) == pytest.approx(WANTED_SHARE * even.ideal_saving)
    assert even.net(needed.twist, needed.mass, needed.drive) == pytest.approx(0.0, abs=1e-6)
    assert even.mass_allowed(needed.twist) > needed.mass  # Without a drive.
    assert even.mass_allowed(needed.twist, 2.0 * even.ideal_saving) == 0.0
    assert pay_sentence(even).startswith(
        f"Pays if it twists ≥ {math.degrees(needed.twist):.1f}° for ≤ "
    )


def test_a_stand_carries_mass_as_thrust():
    """On the HART II rotor, which has no weight, by the thrust of the same newtons."""
    design = make_design(rotor="hart2", mu=0.2, inflow="drees")
    before, after = (solve(one).require() for one in (design, with_mass(design, 10.0)))
    newtons = [design.thrust_unit * one.ct for one in (before, after)]
    assert newtons[1] - newtons[0] == pytest.approx(98.07, rel=1e-3)
    given = (
        replace(design.condition.stand, ct_over_sigma=None, collective=0.1)
        if design.condition.stand
        else None
    )
    with pytest.raises(ValueError, match="give a thrust instead"):
        with_mass(replace(design, condition=replace(design.condition, stand=given)), 10.0)


def test_where_twist_saves_nothing_no_actuator_pays():
    even = line()
    flat = replace(even, gross=1e-3 * even.gross)
    assert not flat.worthwhile
    assert pay_sentence(flat).startswith("No actuator pays: unlimited twist saves")
    table = pay_table([even, flat])
    powers = [name for name in table.columns if name.endswith(("kW", " W"))]
    assert powers == ["ideal kW", "drive ≤ kW"]
    for sentence in (pay_sentence(even), pay_sentence(flat)):
        assert "kW" in sentence
        assert " W" not in sentence
    assert table.rows[1][-1] == "–"
    assert float(table.rows[0][-1]) == pytest.approx(
        even.mass_allowed(even.requirement.twist), abs=0.06
    )


@pytest.mark.slow
def test_command(answer: Callable[..., Any], tmp_path: Path):
    drawn = tmp_path / "line.svg"
    found = answer(
        "actuator", "--rotor", "s61", "--inflow", "drees", "--what-would-pay", "--plot", str(drawn)
    )
    assert found["rotor"].startswith("Sikorsky S-61")
    assert found["message"].startswith("Pays if it twists")
    assert found["pays_from"]["twist_deg"] < found["optima_apart_deg"]
    assert len(found["line"]["mass_kg"]) == len(found["line"]["twist_deg"])
    assert drawn.read_text(encoding="utf-8").startswith("<svg")
