"""The rail of the Explore mode: widgets ↔ `Inputs`. Callbacks only say that something changed."""

import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import viser

from explorer.hosting.browser import Bridge
from explorer.hosting.viser_compat import quick
from explorer.model.inputs import (
    INFLOW_MENUS,
    INPUT_NAMES,
    LAWS,
    NOT_ALWAYS,
    PRESET_TITLES,
    Inputs,
    preset_inflow,
    with_rotor,
)
from explorer.model.pinned import FLIGHT
from explorer.model.session_state import SessionState
from explorer.model.sliders import SLIDERS, meant, shown, slider
from explorer.model.stand import condition_of
from explorer.model.undo import Pauses, PowerTracker
from explorer.model.units import SI, Units
from explorer.tabs.layout import by_hand, key_of
from explorer.tabs.stand_controls import StandControls
from explorer.text import readout
from explorer.text.glossary import hint
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.switches import SWITCHES


@dataclass(frozen=True)
class SessionCallbacks:
    """What the page calls in its session; safe from any thread."""

    wake: Callable[[], None]
    """Something changed: the session's worker does another update."""
    azimuth_changed: Callable[[], None]
    """Only the azimuth of the reference blade changed."""
    state: Callable[[], SessionState | None]
    """The last converged state; None before the first."""


