"""Processes of this machine: one way to start and to end them, for commands, studies and the page.

A process ends with its parent, however that one ends. It leaves Ctrl-C to its parent, keeps BLAS to one thread, and
does not run the caller's script again. Parent and process talk through a pipe and share no semaphore, so a parent that
is killed leaves none in the system.

`concurrent.futures.ProcessPoolExecutor` (and loky, which is built on it) was tried and does not do: its processes go on
when their parent is killed, one lost process breaks them all, it cannot end a task that ignores its stop, and the
interpreter waits for running tasks at exit (8 s measured for a task of 8 s).
"""

import os
import pickle
import signal
import sys
import threading
import traceback
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from importlib.machinery import ModuleSpec
from multiprocessing import Pipe, get_context, parent_process
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess
from queue import Empty, SimpleQueue
from typing import Any, Literal

from rotor.blas_threads import keep_one_blas_thread

Tell = Callable[[Any], None]
Stop = Callable[[], bool]
Work = Callable[..., Iterator[Any]]
"""work(*arguments, stop) yields items."""

_LOOK = 0.1
"""[s] between the questions whether to stop."""
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_one_at_a_time = threading.Lock()


class WorkerLost(BrokenExecutor):
    """A process ended unexpectedly; what it delivered before is kept."""

    def __init__(self) -> None:
        super().__init__(
            "A worker process was lost, perhaps for lack of memory; results so far are kept: use fewer processes."
        )


def start_process(work: Callable[..., None], arguments: tuple[Any, ...], name: str) -> SpawnProcess:
    """Start work(*arguments), a function of an importable module, in a daemonic process of that name."""
    process = get_context("spawn").Process(target=_work, args=(work, arguments), name=name, daemon=True)
    with _one_at_a_time, _inherited():
        process.start()
    return process


@contextmanager
def _inherited() -> Generator[None]:
    """What a new process takes over from this one.

    A main module without a name: a process imports that of its parent, and a script that opens a page, and has no
    `if __name__ == "__main__"`, would open it again there. SIGINT blocked: Ctrl-C in a terminal reaches all processes,
    also one that has just begun. A BLAS that makes no threads when it is loaded.
    """
    main = sys.modules["__main__"]
    spec, main.__spec__ = main.__spec__, ModuleSpec("__main__", None)
    unset = [name for name in _THREADS if name not in os.environ]
    os.environ.update(dict.fromkeys(unset, "1"))
    mask: set[int] | None = None
    if hasattr(signal, "pthread_sigmask"):
        from multiprocessing.resource_tracker import ensure_running

        ensure_running()  # The first process starts it, which lifts the block.
        mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        if mask is not None:
            signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        for name in unset:
            del os.environ[name]
        main.__spec__ = spec


def _work(work: Callable[..., None], arguments: tuple[Any, ...]) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    keep_one_blas_thread()
    work(*arguments)


def _end_with_parent() -> None:
    parent = parent_process()
    assert parent is not None
    wait([parent.sentinel])
    os._exit(1)


@dataclass(frozen=True)
class _Request:
    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    keywords: dict[str, Any]
    streams: bool
    """Whether the function is also given `tell` and `stop`."""
    number: int


@dataclass(frozen=True)
class Reply:
    kind: Literal["item", "result", "error"]
    value: Any
    """What the function told or returned, or the exception that it raised."""
    number: int = 0
    """Number of the call; 0 where the request could not be read."""


class WorkerProcess:
    """A process that makes one call after the other. Its methods raise EOFError or OSError once it is lost."""

    def __init__(self, name: str) -> None:
        self._pipe, theirs = Pipe()
        self._process = start_process(_serve, (theirs,), name)
        theirs.close()  # So that the pipe ends with the process.
        self._number = 0
        """Number of the last call."""

    @property
    def pid(self) -> int | None:
        """Number of the process while it runs."""
        return self._process.pid if self._process.is_alive() else None

    def call(self, function: Callable[..., Any], *arguments: Any, **keywords: Any) -> None:
        """Begin function(*arguments, **keywords)."""
        self._begin(function, arguments, keywords, streams=False)

    def stream(self, function: Callable[..., Any], *arguments: Any) -> None:
        """Begin function(*arguments, tell, stop): each `tell(item)` is a reply, `stop()` is True once asked for."""
        self._begin(function, arguments, {}, streams=True)

    def _begin(self, function: Callable[..., Any], arguments: Any, keywords: dict[str, Any], *, streams: bool) -> None:
        self._pipe.send(_Request(function, arguments, keywords, streams, self._number + 1))
        self._number += 1

    def ask_to_stop(self) -> None:
        self._pipe.send(None)

    def receive(self, seconds: float | None) -> Reply | None:
        """The next reply to the last call; None if none came in time, or one to a call that was given up."""
        reply: Reply | None = self._pipe.recv() if self._pipe.poll(seconds) else None
        return reply if reply is not None and reply.number in (0, self._number) else None

    def kill(self) -> None:
        self._process.kill()
        self._process.join(1.0)

    def close(self) -> None:
        self.kill()
        self._pipe.close()


def _serve(pipe: "Connection[Any, Any]") -> None:
    """What a `WorkerProcess` does until its pipe closes."""
    with suppress(EOFError, OSError):
        while True:
            try:
                request: _Request | None = pipe.recv()
            except (EOFError, OSError):
                raise
            except Exception as error:  # Names a function, for example, that is not here.
                _send_error(pipe, error)
                continue
            if request is not None:  # Else the stop of a call that was done meanwhile.
                _answer(pipe, request)


