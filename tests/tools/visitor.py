"""A browser without a screen: keeps its widgets, reads every frame, moves sliders as the page would."""

import asyncio
import json
import re
from collections.abc import Callable, Coroutine
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

from explorer.page import Page
from tests.tools import wire

Part = TypeVar("Part")
Result = TypeVar("Result")
BLADE = "/rotor/blade_0"
"""The reference blade: the pitch of its rings tells which twist a frame shows."""
BRIDGE = "frame"
"""Label of the text widget that takes the messages of the page's own scripts."""
_CAMERA = {
    "wxyz": (1.0, 0.0, 0.0, 0.0), "position": (20.0, 0.0, 20.0), "fov": 0.5, "near": 1.0, "far": 1000.0,
    "image_height": 940, "image_width": 840, "look_at": (0.0, 0.0, 0.0), "up_direction": (0.0, 0.0, 1.0),
}  # fmt: skip
_SHOWN = r'data-explorer="{}"([^>]*)>([^<]*)'
_FRAME = re.compile(r"RX\.set\((\{.*\})\)", re.DOTALL)
_FORMS = re.compile(r"rotorDisk\.form\((\{.*\})\)", re.DOTALL)
_TOLD = re.compile(r"RX\.(keep|address)\((.*)\)", re.DOTALL)
_CARD_KINDS = {"care": "converged"}
"""Kinds of the status that the page marks otherwise."""
_KIND = re.compile(r'data-kind="(\w+)"')


