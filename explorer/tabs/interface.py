"""What a session gives its tabs: the moment it arrived at, and what they may ask of it; the rest stays hidden."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol

from explorer.pinned import Pinned
from explorer.state import Inputs, ViewState
from rotor.trim.solution import Solution


@dataclass(frozen=True, eq=False)
class Moment:
    """What a round of the session arrived at: one value that every tab reads."""

    inputs: Inputs
    view: ViewState
    solution: Solution
    """Converged."""
    baseline: Solution
    """What a change is counted from when nothing is pinned."""
    pinned: Solution | None
    """A of A/B, in the present flight or in its own, as the user wants; it may have no trim there."""
    pin: Pinned | None = None
    """What was pinned: its inputs, its title, and the answer it had then."""

    def only_turned(self, before: "Moment | None") -> bool:
        """Whether nothing but the marked blade has moved since."""
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
        """What the read-outs compare with."""
        return self.baseline if self.pinned is None else self.pinned


@dataclass(frozen=True)
class Desk:
    """What a tab may ask of its session; from any thread."""

    inputs: Callable[[], Inputs]
    set_inputs: Callable[[Inputs], None]
    """Move the widgets; the page follows as if they had been dragged."""
    view: Callable[[], ViewState]
    set_view: Callable[[ViewState], None]
    turn: Callable[[float], None]
    """Move the marked blade to an azimuth [deg]; the cheapest change there is, made for 20 a second."""
    wake: Callable[[], None]
    """Something changed: the session's worker will do another round."""
    send: Callable[[str, bytes], None]
    """A file to the browser, saved at once: name, content."""
    tell: Callable[[str, str], None]
    """A notification: title, sentence."""
    moment: Callable[[], Moment | None]
    """The last good one; None before the first."""
    pin: Callable[[Inputs | None], None] = lambda inputs: None
    """Let these inputs be A; None: nothing."""
    bind: Callable[[str, Callable[[], None]], None] = lambda name, action: None
    """Give a command of `explorer.tabs.keys.names` its action: it is in the palette and has its key from then on."""


class Tab(Protocol):
    """A part of the page that follows the session; called on the worker's thread."""

    def show(self, moment: Moment) -> None:
        """Follow a converged answer."""
        ...

    def lose(self) -> None:
        """The inputs have no answer: what is shown no longer holds."""
        ...

    def stop(self) -> None:
        """The browser has left."""
        ...
