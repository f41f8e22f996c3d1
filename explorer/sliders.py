"""The sliders of the Design tab: what each can hold, and how weight, altitude and rate of climb read in other units."""

import math
from dataclasses import dataclass, replace

from explorer.state import mass_range
from explorer.text.units import AVIATION, POUND, SI, Unit, Units
from rotor.assets import SHIPPED_ROTORS
from rotor.design.aircraft import FASTEST_CLIMB, Aircraft
from rotor.files.rotor_file import shipped_aircraft


@dataclass(frozen=True)
class Slider:
    """A slider as it is shown."""

    label: str
    low: float
    high: float
    step: float

    @property
    def digits(self) -> int:
        """Decimals that tell two steps apart."""
        return max(0, -math.floor(math.log10(self.step)))


def _weight(aircraft: Aircraft, units: Units) -> Slider:
    """About the aircraft's reference mass: in tonnes round numbers, in pounds those that reach as far."""
    low, high, step = mass_range(aircraft)
    if units is not AVIATION:
        return Slider("Mass [t]", low, high, step)
    coarse = 100.0 if high > 4.0 else 10.0
    ends = (math.floor(POUND.of(1e3 * low) / coarse), math.ceil(POUND.of(1e3 * high) / coarse))
    return Slider("Mass [lb]", coarse * ends[0], coarse * ends[1], coarse)


_FIRST = shipped_aircraft(SHIPPED_ROTORS[0])
SLIDERS: dict[str, Slider] = {
    "built_inner": Slider("Δ inboard [°/R]", -20.0, 20.0, 0.1),
    "built_outer": Slider("Δ outboard [°/R]", -20.0, 20.0, 0.1),
    "built_division": Slider("Break point [r/R]", 0.2, 0.95, 0.01),
    "linear": Slider("Rate [°/R]", -30.0, 10.0, 0.1),
    "quadratic_curvature": Slider("Curvature [°/R²]", -40.0, 40.0, 0.5),
    "quadratic_difference": Slider("Tip−root [°]", -30.0, 10.0, 0.1),
    "two_inner": Slider("Inboard [°/R]", -30.0, 10.0, 0.1),
    "two_outer": Slider("Outboard [°/R]", -30.0, 10.0, 0.1),
    "two_division": Slider("Break point [r/R]", 0.2, 0.95, 0.01),
    "three_inner": Slider("Inboard [°/R]", -30.0, 10.0, 0.1),
    "three_middle": Slider("Middle [°/R]", -30.0, 10.0, 0.1),
    "three_outer": Slider("Outboard [°/R]", -30.0, 10.0, 0.1),
    "three_first": Slider("Break 1 [r/R]", 0.2, 0.95, 0.01),
    "three_second": Slider("Break 2 [r/R]", 0.2, 0.95, 0.01),
    "advance_ratio": Slider("Adv. ratio µ", 0.0, 0.45, 0.005),
    "mass_t": _weight(_FIRST, SI),
    "altitude_m": Slider("Altitude [m]", 0.0, 4000.0, 50.0),
    "climb_m_s": Slider("Climb [m/s]", -FASTEST_CLIMB, FASTEST_CLIMB, 0.1),
}
"""By the field of `Inputs`, in SI; the weight is the first rotor's."""
_AVIATION = {
    "mass_t": _weight(_FIRST, AVIATION),
    "altitude_m": Slider("Altitude [ft]", 0.0, 13_200.0, 100.0),
    "climb_m_s": Slider("Climb [ft/min]", -3900.0, 3900.0, 50.0),
}
_SIZES = {"mass_t": 1e3, "altitude_m": 1.0, "climb_m_s": 1.0}
"""What one of the input is in SI."""


def slider(name: str, units: Units, aircraft: Aircraft = _FIRST) -> Slider:
    """As it is shown in these units, for this aircraft."""
    if name == "mass_t":
        return _weight(aircraft, units)
    if name == "advance_ratio" and aircraft.isolated:
        return replace(SLIDERS[name], high=0.75)
    return _AVIATION[name] if units is AVIATION and name in _AVIATION else SLIDERS[name]


def shown(name: str, value: float, units: Units) -> float:
    """The place of an input on its slider."""
    if name not in _SIZES:
        return value
    return _unit(name, units).of(value * _SIZES[name])


def meant(name: str, place: float, units: Units) -> float:
    """The input that a place means. To nine digits, so that an input shown in other units and read again is itself."""
    if name not in _SIZES:
        return place
    return round(place * _unit(name, units).size / _SIZES[name], 9)


def _unit(name: str, units: Units) -> Unit:
    return {"mass_t": units.mass, "altitude_m": units.altitude, "climb_m_s": units.climb}[name]


def limits(name: str, aircraft: Aircraft = _FIRST) -> tuple[float, float]:
    """What the slider can hold in whichever units are shown."""
    one, other = slider(name, SI, aircraft), slider(name, AVIATION, aircraft)
    if name not in _AVIATION:
        return one.low, one.high
    low, high = meant(name, other.low, AVIATION), meant(name, other.high, AVIATION)
    return min(one.low, low), max(one.high, high)
