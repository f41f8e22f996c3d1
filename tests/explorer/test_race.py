"""The race of a search's starts."""

from dataclasses import replace
from typing import Any

import pytest

from explorer.tabs.optimise import search_request as mission
from explorer.tabs.optimise.run import (
    Race,
    RaceStart,
    SearchRun,
    race_of,
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
def raced() -> tuple[SearchRun, Race]:
    """A finished search, and its race when the second start had just begun."""
    run = SearchRun(SearchRequest(concept="two-segment", starts=3).search(quick(), mission.legs))
    run.state = "running"
    run.start_power = solve(quick()).power.total
    run._add(0, run.start_power, quick())
    halfway: list[Race] = []

    def take(progress: Any) -> None:
        run._step(progress)
        if progress.phase == "search" and progress.start == 1 and not halfway:
            halfway.append(race_of(run))

    run.optimum = run_search(run.search, take)
    run.state = "done"
    return run, halfway[0]


@pytest.fixture(scope="module")
def run(raced: tuple[SearchRun, Race]) -> SearchRun:
    return raced[0]


class TestRace:
    def test_each_start_has_its_trace_and_running_best(self, run: SearchRun):
        race = race_of(run)
        assert len(race.starts) == 3
        for one in race.starts:
            assert len(one.best) == len(one.powers)
            assert list(one.best) == sorted(one.best, reverse=True)
            assert one.best[-1] == min(one.powers)
            assert one.state == "finished"

    def test_the_leader_has_the_power_of_the_optimum(self, run: SearchRun):
        race = race_of(run)
        assert run.optimum is not None
        assert run.optimum.best is not None
        assert race.best_power == pytest.approx(run.optimum.best.power, rel=1e-6)
        assert race.leader is not None
        assert race.leader.best[-1] == race.best_power
        assert race.change == pytest.approx(run.optimum.best.power - solve(quick()).power.total, rel=1e-3)
        assert race.change is not None
        assert race.change < 0.0
        assert race.evaluations == run.optimum.evaluations

    def test_half_way_the_second_start_runs_and_the_third_waits(self, raced: tuple[SearchRun, Race]):
        race = raced[1]
        assert [one.state for one in race.starts] == ["finished", "running", "waiting"]
        assert race.starts[2].gap is None
        assert race.starts[2].legend() == "Start 3: waiting"

    def test_a_start_that_is_behind_by_less_than_the_last_digit_is_equal(self):
        """Neither "+0.0 kW" nor a zero that looks like a lead."""
        for gap in (0.3, 49.0):
            assert RaceStart(2, (844.6e3,), (844.6e3,), "finished", gap).legend() == "Start 2: equal"

    def test_the_legend_names_the_leader_and_the_gaps(self):
        starts = (
            RaceStart(1, (850e3, 845e3), (850e3, 845e3), "finished", 400.0),
            RaceStart(2, (848e3, 844.6e3), (848e3, 844.6e3), "running", 0.0),
            RaceStart(3, (), (), "finished", None),
        )
        assert [one.legend() for one in starts] == ["Start 1: +0.4 kW", "Start 2: leads", "Start 3: no trim"]
        race = Race(starts, 853.7e3, 844.6e3, 4)
        assert race.headline() == "844.6 kW, −9.1 kW vs. starting design"
        assert race.leader is starts[1]

    def test_the_axis_shows_the_ends_and_counts_what_it_clips(self):
        spike = RaceStart(1, (850e3, 2e6, 845e3), (850e3, 850e3, 845e3), "finished", 0.0)
        race = Race((spike,), 853e3, 845e3, 3)
        low, high = race.axis()
        assert low < 845e3
        assert 853e3 < high < 1e6
        assert race.above_axis() == 1

    def test_a_design_beyond_a_limit_leads_nobody(self):
        run = SearchRun(SearchRequest(starts=1).search(quick(), mission.legs))
        step = Progress("search", 0, 1, 1, (0.0, 0.0, 0.5), "linear:0", 850e3, True, (0.0, 0.0, 0.5), 850e3, 0.1)
        run._add(0, 860e3, quick())
        run._step(step)
        run._step(replace(step, evaluation=2, power=800e3, feasible=False))
        assert race_of(run).best_power == 850e3
        assert race_of(run).starts[0].powers == (850e3, 850e3)

    def test_before_the_first_design(self):
        run = SearchRun(SearchRequest(starts=2).search(quick(), mission.legs))
        race = race_of(run)
        assert race.headline() == "Trimming the starting design …"
        assert [one.state for one in race.starts] == ["waiting", "waiting"]
        assert race.leader is None
        assert race.change is None
        assert race.axis() == (0.0, 1.0)
