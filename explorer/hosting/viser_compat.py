"""Every use of viser's private parts. Each has a test, and viser is pinned because of them."""

import asyncio
import contextlib
import io
import json
import logging
import secrets
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import viser
import websockets.asyncio.server
from viser import _gui_api, _messages, _viser
from viser._assignable_props_api import AssignablePropsBase
from viser.infra import _infra
from viser.infra._async_message_buffer import AsyncMessageBuffer

from explorer.hosting.limits import accepted_value, refuse_upload
from explorer.hosting.request_filter import RequestFilter
from rotor.arrays import Array

_starting, _silent = threading.Lock(), threading.Lock()
_log = logging.getLogger(__name__)
_SHEET = "rx-sheet"
"""Identity of our style sheet in the page."""
_KEPT = "rx-kept"
"""Where the page keeps what it is given."""
_ONE_PIECE = 4096
"""Messages; a page has some five hundred to begin with."""


class _ThreadedEvent(asyncio.Event):
    """An event that any thread may set. asyncio's own, set by a thread while the loop waits for it, can fail there with
    "deque mutated during iteration": viser sets it for every message, and the update that sent the message was lost."""

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        super().__init__()
        self._own_loop = loop

    def set(self) -> None:
        """Wakes those who wait only on the thread of the loop; viser sets it there once more after each message."""
        self._value = True
        with contextlib.suppress(RuntimeError):  # No loop runs on this thread.
            if asyncio.get_running_loop() is self._own_loop:
                for waiter in tuple(self._waiters):
                    if not waiter.done():
                        waiter.set_result(True)


