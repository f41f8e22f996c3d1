"""Switches, waterfall, tooltips and units in a real browser."""

import re
from collections.abc import Iterator

import pytest
from test_page import kilowatts
from watched import Watched

from explorer.model.inputs import Inputs

pytestmark = [pytest.mark.browser, pytest.mark.slow]
START = Inputs(law="builtin", advance_ratio=0.3)


@pytest.fixture
def watched(shared: Watched) -> Iterator[Watched]:
    """As the test before left it."""
    yield shared
    assert shared.complaints == []


def box(watched: Watched, label: str) -> None:
    """Click a checkbox."""
    watched.row(label).locator("input[type=checkbox]").click()


def test_a_switch_changes_the_power_and_the_page_says_so(watched: Watched):
    before = watched.text("total-power")
    watched.page.get_by_text("Model", exact=True).click()
    watched.drawer("trust")
    box(watched, "Flapping")
    watched.until(lambda: kilowatts(watched.text("total-power")) > kilowatts(before) + 30.0)
    watched.page.wait_for_function("() => RX.state.power.status.title.includes('Switched off')")
    status = watched.page.evaluate("() => RX.state.power.status.title")
    assert "Switched off: flapping. The result is for teaching, not for the aircraft." in status
    assert re.search(r"the hub carries 1\d\d kN m rolling to the retreating side", status)
    box(watched, "Flapping")
    watched.says("total-power", before)
