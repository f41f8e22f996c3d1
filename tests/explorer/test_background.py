"""What a button begins and a worker process does, without a page: begun once, stopped, begun anew, and heard of."""

from collections.abc import Callable
from typing import Any

import pytest

from explorer.workers.background import BackgroundWork
from rotor.support.processes import Job, JobEnded, JobEvent, JobFailed, JobProgress, JobStarted


class FakePool:
    """Keeps the jobs; the test tells them what happens."""

    def __init__(self) -> None:
        self.jobs: list[Job] = []
        self.stopped: list[tuple[int, bool]] = []

    def begin(self, task: Any, on_event: Callable[[JobEvent], None], limit: float, urgency: int) -> Job:
        self.jobs.append(Job(len(self.jobs), task, on_event, limit, urgency))
        return self.jobs[-1]

    def stop(self, job: Job, quiet: bool = False) -> None:
        self.stopped.append((job.number, quiet))
        if quiet:
            job.silence()


class Work(BackgroundWork):
    """Hears of whatever it is told."""

    problem = ""

    def prepare(self) -> tuple[Any, Callable[[JobEvent], None], str]:
        if self.problem:
            raise ValueError(self.problem)
        self.news: list[JobEvent] = []
        return "task", self.news.append, "Computing …"


class Bench:
    def __init__(self, *, restarts: bool = False) -> None:
        self.pool, self.woken = FakePool(), 0
        pool: Any = self.pool
        self.work = Work(pool, self.wake, 60.0, 2, restarts=restarts)

    def wake(self) -> None:
        self.woken += 1


def test_it_begins_once_and_again_after_its_end():
    bench = Bench()
    bench.work.begin()
    bench.work.begin()
    assert (len(bench.pool.jobs), bench.work.running, bench.work.line) == (1, True, "Computing …")
    assert (bench.pool.jobs[0].limit, bench.pool.jobs[0].urgency) == (60.0, 2)
    bench.pool.jobs[0].tell(JobEnded("found"))
    assert not bench.work.running
    assert bench.work.news == [JobEnded("found")]
    bench.work.begin()
    assert len(bench.pool.jobs) == 2


def test_begun_anew_nothing_is_heard_of_the_first():
    bench = Bench(restarts=True)
    bench.work.begin()
    bench.work.begin()
    first, second = bench.pool.jobs
    assert bench.pool.stopped == [(0, True)]
    first.tell(JobFailed("late"))
    assert (bench.work.news, bench.work.running) == ([], True)
    second.tell(JobStarted())
    assert bench.work.news == [JobStarted()]


def test_what_cannot_begin_is_a_sentence():
    bench = Bench()
    bench.work.problem = "Choose two axes."
    bench.work.begin()
    assert (bench.pool.jobs, bench.work.running, bench.work.line) == ([], False, "Choose two axes.")
    assert bench.woken == 1


def test_halt_keeps_what_is_found_and_leaving_is_quiet():
    bench = Bench()
    bench.work.halt()
    assert bench.pool.stopped == []
    bench.work.begin()
    bench.work.halt()
    bench.work.stop()
    assert bench.pool.stopped == [(0, False), (0, True)]


@pytest.mark.parametrize("end", [JobEnded(None), JobFailed("no")])
def test_the_page_wakes_for_the_end_however_soon(end: JobEvent):
    bench = Bench()
    bench.work.begin()
    job = bench.pool.jobs[0]
    for _ in range(50):
        job.tell(JobProgress(1))
    before = bench.woken
    assert before < 50  # A frame stays a while; all are heard of.
    assert len(bench.work.news) == 50
    job.tell(end)
    assert bench.woken == before + 1
