"""Pages that leave in every state there is: nothing of them stays alive on the server."""

import asyncio
import gc
import logging
import threading
import time
import weakref
from collections.abc import Awaitable, Callable, Iterator
from typing import Any

import pytest

from explorer.app import App
from explorer.hosting.server_limits import ServerLimits
from explorer.session import Session
from explorer.sharing.presentation import PRESENT, follow_name
from tests.tools.visitor import Visitor, arrived, ran

Act = Callable[[Visitor], Awaitable[None]]
SECRET = "a-secret"
PLACES = 16


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
    (plain, {"kept": {PRESENT: SECRET}, "page": "one"}),
    (plain, {"query": f"?follow={follow_name(SECRET)}", "page": "two"}),
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
    """A presenter's page once stayed whole: 20 of them took 290 MB."""
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
    until = time.monotonic() + 180.0  # A busy machine answers late, and a session ends with its work.
    while (left := what_is_left(app, seen, threads)) and time.monotonic() < until:
        time.sleep(0.5)
    assert len(seen) >= len(STATES) - 1
    assert left == []
    assert app.presentations._watchers == {}
    assert app.presentations._presenters == {}
    assert not any(app.presentations._listeners.values())
