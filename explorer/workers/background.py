"""What worker processes do for a page: long work that a press begins, and answers to what its panels ask.

A search, a map and a schedule are begun by a press. Verdicts, flights, the dial, what would pay and
the numbers of the lecture are asked for as the design changes.
"""

import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Literal

from explorer.workers.call import Call
from explorer.workers.newest_wins import UPDATES
from rotor.support.processes import (
    Job,
    JobEnded,
    JobEvent,
    JobFailed,
    JobProgress,
    JobQueued,
    JobStarted,
    Processes,
)
from rotor.support.worker_process import Task

FRAME = 0.1
"""Between two progress reports that wake the page [s]; the end always does."""
WorkState = Literal[
    "starting", "waiting", "running", "stopping", "done", "stopped", "late", "broken"
]


@dataclass(frozen=True, eq=False)
class WorkRecord:
    task: Any
    state: WorkState = "starting"
    ahead: int = 0
    """Jobs before it, while it is waiting."""
    reports: tuple[Any, ...] = ()
    """What the task has reported."""
    result: Any = None
    sentence: str = ""
    """Why it is broken."""

    @property
    def under_way(self) -> bool:
        return self.state in ("starting", "waiting", "running", "stopping")

    def words(self, running: str, kept: str) -> str:
        """How it stands. `running`: what it does meanwhile; `kept`: what stays where it ends early."""
        match self.state:
            case "starting":
                return "Starting a worker …"
            case "waiting":
                return (
                    "Waiting: next in line" if self.ahead == 0 else f"Waiting: {self.ahead} ahead"
                )
            case "running":
                return running
            case "stopping":
                return "Stopping …"
            case "done":
                return "Done"
            case "stopped":
                return f"Stopped, {kept}"
            case "late":
                return f"Time is up, {kept}"
            case "broken":
                return f"Ended early, {kept}"

    def then(self, news: JobEvent) -> "WorkRecord":
        match news:
            case JobQueued(ahead):
                return replace(self, state="waiting", ahead=ahead)
            case JobStarted():
                return self if self.state == "stopping" else replace(self, state="running")
            case JobProgress(item):
                return replace(self, reports=(*self.reports, item))
            case JobEnded(result, stopped, late):
                return replace(
                    self, state="late" if late else "stopped" if stopped else "done", result=result
                )
            case JobFailed(message):
                return replace(self, state="broken", sentence=message)


class LongWork:
    """The long work of one page, one of each name at a time; safe from any thread."""

    def __init__(self, pool: Processes, wake: Callable[[], None]) -> None:
        """`wake`: the page follows."""
        self._pool, self._wake = pool, wake
        self._lock = threading.RLock()
        self._jobs: dict[str, Job] = {}
        self._woken = 0.0
        self._records: dict[str, WorkRecord] = {}

    def __getitem__(self, name: str) -> WorkRecord | None:
        """None before the first of this name."""
        return self._records.get(name)

    def begin(
        self, name: str, task: Task, limit: float, urgency: int = 0, *, restarts: bool = False
    ) -> None:
        """Begin, and end what has this name; where that is under way, only if it `restarts`. `limit`: of its time [s].

        `urgency`: as in `Processes.begin`.
        """
        with self._lock:  # Two quick presses come on two threads.
            record = self._records.get(name)
            if record is None or restarts or not record.under_way:
                self._silence(name)
                self._records = {**self._records, name: WorkRecord(task)}
                self._jobs[name] = self._pool.begin(
                    task, partial(self._heard, name, task), limit=limit, urgency=urgency
                )
        self._wake()

    def halt(self, name: str) -> None:
        """Stop what is under way, and keep what it found."""
        with self._lock:
            record = self._records.get(name)
            if record is None or not record.under_way:
                return
            self._records = {**self._records, name: replace(record, state="stopping")}
        self._pool.stop(self._jobs[name])
        self._wake()

    def stop(self) -> None:
        for name in tuple(self._jobs):
            self._silence(name)

    def _silence(self, name: str) -> None:
        """Nothing more is heard of it."""
        if name in self._jobs:
            self._pool.stop(self._jobs.pop(name), quiet=True)

    def _heard(self, name: str, task: Task, news: JobEvent) -> None:
        with self._lock:
            if self._records[name].task is not task:
                return
            self._records = {**self._records, name: self._records[name].then(news)}
        now = time.monotonic()
        if not isinstance(news, JobProgress) or now - self._woken > FRAME:
            self._woken = now
            self._wake()


