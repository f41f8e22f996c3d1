"""How much a page may send and take: messages, uploads, sessions; and what goes to the log and back to the system.

What it may say is in `messages`. A failure that repeats is told a few times a minute, with the number of those left out
(`RepeatFilter`).
"""

import contextlib
import ctypes
import gc
import logging
import threading
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass

from rotor.support.bytes_cache import CACHE_BYTES

_COLLECT_AFTER_S = 5.0
"""[s] after a page has gone, so that pages that leave together are collected once."""
_TRIM_AFTER_S = 60.0
"""[s] after an update of a page: glibc keeps what updates have freed, and one page went on growing."""
_M_ARENA_MAX = -8
"""Option of `mallopt`, from glibc's malloc.h."""
_lock = threading.Lock()
_due = set[Callable[[], None]]()


def exclude_from_collection() -> None:
    """Exclude what is loaded by now from garbage collection: each pass over it held up all frames."""
    gc.collect()
    gc.freeze()


def limit_memory_pools() -> None:
    """Let all threads of this process take memory from two pools (glibc only); called before they begin.

    glibc makes up to eight for each processor, and each keeps what its threads have freed: with twenty pages a fifth of
    the memory, and it went on growing.
    """
    with contextlib.suppress(OSError, AttributeError, TypeError):
        ctypes.CDLL(None).mallopt(_M_ARENA_MAX, 2)


def release_memory_soon() -> None:
    """Call `release_memory` after a pause, once for all calls until then."""
    _call_soon(release_memory, _COLLECT_AFTER_S)


def trim_memory_soon() -> None:
    """Call `trim_memory` after a pause, once for all calls until then."""
    _call_soon(trim_memory, _TRIM_AFTER_S)


def _call_soon(call: Callable[[], None], pause: float) -> None:
    with _lock:
        if call in _due:
            return
        _due.add(call)

    def begin() -> None:
        with _lock:
            _due.discard(call)
        call()

    timer = threading.Timer(pause, begin)
    timer.name, timer.daemon = "give-back", True
    timer.start()


def release_memory() -> None:
    """Collect the reference cycles of pages that have gone, and return free memory to the system."""
    gc.collect()
    trim_memory()


def trim_memory() -> None:
    """Return free memory to the system: glibc keeps it in its pools, other systems return it by themselves."""
    with contextlib.suppress(OSError, AttributeError, TypeError):
        ctypes.CDLL(None).malloc_trim(0)


SESSIONS = 24
"""Pages at work by default: a class."""
_SPARE_CONNECTIONS = 40
"""Connections beyond the pages at work: pages that were turned away, or have only just connected."""


@dataclass(frozen=True)
class ServerLimits:
    sessions: int = SESSIONS
    """Pages at work at once."""
    allow_hosts: tuple[str, ...] = ()
    frame_ancestors: tuple[str, ...] = ()
    """Origins of other pages that may show this one in a frame, such as a notebook's."""
    cache_bytes: int = CACHE_BYTES
    """What the server keeps to be fast, and each of its worker processes: `rotor.support.bytes_cache`."""

    @property
    def connections(self) -> int:
        """WebSockets at once."""
        return 2 * self.sessions + _SPARE_CONNECTIONS


@dataclass(frozen=True)
class RateLimit:
    """A token bucket: it holds `burst` and fills by `rate` per second."""

    rate: float
    burst: float


MESSAGES = RateLimit(rate=200.0, burst=2000.0)
"""A dragged slider sends 20 a second, a turned camera 50; a tab that slept may send more at once."""
FRAMES = RateLimit(rate=1000.0, burst=10_000.0)
"""Frames of the connection: a message may come in parts, without end where nobody counts them."""
BYTES = RateLimit(rate=2e6, burst=48e6)
"""A file too large by mistake is refused with a sentence (`refuse_upload`) before this limit ends its connection."""
LARGEST_MESSAGE = 16 * 2**20
"""[bytes]; the largest honest message is a picture of the scene drawn by the browser."""


