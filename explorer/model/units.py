"""The units of the page: SI, or aviation units. Everything inside the program is SI."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from rotor import Aircraft
from rotor.design.aircraft import SEA_LEVEL_DENSITY
from rotor.design.design import Design
from rotor.design.quantities import NUMBERS
from rotor.design.quantity import Quantity, Slider
from rotor.support import units

BLANK = "–"
"""Shown in place of a missing number."""


def number(value: float | None, digits: int = 0, sign: bool = False) -> str:
    """A number with a thin space between thousands and a true minus; a dash for None, NaN and infinity."""
    if value is None or not math.isfinite(value):
        return BLANK
    text = f"{value:{'+' if sign else ''},.{digits}f}".replace(",", "\u2009").replace("-", "−")
    # A value that rounds to zero has no sign.
    return text.lstrip("+−") if not any(digit in text for digit in "123456789") else text


def adding(values: Sequence[float], digits: int = 0) -> list[float]:
    """Values rounded so that they add up to their rounded sum: what is then left goes where it makes the least error,
    and only where there is nothing else to what rounds to zero."""
    scaled = [10.0**digits * value for value in values]
    whole = [round(value) for value in scaled]
    left = round(sum(scaled)) - sum(whole)
    step = 1 if left > 0 else -1
    for _ in range(abs(left)):
        k = min(
            range(len(whole)),
            key=lambda k: (abs(scaled[k]) < 0.5, abs(whole[k] + step - scaled[k])),
        )
        whole[k] += step
    return [value / 10.0**digits for value in whole]


def degrees(angle: float, digits: int = 2) -> str:
    """An angle [rad] in degrees."""
    return f"{number(math.degrees(angle), digits)}°"


@dataclass(frozen=True)
class Unit:
    """A unit on the page."""

    symbol: str
    size: float
    """One of it in SI."""

    def of(self, value: float) -> float:
        """A value in SI, in this unit."""
        return value / self.size

    def text(self, value: float | None, digits: int = 0, sign: bool = False) -> str:
        """A value in SI, with the symbol."""
        return f"{number(None if value is None else self.of(value), digits, sign)} {self.symbol}"


def form_of(row: Quantity, units: "Units") -> Slider:
    """How a row's number is shown in these units; ValueError for a row without a slider."""
    form = row.aviation if units.title == AVIATION.title and row.aviation else row.slider
    if form is None:
        raise ValueError(f"{row.name} has no slider: show it as a text")
    return form


def shown(row: Quantity, value: float, units: "Units") -> float:
    """The place of an input on its slider, in the unit shown."""
    return value if row.aviation is None else value * row.input_size / form_of(row, units).size


def slider_input(row: Quantity, place: float, units: "Units") -> float:
    """The input, in the unit of its name, that a place on the slider means, to nine decimals."""
    return (
        place
        if row.aviation is None
        else round(place * form_of(row, units).size / row.input_size, 9)
    )


WATT, KILOWATT, HORSEPOWER = Unit("W", 1.0), Unit("kW", 1e3), Unit("hp", 745.699872)
"""[W]; the mechanical horsepower, 550 ft·lbf/s."""
METRE_PER_SECOND, KILOMETRE_PER_HOUR, KNOT = (
    Unit("m/s", 1.0),
    Unit("km/h", 1.0 / 3.6),
    Unit("kt", units.KNOT),
)
TONNE, POUND = Unit("t", 1e3), Unit("lb", 0.45359237)
METRE, FOOT = Unit("m", 1.0), Unit("ft", 0.3048)
FOOT_PER_MINUTE = Unit("ft/min", 0.3048 / 60.0)


@dataclass(frozen=True)
class Units:
    """A choice of units, the main unit of each quantity first."""

    title: str
    power: tuple[Unit, Unit]
    """The main unit, and the one shown small beside it."""
    speed: tuple[Unit, Unit, Unit]
    mass: Unit
    altitude: Unit
    climb: Unit

    def watts(self, value: float | None, digits: int = 0, sign: bool = False) -> str:
        """A power [W] in the main unit."""
        return self.power[0].text(value, digits, sign)

    def other_watts(self, value: float) -> str:
        """A power [W] in the other unit, with hundredths where the main one is the watt."""
        return self.power[1].text(value, 2 if self.power[0] is WATT else 0)

    def in_sliders(self, sentence: str, carried: float = 0.0) -> str:
        """A sentence with its masses [kg] in the unit of the slider, never rounded up: more may not trim. `carried`:
        mass of an actuator [kg], which the sentence counts and the slider does not."""
        digits = 2 if self.mass is TONNE else 0
        step = self.mass.size / 10.0**digits

        def mass(found: re.Match[str]) -> str:
            return self.mass.text(step * math.floor((float(found[1]) - carried) / step), digits)

        return re.sub(r"(\d+) kg\b", mass, sentence)

    def in_power_unit(self, sentence: str) -> str:
        """A sentence with its powers, in W or kW, in the main unit, to as many decimals."""

        def power(found: re.Match[str]) -> str:
            watts = float(found[1]) * (1e3 if found[3] else 1.0)
            return self.watts(watts, len(found[2] or ".") - 1)

        return re.sub(r"(\d+(\.\d+)?) (k?)W\b", power, sentence)

    def in_words(self, row: Quantity, value: float) -> str:
        """A number in the unit of its name, in words: `climb 5.0 m/s`, `descent 3.0 m/s`; empty at its default."""
        if value == row.default:
            return ""
        if row.slider is None:
            return row.in_words(value)
        form, falls = form_of(row, self), bool(row.below) and value < 0.0
        unit = Unit(form.unit or row.unit, form.size)
        return f"{row.below if falls else row.short} {unit.text(abs(value) if falls else value, form.digits)}"

    def unusual(self, design: Design) -> list[str]:
        """What is not as in most flights, in words."""
        return [self.in_words(NUMBERS[name], value) for name, value in design.unusual.items()]

    def airspeed(self, value: float) -> str:
        """A speed [m/s] in all three units; `hover` for zero."""
        if value == 0.0:
            return "hover"
        return " · ".join(
            unit.text(value, 1 if unit is METRE_PER_SECOND else 0) for unit in self.speed
        )


SI = Units(
    "SI",
    (KILOWATT, HORSEPOWER),
    (KILOMETRE_PER_HOUR, METRE_PER_SECOND, KNOT),
    TONNE,
    METRE,
    METRE_PER_SECOND,
)
AVIATION = Units(
    "Aviation",
    (HORSEPOWER, KILOWATT),
    (KNOT, KILOMETRE_PER_HOUR, METRE_PER_SECOND),
    POUND,
    FOOT,
    FOOT_PER_MINUTE,
)
UNITS = {units.title: units for units in (SI, AVIATION)}
_SMALL = {title: replace(units, power=(WATT, HORSEPOWER)) for title, units in UNITS.items()}


def units_of(title: str, aircraft: Aircraft) -> Units:
    """The units of this title; powers are in W for a rotor that ideally hovers with less than 1 kW at sea level."""
    weight = aircraft.mass * units.GRAVITY
    ideal = weight * math.sqrt(weight / (2.0 * SEA_LEVEL_DENSITY * aircraft.rotor.disk_area))
    return (_SMALL if units.power_unit(ideal)[0] == WATT.symbol else UNITS)[title]
