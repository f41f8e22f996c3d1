"""The flight condition: standard atmosphere, weight, advance ratio, and the drag of the airframe."""

import math
from dataclasses import dataclass
from numbers import Real

from rotor.units import GRAVITY, KNOT

SEA_LEVEL_TEMPERATURE = 288.15
"""[K] (ISO 2533)."""
SEA_LEVEL_DENSITY = 1.225
"""[kg/m³] (ISO 2533)."""
LAPSE_RATE = 0.0065
"""Troposphere temperature lapse [K/m] (ISO 2533)."""
GAS_CONSTANT = 287.05287
"""Specific gas constant of dry air [J/(kg K)] (ISO 2533)."""
RATIO_OF_SPECIFIC_HEATS = 1.4


@dataclass(frozen=True)
class FlightCondition:
    """Steady level flight, or hover when the advance ratio is zero."""

    advance_ratio: float
    """µ = V/(ΩR)."""
    mass: float
    """[kg]"""
    altitude: float = 0.0
    """Pressure altitude in the standard atmosphere [m]."""
    flap_1c: float = 0.0
    """Given longitudinal flapping β1c [rad], negative when the disk tilts back; used where cyclic trims flapping."""
    flap_1s: float = 0.0
    """Given lateral flapping β1s [rad]."""

    def __post_init__(self) -> None:
        _check("advance ratio", self.advance_ratio, 0.0, 0.6, "")
        _check("mass", self.mass, 100.0, 50_000.0, " kg")
        _check("altitude", self.altitude, -500.0, 8_000.0, " m")
        _check("flap_1c", self.flap_1c, -0.3, 0.3, " rad")
        _check("flap_1s", self.flap_1s, -0.3, 0.3, " rad")

    @property
    def weight(self) -> float:
        """[N]"""
        return self.mass * GRAVITY

    @property
    def density(self) -> float:
        """Air density [kg/m³], standard atmosphere."""
        exponent = GRAVITY / (GAS_CONSTANT * LAPSE_RATE) - 1.0
        return SEA_LEVEL_DENSITY * self._temperature_ratio**exponent

    @property
    def sound_speed(self) -> float:
        """[m/s], standard atmosphere."""
        return math.sqrt(RATIO_OF_SPECIFIC_HEATS * GAS_CONSTANT * SEA_LEVEL_TEMPERATURE * self._temperature_ratio)

    @property
    def _temperature_ratio(self) -> float:
        return 1.0 - LAPSE_RATE * self.altitude / SEA_LEVEL_TEMPERATURE


@dataclass(frozen=True)
class Fuselage:
    """The airframe as a drag area: D = ½ρV² f_drag A_eq, eq. (3.19), with f_drag A_eq as one number."""

    drag_area: float
    """Equivalent flat-plate area f [m²]."""

    def drag(self, density: float, speed: float) -> float:
        """[N] at air density [kg/m³] and airspeed [m/s]."""
        return 0.5 * density * speed**2 * self.drag_area


def number(name: str, value: object, example: str) -> float:
    """The value as a float; TypeError with one sentence when it is not a real number."""
    if isinstance(value, bool) or not isinstance(value, Real):
        raise TypeError(f"{name} is {value!r}, not a number: write for example {name}={example}")
    return float(value)


def advance_ratio(
    tip_speed: float, mu: float | None, speed_kt: float | None, hover: bool, default: float | None = None
) -> float | None:
    """µ from whichever of the three arguments is given; `default` when none is. `tip_speed` is ΩR [m/s].

    Raises TypeError or ValueError with one sentence when more than one is given, or a value is not a number.
    """
    if hover not in (True, False):
        raise TypeError(f"hover is {hover!r}: write hover=True or leave it out")
    given = {"mu": mu, "speed_kt": speed_kt, "hover": hover or None}
    chosen = [f"{name}={value!r}" for name, value in given.items() if value is not None]
    if len(chosen) > 1:
        raise ValueError(f"{' and '.join(chosen)} each set the speed: give only one of mu, speed_kt and hover")
    if hover:
        return 0.0
    if speed_kt is not None:
        return number("speed_kt", speed_kt, "120") * KNOT / tip_speed
    return default if mu is None else number("mu", mu, "0.2")


def _check(name: str, value: float, low: float, high: float, unit: str) -> None:
    if not (math.isfinite(value) and low <= value <= high):
        raise ValueError(f"{name} {value:g}{unit} is outside {low:g}…{high:g}{unit}: choose a value inside")
