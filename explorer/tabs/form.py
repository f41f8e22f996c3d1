"""A form: the widgets of some quantities by their names, made, read, placed, hidden, disabled and translated alike."""

from collections.abc import Callable, Mapping
from typing import Any

import viser

from explorer.hosting.viser_compat import quick
from explorer.model.units import SI, Units, meant, shown
from explorer.text.glossary import hint
from rotor.design.quantity import Quantity, Slider


def key_of(titles: Mapping[Any, str], title: str) -> Any:
    """The key of what a menu shows."""
    return next(key for key, value in titles.items() if value == title)


class Form:
    """Widgets of one page. Values are those of the inputs; titles of menus and units are the form's matter."""

    def __init__(
        self,
        gui: viser.GuiApi,
        moved: Callable[[str, bool], None],
        rows: Mapping[str, Quantity] | None = None,
        *,
        at_once: bool = False,
    ) -> None:
        """`moved`: called with the name of a widget after a change, and whether a hand made it. `rows`: of those with
        other units. `at_once`: called on the event loop, for what takes no time."""
        self._gui, self._moved, self._rows, self._at_once = gui, moved, rows or {}, at_once
        self._handles: dict[str, Any] = {}
        self._titles: dict[str, Mapping[Any, str]] = {}
        """Titles of each menu, by what its titles mean."""
        self._below: dict[str, viser.GuiHtmlHandle] = {}
        self._units = SI

    def slider(
        self, name: str, form: Slider, value: float, *, entry: str = "", visible: bool = True, below: str = ""
    ) -> None:
        """`entry`: of the glossary, where it has another name. `below`: HTML under the slider, shown with it."""
        place = min(max(value, form.low), form.high)
        self._add(
            name, self._gui.add_slider, form.label, form.low, form.high, form.step, place, entry=entry, visible=visible
        )
        if below:
            self._below[name] = self._gui.add_html(below, visible=visible)

    def span(
        self,
        name: str,
        label: str,
        ends: tuple[float, float],
        value: tuple[float, float],
        least: float,
        entry: str = "",
    ) -> None:
        """A slider with two handles that stay `least` apart."""
        self._add(name, self._gui.add_multi_slider, label, *ends, 0.01, value, min_range=least, entry=entry)

    def menu(
        self, name: str, label: str, titles: Mapping[Any, str], value: Any = None, *, entry: str = "",
        visible: bool = True,
    ) -> None:  # fmt: skip
        """`titles`: by what they mean; `value`: the meaning that is chosen first, by default the first."""
        self._titles[name] = titles
        first = next(iter(titles.values())) if value is None else titles[value]
        options = tuple(titles.values())
        self._add(name, self._gui.add_dropdown, label, options, initial_value=first, entry=entry, visible=visible)

    def box(self, name: str, label: str, value: bool) -> None:
        self._add(name, self._gui.add_checkbox, label, value)

    def _add(self, name: str, add: Callable[..., Any], *arguments: Any, entry: str = "", **options: Any) -> None:
        handle = self._handles[name] = add(*arguments, hint=hint(entry or name), **options)

        def heard(event: Any) -> None:
            self._moved(name, event.client is not None)

        handle.on_update(quick(heard) if self._at_once else heard)

    def __getitem__(self, name: str) -> Any:
        """The value of a widget, in the unit of the input."""
        place = self._handles[name].value
        if name in self._titles:
            return key_of(self._titles[name], place)
        if isinstance(place, tuple):
            return tuple(sorted(round(float(end), 4) for end in place))
        return meant(self._rows[name], place, self._units) if name in self._rows else place

    def values(self) -> dict[str, Any]:
        """All of them, by name."""
        return {name: self[name] for name in self._handles}

    def place(self, name: str, value: Any) -> None:
        """Move a widget; nothing is sent where it is there already."""
        if name in self._titles:
            value = self._titles[name][value]
        elif name in self._rows:
            value = shown(self._rows[name], value, self._units)
        if self._handles[name].value != value:
            self._handles[name].value = value

    def fit(self, name: str, form: Slider, value: float) -> None:
        """Move a slider whose label, ends or step may be others."""
        handle = self._handles[name]
        if (handle.label, handle.min, handle.max, handle.step) == (form.label, form.low, form.high, form.step):
            self.place(name, value)
            return
        # In an order that never leaves the value outside its ends.
        handle.min, handle.max = min(form.low, handle.min), max(form.high, handle.max)
        handle.label, handle.step, handle.precision = form.label, form.step, form.digits
        self.place(name, value)
        handle.min, handle.max = form.low, form.high

    def translate(self, units: Units, forms: Callable[[str], Slider]) -> None:
        """Sliders in other units, as `forms` has them by name; the values stay."""
        values = {name: self[name] for name, row in self._rows.items() if row.aviation and name in self._handles}
        self._units = units
        for name, value in values.items():
            self.fit(name, forms(name), value)

    def offer(self, name: str, titles: Mapping[Any, str], value: Any) -> None:
        """Give a menu other titles, and choose a meaning."""
        self._titles[name] = titles
        if self._handles[name].options != (options := tuple(titles.values())):
            self._handles[name].options = options
        self.place(name, value)

    def show(self, seen: Mapping[str, bool]) -> None:
        """Which widgets are on the page."""
        for name, visible in seen.items():
            if self._handles[name].visible != visible:
                self._handles[name].visible = visible
                if name in self._below:
                    self._below[name].visible = visible

    def call(self, name: str, label: str) -> None:
        """Another label."""
        self._handles[name].label = label

    def disable(self, held: Mapping[str, bool]) -> None:
        """Which widgets the user may not move."""
        for name, inert in held.items():
            if self._handles[name].disabled != inert:
                self._handles[name].disabled = inert

    def hold(self, held: bool) -> None:
        """Take all widgets from the user, or give them back."""
        self.disable(dict.fromkeys(self._handles, held))
