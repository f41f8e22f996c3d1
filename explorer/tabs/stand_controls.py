"""The widgets of the test stand, which take the place of those of flight."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
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
from explorer.tabs.layout import by_hand, key_of
from explorer.text.glossary import hint
from rotor import Aircraft, FlightCondition
from rotor.design import Flapping
from rotor.design.quantities import STAND_TRIMS

_NONE = "–"
"""In the menus of measured conditions: no measured condition is set."""
_FLAPPING: dict[Flapping, str] = {"trimmed": "Trimmed by cyclic", "free": "Free", "hub-moments": "For hub moments"}
_SLIDERS = {
    "shaft_tilt_deg": Slider("Shaft tilt [°]", -25.0, 25.0, 0.1),
    "ct_over_sigma": Slider("CT/σ", 0.0, 0.2, 0.001),
    "thrust_n": Slider("Thrust [N]", 0.0, 1e5, 100.0),
    "collective_deg": Slider("Collective [°]", -10.0, 30.0, 0.1),
    "cyclic_1c_deg": Slider("Cyclic θ1c [°]", -15.0, 15.0, 0.1),
    "cyclic_1s_deg": Slider("Cyclic θ1s [°]", -15.0, 15.0, 0.1),
    "tip_mach": Slider("Tip Mach", 0.05, 0.9, 0.005),
    "density": Slider("Density [kg/m³]", 0.3, 1.6, 0.005),
}
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
        self._sliders: dict[str, Any] = {}
        self._trim = gui.add_dropdown("Flight or test", tuple(TRIM_TITLES.values()), hint=hint("trim"))
        self._test = gui.add_dropdown("Measured in", (_NONE,), visible=False, hint=hint("measured_test"))
        self._point = gui.add_dropdown("Point", (_NONE,), visible=False, hint=hint("measured_point"))

    def add_sliders(self, gui: viser.GuiApi, start: Inputs) -> None:
        """Those of the test, which come after those of flight."""
        self._load = gui.add_dropdown("Given", tuple(LOAD_TITLES.values()), visible=False, hint=hint("stand_load"))
        self._flapping = gui.add_dropdown(
            "Flapping", tuple(_FLAPPING.values()), visible=False, hint=hint("stand_flapping")
        )
        for name, s in _SLIDERS.items():
            handle = gui.add_slider(s.label, s.low, s.high, s.step, s.low, visible=False, hint=hint(name))
            by_hand(handle, partial(self._slid, name))
            self._sliders[name] = handle
        by_hand(self._trim, self._trim_chosen)
        by_hand(self._test, self._test_chosen)
        by_hand(self._point, self._point_chosen)
        by_hand(self._load, self._load_chosen)
        by_hand(self._flapping, self._flapping_chosen)
        self.place(start)

    @property
    def handles(self) -> tuple[Any, ...]:
        """All widgets, to be taken from the user or given back."""
        return (self._trim, self._test, self._point, self._load, self._flapping, *self._sliders.values())

    def place(self, inputs: Inputs) -> None:
        """Show these inputs."""
        self.stand = stand = inputs.stand
        aircraft = inputs.aircraft
        titles = [title for key, title in TRIM_TITLES.items() if key != "flight" or not aircraft.isolated]
        _choose(self._trim, titles, TRIM_TITLES["flight" if stand is None else stand.trim])
        self.show_measured(inputs)
        for handle in (self._load, self._flapping):
            handle.visible = stand is not None and stand.trim != "controls"
        seen = () if stand is None else _seen(stand)
        for name, handle in self._sliders.items():
            handle.visible = name in seen
        if stand is None:
            return
        _choose(self._load, list(LOAD_TITLES.values()), LOAD_TITLES[stand.load])
        _choose(self._flapping, list(_FLAPPING.values()), _FLAPPING[stand.flapping])
        air = FlightCondition(0.0, 0.0, inputs.altitude_m, stand=stand.stand())
        values = {
            stand.load: stand.value,
            "shaft_tilt_deg": stand.shaft_tilt_deg or 0.0,
            "cyclic_1c_deg": stand.cyclic_1c_deg,
            "cyclic_1s_deg": stand.cyclic_1s_deg,
            "tip_mach": aircraft.rotor.tip_speed / air.sound_speed if stand.tip_mach is None else stand.tip_mach,
            "density": air.density,
        }
        for name, value in values.items():
            handle, form = self._sliders[name], _slider(name, aircraft)
            handle.min, handle.max = min(form.low, value), max(form.high, value)
            handle.step = form.step
            if handle.value != round(value, 6):
                handle.value = round(value, 6)

    def show_measured(self, inputs: Inputs) -> None:
        """The measured condition that is set, where one is; in flight those of flights."""
        flown = inputs.stand is None
        conditions = [one for one in measured_conditions(inputs.rotor) if (one.stand is None) == flown]
        self._test.visible = bool(conditions)
        now = next((one for one in conditions if _is_at(inputs, one)), None)
        tests = list(dict.fromkeys(one.test for one in conditions))
        _choose(self._test, [_NONE, *tests], _NONE if now is None else now.test)
        self._point.visible = now is not None
        if now is not None:
            _choose(self._point, [one.label for one in conditions if one.test == now.test], now.label)

    def _change(self, stand: StandInputs | None) -> None:
        """By hand, all else unchanged."""
        self.place(replace(self._inputs(), stand=stand))
        self._moved()

    def _solution(self) -> Any:
        """The last solution, if it is of the present rotor."""
        state = self._state()
        return state.solution if state is not None and state.inputs.aircraft == self._inputs().aircraft else None

    def _trim_chosen(self, title: str) -> None:
        trim = key_of(TRIM_TITLES, title)
        if trim == "flight":
            self._change(None)
            return
        solution = self._solution()
        begin = self.stand or (StandInputs() if solution is None else stand_like(solution))
        collective = None if solution is None else load_of(solution, "collective_deg")
        self._change(begin.with_trim(next(one for one in STAND_TRIMS if one == trim), collective))

    def _load_chosen(self, title: str) -> None:
        load, solution = key_of(LOAD_TITLES, title), self._solution()
        thrust = 0.3 * _slider("thrust_n", self._inputs().aircraft).high
        usual = {"ct_over_sigma": 0.07, "collective_deg": 8.0, "thrust_n": thrust}
        self._change_stand(load=load, value=usual[load] if solution is None else load_of(solution, load))

    def _flapping_chosen(self, title: str) -> None:
        self._change_stand(flapping=key_of(_FLAPPING, title))

    def _change_stand(self, **changes: Any) -> None:
        if self.stand is not None:
            self._change(replace(self.stand, **changes))

    def _slid(self, name: str, value: float) -> None:
        if self.stand is not None:
            self.stand = replace(self.stand, **{"value" if name in LOAD_TITLES else name: float(value)})  # pyright: ignore[reportArgumentType]
            self._moved()

    def _test_chosen(self, title: str) -> None:
        if title != _NONE:
            self.set_measured(opening([one for one in measured_conditions(self._inputs().rotor) if one.test == title]))

    def _point_chosen(self, label: str) -> None:
        for one in measured_conditions(self._inputs().rotor):
            if one.test == self._test.value and one.label == label:
                self.set_measured(one)

    def set_measured(self, condition: MeasuredCondition) -> None:
        """Fly or test the rotor there, its blade unchanged."""
        self._set_inputs(replace(self._inputs(), **condition.inputs))


def _is_at(inputs: Inputs, condition: MeasuredCondition) -> bool:
    return all(getattr(inputs, name) == value for name, value in condition.inputs.items())


def _seen(stand: StandInputs) -> tuple[str, ...]:
    """The sliders of a test: a free rotor finds its tilt, and cyclic is given where flapping is free."""
    tilt = () if stand.trim == "free-rotor" else ("shaft_tilt_deg",)
    cyclic = ("cyclic_1c_deg", "cyclic_1s_deg") if stand.flapping == "free" else ()
    return (stand.load, *tilt, *cyclic, "tip_mach", "density")


def _slider(name: str, aircraft: Aircraft) -> Slider:
    """As it is for this rotor: thrust to a loading of 0.2 at sea level, in round numbers."""
    form = _SLIDERS[name]
    if name != "thrust_n":
        return form
    rotor = aircraft.rotor
    most = 0.2 * rotor.solidity * 1.225 * rotor.disk_area * rotor.tip_speed**2
    step = 10.0 ** (len(str(int(most))) - 3)
    return replace(form, high=step * (most // step + 1.0), step=step)


def _choose(handle: Any, options: list[str], value: str) -> None:
    """Other options and their value; nothing is sent where both are as before."""
    if handle.options != tuple(options):
        handle.options = tuple(options)
    if handle.value != value:
        handle.value = value
