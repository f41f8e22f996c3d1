"""Answers of the worker processes to what the Actuate mode asks; one that is known serves every page."""

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Any, Protocol

from explorer.workers.job import Job, JobEnded, JobEvent, JobFailed
from explorer.workers.pool import PoolClient

_KEPT = 64
_STOPPED = "This was stopped: change any setting to try again."
_lock = threading.Lock()
_known: OrderedDict[Hashable, Any] = OrderedDict()


class PoolTask(Hashable, Protocol):
    """A task of the pool that can be told from others."""

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> Any: ...


class PoolAnswers:
    """Has the newest tasks answered, one at a time. A task under way runs to its end: it takes a second at most."""

    def __init__(self, pool: PoolClient, urgency: int, answered: Callable[[], None]) -> None:
        """`answered` is called after every answer, on a thread of the pool."""
        self._pool, self._urgency, self._answered = pool, urgency, answered
        self._tasks: tuple[PoolTask, ...] = ()
        self._delay = 0.0
        self._failures: dict[PoolTask, str] = {}
        self._job: Job | None = None
        self._running = self._stopped = False
        self._timer: threading.Timer | None = None
        self._lock = threading.RLock()

    def ask(self, tasks: tuple[PoolTask, ...], delay: float, moved: bool = True) -> None:
        """Have these answered, the first one first, once nothing has `moved` for so long [s]."""
        with self._lock:
            changed = tasks != self._tasks or delay < self._delay
            if tasks != self._tasks:
                self._failures.clear()
            self._tasks, self._delay = tasks, delay
            waits = self._timer is not None
            if self._next() is not None and (changed or (moved and waits)):
                self._stop_timer()
                self._timer = threading.Timer(delay, self._begin)
                self._timer.daemon = True
                self._timer.start()

    def answer(self, task: PoolTask | None) -> Any:
        """What is known, or the sentence that says why there is no answer; None while it is being worked on."""
        with _lock:
            return _known.get(task, None if task is None else self._failures.get(task))

    def stop(self) -> None:
        """The browser has left."""
        with self._lock:
            self._stopped = True
            self._stop_timer()
            if self._job is not None:
                self._pool.stop(self._job, quiet=True)

    def _stop_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
        self._timer = None

    def _next(self) -> PoolTask | None:
        return next((task for task in self._tasks if self.answer(task) is None), None)

    def _begin(self) -> None:
        with self._lock:
            self._timer = None
            task = self._next()
            if self._running or self._stopped or task is None:
                return
            self._running = True
            self._job = self._pool.submit(task, lambda news: self._on_event(task, news), urgency=self._urgency)

    def _on_event(self, task: PoolTask, news: JobEvent) -> None:
        match news:
            case JobEnded(result) if result is not None:
                with _lock:
                    _known[task] = result
                    while len(_known) > _KEPT:
                        _known.popitem(last=False)
            case JobEnded():
                self._failures[task] = _STOPPED
            case JobFailed(message):
                self._failures[task] = message
            case _:
                return
        with self._lock:
            self._running = False
            if self._timer is None:
                self._begin()
        self._answered()
