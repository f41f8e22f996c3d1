"""The page that is served, and the filter before its server: host names that it answers to, whose requests, how many
connections, how much of each."""

import asyncio
import contextlib
import gzip
import hashlib
import http
import logging
import socket
import time
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from functools import cached_property
from ipaddress import ip_address
from typing import Any
from urllib.parse import urlsplit

from websockets.asyncio.server import ServerConnection
from websockets.datastructures import Headers, MultipleValuesError
from websockets.exceptions import ConnectionClosed, InvalidMessage, SecurityError
from websockets.frames import CloseCode, Frame
from websockets.http11 import Request, Response
from websockets.protocol import Event

from explorer import web
from explorer.hosting.messages import LONGEST_HEAD, log_dropped, message_fault
from explorer.hosting.server_limits import FRAMES, LARGEST_MESSAGE, RateLimiter
from rotor.support.compiled import compiling
from rotor.support.markup import end_of, start_of, with_title

_LOOPBACK = ("localhost", "127.0.0.1", "::1")
_DEFAULT_PORTS = {"http": 80, "https": 443}
_NAME_LENGTH = 80
"""Characters of a foreign name that a refusal repeats."""


@dataclass(frozen=True)
class AllowedHosts:
    """Which host names the server answers to, and whose pages may connect to it.

    A browser lets any page open a WebSocket to any address, also to this machine's, and only names that page in
    `Origin`. A page can also give its own name the address 127.0.0.1 (DNS rebinding); `Host` then holds that foreign
    name. So both are checked. A client without `Origin` is not a browser. Programs can send any header they like, so
    refusing those without it would protect nobody and would exclude scripts and monitoring. The address that is
    listened on keeps them out, or a reverse proxy that asks who they are.
    """

    host: str
    also: tuple[str, ...] = ()
    """Further names it is reached by, as behind a reverse proxy."""

    @property
    def public(self) -> bool:
        """Whether other machines can reach it."""
        return not is_loopback(self.host)

    def refusal(self, host: str | None, origin: str | None) -> str | None:
        """Why a request with these headers is refused, in one sentence; None where it is accepted.

        `origin` is None for a plain request, or from a client that is not a browser.
        """
        name, port = _split(host or "")
        if not name or not self._answers_to(name):
            shown = (host or "")[:_NAME_LENGTH]
            return f"This server does not answer to {shown!r}: start it with --allow-host {name[:_NAME_LENGTH]}"
        if origin is None or self._is_own(origin, name, port):
            return None
        return f"Pages of {origin[:_NAME_LENGTH]!r} may not use this server."

    def _answers_to(self, name: str) -> bool:
        if name in _LOOPBACK or name == self.host.lower() or name in self._also:
            return True
        # A request by number was not sent by a foreign name; the machine's own name is trusted.
        return self.public and (_is_address(name) or name in _own_names())

    def _is_own(self, origin: str, name: str, port: int | None) -> bool:
        scheme, separator, place = origin.partition("://")
        if not separator or scheme not in _DEFAULT_PORTS:
            return False  # "null" is the origin of a sandboxed frame or a file.
        theirs, their_port = _split(place)
        if theirs in self._also:
            return True  # A proxy may have put another Host in place of the browser's.
        default = _DEFAULT_PORTS[scheme]
        return theirs == name and (their_port or default) == (port or default)

    @property
    def _also(self) -> tuple[str, ...]:
        return tuple(_split(name)[0] for name in self.also)


def host_name(text: str) -> str:
    """The host name in `text`; ValueError with one sentence where there is none."""
    name, _ = _split(text)
    if not name:
        raise ValueError(
            f"{text!r} is not a host name: give a name such as rotor.example, without https:// and path"
        )
    return name


def is_loopback(host: str) -> bool:
    """Whether an address to listen on is reached from this machine only."""
    return host.lower() == "localhost" or (_is_address(host) and ip_address(host).is_loopback)


def warning(host: str) -> str:
    """Two lines to print when the server listens to other machines."""
    return (
        f"Warning: listening on {host}: anyone who can reach this port can use the explorer without a password.\n"
        "Put a reverse proxy with TLS and authentication in front (docs/deploy.md), and pass its name: --allow-host."
    )


