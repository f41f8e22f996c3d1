"""What a page may say, with types and bounds: messages of viser's client, presses of our own scripts, what the browser
knows, and values of widgets.

msgspec reads each of them before anything else does. A value that does not fit is dropped, and the log says which field
it is, what it holds and what is allowed. What is no message of the page ends its connection, see `request_filter`.
"""

import logging
import math
import re
from collections.abc import Sequence
from typing import Annotated, Any, Literal, get_args, get_type_hints

import msgspec
from msgspec import Meta, Struct

from explorer.parts.presses import PRESSES, Drawn
from rotor.support.user_input import brief

LONGEST_HEAD = 2**16
"""[bytes] of a request's head."""
LONGEST_TEXT = 20_000
"""Characters of a text field."""
LONGEST_PRESS = 300
"""Characters of a press: name and value as JSON."""
LONGEST_SHOWN = 60
"""Characters of a refused value that its sentence repeats."""
_LOGGED_BYTES = 1000
"""[bytes] of a refused field that the log repeats in part."""
_log = logging.getLogger(__name__)

Number = Annotated[float, Meta(gt=-1e15, lt=1e15)]
"""Neither endless nor NaN."""
Count = Annotated[int, Meta(ge=0, lt=10**15)]
Side = Annotated[int, Meta(ge=1, le=2**15)]
"""[px] of the canvas."""
_LARGEST_ASPECT = 32.0
"""Ratio of the sides of a canvas, at most."""
Name = Annotated[str, Meta(max_length=300)]
Text = Annotated[str, Meta(max_length=LONGEST_TEXT)]
Pixel = tuple[Number, Number]
Point = tuple[Number, Number, Number]
Turn = tuple[Number, Number, Number, Number]
Keys = Literal[
    "cmd/ctrl", "alt", "shift", "cmd/ctrl+alt", "cmd/ctrl+shift", "alt+shift", "cmd/ctrl+alt+shift"
]
WidgetValue = bool | Number | Text | Annotated[list[Number], Meta(max_length=1000)] | None


class _ViserMessage(Struct, tag_field="type", tag=True, forbid_unknown_fields=True):
    """A message of viser's client. Classes and fields have viser's names."""

    def fault(self) -> str:
        """What is wrong with its values together, each of which fits; empty where nothing is."""
        return ""


class ViewerCameraMessage(_ViserMessage):
    wxyz: Turn
    position: Point
    fov: Number
    near: Number
    far: Number
    image_height: Side
    image_width: Side
    look_at: Point
    up_direction: Point

    def fault(self) -> str:
        if 1.0 / _LARGEST_ASPECT <= self.image_width / self.image_height <= _LARGEST_ASPECT:
            return ""
        return f"a canvas of {self.image_width} × {self.image_height}, expected a ratio of {_LARGEST_ASPECT:g}"


class ScenePointerMessage(_ViserMessage):
    event_type: Literal["click"]
    """No part of the page selects rectangles."""
    ray_origin: Point
    ray_direction: Point
    screen_pos: Annotated[list[Pixel], Meta(min_length=1, max_length=1)]
    modifier: Keys | None

    def fault(self) -> str:
        length = math.hypot(*self.ray_direction)
        return (
            ""
            if 0.5 < length < 2.0
            else f"ray_direction is {list(self.ray_direction)}, expected a unit vector"
        )


class SceneNodeDragMessage(_ViserMessage):
    phase: Literal["start", "update", "end"]
    name: Name
    instance_index: Count | None
    start_position: Point
    start_screen_pos: Pixel
    end_position: Point
    end_screen_pos: Pixel
    button: Literal["left", "middle", "right"]
    modifier: Keys | None
    owner: Name = ""


class Updates(Struct, forbid_unknown_fields=True):
    value: WidgetValue


class GuiUpdateMessage(_ViserMessage):
    uuid: Name
    updates: Updates


class CommandTriggerMessage(_ViserMessage):
    uuid: Name


class FileTransferStartUpload(_ViserMessage):
    source_component_uuid: Name
    transfer_uuid: Name
    filename: Text
    mime_type: Name
    part_count: Count
    size_bytes: Count

    def fault(self) -> str:
        fits = bool(self.part_count) == bool(self.size_bytes)
        return "" if fits else f"{self.size_bytes} bytes in {self.part_count} parts"


class FileTransferPart(_ViserMessage):
    source_component_uuid: Name | None
    transfer_uuid: Name
    part_index: Count
    content: memoryview


class GetRenderResponseMessage(_ViserMessage):
    payload: memoryview
    render_uuid: Name


class LocalStorageGetItemResponseMessage(_ViserMessage):
    value: str | None
    error: Text | None
    request_uuid: Name


