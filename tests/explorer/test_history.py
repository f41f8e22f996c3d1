"""Undo and redo, the change since a grab, and designs and views in the address of the page."""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from explorer.model.inputs import Inputs, ViewState
from explorer.model.undo import PAUSE, STEPS, History, LongestPause, PowerTracker
from explorer.model.units import UNITS
from explorer.picture.fields import FIELDS
from explorer.sharing.share import (
    DESIGN,
    LONGEST,
    Address,
    StoredHistory,
    code_of,
    inputs_from,
    read_history,
    view_code,
    view_from,
)
from rotor.design.aircraft import RotorFiles

START = Inputs()
LONG, DIGITS = 5.0, "9" * 400
VIEWS = st.builds(
    ViewState, field=st.sampled_from(tuple(FIELDS)), exaggeration=st.sampled_from((1.0, 1.5, 5.0, 6.0)),
    difference=st.booleans(), reverse_flow=st.booleans(), stall=st.booleans(), past_static=st.booleans(),
    drag_divergence=st.booleans(),
    units=st.sampled_from(tuple(UNITS)), wake=st.booleans(),
)  # fmt: skip
FIRST = Inputs(law="linear", linear=-8.0)
DRAG = 0.05
"""[s] between two movements of a drag."""


def drag(history: History, name: str, values: list[float], pause: float) -> None:
    """The first movement after a pause, the others close behind."""
    for k, value in enumerate(values):
        history.note(replace(history.present, **{name: value}), pause if k == 0 else 0.05)


class TestHistory:
    def test_a_drag_is_one_step(self):
        history = History(START)
        assert history.note(replace(START, two_inner=-14.5), LONG)
        assert not history.note(replace(START, two_inner=-15.0), 0.05)
        drag(history, "two_inner", [-15.5, -16.0], 0.05)
        drag(history, "two_outer", [-7.0, -6.0], 0.3)
        assert len(history.past) == 2
        assert history.undo() == replace(START, two_inner=-16.0)
        assert history.undo() == START
        assert history.undo() is None

    def test_a_pause_or_an_undo_begins_another_step(self):
        history = History(START)
        drag(history, "two_inner", [-15.0], LONG)
        drag(history, "two_inner", [-16.0], LONG)
        assert history.undo() == replace(START, two_inner=-15.0)
        drag(history, "two_inner", [-17.0], 0.1)
        assert history.undo() == replace(START, two_inner=-15.0)

    def test_slow_answers_do_not_split_a_drag(self):
        pauses = LongestPause()
        for time in (10.0, 10.1, 10.2):
            pauses.moved(time)
        assert pauses.longest() > PAUSE  # Nothing had moved before.
        for time in (10.3, 10.4):  # The answer to the last took long: it is asked for at 14.
            pauses.moved(time)
        assert pauses.longest() == pytest.approx(0.1)
        pauses.moved(16.0)
        assert pauses.longest() > PAUSE

    def test_a_rest_in_the_hand_is_no_pause_and_the_last_movement_may_come_after_the_release(self):
        pauses, history = LongestPause(), History(START)
        pauses.begin(10.0)
        history.hold()
        for time in (10.1, 14.0):
            pauses.moved(time)
            history.note(replace(START, two_inner=0.5 - time), pauses.longest())
        pauses.moved(17.0)
        pauses.begin(17.1)
        history.release()
        pauses.moved(17.2)
        assert not history.note(replace(START, two_inner=-16.0), pauses.longest())
        assert history.undo() == START

    def test_redo_until_something_else_is_moved(self):
        history = History(START)
        drag(history, "two_inner", [-15.0], LONG)
        drag(history, "advance_ratio", [0.3], LONG)
        history.undo()
        history.undo()
        assert history.redo() == replace(START, two_inner=-15.0)
        # The page's own echo is no step and drops none.
        assert not history.note(history.present, 0.1)
        assert history.redo() == replace(START, two_inner=-15.0, advance_ratio=0.3)
        history.undo()
        drag(history, "mass_t", [9.0], LONG)
        assert history.redo() is None

    def test_a_hundred_steps_are_kept(self):
        history = History(START)
        for k in range(150):
            history.note(replace(START, mass_t=5.0 + 0.04 * k), LONG)
        assert len(history.past) == STEPS == 100
        while history.undo() is not None:
            pass
        assert history.present == replace(START, mass_t=5.0 + 0.04 * 49)
        assert len(history.future) == STEPS


