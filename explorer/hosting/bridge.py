"""The messages between the page's own scripts (`explorer/web`) and the server."""

import json
import logging
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import viser

from explorer.hosting.browser import call
from explorer.hosting.viser_compat import run_in_page, widget_id

_log = logging.getLogger(__name__)


class Bridge:
    """One browser's. Actions run one after another, in the order of the presses, on a thread of their own.

    Those that take no time may run at once, on the event loop, before anything that the page sends later.
    """

    def __init__(self, client: viser.ClientHandle) -> None:
        self._client = client
        self._lock = threading.Lock()
        self._sent: dict[str, str] = {}
        self._actions: dict[str, Callable[[Any], None]] = {}
        self._at_once: set[str] = set()
        self._worker = ThreadPoolExecutor(1, f"frame-{client.client_id}")
        self._heard = client.gui.add_text("frame", "", visible=False)
        self._heard.on_update(self._hear)
        call(client, "RX.begin", widget_id(self._heard))

    def on(self, name: str, action: Callable[[Any], None], at_once: bool = False) -> None:
        """Call `action` with the value that comes with each press of `name`; ValueError for a name that is taken."""
        if name in self._actions:
            raise ValueError(f"the frame's {name!r} has an action already: choose another name")
        self._actions[name] = action
        if at_once:
            self._at_once.add(name)

    def set(self, **parts: Any) -> None:
        """Show these parts of the page's state; what has not changed is not sent."""
        with self._lock:
            texts = {
                name: json.dumps(value, ensure_ascii=False, separators=(",", ":")) for name, value in parts.items()
            }
            changed = {name: text for name, text in texts.items() if self._sent.get(name) != text}
            if not changed:
                return
            self._sent.update(changed)
            body = ",".join(f"{json.dumps(name)}:{text}" for name, text in changed.items())
            run_in_page(self._client, f"RX.set({{{body}}})")

    def stop(self) -> None:
        self._worker.shutdown(wait=False, cancel_futures=True)

    async def _hear(self, event: viser.GuiEvent[Any]) -> None:
        # On the event loop, so that presses keep their order; what they do must not hold the loop.
        if event.client is None:
            return
        try:
            _, name, value = json.loads(event.target.value)
            action = self._actions[name]
        except (ValueError, TypeError, KeyError):
            return  # Not a message of ours.
        if name in self._at_once:
            self._act(action, name, value)
            return
        try:
            self._worker.submit(self._act, action, name, value)
        except RuntimeError:
            return  # The browser has left meanwhile.

    def _act(self, action: Callable[[Any], None], name: str, value: Any) -> None:
        try:
            action(value)
        except Exception:  # One press that fails must not end the others.
            _log.exception("%s failed", name)
