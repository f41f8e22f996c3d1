"""The secret of a presenter never stands in what its page shares."""

import asyncio
import re
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import pytest

from explorer.app import App
from explorer.hosting import browser
from explorer.sharing.presentation import FOLLOW, PRESENT, Presentations, follow_name
from explorer.tabs.lecture.presence import Presence
from tests.tools.soak.visitor import Visitor


@pytest.fixture
def scripts(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What the server has the page run."""
    found: list[str] = []
    monkeypatch.setattr(browser, "run_in_page", lambda client, script: found.append(script))
    return found


@pytest.fixture
def app() -> Iterator[App]:
    app = App("127.0.0.1", 0)
    yield app
    app.stop()


def test_no_address_and_no_clipboard_gets_the_secret(app: App, scripts: list[str]):
    async def visit() -> None:
        async with asyncio.timeout(240.0):
            visitor = Visitor()
            await visitor.open(app.address)
            await visitor.until(lambda: len(app.sessions) == 1)
            page = app.sessions[0].page
            await asyncio.to_thread(page._presence.present)
            page.file.copy_link()
            assert page._presence._secret
            await asyncio.sleep(1.0)
            await visitor.close()

    with ThreadPoolExecutor(1) as thread:
        thread.submit(lambda: asyncio.run(visit())).result()
    (kept,) = (script for script in scripts if script.startswith(f'RX.keep("{PRESENT}",'))
    secret = re.fullmatch(rf'RX\.keep\("{PRESENT}","([\w-]+)"\)', kept)
    assert secret is not None
    shared = [script for script in scripts if script is not kept]
    assert any(f"?{FOLLOW}={follow_name(secret[1])}" in script for script in shared)
    assert not [script for script in shared if secret[1] in script]


class FakeAddress(dict[str, str | None]):
    """A page's address without a browser."""

    def __missing__(self, name: str) -> None:
        return None


def test_a_secret_in_a_link_of_an_earlier_version_gives_no_control():
    class Handle:
        def __getattr__(self, name: str) -> "Handle":
            return self

        def __call__(self, *_: object, **__: object) -> "Handle":
            return self

    address = FakeAddress({PRESENT: "a-secret"})
    presence = Presence(Handle(), Presentations(), address)  # pyright: ignore[reportArgumentType]
    assert not presence._secret
    assert address[PRESENT] is None
    kept = Presence(Handle(), Presentations(), FakeAddress(), "a-secret")  # pyright: ignore[reportArgumentType]
    assert kept._secret
