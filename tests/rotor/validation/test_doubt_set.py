"""Measured powers within the bands of what is uncertain."""

import pytest

from rotor.validation.doubt import HeldPoint, doubt_set
from tests.shipped_rows import still_true


@pytest.mark.slow
def test_the_shares_are_those_shipped():
    found = doubt_set()
    assert {row.kind for row in found.rows} == {"validation"}
    for row in found.rows:
        still_true(row)


def test_a_point_is_inside_up_to_its_band():
    assert HeldPoint("", -0.05, 0.05).inside
    assert not HeldPoint("", 0.051, 0.05).inside
