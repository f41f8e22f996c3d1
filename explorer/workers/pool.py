"""A pool of warm worker processes shared by all pages, with progress, stop, time limits and honest queue positions.

One process is kept warm from the start; others are added, up to the size of the pool, once there is work. Each has a
thread that feeds it through a pipe, so a process that ends or hangs costs only its own job.

`concurrent.futures.ProcessPoolExecutor` (and loky, which is built on it) was tried and does not do: it cannot end a
task that ignores its stop, the interpreter waits for running tasks at exit (8 s measured for a task of 8 s), and the
processes of a server that was killed go on.
"""

import itertools
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from typing import Any

from explorer.workers.job import (
    MOST_WAITING,
    Job,
    JobEnded,
    JobEvent,
    JobFailed,
    JobProgress,
    JobQueue,
    JobQueued,
    JobStarted,
)
from explorer.workers.process import RunRequest, StopRequest, Task, WorkerReply, serve

_PATIENCE = 0.12
"""[s] a process has to answer a stop; then the job ends with what was reported."""
_GRACE = 3.0
"""[s] after a stop until a process that goes on is killed."""
_LOOK = 2.0
"""[s] between the checks of an idle thread whether its process still runs."""
_POLL = 0.2
"""[s] between the questions whether a result is still awaited: each takes a turn of the interpreter from the frames."""
_START = 60.0
"""[s] a new process may take to import and compile."""


class Pool:
    """Processes shared by all sessions; safe from any thread."""

    def __init__(self, processes: int = 2) -> None:
        self._numbers = itertools.count(1)
        self._queue = JobQueue(processes)
        self._change = threading.Condition()
        self._workers: list[WorkerThread] = []
        self._processes = processes
        self.closed = False

    def share(self) -> "PoolClient":
        """Access for one page."""
        with self._change:
            self._queue.pages += 1
        return PoolClient(self)

    def leave(self) -> None:
        """A page has gone; its tabs stop their own jobs."""
        with self._change:
            self._queue.pages -= 1
            self._change.notify_all()

    def warm(self) -> None:
        """Start the first process before it is needed."""
        with self._change:
            if not self._workers:
                self._add_worker()

    def submit(
        self,
        task: Task,
        on_event: Callable[[JobEvent], None],
        limit: float = 60.0,
        urgency: int = 0,
        owner: "PoolClient | None" = None,
    ) -> Job:
        """Queue a task. `on_event` is called from threads of the pool and must be quick. Lower `urgency` goes first."""
        with self._change:
            job = Job(next(self._numbers), task, on_event, limit, urgency, owner)
            if self.closed:
                job.tell(JobFailed("The page is closing."))
                return job
            if self._queue.full(owner):
                job.tell(JobFailed(f"{MOST_WAITING} jobs of this page wait already: stop one of them first."))
                return job
            self._queue.add(job)
            if self._idle < len(self._queue):
                self._add_worker()
            self._change.notify_all()
        self._tell_positions()
        return job

    def stop(self, job: Job, quiet: bool = False) -> None:
        """Stop a job, waiting or running; `quiet`: nobody listens any more."""
        if quiet:
            job.silence()
        job.stopping.set()
        if self._dequeue(job):
            job.tell(JobEnded(None, stopped=True))
            self._tell_positions()

    def abandon(self, job: Job) -> None:
        """Its result is no longer needed: a waiting job leaves the queue, a running one goes on to its end."""
        if self._dequeue(job):
            job.silence()
            self._tell_positions()

    def close(self) -> None:
        """End all processes."""
        with self._change:
            self.closed = True
            workers, waiting = list(self._workers), self._queue.clear()
            self._change.notify_all()
        for job in waiting:
            job.silence()
        for worker in workers:
            worker.close()

    def next(self, patience: float) -> Job | None:
        """The next job; None when none came within `patience` [s] or the pool closes."""
        with self._change:
            job = None if self.closed else self._queue.take()
            if job is None and not self.closed:
                self._change.wait(patience)
                job = None if self.closed else self._queue.take()
        if job is not None:
            self._tell_positions()
        return job

    def done(self, job: Job) -> None:
        """Its process is free again. Where one had work another may soon, so a further one is warmed."""
        with self._change:
            self._queue.done(job)
            self._add_worker()
            self._change.notify_all()

    @property
    def _idle(self) -> int:
        return sum(worker.idle for worker in self._workers)

    def _add_worker(self) -> None:
        if len(self._workers) < self._processes and not self.closed:
            worker = WorkerThread(self, f"jobs-{len(self._workers)}")
            self._workers.append(worker)
            worker.start()

    def _dequeue(self, job: Job) -> bool:
        """Take a job out of the queue, if it waits."""
        with self._change:
            waiting = job in self._queue
            if waiting:
                self._queue.remove(job)
        return waiting

    def _tell_positions(self) -> None:
        with self._change:
            behind = self._queue.behind(self._idle)
        for ahead, job in enumerate(behind):
            job.tell(JobQueued(ahead))


