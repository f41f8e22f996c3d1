"""The map of power over two parameters of a concept: its trims, its drawing, and its least power in words."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, lru_cache

import numpy as np
from scipy.interpolate import RectBivariateSpline
from scipy.ndimage import binary_dilation

from explorer.charts import svg
from explorer.colours import NOW, colour_map, css
from explorer.model.units import Units, number
from explorer.picture.disk_image import encode_png
from explorer.text.readout import total_words
from explorer.workers.solver import MapLevel, MapTask
from rotor import Design
from rotor.design import TwistLaw
from rotor.optimisation import Concept, Parameter, nearest
from rotor.optimisation.descent import BAND
from rotor.support.arrays import Array
from rotor.support.chart import bar_ticks
from rotor.support.markup import Markup, group, tag

CONTOURS = (0.005, 0.01, 0.02, 0.04, 0.08)
"""Power above the least, as parts of it, at which lines are drawn; the colours end at the last."""
_LEFT, _TOP, _WIDE, _HIGH = 38.0, 6.0, 254.0, 190.0
"""Where the picture is in the drawing, which is 300 × 266."""
_SHARP = 2
"""Pixels of the picture for each unit of the drawing."""
_COLOURS, _LINE, _EDGE = 200, 201, 202
"""How many colours there are, and the entries of the palette for contours and for the edge of the band."""
_THICKER = ((0, 0, 0), (0, 1, 1), (0, 1, 0))
"""A pixel more below and to the right."""
_NEAR = 1e-3
"""Twist [rad] within which a design is one of the concept."""


@dataclass(frozen=True, eq=False)
class PowerMap:
    task: MapTask
    powers: Array
    """[W], (rows along y, columns along x); NaN where a design does not trim, or is not computed yet."""
    values: tuple[tuple[tuple[float, ...], ...], ...]
    """All parameters of each point."""
    lowest: tuple[float, tuple[float, ...]]
    """The least power [W], between the points too, and all parameters there."""
    whole: bool = True
    """Whether all points are computed: else the least is that of those which are."""

    @property
    def parameters(self) -> tuple[Parameter, Parameter]:
        x, y = (self.task.concept.parameters[axis] for axis in self.task.axes)
        return x, y

    @property
    def least(self) -> tuple[float, float, float]:
        """Place (0…1 along x and y) and power [W] of the least."""
        power, values = self.lowest
        return *self.place(values), power

    def place(self, values: Sequence[float]) -> tuple[float, float]:
        """Where all parameters lie, 0…1 along x and y."""
        pairs = zip(self.task.axes, self.parameters, strict=True)
        x, y = ((values[axis] - one.low) / (one.high - one.low) for axis, one in pairs)
        return x, y

    def at(self, x: float, y: float) -> Design:
        """The design at a place, its other parameters those of the nearest grid point."""
        n = len(self.powers) - 1
        task, values = self.task, self.values[round(y * n)][round(x * n)]
        return task.concept.apply(task.design, task.place(x, y, values))


def map_of(task: MapTask, levels: Sequence[MapLevel]) -> PowerMap | None:
    """The map as far as it is computed, from all levels that were told; None while no design trims.

    Rows of a finer grid that are not computed yet are those of the coarser one, drawn between its points.
    """
    last = levels[-1]
    power, values = last.least
    if power is None:
        return None
    powers = np.array(last.powers, dtype=float)
    coarser = [level for level in levels if level.whole and len(level.powers) < len(powers)]
    if coarser and not last.whole:
        between = refined(np.array(coarser[-1].powers, dtype=float), len(powers), len(powers))
        powers[last.rows :] = between[last.rows :]
    return PowerMap(task, powers, last.values, (power, values), last.whole)


def default_axes(concept: Concept) -> tuple[int, int]:
    """Division across and outer rate up, where there are such."""
    motions = [handle.motion for handle in concept.handles]
    if len(motions) < 2:
        return 0, 0
    across = motions.index("slide") if "slide" in motions else 0
    rates = [k for k, motion in enumerate(motions) if motion != "slide" and k != across]
    return across, rates[-1]


@lru_cache(maxsize=8)
def place_on(drawn: PowerMap, twist: TwistLaw) -> tuple[float, float] | None:
    """Where a twist lies on a map, 0…1; None where it is not one of the concept's."""
    task = drawn.task
    values, r = nearest(task.concept, twist), np.linspace(0.15, 1.0, 40)
    if float(np.abs(task.concept.twist(values)(r) - twist(r)).max()) > _NEAR:
        return None
    return drawn.place(values)


def rail_name(parameter: Parameter) -> str:
    """Name of a parameter as its slider shows it."""
    return parameter.short or parameter.title


def least_words(drawn: PowerMap, units: Units) -> str:
    """The least with all its parameters, whether the map ends there, and whether others are still computed."""

    def at(parameter: Parameter, value: float) -> str:
        shown = number(parameter.shown(value), 1 if parameter.angular else 2)
        return f"{rail_name(parameter)} {shown} {parameter.shown_unit}"

    every = drawn.task.concept.parameters
    best = ", ".join(at(*one) for one in zip(every, drawn.lowest[1], strict=True))
    least = zip(drawn.parameters, drawn.least[:2], strict=True)
    ends = [
        at(p, p.low + part * (p.high - p.low)) for p, part in least if min(part, 1.0 - part) < 1e-6
    ]
    beyond = (
        f" It lies at the bound of {' and '.join(ends)}: lower power may lie beyond it."
        if ends
        else ""
    )
    so_far = "" if drawn.whole else " so far"
    return f"Least{so_far} {total_words(drawn.least[2], units)} at {best}.{beyond}"


