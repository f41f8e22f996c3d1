"""Units: factors by hand, and sliders that read in pounds and feet without moving the design."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import viser

from explorer.model.inputs import ROWS, Inputs
from explorer.model.sliders import SLIDERS, limits, slider
from explorer.model.units import (
    AVIATION,
    HORSEPOWER,
    KNOT,
    SI,
    UNITS,
    WATT,
    form_of,
    shown,
    slider_input,
    units_of,
)
from explorer.text import readout
from explorer.text.design_words import flight_name
from explorer.widgets.controls import DesignControls
from explorer.widgets.form import WidgetForm
from rotor.design.quantity import Slider
from rotor.files.rotor_file import shipped_aircraft
from rotor.trim.solution import Solution


def test_factors_by_definition():
    """550 ft·lbf/s, 1852 m/h, the international pound and foot."""
    assert HORSEPOWER.size == pytest.approx(550.0 * 0.3048 * 0.45359237 * 9.80665, rel=1e-9)
    assert KNOT.size * 3600.0 == pytest.approx(1852.0)
    by_symbol = {"W": 1.0, "kW": 1000.0, "t": 1000.0, "m": 1.0, "lb": 0.45359237, "ft": 0.3048, "ft/min": 0.00508,
                 "m/s": 1.0, "km/h": 1000.0 / 3600.0}  # fmt: skip
    every = {
        unit
        for own in UNITS.values()
        for unit in (*own.power, *own.speed, own.mass, own.altitude, own.climb)
    }
    named = {unit.symbol: unit.size for unit in {*every, WATT} - {HORSEPOWER, KNOT}}
    assert named == pytest.approx(by_symbol, rel=1e-12)


def test_the_chosen_unit_comes_first(cruise: Solution):
    for units, first, second in ((SI, "kW", "hp"), (AVIATION, "hp", "kW")):
        html = readout.power_panel(cruise, None, units)
        assert html.index(f"{units.watts(cruise.power.total)}</span>") < html.index(
            f" {second}</span>"
        )
        assert f" {first}</td>" in html
        assert f" {second}</td>" not in html
        both = readout.compared_power_panel(cruise, cruise, units)
        assert f"Δ {first}" in both
        assert f"Δ {second}" not in both
    assert AVIATION.airspeed(50.0) == "97 kt · 180 km/h · 50.0 m/s"
    assert SI.airspeed(50.0) == "180 km/h · 50.0 m/s · 97 kt"
    assert SI.airspeed(0.0) == "hover"


def test_names_say_the_flight_in_the_chosen_units_and_what_is_off():
    inputs = Inputs(mass_t=9.0, altitude_m=1524.0, flapping=False, hub_loss=False)
    assert flight_name(inputs) == "µ 0.2, 9 t, 1\u2009524 m, no flapping, no root loss"
    assert (
        flight_name(Inputs(altitude_m=1524.0), AVIATION) == "µ 0.2, 18\u2009348 lb, 5\u2009000 ft"
    )
    assert flight_name(Inputs(climb_m_s=5.0)) == "µ 0.2, climb 5.0 m/s, 8.32 t"
    assert (
        flight_name(Inputs(climb_m_s=-2.54), AVIATION)
        == "µ 0.2, descent 500 ft/min, 18\u2009348 lb"
    )
    assert flight_name(Inputs(climb_m_s=5.0, preset="thesis")) == "µ 0.2, 8.32 t"


@pytest.mark.parametrize("name", ["mass_t", "altitude_m", "climb_m_s"])
def test_an_input_is_itself_after_other_units(name: str):
    row = ROWS[name]
    for value in np.linspace(*limits(name), 173):
        kept = round(float(value), 6)
        assert slider_input(row, shown(row, kept, AVIATION), AVIATION) == kept
    low, high = limits(name)
    for units in UNITS.values():
        form = slider(name, units)
        assert (
            low <= slider_input(row, form.low, units) <= slider_input(row, form.high, units) <= high
        )
    assert slider("linear", AVIATION) is SLIDERS["linear"]


class TestControls:
    def test_units_move_the_sliders_and_not_the_design(self, controls: DesignControls):
        wanted = Inputs(mass_t=9.05, altitude_m=1550.0)
        controls.set_inputs(wanted)
        controls.refresh(wanted, UNITS["Aviation"])
        assert controls.inputs() == wanted
        handle = controls.form._handles["mass_t"]
        assert handle.value == pytest.approx(9050.0 / 0.45359237)
        assert handle.label == "Mass [lb]"
        controls.set_inputs(replace(wanted, altitude_m=3048.0))
        assert controls.form._handles["altitude_m"].value == pytest.approx(10_000.0)
        controls.refresh(wanted, SI)
        assert controls.inputs() == replace(wanted, altitude_m=3048.0)
        assert handle.value == 9.05


def test_a_model_rotor_has_watts_and_a_propeller_climbs():
    """Knight and Hefner's rotor carries 58 N at C_T/σ 0.07: √(58³/(2·1.225·1.824)) is 209 W."""
    model, uh60a = shipped_aircraft("knight-hefner-3"), shipped_aircraft("uh60a")
    for title, units in UNITS.items():
        small = units_of(title, model)
        assert (units_of(title, uh60a), small.power[0].symbol) == (units, "W")
        assert (small.other_watts(233.0), SI.other_watts(149e3)) == ("0.31 hp", "200 hp")
        assert (small.watts(100.2), small.mass) == ("100 W", units.mass)
        assert slider_input(
            ROWS["climb_m_s"], slider("climb_m_s", small, model).high, small
        ) == pytest.approx(100.0)
    for ideal, symbol in ((998.0, "W"), (1002.0, "kW")):
        weight = (ideal * math.sqrt(2.0 * 1.225 * math.pi * model.rotor.radius**2)) ** (2.0 / 3.0)
        assert units_of("SI", replace(model, mass=weight / 9.80665)).power[0].symbol == symbol
    assert flight_name(Inputs(isa_offset_c=-10.0), AVIATION).startswith("µ 0.2, ISA − 10 °C, ")


