"""A schedule played as a flight: exact at its legs, continuous between them, and its energy adds up."""

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import viser
from numpy.testing import assert_allclose

from explorer.tabs.optimise.schedule_panel import SchedulePanel
from explorer.tabs.optimise.schedule_view import (
    FlightInstant,
    PlanProgress,
    ScheduleFlight,
    flown_legs,
    twist_between,
)
from explorer.tabs.optimise.search_request import SearchRequest
from rotor.design.twist import (
    IdealTwist,
    LinearTwist,
    PiecewiseLinearTwist,
    QuadraticTwist,
    SplineTwist,
    SumTwist,
    TwistLaw,
)
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import CONCEPTS
from rotor.optimisation.objective import WeightedCondition
from rotor.optimisation.schedule import Cell, Plan, run_plan
from rotor.trim.solve import solve

LAWS: tuple[tuple[TwistLaw, TwistLaw], ...] = (
    (LinearTwist(-0.2), LinearTwist(-0.1)),
    (QuadraticTwist(0.1, -0.2), QuadraticTwist(-0.1, -0.1)),
    (PiecewiseLinearTwist((-0.3, -0.1), (0.4,)), PiecewiseLinearTwist((-0.1, -0.3), (0.8,))),
    (SplineTwist((0.1, 0.4, 0.75, 1.0), (0.1, 0.05, 0.0, -0.1)), SplineTwist((0.1, 0.4, 0.75, 1.0), (0.0,) * 4)),
    (LinearTwist(-0.2), PiecewiseLinearTwist((-0.1, -0.3), (0.8,))),
    (IdealTwist(0.1), LinearTwist(-0.2)),
    (SumTwist(IdealTwist(0.1), LinearTwist(-0.2)), SumTwist(IdealTwist(0.1), LinearTwist(0.1))),
)


@pytest.fixture(scope="module")
def progress() -> PlanProgress:
    models = replace(make_design().models, inflow="uniform", elements=20, azimuths=36)
    design = make_design(twist="linear:-16", models=models)
    legs = tuple(
        WeightedCondition(replace(design.condition, advance_ratio=mu), hours)
        for mu, hours in ((0.3, 0.5), (0.0, 1.0), (0.15, 2.0))
    )
    plan = Plan(design, (CONCEPTS["linear"],), legs, starts=1)
    schedule = run_plan(plan)
    fixed = schedule.at(None, "linear")
    assert fixed is not None
    powers = tuple(solve(replace(fixed.design, condition=leg.flight)).power.total for leg in legs)
    return PlanProgress(plan, list(schedule.cells), powers)


