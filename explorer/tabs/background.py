"""What a button begins and a worker process does: a search, a map, a schedule. Each part of a page runs one."""

import threading
import time
from collections.abc import Callable

from explorer.tabs.context import TabContext
from explorer.workers.pool import Job, JobEnded, JobEvent, JobFailed, JobProgress, Task

FRAME = 0.1
"""Between two progress reports that wake the page [s]; the end always does."""


class BackgroundWork:
    """Begins, stops and hears of one task; a part of the page says which, and shows it in its own `refresh`."""

    def __init__(self, context: TabContext, limit: float, urgency: int = 0, *, restarts: bool = False) -> None:
        """`limit`: of its time [s]. `urgency` as in `Pool.submit`. `restarts`: a second begin ends the first."""
        self._context, self._limit, self._urgency, self._restarts = context, limit, urgency, restarts
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
                self.running, self.line = True, line
                self._job = self._context.pool.submit(
                    task, lambda news: self._heard(hear, news), self._limit, self._urgency
                )
        self._context.wake()

    def halt(self) -> None:
        """Stop what is under way, and keep what it found."""
        if self._job is not None and self.running:
            self._context.pool.stop(self._job)
            self._context.wake()

    def stop(self) -> None:
        """The browser has left."""
        self._silence()

    def _silence(self) -> None:
        """No further word of the last one."""
        if self._job is not None:
            self._context.pool.stop(self._job, quiet=True)

    def _heard(self, hear: Callable[[JobEvent], None], news: JobEvent) -> None:
        if isinstance(news, (JobEnded, JobFailed)):
            self.running = False
        hear(news)
        now = time.monotonic()
        if not isinstance(news, JobProgress) or now - self._woken > FRAME:
            self._woken = now
            self._context.wake()
