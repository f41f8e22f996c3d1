"""What the optimiser's tabs show, without a browser: runs, charts, maps, drawings and words."""

import csv
import io
import math
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.charts import schedule_view
from explorer.charts.concept import concept_picture
from explorer.charts.power_map import (
    PowerMap,
    default_axes,
    drawing,
    least_words,
    map_of,
    place_on,
    refined,
)
from explorer.charts.schedule_view import ScheduleProgress
from explorer.model.actuator_inputs import mission_over
from explorer.model.inputs import baseline_of
from explorer.model.search_run import SearchRequest, SearchRun
from explorer.model.units import AVIATION, SI
from explorer.text import search_words as search_text
from explorer.text.readout import banded
from explorer.views.notice import comparison
from explorer.widgets.optimise.map_panel import MapPanel
from explorer.workers.background import WorkRecord
from explorer.workers.solver import MapLevel, MapTask, ScheduleTask, SearchTask, StartPower
from rotor import doubt, make_design, solve
from rotor.optimisation import (
    CONCEPTS,
    Progress,
    SchedulePlan,
    Search,
    WeightedCondition,
    at_condition,
    run_search,
)
from rotor.optimisation.mission import standard_mission
from rotor.optimisation.results import ParameterBand
from rotor.optimisation.results import SearchStatus as Status
from rotor.support.chart import Points
from rotor.support.processes import JobEnded, JobFailed
from rotor.trim.doubt import sureness
from tests.curves import curves

UNIFORM = replace(make_design().models, inflow="uniform", elements=20, azimuths=36)
"""Quick, where the physics does not matter."""


def quick(twist: str = "linear:-16", mu: float = 0.3) -> Any:
    return make_design(twist=twist, mu=mu, models=UNIFORM)


def no_stop() -> bool:
    return False


def begun(starts: int, *reports: object, **asked: Any) -> SearchRun:
    """A search from so many starts, fewer than those of the page, that has reported so much."""
    search = replace(SearchRequest(**asked).search(quick(), standard_mission), starts=starts)
    return SearchRun(
        WorkRecord(
            SearchTask(search, baseline_of(quick()), "UH-60A as built"), "running", 0, reports
        )
    )


STEP = Progress(
    "search", 0, 2, 1, (0.0, 0.0, 0.5), "linear:0", 850e3, True, (0.0, 0.0, 0.5), 850e3, 0.1
)
"""The first design of the first of two starts."""


@pytest.fixture(scope="module")
def run() -> SearchRun:
    """A search run here, its news heard as from a process."""
    record = begun(3, concept="two-segment").record
    reports = list[object]()
    optimum = record.task.run(reports.append, no_stop)
    return SearchRun(replace(record, reports=tuple(reports)).then(JobEnded(optimum)))


