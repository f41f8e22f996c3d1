"""Long work in worker processes: results in order, a stop that answers, a queue, and recovery from what goes wrong."""

import os
import signal
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from explorer.workers.pool import (
    Job,
    JobEnded,
    JobEvent,
    JobFailed,
    JobProgress,
    JobQueued,
    JobStarted,
    Pool,
)

SOON = 60.0
"""[s]; a process starts in two or three on a quiet machine."""


def pids_of(pool: Pool) -> tuple[int, ...]:
    """Ids of the processes that run."""
    return tuple(pid for worker in pool._workers if (pid := worker.pid) is not None)


@dataclass(frozen=True)
class Count:
    """Tells 1, 2, … with pauses, and returns how far it came."""

    to: int
    pause: float = 0.0

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> int:
        for k in range(self.to):
            if stop():
                return k
            time.sleep(self.pause)
            tell(k + 1)
        return self.to


@dataclass(frozen=True)
class Marking:
    """Makes a file when it begins, and returns 7 once there is another."""

    file: Path
    leave: Path

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> int:
        self.file.touch()
        while not self.leave.exists():
            time.sleep(0.01)
        return 7


@dataclass(frozen=True)
class Deaf:
    """Never asks whether to stop."""

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> None:
        tell("here")
        time.sleep(3600.0)


@dataclass(frozen=True)
class Failing:
    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> None:
        raise ValueError("a value that nobody wants")


@dataclass(frozen=True)
class Killed:
    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> None:
        os.kill(os.getpid(), signal.SIGKILL)


class Heard(list[JobEvent]):
    """News of one job."""

    def until(self, kind: type, seconds: float = SOON) -> Any:
        """The first event of that kind."""
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            for event in list(self):
                if isinstance(event, kind):
                    return event
            time.sleep(0.002)
        raise AssertionError(f"no {kind.__name__} in {seconds:g} s: {list(self)}")

    @property
    def items(self) -> list[Any]:
        return [event.item for event in self if isinstance(event, JobProgress)]


def submit(pool: Pool, task: Any, **how: Any) -> tuple[Job, Heard]:
    heard = Heard()
    return pool.submit(task, heard.append, **how), heard


@pytest.fixture(scope="module")
def pool() -> Iterator[Pool]:
    pool = Pool(1)
    pool.warm()
    yield pool
    pool.close()


def test_reports_in_order_and_returns(pool: Pool):
    _, heard = submit(pool, Count(5))
    assert heard.until(JobEnded) == JobEnded(5)
    assert heard.items == [1, 2, 3, 4, 5]


def stopped(pool: Pool, task: Any) -> tuple[float, JobEnded, Heard]:
    """How long a running task takes to stop [s], how it ended, and what was heard of it."""
    job, heard = submit(pool, task)
    heard.until(JobProgress)
    pressed = time.monotonic()
    pool.stop(job)
    ended = heard.until(JobEnded)
    return time.monotonic() - pressed, ended, heard


TRIES = 10
"""A busy machine may keep the process from answering in time, but not every time."""


def test_a_stop_answers_at_once_and_keeps_what_there_is(pool: Pool):
    answers: list[tuple[float, Any]] = []
    for _ in range(TRIES):
        took, ended, heard = stopped(pool, Count(10_000, 0.01))
        assert ended.stopped
        assert ended.result in (None, len(heard.items))
        answers.append((took, ended.result))
        if took < 0.3 and ended.result is not None:
            return
    pytest.fail(f"seconds and results of all answers: {answers}")


def test_positions_in_the_queue_are_honest(pool: Pool):
    first, running = submit(pool, Count(10_000, 0.01))
    running.until(JobProgress)
    second, next_in_line = submit(pool, Count(1))
    third, last = submit(pool, Count(1))
    _, urgent = submit(pool, Count(1), urgency=-1)
    assert next_in_line.until(JobQueued) == JobQueued(0)
    assert last.until(JobQueued) == JobQueued(1)
    assert urgent.until(JobQueued) == JobQueued(0)
    assert next_in_line[-1] == JobQueued(1)
    pool.stop(second)
    assert next_in_line.until(JobEnded).stopped
    assert last[-1] == JobQueued(1)
    pool.stop(first)
    last.until(JobEnded)
    assert [type(event) for event in urgent][-3:] == [JobStarted, JobProgress, JobEnded]
    assert third.over


