"""What the server asks of one client's browser: its address, texts to keep, the clipboard."""

import json
import secrets
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import viser

from explorer.hosting.viser_compat import run_in_page


def call(client: viser.ClientHandle, function: str, *arguments: Any) -> None:
    """Call a function that `explorer/web` defines in the page, with arguments that JSON can hold."""
    run_in_page(client, f"{function}({','.join(json.dumps(one, ensure_ascii=False) for one in arguments)})")


@dataclass(frozen=True)
class PageFacts:
    """What only the browser knows when a page opens."""

    dark: bool = False
    """Whether it asks for dark pages."""
    query: str | None = ""
    """Of its address, from the question mark on; None where the browser did not tell."""
    kept: Mapping[str, str] = field(default_factory=dict[str, str])
    """Texts that it was given to keep by name: see `keep`."""
    page: str = ""
    """Another one each time that a tab is loaded; the same when a page connects again."""


def page_facts(client: viser.ClientHandle, timeout: float = 20.0) -> PageFacts:
    """Ask the browser. Blocks, on a busy machine for seconds; not to be called on the event loop."""
    key = f"facts-{client.client_id}-{secrets.token_hex(4)}"  # Other pages share the storage.
    call(client, "RX.facts", key)
    try:
        text = client.local_storage.get_item(key, timeout=timeout)
        client.local_storage.remove_item(key)
        found = json.loads(text or "{}")
        kept = {str(name): str(value) for name, value in found.get("kept", {}).items()}
        return PageFacts(bool(found.get("dark")), str(found.get("query", "")), kept, str(found.get("page", ""))[:40])
    except (TimeoutError, RuntimeError, ValueError, AttributeError):
        return PageFacts(query=None)


def keep(client: viser.ClientHandle, name: str, text: str) -> None:
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
