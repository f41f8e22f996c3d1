"""The settings drawer: units, theme, size of type; and the keys that change the view."""

from dataclasses import replace

from explorer.model.session_state import SessionState
from explorer.model.units import UNITS
from explorer.picture.fields import FIELDS
from explorer.tabs.context import Tab, TabContext
from explorer.text.glossary import hint


class SettingsPanel(Tab):
    """One session's."""

    def __init__(self, context: TabContext) -> None:
        self._context, gui, bind = context, context.gui, context.keyboard.bind
        view = context.view()
        self._units = gui.add_dropdown("Units", tuple(UNITS), initial_value=view.units, hint=hint("units"))
        self._dark = gui.add_checkbox("Dark page", view.dark, hint=hint("dark"))
        self._big = gui.add_checkbox("Big type", False, hint=hint("big_type"))
        self._units.on_update(lambda event: self._change(units=event.target.value) if event.client else None)
        self._dark.on_update(lambda event: self._change(dark=event.target.value) if event.client else None)
        self._big.on_update(lambda _: self._enlarge())
        gui.add_html(
            '<div class="rx rx-dim rx-small"><p>Keys: press <b>?</b> for the list, Ctrl+K to find a command.</p></div>'
        )
        bind("units", lambda: self._change(units=_after(tuple(UNITS), context.view().units)))
        bind("dark", lambda: self._change(dark=not context.view().dark))
        bind("field_next", lambda: self._change(field=_after(tuple(FIELDS), context.view().field)))
        bind("field_previous", lambda: self._change(field=_after(tuple(FIELDS), context.view().field, -1)))

    def show(self, state: SessionState) -> None:
        """Follow the view, which keys change too."""
        self._units.value, self._dark.value = state.view.units, state.view.dark

    def _change(self, **values: object) -> None:
        display = self._context.display
        display.set_view(replace(display.view(), **values))  # pyright: ignore[reportArgumentType]

    def _enlarge(self) -> None:
        """Big type in wider panels, or both as usual."""
        self._context.bridge.set(big=self._big.value)
        self._context.layout.enlarge(self._big.value)


def _after(titles: tuple[str, ...], title: str, step: int = 1) -> str:
    """The title so many places on, round and round."""
    return titles[(titles.index(title) + step) % len(titles)]
