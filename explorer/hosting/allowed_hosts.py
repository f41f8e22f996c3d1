"""Host names that the server answers to, and the pages that may connect to it."""

import socket
from dataclasses import dataclass
from ipaddress import ip_address
from urllib.parse import urlsplit

_LOOPBACK = ("localhost", "127.0.0.1", "::1")
_DEFAULT_PORTS = {"http": 80, "https": 443}
_SHOWN = 80
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
            shown = (host or "")[:_SHOWN]
            return f"This server does not answer to the name {shown!r}: start it with --allow-host {name[:_SHOWN]}"
        if origin is None or self._is_own(origin, name, port):
            return None
        return f"Pages of {origin[:_SHOWN]!r} may not use this server."

    def _answers_to(self, name: str) -> bool:
        if name in _LOOPBACK or name == self.host.lower() or name in self._also:
            return True
        # A request by number was not sent by a foreign name; the machine's own name is trusted.
        return self.public and (_is_address(name) or name in _own_names())

    def _is_own(self, origin: str, name: str, port: int | None) -> bool:
        scheme, separator, place = origin.partition("://")
        if not separator or scheme not in _DEFAULT_PORTS:
            return False  # Also "null": a sandboxed frame or a file.
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
        raise ValueError(f"{text!r} is not a host name: give it as in rotor.example, without https:// and path")
    return name


def is_loopback(host: str) -> bool:
    """Whether an address to listen on is reached from this machine only."""
    if host.lower() == "localhost":
        return True
    return _is_address(host) and ip_address(host).is_loopback


def warning(host: str) -> str:
    """Two lines to print when the server listens to other machines."""
    return (
        f"Warning: listening on {host}: whoever can reach this port can use the explorer; it asks for no password.\n"
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
