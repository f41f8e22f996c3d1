"""One pool of processes of this machine, for commands, studies and the page.

`concurrent.futures.ProcessPoolExecutor` (and loky, which is built on it) was tried and does not do: its processes go on
when their parent is killed, one lost process breaks them all, it cannot end a task that ignores its stop, and the
interpreter waits for running tasks at exit.

One file: what is said of a job, the queue and the thread that feeds a process are read together.
"""

import itertools
import threading
import time
from bisect import insort
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future
from contextlib import suppress
from dataclasses import dataclass, field
from queue import Empty, SimpleQueue
from typing import Any

from rotor.support.worker_process import Stop, Task, Tell, WorkerProcess

Work = Callable[..., Iterator[Any]]
"""work(*arguments, stop) yields items."""

_STOP_ANSWER_S = 0.12
"""[s] a process has to answer the stop of a job with a limit; then the job ends with what was reported."""
_KILL_AFTER_S = 3.0
"""[s] after that stop until a process that goes on is killed."""
_IDLE_CHECK_S = 2.0
"""[s] between the checks of an idle thread whether its prepared process still runs."""
_LIMITED_POLL_S = 0.01
"""[s] between two looks at what ends a job with a limit."""
_POLL_S = 0.1
"""[s] between the questions whether to stop, for all others."""
_START_S = 300.0
"""[s] a new process may take to prepare, on a busy machine: it may have to compile."""


class WorkerLost(BrokenExecutor):
    """A process ended unexpectedly; what it delivered before is kept."""

    def __init__(self) -> None:
        super().__init__(
            "A worker process was lost, perhaps for lack of memory; results so far are kept: use fewer processes."
        )


@dataclass(frozen=True)
class _Called:
    """A function as a task that reports nothing and runs to its end."""

    function: Callable[..., Any]
    arguments: tuple[Any, ...] = ()
    keywords: dict[str, Any] = field(default_factory=dict[str, Any])

    def run(self, tell: Tell, stop: Stop) -> Any:
        del tell, stop
        return self.function(*self.arguments, **self.keywords)


@dataclass(frozen=True)
class _Yielded:
    """Work as a task that reports each item."""

    work: Work
    arguments: tuple[Any, ...]

    def run(self, tell: Tell, stop: Stop) -> None:
        for item in self.work(*self.arguments, stop):
            tell(item)


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
    """The job ended with the task's result, or with None if it was stopped before it had one."""

    result: Any
    stopped: bool = False
    late: bool = False
    """Stopped by the time limit."""


@dataclass(frozen=True)
class JobFailed:
    """The job failed; the sentence tells whoever waits for it why."""

    message: str
    error: Exception | None = None
    """What was raised."""


JobEvent = JobQueued | JobStarted | JobProgress | JobEnded | JobFailed


class Job:
    """One task in the pool; of two that wait the one of lower urgency number runs first, then the older one."""

    def __init__(
        self,
        number: int,
        task: Task,
        on_event: Callable[[JobEvent], None],
        limit: float | None,
        urgency: int,
    ) -> None:
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


