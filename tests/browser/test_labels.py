"""No label wraps, nothing is cut off and nothing sticks out of its panel, in any mode or drawer."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest
from watched import WAIT, Watched, opened

from explorer.app import App
from explorer.state import Inputs
from explorer.tabs.layout import DRAWERS

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = pytest.mark.browser
START = Inputs(law="three")

_FAULTS = """() => {
  const faults = new Set();
  const shown = e => { const r = e.getBoundingClientRect();
    return r.width > 0 && r.height > 0 && e.checkVisibility({visibilityProperty: true}); };
  const pieces = e => { const range = document.createRange(); range.selectNodeContents(e);
    return [...range.getClientRects()].filter(r => r.width > 1 && r.height > 4); };
  const name = e => e.innerText.trim().replace(/\\s+/g, ' ').slice(0, 50);
  // What is one line by intention: a widget's label, a button, a tab, a row of a read-out.
  for (const e of document.querySelectorAll('label, button, [role=tab], .rx-line > span, .rx td')) {
    if (!shown(e) || !name(e) || e.closest('.mantine-Notification-root')) continue;
    const rects = pieces(e);
    if (!rects.length) continue;
    const height = Math.max(...rects.map(r => r.bottom)) - Math.min(...rects.map(r => r.top));
    if (height > 1.75 * Math.min(...rects.map(r => r.height)) && !e.querySelector('br'))
      faults.add(`${name(e)}: on more than one line`);
    const style = getComputedStyle(e);  // An ellipsis is wanted where the whole text is a hover away.
    if (style.textOverflow === 'ellipsis' && (e.closest('[title]') || e.closest('#rx'))) continue;
    if (style.display !== 'inline' && e.scrollWidth > e.clientWidth + 1)
      faults.add(`${name(e)}: cut off`);
  }
  for (const e of document.querySelectorAll('.rx, .rx *, label, [data-dock-region] input, [data-dock-region] button')) {
    const panel = e.closest('[data-dock-group]');
    if (panel && shown(e) && e.getBoundingClientRect().right > panel.getBoundingClientRect().right + 1)
      faults.add(`${name(e) || e.tagName}: sticks out of its panel`);
  }
  for (const e of document.querySelectorAll('[data-dock-group] div'))
    if (shown(e) && e.scrollWidth > e.clientWidth + 1 && ['auto', 'scroll'].includes(getComputedStyle(e).overflowX))
      faults.add(`${name(e)}: scrolls sideways`);
  return [...faults];
}"""


@pytest.fixture(scope="module")
def watched(browser: "Browser", app: App) -> Iterator[Watched]:
    watched = opened(browser, app.address, query="", size=(1280, 720))
    watched.quiet()
    yield watched
    watched.close()


MODES = ("explore", "optimise", "actuate")
SECTIONS = {"optimise": ("Search", "Map", "Schedule"), "open": ("Studies", "Files", "History")}


def unfold(watched: Watched) -> None:
    folders = watched.page.locator("[data-dock-group] svg.tabler-icon-chevron-down:visible")
    for _ in range(folders.count()):
        folders.first.click()
        watched.page.wait_for_timeout(250)


def faults(watched: Watched) -> dict[str, list[str]]:
    """What is wrong, by place, with every folder open."""
    found: dict[str, list[str]] = {}

    def look(place: str) -> None:
        for section in SECTIONS.get(place, ("",)):
            if section:
                watched.section(section)
            watched.page.wait_for_timeout(300)
            unfold(watched)
            found[f"{place} {section}".strip()] = watched.page.evaluate(_FAULTS)

    for mode in MODES:
        watched.mode(mode)
        look(mode)
    for drawer in DRAWERS:
        watched.drawer(drawer)
        look(drawer)
    return {place: wrong for place, wrong in found.items() if wrong}


def test_every_mode_and_drawer(watched: Watched):
    assert faults(watched) == {}


def test_every_mode_and_drawer_while_a_design_is_pinned(watched: Watched):
    watched.page.keyboard.press("Escape")
    watched.page.get_by_role("button", name="Pin A").click()
    watched.page.wait_for_function("() => RX.state.bar.pinned")
    assert faults(watched) == {}


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


@pytest.mark.parametrize("size", [(1920, 1080), (1500, 940), (1280, 720), (768, 1024), (390, 844)])
def test_no_two_cards_meet(browser: "Browser", app: App, size: tuple[int, int]):
    watched = opened(browser, app.address, size=size)
    watched.page.wait_for_timeout(500)
    for mode in MODES:
        watched.mode(mode)
        watched.page.wait_for_timeout(200)
        assert watched.page.evaluate(_CARDS) == [], mode
    watched.mode("explore")
    watched.page.evaluate("() => RX.send('knot', ['2', [1.0, 6.0]])")
    watched.page.wait_for_function("() => RX.state.power.since", timeout=WAIT)
    assert watched.page.evaluate(_CARDS) == []
    watched.page.get_by_role("button", name="Pin A").click()
    watched.page.wait_for_function("() => RX.state.bar.pinned", timeout=WAIT)
    assert watched.page.evaluate(_CARDS) == []
    assert watched.page.evaluate(_OUTSIDE) == []
    watched.close()


def test_the_test_sees_what_it_looks_for(watched: Watched):
    watched.page.evaluate(
        """() => [...document.querySelectorAll('label')].find(e => e.offsetWidth > 0 && e.innerText)
            .append(' and many more words than fit')"""
    )
    assert any("more than one line" in fault for fault in watched.page.evaluate(_FAULTS))
