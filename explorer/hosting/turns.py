"""Whose turn it is to compute: a few rounds at once, first come first served, and frames before what can wait.

All sessions share one process, and most of a round is Python, of which only one line runs at a time. Without turns
twenty rounds would all be half done, none would be drawn, and the thread that talks to the browsers would wait for
each of them in turn. With turns a round runs through, and nobody gets a second before all others had their first.
"""

import os
import threading
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager

_LOOK = 0.02
"""[s] between looks, by one that waits behind frames, at whether it is still wanted."""
_SHARE = 4
"""Frames in a row after which one that waits behind them has its turn: a crowd delays, it does not starve."""


class Turns:
    """A fair gate for so many at once."""

    def __init__(self, at_once: int) -> None:
        self._free = at_once
        self._lock = threading.Lock()
        self._frames: deque[threading.Event] = deque()
        self._behind: deque[threading.Event] = deque()
        self._in_a_row = 0

    @contextmanager
    def take(self) -> "Iterator[Turn]":
        """Wait for a turn, in the order of asking, and hold it; at the end it goes to who waits longest."""
        turn = Turn(self)
        self._wait(self._ask(self._frames), lambda: False)
        try:
            yield turn
        finally:
            if turn.held:
                self._pass_on()

    @property
    def waiting(self) -> int:
        """How many frames wait for their turn."""
        return len(self._frames)

    def behind(self, held: bool, unwanted: Callable[[], bool]) -> bool:
        """Give the turn, if it is held, to frames that wait, and wait for one behind them all; False if none came."""
        mine = self._ask(self._behind)
        if held:
            self._pass_on()
        return self._wait(mine, unwanted)

    def _ask(self, queue: deque[threading.Event]) -> threading.Event:
        mine = threading.Event()
        with self._lock:
            if self._free:
                self._free -= 1
                mine.set()
            else:
                queue.append(mine)
        return mine

    def _wait(self, mine: threading.Event, unwanted: Callable[[], bool]) -> bool:
        while not mine.wait(None if mine.is_set() else _LOOK):
            if not unwanted():
                continue
            with self._lock:
                if mine.is_set():
                    return True
                self._behind.remove(mine)
            return False
        return True

    def _pass_on(self) -> None:
        with self._lock:
            if self._frames and not (self._behind and self._in_a_row >= _SHARE):
                self._in_a_row += 1
                self._frames.popleft().set()
            elif self._behind:
                self._in_a_row = 0
                self._behind.popleft().set()
            else:
                self._free += 1


class Turn:
    """One that is held."""

    def __init__(self, turns: Turns) -> None:
        self._turns = turns
        self.held = True

    def give_way(self, unwanted: Callable[[], bool]) -> bool:
        """Between two steps of work that can wait: let all frames by that wait, unless there are none.

        False, and the turn is gone, when the work became unwanted meanwhile; asking again waits for another.
        """
        if not self.held or self._turns.waiting:
            self.held = self._turns.behind(self.held, unwanted)
        return self.held


TURNS = Turns(min(os.cpu_count() or 1, 2))
"""Those of this process."""
