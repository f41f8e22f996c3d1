"""What the figures of the thesis give to the trust page is recomputed."""

from collections.abc import Callable

import pytest

from rotor.validation.thesis.catalogue import ENTRIES, trust_sets
from rotor.validation.thesis.report import Report
from rotor.validation.trust import trust_rows
from tests.shipped_rows import still_true


@pytest.mark.slow
def test_rows_and_verdicts_are_reproduced(report: Callable[[str], Report]):
    """Verdicts on the thesis' statements; what is only captioned has no row."""
    shipped = {row.what: row.shown for row in trust_rows() if row.kind == "document"}
    *sets, statements = trust_sets(report(entry.number) for entry in ENTRIES if not entry.slow)
    for one in sets:
        for row in one.rows:
            still_true(row)
    assert {row.what for row in statements.rows} == shipped.keys()  # None that is slow is checkable.
    for row in statements.rows:
        assert shipped[row.what] == row.shown, row.what
