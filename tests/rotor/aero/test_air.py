"""Climb and gusts: what the disk sees of them, their energy, their rate, and where hover refuses them."""

import math
import re
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import j0

import rotor
from rotor.aero.problem import build_problem
from rotor.aero.section import FZ
from rotor.columns.flight import flight_system
from rotor.design.design import Design
from rotor.engine.linearise import evaluate
from rotor.support.arrays import Array
from rotor.trim.analysis import Analysis, power_gradient
from tests.solved import SAME, assert_same_trim

PAGE = Path(__file__).parents[3] / "docs" / "developers" / "freedom.md"


@dataclass(frozen=True)
class Wave(rotor.Gust):
    """w = A r² cos nψ."""

    per_rev: int = 2
    amplitude: float = 3.0

    def over_disk(self, r: Array, psi: Array, order: int = 0) -> Array:
        turned = self.per_rev * psi + order * 0.5 * np.pi
        return self.amplitude * self.per_rev**order * r**2 * np.cos(turned)


def gusty(gust: rotor.Gust | None, mu: float, **asked: Any) -> Design:
    return replace(rotor.make_design(mu=mu, twist="linear:-12", **asked), gust=gust)


@pytest.mark.parametrize("mu", [0.0, 0.03, 0.2])
def test_sinking_air_is_a_climb(mu: float):
    """Level flight in air that sinks at 3 m/s: same velocities at the blades, same power, same figure of merit."""
    level, climbing = (
        rotor.solve(gusty(rotor.Gust(-3.0), mu)),
        rotor.solve(gusty(None, mu, climb_m_s=3.0)),
    )
    assert_same_trim(level.require(), climbing.require())
    assert level.figure_of_merit == (
        None if mu else pytest.approx(climbing.figure_of_merit, rel=SAME)
    )
    seen = [Analysis(solution).linear.elements for solution in (level, climbing)]
    for name in ("u_t", "u_p", "u_r"):
        assert_allclose(*(getattr(elements, name) for elements in seen), rtol=0.0, atol=1e-15)


@pytest.mark.parametrize("inflow", ["lifting-line", "local-momentum", "drees"])
def test_energy_closes_in_a_gust_and_its_power_has_its_exact_gradient(inflow: str):
    at = gusty(Wave(1.0), 0.2, inflow=inflow)
    found = rotor.solve(at).require()
    power = found.power
    assert_allclose(power.shaft, power.main_rotor, rtol=1e-10)
    # Of the uniform part alone it is W times 1 m/s.
    assert abs(power.climb + at.condition.weight) > 1e3
    gradient, step = power_gradient(found), 0.02
    ahead, behind = (
        rotor.solve(at.with_twist(f"linear:{-12.0 + s * step!r}")).power.total for s in (1.0, -1.0)
    )
    slope = (ahead - behind) / (2.0 * math.radians(step))
    assert slope == pytest.approx(float(gradient.by_element @ (gradient.r - 0.75)), rel=2e-4)


def test_rate_is_the_derivative_by_azimuth():
    """In unsteady flow at half the chord's delay of the value; the value of steady flow is that at the element."""
    unsteady, steady = (build_problem(gusty(Wave(), 0.2, off=off)) for off in (None, "unsteady"))
    r, psi, by = unsteady.disk.r[:, None], unsteady.disk.psi, unsteady.design.rotor.tip_speed
    lag = unsteady.half_chord[:, None] / r
    assert unsteady.air.gust_rate is not None
    ahead, behind = (Wave().over_disk(r, psi - 0.5 * lag + step) / by for step in (1e-5, -1e-5))
    assert_allclose(unsteady.air.gust_rate, (behind - ahead) / 2e-5, atol=1e-9)
    for problem, late in ((unsteady, lag), (steady, 0.0)):
        assert problem.air.gust is not None
        assert_allclose(problem.air.gust, -Wave().over_disk(r, psi - late) / by, rtol=1e-14)


@pytest.mark.parametrize("per_rev", [2, 6])
def test_lift_of_unsteady_flow_is_that_of_sears(per_rev: int):
    """Over the steady lift of the air in the middle of the chord J0(k), k = n b/r, at C = 1 (Sears, 1941)."""
    off = "elastic-twist,dynamic-stall,tip-loss,hub-loss,compressibility,swirl,unsteady"
    still = gusty(None, 1e-3, inflow="uniform", low_speed="wake", off=off)
    lift = list[Array]()
    for unsteady in (True, False):
        at = replace(still, models=replace(still.models, unsteady=unsteady))
        x = Analysis(rotor.solve(at).require()).linear.point.x
        problems = [
            build_problem(replace(at, gust=gust)) for gust in (Wave(0.0, per_rev, 0.1), None)
        ]
        blown, calm = (evaluate(s, s.grid, x).forces[FZ] for s in map(flight_system, problems))
        lift.append((blown - calm) @ np.exp(-1j * per_rev * problems[0].disk.psi))
    k = per_rev * problems[0].half_chord / problems[0].disk.r
    response = (lift[0] / lift[1] * np.exp(0.5j * k))[8:]
    assert np.all(k[8:] < 0.7)
    assert np.all(np.abs(np.abs(response) - j0(k[8:])) < 0.14 * k[8:] ** 2)
    # Without rate, or with the value at the quarter chord: k/2.
    assert_allclose(np.angle(response), 0.0, atol=0.008)


def test_hover_has_a_ring_of_gust_but_none_that_follows_the_azimuth():
    with pytest.raises(
        ValueError,
        match=r"Wave\(.*\) changes with azimuth, and hover has one azimuth: give a speed",
    ):
        rotor.solve(gusty(Wave(), 0.0))
    ring = Wave(per_rev=0)
    found, near = (rotor.solve(gusty(ring, mu)).require() for mu in (0.0, 1e-4))
    disk, speed = found.disk, found.design.rotor.tip_speed
    assert_allclose(disk.u_p[:, 0], disk.induced[:, 0] - 3.0 * disk.r**2 / speed, rtol=1e-13)
    for power in (found.power, near.power):
        assert_allclose(power.shaft, power.main_rotor, rtol=1e-12)
    assert near.power.total == pytest.approx(found.power.total, rel=1e-5)


def test_what_has_no_place_for_a_gust_says_so():
    with pytest.raises(
        ValueError, match=r"Gust\(uniform=2.0\): the document's equations are those of still air"
    ):
        gusty(rotor.Gust(2.0), 0.2, preset="thesis")
    with pytest.raises(ValueError, match=r"design files have no Gust\(uniform=2.0\)"):
        gusty(rotor.Gust(2.0), 0.2).to_dict()
    assert rotor.make_design(case=gusty(Wave(), 0.2), mu=0.1).gust == Wave()


def test_the_worked_example_saves_what_rising_air_carries():
    block = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)[1]
    names: dict[str, Any] = {}
    exec(compile(block, PAGE.name, "exec"), names)
    assert names["less"] == pytest.approx(names["still"].condition.weight, rel=0.15)