class Visitor:
    """One connection, from `open` to `close`."""

    def __init__(self, query: str = "", kept: dict[str, str] | None = None) -> None:
        self._facts: dict[str, Any] = {"dark": False, "query": query, "kept": kept or {}}
        """What the page answers when it is asked; query: what follows the address, kept: texts the server gave it."""
        self._socket: ClientConnection | None = None
        self._reading: asyncio.Task[None] | None = None
        self._news = asyncio.Event()
        self.widgets: dict[str, dict[str, Any]] = {}
        """Properties by identity, as the page holds them; a widget's value under `value`."""
        self.frame: dict[str, Any] = {}
        """Parts of the page's state that the frame shows."""
        self.notices: list[str] = []
        self.blade: list[float] = []
        """Pitch of each ring of the reference blade [rad]."""
        self.pictures = 0
        """Pictures of the disk."""
        self.frames = 0
        self.bytes = 0
        self._pressed = 0
        self.gone: str | None = None
        """Why the connection ended, once it has."""

    async def open(self, address: str, **options: Any) -> None:
        """Connect to `http://host:port` and say where the camera is, as a page does once it is laid out."""
        uri = "ws" + address.removeprefix("http")
        subprotocols = [Subprotocol(wire.SUBPROTOCOL)]
        self._socket = await connect(
            uri,
            subprotocols=subprotocols,
            max_size=None,
            compression=None,
            open_timeout=90.0,
            **options,
        )
        self._reading = asyncio.create_task(self._read(self._socket))
        await self.send("ViewerCameraMessage", **_CAMERA)

    async def close(self) -> None:
        if self._socket is not None:
            await self._socket.close()
        if self._reading is not None:
            await self._reading

    async def send(self, kind: str, **fields: Any) -> None:
        """Any message, as raw as the page's own; silent once the connection has ended, as the page is."""
        if self._socket is None or self.gone is not None:
            return
        try:
            await self._socket.send(wire.encode(kind, **fields))
        except ConnectionClosed as closed:
            self._lost(closed)

    async def move(self, label: str, value: Any) -> None:
        """Set the visible widget of that label."""
        uuid = self.find(label)
        self.widgets[uuid]["value"] = value
        await self.send("GuiUpdateMessage", uuid=uuid, updates={"value": value})

    async def idle(self, patience: float = 240.0, wholly: bool = True) -> None:
        """Wait until all edits are answered and, wholly, nothing more is computed for this page, as `RX.idle` does."""
        asked = self._pressed + 1
        await self.press("idle", [asked, wholly])
        await self.until(lambda: self.frame.get("idle") == asked, patience)

    async def press(self, name: str, value: Any = None) -> None:
        """What the page's own scripts send, as `RX.send` does."""
        self._pressed += 1
        uuid = next(uuid for uuid, widget in self.widgets.items() if widget.get("label") == BRIDGE)
        value = json.dumps([self._pressed, name, value])
        await self.send("GuiUpdateMessage", uuid=uuid, updates={"value": value})

    def find(self, label: str) -> str:
        """Identity of the visible widget of a label; LookupError where none is shown."""
        for uuid, widget in self.widgets.items():
            if widget.get("label") == label and widget.get("visible", True):
                return uuid
        raise LookupError(f"No widget {label!r} is shown.")

    def shows(self, label: str) -> bool:
        return any(
            widget.get("label") == label and widget.get("visible", True)
            for widget in self.widgets.values()
        )

    def text(self, part: str) -> str:
        """Text or kind of an element that the page marks with `data-explorer`; empty where there is none."""
        line = self.frame.get("line")
        if line is not None and part == "status":
            return str(_CARD_KINDS.get(line["status"]["kind"], line["status"]["kind"]))
        if line is not None and part == "total-power":
            return next((piece["text"] for piece in line["pieces"] if piece["part"] == part), "")
        for widget in self.widgets.values():
            if shown := re.search(_SHOWN.format(part), str(widget.get("content"))):
                kind = _KIND.search(shown[1])
                return kind[1] if kind else shown[2]
        return ""

    async def until(self, true: Callable[[], bool], patience: float = 90.0) -> None:
        """Wait for something the server's messages bring about; TimeoutError after `patience` [s]."""
        async with asyncio.timeout(patience):
            while not true():
                if self.gone is not None:
                    raise ConnectionError(self.gone)
                self._news.clear()
                await self._news.wait()

    async def _read(self, socket: ClientConnection) -> None:
        try:
            async for frame in socket:
                assert isinstance(frame, bytes)
                self.frames += 1
                self.bytes += len(frame)
                for message in wire.decode(frame):
                    await self._hear(message)
                self._news.set()
            self.gone = "closed"
        except ConnectionClosed as closed:
            self._lost(closed)
        except Exception as error:  # Whoever waits hears of it, and `close` raises it.
            self.gone = f"a message could not be read ({error!r})"
            raise
        finally:
            self._news.set()

    def _keep(self, what: str, *texts: str) -> None:
        if what == "keep":
            self._facts["kept"][texts[0]] = texts[1]
        else:
            self._facts["query"] = texts[0]

    @property
    def query(self) -> str:
        """Of the page's address, as it stands."""
        return self._facts["query"]

    def again(self) -> "Visitor":
        """The page as it is loaded again: with its address, and with what it was given to keep."""
        return Visitor(query=self._facts["query"], kept=self._facts["kept"])

    def _lost(self, closed: ConnectionClosed) -> None:
        self.gone = str(closed.rcvd or closed)

    async def _hear(self, message: wire.Message) -> None:
        match message["type"]:
            case "GuiUpdateMessage":
                self.widgets.setdefault(message["uuid"], {}).update(message["updates"])
            case "GuiRemoveMessage":
                self.widgets.pop(message["uuid"], None)
            case "LocalStorageGetItemRequestMessage":
                value = json.dumps(self._facts) if message["key"].startswith("facts-") else None
                await self.send(
                    "LocalStorageGetItemResponseMessage",
                    value=value,
                    error=None,
                    request_uuid=message["request_uuid"],
                )
            case "NotificationShowMessage":
                props = message.get("props", message)
                self.notices.append(f"{props.get('title', '')}: {props.get('body', '')}")
            case "RunJavascriptMessage":
                if state := _FRAME.fullmatch(message["source"]):
                    self.frame.update(json.loads(state[1]))
                elif forms := _FORMS.fullmatch(message["source"]):
                    self.blade = json.loads(forms[1]).get(BLADE, [self.blade])[0]
                elif message["source"].startswith("rotorDisk.paint("):
                    self.pictures += 1
                elif told := _TOLD.fullmatch(message["source"]):
                    self._keep(told[1], *json.loads(f"[{told[2]}]"))
            case _ if "props" in message and "uuid" in message:
                self.widgets[message["uuid"]] = {**message["props"], "value": message.get("value")}


def part_of(page: Page, kind: type[Part]) -> Part:
    """The part of a page that has this class."""
    shows: list[Any] = [*page.context.refreshing, *page.context.following]
    return next(part for show in shows if isinstance(part := getattr(show, "__self__", None), kind))


async def arrived(address: str, **options: Any) -> Visitor:
    """A page that shows its first trim."""
    visitor = Visitor(**options)
    await visitor.open(address)
    await visitor.until(lambda: visitor.text("status") == "converged")
    return visitor


def ran(work: Callable[[], Coroutine[Any, Any, Result]], patience: float = 240.0) -> Result:
    """The outcome of visitors' work, on a thread of its own: where a browser is open, this one has a loop already.

    TimeoutError after `patience` [s].
    """

    async def bounded() -> Result:
        async with asyncio.timeout(patience):
            return await work()

    with ThreadPoolExecutor(1) as thread:
        return thread.submit(lambda: asyncio.run(bounded())).result()
