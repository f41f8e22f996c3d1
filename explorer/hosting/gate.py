"""What a page may say, and how much: presses, values, uploads, messages, sessions; and what goes to the log and the
system.

`message_fault` looks at each message of viser's, `checked_press` at what our scripts send through the bridge: a table
says which names there are, and what comes with each. What is dropped is told in the log, a few times a minute with the
number of those left out (`RepeatFilter`).
"""

import contextlib
import ctypes
import gc
import json
import logging
import math
import re
import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rotor.user_input import brief

LONGEST_TEXT = 20_000
"""Characters of a text field."""
LONGEST_PRESS = 300
"""Characters of a press: name and value as JSON."""
LARGEST = 1e15
"""No number of a page is larger."""
_ITEMS, _DEPTH = 10_000, 6
_FREE = frozenset(("content", "payload", "value"))
"""Fields of other lengths: parts of a file, pictures, and what the browser kept, which have limits of their own."""
_log = logging.getLogger(__name__)

Check = Callable[[Any], Any]
"""The value as the action takes it; ValueError where it cannot."""


def is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < LARGEST


def message_fault(fields: Mapping[str, Any]) -> str:
    """What is wrong with the fields of a message; empty where nothing is."""
    for name, value in fields.items():
        if name not in _FREE and not _is_plain(value, _DEPTH):
            return f"{name} is {brief(repr(value)[:200])}"
    return ""


def dropped(what: str) -> None:
    """Tell that something was dropped."""
    _log.warning("dropped from a page: %s", what)


def _is_plain(value: Any, depth: int) -> bool:
    if isinstance(value, (dict, list, tuple)):
        parts = [*value, *value.values()] if isinstance(value, dict) else value
        return depth > 0 and len(parts) <= _ITEMS and all(_is_plain(part, depth - 1) for part in parts)
    if isinstance(value, (str, bytes)):
        return len(value) <= LONGEST_TEXT
    return value is None or isinstance(value, bool) or is_number(value)


def _nothing(value: Any) -> None:
    """A press, whose name says it all: it has no value."""


def _flag(value: Any) -> bool:
    if not isinstance(value, bool):
        raise ValueError("neither true nor false")
    return value


def _number(low: float, high: float) -> Check:
    def check(value: Any) -> float:
        size: Any = value
        if isinstance(value, str) and re.fullmatch("[0-9.]{1,8}", value):  # A button has it as text.
            size = float(value)
        if not is_number(size) or not low <= size <= high:
            raise ValueError(f"no number between {low:g} and {high:g}")
        return float(size)

    return check


def _count(value: Any) -> int:
    """A place in a list; a button has it as text."""
    count: Any = value
    if isinstance(value, str):
        count = int(value) if re.fullmatch("[0-9]{1,6}", value) else -1
    if not is_number(count) or count != math.floor(count) or not 0 <= count < 1e6:
        raise ValueError("no place in a list")
    return int(count)


def _text(value: Any) -> str:
    if not isinstance(value, str) or len(value) > 100:
        raise ValueError("no short text")
    return value


def _word(*words: str) -> Check:
    def check(value: Any) -> str:
        if value not in words:
            raise ValueError(f"none of {', '.join(words)}")
        return str(value)

    return check


def _row(*checks: Check) -> Check:
    def check(value: Any) -> list[Any]:
        if not isinstance(value, list) or len(value) != len(checks):
            raise ValueError(f"not {len(checks)} values")
        return [check(part) for check, part in zip(checks, value, strict=True)]

    return check


def _some(check: Check, most: int) -> Check:
    def each(value: Any) -> list[Any]:
        if not isinstance(value, list) or not 0 < len(value) <= most:
            raise ValueError(f"not 1 to {most} values")
        return [check(part) for part in value]

    return each


def _either(*checks: Check) -> Check:
    def check(value: Any) -> Any:
        reasons: list[str] = []
        for check in checks:
            try:
                return check(value)
            except ValueError as error:
                reasons.append(str(error))
        raise ValueError("; ".join(reasons))

    return check


def _none(value: Any) -> None:
    if value is not None:
        raise ValueError("not empty")


_radius, _hand = _number(0.0, 1.0), _word("start", "end")
PRESSES: dict[str, Check] = {
    **dict.fromkeys(
        ("pin", "swap", "back", "undo", "redo", "times", "pace", "play", "against", "apply", "discard",
         "halt", "nearest", "aim", "beat", "rival_take", "rival_end"),
        _nothing,
    ),
    **dict.fromkeys(("along", "hold"), _flag),
    **dict.fromkeys(("field", "region", "mode", "drawer", "task", "opened", "rotor", "flown", "default"), _text),
    **dict.fromkeys(("story", "guess", "stop", "dial_front"), _count),
    **dict.fromkeys(("grab_at", "twist_by_hand"), _radius),
    "ride": _either(_word("off"), _row(_radius, _number(-3600.0, 3600.0)), _nothing),
    "azimuth": _number(-3600.0, 3600.0),
    "fly": _number(0.0, 100.0),
    "suppose": _either(_word("on", "off"), _row(_number(0.0, 90.0), _number(0.001, 1e4))),
    "speed": _number(0.0, 1.0),
    "land_at": _row(_radius, _radius),
    "pull": _either(_none, _number(-10.0, 10.0)),
    "wiped": _number(-1.0, 2.0),
    "covered": _row(_number(-10.0, 10.0), _number(-10.0, 10.0)),
    **dict.fromkeys(("difference", "more"), _word("on", "off")),
    "landscape": _word("on"),
    "view": _word("actuator", "3d", "disk", "blade", "top", "side"),
    "colours": _word("Rescale", "Default"),
    "lecture": _word("back", "next", "end"),
    "idle": _row(_count, _flag),
    "knot": _row(
        _text, _either(_hand, _word("undo"), _row(_either(_none, _number(-2.0, 2.0)), _number(-360.0, 360.0)))
    ),
    "dial": _either(_hand, _some(_row(_count, _number(0.0, 90.0), _number(-3600.0, 3600.0)), 9)),
}  # fmt: skip
"""Every press of the page's scripts, and what its value must be."""


