"""A schedule as charts, table and CSV."""

import csv
import io
import math
import re
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.charts import schedule_view
from explorer.charts.schedule_view import ScheduleProgress
from explorer.workers.background import WorkRecord
from explorer.workers.solver import ScheduleTask
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import CONCEPTS
from rotor.optimisation.objective import WeightedCondition
from rotor.optimisation.schedule import SchedulePlan
from rotor.trim.solve import solve
from tests.curves import curves

UNIFORM = replace(make_design().models, inflow="uniform", elements=20, azimuths=36)
"""Quick, where the physics does not matter."""


@pytest.fixture(scope="module")
def progress() -> ScheduleProgress:
    """A schedule worked off here, its news heard as from a process; its legs not in the order of speed."""
    design = make_design(twist="linear:-16", models=UNIFORM)
    legs = tuple(
        WeightedCondition(replace(design.condition, advance_ratio=mu), hours)
        for mu, hours in ((0.3, 0.5), (0.0, 1.0), (0.15, 2.0))
    )
    task, reports = ScheduleTask(SchedulePlan(design, (CONCEPTS["linear"],), legs, starts=1)), list[object]()
    assert task.run(reports.append, lambda: False).complete
    return ScheduleProgress.of(WorkRecord(task, "running", 0, tuple(reports)))


class TestSchedule:
    def test_charts_and_table(self, progress: ScheduleProgress):
        twists, savings = schedule_view.twist_chart(progress, None), schedule_view.saving_chart(progress, None)
        assert savings is not None
        assert twists is not None
        assert [one.label for one in twists.series] == ["hover", "", "fast", "fixed"]
        assert [one.label for one in savings.series] == ["fixed", "variable"]
        assert all(np.isfinite(one.y).all() for chart in (twists, savings) for one in curves(chart))
        empty = ScheduleProgress(progress.plan)
        assert schedule_view.twist_chart(empty, None) is schedule_view.saving_chart(empty, None) is None
        table = schedule_view.table(progress)
        assert "Variable twist, beyond that" in table
        assert re.search(r"saves [\d.]+ ± [\d.]+ %: \w+", table)
        assert "nan" not in table.lower()
        assert "Moving" not in schedule_view.table(ScheduleProgress(progress.plan))

    def test_legs_to_come_are_not_drawn(self, progress: ScheduleProgress):
        half = ScheduleProgress(progress.plan, tuple(cell for cell in progress.cells if cell.condition == 0))
        whole, drawn = (schedule_view.saving_chart(one, None) for one in (progress, half))
        assert drawn is not None
        assert whole is not None
        fixed, moving = curves(drawn)
        assert_allclose(moving.x, [0.3])
        assert_allclose(moving.y, curves(whole)[1].y[2:])
        assert math.isnan(fixed.y[0])  # Not known yet.

    def test_csv_reads_back(self, progress: ScheduleProgress):
        rows = list(csv.DictReader(io.StringIO(schedule_view.csv_of(progress).decode())))
        assert [row["mu"] for row in rows] == ["0.3", "0", "0.15", "mean"]
        for k, row in enumerate(rows[:3]):
            condition = progress.plan.conditions[k].flight
            twisted = replace(make_design(twist=row["twist"], models=UNIFORM), condition=condition)
            assert float(row["best_kw"]) == pytest.approx(solve(twisted).power.total / 1e3, abs=2e-3)
        leg = progress.plan.conditions[0]
        climbing = replace(progress.plan, conditions=(replace(leg, flight=replace(leg.flight, climb_speed=2.5)),))
        text = schedule_view.csv_of(ScheduleProgress(climbing)).decode()
        assert next(csv.DictReader(io.StringIO(text)))["climb_m_s"] == "2.5"
