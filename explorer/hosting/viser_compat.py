"""Every change to viser and websockets, and every use of viser's private parts, for the versions named below.

| what is changed | why | what it becomes |
| --- | --- | --- |
| `viser.infra._infra.AsyncMessageBuffer` | updates of threads could be lost; needless warnings | `ThreadedBuffer` |
| `AssignablePropsBase._cast_value_recursive` | most of an assignment's time, for nothing | `_cast_unless_plain` |
| `print_threadpool_errors` | errors of callbacks are printed | `log_failed_callbacks` |
| `websockets.asyncio.server.serve`, while a server starts | viser has no option for a filter | `quiet_server` |
| `websockets.http11.MAX_LINE_LENGTH` | a long address is dropped without an answer | `LONGEST_HEAD` |
| the handlers of `ShareUrl…` messages | any client could open a public tunnel | `remove_share_tunnel` |
| the handlers of `FileTransfer…` messages | uploads have no limit | `guard_uploads` |
| the handler of `GuiUpdateMessage` messages | any value is taken | `guard_values` |
| the threads of callbacks | a thread costs more than a quick callback takes | `on_event_loop` |

`tests/explorer/hosting/test_viser_compat.py` has a test for each, or says where it is. What is changed in viser's
client is in `explorer/web/viser.js`: its docks stay in a narrow window, no edit is lost to the next, we hear when it
can send, a page that is seen tries to connect, messages for the scene are handled on arrival, in software drawn once,
and an attempt to connect may take its time (`test_reconnect.py`).
What would make each of these changes needless: docs/developers/made.md.
"""

import asyncio
import contextlib
import io
import logging
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from pathlib import Path
from typing import Any

import numpy as np
import viser
import websockets.asyncio.server
import websockets.http11
from viser import _gui_api, _messages, _viser
from viser._assignable_props_api import AssignablePropsBase
from viser.infra import _infra
from viser.infra._async_message_buffer import AsyncMessageBuffer

from explorer.hosting.messages import LONGEST_HEAD, NoDesign, accepted_value, log_dropped
from explorer.hosting.request_filter import RequestFilter
from explorer.hosting.server_limits import refuse_upload
from rotor.support.arrays import Array

VISER, WEBSOCKETS = "1.1.1", "16.1"
"""The versions that this file is for."""
_starting, _silent = threading.Lock(), threading.Lock()
_log = logging.getLogger(__name__)
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
    """viser's queue of messages, with events that any thread may set. It does not warn of a message to a browser that
    has left: that may happen in the middle of any update. (A filter of warnings would not do: it is one for all
    threads, and a library that sets its own for a moment in one of them undoes it.)"""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.message_event, self.flush_event = (
            _ThreadedEvent(self.event_loop),
            _ThreadedEvent(self.event_loop),
        )
        self._warned_push_after_done = True


setattr(_infra, "AsyncMessageBuffer", ThreadedBuffer)  # noqa: B010 - its module does not export it

_cast = AssignablePropsBase._cast_value_recursive
_PLAIN = frozenset((str, bool, int, float, type(None)))


def _cast_unless_plain(handle: Any, hint: Any, value: Any, name: str) -> Any:
    """viser compares the type of each assigned value with array types that it makes anew, four fifths of the time of an
    assignment that changes nothing; no plain value is cast. Of text that is more than a `str`, as markup, its encoder
    knows nothing."""
    if type(value) in _PLAIN:
        return value
    return str(value) if isinstance(value, str) else _cast(handle, hint, value, name)


setattr(AssignablePropsBase, "_cast_value_recursive", _cast_unless_plain)  # noqa: B010 - as above

_add_html = viser.GuiApi.add_html


def _add_plain_html(gui: viser.GuiApi, content: str, **options: Any) -> viser.GuiHtmlHandle:
    """Markup as a plain `str`, for the reason given above."""
    return _add_html(gui, str(content), **options)


