"""The connection of one browser: it waits or gets a session, and ends."""

import threading
import time
from collections.abc import Callable

import viser

from explorer import web
from explorer.hosting import viser_compat
from explorer.hosting.browser import PageFacts, page_facts
from explorer.session import Session

FIRST = 0.6
"""[s] the page stays blank for its first solution. After that it says that the solution is on its way."""
_TELL_EVERY = 10.0
"""[s] between two sentences about values that no page of ours sends."""
MakeSession = Callable[[viser.ClientHandle, PageFacts], Session]


class ClientConnection:
    """Exists from connect to disconnect. Each step may come on another thread; they run one at a time."""

    def __init__(self, client: viser.ClientHandle) -> None:
        self.client = client
        self._lock = threading.Lock()
        self._facts = PageFacts()
        self._waiting: WaitingPage | None = None
        self._session: Session | None = None
        self._gone = False
        self._told = -_TELL_EVERY

    def ask(self) -> None:
        """Ask the browser for its address and theme; blocks up to some seconds."""
        self._facts = page_facts(self.client)

    def wait(self, places: int, ahead: int) -> None:
        """All places are taken and `ahead` others wait before this one."""
        with self._lock:
            if self._gone or self._session is not None:
                return
            if self._waiting is None:
                self._waiting = WaitingPage(self.client, places, ahead, self._facts.dark)
            else:
                self._waiting.show(ahead)

    def begin(self, make: MakeSession) -> None:
        """A place is free: make the session and show it."""
        with self._lock:
            if self._gone or self._session is not None:
                return
            if self._waiting is not None:
                self._waiting.close()
                self._waiting = None
            viser_compat.guard_uploads(self.client, self._refused)
            viser_compat.guard_values(self.client, self._ignored)
            with viser_compat.at_once(self.client):
                self._session = make(self.client, self._facts)
                self._session.start()
                self._session.until_shown(FIRST)

    @property
    def session(self) -> Session | None:
        """The session behind the page, once it has a place."""
        return self._session

    def leave(self) -> None:
        """The connection has ended."""
        with self._lock:
            self._gone = True
            session, self._session = self._session, None
        if session is not None:
            session.stop()

    def _ignored(self, sentence: str) -> None:
        """A value was refused; many of them are reported once in a while."""
        now = time.monotonic()
        if now - self._told > _TELL_EVERY:
            self._told = now
            self.client.add_notification("Ignored", sentence, color="red", auto_close_seconds=10)

    def _refused(self, sentence: str) -> None:
        self.client.add_notification("File refused", sentence, color="red", auto_close_seconds=10)


class WaitingPage:
    """What a browser shows while all places are taken: a dialogue on an empty page, without rotor or worker."""

    def __init__(self, client: viser.ClientHandle, places: int, ahead: int, dark: bool) -> None:
        self._places = places
        gui = self._gui = client.gui
        gui.configure_theme(dark_mode=dark, show_logo=False, show_share_button=False)
        gui.main_panel.minimize()
        self._modal = gui.add_modal("Rotor explorer")
        with self._modal:
            self._words = gui.add_html(_waiting_text(places, ahead))

    def show(self, ahead: int) -> None:
        """`ahead` others wait before this one."""
        self._words.content = _waiting_text(self._places, ahead)

    def close(self) -> None:
        """Make room for the session."""
        self._modal.close()
        self._gui.main_panel.expand()


def _waiting_text(places: int, ahead: int) -> str:
    """The sentences, as HTML."""
    taken = f"All {places} places are taken." if places > 1 else "The place is taken."
    place = "second" if ahead == 1 else f"number {ahead + 1}"
    line = f"You are {place} in the queue." if ahead else "You are next."
    return web.fill("lobby.html", {"taken": taken, "line": line})
