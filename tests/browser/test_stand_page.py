"""The test stand on the real page: a measured rotor in its tests and flights, and points over the curve."""

import pytest
from playwright.sync_api import expect
from watched import WAIT, Watched

from explorer.model.inputs import Inputs

pytestmark = pytest.mark.slow
START = Inputs(law="builtin")


def until(watched: Watched, condition: str) -> None:
    watched.page.wait_for_function(condition, timeout=2 * WAIT)


def test_a_flown_rotor_draws_its_flights_and_a_press_sets_one(watched: Watched):
    watched.page.locator(".rxf-rotor").select_option(label="SA349/2 Gazelle")
    power = "RX.state.strip?.find(one => one.name === 'power')?.chart"
    until(watched, f"() => {power}?.series.some(one => one.press?.length === 4 && one.words[1].includes('computed'))")
    watched.until(lambda: watched.page.locator("[data-name=power] [data-band]").count() == 1)
    watched.page.locator("[data-name=power] [data-value=FC2]").press("Enter")
    until(watched, f"() => {power}?.value.startsWith('FC2: ')")
    watched.until(lambda: "FC2" in watched.row("Point").locator("input").first.input_value())
    expect(watched.field("Altitude")).to_have_value("1521")
    watched.page.locator("[data-name=power] [data-value=FC4]").click()
    until(watched, f"() => {power}?.value.startsWith('FC4: ')")
    watched.drawer("probe")
    measured = watched.page.locator("[data-explorer=probe-measured]")
    measured.get_by_role("button").click()
    until(watched, f"() => {power}?.value.startsWith('FC2: ')")
    watched.until(lambda: "FC2" in measured.inner_text() and "correlation" in measured.inner_text())
    assert measured.get_by_role("button").count() == 0
    watched.page.locator(".rxf-rotor").select_option(label="HART II")
    watched.until(lambda: measured.locator("svg").count() == 4)
    watched.drawer("trust")
    watched.reads("measurement", "airloads")
