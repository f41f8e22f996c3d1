"""The designs the sliders have been through: undo, redo, kept designs, and the change of power since a grab."""

import math
from dataclasses import dataclass, field, fields
from typing import Any, Generic, TypeVar

from explorer.model.inputs import Inputs
from rotor import Solution

Step = TypeVar("Step")
STEPS = 100
"""Most steps that can be undone."""
PAUSE = 1.2
"""[s] without movement after which the same slider begins a new step."""


class LongestPause:
    """The longest pause between the movements since it was last asked for.

    Measured where widgets move, not where answers come: a drag stays one step however slow the answers are.
    """

    def __init__(self) -> None:
        self._last, self._longest = -math.inf, 0.0

    def moved(self, now: float) -> None:
        """Something moved at this time [s]."""
        self._longest, self._last = max(self._longest, now - self._last), now

    def begin(self, now: float) -> None:
        """A pointer went down or up at this time [s]: what was before is no pause in what follows.

        The widget's last movements may arrive after the pointer went up: they still belong to the drag.
        """
        self._last, self._longest = now, 0.0

    def longest(self) -> float:
        """The longest pause [s]."""
        longest, self._longest = self._longest, 0.0
        return longest


@dataclass
class History(Generic[Step]):
    """Steps before and after the present: `Inputs`, or with what else the hand sets in a tuple."""

    present: Step
    past: list[Step] = field(default_factory=list)
    """Oldest first."""
    future: list[Step] = field(default_factory=list)
    """The next step to redo last."""
    _moving: frozenset[str] = frozenset()
    """What the present step has moved."""
    _held: bool = False
    """Whether something is held: all that moves until it is let go is one step."""
    _undone: list[Step] = field(default_factory=list)
    """What could be redone before the present step."""

    def hold(self) -> None:
        """Something was taken by the hand: what moves from now on is a step of its own."""
        self._held, self._moving = True, frozenset()

    def release(self) -> None:
        """The control was let go: what moves next is another step, except the last movements of the drag."""
        self._held = False

    def note(self, inputs: Step, pause: float) -> bool:
        """Take the inputs of an update and the longest pause [s] in moving them; whether they begin a new step."""
        moved = differing(self.present, inputs)
        if not moved:
            return False
        dragging = bool(self._moving) if self._held else moved <= self._moving and pause < PAUSE
        # Back where it began: this is no step.
        if dragging and self.past and self.past[-1] == inputs:
            self.present, self.future, self._moving = self.past.pop(), self._undone, frozenset()
            return False
        if not dragging:
            self.past = [*self.past, self.present][-STEPS:]
            self._moving, self._undone = moved, self.future
        self.present, self.future = inputs, []
        return not dragging

    def undo(self) -> Step | None:
        """Make the step before the present one; None where there is none."""
        return self._step(self.past, self.future)

    def redo(self) -> Step | None:
        """Make the step that was undone the present one; None where there is none."""
        return self._step(self.future, self.past)

    def _step(self, source: list[Step], target: list[Step]) -> Step | None:
        if not source:
            return None
        target.append(self.present)
        self.present = source.pop()
        self._moving = frozenset()
        return self.present


def differing(before: Any, after: Any) -> frozenset[str]:
    """Names of the fields that two of a kind do not share, of tuples of all their parts; none where one is None."""
    if before is None or after is None:
        return frozenset()
    if isinstance(before, tuple):
        return frozenset[str]().union(*map(differing, before, after))
    names = (item.name for item in fields(before))
    return frozenset(name for name in names if getattr(before, name) != getattr(after, name))


class PowerTracker:
    """Keeps the power that a change is counted from.

    A grab begins with a pointer that goes down (`grab`), or, by key, with the first movement after a pause of `PAUSE`
    or of another input than before. It counts from the last power known before it, and lasts until the next one begins.
    """

    def __init__(self) -> None:
        self._by_hand = True
        self.pause = 0.0
        """The longest rest of the inputs [s] before they were read last, as `LongestPause` measures it."""
        self._clear()

    def reset(self) -> None:
        """Forget everything: the change was not made by hand (undo, link, file, optimum, lecture).

        Nothing counts until a hand moves something: an answer on its way may still be that of the design before.
        """
        self._by_hand = False
        self._clear()

    def touch(self) -> None:
        """A hand moves something."""
        self._by_hand = True

    def _clear(self) -> None:
        self._inputs: Inputs | None = None
        self._power: float | None = None
        self.reference: float | None = None
        """Total power before the grab [W]; None when nothing has been moved yet."""
        self._moving: frozenset[str] = frozenset()
        self._held = False

    @property
    def change(self) -> float | None:
        """Total power now less that before the grab [W]; None when nothing has been moved yet."""
        return (
            None if self.reference is None or self._power is None else self._power - self.reference
        )

    def grab(self) -> None:
        """A pointer went down: what follows is one grab until `release`, however long it rests."""
        self.reference, self._moving, self._held, self._by_hand = (
            self._power,
            frozenset(),
            True,
            True,
        )

    def release(self) -> None:
        """The pointer went up; the change stays until the next grab."""
        self._held = False

    def solved(self, inputs: Inputs, power: float | None) -> float | None:
        """Take a solution's inputs and total power [W], None without trim; `change` afterwards."""
        if self._inputs is not None and inputs.aircraft != self._inputs.aircraft:
            self._clear()  # The powers of two rotors are not compared.
        if self._inputs is None:
            self._inputs, self._power = inputs, power
            # Grabbed before the new design had a power: it counts from the first one known.
            if self._held:
                self.reference = power
            return self.change
        if not self._by_hand:
            self._inputs, self._power = inputs, self._power if power is None else power
            return None
        moved = differing(self._inputs, inputs)
        if moved and not self._held and (self.pause >= PAUSE or not moved <= self._moving):
            self.reference, self._moving = self._power, moved
        elif moved:
            self._moving |= moved
        self._inputs = inputs
        # A step without trim has no power; the last known one stays, so that the drag can come back to it.
        self._power = self._power if power is None else power
        return self.change if power is not None else None


@dataclass(frozen=True, eq=False)
class KeptDesign:
    """A design that the user set aside."""

    inputs: Inputs
    solution: Solution

    @property
    def power(self) -> float:
        """Total [W]."""
        return self.solution.power.total
