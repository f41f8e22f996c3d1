"""Verdicts on actuators as tasks of the worker processes."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from explorer.tabs.actuator.actuator_inputs import Question
from rotor.actuator.catalogue import actuators, find_actuator
from rotor.actuator.verdict import Verdict, judge
from rotor.optimisation.concepts import find_concept

Outcome = Verdict | str
"""A verdict, or the sentence that says why there is none."""


@dataclass(frozen=True)
class VerdictTask:
    """One actuator judged. It pickles."""

    question: Question

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> Outcome:
        """The verdict without its fields over the disk, of which the page shows none."""
        del tell, stop  # A second at most.
        outcome = answer(self.question)
        return outcome if isinstance(outcome, str) else lean(outcome)


def answer(question: Question) -> Outcome:
    """The verdict on the actuator asked about."""
    try:
        return judge(
            find_actuator(question.actuator),
            question.pair,
            find_concept(question.concept),
            question.placement,
            question.host,
            counted=question.share,
        )
    except (ValueError, RuntimeError) as error:
        return str(error)


def lean(verdict: Verdict) -> Verdict:
    """The same verdict, its trims left behind: a few kilobytes for three megabytes."""
    base = verdict.baseline
    first, second = (replace(best, solutions=()) for best in base.best)
    fixed = replace(base.fixed, solutions=())
    base = replace(base, best=(first, second), fixed=fixed)
    resting, optimum = (replace(twists, solutions=()) for twists in (verdict.resting, verdict.optimum))
    return replace(verdict, baseline=base, resting=resting, optimum=optimum)


def verdict_tasks(question: Question) -> tuple[VerdictTask, ...]:
    """The chosen actuator first, then all others."""
    others = (id for id in actuators() if id != question.actuator)
    return tuple(VerdictTask(replace(question, actuator=id)) for id in (question.actuator, *others))
