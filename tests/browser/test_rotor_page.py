"""Other rotors on the real page: from the menu, brought as files, and measured ones in their tests and flights."""

from pathlib import Path

import pytest
from playwright.sync_api import expect
from watched import WAIT, Watched

from explorer.model.inputs import Inputs
from rotor.support.assets import asset_path

pytestmark = pytest.mark.slow
START = Inputs(law="builtin")
BLADES = r"""() => Object.entries(window.__viserSceneTree.getState()).filter(
    ([name, node]) => /blade_\d+$/.test(name) && (node.overrideVisibility ?? node.visibility) !== false).length"""


def shown(watched: Watched, part: str, text: str) -> None:
    """Wait until a part of the page says so."""
    watched.page.wait_for_function(
        "([part, text]) => document.querySelector(`[data-explorer='${part}']`)?.innerText.includes(text)",
        arg=[part, text],
        timeout=2 * WAIT,
    )


def load(watched: Watched, file: Path) -> None:
    """As a user picks a file."""
    watched.drawer("open")
    watched.section("Files")
    with watched.page.expect_file_chooser() as chooser:
        watched.page.get_by_role("button", name="Load rotor file").click()
    chooser.value.set_files(file)


@pytest.mark.slow
def test_files_of_ones_own(watched: Watched, tmp_path: Path):
    text = asset_path("r22.toml").read_text(encoding="utf-8").replace("Robinson R22", "Mine")
    file = tmp_path / "mine.toml"
    file.write_text(text.replace("radius_m = 3.8354", "radius_m = -3.8"), encoding="utf-8")
    load(watched, file)
    # It stays in the drawer.
    assert "radius_m is -3.8, outside" in watched.reads("upload", "outside")
    note = watched.page.locator(".mantine-Notification-root", has_text="radius_m is -3.8, outside")
    assert note.evaluate("""one => {
        const {left, top, width, height} = one.getBoundingClientRect();
        return one.contains(document.elementFromPoint(left + width / 2, top + height / 2));
    }""")
    watched.drawer("trust")
    watched.page.wait_for_selector('[data-explorer="provenance"]')
    watched.reads("provenance", "SC1095")  # Nothing is lost.
    file.write_text(text, encoding="utf-8")  # Mended, under the same name.
    load(watched, file)
    watched.reads("line", "^Mine of ")
    watched.until(lambda: watched.page.evaluate(BLADES) == 2)
    watched.until(
        lambda: watched.page.locator(".rxf-rotor option:checked").inner_text() == "Mine (own)"
    )
    file.write_text(
        text.replace('"naca63a015"', '"own"') + '\n[sections.own]\ndeck = "own.cor"\n',
        encoding="utf-8",
    )
    load(watched, file)
    watched.page.wait_for_selector("text=mine.toml is loaded and needs own.cor: load that next.")
    deck = tmp_path / "own.cor"
    deck.write_text(
        asset_path("airfoils/naca0012.c81").read_text(encoding="utf-8"), encoding="utf-8"
    )
    load(watched, deck)
    watched.drawer("trust")
    shown(watched, "provenance", "own")
    # Once it rests, the page is given what its address cannot hold.
    kept = "() => JSON.parse(sessionStorage.getItem('rx-kept') ?? '{}').d?.includes('own.cor')"
    watched.page.wait_for_function(kept, timeout=2 * WAIT)
    watched.page.wait_for_selector(
        '.rxf-chip[data-explorer="status"][data-kind="converged"]', state="attached"
    )
    watched.page.wait_for_function("() => location.search.includes('d=own')")
    watched.answered()
    power, address = watched.text("total-power"), watched.page.url
    watched.page.reload()  # No address holds it: the page itself does.
    watched.ready()
    watched.drawer("trust")
    shown(watched, "provenance", "own")
    shown(watched, "total-power", power)
    watched.until(
        lambda: watched.page.locator(".rxf-rotor option:checked").inner_text() == "Mine (own)"
    )
    other = watched.page.context.new_page()  # Of another window, which does not.
    other.goto(address)
    other.wait_for_selector("text=Its rotor is the sender's own and too large for a link")
    other.get_by_role("button", name="Show the UH-60A instead").click()
    other.wait_for_selector(
        '.rxf-chip[data-explorer="status"][data-kind="converged"]', state="attached"
    )
    other.close()


def until(watched: Watched, condition: str) -> None:
    watched.page.wait_for_function(condition, timeout=2 * WAIT)


def test_a_rotor_tested_alone_is_no_aircraft_and_its_taper_stays_in_its_card(watched: Watched):
    views = "() => RX.state.views.all.map(([, title]) => title)"
    assert watched.page.evaluate(views)[0] == "Aircraft"
    watched.page.set_viewport_size({"width": 1500, "height": 940})
    watched.page.locator(".rxf-rotor").select_option("castles-gray-tapered")
    watched.until(lambda: watched.page.evaluate(views)[0] == "Rotor")
    watched.answered()
    left = "() => Math.min(...[...document.querySelectorAll('[data-part=inset] svg path')].map(one => one.getBBox().x))"
    assert 0 <= watched.page.evaluate(left) < 40


def test_a_flown_rotor_draws_its_flights_and_a_press_sets_one(watched: Watched):
    watched.page.locator(".rxf-rotor").select_option(label="SA349/2 Gazelle")
    power = "RX.state.strip?.find(one => one.name === 'power')?.chart"
    until(
        watched,
        f"() => {power}?.series.some(one => one.press?.length === 4 && one.words[1].includes('computed'))",
    )
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
