"""A schedule as charts, table and CSV, and as a flight: exact at its legs, continuous, and its energy adds up."""

import csv
import io
import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import viser
from numpy.testing import assert_allclose

from explorer.tabs.optimise import schedule_view
from explorer.tabs.optimise.schedule_panel import SchedulePanel
from explorer.tabs.optimise.schedule_view import (
    FlightInstant,
    PlanProgress,
    ScheduleFlight,
    twist_between,
)
from explorer.tabs.optimise.search_run import SearchRequest
from explorer.workers.solver import FixedPowers, ScheduleTask
from rotor.design.twist import IdealTwist, LinearTwist, PiecewiseLinearTwist, TwistLaw
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import CONCEPTS
from rotor.optimisation.objective import WeightedCondition
from rotor.optimisation.schedule import Cell, Plan
from rotor.trim.solve import solve
from tests.curves import curves

LAWS: tuple[tuple[TwistLaw, TwistLaw], ...] = (
    (PiecewiseLinearTwist((-0.3, -0.1), (0.4,)), PiecewiseLinearTwist((-0.1, -0.3), (0.8,))),
    (IdealTwist(0.1), LinearTwist(-0.2)),
)


UNIFORM = replace(make_design().models, inflow="uniform", elements=20, azimuths=36)
"""Quick, where the physics does not matter."""


@pytest.fixture(scope="module")
def progress() -> PlanProgress:
    """A schedule worked off here, its news heard as from a process; its legs not in the order of speed."""
    design = make_design(twist="linear:-16", models=UNIFORM)
    legs = tuple(
        WeightedCondition(replace(design.condition, advance_ratio=mu), hours)
        for mu, hours in ((0.3, 0.5), (0.0, 1.0), (0.15, 2.0))
    )
    progress = PlanProgress(Plan(design, (CONCEPTS["linear"],), legs, starts=1))

    def tell(item: object) -> None:
        match item:
            case Cell():
                progress.cells.append(item)
            case FixedPowers(powers):
                progress.fixed_powers = powers
            case _:
                raise AssertionError(item)

    assert ScheduleTask(progress.plan).run(tell, lambda: False).complete
    return progress


def played(progress: PlanProgress, count: int) -> list[FlightInstant]:
    """Instants of a whole playback, the first and the last included."""
    flight = ScheduleFlight(progress, seconds=12.0)
    return [flight.at(flight.seconds * k / count) for k in range(count + 1)]


class TestSchedule:
    def test_no_fixed_blade_beats_the_moving_one(self, progress: PlanProgress):
        for k in range(3):
            best, fixed = progress.at(k), progress.fixed_power(k)
            assert best is not None
            assert best.best is not None
            assert fixed is not None
            assert best.best.power <= fixed * (1.0 + 1e-6)
        worth = progress.schedule.in_flight_gain("linear")
        assert worth is not None
        assert worth.gain >= 0.0
        assert progress.part_done == 1.0

    def test_charts_and_table(self, progress: PlanProgress):
        twists, savings = schedule_view.twist_chart(progress, None), schedule_view.saving_chart(progress, None)
        assert twists is not None
        assert savings is not None
        assert [one.label for one in twists.series] == ["hover", "", "fast", "fixed"]
        assert [one.label for one in savings.series] == ["fixed", "variable"]
        assert all(np.isfinite(one.y).all() for chart in (twists, savings) for one in curves(chart))
        empty = PlanProgress(progress.plan)
        assert schedule_view.twist_chart(empty, None) is schedule_view.saving_chart(empty, None) is None
        table = schedule_view.table(progress)
        assert "Additional saving from variable twist" in table
        assert "nan" not in table.lower()
        assert "Moving" not in schedule_view.table(PlanProgress(progress.plan))

    def test_legs_to_come_are_not_drawn(self, progress: PlanProgress):
        half = PlanProgress(progress.plan, [cell for cell in progress.cells if cell.condition == 0])
        whole, drawn = (schedule_view.saving_chart(one, None) for one in (progress, half))
        assert whole is not None
        assert drawn is not None
        fixed, moving = curves(drawn)
        assert_allclose(moving.x, [0.3])
        assert_allclose(moving.y, curves(whole)[1].y[2:])
        assert math.isnan(fixed.y[0])  # Not known yet.

    def test_csv_reads_back(self, progress: PlanProgress):
        rows = list(csv.DictReader(io.StringIO(schedule_view.csv_of(progress).decode())))
        assert [row["mu"] for row in rows] == ["0.3", "0", "0.15", "mean"]
        for k, row in enumerate(rows[:3]):
            condition = progress.plan.conditions[k].flight
            twisted = replace(make_design(twist=row["twist"], models=UNIFORM), condition=condition)
            assert float(row["best_kw"]) == pytest.approx(solve(twisted).power.total / 1e3, abs=2e-3)
        leg = progress.plan.conditions[0]
        climbing = replace(progress.plan, conditions=(replace(leg, flight=replace(leg.flight, climb_speed=2.5)),))
        text = schedule_view.csv_of(PlanProgress(climbing)).decode()
        assert next(csv.DictReader(io.StringIO(text)))["climb_m_s"] == "2.5"

    def test_stopped_keeps_what_there_is(self, progress: PlanProgress):
        told: list[Any] = []
        schedule = ScheduleTask(progress.plan).run(told.append, lambda: len(told) > 0)
        assert len(schedule.cells) == 1


