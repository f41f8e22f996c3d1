"""The test stand on the real page: a measured rotor in its tests and flights, and points over the curve."""

import pytest
from watched import WAIT, Watched

from explorer.model.inputs import Inputs

pytestmark = [pytest.mark.browser, pytest.mark.slow]
START = Inputs(law="builtin")
CHART = "() => RX.state.strip?.find(one => one.name === 'measured')"


def until(watched: Watched, condition: str) -> None:
    watched.page.wait_for_function(condition, timeout=2 * WAIT)


def test_a_measured_rotor_offers_its_tests_and_draws_its_points(watched: Watched):
    watched.page.locator(".rxf-rotor").select_option(label="XV-15 metal blade")
    until(watched, f"() => ({CHART})()?.series[1].x.length === 50")
    watched.choose("Measured in", "Tunnel, 15° forward")
    until(watched, f"() => ({CHART})()?.value.includes('rms 6.3 %')")
    watched.until(lambda: watched.page.locator("[data-name=measured] [data-mark]").count() == 4)
    until(watched, "() => document.querySelector('[data-explorer=validated]')?.innerText === 'measured: rms 6.3 %'")
    watched.page.locator(".rxf-rotor").select_option(label="PCA-2 autogiro")
    until(watched, f"() => ({CHART})()?.series[1].x.length === 79")
    until(watched, "() => document.querySelector('[data-explorer=total-power]').innerText.startsWith('0.0')")
    watched.page.locator(".rxf-rotor").select_option(label="UH-60A")
    until(watched, f"() => !({CHART})()")
    watched.row("Mass").wait_for()


def test_a_flown_rotor_draws_its_flights_and_a_press_sets_one(watched: Watched):
    watched.page.locator(".rxf-rotor").select_option(label="SA349/2 Gazelle")
    power = "RX.state.strip?.find(one => one.name === 'power')"
    until(watched, f"() => {power}?.series.some(one => one.press?.length === 4 && one.words[1].includes('ours'))")
    watched.until(lambda: watched.page.locator("[data-name=power] [data-band]").count() == 1)
    watched.page.locator("[data-name=power] [data-value=FC2]").press("Enter")
    until(watched, f"() => {power}?.value.startsWith('FC2: ')")
    assert "FC2" in watched.row("Point").locator("input").first.input_value()
    assert watched.row("Altitude").locator("input:not([type=hidden])").last.input_value() == "1521"
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
    until(watched, "() => document.querySelector('[data-explorer=validated]')?.innerText === 'airloads measured'")


@pytest.mark.slow
def test_a_flight_goes_on_in_the_wind_tunnel_and_comes_back(watched: Watched):
    """The last of the file: loaded again, the page begins with another design."""
    mass = watched.row("Mass")
    flight = watched.text("total-power")
    watched.choose("Flight or test", "Test stand: wind tunnel")
    watched.answered()
    tested = watched.text("total-power")
    assert tested != flight
    mass.wait_for(state="hidden")
    watched.choose("Given", "Collective")
    until(watched, "() => location.search.includes('collective_deg')")
    watched.page.reload()
    watched.ready()
    watched.row("Collective").wait_for()
    watched.answered()
    reloaded = watched.text("total-power")
    assert abs(float(reloaded.split()[0]) - float(tested.split()[0])) < 5.0
    watched.choose("Flight or test", "Flight")
    watched.until_changed(lambda: watched.text("total-power"), reloaded)
    mass.wait_for()
