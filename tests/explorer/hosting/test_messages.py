"""What a page says: each name is known, and each value finite, in range and short, or it is dropped with a line."""

import asyncio
import dataclasses
import json
import logging
import math
import random
import re
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any, cast, get_args

import msgspec
import pytest
from msgspec import inspect
from viser import _messages

from explorer.app import App
from explorer.hosting.messages import (
    LONGEST_TEXT,
    PageFacts,
    Sent,
    checked_press,
    message_fault,
    read_facts,
)
from explorer.parts.presses import PRESSES
from explorer.session import Session
from tests.tools import wire
from tests.tools.visitor import _CAMERA, BRIDGE, Visitor, arrived, ran

GOOD: dict[str, list[Any]] = {
    "azimuth": [65, 0.5], "fly": [1.25], "slide": [["mass_t", 8.5]], "hold": [True], "stop": [3, "3"], "guess": ["0"],
    "drawer": ["", "share"],
    "knot": [["1", "start"], ["1", [None, 3.5]], ["0", [0.4, -2.0]], ["2", "end"], ["2", "undo"]],
    "idle": [[7, False]], "dial": ["start", [[3, 1.5, 270], [2, 0.4, 60]]], "covered": [[0.1, 0.2, 0.3, 0.0]],
    "undo": [None, 5], "view": ["disk"], "suppose": ["on", "off", [0.0, 0.001], [3.2, 9.1]],
}  # fmt: skip
HOSTILE: list[Any] = [
    math.nan, math.inf, -math.inf, 1e308, -1e300, 10**400, "", "x" * 200, "NaN", "１", "nowhere", None, True, [], {},
    ["1", [None, math.nan]], ["1", [math.inf, 0.0]], [math.nan, "start"], [3, [math.nan, 0.0]], [1e9, [1.0, 1.0]],
    [[]], [3, []], [math.nan, math.nan], {"a": 1}, -1, 1e6, "\ud800", [1, True, 2], "-1",
]  # fmt: skip
FLOATS = [(name, value) for name, value in _CAMERA.items() if not isinstance(value, int)]


def press(name: Any, value: Any, serial: Any = 1) -> str:
    return json.dumps([serial, name, value])


@pytest.mark.parametrize("name", GOOD)
def test_what_the_page_sends_passes(name: str):
    for value in GOOD[name]:
        checked = checked_press(press(name, value))
        assert checked[0] == name


@pytest.mark.parametrize("name", PRESSES)
def test_no_number_that_is_not_finite_passes(name: str):
    def numbers(value: Any) -> list[float]:
        if isinstance(value, msgspec.Struct):
            value = msgspec.structs.astuple(value)
        if isinstance(value, (list, tuple)):
            return [number for part in value for number in numbers(part)]
        return [value] if isinstance(value, (int, float)) else []

    for value in HOSTILE:
        checked = checked_press(press(name, value))
        assert checked is None or all(abs(number) < 1e6 for number in numbers(checked[1]))
        assert checked is None or len(str(checked[1])) <= 100


@pytest.mark.parametrize(
    ("text", "said"),
    [
        *(
            (text, "")
            for text in (
                "",
                "[",
                "1",
                "[1, 2]",
                "[" * 200,
                press("x" * 400, 1),
                press("undo", None, math.nan),
                5,
            )
        ),
        (press("azimuth", 1e9), "Expected `float` <= 3600.0"),
        (
            press("view", "nowhere"),
            "Invalid enum value 'nowhere', expected one of actuator, 3d, disk, blade, top, side",
        ),
        (press("covered", [0.1]), "Expected `array` of at least length 4"),
        (press("covered", [0.1, 0.2, 0.3, 0.0, 0.0]), "Expected `array` of at most length 4"),
        (press("nowhere", 1), "no such press"),
        (press("field", "x" * 200), "length <= 100"),
        (press("azimuth", "x" * 400), "at most 300 characters"),
    ],
)
def test_what_is_no_press_is_dropped_with_one_line_that_says_what_is_allowed(
    text: Any, said: str, caplog: pytest.LogCaptureFixture
):
    with caplog.at_level(logging.WARNING):
        assert checked_press(text) is None
    (record,) = caplog.records
    assert record.exc_info is None
    assert len(record.getMessage()) < 400
    assert said in record.getMessage()
    assert not said or text[:20] in record.getMessage()


