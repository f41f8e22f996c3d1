"""The page started from Python: in the background of a notebook or a script."""

import atexit
import os
import sys
import webbrowser
from urllib.parse import urlsplit

from explorer.app import App
from explorer.hosting.request_filter import host_name
from explorer.hosting.server_limits import ServerLimits
from explorer.model.inputs import inputs_of
from explorer.sharing.share import CARRIED, with_parameter
from rotor import Design
from rotor.design.design import require_design
from rotor.support.markup import tag

_LOCAL = ("http://localhost:*", "http://127.0.0.1:*", "vscode-webview:")
"""Where notebooks on this machine are shown."""
_HEIGHT = 720
"""[px] of the page inside a notebook."""
_PREFIX = "JUPYTERHUB_SERVICE_PREFIX"
"""The path of a user's own server, set by JupyterHub."""


class RunningPage:
    """A page in the background: its address, and a way to stop it. Jupyter shows it inline."""

    def __init__(self, app: App, hub: bool = False, query: str = "") -> None:
        """`query`: what the address says of the design beside the sliders."""
        self._app: App | None = app
        self._hub = hub
        self.address = f"{app.address}/{query}" if query else app.address
        atexit.register(self.stop)

    def stop(self) -> None:
        """End the page; a second call does nothing."""
        app, self._app = self._app, None
        if app is not None:
            atexit.unregister(self.stop)
            app.stop()

    def __repr__(self) -> str:
        return f"RunningPage({self.address}{'' if self._app else ', stopped'})"

    def _repr_html_(self) -> str:
        if self._app is None:
            return tag("p", f"The page at {self.address} is stopped.")
        place = proxied_path(self.address) if self._hub else self.address
        if not self._hub and (sentence := why_out_of_reach(self.address)):
            return tag("p", sentence)
        return tag("iframe", src=place, width="100%", height=_HEIGHT, style="border: 0")


def proxied_path(address: str) -> str:
    """Where jupyter-server-proxy passes on a page of the notebook's machine: a path on the hub's own name."""
    _, ask, query = address.partition("?")
    return f"{os.environ.get(_PREFIX, '/')}proxy/{_port(address)}/{ask}{query}"


def why_out_of_reach(address: str) -> str:
    """On JupyterHub, one sentence on how to reach a page that listens on the notebook's machine; else empty."""
    if _PREFIX not in os.environ:
        return ""
    port = _port(address)
    return (
        f"This notebook runs on JupyterHub, and {address} is an address on that machine. If the hub has "
        "jupyter-server-proxy, name the hub: explorer.show(design, hub='hub.example'). Otherwise forward the port: "
        f"ssh -L {port}:127.0.0.1:{port} USER@HUB and open {address} here."
    )


def _port(address: str) -> str:
    return str(urlsplit(address).port)


def start_page(design: Design, port: int, browser: bool | None, hub: str | None) -> RunningPage:
    """Start the server on the design; see `explorer.show`."""
    names = (
        ()
        if hub is None
        else (host_name(hub.removeprefix("https://").removeprefix("http://").partition("/")[0]),)
    )
    start = inputs_of(require_design(design))
    limits = ServerLimits(allow_hosts=names, frame_ancestors=_LOCAL)
    carried = design.rotor.blade.carried
    query = "" if carried is None else with_parameter("", CARRIED, carried.spec)
    page = RunningPage(App("127.0.0.1", port, start, limits), hub is not None, query)
    if browser or (browser is None and hub is None and "ipykernel" not in sys.modules):
        webbrowser.open(page.address)
    if hub is None and (sentence := why_out_of_reach(page.address)):
        print(sentence)
    return page
