"""Messages may be queued by any thread while the server's loop sends others."""

import asyncio
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import numpy.typing as npt
import pytest
from viser import _messages
from viser._assignable_props_api import AssignablePropsBase
from viser.infra import _infra

from explorer.hosting import viser_compat
from explorer.hosting.viser_compat import ThreadedBuffer

MESSAGES, THREADS = 300, 4


async def send_and_count() -> int:
    """How many messages arrive that threads have queued while the loop takes them out."""
    buffer = ThreadedBuffer(asyncio.get_running_loop(), persistent_messages=False)
    buffer.window_duration_sec = 0.0
    arrived = 0

    def queue(thread: int) -> None:
        for k in range(MESSAGES):
            buffer.push(_messages.RunJavascriptMessage(f"{thread}-{k}"))
            buffer.flush()

    async def take() -> None:
        nonlocal arrived
        async for window in buffer.window_generator(0):
            arrived += sum(isinstance(one, _messages.RunJavascriptMessage) for one in window)
            if arrived == THREADS * MESSAGES:
                return

    with ThreadPoolExecutor(THREADS) as threads:
        queued = [asyncio.wrap_future(threads.submit(queue, k)) for k in range(THREADS)]
        async with asyncio.timeout(90.0):
            await asyncio.gather(take(), *queued)
    buffer.set_done()
    return arrived


def test_all_messages_of_several_threads_arrive():
    assert asyncio.run(send_and_count()) == MESSAGES * THREADS


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


def test_servers_use_it():
    assert vars(_infra)["AsyncMessageBuffer"] is ThreadedBuffer


def test_plain_values_are_assigned_as_they_are_and_arrays_cast(monkeypatch: pytest.MonkeyPatch):
    """Without asking viser, which would compare types; an array still becomes one of the property's own type."""
    handle = AssignablePropsBase.__new__(AssignablePropsBase)
    made = handle._cast_value_recursive(npt.NDArray[np.float32], np.arange(3.0), "vertices")
    assert made.dtype == np.float32
    monkeypatch.setattr(viser_compat, "_cast", lambda *_: pytest.fail("asked viser"))
    for value in ("text", True, 3, 0.5, None):
        assert handle._cast_value_recursive(str, value, "content") is value
