"""Presentations: one page presents, others follow. Safe from any thread."""

import hashlib
import logging
import secrets
import threading
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

from explorer.model.session_state import ScreenState
from explorer.sharing.game import Game

_log = logging.getLogger(__name__)

PRESENT, FOLLOW = "present", "follow"
"""The presenter's secret among the texts that its page keeps, and the name of followers in their address.

The secret never stands in an address, because addresses are shared."""

Point = tuple[float, float, float]
"""[m]"""


@dataclass(frozen=True)
class StoryPlace:
    step: int
    guess: int | None = None
    """The answer that was chosen; None before."""
    stop: int = 0
    """Position of the step's control."""
    wipe: float = 0.5
    """Where the handle between A and B is, from left to right (0…1)."""


@dataclass(frozen=True)
class PresentedView:
    """What a presenter shows; `place`: in the lecture. `camera`: position and the point looked at [m]."""

    screen: ScreenState
    place: StoryPlace | None = None
    game: Game | None = None
    """What followers play meanwhile, each with sliders of their own."""
    camera: tuple[Point, Point] | None = None


Watcher = Callable[[int, Sequence[float]], None]
"""Called with how many follow, and with the least power of each who plays [W]."""
Listener = Callable[[PresentedView | Literal["away", "over"]], None]
"""Called with what is shown, or that the presenter's page is closed, or that the presentation has ended."""


def new_secret() -> str:
    return secrets.token_urlsafe(12)


def follow_name(secret: str) -> str:
    """The name for followers, from which the secret cannot be found."""
    return hashlib.sha256(secret.encode()).hexdigest()[:12]


class Presentations:
    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._shown: dict[str, PresentedView] = {}
        self._listeners: dict[str, dict[int, Listener]] = {}
        self._watchers: dict[str, Watcher] = {}
        self._results: dict[str, tuple[Game | None, dict[object, float]]] = {}
        """The game, and what each player has reached [W]."""
        self._presenters: dict[str, tuple[str, object]] = {}
        """Page and session that present, by name."""
        self._next = 0

    def claim(self, secret: str, page: str, session: object) -> bool:
        """Whether this session may present: no other page does, or it is the same one, connected again.

        A tab that the browser duplicates has the same secret as the first; `page` tells them apart, and is "" where
        the browser did not say.
        """
        name = follow_name(secret)
        with self._lock:
            if name in self._presenters and (not page or self._presenters[name][0] != page):
                return False
            self._presenters[name] = page, session
            return True

    def release(self, session: object) -> None:
        """This session has ended: another page with the secret may present."""
        listeners = list[Listener]()
        with self._lock:
            for name, (_, presenter) in tuple(self._presenters.items()):
                if presenter is session:
                    del self._presenters[name]
                    self._watchers.pop(name, None)  # It belongs to the session's page.
                    self._shown.pop(name, None)
                    listeners += self._listeners.get(name, {}).values()
        _tell(listeners, "away")

    def watch(self, secret: str, watcher: Watcher) -> None:
        """Tell a presenter how many follow and what they reach, now and whenever that changes."""
        with self._lock:
            self._watchers[follow_name(secret)] = watcher
        self._count(follow_name(secret))

    def present(self, secret: str, shown: PresentedView) -> None:
        """Show this to everyone who follows."""
        name = follow_name(secret)
        with self._lock:
            if self._shown.get(name) == shown:
                return
            begun = self._results.get(name, (None,))[0] != shown.game
            if begun:
                self._results[name] = shown.game, {}
            self._shown[name] = shown
            listeners = tuple(self._listeners.get(name, {}).values())
        _tell(listeners, shown)
        if begun:
            self._count(name)

    def report(self, name: str, player: object, power: float) -> None:
        """The least power that a follower has reached in the present game [W]."""
        with self._lock:
            _, results = self._results.get(name, (None, {}))
            if results.get(player) == power:
                return
            results[player] = power
        self._count(name)

    def end(self, secret: str) -> None:
        """The presenter has stopped; followers keep what was shown last."""
        name = follow_name(secret)
        with self._lock:
            self._shown.pop(name, None)
            self._results.pop(name, None)
            self._watchers.pop(name, None)
            listeners = tuple(self._listeners.get(name, {}).values())
        _tell(listeners, "over")

    def follow(self, name: str, listener: Listener) -> Callable[[], None]:
        """Call `listener` with what is shown from now on, also by a presenter who comes later; returns how to stop."""
        with self._lock:
            number, self._next = self._next, self._next + 1
            self._listeners.setdefault(name, {})[number] = listener
            away = name not in self._presenters
        if away:
            listener("away")
        sent = None
        # The state may change during the send.
        while (shown := self._shown.get(name)) is not None and shown is not sent:
            sent = shown
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
            results = tuple(self._results.get(name, (None, {}))[1].values())
        if watcher is not None:
            watcher(count, results)


def _tell(listeners: Iterable[Listener], shown: PresentedView | Literal["away", "over"]) -> None:
    """Call all listeners; one that fails, because its browser is leaving, does not affect the others."""
    for listener in listeners:
        try:
            listener(shown)
        except Exception:
            _log.exception("a follower could not be updated")
