"""Updates of the pages on a few threads: the newest state of each page wins, frames come before what can wait.

All sessions share one process, and most of an update is Python, of which only one line runs at a time. On a thread for
each page twenty updates would all be half done, and none would be drawn. Here an update runs through to its frame, and
no page gets its second before all others had their first.
"""

import contextlib
import heapq
import itertools
import math
import os
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from typing import Literal

Update = Callable[[], Iterator[float] | None]
"""Draws a frame and returns what can wait, as steps. Each step yields how long to wait for a newer update before the
next [s], or `GIVE_WAY`. None: what waited before goes on."""
GIVE_WAY = -1.0
"""The next step comes once those of no other page are due; of pages that give way, the first to do so goes on first."""

_FRAMES_IN_A_ROW = 20
"""Frames after which a step of what can wait has its turn, in a crowd. A step is charts of some three frames' time."""
_SLOW_FRAME_S = 0.15
"""[s] of processor time that a frame takes which does not converge, or with a costly model."""
_OWED_S = 0.1
"""[s] between two looks whether an answer is owed: that it is not any more is no change of the pool."""
_IDLE_S = 10.0
"""[s] after which a thread without work ends."""


class UpdatePool:
    """Threads shared by many pages; of what can wait only one step runs at a time, so that frames find a thread."""

    def __init__(self, threads: int) -> None:
        self.change = threading.Condition()
        self._most, self._threads = threads, 0
        self._frames: deque[NewestWins] = deque()
        self._steps: list[tuple[float, int, NewestWins]] = []
        """What can wait: a heap by the time it is due and a number."""
        self._giving_way: list[tuple[float, int, NewestWins]] = []
        """A heap by the number with which it first gave way, and a number."""
        self._numbers = itertools.count(1)
        self._frames_in_a_row = 0
        self._step_runs = False

    @property
    def waiting(self) -> int:
        """How many frames wait for a thread."""
        return len(self._frames)

    @property
    def busy(self) -> bool:
        """Whether what can wait of a page would wait for others now."""
        return bool(self._frames or self._steps or self._giving_way or self._step_runs)

    @property
    def crowded(self) -> bool:
        """Whether anything waits for the step that runs."""
        with self.change:
            return bool(self._frames or self._giving_way) or self._due() <= 0.0

    def _due(self) -> float:
        """How long until a step is due [s]."""
        return self._steps[0][0] - time.monotonic() if self._steps else math.inf

    def queue(self, worker: "NewestWins", due: float | None, first: int | None = None) -> int:
        """Put a worker in line, for a frame or for a step at `due` [s]; the caller holds `change`. Returns a ticket.

        `first`: the ticket with which it first gave way; 0 for this one.
        """
        number = next(self._numbers)
        if first is not None:
            heapq.heappush(self._giving_way, (first or number, number, worker))
        elif due is None:
            self._frames.append(worker)
        else:
            heapq.heappush(self._steps, (due, number, worker))
        if self._threads < self._most:
            self._threads += 1
            threading.Thread(target=self._run, name="update", daemon=True).start()
        self.change.notify_all()  # The thread that waits for an answer is a listener, too.
        return number

    def _run(self) -> None:
        while (following := self._next()) is not None:
            worker, is_step = following
            worker.run()
            with self.change:
                if is_step:
                    self._step_runs = False
                worker.requeue()
                self.change.notify_all()

    def _next(self) -> "tuple[NewestWins, bool] | None":
        """The next worker and whether it is for a step; None when there is no work."""
        with self.change:
            while True:
                for heap in (self._steps, self._giving_way):
                    while heap and not heap[0][2].waits(heap[0][1]):
                        heapq.heappop(heap)
                due = self._due()
                wait = _IDLE_S if self._step_runs else 0.0 if self._giving_way else due
                if self._frames and not (wait <= 0.0 and self._frames_in_a_row >= _FRAMES_IN_A_ROW):
                    worker, is_step = self._frames.popleft(), False
                    self._frames_in_a_row += 1
                elif wait <= 0.0:
                    worker, is_step = (
                        heapq.heappop(self._steps if due <= 0.0 else self._giving_way)[2],
                        True,
                    )
                    self._frames_in_a_row, self._step_runs = 0, True
                else:
                    woken = self.change.wait(min(wait, _IDLE_S))
                    if not (woken or self._frames or self._steps or self._giving_way):
                        self._threads -= 1
                        return None
                    continue
                if worker.begin():
                    return worker, is_step
                self._step_runs = self._step_runs and not is_step


UPDATES = UpdatePool(min(os.cpu_count() or 1, 2))


