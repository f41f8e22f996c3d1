"""Outlines of the NACA four- and five-digit families from their formulas.

Thickness and four-digit camber: Jacobs, Ward and Pinkerton, NACA Report 460 (1933); five-digit camber:
Jacobs and Pinkerton, NACA Report 537 (1935), whose m and k1 are tabulated for the camber's place. The blunt
trailing edge of the formula (0.252 % of chord for 12 %) is kept.
"""

import re

import numpy as np

from rotor.arrays import Array

POINTS = 161
_THICKNESS = (0.2969, -0.1260, -0.3516, 0.2843, -0.1015)
_FIVE_DIGIT = {  # Middle digits: where the camber is: (m, k1) for a design lift coefficient of 0.3.
    "10": (0.0580, 361.4),
    "20": (0.1260, 51.64),
    "30": (0.2025, 15.957),
    "40": (0.2900, 6.643),
    "50": (0.3910, 3.230),
}


def is_naca(name: str) -> bool:
    """Whether `naca_points` can draw `name`: naca0012, naca2412, naca23012."""
    found = re.fullmatch(r"naca(\d{4}|\d{5})", name)
    return found is not None and (len(found[1]) == 4 or found[1][1:3] in _FIVE_DIGIT) and int(found[1][-2:]) > 0


def naca_points(name: str) -> Array:
    """The outline of `naca0012`, `naca23012` and the like [chord], (POINTS, 2), from the upper trailing edge forward.

    Raises ValueError for a name outside the two families.
    """
    if not is_naca(name):
        raise ValueError(f"{name!r} is no NACA section of four or five digits: write for example naca0012 or naca23012")
    digits = name.removeprefix("naca")
    x = 0.5 * (1.0 - np.cos(np.linspace(0.0, np.pi, (POINTS + 1) // 2)))
    roots = np.stack([np.sqrt(x), x, x**2, x**3, x**4])
    half = int(digits[-2:]) / 20.0 * (np.array(_THICKNESS) @ roots)
    camber, slope = _four_digit(digits, x) if len(digits) == 4 else _five_digit(digits, x)
    angle = np.arctan(slope)
    upper = np.stack((x - half * np.sin(angle), camber + half * np.cos(angle)), axis=1)
    lower = np.stack((x + half * np.sin(angle), camber - half * np.cos(angle)), axis=1)
    return np.concatenate((upper[::-1], lower[1:]))


def _four_digit(digits: str, x: Array) -> tuple[Array, Array]:
    """Camber line and its slope: two parabolas that meet at the largest camber."""
    most, place = int(digits[0]) / 100.0, int(digits[1]) / 10.0
    if most == 0.0 or place == 0.0:
        return np.zeros_like(x), np.zeros_like(x)
    share = np.where(x < place, most / place**2, most / (1.0 - place) ** 2)
    rest = np.where(x < place, 0.0, 1.0 - 2.0 * place)
    return share * (rest + 2.0 * place * x - x**2), 2.0 * share * (place - x)


def _five_digit(digits: str, x: Array) -> tuple[Array, Array]:
    """Camber line and its slope: a cubic to x = m, straight behind; scales with the design lift, 0.15 times a digit."""
    m, k1 = _FIVE_DIGIT[digits[1:3]]
    k1 *= int(digits[0]) * 0.15 / 0.3
    front = x < m
    camber = np.where(front, x**3 - 3.0 * m * x**2 + m**2 * (3.0 - m) * x, m**3 * (1.0 - x))
    slope = np.where(front, 3.0 * x**2 - 6.0 * m * x + m**2 * (3.0 - m), -(m**3))
    return k1 / 6.0 * camber, k1 / 6.0 * slope
