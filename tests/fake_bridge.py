"""What stands for the bridge to the page's scripts where there is no page, and panels on such a bridge."""

import json
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import msgspec

from explorer.hosting.messages import checked_press
from explorer.model.inputs import OPENING, Inputs
from explorer.model.session_state import SessionState
from explorer.views.page_state import Effect, PageState, Panel
from explorer.views.panel_updater import PanelUpdater
from rotor.support.processes import Processes


class Bridge:
    """Keeps what the frame was told, and the actions that it would call."""

    def __init__(self) -> None:
        self.actions: dict[str, Any] = {}
        self.state: dict[str, Any] = {}
        self.sent: list[dict[str, Any]] = []

    def on(self, name: str, action: Any, at_once: bool = False) -> None:
        self.actions[name] = action

    def press(self, name: str, value: Any) -> None:
        """As a script sends it."""
        press = checked_press(json.dumps([0, name, value]))
        self.actions[name](press[1])

    def set(self, **parts: Any) -> None:
        msgspec.json.encode(parts)  # Whatever is told must be JSON.
        self.state |= parts
        self.sent.append(parts)


class PanelPage:
    """Panels without a page: what they show, what a press does, and the page's own work."""

    def __init__(
        self, *panels: Panel, inputs: Inputs = OPENING, texts: tuple[str, ...] = ()
    ) -> None:
        """`texts`: names of what is shown outside the frame."""
        self.now = PageState(inputs, None, None)
        self.bridge, self.done, self.words = Bridge(), list[Effect](), list[Any]()
        self.keys: dict[str, Callable[[], None]] = {}
        self.shown = self.bridge.state

        def show(name: str, value: Any) -> None:
            self.words.append(value)
            self.shown[name] = value

        self.updater = PanelUpdater(
            panels,
            self.bridge,  # pyright: ignore[reportArgumentType]
            self.keys.__setitem__,
            {name: partial(show, name) for name in texts},
            Processes(0),
            lambda: None,
            self._now,
            self._now,
            self.done.append,
        )

    def _now(self) -> PageState:
        return replace(
            self.now,
            memory=self.updater.memory,
            answers={**self.now.answers, **self.updater.answers()},
        )

    def follow(self, now: PageState) -> None:
        self.now = now
        self.updater.follow()

    def show(self, state: SessionState) -> None:
        """Follow a converged state."""
        self.follow(
            replace(self.now, state=state, inputs=state.inputs, sliders=state.inputs.design())
        )

    def rest(self) -> None:
        for soon in (True, False):
            for _ in self.updater.work(soon):
                pass
