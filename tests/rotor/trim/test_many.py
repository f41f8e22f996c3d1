"""Many designs at once: each has the answer that it has alone, whatever the others are."""

from collections.abc import Sequence

import numpy as np
import pytest

import rotor
from rotor import Design, Solution, make_design, solve, solve_many
from rotor.engine import lockstep
from rotor.trim import SolverOptions, analyse, analyse_many, power_gradient
from tests.solved import SAME

RATES = (-16.0, -13.5, -12.0, -9.0, -7.0, -4.0)
TWISTED = [make_design(mu=0.25, twist=f"linear:{rate}") for rate in RATES]
ACTIVE = [make_design(mu=0.25, twist_per_rev=f"2:1:{phase}") for phase in (0, 90, 180)]
BENT = [make_design(mu=0.3, bending=True, twist=f"linear:{rate}") for rate in (-10, -14)]
STALLED = [make_design(mu=0.42, mass_kg=11_500, twist=twist) for twist in ("linear:0", "linear:-2")]
BATCH = [
    make_design(mu=0.0),
    make_design(mu=0.05, twist="linear:-8"),
    make_design(mu=0.05, twist="linear:-9"),
    make_design(mu=0.2, inflow="uniform"),
    make_design(mu=0.2, inflow="uniform", twist="linear:-8"),
    make_design(mu=0.05, climb_m_s=-8.0, twist="linear:-8"),
    make_design(mu=0.05, climb_m_s=-8.0, twist="linear:-9"),
    make_design(rotor="bo105", mu=0.25),
]


def same(found: Sequence[Solution], wanted: Sequence[Solution]) -> None:
    for ours, theirs in zip(found, wanted, strict=True):
        assert ours.design == theirs.design
        assert (ours.status, ours.message, ours.passes) == (
            theirs.status,
            theirs.message,
            theirs.passes,
        )
        assert ours.controls.array() == pytest.approx(theirs.controls.array(), rel=SAME, abs=SAME)
        assert ours.last_power.total == pytest.approx(theirs.last_power.total, rel=SAME)
        assert ours.disk.alpha == pytest.approx(theirs.disk.alpha, rel=0, abs=1e-11)


@pytest.mark.parametrize("designs", [BENT, STALLED])
def test_designs_of_one_condition_have_their_own_answers(designs: list[Design]):
    same(solve_many(designs), [solve(design) for design in designs])


def test_the_answer_depends_on_no_other_design():
    mixed = [*TWISTED, *ACTIVE, *BATCH]
    alone = [solve(design) for design in mixed]
    order = np.random.default_rng(3).permutation(len(mixed)).tolist()
    same(solve_many(mixed[k] for k in order), [alone[k] for k in order])
    same([*solve_many(mixed[:4]), *solve_many(mixed[4:])], alone)


def test_trims_in_step_have_all_that_a_gradient_needs():
    start = solve(TWISTED[2])
    for trim, design in zip(analyse_many(TWISTED, [start] * len(TWISTED)), TWISTED, strict=True):
        wanted = power_gradient(analyse(design, start)).by_element
        assert trim.gradient.by_element == pytest.approx(
            wanted, rel=1e-7, abs=1e-7 * np.abs(wanted).max()
        )


def test_designs_are_in_step_and_one_that_does_not_follow_leaves(monkeypatch: pytest.MonkeyPatch):
    taken: list[list[bool]] = []
    together = lockstep.solve_together

    def watched(*args: object) -> list[object]:
        found = together(*args)  # type: ignore[arg-type]
        taken.append([each is not None for each in found])
        return [None, *found[1:]]

    monkeypatch.setattr("rotor.trim.newton.solve_together", watched)
    same(solve_many(TWISTED), [solve(design) for design in TWISTED])
    assert taken == [[True] * len(TWISTED)]


def test_what_is_no_design_is_refused_and_a_stop_is_heeded():
    assert solve_many([]) == []
    with pytest.raises(TypeError, match=r"rotor\.make_design"):
        rotor.solve_many([TWISTED[0], "uh60a"])  # type: ignore[list-item]
    hopeless = [
        make_design(mu=0.42, mass_kg=14_000, twist=twist) for twist in ("linear:0", "linear:-4")
    ]
    stopped = solve_many(hopeless, SolverOptions(stop=lambda: True))
    assert not any(solution.converged for solution in stopped)
    assert all(solution.passes <= 3 * SolverOptions().max_passes for solution in stopped)
