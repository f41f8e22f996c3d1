"""The search: the global minimum by brute force, limits, bands, seeds, stopping."""

import math
import pickle
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import Design, hub_loads, make_design, solve
from rotor.aero.problem import build_problem
from rotor.design.twist import LinearTwist
from rotor.optimisation.concepts import CONCEPTS, Concept, find_concept
from rotor.optimisation.limits import ChangeLimit, Limits, even_change_limit
from rotor.optimisation.objective import (
    POWERS,
    Objective,
    Quantity,
    WeightedCondition,
    at_condition,
    evaluate_objective,
    hover_and_cruise,
)
from rotor.optimisation.results import Minimum, Optimum, Progress, SearchStatus
from rotor.optimisation.search import STARTS, Search, run_search
from rotor.trim.newton import SolverOptions

DEGREE = math.radians(1.0)


def small(mu: float, twist: str | None = None) -> Design:
    design = make_design(mu=mu, twist=twist)
    return replace(design, models=replace(design.models, elements=20, azimuths=48))


def searched(
    design: Design,
    concept: Concept | str = "linear",
    objective: Objective | None = None,
    **choices: Any,
) -> tuple[Optimum, Minimum]:
    """From two starts and without the band, unless asked for; it has a best."""
    family = CONCEPTS[concept] if isinstance(concept, str) else concept
    found = run_search(Search(design, family, objective, **{"starts": 2, "band": False} | choices))
    assert found.best is not None
    return found, found.best


def grid_powers(design: Design, concept_name: str, *axes: np.ndarray) -> np.ndarray:
    """Total power on a grid of parameters; infinite where nothing trims."""
    concept = CONCEPTS[concept_name]
    out = np.full([len(axis) for axis in axes], np.inf)
    start = None
    for place in np.ndindex(out.shape):
        values = np.array([axis[k] for axis, k in zip(axes, place, strict=True)])
        solution = solve(concept.apply(design, values), start, SolverOptions(remedy=False))
        if solution.converged:
            out[place], start = solution.power.total, solution
    return out


def test_the_free_division_is_no_worse_than_any_fixed_one():
    """A movable break makes many local minima; the usual number of starts finds the best."""
    design = small(0.1)
    _, free = searched(design, "two-segment-free", starts=STARTS)
    for division in np.arange(0.30, 0.91, 0.1).tolist():
        _, fixed = searched(design, find_concept("two-segment", [division]), starts=1)
        assert free.power <= fixed.power * (1.0 + 1e-6)


@pytest.mark.slow
@pytest.mark.parametrize(
    "mu", [0.0, *(pytest.param(mu, marks=pytest.mark.nightly) for mu in (0.1, 0.2, 0.3)), 0.35]
)
def test_no_point_of_a_fine_grid_is_better(mu: float):
    design = make_design(mu=mu)
    powers = grid_powers(design, "linear", np.radians(np.arange(-30.0, 10.01, 0.1)))
    _, linear = searched(design, starts=STARTS)
    assert linear.power <= powers.min() * (1.0 + 1e-7)
    assert_allclose(linear.power, powers.min(), rtol=1e-5)
    axis = np.radians(np.arange(-30.0, 10.1, 1.0))
    powers = grid_powers(design, "two-segment", axis, axis)
    found, two = searched(design, "two-segment", starts=8, band=True)
    assert two.power <= powers.min() * (1.0 + 1e-7)
    assert_allclose(two.power, powers.min(), rtol=1e-4)
    # The band on the same grid: the outermost points inside 0.1 %, others free.
    inside = powers <= two.power * 1.001
    for axis_number, band in enumerate(found.band):
        reached = axis[inside.any(axis=1 - axis_number)]
        assert band.low - 0.1 * DEGREE <= reached.min() <= band.low + 1.5 * DEGREE
        assert band.high - 1.5 * DEGREE <= reached.max() <= band.high + 0.1 * DEGREE


def test_band_in_one_variable_is_where_the_power_is_a_thousandth_higher():
    design = small(0.25)
    found, best = searched(design, band=True)
    (band,) = found.band
    assert band.low < best.parameters[0] < band.high
    for rate in (band.low, band.high):
        power = solve(replace(design, twist=LinearTwist(rate))).power.total
        assert_allclose(power / best.power - 1.0, 1e-3, atol=5e-5)


@pytest.mark.slow
def test_the_same_seed_gives_the_same_search():
    search = Search(small(0.2), CONCEPTS["two-segment"], starts=3, seed=4)
    searches = search, pickle.loads(pickle.dumps(search)), replace(search, seed=5)
    first, again, other = (replace(run_search(one), elapsed=0.0) for one in searches)
    assert first == again
    # The same minimum from elsewhere.
    assert_allclose(other.best.power, first.best.power, rtol=1e-6)


