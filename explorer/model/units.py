"""The units of the page: SI, or aviation units. Everything inside the program is SI."""

import math
from dataclasses import dataclass

from rotor import units

BLANK = "–"
"""Shown in place of a missing number."""


def number(value: float | None, digits: int = 0, sign: bool = False) -> str:
    """A number with a thin space between thousands and a true minus; a dash for None, NaN and infinity."""
    if value is None or not math.isfinite(value):
        return BLANK
    text = f"{value:{'+' if sign else ''},.{digits}f}".replace(",", "\u2009").replace("-", "−")
    # A value that rounds to zero has no sign.
    return text.lstrip("+−") if not any(digit in text for digit in "123456789") else text


def degrees(angle: float, digits: int = 2) -> str:
    """An angle [rad] in degrees."""
    return f"{number(math.degrees(angle), digits)}°"


@dataclass(frozen=True)
class Unit:
    symbol: str
    size: float
    """In SI."""

    def of(self, value: float) -> float:
        """A value in SI, in this unit."""
        return value / self.size

    def text(self, value: float | None, digits: int = 0, sign: bool = False) -> str:
        """A value in SI, with the symbol."""
        return f"{number(None if value is None else self.of(value), digits, sign)} {self.symbol}"


KILOWATT, HORSEPOWER = Unit("kW", 1e3), Unit("hp", 745.699872)
"""[W]; the mechanical horsepower, 550 ft·lbf/s."""
METRE_PER_SECOND, KILOMETRE_PER_HOUR, KNOT = Unit("m/s", 1.0), Unit("km/h", 1.0 / 3.6), Unit("kt", units.KNOT)
KILOGRAM, TONNE, POUND = Unit("kg", 1.0), Unit("t", 1e3), Unit("lb", 0.45359237)
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

    def climb_rate(self, value: float) -> str:
        """A rate of climb [m/s] in words, `climb 5.0 m/s` or `descent 3.0 m/s`; empty for level flight."""
        if value == 0.0:
            return ""
        digits = 1 if self.climb is METRE_PER_SECOND else 0
        return f"{'climb' if value > 0.0 else 'descent'} {self.climb.text(abs(value), digits)}"

    def airspeed(self, value: float) -> str:
        """A speed [m/s] in all three units; `hover` for zero."""
        if value == 0.0:
            return "hover"
        return " · ".join(unit.text(value, 1 if unit is METRE_PER_SECOND else 0) for unit in self.speed)


SI = Units("SI", (KILOWATT, HORSEPOWER), (KILOMETRE_PER_HOUR, METRE_PER_SECOND, KNOT), TONNE, METRE, METRE_PER_SECOND)
AVIATION = Units(
    "Aviation", (HORSEPOWER, KILOWATT), (KNOT, KILOMETRE_PER_HOUR, METRE_PER_SECOND), POUND, FOOT, FOOT_PER_MINUTE
)
UNITS = {units.title: units for units in (SI, AVIATION)}
