"""Trims with dynamic stall: exact derivatives, gradients, one power for one design, and what is refused."""

import math
import pickle
import re
from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest

from rotor import Design, distribution, make_design, optimise, solution_record, solve, sweep
from rotor.aero.switches import no_effect
from rotor.design.aircraft import Stand
from rotor.design.design import with_models
from rotor.trim.analysis import power_gradient
from rotor.trim.forward import first_guess
from rotor.trim.low_speed import trim_problem
from rotor.trim.newton import SolverOptions, newton
from rotor.trim.validity import MOST_STALLED
from tests.solved import assert_same_trim

HEAVY: dict[str, Any] = {"mu": 0.35, "mass_kg": 9500.0}


def steady(design: Design) -> Design:
    return replace(design, models=replace(design.models, dynamic_stall=False))


def test_what_the_first_derivatives_leave_out_does_not_move_the_trim(
    monkeypatch: pytest.MonkeyPatch,
):
    problem = trim_problem(make_design(**HEAVY))
    found = newton(problem, first_guess(problem))
    monkeypatch.setattr("rotor.engine.newton._MOST_FORGETFUL", 0)
    exact = newton(problem, first_guess(problem))
    assert found.converged
    assert exact.point.q == pytest.approx(found.point.q, rel=1e-7, abs=1e-12)
    assert exact.state != found.state  # Other steps came to it.


def test_a_start_that_is_the_trim_keeps_its_factors():
    """They serve its gradient and the trim after it."""
    solution = solve(make_design(mu=0.2)).require()
    again = solve(solution.design, solution).require()
    assert again.passes == 1
    assert again.start.factors is not None


def test_stalled_lift_comes_later_and_is_more():
    design = make_design(**HEAVY)
    unsteady, still = solve(design).require(), solve(steady(design)).require()
    assert unsteady.power.total < 0.995 * still.power.total
    assert np.nanmin(distribution(unsteady).cm) < np.nanmin(distribution(still).cm) - 0.01
    assert not [caveat for caveat in unsteady.caveats if "without dynamic stall" in caveat.sentence]


@pytest.mark.parametrize("given", [{"hover": True}, {"mu": 0.3, "inflow": "local-momentum"}])
def test_no_effect_in_hover_and_where_the_section_balances_itself(given: dict[str, Any]):
    design = make_design(**given)
    assert_same_trim(solve(design), solve(steady(design)))


TURN: dict[str, Any] = {"rotor": "gazelle", "mu": 0.337, "mass_kg": 2930.0}
"""A turn of an SA349/2 at C_T/σ 0.094: 513 kW were measured."""


def turn(changed: dict[str, Any]) -> Design:
    return make_design(**{**TURN, **changed})


def test_a_turn_is_met_that_steady_sections_refuse():
    """Within 5 %; with steady sections trims end at a lower mass or speed."""
    found = solve(make_design(**TURN)).require()
    assert found.power.main_rotor == pytest.approx(513e3, rel=0.05)
    assert solution_record(found)["dynamic_stall"] is True
    still = solve(steady(make_design(**TURN)))
    assert not still.converged
    assert "2930 kg at 0 m and advance ratio 0.337 is beyond this rotor" in still.message
    assert "The largest that trim are 289" in still.message
    again = pickle.loads(pickle.dumps(found))
    assert power_gradient(again).by_element == pytest.approx(
        power_gradient(found).by_element, rel=1e-6
    )


@pytest.mark.parametrize(
    "given",
    [{"mu": 0.35, "preset": "thesis"}, {"hover": True}, {"mu": 0.2, "off": "dynamic-stall"}],
)
def test_elsewhere_sections_stay_steady(given: dict[str, Any]):
    solution = solve(make_design(**given)).require()
    assert solution.disk.unsteady is None
    assert solution_record(solution)["dynamic_stall"] is False


