"""Panels as functions of what is known now, without a page."""

import math
import re
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import msgspec
import pytest

from explorer.charts.plots import PowerCurves
from explorer.model.inputs import OPENING, Inputs, ViewState, baseline_of, preset_inflow, with_rotor
from explorer.model.session_state import Pinned, SessionState
from explorer.model.stand import StandInputs
from explorer.model.units import AVIATION, number
from explorer.page import PANELS
from explorer.parts import Parts
from explorer.parts.results import LeastPower, LinePiece
from explorer.views.drawers import DETAILS, TRUST
from explorer.views.inset import blade_inset
from explorer.views.line import line, line_text
from explorer.views.page_state import HeldStation, OpenPanels, PageState, Panel, PanelWork
from explorer.views.power import power_card, station_power
from explorer.views.strip import bands_call, remember_ranges, strip
from explorer.views.waterfall import WATERFALL
from explorer.views.worth import slopes_work, twist_slopes, worth
from explorer.workers.call import at_once
from rotor import doubt
from rotor.design import Harmonic
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

CHANGED = replace(OPENING, built_outer=-2.0)
THESIS = Inputs(preset="thesis", **preset_inflow("thesis"))
STAND = with_rotor(OPENING, "xv15")
FREE = replace(OPENING, inflow="uniform", stand=StandInputs("free-rotor", tip_mach=0.6))
SENTENCE = "The rotor is too heavy. The largest that trims is 9 t at this speed."


@cache
def solved(inputs: Inputs) -> Solution:
    return solve(inputs.design()).require()


def now_at(
    inputs: Inputs, a: Inputs | None = None, units: str = "SI", drawer: str = ""
) -> PageState:
    """What a page knows of these inputs once it rests, but for the answers; `a`: is pinned."""
    solution, pin = solved(inputs), None if a is None else Pinned(a, solved(a))
    state = SessionState(
        inputs, ViewState(units=units), solution, solve(baseline_of(solution.design)), None, pin
    )
    state = state if pin is None else replace(state, pinned=pin.solution)
    curve = PowerCurves().known(solution.design, state.reference.design)
    return PageState(inputs, solution.design, state, ui=OpenPanels(drawer=drawer), curve=curve)


def known(now: PageState, *works: PanelWork) -> PageState:
    """With the results of works, which are remembered."""
    results = {work: at_once(work.run(lambda: None)) for work in works}
    latest = {work.name: result for work, result in results.items()}
    answers = {**now.answers, **{work.key: result for work, result in results.items()}}
    return replace(
        now, answers=answers, memory=replace(now.memory, latest={**now.memory.latest, **latest})
    )


def soon(now: PageState) -> PageState:
    """A moment after it began to rest."""
    works = {work.key: work for panel in PANELS for work in panel.works(now) if work.soon}
    return known(now, *works.values())


def pieces(now: PageState) -> dict[str, LinePiece]:
    """Of the line, by what they are."""
    return {piece.part: piece for piece in line(now).pieces}


def moved(before: PageState, inputs: Inputs, pin: Inputs | None = None) -> PageState:
    """One step of a drag later."""
    now = now_at(inputs, pin)
    assert now.state is not None
    return replace(now, memory=before.memory.then(now.state, before.state))


STATES: Mapping[str, Any] = {
    "before the first": lambda: PageState(OPENING, OPENING.design(), None),
    "no first trim": lambda: PageState(OPENING, None, None, problem=SENTENCE),
    "opening": lambda: now_at(OPENING),
    "at rest": lambda: soon(now_at(CHANGED)),
    "dragged": lambda: moved(soon(now_at(OPENING)), CHANGED),
    "held": lambda: replace(
        soon(now_at(CHANGED)),
        station=HeldStation("tip", LeastPower(3.0, 9e5, held=False)),
        change=-2e3,
    ),
    "A": lambda: soon(now_at(CHANGED, OPENING)),
    "units": lambda: soon(now_at(CHANGED, units="Aviation")),
    "no trim": lambda: replace(soon(now_at(CHANGED)), problem=SENTENCE),
    "rigid": lambda: soon(now_at(THESIS)),
    "free rotor": lambda: soon(now_at(FREE)),
    "stand": lambda: soon(now_at(STAND)),
    "drawer": lambda: soon(now_at(CHANGED, drawer="trust")),
}


