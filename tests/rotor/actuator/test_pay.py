"""The break-even line against trims of its own, and the command."""

import json
import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.__main__ import main
from rotor.actuator.optimum import ConditionPair
from rotor.actuator.pay import ENOUGH, BreakEven, break_even, pay_sentence, suppose, with_mass
from rotor.actuator.tables import pay_table
from rotor.design.twist import LinearTwist
from rotor.files.make_design import make_design
from rotor.trim.solve import solve


def pair(rotor: str = "uh60a") -> ConditionPair:
    design = make_design(rotor=rotor, inflow="drees")
    return ConditionPair(replace(design, models=replace(design.models, elements=16, azimuths=36)), (0.0, 0.3))


@cache
def line(rotor: str = "uh60a") -> BreakEven:
    return break_even(pair(rotor))


def flown(even: BreakEven, k: int, mass: float) -> float:
    """Mean power at point k with a mass on the blades, by trims from nothing."""
    powers: list[float] = []
    span = 1.0 - even.pair.design.rotor.blade.root_cutout
    for design, part in zip(even.pair.designs(), (0.0, math.copysign(even.twists[k] / span, even.change)), strict=True):
        powers.append(solve(with_mass(replace(design, twist=LinearTwist(even.rates[k] + part)), mass)).power.total)
    return float(np.mean(powers))


@pytest.mark.parametrize("rotor", ["uh60a", "s61"])
@pytest.mark.parametrize("k", [2, 5, 8])
def test_on_the_line_nothing_is_saved_and_nothing_lost(rotor: str, k: int):
    """Trimmed anew, without the search that found the line."""
    even = line(rotor)
    assert_allclose(flown(even, k, 0.0), even.fixed_power - even.gross[k], atol=0.1)
    assert_allclose(flown(even, k, float(even.masses[k])), even.fixed_power, atol=0.1)
    assert even.net(float(even.twists[k]), float(even.masses[k])) == pytest.approx(0.0, abs=1e-6)


def test_a_supposed_actuator_is_trimmed_and_has_a_band():
    """Between the points of the line, against trims from nothing; nothing saves nothing, surely."""
    even = line()
    twist, mass = 0.3 * float(even.twists[-1]), 0.5 * float(even.masses[-1])
    found = suppose(even.pair, even.rates_at(twist), mass)
    powers = [
        solve(with_mass(replace(design, twist=LinearTwist(rate)), mass)).power.total
        for design, rate in zip(even.pair.designs(), even.rates_at(twist), strict=True)
    ]
    assert found.saving == pytest.approx(even.fixed_power - float(np.mean(powers)), abs=0.1)
    assert found.saving == pytest.approx(even.net(twist, mass), abs=0.03 * even.ideal_saving)
    assert found.fuel_saving is not None
    assert found.fuel_saving * found.saving > 0.0
    assert found.band is not None
    assert found.band > 0.0
    nothing = suppose(even.pair, even.rates_at(0.0), 0.0)
    assert nothing.saving == pytest.approx(0.0, abs=0.1)
    assert nothing.band == pytest.approx(0.0, abs=1.0)
    assert even.rates_at(2.0 * float(even.twists[-1])) == even.rates_at(float(even.twists[-1]))


def test_mass_costs_what_momentum_theory_says():
    """ΔP/P_i ≈ 1.5 Δm/m, and a little for profile and tail."""
    even = line()
    solutions = [solve(replace(design, twist=LinearTwist(even.rates[8]))) for design in even.pair.designs()]
    induced = float(np.mean([solution.power.induced for solution in solutions]))
    mass = float(even.masses[-1])
    expected = 1.5 * induced * mass / even.pair.design.condition.mass
    assert 1.0 < even.cost(mass) / expected < 1.6
    assert even.cost(2.0 * mass) == pytest.approx(2.0 * even.cost(mass), rel=0.1)


def test_a_requirement_just_pays():
    even = line()
    needed = even.requirement
    assert even.saving(needed.twist) == pytest.approx(ENOUGH * even.ideal_saving)
    assert even.net(needed.twist, needed.mass, needed.drive) == pytest.approx(0.0, abs=1e-6)
    assert even.mass_allowed(needed.twist) > needed.mass  # Without a drive.
    assert even.mass_allowed(needed.twist, 2.0 * even.ideal_saving) == 0.0
    assert pay_sentence(even).startswith(f"Pays if it twists ≥ {math.degrees(needed.twist):.1f}° for ≤ ")


def test_a_stand_carries_mass_as_thrust():
    """On the HART II rotor, which has no weight, by the thrust of the same newtons."""
    design = make_design(rotor="hart2", mu=0.2, inflow="drees")
    before, after = (solve(one).require() for one in (design, with_mass(design, 10.0)))
    newtons = [design.thrust_unit * one.ct for one in (before, after)]
    assert newtons[1] - newtons[0] == pytest.approx(98.07, rel=1e-3)
    given = replace(design.condition.stand, ct_over_sigma=None, collective=0.1) if design.condition.stand else None
    with pytest.raises(ValueError, match="give the stand a thrust"):
        with_mass(replace(design, condition=replace(design.condition, stand=given)), 10.0)


def test_where_twist_saves_nothing_no_actuator_pays():
    even = line()
    flat = replace(even, gross=1e-3 * even.gross)
    assert not flat.worthwhile
    assert pay_sentence(flat).startswith("No actuator pays: unlimited twist saves")
    table = pay_table([even, flat])
    assert table.rows[1][-1] == "–"
    assert float(table.rows[0][-1]) == pytest.approx(even.mass_allowed(even.requirement.twist), abs=0.06)


@pytest.mark.slow
def test_command(capsys: pytest.CaptureFixture[str], tmp_path: Path):
    drawn = tmp_path / "line.svg"
    arguments = ["actuator", "--rotor", "s61", "--inflow", "drees", "--what-would-pay", "--plot", str(drawn), "--json"]
    assert main(arguments) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["rotor"].startswith("Sikorsky S-61")
    assert answer["message"].startswith("Pays if it twists")
    assert answer["pays_from"]["twist_deg"] < answer["optima_apart_deg"]
    assert len(answer["line"]["mass_kg"]) == len(answer["line"]["twist_deg"])
    assert drawn.read_text(encoding="utf-8").startswith("<svg")
    assert main(["actuator", "--plot", str(drawn)]) == 2
    assert "add --what-would-pay" in capsys.readouterr().err
