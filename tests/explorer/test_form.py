"""A form on a server without a page: values in and out, other units, other ends, what is shown and held."""

from typing import Any

import pytest
import viser

from explorer.model.inputs import ROWS
from explorer.model.units import AVIATION, SI, form_of
from explorer.tabs.form import WidgetForm
from rotor.design.quantity import Slider


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


def test_in_other_units_the_values_stay(form: WidgetForm):
    handle = form._handles["altitude_m"]
    form.translate(AVIATION, lambda name: form_of(ROWS[name], AVIATION))
    assert (handle.label, round(handle.value, 3), form["altitude_m"]) == ("Altitude [ft]", 1640.42, 500.0)
    form.place("altitude_m", 3048.0)
    assert handle.value == pytest.approx(10_000.0)
    form.translate(SI, lambda name: form_of(ROWS[name], SI))
    assert (handle.label, handle.value) == ("Altitude [m]", 3048.0)


@pytest.mark.parametrize(
    ("low", "high", "value"), [(9000.0, 9500.0, 9100.0), (-900.0, -100.0, -200.0), (0.0, 9.0, 4.0)]
)
def test_a_slider_with_other_ends_never_has_its_value_outside(form: WidgetForm, low: float, high: float, value: float):
    handle, seen = form._handles["altitude_m"], []
    handle.on_update(lambda event: seen.append((handle.min, event.target.value, handle.max)))
    form.fit("altitude_m", Slider("Altitude [m]", low, high, 1.0), value)
    assert (handle.min, handle.value, handle.max) == (low, value, high)
    assert all(least <= place <= most for least, place, most in seen)


def test_what_is_shown_and_held(form: WidgetForm):
    handles: dict[str, Any] = form._handles
    form.show({"altitude_m": False})
    assert not handles["altitude_m"].visible
    assert not form._below["altitude_m"].visible
    assert handles["preset"].visible
    form.hold(True)
    assert all(handle.disabled for handle in handles.values())
    form.disable({"preset": False})
    assert not handles["preset"].disabled
    assert handles["span"].disabled
