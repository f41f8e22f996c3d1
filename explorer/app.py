"""The server: one `Session` for each browser that connects and has a place."""

import contextlib
import logging
import socket
import sys
import threading
import time
from collections.abc import Callable
from functools import partial

import viser

from explorer import web
from explorer.hosting import server_limits as memory
from explorer.hosting import viser_compat
from explorer.hosting.browser import call, page_facts
from explorer.hosting.messages import PageFacts
from explorer.hosting.request_filter import AllowedHosts, RequestFilter, with_loading_screen
from explorer.hosting.server_limits import ServerLimits
from explorer.model.inputs import OPENING, Inputs
from explorer.model.units import SI, units_of
from explorer.picture import picture
from explorer.session import Session
from explorer.sharing.share import DESIGN, VIEW, inputs_from, parameter, view_from
from explorer.text.design_words import flight_words, title_words
from explorer.text.readout import fineness
from explorer.workers import solver
from explorer.workers.newest_wins import UPDATES, NewestWins, UpdatePool
from rotor import solve
from rotor.command.warm import compile_all, lags_beside
from rotor.support.bytes_cache import limit_caches
from rotor.support.compiled import compiling, has_compiled
from rotor.support.processes import Processes
from rotor.trim.newton import SolverOptions

FIRST_SOLUTION_S = 0.6
"""[s] the page stays blank for its first solution. After that it says that the solution is on its way."""
_TELL_EVERY = 10.0
"""[s] between two sentences about values that no page of ours sends."""
MakeSession = Callable[[viser.ClientHandle, PageFacts], Session]
_log = logging.getLogger(__name__)
_FIRST_PATIENCE = 20.0
"""[s] after which the solve of a first answer is given up."""
_FIRST_ANSWERS = 32
"""Addresses whose first answer is kept."""
_WORKERS = 2
"""Processes for the long work of all pages."""
_THREAD_SWITCH_S = 1e-3
"""[s] after which a thread that computes lets another run: what sends frames must not wait for its default."""


class ClientConnection:
    """Exists from connect to disconnect. Each step may come on another thread; they run one at a time."""

    def __init__(self, client: viser.ClientHandle) -> None:
        self.client = client
        self._lock = threading.Lock()
        self._facts = PageFacts()
        self.session: Session | None = None
        """Behind the page, once it has a place."""
        self._gone = False
        self._told = -_TELL_EVERY

    def ask(self) -> None:
        """Ask the browser for its address and theme; blocks up to some seconds."""
        self._facts = page_facts(self.client)

    def begin(self, make: MakeSession) -> None:
        """A place is free: make the session and show it."""
        with self._lock:
            if self._gone:
                return
            viser_compat.guard_uploads(self.client, self._refused)
            viser_compat.guard_values(self.client, self._ignored)
            with viser_compat.in_one_piece(self.client):
                try:
                    self.session = make(self.client, self._facts)
                    self.session.start()
                except Exception as error:
                    _log.exception("a page could not be made")
                    show_dialogue(
                        self.client, web.fill("crashed.html", {"error": type(error).__name__})
                    )
                    return
                self.session.shown.wait(FIRST_SOLUTION_S)

    def turn_away(self, places: int) -> None:
        """All places are taken: the page says so, asks now and then, and loads again once there is one."""
        taken = f"All {places} places are taken." if places > 1 else "The place is taken."
        with self._lock:
            if self._gone:
                return
            self.client.gui.configure_theme(
                dark_mode=self._facts.dark, show_logo=False, show_share_button=False
            )
            show_dialogue(self.client, web.fill("lobby.html", {"taken": taken}))
            call(self.client, "RX.awaitPlace")

    def leave(self) -> None:
        with self._lock:
            self._gone = True
            session, self.session = self.session, None
        if session is not None:
            session.stop()

    def _ignored(self, sentence: str) -> None:
        """A value was refused; many of them are reported once in a while."""
        now = time.monotonic()
        if now - self._told > _TELL_EVERY:
            self._told = now
            self.client.add_notification("Ignored", sentence, color="red", auto_close_seconds=10)

    def _refused(self, sentence: str) -> None:
        self.client.add_notification("File refused", sentence, color="red", auto_close_seconds=10)


def show_dialogue(client: viser.ClientHandle, content: str) -> None:
    client.gui.main_panel.minimize()
    with client.gui.add_modal("Rotor explorer"):
        client.gui.add_html(content)


class FirstAnswers:
    """The power of the design in a page's address, for its loading screen: solved while the page's parts arrive."""

    def __init__(self, start: Callable[[], Inputs], pool: UpdatePool = UPDATES) -> None:
        """`start`: where an address holds no design. `pool`: where it takes its turn among the pages."""
        self._start = start
        self._known: dict[tuple[str, Inputs], str] = {}
        self._asked: tuple[str, Inputs] | None = None
        """What is being solved: one at a time."""
        self._worker = NewestWins(
            self._solve, lambda error: _log.error("a first answer failed", exc_info=error), pool
        )

    def __call__(self, query: str) -> str:
        """Power, design and flight in three lines; empty until it is solved, and where there is no answer."""
        asked = query, self._start()
        words = self._known.get(asked)
        if words is None and self._asked is None and not compiling():
            self._asked = asked
            self._worker.wake()
        return words or ""

    def _solve(self) -> None:
        words, asked = "", self._asked
        assert asked is not None
        try:
            with contextlib.suppress(ValueError):  # The page says what is wrong with its address.
                words = _first_words(*asked)
        finally:
            if len(self._known) >= _FIRST_ANSWERS:
                self._known.clear()
            self._known[asked], self._asked = words, None


