"""The control panel: widgets ↔ `Inputs` and `ViewState`. Callbacks only say that something changed."""

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

import viser

from explorer import readout
from explorer.colour_bar import colour_bar, outline_legend
from explorer.fields import FIELDS, Field
from explorer.history import Pauses
from explorer.state import INPUT_NAMES, LAWS, NOT_ALWAYS, PRESET_TITLES, Inputs, ViewState, preset_inflow
from explorer.view import View
from rotor.inflow import INFLOW_MODELS
from rotor.presets import make_design
from rotor.switches import SWITCHES


class Handle(Protocol):
    """What a widget must offer."""

    value: Any
    visible: bool

    def on_update(self, func: Callable[[Any], None]) -> Any: ...


@dataclass(frozen=True)
class Slider:
    label: str
    low: float
    high: float
    step: float
    hint: str


_RATE = "Slope of the twist in degrees per radius; negative: the outer end is nose-down."
_DIVISION = "Where two segments meet, as a fraction of the radius."
SLIDERS: dict[str, Slider] = {
    "linear": Slider("Rate [°/R]", -30.0, 10.0, 0.1, _RATE),
    "quadratic_curvature": Slider("Curve [°/R²]", -40.0, 40.0, 0.5, "Second-order coefficient; 0 is the linear law."),
    "quadratic_difference": Slider("Tip−root [°]", -30.0, 10.0, 0.1, "Twist at the tip minus twist at the centre."),
    "two_inner": Slider("Inner [°/R]", -30.0, 10.0, 0.1, _RATE),
    "two_outer": Slider("Outer [°/R]", -30.0, 10.0, 0.1, _RATE),
    "two_division": Slider("Division [R]", 0.2, 0.95, 0.01, _DIVISION),
    "three_inner": Slider("Inner [°/R]", -30.0, 10.0, 0.1, _RATE),
    "three_middle": Slider("Middle [°/R]", -30.0, 10.0, 0.1, _RATE),
    "three_outer": Slider("Outer [°/R]", -30.0, 10.0, 0.1, _RATE),
    "three_first": Slider("Division 1 [R]", 0.2, 0.95, 0.01, _DIVISION),
    "three_second": Slider("Division 2 [R]", 0.2, 0.95, 0.01, _DIVISION),
    "advance_ratio": Slider("Adv. ratio µ", 0.0, 0.45, 0.005, "Airspeed over tip speed; 0 is hover."),
    "mass_t": Slider("Weight [t]", 5.0, 11.0, 0.05, "Gross mass in tonnes."),
    "altitude_m": Slider("Altitude [m]", 0.0, 4000.0, 50.0, "Pressure altitude, standard atmosphere."),
}
LIMITS = {name: (slider.low, slider.high) for name, slider in SLIDERS.items()}
"""What each slider can hold."""
FOUR, INFINITE = "dynamic-wake", "dynamic-wake-infinite-blades"
"""The same theory with the rotor's own blades and with infinitely many."""
VIEW_BUTTONS: dict[str, View] = {"3D": "3d", "Top": "top", "Blade": "blade", "Side": "side"}
_TOGGLES = {"reverse_flow": "Reverse flow", "stall": "Stall", "drag_divergence": "Drag diverg."}


