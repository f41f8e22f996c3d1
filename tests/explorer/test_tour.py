"""The tour, the snapshot of a visitor's page, and slider positions between two states."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from explorer.interface import SessionState, TabContext
from explorer.picture.fields import FIELDS
from explorer.pinned import Pinned
from explorer.snapshot import PageSnapshot
from explorer.state import Inputs, ViewState
from explorer.text.units import AVIATION
from explorer.tour import SECONDS, STOPS, TourStop, blend, eased, inputs_between, stop_begins, tour_at
from rotor.trim.solve import solve


class TestBetween:
    def test_easing_rests_at_both_ends_and_is_clamped(self):
        assert (eased(-1.0), eased(0.0), eased(0.5), eased(1.0), eased(2.0)) == (0.0, 0.0, 0.5, 1.0, 1.0)
        assert eased(0.01) < 0.001
        assert blend(0.1, 0.3, 1.0) == 0.3

    def test_sliders_of_one_law_run_smoothly(self):
        before = Inputs(law="two", two_inner=-14.0, two_outer=-8.0, two_division=0.5)
        after = replace(before, two_inner=-10.0, two_outer=-18.0, two_division=0.8, mass_t=9.0)
        assert inputs_between(before, after, 0.0) == before
        assert inputs_between(before, after, 1.0) == after
        half = inputs_between(before, after, 0.5)
        assert (half.two_inner, half.two_outer) == pytest.approx((-12.0, -13.0))
        rates = [inputs_between(before, after, part / 20.0).two_outer for part in range(21)]
        assert rates == sorted(rates, reverse=True)

    def test_another_law_or_preset_stands_at_once(self):
        before, after = Inputs(law="linear"), Inputs(law="two", preset="thesis")
        assert inputs_between(before, after, 0.1) == after

    def test_hover_is_not_approached_through_low_speed(self):
        before, after = Inputs(advance_ratio=0.0), Inputs(advance_ratio=0.3)
        assert inputs_between(before, after, 0.01).advance_ratio == 0.3
        assert inputs_between(after, before, 0.01).advance_ratio == 0.0


class TestTour:
    def test_one_minute_in_six_stops(self):
        assert SECONDS == 60.0
        assert len(STOPS) == 6
        assert tour_at(SECONDS) is None
        last = tour_at(59.9)
        assert last is not None
        assert last.stop == 5
        assert last.inputs.law == "builtin"

    @pytest.mark.parametrize("stop", range(len(STOPS)))
    def test_a_stop_begins_and_ends_with_its_inputs(self, stop: int):
        first, last = tour_at(stop_begins(stop)), tour_at(stop_begins(stop) + STOPS[stop].seconds - 1e-6)
        assert first is not None
        assert last is not None
        assert (first.stop, last.stop) == (stop, stop)
        assert (first.inputs, last.inputs) == (STOPS[stop].start, STOPS[stop].end)
        assert first.reference == STOPS[stop].start

    @pytest.mark.parametrize("stop", STOPS, ids=lambda stop: stop.caption[:30])
    def test_every_stop_trims_on_its_way_and_its_caption_fits(self, stop: TourStop):
        for part in (0.0, 0.5, 1.0):
            assert solve(inputs_between(stop.start, stop.end, part).design()).converged
        assert stop.field in FIELDS
        assert len(stop.caption) <= 120

    def test_the_captions_are_true(self):
        powers = [[solve(one.design()).power for one in (stop.start, stop.end)] for stop in STOPS]
        slow, fast = powers[0]
        assert fast.induced < slow.induced
        assert fast.parasite > 10.0 * slow.parasite
        flat, twisted = powers[1]
        assert twisted.induced < flat.induced
        optimum, more = powers[2]
        assert 1.0 < more.total / optimum.total < 1.01
        for rate in (-8.0, -12.0, -14.0):  # The caption names the whole degree of least power.
            assert solve(replace(STOPS[2].start, linear=rate).design()).power.total > optimum.total
        one, two = powers[4]
        assert two.total < one.total

    def test_the_reverse_flow_grows(self):
        slow, fast = (solve(one.design()) for one in (STOPS[3].start, STOPS[3].end))
        assert fast.reverse_flow_area > 1.5 * slow.reverse_flow_area

    def test_the_view_keeps_what_belongs_to_the_visitor(self):
        instant = tour_at(0.0)
        assert instant is not None
        view = instant.view(ViewState(dark=True, units=AVIATION.title, difference=True))
        assert (view.dark, view.units, view.difference) == (True, AVIATION.title, False)


class Page:
    """The part of a page that a snapshot reads and writes."""

    def __init__(self, inputs: Inputs, view: ViewState, pin: Inputs | None) -> None:
        self.inputs, self.view, self.pin = inputs, view, pin

    def context(self) -> TabContext:
        def nothing(*_: Any) -> None:
            pass

        def setter(name: str) -> Callable[[Any], None]:
            return lambda value: setattr(self, name, value)

        return TabContext(
            inputs=lambda: self.inputs,
            set_inputs=setter("inputs"),
            view=lambda: self.view,
            set_view=setter("view"),
            set_azimuth=nothing,
            wake=nothing,
            download=nothing,
            notify=nothing,
            state=self.state,
            pin=setter("pin"),
        )

    def state(self) -> SessionState:
        solution = solve(self.inputs.design())
        pin = None if self.pin is None else Pinned(self.pin, solve(self.pin.design()))
        return SessionState(self.inputs, self.view, solution, solution, None, pin)


class TestSnapshot:
    @pytest.mark.parametrize("pin", [None, Inputs(law="linear", linear=-10.0)])
    def test_the_end_gives_design_field_and_a_back(self, pin: Inputs | None):
        mine = Inputs(law="two", two_inner=-9.0, mass_t=9.1, tip_loss=False)
        view = ViewState(field="Mach number", azimuth_deg=210.0, exaggeration=3.0)
        page = Page(mine, view, pin)
        kept = PageSnapshot.take(page.context())
        page.inputs, page.view = Inputs(law="builtin"), ViewState(field="Power dP/dr", difference=True)
        page.pin = Inputs(law="linear", linear=0.0)
        kept.restore(page.context())
        assert (page.inputs, page.view, page.pin) == (mine, view, pin)

    def test_units_and_theme_stay_as_they_were_set_meanwhile(self):
        page = Page(Inputs(), ViewState(), None)
        kept = PageSnapshot.take(page.context())
        page.view = ViewState(dark=True, units=AVIATION.title, field="Power dP/dr")
        kept.restore(page.context())
        assert page.view == ViewState(dark=True, units=AVIATION.title)

    def test_a_rotor_file_brought_meanwhile_stays_in_the_menu(self):
        page = Page(Inputs(), ViewState(), None)
        kept = PageSnapshot.take(page.context())
        own = replace(Inputs().aircraft, name="Mine", key=None)
        page.inputs = replace(Inputs(), own_rotor=own)
        kept.restore(page.context())
        assert page.inputs == replace(Inputs(), own_rotor=own)
