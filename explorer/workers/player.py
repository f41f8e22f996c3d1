"""A clock that advances something in small steps, on a thread that exists only while it plays."""

import logging
import threading
import time
from collections.abc import Callable

_log = logging.getLogger(__name__)

BEAT = 0.05
"""Time between steps [s]: a browser is asked to draw at most 20 times a second."""


class Player:
    """Play and pause; safe from any thread."""

    def __init__(self, step: Callable[[float], None], name: str) -> None:
        """`step` is called with the time [s] since its last call, or since play was pressed."""
        self._step = step
        self._name = name
        self._lock = threading.Lock()
        self._pause: threading.Event | None = None
        """Of the thread that plays now; None when none does."""

    @property
    def playing(self) -> bool:
        return self._pause is not None

    def play(self) -> None:
        """Start, unless it plays already."""
        with self._lock:
            if self._pause is None:
                pause = self._pause = threading.Event()
                threading.Thread(target=self._run, args=(pause,), name=self._name, daemon=True).start()

    def pause(self) -> None:
        """No step begins after this."""
        with self._lock:
            if self._pause is not None:
                self._pause.set()
                self._pause = None

    def _run(self, pause: threading.Event) -> None:
        before = time.monotonic()
        while not pause.wait(BEAT):
            now = time.monotonic()
            try:
                self._step(now - before)
            except Exception:  # The browser may have gone.
                _log.exception("play ended")
                self.pause()
            before = now
