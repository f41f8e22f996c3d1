"""What is shown: widgets ↔ `ViewState`, with colour bar and key of the outlines. None of it moves the design."""

from collections.abc import Callable
from typing import Any

import viser

from explorer.picture.colour_bar import colour_bar, outline_legend
from explorer.picture.fields import FIELDS, Field
from explorer.state import TWIST_SHOWN, ViewState
from explorer.text import readout
from explorer.text.glossary import hint
from explorer.text.units import UNITS

_BAR, _LEGEND = 54, 40
"""Heights of the colour bar and of the key of the outlines [px]."""
_OUTLINES = {"reverse_flow": "Reverse flow", "stall": "Stall", "drag_divergence": "Drag diverg."}


class Display:
    """The widgets of one client's view, made once: the disk's where they are made, the page's where asked for."""

    def __init__(
        self, gui: viser.GuiApi, start: ViewState, changed: Callable[[], None], turned: Callable[[], None]
    ) -> None:
        """`changed`: something is shown otherwise. `turned`: it was only the marked blade."""
        self._changed = changed
        self._field = self._seen(
            gui.add_dropdown("Field", tuple(FIELDS), initial_value=start.field, hint=hint("field"))
        )
        self._difference = self._seen(
            gui.add_checkbox("Show B − A", start.difference, visible=False, hint=hint("difference"))
        )
        self._awaited = False
        """B − A is to be shown as soon as there is an A."""
        self._bar = gui.add_html(readout.reserved(_BAR))
        self.range_buttons = gui.add_button_group("Colours", ("Rescale", "Default"), hint=hint("colours"))
        self._legend = gui.add_html(readout.reserved(_LEGEND))
        self._outlines = {
            name: self._seen(gui.add_checkbox(title, getattr(start, name), hint=hint(f"outline_{name}")))
            for name, title in _OUTLINES.items()
        }
        self._azimuth = gui.add_slider("Azimuth ψ [°]", 0.0, 360.0, 1.0, start.azimuth_deg, hint=hint("azimuth_deg"))
        self._azimuth.on_update(lambda _: turned())
        self._exaggeration = self._seen(
            gui.add_slider("Twist shown ×", *TWIST_SHOWN, 0.5, start.exaggeration, hint=hint("exaggeration"))
        )

    def add_page(self, gui: viser.GuiApi, start: ViewState) -> None:
        """The units and the ground of the whole page, in the folder that is open."""
        units = gui.add_dropdown("Units", tuple(UNITS), initial_value=start.units, hint=hint("units"))
        self._units = self._seen(units)
        self._dark = self._seen(gui.add_checkbox("Dark page", start.dark, hint=hint("dark")))

    def view(self) -> ViewState:
        """What the widgets mean now."""
        return ViewState(
            field=self._field.value,
            azimuth_deg=self._azimuth.value,
            exaggeration=self._exaggeration.value,
            difference=self._difference.value,
            dark=self._dark.value,
            units=self._units.value,
            **{name: handle.value for name, handle in self._outlines.items()},
        )

    def set_view(self, view: ViewState) -> None:
        """Move the widgets."""
        self._field.value, self._azimuth.value = view.field, view.azimuth_deg
        self._exaggeration.value = view.exaggeration
        self._dark.value, self._units.value = view.dark, view.units
        self._awaited = view.difference and not self._difference.visible
        self._difference.value = view.difference and not self._awaited
        for name, handle in self._outlines.items():
            handle.value = getattr(view, name)
        self._changed()

    def turn(self, azimuth_deg: float) -> None:
        """Move the marked blade."""
        self._azimuth.value = azimuth_deg

    def hold(self, held: bool) -> None:
        """Take the rotor's part of the widgets from the user, or give it back; units and ground stay their own."""
        for handle in (self._field, self._difference, self._azimuth, self._exaggeration, *self._outlines.values()):
            handle.disabled = held

    def show_range(self, field: Field, colour_range: tuple[float, float], faded: bool) -> None:
        """The colour bar and legend of a field."""
        self._bar.content = colour_bar(field, *colour_range, faded)
        self._legend.content = outline_legend(field)

    def allow_difference(self, allowed: bool) -> None:
        """Whether there is a pinned design that the disk can show the difference from."""
        if not allowed and self._difference.value:
            self._difference.value = False
        self._difference.visible = allowed
        if allowed and self._awaited:
            self._awaited = False
            self._difference.value = True

    def _seen(self, handle: Any) -> Any:
        handle.on_update(lambda _: self._changed())
        return handle
