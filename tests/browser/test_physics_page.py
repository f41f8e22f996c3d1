"""Switches, waterfall, tooltips and units in a real browser."""

import re
from collections.abc import Iterator

import pytest
from test_page import kilowatts
from watched import Watched

from explorer.model.inputs import Inputs
from rotor.aero.switches import SWITCHES

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


def test_each_switch_says_what_it_costs(watched: Watched):
    watched.page.wait_for_selector('[data-explorer="cost"]')
    watched.answered(wholly=True)
    costs = watched.page.locator('[data-explorer="cost"]').all_inner_texts()
    assert len(costs) == len(SWITCHES)
    without_effect = [cost for cost in costs if not re.fullmatch(r"[+−]\d+\.\d kW here", cost)]
    parts = [f"{which} loss is part of this wake" for which in ("tip", "root")]
    assert without_effect == [*parts, "the rotor file states none"]


def test_units_change_what_is_read_and_not_the_design(watched: Watched):
    before = watched.text("total-power")
    watched.drawer("settings")
    watched.choose("Units", "Aviation")
    after = watched.until_changed(lambda: watched.text("total-power"), before)
    assert after.endswith("hp")
    assert kilowatts(after) == pytest.approx(kilowatts(before) / 0.745699872, abs=1.5)
    watched.reads("speed", "^129 kt")
    watched.says("change", "0.0 %")
    watched.row("Mass [lb]").locator("input:not([type=hidden])").last.wait_for()
    watched.until(lambda: watched.row("Mass [lb]").locator("input:not([type=hidden])").last.input_value() == "18342")
    watched.type("Altitude [ft]", 5000)
    thin = watched.until_changed(lambda: watched.text("total-power"), after)
    watched.choose("Units", "SI")
    watched.until_changed(lambda: watched.text("total-power"), thin)
    watched.row("Altitude [m]").locator("input:not([type=hidden])").last.wait_for()
    watched.until(lambda: watched.row("Altitude [m]").locator("input:not([type=hidden])").last.input_value() == "1524")
