"""The rail of the Explore mode: widgets ↔ `Inputs`. Callbacks only say that something changed."""

import threading
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import viser

from explorer.hosting.browser import Bridge
from explorer.model.inputs import (
    FLIGHT,
    INFLOW_MENUS,
    LAWS,
    PRESET_TITLES,
    ROWS,
    Inputs,
    law_titles,
    menu_titles,
    preset_inflow,
    reference_mass_t,
    with_rotor,
)
from explorer.model.session_state import SessionState
from explorer.model.sliders import slider
from explorer.model.stand import condition_of
from explorer.model.undo import LongestPause, PowerTracker
from explorer.model.units import SI, Units
from explorer.text import readout
from explorer.text.glossary import hint
from explorer.widgets.form import StandControls, WidgetForm
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.switches import SWITCHES
from rotor.design.aircraft import Aircraft
from rotor.design.quantities import OPTIONS
from rotor.support.markup import Markup, tag


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
        self,
        gui: viser.GuiApi,
        bridge: Bridge,
        start: Inputs,
        tracker: PowerTracker,
        callbacks: SessionCallbacks,
    ) -> None:
        self._start, self._tracker, self._changed = start, tracker, callbacks.wake
        self._special = start
        """Holds what the laws mean that are not always there."""
        self._moving = threading.RLock()
        self._own: Inputs | None = None
        """The user's own inputs while the sliders show those of a preview."""
        self._following = self._more = False
        self.pauses = LongestPause()
        self._units = SI
        """Units of the sliders of mass, altitude and climb now."""
        form = self.form = WidgetForm(gui, self._heard, ROWS, at_once=True)
        curve = tag("div.rxp-curve", data_curve=True)
        gui.add_html(tag("div.rxp-head", "BUILT-IN TWIST", tag("span", "rates in °/R")) + curve)
        form.menu("law", "Twist concept", law_titles(start), start.law)
        self._sliders(_LAW_INPUTS, LAWS[start.law].inputs)
        self._speed = gui.add_html(_flight_heading(0.0, SI))
        self._sliders(FLIGHT, _ALWAYS)
        form.finer["mass_t"] = reference_mass_t(start.aircraft)
        self.stand = StandControls(
            gui, self.inputs, self.set_inputs, partial(self._moved, True), callbacks.state
        )
        self.stand.add_sliders(start)
        self._fold = gui.add_html("")
        with gui.add_folder("Model", expand_by_default=False):
            for name in ("preset", *INFLOW_MENUS):
                form.menu(
                    name,
                    ROWS[name].title,
                    INFLOW_MENUS.get(name, PRESET_TITLES),
                    getattr(start, name),
                )
                if name == "inflow":
                    self._explanation = gui.add_html("")
            self._costs: dict[str, viser.GuiHtmlHandle] = {}
            for name in (*SWITCHES, *OPTIONS):
                form.box(name, ROWS[name].title, getattr(start, name))
                self._costs[name] = gui.add_html("")
        self.optimise_button = gui.add_button("Optimise this blade", hint=hint("optimise"))
        bridge.on("rotor", self._choose_rotor)
        bridge.on("law", self._choose_law)
        bridge.on("flown", self._set_measured)
        bridge.on("more", self._show_more)

    def inputs(self) -> Inputs:
        """What the widgets mean now, or what they meant before they followed a preview."""
        with self._moving:
            if self._own is not None:
                return self._own
            return replace(self._special, stand=self.stand.stand, **self.form.values())

    @property
    def aircraft(self) -> Aircraft:
        return (self._own or self._special).aircraft

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

    def default(self, label: str, opening: Inputs) -> None:
        """Put the slider with this label where `opening` has it, or another rotor as it is built."""
        now = self.inputs()
        base = (
            opening if now.rotor == opening.rotor else with_rotor(opening, now.rotor, now.own_rotor)
        )
        self.change(**{name: getattr(base, name) for name in self.form.sliders(label)})

    def follow(self, preview: Inputs | None) -> None:
        """Show a preview on the sliders; None: the user's own inputs again. `inputs` stay what they are."""
        with self._moving:
            inputs = (
                self._own
                if self._own is not None
                else self.inputs()
                if preview is not None
                else None
            )
            if inputs is None:
                return
            self._following, self._own = True, inputs
            try:
                self._place(inputs if preview is None else preview)
            finally:
                self._following = False
                self._own = None if preview is None else inputs

    def _place(self, inputs: Inputs) -> None:
        """Move the widgets, under the lock."""
        self._special = inputs
        self.form.offer("law", law_titles(inputs), inputs.law)
        self.stand.place(inputs)
        for name, row in ROWS.items():
            if row.slider is None:
                self.form.place(name, getattr(inputs, name))
            else:
                self.form.fit(
                    name, slider(name, self._units, inputs.aircraft), getattr(inputs, name)
                )
        self.form.finer["mass_t"] = reference_mass_t(inputs.aircraft)

    def refresh(self, inputs: Inputs, units: Units) -> None:
        """Bring everything that only follows the widgets into line: which sliders show, speed, units, explanations."""
        with self._moving:
            if units is not self._units:
                aircraft, self._units = self._special.aircraft, units
                self.form.translate(units, lambda name: slider(name, units, aircraft))
            shown = inputs if self._own is None else self._special
        law, tested = LAWS[shown.law].inputs, inputs.stand is not None
        self.form.show({name: name in law and name not in shown.idle for name in _LAW_INPUTS})
        counting = [
            name
            for name, row in FLIGHT.items()
            if inputs.counts(row) and not (tested and row.in_place)
        ]
        folded = [
            name
            for name in counting
            if name not in _ALWAYS and getattr(shown, name) == FLIGHT[name].default
        ]
        in_sight = set(counting) if self._more else set(counting) - set(folded)
        self.form.show({name: name in in_sight for name in FLIGHT})
        chosen = tested or shown.aircraft.isolated
        self.stand.form.show({"trim": self._more or chosen})
        self._fold.content = _fold(folded, self._more, chosen)
        if self._own is None:
            self.stand.follow(inputs)
        self._speed.content = _flight_heading(
            inputs.advance_ratio * inputs.tip_speed, units, tested
        )
        self._explanation.content = readout.explanation(INFLOW_MODELS[inputs.inflow].explanation)

    def show_costs(self, costs: Mapping[str, str]) -> None:
        """What each switch of the physics costs, in words, by its name."""
        for name in SWITCHES:
            self._costs[name].content = _switch_note("cost", costs.get(name, ""))

    def show_bending(self, words: str) -> None:
        """What bending costs, or why there is none, beside its switch."""
        self._costs["bending"].content = _switch_note("bending", words)

    def _sliders(self, names: Iterable[str], seen: Iterable[str]) -> None:
        """With a row below each for the arrow of its power sensitivity."""
        for name in names:
            form, below = (
                slider(name, SI, self._start.aircraft),
                tag("div.rxp-worth", data_worth=name, data_answers=True),
            )
            self.form.slider(
                name, form, float(getattr(self._start, name)), visible=name in seen, below=below
            )

    def _heard(self, name: str, by_hand: bool) -> None:
        if by_hand and name == "preset":
            for menu, value in preset_inflow(self.form["preset"]).items():
                self.form.place(menu, value)
        self._moved(by_hand)

    def _moved(self, by_hand: bool) -> None:
        if self._following and not by_hand:
            return
        if by_hand:
            self._own = None  # Whoever moves a slider goes on from the preview.
            self._tracker.touch()
        self.pauses.moved(time.monotonic())
        self._changed()

    def _show_more(self, wanted: str) -> None:
        """Show what of the flight is at its default too, or fold it."""
        self._more = wanted == "on"
        self._changed()

    def _choose_rotor(self, name: str) -> None:
        """Another rotor of the menu, as it is built."""
        if name in menu_titles(self.inputs().own_rotor):
            self.pauses.moved(time.monotonic())
            self.set_inputs(with_rotor(self.inputs(), name))

    def _choose_law(self, law: str) -> None:
        """Another twist law of the menu, as a hand chooses it there."""
        if law in law_titles(self.inputs()):
            self.change(law=law)

    def _set_measured(self, case: str) -> None:
        """Set a measured flight or test of this rotor, by its name."""
        condition = condition_of(self.inputs().rotor, case)
        if condition is not None:
            self.stand.set_measured(condition)


