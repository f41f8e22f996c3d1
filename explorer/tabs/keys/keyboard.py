"""The keyboard and the command palette of one browser: names of `explorer.tabs.keys.names` to actions."""

from collections.abc import Callable
from typing import Any

import viser

from explorer.hosting import viser_compat
from explorer.tabs.keys.in_page import dialog_script, page_script
from explorer.tabs.keys.names import COARSE, KEYS, keys_help, leads


class Keyboard:
    """Commands as they are bound. Actions run on the pool's threads and must only say what is wanted."""

    def __init__(self, client: viser.ClientHandle) -> None:
        self._client = client
        self._commands: dict[str, viser.CommandHandle] = {}
        self._held = False
        viser_compat.run_in_page(client, page_script(COARSE))
        self.bind("keys", self.show)

    def bind(self, name: str, action: Callable[[], None]) -> None:
        """Give the command `name` of `KEYS` its action; the palette and the list of keys have it from then on.

        KeyError for a name that is none, ValueError for one that has its action already.
        """
        key = KEYS[name]
        if name in self._commands:
            raise ValueError(f"the command {name!r} has its action already: choose another name")
        hotkey: Any = key.key or None
        modifier: Any = key.modifier or None
        command = self._client.gui.add_command(key.title, hotkey=hotkey, modifier=modifier)
        command.on_trigger(lambda _: None if self._held and leads(name) else action())
        self._commands[name] = command

    def hold(self, held: bool) -> None:
        """Leave to a presenter what is the presenter's, or give it back."""
        self._held = held

    def show(self) -> None:
        """The list of keys, over the page; shown a second time it goes."""
        viser_compat.run_in_page(self._client, dialog_script(keys_help(self._commands)))
