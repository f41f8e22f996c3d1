"""A job of the worker processes, and the news of it that a page hears."""

import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from explorer.workers.process import Task


@dataclass(frozen=True)
class JobQueued:
    """In the queue, behind so many others that wait."""

    ahead: int


@dataclass(frozen=True)
class JobStarted:
    """A process has it."""


@dataclass(frozen=True)
class JobProgress:
    """Something found on the way."""

    item: Any


@dataclass(frozen=True)
class JobEnded:
    """The end: the task's result, or None where it was stopped before it had one."""

    result: Any
    stopped: bool = False
    late: bool = False
    """Stopped by the time limit."""


@dataclass(frozen=True)
class JobFailed:
    """The end without a result, with a sentence for the page."""

    message: str


JobEvent = JobQueued | JobStarted | JobProgress | JobEnded | JobFailed


class Job:
    """One task on its way through the pool; `owner` is the page it is for, None where pages do not matter."""

    def __init__(
        self,
        number: int,
        task: Task,
        on_event: Callable[[JobEvent], None],
        limit: float,
        urgency: int,
        owner: object = None,
    ) -> None:
        self.number, self.task, self.limit, self.urgency, self.owner = number, task, limit, urgency, owner
        self.stopping = threading.Event()
        self._on_event = on_event
        self._lock = threading.Lock()
        self._over = False

    @property
    def over(self) -> bool:
        return self._over

    def tell(self, news: JobEvent) -> None:
        """Pass news on; nothing follows the end."""
        with self._lock:
            if self._over:
                return
            self._over = isinstance(news, (JobEnded, JobFailed))
            self._on_event(news)

    def silence(self) -> None:
        """Nobody listens any more."""
        with self._lock:
            self._over = True
