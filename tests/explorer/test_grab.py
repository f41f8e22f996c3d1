"""Twisting the blade by hand: geometry of the drag, what it does to the sliders, limits, and one step of undo."""

from dataclasses import replace
from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from fake_bridge import Bridge
from hypothesis import given
from hypothesis import strategies as st

from explorer.model.inputs import LAWS, Inputs
from explorer.model.sliders import (
    DETENT,
    BestTurn,
    StationDrag,
    drag_from,
    grabbed_inputs,
    limits,
    place_of,
    slid,
    stations,
    twist_sensitivities,
    with_station_turned,
)
from explorer.model.undo import History
from explorer.widgets.twist_curve import TwistCurveEditor
from rotor.trim.analysis import power_gradient
from rotor.trim.solve import solve

GRABBED = [law for law in LAWS if stations(Inputs(law=law))]
TWO = Inputs(law="two", two_inner=-14.0, two_outer=-8.0, two_division=0.5)
ROOT = TWO.aircraft.rotor_for("flight").blade.root_cutout


def angles(inputs: Inputs, *r: float) -> np.ndarray:
    """Twist [°] at r/R."""
    return np.degrees(inputs.design().twist(np.array(r)))


class TestStations:
    @pytest.mark.parametrize("law", GRABBED)
    def test_root_divisions_and_tip_in_order(self, law: str):
        places = [station.r for station in stations(Inputs(law=law))]
        assert places[0] == ROOT
        assert places[-1] == 1.0
        assert places == sorted(places)
        assert len(places) == len([one for one in LAWS[law].parameters if one.angular]) + 1

    @pytest.mark.parametrize("law", ["ideal", "optimised"])
    def test_a_law_without_sliders_becomes_the_nearest_two_segments(self, law: str):
        inputs = Inputs(law=law)
        ready = grabbed_inputs(inputs)
        assert ready.law == "two"
        r = np.linspace(0.25, 0.95, 30)
        before, after = inputs.design().twist(r), ready.design().twist(r)
        # Ideal twist is steepest at the root: two segments miss it there by a quarter of its range.
        assert np.abs((before - before.mean()) - (after - after.mean())).max() < 0.28 * np.ptp(
            before
        )


class TestTurning:
    @pytest.mark.parametrize("law", GRABBED)
    def test_a_turned_end_turns_by_that_angle_relative_to_its_neighbour(self, law: str):
        inputs = replace(Inputs(law=law), quadratic_curvature=0.0)
        for index in (0, -1):
            station = stations(inputs)[index]
            neighbour = stations(inputs)[1 if index == 0 else -2]
            # The ends of a curve turn against each other.
            if stations(inputs)[1].title == "middle":
                neighbour = stations(inputs)[-1 if index == 0 else 0]
            after = with_station_turned(inputs, station, 2.0)
            change = angles(after, station.r, neighbour.r) - angles(inputs, station.r, neighbour.r)
            assert change[0] - change[1] == pytest.approx(2.0, abs=0.05)

    @pytest.mark.parametrize("law", ["two", "three", "builtin"])
    def test_a_turned_division_bends_the_blade_and_leaves_the_rest_alone(self, law: str):
        """Relative to the line between its neighbours it turns by the angle; root and tip keep their difference."""
        inputs = Inputs(law=law)
        station = stations(inputs)[1]
        inboard, outboard = stations(inputs)[0].r, stations(inputs)[2].r
        after = with_station_turned(inputs, station, 1.5)
        change = angles(after, inboard, station.r, outboard) - angles(
            inputs, inboard, station.r, outboard
        )
        assert change[2] - change[0] == pytest.approx(0.0, abs=0.06)
        assert change[1] - change[0] == pytest.approx(1.5, abs=0.06)

    def test_the_middle_of_a_quadratic_bends_it(self):
        inputs = Inputs(law="quadratic", quadratic_curvature=0.0, quadratic_difference=-10.0)
        root, middle, tip = stations(inputs)
        after = with_station_turned(inputs, middle, 1.0)
        at = angles(after, root.r, middle.r, tip.r)
        # The slider has steps of 0.5 °/R², 0.1° of bend.
        assert at[1] - 0.5 * (at[0] + at[2]) == pytest.approx(1.0, abs=0.1)

    @pytest.mark.parametrize("degrees", [-80.0, 80.0])
    @pytest.mark.parametrize("law", GRABBED)
    def test_no_slider_leaves_its_limits(self, law: str, degrees: float):
        for station in stations(Inputs(law=law)):
            after = with_station_turned(Inputs(law=law), station, degrees)
            for name in LAWS[law].inputs:
                low, high = limits(name)
                assert low <= getattr(after, name) <= high

    def test_at_a_limit_both_sides_stop_together(self):
        """The bend stays what the hand has made it: one piece does not go on alone."""
        inputs = replace(TWO, two_inner=9.0)
        after = with_station_turned(inputs, stations(inputs)[1], 10.0)
        assert after.two_inner == 10.0
        bent = (after.two_inner - 9.0) * (0.5 - ROOT)
        assert after.two_outer == pytest.approx(-8.0 - bent / 0.5, abs=0.06)