class TestSearchRun:
    def test_frames_lead_from_the_start_to_the_optimum_with_powers_of_trims(self, run: SearchRun):
        assert run.record.state == "done"
        assert run.frames[0].design == run.search.design
        powers = [frame.power for frame in run.frames[1:-1]]
        assert powers == sorted(powers, reverse=True)
        assert run.optimum.status is Status.CONVERGED
        assert run.frames[-1].design == run.optimum.design
        last = len(run.frames) - 1  # The words count what the slider counts.
        assert f"step {last} of {last}" in search_text.frame_line(run, last)
        for frame in (run.frames[0], run.frames[len(run.frames) // 2], run.frames[-1]):
            assert solve(frame.design).power.total == pytest.approx(frame.power, rel=1e-7)
        assert run.start_power == pytest.approx(solve(run.search.design).power.total, rel=1e-9)
        built = solve(baseline_of(run.search.design)).power.total
        assert run.reference_doubt.against == pytest.approx(built, rel=1e-9)
        assert run.reference_doubt.saving_words in search_text.result(run)

    def test_stopped_before_any_design_it_has_found_nothing(self):
        run = SearchRun(begun(1).record.then(JobEnded(None, stopped=True)))
        assert not run.under_way
        assert "Stopped, nothing found yet" in search_text.standing(run)
        assert "Not run yet" in search_text.standing(None)
        assert search_text.result(run) == ""

    def test_a_map_that_ends_before_its_first_level_is_none(self):
        for late, words in ((True, "No map; time is up."), (False, "No map; stopped.")):
            ended = begun(1).record.then(JobEnded(None, stopped=True, late=late))
            panel: Any = SimpleNamespace(_refused="", _work={"map": ended})
            assert MapPanel._line(panel) == words

    def test_a_broken_process_keeps_the_best(self, run: SearchRun):
        half = replace(
            run.record, reports=run.record.reports[: len(run.record.reports) // 2], result=None
        )
        broken = SearchRun(half.then(JobFailed("The worker process ended unexpectedly.")))
        assert broken.best is not None
        assert broken.best == run.frames[len(broken.frames) - 1]
        assert "ended unexpectedly" in search_text.result(broken)
        assert "best so far is kept" in search_text.standing(broken)


class TestWords:
    def test_the_optimum_is_told_with_its_band_and_the_change_against_the_start(
        self, run: SearchRun
    ):
        words = search_text.result(run) + search_text.details(run) + search_text.standing(run)
        for part in ("Inboard rate", "Outboard rate", "Done"):
            assert part in words
        assert "nan" not in words.lower()
        assert run.start_power is not None
        saved, within = run.optimum.doubt.change, run.optimum.doubt.change_band
        assert saved is not None
        assert within is not None
        assert run.best.power - run.start_power == pytest.approx(saved, abs=1.0)
        said = banded(saved, within, SI, sign=True)
        assert said.startswith("−")
        assert said in search_text.headline(run)

    @pytest.mark.parametrize(
        ("half", "rate", "place"),
        [
            (0.04, "−8.3 … −8.2", "0.45 … 0.46"),
            (3.0, "−11 … −5", "0.2 … 0.8"),
            (0.4, "−8.7 … −7.9", "0.42 … 0.50"),
        ],
    )
    def test_a_range_has_the_digits_that_it_allows(
        self, run: SearchRun, half: float, rate: str, place: str
    ):
        free, values = (
            CONCEPTS["two-segment-free"],
            (math.radians(-8.26), math.radians(-1.0), 0.456),
        )
        bands = tuple(
            ParameterBand(each.name, value - within, value + within)
            for each, value in zip(free.parameters, values, strict=True)
            for within in [each.from_shown(half if each.angular else 0.1 * half)]
        )
        assert run.optimum is not None
        assert run.optimum.best is not None
        best = replace(run.optimum.best, parameters=values)
        told = replace(run.optimum, best=best, doubt_band=bands, doubt_cost=1.0)
        task = replace(run.record.task, search=replace(run.search, concept=free))
        words = search_text.details(SearchRun(replace(run.record, task=task, result=told)))
        cells = re.findall(r"<td[^>]*rx-num[^>]*>([^<]*)<", words)
        assert (cells[0], cells[2]) == ("−8.3", "0.46")  # As on the sliders and in the line on top.
        assert f"inboard rate {rate} °/R" in words
        assert f"break point {place} R" in words

    @pytest.mark.parametrize("name", CONCEPTS)
    def test_every_concept_has_a_drawing_with_an_arrow_for_each_parameter(self, name: str):
        drawn = ET.fromstring(concept_picture(CONCEPTS[name]))
        assert len(drawn.findall("path")) == len(CONCEPTS[name].parameters)


class TestSearchRequest:
    def test_the_division_reaches_the_concept(self):
        concept = SearchRequest(concept="two-segment", division=0.62).known_concept()
        twist: Any = concept.twist([-0.1, -0.2])
        assert twist.breaks == (0.62,)
        assert SearchRequest(concept="three-segment").known_concept() is CONCEPTS["three-segment"]

    def test_what_cannot_be_searched_is_a_sentence(self):
        bending = SearchRequest(index=3.0)
        assert (
            bending.search(make_design(mu=0.3, bending=True), standard_mission).limits.index == 3.0
        )
        with pytest.raises(ValueError, match="switch Blade bending on"):
            bending.search(quick(), standard_mission)
        with pytest.raises(ValueError, match="set an advance ratio above 0"):
            SearchRequest(objective="hover-cruise").search(quick(mu=0.0), standard_mission)


def test_a_mission_is_searched_over_the_legs_of_the_flight_bar():
    design = quick(mu=0.2)
    bar = mission_over(design, (1.0, 0.0, 2.0, 0.5))
    objective = SearchRequest(objective="mission").wanted(design, lambda _: bar)
    flown = [(leg.flight.advance_ratio, leg.hours) for leg in objective.conditions]
    assert flown == [(0.0, 1.0), (0.25, 2.0), (0.33, 0.5)]  # 0 hours are not flown.
    assert {leg.flight.mass for leg in objective.conditions} == {design.condition.mass}


@pytest.fixture(scope="module")
def reports() -> tuple[MapTask, list[MapLevel]]:
    """A map, and what it tells after each row."""
    design, concept = quick(), CONCEPTS["two-segment-free"]
    task = MapTask(
        design, concept, at_condition(design), default_axes(concept), (-0.2, -0.15, 0.5), (2, 4)
    )
    told: list[Any] = []
    assert task.run(told.append, no_stop)
    done = [each for each in told if isinstance(each, float)]
    assert done == sorted(done)
    assert done[-1] == 1.0
    return task, [each for each in told if isinstance(each, MapLevel)]


@pytest.fixture(scope="module")
def levels(reports: tuple[MapTask, list[MapLevel]]) -> tuple[MapTask, list[MapLevel]]:
    """A map, and its whole grids."""
    task, told = reports
    return task, [each for each in told if each.whole]


@pytest.fixture(scope="module")
def drawn(levels: tuple[MapTask, list[MapLevel]]) -> PowerMap:
    task, told = levels
    power, values = told[-1].least
    assert power is not None
    return PowerMap(task, np.array(told[-1].powers, dtype=float), told[-1].values, (power, values))


class TestMap:
    def test_coarse_then_fine_and_the_fine_holds_the_coarse(
        self, levels: tuple[MapTask, list[MapLevel]]
    ):
        task, (coarse, fine) = levels
        assert [len(level.powers) for level in (coarse, fine)] == [3, 5]
        assert np.array(fine.powers, dtype=float)[::2, ::2] == pytest.approx(
            np.array(coarse.powers, dtype=float)
        )
        assert not task.run(lambda item: None, lambda: True)  # Stopped between two rows.

    def test_it_is_drawn_as_its_rows_come(self, reports: tuple[MapTask, list[MapLevel]]):
        """Rows not known yet are blank, in the finer grid those of the coarse one; the least only falls."""
        task, told = reports
        assert [(level.rows, len(level.powers)) for level in told] == [
            *((row, 3) for row in (1, 2, 3)),
            *((row, 5) for row in (1, 2, 3, 4, 5)),
        ]
        least = [level.least[0] for level in told]
        known = [power for power in least if power is not None]
        assert known == sorted(known, reverse=True)
        first = map_of(task, told[:2])
        assert first is not None
        assert np.isfinite(first.powers[:2]).all()
        assert np.isnan(first.powers[2]).all()
        assert least_words(first, SI).startswith("Least so far ")
        ET.fromstring(drawing(first, None))
        finer = map_of(task, told[:5])
        assert finer is not None
        assert np.isfinite(finer.powers).all()
        coarse = np.array(told[2].powers, dtype=float)
        assert finer.powers[2::2, ::2] == pytest.approx(coarse[1:])
        assert finer.powers[0] == pytest.approx(np.array(told[-1].powers[0], dtype=float))
        last = map_of(task, told)
        assert last is not None
        assert last.whole
        assert last.powers == pytest.approx(np.array(told[-1].powers, dtype=float))

    @pytest.mark.parametrize("cell", [(1, 2), (3, 1), (0, 4)])
    def test_each_point_is_the_least_over_what_is_held(
        self, drawn: PowerMap, cell: tuple[int, int]
    ):
        """Against trims on a fine line of the third parameter."""
        row, column = cell
        power, (_, *others) = drawn.powers[row, column], drawn.values[row][column]
        concept, design = drawn.task.concept, drawn.task.design
        low, high = concept.parameters[0].low, concept.parameters[0].high
        assert solve(drawn.at(column / 4, row / 4)).power.total == pytest.approx(power, rel=1e-7)
        along = [solve(concept.apply(design, (at, *others))) for at in np.linspace(low, high, 13)]
        least = min(one.power.total for one in along if one.converged)
        assert power < least * (1.0 + 1e-4)

    def test_no_valley_beside_is_missed(self):
        """Two break points are each the least of those beside them."""
        design, concept = quick(), CONCEPTS["two-segment-free"]
        task = MapTask(design, concept, at_condition(design), (0, 1), (-0.2, -0.15, 0.5), (4, 8))
        told: list[Any] = []
        assert task.run(told.append, no_stop)
        level = told[-1]
        for row, column in ((1, 5), (2, 5), (7, 1)):
            inboard, outboard, _ = level.values[row][column]
            along = [
                solve(concept.apply(design, (inboard, outboard, at)))
                for at in np.linspace(0.25, 0.92, 24)
            ]
            least = min(one.power.total for one in along if one.converged)
            assert level.powers[row][column] < least * (1.0 + 1e-4)

    def test_its_least_is_that_of_a_search(self, drawn: PowerMap):
        found = run_search(Search(drawn.task.design, drawn.task.concept, band=False))
        beyond = drawn.least[-1] / solve(found.design).power.total - 1.0
        assert -2e-4 < beyond < 1e-5  # Within the last digit of a search, which ends earlier.
        assert drawn.least[-1] < np.nanmin(drawn.powers) - 100.0  # It lies between the points.

    def test_a_map_that_holds_every_parameter_has_its_least(self):
        """Nothing is free at a point of such a grid; the least lies between its points."""
        design, concept = quick(), CONCEPTS["two-segment"]
        values = tuple(parameter.start for parameter in concept.parameters)
        task = MapTask(design, concept, at_condition(design), (0, 1), values, (2, 4))
        told: list[Any] = []
        assert task.run(told.append, no_stop)
        power, _ = told[-1].least
        found = run_search(Search(design, concept, band=False))
        assert power == pytest.approx(solve(found.design).power.total, rel=2e-4)
        assert power < np.nanmin(np.array(told[-1].powers, dtype=float))

    def test_the_least_is_said_with_all_its_parameters(self, drawn: PowerMap):
        x, y, power = drawn.least
        inboard, outboard, place = drawn.lowest[1]
        concept = drawn.task.concept
        assert solve(
            concept.apply(drawn.task.design, drawn.lowest[1])
        ).power.total == pytest.approx(power, rel=1e-7)
        rates = f"Inboard {math.degrees(inboard):.1f} °/R, Outboard {math.degrees(outboard):.1f} °/R".replace(
            "-", "−"
        )
        said = least_words(drawn, SI)
        assert said.startswith(f"Least {SI.watts(power)} at {rates}, Break point {place:.2f} R.")
        assert ("lies at the bound" in said) == (min(x, 1.0 - x, y, 1.0 - y) < 1e-6)
        steepest = concept.parameters[1].low
        for outboard, outside in ((steepest, True), (0.5 * steepest, False)):
            words = least_words(replace(drawn, lowest=(1e6, (inboard, outboard, 0.6))), SI)
            assert ("lies at the bound of Outboard" in words) == outside

    def test_it_is_drawn_with_its_least_and_a_design_of_its_concept(self, drawn: PowerMap):
        picture = ET.fromstring(drawing(drawn, drawn.at(0.5, 0.25).twist))
        assert picture.find(".//g[@data-map]/image") is not None
        assert place_on(drawn, drawn.at(0.5, 0.25).twist) == pytest.approx((0.5, 0.25), abs=1e-6)
        assert place_on(drawn, make_design(twist="builtin").twist) is None
        assert (
            ET.fromstring(drawing(drawn, make_design(twist="builtin").twist)).find(".//circle")
            is None
        )
        dot = picture.find(".//circle")
        assert float(dot.attrib["cx"]) == pytest.approx(165.0, abs=0.1)
        assert float(dot.attrib["cy"]) == pytest.approx(148.5, abs=0.1)
        off = ET.fromstring(drawing(drawn, make_design(twist="quadratic:-10,4").twist)).find(
            ".//circle"
        )
        assert off is None or off.attrib["fill"] == "none"  # It has no place in the plane.
        assert ET.fromstring(drawing(drawn, None)).find(".//circle") is None

    def test_designs_that_do_not_trim_are_left_blank(self):
        powers = np.full((5, 5), 1e6) + np.arange(5.0)
        powers[4, 4] = math.nan
        values = refined(powers, 40, 30)
        assert np.isnan(values[-1, -1])
        assert np.isfinite(values[:20, :20]).all()


def test_the_bar_moves_with_starts_and_designs():
    steps = [replace(STEP, start=k, evaluation=n) for k, n in ((0, 1), (0, 2), (1, 3), (1, 4))]
    seen = [begun(2, StartPower(860e3), *steps[:k]).part_done for k in range(5)]
    assert sorted(set(seen)) == seen
    assert seen[-1] < begun(2, *steps, replace(STEP, phase="band", evaluation=5)).part_done < 1.0


def test_a_design_beyond_a_limit_is_not_the_best():
    run = begun(
        1, StartPower(860e3), STEP, replace(STEP, evaluation=2, power=800e3, feasible=False)
    )
    assert run.best.power == 850e3
    assert SI.watts(850e3) in search_text.headline(run)


# A game against what the search found: by its own trim, with the band of the difference


START = make_design(mu=0.2, twist="linear:-4")


def test_the_words_are_the_difference_of_two_trims_and_its_band():
    own, other = solve(START).require(), solve(make_design(mu=0.2, twist="linear:-11")).require()
    band = doubt(own, other)
    more, less = comparison(own, other, band, SI), comparison(other, own, band, SI)
    found = re.search(r"yours (\d+) ± (\d+) kW more: (\w+)", more)
    assert found, more
    assert float(found[1]) == pytest.approx((own.power.total - other.power.total) / 1e3, abs=0.5)
    assert float(found[2]) == pytest.approx((band.change_band or np.nan) / 1e3, abs=0.5)
    assert found[3] == band.sureness
    assert f"{found[1]} ± {found[2]} kW less" in less
    near = solve(make_design(mu=0.2, twist="linear:-11.001")).require()
    assert comparison(near, other, doubt(near, other), SI).endswith("yours the same")
    assert " hp more" in comparison(own, other, band, AVIATION)
    exact = f"{(own.power.total - other.power.total) / 1e3:.1f}"
    assert comparison(own, other, None, SI).endswith(f"yours {exact} kW more")


@pytest.fixture(scope="module")
def progress() -> ScheduleProgress:
    """A schedule worked off here, its news heard as from a process; its legs not in the order of speed."""
    design = make_design(twist="linear:-16", models=UNIFORM)
    legs = tuple(
        WeightedCondition(replace(design.condition, advance_ratio=mu), hours)
        for mu, hours in ((0.3, 0.5), (0.0, 1.0), (0.15, 2.0))
    )
    task, reports = (
        ScheduleTask(SchedulePlan(design, (CONCEPTS["linear"],), legs, starts=1)),
        list[object](),
    )
    assert task.run(reports.append, lambda: False).complete
    return ScheduleProgress.of(WorkRecord(task, "running", 0, tuple(reports)))


class TestSchedule:
    def test_charts_and_table(self, progress: ScheduleProgress):
        twists, savings = (
            schedule_view.twist_chart(progress, None),
            schedule_view.saving_chart(progress, None),
        )
        assert savings is not None
        assert twists is not None
        assert [one.label for one in twists.series] == ["hover", "", "fast", "fixed"]
        assert [one.label for one in savings.series] == ["", "", "fixed", "variable"]
        assert all(np.isfinite(one.y).all() for chart in (twists, savings) for one in curves(chart))
        points = savings.series[0]
        assert isinstance(points, Points)
        order = (1, 2, 0)  # By speed.
        bands = [
            sure.change_band_percent
            for leg in order
            if (sure := progress.doubts(leg)[1]) is not None
        ]
        assert_allclose(points.scatter, np.array(bands, dtype=float))
        empty = ScheduleProgress(progress.plan)
        assert (
            schedule_view.twist_chart(empty, None)
            is schedule_view.saving_chart(empty, None)
            is None
        )
        table = schedule_view.table(progress)
        assert "Variable twist, beyond that" in table
        assert len(re.findall(r">[\d.]+ ± [\d.]+ kW: \w+<", table)) == 2
        legs = re.findall(
            r'<span( class="[^"]*")?>([\d.−]+) ± ([\d.]+)<br/?><span class="rx-small">(\w+)<', table
        )
        assert len(legs) == 6
        for colour, saved, band, word in legs:
            assert word == sureness(float(saved.replace("−", "-")), float(band))
            sure = "rx-more" if saved[0] == "−" else "rx-less"
            assert colour == ("" if word == "unclear" else f' class="{sure}"')
        assert "nan" not in table.lower()
        assert "Moving" not in schedule_view.table(ScheduleProgress(progress.plan))

    def test_legs_to_come_are_not_drawn(self, progress: ScheduleProgress):
        half = ScheduleProgress(
            progress.plan, tuple(cell for cell in progress.cells if cell.condition == 0)
        )
        whole, drawn = (schedule_view.saving_chart(one, None) for one in (progress, half))
        assert drawn is not None
        assert whole is not None
        fixed, moving = curves(drawn)[-2:]
        assert_allclose(moving.x, [0.3])
        assert_allclose(moving.y, curves(whole)[-1].y[2:])
        assert math.isnan(fixed.y[0])  # Not known yet.

    def test_csv_reads_back(self, progress: ScheduleProgress):
        rows = list(csv.DictReader(io.StringIO(schedule_view.csv_of(progress).decode())))
        assert [row["mu"] for row in rows] == ["0.3", "0", "0.15", "mean"]
        for k, row in enumerate(rows[:3]):
            condition = progress.plan.conditions[k].flight
            twisted = replace(make_design(twist=row["twist"], models=UNIFORM), condition=condition)
            assert float(row["best_kw"]) == pytest.approx(
                solve(twisted).power.total / 1e3, abs=2e-3
            )
            apart = 100.0 * (1.0 - float(row["fixed_kw"]) / float(row["as_it_is_kw"]))
            assert row["fixed_sureness"] == sureness(apart, float(row["fixed_doubt_percent"]))
            assert row["sureness"] == sureness(
                float(row["saving_percent"]), float(row["saving_doubt_percent"])
            )
        leg = progress.plan.conditions[0]
        climbing = replace(
            progress.plan, conditions=(replace(leg, flight=replace(leg.flight, climb_speed=2.5)),)
        )
        text = schedule_view.csv_of(ScheduleProgress(climbing)).decode()
        assert next(csv.DictReader(io.StringIO(text)))["climb_m_s"] == "2.5"
