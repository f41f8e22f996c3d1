"""`solve` always returns, within bounds, and hands over when it is told to stop."""

from dataclasses import replace

import pytest

from rotor.design.aircraft import LEAST_MASS
from rotor.design.stand import LARGEST_CT_OVER_SIGMA, Stand
from rotor.files.make_design import make_design
from rotor.trim.forward import easier_condition
from rotor.trim.newton import DEFAULT_OPTIONS
from rotor.trim.solve import solve

HOPELESS = make_design(mu=0.4, mass_kg=20_000, inflow="pitt-peters")
"""No trim exists: C_W/σ is 0.2."""


@pytest.mark.parametrize("mass", [100.0, 120.0, 400.0, 900.0])
def test_continuation_never_leaves_the_masses_that_exist(mass: float):
    """A light rotor at high altitude: the easier condition of C_T/σ 0.045 would weigh less than any aircraft."""
    design = make_design(rotor="r22", mu=0.45, mass_kg=mass, altitude_m=8000)
    small = replace(design, rotor=replace(design.rotor, radius=1.2, angular_speed=150.0))
    for t in (0.0, 0.5, 1.0):
        assert LEAST_MASS <= easier_condition(small, t).mass <= mass
    solution = solve(small)
    assert solution.message


def test_continuation_on_a_stand_stays_within_its_limits():
    design = make_design(mu=0.3)
    stand = Stand(thrust=1.9e6)
    models = replace(design.models, trim="wind-tunnel")
    overloaded = replace(design, models=models, condition=replace(design.condition, stand=stand))
    assert overloaded.weight_coefficient / overloaded.rotor.solidity > LARGEST_CT_OVER_SIGMA
    solution = solve(overloaded)
    assert not solution.converged
    assert solution.message


def test_a_hopeless_design_ends_within_the_passes_allowed():
    solution = solve(HOPELESS)
    assert not solution.converged
    assert solution.passes <= DEFAULT_OPTIONS.most_passes + DEFAULT_OPTIONS.max_passes
    few = solve(HOPELESS, options=replace(DEFAULT_OPTIONS, most_passes=60))
    assert few.passes < solution.passes
    assert not few.converged


def test_a_solve_ends_when_it_is_told_to_stop():
    asked: list[int] = []

    def stop() -> bool:
        asked.append(1)
        return len(asked) > 1

    stopped = solve(HOPELESS, options=replace(DEFAULT_OPTIONS, stop=stop))
    assert not stopped.converged
    assert stopped.passes <= 2 * DEFAULT_OPTIONS.max_passes
    assert stopped.message
    assert len(asked) == 2
    easy = make_design(mu=0.2)
    assert solve(easy, options=replace(DEFAULT_OPTIONS, stop=lambda: True)).converged
