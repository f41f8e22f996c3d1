"""Commands and keys: none twice, none that camera, palette or browser need, all of them listed."""

import threading
import typing
from collections import Counter
from contextlib import suppress
from types import SimpleNamespace
from typing import Any

import pytest
import viser
from fake_bridge import Bridge
from viser import _messages

from explorer.widgets.layout import KEYS, Keyboard, keys_help

SHIFT, CTRL, CTRL_SHIFT = "shift", "cmd/ctrl", "cmd/ctrl+shift"
TAKEN_BY_THE_CAMERA = set("WASDQE")
TAKEN_BY_BROWSERS = (
    {(key, CTRL) for key in "CVXANTWRLDFPSQ"}
    | {(key, CTRL_SHIFT) for key in "NTWPIJCR"}
    | {("K", CTRL)}
)


def test_each_key_is_one_of_the_page_free_and_does_one_thing():
    keys = Counter((key.key, key.modifier) for key in KEYS.values() if key.key)
    assert keys.most_common(1)[0][1] == 1
    assert not [key for key in keys if key[0] in TAKEN_BY_THE_CAMERA and key[1] in ("", SHIFT)]
    assert not set(keys) & TAKEN_BY_BROWSERS
    known = {*typing.get_args(_messages.HotkeyKey), "?"}
    assert {key.key for key in KEYS.values()} - {""} <= known
    assert {key.modifier for key in KEYS.values()} - {""} <= set(
        typing.get_args(_messages.KeyModifier)
    )


def test_the_list_shows_what_is_bound_and_nothing_else():
    text = keys_help(["undo", "play", "keys"])
    assert "<kbd>Ctrl</kbd><kbd>Z</kbd>" in text
    assert "<kbd>Space</kbd>" in text
    assert "<kbd>?</kbd>" in text
    assert "Redo" not in text
    assert "Find a command" in text


BRIDGE: Any = Bridge()


class TestKeyboard:
    @pytest.fixture
    def client(self, server: viser.ViserServer) -> Any:
        """As much of a client as the keyboard touches."""
        return SimpleNamespace(gui=server.gui, _websock_connection=server._websock_server)

    def test_two_keys_at_once_act_one_after_the_other(self, client: Any):
        """Each action reads the inputs and writes them changed: between the two no other may write."""
        keyboard, inputs = Keyboard(client, BRIDGE), [0]
        met = threading.Barrier(2)

        def more() -> None:
            before = inputs[0]
            with suppress(threading.BrokenBarrierError):
                met.wait(0.2)  # Where both are here at once, both have read the same.
            inputs[0] = before + 1

        for name in ("undo", "redo"):
            keyboard.bind(name, more)
        commands = [
            c for c in client.gui._command_handle_from_uuid.values() if c.label in ("Undo", "Redo")
        ]
        assert [(c.hotkey, c.modifier) for c in commands] == [("Z", CTRL), ("Z", CTRL_SHIFT)]
        threads = [threading.Thread(target=c._impl.trigger_cb[0], args=(None,)) for c in commands]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert inputs == [2]

    def test_an_unknown_name_or_a_second_action_is_refused(self, client: Any):
        keyboard = Keyboard(client, BRIDGE)
        with pytest.raises(KeyError, match="jump"):
            keyboard.bind("jump", lambda: None)
        with pytest.raises(ValueError, match="'keys' has its action already"):
            keyboard.bind("keys", lambda: None)
