"""What would pay on the stage: its words and its chart, without a browser."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from explorer.model.actuator_inputs import lean_verdict
from explorer.model.inputs import Inputs, with_rotor
from explorer.parts.presses import SupposePress
from explorer.views.actuated import actuated_blade
from explorer.views.actuator import ACTUATOR
from explorer.views.assessed import ACTUATOR_CARD
from explorer.views.page_state import OpenPanels, PageState, SetAddress
from explorer.views.pay import PAY, move_supposed, read_place
from rotor.actuator import OtherStroke, Verdict
from rotor.support.chart import DrawnPoints
from tests.actuate import actuate, done, told

INPUTS = Inputs(inflow="drees")


@pytest.fixture(scope="module")
def judged() -> PageState:
    now = actuate(INPUTS)
    one = actuated_blade(now)
    return told(ACTUATOR, now, lean_verdict=lean_verdict(one.question))


@pytest.fixture(scope="module")
def lined(judged: PageState) -> PageState:
    """With a made-up line of 4°: x(2 − x) of 3000 W, less 200 W per kilogram; band 800 x W, less 10 W per kilogram."""
    x = np.linspace(0.0, 1.0, 9)
    changes = 800.0 * x[None, :], np.array([-10.0])
    line = OtherStroke(math.radians(4.0) * x, 3000.0 * x * (2.0 - x), 200.0, *changes)
    return told(ACTUATOR_CARD, judged, other_stroke=line)


def test_points_are_what_the_verdicts_say(lined: PageState):
    """Each actuator at its range and mass, red where it does not pay; with its whole price in words."""
    shown = PAY.view(done(lined, move_supposed(lined, "on")))["suppose"]
    verdict = next(answer for answer in lined.answers.values() if isinstance(answer, Verdict))
    (point,) = [one for one in shown.chart.series if isinstance(one, DrawnPoints)]
    assert verdict.net_saving < 0.0
    assert point.colour == "var(--rx-bad)"
    assert point.x[0] == pytest.approx(math.degrees(verdict.installed.attainable), abs=1e-3)
    assert point.y[0] == pytest.approx(verdict.installed.masses.aircraft, rel=1e-3)
    assert point.names == ("MFC P1",)
    assert "more" in point.words[0]
    assert (shown.chart.x.label, shown.chart.y.label) == ("range of tip twist in flight [°]", "mass of all blades [kg]")


@pytest.mark.parametrize("text", ["", "4", "4,12,1", "91,12", "4,0", "4,-1", "1e9,1", "4,20000", "..,1", "nan,1"])
def test_a_place_that_is_none_is_refused_with_the_remedy(text: str):
    assert read_place("4.2,12") == (4.2, 12.0)
    with pytest.raises(ValueError, match=re.escape(repr(text)) + r".*write 4,12\."):
        read_place(text)


def test_a_supposed_actuator_is_dragged_and_stays_in_the_address(judged: PageState, lined: PageState):
    """Read off the line of the one value; gone with a press."""
    assert PAY.view(lined) == {"suppose": None, "actuator.pays": False}
    assert "Computing" in PAY.view(done(judged, move_supposed(judged, "on")))["suppose"].words
    now = done(lined, move_supposed(lined, "on"))
    assert PAY.view(now) == PAY.view(replace(now))
    pressed = move_supposed(now, SupposePress(2.004, 4.3))
    assert pressed[-1] == SetAddress("i", "2,4.3")
    now = done(now, pressed)
    shown = PAY.view(now)["suppose"]
    # On the line: 3000·½·1.5 W of twist less 4.3·200 W of mass; 11.25 kg cost what the twist saves.
    assert (shown.words, shown.at) == ("2.0° for 4.3 kg saves 1.4 ± 0.4 kW (sure) over the flight", (2.0, 4.3))
    assert shown.note == "With this range it pays below 11 ± 1.4 kg; with this mass, above 0.6°."
    assert (shown.kind, PAY.view(now)["actuator.pays"]) == ("gain", True)
    near = PAY.view(done(now, move_supposed(now, SupposePress(2.0, 11.0))))
    assert near["suppose"].words.endswith("(unclear) over the flight")
    assert (near["suppose"].kind, near["actuator.pays"]) == ("", False)
    heavy = done(now, move_supposed(now, SupposePress(2.0, 50.0)))
    assert (PAY.view(heavy)["suppose"].kind, PAY.view(heavy)["actuator.pays"]) == ("loss", False)
    assert move_supposed(now, "off")[-1] == SetAddress("i", None)
    assert PAY.view(done(now, move_supposed(now, "off")))["suppose"] is None


def test_at_the_chosen_actuator_it_says_what_the_card_says(lined: PageState):
    now = done(lined, move_supposed(lined, "on"))
    value, shown = actuated_blade(now), PAY.view(now)["suppose"]
    assert value.over_flight is not None
    assert shown.at == (round(math.degrees(value.range), 2), float(f"{value.mass:.3g}"))
    words = re.search(r"needs .* more \(\w+\)", shown.words)
    assert words[0] == ACTUATOR_CARD.view(now)["assessed"].flight
    other = actuate(with_rotor(INPUTS, "s61"), on_stage=True)
    assert PAY.view(other)["suppose"] is None
    assert PAY.view(replace(other, problem="No trim.")) == {}
    assert not PAY.seen(OpenPanels("explore"))
