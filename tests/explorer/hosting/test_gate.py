"""What a page says: each name is known, and each value finite, in range and short, or it is dropped with a line."""

import json
import logging
import math
import random
import re
from typing import Any

import pytest

from explorer import web
from explorer.app import App
from explorer.hosting.gate import LONGEST_TEXT, PRESSES, checked_press, message_fault
from explorer.session import Session
from tests.tools.visitor import _CAMERA, BRIDGE, Visitor, ran

SCRIPTS = (
    "frame",
    "cards",
    "charts",
    "plan",
    "rubber",
    "flight",
    "dial",
    "landscape",
    "lecture",
    "story",
    "keys",
    "inset",
)
GOOD: dict[str, list[Any]] = {
    "azimuth": [65, 0.5], "fly": [1.25], "speed": [0.2, "0.165"], "hold": [True],
    "stop": [3, "3"], "guess": ["0"], "drawer": ["", "share"],
    "knot": [["1", "start"], ["1", [None, 3.5]], ["0", [0.4, -2.0]], ["2", "end"], ["2", "undo"]], "idle": [[7, False]],
    "dial": ["start", [[3, 1.5, 270], [2, 0.4, 60]]], "covered": [[0.1, 0.2]], "undo": [None, 5], "view": ["disk"],
    "suppose": ["on", "off", [0.0, 0.001], [3.2, 9.1]],
}  # fmt: skip
HOSTILE: list[Any] = [
    math.nan, math.inf, -math.inf, 1e308, -1e300, 10**400, "", "x" * 200, "NaN", "１", "nowhere", None, True, [], {},
    ["1", [None, math.nan]], ["1", [math.inf, 0.0]], [math.nan, "start"], [3, [math.nan, 0.0]], [1e9, [1.0, 1.0]],
    [[]], [3, []],
    [math.nan, math.nan], {"a": 1}, -1, 1e6, "\ud800", [1, True, 2], "-1",
]  # fmt: skip
FLOATS = [(name, value) for name, value in _CAMERA.items() if not isinstance(value, int)]


def press(name: Any, value: Any, serial: Any = 1) -> str:
    return json.dumps([serial, name, value])


def test_every_press_of_the_scripts_is_listed():
    text = "".join(web.text(f"{name}.js") for name in SCRIPTS) + web.text("frame.html") + web.text("column.html")
    names = set(re.findall(r"RX\.send\('(\w+)'", text)) | set(re.findall(r'data-do="(\w+)"', text))
    assert names <= PRESSES.keys()
    assert len(names) > 25


@pytest.mark.parametrize("name", GOOD)
def test_what_the_page_sends_passes(name: str):
    for value in GOOD[name]:
        checked = checked_press(press(name, value))
        assert checked is not None
        assert checked[0] == name


@pytest.mark.parametrize("name", PRESSES)
def test_no_number_that_is_not_finite_passes(name: str):
    def numbers(value: Any) -> list[float]:
        if isinstance(value, list):
            return [number for part in value for number in numbers(part)]
        return [value] if isinstance(value, (int, float)) else []

    for value in HOSTILE:
        checked = checked_press(press(name, value))
        assert checked is None or all(abs(number) < 1e6 for number in numbers(checked[1]))
        assert checked is None or len(str(checked[1])) <= 100


@pytest.mark.parametrize(
    "text", ["", "[", "1", "[1, 2]", "[" * 200, press("x" * 400, 1), press("undo", None, math.nan), 5]
)
def test_what_is_no_press_is_dropped_with_one_line(text: Any, caplog: pytest.LogCaptureFixture):
    with caplog.at_level(logging.WARNING):
        assert checked_press(text) is None
    (record,) = caplog.records
    assert record.exc_info is None
    assert len(record.getMessage()) < 400