TRANSFER = {"source_component_uuid": "a", "transfer_uuid": "t"}
UPLOAD = {**TRANSFER, "filename": "a.json", "mime_type": "", "part_count": 1, "size_bytes": 9}
PART = {**TRANSFER, "part_index": 0, "content": b"x" * 10**6}
DRAG = {
    "phase": "start", "name": "/rotor/blade_0", "instance_index": None, "start_position": [0, 1.5, 2],
    "start_screen_pos": [0.1, 0.2], "end_position": [0.0, 1.5, 2.0], "end_screen_pos": [0.1, 0.2], "button": "left",
    "modifier": "shift", "owner": "",
}  # fmt: skip
CLICK = {
    "event_type": "click",
    "ray_origin": [0.0, 1.0, 2.0],
    "ray_direction": [0, 0, 1],
    "screen_pos": [[0.5, 0.5]],
    "modifier": None,
}
STORED = {"value": "x" * 10**6, "error": None, "request_uuid": "r"}


def edit(value: Any, uuid: Any = "a") -> dict[str, Any]:
    return {"uuid": uuid, "updates": {"value": value}}


@pytest.mark.parametrize(
    ("kind", "fields"),
    [
        ("ViewerCameraMessage", _CAMERA),
        *(("GuiUpdateMessage", edit(value)) for value in (True, 3, -0.5, "text", [1, 2.5], None)),
        ("CommandTriggerMessage", {"uuid": "a"}),
        ("FileTransferStartUpload", UPLOAD),
        ("FileTransferPart", PART),
        ("SceneNodeDragMessage", DRAG),
        ("ScenePointerMessage", CLICK),
        ("GetRenderResponseMessage", {"payload": b"x" * 10**6, "render_uuid": "r"}),
        ("LocalStorageGetItemResponseMessage", STORED),
    ],
)
def test_what_the_client_sends_passes(kind: str, fields: dict[str, Any]):
    assert message_fault(wire.encode(kind, **fields)) == ""


@pytest.mark.parametrize(
    ("kind", "fields", "field", "said"),
    [
        ("GuiUpdateMessage", edit(1.0, [1]), "uuid is [1]", "Expected `str`"),
        (
            "FileTransferStartUpload",
            {**UPLOAD, "source_component_uuid": [1]},
            "source_component_uuid is [1]",
            "`str`",
        ),
        ("ViewerCameraMessage", {**_CAMERA, "position": ()}, "position is []", "length 3"),
        (
            "ViewerCameraMessage",
            {**_CAMERA, "wxyz": (1.0, 0.0, 0.0, math.nan)},
            "wxyz is [1.0, 0.0, 0.0, nan]",
            "[3]",
        ),
        (
            "ViewerCameraMessage",
            {**_CAMERA, "image_width": -1},
            "image_width is -1",
            "Expected `int` >= 1",
        ),
        (
            "GuiUpdateMessage",
            edit([math.nan]),
            "updates is {'value': [nan]}",
            "at updates.value[0]",
        ),
        (
            "GuiUpdateMessage",
            edit("x" * (LONGEST_TEXT + 1)),
            "updates is 20011 bytes",
            "length <= 20000",
        ),
        ("GuiUpdateMessage", edit([0.0] * 20_000), "bytes", "length <= 1000"),
        (
            "GuiUpdateMessage",
            edit([[[[[[[1]]]]]]]),
            "[[[[[[[1]]]]]]]",
            "Expected `float`, got `array`",
        ),
        (
            "GuiUpdateMessage",
            {"uuid": "a", "updates": {"max": 1.0}},
            "{'max': 1.0}",
            "unknown field `max`",
        ),
        ("GuiUpdateMessage", edit(1.0, "x" * 1000), "uuid is 1003 bytes", "length <= 300"),
        (
            "FileTransferPart",
            {**PART, "content": "text"},
            "content is 'text'",
            "Expected `bytes`, got `str`",
        ),
        ("ScenePointerMessage", {**CLICK, "screen_pos": []}, "screen_pos is []", "length >= 1"),
        # Each value fits, and they do not fit together.
        (
            "ScenePointerMessage",
            {**CLICK, "event_type": "rect-select"},
            "'rect-select'",
            "expected one of click",
        ),
        (
            "ScenePointerMessage",
            {**CLICK, "ray_origin": None},
            "ray_origin is None",
            "Expected `array`",
        ),
        (
            "ScenePointerMessage",
            {**CLICK, "ray_direction": [0, 0, 0]},
            "ray_direction",
            "unit vector",
        ),
        ("ViewerCameraMessage", {**_CAMERA, "image_height": 0}, "image_height is 0", ">= 1"),
        (
            "ViewerCameraMessage",
            {**_CAMERA, "image_height": 10**14},
            f"image_height is {10**14}",
            "<= 32768",
        ),
        (
            "ViewerCameraMessage",
            {**_CAMERA, "image_width": 1},
            "a canvas of 1 × 940",
            "ratio of 32",
        ),
        ("FileTransferStartUpload", {**UPLOAD, "part_count": 0}, "9 bytes in 0 parts", "parts"),
    ],
)
def test_what_no_client_of_ours_sends_is_named(
    kind: str, fields: dict[str, Any], field: str, said: str
):
    sentence = message_fault(wire.encode(kind, **fields))
    assert sentence.startswith(f"{kind}: ")
    assert field in sentence
    assert said in sentence
    assert len(sentence) < 350


