"""What a button begins and a worker process does, without a page: begun once, stopped, begun anew, and heard of."""

from collections.abc import Callable
from typing import Any

import pytest

from explorer.workers.background import LongWork, WorkRecord
from rotor.support.processes import (
    Job,
    JobEnded,
    JobEvent,
    JobFailed,
    JobProgress,
    JobQueued,
    JobStarted,
)


class FakePool:
    """Keeps the jobs; the test tells them what happens."""

    def __init__(self) -> None:
        self.jobs: list[Job] = []
        self.stopped: list[tuple[int, bool]] = []

    def begin(
        self, task: Any, on_event: Callable[[JobEvent], None], limit: float, urgency: int
    ) -> Job:
        self.jobs.append(Job(len(self.jobs), task, on_event, limit, urgency))
        return self.jobs[-1]

    def stop(self, job: Job, quiet: bool = False) -> None:
        self.stopped.append((job.number, quiet))
        if quiet:
            job.silence()


class Bench:
    def __init__(self) -> None:
        self.pool, self.woken = FakePool(), 0
        pool: Any = self.pool
        self.work = LongWork(pool, self.wake)

    def begin(self, task: str = "task", *, restarts: bool = False) -> None:
        self.work.begin("search", task, 60.0, 2, restarts=restarts)  # pyright: ignore[reportArgumentType]

    @property
    def record(self) -> WorkRecord:
        record = self.work["search"]
        assert record is not None
        return record

    def wake(self) -> None:
        self.woken += 1


def test_it_begins_once_and_again_after_its_end():
    bench = Bench()
    assert bench.work["search"] is None
    bench.begin()
    bench.begin()
    assert (len(bench.pool.jobs), bench.record.state) == (1, "starting")
    assert (bench.pool.jobs[0].limit, bench.pool.jobs[0].urgency) == (60.0, 2)
    bench.pool.jobs[0].tell(JobEnded("found"))
    assert (bench.record.state, bench.record.result, bench.record.under_way) == (
        "done",
        "found",
        False,
    )
    bench.begin()
    assert len(bench.pool.jobs) == 2


def test_begun_anew_nothing_is_heard_of_the_first():
    bench = Bench()
    bench.begin()
    bench.begin("other", restarts=True)
    first, second = bench.pool.jobs
    assert bench.pool.stopped == [(0, True)]
    first.tell(JobFailed("late"))
    bench.work._heard("search", first.task, JobFailed("on its way"))
    assert (bench.record.task, bench.record.state) == ("other", "starting")
    second.tell(JobStarted())
    assert bench.record.state == "running"


def test_a_record_follows_the_news():
    record = WorkRecord("task").then(JobQueued(2))
    assert record.words("running", "kept") == "Waiting: 2 ahead"
    record = record.then(JobStarted()).then(JobProgress(1)).then(JobProgress(2))
    assert (record.reports, record.words("running", "kept")) == ((1, 2), "running")
    assert record.then(JobEnded(3)).words("running", "kept") == "Done"
    assert record.then(JobEnded(None, stopped=True)).words("running", "kept") == "Stopped, kept"
    assert record.then(JobEnded(None, late=True)).words("running", "kept") == "Time is up, kept"
    broken = record.then(JobFailed("It was lost."))
    assert (broken.sentence, broken.words("running", "kept")) == (
        "It was lost.",
        "Ended early, kept",
    )


def test_halt_keeps_what_is_found_and_leaving_is_quiet():
    bench = Bench()
    bench.work.halt("search")
    assert bench.pool.stopped == []
    bench.begin()
    bench.work.halt("search")
    bench.pool.jobs[0].tell(JobStarted())
    assert bench.record.state == "stopping"
    bench.work.stop()
    assert bench.pool.stopped == [(0, False), (0, True)]


@pytest.mark.parametrize("end", [JobEnded(None), JobFailed("no")])
def test_the_page_wakes_for_the_end_however_soon(end: JobEvent):
    bench = Bench()
    bench.begin()
    job = bench.pool.jobs[0]
    for _ in range(50):
        job.tell(JobProgress(1))
    before = bench.woken
    assert before < 50  # A frame stays a while; all are heard of.
    assert len(bench.record.reports) == 50
    job.tell(end)
    assert bench.woken == before + 1
