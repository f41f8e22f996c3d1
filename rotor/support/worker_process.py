"""Processes of this machine: one way to start and to end them, and what one does for its parent.

A process ends with its parent, however that one ends. It leaves Ctrl-C to its parent, keeps BLAS to one thread, and
does not run the caller's script again. Parent and process talk through a pipe and share no semaphore, so a parent that
is killed leaves none in the system.
"""

import os
import pickle
import signal
import sys
import threading
import traceback
from collections.abc import Callable, Generator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from importlib.machinery import ModuleSpec
from multiprocessing import Pipe, get_context, parent_process
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess
from typing import Any, Literal, Protocol

from rotor.support.blas_threads import keep_one_blas_thread

Tell = Callable[[Any], None]
Stop = Callable[[], bool]

_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_one_at_a_time = threading.Lock()


class Task(Protocol):
    """A value that can be pickled and run."""

    def run(self, tell: Tell, stop: Stop) -> Any:
        """Report progress with `tell`; call `stop` often, and return what there is when it is True."""
        ...


def start_process(work: Callable[..., None], arguments: tuple[Any, ...], name: str) -> SpawnProcess:
    """Start work(*arguments), a function of an importable module, in a daemonic process of that name."""
    process = get_context("spawn").Process(
        target=_work, args=(work, arguments), name=name, daemon=True
    )
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
    for name in unset:  # Not in os.environ, which other threads may be reading.
        os.putenv(name, "1")
    mask: set[int] | None = None
    if hasattr(signal, "pthread_sigmask"):
        from multiprocessing.resource_tracker import ensure_running

        ensure_running()  # Else the first process would start it, and that lifts the block.
        mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        if mask is not None:
            signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        for name in unset:
            os.unsetenv(name)
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
    task: Task
    number: int


@dataclass(frozen=True)
class Reply:
    kind: Literal["item", "result", "error"]
    value: Any
    """What the task told or returned, or the exception that it raised."""
    number: int = 0
    """Number of the task; 0 where the request could not be read."""


class WorkerProcess:
    """A process that does one task after the other. Its methods raise EOFError or OSError once it is lost."""

    def __init__(self, name: str) -> None:
        self._pipe, theirs = Pipe()
        self._process = start_process(_serve, (theirs,), name)
        theirs.close()  # So that the pipe ends with the process.
        self._number = 0
        """Number of the last task."""

    @property
    def pid(self) -> int | None:
        """Number of the process while it runs."""
        return self._process.pid if self._process.is_alive() else None

    def begin(self, task: Task) -> None:
        """Begin a task: each `tell(item)` of it is a reply, `stop()` is True once asked for."""
        self._pipe.send(_Request(task, self._number + 1))
        self._number += 1

    def ask_to_stop(self) -> None:
        self._pipe.send(None)

    def receive(self, seconds: float | None) -> Reply | None:
        """The next reply to the last task within so many seconds; None without one, or for a task that was given up."""
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
            if request is not None:  # Otherwise it stops a task that has ended meanwhile.
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

    try:
        pipe.send(Reply("result", request.task.run(tell, stop), request.number))
    except BrokenPipeError:
        raise
    except Exception as error:  # The process goes on whatever a task does.
        _send_error(pipe, error, request.number)


def _send_error(pipe: "Connection[Any, Any]", error: Exception, number: int = 0) -> None:
    error.add_note(traceback.format_exc())
    try:
        pickle.loads(pickle.dumps(error))
    except Exception:  # Some exceptions cannot be pickled or unpickled.
        error = RuntimeError(f"{type(error).__name__}: {error}")
    pipe.send(Reply("error", error, number))
