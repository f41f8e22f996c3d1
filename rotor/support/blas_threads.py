"""One BLAS thread while a rotor is solved, and Ctrl-C within a kernel as the KeyboardInterrupt that it is.

The linear systems have six to a few hundred unknowns, where BLAS threads cost ten times what they save. The limit holds
only inside the context, so importing or using `rotor` leaves the caller's setting as it was.
"""

import importlib
import threading
from collections.abc import Generator
from contextlib import contextmanager
from functools import cache
from typing import Any

from threadpoolctl import ThreadpoolController  # pyright: ignore[reportMissingTypeStubs]

from rotor.support.user_input import raise_interrupt

_lock = threading.Lock()
_users = 0
"""Threads inside `one_blas_thread` now."""
_before: list[int] = []
"""Threads of each library with one pool for the process, before the first of them."""


@contextmanager
def one_blas_thread() -> Generator[None]:
    """Limit BLAS to one thread; nested and concurrent uses share the limit, and the last to leave restores the setting.

    Use it in a `with` or as a decorator. It takes some 7 µs. The context of threadpoolctl takes 11 µs, and restores a
    wrong setting where two threads overlap.
    """
    global _users
    shared, per_thread = _libraries()
    counts = [library.get_num_threads() for library in per_thread]
    _set(per_thread, [1] * len(counts))
    with _lock:
        if _users == 0:
            _before[:] = [library.get_num_threads() for library in shared]
            _set(shared, [1] * len(_before))
        _users += 1
    try:
        yield
    except SystemError as error:
        raise_interrupt(error)
        raise
    finally:
        with _lock:
            _users -= 1
            if _users == 0:
                _set(shared, _before)
        _set(per_thread, counts)


def keep_one_blas_thread() -> None:
    """Limit BLAS to one thread from now on: for a process of our own, such as a command or a worker."""
    for libraries in _libraries():
        _set(libraries, [1] * len(libraries))


@cache
def _libraries() -> tuple[list[Any], list[Any]]:
    """The BLAS libraries that NumPy and SciPy have loaded: with one pool for the process, and with one per thread."""
    # The controller finds only the libraries that are loaded by now.
    importlib.import_module("scipy.linalg")
    controller: Any = ThreadpoolController()
    libraries: list[Any] = controller.select(user_api="blas").lib_controllers
    per_thread = [
        library for library in libraries if getattr(library, "threading_layer", "") == "openmp"
    ]
    return [library for library in libraries if library not in per_thread], per_thread


def _set(libraries: list[Any], threads: list[int]) -> None:
    for library, number in zip(libraries, threads, strict=True):
        if library.get_num_threads() != number:
            # Since 3.8 threadpoolctl ignores all threads but the first that sets a limit, until it is told otherwise.
            if hasattr(library, "clear_controlling_thread"):
                library.clear_controlling_thread(force=True)
            library.set_num_threads(number)
            if hasattr(library, "clear_controlling_thread"):
                library.clear_controlling_thread(force=True)
