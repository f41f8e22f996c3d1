"""A design survives F5, a link and the back button of a real browser, which rewrites the address at each connection."""

import random
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import pytest
from chromium import DRAW_NOTHING
from watched import COARSE, Visit, Watched

from explorer.app import App
from explorer.model.inputs import OPENING, Inputs
from explorer.sharing.share import code_of
from tests.explorer.test_links import random_inputs

if TYPE_CHECKING:
    from playwright.sync_api import Browser

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


@pytest.mark.parametrize(
    "count",
    [pytest.param(12, marks=pytest.mark.slow), pytest.param(1000, marks=[pytest.mark.slow, pytest.mark.nightly])],
)
def test_random_designs_survive_link_reload_and_back(browser: "Browser", app: App, count: int):
    """Without waiting for their trims: what a page makes of its address is done before. A window for each forty: it
    keeps the addresses of 50 pages, and on a busy machine the memory of some 200 that it has left."""
    chance = random.Random(count)
    designs = [random_inputs(chance) for _ in range(count)]
    for first in range(0, count, 40):
        context = browser.new_context(viewport={"width": 400, "height": 300})
        context.add_init_script(DRAW_NOTHING)
        there_and_back(app, Watched(context.new_page()), designs[first : first + 40])
        context.close()


def there_and_back(app: App, watched: Watched, designs: list[Inputs]) -> None:
    """Each by its link and F5, then all again by the back button."""

    def arrived(inputs: Inputs, before: object) -> bool:
        """Whether a new session and the address of its page hold this design."""
        session = next(reversed(app.sessions), None)
        return session is not None and session is not before and holds(app, watched, inputs)

    def goes(step: Callable[[], object], inputs: Inputs) -> None:
        before = next(reversed(app.sessions), None)
        step()
        watched.until(lambda: arrived(inputs, before))

    for inputs in designs:
        goes(partial(watched.page.goto, f"{app.address}?d={code_of(inputs.design())}", wait_until="commit"), inputs)
        goes(partial(watched.page.reload, wait_until="commit"), inputs)
    for inputs in designs[-2::-1]:
        goes(partial(watched.page.go_back, wait_until="commit"), inputs)


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
