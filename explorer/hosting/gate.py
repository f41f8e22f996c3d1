"""What stands between the network and the page's server: whose requests come in, how many, how much they may send."""

import asyncio
import contextlib
import http
import logging
import time
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any

from websockets.asyncio.server import ServerConnection
from websockets.datastructures import Headers, MultipleValuesError
from websockets.exceptions import ConnectionClosed
from websockets.frames import CloseCode
from websockets.http11 import Request, Response

from explorer.hosting.doors import AllowedHosts
from explorer.hosting.meter import LARGEST, RateLimiter
from explorer.hosting.page import ServedPage

_log = logging.getLogger(__name__)
_visitors = logging.getLogger(f"{__name__}.visitors")
_visitors.setLevel(logging.CRITICAL)  # A probe that sends no proper request is no error of ours to print.

Answer = Callable[[ServerConnection, Request], Response | None]
Handler = Callable[[ServerConnection], Awaitable[None]]

_FLOOD = "More came from this page than the server takes; it starts again."
_PARTING = 1.0
"""[s] given to a client that is sent away to say goodbye."""
_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "same-origin",  # An address may hold a design.
    "Content-Security-Policy": "frame-ancestors 'self'",  # No foreign page puts ours under its buttons.
}


@dataclass(frozen=True)
class RequestFilter:
    """The rules, and the arguments for `websockets.serve` that enforce them."""

    doors: AllowedHosts
    connections: int
    """WebSockets at once; more than sessions, for some wait, sleep, or have not said who they are."""
    page: ServedPage | None = None
    """What is served in place of the server's own page."""
    frame_ancestors: tuple[str, ...] = ()
    """Origins of other pages that may show this one in a frame, such as a notebook's."""

    def around(self, handler: Handler, options: dict[str, Any]) -> tuple[Handler, dict[str, Any]]:
        """A server's handler and options with the gate before them."""
        gated = {**options, "max_size": LARGEST, "create_connection": RateLimitedConnection, "logger": _visitors}
        gated["process_request"] = self._asked(options["process_request"])
        return _contained(handler), gated

    @property
    def _headers(self) -> dict[str, str]:
        ancestors = " ".join(("frame-ancestors 'self'", *self.frame_ancestors))
        return {**_HEADERS, "Content-Security-Policy": ancestors}

    def _asked(self, inner: Answer) -> Answer:
        def process_request(connection: ServerConnection, request: Request) -> Response | None:
            upgrade = (request.headers.get("Upgrade") or "").lower() == "websocket"
            try:
                host, origin = request.headers.get("Host"), request.headers.get("Origin")
            except MultipleValuesError:
                host, origin = None, None
            sentence = self.doors.refusal(host, origin if upgrade else None)
            if sentence is not None:
                return _plain(http.HTTPStatus.FORBIDDEN, sentence)
            if upgrade and len(connection.server.connections) >= self.connections:
                return _plain(http.HTTPStatus.SERVICE_UNAVAILABLE, "Too many pages are open: try again later.")
            if not upgrade and self.page is not None and request.path.partition("?")[0] in ("/", "/index.html"):
                return _served(self.page, request, self._headers)
            answer = inner(connection, request)
            if answer is not None:
                for name, value in self._headers.items():
                    answer.headers[name] = value
            return answer

        return process_request


class RateLimitedConnection(ServerConnection):
    """A connection that is cut off when it sends more than it may."""

    def __init__(self, *positional: Any, **named: Any) -> None:
        super().__init__(*positional, **named)
        self._meter = RateLimiter(time.monotonic())

    async def recv(self, decode: bool | None = None) -> Any:
        """The next message, counted."""
        message = await super().recv(decode)
        if not self._meter.take(len(message), time.monotonic()):
            _log.warning("a browser sent too much and was cut off")
            # The page shows the reason for this code alone.
            await _part(self, CloseCode.PROTOCOL_ERROR, _FLOOD)
        return message


def _contained(handler: Handler) -> Handler:
    """A message that is none ends its own connection, with a line in the log and no more."""

    async def contained(connection: ServerConnection) -> None:
        try:
            await handler(connection)
        except ConnectionClosed:
            raise
        except Exception as error:
            _log.warning("a browser sent what is no message (%s: %s)", type(error).__name__, error)
            await _part(connection, CloseCode.INVALID_DATA, "This is no message of the page.")

    return contained


async def _part(connection: ServerConnection, code: CloseCode, reason: str) -> None:
    with contextlib.suppress(TimeoutError):
        await asyncio.wait_for(connection.close(code, reason), _PARTING)
    connection.transport.abort()


def _served(page: ServedPage, request: Request, extra: dict[str, str]) -> Response:
    """The page, or the word that the browser's own copy still holds."""
    headers = Headers({"ETag": page.tag, "Cache-Control": "no-cache", "Vary": "Accept-Encoding", **extra})
    if page.tag in ",".join(request.headers.get_all("If-None-Match")):
        return Response(http.HTTPStatus.NOT_MODIFIED, http.HTTPStatus.NOT_MODIFIED.phrase, headers)
    packs = "gzip" in ",".join(request.headers.get_all("Accept-Encoding"))
    body = page.packed if packs else page.html
    headers["Content-Type"] = "text/html; charset=utf-8"
    headers["Content-Length"] = str(len(body))
    if packs:
        headers["Content-Encoding"] = "gzip"
    return Response(http.HTTPStatus.OK, http.HTTPStatus.OK.phrase, headers, body)


def _plain(status: http.HTTPStatus, sentence: str) -> Response:
    body = (sentence + "\n").encode()
    headers = Headers({"Content-Type": "text/plain; charset=utf-8", "Content-Length": str(len(body)), **_HEADERS})
    return Response(status, status.phrase, headers, body)