@pytest.mark.parametrize("name", STATES)
def test_a_panel_shows_the_same_of_what_is_the_same(name: str):
    """Whatever was shown before; each name belongs to one panel; what is sent is JSON."""
    one, other, shown = STATES[name](), STATES[name](), list[str]()
    for panel in PANELS:
        first = panel.view(one)
        assert [work.key for work in panel.works(one)] == [work.key for work in panel.works(other)]
        assert panel.asks(one) == panel.asks(other)
        assert first == panel.view(one) == panel.view(other)
        parts = {part: value for part, value in first.items() if part in Parts.__annotations__}
        assert all("." in text for text in first.keys() - parts.keys())
        msgspec.json.encode(parts)
        shown += first
    assert len(shown) == len(set(shown))


def test_drawers_that_are_closed_are_not_viewed():
    def opened(drawer: str) -> list[Panel]:
        return [
            panel for panel in (DETAILS, TRUST, WATERFALL) if panel.seen(OpenPanels(drawer=drawer))
        ]

    assert (opened(""), opened("details"), opened("trust")) == ([], [DETAILS, WATERFALL], [TRUST])


class TestWhileADragGoesOn:
    @pytest.fixture
    def rest(self) -> PageState:
        return soon(now_at(replace(OPENING, built_outer=-4.0)))

    def test_the_band_of_the_step_before_stays(self, rest: PageState):
        before, during, after = (
            pieces(now) for now in (rest, moved(rest, CHANGED), soon(moved(rest, CHANGED)))
        )
        assert before["within"].text.startswith(" ± ")
        assert during["within"] == replace(before["within"], stale=True)
        assert (during["sure-band"].stale, during["sure"].stale, during["moved"].stale) == (
            True,
            True,
            False,
        )
        assert after["sure-band"].text != before["sure-band"].text

    def test_so_do_the_rows_of_the_doubt_greyed(self, rest: PageState):
        assert "data-stale" not in TRUST.view(rest)["trust.doubts"]
        during = TRUST.view(moved(rest, CHANGED))["trust.doubts"]
        assert during.count("data-stale") == 1
        assert TRUST.view(rest)["trust.doubts"] in during

    def test_slopes_are_stale_until_it_rests(self, rest: PageState):
        rows, during = worth(rest)["worth"], moved(rest, CHANGED)
        assert {row.stale for row in rows.values()} == {False}
        assert twist_slopes(rest).keys() == rows.keys()
        assert {row.stale for row in worth(during)["worth"].values()} == {True}
        # The foreseen best twist takes none that are of another design.
        assert twist_slopes(during) == {}
        after = worth(soon(during))["worth"]
        assert {row.stale for row in after.values()} == {False}
        assert after != rows

    def test_slopes_of_the_flight_stay_stale_until_they_are_known(self):
        inputs = replace(OPENING, inflow="uniform")
        rest = known(now_at(inputs), *slopes_work(now_at(inputs)))
        during = soon(moved(rest, replace(inputs, mass_t=8.5)))
        rows = worth(during)["worth"]
        assert {name: row.stale for name, row in rows.items()}["mass_t"]
        assert not rows["built_outer"].stale

    def test_another_rotor_forgets_them(self, rest: PageState):
        other = moved(rest, with_rotor(OPENING, "bo105"))
        assert not pieces(other).keys() & {"within", "sure-band", "sure"}
        assert worth(other)["worth"] == {}
        assert TRUST.view(other)["trust.doubts"] == ""


