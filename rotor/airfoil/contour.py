"""Section contours: bundled outlines, NACA formulas, chord line, and resampling for lofting.

Order everywhere: from the upper trailing edge forward around the nose to the lower trailing edge, in chord lengths, x
aft from the leading edge, y up. The trailing-edge gap of the real sections is kept.

NACA thickness and four-digit camber: Jacobs, Ward and Pinkerton, NACA Report 460 (1933). Five-digit camber: Jacobs and
Pinkerton, NACA Report 537 (1935), m and k1 from its table. The blunt trailing edge (0.252 % of chord for 12 %) is
kept.
"""

import re
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import numpy as np
import scipy

from rotor.airfoil.coordinates import read_coordinates
from rotor.support.arrays import Array, read_only
from rotor.support.assets import asset_path

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
    """Whether `naca_points` has a formula for `name`, such as naca0012, naca2412 or naca23012."""
    match = re.fullmatch(r"naca(\d{4}|\d{5})", name)
    return (
        match is not None
        and (len(match[1]) == 4 or match[1][1:3] in _FIVE_DIGIT)
        and int(match[1][-2:]) > 0
    )


def naca_points(name: str) -> Array:
    """The outline of `naca0012`, `naca23012` and the like [chord], (POINTS, 2), from the upper trailing edge forward.

    Raises ValueError for a name outside the two families.
    """
    if not is_naca(name):
        raise ValueError(
            f"{name!r} is not a four- or five-digit NACA section: write for example naca0012 or naca23012"
        )
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


_SIX_SERIES = ("naca63a015", "naca64208", "naca64118", "naca64528", "naca64935")
_TABBED = ("naca23012tab", "naca23012tab-model")
SECTION_NAMES = (
    "sc1095",
    "sc1094r8",
    "naca0012",
    *_SIX_SERIES,
    "goe429",
    "naca0015re242k",
    "oa209",
    *_TABBED,
)
_OUTLINES = {"naca23012tab-model": "naca23012tab"}
"""Outlines of sections that have that of another: the same at another Reynolds number."""


@dataclass(frozen=True, eq=False)
class Contour:
    """A section outline; the trailing-edge gap, if any, closes it.

    `points` has shape (n, 2): x aft and y up in chord lengths [-], upper trailing edge first.
    """

    name: str
    points: Array
    moved: str = ""
    """What was done to a file's points to bring them to x 0 to 1."""


def read_contour(path: Path, name: str | None = None) -> Contour:
    """Read a coordinate file, see `parse_contour`."""
    return replace(
        parse_contour(path.read_text(encoding="utf-8"), path.name), name=name or path.stem
    )


def parse_contour(text: str, name: str) -> Contour:
    """The outline in a coordinate file, see `read_coordinates`."""
    return Contour(name, *read_coordinates(text, name))


@lru_cache(maxsize=32)
@read_only
def load_contour(name: str) -> Contour:
    """The bundled outline of `name`, one of `SECTION_NAMES`, or a NACA outline of four or five digits by formula.

    Sources: `assets/airfoils/CITATION.md`. ValueError for another name.
    """
    if name not in SECTION_NAMES:
        if is_naca(name):
            return Contour(name, naca_points(name))
        raise ValueError(
            f"no outline named {name!r}: choose one of {', '.join(SECTION_NAMES)} or a NACA section such as naca23012"
        )
    return read_contour(asset_path(f"airfoils/{_OUTLINES.get(name, name)}.contour"), name)


def trailing_edge(contour: Contour) -> Array:
    """Middle of the trailing-edge gap, shape (2,) [chord]."""
    return 0.5 * (contour.points[0] + contour.points[-1])


def leading_edge_index(contour: Contour) -> int:
    """Index of the nose, the outline point farthest from the trailing edge."""
    return int(np.argmax(np.hypot(*(contour.points - trailing_edge(contour)).T)))


def thickness_and_camber(contour: Contour) -> tuple[float, float, float]:
    """Largest thickness, its x, and largest camber, all in chord lengths, measured across the x axis."""
    nose = leading_edge_index(contour)
    x = np.linspace(0.0, 1.0, 501)
    upper = np.interp(x, contour.points[nose::-1, 0], contour.points[nose::-1, 1])
    lower = np.interp(x, contour.points[nose:, 0], contour.points[nose:, 1])
    thickest = int(np.argmax(upper - lower))
    return (
        float(upper[thickest] - lower[thickest]),
        float(x[thickest]),
        float(np.max(np.abs(upper + lower)) / 2),
    )


def resample(contour: Contour, n: int) -> Contour:
    """An outline on `n` points (odd, at least 11, else ValueError), so that sections blend point by point.

    Each side gets (n + 1) / 2 points, cosine-spaced in arc length (dense at nose and trailing edge);
    point (n - 1) / 2 is the nose on every section. Cubic splines through the given points carry the shape.
    """
    if n < 11 or n % 2 == 0:
        raise ValueError(
            f"{n} points do not put one at the nose: give an odd number of at least 11"
        )
    steps = np.hypot(*np.diff(contour.points, axis=0).T)
    arc = np.concatenate(([0.0], np.cumsum(steps)))
    nose = arc[leading_edge_index(contour)]
    fraction = 0.5 * (1.0 - np.cos(np.linspace(0.0, np.pi, (n + 1) // 2)))
    where = np.concatenate((nose * fraction, nose + (arc[-1] - nose) * fraction[1:]))
    spline = scipy.interpolate.CubicSpline(arc, contour.points, axis=0)
    return Contour(contour.name, np.asarray(spline(where), dtype=np.float64))