setattr(viser.GuiApi, "add_html", _add_plain_html)  # noqa: B010 - as above

websockets.http11.MAX_LINE_LENGTH = LONGEST_HEAD


def quiet_server(
    host: str, port: int, label: str, request_filter: RequestFilter | None = None
) -> viser.ViserServer:
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
            "The server started without its request filter: this viser starts servers in another way."
        )


def log_failed_callbacks() -> None:
    """Log callbacks that fail, which viser prints: a log can be limited, see `gate.limit_log`."""
    for module in (_gui_api, _viser):
        setattr(module, "print_threadpool_errors", _log_failure)  # noqa: B010 - not of the module's type


def _log_failure(done: Any) -> None:
    error = None if done.cancelled() else done.exception()
    if isinstance(error, NoDesign):  # The page shows the sentence.
        log_dropped(str(error))
    elif error is not None:
        _log.error("a callback failed", exc_info=error)


def client_html() -> str:
    return (Path(viser.__file__).parent / "client" / "build" / "index.html").read_text(
        encoding="utf-8"
    )


def quiet_stop(server: viser.ViserServer) -> None:
    with _silence():
        server.stop()


def remove_share_tunnel(server: viser.ViserServer) -> None:
    """Ignore the request that opens a public tunnel; hiding its button does not."""
    for message in (_messages.ShareUrlRequest, _messages.ShareUrlDisconnect):
        server._websock_server.unregister_handler(message)


def guard_uploads(client: viser.ClientHandle, tell: Callable[[str], None]) -> None:
    """Accept only what `gate.refuse_upload` lets pass; `tell` is called with the sentence when one is refused."""
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
        button: Any = gui._gui_input_handle_from_uuid.get(message.source_component_uuid)
        if not isinstance(button, viser.GuiUploadButtonHandle):
            return  # The file would become the value of another widget.
        accepts = getattr(button._impl.props, "mime_type", "")
        sentence = refuse_upload(
            message.filename, message.size_bytes, message.part_count, len(under_way), accepts
        )
        if sentence is None:
            begin(client_id, message)
        else:
            refuse(message.source_component_uuid, message.transfer_uuid, sentence)

    def continued(client_id: Any, message: _messages.FileTransferPart) -> None:
        state = under_way.get(message.transfer_uuid)
        button: Any = gui._gui_input_handle_from_uuid.get(message.source_component_uuid or "")
        if state is None or not isinstance(button, viser.GuiUploadButtonHandle):
            return  # The upload was refused or never begun.
        left = state["total_bytes"] - state["transferred_bytes"] - len(message.content)
        if left < 0 or (left and len(state["parts"]) + 1 == state["part_count"]):
            refuse(
                message.source_component_uuid,
                message.transfer_uuid,
                "A file was not as long as announced.",
            )
        else:
            more(client_id, message)

    connection.unregister_handler(_messages.FileTransferStartUpload, begin)
    connection.register_handler(_messages.FileTransferStartUpload, started)
    connection.unregister_handler(_messages.FileTransferPart, more)
    connection.register_handler(_messages.FileTransferPart, continued)


def guard_values(client: viser.ClientHandle, tell: Callable[[str], None]) -> None:
    """Let widgets take only values that they can hold; `tell` is called with the sentence when one is refused.

    viser assigns whatever comes, and calls the callbacks with it.
    """
    gui, connection = client.gui, client._websock_connection
    assign = gui._handle_gui_updates

    async def checked(client_id: Any, message: _messages.GuiUpdateMessage) -> None:
        handle: Any = gui._gui_input_handle_from_uuid.get(message.uuid)
        if handle is None:
            return
        props = handle._impl.props
        # viser queues the value for other pages; there are none, but each value wakes the thread that sends.
        handle._impl.sync_cb = None
        try:
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

    callbacks = _Callbacks(gui._thread_executor)
    for part in (gui, client.scene):
        setattr(part, "_thread_executor", callbacks)  # noqa: B010 - not of its type
    connection.unregister_handler(_messages.GuiUpdateMessage, assign)
    connection.register_handler(_messages.GuiUpdateMessage, checked)