def checked_press(text: Any) -> tuple[str, Any] | None:
    """Name and value of a press; None, and a line in the log, for what no page of ours sends."""
    try:
        if not isinstance(text, str) or len(text) > LONGEST_PRESS:
            raise ValueError("it is too long")
        serial, name, value = json.loads(text)
        if not is_number(serial) or not isinstance(name, str) or name not in PRESSES:
            raise ValueError("no such press")
        return name, PRESSES[name](value)
    except (ValueError, TypeError, RecursionError) as error:
        dropped(f"press {brief(repr(text)[:80])}: {error}")
        return None


_PAUSE = 5.0
"""[s] after a page has gone, so that pages that leave together are collected once."""
_M_ARENA_MAX = -8
"""Option of `mallopt`, from glibc's malloc.h."""
_lock = threading.Lock()
_due: threading.Timer | None = None


def exclude_from_collection() -> None:
    """Exclude what is loaded by now from garbage collection: each pass over it took 90 ms, without a frame."""
    gc.collect()
    gc.freeze()


def few_pools() -> None:
    """Let all threads of this process take memory from two pools (glibc only); called before they begin.

    glibc makes up to eight for each processor, and each keeps what its threads have freed: with twenty pages a fifth of
    the memory, and it went on growing.
    """
    with contextlib.suppress(OSError, AttributeError, TypeError):
        ctypes.CDLL(None).mallopt(_M_ARENA_MAX, 2)


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


SESSIONS = 24
"""Pages at work by default: a class. Each takes some 8 MB; with all of them dragging each gets a frame a second."""
_SPARE = 40
"""Connections beyond the pages at work: pages that were turned away, or have only just connected."""


@dataclass(frozen=True)
class ServerLimits:
    sessions: int = SESSIONS
    """Pages at work at once."""
    allow_hosts: tuple[str, ...] = ()
    frame_ancestors: tuple[str, ...] = ()
    """Origins of other pages that may show this one in a frame, such as a notebook's."""

    @property
    def connections(self) -> int:
        """WebSockets at once."""
        return 2 * self.sessions + _SPARE


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
_PARTS = 64
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
    if not _is_accepted(name, accepts):
        return f"{shown} is not a supported type: choose a {accepts.replace(',', ' or ')} file."
    if under_way >= UPLOADS_AT_ONCE:
        return f"{shown} must wait until the files before it have arrived: press again then."
    if size < 0 or not 0 <= parts <= _PARTS:
        return f"{shown} comes in {parts} parts: {_PARTS} are allowed."
    return None


def accepted_value(value: Any, current: Any, *, choices: Sequence[str] = (), low: Any = None, high: Any = None) -> Any:
    """What a widget takes of a value that its page sent; ValueError with one sentence for what no page of ours sends.

    `current`: its present value, which has the type of every other. A number is brought between `low` and `high`,
    which may have changed while it was on its way.
    """
    if isinstance(current, bool) or current is None:
        fits = isinstance(value, bool)
    elif isinstance(current, str):
        fits = isinstance(value, str) and len(value) <= LONGEST_TEXT and (not choices or value in choices)
    elif isinstance(current, (int, float)):
        fits = is_number(value)
        if fits and low is not None and high is not None:
            value = min(max(value, low), high)
    else:  # Numbers; an upload button's value is a file, which comes in another way.
        pairs = isinstance(value, (list, tuple)) and isinstance(current, (list, tuple)) and len(value) == len(current)
        fits = pairs and all(map(is_number, value))
    if not fits:
        raise ValueError(f"A field of this page cannot hold {brief(repr(value))[:LONGEST_SHOWN]}: it stays as it was.")
    return value


LONGEST_SHOWN = 60
"""Characters of a refused value that its sentence repeats."""


def _is_accepted(name: str, accepts: str) -> bool:
    """Whether the ending is one of those listed; types without a dot say nothing about names."""
    endings = [item.strip().lower() for item in accepts.split(",")]
    return any(not item.startswith(".") or name.lower().endswith(item) for item in endings)


_MOST, _WINDOW = 3, 60.0
"""Records of one kind, within so many seconds."""
_KINDS = 200
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
        """Whether the record passes."""
        error = record.exc_info[0] if record.exc_info else None
        kind = (record.name, record.lineno, error.__name__ if error else "")
        now = time.monotonic()
        with self._lock:
            begun, count = self._seen.pop(kind, (now, 0))
            skipped = 0
            if now - begun > self._window:
                skipped, begun, count = max(count - self._most, 0), now, 0
            self._seen[kind] = (begun, count + 1)
            if len(self._seen) > _KINDS:
                self._seen.popitem(last=False)
        if skipped:
            record.msg = f"{record.msg} ({skipped} more like this were not written)"
        return count < self._most


def limit_log() -> None:
    """Limit what this process writes to its log."""
    handlers = logging.getLogger().handlers or ([logging.lastResort] if logging.lastResort else [])
    for handler in handlers:
        if not any(isinstance(known, RepeatFilter) for known in handler.filters):
            handler.addFilter(RepeatFilter())
