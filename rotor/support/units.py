"""Units, physical constants and numbers in print, as several folders need them. Everything inside `rotor` is SI."""

import math
import re

KNOT = 1852.0 / 3600.0
"""One knot [m/s], exact."""
FOOT = 0.3048
"""[m], exact."""
POUND = 0.45359237
"""[kg], exact."""
GRAVITY = 9.80665
"""Standard gravity [m/s²] (ISO 2533)."""


_UNITS = {
    "_deg": "°",
    "_percent": "%",
    "_kt": "kt",
    "_kg": "kg",
    "_m": "m",
    "_m_s": "m/s",
    "_n": "N",
    "_nm": "N m",
    "_w": "W",
    "_kw": "kW",
    "_deg_per_r": "°/R",
    "_ms": "ms",
    "_per_rev": "/rev",
}


def unit_of(name: str) -> str:
    """The unit in which the key of a file, or the column of a table, ends; empty without one. Quantities say theirs."""
    return next((unit for end, unit in _UNITS.items() if name.endswith(end)), "")


KILOWATT = ("kW", 1e3)
"""Symbol and size [W]."""


def power_unit(*powers: float) -> tuple[str, float]:
    """Symbol and size [W] of the unit in which powers [W] stand side by side: W where all are below 1 kW, else kW."""
    return ("W", 1.0) if max(map(abs, powers), default=0.0) < 1e3 else KILOWATT


def power_text(power: float, digits: int = 0) -> str:
    """A power [W] in words: `901 kW`, `412 W`."""
    symbol, size = power_unit(power)
    return f"{power / size:z.{digits}f} {symbol}"


def seconds_text(seconds: float) -> str:
    """A duration in words: `440 s`, `4.2 s`."""
    digits = 0 if seconds >= 9.95 else 1
    return f"{seconds:.{digits}f} s"


def degrees_text(angle: float) -> str:
    """The shortest number of degrees that is `angle` [rad] again; all digits where none is."""
    exact = math.degrees(angle)
    rounded = (round(exact, digits) for digits in range(15))
    return digits_text(next((value for value in rounded if math.radians(value) == angle), exact))


def typographic(text: str) -> str:
    """Replace a hyphen before a number by a minus sign."""
    return re.sub(r"(?<![\w.\-])-(?=\d)", "−", text)


def digits_text(value: float) -> str:
    """All digits of a number, without a needless .0."""
    return repr(int(value)) if value == int(value) else repr(float(value))
