"""Where the parts of the page stand, and its keyboard.

Three modes in the rail on the right, one drawer at a time on the left; every command of the page with its title and
key.
"""

import threading
import tomllib
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_args

import viser

from explorer.hosting.browser import Bridge, call
from explorer.model.session_state import Mode
from rotor.support.markup import Markup, tag

MODES: tuple[Mode, ...] = get_args(Mode)
_FILE = tomllib.loads(Path(__file__).with_name("keys.toml").read_text(encoding="utf-8"))
DRAWERS: dict[str, str] = _FILE["drawers"]
RAIL, DRAWER = 332, 348
"""Widths [px]."""
_WIDER = 1.22
"""Widths with big type, to those without."""


def by_hand(handle: Any, action: Callable[[Any], None]) -> None:
    """Call `action` with the value of a widget whenever the user changes it, not when the program does."""
    handle.on_update(lambda event: action(event.target.value) if event.client is not None else None)


class Layout:
    """The layout of a session. Parts that are not shown are not in the page, so they cost the browser nothing."""

    def __init__(self, gui: viser.GuiApi, bridge: Bridge) -> None:
        self._gui = gui
        self.mode: Mode = "explore"
        self.drawer = ""
        """The one that is open; empty: none."""
        self.drawers_locked = False
        """Whether `open_drawer` does nothing: a step of the lecture is on the page."""
        self.watchers: list[Callable[[], None]] = []
        """Called after another mode or drawer is shown."""
        gui.main_panel.dock_right()
        self.modes = {mode: gui.add_folder(None, visible=mode == self.mode) for mode in MODES}
        """Where the widgets of each mode go, as a context."""
        self._panel = gui.add_panel(visible=False)
        self.drawers: dict[str, viser.GuiFolderHandle] = {}
        """Where the widgets of each drawer go, as a context."""
        with self._panel.add_tab("Drawer"):
            for name, title in DRAWERS.items():
                self.drawers[name] = gui.add_folder(None, visible=False)
                with self.drawers[name]:
                    close = tag(
                        "button",
                        "×",
                        data_do="drawer",
                        data_value="",
                        aria_label="Close",
                        title="Close (Esc)",
                    )
                    gui.add_html(
                        tag("div.rxp-title", title, close, data_explorer="drawer", data_name=name)
                    )
        self._panel.dock_left()
        self.enlarge(False)
        bridge.on("mode", self.show_mode)
        bridge.on("drawer", self.show_drawer)

    def show_mode(self, mode: Any) -> None:
        """Change what the rail holds; a name that is no mode is passed over."""
        if mode not in MODES:
            return
        self.mode = mode
        for name, folder in self.modes.items():
            folder.visible = name == mode
        self._tell()

    def show_drawer(self, name: str) -> None:
        """Open a drawer in place of another; one that is open, or the empty name, closes it."""
        name = "" if name == self.drawer or name not in self.drawers else name
        before, self.drawer = self.drawer, name
        for title, folder in self.drawers.items():
            if title in (before, name):
                folder.visible = title == name
        self._panel.visible = bool(name)
        self._tell()

    def open_drawer(self, name: str) -> None:
        """Open a drawer, unless it is open or drawers are locked."""
        if name != self.drawer and not self.drawers_locked:
            self.show_drawer(name)

    def enlarge(self, big: bool) -> None:
        """Widths for big type, or the usual ones."""
        factor = _WIDER if big else 1.0
        self._gui.main_panel.set_width(factor * RAIL)
        self._panel.set_width(factor * DRAWER)

    def _tell(self) -> None:
        for watcher in self.watchers:
            watcher()


class Sections:
    """Parts of a rail or a drawer of which one is shown, with a row of buttons above them."""

    def __init__(
        self, gui: viser.GuiApi, bridge: Bridge, name: str, titles: tuple[str, ...]
    ) -> None:
        """`name`: of the row in the frame; no other has it."""
        self._name, self._now = name, titles[0]
        self._row = gui.add_html("")
        self._parts = {title: gui.add_folder(None, visible=title == self._now) for title in titles}
        bridge.on(name, self.show)
        self._draw()

    def __getitem__(self, title: str) -> viser.GuiFolderHandle:
        """Where the widgets of a part go, as a context."""
        return self._parts[title]

    def show(self, title: str) -> None:
        """Show this part; a title without one is passed over."""
        if title in self._parts and title != self._now:
            self._parts[self._now].visible = False
            self._now = title
            self._parts[title].visible = True
            self._draw()

    def _draw(self) -> None:
        buttons = [
            tag(
                "button",
                title,
                data_do=self._name,
                data_value=title,
                aria_pressed=str(title == self._now).lower(),
            )
            for title in self._parts
        ]
        self._row.content = tag("div.rxp-sections", buttons, role="group")


COARSE = 10
"""Steps that Shift and an arrow, or Page up and down, move a slider or the probe at once."""


@dataclass(frozen=True)
class Shortcut:
    group: str
    title: str
    key: str = ""
    """The key as the page names it; empty: in the palette only."""
    modifier: str = ""
    """As the page names what is held with it; empty: nothing."""

    @property
    def parts(self) -> tuple[str, ...]:
        """The keys to press together, as they are printed on a keyboard."""
        if not self.key:
            return ()
        # A question mark is typed with Shift, which it need not be told.
        held = () if self.key == "?" or not self.modifier else self.modifier.split("+")
        return tuple(_FILE["printed"].get(part, part) for part in (*held, self.key))


KEYS = {name: Shortcut(*row) for name, row in _FILE["commands"].items()}


def keys_help(bound: Iterable[str]) -> Markup:
    """The list of keys, by group, of the commands that this page has; as HTML."""
    known = set(bound)
    groups: dict[str, list[Markup]] = {}
    for name, key in KEYS.items():
        if name in known and key.key:
            groups.setdefault(key.group, []).append(_row(key.title, key.parts))
    for group, title, *parts in _FILE["always"]:
        groups.setdefault(group, []).append(_row(title, parts))
    lists = [tag("section", tag("h2", group), rows) for group, rows in groups.items()]
    return tag("div.rx.rx-keys", lists, data_explorer="keys")


def _row(title: str, parts: Iterable[str]) -> Markup:
    return tag("div.rx-line", tag("span", title), tag("span", [tag("kbd", part) for part in parts]))


class Keyboard:
    """Commands as they are bound. Actions run on viser's threads, one at a time, and must only say what is wanted."""

    def __init__(self, client: viser.ClientHandle, bridge: Bridge) -> None:
        self._client = client
        self._commands: dict[str, viser.CommandHandle] = {}
        self._acting = threading.Lock()
        """Two keys pressed at once must not both read the inputs before either has written them."""
        bridge.set(coarse=COARSE)
        self.bind("keys", self.show)

    def bind(self, name: str, action: Callable[[], None]) -> None:
        """Give the command `name` of `KEYS` its action; the palette and the list of keys have it from then on.

        KeyError for an unknown name, ValueError for one that has its action already.
        """
        key = KEYS[name]
        if name in self._commands:
            raise ValueError(f"the command {name!r} has its action already: choose another name")
        hotkey: Any = key.key or None
        modifier: Any = key.modifier or None
        command = self._client.gui.add_command(key.title, hotkey=hotkey, modifier=modifier)

        def act(_: Any) -> None:
            with self._acting:
                action()

        command.on_trigger(act)
        self._commands[name] = command

    def show(self) -> None:
        """The list of keys, over the page; shown a second time it goes."""
        call(self._client, "RX.dialog", keys_help(self._commands))
