"""Verdicts in the background: the newest question wins, and nothing that is drawn waits for it.

The work is done in the warm processes of the page. What was found once serves every browser that asks the same.
"""

import threading
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Protocol

from explorer.tabs.actuator.actuator_inputs import Question
from explorer.workers.job import JobFailed
from explorer.workers.newest_wins import NewestWins
from explorer.workers.pool import PoolClient
from explorer.workers.scheduler import FairScheduler
from rotor.actuator.catalogue import actuators, find_actuator
from rotor.actuator.verdict import Verdict, judge
from rotor.optimisation.concepts import find_concept

STILL = 0.4
"""How long a question must stand before it is worked on [s], so that a dragged slider starts nothing."""
IDLE = 2.5
"""How long the page must have been still before work is begun that nobody asked for [s]."""
URGENCY = 5
"""Behind searches, maps and schedules."""
_KEPT = 64

Outcome = Verdict | str
"""A verdict, or the sentence that says why there is none."""
Superseded = Callable[[], bool]


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


@dataclass(frozen=True)
class VerdictTask:
    """One actuator judged. It pickles."""

    question: Question

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> Outcome:
        """The verdict without its fields over the disk, of which the page shows none."""
        del tell, stop  # A second at most.
        found = answer(self.question)
        return found if isinstance(found, str) else lean(found)


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


class VerdictSource(Protocol):
    """Where verdicts come from."""

    def find(self, task: VerdictTask, superseded: Superseded) -> Outcome | None:
        """Waits for the answer; None when superseded first."""
        ...


class CachedVerdicts:
    """What is known already, else a process of the pool."""

    def __init__(self, pool: PoolClient) -> None:
        self._pool = pool

    def find(self, task: VerdictTask, superseded: Superseded) -> Outcome | None:
        """Waits for the answer; None when superseded first."""
        known = _recall(task)
        if known is not None:
            return known
        end = self._pool.result(task, superseded, URGENCY, lambda outcome: _remember(task, outcome))
        if end is None:
            return None
        if isinstance(end, JobFailed):
            return end.message
        return end.result or "The verdict was stopped: change any setting to try again."


_lock = threading.Lock()
_known: OrderedDict[VerdictTask, Outcome] = OrderedDict()


def _recall(task: VerdictTask) -> Outcome | None:
    with _lock:
        return _known.get(task)


def _remember(task: VerdictTask, outcome: Outcome) -> None:
    with _lock:
        _known[task] = outcome
        while len(_known) > _KEPT:
            _known.popitem(last=False)


class VerdictWorker:
    """One thread that answers the newest question, first for the chosen actuator, then for all others."""

    def __init__(self, answers: VerdictSource, found: Callable[[], None], name: str) -> None:
        self._answers = answers
        self._found = found
        self._question: Question | None = None
        self._wanted = False
        self._last = time.monotonic()
        # A turn of its own: this thread only waits, and would keep the pages from theirs while it does.
        self._worker = NewestWins(self._round, self._failed, name, scheduler=FairScheduler(1))
        self.findings = Findings()

    def start(self) -> None:
        self._worker.start()

    def stop(self) -> None:
        self._worker.stop(timeout=0.0)

    def ask(self, question: Question, wanted: bool = True, stirred: bool = True) -> None:
        """Answered some time later, unless another question comes first.

        Not `wanted`: only once the page has been still, nothing `stirred`, for a while.
        """
        if stirred:
            self._last = time.monotonic()
        if question != self._question or wanted > self._wanted:
            self._question, self._wanted = question, wanted
            self._worker.wake()

    def current(self, question: Question) -> bool:
        """Whether the findings are about this question."""
        return self.findings.question == question

    def _round(self, superseded: Superseded) -> None:
        question = self._question
        if question is None or (self.current(question) and self.findings.complete):
            return
        known: dict[str, Outcome] = {}
        before = self.findings.question
        if before is not None and replace(before, actuator=question.actuator) == question:
            known.update(self.findings.others)  # Only another actuator was chosen.
        began = time.monotonic()
        for id in (question.actuator, *actuators()):
            if id not in known:
                if not self._patient(began, superseded):
                    return
                outcome = self._answers.find(VerdictTask(replace(question, actuator=id)), superseded)
                if outcome is None or superseded():
                    return
                known[id] = outcome
            listed = tuple((id, known[id]) for id in actuators() if id in known)
            self.findings = Findings(question, known[question.actuator], listed)
            self._found()

    def _patient(self, began: float, superseded: Superseded) -> bool:
        """Wait until it is time; False when superseded."""
        while True:
            left = (began + STILL if self._wanted else self._last + IDLE) - time.monotonic()
            if left <= 0.0:
                return True
            self._worker.pause(left)
            if superseded():
                return False

    def _failed(self, error: Exception) -> None:
        self.findings = Findings(self._question, f"The verdict failed ({error}): change any setting to try again.")
        self._found()
