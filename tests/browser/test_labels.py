"""No label wraps, nothing is cut off and nothing sticks out of its panel, in any mode or drawer."""

import pytest
from watched import Watched

from explorer.model.inputs import Inputs
from explorer.widgets.layout import DRAWERS

START = Inputs(law="three")

_FAULTS = """() => {
  const faults = new Set();
  const shown = e => { const r = e.getBoundingClientRect();
    return r.width > 0 && r.height > 0 && e.checkVisibility({visibilityProperty: true}); };
  // Of its words alone: a picture above them is no second line.
  const pieces = e => { const range = document.createRange(), found = [];
    const words = document.createTreeWalker(e, NodeFilter.SHOW_TEXT);
    while (words.nextNode()) { range.selectNodeContents(words.currentNode); found.push(...range.getClientRects()); }
    return found.filter(r => r.width > 1 && r.height > 4); };
  const name = e => e.innerText.trim().replace(/\\s+/g, ' ').slice(0, 50);
  // What is one line by intention: a widget's label, a button, a tab, a row of a read-out.
  for (const e of document.querySelectorAll('label, button, [role=tab], .rx-line > span, .rx td')) {
    if (!shown(e) || !name(e) || e.closest('.mantine-Notification-root')) continue;
    const rects = pieces(e);
    if (!rects.length) continue;
    const height = Math.max(...rects.map(r => r.bottom)) - Math.min(...rects.map(r => r.top));
    if (height > 1.75 * Math.max(...rects.map(r => r.height)) && !e.querySelector('br, small'))
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
MODES = ("explore", "optimise", "actuate")
SECTIONS = {"optimise": ("Search", "Map", "Schedule"), "open": ("Files", "History")}
SIZE = (1280, 720)


def faults(watched: Watched) -> dict[str, list[str]]:
    """What is wrong, by place, with every folder open."""
    found: dict[str, list[str]] = {}

    def look(place: str) -> None:
        for section in SECTIONS.get(place, ("",)):
            if section:
                watched.section(section)
            watched.open_folders()
            watched.answered()
            wrong = watched.page.evaluate(_FAULTS)
            if wrong:  # What is wrong only while the page lays itself out does not count.
                wrong = watched.at_rest(lambda: watched.page.evaluate(_FAULTS))
            if wrong:
                found[f"{place} {section}".strip()] = wrong

    for mode in MODES:
        watched.mode(mode)
        look(mode)
    for drawer in DRAWERS:
        watched.drawer(drawer)
        look(drawer)
    return found


@pytest.mark.slow
def test_every_mode_and_drawer(watched: Watched):
    """With a pinned design, whose rows stand beside the others."""
    page = watched.page
    page.get_by_role("button", name="Pin A").click()
    page.wait_for_function("() => RX.state.bar.pinned")
    assert faults(watched) == {}
    # The test sees what it looks for.
    page.evaluate(
        """() => { const label = [...document.querySelectorAll('label:not(:has(input))')]
                .find(e => e.offsetWidth > 0 && e.innerText);
            label.append(' and many more words than fit'); }"""
    )
    assert any("more than one line" in fault for fault in page.evaluate(_FAULTS))
