"""A design survives F5, a link and the back button of a real browser, which rewrites the address at each connection."""

from dataclasses import replace

import pytest
from playwright.sync_api import expect
from watched import COARSE, Visit, Watched

from explorer.app import App
from explorer.model.inputs import OPENING, Inputs
from explorer.sharing.share import code_of

BUILT = replace(
    OPENING, built_inner=-2.0471, built_outer=1.5, built_division=0.793, advance_ratio=0.25
)


def holds(app: App, watched: Watched, inputs: Inputs) -> bool:
    """Whether the page's session and its address hold this design."""
    shown = app.sessions[-1].page.context.controls.inputs().design()
    code = watched.page.evaluate("() => new URLSearchParams(location.search).get('d')")
    return code_of(inputs.design()) == code_of(shown) == code


@pytest.mark.slow
def test_a_design_survives_reload_link_and_back(visit: Visit, app: App):
    watched = visit()
    page = watched.page
    # By hand first: the page itself writes the address.
    watched.press("Δ inboard [°/R]", "ArrowLeft", 3)
    page.wait_for_function("() => location.search.includes('~segments:-0.3,0@0.5')")
    by_hand = replace(OPENING, built_inner=-0.3)
    page.reload()
    watched.ready()
    watched.until(lambda: holds(app, watched, by_hand))
    watched.open(app.address, f"{COARSE}&d={code_of(BUILT.design())}")
    watched.until(lambda: holds(app, watched, BUILT))
    page.reload()
    watched.ready()
    watched.until(lambda: holds(app, watched, BUILT))
    # Rounded; the design is exact.
    for label, shown in (
        ("Δ inboard [°/R]", "-2.0"),
        ("Break point [r/R]", "0.79"),
    ):
        expect(watched.row(label).get_by_role("textbox")).to_have_value(shown)
    page.keyboard.press("r")
    watched.until(lambda: holds(app, watched, OPENING))
    page.get_by_role("button", name="Undo").click()
    watched.until(lambda: holds(app, watched, BUILT))
    page.go_back()
    watched.ready()
    watched.until(lambda: holds(app, watched, by_hand))
