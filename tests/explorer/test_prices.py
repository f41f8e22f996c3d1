"""What stall and reverse flow cost on the disk: the numbers of the waterfall, and a press that switches stall off."""

import re
from dataclasses import replace
from functools import cache

import pytest

from explorer.model.inputs import Inputs, ViewState
from explorer.model.session_state import SessionState
from explorer.model.units import SI
from explorer.views.page_state import MoveSliders, OpenPanels, PageState
from explorer.views.prices import PRICES, prices, stall_edge_work, switch_stall
from explorer.views.waterfall import costs, waterfall_chart, waterfall_work
from rotor import make_design, solve
from rotor.aero.switches import SWITCHES, with_switches
from rotor.study.series import WaterfallStep, waterfall

DESIGN = make_design(mu=0.35, mass_kg=9500.0, elements=12, azimuths=24, inflow="pitt-peters")
EDGES = True, 0.35, {"mu": -0.0312, "mass_kg": -620.0, "twist": 2.14}


@cache
def steps() -> tuple[WaterfallStep, ...]:
    found = waterfall(DESIGN)
    return (*found.steps, *found.alone)


def known(*off: str) -> PageState:
    """All is known of the design with these effects off."""
    solution = solve(with_switches(DESIGN, off))
    state = SessionState(Inputs(), ViewState(), solution, solution, None)
    now = PageState(Inputs(), solution.design, state, ui=OpenPanels(disk=True))
    work = (*waterfall_work(now), *stall_edge_work(now))
    return replace(
        now, answers=dict(zip((one.key for one in work), (steps(), EDGES), strict=False))
    )


def kilowatts(text: str) -> float:
    sign = -1.0 if "save" in text.lower() or "−" in text else 1.0
    return sign * float(re.search(r"\d+\.\d", text)[0])


def test_the_disk_says_what_the_waterfall_says():
    now, drawn = known(), waterfall_chart(steps()[: len(SWITCHES) + 1], SI)
    shown, beside = prices(now)["prices"], costs(now)["switch.costs"]
    for name in ("stall", "reverse_flow"):
        assert kilowatts(shown[name].lines[0]) == kilowatts(beside[name])
        without = next(step for step in steps()[len(SWITCHES) + 1 :] if step.switch.name == name)
        assert without.added is not None
        assert kilowatts(beside[name]) == pytest.approx(-without.added / 1e3, abs=0.05)
    column = re.findall(r'class="rx-w rx-w-number[^>]*>([^<]+)<', drawn)
    # The last effect that is added: all others are on.
    row = column[1 + list(SWITCHES).index("stall")]
    assert kilowatts(row) == kilowatts(shown["stall"].lines[0])
    assert shown["stall"].press == "Without stall"
    assert not shown["stall"].stale


def test_edges_are_said_in_the_units_of_the_page_and_stale_ones_are_marked():
    now = known()
    lines = prices(now)["prices"]["stall"].lines
    assert lines[1:] == ("Ends at µ 0.319", "or with 0.62 t less", "or with twist +2.1°/R")
    waits = prices(replace(now, answers={}))["prices"]["stall"]
    assert waits.lines == ("Computing …",)
    assert waits.stale
    latest = replace(now.memory, latest={"stall-edges": (False, *EDGES[1:]), "waterfall": steps()})
    old = prices(replace(now, answers={}, memory=latest))["prices"]["stall"]
    assert old.stale
    assert old.lines[1] == "Begins at µ 0.319"


def test_with_other_effects_off_there_is_no_cost_and_without_stall_no_edge():
    assert prices(known("swirl"))["prices"]["reverse_flow"].lines == ()
    without = known("stall")
    shown = prices(without)["prices"]["stall"]
    assert stall_edge_work(without) == ()
    assert shown.press == "With stall"
    assert len(shown.lines) == 1


def test_one_press_switches_stall_off_and_on_and_only_the_disk_asks():
    now = known()
    (off,) = switch_stall(now, None)
    assert off == MoveSliders(replace(now.inputs, stall=False), by_hand=False)
    again = switch_stall(replace(now, inputs=replace(now.inputs, stall=False)), None)
    assert again == (MoveSliders(now.inputs, by_hand=False),)
    assert not PRICES.seen(OpenPanels())