class NewestWins:
    """Runs `update` once after every `wake`; one further run answers all wakes that come while it runs."""

    def __init__(
        self,
        update: Update,
        on_error: Callable[[Exception], None],
        pool: UpdatePool = UPDATES,
        held: bool = False,
    ) -> None:
        """held: as after `hold`."""
        self._update, self._on_error, self._pool = update, on_error, pool
        self._wanted = threading.Event()
        self.woken = -math.inf
        """When the change came that the latest update is for, or the one that waits, `time.monotonic` [s]."""
        self._stopped = False
        self._held = held
        self._state: Literal["idle", "frame", "step", "running"] = "idle"
        self._ticket = self._thread = self._gave_way = 0
        self._steps: Iterator[float] | None = None
        self._answered = False
        """Whether what the last update was for is shown."""
        self._pause = 0.0
        """[s] before the next step."""
        self._took = 0.0, 0.0
        """[s] of processor time that each of the last two frames took. A page's first is always slow."""

    def wake(self) -> None:
        """Something changed: an update that starts after this call will see it."""
        if self._wanted.is_set():  # Setting it again takes as long as the rest of an edit.
            return
        with self._pool.change:
            self.woken = time.monotonic()
            self._wanted.set()
            if self._state in ("idle", "step") and not self._stopped and not self._held:
                self._line_up_for_frame()

    def hold(self) -> None:
        """No update and no step begins before `release`; the one that runs goes on."""
        with self._pool.change:
            self._held = True

    def release(self) -> None:
        """Updates may begin; one does where something changed before, and what it left goes on."""
        with self._pool.change:
            self._held = False
            if self._state in ("idle", "step"):  # Its ticket may be gone.
                self.requeue()

    def stop(self, timeout: float = 2.0) -> None:
        """No update and no step begins after this; waits for the one that runs."""
        with self._pool.change:
            self._stopped = True
            self._wanted.set()
            self._pool.change.notify_all()  # Nobody waits for an answer any longer.
            if self._thread != threading.get_ident():
                self._pool.change.wait_for(lambda: self._state != "running", timeout)

    @property
    def superseded(self) -> bool:
        """Whether a newer update is wanted, or none any more."""
        return self._stopped or self._wanted.is_set()

    def wait(self, seconds: float) -> None:
        """Within an update of a pool of one's own: wait until a newer one is wanted, at most so long."""
        self._wanted.wait(seconds)

    def answer(self) -> None:
        """Within a step: what the update was for is shown, and the rest of it can wait."""
        with self._pool.change:
            self._answered = True
            self._pool.change.notify_all()

    def until_answered(self, wholly: bool, waiting: Callable[[], bool] = lambda: False) -> None:
        """Wait until all wakes that came before this call are answered, `wholly` also until nothing is left to do; or
        until the page has gone.

        `waiting`: whether an answer will still wake it. While `change` is held none can, so neither it nor its wake is
        missed.
        """

        def answered() -> bool:
            if self._stopped or self._wanted.is_set():
                return self._stopped
            at_rest = self._state == "idle" and self._steps is None
            return (at_rest and not waiting()) if wholly else (at_rest or self._answered)

        with self._pool.change:
            while not self._pool.change.wait_for(answered, _OWED_S):
                pass

    def waits(self, ticket: int) -> bool:
        """Whether the step of this ticket is still to be done."""
        return (
            self._state == "step"
            and self._ticket == ticket
            and not self._stopped
            and not self._held
        )

    def begin(self) -> bool:
        """A thread takes it; False when it is held or has stopped. The caller holds the pool's `change`."""
        begins = not self._stopped and not self._held
        self._state, self._thread = "running" if begins else "idle", threading.get_ident()
        return begins

    def run(self) -> None:
        """Run one update, or one step of deferred work."""
        try:
            if self._wanted.is_set():
                # Cleared before the update reads anything, so that a change during the update wakes it again.
                answered, self._answered = self._answered, False
                self._wanted.clear()
                begun = time.thread_time()
                self._pause, steps = 0.0, self._update()
                self._took = self._took[1], time.thread_time() - begun
                if steps is None:
                    self._answered = answered
                else:
                    self._steps, self._gave_way = steps, 0
            elif self._steps is not None:
                pause = next(self._steps, None)
                self._pause, self._steps = pause or 0.0, None if pause is None else self._steps
        except Exception as error:  # The session must survive whatever one update does.
            self._steps = None
            if not self._stopped:
                with contextlib.suppress(Exception):  # The browser may have gone.
                    self._on_error(error)

    def requeue(self) -> None:
        """After a run: in line again where there is more to do. The caller holds the pool's `change`."""
        self._state, self._thread = "idle", 0
        if self._stopped:
            self._steps = None
        elif self._held:
            pass
        elif self._wanted.is_set():
            self._line_up_for_frame()
        elif self._steps is not None and self._pause == GIVE_WAY:
            self._state, self._ticket = "step", self._pool.queue(self, None, self._gave_way)
            self._gave_way = self._gave_way or self._ticket
        elif self._steps is not None:
            self._state, self._ticket = (
                "step",
                self._pool.queue(self, time.monotonic() + self._pause),
            )

    def _line_up_for_frame(self) -> None:
        """Frames of a page whose trims take long are steps: only one of these is computed at a time."""
        slow = min(self._took) > _SLOW_FRAME_S
        self._state = "step" if slow else "frame"
        self._ticket = self._pool.queue(self, time.monotonic() if slow else None)