def _split(place: str) -> tuple[str, int | None]:
    """Lower-case name and port of `name`, `name:port` or `[v6]:port`; an empty name for anything else."""
    try:
        parts = urlsplit("//" + place.strip())
        if parts.path or parts.query or parts.fragment or "@" in place:
            return "", None
        return (parts.hostname or "").rstrip("."), parts.port
    except ValueError:
        return "", None


def _is_address(name: str) -> bool:
    try:
        ip_address(name)
    except ValueError:
        return False
    return True


def _own_names() -> tuple[str, ...]:
    name = socket.gethostname().lower()
    return name, name.partition(".")[0], f"{name.partition('.')[0]}.local"


TITLE = "Rotor explorer"
_VIEWPORT = "width=device-width, initial-scale=1"
"""Of the client's page. Without a least scale, a list that opens beyond the edge of a telephone widens the page, which
closes the list, without end."""
_SCRIPT_BEGINS, _HEAD_ENDS, _BODY_BEGINS = (
    start_of("script"),
    end_of("head"),
    f"{start_of('body')}>",
)


@dataclass(frozen=True)
class ServedPage:
    html: bytes

    @cached_property
    def packed(self) -> bytes:
        """Compressed by gzip."""
        return gzip.compress(self.html, 6, mtime=0)

    @cached_property
    def tag(self) -> str:
        """ETag: a browser that holds this version need not fetch it again."""
        return f'"{hashlib.sha256(self.html).hexdigest()[:16]}"'


def with_loading_screen(client: str, frame: str = "") -> ServedPage:
    """The client's page with our title, the loading screen, and the `frame` behind it; ValueError for another layout.

    Its script moves from the head behind the loading screen, which is then painted while the script arrives.
    """
    head, begins, rest = client.partition(_SCRIPT_BEGINS)
    script, ends, tail = rest.partition(_HEAD_ENDS)
    before, body, content = tail.partition(_BODY_BEGINS)
    if (
        not (begins and ends and body)
        or before.strip()
        or start_of("title") not in head
        or _VIEWPORT not in head
    ):
        raise ValueError(
            "The client's page is not built as expected: a head that ends in its script, then a body."
        )
    head = with_title(head, TITLE).replace(_VIEWPORT, f"{_VIEWPORT}, minimum-scale=1")
    veil = web.text("loading.html") + web.scripts("loading.js")
    return ServedPage(
        f"{head}{web.styles('loading.css')}{ends}{body}{veil}{frame}{begins}{script}{content}".encode()
    )


_log = logging.getLogger(__name__)
_visitors = logging.getLogger(f"{__name__}.visitors")
# A malformed request is not an error of ours, so it is not printed.
_visitors.setLevel(logging.CRITICAL)

Answer = Callable[[ServerConnection, Request], Response | None]
Handler = Callable[[ServerConnection], Awaitable[None]]

_FLOOD = "Rate limit exceeded; the page starts again."
_CLOSING_S = 1.0
"""[s] a client has to complete the closing handshake."""
_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "same-origin",  # The address of a page may hold a design.
    "Content-Security-Policy": "frame-ancestors 'self'",  # No other site may put this page under buttons of its own.
}


