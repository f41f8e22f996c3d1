"""A ride with a section: which one shows most of stall, what is said on the way, and the price that adds up."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.app import App
from explorer.model.inputs import Inputs, ViewState
from explorer.model.session_state import SessionState
from explorer.model.units import AVIATION, SI
from explorer.picture.element import probe
from explorer.picture.ride import AZIMUTHS, FIRST_PSI, telling_station, turn_of
from explorer.views.page_state import OpenPanels, PageState
from explorer.views.prices import prices
from explorer.views.ride_cost import price_summed, ride_cost
from explorer.views.waterfall import waterfall_work
from rotor import Solution, make_design, solve
from rotor.aero.switches import SWITCHES, with_switches
from rotor.study.series import WaterfallStep, waterfall
from tests.tools.visitor import Visitor, arrived, ran

HEAVY = make_design(mu=0.35, mass_kg=9500.0)


@pytest.fixture(scope="module")
def stalled() -> Solution:
    return solve(HEAVY).require()


@pytest.fixture(scope="module")
def attached() -> Solution:
    return solve(make_design(mu=0.28)).require()


@pytest.fixture(scope="module")
def steps() -> tuple[WaterfallStep, ...]:
    found = waterfall(HEAVY)
    return (*found.steps, *found.alone)


def alone(steps: tuple[WaterfallStep, ...], name: str) -> WaterfallStep:
    """The step that switches this effect off, all others on."""
    return steps[1 + len(SWITCHES) + list(SWITCHES).index(name)]


def known(solution: Solution, steps: tuple[WaterfallStep, ...] | None) -> PageState:
    """A page that rides, with these steps of its waterfall."""
    state = SessionState(Inputs(), ViewState(), solution, solution, None)
    now = PageState(Inputs(), solution.design, state, ui=OpenPanels(disk=True, riding=True))
    if steps is None:
        return now
    return replace(now, answers={one.key: steps for one in waterfall_work(now)})


class TestPrice:
    """What stall costs is one number: on the disk, in the waterfall, and at the end of a turn."""

    def test_the_shares_of_the_azimuths_are_the_difference_of_the_two_trims(
        self, stalled: Solution, steps
    ):
        step = alone(steps, "stall")
        assert step.added is not None
        assert step.added_around is not None
        assert step.added_around.mean() == pytest.approx(step.added, rel=1e-9)
        without = solve(with_switches(HEAVY, ("stall",))).require()
        assert -step.added == pytest.approx(stalled.power.total - without.power.total, abs=20.0)

    @pytest.mark.parametrize("name", SWITCHES)
    def test_so_are_those_of_every_effect(self, name: str, steps):
        step = alone(steps, name)
        if step.added_around is not None:
            assert step.added_around.mean() == pytest.approx(step.added, rel=1e-6, abs=1e-3)

    def test_it_is_spent_where_the_flow_is_separated(self, stalled: Solution, steps):
        added = alone(steps, "stall").added_around
        assert added is not None
        around = -added
        psi = np.degrees(stalled.disk.psi[stalled.disk.stalled.any(axis=0)])
        columns = np.arange(len(around)) * 360.0 / len(around)
        inside = (columns >= psi.min()) & (columns <= psi.max())
        assert around[inside].sum() > 0.8 * around.sum()
        assert inside.mean() < 0.5

    def test_a_sum_from_any_azimuth_over_a_whole_turn_is_the_price(self):
        around = -np.array([3.0, 1.0, 0.0, 8.0, 40.0, 20.0])
        summed = price_summed(around, 72)
        assert summed[0] == 0.0
        assert summed[-1] == pytest.approx(12.0)
        # Each azimuth stands for a sixth of the turn about it.
        assert summed[72 * 3 // 12] - summed[72 // 12] == pytest.approx(1.0 / 6.0)
        assert summed[6] == pytest.approx(0.5 * 3.0 / 6.0)

    @pytest.mark.parametrize("units", [SI, AVIATION], ids=["SI", "aviation"])
    def test_the_end_of_a_turn_is_what_the_disk_says(self, units, stalled: Solution, steps):
        now = known(stalled, steps)
        assert now.state is not None
        now = replace(
            now, state=replace(now.state, view=replace(now.state.view, units=units.title))
        )
        cost = ride_cost(now)["ride_cost"]
        said = prices(now)["prices"]["stall"].lines[0]
        assert cost.words == f"Stall {said[0].lower()}{said[1:]}"
        assert f"{cost.spent[-1]:.1f} {cost.unit}" in said
        assert len(cost.spent) == AZIMUTHS + 1
        assert not cost.stale

    def test_where_there_is_no_price_a_sentence_says_why(
        self, stalled: Solution, attached: Solution, steps
    ):
        waits = ride_cost(known(stalled, None))["ride_cost"]
        assert (waits.words, waits.spent) == ("Computing what stall costs …", ())
        nothing = ride_cost(known(attached, None))["ride_cost"]
        assert (nothing.words, nothing.spent) == ("Nothing is separated on this disk", ())
        without = solve(with_switches(HEAVY, ("stall",))).require()
        off = ride_cost(known(without, steps))["ride_cost"]
        assert (off.words, off.spent) == ("Stall is switched off", ())


class TestStation:
    def test_it_is_the_one_with_most_separated_air(self, stalled: Solution):
        disk = stalled.disk
        at = int(np.abs(disk.r - telling_station(stalled)).argmin())
        air = np.where(disk.stalled, disk.u_t, 0.0).sum(axis=1)
        assert air[at] == air.max() > 0.0

    def test_without_separated_flow_it_is_that_of_the_least_margin(self, attached: Solution):
        disk = attached.disk
        assert attached.stalled_area == 0.0
        at = int(np.abs(disk.r - telling_station(attached)).argmin())
        outside = disk.u_t[at] >= 0.0
        least = disk.unsteady.separation[at, outside].min() - 0.7
        assert least == pytest.approx(attached.least_margin, abs=0.02)

    def test_steady_sections_and_sections_without_stall_have_one_too(self, stalled: Solution):
        models = replace(HEAVY.models, dynamic_stall=False)
        steady = solve(replace(HEAVY, models=models)).require()
        r = telling_station(steady)
        assert steady.disk.stalled[np.abs(steady.disk.r - r).argmin()].any()
        assert telling_station(solve(with_switches(HEAVY, ("stall",)))) == 0.75


class TestTurn:
    def test_the_point_leaves_the_static_curve_where_stall_is_dynamic(self, stalled: Solution):
        r = telling_station(stalled)
        turn = turn_of(stalled, r, FIRST_PSI)
        for k in range(0, AZIMUTHS, 6):
            if turn.u[k] > 0.0:
                assert turn.static[k] == pytest.approx(
                    np.interp(turn.alpha[k], turn.angles, turn.curves[k]), abs=0.03
                )
                assert turn.cl[k] == pytest.approx(probe(stalled, r, np.pi * k / 36).cl, abs=1e-3)
        above = np.array(turn.cl) - np.array(turn.static)
        assert above.max() > 0.5
        assert above.min() < -0.05
        assert min(turn.angles) <= min(turn.alpha)
        assert max(turn.alpha) <= max(turn.angles)

    def test_steady_sections_stay_on_it(self):
        models = replace(HEAVY.models, dynamic_stall=False, unsteady=False)
        steady = solve(replace(HEAVY, models=models)).require()
        station = float(steady.disk.r[14])
        turn = turn_of(steady, station, 0.0)
        at_stations = slice(0, AZIMUTHS, 3)
        ahead = np.array(turn.u)[at_stations] > 0.0
        gap = np.array(turn.cl)[at_stations] - np.array(turn.static)[at_stations]
        assert_allclose(gap[ahead], 0.0, atol=0.03)

    def test_what_is_said_is_true(self, stalled: Solution):
        for r in (0.35, 0.44, 0.6, 0.9):
            turn = turn_of(stalled, r, 0.0)
            alpha, cl, u = np.array(turn.alpha), np.array(turn.cl), np.array(turn.u)
            later = np.roll(alpha, -1) > np.roll(alpha, 1)
            higher = np.roll(cl, -1) > np.roll(cl, 1)
            for k, words in enumerate(turn.seen):
                # Beside reverse flow angles count from another edge.
                if min(u[k - 1], u[k], u[(k + 1) % AZIMUTHS]) < 0.0:
                    continue
                if "from above" in words:
                    assert alpha[k] < -10.0
                    continue
                assert ("separated" in turn.region[k]) == ("separate" in words)
                assert ("past static" in words) <= (alpha[k] > turn.stall[k])
                assert ("below static stall again" in words) <= (alpha[k] < turn.stall[k])
                assert ("still rises" in words) <= (higher[k] and later[k])
                assert ("coefficient falls" in words) <= (not higher[k])
                assert ("angle of attack grows" in words) <= later[k]
                assert ("angle of attack falls" in words) <= (not later[k])

    def test_in_hover_nothing_changes(self):
        hover = solve(make_design(mu=0.0)).require()
        assert set(turn_of(hover, 0.75, 0.0).seen) == {
            "Nothing changes around this turn: the air is the same at every azimuth."
        }


def views(visitor: Visitor) -> str:
    return visitor.frame["views"]["now"]


def test_the_view_rides_with_the_chosen_section_and_gives_back_what_was_there(app: App):
    async def visit() -> None:
        visitor = await arrived(app.address)
        page = app.sessions[0].page
        await visitor.until(lambda: page.latest.state is not None)
        azimuth = page.context.display.view.azimuth_deg
        # None is chosen: the one that shows most.
        await visitor.press("view", "ride")
        await visitor.until(lambda: visitor.frame.get("ride") is not None)
        ride = visitor.frame["ride"]
        assert ride["r"] == pytest.approx(telling_station(page.latest.state.solution), abs=0.006)
        assert ride["psi"] == FIRST_PSI
        await visitor.until(lambda: views(visitor) == "ride")
        await visitor.until(lambda: visitor.frame.get("ride_cost") is not None)
        await visitor.press("riding", 200.0)
        await visitor.until(lambda: page.context.display.view.azimuth_deg == 200.0)
        await visitor.press("ride", "off")
        await visitor.until(lambda: visitor.frame["ride"] is None and views(visitor) == "3d")
        await visitor.until(lambda: page.context.display.view.azimuth_deg == azimuth)
        # What comes late moves nothing.
        await visitor.press("riding", 210.0)
        await visitor.idle(wholly=False)
        assert page.context.display.view.azimuth_deg == azimuth
        assert not visitor.frame["bar"]["drawer"]
        await visitor.until(lambda: visitor.frame["ride_cost"] is None)
        # The section of the drawer, which comes back after it.
        await visitor.press("section", [0.62, 285.0])
        await visitor.until(lambda: visitor.frame["bar"]["drawer"] == "probe")
        await visitor.press("view", "ride")
        await visitor.until(lambda: visitor.frame["ride"] is not None)
        assert (visitor.frame["ride"]["r"], visitor.frame["ride"]["psi"]) == (0.62, 285.0)
        await visitor.until(lambda: visitor.frame["bar"]["drawer"] == "")
        await visitor.press("view", "ride")
        await visitor.until(lambda: visitor.frame["bar"]["drawer"] == "probe")
        # Another view, and another mode, end it.
        for press in (("view", "side"), ("mode", "optimise")):
            await visitor.press("view", "ride")
            await visitor.until(lambda: visitor.frame["ride"] is not None)
            await visitor.press(*press)
            await visitor.until(lambda: visitor.frame["ride"] is None)
            await visitor.until(lambda: views(visitor) == "side")
        await visitor.close()

    ran(visit)


def test_a_ride_out_of_actuate_puts_the_blade_back_and_lifts_it_again(app: App):
    async def visit() -> None:
        visitor = await arrived(app.address)
        page = app.sessions[0].page
        await visitor.press("mode", "actuate")
        await visitor.until(lambda: page.actuator.lifted)
        await visitor.press("view", "ride")
        await visitor.until(lambda: visitor.frame.get("ride") is not None)
        assert not page.actuator.lifted
        await visitor.press("ride", "off")
        await visitor.until(lambda: page.actuator.lifted and views(visitor) == "actuator")
        await visitor.press("view", "ride")
        await visitor.until(lambda: visitor.frame["ride"] is not None)
        await visitor.press("view", "3d")
        await visitor.until(lambda: visitor.frame["ride"] is None and views(visitor) == "3d")
        assert not page.actuator.lifted
        await visitor.close()

    ran(visit)
