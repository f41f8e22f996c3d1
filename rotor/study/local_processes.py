"""Processes of this machine for the chunks of a study, with the interface of a Dask client as far as `cluster` uses it.

They are reached by pipes, which only this program holds. An embedded Dask cluster would listen on ports without
authentication and execute what any user of the machine sends there.
"""

import os
import signal
import threading
from collections.abc import Callable
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context, parent_process
from typing import Any

from rotor.blas_threads import keep_one_blas_thread


class LocalFuture:
    """One submitted call."""

    def __init__(self, future: Future[Any]) -> None:
        self._future = future

    @property
    def status(self) -> str:
        """As Dask names it: finished, error, cancelled, or pending."""
        if not self._future.done():
            return "pending"
        if self._future.cancelled():
            return "cancelled"
        return "error" if self._future.exception() is not None else "finished"

    def result(self) -> Any:
        return self._future.result()

    def exception(self) -> BaseException | None:
        return self._future.exception()

    def add_done_callback(self, tell: Callable[["LocalFuture"], None]) -> None:
        self._future.add_done_callback(lambda _: tell(self))

    def cancel(self) -> None:
        self._future.cancel()

    def release(self) -> None:
        """Nothing is kept beyond the future itself."""


class LocalProcesses:
    """So many processes; they end with this one, however it ends."""

    def __init__(self, processes: int) -> None:
        self._processes = processes
        self._pool = self._start()

    def nthreads(self) -> dict[str, int]:
        """Calls at once, by worker."""
        return {"this machine": self._processes}

    def submit(self, function: Callable[..., Any], *arguments: Any, key: str = "", pure: bool = False) -> LocalFuture:
        """Call `function` in some process. `key` and `pure` are Dask's, and not needed here."""
        del key, pure
        try:
            return LocalFuture(self._pool.submit(function, *arguments))
        except BrokenProcessPool:  # A process was killed, with which the others end too.
            self._pool = self._start()
            return LocalFuture(self._pool.submit(function, *arguments))

    def close(self) -> None:
        """End the processes, after the calls they are in."""
        self._pool.shutdown(cancel_futures=True)

    def _start(self) -> ProcessPoolExecutor:
        return ProcessPoolExecutor(self._processes, get_context("spawn"), initializer=_begin)


def _begin() -> None:
    """Initialise a process: Ctrl-C is left to the parent, and a parent that was killed ends it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    keep_one_blas_thread()
    threading.Thread(target=_end_with_parent, name="parent", daemon=True).start()


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
