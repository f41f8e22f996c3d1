"""Other rotors on the real page: chosen from the menu, and brought as files."""

from pathlib import Path

import pytest
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
    watched.page.wait_for_selector("text=radius_m is -3.8, outside")
    watched.drawer("trust")
    watched.page.wait_for_selector('[data-explorer="provenance"]')
    watched.reads("provenance", "SC1095")  # Nothing is lost.
    file.write_text(text, encoding="utf-8")  # Mended, under the same name.
    load(watched, file)
    shown(watched, "against", "Mine as built")
    watched.until(lambda: watched.page.evaluate(BLADES) == 2)
    watched.until(lambda: watched.page.locator(".rxf-rotor option:checked").inner_text() == "Mine (own)")
    file.write_text(text.replace('"naca63a015"', '"own"') + '\n[sections.own]\ndeck = "own.cor"\n', encoding="utf-8")
    load(watched, file)
    watched.page.wait_for_selector("text=mine.toml is loaded and needs own.cor: load that next.")
    deck = tmp_path / "own.cor"
    deck.write_text(asset_path("airfoils/naca0012.c81").read_text(encoding="utf-8"), encoding="utf-8")
    load(watched, deck)
    watched.drawer("trust")
    shown(watched, "provenance", "own")
    # Once it rests, the page is given what its address cannot hold.
    kept = "() => JSON.parse(sessionStorage.getItem('rx-kept') ?? '{}').d?.includes('own.cor')"
    watched.page.wait_for_function(kept, timeout=2 * WAIT)
    watched.page.wait_for_selector('.rxf-chip[data-explorer="status"][data-kind="converged"]')
    watched.page.wait_for_function("() => location.search.includes('d=own')")
    watched.answered()
    power, address = watched.text("total-power"), watched.page.url
    watched.page.reload()  # No address holds it: the page itself does.
    watched.ready()
    watched.drawer("trust")
    shown(watched, "provenance", "own")
    shown(watched, "total-power", power)
    watched.until(lambda: watched.page.locator(".rxf-rotor option:checked").inner_text() == "Mine (own)")
    other = watched.page.context.new_page()  # Of another window, which does not.
    other.goto(address)
    other.wait_for_selector("text=Its rotor is the sender's own and too large for a link")
    other.get_by_role("button", name="Show the UH-60A instead").click()
    other.wait_for_selector('.rxf-chip[data-explorer="status"][data-kind="converged"]')
    other.close()
