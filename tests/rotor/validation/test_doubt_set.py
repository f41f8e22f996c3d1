"""Measured powers within the bands of what is uncertain."""

import pytest

from rotor.validation.doubt import PointAndBand, count_by_kind, doubt_set
from tests.shipped_rows import still_true


@pytest.mark.slow
def test_the_shares_are_those_shipped():
    found = doubt_set()
    assert {row.kind for row in found.rows} == {"validation"}
    for row in found.rows:
        still_true(row)


def test_points_inside_are_counted_by_kind_of_flight():
    """Forty of one kind say nothing of another."""
    hover = [PointAndBand("", "hover", error, 0.05) for error in (0.2, -0.01)]
    assert (
        count_by_kind([*[PointAndBand("", "XV-15", 0.0, 0.05)] * 40, *hover])
        == "inside the band: XV-15 40 of 40; hover 1 of 2"
    )