@pytest.mark.parametrize(
    "message",
    [
        b"",
        b"\xff\xff",
        wire.encode("NoSuch"),
        wire.encode("GuiUpdateMessage", colour=1),
        b"\x91" * 100_000,
        wire.encode("GuiUpdateMessage", uuid="a"),
        wire.encode("ViewerCameraMessage", **_CAMERA, more=1),
    ],
)
def test_what_is_no_message_of_the_page_is_an_error(message: bytes):
    with pytest.raises(ValueError, match=r"\w"):
        message_fault(message)


def test_the_messages_are_those_of_viser():
    """Fields and defaults; and no handler of its server is for a message that is neither read nor known not to come."""
    kinds = {kind.__name__: kind for kind in get_args(Sent)}
    for name, kind in kinds.items():
        theirs = dataclasses.fields(getattr(_messages, name))
        assert kind.__struct_fields__ == tuple(field.name for field in theirs)
        assert len(kind.__struct_defaults__) == sum(
            field.default is not dataclasses.MISSING for field in theirs
        )
    package = Path(_messages.__file__).parent
    handled = "".join(
        (package / f"{file}.py").read_text("utf-8") for file in ("_gui_api", "_scene_api", "_viser")
    )
    named = set(re.findall(r"register_(?:owner_scoped_)?handler\(\s*_messages\.(\w+)", handled))
    # Of held buttons, forms, handles and nodes to be clicked our page has none; its share button is hidden.
    never = re.compile(r"Gui(ButtonHold|Form)|SceneNodeClick|TransformControls|ShareUrl")
    assert [name for name in named - kinds.keys() if not never.match(name)] == []


@pytest.mark.parametrize(
    "text", ["", "[1]", "{", '{"query": 5}', '{"kept": {"d": 1}}', '{"scene": "painted"}']
)
def test_facts_that_no_page_of_ours_tells_are_none(text: str, caplog: pytest.LogCaptureFixture):
    with caplog.at_level(logging.WARNING):
        assert read_facts(text) == PageFacts(query=None)
    assert [record.exc_info for record in caplog.records] == [None]


def test_facts_of_a_page_are_read():
    told = {"dark": True, "query": "?d=1;linear:-8", "kept": {"d": "{}"}, "scene": "lost"}
    assert read_facts(json.dumps(told)) == PageFacts(True, "?d=1;linear:-8", {"d": "{}"}, "lost")
    assert read_facts("{}") == PageFacts()


def fitting(kind: inspect.Type, names: list[str], chance: random.Random) -> Any:
    """A value that fits by itself: nought, empty, at an end of its range, or a name that means something else."""
    match kind:
        case inspect.UnionType(types=types):
            return fitting(chance.choice(types), names, chance)
        case inspect.StructType(fields=fields):
            return {field.encode_name: fitting(field.type, names, chance) for field in fields}
        case inspect.TupleType(item_types=items):
            return [fitting(item, names, chance) for item in items]
        case inspect.ListType(item_type=item, min_length=least):
            return [fitting(item, names, chance) for _ in range(least or 0)]
        case inspect.LiteralType(values=values):
            return chance.choice(values)
        case inspect.IntType(ge=low, le=high):
            return chance.choice([low or 0, 1, high or 10**14])
        case inspect.FloatType():
            return chance.choice([0.0, 1.0, 1e-300, -1e14, 1e14])
        case inspect.StrType():
            return chance.choice(names)
        case inspect.MemoryViewType():
            return chance.choice([b"", b"x"])
        case _:
            return None


