"""The waterfall on the page: the drawing adds up, and it is computed only when the page rests."""

import re
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest
import viser

from explorer.model.inputs import Inputs, ViewState
from explorer.model.session_state import SessionState
from explorer.model.units import AVIATION, HORSEPOWER, KILOWATT, SI
from explorer.tabs.waterfall import WaterfallPanel, _cost, waterfall_chart
from rotor.aero.switches import SWITCHES
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.study.series import Waterfall, waterfall
from rotor.trim.solution import Status
from rotor.trim.solve import solve


def coarse(mu: float) -> Design:
    design = make_design(mu=mu)
    return replace(design, models=replace(design.models, elements=12, azimuths=24, inflow="pitt-peters"))


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
        assert column[-1] == pytest.approx(unit.of(found.full.power.total), abs=0.05)

    def test_what_cannot_matter_says_why(self):
        steps = waterfall(coarse(0.0))
        assert "no drag in hover" in waterfall_chart(steps.steps)
        assert any("hover is the same at every azimuth" in _cost(step, SI) for step in steps.alone)

    def test_a_step_that_does_not_trim_is_named(self, found: Waterfall):
        lost = replace(found.steps[1].solution, status=Status.NOT_CONVERGED, message="Too <heavy>.")
        steps = (found.steps[0], replace(found.steps[1], solution=lost))
        svg = waterfall_chart(steps)
        assert "has no trim" in svg
        assert "Too &lt;heavy&gt;." in svg
        assert _cost(steps[1], SI) == "does not trim without it"


class TestPanel:
    @pytest.fixture
    def panel(self, server: viser.ViserServer) -> WaterfallPanel:
        self.costs: dict[str, str] = {}
        context: Any = SimpleNamespace(gui=server.gui, controls=SimpleNamespace(show_costs=self.costs.update))
        return WaterfallPanel(context)

    def test_it_comes_by_itself_and_never_while_superseded(self, panel: WaterfallPanel):
        solution = solve(coarse(0.2))
        state = SessionState(Inputs(), ViewState(), solution, solution, None, None)
        panel.solve_steps(lambda: False)  # Before there is an answer.
        panel.show(state)
        assert "Computing" in panel._chart.content
        panel.solve_steps(lambda: True)
        assert panel._steps == []
        asked = iter([False, False, True])
        panel.solve_steps(lambda: next(asked))
        assert len(panel._steps) == 2
        assert "Computing" in panel._chart.content  # Whole, or not at all: it would grow under the eyes.
        panel.solve_steps(lambda: False)  # Goes on where it was interrupted.
        assert len(panel._steps) == 2 * len(SWITCHES) + 1
        assert "All switched on" in panel._chart.content
        assert re.fullmatch(r"[+−]\d+\.\d kW here", self.costs["compressibility"])
        steps = panel._steps
        panel.show(replace(state, view=ViewState(azimuth_deg=90.0)))  # The azimuth does not start it again.
        assert panel._steps is steps
        assert "rx-faded" not in panel._chart.content

    def test_a_new_design_fades_the_old_answer_once(self, panel: WaterfallPanel):
        for mu in (0.1, 0.2, 0.3):
            solution = solve(coarse(mu))
            panel.show(SessionState(Inputs(), ViewState(), solution, solution, None, None))
            if mu == 0.1:
                panel.solve_steps(lambda: False)
        assert panel._chart.content.count("rx-faded") == 1
        assert panel._steps == []


def test_in_descent_the_bars_of_what_needs_power_fit_and_the_climb_has_its_colour():
    design = coarse(0.2).at(climb_m_s=-5.0)
    svg = waterfall_chart(waterfall(design).steps)
    right = [float(x) + float(width) for x, width in re.findall(r'<rect x="([\d.]+)" y="[\d.]+" width="([\d.]+)"', svg)]
    assert max(right) <= 258.0
    assert "climb −408 kW" in svg
    assert ">climb</span>" in svg
    assert ">climb</span>" not in waterfall_chart(waterfall(coarse(0.2)).steps)