class DesignControls:
    """The widgets of one client's Explore mode, made once, and the view that goes with them."""

    def __init__(
        self, gui: viser.GuiApi, bridge: Bridge, start: Inputs, tracker: PowerTracker, callbacks: SessionCallbacks
    ) -> None:
        self._start, self._tracker, self._changed = start, tracker, callbacks.wake
        self._inputs: dict[str, Any] = {}
        self._special = start
        """Holds what the laws mean that are not always there."""
        self._moving = threading.RLock()
        self._own: Inputs | None = None
        """The user's own inputs while the sliders show those of a preview."""
        self._following = self._held = False
        self.pauses = Pauses()
        self._laws = _laws_of(start)
        self._units = SI
        """Of the sliders of mass, altitude and climb now."""
        self._sensitivities: dict[str, viser.GuiHtmlHandle] = {}
        """The row below each slider that the arrow of its power sensitivity goes into."""
        gui.add_html(
            '<div class="rxp-head">JIG TWIST<span>slopes in °/R</span></div><div class="rxp-curve" data-curve></div>'
        )
        self._law = gui.add_dropdown(
            "Twist concept", tuple(self._laws.values()), initial_value=self._laws[start.law], hint=hint("law")
        )
        self._inputs["law"] = self._watched(self._law)
        self._sliders(gui, tuple(name for law in LAWS.values() for name in law.inputs))
        self._speed = gui.add_html(_flight_heading(0.0, SI))
        self.stand = StandControls(gui, self.inputs, self.set_inputs, partial(self._moved, True), callbacks.state)
        self._sliders(gui, FLIGHT)
        self.stand.add_sliders(gui, start)
        with gui.add_folder("Model", expand_by_default=False):
            titles = tuple(PRESET_TITLES.values())
            preset = gui.add_dropdown("Preset", titles, initial_value=PRESET_TITLES[start.preset], hint=hint("preset"))
            self._inputs["preset"] = self._watched(preset)
            self._inflow_menu(gui, "inflow", "Inflow")
            self._explanation = gui.add_html("")
            self._inflow_menu(gui, "hover_inflow", "Inflow in hover")
            self._inflow_menu(gui, "low_speed", "At low speed")
            self._inflow_menu(gui, "loss_on", "Tip and root loss")
            self._costs: dict[str, viser.GuiHtmlHandle] = {}
            for name, switch in SWITCHES.items():
                box = gui.add_checkbox(switch.title, getattr(start, name), hint=hint(name))
                self._inputs[name] = self._watched(box)
                self._costs[name] = gui.add_html("")
            bending = gui.add_checkbox("Blade bending", start.bending, hint=hint("bending"))
            self._bending_words = gui.add_html("")
            stall = gui.add_checkbox("Dynamic stall", start.dynamic_stall, hint=hint("dynamic_stall"))
            self._inputs |= {"bending": self._watched(bending), "dynamic_stall": self._watched(stall)}
        self.optimise_button = gui.add_button("Optimise this blade", hint=hint("optimise"))
        self.reset_button = gui.add_button("Reset design", color="gray", hint=hint("reset"))
        by_hand(preset, self._preset_chosen)
        bridge.on("rotor", self._choose_rotor)
        bridge.on("flown", self._set_measured)

    def inputs(self) -> Inputs:
        """What the widgets mean now, or what they meant before they followed a preview."""
        with self._moving:
            if self._own is not None:
                return self._own
            values = {name: self._read(name, handle.value) for name, handle in self._inputs.items()}
            special = replace(self._special, stand=self.stand.stand)
        values["law"] = key_of(self._laws, values["law"])
        values["preset"] = key_of(PRESET_TITLES, values["preset"])
        values |= {name: key_of(titles, values[name]) for name, titles in INFLOW_MENUS.items()}
        return replace(special, **values)

    def reset(self) -> None:
        """Back to the design the page began with."""
        self.set_inputs(self._start)

    def hold(self, held: bool) -> None:
        """Take the widgets from the user, or give them back."""
        self._held = held
        for handle in (*self._inputs.values(), *self.stand.handles, self.reset_button, self.optimise_button):
            handle.disabled = held

    def set_inputs(self, inputs: Inputs) -> None:
        """Move the widgets; the page follows as if they had been dragged."""
        with self._moving:  # An update that reads meanwhile would see half of them.
            self._own = None
            self._place(inputs)
        self._changed()

    def change(self, **changes: Any) -> None:
        """A hand changed inputs by widgets elsewhere on the page; all else stays, that of a preview too."""
        with self._moving:
            self._own = None
            changed = replace(self.inputs(), **changes)
        self._tracker.touch()
        self.pauses.moved(time.monotonic())
        self.set_inputs(changed)

    def follow(self, preview: Inputs | None) -> None:
        """Show a preview on the sliders; None: the user's own inputs again. `inputs` stay what they are."""
        with self._moving:
            own = self._own if self._own is not None else self.inputs() if preview is not None else None
            if own is None:
                return
            self._following, self._own = True, own
            try:
                self._place(own if preview is None else preview)
            finally:
                self._following = False
                self._own = None if preview is None else own

    def _place(self, inputs: Inputs) -> None:
        """Move the widgets, under the lock."""
        self._special = inputs
        self._laws = _laws_of(inputs)
        if self._law.options != tuple(self._laws.values()):
            self._law.options = tuple(self._laws.values())
        self._fit("mass_t", inputs)
        self._fit("advance_ratio", inputs)
        self.stand.place(inputs)
        titles = {"law": self._laws, "preset": PRESET_TITLES, **INFLOW_MENUS}
        for name in INPUT_NAMES:
            if name in self._inputs:
                value = getattr(inputs, name)
                place = titles[name][value] if name in titles else self._shown(name, value)
                if self._inputs[name].value != place:
                    self._inputs[name].value = place

    def refresh(self, inputs: Inputs, units: Units) -> None:
        """Bring everything that only follows the widgets into line: which sliders show, speed, units, explanations."""
        self._change_units(units)
        with self._moving:
            shown_inputs = inputs if self._own is None else self._special
            shown_law = shown_inputs.law
        in_flight = inputs.stand is None
        seen = {name: key == shown_law for key, law in LAWS.items() for name in law.inputs}
        seen |= {"mass_t": in_flight, "altitude_m": in_flight, "climb_m_s": inputs.climbs}
        for name, visible in seen.items():
            if self._inputs[name].visible != visible:
                self._inputs[name].visible = self._sensitivities[name].visible = visible
        for name in LAWS[shown_law].inputs:
            inert = self._held or name in shown_inputs.idle
            if self._inputs[name].disabled != inert:
                self._inputs[name].disabled = inert
        if self._own is None:
            self.stand.show_measured(inputs)
        self._speed.content = _flight_heading(inputs.advance_ratio * inputs.tip_speed, units, inputs.stand is not None)
        self._explanation.content = readout.explanation(INFLOW_MODELS[inputs.inflow].explanation)

    def show_costs(self, costs: Mapping[str, str]) -> None:
        """What each switch of the physics costs, in words, by its name."""
        for name, handle in self._costs.items():
            handle.content = _beside("cost", costs.get(name, ""))

    def show_bending(self, words: str) -> None:
        """What bending costs, or why there is none, beside its switch."""
        if self._bending_words.content != (content := _beside("bending", words)):
            self._bending_words.content = content

    def _change_units(self, units: Units) -> None:
        """Weight, altitude and climb in other units; the inputs stay what they are."""
        if units is self._units:
            return
        with self._moving:
            for name in FLIGHT[1:]:
                handle = self._inputs[name]
                value, form = self._read(name, handle.value), slider(name, units, self._special.aircraft)
                handle.label, handle.step, handle.precision = form.label, form.step, form.digits
                handle.min, handle.max = form.low, form.high
                handle.value = shown(name, value, units)
            self._units = units

    def _read(self, name: str, place: Any) -> Any:
        """The input that a widget's value means, but for titles."""
        return meant(name, place, self._units) if name in SLIDERS else place

    def _shown(self, name: str, value: Any) -> Any:
        return shown(name, value, self._units) if name in SLIDERS else value

    def _sliders(self, gui: viser.GuiApi, names: tuple[str, ...]) -> None:
        for name in names:
            s = slider(name, SI, self._start.aircraft)
            value = min(max(float(getattr(self._start, name)), s.low), s.high)
            shown_first = name not in _LAW_INPUTS or name in LAWS[self._start.law].inputs
            handle = gui.add_slider(s.label, s.low, s.high, s.step, value, visible=shown_first, hint=hint(name))
            self._inputs[name] = self._watched(handle)
            self._sensitivities[name] = gui.add_html(
                f'<div class="rxp-worth" data-worth="{name}"></div>', visible=shown_first
            )

    def _inflow_menu(self, gui: viser.GuiApi, name: str, label: str) -> None:
        titles = INFLOW_MENUS[name]
        menu = gui.add_dropdown(
            label, tuple(titles.values()), initial_value=titles[getattr(self._start, name)], hint=hint(name)
        )
        self._inputs[name] = self._watched(menu)

    def _watched(self, handle: Any) -> Any:
        handle.on_update(quick(lambda event: self._moved(event.client is not None)))
        return handle

    def _moved(self, by_hand: bool) -> None:
        if self._following and not by_hand:
            return
        if by_hand:
            self._own = None  # Whoever moves a slider goes on from the preview.
            self._tracker.touch()
        self.pauses.moved(time.monotonic())
        self._changed()

    def _preset_chosen(self, title: str) -> None:
        for name, value in preset_inflow(key_of(PRESET_TITLES, title)).items():
            self._inputs[name].value = INFLOW_MENUS[name][value]

    def _choose_rotor(self, name: str) -> None:
        """Another rotor of the menu, as it is built."""
        if not self._held:
            self.pauses.moved(time.monotonic())
            self.set_inputs(with_rotor(self.inputs(), name))

    def _set_measured(self, case: str) -> None:
        """Set a measured flight or test of this rotor, by its name."""
        condition = condition_of(self.inputs().rotor, case)
        if condition is not None and not self._held:
            self.stand.set_measured(condition)

    def _fit(self, name: str, inputs: Inputs) -> None:
        """A slider whose ends depend on the rotor: weight about its own reference mass, speed as it can be tested."""
        handle = self._inputs[name]
        form = slider(name, self._units, inputs.aircraft)
        if (handle.min, handle.max) != (form.low, form.high):
            # In an order that never leaves the value outside its ends.
            handle.min, handle.max = min(form.low, handle.min), max(form.high, handle.max)
            handle.step, handle.precision = form.step, form.digits
            handle.value = shown(name, getattr(inputs, name), self._units)
            handle.min, handle.max = form.low, form.high


def _beside(part: str, words: str) -> str:
    """Words beside a switch; nothing without."""
    return f'<div class="rxp-cost" data-explorer="{part}">{words}</div>' if words else ""


def _flight_heading(speed: float, units: Units, tested: bool = False) -> str:
    """The heading of the flight sliders with the airspeed [m/s] as each reader reads it."""
    words, title = units.airspeed(speed), "TEST STAND" if tested else "FLIGHT"
    return f'<div class="rxp-head" data-ruled>{title}<span class="rx-num" data-explorer="speed">{words}</span></div>'


_LAW_INPUTS = frozenset(name for law in LAWS.values() for name in law.inputs)


def _laws_of(inputs: Inputs) -> dict[str, str]:
    """The menu of laws: those that are not always there only where `inputs` hold them."""
    return {key: law.title for key, law in LAWS.items() if key not in NOT_ALWAYS or getattr(inputs, key) is not None}
