"""What Actuate knows: the actuator on the blade of the sliders, what is asked about it, and what was answered."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from explorer.model.actuator_inputs import (
    AGAINST,
    Outcome,
    Question,
    flight_legs,
    flight_of,
    question_of,
    verdict_tasks,
)
from explorer.views.dial_answer import Fitted
from explorer.views.now import Now, Ui
from explorer.workers.call import Call
from rotor import Design
from rotor.actuator import ActuatorFlight, ActuatorStability, FlightLeg, InstalledActuator, Verdict, actuator_stability
from rotor.dynamics.structure import check_blade


def in_actuate(ui: Ui) -> bool:
    return ui.mode == "actuate"


def built(now: Now) -> "Built | None":
    """One for all panels; None where the sliders mean no design, or one that cannot carry the actuator."""
    found = now.of(_built)
    return found if isinstance(found, Built) else None


def problem(now: Now) -> str:
    """Why there is no solution, or no such actuator; empty where there are both."""
    found = now.of(_built)
    return now.problem or (found if isinstance(found, str) else "")


def _built(now: Now) -> "Built | str":
    design, inputs = now.sliders, now.hand.actuator
    if design is None:
        return now.problem
    try:
        check_blade(design.aircraft)
        return Built(now, design, inputs.installed(design.rotor), question_of(inputs, design))
    except ValueError as error:
        return str(error)


@dataclass(frozen=True, eq=False)
class Built:
    """The actuator on the blade."""

    now: Now
    design: Design
    """On the sliders, without the actuator's twist."""
    installed: InstalledActuator
    question: Question

    @cached_property
    def tasks(self) -> Mapping[str, Call]:
        """Of verdicts, by actuator: the chosen one first."""
        return verdict_tasks(self.question)

    @cached_property
    def outcomes(self) -> Mapping[str, Outcome | None]:
        """By actuator; None on its way."""
        return {id: self.now.answers.get(task) for id, task in self.tasks.items()}

    @property
    def outcome(self) -> Outcome | None:
        """Of the chosen one."""
        return self.outcomes[self.question.actuator]

    @property
    def verdict(self) -> Verdict | None:
        return self.outcome if isinstance(self.outcome, Verdict) else None

    @cached_property
    def flight_task(self) -> Call | None:
        return None if self.verdict is None else Call(flight_of, (self.verdict,))

    @property
    def flight(self) -> ActuatorFlight | str | None:
        """The sentence that says why there is none; None on its way."""
        return None if self.flight_task is None else self.now.answers.get(self.flight_task)

    @cached_property
    def modes_task(self) -> Call | None:
        return None if self.verdict is None else Call(actuator_stability, (self.installed, self.design))

    @property
    def modes(self) -> ActuatorStability | str | None:
        return None if self.modes_task is None else self.now.answers.get(self.modes_task)

    @cached_property
    def legs(self) -> tuple[FlightLeg, ...]:
        return flight_legs(self.design)

    @cached_property
    def fitted(self) -> Fitted:
        """For the dial: the actuator, and the blade that power and vibration are compared with."""
        inputs = self.now.hand.actuator
        fixed = None if self.verdict is None else self.verdict.baseline.fixed_twist
        twist = self.design.twist if inputs.against == "as-built" else fixed
        against = f"the {AGAINST[inputs.against][0].lower()}{AGAINST[inputs.against][1:]}"
        return Fitted(self.installed, inputs.volts(self.installed), twist, against)
