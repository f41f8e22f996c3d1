"""What worker processes do for a part of a page: work that a button begins, and answers that the page asks for.

A search, a map and a schedule are begun by a button. Verdicts, flights, the dial, what would pay and
the numbers of the lecture are asked for as the design changes.
"""

import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Hashable
from functools import partial
from typing import Any

from explorer.workers.call import Call
from rotor.support.processes import Job, JobEnded, JobEvent, JobFailed, JobProgress, Processes
from rotor.support.worker_process import Task

FRAME = 0.1
"""Between two progress reports that wake the page [s]; the end always does."""


class BackgroundWork:
    """Begins, stops and hears of one task; a part of the page says which, and shows it in its own `refresh`."""

    def __init__(
        self, pool: Processes, wake: Callable[[], None], limit: float, urgency: int = 0, *, restarts: bool = False
    ) -> None:
        """`wake`: the page follows. `limit`: of its time [s]. `urgency`: as in `Processes.begin`. `restarts`: a second
        begin ends the first."""
        self._pool, self._wake = pool, wake
        self._limit, self._urgency, self._restarts = limit, urgency, restarts
        self._beginning = threading.Lock()
        self._job: Job | None = None
        self._woken = 0.0
        self.running = False
        self.line = ""
        """What is said of it: that it waits, runs, is done, or why there is none."""

    def prepare(self) -> tuple[Task, Callable[[JobEvent], None], str]:
        """The task, what hears of it on a thread of the pool, and what is said at first.

        ValueError with one sentence where there is no task.
        """
        raise NotImplementedError

    def begin(self) -> None:
        """Begin, unless it is under way already and does not restart."""
        with self._beginning:  # Two quick presses come on two threads.
            if self.running and not self._restarts:
                return
            try:
                task, hear, line = self.prepare()
            except ValueError as error:
                self.line = str(error)
            else:
                self._silence()
                self.line = line
                self._submit(task, hear)
        self._wake()

    def _submit(self, task: Task, hear: Callable[[JobEvent], None]) -> None:
        self.running = True
        self._job = self._pool.begin(
            task, lambda news: self._heard(hear, news), limit=self._limit, urgency=self._urgency
        )

    def halt(self) -> None:
        """Stop what is under way, and keep what it found."""
        if self._job is not None and self.running:
            self._pool.stop(self._job)
            self._wake()

    def stop(self) -> None:
        """The browser has left."""
        self._silence()

    def _silence(self) -> None:
        """No further word of the last one."""
        if self._job is not None:
            self._pool.stop(self._job, quiet=True)

    def _heard(self, hear: Callable[[JobEvent], None], news: JobEvent) -> None:
        if isinstance(news, (JobEnded, JobFailed)):
            self.running = False
        hear(news)
        now = time.monotonic()
        if not isinstance(news, JobProgress) or now - self._woken > FRAME:
            self._woken = now
            self._wake()


_KEPT = 64
_LIMIT = 600.0
"""[s] for each task, by the clock: it needs seconds of a processor, of which a busy machine gives a worker little."""
_LATE = "No answer after 10 minutes; the machine may be busy. Trying again."
_lock = threading.Lock()
_known: OrderedDict[Call, Any] = OrderedDict()


def all_known() -> dict[Hashable, Any]:
    """Every answer there is, of all pages."""
    with _lock:
        return {**_known}


class PoolAnswers(BackgroundWork):
    """Has the newest tasks answered, one at a time. A task under way runs to its end.

    One that is ended after its time is begun again once the others are answered.
    """

    def __init__(self, pool: Processes, urgency: int, answered: Callable[[], None]) -> None:
        """`answered` is called after every answer, on a thread of the pool."""
        super().__init__(pool, answered, _LIMIT, urgency)
        self._tasks: tuple[Call, ...] = ()
        self._failures: dict[Call, str] = {}
        self._stopped = False
        self._timer: threading.Timer | None = None
        self._lock = threading.RLock()

    def ask(self, tasks: tuple[Call, ...], delay: float) -> None:
        """Have these answered, the first one first, after so long [s]; what was asked before no longer."""
        with self._lock:
            changed = tasks != self._tasks
            if changed:
                self._failures.clear()
            self._tasks = tasks
            if self._next() is not None and (changed or self._timer is not None):
                self._stop_timer()
                self._timer = threading.Timer(delay, self._next_one)
                self._timer.daemon = True
                self._timer.start()

    def answer(self, task: Call | None) -> Any:
        """What is known, or the sentence that says why there is no answer; None while it is being worked on."""
        with _lock:
            return None if task is None else _known.get(task, self._failures.get(task))

    @property
    def failures(self) -> dict[Hashable, str]:
        """Why there is no answer, by what is asked now."""
        with self._lock:
            return {**self._failures}

    def stop(self) -> None:
        """The browser has left."""
        with self._lock:
            self._stopped = True
            self._stop_timer()
        super().stop()

    def _stop_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
        self._timer = None

    def _next(self) -> Call | None:
        return next((task for said in (None, _LATE) for task in self._tasks if self.answer(task) is said), None)

    def _next_one(self) -> None:
        with self._lock:
            self._timer = None
            task = self._next()
            if not (self.running or self._stopped or task is None):
                self._submit(task, partial(self._keep, task))

    def _heard(self, hear: Callable[[JobEvent], None], news: JobEvent) -> None:
        if isinstance(news, (JobEnded, JobFailed)):
            super()._heard(hear, news)

    def _keep(self, task: Call, news: JobEvent) -> None:
        match news:
            case JobEnded(result) if result is not None:
                with _lock:
                    _known[task] = result
                    while len(_known) > _KEPT:
                        _known.popitem(last=False)
            case JobFailed(message):
                self._failures[task] = message
            case JobEnded(late=True):
                self._failures[task] = _LATE
            case _:  # The server ends.
                pass
        with self._lock:
            if self._timer is None:
                self._next_one()
