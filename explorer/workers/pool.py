"""Long work in warm processes: a queue with honest positions, a stop that answers, and recovery from a process lost.

A pool keeps one warm process from the start and adds others, up to its size, once there is work. Each has a thread
that feeds it, so a process that dies or hangs costs its own job and nothing else. Whose job is next: `queue`.
"""

import itertools
import threading
from collections.abc import Callable

from explorer.workers.hand import WorkerThread
from explorer.workers.job import Job, JobEnded, JobEvent, JobFailed, JobQueued
from explorer.workers.process import Task
from explorer.workers.queue import MOST_WAITING, Queue


class Pool:
    """Processes shared by all sessions."""

    def __init__(self, processes: int = 2) -> None:
        self._numbers = itertools.count(1)
        self._queue = Queue(processes)
        self._change = threading.Condition()
        self._hands: list[WorkerThread] = []
        self._processes = processes
        self._closed = False

    def share(self) -> "Share":
        """A page's own way in."""
        with self._change:
            self._queue.pages += 1
        return Share(self)

    def leave(self) -> None:
        """A page has gone; its jobs are stopped by those who began them."""
        with self._change:
            self._queue.pages -= 1
            self._change.notify_all()

    def warm(self) -> None:
        """Start the first process before anybody asks."""
        with self._change:
            if not self._hands and not self._closed:
                self._add_hand()

    def submit(
        self,
        task: Task,
        on_event: Callable[[JobEvent], None],
        limit: float = 60.0,
        urgency: int = 0,
        owner: "Share | None" = None,
    ) -> Job:
        """Queue a task; `hear` is called from threads of the pool and must be quick. Less `urgency` goes first."""
        with self._change:
            job = Job(next(self._numbers), task, on_event, limit, urgency, owner)
            if self._closed:
                job.tell(JobFailed("The page is closing."))
                return job
            if self._queue.full(owner):
                job.tell(JobFailed(f"{MOST_WAITING} jobs of this page wait already: stop one of them first."))
                return job
            self._queue.add(job)
            idle = sum(hand.idle for hand in self._hands)
            if idle < len(self._queue) and len(self._hands) < self._processes:
                self._add_hand()
            self._change.notify_all()
        self._tell_positions()
        return job

    def stop(self, job: Job, quiet: bool = False) -> None:
        """Stop a job, waiting or running; `quiet`: nobody listens any more."""
        if quiet:
            job.silence()
        job.stopping.set()
        with self._change:
            waiting = job in self._queue
            if waiting:
                self._queue.remove(job)
        if waiting:
            job.tell(JobEnded(None, stopped=True))
            self._tell_positions()

    def abandon(self, job: Job) -> None:
        """Nobody waits for its answer any more: out of the queue, or on to its end."""
        with self._change:
            waiting = job in self._queue
            if waiting:
                self._queue.remove(job)
        if waiting:
            job.silence()
            self._tell_positions()

    def close(self) -> None:
        """End all processes."""
        with self._change:
            self._closed = True
            hands, waiting = list(self._hands), self._queue.clear()
            self._change.notify_all()
        for job in waiting:
            job.silence()
        for hand in hands:
            hand.close()

    @property
    def pids(self) -> tuple[int, ...]:
        """Process ids of the processes that live."""
        return tuple(pid for hand in self._hands if (pid := hand.pid) is not None)

    def next(self, patience: float) -> Job | None:
        """The job whose turn it is; None when none came within `patience` [s] or the pool closes."""
        with self._change:
            if self._closed:
                return None
            job = self._queue.take()
            if job is None:
                self._change.wait(patience)
                job = None if self._closed else self._queue.take()
            if job is None:
                return None
        self._tell_positions()
        return job

    def done(self, job: Job) -> None:
        """A process has no more to do with it."""
        with self._change:
            self._queue.done(job)
            self._change.notify_all()

    @property
    def closed(self) -> bool:
        return self._closed

    def spare(self) -> None:
        """Where one process has work, another may soon: warm it before it is asked for."""
        with self._change:
            if len(self._hands) < self._processes and not self._closed:
                self._add_hand()

    def _add_hand(self) -> None:
        hand = WorkerThread(self, f"jobs-{len(self._hands)}")
        self._hands.append(hand)
        hand.start()

    def _tell_positions(self) -> None:
        with self._change:
            stays = self._queue.stays(sum(hand.idle for hand in self._hands))
        for ahead, job in enumerate(stays):
            job.tell(JobQueued(ahead))


class Share:
    """What a page holds of the pool."""

    def __init__(self, pool: Pool) -> None:
        self._pool = pool

    def submit(self, task: Task, on_event: Callable[[JobEvent], None], limit: float = 60.0, urgency: int = 0) -> Job:
        """As `Pool.submit`, in this page's name."""
        return self._pool.submit(task, on_event, limit, urgency, self)

    def stop(self, job: Job, quiet: bool = False) -> None:
        self._pool.stop(job, quiet)

    def abandon(self, job: Job) -> None:
        self._pool.abandon(job)

    def leave(self) -> None:
        """The page has gone."""
        self._pool.leave()