def test_thousands_of_hostile_messages_leave_the_page_as_it_was(caplog: pytest.LogCaptureFixture):
    """2,500 such presses once gave a thousand tracebacks, and NaN as the azimuth ended the page for good."""
    app, chance = App("127.0.0.1", 0), random.Random(54)
    names = sorted(PRESSES.keys() - {"dial_bend"})  # Blades that bend, whatever is sent with it.

    async def visit() -> tuple[str, str]:
        visitor = await arrived(app.address)
        power = visitor.text("total-power")
        # These once gave tracebacks: values that fit one by one, and a file for a menu, whose value it became.
        await visitor.press("pull", 0.3)
        for wrong in (
            {"event_type": "rect-select"},
            {"ray_origin": None},
            {"ray_direction": (0, 0, 0)},
        ):
            await visitor.send("ScenePointerMessage", **{**CLICK, **wrong})
        for size in (0, 10**14):
            await visitor.send("ViewerCameraMessage", **{**_CAMERA, "image_height": size})
        menu = next(uuid for uuid, widget in visitor.widgets.items() if widget.get("options"))
        await visitor.send("FileTransferStartUpload", **{**UPLOAD, "source_component_uuid": menu})
        await visitor.send(
            "FileTransferPart", **{**PART, "source_component_uuid": menu, "content": b"x" * 9}
        )
        await visitor.send("GuiUpdateMessage", **edit(1.0, [1]))
        await visitor.send("FileTransferStartUpload", **{**UPLOAD, "source_component_uuid": [1]})
        await visitor.send("ViewerCameraMessage", **{**_CAMERA, "position": ()})
        uuid = next(
            uuid for uuid, widget in visitor.widgets.items() if widget.get("label") == BRIDGE
        )
        for k in range(1200):  # In all less than a page may send at once.
            name, value = chance.choice([*names, "constructor", 7]), chance.choice(HOSTILE)
            await visitor.send(
                "GuiUpdateMessage", uuid=uuid, updates={"value": press(name, value, k)}
            )
            # Fields that fit one by one, seldom together. No blade and no command: those would act.
            if k % 4 == 0:
                kind, ids = chance.choice(get_args(Sent)), list(visitor.widgets)
                if kind.__name__ not in ("GuiUpdateMessage", "CommandTriggerMessage"):
                    fields = fitting(
                        inspect.type_info(kind), ["", "a.json", "/rotor/nowhere", *ids], chance
                    )
                    await visitor.send(kind.__name__, **fields)
            if k % 10 == 0:
                field, bad = chance.choice(FLOATS), chance.choice([math.nan, math.inf])
                value = [bad] * len(field[1]) if isinstance(field[1], tuple) else bad
                await visitor.send("ViewerCameraMessage", **{**_CAMERA, field[0]: value})
        await visitor.idle()
        await visitor.send(
            "GuiUpdateMessage", uuid=uuid, updates={"value": press("azimuth", 65.0, 9999)}
        )
        await visitor.until(lambda: visitor.frame["turn"]["psi"] == 65.0)
        await visitor.close()
        return power, visitor.text("total-power")

    try:
        with caplog.at_level(logging.WARNING):
            before, after = ran(visit)
    finally:
        app.stop()
    assert before == after
    assert not [record for record in caplog.records if record.exc_info]
    kinds = [record.getMessage().split(": ")[1] for record in caplog.records[:8]]
    wrong = ["GuiUpdateMessage", "FileTransferStartUpload", "ViewerCameraMessage"]
    assert kinds == [*["ScenePointerMessage"] * 3, *["ViewerCameraMessage"] * 2, *wrong]


def test_a_visitor_that_cannot_read_a_message_ends_the_wait():
    """It waited for its whole patience."""

    async def visit() -> None:
        async def frames() -> AsyncIterator[bytes]:
            yield wire.encode("GuiUpdateMessage")

        visitor = Visitor()
        visitor._reading = asyncio.create_task(visitor._read(cast("Any", frames())))
        with pytest.raises(ConnectionError, match="could not be read"):
            await visitor.until(lambda: False, 20.0)
        with pytest.raises(Exception, match=r"\w"):
            await visitor.close()

    ran(visit)


def test_a_session_that_cannot_be_made_says_so(
    caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
):
    """It was once told as a server that is busy."""

    def fail(session: Session, *_: Any) -> None:
        raise ZeroDivisionError("made to fail")

    monkeypatch.setattr(Session, "__init__", fail)
    app = App("127.0.0.1", 0)

    async def visit() -> str:
        visitor = Visitor()
        await visitor.open(app.address)
        await visitor.until(
            lambda: any("rx-lobby" in str(one.get("content")) for one in visitor.widgets.values())
        )
        await visitor.close()
        return " ".join(str(one.get("content")) for one in visitor.widgets.values())

    try:
        said = ran(visit)
    finally:
        app.stop()
    assert "ZeroDivisionError" in said
    assert "could not make this page" in said
    assert sum(record.exc_info is not None for record in caplog.records) == 1
