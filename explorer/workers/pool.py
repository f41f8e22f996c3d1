"""A pool of warm worker processes shared by all pages, with progress, stop, time limits and honest queue positions.

One process is kept warm from the start; others are added, up to the size of the pool, once there is work. Each has a
thread that feeds it through a pipe, so a process that ends or hangs costs only its own job.
"""

import itertools
import os
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, Protocol

for _threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_threads, "1")  # Before NumPy is loaded: its BLAS then makes no threads, which only hinder.

from rotor.processes import Stop, Tell, WorkerProcess  # noqa: E402

_NICE = 5
"""Lower priority than the server, so that frames come before searches where processors are short."""
_PATIENCE = 0.12
"""[s] a process has to answer a stop; then the job ends with what was reported."""
_GRACE = 3.0
"""[s] after a stop until a process that goes on is killed."""
_LOOK = 2.0
"""[s] between the checks of an idle thread whether its process still runs."""
_POLL = 0.2
"""[s] between the questions whether a result is still awaited: each takes a turn of the interpreter from the frames."""
_START = 300.0
"""[s] a new process may take to import and compile, on a busy machine."""


class Task(Protocol):
    """A value that can be pickled and run."""

    def run(self, tell: Tell, stop: Stop) -> Any:
        """Report progress with `tell`; call `stop` often, and return what there is when it is True."""
        ...


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
    """One task in the pool; of two that wait the one of lower urgency number runs first, then the older one."""

    def __init__(self, number: int, task: Task, on_event: Callable[[JobEvent], None], limit: float, urgency: int):
        self.number, self.task, self.limit, self.urgency = number, task, limit, urgency
        self.stopping = threading.Event()
        self._on_event = on_event
        self._lock = threading.Lock()
        self.over = False

    def tell(self, event: JobEvent) -> None:
        """Pass an event on; none follows the end."""
        with self._lock:
            if self.over:
                return
            self.over = isinstance(event, (JobEnded, JobFailed))
            self._on_event(event)

    def silence(self) -> None:
        """Pass on no further event."""
        with self._lock:
            self.over = True


class Pool:
    """Processes shared by all sessions; safe from any thread."""

    def __init__(self, processes: int = 2) -> None:
        self._numbers = itertools.count(1)
        self._waiting: list[Job] = []
        self._change = threading.Condition()
        self._workers: list[WorkerThread] = []
        self._processes = processes
        self.closed = False

    def warm(self) -> None:
        """Start the first process before it is needed."""
        with self._change:
            if not self._workers:
                self._add_worker()

    def submit(self, task: Task, on_event: Callable[[JobEvent], None], limit: float = 60.0, urgency: int = 0) -> Job:
        """Queue a task. `on_event` is called from threads of the pool and must be quick. Lower `urgency` goes first."""
        with self._change:
            job = Job(next(self._numbers), task, on_event, limit, urgency)
            if self.closed:
                job.tell(JobFailed("The page is closing."))
                return job
            self._waiting.append(job)
            self._waiting.sort(key=lambda job: (job.urgency, job.number))
            if self._idle < len(self._waiting):
                self._add_worker()
            self._change.notify_all()
        self._tell_positions()
        return job

    def result(
        self, task: Task, superseded: Callable[[], bool], urgency: int, tell: Callable[[Any], None] = lambda _: None
    ) -> JobEnded | JobFailed | None:
        """Waits for the end of a task; None when superseded first: it leaves the queue, or runs on to its end.

        `tell` is called with the result, also of a task that ran on. Not to be called on a thread that pages need.
        """
        over, ends = threading.Event(), list[JobEnded | JobFailed]()

        def on_event(event: JobEvent) -> None:
            if isinstance(event, JobEnded | JobFailed):
                if isinstance(event, JobEnded) and event.result is not None:
                    tell(event.result)
                ends.append(event)
                over.set()

        job = self.submit(task, on_event, urgency=urgency)
        while not over.wait(_POLL):
            if superseded():
                if self._dequeue(job):
                    job.silence()
                return None
        return ends[0]

    def stop(self, job: Job, quiet: bool = False) -> None:
        """Stop a job, waiting or running; `quiet`: nobody listens any more."""
        if quiet:
            job.silence()
        job.stopping.set()
        if self._dequeue(job):
            job.tell(JobEnded(None, stopped=True))

    def close(self) -> None:
        with self._change:
            self.closed = True
            workers, waiting, self._waiting = list(self._workers), self._waiting, []
            self._change.notify_all()
        for job in waiting:
            job.silence()
        for worker in workers:
            worker.close()

    def next(self, patience: float) -> Job | None:
        """The next job; None when none came within `patience` [s] or the pool closes."""
        with self._change:
            self._change.wait_for(lambda: self._waiting or self.closed, patience)
            job = self._waiting.pop(0) if self._waiting else None
        if job is not None:
            self._tell_positions()
        return job

    def done(self) -> None:
        """A process is free again. Where one had work another may soon, so a further one is warmed."""
        with self._change:
            self._add_worker()

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
            waits = job in self._waiting
            if waits:
                self._waiting.remove(job)
        self._tell_positions()
        return waits

    def _tell_positions(self) -> None:
        with self._change:
            behind = self._waiting[self._idle :]
        for ahead, job in enumerate(behind):
            job.tell(JobQueued(ahead))


