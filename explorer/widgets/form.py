"""A form: the widgets of some quantities by their names, made, read, placed, hidden and translated alike.

One of them is that of the test stand, whose widgets take the place of those of flight.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import viser

from explorer.hosting.viser_compat import on_event_loop
from explorer.model.inputs import Inputs
from explorer.model.session_state import SessionState
from explorer.model.sliders import STAND_SLIDERS, stand_slider
from explorer.model.stand import (
    LOAD_TITLES,
    TRIM_TITLES,
    MeasuredCondition,
    StandInputs,
    equivalent_stand,
    load_of,
    measured_conditions,
    opening,
)
from explorer.model.units import SI, Units, shown, slider_input
from explorer.text.glossary import hint
from rotor import FlightCondition
from rotor.design import Flapping
from rotor.design.quantities import BY_INPUT, STAND_TRIMS
from rotor.design.quantity import Quantity, Slider

Titles = Mapping[Any, str]
"""What a menu shows, by what it means."""
Ends = tuple[float, float]


class WidgetForm:
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
        self._titles: dict[str, Titles] = {}
        """Titles of each menu."""
        self._defaults: dict[str, float] = {}
        """Where sliders began."""
        self._placed: dict[str, tuple[Any, Any]] = {}
        """By slider its place and the input put there, which it means until a hand moves it."""
        self.finer: dict[str, float] = {}
        """By slider an input with more digits than it shows, which a place means that shows the same."""
        self._below: dict[str, viser.GuiHtmlHandle] = {}
        self._units = SI

    def slider(
        self,
        name: str,
        form: Slider,
        value: float,
        *,
        entry: str = "",
        visible: bool = True,
        below: str = "",
    ) -> None:
        """`entry`: of the glossary, where it has another name. `below`: HTML under the slider, shown with it."""
        place = self._defaults[name] = min(max(value, form.low), form.high)
        self._placed[name] = place, place
        self._add(
            name,
            self._gui.add_slider,
            form.label,
            form.low,
            form.high,
            form.step,
            place,
            entry=entry,
            visible=visible,
        )
        self._handles[name].precision = form.digits  # By default viser shows all digits.
        if below:
            self._below[name] = self._gui.add_html(below, visible=visible)

    def span(
        self, name: str, label: str, ends: Ends, value: Ends, least: float, entry: str = ""
    ) -> None:
        """A slider with two handles that stay `least` apart."""
        self._add(
            name,
            self._gui.add_multi_slider,
            label,
            *ends,
            0.01,
            value,
            min_range=least,
            entry=entry,
        )

    def menu(
        self,
        name: str,
        label: str,
        titles: Titles,
        value: Any = None,
        *,
        entry: str = "",
        visible: bool = True,
    ) -> None:
        """`titles`: by what they mean; `value`: the meaning that is chosen first, by default the first."""
        self._titles[name] = titles
        first = next(iter(titles.values())) if value is None else titles[value]
        options = tuple(titles.values())
        self._add(
            name,
            self._gui.add_dropdown,
            label,
            options,
            initial_value=first,
            entry=entry,
            visible=visible,
        )

    def box(self, name: str, label: str, value: bool) -> None:
        self._add(name, self._gui.add_checkbox, label, value)

    def _add(
        self, name: str, add: Callable[..., Any], *arguments: Any, entry: str = "", **options: Any
    ) -> None:
        handle = self._handles[name] = add(*arguments, hint=hint(entry or name), **options)

        def heard(event: Any) -> None:
            self._moved(name, event.client is not None)

        handle.on_update(on_event_loop(heard) if self._at_once else heard)

    def __getitem__(self, name: str) -> Any:
        """The value of a widget, in the unit of the input."""
        place = self._handles[name].value
        if name in self._placed and place == self._placed[name][0]:
            return self._placed[name][1]
        if name in self._titles:
            return next(key for key, title in self._titles[name].items() if title == place)
        if isinstance(place, tuple):
            return tuple(sorted(round(float(end), 4) for end in place))
        if (finer := self.finer.get(name)) is not None:
            at, digits = shown(self._rows[name], finer, self._units), self._handles[name].precision
            if round(at, digits) == round(place, digits):
                return finer
        return slider_input(self._rows[name], place, self._units) if name in self._rows else place

    def values(self) -> dict[str, Any]:
        return {name: self[name] for name in self._handles}

    def sliders(self, label: str) -> list[str]:
        """Names of the sliders that are shown with this label."""
        return [
            n
            for n in self._defaults
            if self._handles[n].label == label and self._handles[n].visible
        ]

    def default(self, label: str) -> None:
        """Put the sliders with this label back to where they began, as a hand does."""
        for name in self.sliders(label):
            self.place(name, self._defaults[name])
            self._moved(name, True)

    def place(self, name: str, value: Any) -> None:
        """Move a widget; nothing is sent where it is there already."""
        if name in self._titles:
            value = self._titles[name][value]
        elif name in self._rows:
            meaning, value = value, shown(self._rows[name], value, self._units)
            self._placed[name] = value, meaning
        if self._handles[name].value != value:
            self._handles[name].value = value

    def move(self, name: str, place: float) -> None:
        """Move a slider as a hand does, to a place in the unit shown, as far as it goes."""
        handle = self._handles[name]
        place = handle.step * round(place / handle.step)
        handle.value = round(min(max(place, handle.min), handle.max), 9)
        self._moved(name, True)

    def __contains__(self, name: str) -> bool:
        return name in self._placed

    def fit(self, name: str, form: Slider, value: float) -> None:
        """Move a slider whose label, ends or step may be others."""
        handle = self._handles[name]
        if (handle.label, handle.min, handle.max, handle.step) == (
            form.label,
            form.low,
            form.high,
            form.step,
        ):
            self.place(name, value)
            return
        # In an order that never leaves the value outside its ends.
        handle.min, handle.max = min(form.low, handle.min), max(form.high, handle.max)
        handle.label, handle.step, handle.precision = form.label, form.step, form.digits
        self.place(name, value)
        handle.min, handle.max = form.low, form.high

    def translate(self, units: Units, forms: Callable[[str], Slider]) -> None:
        """Sliders in other units, as `forms` has them by name; the values stay."""
        values = {
            name: self[name]
            for name, row in self._rows.items()
            if row.aviation and name in self._handles
        }
        self._units = units
        for name, value in values.items():
            self.fit(name, forms(name), value)

    def offer(self, name: str, titles: Titles, value: Any) -> None:
        """Give a menu other titles, and choose a meaning."""
        self._titles[name] = titles
        if self._handles[name].options != (options := tuple(titles.values())):
            self._handles[name].options = options
        self.place(name, value)

    def show(self, seen: Mapping[str, bool]) -> None:
        for name, visible in seen.items():
            if self._handles[name].visible != visible:
                self._handles[name].visible = visible
                if name in self._below:
                    self._below[name].visible = visible

    def bound(self, name: str, low: float) -> None:
        """Another low end of a slider, which its value does not leave."""
        handle = self._handles[name]
        if handle.min != low:
            self.place(name, max(handle.value, low))
            handle.min = low

    def call(self, name: str, label: str) -> None:
        self._handles[name].label = label


_NONE = "–"
"""In the menus of measured conditions: no measured condition is set."""
_TRIM, _TEST, _POINT, _LOAD, _FLAPPING = (
    "trim",
    "measured_test",
    "measured_point",
    "stand_load",
    "stand_flapping",
)
_FLAPPINGS: dict[Flapping, str] = {
    "trimmed": "Trimmed by cyclic",
    "free": "Free",
    "hub-moments": "Gives moments",
}


class StandControls:
    """One client's. The value is `stand`; the widgets only show it, so that a measured condition stays exact."""

    def __init__(
        self,
        gui: viser.GuiApi,
        inputs: Callable[[], Inputs],
        set_inputs: Callable[[Inputs], None],
        moved: Callable[[], None],
        state: Callable[[], SessionState | None],
    ) -> None:
        """`inputs`, `set_inputs`: of all sliders of the page. `moved`: called after a change by hand.

        `state`: the last converged state of the session, from which a test begins.
        """
        self._inputs, self._set_inputs, self._moved, self._state = inputs, set_inputs, moved, state
        self.stand: StandInputs | None = None
        form = self.form = WidgetForm(gui, self._heard)
        form.menu(_TRIM, BY_INPUT[_TRIM].title, TRIM_TITLES)
        form.menu(_TEST, "Measured in", {_NONE: _NONE}, visible=False)
        form.menu(_POINT, "Point", {_NONE: _NONE}, visible=False)

    def add_sliders(self, start: Inputs) -> None:
        """Add the sliders of the test, which come after those of flight."""
        self.form.menu(_LOAD, "Given", LOAD_TITLES, visible=False)
        self.form.menu(_FLAPPING, BY_INPUT[_FLAPPING].title, _FLAPPINGS, visible=False)
        for name, form in STAND_SLIDERS.items():
            self.form.slider(name, form, form.low, visible=False)
        self.place(start)

    def place(self, inputs: Inputs) -> None:
        self.stand = stand = inputs.stand
        titles = {
            key: title
            for key, title in TRIM_TITLES.items()
            if key != "flight" or not inputs.aircraft.isolated
        }
        self.form.offer(_TRIM, titles, "flight" if stand is None else stand.trim)
        self.follow(inputs)
        seen = () if stand is None else _seen(stand)
        self.form.show({name: name in seen for name in (_LOAD, _FLAPPING, *STAND_SLIDERS)})
        if stand is None:
            return
        self.form.place(_LOAD, stand.load)
        self.form.place(_FLAPPING, stand.flapping)
        self._fit(inputs, stand.load, stand.value)
        self._fit(inputs, "shaft_tilt_deg", stand.shaft_tilt_deg or 0.0)
        self._fit(inputs, "cyclic_1c_deg", stand.cyclic_1c_deg)
        self._fit(inputs, "cyclic_1s_deg", stand.cyclic_1s_deg)

    def _fit(self, inputs: Inputs, name: str, value: float) -> None:
        form = stand_slider(name, inputs)
        self.form.fit(
            name,
            replace(form, low=min(form.low, value), high=max(form.high, value)),
            round(value, 6),
        )

    def follow(self, inputs: Inputs) -> None:
        """The measured condition that is set, in flight one of flights; air and speed of the tip, given or not."""
        stand, flown = self.stand, inputs.stand is None
        if stand is not None:
            # Its mass does not matter.
            air = FlightCondition(0.0, 1e3, inputs.altitude_m, inputs.isa_offset_c)
            mach = stand.tip_mach
            self._fit(
                inputs, "tip_mach", inputs.tip_speed / air.sound_speed if mach is None else mach
            )
            self._fit(inputs, "density", air.density if stand.density is None else stand.density)
        conditions = [
            one for one in measured_conditions(inputs.rotor) if (one.stand is None) == flown
        ]
        here = (
            one
            for one in conditions
            if all(getattr(inputs, name) == at for name, at in one.inputs.items())
        )
        now = next(here, None)
        tests = [_NONE, *dict.fromkeys(condition.test for condition in conditions)]
        self.form.show({_TEST: bool(conditions), _POINT: now is not None})
        self.form.offer(_TEST, {name: name for name in tests}, _NONE if now is None else now.test)
        if now is not None:
            labels = {
                condition.label: condition.label
                for condition in conditions
                if condition.test == now.test
            }
            self.form.offer(_POINT, labels, now.label)

    def _heard(self, name: str, by_hand: bool) -> None:
        """The value is `stand`, so that only what a hand does counts."""
        if not by_hand:
            return
        value, conditions = self.form[name], measured_conditions(self._inputs().rotor)
        if name == _TRIM:
            self._change_trim(value)
        elif name == _LOAD:
            self._change_load(value)
        elif name == _TEST and value != _NONE:
            self.set_measured(
                opening([condition for condition in conditions if condition.test == value])
            )
        elif name == _POINT:
            for condition in conditions:
                if (condition.test, condition.label) == (self.form[_TEST], value):
                    self.set_measured(condition)
        elif self.stand is not None and name == _FLAPPING:
            self._change(replace(self.stand, flapping=value))
        elif self.stand is not None and name in STAND_SLIDERS:
            self.stand = replace(
                self.stand, **{"value" if name in LOAD_TITLES else name: float(value)}
            )  # pyright: ignore[reportArgumentType]
            self._moved()

    def _change(self, stand: StandInputs | None) -> None:
        """By hand, all else unchanged."""
        self.place(replace(self._inputs(), stand=stand))
        self._moved()

    def _solution(self) -> Any:
        """The last solution, if it is of the present rotor."""
        state = self._state()
        return (
            state.solution
            if state is not None and state.inputs.aircraft == self._inputs().aircraft
            else None
        )

    def _change_trim(self, trim: str) -> None:
        if trim == "flight":
            self._change(None)
            return
        solution = self._solution()
        begin = self.stand or (StandInputs() if solution is None else equivalent_stand(solution))
        collective = None if solution is None else load_of(solution, "collective_deg")
        self._change(
            begin.with_trim(next(known for known in STAND_TRIMS if known == trim), collective)
        )

    def _change_load(self, load: str) -> None:
        solution = self._solution()
        usual = {"ct_over_sigma": 0.07, "collective_deg": 8.0}
        usual["thrust_n"] = 0.3 * stand_slider("thrust_n", self._inputs()).high
        if self.stand is not None:
            value = usual[load] if solution is None else load_of(solution, load)
            self._change(replace(self.stand, load=load, value=value))

    def set_measured(self, condition: MeasuredCondition) -> None:
        """Fly or test the rotor there, its blade unchanged."""
        self._set_inputs(replace(self._inputs(), **condition.inputs))


def _seen(stand: StandInputs) -> tuple[str, ...]:
    """The widgets of a test: a free rotor finds its tilt, and cyclic is given where flapping is free."""
    tilt = () if stand.trim == "free-rotor" else ("shaft_tilt_deg",)
    cyclic = ("cyclic_1c_deg", "cyclic_1s_deg") if stand.flapping == "free" else ()
    menus = () if stand.trim == "controls" else (_LOAD, _FLAPPING)
    return (*menus, stand.load, *tilt, *cyclic, "tip_mach", "density")
