"""The types that pass between a session, its page and the tabs of the page.

The session calls `SessionPage` with a `Reading`, a `Frame`, a `SessionState` or a `Failure`. The page calls
`SessionCallbacks`. A tab calls `TabContext` and follows the session as a `Tab`.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

from explorer.charts.plots import PowerCurve
from explorer.picture.fields import Field
from explorer.pinned import Pinned
from explorer.sharing.presentation import Presentations
from explorer.state import Inputs, ViewState
from explorer.workers.pool import Pool
from rotor.design.design import Design
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
        """Whether only the azimuth of the reference blade differs from `before`."""
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


@dataclass(frozen=True, eq=False)
class Reading:
    """What the page asks for at one instant."""

    inputs: Inputs
    view: ViewState
    sliders: Design | None = None
    """The design on the sliders; None where they mean none."""
    design: Design | None = None
    """The design to solve: that on the sliders, with the actuator's twist, or one that a search found."""
    previewed: bool = False
    """Whether `design` is one that a search found."""
    problem: str = ""
    """Why there is no design, in one sentence."""


@dataclass(frozen=True, eq=False)
class Frame:
    """What the 3D picture shows."""

    reading: Reading
    solution: Solution
    """Converged."""
    pinned: Solution | None
    """A, where the disk shows the difference to it."""
    only_azimuth: bool
    """Whether nothing but the azimuth of the reference blade can have changed since the last frame."""


@dataclass(frozen=True, eq=False)
class Failure:
    """Inputs without a solution."""

    reading: Reading
    solution: Solution | None
    """The one that did not converge; None where the inputs mean no design."""
    good: Solution | None
    """The last converged one, which the picture still shows."""

    @property
    def message(self) -> str:
        """Why there is no solution, in one sentence."""
        return self.reading.problem if self.solution is None else self.solution.message


class SessionPage(Protocol):
    """What a session calls on its page, always from its worker thread."""

    def start(self) -> None:
        """The session begins."""
        ...

    def stop(self) -> None:
        """The browser has left: end threads and jobs."""
        ...

    def read(self) -> tuple[Inputs, ViewState]:
        """What the widgets mean now. A change of inputs becomes a step of undo."""
        ...

    def driven(self, design: Design) -> Design:
        """The design with the twist of the page's actuator; ValueError with one sentence where it cannot drive it."""
        ...

    def preview(self, design: Design) -> Design | None:
        """The design of a search to show in place of the one on the sliders, which the search began from."""
        ...

    @property
    def pin(self) -> Pinned | None:
        """A of A/B."""
        ...

    def pin_or_swap(self, inputs: Inputs, solution: Solution | None) -> bool:
        """Do what the A/B buttons asked for; True if that moved the sliders, so that another update follows."""
        ...

    def solve_pinned(self, present: Design, hurried: bool) -> Solution | None:
        """A beside the present design; None when nothing is pinned. `hurried`: a newer update waits."""
        ...

    def show_frame(self, frame: Frame) -> None:
        """Draw the 3D picture and send it. Nothing else belongs here: it is the delay that the user feels."""
        ...

    def show_power_number(self, state: SessionState) -> None:
        """Update power and what stands beside the hand, of a step whose charts are left out."""
        ...

    def show_azimuth(self, state: SessionState) -> None:
        """Only the azimuth of the reference blade changed."""
        ...

    def show_results(self, reading: Reading, state: SessionState) -> None:
        """Update what stands beside the picture, after every frame."""
        ...

    def show_power(self, state: SessionState, curve: PowerCurve, failed: bool = False) -> None:
        """Draw power over advance ratio; `failed`: the present inputs have no solution."""
        ...

    def follow(self, reading: Reading, state: SessionState) -> None:
        """Update all other tabs; skipped while the sliders move faster than the page can follow."""
        ...

    def settle(self, state: SessionState) -> None:
        """Nothing moves: draw finely, and keep what must survive a reload."""
        ...

    def rest(self, state: SessionState, stop: Callable[[], bool]) -> None:
        """Nothing has moved since: compute and save what could wait, until `stop`."""
        ...

    def show_failure(self, failure: Failure) -> None:
        """Show the sentence and mark what is shown as out of date."""
        ...

    def show_error(self, sentence: str) -> None:
        """An update failed with an exception."""
        ...


@dataclass(frozen=True)
class TabContext:
    """What a tab may call; safe from any thread."""

    inputs: Callable[[], Inputs]
    set_inputs: Callable[[Inputs], None]
    """Move the widgets; the page follows as if they had been dragged."""
    view: Callable[[], ViewState]
    set_view: Callable[[ViewState], None]
    set_azimuth: Callable[[float], None]
    """Move the reference blade to an azimuth [deg]. This is the cheapest change and may be called 20 times a second."""
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
    """Give a command of `explorer.tabs.keys` its action: from then on it is in the palette and has its key."""


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
    """Only the azimuth of the reference blade changed."""
    state: Callable[[], SessionState | None]
    """The last converged state; None before the first."""


@dataclass(frozen=True)
class SharedServices:
    """What the pages of one server share."""

    pool: Pool
    """This page's access to the worker processes."""
    presentations: Presentations
    studies: Path = Path()
    """The folder whose results the Studies tab offers."""


class RangeDisplay(Protocol):
    """The widgets that show the colour range of the disk."""

    def show_range(
        self, field: Field, colour_range: tuple[float, float], faded: bool, beyond: tuple[bool, bool] = (False, False)
    ) -> None:
        """Show the colour bar of a field; `faded`: the disk no longer holds."""
        ...