def played(progress: PlanProgress, count: int) -> list[FlightInstant]:
    """Instants of a whole playback, the first and the last included."""
    flight = ScheduleFlight(progress, seconds=12.0)
    return [flight.at(flight.seconds * k / count) for k in range(count + 1)]


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

    def test_begins_in_hover_and_ends_fast(self, progress: PlanProgress):
        flight = ScheduleFlight(progress, seconds=10.0)
        first, last = flight.at(0.0), flight.at(10.0)
        assert (first.advance_ratio, first.leg, first.saved) == (0.0, 0, 0.0)
        assert last.advance_ratio == pytest.approx(0.3)
        assert last.twist == flight.legs[-1].twist
        assert flight.at(99.0) == last
        assert flight.at(-1.0) == first

    def test_the_energy_is_that_of_the_mission(self, progress: PlanProgress):
        last = ScheduleFlight(progress).at(math.inf)
        legs = flown_legs(progress)
        assert last.hours == pytest.approx(3.5)
        assert last.saved == pytest.approx(3600.0 * sum(leg.hours * (leg.starting - leg.moving) for leg in legs))

    def test_speed_and_saving_never_step_back(self, progress: PlanProgress):
        instants = played(progress, 240)
        speeds = [one.advance_ratio for one in instants]
        assert speeds == sorted(speeds)
        assert max(np.diff(speeds)) < 0.02
        hours = [one.hours for one in instants]
        assert hours == sorted(hours)
        saved = [one.saved for one in instants]
        assert saved == sorted(saved)

    def test_power_and_twist_are_continuous(self, progress: PlanProgress):
        instants = played(progress, 600)
        powers = np.array([one.moving for one in instants])
        twists = np.array([one.root_to_tip_deg for one in instants])
        assert np.abs(np.diff(powers)).max() < 0.03 * np.ptp(powers)
        assert np.abs(np.diff(twists)).max() < 0.03 * np.ptp(twists)

    def test_no_mission_time_passes_between_legs(self, progress: PlanProgress):
        instants = played(progress, 600)
        changing = [one for one in instants if one.between and one.leg == 0]
        assert len(changing) > 10
        assert len({one.hours for one in changing}) == 1

    def test_its_designs_solve_to_the_powers_shown_at_the_legs(self, progress: PlanProgress):
        flight = ScheduleFlight(progress)
        for instant in (flight.at(0.0), flight.at(flight.seconds)):
            assert solve(flight.design(instant)).power.total == pytest.approx(instant.moving, rel=1e-7)

    def test_three_large_numbers(self, progress: PlanProgress):
        flight = ScheduleFlight(progress)
        (_, speed), (_, twist), (_, saved) = flight.at(0.0).numbers()
        assert speed == "hover"
        assert twist.endswith("°")
        assert saved == "0.0 kW\u202fh"
        assert flight.at(flight.seconds).numbers()[0][1] == "µ 0.30"

    def test_what_is_not_known_yet_is_left_out(self, progress: PlanProgress):
        partial = PlanProgress(progress.plan, [cell for cell in progress.cells if cell.condition in (0, 1)])
        flight = ScheduleFlight(partial)
        assert len(flight.legs) == 2
        empty: list[Cell] = []
        with pytest.raises(ValueError, match="no optimum to play yet"):
            ScheduleFlight(PlanProgress(progress.plan, empty))

    def test_one_leg_alone_stands_still(self, progress: PlanProgress):
        flight = ScheduleFlight(PlanProgress(progress.plan, [cell for cell in progress.cells if cell.condition == 0]))
        assert flight.at(0.0).twist == flight.at(flight.seconds).twist


class TestTwistBetween:
    @pytest.mark.parametrize(("before", "after"), LAWS)
    def test_exact_at_both_ends(self, before: TwistLaw, after: TwistLaw):
        assert twist_between(before, after, 0.0) is before
        assert twist_between(before, after, 1.0) is after

    @pytest.mark.parametrize(("before", "after"), [pair for pair in LAWS if not isinstance(pair[1], SplineTwist)])
    def test_near_the_ends_near_their_laws(self, before: TwistLaw, after: TwistLaw):
        r = np.linspace(0.13, 1.0, 30)
        assert_allclose(twist_between(before, after, 1e-6)(r), before(r), atol=3e-3)
        assert_allclose(twist_between(before, after, 1.0 - 1e-6)(r), after(r), atol=3e-3)

    def test_half_way_between_two_rates(self):
        half = twist_between(LinearTwist(-0.2), LinearTwist(-0.1), 0.5)
        assert_allclose(half(1.0), 0.25 * -0.15)
        built = IdealTwist(0.1)
        assert twist_between(SumTwist(built, LinearTwist(-0.2)), SumTwist(built, LinearTwist(-0.1)), 0.5) == SumTwist(
            built, twist_between(LinearTwist(-0.2), LinearTwist(-0.1), 0.5)
        )

    @pytest.mark.parametrize(("before", "after"), LAWS)
    def test_zero_at_three_quarters_radius(self, before: TwistLaw, after: TwistLaw):
        assert_allclose(twist_between(before, after, 0.4)(0.75), 0.0, atol=1e-12)


def test_the_playback_says_when_it_begins_and_when_it_ends(progress: PlanProgress):
    """The power card then counts no change since an earlier grab."""
    told: list[bool] = []
    nothing: Any = SimpleNamespace(on=lambda *_: None, wake=lambda: None)
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    panel = SchedulePanel(server.gui, nothing, nothing, nothing, SearchRequest, lambda: told.append(True))
    panel.play()
    assert told == []  # There is no schedule to play yet.
    panel._progress = progress
    panel.play()
    assert len(told) == 1
    panel.play()
    panel.land()
    assert len(told) == 2
    server.stop()
