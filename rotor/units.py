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


def degrees_text(angle: float) -> str:
    """The shortest number of degrees that is `angle` [rad] again; all digits where none is."""
    exact = math.degrees(angle)
    rounded = (round(exact, digits) for digits in range(15))
    return digits_text(next((value for value in rounded if math.radians(value) == angle), exact) + 0.0)


def typographic(text: str) -> str:
    """Replace a hyphen before a number by a minus sign."""
    return re.sub(r"(?<![\w.\-])-(?=\d)", "−", text)


def digits_text(value: float) -> str:
    """All digits of a number, without a needless .0."""
    return repr(int(value)) if value == int(value) else repr(float(value))
