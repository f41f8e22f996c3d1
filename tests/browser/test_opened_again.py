"""Every panel that is opened again is whole: what it shows belongs to the design that is on the page now.

What is hidden does not follow the page. One page reads all its panels, changes the design while they are hidden, and
reads them again; the other opens the link of the changed design, and has shown no other.
"""

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser
from watched import COARSE, LARGE, Watched, opened

from explorer.app import App
from explorer.model import actuator_inputs
from explorer.model.inputs import Inputs
from explorer.widgets.layout import DRAWERS
from explorer.workers.background import PoolAnswers

pytestmark = pytest.mark.slow
START = Inputs(law="two", preset="thesis")
SECTIONS = {"optimise": ("Search", "Map", "Schedule"), "open": ("Files", "History")}
PANELS = [
    (name, part)
    for name in ("explore", "optimise", "actuate", *DRAWERS)
    for part in SECTIONS.get(name, ("",))
]
READ = """name => {
    const seen = e => e.checkVisibility({visibilityProperty: true}) && e.getClientRects().length > 0;
    const drawer = document.querySelector('[data-explorer=drawer]')?.closest('[data-dock-group]');
    const rails = [...document.querySelectorAll('[data-dock-group]')].filter(e => e !== drawer);
    const found = [], {flight, earns} = RX.state;
    const read = e => {
        if (!seen(e)) return;
        if (e.matches('input, select')) found.push(`${e.type} ${e.value} ${e.checked ?? ''} ${e.disabled}`);
        for (const shape of ['d', 'points', 'cx', 'cy']) if (e.hasAttribute(shape)) found.push(e.getAttribute(shape));
        for (const child of e.childNodes)
            if (child.nodeType === Node.TEXT_NODE && child.data.trim()) found.push(child.data.trim());
            else if (child.nodeType === Node.ELEMENT_NODE) read(child);
    };
    for (const root of drawer ? [drawer] : rails) read(root);
    if (name === 'actuate')  // Drawn as large as the stage is: their words, and what they are drawn from.
        for (const part of ['fly', 'earns']) found.push(RX.part(part).innerText);
    return name === 'actuate' ? [...found, JSON.stringify([flight, earns])] : found;
}"""
COURSE = re.compile(r"[\d.]+ ms|10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+|\d+ iterations?")
"""What a solve took from where it began."""
Readings = dict[tuple[str, str], list[str]]
MADE: list[PoolAnswers] = []
"""Of pages that were opened since."""


class Rest:
    """Waits until nothing is computed for a page, by its workers neither, and all is drawn."""

    def __init__(self, watched: Watched) -> None:
        watched.answered()
        self._watched = watched

    def __call__(self) -> None:
        self._watched.answered(wholly=True)
        while answers := self._answers():
            self._watched.until(lambda answers=answers: not any(map(works, answers)))
            self._watched.answered(wholly=True)  # It may ask for more.

    @staticmethod
    def _answers() -> list[PoolAnswers]:
        """Those that work; a panel has its own from its first question on."""
        return [one for one in MADE if not one._stopped and works(one)]


def works(answers: PoolAnswers) -> bool:
    return answers._job is not None or answers._timer is not None


def show(watched: Watched, panel: tuple[str, str]) -> None:
    name, part = panel
    if name in DRAWERS:
        watched.drawer(name)
    else:
        watched.mode(name)
    if part:
        watched.section(part)


def close(watched: Watched, mode: str = "explore") -> None:
    """Leave all panels but this one."""
    watched.page.evaluate("() => { if (RX.state.bar.drawer) RX.send('drawer', ''); }")
    watched.page.wait_for_selector('[data-explorer="drawer"]', state="detached")
    watched.mode(mode)


def read(watched: Watched, rest: Rest) -> Readings:
    readings: Readings = {}
    for panel in PANELS:
        show(watched, panel)
        watched.open_folders()
        rest()
        words = watched.at_rest(lambda panel=panel: watched.page.evaluate(READ, panel[0]))
        readings[panel] = [COURSE.sub("…", word) for word in words]
        close(watched, panel[0] if panel[0] not in DRAWERS else "explore")
    close(watched)
    return readings


def step(watched: Watched, way: str) -> None:
    """Undo or redo the change of the design."""
    watched.page.evaluate("way => RX.send(way)", way)
    watched.answered(wholly=True)


@pytest.fixture(scope="module")
def monkeypatch() -> Iterator[pytest.MonkeyPatch]:
    with pytest.MonkeyPatch.context() as patch:
        yield patch


@pytest.fixture(scope="module")
def readings(
    browser: Browser, app: App, monkeypatch: pytest.MonkeyPatch
) -> tuple[Readings, Readings, Readings, Readings]:
    """Before, after a change and back, after the change; of the page that opened with the change."""
    monkeypatch.setattr(actuator_inputs, "actuators", tuple)  # The chosen one alone is judged.
    made = PoolAnswers.__init__

    def noted(one: PoolAnswers, *given: Any) -> None:
        made(one, *given)
        MADE.append(one)

    monkeypatch.setattr(PoolAnswers, "__init__", noted)
    watched = opened(browser, app.address, size=LARGE)
    watched.quiet()
    rest = Rest(watched)
    watched.type("Mass", 9.1)
    rest()
    step(watched, "undo")
    before = read(watched, rest)
    watched.mode("optimise")  # Explore is hidden too.
    step(watched, "redo")
    step(watched, "undo")
    watched.mode("explore")
    step(watched, "redo")
    step(watched, "undo")
    back = read(watched, rest)
    watched.mode("optimise")
    step(watched, "redo")
    after = read(watched, rest)
    address = watched.page.evaluate("() => location.search.slice(1)")
    complaints = watched.complaints
    watched.close()
    fresh = opened(browser, app.address, f"{COARSE}&{address.replace(COARSE[1:], '')}", size=LARGE)
    fresh.quiet()
    new = read(fresh, Rest(fresh))
    assert complaints + fresh.complaints == []
    assert MADE
    fresh.close()
    return before, back, after, new


@pytest.mark.parametrize("panel", PANELS, ids=lambda panel: "-".join(filter(None, panel)))
def test_a_panel_opened_again_is_whole(
    readings: tuple[Readings, Readings, Readings, Readings], panel: tuple[str, str]
):
    before, back, after, new = (all_[panel] for all_ in readings)
    assert len(before) > 3
    assert back == before
    assert after == new
