"""A page that is idle shows what workers answered, too."""

import asyncio
import threading

from explorer.app import App
from explorer.views.strip import bands_call
from tests.tools.visitor import arrived, ran


def test_wholly_idle_the_curve_of_power_has_its_band(app: App):
    async def visit() -> None:
        visitor = await arrived(app.address)
        await visitor.move("Adv. ratio µ", 0.23)
        await visitor.idle()
        (session,) = app.sessions
        now = session.page.now()
        assert isinstance(now.answers.get(bands_call(now)), tuple)
        power = next(chart for chart in visitor.frame["strip"] if chart["name"] == "power")
        assert power["chart"]["series"][0]["kind"] == "band"
        await visitor.close()

    ran(visit)


def test_a_page_that_waits_until_it_is_idle_takes_presses_meanwhile(app: App):
    async def visit() -> None:
        visitor = await arrived(app.address)
        await visitor.idle()
        (session,) = app.sessions
        busy, asked = True, threading.Event()

        def is_waiting() -> bool:
            asked.set()
            return busy

        session.page.context.waiting.append(is_waiting)
        before = visitor.frame["idle"]
        waits = asyncio.create_task(visitor.idle())
        assert await asyncio.to_thread(asked.wait, 60.0)
        await visitor.press("drawer", "settings")
        await visitor.until(lambda: visitor.frame["bar"]["drawer"] == "settings")
        assert visitor.frame["idle"] == before
        assert not waits.done()
        busy = False
        await waits
        await visitor.close()

    ran(visit)
