"""What stands where, at every size of window: nothing leaves its card or the window, nothing lies on another."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest
from watched import Watched, opened

from explorer.app import App

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = [pytest.mark.browser, pytest.mark.slow]

# What is seen beyond the left or right edge of the box it belongs to, by more than a pixel and a half.
_LEAVES = """([outer, inner]) => {
  const box = outer ? document.querySelector(outer).getBoundingClientRect() : {left: 0, right: innerWidth};
  return [...document.querySelectorAll(inner)].filter(e => e.checkVisibility()).filter(e => {
    const own = e.getBoundingClientRect();
    return own.width && (own.right > box.right + 1.5 || own.left < box.left - 1.5);
  }).map(e => e.ariaLabel || e.innerText || e.className);
}"""

# Pairs of these that meet, by more than a pixel each way.
_MEET = """selectors => {
  const all = selectors.flatMap(s => [...document.querySelectorAll(s)]).filter(e => e.checkVisibility());
  const range = document.createRange();
  const ink = e => { range.selectNodeContents(e); return range.getBoundingClientRect(); };
  const boxes = all.map(e => [e, ink(e)]);
  const wrong = [];
  for (const [i, [a, p]] of boxes.entries()) for (const [b, q] of boxes.slice(i + 1)) {
    const wide = Math.min(p.right, q.right) - Math.max(p.left, q.left);
    const high = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
    if (wide > 1 && high > 1) wrong.push(`${a.innerText} meets ${b.innerText}`);
  }
  return wrong;
}"""

# What stands over the scene: no two cards meet, and none leaves the window.
_CARDS = """() => {
  const seen = [...document.querySelectorAll('.rxf-card, .rxf-notice, .rxf-bar, .rxf-strip')]
    .filter(e => e.checkVisibility()).map(e => [e.className, e.getBoundingClientRect()])
    .filter(([, r]) => r.width && r.height);
  const wrong = [];
  for (const [name, r] of seen)
    if (r.left < -1 || r.right > innerWidth + 1 || r.top < -1 || r.bottom > innerHeight + 1)
      wrong.push(`${name} leaves the window`);
  for (let i = 0; i < seen.length; i++) for (let k = i + 1; k < seen.length; k++) {
    const [a, p] = seen[i], [b, q] = seen[k];
    const wide = Math.min(p.right, q.right) - Math.max(p.left, q.left);
    const high = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
    if (wide > 1 && high > 1) wrong.push(`${a} meets ${b}`);
  }
  return wrong;
}"""


# The buttons of the bar that leave the window, and what leaves the card of the field.
_OUTSIDE = """() => [
  ...[...document.querySelectorAll('.rxf-bar button')].filter(e => e.getBoundingClientRect().right > innerWidth + 1),
  ...[...document.querySelectorAll('.rxf-field button')].filter(e => e.getBoundingClientRect().right >
    e.closest('.rxf-field').getBoundingClientRect().right + 1),
].filter(e => e.checkVisibility()).map(e => e.ariaLabel || e.innerText)"""

# Charts whose drawing is not as wide as the place they have.
_NARROW_CHARTS = """() => [...document.querySelectorAll('.rxf-chart')].filter(e => e.clientWidth)
  .filter(e => Math.abs(e.querySelector('svg').viewBox.baseVal.width - Math.max(e.clientWidth - 32, 60)) > 1)
  .map(e => e.dataset.name)"""

_PARTS = ['[data-explorer="total-power"]', ".rxf-sub", ".rxf-since", ".rxf-why", ".rxf-parts dl", ".rxf-chip"]
SIZES = [(1280, 720), (390, 844), (1920, 1080), (1500, 940), (1024, 768), (768, 1024)]


@pytest.fixture(params=SIZES, ids=lambda size: f"{size[0]}x{size[1]}")
def size(request: pytest.FixtureRequest) -> tuple[int, int]:
    return request.param


@pytest.fixture
def sized(size: tuple[int, int], shared: Watched, browser: "Browser", app: App) -> Iterator[Watched]:
    """The page as it opens. One with a sheet differs from one that is made narrow: it opens it."""
    watched = opened(browser, app.address, size=size) if size[0] <= 860 else shared
    watched.page.set_viewport_size({"width": size[0], "height": size[1]})
    watched.reset()
    yield watched
    assert watched.complaints == []
    if watched is not shared:
        watched.close()


def _none(page: "Page", wrong: str, arg: object = None) -> None:
    """Wait until one of the scripts above finds nothing wrong; what it finds is in the message of the failure."""
    from playwright.sync_api import TimeoutError

    try:
        page.wait_for_function(f"arg => ({wrong})(arg).length === 0", arg=arg)
    except TimeoutError:
        assert page.evaluate(wrong, arg) == []


def test_everything_has_its_place(sized: Watched, size: tuple[int, int]):
    _units_and_power_fit_their_cards(sized)
    if size[0] > 700:  # A telephone has no room for the sentence.
        _a_sentence_is_not_cut_and_moves_nothing(sized)
    _no_two_cards_meet(sized)
    _the_bar_of_a_preview_stays_on_the_stage(sized)


def _units_and_power_fit_their_cards(watched: Watched) -> None:
    page = watched.page
    for field in ("Power dP/dr", "Thrust dT/dr"):  # Those with the longest units.
        watched.show(field)
        page.wait_for_function("field => RX.state.field.field === field", arg=field)
        watched.drawn()
        assert page.evaluate(_LEAVES, [".rxf-field", ".rxf-field *"]) == []
    watched.answered(wholly=True)  # Nothing may come that puts back what is set here.
    long = {"value": "+1 903 kW", "words": "since grabbed", "kind": "bad"}
    page.evaluate("since => RX.set({power: {...RX.state.power, total: '2 801', since}})", long)
    page.wait_for_function("""() => document.querySelector('.rxf-since').innerText.startsWith('+1 903')""")
    assert page.evaluate(_MEET, _PARTS) == []
    assert page.evaluate(_LEAVES, [".rxf-power", ".rxf-power *"]) == []
    # The chart of a search's starts takes two places of the strip and gives them back.
    page.evaluate("() => { window.before = RX.state.strip; RX.set({strip: [{...before[0], wide: true}, before[1]]}); }")
    page.wait_for_function("() => document.querySelectorAll('.rxf-chart').length !== 3")
    _none(page, _NARROW_CHARTS)
    page.evaluate("() => RX.set({strip: window.before})")
    page.wait_for_function("() => document.querySelectorAll('.rxf-chart').length >= 3")
    _none(page, _NARROW_CHARTS)


_WHY = (
    "Nothing has changed.",
    "Lift moved inboard and towards the advancing side: induced −12.3, profile +4.0, tail rotor −0.5 kW.",
    "Lift moved inboard and towards the advancing side: induced −12.3, profile +4.0, tail rotor −0.5 kW; stall grew "
    "inboard on the retreating side (12.3 % of the disk); drag divergence grew near the tip on the advancing side "
    "(5.3 % of the disk).",
)
_STANDS = """() => [...document.querySelectorAll('.rxf-power, .rxf-parts, .rxf-chip')].map(e => {
    const {left, top, bottom} = e.getBoundingClientRect();
    return [left, top, bottom].map(Math.round);
})"""


def _a_sentence_is_not_cut_and_moves_nothing(watched: Watched) -> None:
    page = watched.page
    stands: list[object] = []
    for value, why in (("−1 kW", _WHY[0]), ("−9.2 kW", _WHY[1]), ("+128 kW", _WHY[2])):
        since = {"value": value, "words": "since grabbed", "kind": ""}
        page.evaluate("([since, why]) => RX.set({power: {...RX.state.power, since, why}})", [since, why])
        page.wait_for_function("why => document.querySelector('.rxf-why')?.title === why", arg=why)
        watched.drawn()
        stands.append(page.evaluate(_STANDS))
        shown = " ".join(watched.text("why").split())
        assert shown.endswith(".")
        assert why.replace("\u00a0", " ").startswith(shown.replace("\u00a0", " ").removesuffix("."))
        assert page.evaluate("() => (e => e.scrollHeight <= e.clientHeight + 1)(document.querySelector('.rxf-why'))")
    assert stands[0] == stands[1] == stands[2]


def _no_two_cards_meet(watched: Watched) -> None:
    page = watched.page
    controls = page.get_by_role("button", name="Controls")
    for mode in ("optimise", "actuate", "explore"):
        watched.mode(mode)
        watched.answered()
        _none(page, _CARDS)
        if controls.is_visible():  # Without the rail the stage is another.
            controls.click()
            watched.answered()
            _none(page, _CARDS)
            controls.click()
    page.evaluate("() => RX.send('knot', ['2', [1.0, 6.0]])")
    watched.answered()
    _none(page, _CARDS)
    page.get_by_role("button", name="Pin A").click()
    page.wait_for_function("() => RX.state.bar.pinned")
    watched.answered()
    _none(page, _CARDS)
    _none(page, _OUTSIDE)
    page.evaluate("() => RX.send('pin', '')")
    page.wait_for_function("() => !RX.state.bar.pinned")


def _the_bar_of_a_preview_stays_on_the_stage(watched: Watched) -> None:
    """The longest: that of a schedule in flight, also beside an open rail."""
    page = watched.page
    text = "Speed µ 0.10 · twist, root to tip −11.0° · saved vs. starting design 6.6 kW h"
    page.evaluate("text => RX.set({notice: {text, actions: [['discard', 'Discard'], ['apply', 'Apply']]}})", text)
    page.wait_for_selector(".rxf-notice [data-do=apply]")
    toggle = page.get_by_role("button", name="Controls")
    for _ in range(2 if toggle.is_visible() else 1):
        _none(page, _LEAVES, [".rxf-stage", ".rxf-notice, .rxf-notice *"])
        _none(page, _CARDS)
        if toggle.is_visible():
            toggle.click()
    page.evaluate("() => RX.set({notice: null})")
    page.wait_for_selector(".rxf-notice", state="hidden")


def test_the_lecture_is_a_column_beside_the_scene_and_three_numbers(sized: Watched, size: tuple[int, int]):
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