class Controls:
    """The widgets of one client, made once."""

    def __init__(
        self,
        gui: viser.GuiApi,
        start: Inputs,
        changed: Callable[[], None],
        dark: bool,
        turned: Callable[[], None] | None = None,
    ) -> None:
        """`changed`: something moved. `turned`: it was only the marked blade."""
        self._start = start
        self._changed = changed
        self._inputs: dict[str, Handle] = {}
        self._special = start
        """Holds what the laws mean that are not always there."""
        self._moving = threading.RLock()
        self.pauses = Pauses()
        self._laws = _laws_of(start)
        self._inflows = {name: model.title for name, model in INFLOW_MODELS.items()}
        self.view_buttons = gui.add_button_group(
            "View", tuple(VIEW_BUTTONS), hint="Fit it into the window: the rotor, its plan, the marked blade, the side."
        )
        with gui.add_folder("Twist"):
            self._law = gui.add_dropdown("Law", tuple(self._laws.values()), initial_value=self._laws[start.law])
            self._inputs["law"] = self._watched(self._law)
            self._sliders(gui, tuple(name for law in LAWS.values() for name in law.inputs))
        with gui.add_folder("Flight"):
            self._sliders(gui, ("advance_ratio",))
            self._speed = gui.add_html(readout.speed_line(0.0))
            self._sliders(gui, ("mass_t", "altitude_m"))
        with gui.add_folder("Disk and blades"):
            self._field = self._seen(gui.add_dropdown("Field", tuple(FIELDS), initial_value=ViewState.field))
            self._difference = self._seen(
                gui.add_checkbox(
                    "Show B − A", False, visible=False, hint="The field of this design minus that of the pinned one."
                )
            )
            self._bar = gui.add_html("")
            self.range_buttons = gui.add_button_group(
                "Colours",
                ("Rescale", "Default"),
                hint="The range stays as it is while you drag; fit it to the data here.",
            )
            self._legend = gui.add_html("")
            self._toggles = {name: self._seen(gui.add_checkbox(title, True)) for name, title in _TOGGLES.items()}
            self._azimuth = gui.add_slider(
                "Azimuth ψ [°]", 0.0, 360.0, 1.0, ViewState.azimuth_deg, hint="Of the marked blade."
            )
            self._azimuth.on_update(lambda _: (turned or changed)())
            self._exaggeration = self._seen(
                gui.add_slider(
                    "Twist shown ×", 1.0, 5.0, 0.5, 1.0, hint="Exaggerates the twist of the drawn blades only."
                )
            )
        with gui.add_folder("Model"):
            self._inputs["preset"] = self._watched(
                gui.add_dropdown("Preset", tuple(PRESET_TITLES.values()), initial_value=PRESET_TITLES[start.preset])
            )
            self._inputs["inflow"] = self._watched(
                gui.add_dropdown("Inflow", tuple(self._inflows.values()), initial_value=self._inflows[start.inflow])
            )
            self._explanation = gui.add_html("")
            self._infinite = gui.add_checkbox(
                "Infinite blades",
                start.inflow == INFINITE,
                hint="The same wake averaged over time: the rotor that textbooks untwist for speed.",
            )
            self._infinite.on_update(self._infinite_changed)
            self.check_button = gui.add_button(
                "Check with the vortex wake", color="gray", hint="The same design with rigid helical vortices."
            )
            self._dark = self._seen(gui.add_checkbox("Dark page", dark))
        with gui.add_folder("Physics", expand_by_default=False):
            for name, switch in SWITCHES.items():
                box = gui.add_checkbox(switch.title, getattr(start, name), hint=f"{switch.on} Off: {switch.off}")
                self._inputs[name] = self._watched(box)
        self.reset_button = gui.add_button("Reset design")
        self._inputs["preset"].on_update(self._preset_changed)

    def inputs(self) -> Inputs:
        """What the widgets mean now."""
        with self._moving:
            values = {name: handle.value for name, handle in self._inputs.items()}
            special = self._special
        values["law"] = _key(self._laws, values["law"])
        values["preset"] = _key(PRESET_TITLES, values["preset"])
        values["inflow"] = _key(self._inflows, values["inflow"])
        return Inputs(**values, given=special.given, found=special.found, airfoils=special.airfoils)

    def view(self) -> ViewState:
        return ViewState(
            field=self._field.value,
            azimuth_deg=self._azimuth.value,
            exaggeration=self._exaggeration.value,
            difference=self._difference.value,
            dark=self._dark.value,
            **{name: handle.value for name, handle in self._toggles.items()},
        )

    def turn(self, azimuth_deg: float) -> None:
        """Move the marked blade."""
        self._azimuth.value = azimuth_deg

    def reset(self) -> None:
        """Back to the design the page began with."""
        self.set_inputs(self._start)

    def set_view(self, view: ViewState) -> None:
        """Move the widgets of what is shown."""
        self._field.value, self._azimuth.value, self._exaggeration.value = (
            view.field,
            view.azimuth_deg,
            view.exaggeration,
        )
        self._dark.value = view.dark
        self._difference.value = view.difference and self._difference.visible
        for name, handle in self._toggles.items():
            handle.value = getattr(view, name)
        self._changed()

    def set_inputs(self, inputs: Inputs) -> None:
        """Move the widgets; the page follows as if they had been dragged."""
        with self._moving:  # A round that reads meanwhile would see half of them.
            self._special = inputs
            self._laws = _laws_of(inputs)
            if self._law.options != tuple(self._laws.values()):
                self._law.options = tuple(self._laws.values())
            titles = {"law": self._laws, "preset": PRESET_TITLES, "inflow": self._inflows}
            for name in INPUT_NAMES:
                if name in self._inputs:
                    value = getattr(inputs, name)
                    self._inputs[name].value = titles[name][value] if name in titles else value
        self._changed()

    def refresh(self, inputs: Inputs) -> None:
        """Bring everything that only follows the widgets into line: which sliders show, speed, explanations."""
        for key, law in LAWS.items():
            for name in law.inputs:
                self._inputs[name].visible = key == inputs.law
        self._speed.content = readout.speed_line(
            make_design(inputs.preset, advance_ratio=inputs.advance_ratio).airspeed
        )
        self._explanation.content = readout.explanation(INFLOW_MODELS[inputs.inflow].explanation)
        self._infinite.visible = inputs.inflow in (FOUR, INFINITE)
        self._infinite.value = inputs.inflow == INFINITE

    def show_range(self, field: Field, colour_range: tuple[float, float], faded: bool) -> None:
        """The colour bar and legend of a field."""
        self._bar.content = colour_bar(field, *colour_range, faded)
        self._legend.content = outline_legend(field)

    def allow_difference(self, allowed: bool) -> None:
        """Whether there is a pinned design that the disk can show the difference from."""
        if not allowed and self._difference.value:
            self._difference.value = False
        self._difference.visible = allowed

    def _sliders(self, gui: viser.GuiApi, names: tuple[str, ...]) -> None:
        for name in names:
            s = SLIDERS[name]
            value = min(max(float(getattr(self._start, name)), s.low), s.high)
            self._inputs[name] = self._watched(gui.add_slider(s.label, s.low, s.high, s.step, value, hint=s.hint))

    def _watched(self, handle: Any) -> Any:
        handle.on_update(lambda _: self._moved())
        return handle

    def _seen(self, handle: Any) -> Any:
        """The same for what is only shown: it is no movement of the design."""
        handle.on_update(lambda _: self._changed())
        return handle

    def _moved(self) -> None:
        self.pauses.moved(time.monotonic())
        self._changed()

    def _preset_changed(self, event: viser.GuiEvent[Any]) -> None:
        if event.client is not None:  # Not when the reset button moved it.
            self._inputs["inflow"].value = self._inflows[preset_inflow(self.inputs().preset)]

    def _infinite_changed(self, event: viser.GuiEvent[Any]) -> None:
        if event.client is not None:  # Not when the menu moved it.
            self._inputs["inflow"].value = self._inflows[INFINITE if event.target.value else FOUR]


def _laws_of(inputs: Inputs) -> dict[str, str]:
    """The menu of laws: those that are not always there only where `inputs` hold them."""
    return {key: law.title for key, law in LAWS.items() if key not in NOT_ALWAYS or getattr(inputs, key) is not None}


def _key(titles: dict[str, str], title: str) -> str:
    return next(key for key, value in titles.items() if value == title)
