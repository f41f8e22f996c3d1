"""A job of the worker processes, and the news of it that a page hears."""

import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from explorer.workers.process import Task


@dataclass(frozen=True)
class Waiting:
    """In the queue, behind so many others that wait."""

    ahead: int


@dataclass(frozen=True)
class Started:
    """A process has it."""


@dataclass(frozen=True)
class Told:
    """Something found on the way."""

    item: Any


@dataclass(frozen=True)
class Ended:
    """The end: the task's result, or None where it was stopped before it had one."""

    result: Any
    stopped: bool = False
    late: bool = False
    """Stopped by the time limit."""


@dataclass(frozen=True)
class Broken:
    """The end without a result, with a sentence for the page."""

    message: str


News = Waiting | Started | Told | Ended | Broken


class Job:
    """One task on its way through the pool; `owner` is the page it is for, None where pages do not matter."""

    def __init__(
        self,
        number: int,
        task: Task,
        hear: Callable[[News], None],
        limit: float,
        urgency: int,
        owner: object = None,
    ) -> None:
        self.number, self.task, self.limit, self.urgency, self.owner = number, task, limit, urgency, owner
        self.stopping = threading.Event()
        self._hear = hear
        self._lock = threading.Lock()
        self._over = False

    @property
    def over(self) -> bool:
        return self._over

    def tell(self, news: News) -> None:
        """Pass news on; nothing follows the end."""
        with self._lock:
            if self._over:
                return
            self._over = isinstance(news, (Ended, Broken))
            self._hear(news)

    def silence(self) -> None:
        """Nobody listens any more."""
        with self._lock:
            self._over = True
