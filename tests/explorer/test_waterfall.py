"""The waterfall on the page: its rows add up, and it goes on where it was interrupted."""

import re
from dataclasses import replace
from typing import Any

import pytest

from explorer.model.inputs import Inputs, ViewState
from explorer.model.session_state import SessionState
from explorer.model.units import AVIATION, HORSEPOWER, KILOWATT, SI
from explorer.views.page_state import PageState
from explorer.views.waterfall import cost_words, costs, waterfall_chart, waterfall_work
from explorer.views.waterfall import waterfall as shown
from explorer.workers.call import at_once
from rotor import Design, make_design, solve
from rotor.aero.switches import SWITCHES
from rotor.study.series import Waterfall, waterfall


def coarse(mu: float) -> Design:
    return make_design(mu=mu, elements=12, azimuths=24, inflow="pitt-peters")


@pytest.fixture(scope="module")
def found() -> Waterfall:
    return waterfall(coarse(0.3))


def numbers(svg: str) -> list[float]:
    """The column at the right, as written."""
    shown = re.findall(r'class="rx-w rx-w-number[^>]*>([^<]+)<', svg)
    return [float(text.replace("−", "-").replace("\u2009", "")) for text in shown]


class TestDrawing:
    @pytest.mark.parametrize("units", [SI, AVIATION])
    def test_rows_add_up(self, found: Waterfall, units: Any):
        column = numbers(waterfall_chart(found.steps, units))
        assert len(column) == len(SWITCHES) + 2
        assert sum(column[:-1]) == pytest.approx(column[-1], abs=0.05 * len(column))
        unit = KILOWATT if units is SI else HORSEPOWER
        assert column[-1] == pytest.approx(unit.of(found.full.power or 0.0), abs=0.05)

    def test_lines_between_rows_lie_behind_every_word(self, found: Waterfall):
        svg = waterfall_chart(found.steps)
        assert svg.count("rx-w-link") == len(SWITCHES)
        assert svg.rindex("rx-w-link") < svg.index("<text")

    def test_what_cannot_matter_says_why(self):
        steps = waterfall(coarse(0.0))
        assert "no drag in hover" in waterfall_chart(steps.steps)
        assert any(
            "Hover is the same at every azimuth" in cost_words(step, SI) for step in steps.alone
        )

    def test_a_step_that_does_not_trim_is_named(self, found: Waterfall):
        steps = (found.steps[0], replace(found.steps[1], budget=None, message="Too <heavy>."))
        svg = waterfall_chart(steps)
        assert "has no trim" in svg
        assert "Too &lt;heavy&gt;." in svg
        assert cost_words(steps[1], SI) == "No trim without it"


def now_at(mu: float) -> PageState:
    solution = solve(coarse(mu))
    return PageState(
        Inputs(), solution.design, SessionState(Inputs(), ViewState(), solution, solution, None)
    )


def test_it_gives_way_after_each_trim_and_is_shown_whole_or_not_at_all():
    now = now_at(0.2)
    (work,) = waterfall_work(now)
    assert "Computing" in shown(now)["details.waterfall"]
    coming = work.run(lambda: None)
    # It gives way after each.
    assert [next(coming) for _ in range(2 * len(SWITCHES))] == [None] * 2 * len(SWITCHES)
    steps = at_once(coming)
    assert len(steps) == 2 * len(SWITCHES) + 1
    known = replace(
        now, answers={work.key: steps}, memory=replace(now.memory, latest={work.name: steps})
    )
    drawn = shown(known)
    assert "All switched on" in drawn["details.waterfall"]
    assert "data-stale" not in drawn["details.waterfall"]
    assert re.fullmatch(r"[+−]\d+\.\d kW here", costs(known)["switch.costs"]["compressibility"])
    assert "[hp]" in shown(in_units(known))["details.waterfall"]
    for other in (replace(now_at(0.3), memory=known.memory), replace(known, problem="No trim.")):
        stale = shown(other)["details.waterfall"]
        assert stale.count("data-stale") == 1
        assert drawn["details.waterfall"] in stale
    assert [one.key for one in waterfall_work(turned(known))] == [work.key]


def turned(now: PageState) -> PageState:
    assert now.state is not None
    return replace(now, state=replace(now.state, view=ViewState(azimuth_deg=90.0)))


def in_units(now: PageState) -> PageState:
    assert now.state is not None
    return replace(now, state=replace(now.state, view=ViewState(units="Aviation")))


def test_in_descent_the_bars_of_what_needs_power_fit_and_the_climb_has_its_colour():
    design = coarse(0.2).at(climb_m_s=-5.0)
    svg = waterfall_chart(waterfall(design).steps)
    right = [
        float(x) + float(width)
        for x, width in re.findall(r'<rect x="([\d.]+)" y="[\d.]+" width="([\d.]+)"', svg)
    ]
    assert max(right) <= 258.0
    assert "climb −408 kW" in svg
    assert ">climb</span>" in svg
    assert ">climb</span>" not in waterfall_chart(waterfall(coarse(0.2)).steps)
