"""What Actuate asks of the worker processes: verdicts and flights; a known answer serves every page."""

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import chain, pairwise
from typing import Any

from explorer.tabs.actuator.actuator_inputs import Question
from explorer.workers.pool import Job, JobEnded, JobEvent, JobFailed, Pool
from rotor import Design
from rotor.actuator import (
    ActuatorFlight,
    FlightLeg,
    Verdict,
    actuators,
    find_actuator,
    fly,
    judge,
    standard_flight,
)
from rotor.optimisation import find_concept

Outcome = Verdict | str
"""A verdict, or the sentence that says why there is none."""


@dataclass(frozen=True)
class Call:
    """A task of the pool: a function of a module and its arguments. It pickles; equal ones have one answer."""

    function: Callable[..., Any]
    arguments: tuple[Hashable, ...]

    def run(self, tell: object = None, stop: object = None) -> Any:
        """What the function returns; for a ValueError or RuntimeError its sentence."""
        del tell, stop  # Some seconds at most.
        try:
            return self.function(*self.arguments)
        except (ValueError, RuntimeError) as error:
            return str(error)


def verdict_on(question: Question) -> Verdict:
    """The verdict on the actuator asked about; ValueError or RuntimeError with a sentence where there is none."""
    return judge(
        find_actuator(question.actuator),
        question.pair,
        find_concept(question.concept),
        question.placement,
        question.host,
        against=question.against,
    )


def lean_verdict(question: Question) -> Verdict:
    """The same, its trims with their disks left behind: a few kilobytes for three megabytes."""
    verdict = verdict_on(question)
    base = verdict.baseline
    first, second = (replace(best, solutions=()) for best in base.best)
    base = replace(base, best=(first, second), fixed=replace(base.fixed, solutions=()))
    resting, optimum = (replace(twists, solutions=()) for twists in (verdict.resting, verdict.optimum))
    return replace(verdict, baseline=base, resting=resting, optimum=optimum)


def verdict_tasks(question: Question) -> dict[str, Call]:
    """By actuator: the chosen one first, then all others."""
    ids = dict.fromkeys((question.actuator, *actuators()))
    return {id: Call(lean_verdict, (replace(question, actuator=id),)) for id in ids}


def flight_of(verdict: Verdict) -> ActuatorFlight:
    """The flight of a judged actuator."""
    return fly(verdict, flight_legs(verdict.baseline.pair.design))


@lru_cache(maxsize=8)
def flight_legs(design: Design) -> tuple[FlightLeg, ...]:
    """The standard flight of a design, with a leg half way between any two."""
    legs = standard_flight(design)
    halves = [
        FlightLeg(
            f"{a.name} to {b.name}",
            0.5 * (a.advance_ratio + b.advance_ratio),
            0.5 * (a.climb_speed + b.climb_speed),
        )
        for a, b in pairwise(legs)
    ]
    return (*chain.from_iterable(zip(legs, halves, strict=False)), legs[-1])


_KEPT = 64
_STOPPED = "This was stopped: change any setting to try again."
_lock = threading.Lock()
_known: OrderedDict[Call, Any] = OrderedDict()


class PoolAnswers:
    """Has the newest tasks answered, one at a time. A task under way runs to its end: it takes a second at most."""

    def __init__(self, pool: Pool, urgency: int, answered: Callable[[], None], limit: float = 60.0) -> None:
        """`answered` is called after every answer, on a thread of the pool; `limit`: for each task [s]."""
        self._pool, self._urgency, self._answered, self._limit = pool, urgency, answered, limit
        self._tasks: tuple[Call, ...] = ()
        self._delay = 0.0
        self._failures: dict[Call, str] = {}
        self._job: Job | None = None
        self._running = self._stopped = False
        self._timer: threading.Timer | None = None
        self._lock = threading.RLock()

    def ask(self, tasks: tuple[Call, ...], delay: float, moved: bool = True) -> None:
        """Have these answered, the first one first, once nothing has `moved` for so long [s]."""
        with self._lock:
            changed = tasks != self._tasks or delay < self._delay
            if tasks != self._tasks:
                self._failures.clear()
            self._tasks, self._delay = tasks, delay
            waits = self._timer is not None
            if self._next() is not None and (changed or (moved and waits)):
                self._stop_timer()
                self._timer = threading.Timer(delay, self._begin)
                self._timer.daemon = True
                self._timer.start()

    def answer(self, task: Call | None) -> Any:
        """What is known, or the sentence that says why there is no answer; None while it is being worked on."""
        with _lock:
            return None if task is None else _known.get(task, self._failures.get(task))

    def stop(self) -> None:
        """The browser has left."""
        with self._lock:
            self._stopped = True
            self._stop_timer()
            if self._job is not None:
                self._pool.stop(self._job, quiet=True)

    def _stop_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
        self._timer = None

    def _next(self) -> Call | None:
        return next((task for task in self._tasks if self.answer(task) is None), None)

    def _begin(self) -> None:
        with self._lock:
            self._timer = None
            task = self._next()
            if self._running or self._stopped or task is None:
                return
            self._running = True
            self._job = self._pool.submit(
                task, lambda news: self._on_event(task, news), limit=self._limit, urgency=self._urgency
            )

    def _on_event(self, task: Call, news: JobEvent) -> None:
        match news:
            case JobEnded(result) if result is not None:
                with _lock:
                    _known[task] = result
                    while len(_known) > _KEPT:
                        _known.popitem(last=False)
            case JobEnded():
                self._failures[task] = _STOPPED
            case JobFailed(message):
                self._failures[task] = message
            case _:
                return
        with self._lock:
            self._running = False
            if self._timer is None:
                self._begin()
        self._answered()
