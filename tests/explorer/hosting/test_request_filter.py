"""The server as a client meets it: who may connect, the served page, floods, uploads, places."""

import asyncio
import json
import socket
import threading
import urllib.error
import urllib.request
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import pytest
import viser
from viser import _messages
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.typing import Subprotocol

from explorer.app import App, FirstAnswers, PortBusy
from explorer.hosting import request_filter, server_limits, viser_compat
from explorer.hosting.request_filter import AllowedHosts, RequestFilter, with_loading_screen
from explorer.hosting.server_limits import ServerLimits
from explorer.model.inputs import OPENING
from explorer.model.units import number
from explorer.workers.newest_wins import NewestWins, UpdatePool
from rotor import make_design, solve
from tests.tools import wire
from tests.tools.visitor import Visitor, arrived, ran
from tests.waited import until

OUTER = "Δ outboard [°/R]"
CLIENT = (
    '<!doctype html><html><head><meta name="viewport" content="width=device-width, initial-scale=1" />'
    "<title>Viser</title>\n<script data-p=x>go()</script></head>\n"
    '<body>\n<div id="root"></div></body></html>'
)


@pytest.fixture(scope="module")
def app() -> Iterator[App]:
    app = App("127.0.0.1", 0, limits=ServerLimits(sessions=2))
    yield app
    app.stop()


async def handshake(app: App, **headers: str) -> int:
    """Status of a WebSocket handshake."""
    uri = "ws" + app.address.removeprefix("http")
    origin: Any = headers.pop("Origin", None)
    try:
        async with connect(
            uri,
            subprotocols=[Subprotocol(wire.SUBPROTOCOL)],
            origin=origin,
            additional_headers=headers,
        ):
            return 101
    except InvalidStatus as refused:
        return refused.response.status_code


def fetch(address: str, **headers: str) -> tuple[int, bytes, dict[str, str]]:
    """Status, body and headers of a plain request."""
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    try:
        with urllib.request.urlopen(
            urllib.request.Request(address, headers=named), timeout=60
        ) as answer:
            return answer.status, answer.read(), dict(answer.headers)
    except urllib.error.HTTPError as error:
        with error:
            return error.code, error.read(), dict(error.headers)


def test_the_veil_comes_before_the_script_and_the_script_before_the_root():
    html = with_loading_screen(CLIENT).html.decode()
    parts = (
        "<title>Rotor explorer</title>",
        "</head>",
        'id="rx-veil"',
        "data-p=x>go()",
        'id="root"',
    )
    assert [html.index(part) for part in parts] == sorted(html.index(part) for part in parts)
    assert (
        html.count("<body>")
        == html.count("</head>")
        == html.count("initial-scale=1, minimum-scale=1")
        == 1
    )


@pytest.mark.parametrize(
    "client",
    [
        "",
        "<html></html>",
        CLIENT.replace("<title>", "<t>"),
        CLIENT.replace("scale=1", ""),
        CLIENT.replace("<body>", ""),
    ],
)
def test_another_page_is_refused(client: str):
    with pytest.raises(ValueError, match="not built as expected"):
        with_loading_screen(client)


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    gate = RequestFilter(AllowedHosts("127.0.0.1"), 4, with_loading_screen(CLIENT))
    server: viser.ViserServer = viser_compat.quiet_server("127.0.0.1", 0, "x", gate)
    yield f"http://127.0.0.1:{server.get_port()}"
    viser_compat.quiet_stop(server)


def test_a_page_is_packed_for_those_who_unpack_and_sent_once(address: str):
    status, body, headers = fetch(address + "/?d=1;linear:-8")
    assert (status, body) == (200, with_loading_screen(CLIENT).html)
    status, body, _ = fetch(address, If_None_Match=headers["ETag"])
    assert (status, body) == (304, b"")
    assert fetch(address, If_None_Match='"other"')[0] == 200
    _, body, headers = fetch(address, Accept_Encoding="gzip, br")
    assert headers["Content-Encoding"] == "gzip"
    assert body == with_loading_screen(CLIENT).packed