class TestSliding:
    def test_a_division_follows_the_hand_within_its_slider(self):
        three = Inputs(law="three")
        first, second = stations(three)[1:3]
        assert slid(three, first, 0.5).three_inner_break == 0.5
        assert slid(three, first, 0.9).three_inner_break == limits("three_inner_break")[1]
        assert slid(three, second, 0.1).three_outer_break == limits("three_outer_break")[0]
        assert limits("three_inner_break")[1] + 0.02 <= limits("three_outer_break")[0]
        assert slid(three, second, 1.2).three_outer_break == limits("three_outer_break")[1]


def grab_at(r: float, inputs: Inputs = TWO) -> StationDrag:
    grab = drag_from(inputs, r)
    assert grab is not None
    return grab


def seen_at(grab: StationDrag, turn: float) -> tuple[float, float, float]:
    """Turn that the sliders reach, power there, and its exact slope."""
    inputs = with_station_turned(grab.inputs, grab.station, turn)
    solution = solve(inputs.design())
    slopes = {
        name: one.slope
        for name, one in twist_sensitivities(inputs, power_gradient(solution)).items()
    }
    reached, slope = grab.turn_to(inputs), grab.power_slope(slopes)
    assert reached is not None
    assert slope is not None
    return reached, solution.power.total, slope


class TestGrab:
    def test_the_nearest_station_is_taken(self):
        assert [grab_at(r).station.title for r in (0.2, 0.4, 0.7, 0.9)] == [
            "root",
            "break point",
            "break point",
            "tip",
        ]


class TestBestTurn:
    def test_slopes_foresee_the_least_power_or_nothing(self):
        best = BestTurn().with_turn(0.0, 1225.0, -300.0)
        assert best.turn is best.power is None  # One slope says which way, not how far.
        best = best.with_turn(0.5, 1100.0, -200.0)
        assert best.turn == pytest.approx(1.5)
        assert best.power == pytest.approx(1000.0)  # 1000 + 100 (t − 1.5)²
        best = BestTurn()
        for turn in (0.0, 0.8, 2.0, 1.4):
            off = turn - 1.0
            best = best.with_turn(turn, 0.25 * off**4 + 0.1 * off**2, off**3 + 0.2 * off)
        assert best.turn == pytest.approx(1.0, abs=0.15)
        assert BestTurn().with_turn(0.0, 0.0, 100.0).with_turn(1.0, 75.0, 50.0).turn is None
        assert BestTurn().with_turn(0.0, 0.0, -100.0).with_turn(1.0, -99.5, -99.0).power is None

    @given(
        st.floats(-6.0, 6.0),
        st.floats(10.0, 500.0),
        st.floats(0.2, 5.0),
        st.sampled_from((-1.0, 1.0)),
    )
    def test_powers_of_a_parabola_foresee_it_as_its_slopes_do(
        self, least: float, curve: float, far: float, way: float
    ):
        """The slope is known where the station was taken alone."""

        def power(turn: float) -> float:
            return 9e5 + curve * (turn - least) ** 2

        taken = BestTurn().with_turn(0.0, power(0.0), -2.0 * curve * least)
        best = taken.with_power(way * far, power(way * far))
        assert best.turn == pytest.approx(least, abs=1e-4)
        assert best.power == pytest.approx(9e5, abs=1e-2)
        assert BestTurn().with_power(far, power(far)).turn is None  # No slope is known yet.
        assert best.with_power(0.05, power(0.05)).turn is None  # Too near to tell.

    def test_the_station_is_held_about_the_best_turn_and_goes_on_beyond(self):
        grab, best = grab_at(0.97), 2.0
        near = [grab.turned(best + off, best) for off in (-0.3, 0.0, 0.3)]
        assert near[0] == near[1] == near[2]
        beyond = grab.turned(best + 1.1 * DETENT, best)
        assert beyond != near[0]
        assert beyond == grab.turned(best + 1.1 * DETENT)

    @pytest.mark.parametrize("r", [0.2, 0.55, 0.97])
    def test_the_foreseen_turn_is_the_least_power_of_all_turns(self, r: float):
        """Slopes are the exact ones of the sliders; the minimum is looked for by trims on both sides of it."""
        grab = grab_at(r)
        (t0, p0, s0), (t1, p1, s1) = seen_at(grab, 0.0), seen_at(grab, 0.4)
        assert p1 - p0 == pytest.approx(0.5 * (s0 + s1) * (t1 - t0), rel=0.1)
        best = BestTurn().with_turn(t0, p0, s0).with_turn(t1, p1, s1)
        reached = t1
        for _ in range(3):
            if best.turn is None:
                return  # The least power lies beyond what can be foreseen from here.
            reached, power, slope = seen_at(grab, best.turn)
            best = best.with_turn(reached, power, slope)
        assert best.turn is not None
        if reached == pytest.approx(best.turn, abs=0.1):  # Else a slider has ended.
            least = seen_at(grab, best.turn)[1]
            assert best.power == pytest.approx(least, rel=2e-4)
            assert least < seen_at(grab, best.turn - 1.0)[1]
            assert least < seen_at(grab, best.turn + 1.0)[1]


