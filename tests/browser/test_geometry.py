"""A long sentence and the lecture at every size of window; cards, modes and drawers are in `test_sizes.py`."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page
from test_sizes import MEASURE
from watched import Watched, opened

from explorer.app import App

pytestmark = pytest.mark.slow

# What is seen beyond the left or right edge of the box it belongs to, by more than a pixel and a half.
_LEAVES = """([outer, inner]) => {
  const box = outer ? document.querySelector(outer).getBoundingClientRect() : {left: 0, right: innerWidth};
  return [...document.querySelectorAll(inner)].filter(e => e.checkVisibility()).filter(e => {
    const own = e.getBoundingClientRect();
    return own.width && (own.right > box.right + 1.5 || own.left < box.left - 1.5);
  }).map(e => e.ariaLabel || e.innerText || e.className);
}"""

# What stands over the scene: no two cards meet, and none leaves the window.
_CARDS = f"() => {{ const {{hit, outside}} = ({MEASURE})(); return [...hit, ...outside]; }}"

SIZES = [(1280, 720), (390, 844), (1920, 1080), (1024, 768), (768, 1024)]


@pytest.fixture(params=SIZES, ids=lambda size: f"{size[0]}x{size[1]}")
def size(request: pytest.FixtureRequest) -> tuple[int, int]:
    return request.param


@pytest.fixture
def sized(size: tuple[int, int], shared: Watched, browser: Browser, app: App) -> Iterator[Watched]:
    """The page as it opens. One with a sheet differs from one that is made narrow: it opens it."""
    watched = opened(browser, app.address, size=size) if size[0] <= 860 else shared
    watched.page.set_viewport_size({"width": size[0], "height": size[1]})
    watched.reset()
    yield watched
    assert watched.complaints == []
    if watched is not shared:
        watched.close()


def _none(page: Page, wrong: str, arg: object = None) -> None:
    """Wait until one of the scripts above finds nothing wrong; what it finds is in the message of the failure."""
    from playwright.sync_api import TimeoutError

    try:
        page.wait_for_function(f"arg => ({wrong})(arg).length === 0", arg=arg)
    except TimeoutError:
        assert page.evaluate(wrong, arg) == []


_WHY = (
    "Nothing has changed.",
    "Lift moved inboard and towards the advancing side: induced −12.3, profile +4.0, tail rotor −0.5 kW.",
    "Lift moved inboard and towards the advancing side: induced −12.3, profile +4.0, tail rotor −0.5 kW; separation "
    "grew inboard on the retreating side (12.3 % of the disk); drag divergence grew near the tip on the advancing side "
    "(5.3 % of the disk).",
)
_STANDS = """() => [...document.querySelectorAll('.rxf-power, .rxf-parts')].map(e => {
    const {left, top, bottom} = e.getBoundingClientRect();
    return [left, top, bottom].map(Math.round);
})"""


def test_a_sentence_is_not_cut_and_moves_nothing(sized: Watched, size: tuple[int, int]):
    if size[0] <= 700:  # A telephone has no room for the sentence.
        return
    watched, page = sized, sized.page
    watched.answered(wholly=True)  # No answer of the background may write over the sentence.
    stands: list[object] = []
    for why in _WHY:
        page.evaluate("why => RX.set({power: {...RX.state.power, why}})", why)
        page.wait_for_function("why => document.querySelector('.rxf-why')?.title === why", arg=why)
        watched.drawn()
        stands.append(page.evaluate(_STANDS))
        shown = " ".join(watched.text("why").split())
        assert shown.endswith(".")
        assert why.replace("\u00a0", " ").startswith(shown.replace("\u00a0", " ").removesuffix("."))
        assert page.evaluate(
            "() => (e => e.scrollHeight <= e.clientHeight + 1)(document.querySelector('.rxf-why'))"
        )
    assert stands[0] == stands[1] == stands[2]


def test_the_lecture_is_a_column_beside_the_scene_and_three_numbers(
    sized: Watched, size: tuple[int, int]
):
    watched, page, rail = sized, sized.page, sized.page.locator("[data-dock-region=right]")
    page.keyboard.press("t")
    page.wait_for_selector('[data-explorer="lecture"][data-step="1"]')
    _none(page, _LEAVES, ["", ".rxf-bar *, .rxs-foot *, .rxf-stage > .rxf-card"])
    rail.wait_for(state="hidden")
    page.keyboard.press("PageDown")
    page.wait_for_selector('[data-explorer="lecture"][data-step="2"]')
    page.wait_for_function("() => RX.state.wipe === true")  # Wanted before there was an A.
    page.wait_for_function("() => document.querySelectorAll('.rxs-figures b').length === 3")
    # In the middle of its first line each is what is seen there: nothing lies over it. One call: answers redraw it.
    seen = """selector => { const e = document.querySelector(selector), box = e.getClientRects()[0];
        const x = box?.x + box?.width / 2, y = box?.y + box?.height / 2;
        return Boolean(box) && e.contains(document.elementFromPoint(x, y)); }"""
    for part in (".rxs-list > [data-step='2'] h2", ".rxs-foot [data-value=next]", ".rxs-figures"):
        page.wait_for_function(seen, arg=part)
    boxes = """() => ["canvas[data-engine]", ".rxs-column"].map(
        name => document.querySelector(name).getBoundingClientRect().toJSON())"""
    scene, column = watched.at_rest(lambda: page.evaluate(boxes))
    assert scene["right"] == size[0]
    assert column["left"] == 0
    assert column["bottom"] == size[1]
    if size[0] > 860:
        assert abs(column["right"] - scene["left"]) <= 1
        assert scene["width"] > 0.45 * size[0]
    else:  # Below the scene.
        assert column["top"] >= scene["bottom"] - 1
        assert scene["height"] > 0.3 * size[1]
    assert page.locator(".rxs-list").evaluate("e => e.scrollWidth <= e.clientWidth")
    _none(page, _CARDS)
    for panel in ("[data-dock-region]", ".rxf-strip", ".rxf-power"):
        page.locator(panel).first.wait_for(state="hidden")
    _controls_come_and_go(watched)
    page.evaluate("() => RX.send('story', 5)")  # Its captions are the longest.
    page.get_by_text("of the disk in reverse flow", exact=True).wait_for()
    assert page.locator(".rxs-figures").evaluate("e => e.scrollWidth <= e.clientWidth")
    page.get_by_role("button", name="End", exact=True).click()
    page.wait_for_selector('[data-explorer="lecture"]', state="hidden")
    rail.wait_for(state="visible" if size[0] > 1100 or size[0] <= 860 else "hidden")


def _controls_come_and_go(watched: Watched) -> None:
    """Asked for in the lecture: the rail beside the scene and the steps, in a narrow window in their place."""
    page, rail = watched.page, watched.page.locator("[data-dock-region=right]")
    page.get_by_role("button", name="Controls").click()
    rail.wait_for(state="visible")
    page.wait_for_function(
        """() => {
            const rail = document.querySelector('[data-dock-region=right]').getBoundingClientRect();
            const column = document.querySelector('.rxs-column'), steps = column.getBoundingClientRect();
            const scene = document.querySelector('canvas').getBoundingClientRect();
            return rail.right <= innerWidth + 1
                && (rail.left >= steps.right - 1 || getComputedStyle(column).visibility === 'hidden')
                && (scene.right <= rail.left + 1 || scene.bottom <= rail.top + 1);
        }"""
    )
    page.get_by_role("button", name="Controls").click()
    rail.wait_for(state="hidden")
