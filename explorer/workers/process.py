"""The worker process: takes tasks from a pipe, one at a time, and sends what they report. Without the page."""

import os
import signal
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any, Literal, Protocol

for _threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_threads, "1")  # Before NumPy is loaded: its BLAS then makes no threads, which only hinder.

_NICE = 5
"""Lower priority than the server, so that frames come before searches where processors are short."""

Tell = Callable[[Any], None]
Stop = Callable[[], bool]


class Task(Protocol):
    """A value that can be pickled and run."""

    def run(self, tell: Tell, stop: Stop) -> Any:
        """Report progress with `tell`; call `stop` often, and return what there is when it is True."""
        ...


@dataclass(frozen=True)
class RunRequest:
    number: int
    task: Task


@dataclass(frozen=True)
class StopRequest:
    number: int


@dataclass(frozen=True)
class WorkerReply:
    """What the process sends about the task of that number."""

    number: int
    kind: Literal["ready", "progress", "done", "failed"]
    item: Any = None


def serve(pipe: "Connection[Any, Any]") -> None:
    """The life of the process. It ends when the pipe closes, which it does however the server ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the server.
    if hasattr(os, "nice"):
        os.nice(_NICE)
    from explorer.workers import solver

    solver.warm()
    with suppress(EOFError, OSError):
        pipe.send(WorkerReply(0, "ready"))
        while True:
            request = pipe.recv()
            if isinstance(request, RunRequest):
                _run(pipe, request)


def _run(pipe: "Connection[Any, Any]", request: RunRequest) -> None:
    stopped = False

    def stop() -> bool:
        nonlocal stopped
        try:
            while not stopped and pipe.poll():
                stopped = pipe.recv() == StopRequest(request.number)
        except (EOFError, OSError):
            stopped = True
        return stopped

    def tell(item: Any) -> None:
        pipe.send(WorkerReply(request.number, "progress", item))

    try:
        reply = WorkerReply(request.number, "done", request.task.run(tell, stop))
    except (EOFError, BrokenPipeError):
        raise
    except Exception as error:  # The process must survive whatever a task does.
        reply = WorkerReply(request.number, "failed", str(error) or type(error).__name__)
    pipe.send(reply)
