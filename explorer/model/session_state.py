"""What one update of a session reads, solves and shows, as values; and how a part of the page moves the design."""

from dataclasses import dataclass, replace

from explorer.model.inputs import Inputs, ViewState
from explorer.model.pinned import Pinned
from rotor import Design, Solution


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
class FailedTrim:
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
