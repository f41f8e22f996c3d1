"""Returns memory to the system when pages have gone."""

import contextlib
import ctypes
import gc
import threading

_PAUSE = 5.0
"""[s] after a page has gone, so that pages that leave together are collected once."""
_lock = threading.Lock()
_due: threading.Timer | None = None


def settle() -> None:
    """Exclude what is loaded by now from garbage collection: each pass over it took 90 ms, without a frame."""
    gc.collect()
    gc.freeze()


def give_back_soon(pause: float = _PAUSE) -> None:
    """Call `give_back` after `pause` [s], once for all calls until then."""
    global _due
    with _lock:
        if _due is None:
            _due = threading.Timer(pause, give_back)
            _due.name, _due.daemon = "give-back", True
            _due.start()


def give_back() -> None:
    """Collect the reference cycles of pages that have gone, and return free memory to the system."""
    global _due
    with _lock:
        _due = None
    gc.collect()
    # glibc keeps freed memory in one pool per thread; other systems return it by themselves.
    with contextlib.suppress(OSError, AttributeError, TypeError):
        ctypes.CDLL(None).malloc_trim(0)
