"""Schedules the updates of all pages: a few at once, first come first served, frames before what can wait.

Of what can wait, and of a frame that takes long, only one is computed at a time: a turn stays free for frames.

All sessions share one process, and most of an update is Python, of which only one line runs at a time. Unscheduled,
twenty updates would all be half done, none would be drawn, and the thread that talks to the browsers would wait for
each of them. Scheduled, an update runs through, and no page gets its second before all others had their first.
"""

import os
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager

_FRAMES_IN_A_ROW = 4
"""Frames after which work that waits behind them has its turn: a crowd delays it but does not starve it."""
SLICE = 0.03
"""[s] of processor time that one step may take before it gives way in the middle: several times that of an ordinary
trim. If ordinary trims gave way too, all pages would be half done and none drawn."""


class FairScheduler:
    """Grants a number of turns at once, frames first."""

    def __init__(self, at_once: int) -> None:
        self._free = at_once
        self._lock = threading.Lock()
        self._frames: deque[threading.Event] = deque()
        self._behind: deque[threading.Event] = deque()
        self._in_a_row = 0
        self._waitable = False
        """Whether a turn is held by work that can wait."""

    @contextmanager
    def take(self) -> "Iterator[Turn]":
        """Wait for a turn, in the order of calls, and hold it to the end of the block."""
        self._ask(self._frames).wait()
        turn = Turn(self)
        try:
            yield turn
        finally:
            turn.leave()

    @property
    def waiting(self) -> int:
        """How many frames wait for their turn."""
        return len(self._frames)

    def behind(self, turn: "Turn", unwanted: Callable[[], bool]) -> bool:
        """Pass the turn, if held, to waiting frames and wait for one after them; False if it became unwanted."""
        mine = turn.waits_on = self._ask(self._behind)
        turn.leave()
        while not unwanted():
            mine.wait()
            with self._lock:
                if mine not in self._behind:
                    return True
                mine.clear()  # Under the lock, so that no grant is lost.
        with self._lock:
            if mine not in self._behind:
                return True
            self._behind.remove(mine)
        return False

    def _ask(self, queue: deque[threading.Event]) -> threading.Event:
        mine = threading.Event()
        with self._lock:
            queue.append(mine)
            if self._free:
                self._free -= 1
                self._grant()
        return mine

    def pass_on(self, waitable: bool) -> None:
        """A turn has ended, of work that could wait or of a frame: the next one begins."""
        with self._lock:
            if waitable:
                self._waitable = False
            self._grant()

    def _grant(self) -> None:
        """Give a turn to who is next, or keep it free."""
        behind = bool(self._behind) and not self._waitable
        if self._frames and not (behind and self._in_a_row >= _FRAMES_IN_A_ROW):
            self._in_a_row += 1
            self._frames.popleft().set()
        elif behind:
            self._in_a_row = 0
            self._waitable = True
            self._behind.popleft().set()
        else:
            self._free += 1


class Turn:
    """The right to compute."""

    def __init__(self, scheduler: FairScheduler) -> None:
        self._scheduler = scheduler
        self.held = True
        self._waitable = False
        self._since = time.thread_time()
        self.waits_on: threading.Event | None = None
        """Set by a grant, and by `look`."""

    def look(self) -> None:
        """Whether the work is still wanted may have changed: who waits in `give_way` asks again. From any thread."""
        if (waits_on := self.waits_on) is not None:
            waits_on.set()

    def leave(self) -> None:
        """Pass the turn on, if held; `give_way` waits for another."""
        if self.held:
            self.held = False
            self._scheduler.pass_on(self._waitable)

    def give_way(self, unwanted: Callable[[], bool]) -> bool:
        """Let waiting frames go first; called between two steps of work that can wait.

        `unwanted` is asked at once and after each `look`. False when the work became unwanted meanwhile: the turn is
        then gone, and a further call waits for another.
        """
        if not self.held or self._scheduler.waiting or (self.long and not self._waitable):
            self.held = self._waitable = self._scheduler.behind(self, unwanted)
            self._since = time.thread_time()
        return self.held

    @property
    def long(self) -> bool:
        """Whether its thread has computed for more than a slice of time, or it is not held."""
        return not self.held or time.thread_time() - self._since > SLICE


SCHEDULER = FairScheduler(min(os.cpu_count() or 1, 2))
"""Of this process."""
