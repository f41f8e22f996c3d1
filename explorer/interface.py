"""The types that pass between a session and its tabs: the state that was computed, what a tab may call, and a tab."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

from explorer.pinned import Pinned
from explorer.sharing.presentation import Presentations
from explorer.state import Inputs, ViewState
from explorer.workers.pool import Share
from rotor.trim.solution import Solution


@dataclass(frozen=True, eq=False)
class SessionState:
    """The result of one update of a session; every tab reads this value."""

    inputs: Inputs
    view: ViewState
    solution: Solution
    """Converged."""
    baseline: Solution
    """The reference of every change while nothing is pinned."""
    pinned: Solution | None
    """A of A/B, in the present flight or in its own, as the user chose. It may not have converged there."""
    pin: Pinned | None = None
    """What was pinned: its inputs, its title, and its solution at that time."""

    def only_turned(self, before: "SessionState | None") -> bool:
        """Whether only the azimuth of the marked blade differs from `before`."""
        return (
            before is not None
            and self.solution is before.solution
            and self.baseline is before.baseline
            and self.pinned is before.pinned
            and self.inputs == before.inputs
            and self.view == replace(before.view, azimuth_deg=self.view.azimuth_deg)
            and self.view != before.view
        )

    @property
    def reference(self) -> Solution:
        """The solution that the read-outs compare with."""
        return self.baseline if self.pinned is None else self.pinned


@dataclass(frozen=True)
class TabContext:
    """What a tab may call; safe from any thread."""

    inputs: Callable[[], Inputs]
    set_inputs: Callable[[Inputs], None]
    """Move the widgets; the page follows as if they had been dragged."""
    view: Callable[[], ViewState]
    set_view: Callable[[ViewState], None]
    set_azimuth: Callable[[float], None]
    """Move the marked blade to an azimuth [deg]. This is the cheapest change and may be called 20 times a second."""
    wake: Callable[[], None]
    """Something changed: the session's worker does another update."""
    download: Callable[[str, bytes], None]
    """Send a file to the browser, which saves it at once: name, content."""
    notify: Callable[[str, str], None]
    """Show a notification: title, sentence."""
    state: Callable[[], SessionState | None]
    """The last converged state; None before the first."""
    pin: Callable[[Inputs | None], None] = lambda inputs: None
    """Pin these inputs as A; None removes the pin."""
    bind_command: Callable[[str, Callable[[], None]], None] = lambda name, action: None
    """Give a command of `explorer.tabs.keys.names` its action: from then on it is in the palette and has its key."""


class Tab(Protocol):
    """A part of the page that follows the session; called on the worker's thread."""

    def show(self, state: SessionState) -> None:
        """Show a converged state."""
        ...

    def show_failure(self) -> None:
        """The inputs have no solution: mark what is shown as out of date."""
        ...

    def stop(self) -> None:
        """The browser has left: end threads and jobs."""
        ...


@dataclass(frozen=True)
class SessionCallbacks:
    """What the page calls in its session; safe from any thread."""

    wake: Callable[[], None]
    """Something changed."""
    azimuth_changed: Callable[[], None]
    """Only the azimuth of the marked blade changed."""
    state: Callable[[], SessionState | None]
    """The last converged state; None before the first."""


@dataclass(frozen=True)
class SharedServices:
    """What the pages of one server share."""

    pool: Share
    """This page's access to the worker processes."""
    presentations: Presentations
    studies: Path = Path()
    """The folder whose results the Studies tab offers."""
