"""A thread and the process that it feeds: kept warm, asked to stop, ended when it does not, and replaced when lost."""

import threading
import time
from collections.abc import Generator
from contextlib import contextmanager, suppress
from multiprocessing import get_context, spawn
from multiprocessing.connection import Connection, wait
from typing import Any, Protocol

from explorer.workers.job import Job, JobEnded, JobFailed, JobProgress, JobStarted
from explorer.workers.process import RunRequest, StopRequest, WorkerReply, serve

PATIENCE = 0.12
"""A process that has not answered a stop by then [s] is no longer waited for: the job ends with what was told."""
GRACE = 3.0
"""A process that goes on for so long after a stop [s] is ended."""
_LOOK = 2.0
"""How often a thread without work looks whether its process still lives [s]."""
_START = 60.0
"""[s] a new process may take to import and compile."""
_starting = threading.Lock()
"""One process is started at a time."""


class Work(Protocol):
    """Where the jobs come from."""

    @property
    def closed(self) -> bool: ...

    def next(self, patience: float) -> Job | None: ...

    def done(self, job: Job) -> None: ...

    def spare(self) -> None: ...


class WorkerThread(threading.Thread):
    """A thread and the process that it feeds."""

    def __init__(self, pool: Work, name: str) -> None:
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
                self._ready()  # Warm before anybody asks, and again after it was lost.
            job = self._pool.next(_LOOK)
            if job is None:
                continue
            self.idle = False
            try:
                self._do(job)
            except (OSError, EOFError):
                self._drop()
                job.tell(JobFailed("The worker process ended unexpectedly; a new one is starting. Press again."))
            except Exception as error:  # A task that does not pickle, for example: the hand must live on.
                job.tell(JobFailed(f"The work could not be done: {error}"))
            self.idle = True
            self._pool.done(job)
            self._pool.spare()

    def close(self) -> None:
        self._closed = True
        self._drop()

    def _ready(self) -> "Connection[Any, Any]":
        """A live, warm process."""
        if self.pid is None or self._pipe is None:
            self._drop()
            context = get_context("spawn")
            pipe, theirs = context.Pipe()
            process = context.Process(target=serve, args=(theirs,), name=self.name, daemon=True)
            with _without_main():
                process.start()
            theirs.close()  # So that the pipe ends with the process.
            self._process, self._pipe = process, pipe
            if self._closed:
                self._drop()
            if not pipe.poll(_START):
                raise EOFError
            pipe.recv()
            return pipe
        return self._pipe

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
            if asked is not None and now - asked > PATIENCE:
                job.tell(JobEnded(None, stopped=True, late=late))
            if asked is not None and now - asked > GRACE:
                self._drop()
                return
            if not wait([pipe], 0.01):
                continue
            said: WorkerReply = pipe.recv()
            if said.number != job.number:
                continue
            if said.kind == "told":
                job.tell(JobProgress(said.item))
            elif said.kind == "done":
                job.tell(JobEnded(said.item, stopped=asked is not None, late=late))
                return
            else:
                job.tell(JobFailed(f"The work failed ({said.item})."))
                return

    def _drop(self) -> None:
        process, self._process = self._process, None
        pipe, self._pipe = self._pipe, None
        if process is not None and process.is_alive():
            process.kill()
            process.join(1.0)
        if pipe is not None:
            pipe.close()


@contextmanager
def _without_main() -> Generator[None]:
    """While this thread starts a process, do not have it import the main module, as `spawn` would.

    A worker needs nothing from there, and a script that calls `explorer.show` would otherwise run again in each worker.
    """
    with _starting:
        prepare, thread = spawn.get_preparation_data, threading.get_ident()

        def prepared(name: str) -> dict[str, Any]:
            data = prepare(name)
            if threading.get_ident() != thread:
                return data
            return {key: value for key, value in data.items() if not key.startswith("init_main")}

        spawn.get_preparation_data = prepared
        try:
            yield
        finally:
            spawn.get_preparation_data = prepare