class TestStoredHistory:
    STEPS = tuple(replace(START, two_inner=-12.0 - k) for k in range(4))
    TEXT = StoredHistory(STEPS[:2], STEPS[2], STEPS[3:], (STEPS[1],)).text()

    def test_a_reload_finds_the_same_steps(self):
        assert read_history(self.TEXT, self.STEPS[2]) == StoredHistory(
            self.STEPS[:2], self.STEPS[2], self.STEPS[3:], (self.STEPS[1],)
        )

    def test_a_link_opened_in_the_same_window_is_the_next_step(self):
        link = Inputs(law="linear", linear=-9.0)
        found = read_history(self.TEXT, link)
        assert (found.past, found.present, found.future) == (self.STEPS[:3], link, ())
        assert found.bookmarks == (self.STEPS[1],)

    def test_a_code_that_cannot_be_read_is_left_out(self):
        text = self.TEXT.replace("segments:-13,-8@0.5", "segments:-13,-8@0.5;wings=2")
        assert read_history(text, self.STEPS[2]).past == self.STEPS[:1]

    @pytest.mark.parametrize(
        "text", [None, "", "{", "[]", "7", '{"past":7}', '{"past":[[]],"present":{}}', "[" * 10_000]
    )
    def test_what_cannot_be_read_is_no_history(self, text: str | None):
        assert read_history(text, START) == StoredHistory(present=START)

    def test_the_newest_fifty_are_kept(self):
        steps = tuple(replace(START, mass_t=round(6.0 + 0.05 * k, 2)) for k in range(80))
        text = StoredHistory(steps, START).text()
        assert len(text) < 6_000
        assert read_history(text, START).past == steps[-50:]

    def test_a_rotor_of_ones_own_is_left_out(self):
        own_rotor = replace(Inputs(rotor="r22").aircraft, key="", files=RotorFiles("a.toml", ()))
        own = replace(START, law="builtin", rotor="own", own_rotor=own_rotor)
        assert read_history(StoredHistory((START, own), START).text(), START).past == (START,)


class TestShare:
    @pytest.mark.parametrize("twist", ["linear:-35", "segments:-40,-2@0.5", "segments:-8,-2@0.1"])
    def test_a_twist_beyond_the_sliders_is_kept_as_it_is(self, twist: str):
        inputs = inputs_from(f"1;{twist};mu=0.3")
        assert inputs.law == "given"
        assert inputs.design().twist.spec() == twist
        assert code_of(inputs.design()) == f"1;{twist};mu=0.3"


BAD = {
    "": "not version 1",
    "1;table:/etc/passwd": "a file on the sender",
    "1;linear:-8;mu": "not of the form key=value",
    "1;linear:-8;mu=fast": "not a number: write for example 1.0",
    "1;linear:-8;mu=NaN": "advance_ratio is nan, outside",
    "1;linear:-8;wings=2": "unknown key 'wings'",
    "1;linear:-8;inflow=magic": "magic",
    '1;linear:-8;mass="\\ud800"': "'\\ud800' holds half of a character: write it whole",
    "1;linear:-8;speed_kt=90": "unknown key 'speed_kt': write advance_ratio",
    "1;bent:3": "is not known",
    "1;linear:-8;mu=0.47": "Adv. ratio µ is 0.47, outside this page's 0…0.45",
    "1;linear:-8;elements=49": "asks for 49 blade elements and the usual azimuths",
    "1;linear:-8;inflow=drees;azimuths=241": "computes with at most 48 and 240",
    "1;linear:-8;mass=1e9": "mass",
    "1;linear:-8;pitch_per_rev=1:1:0": "in the address cannot be used: root pitch at 1/rev",
    "1;linear:-8" + ";mu=0.2" * 400: f"at most {LONGEST} are allowed",
    **dict.fromkeys((
        "1;linear:-8;mass=" + DIGITS, "1;linear:-8;mass=" + "9" * 5000, "1;linear:-8;rotor=" + "[" * 1500,
        '1;linear:-8;rotor={"main":{}}', "1;linear:-8;active_twist=" + DIGITS, "1;" + "+".join(["ideal"] * 250),
        "1;" + "x" * 7000, "1;linear:-8;\0=1", "own",
    ), ""),
}  # fmt: skip


@pytest.mark.parametrize("code", BAD, ids=lambda code: code[:40])
def test_a_bad_link_opens_the_page_with_one_sentence(code: str):
    address = Address("?d=" + code, lambda query: None)
    assert address.read(DESIGN, inputs_from, START, "Not the design") == START
    with pytest.raises(
        ValueError, match=r"\w"
    ) as caught:  # As A of a link, which is read elsewhere.
        inputs_from(code)
    for sentence in (str(caught.value), *(said for _, said in address.problems)):
        assert BAD[code] in sentence
        assert "\n" not in sentence
        assert len(sentence) < 450
        assert "9" * 100 not in sentence
    assert len(address.problems) == 1


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("1;segments:-14,-8@0.5;mass=8320", {"law": "two", "two_inner": -14.0, "two_outer": -8.0}),
        (
            "1;linear:-12.5;mu=0.31;mass=8320;inflow=drees",
            {"law": "linear", "advance_ratio": 0.31, "inflow": "drees"},
        ),
        (
            "1;segments:-16,-12,-6@0.4,0.75;mass=9100;alt=1500",
            {"law": "three", "mass_t": 9.1, "altitude_m": 1500.0},
        ),
        (
            "1;segments:-14,-8@0.5;mass=8320;tip_loss=false;hub_loss=false",
            {"tip_loss": False, "hub_loss": False},
        ),
    ],
)
def test_a_link_means_what_its_words_say(code: str, expected: dict[str, object]):
    inputs = inputs_from(code)
    assert {name: getattr(inputs, name) for name in expected} == expected