@dataclass(frozen=True)
class RequestFilter:
    """The rules, and the arguments for `websockets.serve` that enforce them."""

    hosts: AllowedHosts
    connections: int
    """WebSockets at once."""
    page: ServedPage | None = None
    """Served in place of the server's own page."""
    frame_ancestors: tuple[str, ...] = ()
    """Origins of other pages that may show this one in a frame, such as a notebook's."""
    first_answer: Callable[[str], str] = lambda query: ""
    """What the loading screen says of the design in an address's query; it must not block."""
    place_free: Callable[[], bool] = lambda: True
    """Whether there is a place for another page."""

    def around(self, handler: Handler, options: dict[str, Any]) -> tuple[Handler, dict[str, Any]]:
        """A server's handler and options with the filter before them."""
        filtered = {
            **options,
            "max_size": LARGEST_MESSAGE,
            "create_connection": GuardedConnection,
            "logger": _visitors,
        }
        filtered["process_request"] = self._process(options["process_request"])
        return _contained(handler), filtered

    @property
    def _headers(self) -> dict[str, str]:
        ancestors = " ".join(("frame-ancestors 'self'", *self.frame_ancestors))
        return {**_HEADERS, "Content-Security-Policy": ancestors}

    def _process(self, inner: Answer) -> Answer:
        def answer(connection: ServerConnection, request: Request) -> Response | None:
            names = ("Upgrade", "Host", "Origin", "Sec-Fetch-Site")
            try:
                upgrades, host, origin, site = (request.headers.get(name) for name in names)
            except MultipleValuesError as error:
                return _plain(
                    http.HTTPStatus.BAD_REQUEST, f"The request has two headers {error}: send one."
                )
            upgrade = (upgrades or "").lower() == "websocket"
            sentence = self.hosts.refusal(host, origin if upgrade else None)
            if sentence is not None:
                return _plain(http.HTTPStatus.FORBIDDEN, sentence)
            if upgrade and len(connection.server.connections) >= self.connections:
                return _plain(
                    http.HTTPStatus.SERVICE_UNAVAILABLE, "Too many pages are open: try again later."
                )
            path, _, query = request.path.partition("?")
            if not upgrade and self.page is not None and path in ("/", "/index.html"):
                return _served(self.page, request, self._headers)
            if not upgrade and path == "/compiling":  # The loading screen asks.
                return _plain(http.HTTPStatus.OK, compiling())
            if not upgrade and path == "/first-answer":
                # An image of another site could ask for solve after solve.
                if site not in (None, "same-origin", "none"):
                    return _plain(
                        http.HTTPStatus.FORBIDDEN, "Pages of other sites may not ask for answers."
                    )
                return _plain(http.HTTPStatus.OK, self.first_answer(query))
            if not upgrade and path == "/place":  # Asked by a page that was turned away.
                return _plain(http.HTTPStatus.OK, "free" if self.place_free() else "taken")
            try:
                served = inner(connection, request)
            except (
                OSError,
                ValueError,
            ):
                # No file can have this path: it is too long or has a zero byte.
                served = _plain(http.HTTPStatus.NOT_FOUND, "There is no such page.")
            if served is not None:
                for name, value in self._headers.items():
                    served.headers[name] = value
            return served

        def process_request(connection: ServerConnection, request: Request) -> Response | None:
            response = answer(connection, request)
            if isinstance(connection, GuardedConnection) and connection.head_only:
                response = response or _plain(
                    http.HTTPStatus.BAD_REQUEST, "A WebSocket opens with GET."
                )
                response.body = b""
            return response

        return process_request


_TOO_LONG = "This address is too long: ask for a shorter link, or for the design as a file."
_METHODS = "This server answers only GET and HEAD."
_VERSION = "This server answers only HTTP/1.1: set the proxy in front of it to use that."


