"""The widgets of the test stand, which take the place of those of flight."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import viser

from explorer.model.inputs import Inputs
from explorer.model.session_state import SessionState
from explorer.model.sliders import Slider
from explorer.model.stand import (
    LOAD_TITLES,
    TRIM_TITLES,
    MeasuredCondition,
    StandInputs,
    load_of,
    measured_conditions,
    opening,
    stand_like,
)
from explorer.tabs.form import Form
from rotor import FlightCondition
from rotor.design import Flapping
from rotor.design.quantities import BY_INPUT, STAND, STAND_TRIMS

_NONE = "–"
"""In the menus of measured conditions: no measured condition is set."""
_TRIM, _TEST, _POINT, _LOAD, _FLAPPING = "trim", "measured_test", "measured_point", "stand_load", "stand_flapping"
_FLAPPINGS: dict[Flapping, str] = {"trimmed": "Trimmed by cyclic", "free": "Free", "hub-moments": "For hub moments"}
_SLIDERS = {row.input: row.slider for row in STAND.values() if row.slider}
"""By the field of `StandInputs`, or by what is given."""


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
        form = self.form = Form(gui, self._heard)
        form.menu(_TRIM, BY_INPUT[_TRIM].title, TRIM_TITLES)
        form.menu(_TEST, "Measured in", {_NONE: _NONE}, visible=False)
        form.menu(_POINT, "Point", {_NONE: _NONE}, visible=False)

    def add_sliders(self, start: Inputs) -> None:
        """Add the sliders of the test, which come after those of flight."""
        self.form.menu(_LOAD, "Given", LOAD_TITLES, visible=False)
        self.form.menu(_FLAPPING, BY_INPUT[_FLAPPING].title, _FLAPPINGS, visible=False)
        for name, form in _SLIDERS.items():
            self.form.slider(name, form, form.low, visible=False)
        self.place(start)

    def place(self, inputs: Inputs) -> None:
        """Show these inputs."""
        self.stand = stand = inputs.stand
        titles = {key: title for key, title in TRIM_TITLES.items() if key != "flight" or not inputs.aircraft.isolated}
        self.form.offer(_TRIM, titles, "flight" if stand is None else stand.trim)
        self.follow(inputs)
        seen = () if stand is None else _seen(stand)
        self.form.show({name: name in seen for name in (_LOAD, _FLAPPING, *_SLIDERS)})
        if stand is None:
            return
        self.form.place(_LOAD, stand.load)
        self.form.place(_FLAPPING, stand.flapping)
        self._fit(inputs, stand.load, stand.value)
        self._fit(inputs, "shaft_tilt_deg", stand.shaft_tilt_deg or 0.0)
        self._fit(inputs, "cyclic_1c_deg", stand.cyclic_1c_deg)
        self._fit(inputs, "cyclic_1s_deg", stand.cyclic_1s_deg)

    def _fit(self, inputs: Inputs, name: str, value: float) -> None:
        form = _slider(name, inputs)
        self.form.fit(name, replace(form, low=min(form.low, value), high=max(form.high, value)), round(value, 6))

    def follow(self, inputs: Inputs) -> None:
        """The measured condition that is set, in flight one of flights; air and speed of the tip, given or not."""
        stand, flown = self.stand, inputs.stand is None
        if stand is not None:
            air, mach = FlightCondition(0.0, 1e3, inputs.altitude_m), stand.tip_mach  # Of any mass.
            self._fit(inputs, "tip_mach", inputs.tip_speed / air.sound_speed if mach is None else mach)
            self._fit(inputs, "density", air.density if stand.density is None else stand.density)
        conditions = [
            condition for condition in measured_conditions(inputs.rotor) if (condition.stand is None) == flown
        ]
        now = next((condition for condition in conditions if _is_at(inputs, condition)), None)
        tests = [_NONE, *dict.fromkeys(condition.test for condition in conditions)]
        self.form.show({_TEST: bool(conditions), _POINT: now is not None})
        self.form.offer(_TEST, {name: name for name in tests}, _NONE if now is None else now.test)
        if now is not None:
            self.form.offer(
                _POINT,
                {condition.label: condition.label for condition in conditions if condition.test == now.test},
                now.label,
            )

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
            self.set_measured(opening([condition for condition in conditions if condition.test == value]))
        elif name == _POINT:
            for condition in conditions:
                if (condition.test, condition.label) == (self.form[_TEST], value):
                    self.set_measured(condition)
        elif self.stand is not None and name == _FLAPPING:
            self._change(replace(self.stand, flapping=value))
        elif self.stand is not None and name in _SLIDERS:
            self.stand = replace(self.stand, **{"value" if name in LOAD_TITLES else name: float(value)})  # pyright: ignore[reportArgumentType]
            self._moved()

    def _change(self, stand: StandInputs | None) -> None:
        """By hand, all else unchanged."""
        self.place(replace(self._inputs(), stand=stand))
        self._moved()

    def _solution(self) -> Any:
        """The last solution, if it is of the present rotor."""
        state = self._state()
        return state.solution if state is not None and state.inputs.aircraft == self._inputs().aircraft else None

    def _change_trim(self, trim: str) -> None:
        if trim == "flight":
            self._change(None)
            return
        solution = self._solution()
        begin = self.stand or (StandInputs() if solution is None else stand_like(solution))
        collective = None if solution is None else load_of(solution, "collective_deg")
        self._change(begin.with_trim(next(known for known in STAND_TRIMS if known == trim), collective))

    def _change_load(self, load: str) -> None:
        solution = self._solution()
        usual = {
            "ct_over_sigma": 0.07,
            "collective_deg": 8.0,
            "thrust_n": 0.3 * _slider("thrust_n", self._inputs()).high,
        }
        if self.stand is not None:
            value = usual[load] if solution is None else load_of(solution, load)
            self._change(replace(self.stand, load=load, value=value))

    def set_measured(self, condition: MeasuredCondition) -> None:
        """Fly or test the rotor there, its blade unchanged."""
        self._set_inputs(replace(self._inputs(), **condition.inputs))


def _is_at(inputs: Inputs, condition: MeasuredCondition) -> bool:
    return all(getattr(inputs, name) == value for name, value in condition.inputs.items())


def _seen(stand: StandInputs) -> tuple[str, ...]:
    """The widgets of a test: a free rotor finds its tilt, and cyclic is given where flapping is free."""
    tilt = () if stand.trim == "free-rotor" else ("shaft_tilt_deg",)
    cyclic = ("cyclic_1c_deg", "cyclic_1s_deg") if stand.flapping == "free" else ()
    menus = () if stand.trim == "controls" else (_LOAD, _FLAPPING)
    return (*menus, stand.load, *tilt, *cyclic, "tip_mach", "density")


def _slider(name: str, inputs: Inputs) -> Slider:
    """The slider of a load for this rotor at its speed: thrust to a loading of 0.2 at sea level, in round numbers."""
    form = _SLIDERS[name]
    if name != "thrust_n":
        return form
    rotor = inputs.aircraft.rotor
    most = 0.2 * rotor.solidity * 1.225 * rotor.disk_area * inputs.tip_speed**2
    step = 10.0 ** (len(str(int(most))) - 3)
    return replace(form, high=step * (most // step + 1.0), step=step)
