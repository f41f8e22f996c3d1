"""Progress of long commands: a bar on a terminal, and Ctrl-C as a request to stop and print the results so far."""

import signal
import sys
import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from types import FrameType
from typing import Any

_TWICE = 0.5
"""[s]"""
STOPPED = 130
"""Exit code after Ctrl-C; results so far are printed."""


@contextmanager
def bar(total: int | None, unit: str) -> Generator[Callable[[str], None]]:
    """A progress bar on stderr if that is a terminal; call it with a short text to advance it by one."""
    if not sys.stderr.isatty():
        yield lambda words: None
        return
    from tqdm import tqdm

    made: Any = tqdm(total=total, unit=unit, file=sys.stderr, leave=False, dynamic_ncols=True)

    def advance(words: str) -> None:
        made.set_postfix_str(words, refresh=False)
        made.update()

    try:
        yield advance
    finally:
        made.close()


@contextmanager
def interruptible() -> Generator[Callable[[], bool]]:
    """A `stop` that returns True after the first Ctrl-C; a second one interrupts at once.

    Some programs send one Ctrl-C twice, to a process and to its group: two within half a second count as one.
    """
    asked: list[float] = []

    def ask(number: int, frame: FrameType | None) -> None:
        now = time.monotonic()
        if asked and now - asked[0] > _TWICE:
            signal.default_int_handler(number, frame)
        if not asked:
            asked.append(now)

    before = signal.signal(signal.SIGINT, ask)
    try:
        yield lambda: bool(asked)
    finally:
        signal.signal(signal.SIGINT, before)
