"""Undo and redo: the designs the sliders have been through, where a drag is one step."""

import math
from dataclasses import dataclass, field, fields

from explorer.state import Inputs
from rotor.trim.solution import Solution

STEPS = 100
"""Most steps that can be undone."""
PAUSE = 1.2
"""[s] without movement after which the same slider begins a new step."""


class Pauses:
    """The longest pause between the movements since it was last asked for.

    Measured where widgets move, not where answers come: a drag stays one step however slow the answers are.
    """

    def __init__(self) -> None:
        self._last, self._longest, self._held = -math.inf, 0.0, False

    def moved(self, now: float) -> None:
        """Something moved at this time [s]."""
        self._longest, self._last = max(self._longest, now - self._last), now

    def hold(self, held: bool, now: float) -> None:
        """A pointer went down or up at this time [s]. Rests in between are no pauses.

        The widget's last movements may arrive after the pointer went up: they still belong to the drag.
        """
        self._held, self._last, self._longest = held, now, 0.0

    def longest(self) -> float:
        """[s]"""
        longest, self._longest = 0.0 if self._held else self._longest, 0.0
        return longest


@dataclass
class History:
    """Steps before and after the present."""

    present: Inputs
    past: list[Inputs] = field(default_factory=list)
    """Oldest first."""
    future: list[Inputs] = field(default_factory=list)
    """The next step to redo last."""
    _moving: frozenset[str] = frozenset()
    """What the present step has moved."""
    _held: bool = False
    """Whether something is held: all that moves until it is let go is one step."""

    def hold(self) -> None:
        """Something was taken by the hand: what moves from now on is a step of its own."""
        self._held, self._moving = True, frozenset()

    def release(self) -> None:
        """It was let go: what moves next is another step, except the last movements of the drag."""
        self._held = False

    def note(self, inputs: Inputs, pause: float) -> bool:
        """Take the inputs of an update and the longest pause [s] in moving them; whether they begin a new step."""
        moved = differing(self.present, inputs)
        if not moved:
            return False
        dragging = bool(self._moving) if self._held else moved <= self._moving and pause < PAUSE
        if not dragging:
            self.past = [*self.past, self.present][-STEPS:]
            self._moving = moved
        self.present, self.future = inputs, []
        return not dragging

    def undo(self) -> Inputs | None:
        """Make the step before the present one; None where there is none."""
        return self._step(self.past, self.future)

    def redo(self) -> Inputs | None:
        """Make the step that was undone the present one; None where there is none."""
        return self._step(self.future, self.past)

    def go(self, step: int) -> Inputs | None:
        """Undo or redo until `steps[step]` is the present; None where there is no such step, or it is the present."""
        if step == len(self.past) or not 0 <= step < len(self.steps):
            return None
        while step < len(self.past):
            self.undo()
        while step > len(self.past):
            self.redo()
        return self.present

    @property
    def steps(self) -> tuple[Inputs, ...]:
        """All of them, oldest first; the present is `steps[len(past)]`."""
        return (*self.past, self.present, *reversed(self.future))

    def _step(self, source: list[Inputs], target: list[Inputs]) -> Inputs | None:
        if not source:
            return None
        target.append(self.present)
        self.present = source.pop()
        self._moving = frozenset()
        return self.present


def differing(before: Inputs, after: Inputs) -> frozenset[str]:
    """Names of the inputs that two sets of them do not share."""
    names = (item.name for item in fields(Inputs))
    return frozenset(name for name in names if getattr(before, name) != getattr(after, name))


@dataclass(frozen=True, eq=False)
class KeptDesign:
    """A design that the user set aside."""

    inputs: Inputs
    solution: Solution

    @property
    def power(self) -> float:
        """Total [W]."""
        return self.solution.power.total
