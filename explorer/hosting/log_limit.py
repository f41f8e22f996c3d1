"""A log that repeated failures cannot flood: thousands of equal tracebacks hide the first one and fill the disk."""

import logging
import threading
import time
from collections import OrderedDict

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
        if not any(isinstance(one, RepeatFilter) for one in handler.filters):
            handler.addFilter(RepeatFilter())