@pytest.mark.parametrize(
    "fields",
    [
        {"wxyz": (1.0, 0.0, 0.0, math.nan)}, {"fov": math.inf}, {"updates": {"value": [math.nan]}},
        {"name": "x" * (LONGEST_TEXT + 1)},
        {"a": [[[[[[[1]]]]]]]}, {"a": list(range(20_000))}, {"a": 10**400}, {"a": object()},
    ],
)  # fmt: skip
def test_messages_of_viser_are_looked_at(fields: dict[str, Any]):
    assert message_fault(fields)
    assert not message_fault(_CAMERA)
    assert not message_fault({"content": b"x" * 10**6, "updates": {"value": "text"}})


def test_thousands_of_hostile_messages_leave_the_page_as_it_was(caplog: pytest.LogCaptureFixture):
    """2,500 such presses once gave a thousand tracebacks, and NaN as the azimuth ended the page for good."""
    app, chance = App("127.0.0.1", 0), random.Random(54)
    names = sorted(PRESSES.keys() - {"dial_bend"})  # Blades that bend, whatever is sent with it.

    async def visit() -> tuple[str, str]:
        visitor = Visitor()
        await visitor.open(app.address)
        await visitor.until(lambda: visitor.text("status") == "converged")
        power = visitor.text("total-power")
        uuid = next(uuid for uuid, widget in visitor.widgets.items() if widget.get("label") == BRIDGE)
        for k in range(1500):
            name, value = chance.choice([*names, "constructor", 7]), chance.choice(HOSTILE)
            await visitor.send("GuiUpdateMessage", uuid=uuid, updates={"value": press(name, value, k)})
            if k % 10 == 0:
                field, bad = chance.choice(FLOATS), chance.choice([math.nan, math.inf])
                value = [bad] * len(field[1]) if isinstance(field[1], tuple) else bad
                await visitor.send("ViewerCameraMessage", **{**_CAMERA, field[0]: value})
        await visitor.idle()
        await visitor.send("GuiUpdateMessage", uuid=uuid, updates={"value": press("azimuth", 65.0, 9999)})
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


def test_a_session_that_cannot_be_made_says_so(caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch):
    """It was once told as a server that is busy."""

    def fail(session: Session, *_: Any) -> None:
        raise ZeroDivisionError("made to fail")

    monkeypatch.setattr(Session, "__init__", fail)
    app = App("127.0.0.1", 0)

    async def visit() -> str:
        visitor = Visitor()
        await visitor.open(app.address)
        await visitor.until(lambda: any("rx-lobby" in str(one.get("content")) for one in visitor.widgets.values()))
        await visitor.close()
        return " ".join(str(one.get("content")) for one in visitor.widgets.values())

    try:
        said = ran(visit)
    finally:
        app.stop()
    assert "ZeroDivisionError" in said
    assert "not a busy server" in said
    assert sum(record.exc_info is not None for record in caplog.records) == 1


def test_an_update_after_one_that_failed_begins_clean(monkeypatch: pytest.MonkeyPatch):
    app = App("127.0.0.1", 0)
    began: list[object] = []

    async def visit() -> tuple[str, str]:
        visitor = Visitor()
        await visitor.open(app.address)
        await visitor.until(lambda: visitor.text("status") == "converged")
        await visitor.idle()
        power, (session,) = visitor.text("total-power"), app.sessions
        patched: Any = session
        draw, solve = session._draw, session._solve

        def fail(*_: Any, **__: Any) -> None:
            patched._draw = draw
            raise ZeroDivisionError("made to fail")

        def watched(reading: Any) -> Any:
            began.append(session._good)
            return solve(reading)

        patched._draw, patched._solve = fail, watched
        label = "Δ inboard [°/R]"
        await visitor.move(label, -3.0)
        await visitor.until(lambda: "failed" in json.dumps(visitor.frame["power"]))
        await visitor.move(label, 0.0)
        await visitor.until(lambda: visitor.text("status") == "converged" and visitor.text("total-power") == power)
        await visitor.close()
        return power, visitor.text("total-power")

    try:
        before, after = ran(visit)
    finally:
        app.stop()
    assert before == after
    assert began[0] is not None
    assert began[1] is None  # Nothing of the failed update is used.