def _switch_note(part: str, words: str) -> Markup:
    """Words beside a switch; nothing without."""
    return tag("div.rxp-cost", words, data_explorer=part) if words else Markup()


def _flight_heading(speed: float, units: Units, tested: bool = False) -> Markup:
    """The heading of the flight sliders with the airspeed [m/s], where the pointer rests as each reader reads it."""
    words, title = units.airspeed(speed), "TEST STAND" if tested else "FLIGHT"
    airspeed = tag("span.rx-num", words.partition(" · ")[0], title=words, data_explorer="speed")
    return tag("div.rxp-head", title, airspeed, data_ruled=True)


_ALWAYS = ("advance_ratio", "mass_t")
"""Sliders of flight that are never folded."""

_NAMED = 3
"""Names on the button that unfolds the others: more would not fit its line."""


def _fold(folded: Iterable[str], more: bool, chosen: bool) -> Markup:
    """The button that shows the sliders of flight at their defaults, by name, or folds them; `chosen`: the menu of the
    test stand is in sight anyway."""
    sliders = [form for name in folded if (form := FLIGHT[name].slider) is not None]
    names = [form.label.partition(" [")[0] for form in sliders] + ([] if chosen else ["Test stand"])
    if not names:
        return Markup()
    following = [
        name if name.startswith("ISA") else f"{name[:1].lower()}{name[1:]}" for name in names[1:]
    ]
    few = len(names) if len(names) <= _NAMED + 1 else _NAMED
    words = "Fewer" if more else ", ".join((names[0], *following)[:few])
    if not more and few < len(names):
        words += " and more"
    pressed = {
        "data_do": "more",
        "data_value": "off" if more else "on",
        "aria_expanded": str(more).lower(),
    }
    return tag("button.rxp-fold", words, **pressed)


_LAW_INPUTS = tuple(name for law in LAWS.values() for name in law.inputs)