def test_bounds_rate_and_change_limits_are_kept():
    design = small(0.25, "linear:-8")
    for limits, active in (
        (Limits(bounds=(("rate", -6 * DEGREE, 2 * DEGREE),)), "rate low"),
        (Limits(rate=(-5 * DEGREE, 0.0)), "rate"),
        (Limits(change=even_change_limit(design.twist, 2.0 * DEGREE)), "change"),
    ):
        found, best = searched(design, limits=limits, band=True)
        assert found.status is SearchStatus.CONVERGED
        assert active in best.active
        if active == "change":
            # The optimum lies beyond −11°/R; two degrees from the cut-out (0.1304 R) to the tip are 2.3 °/R.
            assert_allclose(math.degrees(best.parameters[0]), -8.0 - 2.0 / 0.8696, atol=0.01)
            assert math.degrees(found.band[0].low) >= -8.0 - 2.0 / 0.8696 - 0.01


@pytest.mark.parametrize("name", ["three-segment", "free-form"])
def test_rate_limit_is_kept_on_every_segment_and_along_a_spline(name: str):
    _, best = searched(small(0.1), name, limits=Limits(rate=(-15 * DEGREE, -5 * DEGREE)))
    rates = np.degrees(np.array(CONCEPTS[name].rate_rows) @ best.parameters)
    assert rates.min() >= -15.0 - 0.01
    assert rates.max() <= -5.0 + 0.01


def test_change_limit_may_vary_along_the_blade():
    """Nothing may move inboard of 0.6 R, a degree at the tip."""
    design, r = small(0.25, "linear:-8"), np.linspace(0.14, 1.0, 44)
    limit = ChangeLimit(design.twist, (0.6, 1.0), (0.0, DEGREE))
    found, _ = searched(design, find_concept("two-segment", [0.6]), limits=Limits(change=limit))
    change = np.degrees(found.design.twist(r) - design.twist(r))
    change = np.abs(change - change[0])
    assert change[r < 0.6].max() < 0.01
    assert 0.9 < change.max() <= 1.01


def test_stalled_area_limit_is_kept():
    """At µ 0.36 the best linear twist leaves more of the disk stalled than the limit; the limit costs power."""
    design = small(0.36)

    def stalled(twisted: Design) -> float:
        return (
            evaluate_objective(at_condition(design), twisted, limits=Limits(stalled=1.0)).limited[0]
            / 100.0
        )

    free, best = searched(design, "two-segment")
    limit = 0.9 * stalled(free.design)
    held, calm = searched(design, "two-segment", limits=Limits(stalled=limit), starts=3)
    assert "area past the static angle" in calm.active
    assert stalled(held.design) <= limit + 2e-5
    assert calm.power > best.power


def test_progress_reports_every_evaluation_and_the_best_never_increases():
    heard: list[Progress] = []
    found = run_search(Search(small(0.2), CONCEPTS["two-segment"], starts=3), heard.append)
    # 1: the baseline.
    assert [progress.evaluation for progress in heard] == list(range(2, found.evaluations + 1))
    best = [progress.best_power for progress in heard if progress.best_power is not None]
    assert all(later <= earlier for earlier, later in pairwise(best))
    assert {progress.phase for progress in heard} == {"search", "band"}
    assert {progress.start for progress in heard} == {0, 1, 2}
    assert pickle.loads(pickle.dumps(heard[0])) == heard[0]
    assert_allclose(found.best.power, best[-1], rtol=1e-7)


@pytest.mark.parametrize("after", [1, 11, 30])
def test_stopping_keeps_the_best_so_far(after: int):
    heard: list[Progress] = []
    found = run_search(
        Search(small(0.2), CONCEPTS["free-form"]), heard.append, lambda: len(heard) >= after
    )
    assert found.status is SearchStatus.STOPPED
    assert len(heard) == after
    assert_allclose(
        found.best.power, min(progress.power or math.inf for progress in heard), rtol=1e-9
    )
    assert "Stopped" in found.message
    none = run_search(Search(small(0.2), CONCEPTS["linear"]), None, lambda: True)
    assert (none.status, none.best, none.minima, none.saving) == (
        SearchStatus.STOPPED,
        None,
        (),
        None,
    )


@pytest.mark.parametrize(
    ("design", "limits", "words"),
    [
        (
            small(0.2).at(mu=0.0, mass_kg=20000.0, altitude_m=4000.0),
            Limits(),
            "No starting point has a trim",
        ),
        (small(0.36), Limits(stalled=1e-4), "limits"),  # That no blade can keep.
    ],
)
def test_a_search_without_a_result_says_why(design: Design, limits: Limits, words: str):
    found = run_search(Search(design, CONCEPTS["linear"], limits=limits, starts=1))
    assert (found.status, found.best, found.band) == (SearchStatus.NOT_CONVERGED, None, ())
    assert words in found.message


@pytest.mark.slow
def test_starts_that_do_not_trim_do_not_end_the_search():
    """At µ 0.4 and 9.3 t strong untwist does not trim: the search avoids it."""
    design = small(0.4).at(mass_kg=9300.0)
    _, best = searched(design, starts=4)
    assert best.power <= grid_powers(
        design, "linear", np.radians(np.arange(-28.0, 9.0, 2.0))
    ).min() * (1 + 1e-5)


