"""What a page may put into its widgets, and links and files of any kind: a value or a sentence, never silence."""

import math
import threading
import urllib.error
import urllib.request
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest
from viser import UploadedFile
from viser.infra import Message

from explorer.app import App
from explorer.hosting.messages import LONGEST_TEXT, accepted_value
from explorer.hosting.viser_compat import _Callbacks, on_event_loop
from explorer.model.inputs import ViewState
from explorer.sharing.share import Address, view_from
from tests.tools.visitor import arrived, ran

DIGITS = "9" * 400


@pytest.mark.parametrize(
    ("value", "current", "limits"),
    [
        (math.nan, 1.0, {}), (True, 1.0, {}), ({}, 1, {}), (int(DIGITS), 1.0, {}),
        ("c", "a", {"choices": ("a", "b")}), ("x", True, {}), ([1, 2], UploadedFile("", b""), {}),
        (1.0, (1.0, 2.0), {}), ("x" * (LONGEST_TEXT + 1), "a", {}), ((1.0, math.nan), (1.0, 2.0), {}),
    ],
)  # fmt: skip
def test_a_value_that_a_widget_cannot_hold_is_refused(
    value: Any, current: Any, limits: dict[str, Any]
):
    with pytest.raises(ValueError, match="cannot hold") as refusal:
        accepted_value(value, current, **limits)
    assert len(str(refusal.value)) < 150


def test_values_that_a_widget_can_hold_pass():
    assert accepted_value(2, 1.0, low=0.0, high=5.0) == 2
    assert accepted_value(9.0, 1.0, low=0.0, high=5.0) == 5.0
    assert accepted_value("b", "a", choices=("a", "b")) == "b"
    assert accepted_value(True, False) is True
    assert accepted_value([1, 2.5], (0.0, 0.0)) == [1, 2.5]


def test_any_failure_of_a_reader_leaves_the_page_standing():
    def fail(code: str) -> ViewState:
        raise ZeroDivisionError(code)

    address = Address("?v=1", lambda query: None)
    assert address.read("v", fail, ViewState(), "No") == ViewState()
    assert len(address.problems) == 1
    with pytest.raises(ValueError, match="version"):
        view_from("q" * 7000)


@pytest.mark.parametrize("length", [7_000, 20_000])
def test_a_long_address_opens_the_page(app: App, length: int):
    with urllib.request.urlopen(f"{app.address}/?d=1;{'x' * length}", timeout=60) as answer:
        assert answer.status == 200


def test_an_address_beyond_every_limit_gets_a_sentence(app: App):
    with pytest.raises(urllib.error.HTTPError, match="414") as refusal:
        urllib.request.urlopen(f"{app.address}/?d=1;{'x' * 200_000}", timeout=60)
    with refusal.value as answer:
        assert "shorter link" in answer.read().decode()


@pytest.mark.parametrize(
    "path",
    ["x" * 7000, "x/" * 3000, "%00", "a" * 300, "..%2f..%2fetc/passwd"],
    ids=lambda path: path[:8],
)
def test_a_path_that_no_file_can_have_is_not_found(app: App, path: str):
    with pytest.raises(urllib.error.HTTPError, match="404") as refusal:
        urllib.request.urlopen(f"{app.address}/{path}", timeout=60)
    refusal.value.close()


def test_a_value_is_not_sent_back_to_the_page_it_came_from(app: App):
    async def drag() -> list[Any]:
        visitor = await arrived(app.address)
        (session,) = app.sessions
        buffer, queued = (
            session.page.context.client._websock_connection.get_message_buffer(),
            list[Any](),
        )
        push = buffer.push

        def watched(message: Message) -> None:
            queued.append(message)
            push(message)

        buffer.push = watched
        slider, power = visitor.find("Δ inboard [°/R]"), visitor.text("total-power")
        await visitor.move("Δ inboard [°/R]", visitor.widgets[slider]["value"] - 2.0)
        await visitor.until(lambda: visitor.text("total-power") != power)
        await visitor.close()
        return [one for one in queued if getattr(one, "uuid", None) == slider]

    assert ran(drag) == []


def test_only_quick_callbacks_are_called_at_once():
    def here() -> Any:
        return threading.get_ident()

    def fail() -> None:
        raise ZeroDivisionError

    with ThreadPoolExecutor(1) as threads:
        callbacks = _Callbacks(threads)
        assert callbacks.submit(here).result() != threading.get_ident()
        assert callbacks.submit(on_event_loop(lambda *_: here())).result() == threading.get_ident()
        assert isinstance(
            callbacks.submit(on_event_loop(lambda *_: fail())).exception(), ZeroDivisionError
        )