# A form on a server without a page


@pytest.fixture
def moved() -> list[tuple[str, bool]]:
    return []


@pytest.fixture
def form(server: viser.ViserServer, moved: list[tuple[str, bool]]) -> WidgetForm:
    form = WidgetForm(server.gui, lambda name, by_hand: moved.append((name, by_hand)), ROWS)
    form.slider("altitude_m", form_of(ROWS["altitude_m"], SI), 500.0, below="<b></b>")
    form.menu("preset", "Preset", {"flight": "Best", "thesis": "Thesis"}, "thesis")
    form.span("span", "Span", (0.0, 1.0), (0.2, 0.8), 0.1)
    form.box("fuselage", "Drag", True)
    return form


def test_values_are_those_of_the_inputs(form: WidgetForm, moved: list[tuple[str, bool]]):
    values = {"altitude_m": 500.0, "preset": "thesis", "span": (0.2, 0.8), "fuselage": True}
    assert form.values() == values
    form.place("preset", "thesis")  # It is there already.
    assert moved == []
    form.place("preset", "flight")
    assert form["preset"] == "flight"
    assert moved == [("preset", False)]
    form.offer("preset", {"flight": "As flown"}, "flight")
    assert (form._handles["preset"].value, form["preset"]) == ("As flown", "flight")


@pytest.mark.parametrize("value", [1234.567890123456, 500.0, 3000.1])
def test_a_value_that_no_hand_moved_is_kept_in_all_digits(form: WidgetForm, value: float):
    form.place("altitude_m", value)
    for units in (AVIATION, SI):
        form.translate(units, lambda name, units=units: form_of(ROWS[name], units))
        assert form["altitude_m"] == value
    form._handles["altitude_m"].value = 1250.0
    assert form["altitude_m"] == 1250.0


@pytest.mark.parametrize(
    ("low", "high", "value"), [(9000.0, 9500.0, 9100.0), (-900.0, -100.0, -200.0), (0.0, 9.0, 4.0)]
)
def test_a_slider_with_other_ends_never_has_its_value_outside(
    form: WidgetForm, low: float, high: float, value: float
):
    handle, seen = form._handles["altitude_m"], []
    handle.on_update(lambda event: seen.append((handle.min, event.target.value, handle.max)))
    form.fit("altitude_m", Slider("Altitude [m]", low, high, 1.0), value)
    assert (handle.min, handle.value, handle.max) == (low, value, high)
    assert all(least <= place <= most for least, place, most in seen)


def test_widgets_are_hidden_by_name(form: WidgetForm):
    handles: dict[str, Any] = form._handles
    form.show({"altitude_m": False})
    assert not handles["altitude_m"].visible
    assert not form._below["altitude_m"].visible
    assert handles["preset"].visible
