"""Schedules: properties of every schedule, and processes."""

import multiprocessing
import os
import signal
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import Design, Limits, make_design, solve
from rotor.optimisation import (
    CONCEPTS,
    Schedule,
    ScheduleOptimum,
    SchedulePlan,
    WeightedCondition,
    run_plan,
)
from rotor.optimisation.results import Minimum, SearchStatus
from tests.solved import SAME

NAMES = ("linear", "quadratic", "two-segment", "free-form")


def small() -> Design:
    return make_design(inflow="uniform", elements=20, azimuths=48)


def plan(
    *names: str,
    ratios: tuple[float, ...] = (0.0, 0.15, 0.3),
    hours: tuple[float, ...] = (1.0, 2.0, 1.0),
) -> SchedulePlan:
    design = small()
    conditions = tuple(
        WeightedCondition(replace(design.condition, advance_ratio=mu), hour)
        for mu, hour in zip(ratios, hours, strict=True)
    )
    return SchedulePlan(design, tuple(CONCEPTS[name] for name in names), conditions)


@pytest.fixture(scope="module")
def made() -> Schedule:
    return run_plan(plan(*NAMES))


def power(schedule: Schedule, condition: int | None, name: str) -> float:
    found = schedule.at(condition, name)
    return found.best.power


def test_variable_twist_is_never_worse_than_the_best_fixed_blade(made: Schedule):
    """Means by the hours 1, 2, 1."""
    assert made.complete
    assert made.converged
    assert [cell.condition for cell in made.cells] == [
        condition for condition in (0, 1, 2, None) for _ in NAMES
    ]
    for name in NAMES:
        worth = made.in_flight_gain(name)
        assert worth.moving <= worth.fixed * (1 + 1e-7) <= worth.baseline * (1 + 1e-7)
        assert_allclose(
            worth.moving,
            np.dot([0.25, 0.5, 0.25], [power(made, k, name) for k in range(3)]),
            rtol=1e-12,
        )
        fixed = made.at(None, name)
        for condition in range(3):  # In every condition by itself, too.
            design = replace(fixed.design, condition=made.plan.conditions[condition].flight)
            assert power(made, condition, name) <= solve(design).power.total * (1 + 1e-6)


def test_concepts_with_more_parameters_are_never_worse(made: Schedule):
    for condition in (0, 1, 2, None):
        for poor, rich in (
            ("linear", "quadratic"),
            ("linear", "two-segment"),
            ("quadratic", "free-form"),
        ):
            assert power(made, condition, rich) <= power(made, condition, poor) * (1 + 2e-6)
        # The envelope of all, but for the kink that a smooth curve rounds off.
        assert power(made, condition, "free-form") <= min(
            power(made, condition, name) for name in NAMES
        ) * (1 + 3e-4)


def test_variable_twist_saves_nothing_with_one_condition():
    alone = run_plan(plan("linear", ratios=(0.2,), hours=(1.0,)))
    worth = alone.in_flight_gain("linear")
    assert_allclose(worth.share, 0.0, atol=2e-6)


def same(a: Minimum | None, b: Minimum | None) -> None:
    assert (a.starts, a.active) == (b.starts, b.active)
    assert a.power == pytest.approx(b.power, rel=SAME)
    assert a.parameters == pytest.approx(b.parameters, rel=1e-9)


@pytest.mark.slow
def test_two_processes_give_the_same_result():
    twin = plan("linear", ratios=(0.1, 0.15, 0.2, 0.25, 0.3), hours=(1.0,) * 5)
    heard: list[ScheduleOptimum] = []
    here, there = run_plan(twin), run_plan(twin, keep=heard.append, processes=2)
    assert there.converged
    assert len(heard) == len(there.cells) == len(here.cells)
    for a, b in zip(here.cells, there.cells, strict=True):
        assert (a.condition, a.concept) == (b.condition, b.concept)
        same(a.optimum.best, b.optimum.best)


def test_results_are_kept_after_a_stop():
    heard: list[ScheduleOptimum] = []
    part = run_plan(plan("linear", "two-segment"), heard.append, lambda: len(heard) >= 3)
    assert not part.complete
    assert len(part.cells) == len(heard) >= 3
    assert part.in_flight_gain("linear") is None


@pytest.mark.slow
def test_a_lost_worker_is_reported_and_its_results_are_kept():
    killed: list[int] = []

    def kill(cell: ScheduleOptimum) -> None:
        for child in multiprocessing.active_children():
            if child.pid is not None and not killed:
                killed.append(child.pid)
                os.kill(child.pid, signal.SIGKILL)

    schedule = run_plan(plan("linear", ratios=tuple(0.1 + 0.01 * k for k in range(20)), hours=(1.0,) * 20),
                        keep=kill, processes=2)  # fmt: skip
    assert "worker process was lost" in schedule.message
    assert not schedule.complete
    assert schedule.cells


def test_a_condition_that_cannot_trim_is_reported():
    design = small()
    conditions = (
        WeightedCondition(design.condition),
        WeightedCondition(
            replace(design.condition, advance_ratio=0.0, mass=20000.0, altitude=4000.0)
        ),
    )
    schedule = run_plan(SchedulePlan(design, (CONCEPTS["linear"],), conditions, starts=1))
    assert schedule.complete
    assert not schedule.converged
    assert schedule.in_flight_gain("linear") is None
    bad = schedule.at(1, "linear")
    assert bad.status is SearchStatus.NOT_CONVERGED


def test_a_limit_of_the_index_needs_hub_loads_everywhere():
    with pytest.raises(ValueError, match="no vibration index"):
        replace(plan("linear"), limits=Limits(index=3.0))
    with pytest.raises(ValueError, match="compares powers"):
        replace(plan("linear"), quantity="vibration")
