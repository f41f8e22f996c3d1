"""Pages that drag, bend, climb, search and compute gradients at once: each ends at the answer of its design alone.

A hundred pages that come and go do not add to the memory, and of one that leaves in any state nothing stays alive.
`pytest -s -m nightly -k at_once_end` prints how long twenty pages wait; without other work: `tests.tools.measured`.
"""

import asyncio
import gc
import logging
import os
import threading
import time
import weakref
from collections.abc import Awaitable, Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from explorer.app import App
from explorer.hosting.server_limits import ServerLimits, release_memory
from explorer.session import Session
from explorer.workers.newest_wins import NewestWins
from rotor.support.bytes_cache import CACHE_BYTES, bytes_kept, limit_caches
from rotor.trim.analysis import power_gradient
from rotor.trim.solve import solve
from tests.tools.visitor import Visitor, arrived, ran

PATIENCE = 900.0
"""[s]"""
PLACES = 20
"""Pages that a server takes here."""
SAME = 1e-7
"""Largest relative difference of a power from that of a solve alone, which starts elsewhere."""


def query(k: int) -> str:
    """The flight of a page: every second one bends; each has its own height, and a speed that `work` does not set."""
    bends = ";bending=true" if k % 2 else ""
    return f"?d=1;linear:-{4 + 0.5 * k:g};mu={0.145 + 0.012 * k:g};mass={7000 + 90 * k};alt={150 * k}{bends}"


STATM = Path("/proc/self/statm")


