"""Who is served, who waits, and who comes next. Pure.

A place is a page at work. A page that sleeps keeps its session but holds no place, and gets one back at once when it is
touched, even above the number: nobody loses what they had.
"""

import threading
from typing import Generic, TypeVar

V = TypeVar("V")


class SeatQueue(Generic[V]):
    """So many places, and a line in order of arrival; safe from any thread."""

    def __init__(self, places: int) -> None:
        self.places = places
        self._lock = threading.Lock()
        self._seated: set[V] = set()
        self._asleep: set[V] = set()
        self._line: list[V] = []

    def arrive(self, visitor: V) -> bool:
        """True when there is a place, which is then taken; else the visitor stands in line."""
        with self._lock:
            if len(self._seated) < self.places and not self._line:
                self._seated.add(visitor)
                return True
            self._line.append(visitor)
            return False

    def leave(self, visitor: V) -> list[V]:
        """The visitor goes, wherever it was; returns those whose turn it now is, already seated."""
        with self._lock:
            self._seated.discard(visitor)
            self._asleep.discard(visitor)
            if visitor in self._line:
                self._line.remove(visitor)
            return self._seat()

    def sleep(self, visitor: V) -> list[V]:
        """The visitor falls asleep; returns those whose turn it now is, already seated."""
        with self._lock:
            if visitor not in self._seated:
                return []
            self._seated.remove(visitor)
            self._asleep.add(visitor)
            return self._seat()

    def wake(self, visitor: V) -> None:
        """A sleeper is touched."""
        with self._lock:
            if visitor in self._asleep:
                self._asleep.remove(visitor)
                self._seated.add(visitor)

    @property
    def line(self) -> tuple[V, ...]:
        """Who waits, first come first."""
        with self._lock:
            return tuple(self._line)

    def _seat(self) -> list[V]:
        free = max(self.places - len(self._seated), 0)
        coming, self._line = self._line[:free], self._line[free:]
        self._seated.update(coming)
        return coming
