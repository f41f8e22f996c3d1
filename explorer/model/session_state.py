"""A of A/B, the pinned design; and what one update of a session solves, as a value."""

from collections import deque
from dataclasses import dataclass, field, replace
from typing import Literal

from explorer.model.actuator_inputs import HandSettings
from explorer.model.inputs import FLIGHT, Inputs, ViewState
from explorer.workers.solver import BaselineCache, Solve
from rotor import Design, Solution, solve
from rotor.design.quantities import UNUSUAL
from rotor.trim import DEFAULT_OPTIONS, Analysis, SolverOptions, analyse

Mode = Literal["explore", "optimise", "actuate"]
Look = Literal["actuator", "3d", "disk", "top", "blade", "side"]
"""What a view looks at: the actuator on the blade that is out of the rotor, or the rotor."""
Order = Literal["pin", "unpin", "swap", "back", "along", "apart"]
"""What a press asks of A: the last two, that it flies in the present condition, or in its own."""
CONDITION = (*FLIGHT, "stand")
"""The inputs of the condition; the others are the aircraft and the models."""
_NO_TRIM = "The design on the sliders has no trim: move a slider back first. Only a trimmed design can be A."
_DRIVEN = "The voltage of the actuator is unchanged: set it under Actuate."


@dataclass(frozen=True)
class ScreenState:
    """What is on screen, put there by a hand or by the lecture. `against`: A of A/B."""

    inputs: Inputs
    view: ViewState
    against: Inputs | None = None
    mode: Mode = "explore"
    look: Look = "3d"
    hand: HandSettings = field(default_factory=HandSettings)


@dataclass(frozen=True, eq=False)
class Pinned:
    """A design that others are compared with, and its converged solution when it was pinned."""

    inputs: Inputs
    solution: Solution

    @property
    def driven(self) -> bool:
        """Whether an actuator also twists the blade, which the sliders cannot show."""
        design = self.solution.design
        return (
            design.rotor.blade.carried is not None
            or design.active_twist != self.inputs.design().active_twist
        )

    def design(self, present: Design) -> Design:
        """A's blade and models in the flight condition of the present design, level where its models cannot climb."""
        design = self.solution.design
        tested = design.condition.stand is not None, present.condition.stand is not None
        trim = present.models.trim if any(tested) else design.models.trim
        level = {
            row.field: row.default
            for row in UNUSUAL.values()
            if row.axial and not design.models.disk_axial_flow
        }
        carried = design.rotor.blade.carried
        flown = present.bare.condition
        condition = replace(
            flown, mass=flown.mass + (carried.aircraft_kg if carried else 0.0), **level
        )
        return replace(design, condition=condition, models=replace(design.models, trim=trim))

    def sliders(self, present: Inputs, along: bool) -> Inputs:
        """The slider positions that mean A: in the present flight when it flies along, else in its own.

        Another rotor keeps its own flight condition, because its weight differs.
        """
        if not along or self.inputs.aircraft != present.aircraft:
            return self.inputs
        return replace(self.inputs, **{name: getattr(present, name) for name in CONDITION})


def same_but_flight(inputs: Inputs, other: Inputs) -> bool:
    """Whether two inputs mean the same blade, computed in the same way."""
    return replace(inputs, **{name: getattr(other, name) for name in CONDITION}) == other


@dataclass(frozen=True, eq=False)
class PinResult:
    """What is pinned now, what to put on the sliders, and what to say."""

    pinned: Pinned | None
    inputs: Inputs | None = None
    sentence: str = ""


def apply_order(
    order: Order, pinned: Pinned | None, inputs: Inputs, solution: Solution | None, along: bool
) -> PinResult:
    """What a button leads to. `solution`: of `inputs`, None where they have no trim."""
    present = None if solution is None else Pinned(inputs, solution)
    match order:
        case "pin":
            return PinResult(pinned, sentence=_NO_TRIM) if present is None else PinResult(present)
        case "unpin":
            return PinResult(None)
        case _ if pinned is None:
            return PinResult(None)
        case "swap" if present is None:
            return PinResult(pinned, sentence=_NO_TRIM)
        case _:
            after = present if order == "swap" else pinned
            moved = pinned.driven or (present is not None and present.driven)
            return PinResult(after, pinned.sliders(inputs, along), _DRIVEN if moved else "")


@dataclass(frozen=True, eq=False)
class Pins:
    """A of A/B as it stands.

    `answer`: A's, as last compared; it may not have converged. `along`: A flies in the present condition.
    """

    pinned: Pinned | None = None
    answer: Solution | None = None
    along: bool = True


@dataclass(frozen=True)
class Compared:
    """A of A/B by what makes it: its inputs, and its design with the actuator on board. None where nothing is A."""

    inputs: Inputs | None
    design: Design | None


def compared_with(pinned: Pinned | Inputs | None) -> Compared:
    """What A is, or what inputs will be as A."""
    if pinned is None:
        return Compared(None, None)
    if isinstance(pinned, Pinned):
        return Compared(pinned.inputs, pinned.solution.design)
    return Compared(pinned, pinned.design())


_KEPT_PINS = 4
"""Designs that were A with an actuator on board and are kept, with their solutions."""


