"""Each change to viser and websockets, for the versions it is for; when one fails, the pin may not move.

Elsewhere, with a server behind them: the filter of requests, the tunnel and uploads in `test_request_filter.py`, values
and quick callbacks in `test_values.py`; what is changed in the client, in `tests/browser/test_viser_client.py`.
"""

import asyncio
import threading
from collections.abc import Iterator
from concurrent.futures import Future
from importlib.metadata import requires, version
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
import viser
from viser import _gui_api, _messages, _viser

from explorer.hosting import viser_compat
from explorer.hosting.viser_compat import ThreadedBuffer


def test_a_thread_does_not_touch_what_waits_on_the_loop():
    """asyncio's own event, set by another thread, walks through the waiting tasks while the loop changes them."""

    async def wait() -> None:
        buffer = ThreadedBuffer(asyncio.get_running_loop(), persistent_messages=False)
        event = buffer.message_event
        waiting = asyncio.ensure_future(event.wait())
        await asyncio.sleep(0)
        (waiter,) = event._waiters
        thread = threading.Thread(target=event.set)
        thread.start()
        thread.join()
        assert event.is_set()
        assert not waiter.done()
        event.set()
        assert await asyncio.wait_for(waiting, 60.0)

    asyncio.run(wait())


def test_a_message_to_a_browser_that_has_left_is_no_warning():
    async def late() -> None:
        buffer = ThreadedBuffer(asyncio.get_running_loop(), persistent_messages=False)
        buffer.set_done()
        buffer.push(_messages.RunJavascriptMessage("late"))  # A warning is an error in these tests.

    asyncio.run(late())


@pytest.fixture
def server() -> Iterator[viser.ViserServer]:
    server = viser_compat.quiet_server("127.0.0.1", 0, "test")
    yield server
    viser_compat.quiet_stop(server)


def test_a_node_is_placed_as_its_setters_place_it(server: viser.ViserServer):
    """It sends the messages of the setters, and none for what stays."""
    one, other = (server.scene.add_frame(name) for name in ("/one", "/other"))
    queued: list[Any] = []
    cast(Any, server._websock_server).queue_message = queued.append
    turn, way = np.array([0.6, 0.0, 0.8, 0.0]), np.array([1.0, -2.0, 3.0])
    one.wxyz, one.position = turn, way
    viser_compat.set_pose(other, turn, way)
    theirs, ours = ([vars(message) for message in half] for half in (queued[:2], queued[2:]))
    assert [{**fields, "name": ""} for fields in theirs] == [
        {**fields, "name": ""} for fields in ours
    ]
    assert list(map(type, queued[:2])) == list(map(type, queued[2:]))
    assert np.array_equal(other.wxyz, turn)
    assert np.array_equal(other.position, way)
    viser_compat.set_pose(other, turn.copy(), way.copy())
    viser_compat.set_pose(other, turn)
    assert len(queued) == 4
    way[0] = 9.0  # What was sent is nobody else's.
    assert other.position[0] == 1.0


def test_a_camera_is_aimed_as_its_setters_aim_it():
    """It sends the messages of the setters, and none for what stays."""
    queued: list[Any] = []
    connection = SimpleNamespace(
        queue_message=lambda message: queued.append((type(message), vars(message)))
    )
    one, other = (
        viser.CameraHandle(cast(Any, SimpleNamespace(_websock_connection=connection)))
        for _ in range(2)
    )
    for camera in (one, other):
        state = camera._state
        state.update_timestamp, state.up_direction, state.look_at = (
            1.0,
            np.array([0.0, 0.0, 1.0]),
            np.ones(3),
        )
    position, target = np.array([5.0, -4.0, 3.0]), np.array([1.0, 0.5, 0.0])
    one.position, one.look_at = position, target
    theirs = dict(queued)  # Of each kind the last one counts.
    queued.clear()
    viser_compat.aim(other, position, target)
    assert dict(queued) == theirs
    assert (other.position == position).all()
    assert (other.look_at == target).all()
    viser_compat.aim(other, position.copy(), target.copy())
    assert len(queued) == 2


def test_a_callback_that_fails_is_logged_and_not_printed(
    server: viser.ViserServer, caplog: pytest.LogCaptureFixture, capsys: pytest.CaptureFixture[str]
):
    viser_compat.log_failed_callbacks()
    failed: Future[None] = Future()
    failed.set_exception(ZeroDivisionError("one over nothing"))
    for module in (_gui_api, _viser):
        cast(Any, module).print_threadpool_errors(failed)
    assert caplog.text.count("one over nothing") == 2
    assert capsys.readouterr() == ("", "")


def test_the_versions_are_those_that_the_changes_are_for():
    assert viser.__version__ == viser_compat.VISER
    assert version("websockets").rsplit(".", 1)[0] == viser_compat.WEBSOCKETS
    project = (Path(__file__).parents[3] / "pyproject.toml").read_text(encoding="utf-8")
    assert f'"viser=={viser_compat.VISER}"' in project
    assert f'"websockets>={viser_compat.WEBSOCKETS},<17"' in project
    assert "websockets<17.0.0,>=13.1" in (requires("viser") or []), (
        "viser allows other versions now: so may we"
    )
    client = (Path(viser_compat.__file__).parents[1] / "web" / "viser.js").read_text(
        encoding="utf-8"
    )
    assert f"viser {viser_compat.VISER}" in client.splitlines()[1]