class PoolClient:
    """Access of one page to the pool; the methods are those of `Pool`, in this page's name."""

    def __init__(self, pool: Pool) -> None:
        self._pool = pool
        self.stop, self.abandon, self.leave = pool.stop, pool.abandon, pool.leave

    def submit(self, task: Task, on_event: Callable[[JobEvent], None], limit: float = 60.0, urgency: int = 0) -> Job:
        return self._pool.submit(task, on_event, limit, urgency, self)

    def result(
        self, task: Task, superseded: Callable[[], bool], urgency: int, found: Callable[[Any], None] = lambda _: None
    ) -> JobEnded | JobFailed | None:
        """Waits for the end of a task; None when superseded first.

        `found` is called with the result, also of a task that ran on after it was superseded. The thread that waits
        must not hold a turn that pages need to compute.
        """
        over, ends = threading.Event(), list[JobEnded | JobFailed]()

        def on_event(news: JobEvent) -> None:
            if isinstance(news, JobEnded | JobFailed):
                if isinstance(news, JobEnded) and news.result is not None:
                    found(news.result)
                ends.append(news)
                over.set()

        job = self.submit(task, on_event, urgency=urgency)
        while not over.wait(_POLL):
            if superseded():
                self.abandon(job)
                return None
        return ends[0]


class WorkerThread(threading.Thread):
    """A thread and the process that it feeds: kept warm, killed when it does not stop, replaced when lost."""

    def __init__(self, pool: Pool, name: str) -> None:
        super().__init__(name=name, daemon=True)
        self.idle = True
        self._pool = pool
        self._process: Any = None
        self._pipe: Connection[Any, Any] | None = None
        self._closed = False

    @property
    def pid(self) -> int | None:
        process = self._process
        return process.pid if process is not None and process.is_alive() else None

    def run(self) -> None:
        while not self._pool.closed:
            with suppress(OSError, EOFError):
                self._ready()  # Warm before it is needed, and again after it was lost.
            job = self._pool.next(_LOOK)
            if job is None:
                continue
            self.idle = False
            try:
                self._do(job)
            except (OSError, EOFError):
                self._drop()
                job.tell(JobFailed("The worker process ended unexpectedly; a new one is on its way. Press again."))
            except Exception as error:  # A task that cannot be pickled, for example: the thread must go on.
                job.tell(JobFailed(f"The work could not be done: {error}"))
            self.idle = True
            self._pool.done(job)

    def close(self) -> None:
        self._closed = True
        self._drop()

    def _ready(self) -> "Connection[Any, Any]":
        """The pipe to a live, warm process."""
        if self.pid is not None and self._pipe is not None:
            return self._pipe
        self._drop()
        context = get_context("spawn")
        pipe, theirs = context.Pipe()
        process = context.Process(target=serve, args=(theirs,), name=self.name, daemon=True)
        process.start()
        theirs.close()  # So that the pipe ends with the process.
        self._process, self._pipe = process, pipe
        if self._closed:
            self._drop()
        if not pipe.poll(_START):
            raise EOFError
        pipe.recv()
        return pipe

    def _do(self, job: Job) -> None:
        pipe = self._ready()
        if job.stopping.is_set():
            job.tell(JobEnded(None, stopped=True))
            return
        job.tell(JobStarted())
        begun, asked, late = time.monotonic(), None, False
        pipe.send(RunRequest(job.number, job.task))
        while True:
            now = time.monotonic()
            if now - begun > job.limit and asked is None:
                late = True
                job.stopping.set()
            if job.stopping.is_set() and asked is None:
                asked = now
                pipe.send(StopRequest(job.number))
            if asked is not None and now - asked > _PATIENCE:
                job.tell(JobEnded(None, stopped=True, late=late))
            if asked is not None and now - asked > _GRACE:
                self._drop()
                return
            if not wait([pipe], 0.01):
                continue
            reply: WorkerReply = pipe.recv()
            if reply.number != job.number:
                continue
            match reply.kind:
                case "progress":
                    job.tell(JobProgress(reply.item))
                case "done":
                    job.tell(JobEnded(reply.item, stopped=asked is not None, late=late))
                    return
                case _:
                    job.tell(JobFailed(f"The work failed ({reply.item})."))
                    return

    def _drop(self) -> None:
        process, self._process = self._process, None
        pipe, self._pipe = self._pipe, None
        if process is not None and process.is_alive():
            process.kill()
            process.join(1.0)
        if pipe is not None:
            pipe.close()
