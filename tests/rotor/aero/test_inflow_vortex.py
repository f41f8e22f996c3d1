"""The dynamic wake against the vortex wake: two independent theories of four blades, one trim."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.files.make_design import make_design
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

RATES = (0, -4, -8, -12, -16, -20)


@cache
def solved(inflow: str, mu: float, rate: int) -> Solution:
    design = make_design(twist=f"linear:{rate}", mu=mu)
    return solve(replace(design, models=replace(design.models, inflow=inflow))).require()


def power(inflow: str, mu: float, rate: int) -> float:
    return solved(inflow, mu, rate).power.total


def best_rate(inflow: str, mu: float) -> float:
    """Least of a quartic through the powers [° per radius]."""
    fine = np.linspace(-20.0, 0.0, 2001)
    fit = np.polyfit(RATES, [power(inflow, mu, rate) for rate in RATES], 4)
    return float(fine[np.polyval(fit, fine).argmin()])


def compare(mu: float, rates: tuple[int, ...]) -> None:
    for rate in rates:
        assert_allclose(power("dynamic-wake", mu, rate), power("vortex-wake", mu, rate), rtol=0.03)


@pytest.mark.parametrize("mu", [0.1, 0.3])
def test_power_agrees(mu: float):
    compare(mu, (-4, -16))


def test_best_linear_twist_agrees():
    assert_allclose(best_rate("dynamic-wake", 0.2), best_rate("vortex-wake", 0.2), atol=1.0)


@pytest.mark.slow
@pytest.mark.parametrize("mu", [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4])
def test_power_and_optimum_agree_everywhere(mu: float):
    compare(mu, RATES)
    ours, theirs = best_rate("dynamic-wake", mu), best_rate("vortex-wake", mu)
    print(f"\nµ {mu:.2f}: best linear twist {ours:.1f}° (dynamic wake), {theirs:.1f}° (vortex wake)")
    assert_allclose(ours, theirs, atol=1.0)


def test_energy_identity_and_closure():
    solution = solved("vortex-wake", 0.3, -16)
    assert_allclose(solution.power.shaft, solution.power.main_rotor, rtol=1e-9)


@pytest.mark.slow
def test_the_lattice_is_fine_enough(monkeypatch: pytest.MonkeyPatch):
    """Power on 16 × 36 panels and 40 elements against 24 × 60 and 80: 0.4 %."""
    import rotor.aero.inflow.vortex_lattice as module

    design = make_design(twist="linear:-12", mu=0.3)
    coarse = solve(replace(design, models=replace(design.models, inflow="vortex-wake"))).require()
    monkeypatch.setattr(module, "PANELS", 24)
    monkeypatch.setattr(module, "AZIMUTHS", 60)
    module._lattice_theory.cache_clear()
    fine = solve(replace(design, models=replace(design.models, inflow="vortex-wake", elements=80))).require()
    module._lattice_theory.cache_clear()
    assert_allclose(coarse.power.main_rotor, fine.power.main_rotor, rtol=4e-3)
