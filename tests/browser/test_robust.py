"""A page that opens quickly and whole, waits where it must, and outlives its server."""

import os
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from math import inf
from pathlib import Path

import pytest
from chromium import DRAW_NOTHING
from playwright.sync_api import Browser, BrowserContext
from watched import OPEN, WAIT, Watched

from explorer import web
from explorer.app import App
from explorer.hosting.server_limits import ServerLimits

ROOT = Path(__file__).parent.parent.parent
_WATCH = """
window.__shift = 0; window.__opened = null;
new PerformanceObserver(list => { for (const entry of list.getEntries()) window.__shift += entry.value; })
    .observe({type: 'layout-shift', buffered: true});
const look = () => {
  const open = document.querySelector('[data-explorer=status][data-kind=converged]')
    && !document.documentElement.classList.contains('rx-veiled');
  if (open) window.__opened = performance.now(); else requestAnimationFrame(look);
};
requestAnimationFrame(look);
"""


@pytest.fixture
def context(browser: Browser) -> Iterator[BrowserContext]:
    context = browser.new_context(viewport={"width": 1280, "height": 720})
    context.add_init_script(DRAW_NOTHING)
    context.add_init_script(_WATCH)
    context.set_default_timeout(WAIT)
    yield context
    context.close()


def test_opens_whole_and_then_nothing_jumps(context: BrowserContext, app: App, artefacts: Path):
    page = context.new_page()
    page.goto(app.address)
    page.wait_for_function(OPEN)  # Warms the server: the figures are those of the next page.
    painted, opened, shift = inf, inf, inf
    for _ in range(3):  # A machine that runs tests is busy, but not every time.
        page.reload()
        page.wait_for_function(OPEN)
        page.wait_for_timeout(1500)
        first_paint = page.evaluate(
            "performance.getEntriesByName('first-contentful-paint')[0].startTime"
        )
        seen = (first_paint, *page.evaluate("[window.__opened, window.__shift]"))
        painted, opened, shift = map(min, (painted, opened, shift), seen)
        if painted < 5_000 and opened < 15_000 and shift < 0.02:
            break
    sheets = page.evaluate("[...document.querySelectorAll('body > style')].length")
    line = f"first page: painted {painted:.0f} ms, answer seen {opened:.0f} ms, layout shift {shift:.4f}"
    print(line)
    with (artefacts / "latency.txt").open("a", encoding="utf-8") as file:
        file.write(line + "\n")
    assert shift < 0.02  # 0.1 counts as good; only the veil's own words may move.
    assert painted < 5_000  # The targets are 500 and 2000; machines that run tests are busy.
    assert opened < 15_000
    # In the body itself: a panel that is folded away would take them along.
    assert sheets == len(web.STYLES)


@pytest.mark.slow
def test_a_full_server_seats_the_next_page_when_one_leaves(
    context: BrowserContext, artefacts: Path
):
    app = App("127.0.0.1", 0, limits=ServerLimits(sessions=1))
    try:
        first, second = context.new_page(), context.new_page()
        first.goto(app.address)
        first.wait_for_function(OPEN)
        second.goto(app.address)
        second.wait_for_selector("[data-explorer=lobby]")
        assert "The place is taken." in second.locator("[data-explorer=lobby]").inner_text()
        assert second.locator("[role=slider]:visible").count() == 0
        second.wait_for_timeout(400)
        second.screenshot(path=artefacts / "full-house.png")
        first.close()
        second.wait_for_function(OPEN)
        second.locator("[data-explorer=lobby]").wait_for(state="detached")
        second.locator("[role=slider]:visible").first.wait_for()
    finally:
        app.stop()


@pytest.mark.slow
def test_outlives_its_server(context: BrowserContext, artefacts: Path):
    """A real restart on the same port: the page says so, comes back by itself, and shows the same design."""
    port, page = free_port(), context.new_page()
    with served(port) as address:
        page.goto(address)
        page.wait_for_function(OPEN)
        Watched(page).type("Δ inboard", -11.5)
        page.wait_for_function("() => location.search.includes('-11.5')")
        page.wait_for_function("() => RX.state.line.pieces.some(piece => piece.part === 'moved')")
        page.wait_for_function("() => !document.querySelector('[data-do=undo]').disabled")
        page.keyboard.press("Escape")  # In a field of numbers, keys are the field's own.
        page.keyboard.press("m")
        page.wait_for_function(
            "() => JSON.parse(sessionStorage['rx-kept'] ?? '{}').steps?.includes('bookmarks\":[\"1')"
        )
        power = page.locator("[data-explorer=total-power]").first.inner_text()
    page.wait_for_selector("#rx-gone")
    page.screenshot(path=artefacts / "server-gone.png")
    with served(port):
        # A new process has everything to load before it answers.
        page.wait_for_selector("#rx-gone", state="detached", timeout=4 * WAIT)
        page.wait_for_function(OPEN, timeout=4 * WAIT)
        inboard = "() => [...document.querySelectorAll('input')].some(one => one.value === '-11.5')"
        page.wait_for_function(inboard)
        same = "power => document.querySelector('[data-explorer=total-power]').innerText === power"
        page.wait_for_function(same, arg=power)
        page.locator("[data-do=drawer][data-value=open]").click()
        page.get_by_role("button", name="History").click()
        page.locator("[data-explorer=kept]").wait_for()
        page.get_by_role("button", name="Undo").click()
        page.wait_for_function("() => !location.search.includes('-11.5')")
        page.get_by_role("button", name="Redo").click()
        page.wait_for_function("() => location.search.includes('-11.5')")


def free_port() -> int:
    """One below those that systems give to outgoing connections: nobody else takes it between two servers."""
    for port in range(20_000 + os.getpid() % 10_000, 32_000):
        with socket.socket() as probe, suppress(OSError):
            probe.bind(("127.0.0.1", port))
            return port
    raise OSError("no free port")


@contextmanager
def served(port: int) -> Iterator[str]:
    """A server of its own process, ended as a service manager ends it."""
    command = [sys.executable, "-m", "explorer", "--port", str(port), "--no-browser"]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True) as server:
        try:
            while "http://" not in server.stdout.readline():
                assert server.poll() is None
            yield f"http://127.0.0.1:{port}"
        finally:  # A test that failed must not wait for it for ever.
            server.terminate()
        assert server.wait(90) == 0
