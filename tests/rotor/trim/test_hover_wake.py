"""Hover with a free wake as a solution: energy, gradient, path, preview, filaments, refusals."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotor.aero.free_wake import settle
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.trim.adjoint import Objective, power_gradient
from rotor.trim.newton import SolverOptions
from rotor.trim.solution import Solution
from rotor.trim.solve import solve


def free_wake(twist: str = "linear:-12", mass_kg: float | None = None) -> Design:
    design = make_design(hover=True, twist=twist, mass_kg=mass_kg)
    return replace(design, models=replace(design.models, hover_inflow="free-wake"))


@pytest.fixture(scope="module")
def solution() -> Solution:
    return solve(free_wake()).require()


def test_power_by_parts_is_the_shaft_power(solution: Solution):
    """Induced power is circulation times the velocity normal to it, and with dissipation it is all of the torque."""
    power = solution.power
    assert power.main_rotor == pytest.approx(power.shaft, rel=1e-12)
    assert power.induced > 0.0
    assert power.profile > 0.0


def test_it_costs_more_than_momentum_theory_and_is_near_the_annulus_balance(solution: Solution):
    assert solution.induced_power_factor > 1.0
    annulus = solve(make_design(hover=True, twist="linear:-12")).require()
    assert solution.power.total == pytest.approx(annulus.power.total, rel=0.06)


@pytest.mark.parametrize("station", [0.5, 0.85])
@pytest.mark.parametrize("objective", ["total", "induced"])
def test_gradient_by_pitch_agrees_with_differences(solution: Solution, objective: Objective, station: float):
    gradient = power_gradient(solution, objective)
    stations = np.array([0.13, station, 1.0])
    bend = 0.01

    def watts(sign: float) -> float:
        angles = -12.0 * (stations - 0.75) + sign * bend * np.array([0.0, 1.0, 0.0])
        twist = f"points:{','.join(map(repr, angles.tolist()))}@{','.join(map(repr, stations.tolist()))}"
        power = solve(solution.design.with_twist(twist), solution).require().power
        return power.total if objective == "total" else power.induced

    change = np.interp(gradient.r, stations, [0.0, 1.0, 0.0])
    slope = (watts(1.0) - watts(-1.0)) / (2.0 * math.radians(bend))
    assert slope == pytest.approx(float(gradient.by_element @ change), rel=1e-4)


def test_elastic_blade_has_the_power_of_a_rigid_one_built_as_it_flies(solution: Solution):
    """The flown twist of the elastic blade, given to a blade that is rigid in torsion."""
    assert solution.elastic is not None
    flown = np.degrees(solution.design.twist(solution.disk.r) + solution.elastic.along_blade)
    pairs = [",".join(map(repr, values.tolist())) for values in (flown, solution.disk.r)]
    rigid = solution.design.with_twist(f"points:{pairs[0]}@{pairs[1]}")
    rigid = replace(rigid, models=replace(rigid.models, elastic_twist=False))
    found = solve(rigid, solution).require()
    assert found.elastic is None
    assert found.power.total == pytest.approx(solution.power.total, rel=1e-7)
    annulus = solve(make_design(hover=True, twist="linear:-12")).require()
    assert annulus.elastic is not None
    assert solution.elastic.tip[0] == pytest.approx(annulus.elastic.tip[0], abs=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("first", ["linear:-4", "linear:-20"])
def test_settled_power_does_not_depend_on_the_path(solution: Solution, first: str):
    found = solve(free_wake(first)).require()
    for twist in ("linear:-8", "linear:-15", "linear:-12"):
        found = solve(free_wake(twist), found).require()
    assert found.power.total == pytest.approx(solution.power.total, rel=1e-7)
    assert found.settled


def test_preview_is_close_and_says_that_it_is_not_settled(solution: Solution, monkeypatch: pytest.MonkeyPatch):
    before, near = solve(free_wake()), free_wake("linear:-12.5")
    for k in range(6):  # Those of a drag all begin at the same wake; the factors of four wakes are kept.
        assert solve(free_wake(f"linear:{-12.1 - 0.05 * k}"), before, SolverOptions(preview=True)).passes == 2
    monkeypatch.setattr(settle, "KEPT", settle.KeptFactors())  # Other wakes have taken their place.
    preview = solve(near, before, SolverOptions(preview=True)).require()
    settled = solve(near, before).require()
    assert not preview.settled
    assert preview.to_dict()["settled"] is False
    change = settled.power.total - solution.power.total
    assert preview.power.total - solution.power.total == pytest.approx(change, rel=0.1)


@pytest.mark.slow
def test_without_an_earlier_wake_a_preview_is_the_settled_answer():
    design = free_wake("linear:-12")
    assert solve(design, None, SolverOptions(preview=True)).settled


def test_filaments_begin_at_the_blades_and_go_down(solution: Solution):
    wake = solution.wake
    assert wake is not None
    assert wake.points.shape == (16, 121, 3)
    assert wake.core_radius.shape == (16, 121)
    tips = wake.tip_vortices
    angles = np.arctan2(tips[:, 0, 1], tips[:, 0, 0]) % (2.0 * math.pi)
    assert np.sort(angles) == pytest.approx([0.0, math.pi / 2, math.pi, 1.5 * math.pi], abs=1e-12)
    assert (tips[:, -1, 2] < -1.0).all()
    assert (wake.circulation.reshape(4, 4)[:, -1] > 0.0).all()


def test_band_holds_the_power_itself(solution: Solution):
    assert solution.power_band is not None
    low, high = solution.power_band
    assert solution.to_dict()["power_band_percent"] == {"low": 100.0 * low, "high": 100.0 * high}
    assert -0.1 < low <= 0.0 <= high < 0.1
    assert high - low > 0.002


@pytest.mark.slow
def test_worth_of_twist_has_a_band_that_reads_both_ways():
    """The same roll-ups in both: the band of B from A is that of A from B, and a blade is worth nothing to itself."""
    a, b = (solve(replace(at, models=replace(at.models, elastic_twist=False))).require()
            for at in (free_wake("linear:-8"), free_wake("linear:-14")))  # fmt: skip
    forth, back = b.worth_band(a), a.worth_band(b)
    assert forth is not None
    assert back is not None
    assert forth[0] <= b.power.main_rotor / a.power.main_rotor - 1.0 <= forth[1]
    assert 0.001 < forth[1] - forth[0] < 0.1
    assert (1.0 + forth[0]) * (1.0 + back[1]) == pytest.approx(1.0, abs=1e-9)
    assert a.worth_band(a) == pytest.approx((0.0, 0.0), abs=1e-12)


def test_worth_of_twist_has_no_band_without_a_free_wake(solution: Solution):
    assert solution.worth_band(solve(make_design(hover=True))) is None


def test_a_rotor_without_thrust_gets_a_sentence():
    solution = solve(free_wake(mass_kg=300.0))
    assert not solution.converged
    assert "annulus" in solution.message


@pytest.mark.slow
def test_tips_that_push_down_get_a_sentence():
    """Followed from more thrust, the wake of five blades with −21.7° ends at C_T/σ 0.025 (a fold of the solution)."""
    solution = solve(free_wake("linear:-32", mass_kg=2000.0))
    assert not solution.converged
    assert "tips push down" in solution.message


def test_a_given_collective_gets_a_sentence():
    design = make_design(rotor="xv15", hover=True, trim="controls", stand={"collective_deg": 8.0})
    solution = solve(replace(design, models=replace(design.models, hover_inflow="free-wake")))
    assert not solution.converged
    assert "give such a thrust" in solution.message


@pytest.mark.slow
def test_less_power_than_momentum_theory_allows_carries_a_caveat(solution: Solution):
    names = {caveat.name for caveat in solution.caveats}
    assert "free-wake-band" in names
    assert "free-wake-below-ideal" not in names
    strongly_twisted = solve(free_wake("linear:-26")).require()
    assert strongly_twisted.induced_power_factor < 1.0
    assert "free-wake-below-ideal" in {caveat.name for caveat in strongly_twisted.caveats}