Callback = Callable[[viser.GuiEvent[Any]], None]


def on_event_loop(callback: Callback) -> Callback:
    """A callback that takes no time and waits for nothing: it is called on the event loop.

    Another thread would cost more than it does, and have to wait for its turn of the interpreter.
    """
    setattr(callback, "quick", True)  # noqa: B010 - functions have no such attribute
    return callback


class _Callbacks:
    """viser's threads for callbacks; quick ones are called at once."""

    def __init__(self, threads: ThreadPoolExecutor) -> None:
        self._threads = threads
        self.under_way: set[Future[Any]] = set()

    def submit(self, callback: Callable[..., Any], *arguments: Any) -> Future[Any]:
        if not getattr(callback, "quick", False):
            begun = self._threads.submit(callback, *arguments)
            self.under_way.add(begun)
            begun.add_done_callback(self.under_way.discard)
            return begun
        done: Future[Any] = Future()
        try:
            done.set_result(callback(*arguments))
        except Exception as error:
            done.set_exception(error)
        return done


def wait_for_callbacks(client: viser.ClientHandle) -> None:
    """Wait until the callbacks of all that has come from a page with `guard_values` have ended."""
    threads = client.gui._thread_executor
    assert isinstance(threads, _Callbacks)
    wait(tuple(threads.under_way))


def set_png(handle: viser.ImageHandle, png: bytes) -> None:
    """Assign an encoded PNG: the public setter would encode again, in true colour, for ten times the time.

    As an array, which viser sends as it is; bytes it would compress once more.
    """
    handle._data = np.frombuffer(png, dtype=np.uint8)  # pyright: ignore[reportAttributeAccessIssue]


def set_pose(handle: viser.SceneNodeHandle, wxyz: Array, position: Array | None = None) -> None:
    """Turn and move a node within its parent, where that changes anything: the public setters take ten times as long
    to see that."""
    node = handle._impl
    if (node.wxyz != wxyz).any():
        node.wxyz[:] = wxyz
        node.api._queue_scene_message(
            _messages.SetOrientationMessage(node.name, tuple(wxyz.tolist()))
        )
    if position is not None and (node.position != position).any():
        node.position[:] = position
        node.api._queue_scene_message(
            _messages.SetPositionMessage(node.name, tuple(position.tolist()))
        )


def aim(camera: viser.CameraHandle, position: Array, look_at: Array) -> None:
    """Move a camera and turn it to a point, where that changes anything: the public setters take eight times as long,
    and each of them checks the camera's axes."""
    state = camera._state
    if (state.position != position).any() or (state.look_at != look_at).any():
        state.position, state.look_at = position.copy(), look_at.copy()
        queue = state.client._websock_connection.queue_message
        queue(_messages.SetCameraPositionMessage(tuple(position.tolist())))
        queue(_messages.SetCameraLookAtMessage(tuple(look_at.tolist())))


def widget_id(handle: viser.GuiInputHandle[Any]) -> str:
    """The name by which a page's messages mean this widget."""
    return handle._impl.uuid


def run_in_page(client: viser.ClientHandle, script: str) -> None:
    """Run a line of JavaScript in the page of one client."""
    client._websock_connection.queue_message(_messages.RunJavascriptMessage(script))


@contextlib.contextmanager
def in_one_piece(client: viser.ClientHandle) -> Iterator[None]:
    """Send everything queued in the block as one piece, so that the page is laid out once. Otherwise it comes in pieces
    of 128 messages, and the layout jumps at each. Nothing in the block may wait for an answer of the page."""
    client._websock_connection.get_message_buffer().max_window_size = _ONE_PIECE
    with client.atomic():
        yield
