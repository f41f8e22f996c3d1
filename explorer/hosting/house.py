"""Bounds of one server: how many pages at once, and how long one may rest before it sleeps."""

from dataclasses import dataclass
from pathlib import Path

SESSIONS = 24
"""Places by default: a class. Each takes some 8 MB, and all of them dragging at once still get a frame a second."""
SLEEP_AFTER = 1800.0
"""[s]; a lecture's break."""
_SPARE = 40
"""Connections above the places, for those who wait in line, sleep, or have not said who they are."""


@dataclass(frozen=True)
class ServerLimits:
    """What whoever starts the server decides."""

    sessions: int = SESSIONS
    """Pages at work at once."""
    sleep_after: float = SLEEP_AFTER
    """[s] without a change after which a page sleeps: its caches go, its place is free for others."""
    allow_hosts: tuple[str, ...] = ()
    """Further names the server is reached by."""
    frame_ancestors: tuple[str, ...] = ()
    """Origins of other pages that may show this one in a frame, such as a notebook's."""
    studies: Path = Path()
    """Results of studies beneath this folder are offered to every page; nothing else of the machine's disk is."""

    @property
    def connections(self) -> int:
        """WebSockets at once."""
        return 2 * self.sessions + _SPARE
