"""Processes of this machine: results and errors of calls, lost processes, stops, and none that outlives its parent."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import pytest

from rotor.blas_threads import _libraries
from rotor.processes import Processes, WorkerLost, WorkerProcess, run_tasks

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
    return os.getpid(), {library.get_num_threads() for libraries in _libraries() for library in libraries}


def count(first: int, last: int, pause: float, stop: Callable[[], bool] | None) -> Iterator[int]:
    for k in range(first, last):
        if stop is not None and stop():
            return
        time.sleep(pause)
        yield k


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


def echo(value: Any, pause: float = 0.0) -> Any:
    time.sleep(pause)
    return value


def test_no_call_takes_the_answer_of_one_that_was_given_up():
    """A warm-up of more than a minute was given up; from then on each job had the answer of the one before."""
    process = WorkerProcess("late")
    try:
        process.call(echo, "first", 0.5)
        process.call(echo, "second")
        begin, reply = time.monotonic(), None
        while reply is None and time.monotonic() < begin + PATIENCE:
            reply = process.receive(0.1)
        assert reply is not None
        assert reply.value == "second"
    finally:
        process.close()


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


def test_a_shutdown_ends_calls_at_once_where_asked():
    pool = Processes(1)
    process, _ = pool.submit(settings).result(PATIENCE)
    begin = time.monotonic()
    calls = [pool.submit(time.sleep, 3600.0) for _ in range(2)]
    pool.shutdown(cancel_futures=True)
    assert time.monotonic() - begin < PATIENCE
    assert not lives(process)
    assert all(call.done() for call in calls)


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


_PARENT = """
import os, sys, time
from rotor.processes import Processes
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


def until(true: Callable[[], bool]) -> None:
    begin = time.monotonic()
    while not true():
        assert time.monotonic() - begin < PATIENCE, "waited too long"
        time.sleep(0.05)


COMMANDS = {
    "schedule": ["--starts", "100", "--processes", "2"],
    "reproduce": ["OUT", "--processes", "2"],
    "study": ["two_segment.toml", "--workers", "2", "--out", "OUT"],
}


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_that_is_ended_leaves_no_process(name: str, number: int, tmp_path: Path):
    """While its processes are at work."""
    words = [str(tmp_path / "out") if word == "OUT" else word for word in COMMANDS[name]]
    run = subprocess.Popen(
        [sys.executable, "-m", "rotor", name, *words], cwd=ROOT, text=True, start_new_session=True,
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
    )  # fmt: skip
    try:

        def at_work() -> bool:
            assert run.poll() is None
            children = psutil.Process(run.pid).children(recursive=True)
            return sum(child.cpu_times().user > 2.0 for child in children) == 2

        until(at_work)
        family = psutil.Process(run.pid).children(recursive=True)
        os.killpg(run.pid, number) if number == signal.SIGINT else run.send_signal(number)
        _, said = run.communicate(timeout=PATIENCE)
        assert run.returncode == (130 if number == signal.SIGINT else -number)
        assert "semaphore" not in said
        assert "Traceback" not in said
        until(lambda: not any(lives(child.pid) for child in family))
    finally:
        run.kill()
        run.communicate()
