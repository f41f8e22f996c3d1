"""What would pay on the stage: its words and its chart, without a browser."""

import math
import re
from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from explorer.hosting.messages import SupposePress
from explorer.model.units import SI
from explorer.sharing.share import Address
from explorer.tabs.actuator.what_would_pay import WhatWouldPay, mass_chart, place_of
from explorer.tabs.background import PoolAnswers
from rotor.actuator.catalogue import find_actuator
from rotor.actuator.optimum import ConditionPair
from rotor.actuator.pay import BreakEven, Supposed, pay_sentence
from rotor.actuator.section import Host, default_placement
from rotor.actuator.verdict import judge
from rotor.chart import Points
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept
from tests.curves import curves

DESIGN = make_design(inflow="drees")


def even(gain: float = 3000.0) -> BreakEven:
    """A made-up line: saving x(2 − x) of a range of 4°, 200 W per kilogram."""
    x = np.linspace(0.0, 1.0, 9)
    gross = gain * x * (2.0 - x)
    return BreakEven(
        ConditionPair(DESIGN, (0.0, 0.3)), 1.4e6, math.radians(4.0), math.radians(4.0) * x, gross, x, gross / 200.0
    )


def test_points_are_what_the_verdicts_say():
    """Each actuator at the reach of its tip and its mass, red where it does not pay; with its whole price in words."""
    design = make_design(inflow="drees", elements=16, azimuths=36)
    pair = ConditionPair(design, (0.0, 0.3))
    judged = judge(find_actuator("MFC_P1"), pair, find_concept("linear"), default_placement(2), Host("new", 0.5))
    line = replace(even(4000.0), pair=pair)
    chart = mass_chart(line, [judged])
    point = chart.series[-1]
    assert isinstance(point, Points)
    assert judged.net_saving < 0.0
    assert point.colour == "var(--rx-bad)"
    assert point.x[0] == pytest.approx(math.degrees(judged.installed.attainable))
    assert point.y[0] == pytest.approx(judged.installed.masses.aircraft)
    assert point.names == ("MFC P1",)
    assert f"needs {-judged.net_saving / 1e3:.0f} kW more" in point.words[0]
    assert not [one for one in mass_chart(line).series if isinstance(one, Points)]
    edge = curves(chart)[1]
    assert point.y[0] > np.interp(point.x[0], edge.x, edge.y)  # More mass than pays.


@pytest.mark.parametrize("text", ["", "4", "4,12,1", "91,12", "4,0", "4,-1", "1e9,1", "4,20000", "..,1", "nan,1"])
def test_a_place_that_is_none_is_refused_with_the_remedy(text: str):
    assert place_of("4.2,12") == (4.2, 12.0)
    with pytest.raises(ValueError, match=re.escape(repr(text)) + r".*write 4,12\."):
        place_of(text)


Stage = dict[str, Any]
Press = Callable[[Any], None]


@pytest.fixture
def opened():
    """Opened with a query: it, what it sets on the stage, its press, and the queries it writes."""

    def made(query: str = "") -> tuple[WhatWouldPay, Stage, Press, list[str], list[tuple[str, str]]]:
        stage: Stage = {}
        presses: dict[str, Press] = {}
        written: list[str] = []
        problems: list[tuple[str, str]] = []
        bridge = SimpleNamespace(set=stage.update, on=presses.__setitem__)
        context: Any = SimpleNamespace(pool=None, wake=lambda: None, bridge=bridge, held=False, units=SI)
        pay = WhatWouldPay(context, Address(query, written.append, pause=0.0), problems)
        return pay, stage, presses["suppose"], written, problems

    return made


def test_a_supposed_actuator_is_dragged_and_stays_in_the_address(opened: Any, monkeypatch: pytest.MonkeyPatch):
    """Read off the line at once, and told with its band when it is trimmed; gone with a press."""
    line, known = even(), dict[str, Any]()
    pair = line.pair
    monkeypatch.setattr(PoolAnswers, "ask", lambda self, tasks, delay: None)
    monkeypatch.setattr(PoolAnswers, "answer", lambda self, task: known.get(task.function.__name__))
    pay, stage, press, written, _ = opened("d=1")
    pay.refresh(pair)
    assert stage["suppose"] is None
    press("on")
    pay.refresh(pair)
    assert "Trimming" in stage["suppose"]["words"]
    known["break_even"] = line
    press(SupposePress(2.0, 4.3))
    pay.refresh(pair)
    # On the line: 3000·½·1.5 W of twist less 4.3·200 W of mass.
    assert stage["suppose"]["words"] == "2.0° for 4.3 kg saves 1.4 kW …"
    assert stage["suppose"]["at"] == [2.0, 4.3]
    assert stage["suppose"]["note"].endswith(f" kg, less what its drive takes. {pay_sentence(line)}")
    assert pay.pays
    assert written[-1].endswith("i=2,4.3")
    known["suppose"] = Supposed(1100.0, 0.0001, 300.0)
    pay.refresh(pair)
    assert stage["suppose"]["words"] == "2.0° for 4.3 kg saves 1.1 kW (± 0.3 kW: sure), −0.4 kg of fuel an hour"
    assert stage["suppose"]["kind"] == "gain"
    known["suppose"] = Supposed(1100.0, 0.0001, 1500.0)
    pay.refresh(pair)
    assert "cannot be told" in stage["suppose"]["words"]
    pay.rest()  # Another mode may show another design: the shared picture does not speak of this one.
    assert not pay.pays
    pay.refresh(pair)
    assert "cannot be told" in stage["suppose"]["words"]
    assert (stage["suppose"]["kind"], pay.pays) == ("", False)
    known["suppose"] = "No trim there."
    pay.refresh(pair)
    assert stage["suppose"]["note"] == "No trim there."
    del known["suppose"]
    press(SupposePress(2.0, 50.0))
    pay.refresh(pair)
    assert stage["suppose"]["kind"] == "loss"
    assert not pay.pays
    press("off")
    pay.refresh(pair)
    assert stage["suppose"] is None
    assert "i=" not in written[-1]


def test_a_link_holds_the_supposed_actuator(opened: Any):
    pay, *_, problems = opened("d=1&i=3.2,9")
    assert pay.on_stage
    assert not problems
    pay, *_, problems = opened("d=1&i=3.2;9")
    assert not pay.on_stage
    assert "write 4,12" in problems[0][1]
