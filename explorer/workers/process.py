"""What runs in a worker process: it takes tasks from a pipe, one at a time, and tells what it finds. Knows no page."""

import os
import signal
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any, Protocol

for _threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_threads, "1")  # Nothing here has met NumPy yet: its BLAS makes no threads that only hinder.

_NICE = 5
"""Where processors are short, the frames of those who drag come before searches."""

Tell = Callable[[Any], None]
Stop = Callable[[], bool]


class Task(Protocol):
    """A value that pickles and can be run."""

    def run(self, tell: Tell, stop: Stop) -> Any:
        """Tells what it finds on the way; asks `stop` often, and returns what there is when it says True."""
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
    """An answer of the process: `kind` is ready, told, done or failed."""

    number: int
    kind: str
    item: Any = None


def serve(pipe: "Connection[Any, Any]") -> None:
    """The process's whole life: until the pipe closes, which it does when the page's server ends, however it ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the server to understand.
    if hasattr(os, "nice"):
        os.nice(_NICE)
    from explorer.workers import solver
    from rotor.blas_threads import keep_one_blas_thread

    keep_one_blas_thread()
    solver.warm()
    with suppress(EOFError, OSError):
        pipe.send(WorkerReply(0, "ready"))
        while True:
            order = pipe.recv()
            if isinstance(order, RunRequest):
                _work(pipe, order)


def _work(pipe: "Connection[Any, Any]", order: RunRequest) -> None:
    halted = False

    def stop() -> bool:
        nonlocal halted
        try:
            while not halted and pipe.poll():
                halted = pipe.recv() == StopRequest(order.number)
        except (EOFError, OSError):
            halted = True
        return halted

    def tell(item: Any) -> None:
        pipe.send(WorkerReply(order.number, "told", item))

    try:
        answer = WorkerReply(order.number, "done", order.task.run(tell, stop))
    except (EOFError, BrokenPipeError):
        raise
    except Exception as error:  # The process must survive whatever one task does.
        answer = WorkerReply(order.number, "failed", str(error) or type(error).__name__)
    pipe.send(answer)