_KEPT = 64
_LIMIT = 600.0
"""[s] for each task, by the clock: it needs seconds of a processor, of which a busy machine gives a worker little."""
_GIVES_WAY, _LOOKS_AGAIN_S = 7, 0.5
"""From this urgency on a task begins only while no page draws: else the workers take the processor from its frames."""
_LATE = "No answer after 10 minutes; the machine may be busy. Trying again."
_lock = threading.Lock()
_known: OrderedDict[Call, Any] = OrderedDict()


def all_known() -> dict[Hashable, Any]:
    """Every answer there is, of all pages."""
    with _lock:
        return {**_known}


class PoolAnswers:
    """Has the newest tasks answered, one at a time. A task under way runs to its end.

    One that is ended after its time is begun again once the others are answered.
    """

    def __init__(self, pool: Processes, urgency: int, answered: Callable[[], None]) -> None:
        """`answered` is called after every answer, on a thread of the pool."""
        self._pool, self._urgency, self._answered = pool, urgency, answered
        self._tasks: tuple[Call, ...] = ()
        self._failures: dict[Call, str] = {}
        self._job: Job | None = None
        """The task under way."""
        self._stopped = self._resting = False
        self._timer: threading.Timer | None = None
        self._lock = threading.RLock()

    def ask(self, tasks: tuple[Call, ...], delay: float) -> None:
        """Have these answered, the first one first, after so long [s]; what was asked before no longer."""
        with self._lock:
            changed = tasks != self._tasks
            if changed:
                self._failures.clear()
            self._tasks = tasks
            if self._next() is not None and (changed or self._timer is not None):
                self._next_after(delay)

    def answer(self, task: Call | None) -> Any:
        """What is known, or the sentence that says why there is no answer; None while it is being worked on."""
        with _lock:
            return None if task is None else _known.get(task, self._failures.get(task))

    @property
    def failures(self) -> dict[Hashable, str]:
        """Why there is no answer, by what is asked now."""
        with self._lock:
            return {**self._failures}

    def is_waiting(self) -> bool:
        """Whether an answer is still to come or to be told; takes no lock that is held while others are told."""
        begins = not self._resting and self._next() is not None
        return not self._stopped and (begins or self._job is not None)

    def rest(self, resting: bool) -> None:
        with self._lock:
            self._resting = resting
            if self._timer is None:
                self._next_one()

    def stop(self) -> None:
        with self._lock:
            self._stopped = True
            self._stop_timer()
        if self._job is not None:
            self._pool.stop(self._job, quiet=True)

    def _next_after(self, delay: float) -> None:
        self._stop_timer()
        self._timer = threading.Timer(delay, self._next_one)
        self._timer.daemon = True
        self._timer.start()

    def _stop_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
        self._timer = None

    def _next(self) -> Call | None:
        return next(
            (task for known in (None, _LATE) for task in self._tasks if self.answer(task) is known),
            None,
        )

    def _next_one(self) -> None:
        with self._lock:
            self._timer = None
            task = self._next()
            if self._job is not None or self._stopped or self._resting or task is None:
                return
            if self._urgency >= _GIVES_WAY and UPDATES.busy:
                self._next_after(_LOOKS_AGAIN_S)
            else:
                self._job = self._pool.begin(
                    task, partial(self._keep, task), limit=_LIMIT, urgency=self._urgency
                )

    def _keep(self, task: Call, news: JobEvent) -> None:
        match news:
            case JobEnded(result) if result is not None:
                with _lock:
                    _known[task] = result
                    while len(_known) > _KEPT:
                        _known.popitem(last=False)
            case JobFailed(message):
                self._failures[task] = message
            case JobEnded(late=True):
                self._failures[task] = _LATE
            case JobEnded():  # The server ends.
                pass
            case _:
                return
        self._answered()  # First: whoever sees that nothing is under way then knows that the answer was told.
        with self._lock:
            self._job = None
            if self._timer is None:
                self._next_one()
