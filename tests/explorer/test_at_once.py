"""Pages that drag, bend, climb, search and compute gradients at once: each ends at the answer of its design alone.

A hundred pages that come and go do not add to the memory. How long frames take: `tests.tools.measured`.
"""

import asyncio
import os
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from explorer.app import App
from explorer.hosting.server_limits import ServerLimits, release_memory
from explorer.session import Session
from explorer.workers.newest_wins import NewestWins
from rotor.support.bytes_cache import CACHE_BYTES, bytes_kept, limit_caches
from rotor.trim.analysis import power_gradient
from rotor.trim.solve import solve
from tests.explorer.test_leaving import searching
from tests.tools.visitor import Visitor, arrived, ran

PATIENCE = 900.0
"""[s]"""
SAME = 1e-7
"""Largest relative difference of a power from that of a solve alone, which starts elsewhere."""


def query(k: int) -> str:
    """The flight of a page: every second one bends, all have another height and speed."""
    bends = ";bending=true" if k % 2 else ""
    return f"?d=1;linear:-{4 + 0.5 * k:g};mu={0.14 + 0.012 * k:g};mass={7000 + 90 * k};alt={150 * k}{bends}"


STATM = Path("/proc/self/statm")


def resident() -> float:
    """Memory of this process [MB], where the system tells it as Linux does."""
    return int(STATM.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6 if STATM.exists() else float("nan")


async def work(visitor: Visitor, app: App, k: int, seconds: float) -> None:
    """Drag, and now and then search, or open what the doubt consists of, which needs the gradient."""
    await visitor.open(app.address)
    await visitor.until(lambda: visitor.text("status") == "converged", PATIENCE)
    await visitor.press("more", "on")
    await visitor.until(lambda: visitor.shows("Altitude [m]"), PATIENCE)
    end, step = time.monotonic() + seconds, 0
    while step == 0 or time.monotonic() < end:
        if step % 40 == 0 and k % 5 == 0:
            await searching(visitor, PATIENCE)
            await visitor.press("halt")
            await visitor.press("discard")
        elif step % 40 == 0 and k % 5 == 1:
            await visitor.press("drawer", "trust")
        shown = visitor.pictures
        if step % 2:
            await visitor.move("Altitude [m]", 50.0 * ((7 * k + 11 * step) % 60))
        else:
            await visitor.move("Adv. ratio µ", round(0.12 + 0.01 * ((5 * k + 3 * step) % 18), 3))
        await visitor.until(lambda shown=shown: visitor.pictures > shown, PATIENCE)
        await asyncio.sleep(0.15)
        step += 1
    await visitor.idle(PATIENCE, wholly=False)


def answers(session: Session) -> tuple[float, float]:
    """Relative difference of the page's power and of its gradient from those of the same design solved alone."""
    state = session.page.latest.state
    alone = solve(state.solution.design).require()
    here, there = power_gradient(state.solution).by_element, power_gradient(alone).by_element
    power = abs(state.solution.power.total / alone.power.total - 1.0)
    return power, float(abs(here - there).max() / abs(there).max())


def test_a_power_comes_with_its_frame_while_another_page_draws_charts(app: App):
    """It waited for them, and for the sweep of a blade that bends: once 187 s."""
    begun, go = threading.Event(), threading.Event()

    def charts() -> Iterator[float]:
        yield 0.0
        begun.set()
        assert go.wait(PATIENCE)

    other = NewestWins(charts, lambda _: None)

    async def visit() -> None:
        visitor = await arrived(app.address)
        await visitor.idle()
        other.wake()
        assert await asyncio.to_thread(begun.wait, PATIENCE)
        before = visitor.text("total-power")
        await visitor.move("Δ outboard [°/R]", -6.0)
        await visitor.until(lambda: visitor.text("total-power") != before, 60.0)
        await visitor.close()

    try:
        ran(visit)
    finally:
        go.set()
        other.stop()


@pytest.mark.slow
@pytest.mark.parametrize(("pages", "seconds"), [(4, 1.0), pytest.param(20, 600.0, marks=pytest.mark.nightly)])
def test_pages_at_once_end_at_the_answers_of_each_alone(app: App, pages: int, seconds: float):
    async def visit() -> tuple[list[str], list[Session]]:
        visitors = [Visitor(query=query(k)) for k in range(pages)]
        await asyncio.gather(*(work(visitor, app, k, seconds) for k, visitor in enumerate(visitors)))
        sessions, notices = list(app.sessions), [notice for visitor in visitors for notice in visitor.notices]
        for visitor in visitors:
            await visitor.close()
        return notices, sessions

    notices, sessions = ran(visit, seconds + 4.0 * PATIENCE)
    assert notices == []
    assert len(sessions) == pages
    states = [session.page.latest.state for session in sessions]
    designs = {state.solution.design for state in states if state is not None}
    assert len(designs) == pages
    assert sum(design.models.bending for design in designs) == pages // 2
    for session in sessions:
        power, gradient = answers(session)
        assert power < SAME
        assert gradient < 1e-5


@pytest.fixture
def small_caches() -> Iterator[App]:
    """A server whose caches are soon full."""
    app = App("127.0.0.1", 0, limits=ServerLimits(cache_bytes=128 * 2**20))
    app.wait_until_warm()
    yield app
    app.stop()
    limit_caches(CACHE_BYTES)


@pytest.mark.slow
@pytest.mark.nightly
@pytest.mark.skipif(not STATM.exists(), reason="the system does not tell how much memory a process has")
def test_memory_stays_the_same_while_a_hundred_pages_come_and_go(small_caches: App):
    """A page and the solutions that it leaves behind are given back."""
    sizes, app = list[float](), small_caches

    async def visit() -> None:
        for k in range(100):
            visitor = Visitor(query=query(k % 20))
            await visitor.open(app.address)
            await visitor.until(lambda visitor=visitor: visitor.text("status") == "converged", PATIENCE)
            await visitor.move("Adv. ratio µ", 0.25)
            await visitor.idle(PATIENCE, wholly=False)
            await visitor.close()
            while app.sessions:
                await asyncio.sleep(0.05)
            release_memory()
            sizes.append(resident())

    ran(visit, 10.0 * PATIENCE)
    print("after every tenth page [MB]:", *(f"{size:.0f}" for size in sizes[9::10]))
    assert bytes_kept() <= 128 * 2**20
    assert min(sizes[-10:]) - min(sizes[30:40]) < 40.0  # The caches are full by then.
