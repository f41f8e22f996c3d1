"""How far each start of a search is, and which is best."""

from dataclasses import replace
from typing import Any

import pytest

from explorer.tabs.optimise import search_request as mission
from explorer.tabs.optimise.run import (
    SearchRun,
    Start,
    Starts,
    starts_of,
)
from explorer.tabs.optimise.search_request import SearchRequest
from rotor.files.make_design import make_design
from rotor.optimisation.search import Progress, run_search
from rotor.trim.solve import solve

UNIFORM = replace(make_design().models, inflow="uniform", elements=20, azimuths=36)
"""Quick, where the physics does not matter."""


def quick() -> Any:
    return make_design(twist="linear:-16", mu=0.3, models=UNIFORM)


@pytest.fixture(scope="module")
def begun() -> tuple[SearchRun, Starts]:
    """A finished search, and its starts when the second had just begun."""
    run = SearchRun(SearchRequest(concept="two-segment", starts=3).search(quick(), mission.legs))
    run.state = "running"
    run.start_power = solve(quick()).power.total
    run._add(0, run.start_power, quick())
    halfway: list[Starts] = []

    def take(progress: Any) -> None:
        run._step(progress)
        if progress.phase == "search" and progress.start == 1 and not halfway:
            halfway.append(starts_of(run))

    run.optimum = run_search(run.search, take)
    run.state = "done"
    return run, halfway[0]


@pytest.fixture(scope="module")
def run(begun: tuple[SearchRun, Starts]) -> SearchRun:
    return begun[0]


class TestStarts:
    def test_each_start_has_its_trace_and_running_best(self, run: SearchRun):
        starts = starts_of(run)
        assert len(starts.each) == 3
        for one in starts.each:
            assert len(one.best) == len(one.powers)
            assert list(one.best) == sorted(one.best, reverse=True)
            assert one.best[-1] == min(one.powers)
            assert one.state == "finished"

    def test_the_best_start_has_the_power_of_the_optimum(self, run: SearchRun):
        starts = starts_of(run)
        assert run.optimum is not None
        assert run.optimum.best is not None
        assert starts.best_power == pytest.approx(run.optimum.best.power, rel=1e-6)
        assert starts.best_start is not None
        assert starts.best_start.best[-1] == starts.best_power
        assert starts.change == pytest.approx(run.optimum.best.power - solve(quick()).power.total, rel=1e-3)
        assert starts.change is not None
        assert starts.change < 0.0
        assert starts.evaluations == run.optimum.evaluations

    def test_half_way_the_second_start_runs_and_the_third_waits(self, begun: tuple[SearchRun, Starts]):
        starts = begun[1]
        assert [one.state for one in starts.each] == ["finished", "running", "waiting"]
        assert starts.each[2].gap is None
        assert starts.each[2].legend() == "Start 3: waiting"

    def test_a_start_that_is_behind_by_less_than_the_last_digit_is_equal(self):
        """Neither "+0.0 kW" nor a zero that looks like the best."""
        for gap in (0.3, 49.0):
            assert Start(2, (844.6e3,), (844.6e3,), "finished", gap).legend() == "Start 2: equal"

    def test_the_legend_names_the_best_start_and_the_gaps(self):
        each = (
            Start(1, (850e3, 845e3), (850e3, 845e3), "finished", 400.0),
            Start(2, (848e3, 844.6e3), (848e3, 844.6e3), "running", 0.0),
            Start(3, (), (), "finished", None),
        )
        assert [one.legend() for one in each] == ["Start 1: +0.4 kW", "Start 2: best", "Start 3: no trim"]
        starts = Starts(each, 853.7e3, 844.6e3, 4)
        assert starts.headline() == "844.6 kW, −9.1 kW vs. starting design"
        assert starts.best_start is each[1]

    def test_the_axis_shows_the_ends_and_counts_what_it_clips(self):
        spike = Start(1, (850e3, 2e6, 845e3), (850e3, 850e3, 845e3), "finished", 0.0)
        starts = Starts((spike,), 853e3, 845e3, 3)
        low, high = starts.axis()
        assert low < 845e3
        assert 853e3 < high < 1e6
        assert starts.above_axis() == 1

    def test_a_design_beyond_a_limit_is_not_the_best(self):
        run = SearchRun(SearchRequest(starts=1).search(quick(), mission.legs))
        step = Progress("search", 0, 1, 1, (0.0, 0.0, 0.5), "linear:0", 850e3, True, (0.0, 0.0, 0.5), 850e3, 0.1)
        run._add(0, 860e3, quick())
        run._step(step)
        run._step(replace(step, evaluation=2, power=800e3, feasible=False))
        assert starts_of(run).best_power == 850e3
        assert starts_of(run).each[0].powers == (850e3, 850e3)

    def test_before_the_first_design(self):
        run = SearchRun(SearchRequest(starts=2).search(quick(), mission.legs))
        starts = starts_of(run)
        assert starts.headline() == "Trimming the starting design …"
        assert [one.state for one in starts.each] == ["waiting", "waiting"]
        assert starts.best_start is None
        assert starts.change is None
        assert starts.axis() == (0.0, 1.0)
