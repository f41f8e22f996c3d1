"""What the optimiser's tabs show, without a browser: runs, charts, maps, drawings and words."""

import math
import xml.etree.ElementTree as ET
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from explorer.charts.strip import LOOKS
from explorer.model.inputs import baseline_of
from explorer.model.units import SI
from explorer.picture.landscape import refined
from explorer.tabs.optimise import map_panel as power_map
from explorer.tabs.optimise import search_run as mission
from explorer.tabs.optimise import search_words as search_text
from explorer.tabs.optimise.map_panel import default_axes
from explorer.tabs.optimise.search_run import OBJECTIVES, SearchFrame, SearchRequest, SearchRun, StartTrace
from explorer.tabs.optimise.search_words import concept_picture, starts_chart
from explorer.workers.solver import MapLevel, MapTask, SearchTask
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import CONCEPTS
from rotor.optimisation.objective import at_condition
from rotor.optimisation.results import Progress
from rotor.optimisation.results import SearchStatus as Status
from rotor.processes import JobEnded, JobFailed, JobProgress, JobQueued, JobStarted
from rotor.trim.solve import solve
from tests.curves import curves

UNIFORM = replace(make_design().models, inflow="uniform", elements=20, azimuths=36)
"""Quick, where the physics does not matter."""


def quick(twist: str = "linear:-16", mu: float = 0.3) -> Any:
    return make_design(twist=twist, mu=mu, models=UNIFORM)


def no_stop() -> bool:
    return False


@pytest.fixture(scope="module")
def searched() -> tuple[SearchRun, tuple[StartTrace, ...]]:
    """A search run here, its news heard as from a process; and its starts when the second had just begun."""
    run = SearchRun(SearchRequest(concept="two-segment", starts=3).search(quick(), mission.legs), "UH-60A as built")
    halfway: list[tuple[StartTrace, ...]] = []

    def tell(item: object) -> None:
        run.on_event(JobProgress(item))
        if isinstance(item, Progress) and item.phase == "search" and item.start == 1 and not halfway:
            halfway.append(run.starts())

    run.on_event(JobStarted())
    run.on_event(JobEnded(SearchTask(run.search, baseline_of(quick())).run(tell, no_stop)))
    return run, halfway[0]


@pytest.fixture
def run(searched: tuple[SearchRun, tuple[StartTrace, ...]]) -> SearchRun:
    return searched[0]


