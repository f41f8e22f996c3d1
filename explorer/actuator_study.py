"""Verdicts in the background: the newest question wins, and nothing that is drawn waits for it."""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

from explorer.actuator_state import Question
from explorer.worker import LatestWins
from rotor.actuator.catalogue import actuators, find_actuator
from rotor.actuator.verdict import Verdict, judge
from rotor.concepts import find_concept

STILL = 0.4
"""How long a question must stand before it is worked on [s], so that a dragged slider starts nothing."""

Outcome = Verdict | str
"""A verdict, or the sentence that says why there is none."""


@dataclass(frozen=True, eq=False)
class Findings:
    """What is known about a question."""

    question: Question | None = None
    outcome: Outcome | None = None
    """None while it is being computed."""
    others: tuple[tuple[str, Outcome], ...] = ()
    """Verdicts of all actuators, as far as they are known."""

    @property
    def verdict(self) -> Verdict | None:
        return self.outcome if isinstance(self.outcome, Verdict) else None

    @property
    def complete(self) -> bool:
        return self.outcome is not None and len(self.others) == len(actuators())


def answer(question: Question, actuator: str) -> Outcome:
    """The verdict on one actuator."""
    try:
        return judge(
            find_actuator(actuator),
            question.pair,
            find_concept(question.concept),
            question.placement,
            question.host,
            counted=question.share,
        )
    except (ValueError, RuntimeError) as error:
        return str(error)


class Study:
    """One thread that answers the newest question, first for the chosen actuator, then for all others."""

    def __init__(self, found: Callable[[], None], name: str) -> None:
        self._found = found
        self._question: Question | None = None
        self._worker = LatestWins(self._round, self._failed, name)
        self.findings = Findings()

    def start(self) -> None:
        self._worker.start()

    def stop(self) -> None:
        self._worker.stop(timeout=0.0)

    def ask(self, question: Question) -> None:
        """Answered some time later, unless another question comes first."""
        if question != self._question:
            self._question = question
            self._worker.wake()

    def current(self, question: Question) -> bool:
        """Whether the findings are about this question."""
        return self.findings.question == question

    def _round(self, superseded: Callable[[], bool]) -> None:
        question = self._question
        if question is None or (self.current(question) and self.findings.complete):
            return
        until = time.monotonic() + STILL
        while time.monotonic() < until:
            if superseded():
                return
            time.sleep(0.05)
        known: dict[str, Outcome] = {}
        before = self.findings.question
        if before is not None and replace(before, actuator=question.actuator) == question:
            known.update(self.findings.others)  # Only another actuator was chosen.
        for id in (question.actuator, *actuators()):
            if id not in known:
                known[id] = answer(question, id)
                if superseded():
                    return
            listed = tuple((id, known[id]) for id in actuators() if id in known)
            self.findings = Findings(question, known[question.actuator], listed)
            self._found()

    def _failed(self, error: Exception) -> None:
        self.findings = Findings(self._question, f"The verdict failed ({error}): change any setting to try again.")
        self._found()
