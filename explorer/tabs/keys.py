"""Keyboard: every command of the page with its title and key, the palette, and what the page does for them."""

import threading
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import viser

from explorer.hosting.browser import call
from rotor.markup import Markup, tag

SHIFT, CTRL, CTRL_SHIFT = "shift", "cmd/ctrl", "cmd/ctrl+shift"
COARSE = 10
"""Steps that Shift and an arrow, or Page up and down, move a slider or the probe at once."""

_SHOWN = {
    "arrowup": "↑", "arrowdown": "↓", "arrowleft": "←", "arrowright": "→", "space": "Space",
    "pageup": "Page up", "pagedown": "Page down", "shift": "Shift", "cmd/ctrl": "Ctrl",
}  # fmt: skip


@dataclass(frozen=True)
class Key:
    group: str
    title: str
    key: str = ""
    """The key as the page names it; empty: in the palette only."""
    modifier: str = ""
    """`SHIFT`, `CTRL`, `CTRL_SHIFT`, or empty."""

    @property
    def parts(self) -> tuple[str, ...]:
        """The keys to press together, as they are printed on a keyboard."""
        if not self.key:
            return ()
        # A question mark is typed with Shift, which it need not be told.
        held = () if self.key == "?" or not self.modifier else self.modifier.split("+")
        return tuple(_SHOWN.get(part, part) for part in (*held, self.key))


_DESIGN, _FLIGHT, _VIEW, _PROBE, _PAGE = "Design", "Flight", "View", "Blade and probe", "Page"
KEYS: dict[str, Key] = {
    "undo": Key(_DESIGN, "Undo", "Z", CTRL),
    "redo": Key(_DESIGN, "Redo", "Z", CTRL_SHIFT),
    "keep": Key(_DESIGN, "Keep this design (bookmark)", "M"),
    "twist": Key(_DESIGN, "Twist the blade by hand", "G"),
    "optimise": Key(_DESIGN, "Optimise, or stop", "O"),
    "pin": Key(_DESIGN, "Pin as A, or unpin", "P"),
    "swap": Key(_DESIGN, "Swap A and B"),
    "back": Key(_DESIGN, "Back to A"),
    "reset": Key(_DESIGN, "Reset design", "R"),
    "hover": Key(_FLIGHT, "Hover", "H"),
    "mu_015": Key(_FLIGHT, "Advance ratio 0.15", "J"),
    "mu_024": Key(_FLIGHT, "Advance ratio 0.24", "K"),
    "mu_037": Key(_FLIGHT, "Advance ratio 0.37", "L"),
    "view_3d": Key(_VIEW, "View: 3D", "1"),
    "view_top": Key(_VIEW, "View: from above", "2"),
    "view_blade": Key(_VIEW, "View: reference blade", "3"),
    "view_side": Key(_VIEW, "View: advancing side", "4"),
    "field_next": Key(_VIEW, "Next quantity on the disk", "F"),
    "field_previous": Key(_VIEW, "Previous quantity on the disk", "F", SHIFT),
    "rescale": Key(_VIEW, "Fit colour range to the data", "C"),
    "rescale_default": Key(_VIEW, "Default colour range", "C", SHIFT),
    "units": Key(_VIEW, "SI or aviation units", "U"),
    "dark": Key(_VIEW, "Dark or light page", "N"),
    "play": Key(_PROBE, "Play or pause the rotor", "space"),
    "probe_out": Key(_PROBE, "Probe one step outboard", "arrowup"),
    "probe_in": Key(_PROBE, "Probe one step inboard", "arrowdown"),
    "probe_on": Key(_PROBE, "Probe one step forward in azimuth", "arrowright"),
    "probe_back": Key(_PROBE, "Probe one step back in azimuth", "arrowleft"),
    "probe_far_out": Key(_PROBE, "Probe ten steps outboard", "arrowup", SHIFT),
    "probe_far_in": Key(_PROBE, "Probe ten steps inboard", "arrowdown", SHIFT),
    "probe_far_on": Key(_PROBE, "Probe ten steps forward in azimuth", "arrowright", SHIFT),
    "probe_far_back": Key(_PROBE, "Probe ten steps back in azimuth", "arrowleft", SHIFT),
    "probe_hide": Key(_PROBE, "Show or hide the probe on the disk", "B"),
    "lecture": Key(_PAGE, "Lecture mode", "T"),
    "lecture_next": Key(_PAGE, "Next step of the lecture", "pagedown"),
    "lecture_previous": Key(_PAGE, "Previous step of the lecture", "pageup"),
    "share": Key(_PAGE, "Copy a link to this design", "Y"),
    "export": Key(_PAGE, "Export", "X"),
    "keys": Key(_PAGE, "Keys", "?", SHIFT),
}


def leads(name: str) -> bool:
    """Whether a command is the presenter's while the page follows one: it moves the design, the disk or the lecture."""
    return KEYS[name].group in (_DESIGN, _FLIGHT) or name.startswith(("field", "lecture"))


_ALWAYS = (
    ("Sliders", "One step", ("←", "→")),
    ("Sliders", "Ten steps", ("Shift", "←", "→")),
    ("Sliders", "Ten steps", ("Page up", "Page down")),
    ("Sliders", "To either end", ("Home", "End")),
    ("Camera", "Orbit, pan, zoom", ("mouse left", "right", "wheel")),
    ("Camera", "Fly", ("W", "A", "S", "D", "Q", "E")),
    (_PAGE, "Find a command", ("Ctrl", "K")),
    (_PAGE, "Leave a field, so that keys work", ("Esc",)),
)
"""What works without being a command."""


def keys_help(bound: Iterable[str]) -> Markup:
    """The list of keys, by group, of the commands that this page has; as HTML."""
    known = set(bound)
    groups: dict[str, list[Markup]] = {}
    for name, key in KEYS.items():
        if name in known and key.key:
            groups.setdefault(key.group, []).append(_row(key.title, key.parts))
    for group, title, parts in _ALWAYS:
        groups.setdefault(group, []).append(_row(title, parts))
    lists = [tag("section", tag("h4", group), rows) for group, rows in groups.items()]
    return tag("div.rx.rx-keys", lists, data_explorer="keys")


def _row(title: str, parts: tuple[str, ...]) -> Markup:
    return tag("div.rx-line", tag("span", title), tag("span", [tag("kbd", part) for part in parts]))


class Keyboard:
    """Commands as they are bound. Actions run on viser's threads, one at a time, and must only say what is wanted."""

    def __init__(self, client: viser.ClientHandle) -> None:
        self._client = client
        self._commands: dict[str, viser.CommandHandle] = {}
        self._held = False
        self._acting = threading.Lock()
        """Two keys pressed at once must not both read the inputs before either has written them."""
        call(client, "RX.set", {"coarse": COARSE})
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
            if not (self._held and leads(name)):
                with self._acting:
                    action()

        command.on_trigger(act)
        self._commands[name] = command

    def hold(self, held: bool) -> None:
        """Leave to a presenter what is the presenter's, or give it back."""
        self._held = held

    def show(self) -> None:
        """The list of keys, over the page; shown a second time it goes."""
        call(self._client, "RX.dialog", keys_help(self._commands))