def test_time_is_limited(pool: Pool):
    for _ in range(TRIES):
        _, heard = submit(pool, Count(10_000, 0.01), limit=0.1)
        ended = heard.until(JobEnded)
        assert ended.late
        assert ended.result in (None, len(heard.items))
        if ended.result is not None:
            return
    pytest.fail(f"none of {TRIES} tasks brought a result")


def test_a_task_that_fails_says_so_and_the_process_goes_on(pool: Pool):
    before = pids_of(pool)
    _, heard = submit(pool, Failing())
    assert "a value that nobody wants" in heard.until(JobFailed).message
    assert pids_of(pool) == before


def test_a_task_that_cannot_travel_says_so(pool: Pool):
    task: Any = Count(1)
    object.__setattr__(task, "to", lambda: 1)
    _, heard = submit(pool, task)
    assert heard.until(JobFailed).message
    _, heard = submit(pool, Count(1))
    assert heard.until(JobEnded) == JobEnded(1)


@pytest.mark.slow
def test_a_killed_process_is_reported_and_replaced(pool: Pool):
    _, heard = submit(pool, Killed())
    assert "ended unexpectedly" in heard.until(JobFailed).message
    _, heard = submit(pool, Count(3))
    assert heard.until(JobEnded) == JobEnded(3)


@pytest.mark.slow
def test_a_process_lost_while_idle_is_replaced_before_it_is_needed(pool: Pool):
    submit(pool, Count(1))[1].until(JobEnded)
    (before,) = pids_of(pool)
    os.kill(before, signal.SIGKILL)
    deadline = time.monotonic() + SOON
    while pids_of(pool) in ((), (before,)) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert pids_of(pool) not in ((), (before,))
    _, heard = submit(pool, Count(2))
    assert heard.until(JobEnded) == JobEnded(2)
    assert not any(isinstance(event, JobFailed) for event in heard)


@pytest.mark.slow
def test_a_process_that_will_not_stop_is_not_waited_for(pool: Pool):
    least = SOON
    for _ in range(3):  # Each takes a process.
        took, ended, _ = stopped(pool, Deaf())
        assert ended == JobEnded(None, stopped=True)
        least = min(least, took)
        if least < 0.35:
            break
    assert least < 0.35
    _, heard = submit(pool, Count(2))
    assert heard.until(JobEnded) == JobEnded(2)


def test_a_job_whose_browser_left_reports_nothing(pool: Pool):
    job, heard = submit(pool, Count(10_000, 0.01))
    heard.until(JobProgress)
    pool.stop(job, quiet=True)
    known = len(heard)
    _, other = submit(pool, Count(1))
    other.until(JobEnded)
    assert len(heard) == known


def test_a_result_can_be_waited_for_and_comes_later_when_superseded(pool: Pool, tmp_path: Path):
    found = list[int]()
    assert pool.result(Count(2), lambda: False, 0, found.append) == JobEnded(2)
    failed = pool.result(Failing(), lambda: False, 0, found.append)
    assert isinstance(failed, JobFailed)
    assert "a value that nobody wants" in failed.message
    begun, leave = tmp_path / "begun", tmp_path / "leave"
    assert pool.result(Marking(begun, leave), begun.exists, 0, found.append) is None
    leave.touch()
    _, after = submit(pool, Count(1))
    after.until(JobEnded)
    assert found == [2, 7]


@pytest.mark.slow
def test_a_page_that_cannot_hear_spoils_no_other_job(pool: Pool):
    """Its process was left at the first job, and the next one took the answer of that."""

    def fails(event: JobEvent) -> None:
        if isinstance(event, JobProgress):
            raise ZeroDivisionError("its browser has just left")

    pool.submit(Count(3, 0.05), fails)
    _, heard = submit(pool, Count(5))
    assert heard.until(JobEnded) == JobEnded(5)


def test_a_start_that_takes_too_long_shifts_no_answers(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("explorer.workers.pool._START", 0.05)
    pool = Pool(1)
    try:
        pool.warm()
        time.sleep(0.5)
        monkeypatch.undo()
        _, heard = submit(pool, Count(2))
        assert heard.until(JobEnded) == JobEnded(2)
    finally:
        pool.close()


def test_closing_ends_every_process():
    pool = Pool(1)
    _, heard = submit(pool, Count(10_000, 0.01))
    heard.until(JobProgress)
    pids = pids_of(pool)
    pool.close()
    assert pids
    assert pids_of(pool) == ()
    _, after = submit(pool, Count(1))
    assert after.until(JobFailed)