def test_axes_hold_while_the_data_fit():
    now = now_at(CHANGED)
    (axis,) = [one.chart.y.range for one in strip(now)["strip"] if one.name == "alpha"]
    low, high = axis
    wide = replace(now, memory=replace(now.memory, ranges={"alpha": (low - 1.0, high + 1.0)}))
    held = replace(wide, memory=remember_ranges(wide, strip(wide)))
    assert held.memory.ranges["alpha"] == (low - 1.0, high + 1.0)
    assert held.memory.ranges.keys() == {"power-change", "alpha", "lift"}
    left = replace(now, memory=replace(now.memory, ranges={"alpha": (low + 5.0, high + 9.0)}))
    assert remember_ranges(left, strip(left)).ranges["alpha"] == axis


def test_the_change_from_the_reference_and_why():
    assert power_card(now_at(CHANGED))["power"].why.startswith("Lift moved")
    built = f"{1e-3 * solved(OPENING).power.total:.0f}"
    for pinned, name in ((None, "as built"), (OPENING, "A")):
        shown = pieces(now_at(CHANGED, pinned))
        said = [shown[part].text for part in ("than", "against", "reference")]
        assert "".join(said) == f" than {name} ({built})"
    assert power_card(now_at(OPENING))["power"].why == ""
    assert not pieces(now_at(OPENING)).keys() & {"moved", "against"}


class TestWithoutATrim:
    def test_the_last_numbers_stay_greyed_beside_the_sentence(self):
        good = soon(now_at(CHANGED))
        lost = replace(good, problem=SENTENCE)
        assert line(lost).problem == SENTENCE
        assert line(lost).status.kind == "problem"
        assert pieces(lost).keys() == {"", "wide", "airspeed", "problem"}
        assert pieces(lost)["problem"].text == f" has no trim: {SENTENCE.rstrip('.')}"
        assert power_card(lost) == power_card(good)
        assert {one.stale for one in strip(lost)["strip"]} == {True}
        assert {one.stale for one in strip(good)["strip"]} == {False}
        assert worth(lost)["worth"] == {}
        for name, table in DETAILS.view(lost).items():
            assert "data-stale" in table
            assert DETAILS.view(good)[name] in table
        assert SENTENCE in TRUST.view(lost)["trust.status"]
        assert "trust.doubts" not in TRUST.view(lost)
        assert blade_inset(lost) == blade_inset(good)

    def test_before_the_first_there_are_none(self):
        none = PageState(OPENING, None, None, problem=SENTENCE)
        assert (power_card(none)["power"].parts, line(none).status.kind) == ((), "problem")


def test_a_free_rotor_has_the_doubt_of_its_drag_and_no_slopes():
    now = soon(now_at(FREE))
    assert now.state is not None
    lift, drag = now.state.solution.lift_and_drag
    band = doubt(now.state.solution)
    assert pieces(now)["total-power"].text == f"{lift / drag:.1f}"
    assert pieces(now)["total-power"].title.startswith("Drag times speed")
    assert pieces(now)["within"].text == f" ± {lift / drag * band.band / band.power:.1f}"
    assert (worth(now)["worth"], slopes_work(now)) == ({}, ())


def test_the_band_of_the_curve_is_asked_once_for_all_speeds():
    here, faster, heavier = (
        bands_call(now_at(replace(CHANGED, **changes)))
        for changes in ({}, {"advance_ratio": 0.25}, {"mass_t": 9.0})
    )
    assert here == faster is not None
    assert here != heavier
    assert here != bands_call(now_at(OPENING))  # Without a change, that of the power.
    assert bands_call(now_at(STAND)) is None


def test_in_the_hand_power_has_the_unit_of_the_page():
    now = replace(
        now_at(CHANGED, units="Aviation"),
        station=HeldStation("tip", LeastPower(3.0, 745699.872, held=True)),
    )
    shown = station_power(replace(now, change=-74569.9872))["hand"]
    assert shown.now == pytest.approx(
        AVIATION.power[0].of(now.state.solution.power.total), abs=0.01
    )
    assert shown.before == pytest.approx(shown.now + 100.0, abs=0.02)
    assert (shown.best.power, shown.place, shown.optimised) == (1000.0, "tip", None)
    assert station_power(replace(now, station=None)) == {"hand": None}


