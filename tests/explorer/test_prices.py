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
from rotor.trim.stall_edge import AttachedRange, StallEdges

DESIGN = make_design(mu=0.35, mass_kg=9500.0, elements=12, azimuths=24, inflow="pitt-peters")
EDGES = StallEdges(True, AttachedRange(None, 0.3188), mass_kg=-620.0, twist_deg=2.14)


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
    assert lines[1:] == ("Ends below µ 0.319", "or with 0.62 t less", "or with Δ twist +2.1°/R")
    waits = prices(replace(now, answers={}))["prices"]["stall"]
    assert waits.lines == ("Computing …",)
    assert waits.stale
    latest = replace(now.memory, latest={"stall-edges": EDGES, "waterfall": steps()})
    old = prices(replace(now, answers={}, memory=latest))["prices"]["stall"]
    assert old.stale
    assert old.lines == lines


@pytest.mark.parametrize(
    ("separated", "low", "high", "words"),
    [
        (False, 0.26, 0.3, "None from µ 0.260 to 0.300"),
        (True, 0.26, 0.3, "None from µ 0.260 to 0.300"),
        (False, None, 0.3, "Begins above µ 0.300"),
        (False, 0.26, None, "Begins below µ 0.260"),
        (True, None, 0.3, "Ends below µ 0.300"),
        (True, 0.26, None, "Ends above µ 0.260"),
    ],
)
def test_the_speeds_without_separated_flow_are_said_as_far_as_they_are_known(
    separated: bool, low: float | None, high: float | None, words: str
):
    now = known()
    edges = StallEdges(separated, AttachedRange(low, high), mass_kg=None, twist_deg=None)
    (work,) = stall_edge_work(now)
    now = replace(now, answers={**now.answers, work.key: edges})
    assert prices(now)["prices"]["stall"].lines[1:] == (words,)


def test_an_edge_by_mass_begins_separated_flow_also_beside_a_range_of_speeds():
    """`None from µ 0.260 to 0.300` and then `or with …` would say that more mass leads to attached flow."""
    now = known()
    (work,) = stall_edge_work(now)
    edges = StallEdges(False, AttachedRange(0.26, 0.3), mass_kg=60.0, twist_deg=-1.5)
    now = replace(now, answers={**now.answers, work.key: edges})
    assert prices(now)["prices"]["stall"].lines[1:] == (
        "None from µ 0.260 to 0.300",
        "Begins with 0.06 t more",
        "or with Δ twist −1.5°/R",
    )
    edges = replace(edges, separated=True)
    now = replace(now, answers={**now.answers, work.key: edges})
    assert prices(now)["prices"]["stall"].lines[2] == "or with 0.06 t more"


def test_what_is_not_separated_has_no_price():
    design = make_design(mu=0.1, mass_kg=7000.0, elements=12, azimuths=24, inflow="pitt-peters")
    solution = solve(design)
    assert solution.stalled_area == 0.0
    state = SessionState(Inputs(), ViewState(), solution, solution, None)
    now = PageState(Inputs(), solution.design, state, ui=OpenPanels(disk=True))
    (work,) = stall_edge_work(now)
    edges = StallEdges(False, AttachedRange(None, 0.3), mass_kg=None, twist_deg=None)
    now = replace(now, answers={work.key: edges})
    assert prices(now)["prices"]["stall"].lines == ("Begins above µ 0.300",)


def test_with_other_effects_off_there_is_no_cost_and_without_stall_no_edge():
    assert prices(known("swirl"))["prices"]["reverse_flow"].lines == ()
    without = known("stall")
    shown = prices(without)["prices"]["stall"]
    assert stall_edge_work(without) == ()
    assert shown.press == "With stall"
    (line,) = shown.lines
    assert line.startswith(("Stall would cost ", "Stall would save "))


def test_one_press_switches_stall_off_and_on_and_only_the_disk_asks():
    now = known()
    (off,) = switch_stall(now, None)
    assert off == MoveSliders(replace(now.inputs, stall=False), by_hand=False)
    again = switch_stall(replace(now, inputs=replace(now.inputs, stall=False)), None)
    assert again == (MoveSliders(now.inputs, by_hand=False),)
    assert not PRICES.seen(OpenPanels())
