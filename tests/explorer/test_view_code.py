"""What is shown, in the page's address: short, checked, and the same again when it is read."""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from explorer.model.inputs import ViewState
from explorer.model.units import UNITS
from explorer.picture.fields import FIELDS
from explorer.sharing.share import view_code, view_from

VIEWS = st.builds(
    ViewState,
    field=st.sampled_from(tuple(FIELDS)),
    exaggeration=st.sampled_from((1.0, 1.5, 5.0, 6.0)),
    difference=st.booleans(),
    reverse_flow=st.booleans(),
    stall=st.booleans(),
    drag_divergence=st.booleans(),
    units=st.sampled_from(tuple(UNITS)),
    wake=st.booleans(),
    arrows=st.booleans(),
    beside=st.booleans(),
)


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
        ("2;field=mach", "version 1"),
        ("1;colour=red", "'colour=red'"),
        ("1;dark=on", "'dark=on'"),
        ("1;field=" + "x" * 90, "choose angle, induced"),
        ("1;stall=1", "choose on, off"),
        ("1;exaggeration=nan", "from 1 to 6"),
        ("1;exaggeration=50", "from 1 to 6"),
    ],
)
def test_a_bad_view_is_one_sentence(code: str, said: str):
    with pytest.raises(ValueError, match=r"^The view in the address") as raised:
        view_from(code)
    assert said in str(raised.value)
    assert len(str(raised.value)) < 240
