"""The page started from Python: in the background of a notebook or a script."""

import atexit
import os
import sys
import webbrowser

from explorer.app import App
from explorer.hosting.limits import ServerLimits
from explorer.model.inputs import inputs_of
from rotor.design.design import Design, require_design

_LOCAL = ("http://localhost:*", "http://127.0.0.1:*", "vscode-webview:")
"""Where notebooks on this machine are shown."""
_HEIGHT = 720
"""[px] of the page inside a notebook."""


class RunningPage:
    """A page in the background: its address, and a way to stop it. Jupyter shows it inline."""

    def __init__(self, app: App) -> None:
        self._app: App | None = app
        self.address = app.address
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
            return f"<p>The page at {self.address} is stopped.</p>"
        if sentence := why_out_of_reach(self.address):
            return f"<p>{sentence}</p>"
        return f'<iframe src="{self.address}" width="100%" height="{_HEIGHT}" style="border: 0"></iframe>'


def why_out_of_reach(address: str) -> str:
    """On JupyterHub, one sentence on how to reach a page that listens on the notebook's machine; else empty."""
    if "JUPYTERHUB_SERVICE_PREFIX" not in os.environ:
        return ""
    port = address.rstrip("/").rpartition(":")[2]
    return (
        f"This notebook runs on JupyterHub, and {address} is an address of that machine: forward the port with "
        f"ssh -L {port}:127.0.0.1:{port} USER@HUB and open {address} here, or save the design and run "
        "rotor-explorer --design FILE on your own machine."
    )


def start_page(design: Design, port: int, browser: bool | None) -> RunningPage:
    """Start the server on the design; see `explorer.show`."""
    start = inputs_of(require_design(design))
    page = RunningPage(App("127.0.0.1", port, start, ServerLimits(frame_ancestors=_LOCAL)))
    if browser or (browser is None and "ipykernel" not in sys.modules):
        webbrowser.open(page.address)
    if sentence := why_out_of_reach(page.address):
        print(sentence)
    return page
