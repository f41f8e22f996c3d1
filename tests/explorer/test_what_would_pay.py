"""What would pay on the stage: its words and its chart, without a browser."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from explorer.model.inputs import Inputs, with_rotor
from explorer.parts.presses import SupposePress
from explorer.views.now import SetAddress, Ui
from explorer.views.pay import PAY, mass_chart, place_it, place_of
from rotor.actuator.catalogue import find_actuator
from rotor.actuator.optimum import ConditionPair
from rotor.actuator.pay import BreakEven, Supposed, pay_sentence
from rotor.actuator.section import Host, default_placement
from rotor.actuator.verdict import judge
from rotor.chart import Points
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept
from tests.actuate import actuate, asked, done, told
from tests.curves import curves

DESIGN = make_design(inflow="drees")
INPUTS = Inputs(inflow="drees")


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


def test_a_supposed_actuator_is_dragged_and_stays_in_the_address():
    """Read off the line at once, and told with its band when it is trimmed; gone with a press."""
    now, line = actuate(INPUTS), even()
    assert PAY.view(now) == {"suppose": None, "actuator.pays": False}
    assert asked(PAY, now) == {}
    now = done(now, place_it(now, "on"))
    assert "Trimming" in PAY.view(now)["suppose"].words
    now = told(PAY, now, break_even=line)
    assert PAY.view(now) == PAY.view(replace(now))
    pressed = place_it(now, SupposePress(2.004, 4.3))
    assert pressed[-1] == SetAddress("i", "2,4.3")
    now = done(now, pressed)
    shown = PAY.view(now)["suppose"]
    # On the line: 3000·½·1.5 W of twist less 4.3·200 W of mass.
    assert (shown.words, shown.at, shown.kind) == ("2.0° for 4.3 kg saves 1.4 kW …", (2.0, 4.3), "gain")
    assert shown.note.endswith(f" kg, less what its drive takes. {pay_sentence(line)}")
    assert PAY.view(now)["actuator.pays"]
    assert list(asked(PAY, now)) == ["suppose", "break_even"]
    for saving, words, kind in (
        (Supposed(1100.0, 0.0001, 300.0), "saves 1.1 kW (± 0.3 kW: sure), −0.4 kg of fuel an hour", "gain"),
        (Supposed(1100.0, 0.0001, 1500.0), "cannot be told", ""),
    ):
        trimmed = PAY.view(told(PAY, now, suppose=saving))
        assert words in trimmed["suppose"].words
        assert (trimmed["suppose"].kind, trimmed["actuator.pays"]) == (kind, kind == "gain")
    assert PAY.view(told(PAY, now, suppose="No trim there."))["suppose"].note == "No trim there."
    heavy = done(now, place_it(now, SupposePress(2.0, 50.0)))
    assert (PAY.view(heavy)["suppose"].kind, PAY.view(heavy)["actuator.pays"]) == ("loss", False)
    assert place_it(now, "off")[-1] == SetAddress("i", None)
    assert PAY.view(done(now, place_it(now, "off")))["suppose"] is None


def test_it_stands_at_the_chosen_actuator_at_first_and_nowhere_on_another_rotor():
    now = told(PAY, actuate(INPUTS, on_stage=True), break_even=even())
    assert PAY.view(now)["suppose"].at == (2.0, 2.0 * even().masses[-1])
    other = actuate(with_rotor(INPUTS, "s61"), on_stage=True)
    assert PAY.view(other)["suppose"] is None
    assert PAY.view(replace(other, problem="No trim.")) == {}
    assert not PAY.seen(Ui("explore"))
