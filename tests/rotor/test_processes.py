"""Processes of this machine: calls and jobs, their order and their stop, what goes wrong, none outlives its parent."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import pytest

from rotor.support.blas_threads import _libraries
from rotor.support.processes import (
    Job,
    JobEnded,
    JobEvent,
    JobFailed,
    JobProgress,
    JobQueued,
    JobStarted,
    Processes,
    WorkerLost,
    run_tasks,
)
from rotor.support.worker_process import _inherited
from tests.tools.measured import memory
from tests.waited import until

ROOT = Path(__file__).parent.parent.parent
PATIENCE = 120.0
"""[s], on a busy machine."""


class OddError(Exception):
    """Cannot be made again from what is pickled of it."""

    def __init__(self, first: str, second: str) -> None:
        super().__init__(f"{first} {second}")


def fail(kind: str) -> None:
    if kind == "odd":
        raise OddError("very", "odd")
    raise KeyError(kind)


def die() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def settings() -> tuple[int, set[int]]:
    """This process, and the threads of its BLAS libraries."""
    np.linalg.solve(np.eye(2), np.eye(2))
    return os.getpid(), {
        library.get_num_threads() for libraries in _libraries() for library in libraries
    }


def count(first: int, last: int, pause: float, stop: Callable[[], bool] | None) -> Iterator[int]:
    for k in range(first, last):
        if stop is not None and stop():
            return
        time.sleep(pause)
        yield k


def pids_of(pool: Processes) -> tuple[int, ...]:
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
class Deaf:
    """Never asks whether to stop."""

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> None:
        tell("here")
        time.sleep(3600.0)


@dataclass(frozen=True)
class Failing:
    error: Exception

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> None:
        raise self.error


@dataclass(frozen=True)
class Killed:
    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> None:
        os.kill(os.getpid(), signal.SIGKILL)


class Heard(list[JobEvent]):
    """News of one job."""

    def until(self, kind: type, seconds: float = PATIENCE) -> Any:
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


def begin(
    pool: Processes, task: Any, limit: float = PATIENCE, urgency: int = 0
) -> tuple[Job, Heard]:
    heard = Heard()
    return pool.begin(task, heard.append, limit, urgency), heard


def test_calls_return_raise_and_are_made_by_other_processes_with_one_blas_thread():
    with Processes(2) as pool:
        assert list(pool.map(pow, range(20), [2] * 20)) == [k**2 for k in range(20)]
        process, threads = pool.submit(settings).result(PATIENCE)
        assert process != os.getpid()
        assert threads <= {1}
        with pytest.raises(KeyError, match="x"):
            pool.submit(fail, "x").result(PATIENCE)
        with pytest.raises(RuntimeError, match="OddError: very odd"):
            pool.submit(fail, "odd").result(PATIENCE)
        with pytest.raises(Exception, match="pickle"):
            pool.submit(lambda: None).result(PATIENCE)
        assert pool.submit(pow, 2, 3).result(PATIENCE) == 8
    with pytest.raises(RuntimeError, match="shut down"):
        pool.submit(pow, 2, 3)


def test_a_process_that_starts_leaves_the_environment_to_other_threads(
    monkeypatch: pytest.MonkeyPatch,
):
    """One that read it meanwhile ended with `KeyError: 'OMP_NUM_THREADS'`."""
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    before = dict(os.environ)
    with _inherited():
        assert dict(os.environ) == before
    with Processes(1) as pool:
        assert pool.submit(os.getenv, "OMP_NUM_THREADS").result(PATIENCE) == "1"
    assert subprocess.run(["printenv", "OMP_NUM_THREADS"], capture_output=True).stdout == b""


@pytest.mark.skipif(sys.platform != "linux", reason="the system does not tell what processes share")
def test_measured_memory_counts_a_process_that_a_thread_begins():
    """Of a server no worker was counted."""
    with Processes(1) as pool:
        worker, own = pool.submit(os.getpid).result(), psutil.Process().memory_full_info().pss / 1e6
        assert memory(os.getpid()) > own + 0.5 * memory(worker)


def test_a_listener_that_fails_leaves_its_process_at_no_other_call():
    with Processes(1) as pool:

        def fail_to_hear(item: Any) -> None:
            raise ZeroDivisionError(item)

        with pytest.raises(ZeroDivisionError):
            pool.stream([(count, (0, 50, 0.01))], fail_to_hear)
        assert pool.submit(pow, 2, 3).result(PATIENCE) == 8


def test_a_lost_process_costs_its_own_call_and_is_replaced():
    with Processes(1) as pool:
        lost, next_call = pool.submit(die), pool.submit(pow, 2, 3)
        with pytest.raises(WorkerLost, match="use fewer processes"):
            lost.result(PATIENCE)
        assert next_call.result(PATIENCE) == 8
        _, heard = begin(pool, Killed())
        assert "ended unexpectedly" in heard.until(JobFailed).message
        assert pool.submit(pow, 2, 3).result(PATIENCE) == 8


def test_a_shutdown_ends_calls_at_once_where_asked():
    pool = Processes(1)
    process, _ = pool.submit(settings).result(PATIENCE)
    begun = time.monotonic()
    calls = [pool.submit(time.sleep, 3600.0) for _ in range(2)]
    _, waiting = begin(pool, Count(1))
    pool.shutdown(cancel_futures=True)
    assert time.monotonic() - begun < PATIENCE
    assert not lives(process)
    assert pids_of(pool) == ()
    assert waiting.until(JobEnded) == JobEnded(None, stopped=True)
    assert all(call.done() for call in calls)
    _, after = begin(pool, Count(1))
    assert "shut down" in after.until(JobFailed).message


@pytest.mark.parametrize("processes", [0, 2])
def test_items_come_in_order_until_a_stop(processes: int):
    items: list[int] = []
    pool = Processes(processes) if processes else None
    tasks = [(count, (100 * k, 100 * k + 5, 0.0)) for k in range(3)]
    assert not run_tasks(pool, tasks, items.append, None)
    assert sorted(items) == [100 * k + j for k in range(3) for j in range(5)]
    assert [item for item in items if item < 100] == [0, 1, 2, 3, 4]
    items.clear()
    endless = [(count, (0, 10**9, 0.001))]
    assert run_tasks(pool, endless, items.append, lambda: len(items) > 3)
    assert items == list(range(len(items)))
    with pytest.raises(WorkerLost) if processes else pytest.raises(TypeError):
        run_tasks(pool, [(_dying, ()) if processes else (count, ())], items.append, None)
    if pool is not None:
        pool.shutdown()


def _dying(stop: Callable[[], bool]) -> Iterator[int]:
    yield 1
    die()


@pytest.fixture(scope="module")
def pool() -> Iterator[Processes]:
    pool = Processes(1, settings)
    pool.warm()
    yield pool
    pool.shutdown(cancel_futures=True)


def stopped(pool: Processes, task: Any) -> tuple[float, JobEnded, Heard]:
    """How long a running task takes to stop [s], how it ended, and what was heard of it."""
    job, heard = begin(pool, task)
    heard.until(JobProgress)
    pressed = time.monotonic()
    pool.stop(job)
    ended = heard.until(JobEnded)
    return time.monotonic() - pressed, ended, heard


TRIES = 10
"""A busy machine may keep the process from answering in time, but not every time."""


def test_a_stop_answers_at_once_and_keeps_what_there_is(pool: Processes):
    answers: list[tuple[float, Any]] = []
    for _ in range(TRIES):
        took, ended, heard = stopped(pool, Count(10_000, 0.01))
        assert ended.stopped
        assert ended.result in (None, len(heard.items))
        answers.append((took, ended.result))
        if took < 0.3 and ended.result is not None:
            return
    pytest.fail(f"seconds and results of all answers: {answers}")


def test_positions_in_the_queue_are_honest(pool: Processes):
    first, running = begin(pool, Count(10_000, 0.01))
    running.until(JobProgress)
    second, next_in_line = begin(pool, Count(1))
    third, last = begin(pool, Count(1))
    _, urgent = begin(pool, Count(1), urgency=-1)
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


def test_time_is_limited(pool: Processes):
    for _ in range(TRIES):
        _, heard = begin(pool, Count(10_000, 0.01), limit=0.1)
        ended = heard.until(JobEnded)
        assert ended.late
        assert ended.result in (None, len(heard.items))
        if ended.result is not None:
            return
    pytest.fail(f"none of {TRIES} tasks brought a result")


def test_a_task_that_fails_says_so_and_the_process_goes_on(pool: Processes):
    begin(pool, Count(1))[1].until(JobEnded)
    before = pids_of(pool)
    for error, words in (
        (ValueError("a bad value"), "a bad value"),
        (MemoryError(), "needs more memory than is free"),
    ):
        _, heard = begin(pool, Failing(error))
        assert words in heard.until(JobFailed).message
    _, heard = begin(pool, Count(5))
    assert heard.until(JobEnded) == JobEnded(5)
    assert heard.items == [1, 2, 3, 4, 5]
    assert pids_of(pool) == before


@pytest.mark.slow
def test_a_process_lost_while_idle_is_replaced_before_it_is_needed(pool: Processes):
    begin(pool, Count(1))[1].until(JobEnded)
    (before,) = pids_of(pool)
    os.kill(before, signal.SIGKILL)
    until(lambda: pids_of(pool) not in ((), (before,)))
    _, heard = begin(pool, Count(2))
    assert heard.until(JobEnded) == JobEnded(2)
    assert not any(isinstance(event, JobFailed) for event in heard)


@pytest.mark.slow
def test_a_process_that_will_not_stop_is_not_waited_for(pool: Processes):
    least = PATIENCE
    for _ in range(TRIES):  # Each takes a process.
        took, ended, _ = stopped(pool, Deaf())
        assert ended == JobEnded(None, stopped=True)
        least = min(least, took)
        if least < 0.35:
            break
    assert least < 0.35
    _, heard = begin(pool, Count(2))
    assert heard.until(JobEnded) == JobEnded(2)


def test_a_job_whose_browser_left_reports_nothing(pool: Processes):
    job, heard = begin(pool, Count(10_000, 0.01))
    heard.until(JobProgress)
    pool.stop(job, quiet=True)
    known = len(heard)
    _, other = begin(pool, Count(1))
    other.until(JobEnded)
    assert len(heard) == known


def test_a_page_that_cannot_hear_spoils_no_other_job(pool: Processes):
    """Its process was left at the first job, and the next one took the answer of that."""

    def fails(event: JobEvent) -> None:
        if isinstance(event, JobProgress):
            raise ZeroDivisionError("its browser has just left")

    pool.begin(Count(3, 0.05), fails)
    _, heard = begin(pool, Count(5))
    assert heard.until(JobEnded) == JobEnded(5)


def test_a_start_that_takes_too_long_shifts_no_answers(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("rotor.support.processes._START_S", 0.05)
    pool = Processes(1, settings)
    try:
        pool.warm()
        time.sleep(0.5)
        monkeypatch.undo()
        _, heard = begin(pool, Count(2))
        assert heard.until(JobEnded) == JobEnded(2)
    finally:
        pool.shutdown(cancel_futures=True)


_PARENT = """
import os, sys, time
from rotor.support.processes import Processes
pool = Processes(2)
print(*{pool.submit(os.getpid).result() for _ in range(20)}, flush=True)
pool.submit(time.sleep, 3600.0)
time.sleep(0.5)
os.kill(os.getpid(), int(sys.argv[1]))
time.sleep(60.0)
"""


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL])
def test_processes_end_with_a_parent_that_was_killed(number: int):
    """The one in the midst of a call too; nothing is said of what a semaphore left."""
    command = [sys.executable, "-c", _PARENT, str(int(number))]
    parent = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=PATIENCE)
    assert (parent.returncode, parent.stderr) == (-number, "")
    processes = [int(word) for word in parent.stdout.split()]
    assert processes
    until(lambda: not any(map(lives, processes)))


def lives(process: int) -> bool:
    with suppress(psutil.NoSuchProcess):
        return psutil.Process(process).status() != psutil.STATUS_ZOMBIE
    return False
