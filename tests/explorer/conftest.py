"""The page's server, one without a page, the sliders of Explore on it, and the UH-60A as built at three speeds."""

from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import pytest
import viser

from explorer.app import App
from explorer.model.inputs import Inputs
from explorer.model.undo import PowerTracker
from explorer.widgets.controls import DesignControls, SessionCallbacks
from rotor import Solution, make_design, solve


@pytest.fixture(scope="session")
def hover() -> Solution:
    return solve(make_design(mu=0.0)).require()


@pytest.fixture(scope="session")
def cruise() -> Solution:
    return solve(make_design(mu=0.2)).require()


@pytest.fixture(scope="session")
def fast() -> Solution:
    return solve(make_design(mu=0.3)).require()


def nothing(*_: Any) -> None:
    """For whoever must be told."""


@pytest.fixture
def app() -> Iterator[App]:
    app = App("127.0.0.1", 0)
    yield app
    app.stop()


@pytest.fixture
def server() -> Iterator[viser.ViserServer]:
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    yield server
    server.stop()


@pytest.fixture
def controls_from(server: viser.ViserServer) -> Callable[[Inputs], DesignControls]:
    """Makes the sliders that begin with these inputs."""
    bridge: Any = SimpleNamespace(on=nothing)
    callbacks = SessionCallbacks(nothing, nothing, lambda: None)
    return lambda start: DesignControls(server.gui, bridge, start, PowerTracker(), callbacks)


@pytest.fixture
def controls(controls_from: Callable[[Inputs], DesignControls]) -> DesignControls:
    return controls_from(Inputs())
