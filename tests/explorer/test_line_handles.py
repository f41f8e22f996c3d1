"""The handles of the line: what opens below its words, what a choice does, and how a link and undo keep it."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cache

import msgspec
import pytest

from explorer.model.actuator_inputs import AGAINST, ActuatorInputs, HandSettings, read_against
from explorer.model.inputs import LAWS, NOT_ALWAYS, OPENING, Inputs, ViewState
from explorer.model.session_state import Pinboard, Pinned, Pins, SessionState, compared_with
from explorer.model.sliders import slider
from explorer.model.stand import StandInputs
from explorer.model.undo import KeptDesign
from explorer.model.units import AVIATION, KNOT, SI, Units
from explorer.parts.presses import PRESSES
from explorer.parts.results import LineControl, LineMenu, LinePiece
from explorer.text.line import blade_pieces, flight_pieces, plain
from explorer.views.line import BUILT, LINE, THIS, line
from explorer.views.page_state import Effect, OpenPanels, PageState, PinDesign, PinOrder, SetHand
from rotor import Solution, solve
from rotor.actuator.catalogue import actuators
from rotor.design import TableTwist

COARSE = replace(OPENING, elements=16, azimuths=24, inflow="drees")
"""Quick to trim."""
CHANGED = replace(COARSE, built_outer=-2.0)
MARKED = replace(COARSE, built_outer=-1.0)
TABLE = TableTwist((0.15, 0.6, 1.0), (0.14, 0.02, -0.1))


@cache
def solved(inputs: Inputs) -> Solution:
    return solve(inputs.design()).require()


def compared(
    inputs: Inputs, pinned: Inputs | None = None, kept: Sequence[Inputs] = ()
) -> PageState:
    """The page in Explore with this design, A and bookmarks."""
    solution, baseline = solved(inputs), solved(COARSE)
    pin = None if pinned is None else Pinned(pinned, solved(pinned))
    answer = None if pin is None else pin.solution
    state = SessionState(inputs, ViewState(), solution, baseline, answer, pin)
    marks = tuple(KeptDesign(one, solved(one)) for one in kept)
    return PageState(inputs, inputs.design(), state, pins=Pins(pin, answer), kept=marks)


def menus(pieces: Sequence[LinePiece]) -> dict[str, LineMenu]:
    return {piece.menu.name: piece.menu for piece in pieces if piece.menu is not None}


def numbers(pieces: Sequence[LinePiece]) -> dict[str, LineControl]:
    return {piece.control.name: piece.control for piece in pieces if piece.control is not None}


def chosen(menu: LineMenu) -> list[str]:
    return [option.title for option in menu.options if option.chosen]


def press(now: PageState, wanted: str | int) -> tuple[Effect, ...]:
    return LINE.presses["compare"](now, wanted)


# Numbers


@pytest.mark.parametrize(("units", "said"), [(SI, "159 km/h"), (AVIATION, "86 kt")])
def test_airspeed_is_another_number_of_the_slider_of_advance_ratio(units: Units, said: str):
    pieces = flight_pieces(OPENING, units)
    assert f" at µ 0.200 ({said})" in plain(pieces)
    named = numbers(pieces)
    speed, ratio = named["airspeed"], named["advance_ratio"]
    assert (speed.slider, speed.words) == (ratio.slider, said) == ("advance_ratio", said)
    form = slider("advance_ratio", units, OPENING.aircraft)
    for one in (speed, ratio):
        assert (one.value, one.low, one.high, one.step) == (0.2, form.low, form.high, form.step)
    size = KNOT.size if units is AVIATION else 1.0 / 3.6
    assert speed.factor * speed.value == pytest.approx(0.2 * OPENING.tip_speed / size)
    assert "airspeed" not in numbers(flight_pieces(replace(OPENING, advance_ratio=0.0), units))
    tested = replace(OPENING, stand=StandInputs("wind-tunnel", value=0.08))
    assert "airspeed" not in numbers(flight_pieces(tested, units))


# The twist law


@pytest.mark.parametrize("law", LAWS)
def test_one_word_of_the_twist_opens_the_menu_of_laws(law: str):
    inputs = replace(OPENING, law=law, given=TABLE, optimised=None)
    pieces = blade_pieces(inputs, inputs.design())
    words = [piece.text for piece in pieces if piece.menu is not None]
    named = law == "ideal" or (law == "given" and "as built" not in plain(pieces))
    assert len(words) == 1
    assert (words == ["twist"]) == (not named)
    menu = menus(pieces)["law"]
    assert chosen(menu) == ([] if law == "optimised" else [LAWS[law].title])
    offered = [option.value for option in menu.options]
    assert offered == [one for one in LAWS if one not in NOT_ALWAYS or one == "given"]
    assert {option.press for option in menu.options} == {"law"}


# What it is compared with


def test_the_design_is_compared_with_the_blade_as_built_a_or_a_bookmark():
    now = compared(CHANGED, kept=[MARKED])
    menu = menus(line(now).pieces)["than"]
    built, this, marked = menu.options
    assert (chosen(menu), this.title) == (["as built"], "this design: keep it as A")
    assert marked.title == "bookmark: UH-60A as built + segments 0/−1 at 0.5, µ 0.2, 8.32 t"
    assert press(now, built.value) == ()
    assert press(now, this.value) == (PinOrder("pin"),)
    (pin,) = press(now, marked.value)
    assert isinstance(pin, PinDesign)
    assert compared_with(pin.design) == compared_with(MARKED)
    assert press(now, 1) == ()  # Deleted meanwhile.
    # A that is a bookmark is named once; another one has a row of its own.
    now = compared(CHANGED, MARKED, kept=[MARKED])
    menu = menus(line(now).pieces)["than"]
    assert chosen(menu) == [marked.title]
    assert len(menu.options) == 2
    assert press(now, BUILT) == (PinOrder("unpin"),)
    menu = menus(line(compared(CHANGED, MARKED)).pieces)["than"]
    assert chosen(menu) == ["A: UH-60A as built + segments 0/−1 at 0.5"]
    assert THIS not in [option.value for option in menu.options]
    # Where it is A itself, that word opens them too.
    same = line(compared(MARKED, MARKED)).pieces
    assert ": same as A" in plain(same)
    assert "than" in menus(same)
    assert "than" not in menus(line(compared(COARSE)).pieces)


def test_a_bookmark_is_compared_with_its_actuator():
    """It was named with it, and compared without."""
    kept = acting().state
    assert kept is not None
    now = replace(compared(CHANGED), kept=(KeptDesign(kept.inputs, kept.solution.light()),))
    bookmark = menus(line(now).pieces)["than"].options[-1]
    assert "MFC P1" in bookmark.title
    (pin,) = press(now, bookmark.value)
    assert isinstance(pin, PinDesign)
    assert pin.design.solution.design == kept.solution.design
    board = Pinboard()
    board.put(pin.design)
    board.act(CHANGED, None)
    assert board.compared == compared_with(pin.design)


# In Actuate


def acting(against: str = "same-blade") -> PageState:
    hand = HandSettings(ActuatorInputs(against=read_against(against)), on_board=True)
    solution = solve(hand.fit(COARSE.design())).require()
    state = SessionState(COARSE, ViewState(), solution, solved(COARSE), None)
    ui = OpenPanels("actuate")
    return PageState(COARSE, COARSE.design(), state, ui=ui, hand=hand)


@pytest.mark.parametrize("against", AGAINST)
def test_in_actuate_actuator_and_blade_to_count_from_are_chosen(against: str):
    now = acting(against)
    pieces = line(now).pieces
    named = menus(pieces)
    assert [option.value for option in named["actuator"].options] == list(actuators())
    assert chosen(named["actuator"]) == ["MFC P1: d33 fibres"]
    blades = named["than"].options
    assert [option.value for option in blades if option.chosen] == [against]
    assert tuple(option.value for option in blades) == AGAINST
    # Until the best blade is found, the line names it all the same.
    words = "than without it" if against == "same-blade" else "from the best fixed blade …"
    assert words in plain(pieces)
    # Also where the blade is in the rotor, and its card is not shown.
    assert LINE.presses["against"](now, "best-fixed") == (
        SetHand(actuator={"against": "best-fixed"}),
    )


def test_each_choice_is_a_press_of_the_page():
    lines = [line(now).pieces for now in (acting(), compared(CHANGED, MARKED, kept=[COARSE]))]
    options = [
        option for pieces in lines for menu in menus(pieces).values() for option in menu.options
    ]
    assert {option.press for option in options} == {"law", "kind", "against", "compare"}
    for option in options:
        assert msgspec.convert(option.value, PRESSES[option.press]) == option.value


# Links


def test_a_link_names_the_blade_that_changes_count_from():
    assert [read_against(text) for text in AGAINST] == list(AGAINST)
    with pytest.raises(
        ValueError, match="The comparison 'best' is not known: choose same-blade or"
    ):
        read_against("best")


# Undo


def test_what_was_a_is_a_again_with_its_actuator():
    """Its inputs do not say what it had on board."""
    carried = Pinned(COARSE, acting().state.solution)  # pyright: ignore[reportOptionalMemberAccess]
    bare = Pinned(MARKED, solved(MARKED))
    board = Pinboard()
    for pinned in (carried, bare, None):
        board.pin(pinned)
    with_actuator = compared_with(carried)
    board.put_back(with_actuator)
    assert board.compared == with_actuator
    assert with_actuator != compared_with(COARSE)
    board.act(CHANGED, None)
    assert board.pinned is carried
    board.put(COARSE)
    board.act(CHANGED, None)
    assert board.pinned is not None
    assert board.pinned.solution.design.rotor.blade.carried is None
    board.put_back(compared_with(carried))
    board.act(CHANGED, None)
    assert board.pinned is carried
    board.put_back(compared_with(None))
    board.act(CHANGED, None)
    assert board.pinned is None
