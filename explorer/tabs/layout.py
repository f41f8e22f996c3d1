"""Where the parts of the page stand: three modes in the rail on the right, and one drawer at a time on the left."""

from collections.abc import Callable
from typing import Any, Literal

import viser

from explorer.hosting.browser import Bridge
from rotor.markup import tag

Mode = Literal["explore", "optimise", "actuate"]
MODES: tuple[Mode, ...] = ("explore", "optimise", "actuate")
DRAWERS = {
    "open": "Open",
    "share": "Share and export",
    "details": "Power and trim",
    "probe": "Blade element",
    "twist": "Power sensitivity to local pitch",
    "trust": "How far to trust this",
    "lecture": "Lecture",
    "settings": "Settings",
}
RAIL, DRAWER = 332, 348
"""Widths [px]."""
_WIDER = 1.22
"""Widths with big type, to those without."""


def by_hand(handle: Any, action: Callable[[Any], None]) -> None:
    """Call `action` with the value of a widget whenever the user changes it, not when the program does."""
    handle.on_update(lambda event: action(event.target.value) if event.client is not None else None)


class Layout:
    """One session's. What is not shown is not in the page, so that it costs the browser nothing."""

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
        self._modes = {mode: gui.add_folder(None, visible=mode == self.mode) for mode in MODES}
        self._panel = gui.add_panel(visible=False)
        self._drawers: dict[str, viser.GuiFolderHandle] = {}
        with self._panel.add_tab("Drawer"):
            for name, title in DRAWERS.items():
                self._drawers[name] = gui.add_folder(None, visible=False)
                with self._drawers[name]:
                    close = tag("button", "×", data_do="drawer", data_value="", aria_label="Close", title="Close (Esc)")
                    gui.add_html(tag("div.rxp-title", title, close, data_explorer="drawer", data_name=name))
        self._panel.dock_left()
        self.enlarge(False)
        bridge.on("mode", self.show_mode)
        bridge.on("drawer", self.show_drawer)

    def in_mode(self, mode: Mode) -> viser.GuiFolderHandle:
        """Where the widgets of a mode go, as a context."""
        return self._modes[mode]

    def in_drawer(self, name: str) -> viser.GuiFolderHandle:
        """Where the widgets of a drawer go, as a context; KeyError for a name without one."""
        return self._drawers[name]

    def show_mode(self, mode: Any) -> None:
        """Change what the rail holds; a name that is no mode is passed over."""
        if mode not in MODES:
            return
        self.mode = mode
        for name, folder in self._modes.items():
            folder.visible = name == mode
        self._tell()

    def show_drawer(self, name: str) -> None:
        """Open a drawer in place of another; one that is open, or the empty name, closes it."""
        name = "" if name == self.drawer or name not in self._drawers else name
        before, self.drawer = self.drawer, name
        for title, folder in self._drawers.items():
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
        self, gui: viser.GuiApi, bridge: Bridge, name: str, titles: tuple[str, ...],
        changed: Callable[[], None] | None = None,
    ) -> None:  # fmt: skip
        """`name`: of the row in the frame; no other has it. `changed` is called after another part is shown."""
        self._name, self._now, self._changed = name, titles[0], changed
        self._row = gui.add_html("")
        self._parts = {title: gui.add_folder(None, visible=title == self._now) for title in titles}
        bridge.on(name, self.show)
        self._draw()

    @property
    def now(self) -> str:
        """The part that is shown."""
        return self._now

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
            if self._changed is not None:
                self._changed()

    def _draw(self) -> None:
        buttons = [
            tag("button", title, data_do=self._name, data_value=title, aria_pressed=str(title == self._now).lower())
            for title in self._parts
        ]
        self._row.content = tag("div.rxp-sections", buttons, role="group")
