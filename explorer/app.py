"""The server: one `Session` for each browser that connects."""

import logging
import socket
import threading

import viser

from explorer import solver, viser_compat
from explorer.jobs import Pool
from explorer.session import Session
from explorer.state import Inputs

_log = logging.getLogger(__name__)


class PortBusy(RuntimeError):
    """The wanted port is taken."""


class App:
    """A running server and its sessions."""

    def __init__(self, host: str, port: int, start: Inputs | None = None) -> None:
        if port:
            _check_free(host, port)
        self._start = start or Inputs()
        self._sessions: dict[int, Session] = {}
        self._lock = threading.Lock()
        self.pool = Pool()
        self.server = viser_compat.quiet_server(host, port, "Rotor explorer")
        viser_compat.remove_share_tunnel(self.server)
        self.server.on_client_connect(self._connected)
        self.server.on_client_disconnect(self._disconnected)
        threading.Thread(target=self._warm, name="warm-up", daemon=True).start()

    @property
    def address(self) -> str:
        host = self.server.get_host()
        shown = "127.0.0.1" if host in ("0.0.0.0", "") else host
        return f"http://{shown}:{self.server.get_port()}"

    def stop(self) -> None:
        with self._lock:
            sessions, self._sessions = list(self._sessions.values()), {}
        for session in sessions:
            session.stop()
        self.pool.close()
        viser_compat.quiet_stop(self.server)

    def _connected(self, client: viser.ClientHandle) -> None:
        session = Session(client, self._start, viser_compat.page_facts(client), self.pool)
        with self._lock:
            self._sessions[client.client_id] = session
        session.start()

    def _disconnected(self, client: viser.ClientHandle) -> None:
        with self._lock:
            session = self._sessions.pop(client.client_id, None)
        if session is not None:
            session.stop()

    def _warm(self) -> None:
        try:
            solver.warm()
        except Exception:  # The sessions will meet the same error and show it.
            _log.exception("warming the solver failed")
        self.pool.warm()  # Only now: the first page does not compete with it.


def _check_free(host: str, port: int) -> None:
    """Raise PortBusy when something listens there: viser would move to the next port without a word."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((host, port))
        except OSError as error:
            raise PortBusy(f"{host}:{port} cannot be used ({error.strerror}): choose another with --port") from error
