"""The ladder from the preset `thesis` to `flight`: conditions that hold whatever the numbers are."""

import pytest
from numpy.testing import assert_allclose

from rotor.files.make_design import make_design
from rotor.trim.solve import solve
from rotor.validation.thesis.ladder import RUNGS, linear_optimum, moving_twist, rung_design


@pytest.mark.parametrize("mu", [0.0, 0.2, 0.35])
def test_the_ladder_begins_at_thesis_and_ends_at_flight(mu: float):
    thesis = make_design(preset="thesis", twist="linear:-16", mu=mu)
    assert_allclose(solve(rung_design((), mu)).require().power.total, solve(thesis).require().power.total, rtol=1e-12)
    assert rung_design(tuple(RUNGS), mu) == make_design(twist="linear:-16", mu=mu)


@pytest.mark.parametrize("name", RUNGS)
def test_each_rung_changes_something(name: str):
    """Each is a change of its own, by its power at µ 0.35 in the ladder."""
    place = tuple(RUNGS).index(name)
    before, after = (solve(rung_design(tuple(RUNGS)[: place + k], 0.35)).require().power.total for k in (0, 1))
    assert abs(after / before - 1.0) > 1e-4


@pytest.mark.slow
def test_the_best_twist_is_a_least_and_moving_saves_something():
    for count in range(len(RUNGS) + 1):
        on = tuple(RUNGS)[:count]
        assert -1e-9 <= moving_twist(on, (0.0, 0.35), None).gain < 0.02
        if count not in (0, 5, len(RUNGS)):
            continue
        best = linear_optimum(on, 0.35, None)  # Its band by trims of their own, without the search.
        edges = [
            solve(rung_design(on, 0.35, f"linear:{rate:.9f}")).require().power.total / 1e3 for rate in best.band_deg
        ]
        assert_allclose(edges, 1.001 * best.power_kw, rtol=2e-4)
