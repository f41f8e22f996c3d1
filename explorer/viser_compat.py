"""Every use of viser's private parts, in one place; each has a test, and viser is pinned for their sake."""

import contextlib
import io
import json
import secrets
from dataclasses import dataclass

import viser
from viser import _messages


def quiet_server(host: str, port: int, label: str) -> viser.ViserServer:
    """A server that leaves it to us what is printed; `verbose=False` still prints a banner."""
    with contextlib.redirect_stdout(io.StringIO()):
        return viser.ViserServer(host=host, port=port, label=label, verbose=False)


def quiet_stop(server: viser.ViserServer) -> None:
    with contextlib.redirect_stdout(io.StringIO()):
        server.stop()


def remove_share_tunnel(server: viser.ViserServer) -> None:
    """Make the server deaf to the request that opens a public tunnel; hiding its button does not."""
    for message in (_messages.ShareUrlRequest, _messages.ShareUrlDisconnect):
        server._websock_server.unregister_handler(message)


def set_png(handle: viser.ImageHandle, png: bytes) -> None:
    """Assign an encoded PNG: the public setter would encode again, in true colour, for ten times the time."""
    handle._data = png


def run_in_page(client: viser.ClientHandle, script: str) -> None:
    """Run a line of JavaScript in the page of one client."""
    client._websock_connection.queue_message(_messages.RunJavascriptMessage(script))


@dataclass(frozen=True)
class PageFacts:
    """What only the browser knows when a page opens."""

    dark: bool = False
    """Whether it asks for dark pages."""
    query: str = ""
    """Of its address, from the question mark on."""


def page_facts(client: viser.ClientHandle, timeout: float = 2.0) -> PageFacts:
    """Ask the browser. Blocks; not to be called on the event loop."""
    key = f"facts-{client.client_id}-{secrets.token_hex(4)}"  # Other pages share the storage.
    dark = "matchMedia('(prefers-color-scheme: dark)').matches || new URLSearchParams(location.search).has('darkMode')"
    facts = f"JSON.stringify({{dark:{dark},query:location.search}})"
    run_in_page(client, f"localStorage.setItem('viser-user:{key}',{facts})")
    try:
        text = client.local_storage.get_item(key, timeout=timeout)
        client.local_storage.remove_item(key)
        found = json.loads(text or "{}")
        return PageFacts(bool(found.get("dark")), str(found.get("query", "")))
    except (TimeoutError, RuntimeError, ValueError):
        return PageFacts()


def set_query(client: viser.ClientHandle, query: str) -> None:
    """Write the query of the page's address, without loading anything and without a step in its history."""
    run_in_page(client, f"history.replaceState(null,'',location.pathname+{json.dumps(query)})")


def copy_text(client: viser.ClientHandle, expression: str) -> None:
    """Put the value of a JavaScript expression into the clipboard, where the browser allows it."""
    run_in_page(client, f"navigator.clipboard&&navigator.clipboard.writeText({expression}).catch(()=>0)")