def test_page_search_and_sweep_have_one_power_for_one_design():
    """Of a heavy rotor, whose best twist and built-in twist stall differently."""
    design = make_design(mu=0.2, mass_kg=10_900.0)
    found = optimise(design, "linear", starts=1)
    best = found.best
    for one, power in ((found.design, best.power), (design, found.baseline_power)):
        assert power == pytest.approx(solve(one).require().power.total, rel=1e-7)
        assert solve(one, solve(design)).require().power.total == pytest.approx(power, rel=1e-7)
        assert sweep(one, mu=[0.15, 0.2])[1].power.total == pytest.approx(power, rel=1e-7)
    beside = [
        solve(design.with_twist(f"linear:{rate}")).require().power.total for rate in range(-20, -9)
    ]
    assert best.power < min(beside)


def test_the_answer_does_not_depend_on_the_start():
    light, heavy = make_design(mu=0.35, mass_kg=8500.0), make_design(mu=0.35, mass_kg=9500.0)
    first = solve(heavy).require()
    for design, start in ((light, first), (heavy, solve(light))):
        assert solve(design, start).require().power.total == pytest.approx(
            solve(design).power.total, rel=1e-6
        )


def test_beyond_all_measured_stall_there_is_no_power():
    """The turn at C_T/σ 0.116: what trims there is named, and trims."""
    refused = solve(turn({"mu": 0.338, "mass_kg": 3600.0}))
    assert not refused.converged
    assert refused.stalled_moment > MOST_STALLED
    mass, mu = re.findall(r"(\d+) kg at this speed and advance ratio (0\.\d+)", refused.message)[0]
    assert solve(turn({"mu": 0.338, "mass_kg": float(mass)})).converged
    assert solve(turn({"mu": float(mu), "mass_kg": 3600.0})).converged
    with pytest.raises(RuntimeError, match="61 % of the lift's moment"):
        refused.require()
    short = solve(refused.design, options=SolverOptions(remedy=False))
    assert short.message.startswith("Not trimmed: 61 % of the lift's moment")
    assert "The largest" not in short.message


@pytest.mark.parametrize("name", ["rotor_speed_percent", "mass_kg"])
def test_no_island_of_trims_lies_behind_a_refusal(name: str):
    """From easy to hard: once refused, always refused. Beyond the largest lift the weight balances once more."""
    values = {
        "rotor_speed_percent": (84, 80, 77, 76, 74, 73),
        "mass_kg": (12_500, 13_000, 13_500, 14_000, 15_000),
    }[name]
    designs = [make_design(mu=0.3, **cast(Any, {name: float(value)})) for value in values]
    trimmed = [solve(design, options=SolverOptions(remedy=False)).converged for design in designs]
    assert trimmed == sorted(trimmed, reverse=True)
    assert trimmed[0]
    assert not trimmed[-1]


def test_an_inflow_that_cannot_have_it_says_so():
    design = make_design(mu=0.3, inflow="local-momentum")
    assert "no-dynamic-stall" in {caveat.name for caveat in solve(design).require().caveats}
    assert "without lags" in no_effect(design, "dynamic_stall")
    asked = make_design(mu=0.3, inflow="local-momentum", off="dynamic-stall")
    assert "no-dynamic-stall" not in {caveat.name for caveat in solve(asked).require().caveats}


@pytest.mark.parametrize("mu", [0.15, 0.17, 0.2])
def test_a_measured_state_with_much_stall_near_the_hub_trims(mu: float):
    """An XV-15 tilted 15° aft at C_T/σ 0.075 was measured (Betzina 2002).

    A fifth of its thrust is stalled, and more than a quarter without the delay of stall by rotation.
    """
    aft = make_design(
        rotor="xv15",
        mu=mu,
        trim="wind-tunnel",
        stand=Stand(ct_over_sigma=0.075, shaft_tilt=math.radians(-15.0)),
    )
    found = solve(aft).require()
    assert 0.17 < found.stalled_thrust < 0.23
    assert found.stalled_moment < 0.75 * MOST_STALLED
    without = solve(with_models(aft, stall_delay=False)).require()
    assert without.stalled_moment < MOST_STALLED < without.stalled_thrust