def _answer(pipe: "Connection[Any, Any]", request: _Request) -> None:
    stopped = False

    def stop() -> bool:
        nonlocal stopped
        while not stopped and pipe.poll():
            stopped = pipe.recv() is None
        return stopped

    def tell(item: Any) -> None:
        pipe.send(Reply("item", item, request.number))

    more = (tell, stop) if request.streams else ()
    try:
        value = request.function(*request.arguments, *more, **request.keywords)
        pipe.send(Reply("result", value, request.number))
    except BrokenPipeError:
        raise
    except Exception as error:  # The process goes on whatever a function does.
        _send_error(pipe, error, request.number)


def _send_error(pipe: "Connection[Any, Any]", error: Exception, number: int = 0) -> None:
    error.add_note(traceback.format_exc())
    try:
        pickle.loads(pickle.dumps(error))
    except Exception:  # Some exceptions cannot be pickled, or cannot be made again from what was.
        error = RuntimeError(f"{type(error).__name__}: {error}")
    pipe.send(Reply("error", error, number))


@dataclass(frozen=True, eq=False)
class _Call:
    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    keywords: dict[str, Any]
    tell: Tell | None = None
    stopping: threading.Event = field(default_factory=threading.Event)
    future: Future[Any] = field(default_factory=Future[Any])


class Processes(Executor):
    """So many processes of this machine as an executor. A lost one costs its own call, and is replaced."""

    def __init__(self, count: int) -> None:
        self._calls: SimpleQueue[_Call | None] = SimpleQueue()
        self._workers: dict[str, WorkerProcess] = {}
        self._change = threading.Lock()
        self._closed = self._killed = False
        self._threads = [threading.Thread(target=self._feed, args=(f"worker-{k}",), daemon=True) for k in range(count)]
        for thread in self._threads:
            thread.start()

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        return self._enter(_Call(fn, args, kwargs))

    def stream(self, tasks: Sequence[tuple[Work, tuple[Any, ...]]], deliver: Tell, stop: Stop | None = None) -> bool:
        """Run tasks and deliver their items in this thread as they come; True when stopped before the end.

        `stop` is called several times a second. Raises WorkerLost, and what a task raises.
        """
        items: SimpleQueue[Any] = SimpleQueue()
        stopping = threading.Event()
        calls = [_Call(_yielded, task, {}, items.put, stopping) for task in tasks]
        try:
            waiting = [self._enter(call) for call in calls]
            while waiting:
                ended = [future for future in waiting if future.done()]  # Before the items: none comes after the end.
                with suppress(Empty):
                    deliver(items.get(timeout=0.0 if ended else _LOOK))
                    while True:
                        deliver(items.get_nowait())
                for future in ended:
                    if not future.cancelled():
                        future.result()
                waiting = [future for future in waiting if future not in ended]
                if waiting and stop is not None and not stopping.is_set() and stop():
                    stopping.set()
                    waiting = [future for future in waiting if not future.cancel()]
            return stopping.is_set()
        finally:
            stopping.set()
            for call in calls:
                call.future.cancel()

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End the processes after the calls made so far; with `cancel_futures` at once, also in the midst of a call."""
        with self._change:
            self._killed |= cancel_futures
            if not self._closed:
                self._closed = True
                for _ in self._threads:
                    self._calls.put(None)
            if self._killed:
                for worker in self._workers.values():
                    worker.kill()
        if wait:
            for thread in self._threads:
                thread.join()

    def __exit__(self, error: type[BaseException] | None, *_: object) -> None:
        self.shutdown(cancel_futures=error is not None)

    def _enter(self, call: _Call) -> Future[Any]:
        with self._change:
            if self._closed:
                raise RuntimeError("these processes have been shut down")
            self._calls.put(call)
        return call.future

    def _feed(self, name: str) -> None:
        """What the thread of each process does."""
        while (call := self._calls.get()) is not None:
            if self._killed:
                call.future.cancel()
            if not call.future.set_running_or_notify_cancel():
                continue
            try:
                reply = self._run(call, self._worker(name))
            except (EOFError, OSError):
                self._drop(name)
                reply = Reply("error", WorkerLost())
            except Exception as error:  # Arguments, for example, that cannot be pickled.
                reply = Reply("error", error)
            if reply.kind == "result":
                call.future.set_result(reply.value)
            else:
                call.future.set_exception(reply.value)
        self._drop(name)

    def _run(self, call: _Call, worker: WorkerProcess) -> Reply:
        if call.tell is None:
            worker.call(call.function, *call.arguments, **call.keywords)
        else:
            worker.stream(call.function, *call.arguments)
        try:
            return self._reply_of(call, worker)
        except Exception:  # What hears of its items failed: the process is still at this call.
            worker.kill()
            raise

    @staticmethod
    def _reply_of(call: _Call, worker: WorkerProcess) -> Reply:
        asked = False
        while True:
            if call.stopping.is_set() and not asked:
                asked = True
                worker.ask_to_stop()
            reply = worker.receive(None if call.tell is None else _LOOK)
            if reply is not None and reply.kind != "item":
                return reply
            if reply is not None and call.tell is not None:
                call.tell(reply.value)

    def _worker(self, name: str) -> WorkerProcess:
        if name in self._workers and self._workers[name].pid is None:  # Lost while idle.
            self._drop(name)
        if name not in self._workers:
            worker = WorkerProcess(name)
            with self._change:
                self._workers[name] = worker
                if self._killed:
                    worker.kill()
        return self._workers[name]

    def _drop(self, name: str) -> None:
        with self._change:
            worker = self._workers.pop(name, None)
        if worker is not None:
            worker.close()


def _yielded(work: Work, arguments: tuple[Any, ...], tell: Tell, stop: Stop) -> None:
    for item in work(*arguments, stop):
        tell(item)


def run_tasks(
    pool: Processes | None, tasks: Sequence[tuple[Work, tuple[Any, ...]]], deliver: Tell, stop: Stop | None
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
