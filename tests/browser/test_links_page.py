"""A design survives F5, a link and the back button of a real browser, which rewrites the address at each connection."""

from dataclasses import replace
from typing import TYPE_CHECKING

import pytest
from watched import COARSE, Visit, Watched

from explorer.app import App
from explorer.model.inputs import OPENING, Inputs
from explorer.sharing.share import code_of

if TYPE_CHECKING:
    pass

pytestmark = pytest.mark.browser

BUILT = replace(OPENING, built_inner=-2.0, built_outer=1.5, built_division=0.6, advance_ratio=0.25)


def holds(app: App, watched: Watched, inputs: Inputs) -> bool:
    """Whether the page's session and its address hold this design."""
    shown = app.sessions[-1].page.controls.inputs().design()
    return code_of(shown) == code_of(inputs.design()) and f"d={code_of(shown)}" in watched.page.evaluate(
        "() => decodeURIComponent(location.search)"
    )


@pytest.mark.slow
def test_a_design_survives_reload_link_and_back(visit: Visit, app: App):
    watched = visit()
    page = watched.page
    watched.press("Δ inboard [°/R]", "ArrowLeft", 3)  # By hand first: the page itself writes the address.
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
    page.get_by_role("button", name="Reset design").click()
    watched.until(lambda: holds(app, watched, OPENING))
    page.get_by_role("button", name="Undo").click()
    watched.until(lambda: holds(app, watched, BUILT))
    page.go_back()
    watched.ready()
    watched.until(lambda: holds(app, watched, by_hand))
    # As earlier versions wrote it.
    watched.open(app.address, f"{COARSE}&d=1;uh60a%2Bsegments:-2,1.5@0.6;mu=0.25;mass=8320")
    watched.until(lambda: holds(app, watched, BUILT))


@pytest.mark.slow
def test_a_link_that_cannot_be_read_is_said_and_stays(visit: Visit):
    watched = visit(COARSE + "&d=1;uh60a~bends:3;mu=0.3")
    page = watched.page
    said = page.get_by_text("'uh60a+bends:3' is not known")
    said.wait_for()
    watched.answered()
    assert watched.text("against") == "UH-60A as built"
    assert watched.text("change") == "0.0 %"  # The usual design.
    page.wait_for_timeout(7000)  # Other notices are gone by then.
    assert said.is_visible()
    assert "d=1;uh60a~bends:3;mu=0.3" in page.url
    watched.press("Δ outboard [°/R]", "ArrowLeft")
    page.wait_for_function("() => location.search.includes('uh60a~segments:0,-0.1@0.5')")
