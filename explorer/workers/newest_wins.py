"""A thread that always works on the newest state: nothing is queued, nothing is debounced."""

import contextlib
import threading
from collections.abc import Callable
from dataclasses import dataclass

from explorer.workers.scheduler import SCHEDULER, FairScheduler, Turn

Update = Callable[[Callable[[], bool]], None]
"""Does one update. Between steps of what can wait it calls its argument, which lets the frames of other pages go first
and returns whether a newer update is wanted; the update then returns early."""


@dataclass(frozen=True)
class IdleTimeout:
    """What happens when no update is wanted for long; called on the worker's thread."""

    after: float
    """[s]"""
    on_sleep: Callable[[], None]
    on_wake: Callable[[], None]
    """Called before the update that ends the sleep."""


class Superseded:
    """What an update calls between its steps."""

    def __init__(self, worker: "NewestWins", turn: Turn) -> None:
        self._worker, self._turn = worker, turn

    def __call__(self) -> bool:
        """Let the frames of other pages go first; whether a newer update is wanted."""
        return not self._turn.give_way(lambda: self._worker.superseded) or self._worker.superseded

    def pause(self) -> None:
        """Let them go first in the middle of a step that must come to its end, if that step is a long one."""
        if self._turn.long:
            self._turn.give_way(lambda: self._worker.stopped)


class NewestWins:
    """Runs `update` once after every `wake`; one further run answers all wakes that come while it runs."""

    def __init__(
        self,
        update: Update,
        on_error: Callable[[Exception], None],
        name: str,
        idle: IdleTimeout | None = None,
        scheduler: FairScheduler = SCHEDULER,
    ) -> None:
        self._update = update
        self._on_error = on_error
        self._idle = idle
        self._scheduler = scheduler
        self._wanted = threading.Event()
        self._standing = threading.Condition()
        self._answered = self._resting = False
        """Whether what the update that runs was for is shown, and whether none runs."""
        self._stopped = False
        self._turn: Turn | None = None
        """Of the update that runs now."""
        self._thread = threading.Thread(target=self._loop, name=name, daemon=True)

    def start(self) -> None:
        self._thread.start()

    def wake(self) -> None:
        """Something changed: an update that starts after this call will see it."""
        if not self._wanted.is_set():  # To set it again takes as long as all the rest of an edit.
            self._wanted.set()
            self._look()

    def stop(self, timeout: float = 2.0) -> None:
        """End the thread after the update it is in."""
        self._stopped = True
        self._wanted.set()
        self._look()
        with self._standing:
            self._standing.notify_all()
        if threading.current_thread() is not self._thread and self._thread.is_alive():
            self._thread.join(timeout)

    @property
    def stopped(self) -> bool:
        """Whether the page has gone."""
        return self._stopped

    @property
    def superseded(self) -> bool:
        """Whether a newer update is wanted."""
        return self._stopped or self._wanted.is_set()

    def pause(self, seconds: float) -> None:
        """Within an update: leave the turn to others until a newer update is wanted, at most so long.

        What can wait then does not stand in the way of the next step of a drag. Nor does the wait for another turn,
        which may be long where other pages compute: a newer update ends it.
        """
        if self._turn is not None:
            self._turn.leave()
        self._wanted.wait(seconds)
        if self._turn is not None:
            self._turn.give_way(lambda: self.superseded)

    def answer(self) -> None:
        """Within an update: what it was for is shown, and the rest of it can wait."""
        with self._standing:
            self._answered = True
            self._standing.notify_all()

    def until_answered(self, wholly: bool) -> None:
        """Wait until all wakes that came before this call are answered, `wholly` also until no update runs; or until
        the page has gone."""
        with self._standing:
            # In this order: a wake is taken only after both were unset.
            self._standing.wait_for(
                lambda: (
                    self._stopped or (not self._wanted.is_set() and (self._resting or (self._answered and not wholly)))
                )
            )

    def _look(self) -> None:
        """Let an update that waits behind frames check again whether it is wanted."""
        if (turn := self._turn) is not None:
            turn.look()

    def _superseded_after(self, turn: Turn) -> "Superseded":
        return Superseded(self, turn)

    def _rest(self) -> None:
        """Wait until an update is wanted."""
        with self._standing:
            self._resting = True
            self._standing.notify_all()
        idle = self._idle
        if not self._wanted.wait(None if idle is None else idle.after):
            assert idle is not None
            idle.on_sleep()
            self._wanted.wait()
            idle.on_wake()
        self._answered = self._resting = False

    def _loop(self) -> None:
        while True:
            self._rest()
            try:
                with self._scheduler.take() as turn:
                    # Cleared before the update reads anything, so that a change during the update wakes it again.
                    # Not cleared before the turn: the update will see what changes while it waits.
                    self._wanted.clear()
                    if self._stopped:
                        return
                    self._turn = turn
                    self._update(self._superseded_after(turn))
            except Exception as error:  # The session must survive whatever one update does.
                if not self._stopped:
                    with contextlib.suppress(Exception):  # The browser may have gone.
                        self._on_error(error)