class TestFirstAnswer:
    """The loading screen has the number that the page then shows; a bad address has none, and asks nothing twice."""

    def words(self, app: App, query: str) -> list[str]:
        return until(
            lambda: fetch(f"{app.address}/first-answer{query}")[1].decode().strip().splitlines()
        )

    def test_it_is_the_power_of_the_design_of_the_address(self, app: App):
        power, design, flight = self.words(app, "?d=1;linear:-12;mu=0.33")
        solution = solve(make_design(twist="linear:-12", mu=0.33))
        assert power == f"{number(solution.power.total / 1e3)} kW"
        assert (design, flight.split(" · ")[0]) == ("UH-60A · linear −12\u00a0°/R", "µ 0.330")

    def test_another_address_waits_its_turn_and_a_bad_one_has_no_words(self):
        pool, begun, go = UpdatePool(1), threading.Event(), threading.Event()
        NewestWins(
            lambda: begun.set() or iter([0.0] if go.wait(60.0) else []), lambda _: None, pool
        ).wake()
        assert begun.wait(60.0)
        first = FirstAnswers(lambda: OPENING, pool)

        def answered(query: str) -> str:
            until(lambda: first(query) or (query, OPENING) in first._known)
            return first._known[query, OPENING]

        assert first("d=1;linear:-8") == first("d=1;linear:-9") == ""
        assert pool.waiting == 1  # Behind the page, and the other behind it.
        assert not first._known
        go.set()
        assert "kW" in answered("d=1;linear:-8")
        for query in ("d=nonsense", "d=1;linear:-12;mu=0.44;mass=11000;altitude=4000"):
            assert answered(query) == ""


OWN = b"Host: 127.0.0.1\r\n"
UPGRADE = b"Upgrade: websocket\r\n"


@pytest.mark.parametrize(
    ("line", "headers", "status", "words"),
    [
        (b"HEAD / HTTP/1.1", OWN, 200, b""),
        (b"HEAD /place HTTP/1.1", OWN + UPGRADE, 400, b""),
        (b"POST / HTTP/1.1", OWN, 405, b"only GET and HEAD"),
        (b"OPTIONS / HTTP/1.1", OWN, 405, b"Allow: GET, HEAD"),
        (b"GET / HTTP/1.0", OWN, 505, b"only HTTP/1.1"),
        (
            b"GET / HTTP/1.1",
            OWN + b"".join(b"A%d: b\r\n" % k for k in range(300)),
            431,
            b"too many HTTP headers",
        ),
        (b"GET / HTTP/1.1", OWN + b"Transfer-Encoding: chunked\r\n", 400, b"cannot be read"),
        (
            b"GET / HTTP/1.1",
            OWN + b"Expect: 100-continue\r\nContent-Length: 5\r\n",
            400,
            b"cannot be read",
        ),
        (b"GET / HTTP/1.1\nHost: 127.0.0.1\n", OWN, 400, b"end with CR LF"),
        (b"nonsense", OWN, 400, b"cannot be read"),
        (b"GET / HTTP/1.1", b"Host: caf\xc3\xa9.example\r\n", 403, b"--allow-host"),
        (b"GET / HTTP/1.1", OWN + 2 * UPGRADE, 400, b"Upgrade"),
        (
            b"GET /first-answer?d=1;linear:-8 HTTP/1.1",
            OWN + b"Sec-Fetch-Site: cross-site\r\n",
            403,
            b"other sites",
        ),
        (
            b"GET /first-answer?d=1;linear:-8 HTTP/1.1",
            OWN + b"Sec-Fetch-Site: same-origin\r\n",
            200,
            b"",
        ),
    ],
)
def test_each_request_has_an_answer(
    address: str, line: bytes, headers: bytes, status: int, words: bytes
):
    """Also those of health checks; they come in pieces."""
    answer = b""
    with socket.create_connection(
        ("127.0.0.1", int(address.rpartition(":")[2])), timeout=90.0
    ) as probe:
        probe.sendall(line[:3])
        probe.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        probe.sendall(line[3:] + b"\r\n" + headers + b"\r\n")
        while piece := probe.recv(65536):
            answer += piece
    head, _, body = answer.partition(b"\r\n\r\n")
    assert head.startswith(b"HTTP/1.1 %d " % status)
    assert words in answer
    assert body or line.startswith(b"HEAD") or status == 200