Sent = (
    ViewerCameraMessage
    | ScenePointerMessage
    | SceneNodeDragMessage
    | GuiUpdateMessage
    | CommandTriggerMessage
    | FileTransferStartUpload
    | FileTransferPart
    | GetRenderResponseMessage
    | LocalStorageGetItemResponseMessage
)
"""Every kind of message that viser's client sends from our page."""
_sent = msgspec.msgpack.Decoder(Sent)


def message_fault(message: bytes) -> str:
    """What is wrong with a value of a message; empty where it fits. ValueError for what is no message of the page: of
    no known kind, or with other fields."""
    try:
        sent = _sent.decode(message)
    except msgspec.ValidationError as error:
        reason, _, place = str(error).removesuffix("`").partition(" - at `$.")
        field = re.match(r"\w*", place)
        if field is None or field[0] in ("", "type"):
            raise
        parts = msgspec.msgpack.decode(message, type=dict[str, msgspec.Raw])
        kind, part = msgspec.msgpack.decode(parts["type"]), parts[field[0]]
        size = len(memoryview(part))
        shown = _shown(msgspec.msgpack.decode(part)) if size <= _LOGGED_BYTES else f"{size} bytes"
        (fields,) = (get_type_hints(one) for one in get_args(Sent) if one.__name__ == kind)
        return f"{kind}: {field[0]} is {shown}: {reason}{_choices(reason, fields[field[0]])} at {place}"
    fault = sent.fault()
    return fault and f"{type(sent).__name__}: {fault}"


class NoDesign(ValueError):
    """What the widgets say is no design; one sentence, which the page shows."""


def log_dropped(what: str) -> None:
    _log.warning("dropped from a page: %s", what)


def _choices(reason: str, kind: Any) -> str:
    """The words of a type, where msgspec refused another word: it does not name them."""
    return f", expected one of {', '.join(_words(kind))}" if "enum value" in reason else ""


def _words(kind: Any) -> list[str]:
    return [
        word
        for part in get_args(kind)
        for word in ([part] if isinstance(part, str) else _words(part))
    ]


def _shown(value: object) -> str:
    return brief(repr(value)[:200])


class Press(Struct, array_like=True, forbid_unknown_fields=True):
    """What a script of the page sends: a number that rises, a name, a value."""

    serial: Number
    name: Name
    value: msgspec.Raw


def checked_press(text: Any) -> tuple[str, Any] | None:
    """Name and value of a press; None, and a line in the log, for what no page of ours sends."""
    kind: Any = None
    try:
        if not isinstance(text, str) or len(text) > LONGEST_PRESS:
            raise ValueError(f"at most {LONGEST_PRESS} characters are allowed")
        press = msgspec.json.decode(text, type=Press)
        if press.name not in PRESSES:
            raise ValueError("there is no such press")
        kind = PRESSES[press.name]
        # A button has its number as text: not strictly.
        return press.name, None if kind is None else msgspec.json.decode(
            press.value, type=kind, strict=False
        )
    except ValueError as error:
        log_dropped(f"press {_shown(text)}: {error}{_choices(str(error), kind)}")
        return None


class PageFacts(Struct, frozen=True):
    """What only the browser knows when a page opens."""

    dark: bool = False
    """Whether it asks for dark pages."""
    query: Annotated[str, Meta(max_length=LONGEST_HEAD)] | None = ""
    """The query of the page's address, from the question mark on; None where the browser did not tell."""
    kept: dict[str, str] = {}
    """Texts that it was given to keep by name: see `browser.store_text`."""
    scene: Drawn = "drawn"
    stores: bool = True
    """Whether the browser stores what the page keeps."""


def read_facts(text: str) -> PageFacts:
    """What the browser answered; without its query, and with a line in the log, where no page of ours says that."""
    try:
        return msgspec.json.decode(text, type=PageFacts)
    except ValueError as error:
        log_dropped(f"facts {_shown(text)}: {error}")
        return PageFacts(query=None)


def accepted_value(
    value: Any, current: Any, *, choices: Sequence[str] = (), low: Any = None, high: Any = None
) -> Any:
    """What a widget takes of a value that its page sent; ValueError with one sentence for what no page of ours sends.

    `current`: its present value, which has the type of every other. A number is brought between `low` and `high`,
    which may have changed while it was on its way.
    """
    kind: Any = None  # An upload button's value is a file, which comes in another way.
    if isinstance(current, bool) or current is None:
        kind = bool
    elif isinstance(current, str):
        kind = Text
    elif isinstance(current, (int, float)):
        kind = Number
    elif isinstance(current, (list, tuple)):
        kind = tuple[(Number,) * len(current)]
    try:
        msgspec.convert(value, kind)
        if kind is None or (choices and value not in choices):
            raise ValueError("not a choice")
    except ValueError:
        shown = brief(repr(value))[:LONGEST_SHOWN]
        raise ValueError(f"A field of this page cannot hold {shown}: it stays as it was.") from None
    if kind is Number and low is not None and high is not None:
        return min(max(value, low), high)
    return value