@settings(max_examples=25)
@given(VIEWS)
def test_a_view_comes_back_from_the_address(view: ViewState):
    code = view_code(view)
    assert (ViewState() if code is None else view_from(code)) == view
    assert code is None or (code.isascii() and len(code) < 160)


def test_only_what_differs_is_written():
    assert view_code(ViewState()) is None
    assert view_code(replace(ViewState(), azimuth_deg=200.0, dark=True)) is None
    assert view_code(replace(ViewState(), field="M²cn", stall=False)) == "1;field=m2cn;stall=off"


@pytest.mark.parametrize(
    ("code", "said"),
    [
        ("", "version 1"),
        ("1;colour=red", "'colour=red'"),
        ("1;field=" + "x" * 90, "choose angle, induced"),
        ("1;stall=1", "choose on, off"),
        ("1;exaggeration=nan", "give a number from 1 to 6"),
    ],
)
def test_a_bad_view_is_one_sentence(code: str, said: str):
    with pytest.raises(ValueError, match=r"^The view in the address") as raised:
        view_from(code)
    assert said in str(raised.value)
    assert len(str(raised.value)) < 240


def at(rate: float, **others: float) -> Inputs:
    return replace(FIRST, linear=rate, **others)


R22 = {"rotor": "r22", "mass_t": 0.6}
BEGUN = ((FIRST, 850e3, 0.0, None), (at(-9.0), 847e3, 60.0, -3e3))
"""A page that has opened at 850 kW, and a first movement."""
COURSES = {
    "the first solution is what counting begins from": ((FIRST, 850e3, 0.0, None),),
    "a drag counts from the power before it": (
        (FIRST, 850e3, 0.0, None),
        (at(-8.5), 849e3, 60.0, -1e3),
        (at(-9.0), 847e3, DRAG, -3e3),
    ),
    "the same inputs keep the count": (*BEGUN, (at(-9.0), 847e3, 0.0, -3e3)),
    "after a pause the next movement counts anew": (*BEGUN, (at(-10.0), 845e3, PAUSE, -2e3)),
    "another slider counts anew without a pause": (
        *BEGUN,
        (at(-9.0, mass_t=9.0), 950e3, DRAG, 103e3),
    ),
    "while the pointer is down neither a pause nor a second input ends the grab": (
        BEGUN[0],
        "grab",
        BEGUN[1],
        (at(-9.5, two_division=0.6), 846e3, 10.0, -4e3),
        "release",
        (at(-10.0, two_division=0.6), 845e3, 10.0, -1e3),
    ),
    "a second grab counts from where the slider stands": (
        *BEGUN,
        "grab",
        (at(-9.5), 846e3, DRAG, -1e3),
    ),
    "a step without trim has no change and does not spoil the next": (
        *BEGUN,
        (at(-30.0), None, DRAG, None),
        (at(-9.5), 846e3, DRAG, -4e3),
    ),
    "a reset drops what was kept": (*BEGUN, "reset", (at(-12.0), 840e3, 0.0, None)),
    "another rotor is no change of power": (
        *BEGUN,
        (replace(at(-9.0), **R22), 74e3, 60.0, None),
        (replace(at(-9.5), **R22), 73e3, 60.0, -1e3),
    ),
    # Reset, then a handle taken at once: the change is counted, not lost for as long as it is held.
    "a grab before the new design has a power counts from its first": (
        BEGUN[0],
        "reset",
        "grab",
        (FIRST, 850e3, 0.0, 0.0),
        (at(-9.0), 847e3, DRAG, -3e3),
        "release",
    ),
    # A lecture sets another design while the answer to the last drag is still on its way.
    "what no hand has moved does not count": (
        *BEGUN,
        "reset",
        (at(-9.5), 846e3, DRAG, None),
        (at(-16.0, mass_t=10.0), 1349e3, 60.0, None),
        "touch",
        (at(-16.5, mass_t=10.0), 1347e3, DRAG, -2e3),
    ),
    # The release comes at once, the answers to the last movements of the drag later.
    "a slider let go before its last answers counts from the press": (
        (FIRST, 1047e3, 0.0, None),
        "grab",
        (at(-9.0), 1000e3, 60.0, -47e3),
        (at(-10.0), 901e3, 3.0, -146e3),
        "release",
        (at(-10.5), 915e3, DRAG, -132e3),
        (at(-10.6), 929e3, DRAG, -118e3),
    ),
}
"""Calls of the tracker, and solutions: inputs, power [W], pause [s] and the change that is expected [W]."""


@pytest.mark.parametrize("course", COURSES.values(), ids=COURSES)
def test_change(course: tuple[str | tuple[Inputs, float | None, float, float | None], ...]):
    tracker, expected = PowerTracker(), None
    for step in course:
        if isinstance(step, str):
            getattr(tracker, step)()
            expected = None if step == "reset" else expected
        else:
            inputs, power, pause, expected = step
            tracker.pause = pause
            assert tracker.solved(inputs, power) == expected
    if course[-1] == "release":
        assert tracker.change == expected
