"""What is shown of a solution is worked out when it is read, the same whenever, wherever and from whatever that is."""

import pickle
from concurrent.futures import ThreadPoolExecutor
from dataclasses import astuple
from typing import Any

import numpy as np
import pytest

from rotor import Solution, make_design, optimise, solve, solve_many
from rotor.trim import SolverOptions, analyse
from rotor.trim import assemble as assembling
from rotor.trim.reach import SHARE_ERROR
from tests.solved import SAME

FIELDS = ("theta", "u_p", "induced", "alpha", "cl", "cd", "stall_margin", "dct", "dcq", "dcr")


@pytest.mark.parametrize(
    "case",
    [
        {"mu": 0.3, "mass_kg": 11_000.0}, {"mu": 0.3, "bending": True}, {"mu": 0.04}, {"mu": 0.2, "inflow": "drees"},
        {"mu": 0.2, "trim": "wind-tunnel", "stand": {"ct_over_sigma": 0.07, "shaft_tilt_deg": -4.0}},
        {"mu": 0.4, "mass_kg": 14_000.0}, {"mu": 0.0},
    ],
    ids=lambda case: ", ".join(f"{name} {value}" for name, value in case.items()),
)  # fmt: skip
def test_a_light_solution_shows_the_same_from_less_than_50_kb(case: dict[str, Any]) -> None:
    full = analyse(make_design(**case), options=SolverOptions(remedy=False)).solution
    small = pickle.dumps(full.light())
    assert len(small) < 50_000
    light: Solution = pickle.loads(small)
    exact = 0.0 if case["mu"] else 10.0 * SAME  # Hover is iterated once more.
    for name in FIELDS:
        wanted = getattr(full.disk, name)
        np.testing.assert_allclose(
            getattr(light.disk, name), wanted, rtol=0.0, atol=exact * np.abs(wanted).max()
        )
    assert astuple(light.regions) == pytest.approx(astuple(full.regions), rel=exact, abs=exact)
    assert light.caveats == full.caveats
    if full.elastic is not None and light.elastic is not None:
        np.testing.assert_allclose(
            light.elastic.control_moment, full.elastic.control_moment, rtol=exact
        )


def test_threads_that_read_at_once_read_the_same() -> None:
    solution = solve(make_design(mu=0.3, mass_kg=11_000.0))
    with ThreadPoolExecutor(4) as pool:
        read = [
            *pool.map(
                lambda one: (one.stalled_area, one.disk.alpha.tobytes(), one.caveats),
                [solution] * 8,
            )
        ]
    assert all(one == read[0] for one in read)


def test_what_is_shown_of_a_trim_takes_no_second_problem(monkeypatch: pytest.MonkeyPatch) -> None:
    solution = solve(make_design(mu=0.3, mass_kg=11_000.0))
    monkeypatch.setattr("rotor.trim.analysis.problem_of", None)
    assert solution.stalled_area > 0.0
    assert solution.caveats
    with pytest.raises(TypeError):
        _ = solution.light().shown


def test_searches_and_many_trims_make_no_fields(monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[Solution] = []
    make = assembling.shown_of
    monkeypatch.setattr(
        assembling, "shown_of", lambda solution: made.append(solution) or make(solution)
    )
    many = solve_many(make_design(mu=0.2, twist=f"linear:{rate}") for rate in (-8, -10))
    assert optimise(make_design(mu=0.2, inflow="uniform"), "linear", starts=1).evaluations > 2
    assert made == []
    assert many[0].stalled_area >= 0.0
    assert len(made) == 1


def test_the_azimuths_of_the_trim_tell_how_much_is_stalled() -> None:
    shares: list[float] = []
    for rate, mu, heavier in (
        (0, 0.36, 1.2),
        (-4, 0.43, 1.1),
        (-8, 0.4, 1.3),
        (-12, 0.45, 1.3),
        (-16, 0.3, 1.5),
    ):
        design = make_design(mu=mu, twist=f"linear:{rate}")
        trim = analyse(
            design.at(mass_kg=heavier * design.condition.mass), options=SolverOptions(remedy=False)
        )
        assert abs(trim.linear.stalled_moment - trim.solution.stalled_moment) < 0.5 * SHARE_ERROR
        shares.append(trim.solution.stalled_moment)
    assert min(shares) < 0.2 < 0.25 < max(shares)
