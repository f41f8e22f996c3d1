"""One page presents, others follow: what the presenters of a server show, and who looks. Any thread may call."""

import hashlib
import logging
import secrets
import threading
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from explorer.state import Inputs, ViewState

_log = logging.getLogger(__name__)

PRESENT, FOLLOW = "present", "follow"
"""Names in the page's address: the presenter's own secret, and what the others are given."""

Point = tuple[float, float, float]
"""[m]"""


@dataclass(frozen=True)
class PresentedView:
    """What a presenter shows."""

    inputs: Inputs
    view: ViewState
    against: Inputs | None = None
    """A of A/B."""
    step: int | None = None
    """Of the lecture."""
    camera: tuple[Point, Point] | None = None
    """Position and the point looked at [m]."""


Listener = Callable[[PresentedView | None], None]
"""Hears what is shown; None: the presenter has gone."""


def new_secret() -> str:
    return secrets.token_urlsafe(12)


def follow_name(secret: str) -> str:
    """What followers are given; it does not tell the secret."""
    return hashlib.sha256(secret.encode()).hexdigest()[:12]


class Presentations:
    """The presentations of one server."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._shown: dict[str, PresentedView] = {}
        self._listeners: dict[str, dict[int, Listener]] = {}
        self._watchers: dict[str, Callable[[int], None]] = {}
        self._next = 0

    def watch(self, secret: str, watcher: Callable[[int], None]) -> None:
        """Tell a presenter how many follow, now and whenever that changes."""
        with self._lock:
            self._watchers[follow_name(secret)] = watcher
        self._count(follow_name(secret))

    def present(self, secret: str, shown: PresentedView) -> None:
        """Show this to everyone who follows."""
        name = follow_name(secret)
        with self._lock:
            if self._shown.get(name) == shown:
                return
            self._shown[name] = shown
            listeners = tuple(self._listeners.get(name, {}).values())
        _tell(listeners, shown)

    def end(self, secret: str) -> None:
        """The presenter has stopped; who follows keeps what was shown last."""
        name = follow_name(secret)
        with self._lock:
            self._shown.pop(name, None)
            self._watchers.pop(name, None)
            listeners = tuple(self._listeners.get(name, {}).values())
        _tell(listeners, None)

    def follow(self, name: str, listener: Listener) -> Callable[[], None]:
        """Hear what is shown, from now on; the answer ends it. A presenter who has not come yet is waited for."""
        with self._lock:
            number, self._next = self._next, self._next + 1
            self._listeners.setdefault(name, {})[number] = listener
        told = None
        while (shown := self._shown.get(name)) is not None and shown is not told:  # It may change meanwhile.
            told = shown
            listener(shown)
        self._count(name)

        def leave() -> None:
            with self._lock:
                others = self._listeners.get(name, {})
                others.pop(number, None)
                if not others:
                    self._listeners.pop(name, None)
            self._count(name)

        return leave

    def _count(self, name: str) -> None:
        with self._lock:
            watcher, count = self._watchers.get(name), len(self._listeners.get(name, {}))
        if watcher is not None:
            watcher(count)


def _tell(listeners: Iterable[Listener], shown: PresentedView | None) -> None:
    """One page that cannot follow, because its browser is just leaving, must not keep it from the others."""
    for listener in listeners:
        try:
            listener(shown)
        except Exception:
            _log.exception("a follower did not hear")