class TestAllowedHosts:
    def test_only_our_own_page_and_clients_without_origin_connect(self, app: App):
        assert ran(lambda: handshake(app, Origin="http://evil.example")) == 403
        assert ran(lambda: handshake(app, Origin="null")) == 403
        assert ran(lambda: handshake(app, Origin=app.address)) == 101
        assert ran(lambda: handshake(app)) == 101
        assert ran(lambda: handshake(app, Host="evil.example")) == 400

    def test_headers_forbid_foreign_frames_and_referrers(self, app: App):
        status, _, headers = fetch(app.address)
        assert status == 200
        assert headers["Content-Security-Policy"] == "frame-ancestors 'self'"
        assert headers["Referrer-Policy"] == "same-origin"

    def test_no_browser_can_open_a_tunnel_to_the_public(self, app: App):
        handlers = app.server._websock_server._incoming_handlers
        assert not handlers.get(_messages.ShareUrlRequest)
        assert not handlers.get(_messages.ShareUrlDisconnect)

    def test_a_malformed_request_prints_nothing(self, app: App, caplog: pytest.LogCaptureFixture):
        with socket.create_connection(("127.0.0.1", app.server.get_port()), timeout=90.0) as probe:
            probe.sendall(b"GET\r\nHost: 127.0.0.1\r\n\r\n")
            while probe.recv(4096):
                pass
        assert ran(lambda: handshake(app)) == 101  # By then the server has done with the probe.
        assert caplog.text == ""

    def test_a_server_without_its_filter_does_not_start(self, monkeypatch: pytest.MonkeyPatch):
        class Elsewhere:
            def __init__(self, **_: object) -> None: ...

        monkeypatch.setattr(viser, "ViserServer", Elsewhere)
        with pytest.raises(RuntimeError, match="without its request filter"):
            viser_compat.quiet_server(
                "127.0.0.1", 0, "x", RequestFilter(AllowedHosts("127.0.0.1"), 1)
            )

    def test_an_unknown_host_to_listen_on_is_one_sentence(self):
        with pytest.raises(PortBusy, match="choose another with --host"):
            App("no.such.host.invalid", 0)


@pytest.mark.slow
class TestStrangers:
    def test_a_flood_and_an_invalid_message_end_only_their_own_connection(
        self, app: App, monkeypatch: pytest.MonkeyPatch
    ):
        async def work() -> None:
            other = await arrived(app.address)
            monkeypatch.setattr(
                request_filter,
                "RateLimiter",
                lambda now, *given: server_limits.RateLimiter(
                    now, *(given or (server_limits.RateLimit(0.01, 50.0),))
                ),
            )
            flooder = Visitor()
            await flooder.open(app.address)
            for _ in range(60):
                await flooder.send("GuiUpdateMessage", uuid="none", updates={})
            with pytest.raises(ConnectionError, match="Rate limit exceeded"):
                await flooder.until(lambda: False)
            for junk in (
                "text",
                b"\xff\xff",
                b"",
                wire.encode("NoSuch"),
                wire.encode("GuiUpdateMessage", colour=1),
            ):
                assert await cut(app, junk) in (None, 1002, 1007)
            await still_served(other)
            connections = app.server._websock_server._live_connections.values()
            assert [one.protocol.max_message_size for one in connections] == [
                server_limits.LARGEST_MESSAGE
            ]
            await other.close()

        ran(work)


class TestUploads:
    def test_uploads_arrive_or_are_refused_with_a_sentence(self, app: App):
        design = json.dumps({"twist": "linear:-9"}).encode()

        async def work() -> None:
            visitor = await arrived(app.address)
            for name, size, parts, sentence in (
                ("mine.json", len(design), [design], "Loaded: mine.json is on the sliders"),
                (
                    "large.json",
                    server_limits.LARGEST_FILE + 1,
                    [b"x"],
                    "File refused: 'large.json' has 4.0 MB",
                ),
                ("film.mp4", 10, [b"x" * 10], "choose a .json"),
                ("liar.json", 10, [b"x" * 5, b"x" * 600], "not as long as announced"),
                ("again.json", len(design), [design], "Loaded: again.json is on the sliders"),
            ):
                visitor.notices.clear()
                await upload(visitor, name, size, parts)
                await visitor.until(lambda: bool(visitor.notices))
                assert sentence in visitor.notices[0]
                assert not any(
                    client.gui._current_file_upload_states
                    for client in app.server.get_clients().values()
                )
            await visitor.close()

        ran(work)


@pytest.mark.slow
class TestPlaces:
    def test_too_many_connections_are_refused(self):
        server = viser_compat.quiet_server(
            "127.0.0.1", 0, "x", RequestFilter(AllowedHosts("127.0.0.1"), 1)
        )
        try:

            async def work() -> None:
                visitor = Visitor()
                address = f"http://127.0.0.1:{server.get_port()}"
                await visitor.open(address)
                with pytest.raises(InvalidStatus, match="503"):
                    await Visitor().open(address)
                await visitor.close()

            ran(work)
        finally:
            viser_compat.quiet_stop(server)


async def still_served(visitor: Visitor) -> None:
    """A slider moved by this visitor still moves its blade."""
    before = visitor.blade
    value = visitor.widgets[visitor.find(OUTER)]["value"]
    await visitor.move(OUTER, value + 1.0)
    await visitor.until(lambda: visitor.blade != before)