class WorkerThread(threading.Thread):
    """A thread and the process that it feeds: kept warm, killed when it does not stop, replaced when lost."""

    def __init__(self, pool: Pool, name: str) -> None:
        super().__init__(name=name, daemon=True)
        self.idle = True
        self._pool = pool
        self._process: WorkerProcess | None = None
        self._closed = False

    @property
    def pid(self) -> int | None:
        process = self._process
        return process.pid if process is not None else None

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
            self._pool.done()

    def close(self) -> None:
        self._closed = True
        self._drop()

    def _ready(self) -> WorkerProcess:
        """A live, warm process."""
        process = self._process
        if process is not None and process.pid is not None:
            return process
        self._drop()
        process = self._process = WorkerProcess(self.name)
        if self._closed:
            self._drop()
        process.call(warm)
        if process.receive(_START) is None:
            self._drop()  # Its answer would be taken for that of the next job.
            raise EOFError
        return process

    def _do(self, job: Job) -> None:
        process = self._ready()
        if job.stopping.is_set():
            job.tell(JobEnded(None, stopped=True))
            return
        job.tell(JobStarted())
        begun = time.monotonic()
        process.stream(job.task.run)
        try:
            self._hear(job, process, begun)
        except Exception:  # The page could not be told: the process is still at this job.
            self._drop()
            raise

    def _hear(self, job: Job, process: WorkerProcess, begun: float) -> None:
        """Pass on what a process says of a job, until it ends."""
        asked, late = None, False
        while True:
            now = time.monotonic()
            if now - begun > job.limit and asked is None:
                late = True
                job.stopping.set()
            if job.stopping.is_set() and asked is None:
                asked = now
                process.ask_to_stop()
            if asked is not None and now - asked > _PATIENCE:
                job.tell(JobEnded(None, stopped=True, late=late))
            if asked is not None and now - asked > _GRACE:
                self._drop()
                return
            reply = process.receive(0.01)
            if reply is None:
                continue
            match reply.kind:
                case "item":
                    job.tell(JobProgress(reply.value))
                case "result":
                    job.tell(JobEnded(reply.value, stopped=asked is not None, late=late))
                    return
                case "error":
                    job.tell(JobFailed(f"The work failed ({str(reply.value) or type(reply.value).__name__})."))
                    return

    def _drop(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            process.close()


def warm() -> None:
    """In a new process: what every solution would wait for."""
    if hasattr(os, "nice"):
        os.nice(_NICE)
    from explorer.workers import solver

    solver.warm()