class Pinboard:
    """A of one session. Buttons ask from any thread; all else happens on the session's worker."""

    def __init__(self, by: Solve = solve) -> None:
        self.pinned: Pinned | None = None
        self.answer: Solution | None = None
        self.along = True
        self._before: deque[Pinned] = deque(maxlen=_KEPT_PINS)
        """What was A with an actuator on board, which its inputs do not say; the last one first."""
        self._asked: deque[Order] = deque()
        self._put: deque[Inputs | Pinned | None] = deque()
        self._by, self._known = by, BaselineCache(by=by)

    def ask(self, order: Order) -> None:
        """A button was pressed; takes effect in the next update."""
        if order in ("along", "apart"):
            self.along = order == "along"
        else:
            self._asked.append(order)

    def put(self, design: Pinned | Inputs | None) -> None:
        """Pin this design as A, or nothing; takes effect in the next update."""
        self._put.append(design)

    def put_back(self, compared: Compared) -> None:
        """Pin what was A, its actuator too; one with an actuator that is kept no longer without it."""
        known = [pinned for pinned in self._before.copy() if compared_with(pinned) == compared]
        self._put.append(known[0] if known else compared.inputs)

    @property
    def now(self) -> Pins:
        return Pins(self.pinned, self.answer, self.along)

    @property
    def compared(self) -> Compared:
        """A, or what will be A in the next update."""
        waiting = self._put.copy()
        return compared_with(waiting[-1] if waiting else self.pinned)

    @property
    def inputs(self) -> Inputs | None:
        """The inputs of A, or of what will be A in the next update."""
        return self.compared.inputs

    def act(self, inputs: Inputs, solution: Solution | None) -> PinResult | None:
        """Do what was asked, with what is on the sliders and its answer; None when nothing was.

        Requests after a button that moves the sliders wait for the update in which they have moved.
        """
        outcome = None
        while self._put:
            given = self._put[0]  # Removed once it is A: `inputs` reads it until then.
            try:
                self.pin(self._pinned_of(given) if isinstance(given, Inputs) else given)
            finally:
                self._put.popleft()
        while self._asked and (outcome is None or outcome.inputs is None):
            outcome = apply_order(self._asked.popleft(), self.pinned, inputs, solution, self.along)
            self.pin(outcome.pinned)
        return outcome

    def _pinned_of(self, inputs: Inputs) -> Pinned | None:
        """A of these inputs; None where they have no trim."""
        answer = self._by(inputs.design(), None, DEFAULT_OPTIONS)
        return Pinned(inputs, answer) if answer.converged else None

    def pin(self, pinned: Pinned | None) -> None:
        """Pin this as A; None removes the pin."""
        if pinned is not self.pinned:
            if self.pinned is not None and self.pinned.driven:
                self._before.appendleft(self.pinned)
            self.pinned = pinned
            self.answer = None if pinned is None else pinned.solution
            design, solution = (
                (None, None) if pinned is None else (pinned.solution.design, pinned.solution)
            )
            self._known = BaselineCache(design, solution, self._by)

    def solve(
        self, present: Design, hurried: bool = False, moving: bool = False
    ) -> Solution | None:
        """A's solution: in the present flight condition if A flies along, else as it was when pinned.

        A of another rotor keeps its own solution, because its weight differs. A trim that fails is slow, so it
        is not repeated when `hurried`: a newer update waits. `moving`: to the digits shown.
        """
        along = (
            self.along
            and self.pinned is not None
            and self.pinned.solution.design.aircraft == present.aircraft
        )
        if self.pinned is None or (
            along and hurried and self.answer is not None and not self.answer.converged
        ):
            return self.answer
        self.answer = (
            self._known.solve(self.pinned.design(present), moving)
            if along
            else self.pinned.solution
        )
        return self.answer


_KEPT_SOLUTIONS = 4
"""Solutions at once: of the sliders, the reference, the optimiser's, and one that is on its way."""


class Analyses:
    """Analyses of the solutions that a page shows: its parts ask for slopes and bands of the same ones."""

    def __init__(self) -> None:
        self._kept: tuple[Analysis, ...] = ()

    def solve(
        self,
        design: Design,
        start: Solution | None = None,
        options: SolverOptions = DEFAULT_OPTIONS,
    ) -> Solution:
        """As `rotor.solve`; the equations are kept for slopes."""
        return self._keep(analyse(design, start, options)).solution

    def of(self, solution: Solution) -> Analysis:
        return self._keep(
            next((one for one in self._kept if one.solution is solution), None)
            or Analysis(solution)
        )

    def forget_others(self, *shown: Solution | None) -> None:
        """Keep those of these solutions only: their derivatives are large."""
        self._kept = tuple(one for one in self._kept if one.solution in shown)

    def _keep(self, analysis: Analysis) -> Analysis:
        self._kept = (analysis, *(one for one in self._kept if one is not analysis))[
            :_KEPT_SOLUTIONS
        ]
        return analysis


@dataclass(frozen=True, eq=False)
class SessionState:
    """The result of one update of a session, converged; every tab reads this value.

    `baseline`: the reference of every change while nothing is pinned. `pinned`: A of A/B, in the present flight or in
    its own, as the user chose, where it may not have converged; `pin`: what was pinned, with its solution at that time.
    """

    inputs: Inputs
    view: ViewState
    solution: Solution
    baseline: Solution
    pinned: Solution | None
    pin: Pinned | None = None

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
