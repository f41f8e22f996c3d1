"""Which pages are at work, which wait, and which comes next.

A place is a page at work. A page that sleeps keeps its session but holds no place. It gets one back at once when it is
touched, even beyond the number of places: nobody loses what they had.
"""

import threading
from typing import Generic, TypeVar

V = TypeVar("V")


class SeatQueue(Generic[V]):
    """A number of places and a queue in order of arrival; safe from any thread."""

    def __init__(self, places: int) -> None:
        self.places = places
        self._lock = threading.Lock()
        self._seated: set[V] = set()
        self._asleep: set[V] = set()
        self._waiting: list[V] = []

    def arrive(self, visitor: V) -> bool:
        """True if there was a free place, which is then taken; else the visitor waits."""
        with self._lock:
            if len(self._seated) < self.places and not self._waiting:
                self._seated.add(visitor)
                return True
            self._waiting.append(visitor)
            return False

    def leave(self, visitor: V) -> list[V]:
        """The visitor leaves, seated or not; returns those who are seated in turn."""
        with self._lock:
            self._seated.discard(visitor)
            self._asleep.discard(visitor)
            if visitor in self._waiting:
                self._waiting.remove(visitor)
            return self._seat()

    def sleep(self, visitor: V) -> list[V]:
        """The visitor falls asleep; returns those who are seated in turn."""
        with self._lock:
            if visitor not in self._seated:
                return []
            self._seated.remove(visitor)
            self._asleep.add(visitor)
            return self._seat()

    def wake(self, visitor: V) -> None:
        """A sleeping visitor is back."""
        with self._lock:
            if visitor in self._asleep:
                self._asleep.remove(visitor)
                self._seated.add(visitor)

    @property
    def waiting(self) -> tuple[V, ...]:
        """Those who wait, first come first."""
        with self._lock:
            return tuple(self._waiting)

    def _seat(self) -> list[V]:
        free = max(self.places - len(self._seated), 0)
        coming, self._waiting = self._waiting[:free], self._waiting[free:]
        self._seated.update(coming)
        return coming
