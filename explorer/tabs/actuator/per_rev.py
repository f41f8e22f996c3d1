"""Pitch and twist at n/rev in the Actuate mode: widgets ↔ `Inputs`."""

import math
from collections.abc import Callable
from functools import partial
from html import escape
from typing import Any

import viser

from explorer.hosting.viser_compat import quick
from explorer.model.inputs import Inputs
from explorer.model.session_state import SessionState
from explorer.tabs.actuator.dial import TwistDial
from explorer.tabs.context import TabContext
from explorer.tabs.layout import by_hand
from explorer.text.design_words import harmonic_words
from explorer.text.glossary import hint
from rotor.design import Harmonic
from rotor.design.active_twist import HIGHEST, LARGEST_PITCH

_WAVES = {"pitch_per_rev": ("Pitch", 2), "twist_per_rev": ("Twist", 1)}
"""By the field of `Inputs`: title, and the lowest harmonic."""
_WAVE_DEG = round(math.degrees(LARGEST_PITCH), 6)
"""Largest amplitude on the sliders; a design file may have more twist."""


class PerRevControls:
    """One client's. The menu says which harmonic the two sliders set; an amplitude of zero takes it away."""

    def __init__(self, context: TabContext, grabbed: Callable[[bool], None]) -> None:
        """`grabbed`: the dot of the dial was taken (True) or let go."""
        self._controls, gui = context.controls, context.gui
        self._orders: dict[str, Any] = {}
        self._sizes: dict[str, Any] = {}
        self._phases: dict[str, Any] = {}
        self._seen: dict[str, tuple[Harmonic, ...]] = {}
        """What was shown last of each input."""
        with gui.add_folder("Pitch and twist at n/rev"):
            self._words = gui.add_html("")
            self._vibration = gui.add_html("", visible=False)
            self._dial = TwistDial(context, grabbed)
            for name, (title, lowest) in _WAVES.items():
                orders = tuple(f"{n}/rev" for n in range(lowest, HIGHEST + 1))
                self._orders[name] = gui.add_dropdown(
                    f"{title} harmonic", orders, initial_value="3/rev", hint=hint(name)
                )
                self._sizes[name] = gui.add_slider(
                    f"{title} ampl. [°]", 0.0, _WAVE_DEG, 0.05, 0.0, hint=hint("wave_amplitude")
                )
                self._phases[name] = gui.add_slider(f"{title} phase [°]", 0.0, 360.0, 5.0, 0.0, hint=hint("wave_phase"))
                by_hand(self._orders[name], partial(self._chosen, name))
                for handle in (self._sizes[name], self._phases[name]):
                    handle.on_update(quick(partial(self._moved, name)))
        self.refresh(context.inputs())

    def refresh(self, inputs: Inputs) -> None:
        """Show these inputs; a harmonic that is there, where the menu names one that is not."""
        for name in _WAVES:
            waves: tuple[Harmonic, ...] = getattr(inputs, name)
            if waves == self._seen.get(name):
                continue
            self._seen[name] = waves
            there = [one.per_rev for one in waves]
            if there and self._order(name) not in there:
                self._orders[name].value = f"{there[0]}/rev"
            self._show(name, waves)
        words = harmonic_words(inputs.twist_per_rev, inputs.pitch_per_rev) or "none set"
        shaped = " The twist has the shape of its design file." if inputs.active_shape else ""
        self._words.content = (
            f'<div class="rx rx-dim rx-small" data-explorer="per-rev">{words[:1].upper()}{words[1:]}.{shaped}</div>'
        )

    def show(self, state: SessionState, words: str, index: float | None) -> None:
        """Dial and vibration of a converged state; `words` of its index [%], empty and None: blades do not bend."""
        self._dial.show(state, index)
        content = f'<div class="rx rx-small" data-explorer="per-rev-vibration">{escape(words)}</div>' if words else ""
        if self._vibration.content != content:
            self._vibration.visible, self._vibration.content = bool(words), content

    def stop(self) -> None:
        """The browser has left."""
        self._dial.stop()

    def hold(self, held: bool) -> None:
        """Take the widgets from the user, or give them back."""
        for handles in (self._orders, self._sizes, self._phases):
            for handle in handles.values():
                handle.disabled = held

    def _order(self, name: str) -> int:
        return int(self._orders[name].value.partition("/")[0])

    def _show(self, name: str, waves: tuple[Harmonic, ...]) -> None:
        """The harmonic of the menu on its sliders; without it the phase stays as it was."""
        wave = next((one for one in waves if one.per_rev == self._order(name)), None)
        size, phase = self._sizes[name], self._phases[name]
        degrees = 0.0 if wave is None else round(math.degrees(wave.amplitude), 6)
        if degrees > size.max:  # From a design file.
            size.max = degrees
        if size.value != degrees:
            size.value = degrees
        if wave is not None and phase.value % 360.0 != (angle := round(math.degrees(wave.phase), 6)):
            phase.value = angle

    def _chosen(self, name: str, _: object = None) -> None:
        self._show(name, getattr(self._controls.inputs(), name))

    def _moved(self, name: str, event: viser.GuiEvent[Any]) -> None:
        if event.client is not None:
            self._slid(name)

    def _slid(self, name: str) -> None:
        order, size = self._order(name), math.radians(float(self._sizes[name].value))
        before: tuple[Harmonic, ...] = getattr(self._controls.inputs(), name)
        others = [one for one in before if one.per_rev != order]
        own = [Harmonic(order, size, math.radians(float(self._phases[name].value)))] if size > 0.0 else []
        after = tuple(sorted([*others, *own], key=lambda one: one.per_rev))
        if after != before:
            self._seen[name] = after  # The menu stays on the harmonic that the hand moves.
            self._controls.change(**{name: after})