def refined(powers: Array, wide: int, high: int) -> Array:
    """Smooth between grid points, (high, wide), first row low; straight where some do not trim, NaN next to those."""
    n = len(powers) - 1
    row, column = np.linspace(0.0, n, high), np.linspace(0.0, n, wide)
    degree = min(3, n) if np.isfinite(powers).all() else 1
    known = np.where(np.isfinite(powers), powers, 1e9)
    grid = np.arange(n + 1.0)
    values = RectBivariateSpline(grid, grid, known, kx=degree, ky=degree)(row, column)
    return np.where(values < 1e8, values, np.nan)


@lru_cache(maxsize=1)
def _picture(drawn: PowerMap) -> bytes:
    """PNG: colours by power above the least, lines at `CONTOURS`, the 0.1 % band within a white edge."""
    values = refined(drawn.powers, round(_SHARP * _WIDE), round(_SHARP * _HIGH))[::-1]
    excess = values / drawn.least[-1] - 1.0
    known = np.isfinite(excess)
    excess = np.where(known, excess, 9.0)
    pixels = (1.0 + np.clip(excess / CONTOURS[-1], 0.0, 1.0) ** 0.5 * (_COLOURS - 1)).astype(
        np.uint8
    )
    ring = np.searchsorted([BAND, *CONTOURS], excess)
    change = np.zeros(ring.shape, dtype=bool)
    change[:, 1:] |= ring[:, 1:] != ring[:, :-1]
    change[1:, :] |= ring[1:, :] != ring[:-1, :]
    pixels[binary_dilation(change, _THICKER)] = _LINE
    band = excess <= BAND
    pixels[binary_dilation(band, _THICKER, 3) & ~band] = _EDGE
    pixels[~known] = 0
    entries = np.zeros((256, 4), dtype=np.uint8)
    entries[1 : 1 + _COLOURS, :3] = colour_map("sequential", _COLOURS)
    entries[1 : 1 + _COLOURS, 3] = 255
    entries[_LINE] = (255, 255, 255, 130)
    entries[_EDGE] = (255, 255, 255, 255)
    return encode_png(pixels, entries)


def drawing(drawn: PowerMap, twist: TwistLaw | None) -> Markup:
    """SVG of a map. `twist`: on the sliders; it has a mark where it is one of the concept's."""
    across, up = drawn.parameters
    x, y, _ = drawn.least
    marks = [_star(_LEFT + x * _WIDE, _TOP + (1.0 - y) * _HIGH)]
    place = None if twist is None else place_on(drawn, twist)
    if place is not None and all(0.0 <= part <= 1.0 for part in place):
        cx, cy = _LEFT + place[0] * _WIDE, _TOP + (1.0 - place[1]) * _HIGH
        look = {"fill": "none", "stroke": NOW, "stroke_width": 2.4}
        marks.append(tag("circle", cx=round(cx, 1), cy=round(cy, 1), r=4.5, **look))
    image = svg.image(_LEFT, _TOP, _WIDE, _HIGH, _picture(drawn))
    area = tag("g.rx-map", image, data_map="", data_explorer="map")
    above = tag("g", marks, pointer_events="none")
    axes = tag("g", _across(across), _up(up), _bar(), font_size=12, fill="currentColor")
    return svg.drawing(
        300, 266, f"Power over {rail_name(across)} and {rail_name(up)}", area, above, axes
    )


def _star(x: float, y: float) -> Markup:
    corners = [(2.7 if k % 2 else 6.5, k * math.pi / 5.0) for k in range(10)]
    points = [(x + r * math.sin(turn), y - r * math.cos(turn)) for r, turn in corners]
    return svg.polygon(points, fill="#fff", stroke="#111", stroke_width=1)


def _across(parameter: Parameter) -> Markup:
    base = _TOP + _HIGH
    ticks = bar_ticks(parameter.shown(parameter.low), parameter.shown(parameter.high))
    places = [(round(_LEFT + 0.01 * percent * _WIDE, 1), word) for percent, word in ticks]
    words = [tag("text", word, x=at, y=base + 13, text_anchor="middle") for at, word in places]
    return group(
        words, [tag("path", d=f"M{at},{base} v4", stroke="currentColor") for at, _ in places]
    )


def _up(parameter: Parameter) -> Markup:
    ticks = bar_ticks(parameter.shown(parameter.low), parameter.shown(parameter.high))
    places = [(round(_TOP + (1.0 - 0.01 * percent) * _HIGH, 1), word) for percent, word in ticks]
    words = [tag("text", word, x=_LEFT - 6, y=at + 4, text_anchor="end") for at, word in places]
    return group(
        words, [tag("path", d=f"M{_LEFT},{at} h-4", stroke="currentColor") for at, _ in places]
    )


@cache
def _bar() -> Markup:
    """The colours, with the contours at their places [%]."""
    colours = colour_map("sequential", 25)
    stops = [
        tag("stop", offset=round(k / 24, 3), stop_color=css(colour))
        for k, colour in enumerate(colours)
    ]
    places = [
        (_LEFT + math.sqrt(part / CONTOURS[-1]) * _WIDE, f"{100 * part:g}")
        for part in (0.0, *CONTOURS)
    ]
    return group(
        tag("linearGradient", stops, id="rx-map-colours"),
        tag("rect", x=_LEFT, y=224, width=_WIDE, height=9, rx=2, fill="url(#rx-map-colours)"),
        [tag("text", word, x=round(at, 1), y=246, text_anchor="middle") for at, word in places],
        tag(
            "text",
            "power above the least [%]",
            x=_LEFT + _WIDE / 2,
            y=262,
            text_anchor="middle",
            opacity=0.7,
        ),
    )