def resident() -> float:
    """Memory of this process [MB], where the system tells it as Linux does."""
    return (
        int(STATM.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6
        if STATM.exists()
        else float("nan")
    )


async def work(visitor: Visitor, app: App, k: int, seconds: float) -> list[float]:
    """Drag and rest as a hand does, now and then search, or open what the doubt consists of, which needs the gradient.

    Returns the time from each edit to its picture [s].
    """
    await visitor.open(app.address)
    await visitor.until(lambda: visitor.text("status") == "converged", PATIENCE)
    await visitor.press("more", "on")
    await visitor.until(lambda: visitor.shows("Altitude [m]"), PATIENCE)
    end, step, took = time.monotonic() + seconds, 0, list[float]()
    while step == 0 or time.monotonic() < end:
        if step % 40 == 0 and k % 5 == 0:
            await searching(visitor, PATIENCE)
            await visitor.press("halt")
            await visitor.press("discard")
        elif step % 40 == 0 and k % 5 == 1:
            await visitor.press("drawer", "trust")
        shown, begun = visitor.pictures, time.monotonic()
        if step % 2:
            await visitor.move("Altitude [m]", 50.0 * ((7 * k + 11 * step) % 60))
        else:
            await visitor.move("Adv. ratio µ", round(0.12 + 0.01 * ((5 * k + 3 * step) % 18), 3))
        await visitor.until(lambda shown=shown: visitor.pictures > shown, PATIENCE)
        took.append(time.monotonic() - begun)
        step += 1
        await asyncio.sleep(0.05 if step % 20 else 3.0)
    await visitor.idle(PATIENCE, wholly=False)
    return took


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
@pytest.mark.parametrize(
    ("pages", "seconds"), [(4, 1.0), pytest.param(PLACES, 600.0, marks=pytest.mark.nightly)]
)
def test_pages_at_once_end_at_the_answers_of_each_alone(app: App, pages: int, seconds: float):
    async def visit() -> tuple[list[str], list[Session]]:
        visitors = [Visitor(query=query(k)) for k in range(pages)]
        each = await asyncio.gather(
            *(work(visitor, app, k, seconds) for k, visitor in enumerate(visitors))
        )
        took = sorted(time for times in each for time in times)
        half, late = took[len(took) // 2], took[int(0.95 * len(took))]
        print(
            f"{len(took)} edits; from edit to picture: median {half:.2f} s, 95 of 100 within {late:.2f} s"
        )
        sessions, notices = (
            list(app.sessions),
            [notice for visitor in visitors for notice in visitor.notices],
        )
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
@pytest.mark.skipif(
    not STATM.exists(), reason="the system does not tell how much memory a process has"
)
def test_memory_stays_the_same_while_a_hundred_pages_come_and_go(small_caches: App):
    """A page and the solutions that it leaves behind are given back."""
    sizes, app = list[float](), small_caches

    async def visit() -> None:
        for k in range(100):
            visitor = Visitor(query=query(k % 20))
            await visitor.open(app.address)
            await visitor.until(
                lambda visitor=visitor: visitor.text("status") == "converged", PATIENCE
            )
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


def test_what_updates_free_is_returned_while_the_page_stays(
    app: App, monkeypatch: pytest.MonkeyPatch
):
    """glibc kept it, and one page went on growing."""
    asked = threading.Event()
    monkeypatch.setattr("explorer.session.trim_memory_soon", asked.set)

    async def visit() -> None:
        visitor = await arrived(app.address)
        await visitor.idle()
        asked.clear()
        await visitor.move("Adv. ratio µ", 0.25)
        await visitor.idle()
        assert asked.is_set()
        await visitor.close()

    ran(visit)


Act = Callable[[Visitor], Awaitable[None]]


async def plain(visitor: Visitor) -> None:
    await visitor.idle()


async def dragging(visitor: Visitor) -> None:
    await visitor.press("hold", True)
    for k in range(5):
        await visitor.move("Δ inboard [°/R]", -float(k))


async def holding_the_blade(visitor: Visitor) -> None:
    await visitor.press("grab_at", 1.0)
    await visitor.until(lambda: visitor.frame.get("twisting") is not None)
    await visitor.press("knot", [visitor.frame["twisting"]["knot"], [None, -4.0]])


async def comparing(visitor: Visitor) -> None:
    await visitor.press("pin")
    await visitor.move("Δ inboard [°/R]", -4.0)
    await visitor.until(lambda: bool(visitor.frame["bar"]["pinned"]))
    await visitor.press("difference", "on")


async def searching(visitor: Visitor, patience: float = 240.0) -> None:
    await visitor.press("mode", "optimise")
    await visitor.until(lambda: visitor.frame["bar"]["mode"] == "optimise", patience)
    await visitor.until(lambda: visitor.shows("Optimise"), patience)
    await visitor.move("Optimise", True)
    await visitor.until(lambda: visitor.frame.get("notice") is not None, patience)


async def asking_for_other_models(visitor: Visitor) -> None:
    """Leaves while workers look for the best linear twist and solve with other models."""
    await visitor.press("mode", "optimise")
    await visitor.press("drawer", "trust")
    await asyncio.sleep(0.8)


async def mapping(visitor: Visitor) -> None:
    await visitor.press("mode", "optimise")
    await visitor.press("task", "Map")
    await visitor.idle()
    await visitor.move("Compute map", True)


async def actuating(visitor: Visitor) -> None:
    await visitor.press("mode", "actuate")
    await visitor.until(lambda: visitor.frame.get("flight") is not None)
    await visitor.press("fly", 1.5)


async def in_the_lecture(visitor: Visitor) -> None:
    await visitor.press("drawer", "lecture")
    await visitor.idle()
    await visitor.move("Start the lecture", True)
    await visitor.until(lambda: visitor.frame.get("lecture") is not None)


async def over_the_disk(visitor: Visitor) -> None:
    await visitor.press("view", "disk")
    await visitor.press("play")
    await visitor.press("drawer", "probe")
    await visitor.until(lambda: visitor.frame.get("plan") is not None)


async def uploading(visitor: Visitor) -> None:
    """Half a file."""
    await visitor.press("drawer", "open")
    await visitor.idle()
    button = next(uuid for uuid, widget in visitor.widgets.items() if "mime_type" in widget)
    await visitor.send(
        "FileTransferStartUpload", source_component_uuid=button, transfer_uuid="t", filename="a.json",
        mime_type="application/json", part_count=2, size_bytes=20,
    )  # fmt: skip


async def at_once(visitor: Visitor) -> None:
    """Leaves while it is built."""
    del visitor


STATES: tuple[tuple[Act, dict[str, Any]], ...] = (
    (plain, {}),
    (plain, {"query": "?d=1;linear:-8;mu=0.3&a=1;linear:-2;mu=0.3"}),
    *((act, {}) for act in (dragging, holding_the_blade, comparing, searching, asking_for_other_models, mapping,
                            actuating, in_the_lecture, over_the_disk, uploading, at_once)),
)  # fmt: skip


@pytest.fixture
def app() -> Iterator[App]:
    app = App("127.0.0.1", 0, limits=ServerLimits(sessions=PLACES))
    yield app
    app.stop()


def seen_by(app: App, seen: list["weakref.ref[Session]"]) -> None:
    known = {id(one()) for one in seen}
    seen.extend(weakref.ref(one) for one in app.sessions if id(one) not in known)


def what_is_left(app: App, seen: list["weakref.ref[Session]"], threads: set[str]) -> list[str]:
    """Sessions and threads of pages that are alive, and workers that still compute."""
    gc.collect()
    left = ["session" for one in seen if one() is not None]
    new = {one.name for one in threading.enumerate()} - threads
    left += [name for name in new if name.startswith(("frame-", "welcome-", "goodbye-", "seat-"))]
    return left + ["worker"] * (len(app.pool._workers) - app.pool._idle)


def test_who_leaves_during_an_export_is_a_line_at_most(app: App, caplog: pytest.LogCaptureFixture):
    """*Picture* asks the page, which had gone: eleven lines of traceback."""

    async def export(name: str) -> None:
        visitor = await arrived(app.address)
        await visitor.press("drawer", "share")
        await visitor.idle(wholly=False)
        await visitor.move(name, True)
        await visitor.until(lambda: visitor.text("export") in ("busy", "done"))
        await visitor.close()

    async def visit() -> None:
        await asyncio.gather(*map(export, ("Picture", "Report", "Tables", "As-built STL")))
        while app.sessions or any(one.name == "export" for one in threading.enumerate()):
            await asyncio.sleep(0.05)

    ran(visit)
    (line,) = [record for record in caplog.records if record.levelno >= logging.WARNING]
    assert line.exc_info is None
    assert "export of Picture: The page sent no picture" in line.getMessage()


@pytest.mark.slow
def test_pages_that_leave_in_any_state_are_collected(app: App):
    """Twenty pages that stayed whole once took 290 MB."""
    seen: list[weakref.ref[Session]] = []
    threads = {thread.name for thread in threading.enumerate()}

    async def visit() -> None:
        visitors: list[Visitor] = []
        for act, options in STATES:
            visitor = Visitor(**options)
            visitors.append(visitor)
            await visitor.open(app.address)
            if act is not at_once:
                await visitor.until(lambda visitor=visitor: visitor.text("status") == "converged")
            await act(visitor)
            seen_by(app, seen)
        for visitor in reversed(visitors):
            await visitor.close()
        while app.sessions:
            await asyncio.sleep(0.05)

    ran(visit)
    # A busy machine answers late, and a session ends with its work.
    until = time.monotonic() + 180.0
    while (left := what_is_left(app, seen, threads)) and time.monotonic() < until:
        time.sleep(0.5)
    assert len(seen) >= len(STATES) - 1
    assert left == []