async def upload(visitor: Visitor, name: str, size: int, parts: list[bytes]) -> None:
    button = visitor.find("Load design")
    await visitor.send(
        "FileTransferStartUpload",
        source_component_uuid=button,
        transfer_uuid="t",
        filename=name,
        mime_type="application/json",
        part_count=len(parts),
        size_bytes=size,
    )
    for k, part in enumerate(parts):
        await visitor.send(
            "FileTransferPart",
            source_component_uuid=button,
            transfer_uuid="t",
            part_index=k,
            content=part,
        )


async def cut(app: App, message: bytes | str) -> int | None:
    """The code with which the server closes after a message."""
    uri = "ws" + app.address.removeprefix("http")
    async with connect(uri, subprotocols=[Subprotocol(wire.SUBPROTOCOL)], max_size=None) as socket:
        try:
            await socket.send(message)
            while True:
                await socket.recv()
        except ConnectionClosed as closed:
            return None if closed.rcvd is None else closed.rcvd.code


def _handshake(app: App, source: str = "127.0.0.1") -> socket.socket:
    """A connection that speaks WebSocket by hand."""
    port = app.server.get_port()
    own = socket.create_connection(("127.0.0.1", port), timeout=30, source_address=(source, 0))
    head = (
        f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        f"Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Version: 13\r\n"
        f"Sec-WebSocket-Protocol: {wire.SUBPROTOCOL}\r\n\r\n"
    )
    own.sendall(head.encode())
    answer = b""
    while b"\r\n\r\n" not in answer:
        answer += own.recv(4096)
    assert b" 101 " in answer.partition(b"\r\n")[0]
    return own


def _frame(first: int, payload: bytes = b"") -> bytes:
    size = len(payload)
    length = bytes([0x80 | size]) if size < 126 else b"\xff" + size.to_bytes(8, "big")
    return bytes([first]) + length + bytes(4) + payload


class TestMessagesThatNeverEnd:
    @pytest.mark.parametrize("part", [b"", b"x"], ids=["empty", "a byte"])
    def test_endless_parts_end_their_own_connection(
        self, app: App, part: bytes, caplog: pytest.LogCaptureFixture
    ):
        """1.5 million empty parts in 8 s took 110 MB, and nothing ended them."""
        sent = 0
        with _handshake(app) as own, suppress(OSError):
            own.sendall(_frame(0x02, b"a"))
            while sent < 5_000_000:
                own.sendall(_frame(0x00, part) * 10_000)
                sent += 10_000
        assert sent < 5_000_000
        assert "too many parts" in caplog.text
        self.others_are_served(app)

    def test_a_message_of_60_mb_ends_its_own_connection(self, app: App):
        with _handshake(app) as own:
            with suppress(OSError):
                own.sendall(_frame(0x82, bytes(60_000_000)))
            with suppress(OSError):
                while own.recv(2**16):
                    pass
        self.others_are_served(app)

    @staticmethod
    def others_are_served(app: App) -> None:
        async def visit() -> None:
            await (await arrived(app.address)).close()

        ran(visit)


@pytest.mark.parametrize(
    ("allowed", "served"), [((), False), (("127.0.0.2",), True), (("rotor.example",), False)]
)
def test_behind_a_proxy_at_another_address_of_this_machine(allowed: tuple[str, ...], served: bool):
    """It is refused with the flag that allows it, and served with that flag."""
    app = App("127.0.0.1", 0, limits=ServerLimits(allow_hosts=allowed))

    async def copy(source: asyncio.StreamReader, to: asyncio.StreamWriter) -> None:
        with suppress(OSError):
            while data := await source.read(2**16):
                to.write(data)
                await to.drain()
        to.close()

    async def relay(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        theirs = await asyncio.open_connection(
            "127.0.0.1", app.server.get_port(), local_addr=("127.0.0.3", 0)
        )
        await asyncio.gather(copy(reader, theirs[1]), copy(theirs[0], writer))

    async def visit() -> str:
        proxy = await asyncio.start_server(relay, "127.0.0.2", 0)
        address = f"http://127.0.0.2:{proxy.sockets[0].getsockname()[1]}"
        visitor = Visitor()
        try:
            await visitor.open(address)
            await visitor.until(lambda: visitor.text("status") == "converged")
            return "served"
        except InvalidStatus as refusal:
            return (refusal.response.body or b"").decode()
        finally:
            await visitor.close()
            proxy.close()
            await asyncio.sleep(0.2)

    try:
        said = ran(visit)
    finally:
        app.stop()
    assert (said == "served") == served
    assert served or "--allow-host 127.0.0.2" in said
