"""How far each start of a search is, and which is best."""

from dataclasses import replace
from typing import Any

import pytest

from explorer.model.units import SI
from explorer.tabs.optimise.search_run import SearchRequest, SearchRun, StartTrace, legs
from explorer.tabs.optimise.search_words import headline, power_axis, starts_chart
from rotor.files.make_design import make_design
from rotor.optimisation.search import Progress, run_search
from rotor.trim.solve import solve

UNIFORM = replace(make_design().models, inflow="uniform", elements=20, azimuths=36)
"""Quick, where the physics does not matter."""


def quick() -> Any:
    return make_design(twist="linear:-16", mu=0.3, models=UNIFORM)


@pytest.fixture(scope="module")
def begun() -> tuple[SearchRun, tuple[StartTrace, ...]]:
    """A finished search, and its starts when the second had just begun."""
    run = SearchRun(SearchRequest(concept="two-segment", starts=3).search(quick(), legs))
    run.state = "running"
    run.start_power = solve(quick()).power.total
    run._add(0, run.start_power, quick())
    halfway: list[tuple[StartTrace, ...]] = []

    def follow(progress: Any) -> None:
        run._step(progress)
        if progress.phase == "search" and progress.start == 1 and not halfway:
            halfway.append(run.starts())

    run.optimum = run_search(run.search, follow)
    run.state = "done"
    return run, halfway[0]


@pytest.fixture(scope="module")
def run(begun: tuple[SearchRun, tuple[StartTrace, ...]]) -> SearchRun:
    return begun[0]


def test_each_start_has_its_trace_and_running_best(run: SearchRun):
    starts = run.starts()
    assert len(starts) == 3
    for one in starts:
        assert len(one.best) == len(one.powers)
        assert list(one.best) == sorted(one.best, reverse=True)
        assert one.best[-1] == min(one.powers)
        assert one.state == "finished"


def test_the_best_start_has_the_power_of_the_optimum(run: SearchRun):
    (best,) = (one for one in run.starts() if one.is_best)
    assert run.optimum is not None
    assert run.optimum.best is not None
    assert best.best[-1] == pytest.approx(run.optimum.best.power, rel=1e-6)
    assert SI.watts(run.optimum.best.power, 1) in headline(run)
    equal = [one.number for one in run.starts() if one.gap is not None and one.gap < 50.0]
    one, several, every = f"start {best.number} is best", f"{len(equal)} of 3 starts are best", "all 3 starts agree"
    assert starts_chart(run, SI)["value"] == (one, several, every)[len(equal) - 1]


def test_half_way_the_second_start_runs_and_the_third_waits(begun: tuple[SearchRun, tuple[StartTrace, ...]]):
    starts = begun[1]
    assert [one.state for one in starts] == ["finished", "running", "waiting"]
    assert starts[2].gap is None
    assert starts[2].legend() == "Start 3: waiting"


def test_the_legend_names_the_best_start_and_the_gaps():
    """Behind by less than the last digit is equal: neither "+0.0 kW" nor a zero that looks like the best."""
    gaps = {400.0: "Start 2: +0.4 kW", 0.3: "Start 2: equal", 49.0: "Start 2: equal", 0.0: "Start 2: best"}
    for gap, words in gaps.items():
        assert StartTrace(2, (844.6e3,), (844.6e3,), "finished", gap).legend() == words
    assert StartTrace(3, (), (), "finished", None).legend() == "Start 3: no trim"


def test_the_axis_shows_the_ends_and_counts_what_it_clips(monkeypatch: pytest.MonkeyPatch):
    spike = StartTrace(1, (850e3, 2e6, 845e3), (850e3, 850e3, 845e3), "finished", 0.0)
    low, high = power_axis((spike,), 853e3)
    assert low < 845e3
    assert 853e3 < high < 1e6
    run = SearchRun(SearchRequest(starts=1).search(quick(), legs))
    monkeypatch.setattr(run, "starts", lambda: (spike,))
    assert starts_chart(run, SI)["note"] == "1 designs lie above the axis."


def test_a_design_beyond_a_limit_is_not_the_best():
    run = SearchRun(SearchRequest(starts=1).search(quick(), legs))
    step = Progress("search", 0, 1, 1, (0.0, 0.0, 0.5), "linear:0", 850e3, True, (0.0, 0.0, 0.5), 850e3, 0.1)
    run._add(0, 860e3, quick())
    run._step(step)
    run._step(replace(step, evaluation=2, power=800e3, feasible=False))
    assert run.starts()[0].powers == (850e3, 850e3)


def test_before_the_first_design():
    run = SearchRun(SearchRequest(starts=2).search(quick(), legs))
    assert headline(run) == ""
    assert [one.state for one in run.starts()] == ["waiting", "waiting"]
    assert power_axis(run.starts(), None) == (0.0, 1.0)