class TestUndo:
    def test_a_drag_that_ends_where_it_began_is_no_step_and_keeps_what_can_be_redone(self):
        history = History(TWO, future=[replace(TWO, two_inner=-9.0)])
        history.hold()
        for inner in (-13.0, -12.0, TWO.two_inner):
            history.note(replace(TWO, two_inner=inner), pause=0.1)
        history.release()
        assert history.past == []
        assert history.redo() == replace(TWO, two_inner=-9.0)


def editor_of(inputs: Inputs) -> tuple[TwistCurveEditor, Bridge, list[Inputs], list[bool]]:
    """With the present inputs, and what was taken (True) or let go."""
    bridge, now, took = Bridge(), [inputs], list[bool]()
    page: Any = SimpleNamespace(
        inputs=lambda: now[0],
        drag_to=lambda new: now.__setitem__(0, new),
        state=lambda: None,
        bridge=bridge,
        keyboard=SimpleNamespace(bind=lambda *_: None),
    )
    return TwistCurveEditor(page, took.append), bridge, now, took


class TestTwistCurve:
    """Handles of the twist curve in the rail, and the blade twisted by hand."""

    def test_a_pressed_blade_is_shown_from_the_tip_and_its_station_held_at_the_best_angle(self):
        editor, bridge, now, took = editor_of(TWO)
        editor.grab(0.9)
        assert bridge.state["twisting"].knot == "2"
        assert bridge.state["twisting"].stations == pytest.approx([ROOT, 0.5, 1.0])
        start = float(angles(TWO, 1.0)[0] - angles(TWO, 0.75)[0])
        for turn, power, slope in ((0.0, 1225.0, -300.0), (0.5, 1100.0, -200.0)):
            editor.learn(
                with_station_turned(TWO, stations(TWO)[2], turn), power, {"two_outer": slope * 0.5}
            )
        best = editor.held.best
        # Half of a turn is seen from 0.75 R.
        assert best.theta == pytest.approx(start + 0.5 * 1.5, abs=0.03)
        assert best.power == pytest.approx(1000.0)
        assert not best.held
        bridge.press("knot", ["2", [None, best.theta + 0.1]])
        assert now[0] == with_station_turned(TWO, stations(TWO)[2], 1.5)
        assert editor.held.best.held
        bridge.press("knot", ["2", "end"])
        assert bridge.state["twisting"] is None
        assert took == [True, False]

    def test_the_blade_stops_where_its_first_slider_ends(self):
        """A quarter of the tip's turn relative to 0.75 R is half a radius of the outboard slider's rate."""
        editor, bridge, now, _ = editor_of(TWO)
        editor.grab(1.0)
        start = float(angles(TWO, 1.0)[0] - angles(TWO, 0.75)[0])
        wanted = [
            (start + 0.25 * (end - TWO.two_outer), "Outboard [°/R]") for end in limits("two_outer")
        ]
        for (theta, title), (expected, name) in zip(
            bridge.state["twisting"].ends, wanted, strict=True
        ):
            assert (theta, title) == (pytest.approx(expected, abs=0.02), name)
        bridge.press("knot", ["2", [None, 60.0]])
        assert now[0].two_outer == limits("two_outer")[1]
        editor.grab(1.0)  # At its end, it turns back as far as it came.
        bridge.press("knot", ["2", [None, start]])
        assert now[0].two_outer == pytest.approx(TWO.two_outer, abs=0.1)

    def test_no_least_power_is_told_past_the_end_of_a_slider(self):
        editor, *_ = editor_of(TWO)
        editor.grab(1.0)
        end = (limits("two_outer")[1] - TWO.two_outer) * 0.5
        for turn in (0.0, 1.0):
            power, slope = (turn - end - 1.0) ** 2, 2.0 * (turn - end - 1.0)
            editor.learn(
                with_station_turned(TWO, stations(TWO)[2], turn), power, {"two_outer": slope * 0.5}
            )
        assert editor.held.best is None

    def test_escape_brings_back_the_law_that_was_there(self):
        ideal = replace(TWO, law="ideal")
        editor, bridge, now, took = editor_of(ideal)
        editor.grab(1.0)
        bridge.press("knot", ["2", [None, 5.0]])
        bridge.press("knot", ["2", "undo"])
        assert now[0] == ideal
        assert took == [True, False]

    def test_a_held_handle_has_a_place_that_ends_with_the_drag(self):
        editor, bridge, now, took = editor_of(Inputs(law="two"))
        drag = partial(bridge.press, "knot")
        drag(["2", [1.0, -1.0]])  # By key: nothing is held.
        assert editor.held is None
        drag(["2", "start"])
        before = now[0]
        drag(["2", [1.0, 2.0]])
        assert now[0].two_outer > before.two_outer
        assert editor.held is not None
        assert editor.held.place == place_of(now[0], stations(now[0])[2])
        assert editor.held.place.startswith("tip 1.00 R · twist ")
        drag(["2", "end"])
        assert editor.held is None
        assert took == [True, False]