class TestFlight:
    def test_legs_come_in_the_order_of_speed_with_the_numbers_of_the_schedule(self, progress: PlanProgress):
        flight = ScheduleFlight(progress)
        assert [leg.advance_ratio for leg in flight.legs] == [0.0, 0.15, 0.3]
        assert [leg.hours for leg in flight.legs] == [1.0, 2.0, 0.5]
        for leg in flight.legs:
            k = [one.flight.advance_ratio for one in progress.plan.conditions].index(leg.advance_ratio)
            optimum = progress.at(k)
            assert optimum is not None
            assert optimum.best is not None
            assert (leg.moving, leg.starting) == (optimum.best.power, optimum.baseline_power)
            assert solve(leg.design).power.total == pytest.approx(leg.moving, rel=1e-7)

    def test_begins_in_hover_and_ends_fast(self, progress: PlanProgress):
        flight = ScheduleFlight(progress, seconds=10.0)
        first, last = flight.at(0.0), flight.at(10.0)
        assert (first.design, first.saved) == (flight.legs[0].design, 0.0)
        assert last.design == flight.legs[-1].design
        assert last.design.condition.advance_ratio == 0.3
        assert flight.at(99.0).design == last.design
        assert flight.at(-1.0) == first

    def test_the_energy_is_that_of_the_mission(self, progress: PlanProgress):
        last = ScheduleFlight(progress).at(math.inf)
        legs = ScheduleFlight(progress).legs
        assert last.hours == pytest.approx(3.5)
        assert last.saved == pytest.approx(3600.0 * sum(leg.hours * (leg.starting - leg.moving) for leg in legs))

    def test_speed_and_saving_never_step_back(self, progress: PlanProgress):
        instants = played(progress, 240)
        speeds = [one.design.condition.advance_ratio for one in instants]
        assert speeds == sorted(speeds)
        assert max(np.diff(speeds)) < 0.02
        hours = [one.hours for one in instants]
        assert hours == sorted(hours)
        saved = [one.saved for one in instants]
        assert np.diff(saved).min() > -1e-12 * max(saved)  # But for rounding.

    def test_twist_is_continuous_and_no_mission_time_passes_between_legs(self, progress: PlanProgress):
        instants = played(progress, 600)
        twists = np.array([float(one.design.twist(np.array([1.0]))[0]) for one in instants])
        assert np.abs(np.diff(twists)).max() < 0.03 * np.ptp(twists)
        hovers = [one for one in instants if 0.0 < one.design.condition.advance_ratio < 0.15]
        assert len(hovers) > 10
        assert len({round(one.hours, 12) for one in hovers}) == 1

    def test_what_is_not_known_yet_is_left_out(self, progress: PlanProgress):
        partial = PlanProgress(progress.plan, [cell for cell in progress.cells if cell.condition in (0, 1)])
        flight = ScheduleFlight(partial)
        assert len(flight.legs) == 2
        alone = ScheduleFlight(PlanProgress(progress.plan, partial.cells[:1]))  # One leg stands still.
        assert alone.at(0.0).design == alone.at(alone.seconds).design
        with pytest.raises(ValueError, match="no optimum to play yet"):
            ScheduleFlight(PlanProgress(progress.plan))


@pytest.mark.parametrize(("before", "after"), LAWS)
def test_a_twist_between_two_laws_is_exact_at_both_ends(before: TwistLaw, after: TwistLaw):
    assert twist_between(before, after, 0.0) is before
    assert twist_between(before, after, 1.0) is after
    r = np.array([0.2, 0.5, 0.75, 1.0])
    assert_allclose(twist_between(before, after, 0.4)(r), 0.6 * before(r) + 0.4 * after(r), atol=3e-3)


def test_no_change_since_a_grab_counts_once_the_playback_begins_or_ends(
    server: viser.ViserServer, progress: PlanProgress
):
    resets: list[bool] = []
    context: Any = SimpleNamespace(
        pool=None, gui=server.gui, bridge=SimpleNamespace(on=lambda *_: None), wake=lambda: None,
        tracker=SimpleNamespace(reset=lambda: resets.append(True)),
    )  # fmt: skip
    search: Any = SimpleNamespace(request=SearchRequest)
    panel = SchedulePanel(context, search)
    panel.play()
    assert resets == []  # There is no schedule to play yet.
    panel._progress = progress
    panel.play()
    assert len(resets) == 1
    panel.play()
    panel.land()
    assert len(resets) == 2
