"""One BLAS thread while the solver runs: on systems of a few unknowns, threads cost ten times what they save.

The limit is the process's own setting, so it is put back when the outermost computation ends.
"""

import importlib
import threading
from collections.abc import Generator
from contextlib import contextmanager
from functools import cache
from typing import Any

from threadpoolctl import ThreadpoolController  # pyright: ignore[reportMissingTypeStubs]

_lock = threading.Lock()
_running = 0
"""Computations in progress, on all threads."""
_limit: Any = None
"""What the first of them put in place."""


@cache
def _controller() -> Any:
    importlib.import_module("scipy.linalg")  # The controller knows only the BLAS libraries that are loaded by now.
    return ThreadpoolController()


@contextmanager
def one_blas_thread() -> Generator[None]:
    """Keep BLAS to one thread inside the block, or inside a function decorated with it."""
    global _running, _limit
    with _lock:
        if _running == 0:
            _limit = _controller().limit(limits=1, user_api="blas")
        _running += 1
    try:
        yield
    finally:
        with _lock:
            _running -= 1
            if _running == 0:
                _limit.restore_original_limits()


def keep_one_blas_thread() -> None:
    """Keep BLAS to one thread from now on: for a process of our own, such as a command or a worker."""
    _controller().limit(limits=1, user_api="blas")