def test_in_the_hand_a_change_has_its_band_once_it_rests():
    before, now = solved(OPENING), now_at(CHANGED)
    assert now.state is not None
    change = now.state.solution.power.total - before.power.total
    now = replace(now, station=HeldStation("tip", None, before), change=change)
    sure = doubt(now.state.solution, before)
    assert sure.change_band is not None
    assert "±" not in station_power(now)["hand"].change
    assert station_power(soon(now))["hand"].power.endswith(f" ± {1e-3 * sure.band:.0f} kW")
    size, within, word = re.findall(
        r"(.+) ± (.+) kW, (.+)", station_power(soon(now))["hand"].change
    )[0]
    assert [float(text.replace("−", "-")) for text in (size, within)] == pytest.approx(
        [1e-3 * change, 1e-3 * sure.change_band], abs=0.51
    )
    assert word == sure.sureness


# The power card where power is near zero or negative: descent and autorotation


def flown(inputs: Inputs) -> PageState:
    solution = solve(inputs.design()).require()
    state = SessionState(inputs, ViewState(), solution, solve(baseline_of(solution.design)), None)
    return PageState(inputs, solution.design, state)


@pytest.mark.parametrize("climb", [-8.0, -13.0])
@pytest.mark.parametrize("outer", [0.0, -2.0])
def test_no_number_of_the_card_is_blank_in_descent(climb: float, outer: float):
    now = flown(replace(OPENING, advance_ratio=0.15, climb_m_s=climb, built_outer=outer))
    found = power_card(now)["power"]
    assert "–" not in line_text(now)
    assert sum(max(one.share, 0.0) for one in found.parts) == pytest.approx(1.0, abs=1e-4)


def test_autorotation_is_marked():
    now = flown(replace(OPENING, advance_ratio=0.15, climb_m_s=-13.0))
    found = line(now)
    assert re.search(
        r"descent 13\.0 m/s .* takes [\d.]+ kW from the air; driven by the air\.$", line_text(now)
    )
    assert found.status.words == "driven by the air"
    assert (
        "The air drives the rotor, which sinks by about 11 m/s in autorotation and by 13.0 here"
        in found.status.title
    )
    assert (
        line(flown(replace(OPENING, advance_ratio=0.15, climb_m_s=-10.8))).status.words
        == "autorotation"
    )
    assert (
        line(flown(replace(OPENING, advance_ratio=0.15, climb_m_s=-8.0))).status.words
        != "autorotation"
    )


def test_more_than_the_engines_give_is_said_in_the_line():
    """The UH-60A's two T700 give 2,327 kW by its rotor file."""
    fast = line(flown(replace(OPENING, advance_ratio=0.42)))
    assert fast.status.words == f"engines give only {number(2327.0)} kW"
    assert "The rotors need" in fast.status.title
    assert "engines" not in line(flown(replace(OPENING, advance_ratio=0.3))).status.words


def test_less_power_by_a_twist_that_nothing_on_board_makes_is_not_green():
    """And the line says so. The same waves in A are no part of the change."""
    active = replace(
        OPENING,
        advance_ratio=0.3,
        twist_per_rev=(Harmonic(2, math.radians(1.0), math.radians(40.0)),),
    )
    saving = min(
        (
            replace(active, twist_per_rev=(replace(active.twist_per_rev[0], phase=phase),))
            for phase in (0.0, math.pi)
        ),
        key=lambda inputs: solved(inputs).power.total,
    )
    shown = pieces(soon(now_at(saving)))
    assert shown["more"].text == " less"
    assert shown["moved"].kind == ""
    assert shown["against"].text == "as built"
    assert shown["reference"].text == f" ({number(1405.0)})"
    assert shown["unbuilt"].text == "; no actuator on board makes this"
    built = replace(OPENING, advance_ratio=0.3, built_outer=-2.0)
    assert "actuator" not in line_text(soon(now_at(built)))
    more = replace(saving, built_outer=3.0)
    assert "actuator" not in line_text(soon(now_at(more, saving)))