@pytest.mark.parametrize("quantity", POWERS)
def test_mission_optimum_is_between_those_of_its_conditions(quantity: Quantity):
    design = small(0.2)
    conditions = tuple(
        WeightedCondition(replace(design.condition, advance_ratio=mu)) for mu in (0.1, 0.3)
    )
    alone = [
        searched(design, "linear", Objective(quantity, (condition,)))[1] for condition in conditions
    ]
    _, both = searched(design, "linear", Objective(quantity, conditions))
    rates = [one.parameters[0] for one in alone]
    assert min(rates) <= both.parameters[0] <= max(rates)
    assert both.power >= sum(one.power for one in alone) / 2 - 1.0


class TestVibration:
    """The index of the hub loads as objective and limit."""

    TIGHT = SolverOptions(residual_tolerance=1e-12, inflow_tolerance=1e-10, torsion_tolerance=1e-12)

    @staticmethod
    def bent(mu: float, twist: str | None = None) -> Design:
        return make_design(mu=mu, twist=twist, inflow="pitt-peters", bending=True)

    @pytest.mark.parametrize("quantity", ["vibration", "total"])
    def test_gradients_over_two_conditions(self, quantity: Quantity):
        """Slopes of objective and limits by twist in two segments, against differences of tight trims."""
        concept, design, held = (
            CONCEPTS["two-segment"],
            self.bent(0.3),
            Limits(index=3.0, stalled=0.1),
        )
        conditions = tuple(
            WeightedCondition(self.bent(mu).condition, hours)
            for mu, hours in ((0.25, 2.0), (0.33, 1.0))
        )
        objective, values, step = (
            Objective(quantity, conditions),
            np.radians([-8.0, -11.0]),
            math.radians(0.05),
        )
        found = evaluate_objective(
            objective, concept.apply(design, values), limits=held, options=self.TIGHT
        )
        assert found.by_pitch is not None
        slopes = concept.slopes(values, build_problem(design).disk.r)
        for k, along in enumerate(np.eye(2)):
            low, high = (
                evaluate_objective(
                    objective,
                    concept.apply(design, values + sign * step * along),
                    limits=held,
                    options=self.TIGHT,
                )
                for sign in (-1.0, 1.0)
            )
            assert high.value is not None
            assert low.value is not None
            assert_allclose(
                slopes[k] @ found.by_pitch, (high.value - low.value) / (2.0 * step), rtol=1e-3
            )
            expected = (np.array(high.limited) - np.array(low.limited)) / (2.0 * step)
            assert_allclose(found.limited_by_pitch[2:] @ slopes[k], expected[2:], rtol=1e-3)
        assert found.index is not None
        assert_allclose(found.index, (2.0 * found.limited[2] + found.limited[3]) / 3.0, rtol=1e-12)

    def test_least_index(self):
        """No linear twist of a grid has less, and the power beside it is that of the trim."""
        design = self.bent(0.3)
        found, best = searched(
            design, "linear", at_condition(design, "vibration"), starts=3, band=True
        )
        assert found.status is SearchStatus.CONVERGED
        assert best.index is not None
        for rate in np.arange(-20.0, 6.0, 2.5).tolist():
            loads = hub_loads(solve(self.bent(0.3, f"linear:{rate:g}")).require(), band=False)
            assert loads.index > best.index
        assert_allclose(solve(found.design).power.total, best.power, rtol=1e-6)
        assert found.baseline_index is not None
        assert found.baseline_index > best.index
        (band,) = found.band
        assert band.low < best.parameters[0] < band.high

    def test_limit_is_kept_and_costs_power(self):
        design = self.bent(0.35)
        _, free = searched(design, limits=Limits(index=1e3))
        assert free.index is not None
        limit = 0.8 * free.index
        held, calm = searched(design, limits=Limits(index=limit))
        assert "vibration index" in calm.active
        loads = hub_loads(solve(held.design).require(), band=False)
        assert_allclose(loads.index, limit, rtol=1e-3)
        assert calm.power > free.power

    def test_conditions_without_hub_loads_are_refused_before_the_search(self):
        design, both = self.bent(0.3), hover_and_cruise(self.bent(0.3), 0.5, 0.3)
        search = Search(design, CONCEPTS["linear"])
        for change, words in (
            (
                {"objective": at_condition(design.at(mu=0.1), "vibration")},
                "advance ratio 0.1.*below µ 0.2",
            ),
            ({"objective": both, "limits": Limits(index=3.0)}, "advance ratio 0 .*below µ 0.2"),
            ({"design": make_design(mu=0.3), "limits": Limits(index=3.0)}, "--bending"),
            (
                {"design": make_design(rotor="r22", mu=0.25), "limits": Limits(index=3.0)},
                "not known",
            ),
        ):
            with pytest.raises(ValueError, match=words):
                replace(search, **change)
