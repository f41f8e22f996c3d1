"""A design in a few words: what its twist is and where it flies, for strips, lists and notes."""

from explorer.state import LAWS, Inputs
from explorer.text.units import SI, Units, number
from rotor.aero.switches import SWITCHES
from rotor.assets import SHIPPED_ROTORS

_SHAPES = {
    "linear": ("linear",),
    "quadratic": ("quadratic_curvature", "quadratic_difference"),
    "two": ("two_inner", "two_outer"),
    "three": ("three_inner", "three_middle", "three_outer"),
}
_PLACES = {"two": ("two_division",), "three": ("three_first", "three_second")}


def twist_name(inputs: Inputs) -> str:
    """The twist: `Two segments −14/−8 at 0.5`, and before it the rotor where it is not the page's first."""
    values = "/".join(number(getattr(inputs, name), 1).removesuffix(".0") for name in _SHAPES.get(inputs.law, ()))
    places = "/".join(f"{getattr(inputs, name):g}" for name in _PLACES.get(inputs.law, ()))
    name = LAWS[inputs.law].title
    if values:
        name += f" {values}" + ("°" if inputs.law == "linear" else "")
    rotor = "" if inputs.rotor == SHIPPED_ROTORS[0] else f"{inputs.aircraft.name}, "
    return rotor + name + (f" at {places}" if places else "")


def flight_name(inputs: Inputs, units: Units = SI) -> str:
    """The flight: `µ 0.25, 8.32 t`, the altitude where it is not sea level, and what of the physics is switched off."""
    speed = f"µ {inputs.advance_ratio:g}" if inputs.advance_ratio else "hover"
    high = f", {units.altitude.text(inputs.altitude_m)}" if inputs.altitude_m else ""
    mass = f"{inputs.mass_t:g} t" if units is SI else units.mass.text(1e3 * inputs.mass_t)
    off = "".join(f", no {switch.title.lower()}" for name, switch in SWITCHES.items() if not getattr(inputs, name))
    return f"{speed}, {mass}{high}{off}"