class ThreadedBuffer(AsyncMessageBuffer):
    """viser's queue of messages, with events that any thread may set."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.message_event, self.flush_event = _ThreadedEvent(self.event_loop), _ThreadedEvent(self.event_loop)


setattr(_infra, "AsyncMessageBuffer", ThreadedBuffer)  # noqa: B010 - its module does not export it

_cast = AssignablePropsBase._cast_value_recursive
_PLAIN = frozenset((str, bool, int, float, type(None)))


def _cast_unless_plain(handle: Any, hint: Any, value: Any, name: str) -> Any:
    """viser compares the type of each assigned value with array types that it makes anew, four fifths of the time of an
    assignment that changes nothing; no plain value is cast."""
    return value if type(value) in _PLAIN else _cast(handle, hint, value, name)


setattr(AssignablePropsBase, "_cast_value_recursive", _cast_unless_plain)  # noqa: B010 - as above


def quiet_server(host: str, port: int, label: str, request_filter: RequestFilter | None = None) -> viser.ViserServer:
    """A server that prints nothing (viser's `verbose=False` still prints a banner), with a filter for its requests."""
    with _silence(), _filtered_by(request_filter) if request_filter else contextlib.nullcontext():
        return viser.ViserServer(host=host, port=port, label=label, verbose=False)


@contextlib.contextmanager
def _silence() -> Iterator[None]:
    """Print nothing. One thread at a time: two at once could leave stdout redirected."""
    with _silent, contextlib.redirect_stdout(io.StringIO()):
        yield


@contextlib.contextmanager
def _filtered_by(request_filter: RequestFilter) -> Iterator[None]:
    """While a server starts, pass its call of `websockets.serve` through the filter: viser has no option for it.

    RuntimeError if there was no such call: a server must not run without its filter.
    """
    serve, passed = websockets.asyncio.server.serve, []

    def filtered(handler: Any, *where: Any, **options: Any) -> Any:
        passed.append(True)
        handler, options = request_filter.around(handler, options)
        return serve(handler, *where, **options)

    with _starting:
        websockets.asyncio.server.serve = filtered  # pyright: ignore[reportAttributeAccessIssue]
        try:
            yield
        finally:
            websockets.asyncio.server.serve = serve
    if not passed:
        raise RuntimeError(
            "The server started without its request filter: this viser starts its server in another way."
        )


def log_failed_callbacks() -> None:
    """Log callbacks that fail, which viser prints: a log can be limited, see `log_limit`."""
    for module in (_gui_api, _viser):
        setattr(module, "print_threadpool_errors", _log_failure)  # noqa: B010 - not of the module's type


def _log_failure(done: Any) -> None:
    if not done.cancelled() and (error := done.exception()) is not None:
        _log.error("a callback failed", exc_info=error)


def client_html() -> str:
    """The page of the client, as it was built."""
    return (Path(viser.__file__).parent / "client" / "build" / "index.html").read_text(encoding="utf-8")


def quiet_stop(server: viser.ViserServer) -> None:
    with _silence():
        server.stop()


def remove_share_tunnel(server: viser.ViserServer) -> None:
    """Ignore the request that opens a public tunnel; hiding its button does not."""
    for message in (_messages.ShareUrlRequest, _messages.ShareUrlDisconnect):
        server._websock_server.unregister_handler(message)


def guard_uploads(client: viser.ClientHandle, tell: Callable[[str], None]) -> None:
    """Accept only uploads within `limits`; `tell` is called with the sentence when one is refused."""
    gui, connection = client.gui, client._websock_connection
    begin, more = gui._handle_file_transfer_start, gui._handle_file_transfer_part
    under_way = gui._current_file_upload_states

    def refuse(component: str | None, transfer: str, sentence: str) -> None:
        under_way.pop(transfer, None)
        # Enables the button again and removes the page's own progress notice.
        connection.queue_message(_messages.FileTransferPartAck(component, transfer, 1, 1))
        connection.queue_message(_messages.RemoveNotificationMessage(f"upload-{transfer}"))
        tell(sentence)

    def started(client_id: Any, message: _messages.FileTransferStartUpload) -> None:
        button = gui._gui_input_handle_from_uuid.get(message.source_component_uuid)
        if button is None:
            return
        accepts = getattr(button._impl.props, "mime_type", "")
        sentence = refuse_upload(message.filename, message.size_bytes, message.part_count, len(under_way), accepts)
        if sentence is None:
            begin(client_id, message)
        else:
            refuse(message.source_component_uuid, message.transfer_uuid, sentence)

    def continued(client_id: Any, message: _messages.FileTransferPart) -> None:
        state = under_way.get(message.transfer_uuid)
        if state is None:
            return  # Refused, or never begun: dropped.
        if state["transferred_bytes"] + len(message.content) > state["total_bytes"]:
            refuse(message.source_component_uuid, message.transfer_uuid, "A file was longer than announced.")
        else:
            more(client_id, message)

    connection.unregister_handler(_messages.FileTransferStartUpload, begin)
    connection.register_handler(_messages.FileTransferStartUpload, started)
    connection.unregister_handler(_messages.FileTransferPart, more)
    connection.register_handler(_messages.FileTransferPart, continued)


def guard_values(client: viser.ClientHandle, tell: Callable[[str], None]) -> None:
    """Let widgets take only values that they can hold; `tell` is called with the sentence when one is refused.

    viser assigns whatever comes, also to other properties, and calls the callbacks with it.
    """
    gui, connection = client.gui, client._websock_connection
    assign = gui._handle_gui_updates

    async def checked(client_id: Any, message: _messages.GuiUpdateMessage) -> None:
        handle: Any = gui._gui_input_handle_from_uuid.get(message.uuid)
        if handle is None:
            return
        props = handle._impl.props
        # viser queues the value for its other pages, of which there is none: each time that wakes what sends, in vain.
        handle._impl.sync_cb = None
        try:
            if set(message.updates) != {"value"}:
                raise ValueError("This page sent more than a value: that is ignored.")
            message.updates["value"] = accepted_value(
                message.updates["value"],
                handle._impl.value,
                choices=getattr(props, "options", ()),
                low=getattr(props, "min", None),
                high=getattr(props, "max", None),
            )
        except ValueError as error:
            tell(str(error))
            return
        await assign(client_id, message)

    setattr(gui, "_thread_executor", _Callbacks(gui._thread_executor))  # noqa: B010 - not of its type
    connection.unregister_handler(_messages.GuiUpdateMessage, assign)
    connection.register_handler(_messages.GuiUpdateMessage, checked)


Callback = Callable[[viser.GuiEvent[Any]], None]


def quick(callback: Callback) -> Callback:
    """A callback that takes no time and waits for nothing: it is called on the event loop.

    Another thread would cost more than it does, and have to wait for its turn of the interpreter.
    """
    setattr(callback, "quick", True)  # noqa: B010 - functions have no such attribute
    return callback


class _Callbacks:
    """viser's threads for callbacks; quick ones are called at once."""

    def __init__(self, threads: ThreadPoolExecutor) -> None:
        self._threads = threads

    def submit(self, callback: Callable[..., Any], *arguments: Any) -> Future[Any]:
        if not getattr(callback, "quick", False):
            return self._threads.submit(callback, *arguments)
        done: Future[Any] = Future()
        try:
            done.set_result(callback(*arguments))
        except Exception as error:
            done.set_exception(error)
        return done


def set_png(handle: viser.ImageHandle, png: bytes) -> None:
    """Assign an encoded PNG: the public setter would encode again, in true colour, for ten times the time."""
    handle._data = png


def place(handle: viser.SceneNodeHandle, wxyz: Array, position: Array | None = None) -> None:
    """Turn and move a node within its parent, where that changes anything: the public setters take ten times as long
    to see that."""
    node = handle._impl
    if (node.wxyz != wxyz).any():
        node.wxyz[:] = wxyz
        node.api._queue_scene_message(_messages.SetOrientationMessage(node.name, tuple(wxyz.tolist())))
    if position is not None and (node.position != position).any():
        node.position[:] = position
        node.api._queue_scene_message(_messages.SetPositionMessage(node.name, tuple(position.tolist())))


def widget_id(handle: viser.GuiInputHandle[Any]) -> str:
    """The name by which a page's messages mean this widget."""
    return handle._impl.uuid


def run_in_page(client: viser.ClientHandle, script: str) -> None:
    """Run a line of JavaScript in the page of one client."""
    client._websock_connection.queue_message(_messages.RunJavascriptMessage(script))


@contextlib.contextmanager
def at_once(client: viser.ClientHandle) -> Iterator[None]:
    """Send everything queued in the block as one piece, so that the page is laid out once. Otherwise it comes in pieces
    of 128 messages, and the layout jumps at each. Nothing in the block may wait for an answer of the page."""
    client._websock_connection.get_message_buffer().max_window_size = _ONE_PIECE
    with client.atomic():
        yield


def set_style(client: viser.ClientHandle, sheet: str) -> None:
    """Put a style sheet into the page's head: one inside a panel goes when that panel is folded away."""
    run_in_page(
        client,
        f"(()=>{{const id='{_SHEET}';const sheet=document.getElementById(id)||document.createElement('style');"
        f"sheet.id=id;sheet.textContent={json.dumps(sheet)};document.head.appendChild(sheet)}})()",
    )


@dataclass(frozen=True)
class PageFacts:
    """What only the browser knows when a page opens."""

    dark: bool = False
    """Whether it asks for dark pages."""
    query: str | None = ""
    """Of its address, from the question mark on; None where the browser did not tell."""
    kept: Mapping[str, str] = field(default_factory=dict[str, str])
    """Texts that it was given to keep by name: see `keep_in_page`."""


def page_facts(client: viser.ClientHandle, timeout: float = 20.0) -> PageFacts:
    """Ask the browser. Blocks, on a busy machine for seconds; not to be called on the event loop."""
    key = f"facts-{client.client_id}-{secrets.token_hex(4)}"  # Other pages share the storage.
    dark = "matchMedia('(prefers-color-scheme: dark)').matches || new URLSearchParams(location.search).has('darkMode')"
    # A page that was open before, and whose server has come back, stays as it was.
    dark = f"document.getElementById('{_SHEET}')?document.documentElement.dataset.mantineColorScheme==='dark':({dark})"
    kept = f"JSON.parse(sessionStorage.getItem('{_KEPT}')??'{{}}')"
    facts = f"JSON.stringify({{dark:{dark},query:location.search,kept:{kept}}})"
    run_in_page(client, f"localStorage.setItem('viser-user:{key}',{facts})")
    try:
        text = client.local_storage.get_item(key, timeout=timeout)
        client.local_storage.remove_item(key)
        found = json.loads(text or "{}")
        kept = {str(name): str(value) for name, value in found.get("kept", {}).items()}
        return PageFacts(bool(found.get("dark")), str(found.get("query", "")), kept)
    except (TimeoutError, RuntimeError, ValueError, AttributeError):
        return PageFacts(query=None)


def keep_in_page(client: viser.ClientHandle, name: str, text: str) -> None:
    """Give the page a text to keep until its window is closed, also while it is loaded again.

    One too long for the browser's store (some megabytes) is not kept, nor what stood there before.
    """
    run_in_page(
        client,
        f"(()=>{{const all=JSON.parse(sessionStorage.getItem('{_KEPT}')??'{{}}');all[{json.dumps(name)}]="
        f"{json.dumps(text)};try{{sessionStorage.setItem('{_KEPT}',JSON.stringify(all))}}"
        f"catch{{sessionStorage.removeItem('{_KEPT}')}}}})()",
    )


def set_query(client: viser.ClientHandle, query: str) -> None:
    """Write the query of the page's address, without loading anything and without a step in its history."""
    run_in_page(client, f"history.replaceState(null,'',location.pathname+{json.dumps(query)})")


def copy_text(client: viser.ClientHandle, expression: str) -> None:
    """Put the value of a JavaScript expression into the clipboard, where the browser allows it."""
    run_in_page(client, f"navigator.clipboard&&navigator.clipboard.writeText({expression}).catch(()=>0)")


def save_picture(client: viser.ClientHandle, drawing: str, size: tuple[int, int], name: str, patience: float) -> int:
    """Have the page save an SVG as a PNG of `size` pixels; how many bytes it has. Not to be called on the event loop.

    RuntimeError with the browser's reason where it could not, or has left; TimeoutError after `patience` [s].
    """
    key = f"picture-{client.client_id}-{secrets.token_hex(4)}"
    run_in_page(client, _picture_script(drawing, *size, name, key))
    deadline = time.monotonic() + patience
    while (said := client.local_storage.get_item(key, timeout=patience)) is None:
        if time.monotonic() > deadline:
            raise TimeoutError(f"the page has not drawn the picture within {patience:g} s")
        time.sleep(0.1)
    client.local_storage.remove_item(key)
    if not said.isdigit():
        raise RuntimeError(said.removeprefix("failed: "))
    return int(said)


_SAVE_PICTURE = """(async () => {
  const said = text => localStorage.setItem('viser-user:' + KEY, text);
  try {
    const address = URL.createObjectURL(new Blob([DRAWING], {type: 'image/svg+xml;charset=utf-8'}));
    const image = new Image();
    image.src = address;
    await image.decode();
    const canvas = document.createElement('canvas');
    canvas.width = WIDTH;
    canvas.height = HEIGHT;
    canvas.getContext('2d').drawImage(image, 0, 0, WIDTH, HEIGHT);
    URL.revokeObjectURL(address);
    const pixels = await new Promise(done => canvas.toBlob(done, 'image/png'));
    if (!pixels) throw new Error('no memory for so many pixels');
    const link = document.createElement('a');
    link.href = URL.createObjectURL(pixels);
    link.download = NAME;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    said(String(pixels.size));
  } catch (error) {
    said('failed: ' + error.message);
  }
})()"""


def _picture_script(drawing: str, width: int, height: int, name: str, key: str) -> str:
    """JavaScript that saves an SVG as a PNG of so many pixels, and says under `key` how many bytes, or why not."""
    words = {"DRAWING": drawing, "NAME": name, "KEY": key}
    script = _SAVE_PICTURE.replace("WIDTH", str(width)).replace("HEIGHT", str(height))
    for word in ("NAME", "KEY", "DRAWING"):  # The drawing last: what it holds is not looked into.
        script = script.replace(word, json.dumps(words[word]))
    return script
