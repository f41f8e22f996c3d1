"""What the browser tests share: one server for a process, since another costs more than a test; a page for a file."""

from collections.abc import Iterator
from functools import partial
from typing import cast

import pytest
from playwright.sync_api import Browser
from watched import COARSE, SMALL, Visit, Watched, opened

from explorer.app import App
from explorer.model.inputs import OPENING, Inputs
from explorer.widgets.optimise import map_panel
from explorer.workers.solver import MapTask


def pytest_itemcollected(item: pytest.Item) -> None:
    """All tests of this folder drive a page."""
    item.add_marker("browser")


@pytest.fixture(scope="session")
def server() -> Iterator[App]:
    """Its maps of power have 9 × 9 points, coarse and then fine as those of 17 × 17."""
    server = App("127.0.0.1", 0)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(map_panel, "MapTask", partial(MapTask, steps=(4, 8)))
        yield server
    server.stop()


@pytest.fixture(scope="module")
def app(request: pytest.FixtureRequest, server: App) -> App:
    """Its pages begin with the design that the file names `START`, else with their own."""
    start = cast(Inputs, getattr(request.module, "START", OPENING))
    server._start = start
    return server


@pytest.fixture(scope="module")
def shared(request: pytest.FixtureRequest, browser: Browser, app: App) -> Iterator[Watched]:
    """One page for all tests of a file that leave it usable, of the file's `SIZE`."""
    watched = opened(browser, app.address, size=getattr(request.module, "SIZE", SMALL))
    watched.quiet()
    yield watched
    watched.close()


@pytest.fixture
def watched(request: pytest.FixtureRequest, shared: Watched) -> Iterator[Watched]:
    """That page with the design it began with; where the file says `AS_LEFT`, as the test before left it."""
    if not getattr(request.module, "AS_LEFT", False):
        shared.reset()
    yield shared
    assert shared.complaints == []


@pytest.fixture
def visit(browser: Browser, app: App) -> Iterator[Visit]:
    """Opens a page, as `opened` does; after the test it is closed, and must not have complained."""
    pages: list[Watched] = []

    def visit(query: str = COARSE, size: tuple[int, int] = SMALL) -> Watched:
        pages.append(opened(browser, app.address, query, size))
        return pages[-1]

    yield visit
    for one in pages:
        one.close()
        assert one.complaints == []
