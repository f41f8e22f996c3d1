"""Connections that take long, break and come back: a proxy between browser and server delays and cuts them."""

import asyncio
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from urllib.parse import urlsplit

import pytest
from chromium import DRAW_NOTHING
from playwright.sync_api import Browser, Page
from watched import COARSE, OPEN, WAIT, Watched

from explorer.app import App

pytestmark = [
    pytest.mark.slow,
    # A connection that comes while the proxy ends is left to the collector.
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),
]


class Proxy:
    """Passes bytes between a browser and a server, which is seen in `folder`, "/rotor" or the like.

    A WebSocket's handshake is answered after `delay` [s].
    """

    def __init__(self, address: str) -> None:
        self.delay, self.handshakes, self.folder = 0.0, 0, ""
        self.cut_off = self.deaf = False
        self._target = urlsplit(address)
        self._open: set[asyncio.StreamWriter] = set()
        self._begun, self._thread = (
            threading.Event(),
            threading.Thread(target=lambda: asyncio.run(self._serve())),
        )
        self._thread.start()
        self._begun.wait()

    async def _serve(self) -> None:
        self._loop, self._ended = asyncio.get_running_loop(), asyncio.Event()
        server = await asyncio.start_server(self._pass, "127.0.0.1", 0)
        self.address = f"http://127.0.0.1:{server.sockets[0].getsockname()[1]}"
        self._begun.set()
        await self._ended.wait()
        server.close()
        self._abort()
        await asyncio.sleep(0.2)  # So that what passes bytes ends by itself.

    async def _pass(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        if self.cut_off:
            writer.transport.abort()
            return
        server_reader, server = await asyncio.open_connection(
            self._target.hostname, self._target.port
        )
        self._open |= {writer, server}
        with suppress(OSError, asyncio.IncompleteReadError):
            head = await reader.readuntil(b"\r\n\r\n")
            if f" {self.folder}/".encode() not in head.partition(b"\r\n")[0]:
                raise ConnectionError("nothing is served outside the folder")
            head = head.replace(f" {self.folder}/".encode(), b" /", 1)
            if b"Upgrade: websocket" in head:
                self.handshakes += 1
                with suppress(TimeoutError):
                    await asyncio.wait_for(self._ended.wait(), self.delay)
                if self._ended.is_set():
                    raise ConnectionError("the test is over")
            server.write(head)
            await asyncio.gather(
                self._copy(reader, server, sent=True), self._copy(server_reader, writer)
            )
        for one in (writer, server):
            self._open.discard(one)
            one.close()

    async def _copy(
        self, source: asyncio.StreamReader, to: asyncio.StreamWriter, sent: bool = False
    ) -> None:
        with suppress(OSError):
            while data := await source.read(2**16):
                if not (sent and self.deaf):
                    to.write(data)
                    await to.drain()
        to.close()

    def cut(self, off: bool = True) -> None:
        """End all connections, and refuse new ones until they are allowed again."""
        self.cut_off = off
        if off:
            self._loop.call_soon_threadsafe(self._abort)

    def _abort(self) -> None:
        for one in tuple(self._open):
            one.transport.abort()

    def stop(self) -> None:
        self._loop.call_soon_threadsafe(self._ended.set)
        self._thread.join()


@pytest.fixture
def proxy(app: App) -> Iterator[Proxy]:
    proxy = Proxy(app.address)
    yield proxy
    proxy.stop()


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    context = browser.new_context(viewport={"width": 1280, "height": 720})
    context.add_init_script(DRAW_NOTHING)
    context.set_default_timeout(WAIT)
    yield context.new_page()
    context.close()


def set_inboard(page: Page, value: float) -> None:
    Watched(page).type("Δ inboard", value)
    page.wait_for_function(f"() => location.search.includes('{value}')")


@pytest.fixture
def twisted(page: Page, proxy: Proxy) -> Page:
    """Connected, with a twist that its address tells."""
    page.goto(proxy.address + COARSE)
    page.wait_for_function(OPEN)
    set_inboard(page, -7.9)
    return page


@pytest.mark.parametrize("delay", [0.3, 1.6, 5.5])
def test_connects_and_reconnects_however_long_the_handshake_takes(
    page: Page, proxy: Proxy, delay: float
):
    """viser's client alone tries again every second, closing the socket that connects, and gives up after five."""
    proxy.delay = delay
    page.goto(proxy.address + COARSE)
    page.wait_for_function(OPEN)
    assert proxy.handshakes == 1
    proxy.cut()
    page.wait_for_selector("#rx-gone")
    begin = time.monotonic()
    proxy.cut(off=False)
    page.wait_for_selector("#rx-gone", state="detached")
    page.wait_for_function(OPEN)
    assert proxy.handshakes == 2
    assert time.monotonic() - begin < delay + 30.0


def test_is_served_in_a_folder(page: Page, proxy: Proxy):
    proxy.folder = "/rotor"
    page.goto(f"{proxy.address}/rotor/{COARSE}")
    page.wait_for_function(OPEN)
    set_inboard(page, -7.9)


def test_what_is_pressed_after_a_reconnect_is_held_back_or_answered(twisted: Page, proxy: Proxy):
    """For up to 2.5 s presses went to the session that had gone, and `RX.idle` never returned."""
    page = twisted
    proxy.cut()
    page.wait_for_selector("#rx-gone")
    proxy.cut(off=False)
    page.wait_for_selector("#rx-gone", state="detached")
    page.evaluate("() => { RX.idle().then(() => { window.__idle = true; }); }")
    press = "document.querySelector('.rxf-modes [data-value=optimise]').click()"
    page.wait_for_function(
        f"() => !document.documentElement.hasAttribute('data-held') && ({press}, true)"
    )
    page.wait_for_function("() => window.__idle")
    page.wait_for_function("() => RX.state.bar?.mode === 'optimise'")
    assert "-7.9" in page.url


def test_nothing_can_be_changed_while_the_server_is_away(twisted: Page, proxy: Proxy):
    """A slider once stood at −7.3 while the server was away, and at −7.9 after it had come back."""
    page, watched = twisted, Watched(twisted)
    field = watched.field("Δ inboard")
    x, y = watched.thumb("Δ inboard")
    watched.hold(x, y)  # The drag that is under way ends with the connection.
    page.wait_for_function("() => location.search.includes(':-8,')")
    proxy.cut()
    page.wait_for_selector("#rx-gone")
    said = page.locator("#rx-gone").inner_text()
    assert "You cannot change anything until it returns" in said
    before = field.input_value()
    page.mouse.move(x + 83, y)
    page.mouse.up()
    page.mouse.click(x + 53, y)
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Tab")
    page.keyboard.press("ArrowRight")
    assert page.evaluate("() => document.activeElement === document.body")
    assert field.input_value() == before
    proxy.cut(off=False)
    page.wait_for_selector("#rx-gone", state="detached")
    page.wait_for_function("() => !document.documentElement.hasAttribute('data-held')")
    assert field.input_value() == before
    set_inboard(page, -7.3)


def test_a_change_that_did_not_arrive_is_named(twisted: Page, proxy: Proxy):
    """Sent in the moment in which the connection breaks."""
    page, watched = twisted, Watched(twisted)
    proxy.deaf = True  # What the browser sends goes nowhere.
    watched.type("Δ inboard", -7.3)
    proxy.cut()
    page.wait_for_selector("#rx-gone")
    proxy.deaf = False
    proxy.cut(off=False)
    page.wait_for_selector("#rx-lost")
    assert (
        "Δ inboard [°/R] was -7.3, is -7.9. Set it again." in page.locator("#rx-lost").inner_text()
    )
    page.mouse.click(5, 5)
    page.wait_for_selector("#rx-lost", state="detached")


def test_a_tab_that_slept_for_a_day_comes_back_with_its_design(page: Page, proxy: Proxy):
    """The machine sleeps, its connection ends without a word, and the clocks of page and day have gone on."""
    page.clock.install()
    page.goto(proxy.address + COARSE)
    page.wait_for_function(OPEN)
    set_inboard(page, -7.9)
    devtools = page.context.new_cdp_session(page)
    devtools.send("Page.setWebLifecycleState", {"state": "frozen"})
    proxy.cut()
    proxy.cut(off=False)
    time.sleep(1.0)
    page.clock.fast_forward("24:00:00")
    devtools.send("Page.setWebLifecycleState", {"state": "active"})
    page.wait_for_function(
        "() => !document.querySelector('#rx-gone') && !document.documentElement.hasAttribute('data-held')"
    )
    page.wait_for_function(OPEN)
    assert "-7.9" in page.evaluate("() => location.search")
    set_inboard(page, -7.3)


FAST = "const now = performance.now.bind(performance); performance.now = () => 12 * now();"
"""Time passes twelve times as fast for what waits in the page."""


@pytest.mark.parametrize("way", ["no WebSocket", "messages lost"])
def test_a_page_without_a_connection_does_not_go_on_solving(page: Page, proxy: Proxy, way: str):
    """As behind a proxy that passes no WebSockets: the frame is served with the page, the first trim comes after it."""
    page.add_init_script(FAST)
    proxy.delay, proxy.deaf = (1e4, False) if way == "no WebSocket" else (0.0, True)
    page.goto(proxy.address + COARSE)
    card = "document.querySelector('[data-explorer=line]')?.textContent ?? ''"
    page.wait_for_function(
        f"() => {{ const said = {card}; return said && !said.includes('Solving the first trim'); }}"
    )
    if way == "no WebSocket":
        assert "The server does not answer" in page.inner_text("[data-explorer=line]")


def test_a_clock_set_back_by_a_day_stops_nothing(twisted: Page, monkeypatch: pytest.MonkeyPatch):
    """viser's frames carry the time of day, by which its client smooths their arrival."""
    clock = time.time
    for hours, value in ((-24, -7.3), (0, -6.5)):  # Back, and forward again.
        monkeypatch.setattr(time, "time", lambda hours=hours: clock() + 3600.0 * hours)
        begin = time.monotonic()
        set_inboard(twisted, value)
        Watched(twisted).answered()
        assert time.monotonic() - begin < 30.0
