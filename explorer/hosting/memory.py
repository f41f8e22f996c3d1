"""What a server does about memory that nobody needs any more, so that it shrinks again after a crowd."""

import contextlib
import ctypes
import gc
import threading

_PAUSE = 5.0
"""[s] after a page has gone, so that a class that leaves is cleared away in one go."""
_lock = threading.Lock()
_due: threading.Timer | None = None


def settle() -> None:
    """What is loaded by now stays: looking through it for waste took 90 ms each time, in which no frame was made."""
    gc.collect()
    gc.freeze()


def give_back_soon(pause: float = _PAUSE) -> None:
    """Some page has gone, or sleeps: `give_back` after `pause` [s], once for all that go meanwhile."""
    global _due
    with _lock:
        if _due is None:
            _due = threading.Timer(pause, give_back)
            _due.name, _due.daemon = "give-back", True
            _due.start()


def give_back() -> None:
    """Collect what pages that left held in circles, and return free memory to the system."""
    global _due
    with _lock:
        _due = None
    gc.collect()
    # glibc keeps what is freed for later, in one pool a thread; other systems return it by themselves.
    with contextlib.suppress(OSError, AttributeError, TypeError):
        ctypes.CDLL(None).malloc_trim(0)
