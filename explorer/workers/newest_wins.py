"""One thread that always works on the newest state: nothing is queued, nothing is debounced away."""

import contextlib
import threading
from collections.abc import Callable
from dataclasses import dataclass

from explorer.hosting.turns import TURNS, Turn, Turns

Job = Callable[[Callable[[], bool]], None]
"""Does one round; once its frame is out it asks its argument, between steps of what can wait, whether a newer round is
already wanted, and returns early if so. Asking is where it waits, in a crowd, while the frames of others go first."""


@dataclass(frozen=True)
class IdleTimeout:
    """What happens when nothing is wanted for long; on the worker's thread."""

    after: float
    """[s]"""
    on_sleep: Callable[[], None]
    on_wake: Callable[[], None]
    """Before the round that ends it."""


class NewestWins:
    """Runs `job` once after every `wake`; wakes that come while it runs are answered by a single further run."""

    def __init__(
        self,
        job: Job,
        on_error: Callable[[Exception], None],
        name: str,
        sleep: IdleTimeout | None = None,
        turns: Turns = TURNS,
    ) -> None:
        self._job = job
        self._on_error = on_error
        self._sleep = sleep
        self._turns = turns
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

    @property
    def superseded(self) -> bool:
        """Whether a newer round is already wanted."""
        return self._stopped or self._wanted.is_set()

    def _asking(self, turn: Turn) -> Callable[[], bool]:
        return lambda: not turn.give_way(lambda: self.superseded) or self.superseded

    def _rest(self) -> None:
        """Until something is wanted; one look at the clock on the way to sleep, none in it."""
        sleep = self._sleep
        if self._wanted.wait(None if sleep is None else sleep.after):
            return
        assert sleep is not None
        sleep.on_sleep()
        self._wanted.wait()
        sleep.on_wake()

    def _loop(self) -> None:
        while True:
            self._rest()
            try:
                with self._turns.take() as turn:
                    # Cleared before the job reads anything, so that a change during the job wakes it again; and not
                    # while it waits for its turn, for what changes then it will see.
                    self._wanted.clear()
                    if self._stopped:
                        return
                    self._job(self._asking(turn))
            except Exception as error:  # The session must survive whatever one round does.
                if not self._stopped:
                    with contextlib.suppress(Exception):  # The browser may be gone: nobody is left to tell.
                        self._on_error(error)
