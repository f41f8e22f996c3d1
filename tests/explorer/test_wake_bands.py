"""The bands of a free wake's power on the page: asked for once, in the pool, and shown only beside their own design."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from explorer.interface import SessionState
from explorer.state import Inputs, ViewState
from explorer.tabs.power_card import WakeBandJobs
from explorer.text import comparison, readout
from explorer.text.readout import WakeBands
from explorer.workers.job import Job, JobEnded, JobEvent
from explorer.workers.tasks import PowerBandTask, WorthBandTask
from rotor.files.make_design import make_design
from rotor.trim.solution import Solution
from rotor.trim.solve import solve


class Pool:
    """Holds the jobs of a page until they are done."""

    def __init__(self) -> None:
        self.jobs: list[Job] = []
        self.abandoned: list[Job] = []

    def submit(self, task: Any, on_event: Callable[[JobEvent], None], urgency: int) -> Job:
        self.jobs.append(Job(len(self.jobs), task, on_event, 60.0, urgency))
        return self.jobs[-1]

    def abandon(self, job: Job) -> None:
        self.abandoned.append(job)

    def do(self, job: Job) -> None:
        job.tell(JobEnded(job.task.run(lambda _: None, lambda: False)))


def hovering(twist: str, inflow: Any = "free-wake") -> Solution:
    design = make_design(hover=True, twist=twist)
    models = replace(design.models, hover_inflow=inflow, elements=20, elastic_twist=False)
    return solve(replace(design, models=models)).require()


@pytest.fixture(scope="module")
def twisted() -> Solution:
    return hovering("linear:-12")


@pytest.fixture(scope="module")
def built() -> Solution:
    return hovering("linear:-8")


def state(solution: Solution, reference: Solution) -> SessionState:
    return SessionState(Inputs(advance_ratio=0.0), ViewState(), solution, reference, None)


def test_bands_come_from_the_pool_once_and_belong_to_their_design(
    twisted: Solution, built: Solution, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(Solution, "worth_band", lambda *_: (-0.01, 0.02))  # It takes seconds.
    pool, heard = Pool(), []
    bands: Any = WakeBandJobs(pool, lambda: heard.append(1))  # pyright: ignore[reportArgumentType]
    now = state(twisted, built)
    for _ in range(2):
        bands.settle(now)
        bands.rest(now)
    assert [type(job.task) for job in pool.jobs] == [PowerBandTask, WorthBandTask]
    assert bands.of(now) == WakeBands()
    assert not heard
    for job in list(pool.jobs):
        pool.do(job)
    assert bands.of(now) == WakeBands(twisted.power_band, (-0.01, 0.02))
    assert len(heard) == 2
    assert bands.of(state(built, built)) == WakeBands()
    bands.settle(state(built, built))
    bands.rest(state(built, built))  # It is worth nothing to itself.
    assert len(pool.jobs) == 3
    assert pool.abandoned == [pool.jobs[0]]
    assert bands.of(now).power is None  # The newest design's alone are kept.


def test_without_a_free_wake_nothing_is_asked(built: Solution):
    pool = Pool()
    bands: Any = WakeBandJobs(pool, lambda: None)  # pyright: ignore[reportArgumentType]
    annulus = hovering("linear:-12", "annulus")
    for now in (state(annulus, built), state(replace(built, settled=False), built)):
        bands.settle(now)
        bands.rest(now)
    bands.rest(state(built, annulus))
    assert pool.jobs == []


def test_read_out_states_the_bands(twisted: Solution, built: Solution):
    bands = WakeBands((-0.04, 0.014), (-0.004, 0.024))
    rotor = 1e-3 * twisted.power.main_rotor
    digits = readout.fineness(twisted.power)
    for html in (
        readout.power_panel(twisted, built, bands=bands),
        comparison.power_panel(twisted, built, bands=bands),
    ):
        power = f"{readout.span((-0.04 * rotor, 0.014 * rotor), digits)} kW (−4.0…+1.4 %)"
        assert power in html
        assert "−0.4…+2.4 %" in html
    assert "roll-up" not in readout.power_panel(twisted, built)
