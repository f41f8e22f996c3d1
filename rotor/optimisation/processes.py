"""Generator tasks run here or in other processes; items are passed on one by one, and tasks can be stopped.

A task is a module-level function that takes its arguments and a `stop` callable, and yields items.
"""

import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from multiprocessing import get_context
from multiprocessing.queues import Queue
from multiprocessing.synchronize import Event
from queue import Empty
from typing import Any

from rotor.blas_threads import keep_one_blas_thread

Stop = Callable[[], bool]
Work = Callable[..., Iterator[Any]]
"""work(*arguments, stop) yields items; each is delivered at once, and from processes again at the end of the task."""


class WorkerLost(RuntimeError):
    """A process ended unexpectedly; items delivered before are kept."""


class Workers:
    """Runs tasks here, or in processes that are started once. A context manager."""

    def __init__(self, processes: int, deliver: Callable[[Any], None], stop: Stop | None) -> None:
        self._deliver, self._stop = deliver, stop
        context = get_context("spawn")
        self._stop_event, self._items = context.Event(), context.Queue()
        self._pool = (
            ProcessPoolExecutor(processes, context, initializer=_join, initargs=(self._stop_event, self._items))
            if processes > 1
            else None
        )

    def __enter__(self) -> "Workers":
        return self

    def __exit__(self, *error: object) -> None:
        self._stop_event.set()
        if self._pool is not None:
            self._pool.shutdown(cancel_futures=True)

    def run(self, tasks: Sequence[tuple[Work, tuple[Any, ...]]]) -> bool:
        """Run the tasks; True when stopped before the end."""
        if self._pool is None:
            for work, arguments in tasks:
                for item in work(*arguments, self._stop):
                    self._deliver(item)
                if self._asked():
                    return True
            return False
        try:
            return self._wait({self._pool.submit(_all, work, arguments) for work, arguments in tasks})
        except BrokenProcessPool:
            self._empty_queue()
            raise WorkerLost(
                "A worker process was lost, perhaps for lack of memory; results so far are kept: use fewer processes."
            ) from None

    def _wait(self, waiting: set[Future[list[Any]]]) -> bool:
        stopped = False
        while waiting:
            done, waiting = wait(waiting, timeout=0.1, return_when=FIRST_COMPLETED)
            self._empty_queue()
            for future in done:  # Items still in the queue are part of the result as well.
                for item in future.result():
                    self._deliver(item)
            if not stopped and self._asked():
                stopped = True
                self._stop_event.set()
                waiting = {future for future in waiting if not future.cancel()}
        return stopped

    def _empty_queue(self) -> None:
        with suppress(Empty):
            while True:
                self._deliver(self._items.get_nowait())

    def _asked(self) -> bool:
        return self._stop is not None and self._stop()


_stop_event: Event | None = None
_items: "Queue[Any] | None" = None


def _join(stop_event: Event, items: "Queue[Any]") -> None:
    """Initialise a new process: stop event, queue for items, Ctrl-C left to the parent."""
    global _stop_event, _items
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _stop_event, _items = stop_event, items
    keep_one_blas_thread()


def _all(work: Work, arguments: tuple[Any, ...]) -> list[Any]:
    assert _stop_event is not None
    assert _items is not None
    made: list[Any] = []
    for item in work(*arguments, _stop_event.is_set):
        _items.put(item)
        made.append(item)
    return made
