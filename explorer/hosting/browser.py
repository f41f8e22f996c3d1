"""What a page and the server tell each other: facts, texts to keep, the clipboard, and the messages of its scripts."""

import json
import logging
import secrets
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Unpack

import msgspec
import viser

from explorer.hosting.messages import NoDesign, PageFacts, checked_press, log_dropped, read_facts
from explorer.hosting.viser_compat import run_in_page, widget_id
from explorer.parts import Parts
from explorer.parts.presses import PRESSES

_log = logging.getLogger(__name__)


def call(client: viser.ClientHandle, function: str, *arguments: Any) -> None:
    """Call a function that `explorer/web` defines in the page, with arguments that JSON can hold."""
    run_in_page(
        client,
        f"{function}({','.join(json.dumps(argument, ensure_ascii=False) for argument in arguments)})",
    )


def page_facts(client: viser.ClientHandle) -> PageFacts:
    """Ask the browser. Blocks, on a busy machine for seconds; not to be called on the event loop."""
    key = f"facts-{client.client_id}-{secrets.token_hex(4)}"  # Other pages share the storage.
    call(client, "RX.facts", key)
    try:
        text = client.local_storage.get_item(key, timeout=20.0)
        client.local_storage.remove_item(key)
    except (TimeoutError, RuntimeError):
        return PageFacts(query=None)
    return read_facts(text or "{}")


def store_text(client: viser.ClientHandle, name: str, text: str) -> None:
    """Give the page a text to keep until its window is closed, also while it is loaded again.

    One too long for the browser's store (some megabytes) is not kept, nor what stood there before.
    """
    call(client, "RX.keep", name, text)


def set_query(client: viser.ClientHandle, query: str) -> None:
    """Write the query of the page's address, without loading anything and without a step in its history."""
    call(client, "RX.address", query)


def copy_link(client: viser.ClientHandle, query: str) -> None:
    """Put the page's address with this query into the clipboard, where the browser allows it."""
    call(client, "RX.copyLink", query)


class Bridge:
    """The link to one browser. Actions run one after another, in the order of the presses, on a thread of their own.

    Those that take no time may run at once, on the event loop, before anything that the page sends later.
    """

    def __init__(self, client: viser.ClientHandle) -> None:
        self._client = client
        self._lock = threading.Lock()
        self._sent: dict[str, bytes] = {}
        self._actions: dict[str, Callable[[Any], object]] = {}
        self._at_once: set[str] = set()
        self._worker = ThreadPoolExecutor(1, f"frame-{client.client_id}")
        self._heard = client.gui.add_text("frame", "", visible=False)
        self._heard.on_update(self._hear)
        call(client, "RX.begin", widget_id(self._heard))

    def on(self, name: str, action: Callable[[Any], object], at_once: bool = False) -> None:
        """Call `action` with the value that comes with each press of `name`, which `presses.PRESSES` lists.

        ValueError for a name that is taken, or not listed.
        """
        if name in self._actions or name not in PRESSES:
            raise ValueError(
                f"the frame's {name!r} has an action already, or no row in presses.PRESSES"
            )
        self._actions[name] = action
        if at_once:
            self._at_once.add(name)

    def set(self, **parts: Unpack[Parts]) -> None:
        """Show these parts of the page's state; what has not changed is not sent."""
        with self._lock:
            texts = {name: msgspec.json.encode(value) for name, value in parts.items()}
            changed = {name: text for name, text in texts.items() if self._sent.get(name) != text}
            if not changed:
                return
            self._sent.update(changed)
            body = ",".join(f'"{name}":{text.decode()}' for name, text in changed.items())
            run_in_page(self._client, f"RX.set({{{body}}})")

    def stop(self) -> None:
        self._worker.shutdown(wait=False, cancel_futures=True)

    async def _hear(self, event: viser.GuiEvent[Any]) -> None:
        # On the event loop, so that presses keep their order; what they do must not hold the loop.
        if event.client is None:
            return
        press = checked_press(event.target.value)
        if press is None or press[0] not in self._actions:  # The page is still being built.
            return
        name, value = press
        action = self._actions[name]
        if name in self._at_once:
            self._act(action, name, value)
            return
        try:
            self._worker.submit(self._act, action, name, value)
        except RuntimeError:
            return  # The browser has left meanwhile.

    def _act(self, action: Callable[[Any], object], name: str, value: Any) -> None:
        try:
            action(value)
        except NoDesign as error:  # The page shows the sentence.
            log_dropped(f"press {name}: {error}")
        except Exception:  # One press that fails must not end the others.
            _log.exception("%s failed", name)
