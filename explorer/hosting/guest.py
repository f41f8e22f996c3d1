"""One browser's way through the house: asked who it is, seated or kept in line, and gone again."""

import threading
from collections.abc import Callable

import viser

from explorer.hosting import viser_compat
from explorer.hosting.lobby import WaitingPage
from explorer.session import Session

FIRST = 0.6
"""[s] the page stays blank for its first answer; one that takes longer finds the page saying that it is on its way."""
Seat = Callable[[viser.ClientHandle, viser_compat.PageFacts], Session]


class ClientConnection:
    """Lives as long as its connection. Every step may come on another thread; one is taken at a time."""

    def __init__(self, client: viser.ClientHandle) -> None:
        self.client = client
        self._lock = threading.Lock()
        self._facts = viser_compat.PageFacts()
        self._lobby: WaitingPage | None = None
        self._session: Session | None = None
        self._gone = False

    def ask(self) -> None:
        """What only the browser knows; blocks up to some seconds."""
        self._facts = viser_compat.page_facts(self.client)

    def wait(self, places: int, ahead: int) -> None:
        """Stand in line behind so many."""
        with self._lock:
            if self._gone or self._session is not None:
                return
            if self._lobby is None:
                self._lobby = WaitingPage(self.client, places, ahead, self._facts.dark)
            else:
                self._lobby.show(ahead)

    def sit(self, seat: Seat) -> None:
        """Take the place: only now is there a session with its worker."""
        with self._lock:
            if self._gone or self._session is not None:
                return
            if self._lobby is not None:
                self._lobby.close()
                self._lobby = None
            viser_compat.guard_uploads(self.client, self._refused)
            with viser_compat.at_once(self.client):
                self._session = seat(self.client, self._facts)
                self._session.start()
                self._session.until_shown(FIRST)

    def _refused(self, sentence: str) -> None:
        self.client.add_notification("File refused", sentence, color="red", auto_close_seconds=10)

    @property
    def session(self) -> Session | None:
        """Behind the page, once it has a place."""
        return self._session

    def leave(self) -> None:
        """The connection has ended."""
        with self._lock:
            self._gone = True
            session, self._session = self._session, None
        if session is not None:
            session.stop()
