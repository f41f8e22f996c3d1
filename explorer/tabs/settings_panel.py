"""The settings drawer: units, theme, size of type."""

from collections.abc import Callable
from dataclasses import replace

import viser

from explorer.interface import SessionState
from explorer.tabs.display import Display
from explorer.text.glossary import hint
from explorer.text.units import UNITS


class SettingsPanel:
    """One session's."""

    def __init__(self, gui: viser.GuiApi, display: Display, enlarge: Callable[[bool], None]) -> None:
        """`enlarge`: big type for the whole page, or as it was."""
        self._display = display
        view = display.view()
        self._units = gui.add_dropdown("Units", tuple(UNITS), initial_value=view.units, hint=hint("units"))
        self._dark = gui.add_checkbox("Dark page", view.dark, hint=hint("dark"))
        self._big = gui.add_checkbox("Big type", False, hint=hint("big_type"))
        self._units.on_update(lambda event: self._change(units=event.target.value) if event.client else None)
        self._dark.on_update(lambda event: self._change(dark=event.target.value) if event.client else None)
        self._big.on_update(lambda event: enlarge(event.target.value))
        gui.add_html(
            '<div class="rx rx-dim rx-small"><p>Keys: press <b>?</b> for the list, Ctrl+K to find a command.</p></div>'
        )

    def show(self, state: SessionState) -> None:
        """Follow the view, which keys change too."""
        self._units.value, self._dark.value = state.view.units, state.view.dark

    def show_failure(self) -> None:
        """The view does not depend on a solution."""

    def stop(self) -> None:
        """Nothing runs on."""

    def _change(self, **values: object) -> None:
        self._display.set_view(replace(self._display.view(), **values))  # pyright: ignore[reportArgumentType]
