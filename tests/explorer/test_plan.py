"""The plan of the disk: values under the pointer, shares of the regions, and fields whose sum is known."""

import base64
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from explorer.model.inputs import Inputs, ViewState
from explorer.model.session_state import SessionState
from explorer.parts.stage import PackedTable
from explorer.picture.element import probe
from explorer.picture.fields import FIELDS
from explorer.picture.plan import plan
from explorer.picture.polar import CLEAR_OF_REVERSE, DrawnSolution, polar_grid
from explorer.widgets.display import Display
from rotor import Solution, make_design, solve
from rotor.aero.switches import with_switches
from rotor.support.arrays import Array
from tests.fake_bridge import Bridge

ALPHA, MACH = FIELDS["Angle of attack"], FIELDS["Mach number"]


@pytest.fixture(
    scope="module", params=[(0.2, 8322.0), (0.4, 10000.0)], ids=["mu 0.2", "mu 0.4, heavy"]
)
def solution(request: pytest.FixtureRequest) -> Solution:
    mu, mass = request.param
    return solve(make_design(mu=mu, mass_kg=mass))


def table(packed: PackedTable, like: Array) -> Array:
    steps = np.frombuffer(base64.b64decode(packed.data), "<u2").reshape(like.shape)
    return packed.low + packed.step * steps


def test_regions_cover_as_much_of_the_disk_as_the_solution_says(solution: Solution):
    regions = solution.regions
    shown = {one.name: one for one in plan(solution, ViewState(), ALPHA, (0.0, 9.0), False).regions}
    for name, area, thrust in (
        ("stall", solution.stalled_area, solution.stalled_thrust),
        ("past_static", solution.past_static_area, regions.past_static_thrust),
        ("reverse_flow", solution.reverse_flow_area, regions.reverse_flow_thrust),
        ("drag_divergence", regions.drag_divergence, regions.drag_divergence_thrust),
    ):
        if name in shown:
            words = f"{100.0 * area:.1f} % area · {100.0 * thrust:z.1f} % thrust"
            assert shown[name].words == words.replace("-", "−")
            assert len(shown[name].lines) > 0
        else:
            assert area < 0.001
    # Where the flow is slow there is little lift to lose.
    assert abs(solution.stalled_thrust) < solution.stalled_area
    # Air from behind presses the blade down there.
    assert regions.reverse_flow_thrust < 0.0


def test_values_under_the_pointer_are_those_of_the_stations_and_of_the_field(solution: Solution):
    shown, disk = plan(solution, ViewState(), MACH, (0.0, 0.9), at_rest=True), solution.disk
    assert shown.coloured is not None
    assert shown.values is not None
    coloured = MACH.sample(DrawnSolution(solution), polar_grid(disk, 40, 120))
    assert (
        np.abs(table(shown.coloured, coloured) - coloured).max()
        <= 0.51 * shown.coloured.step + 1e-9
    )
    assert shown.values.r == pytest.approx(disk.r, abs=1e-6)
    assert math.radians(shown.values.first) == pytest.approx(disk.psi[0])
    tables = {name: table(packed, disk.mach) for name, packed in shown.values.tables.items()}
    phi = np.degrees(np.arctan2(tables["u_p"], tables["u_t"]))
    turn = tables["theta"] + tables["ahead"] - phi - np.degrees(disk.alpha)
    assert (
        np.abs(np.remainder(turn + 180.0, 360.0) - 180.0)[tables["u_t"] > CLEAR_OF_REVERSE].max()
        < 0.01
    )
    margin = np.minimum(
        np.degrees(disk.alpha) - tables["lower"], tables["upper"] - np.degrees(disk.alpha)
    )
    for row, column in ((4, 3), (12, 9), (20, 17)):
        there = probe(solution, float(disk.r[row]), float(disk.psi[column]))
        assert tables["cl"][row, column] == pytest.approx(there.cl, abs=1e-4)
        assert tables["mach"][row, column] == pytest.approx(there.mach, abs=1e-4)
        if there.stall_margin is not None:
            assert margin[row, column] == pytest.approx(math.degrees(there.stall_margin), abs=0.01)


