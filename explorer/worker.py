"""One thread that always works on the newest state: nothing is queued, nothing is debounced away."""

import contextlib
import threading
from collections.abc import Callable

Job = Callable[[Callable[[], bool]], None]
"""Does one round; may ask its argument whether a newer round is already wanted, and return early."""


class LatestWins:
    """Runs `job` once after every `wake`; wakes that come while it runs are answered by a single further run."""

    def __init__(self, job: Job, on_error: Callable[[Exception], None], name: str) -> None:
        self._job = job
        self._on_error = on_error
        self._wanted = threading.Event()
        self._stopped = False
        self._thread = threading.Thread(target=self._loop, name=name, daemon=True)

    def start(self) -> None:
        self._thread.start()

    def wake(self) -> None:
        """Something changed: a round that starts after this call will see it."""
        self._wanted.set()

    def stop(self, timeout: float = 2.0) -> None:
        """End the thread after the round it is in."""
        self._stopped = True
        self._wanted.set()
        if threading.current_thread() is not self._thread and self._thread.is_alive():
            self._thread.join(timeout)

    def _superseded(self) -> bool:
        return self._stopped or self._wanted.is_set()

    def _loop(self) -> None:
        while True:
            self._wanted.wait()
            # Cleared before the job reads anything, so that a change during the job wakes it again.
            self._wanted.clear()
            if self._stopped:
                return
            try:
                self._job(self._superseded)
            except Exception as error:  # The session must survive whatever one round does.
                if not self._stopped:
                    with contextlib.suppress(Exception):  # The browser may be gone: nobody is left to tell.
                        self._on_error(error)
