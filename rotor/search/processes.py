"""Generators worked off here or in other processes, their items handed on one by one, stopped when told.

A task is a function at the top of a module, that takes its arguments and a `stop` to ask, and yields items.
"""

import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from contextlib import suppress
from multiprocessing import get_context
from multiprocessing.queues import Queue
from queue import Empty
from typing import Any, Protocol

Stop = Callable[[], bool]
Work = Callable[..., Iterator[Any]]
"""work(*arguments, stop) yields items; each is handed on once, and again at the end of the task from processes."""


def spread(
    tasks: Sequence[tuple[Work, tuple[Any, ...]]],
    take: Callable[[Any], None],
    stop: Stop | None,
    processes: int,
) -> bool:
    """Run the tasks; True when stopped before the end."""
    if processes <= 1:
        for work, arguments in tasks:
            for item in work(*arguments, stop):
                take(item)
            if stop is not None and stop():
                return True
        return False
    context = get_context("spawn")
    halt, news = context.Event(), context.Queue()
    stopped = False
    with ProcessPoolExecutor(processes, mp_context=context, initializer=_join, initargs=(halt, news)) as pool:
        waiting: set[Future[list[Any]]] = {pool.submit(_all, work, arguments) for work, arguments in tasks}
        try:
            while waiting:
                done, waiting = wait(waiting, timeout=0.1, return_when=FIRST_COMPLETED)
                with suppress(Empty):
                    while True:
                        take(news.get_nowait())
                for future in done:  # Whatever the queue still holds comes with the result as well.
                    for item in future.result():
                        take(item)
                if not stopped and stop is not None and stop():
                    stopped = True
                    halt.set()
                    waiting = {future for future in waiting if not future.cancel()}
        finally:
            halt.set()
    return stopped


class _Flag(Protocol):
    def is_set(self) -> bool: ...


_halt: _Flag | None = None
_news: "Queue[Any] | None" = None


def _join(halt: _Flag, news: "Queue[Any]") -> None:
    """What a new process is told: when to stop, where to send items. Ctrl-C is for the parent to understand."""
    global _halt, _news
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _halt, _news = halt, news


def _all(work: Work, arguments: tuple[Any, ...]) -> list[Any]:
    assert _halt is not None
    assert _news is not None
    made: list[Any] = []
    for item in work(*arguments, _halt.is_set):
        _news.put(item)
        made.append(item)
    return made
