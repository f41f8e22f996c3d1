"""Jobs for the worker processes, the events that a page receives of them, and the queue in which they wait."""

import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from explorer.workers.process import Task

MOST_WAITING = 6
"""Jobs of one page in the queue; its tabs start three."""


@dataclass(frozen=True)
class JobQueued:
    """The job waits behind `ahead` others."""

    ahead: int


@dataclass(frozen=True)
class JobStarted:
    """A process runs the job."""


@dataclass(frozen=True)
class JobProgress:
    """What the task reported."""

    item: Any


@dataclass(frozen=True)
class JobEnded:
    """The end: the task's result, or None if it was stopped before it had one."""

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
    """One task in the pool; `owner` is its page, None where fairness between pages does not matter."""

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

    def tell(self, event: JobEvent) -> None:
        """Pass an event on; none follows the end."""
        with self._lock:
            if self._over:
                return
            self._over = isinstance(event, (JobEnded, JobFailed))
            self._on_event(event)

    def silence(self) -> None:
        """Pass on no further event."""
        with self._lock:
            self._over = True


class JobQueue:
    """Jobs that wait, and jobs that run.

    Pages take turns: the page with fewer jobs running comes first, then the more urgent job. While there are several
    pages, none has all processes, so that the next page finds one free, or free soon. Not safe from several threads.
    """

    def __init__(self, processes: int) -> None:
        self._processes = processes
        self._waiting: list[Job] = []
        self._running: list[Job] = []
        self._served: dict[object, int] = {}
        """When a page that still waits was last served, counted in jobs."""
        self._count = 0
        self.pages = 0
        """How many pages there are."""

    def __len__(self) -> int:
        return len(self._waiting)

    def __contains__(self, job: Job) -> bool:
        return job in self._waiting

    def behind(self, free: int) -> tuple[Job, ...]:
        """Jobs that go on waiting when `free` processes are free, in the order in which they will run."""
        going = [job for job in self._waiting if self._may_run(job)][:free]
        return tuple(job for job in self._waiting if job not in going)

    def full(self, owner: object) -> bool:
        """Whether a page has as many jobs waiting as it may."""
        return owner is not None and sum(job.owner == owner for job in self._waiting) >= MOST_WAITING

    def add(self, job: Job) -> None:
        self._waiting.append(job)
        self._sort()

    def remove(self, job: Job) -> None:
        """The job is no longer wanted."""
        self._waiting.remove(job)
        self._sort()

    def take(self) -> Job | None:
        """The next job, which now runs; None where none waits, or none may run."""
        job = next((job for job in self._waiting if self._may_run(job)), None)
        if job is not None:
            self._waiting.remove(job)
            self._running.append(job)
            self._count += 1
            self._served[job.owner] = self._count
            self._sort()
        return job

    def done(self, job: Job) -> None:
        """The job no longer runs."""
        self._running.remove(job)
        self._sort()

    def clear(self) -> tuple[Job, ...]:
        """Empty the queue and return the jobs that waited."""
        waiting, self._waiting = tuple(self._waiting), []
        return waiting

    def _may_run(self, job: Job) -> bool:
        """Whether its page may have another process."""
        most = max(self._processes - 1, 1) if self.pages > 1 else self._processes
        return job.owner is None or self._running_of(job.owner) < most

    def _running_of(self, owner: object) -> int:
        return 0 if owner is None else sum(job.owner == owner for job in self._running)

    def _sort(self) -> None:
        """The second job of a page waits behind the first of all others, the page served last behind the others."""
        self._waiting.sort(key=lambda job: (job.urgency, job.number))
        before = {job.owner: self._running_of(job.owner) for job in self._waiting}
        rank: dict[int, int] = {}
        for job in self._waiting:
            rank[job.number] = before[job.owner]
            before[job.owner] += job.owner is not None
        known = {job.owner for job in (*self._waiting, *self._running) if job.owner is not None}
        self._served = {page: when for page, when in self._served.items() if page in known}
        self._waiting.sort(key=lambda job: (rank[job.number], self._served.get(job.owner, 0), job.urgency, job.number))
