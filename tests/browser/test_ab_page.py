"""A and B on the real page: pin, move, read the difference, see it on the disk, swap, go back, let go."""

import re

import pytest
from watched import Visit, Watched

from explorer.model.inputs import Inputs

START = Inputs()
_ALPHA = "RX.state.strip.find(one => one.name === 'alpha').chart.series"
_BESIDE_A = f"{_ALPHA}.some(line => line.colour === 'var(--rx-pinned)')"


def overlay_seen(watched: Watched) -> bool:
    return watched.page.evaluate(
        "() => window.__viserMutable.nodeRefFromName['/rotor/blade_0/overlay'].visible"
    )


def total_row(watched: Watched) -> list[str]:
    """A, B, Δ kW with its band, and how sure it is, of the total."""
    row = watched.page.locator('[data-explorer="ab"] tr', has_text="Total").locator("td")
    row.nth(4).wait_for()  # The page fills the table anew with each answer.
    cells = row.all_inner_texts()
    return [text.strip() for text in cells[1:]]


def menu(watched: Watched) -> None:
    """Open the menu of A."""
    watched.page.get_by_role("button", name="A is").click()
    watched.page.wait_for_selector('[data-explorer="pinned"]')


def press(watched: Watched, name: str) -> None:
    watched.page.get_by_role("button", name=name, exact=True).click()


CLOSE_NOTIFICATION = """() => {
    const note = document.body.appendChild(document.createElement('div'));
    note.className = 'mantine-Notification-root';
    note.innerHTML = '<button></button>';
    note.firstChild.click();
    note.remove();
}"""
"""As the page closes viser's remark on drawing in software, five seconds after it appears."""


@pytest.mark.slow
def test_pin_move_compare_swap_back_and_let_go(visit: Visit):
    watched = visit(size=(1500, 940))
    page = watched.page
    begun = watched.text("total-power")
    watched.drawer("details")
    assert page.get_by_role("button", name="Show B − A").count() == 0

    page.keyboard.press("p")
    page.wait_for_function("() => RX.state.bar.pinned")
    page.wait_for_selector('[data-explorer="ab"]')
    menu(watched)
    page.evaluate(CLOSE_NOTIFICATION)  # Nobody has pressed beside the menu.
    assert page.locator('[data-explorer="pinned"]').is_visible()
    watched.reads("pinned", r"A\s*UH-60A · segments −14/−8 at 0\.5\s+" + begun)
    page.keyboard.press("Escape")
    watched.says("than", ": same as")
    watched.says("against", "A")
    watched.until(lambda: total_row(watched)[2:] == ["0.0", ""])
    # A and B are one blade: the overlay is its jig shape.
    watched.until(lambda: overlay_seen(watched))
    page.wait_for_function(f"() => {_BESIDE_A}")

    disk = watched.node("/rotor/disk/field")
    watched.press("Inboard", "PageUp", 9)
    watched.answered()
    watched.until(lambda: "±" in total_row(watched)[2])
    a, b, apart, word = total_row(watched)
    assert a == begun
    watched.says("total-power", b)
    assert re.fullmatch(r"[+−][\d.]+ ± [\d.]+", apart)
    assert word in ("sure", "likely", "unclear")
    watched.says("than", "than")
    watched.says("against", "A")
    plain = watched.node("/rotor/disk/field")
    assert plain != disk

    page.get_by_role("button", name="Show B − A").click()
    watched.until_changed(lambda: watched.node("/rotor/disk/field"), plain)
    watched.until(
        lambda: (
            page.get_by_role("button", name="Show B − A").get_attribute("aria-pressed") == "true"
        )
    )
    watched.until(lambda: "B − A" in page.locator('[data-part="unit"]').inner_text())

    press(watched, "Disk")
    press(watched, "Wipe A | B")
    page.wait_for_function(
        "() => RX.state.plan?.wiped && RX.state.plan.wiped.values !== RX.state.plan.disk.values"
    )
    edge = "() => getComputedStyle(document.querySelector('[data-colours]').shadowRoot.lastElementChild).clipPath"
    before = page.evaluate(edge)
    page.locator(".rxs-wipe [role=slider]").press("ArrowLeft")
    watched.until_changed(lambda: page.evaluate(edge), before)
    press(watched, "Wipe A | B")
    page.wait_for_function("() => RX.state.plan && !RX.state.plan.wiped")
    press(watched, "Aircraft")

    menu(watched)
    press(watched, "Swap A and B")
    watched.answered()
    watched.until(lambda: "±" in total_row(watched)[2])
    swapped = total_row(watched)
    watched.says("total-power", a)
    assert swapped[:2] == [b, a]
    assert swapped[2].lstrip("+−") == apart.lstrip("+−")

    menu(watched)
    press(watched, "Back to A")
    watched.answered()
    assert total_row(watched) == [b, b, "0.0", ""]

    menu(watched)
    press(watched, "Unpin")
    page.wait_for_selector('[data-explorer="ab"]', state="detached")
    page.wait_for_function("() => !RX.state.bar.pinned")
    watched.until_changed(lambda: overlay_seen(watched), False)  # Of the blade as built.
    watched.says("against", "as built")
    watched.until(lambda: "B − A" not in page.locator('[data-part="unit"]').inner_text())
    page.get_by_role("button", name="Show B − A").wait_for(state="detached")
    page.wait_for_function(f"() => !({_BESIDE_A})")
    assert not re.search(r"\b(NaN|nan|inf|undefined)\b", page.inner_text("body"))