class GuardedConnection(ServerConnection):
    """A connection that is closed when it sends more than it may; of its messages those arrive that fit."""

    def __init__(self, *positional: Any, **named: Any) -> None:
        super().__init__(*positional, **named)
        self._head = 0
        self._line: bytes | None = b""
        """What has come of the request's first line; None once it is whole."""
        self.head_only = False
        """Whether the headers of a page are asked for without its body."""
        self._limiter = RateLimiter(time.monotonic())
        self._frames = RateLimiter(time.monotonic(), FRAMES)

    def data_received(self, data: bytes) -> None:
        """Bytes of the request or, once it is answered, of messages."""
        if self.request is None:
            self._head += len(data)
            if self._head > LONGEST_HEAD:
                return self._refuse(_plain(http.HTTPStatus.REQUEST_URI_TOO_LONG, _TOO_LONG))
        if self._line is not None:
            self._line += data
            if b"\n" not in self._line:
                return None
            data, self._line = self._line, None
            method, _, rest = data.partition(b" ")
            # The server below leaves all but GET of HTTP/1.1 without an answer.
            if method.isalpha() and method not in (b"GET", b"HEAD"):
                return self._refuse(
                    _plain(http.HTTPStatus.METHOD_NOT_ALLOWED, _METHODS, Allow="GET, HEAD")
                )
            if rest.partition(b"\n")[0].rstrip().endswith(b"HTTP/1.0"):
                return self._refuse(_plain(http.HTTPStatus.HTTP_VERSION_NOT_SUPPORTED, _VERSION))
            self.head_only = method == b"HEAD"
            data = b"GET " + rest if self.head_only else data
        super().data_received(data)

    def _refuse(self, response: Response) -> None:
        if not self.transport.is_closing():
            self.transport.write(response.serialize())
            self.transport.close()

    def send_data(self) -> None:
        """What the server below has to send; in place of its silence, why a request cannot be read."""
        fault = self.protocol.handshake_exc
        if self.request is None and isinstance(fault, InvalidMessage):
            long = isinstance(fault.__cause__, SecurityError)
            status = (
                http.HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE
                if long
                else http.HTTPStatus.BAD_REQUEST
            )
            remedy = "send fewer headers, in lines that end with CR LF, and no body"
            return self._refuse(
                _plain(status, f"This request cannot be read ({fault.__cause__}): {remedy}.")
            )
        super().send_data()

    def process_event(self, event: Event) -> None:
        """A frame, counted: parts of a message that never ends fill the memory before any limit of messages."""
        if self.transport.is_closing():
            return
        if isinstance(event, Frame) and not self._frames.allows(0, time.monotonic()):
            _log.warning("a browser sent a message in too many parts; its connection was closed")
            self.transport.abort()
            return
        super().process_event(event)

    async def recv(self, decode: bool | None = None) -> Any:
        """The next message that fits; all are counted."""
        while True:
            message = await super().recv(decode)
            if not self._limiter.allows(len(message), time.monotonic()):
                _log.warning("a browser sent too much; its connection was closed")
                # The page shows the reason for this code alone.
                await _close(self, CloseCode.PROTOCOL_ERROR, _FLOOD)
            # viser's messages are binary.
            fault = message_fault(message) if isinstance(message, bytes) else ""
            if not fault:
                return message
            log_dropped(fault)


def _contained(handler: Handler) -> Handler:
    """A message that cannot be read ends its own connection, with one line in the log."""

    async def contained(connection: ServerConnection) -> None:
        try:
            await handler(connection)
        except ConnectionClosed:
            raise
        except Exception as error:
            _log.warning("a browser sent an invalid message (%s: %s)", type(error).__name__, error)
            await _close(connection, CloseCode.INVALID_DATA, "This is not a message of the page.")

    return contained


async def _close(connection: ServerConnection, code: CloseCode, reason: str) -> None:
    with contextlib.suppress(TimeoutError):
        await asyncio.wait_for(connection.close(code, reason), _CLOSING_S)
    connection.transport.abort()


def _served(page: ServedPage, request: Request, extra: dict[str, str]) -> Response:
    """The page, or the status that the browser's own copy is current."""
    headers = Headers(
        {"ETag": page.tag, "Cache-Control": "no-cache", "Vary": "Accept-Encoding", **extra}
    )
    if page.tag in ",".join(request.headers.get_all("If-None-Match")):
        return Response(http.HTTPStatus.NOT_MODIFIED, http.HTTPStatus.NOT_MODIFIED.phrase, headers)
    packs = "gzip" in ",".join(request.headers.get_all("Accept-Encoding"))
    body = page.packed if packs else page.html
    headers["Content-Type"] = "text/html; charset=utf-8"
    headers["Content-Length"] = str(len(body))
    if packs:
        headers["Content-Encoding"] = "gzip"
    return Response(http.HTTPStatus.OK, http.HTTPStatus.OK.phrase, headers, body)


def _plain(status: http.HTTPStatus, sentence: str, **others: str) -> Response:
    # The message may repeat bytes of the request that are not text.
    body = (sentence + "\n").encode(errors="replace")
    kind = {"Content-Type": "text/plain; charset=utf-8", "Content-Length": str(len(body))}
    return Response(status, status.phrase, Headers({**kind, **_HEADERS, **others}), body)