def test_a_moving_plan_carries_no_values_and_switches_hide_regions(solution: Solution):
    moving = plan(
        solution, ViewState(stall=False, past_static=False), ALPHA, (-4.0, 10.0), at_rest=False
    )
    assert moving.values is None
    assert {"stall", "past_static"}.isdisjoint(one.name for one in moving.regions)


def test_the_field_of_a_is_on_the_plan_while_it_is_wiped(solution: Solution):
    other, drawn = solve(make_design(mu=0.3)), (ALPHA, (-4.0, 10.0), False)
    wiped = plan(solution, ViewState(wipe=True), *drawn, other).wiped
    assert wiped == plan(other, ViewState(), *drawn).disk
    assert wiped != plan(solution, ViewState(), *drawn).disk
    assert plan(solution, ViewState(), *drawn, other).wiped is None


def test_outlines_of_the_pinned_design_stand_beside(solution: Solution):
    other = solve(make_design(mu=0.3))
    shown = plan(solution, ViewState(), ALPHA, (-4.0, 10.0), True, other)
    reverse = next(one for one in shown.regions if one.name == "reverse_flow")
    own, before = (
        max(np.abs(np.concatenate(lines)[:, 0])) for lines in (reverse.lines, reverse.before)
    )
    tilt = np.cos([s.controls.shaft_tilt for s in (solution, other)])
    assert [own, before] == pytest.approx(
        [solution.design.condition.advance_ratio * tilt[0], 0.3 * tilt[1]], abs=1e-3
    )
    assert shown.before is not None
    assert (
        np.abs(table(shown.before.tables["mach"], other.disk.mach) - other.disk.mach).max() < 1e-4
    )


@pytest.mark.parametrize(
    ("title", "part", "within"),
    [
        ("Power dP/dr", "shaft", 0.01),
        ("Induced power dP/dr", "induced", 0.01),
        ("Profile power dP/dr", "profile", 0.03),
    ],
)
def test_power_fields_sum_to_the_power_by_parts(
    solution: Solution, title: str, part: str, within: float
):
    grid, rotor = polar_grid(solution.disk, 120, 480), solution.design.rotor
    per_metre = FIELDS[title].sample(DrawnSolution(solution), grid).mean(axis=1)
    total = 1e3 * per_metre.sum() * (grid.r[1] - grid.r[0]) * rotor.radius * rotor.blades
    assert total == pytest.approx(getattr(solution.power, part), rel=within)


def test_the_key_says_which_regions_the_disk_has_none_of():
    """Only of those that are shown: the others are off."""
    page: Any = Bridge()

    def told(mu: float, off: tuple[str, ...] = (), **view: Any) -> Mapping[str, str]:
        solution, shown = solve(with_switches(make_design(mu=mu), off)), ViewState(**view)
        display = Display(page, shown, lambda: None, lambda: None)
        display.show_range(ALPHA, (0.0, 9.0), False, (False, False))
        display.show(SessionState(Inputs(), shown, solution, solution, None))
        return page.state["field"].shares

    assert told(0.0) == dict.fromkeys(
        ("stall", "past_static", "reverse_flow", "drag_divergence"), "none"
    )
    assert (
        told(0.0, stall=False, past_static=False, reverse_flow=False, drag_divergence=False) == {}
    )
    assert told(0.2) == {"stall": "0.1 %", "past_static": "2.0 %", "drag_divergence": "none"}
    assert told(0.2, ("stall",))["stall"] == "not modelled"
    assert told(0.2, ("dynamic_stall",))["past_static"] == "none"
    assert told(0.302) == {
        "stall": "0.0 %",
        "past_static": "1.8 %",
    }  # As the plan says beside its outline.