class Processes(Executor):
    """A pool of processes of this machine, as an executor and for jobs with progress that can be stopped; thread-safe.

    Each has a thread that feeds it through a pipe, so a process that ends or hangs costs only its own job, and is
    replaced. They are started once there is work.
    """

    def __init__(self, count: int, prepare: Callable[[], object] | None = None) -> None:
        """`prepare`: what a new process does first. All are then kept ready, begun one after the other."""
        self.prepare = prepare
        self._count = count
        self._numbers = itertools.count(1)
        self._waiting: list[Job] = []
        self._change = threading.Condition()
        self._workers: list[_Worker] = []
        self._closed = self._killed = False

    def warm(self) -> None:
        """Start the first process before it is needed."""
        with self._change:
            if not self._workers:
                self._add_worker()

    def begin(
        self,
        task: Task,
        on_event: Callable[[JobEvent], None],
        limit: float | None = None,
        urgency: int = 0,
    ) -> Job:
        """Queue a task. `on_event` is called from threads of the pool and must be quick. Lower `urgency` goes first.

        `limit`: of its time [s]; its process is killed where it does not heed a stop. None: a task of any length, which
        also ends by itself after a stop, and hears nothing of its place in the queue.
        """
        job = Job(next(self._numbers), task, on_event, limit, urgency)
        try:
            self._queue(job)
        except RuntimeError as error:
            job.tell(JobFailed(str(error), error))
        return job

    def stop(self, job: Job, quiet: bool = False) -> None:
        """Stop a job, waiting or running; `quiet`: nobody listens any more."""
        if quiet:
            job.silence()
        job.stopping.set()
        with self._change:
            waits = job in self._waiting
            if waits:
                self._waiting.remove(job)
        self._tell_positions()
        if waits:
            job.tell(JobEnded(None, stopped=True))

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()

        def hear(event: JobEvent) -> None:
            match event:
                case JobStarted() if not future.set_running_or_notify_cancel():
                    job.stopping.set()
                case JobEnded(stopped=True):
                    future.cancel()
                case JobEnded(result):
                    future.set_result(result)
                case JobFailed(message, error):
                    future.set_exception(error or RuntimeError(message))
                case _:
                    pass

        job = Job(next(self._numbers), _Called(fn, args, kwargs), hear, None, 0)
        self._queue(job)
        return future

    def stream(
        self, tasks: Sequence[tuple[Work, tuple[Any, ...]]], deliver: Tell, stop: Stop | None = None
    ) -> bool:
        """Run tasks and deliver their items in this thread as they come; True when stopped before the end.

        `stop` is called several times a second. Raises WorkerLost, and what a task raises.
        """
        events: SimpleQueue[JobEvent] = SimpleQueue()
        jobs = [self.begin(_Yielded(*task), events.put) for task in tasks]
        under_way, stopping = len(jobs), False
        try:
            while under_way:
                with suppress(Empty):
                    match events.get(timeout=_POLL_S):
                        case JobProgress(item):
                            deliver(item)
                        case JobFailed(message, error):
                            raise error or RuntimeError(message)
                        case JobEnded():
                            under_way -= 1
                        case _:
                            pass
                if under_way and stop is not None and not stopping and stop():
                    stopping = True
                    for job in jobs:
                        self.stop(job)
            return stopping
        finally:
            for job in jobs:
                self.stop(job)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End the processes after the jobs queued so far; with `cancel_futures` at once, also in the midst of a job."""
        with self._change:
            self._closed = True
            self._killed |= cancel_futures
            cancelled = self._waiting if self._killed else []
            self._waiting = [] if self._killed else self._waiting
            self._change.notify_all()
        for job in cancelled:
            job.tell(JobEnded(None, stopped=True))
        for worker in self._workers:
            if self._killed:
                worker.kill()
        for worker in self._workers if wait else ():
            worker.join()

    def __exit__(self, error: type[BaseException] | None, *_: object) -> None:
        self.shutdown(cancel_futures=error is not None)

    def next(self, worker: "_Worker") -> Job | None:
        """The next job of an idle thread; None when none came in time, or ever will."""
        with self._change:
            self._change.wait_for(
                lambda: self._waiting or self._closed, _IDLE_CHECK_S if self.prepare else None
            )
            job = self._waiting.pop(0) if self._waiting else None
            worker.idle = job is None
        if job is not None:
            self._tell_positions()
        return job

    def ends(self) -> bool:
        """Whether there will be no further job."""
        with self._change:
            return self._closed and not self._waiting

    def keep(self, worker: "_Worker", process: WorkerProcess) -> None:
        """A new process; killed where the pool was ended while it started."""
        with self._change:
            worker.process = process
            if self._killed:
                process.kill()

    def ready(self) -> None:
        """A process is prepared: a further one may begin."""
        with self._change:
            self._add_worker()

    @property
    def _idle(self) -> int:
        return sum(worker.idle for worker in self._workers)

    def _queue(self, job: Job) -> None:
        with self._change:
            if self._closed:
                raise RuntimeError("these processes have been shut down")
            insort(self._waiting, job, key=lambda one: (one.urgency, one.number))
            if self._idle < len(self._waiting):
                self._add_worker()
            self._change.notify_all()
        self._tell_positions()

    def _add_worker(self) -> None:
        if len(self._workers) < self._count and not self._closed:
            worker = _Worker(self, f"worker-{len(self._workers)}")
            self._workers.append(worker)
            worker.start()

    def _tell_positions(self) -> None:
        with self._change:
            behind = self._waiting[self._idle :]
        for ahead, job in enumerate(behind):
            if job.limit is not None:
                job.tell(JobQueued(ahead))


class _Worker(threading.Thread):
    """A thread and the process that it feeds: killed when it does not stop, replaced when lost."""

    def __init__(self, pool: Processes, name: str) -> None:
        super().__init__(name=name, daemon=True)
        self.idle = True
        self.process: WorkerProcess | None = None
        self._pool = pool

    @property
    def pid(self) -> int | None:
        process = self.process
        return process.pid if process is not None else None

    def run(self) -> None:
        while not self._pool.ends():
            if self._pool.prepare is not None:
                with suppress(OSError, EOFError):
                    self._ready()  # Start a process ahead of the next job, also after one was lost.
                self._pool.ready()
            job = self._pool.next(self)
            if job is None:
                continue
            try:
                self._do(job)
            except (OSError, EOFError):
                self._drop()
                sentence = (
                    "The worker process ended unexpectedly; a new one is starting. Press again."
                )
                job.tell(JobFailed(sentence, WorkerLost()))
            except (
                Exception
            ) as error:  # A task that cannot be pickled, for example: the thread must go on.
                job.tell(JobFailed(f"The work could not be done: {error}", error))
            self.idle = True
        self._drop()

    def kill(self) -> None:
        process = self.process
        if process is not None:
            process.kill()

    def _ready(self) -> WorkerProcess:
        """A live process, prepared."""
        process = self.process
        if process is not None and process.pid is not None:
            return process
        self._drop()
        process = WorkerProcess(self.name)
        self._pool.keep(self, process)
        if self._pool.prepare is not None:
            process.begin(_Called(self._pool.prepare))
            if process.receive(_START_S) is None:
                self._drop()  # Its late answer would be taken for that of the next job.
                raise EOFError
        return process

    def _do(self, job: Job) -> None:
        job.tell(JobStarted())
        if job.stopping.is_set():
            job.tell(JobEnded(None, stopped=True))
            return
        process = self._ready()
        process.begin(job.task)
        try:
            self._hear(job, process)
        except Exception:  # The page could not be told: the process is still at this job.
            self._drop()
            raise

    def _hear(self, job: Job, process: WorkerProcess) -> None:
        """Pass on what a process says of a job, until it ends."""
        begun, asked, late = time.monotonic(), None, False
        while True:
            now = time.monotonic()
            if job.limit is not None and now - begun > job.limit and asked is None:
                late = True
                job.stopping.set()
            if job.stopping.is_set() and asked is None:
                asked = now
                process.ask_to_stop()
            if job.limit is not None and asked is not None and now - asked > _STOP_ANSWER_S:
                job.tell(JobEnded(None, stopped=True, late=late))
                if now - asked > _KILL_AFTER_S:
                    self._drop()
                    return
            reply = process.receive(_POLL_S if job.limit is None else _LIMITED_POLL_S)
            if reply is None:
                continue
            match reply.kind:
                case "item":
                    job.tell(JobProgress(reply.value))
                case "result":
                    job.tell(JobEnded(reply.value, stopped=asked is not None, late=late))
                    return
                case "error":
                    sentence = (
                        f"The work failed ({str(reply.value) or type(reply.value).__name__})."
                    )
                    if isinstance(reply.value, MemoryError):
                        sentence = "This needs more memory than is free here: end other programs, then press again."
                    job.tell(JobFailed(sentence, reply.value))
                    return

    def _drop(self) -> None:
        process, self.process = self.process, None
        if process is not None:
            process.close()


def run_tasks(
    pool: Processes | None,
    tasks: Sequence[tuple[Work, tuple[Any, ...]]],
    deliver: Tell,
    stop: Stop | None,
) -> bool:
    """Run tasks as `Processes.stream`; here, one after the other, where there is no pool."""
    if pool is not None:
        return pool.stream(tasks, deliver, stop)
    for work, arguments in tasks:
        for item in work(*arguments, stop):
            deliver(item)
        if stop is not None and stop():
            return True
    return False