def _first_words(query: str, start: Inputs) -> str:
    """Power, design and flight in three lines; empty where there is no trim."""
    code, view = parameter(query, DESIGN), parameter(query, VIEW)
    design = (start if code is None else inputs_from(code)).design()
    units = units_of(view_from(view).units if view is not None else SI.title, design.aircraft)
    limit = time.monotonic() + _FIRST_PATIENCE
    solution = solve(design, options=SolverOptions(stop=lambda: time.monotonic() > limit))
    if not solution.converged:
        return ""
    power = units.watts(solution.power.total, fineness(solution.power, units))
    return f"{power}\n{title_words(design)}\n{flight_words(design, units)}"


class PortBusy(RuntimeError):
    """The wanted port cannot be listened on."""


class App:
    """A running server and its connections."""

    def __init__(
        self, host: str, port: int, start: Inputs | None = None, limits: ServerLimits | None = None
    ) -> None:
        _check_free(host, port)
        sys.setswitchinterval(_THREAD_SWITCH_S)
        self._start = start or OPENING
        self._limits = limits or ServerLimits()
        limit_caches(self._limits.cache_bytes)
        self._connections: dict[int, ClientConnection] = {}
        self._lock = threading.Lock()
        self._seated: set[ClientConnection] = set()
        self.pool = Processes(_WORKERS, partial(solver.prepare_worker, self._limits.cache_bytes))
        self._warmed = threading.Event()
        hosts = AllowedHosts(host, self._limits.allow_hosts)
        page = with_loading_screen(viser_compat.client_html(), web.frame())
        first = FirstAnswers(lambda: self._start)
        request_filter = RequestFilter(
            hosts,
            self._limits.connections,
            page,
            self._limits.frame_ancestors,
            first,
            lambda: not self._full,
        )
        self.server = viser_compat.quiet_server(host, port, "Rotor explorer", request_filter)
        viser_compat.remove_share_tunnel(self.server)
        viser_compat.log_failed_callbacks()
        self.server.on_client_connect(self._connected)
        self.server.on_client_disconnect(self._disconnected)
        threading.Thread(target=self._warm, name="warm-up", daemon=True).start()

    @property
    def address(self) -> str:
        host = self.server.get_host()
        shown = (
            "127.0.0.1" if host in ("0.0.0.0", "::", "") else f"[{host}]" if ":" in host else host
        )
        return f"http://{shown}:{self.server.get_port()}"

    def wait_until_warm(self) -> None:
        """Wait until everything is loaded and keep it from garbage collection: for a process that only serves."""
        self._warmed.wait()
        if not self._connections:  # What a page holds must be freed with it.
            memory.exclude_from_collection()

    @property
    def sessions(self) -> tuple[Session, ...]:
        """Sessions at work, in the order in which their browsers connected."""
        return tuple(
            one.session for one in tuple(self._connections.values()) if one.session is not None
        )

    def stop(self) -> None:
        connections, self._connections = list(self._connections.values()), {}
        for connection in connections:
            connection.leave()
        self.pool.shutdown(wait=False, cancel_futures=True)
        viser_compat.quiet_stop(self.server)

    @property
    def _full(self) -> bool:
        return len(self._seated) >= self._limits.sessions

    def _connected(self, client: viser.ClientHandle) -> None:
        connection = self._connections[client.client_id] = ClientConnection(client)
        # On its own thread: viser's are shared by all pages, and a slow browser would block one.
        _in_thread(f"welcome-{client.client_id}", partial(self._welcome, connection))

    def _disconnected(self, client: viser.ClientHandle) -> None:
        connection = self._connections.pop(client.client_id, None)
        if connection is not None:
            _in_thread(f"goodbye-{client.client_id}", partial(self._leave, connection))

    def _welcome(self, connection: ClientConnection) -> None:
        connection.ask()
        with self._lock:
            seated = not self._full
            if seated:
                self._seated.add(connection)
        if seated:
            connection.begin(self._session)
        else:
            connection.turn_away(self._limits.sessions)
        # The browser left before its turn came.
        if connection.client.client_id not in self._connections:
            self._leave(connection)

    def _leave(self, connection: ClientConnection) -> None:
        connection.leave()
        with self._lock:
            self._seated.discard(connection)
        memory.release_memory_soon()

    def _session(self, client: viser.ClientHandle, facts: PageFacts) -> Session:
        return Session(client, self._start, facts, self.pool)

    def _warm(self) -> None:
        try:
            with lags_beside():
                picture.warm()  # First the trim that a page opens on, then what later steps need.
            solver.warm()
            if has_compiled():  # Or each worker would compile the rest.
                compile_all()
        except Exception:  # The sessions will meet the same error and show it.
            _log.exception("warming the solver and the picture failed")
        self.pool.warm()  # Not earlier: it would compete with the first page for the processor.
        self._warmed.set()


def _in_thread(name: str, work: partial[None]) -> None:
    def run() -> None:
        try:
            work()
        except Exception:  # A failure of one page must not stop the server.
            _log.exception("%s failed", name)

    threading.Thread(target=run, name=name, daemon=True).start()


def _check_free(host: str, port: int) -> None:
    """Raise PortBusy when the port cannot be listened on: viser would silently try a thousand others."""
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