class RateLimiter:
    """The token buckets of one connection."""

    def __init__(self, now: float, messages: RateLimit = MESSAGES, size: RateLimit = BYTES) -> None:
        self._buckets = [[messages, messages.burst], [size, size.burst]]
        self._then = now

    def allows(self, size: int, now: float) -> bool:
        """Count a message of `size` bytes that came at `now` [s]; False when that is more than is allowed."""
        since, self._then = max(now - self._then, 0.0), now
        within = True
        for bucket, cost in zip(self._buckets, (1.0, float(size)), strict=True):
            limit, left = bucket
            bucket[1] = min(left + since * limit.rate, limit.burst) - cost
            within = within and bucket[1] >= 0.0
        return within


LARGEST_FILE = 4 * 2**20
"""[bytes]; ten times the largest published table of section data."""
_UPLOAD_PARTS = 64
"""The page sends parts of half a megabyte. A million small parts would take a hundred times their size in memory."""
UPLOADS_AT_ONCE = 2
"""Files on their way from one page."""


def refuse_upload(name: str, size: int, parts: int, under_way: int, accepts: str) -> str | None:
    """Why a file is refused, in one sentence; None where it is accepted. `accepts`: as in HTML, ".json,.toml" or "*/*".

    The page's server keeps every part in memory until the last has come, and accepts whatever size is claimed.
    """
    shown = repr(name if len(name) <= 60 else name[:57] + "…")
    if size > LARGEST_FILE:
        return f"{shown} has {size / 2**20:.1f} MB: {LARGEST_FILE // 2**20} MB are allowed."
    # Types without a dot say nothing about names.
    endings = [item.strip().lower() for item in accepts.split(",")]
    if not any(not item.startswith(".") or name.lower().endswith(item) for item in endings):
        return f"{shown} is not a supported type: choose a {accepts.replace(',', ' or ')} file."
    if under_way >= UPLOADS_AT_ONCE:
        return f"{shown} must wait for the files before it: try again when they have arrived."
    if size < 0 or not 0 <= parts <= _UPLOAD_PARTS:
        return f"{shown} comes in {parts} parts: {_UPLOAD_PARTS} are allowed."
    return None


_MOST, _WINDOW = 3, 60.0
"""Records of one kind, within so many seconds."""
_COUNTED_KINDS = 200
"""Kinds that are counted at once."""


class RepeatFilter(logging.Filter):
    """Lets few records of a kind pass within a minute; the next one that passes says how many did not."""

    def __init__(self, most: int = _MOST, window: float = _WINDOW) -> None:
        super().__init__()
        self._most, self._window = most, window
        self._lock = threading.Lock()
        self._seen: OrderedDict[tuple[str, int, str], tuple[float, int]] = OrderedDict()
        """Begin of the window and number of records by kind: logger, line of code, type of the error."""

    def filter(self, record: logging.LogRecord) -> bool:
        error = record.exc_info[0] if record.exc_info else None
        kind = (record.name, record.lineno, error.__name__ if error else "")
        now = time.monotonic()
        with self._lock:
            begun, count = self._seen.pop(kind, (now, 0))
            skipped = 0
            if now - begun > self._window:
                skipped, begun, count = max(count - self._most, 0), now, 0
            self._seen[kind] = (begun, count + 1)
            if len(self._seen) > _COUNTED_KINDS:
                self._seen.popitem(last=False)
        if skipped:
            record.msg = f"{record.msg} ({skipped} more like this were not written)"
        return count < self._most


def limit_log() -> None:
    handlers = logging.getLogger().handlers or ([logging.lastResort] if logging.lastResort else [])
    for handler in handlers:
        if not any(isinstance(known, RepeatFilter) for known in handler.filters):
            handler.addFilter(RepeatFilter())
