"""No label wraps, nothing is cut off and nothing sticks out of its panel, on any tab, in the smaller window."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest
from watched import Watched, opened

from explorer.app import App
from explorer.state import Inputs

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
    if (style.textOverflow === 'ellipsis' && e.closest('[title]')) continue;
    if (style.display !== 'inline' && e.scrollWidth > e.clientWidth + 1)
      faults.add(`${name(e)}: cut off`);
  }
  for (const e of document.querySelectorAll('.rx, .rx *, input, label, button')) {
    const panel = e.closest('[data-dock-group]');
    if (panel && shown(e) && e.getBoundingClientRect().right > panel.getBoundingClientRect().right + 1)
      faults.add(`${name(e) || e.tagName}: sticks out of its panel`);
  }
  for (const e of document.querySelectorAll('[data-dock-group] div'))
    if (shown(e) && e.scrollWidth > e.clientWidth + 1 && ['auto', 'scroll'].includes(getComputedStyle(e).overflowX))
      faults.add(`${name(e)}: scrolls sideways`);
  return [...faults];
}"""
_ROWS_OF_TABS = """() => {
  const rows = new Map();
  for (const tab of document.querySelectorAll('[role=tab]')) {
    const row = tab.parentElement;
    rows.set(row, [...(rows.get(row) ?? []), Math.round(tab.getBoundingClientRect().top)]);
  }
  return [...rows.values()].map(tops => new Set(tops).size);
}"""


@pytest.fixture(scope="module")
def watched(browser: "Browser", app: App) -> Iterator[Watched]:
    watched = opened(browser, app.address, query="", size=(1280, 720))
    watched.quiet()
    yield watched
    watched.close()


def faults(watched: Watched) -> dict[str, list[str]]:
    """What is wrong, by tab, with every folder open."""
    page = watched.page
    found: dict[str, list[str]] = {}
    for tab in page.locator("[role=tab]").all():
        tab.click()
        page.wait_for_timeout(250)
        folders = page.locator("[data-dock-group] svg.tabler-icon-chevron-down:visible")
        for _ in range(folders.count()):
            folders.first.click()
            page.wait_for_timeout(300)
        found[tab.inner_text()] = page.evaluate(_FAULTS)
    return {tab: wrong for tab, wrong in found.items() if wrong}


def test_every_tab(watched: Watched):
    assert faults(watched) == {}
    assert watched.page.evaluate(_ROWS_OF_TABS) == [1, 1]


def test_every_tab_while_a_design_is_pinned(watched: Watched):
    watched.page.keyboard.press("Escape")
    watched.page.get_by_role("button", name="Pin as A").click()
    watched.page.wait_for_timeout(1000)
    assert faults(watched) == {}


def test_the_test_sees_what_it_looks_for(watched: Watched):
    watched.page.evaluate(
        """() => [...document.querySelectorAll('label')].find(e => e.offsetWidth > 0 && e.innerText)
            .append(' and many more words than fit')"""
    )
    assert any("more than one line" in fault for fault in watched.page.evaluate(_FAULTS))
