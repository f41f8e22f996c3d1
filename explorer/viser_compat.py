"""Every use of viser's private parts, in one place; each has a test, and viser is pinned for their sake."""

import contextlib
import io

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


def page_prefers_dark(client: viser.ClientHandle, timeout: float = 2.0) -> bool:
    """Whether the browser asks for dark pages. Blocks; not to be called on the event loop."""
    dark = "matchMedia('(prefers-color-scheme: dark)').matches || new URLSearchParams(location.search).has('darkMode')"
    run_in_page(client, f"localStorage.setItem('viser-user:prefers-dark', String({dark}))")
    try:
        return client.local_storage.get_item("prefers-dark", timeout=timeout) == "true"
    except (TimeoutError, RuntimeError):
        return False
