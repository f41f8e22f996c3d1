"""What would pay on the stage: its words and its chart, without a browser."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from explorer.model.actuator_inputs import (
    MOST_SEGMENTS,
    ActuatorInputs,
    VerdictInputs,
    lean_verdict,
)
from explorer.model.inputs import Inputs, with_rotor
from explorer.model.units import SI
from explorer.parts.presses import SupposePress
from explorer.text.readout import change_sizes
from explorer.views.actuated import actuated_blade, immovable_kinds
from explorer.views.actuator import ACTUATOR
from explorer.views.assessed import ACTUATOR_CARD
from explorer.views.flight import earns_state
from explorer.views.line import LINE, line_text
from explorer.views.page_state import OpenPanels, PageState, SetAddress
from explorer.views.pay import PAY, move_supposed, read_place, take_kind
from explorer.workers.call import Call
from rotor import doubt, make_design, solve
from rotor.actuator import OtherStroke, Verdict, actuators, verdict_sentence, with_actuator
from rotor.support.chart import DrawnPoints
from rotor.trim.doubt import sureness
from tests.actuate import actuate, done, told, worked

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
    assert (shown.chart.x.label, shown.chart.y.label) == (
        "range of tip twist in flight [°]",
        "mass on board [kg]",
    )


@pytest.mark.parametrize(
    "text", ["", "4", "4,12,1", "91,12", "4,0", "4,-1", "1e9,1", "4,20000", "..,1", "nan,1"]
)
def test_a_place_that_is_none_is_refused_with_the_remedy(text: str):
    assert read_place("4.2,12") == (4.2, 12.0)
    with pytest.raises(ValueError, match=re.escape(repr(text)) + r".*write 4,12\."):
        read_place(text)


def test_a_supposed_actuator_is_dragged_and_stays_in_the_address(
    judged: PageState, lined: PageState
):
    """Read off the line of the one value; gone with a press."""
    shown = PAY.view(lined)
    assert (shown["suppose"], shown["actuator.pays"]) == (None, False)
    assert "Compare kinds" in shown["actuator.kinds"]
    assert "Computing" in PAY.view(done(judged, move_supposed(judged, "on")))["suppose"].words
    now = done(lined, move_supposed(lined, "on"))
    assert PAY.view(now) == PAY.view(replace(now))
    pressed = move_supposed(now, SupposePress(2.004, 4.3))
    assert pressed[-1] == SetAddress("i", "2,4.3")
    now = done(now, pressed)
    shown = PAY.view(now)["suppose"]
    # On the line: 3000·½·1.5 W of twist less 4.3·200 W of mass; 11.25 kg cost what the twist saves.
    assert (shown.words, shown.at) == (
        "2.0° for 4.3 kg saves 1.4 ± 0.4 kW (likely, from estimated data) over the mission",
        (2.0, 4.3),
    )
    assert shown.note == "With this range it pays below 11.2 ± 1.4 kg; with this mass, above 0.6°."
    assert (shown.kind, PAY.view(now)["actuator.pays"]) == ("gain", True)
    near = PAY.view(done(now, move_supposed(now, SupposePress(2.0, 11.0))))
    assert near["suppose"].words.endswith("(unclear) over the mission")
    assert (near["suppose"].kind, near["actuator.pays"]) == ("", False)
    line = actuated_blade(lined).line
    assert line is not None
    wide = replace(line, changes=np.linspace(0.0, 6000.0, 9)[None, :])
    unsure = done(told(ACTUATOR_CARD, judged, other_stroke=wide), move_supposed(judged, "on"))
    unsure = done(unsure, move_supposed(unsure, SupposePress(2.0, 4.3)))
    note = PAY.view(unsure)["suppose"].note
    assert note == "With this range no mass is sure to pay; with this mass, above 0.6°."
    heavy = done(now, move_supposed(now, SupposePress(2.0, 50.0)))
    assert (PAY.view(heavy)["suppose"].kind, PAY.view(heavy)["actuator.pays"]) == ("loss", False)
    assert move_supposed(now, "off")[-1] == SetAddress("i", None)
    assert PAY.view(done(now, move_supposed(now, "off")))["suppose"] is None


def asked_of(task: Call) -> VerdictInputs:
    (question,) = task.arguments
    assert isinstance(question, VerdictInputs)
    return question


def table_of(now: PageState) -> list[str]:
    """The rows of the table of kinds as text."""
    rows = re.findall(r"<tr[^>]*>(.*?)</tr>", PAY.view(now)["actuator.kinds"])
    return [re.sub(r"<[^>]*>", " ", row) for row in rows]


def test_the_table_of_kinds_has_the_verdict_of_each_as_it_comes(judged: PageState):
    """Same blade and mission; the words of sureness and the limits beside the number; a press takes one."""
    tried = replace(judged.hand.actuator, plies=4, chord=(0.2, 0.8))
    now = done(
        replace(judged, hand=replace(judged.hand, actuator=tried)), move_supposed(judged, "on")
    )
    tasks = actuated_blade(now).tasks
    assert next(iter(tasks)) == "MFC_P1"
    assert [asked_of(task).placement.plies for task in tasks.values()] == [
        4,
        *[2] * (len(tasks) - 1),
    ]
    passive = tasks["extension_twist"].run()
    strips = tasks["PZT5H_strips"].run()
    now = replace(now, answers={tasks["PZT5H_strips"]: strips})
    words = table_of(now)
    kinds = [id for id in tasks if id not in immovable_kinds(now)]
    assert len(words) == 1 + 2 * len(kinds)  # Below the heading two rows for each kind.
    size, band = change_sizes(strips.net_saving, strips.net_band, SI)
    row = 1 + 2 * sorted(kinds, key=list(actuators()).index).index("PZT5H_strips")
    assert f"+{size}{band}" in words[row]
    assert words[row + 1].strip().startswith("over its limits in fibre strain and mass; ")
    # One that cannot move the blade stands in the table once it is chosen.
    now = done(now, take_kind(now, "extension_twist"))
    tasks = actuated_blade(now).tasks
    passive = tasks["extension_twist"].run()
    now = replace(now, answers={tasks["extension_twist"]: passive})
    rows = re.findall(r"<tr[^>]*>(.*?)</tr>", PAY.view(now)["actuator.kinds"])
    words = table_of(now)
    size, band = change_sizes(passive.net_saving, passive.net_band, SI)
    assert passive.net_saving > passive.net_band  # Less power, and never green.
    row = len(words) - 2
    assert (f"−{size}{band}" in words[row], "gain" in rows[row]) == (True, False)
    assert words[row + 1].strip() == "forbidden by constant rotor speed; likely"
    taken = done(now, take_kind(now, "AFC")).hand.actuator
    assert (taken.actuator, taken.plies, taken.chord) == ("AFC", 2, ActuatorInputs().chord)
    assert take_kind(now, "nothing") == ()


def test_a_kind_that_constant_speed_forbids_says_so_first_and_is_never_green():
    """In the line, the card, the sentence of the command and the balance."""
    drives = (100.0,) * MOST_SEGMENTS
    now = actuate(INPUTS, actuator=ActuatorInputs("extension_twist", drives=drives))
    verdict = lean_verdict(actuated_blade(now).question)
    now = worked(LINE, told(ACTUATOR, now, lean_verdict=verdict))
    pieces = LINE.view(now)["line"].pieces
    assert "with extension twist (forbidden by constant rotor speed) at 100" in line_text(now)
    assert "good" not in {piece.kind for piece in pieces}
    assert verdict_sentence(verdict).startswith(
        "Forbidden by constant rotor speed; if it could work, it saves"
    )
    still = worked(LINE, actuate(INPUTS, actuator=ActuatorInputs("extension_twist")))
    assert line_text(still).endswith("kW: no change from the blade without it.")
    card = ACTUATOR_CARD.view(now)["assessed"]
    assert card.buildable == "not buildable: forbidden by constant rotor speed"
    assert card.earns.endswith(" kW less")
    assert card.sure.endswith(", if it could work")
    assert "gain" not in {bar.kind for bar in earns_state(verdict, True, SI).bars if bar.total}
    assert earns_state(verdict, True, SI).fuel_kind == ""
    assert actuated_blade(now).over_flight.kind == ""


def test_what_rests_on_values_without_a_source_is_never_sure():
    """One rule, for the page, the verdict and a design that carries the actuator."""
    assert (sureness(9.0, 1.0), sureness(9.0, 1.0, sourced=False), sureness(1.0, 2.0, sourced=False)) == (
        "sure", "likely", "unclear"
    )  # fmt: skip
    bare = make_design(mu=0.2, inflow="drees")
    flown, other = (solve(design).require() for design in (with_actuator(bare, "AFC"), bare))
    assert doubt(flown, other).sureness == "likely"
    assert flown.design.rotor.blade.carried is not None
    carried = replace(flown.design.rotor.blade.carried, sourced=True)
    rotor = replace(flown.design.rotor, blade=replace(flown.design.rotor.blade, carried=carried))
    known = solve(replace(flown.design, rotor=rotor)).require()
    assert doubt(known, other).sureness == "sure"


def test_at_the_chosen_actuator_it_says_what_the_card_says(lined: PageState):
    now = done(lined, move_supposed(lined, "on"))
    value, shown = actuated_blade(now), PAY.view(now)["suppose"]
    assert value.over_flight is not None
    assert shown.at == (round(math.degrees(value.range), 2), float(f"{value.mass:.3g}"))
    words = re.search(r"needs .* more \([^)]+\)", shown.words)
    card = ACTUATOR_CARD.view(now)["assessed"]
    assert words[0] == f"needs {card.earns} ({card.sure})"
    other = actuate(with_rotor(INPUTS, "s61"), on_stage=True)
    assert PAY.view(other)["suppose"] is None
    assert PAY.view(replace(other, problem="No trim.")) == {}
    assert not PAY.seen(OpenPanels("explore"))
