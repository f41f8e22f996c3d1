"""The server: one `Session` for each browser that connects and finds a place."""

import logging
import socket
import threading
from functools import partial

import viser

from explorer.hosting import memory, viser_compat
from explorer.hosting.doors import AllowedHosts
from explorer.hosting.gate import RequestFilter
from explorer.hosting.guest import ClientConnection
from explorer.hosting.hall import SeatQueue
from explorer.hosting.house import ServerLimits
from explorer.hosting.page import veiled
from explorer.interface import SharedServices
from explorer.session import Session
from explorer.sharing.presentation import Presentations
from explorer.state import Inputs
from explorer.workers import solver
from explorer.workers.newest_wins import IdleTimeout
from explorer.workers.pool import Pool

_log = logging.getLogger(__name__)


class PortBusy(RuntimeError):
    """The wanted port is taken."""


class App:
    """A running server and its guests."""

    def __init__(self, host: str, port: int, start: Inputs | None = None, house: ServerLimits | None = None) -> None:
        _check_free(host, port)
        self._start = start or Inputs()
        self._house = house or ServerLimits()
        self._guests: dict[int, ClientConnection] = {}
        self._hall: SeatQueue[ClientConnection] = SeatQueue(self._house.sessions)
        self.pool = Pool()
        self._warmed = threading.Event()
        self.presentations = Presentations()
        doors, page = AllowedHosts(host, self._house.allow_hosts), veiled(viser_compat.client_html())
        gate = RequestFilter(doors, self._house.connections, page, self._house.frame_ancestors)
        self.server = viser_compat.quiet_server(host, port, "Rotor explorer", gate)
        viser_compat.remove_share_tunnel(self.server)
        self.server.on_client_connect(self._connected)
        self.server.on_client_disconnect(self._disconnected)
        threading.Thread(target=self._warm, name="warm-up", daemon=True).start()

    @property
    def address(self) -> str:
        host = self.server.get_host()
        shown = "127.0.0.1" if host in ("0.0.0.0", "::", "") else f"[{host}]" if ":" in host else host
        return f"http://{shown}:{self.server.get_port()}"

    def settle(self) -> None:
        """Wait until everything is loaded, and let it stay: for a process that does nothing else."""
        self._warmed.wait()
        if not self._guests:  # What a page holds must go with it.
            memory.settle()

    @property
    def sessions(self) -> tuple[Session, ...]:
        """Those at work, in the order they came."""
        return tuple(guest.session for guest in tuple(self._guests.values()) if guest.session is not None)

    def stop(self) -> None:
        guests, self._guests = list(self._guests.values()), {}
        for guest in guests:
            guest.leave()
        self.pool.close()
        viser_compat.quiet_stop(self.server)

    def _connected(self, client: viser.ClientHandle) -> None:
        guest = self._guests[client.client_id] = ClientConnection(client)
        # On a thread of its own: viser's are shared by all pages, and a slow browser would hold one.
        _aside(f"welcome-{client.client_id}", partial(self._welcome, guest))

    def _disconnected(self, client: viser.ClientHandle) -> None:
        guest = self._guests.pop(client.client_id, None)
        if guest is not None:
            _aside(f"goodbye-{client.client_id}", partial(self._goodbye, guest))

    def _welcome(self, guest: ClientConnection) -> None:
        guest.ask()
        if self._hall.arrive(guest):
            guest.sit(partial(self._session, guest))
        else:
            self._tell_line()
        if guest.client.client_id not in self._guests:  # It left before it was known.
            self._goodbye(guest)

    def _goodbye(self, guest: ClientConnection) -> None:
        guest.leave()
        self._seat(self._hall.leave(guest))
        memory.give_back_soon()

    def _session(self, guest: ClientConnection, client: viser.ClientHandle, facts: viser_compat.PageFacts) -> Session:
        sleep = IdleTimeout(
            self._house.sleep_after,
            lambda: self._rest(guest),
            lambda: self._hall.wake(guest),
        )
        shared = SharedServices(self.pool.share(), self.presentations, self._house.studies)
        return Session(client, self._start, facts, shared, sleep)

    def _rest(self, guest: ClientConnection) -> None:
        self._seat(self._hall.sleep(guest))
        memory.give_back_soon()

    def _seat(self, coming: list[ClientConnection]) -> None:
        """Those in line whose turn it is."""
        for guest in coming:
            _aside(f"seat-{guest.client.client_id}", partial(guest.sit, partial(self._session, guest)))
        self._tell_line()

    def _tell_line(self) -> None:
        for ahead, guest in enumerate(self._hall.line):
            guest.wait(self._house.sessions, ahead)

    def _warm(self) -> None:
        try:
            solver.warm()
        except Exception:  # The sessions will meet the same error and show it.
            _log.exception("warming the solver failed")
        self.pool.warm()  # Only now: the first page does not compete with it.
        self._warmed.set()


def _aside(name: str, work: partial[None]) -> None:
    def run() -> None:
        try:
            work()
        except Exception:  # One page's trouble is not the server's.
            _log.exception("%s failed", name)

    threading.Thread(target=run, name=name, daemon=True).start()


def _check_free(host: str, port: int) -> None:
    """Raise PortBusy when this place cannot be listened on: viser would try a thousand ports without a word."""
    try:
        family, kind, protocol, _, place = socket.getaddrinfo(
            host or None, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )[0]
        with socket.socket(family, kind, protocol) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind(place)
    except OSError as error:
        remedy = f"choose another with {'--port' if port and not isinstance(error, socket.gaierror) else '--host'}"
        raise PortBusy(f"{host}:{port} cannot be used ({error.strerror}): {remedy}") from error
