"""The server that the tests of one file share."""

from collections.abc import Iterator

import pytest

from explorer.app import App


@pytest.fixture(scope="module")
def app(request: pytest.FixtureRequest) -> Iterator[App]:
    """Begins with the design that the file names `START`, else with the page's own."""
    app = App("127.0.0.1", 0, getattr(request.module, "START", None))
    yield app
    app.stop()
