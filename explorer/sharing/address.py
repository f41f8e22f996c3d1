"""The query of the page's address, kept by the server; several parts of the page have a name in it."""

import math
import threading
import time
from collections.abc import Callable
from typing import TypeVar
from urllib.parse import parse_qsl, quote

from rotor.user_input import refusing

_PLAIN = ":;,@/="
"""Characters that are not escaped, so that a design in the address can be read."""

_Part = TypeVar("_Part")

_PAUSE = 0.4
"""[s] between two changes: browsers refuse a hundred in half a minute."""


def parameter(query: str, name: str) -> str | None:
    """The value of a name; None where it is not there."""
    return dict(parse_qsl(query.lstrip("?"), keep_blank_values=True)).get(name)


def with_parameter(query: str, name: str, value: str | None) -> str:
    """The query with a name set, at its end; None removes it. Everything else stays."""
    pairs = [pair for pair in parse_qsl(query.lstrip("?"), keep_blank_values=True) if pair[0] != name]
    if value is not None:
        pairs.append((name, value))
    return "?" + "&".join(f"{quote(key, _PLAIN)}={quote(text, _PLAIN)}" for key, text in pairs)


class Address:
    """The address of one page; safe from any thread."""

    def __init__(self, query: str | None, write: Callable[[str], None], pause: float = _PAUSE) -> None:
        """`query`: that of the opened page; None, not known, is never written over. `write` puts another into the
        address, at least `pause` [s] apart."""
        self._query, self._pause = query or "", pause
        self._write = write if query is not None else lambda query: None
        self._lock = threading.Lock()
        self._written = -math.inf
        self._waiting: threading.Timer | None = None
        self._unread: dict[str, list[str | None]] = {}
        """Names whose value could not be read, with what the page opened with instead, once that is known."""

    def __getitem__(self, name: str) -> str | None:
        return parameter(self._query, name)

    def read(
        self, name: str, meaning: Callable[[str], _Part], usual: _Part, title: str, problems: list[tuple[str, str]]
    ) -> _Part:
        """The meaning of a name's value; `usual` where there is none or a bad one. Problems are added under `title`.

        A bad value stays in the address until the page shows something else than it opened with: whoever wrote it can
        mend it there.
        """
        value = self[name]
        if value is None:
            return usual
        try:
            with refusing(f"What the address holds as {name!r}", "ask for a new link"):
                return meaning(value)
        except ValueError as error:
            problems.append((title, str(error)))
            self._unread[name] = []
            return usual

    def __setitem__(self, name: str, value: str | None) -> None:
        with self._lock:
            if (opened := self._unread.get(name)) is not None:
                if not opened:
                    opened.append(value)
                if opened == [value]:
                    return
                del self._unread[name]
            if value == parameter(self._query, name):
                return
            self._query = with_parameter(self._query, name, value)
            wait = self._pause - (time.monotonic() - self._written)
            if self._waiting is not None:
                return  # The waiting write will take the newest value.
            if wait > 0.0:
                self._waiting = threading.Timer(wait, self._put)
                self._waiting.daemon = True
                self._waiting.start()
                return
        self._put()

    @property
    def query(self) -> str:
        """As it is or is about to be written."""
        return self._query

    def write_over(self) -> None:
        """What could not be read need not stay any longer."""
        with self._lock:
            self._unread.clear()

    def stop(self) -> None:
        with self._lock:
            if self._waiting is not None:
                self._waiting.cancel()

    def _put(self) -> None:
        with self._lock:
            self._waiting, self._written = None, time.monotonic()
            self._write(self._query)
