"""What Actuate knows: the actuator on the blade of the sliders, what is asked about it, and what was answered."""

from collections.abc import Mapping
from dataclasses import dataclass

from explorer.model.actuator_inputs import (
    Outcome,
    VerdictInputs,
    flight_legs,
    flight_of,
    verdict_inputs_of,
    verdict_tasks,
)
from explorer.views.page_state import OpenPanels, PageState
from explorer.workers.call import Call
from rotor import Design
from rotor.actuator import ActuatorFlight, FlightLeg, InstalledActuator, Verdict
from rotor.dynamics.structure import check_blade


def in_actuate(ui: OpenPanels) -> bool:
    return ui.mode == "actuate"


def blade_out(ui: OpenPanels) -> bool:
    """Whether Actuate shows the blade out of the rotor."""
    return in_actuate(ui) and ui.lifted


def actuated_blade(now: PageState) -> "ActuatedBlade | None":
    """One for all panels; None where the sliders mean no design, or one that cannot carry the actuator."""
    found = now.of(_built)
    return found if isinstance(found, ActuatedBlade) else None


def problem(now: PageState) -> str:
    """Why there is no solution, or no such actuator; empty where there are both."""
    found = now.of(_built)
    return now.problem or (found if isinstance(found, str) else "")


def _built(now: PageState) -> "ActuatedBlade | str":
    design, inputs = now.sliders, now.hand.actuator
    if design is None:
        return now.problem
    try:
        check_blade(design.aircraft)
        installed, question = inputs.installed(design.rotor), verdict_inputs_of(inputs, design)
    except ValueError as error:
        return str(error)
    tasks = verdict_tasks(question)
    outcomes = {id: now.answers.get(task) for id, task in tasks.items()}
    outcome = outcomes[question.actuator]
    verdict = outcome if isinstance(outcome, Verdict) else None
    flight_task = None if verdict is None else Call(flight_of, (verdict,))
    flight, legs = now.answers.get(flight_task), flight_legs(design)
    return ActuatedBlade(design, installed, question, tasks, outcomes, outcome, verdict, flight_task, flight, legs)


@dataclass(frozen=True, eq=False)
class ActuatedBlade:
    """The actuator on the blade, what is asked about it, and the answers: a sentence says why there is none, None that
    it is on its way."""

    design: Design
    """On the sliders, without the actuator's twist."""
    installed: InstalledActuator
    question: VerdictInputs
    tasks: Mapping[str, Call]
    """Of verdicts, by actuator: the chosen one first."""
    outcomes: Mapping[str, Outcome | None]
    """By actuator."""
    outcome: Outcome | None
    """Of the chosen one."""
    verdict: Verdict | None
    flight_task: Call | None
    flight: ActuatorFlight | str | None
    legs: tuple[FlightLeg, ...]