class TestSearchRun:
    def test_frames_lead_from_the_start_to_the_optimum(self, run: SearchRun):
        assert run.state == "done"
        assert run.frames[0].design == run.search.design
        powers = [frame.power for frame in run.frames[1:-1]]
        assert powers == sorted(powers, reverse=True)
        assert run.optimum is not None
        assert run.optimum.status is Status.CONVERGED
        assert run.frames[-1].design == run.optimum.design

    def test_every_frame_has_the_power_that_is_said(self, run: SearchRun):
        for frame in (run.frames[0], run.frames[len(run.frames) // 2], run.frames[-1]):
            assert solve(frame.design).power.total == pytest.approx(frame.power, rel=1e-7)

    def test_baseline_and_start_are_measured(self, run: SearchRun):
        assert run.start_power == pytest.approx(solve(run.search.design).power.total, rel=1e-9)
        assert run.reference_power == pytest.approx(solve(baseline_of(run.search.design)).power.total, rel=1e-9)

    def test_playing_shows_each_frame_and_ends_with_the_last(self, run: SearchRun, monkeypatch: pytest.MonkeyPatch):
        now = 100.0
        monkeypatch.setattr("explorer.tabs.optimise.search_run.time.monotonic", lambda: now)
        run.replay()
        seen = []
        for _ in range(10 * len(run.frames)):
            frame = run.shown()
            if not seen or seen[-1] is not frame:
                seen.append(frame)
            now += 0.05
        assert [frame for frame in run.frames if frame in seen] == run.frames
        assert not run.playing
        run.scrub(0)
        assert run.shown() is run.frames[0]
        run.scrub(10_000)
        assert run.shown() is run.frames[-1]

    def test_while_it_runs_the_picture_does_not_fall_far_behind(self, monkeypatch: pytest.MonkeyPatch):
        now = 100.0
        monkeypatch.setattr("explorer.tabs.optimise.search_run.time.monotonic", lambda: now)
        run = SearchRun(SearchRequest().search(quick(), mission.legs))
        for k in range(100):
            run.frames.append(SearchFrame(k, 1000.0 - k, quick()))
        run.shown()
        now += 0.11
        run.shown()
        assert run.cursor >= 90

    def test_states_follow_the_news(self):
        run = SearchRun(SearchRequest().search(quick(), mission.legs))
        assert run.state == "starting"
        run.on_event(JobQueued(2))
        assert (run.state, run.ahead) == ("waiting", 2)
        assert "2 ahead" in search_text.standing(run)
        run.on_event(JobStarted())
        assert run.state == "running"
        run.stopping()
        run.on_event(JobStarted())
        assert run.state == "stopping"
        run.on_event(JobEnded(None, stopped=True))
        assert run.state == "stopped"
        assert not run.under_way
        assert "Stopped, nothing found yet" in search_text.standing(run)
        assert search_text.result(run) == ""
        assert {start.legend(SI) for start in run.starts()} == {f"Start {k}: not run" for k in range(1, 7)}

    def test_a_broken_process_keeps_the_best(self, run: SearchRun):
        broken = SearchRun(run.search)
        broken.frames = run.frames[:3]
        broken.on_event(JobFailed("The worker process ended unexpectedly."))
        assert broken.best is run.frames[2]
        assert "ended unexpectedly" in search_text.result(broken)
        assert "best so far is kept" in search_text.standing(broken)


class TestCharts:
    def test_every_start_is_a_line_of_finite_numbers(self, run: SearchRun):
        chart = starts_chart(run, SI)
        level, *starts = curves(chart)
        assert level.colour == LOOKS["reference"][0]
        assert len(starts) == sum(bool(trace) for trace in run.traces) == 3
        low, high = chart.span("y")
        for line in starts:
            assert len(line.x) == len(line.y)
            assert all(math.isfinite(value) for value in line.y)
            assert low <= line.y[-1] <= high
        assert run.best is not None
        assert min(line.y[-1] for line in starts) == pytest.approx(run.best.power / 1e3, rel=1e-4)
        assert len({line.colour for line in starts}) == 3


class TestWords:
    def test_the_optimum_is_told_with_its_band_and_the_change_against_the_start(self, run: SearchRun):
        words = search_text.result(run) + search_text.details(run) + search_text.standing(run)
        for part in ("Inboard rate", "Outboard rate", "within 0.1 % of the least power", "Done"):
            assert part in words
        assert "nan" not in words.lower()
        assert run.best is not None
        assert run.start_power is not None
        saved = 100.0 * (1.0 - run.best.power / run.start_power)
        assert saved > 0.01
        assert f"−{saved:.2f} % vs. start" in search_text.headline(run)

    @pytest.mark.parametrize("name", CONCEPTS)
    def test_every_concept_has_a_drawing_with_an_arrow_for_each_parameter(self, name: str):
        drawn = ET.fromstring(concept_picture(CONCEPTS[name]))
        assert len(drawn.findall("path")) == len(CONCEPTS[name].parameters)


class TestSearchRequest:
    @pytest.mark.parametrize("objective", OBJECTIVES)
    @pytest.mark.parametrize("concept", CONCEPTS)
    def test_mean_a_search(self, concept: str, objective: str):
        search = SearchRequest(concept=concept, objective=objective, stalled=3.0, change=4.0).search(
            quick(), mission.legs
        )
        assert search.concept.name == concept
        assert search.limits.stalled == pytest.approx(0.03)
        assert search.objective is not None

    def test_the_division_reaches_the_concept(self):
        concept = SearchRequest(concept="two-segment", division=0.62).known_concept()
        twist: Any = concept.twist([-0.1, -0.2])
        assert twist.breaks == (0.62,)
        assert SearchRequest(concept="three-segment").known_concept() is CONCEPTS["three-segment"]

    def test_what_cannot_be_searched_is_a_sentence(self):
        bending = SearchRequest(index=3.0)
        assert bending.search(make_design(mu=0.3, bending=True), mission.legs).limits.index == 3.0
        with pytest.raises(ValueError, match="switch Blade bending on"):
            bending.search(quick(), mission.legs)
        with pytest.raises(ValueError, match="set an advance ratio above 0"):
            SearchRequest(objective="hover-cruise").search(quick(mu=0.0), mission.legs)
        with pytest.raises(ValueError, match="no hours"):
            mission.legs(quick(), [mission.MissionRow(0.2, 0.0)])


@pytest.fixture(scope="module")
def levels() -> tuple[MapTask, list[MapLevel]]:
    design, concept = quick(), CONCEPTS["two-segment-free"]
    task = MapTask(design, concept, at_condition(design), default_axes(concept), (-0.2, -0.15, 0.5), (2, 4))
    told: list[Any] = []
    assert task.run(told.append, no_stop)
    return task, told


class TestMap:
    def test_default_axes_are_division_and_outer_rate(self):
        names = [parameter.name for parameter in CONCEPTS["two-segment-free"].parameters]
        assert [names[k] for k in default_axes(CONCEPTS["two-segment-free"])] == ["division", "outboard_rate"]
        assert default_axes(CONCEPTS["quadratic"]) == (0, 1)

    def test_coarse_then_fine_and_the_fine_holds_the_coarse(self, levels: tuple[MapTask, list[MapLevel]]):
        task, (coarse, fine) = levels
        assert [len(level.powers) for level in (coarse, fine)] == [3, 5]
        assert np.array(fine.powers, dtype=float)[::2, ::2] == pytest.approx(np.array(coarse.powers, dtype=float))
        assert not task.run(lambda item: None, lambda: True)  # Stopped between two points.
        assert fine.powers[1][2] == pytest.approx(solve(task.at(0.5, 0.25)).power.total, rel=1e-7)

    def test_the_least_is_said_with_what_is_held(self, levels: tuple[MapTask, list[MapLevel]]):
        task, told = levels
        drawn = power_map.Map(task, np.array(told[-1].powers, dtype=float))
        x, y, power = drawn.least
        assert solve(task.at(x, y)).power.total == pytest.approx(power, rel=1e-7)
        across, up = drawn.parameters
        division, rate = across.low + x * (across.high - across.low), math.degrees(up.low + y * (up.high - up.low))
        shown = f"{division:.2f} R, {rate:.1f} °/R".replace("-", "−")
        assert power_map.least_words(drawn, SI) == (
            f"Least {SI.watts(power, 1)} at {shown}. Fixed: Inboard rate −11.5 °/R."
        )

    def test_designs_that_do_not_trim_are_left_blank(self):
        powers = np.full((5, 5), 1e6) + np.arange(5.0)
        powers[4, 4] = math.nan
        values = refined(powers, 40, 30)
        assert np.isnan(values[-1, -1])
        assert np.isfinite(values[:20, :20]).all()


def test_each_start_has_its_trace_and_running_best(run: SearchRun):
    starts = run.starts()
    assert len(starts) == 3
    for one in starts:
        assert len(one.best) == len(one.powers)
        assert list(one.best) == sorted(one.best, reverse=True)
        assert one.best[-1] == min(one.powers)
        assert one.state == "finished"


def test_the_best_start_has_the_power_of_the_optimum(run: SearchRun):
    best = next(one for one in run.starts() if one.is_best)
    assert run.optimum is not None
    assert run.optimum.best is not None
    assert best.best[-1] == pytest.approx(run.optimum.best.power, rel=1e-6)
    assert SI.watts(run.optimum.best.power, 1) in search_text.headline(run)
    equal = [one.number for one in run.starts() if one.gap is not None and one.gap < 50.0]
    listed = [f"Start {start.number}:" in search_text.headline(run) for start in run.starts()]
    assert listed == [len(equal) < 3] * 3  # Where all agree the chart says so.
    one, several, every = f"start {best.number} is best", f"{len(equal)} of 3 starts are best", "all 3 starts agree"
    assert starts_chart(run, SI).value == (one, several, every)[len(equal) - 1]


def test_half_way_the_second_start_runs_and_the_third_waits(searched: tuple[SearchRun, tuple[StartTrace, ...]]):
    starts = searched[1]
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
    low, high = search_text.power_axis((spike,), 853e3)
    assert low < 845e3
    assert 853e3 < high < 1e6
    run = SearchRun(SearchRequest(starts=1).search(quick(), mission.legs))
    monkeypatch.setattr(run, "starts", lambda: (spike,))
    assert starts_chart(run, SI).note == "1 designs lie above the axis."


def test_a_design_beyond_a_limit_is_not_the_best():
    run = SearchRun(SearchRequest(starts=1).search(quick(), mission.legs))
    step = Progress("search", 0, 1, 1, (0.0, 0.0, 0.5), "linear:0", 850e3, True, (0.0, 0.0, 0.5), 850e3, 0.1)
    run.frames.append(SearchFrame(0, 860e3, quick()))
    run._step(step)
    run._step(replace(step, evaluation=2, power=800e3, feasible=False))
    assert run.starts()[0].powers == (850e3, 850e3)


def test_before_the_first_design():
    assert "Not run yet" in search_text.standing(None)
    run = SearchRun(SearchRequest(starts=2).search(quick(), mission.legs))
    assert search_text.headline(run) == ""
    assert [one.state for one in run.starts()] == ["waiting", "waiting"]
    assert search_text.power_axis(run.starts(), None) == (0.0, 1.0)
