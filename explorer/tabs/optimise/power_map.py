"""The map of power over two parameters: a small picture with contours, and axes and marks as SVG around it."""

import base64
import math
from dataclasses import dataclass
from html import escape

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RectBivariateSpline

from explorer.charts.clicks import write_to
from explorer.picture.fields import tick_text, ticks
from explorer.picture.png import encode_png
from explorer.text.units import SI, Units, number
from explorer.theme.colours import NOW, colour_map
from explorer.workers.tasks import MapTask
from rotor.arrays import Array
from rotor.optimisation.concepts import Parameter
from rotor.optimisation.descent import BAND as _BAND

CONTOURS = (0.005, 0.01, 0.02, 0.04, 0.08)
"""Power above the least, as parts of it, at which lines are drawn."""
_SCALE = 0.08
"""At which the colours end."""
_WIDE, _HIGH = 508, 380
"""Pixels of the picture: two for each of the drawing's units."""
_LEFT, _TOP, _W, _H = 36, 6, 254, 190
_LEVELS = 200
_LINE, _EDGE = 201, 202

FIELD = "Take point"
"""The label of the text field that a click writes to."""


@dataclass(frozen=True, eq=False)
class Map:
    """What is known of a map."""

    task: MapTask
    powers: Array
    """[W], (rows along y, columns along x); NaN where a design does not trim."""

    @property
    def parameters(self) -> tuple[Parameter, Parameter]:
        x, y = (self.task.concept.parameters[axis] for axis in self.task.axes)
        return x, y

    @property
    def least(self) -> tuple[float, float, float]:
        """Place (0…1 along x and y) and power [W] of the best grid point."""
        row, column = np.unravel_index(np.nanargmin(self.powers), self.powers.shape)
        n = len(self.powers) - 1
        return float(column) / n, float(row) / n, float(self.powers[row, column])


def refined(powers: Array, wide: int, high: int) -> Array:
    """Smooth between grid points, (high, wide), first row low; straight where some do not trim, NaN next to those."""
    n = len(powers) - 1
    row, column = np.linspace(0.0, n, high), np.linspace(0.0, n, wide)
    degree = 3 if np.isfinite(powers).all() else 1
    known = np.where(np.isfinite(powers), powers, 1e9)
    grid = np.arange(n + 1.0)
    values = RectBivariateSpline(grid, grid, known, kx=degree, ky=degree)(row, column)
    return np.where(values < 1e8, values, np.nan)


def picture(powers: Array) -> bytes:
    """PNG: colours by power above the least, lines at CONTOURS, the 0.1 % band white within a white edge."""
    values = refined(powers, _WIDE, _HIGH)[::-1]
    least = float(np.nanmin(powers))
    excess = values / least - 1.0
    known = np.isfinite(excess)
    excess = np.where(known, excess, 9.0)
    pixels = (1.0 + np.clip(excess / _SCALE, 0.0, 1.0) ** 0.5 * (_LEVELS - 1)).astype(np.uint8)
    ring = np.searchsorted([_BAND, *CONTOURS], excess)
    change = np.zeros(ring.shape, dtype=bool)
    change[:, 1:] |= ring[:, 1:] != ring[:, :-1]
    change[1:, :] |= ring[1:, :] != ring[:-1, :]
    pixels[_thicker(change)] = _LINE
    band = excess <= _BAND
    pixels[_thicker(_thicker(band)) & ~band] = _EDGE
    pixels[~known] = 0
    entries = np.zeros((256, 4), dtype=np.uint8)
    entries[1 : 1 + _LEVELS, :3] = colour_map("sequential", _LEVELS)
    entries[1 : 1 + _LEVELS, 3] = 255
    entries[_LINE] = (255, 255, 255, 130)
    entries[_EDGE] = (255, 255, 255, 255)
    return encode_png(pixels, entries)


def _thicker(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """A pixel more below and to the right."""
    out = mask.copy()
    out[1:] |= mask[:-1]
    out[:, 1:] |= mask[:, :-1]
    return out


def drawing(drawn: Map, here: tuple[float, float] | None, exact: bool) -> str:
    """SVG of a map. `here`: the design on the sliders, 0…1 along each axis; hollow unless `exact`."""
    x, y = drawn.parameters
    at_x, at_y, _ = drawn.least
    data = base64.b64encode(picture(drawn.powers)).decode()
    marks = [_star(_LEFT + at_x * _W, _TOP + (1.0 - at_y) * _H)]
    if here is not None:
        fill = NOW if exact else "none"
        marks.append(
            f'<circle cx="{_LEFT + here[0] * _W:.1f}" cy="{_TOP + (1.0 - here[1]) * _H:.1f}" r="4.5" fill="{fill}" '
            f'stroke="{"#fff" if exact else NOW}" stroke-width="1.8" pointer-events="none"/>'
        )
    return (
        f'<svg viewBox="0 0 300 222" width="100%" class="rx-map" data-explorer="map">'
        f'<image x="{_LEFT}" y="{_TOP}" width="{_W}" height="{_H}" preserveAspectRatio="none" '
        f'href="data:image/png;base64,{data}" style="cursor:crosshair" onclick="{_script(x, y)}"/>'
        f'<rect x="{_LEFT}" y="{_TOP}" width="{_W}" height="{_H}" fill="none" stroke="currentColor" opacity=".4"/>'
        f"{_axis(x, True)}{_axis(y, False)}{''.join(marks)}</svg>"
    )


def _star(x: float, y: float) -> str:
    points = " ".join(
        f"{x + r * math.sin(k * math.pi / 5.0):.1f},{y - r * math.cos(k * math.pi / 5.0):.1f}"
        for k in range(10)
        for r in (6.5 if k % 2 == 0 else 2.7,)
    )
    return f'<polygon points="{points}" fill="#fff" stroke="#111" stroke-width="1" pointer-events="none"/>'


def _axis(parameter: Parameter, along: bool) -> str:
    low, high = parameter.shown(parameter.low), parameter.shown(parameter.high)
    out = []
    for value in ticks(low, high):
        part = (value - low) / (high - low)
        if along:
            at = _LEFT + part * _W
            out.append(f'<text x="{at:.1f}" y="{_TOP + _H + 13}" text-anchor="middle">{tick_text(value)}</text>')
            out.append(f'<path d="M{at:.1f},{_TOP + _H} v4" stroke="currentColor"/>')
        else:
            at = _TOP + (1.0 - part) * _H
            out.append(f'<text x="{_LEFT - 6}" y="{at + 3.5:.1f}" text-anchor="end">{tick_text(value)}</text>')
            out.append(f'<path d="M{_LEFT},{at:.1f} h-4" stroke="currentColor"/>')
    return f'<g font-size="10.5" fill="currentColor">{"".join(out)}</g>'


def _script(x: Parameter, y: Parameter) -> str:
    """JavaScript of a click: write the point to the text field, as if it had been typed."""
    (x0, x1), (y0, y1) = ((p.shown(p.low), p.shown(p.high)) for p in (x, y))
    across = f"({x0:.6g}+({x1 - x0:.6g})*(event.clientX-b.left)/b.width).toFixed({_digits(x)})"
    up = f"({y1:.6g}-({y1 - y0:.6g})*(event.clientY-b.top)/b.height).toFixed({_digits(y)})"
    return "const b=this.getBoundingClientRect();" + write_to(FIELD, f"{across}+' '+{up}")


def _digits(parameter: Parameter) -> int:
    return 1 if parameter.angular else 3


def point_of(text: str, drawn: Map) -> tuple[float, ...]:
    """The concept's parameters at a typed or clicked point; ValueError with one sentence for any other text."""
    try:
        x, y = (float(item) for item in text.replace(",", " ").replace("−", "-").split())
    except ValueError:
        raise ValueError(f"{text!r} is not a point: type two numbers, x and y.") from None
    values = list(drawn.task.values)
    for axis, parameter, value in zip(drawn.task.axes, drawn.parameters, (x, y), strict=True):
        inside = parameter.from_shown(value)
        if not (math.isfinite(value) and parameter.low - 1e-9 <= inside <= parameter.high + 1e-9):
            raise ValueError(f"{number(value, 3)} {parameter.shown_unit} lies outside the map.")
        values[axis] = min(max(inside, parameter.low), parameter.high)
    return tuple(values)


def legend(drawn: Map, units: Units = SI) -> str:
    """Axes, least power, contour lines, and the fixed parameters."""
    x, y = drawn.parameters
    at_x, at_y, power = drawn.least
    best = [
        f"{number(p.shown(p.low + part * (p.high - p.low)), 1 if p.angular else 2)} {p.shown_unit}"
        for p, part in ((x, at_x), (y, at_y))
    ]
    held = [
        f"{p.title} {number(p.shown(value), 1 if p.angular else 2)} {p.shown_unit}"
        for k, (p, value) in enumerate(zip(drawn.task.concept.parameters, drawn.task.values, strict=True))
        if k not in drawn.task.axes
    ]
    lines = ", ".join(f"{100 * part:g}" for part in CONTOURS)
    return (
        '<div class="rx rx-small" data-explorer="map-legend">'
        f"<div>★ {units.watts(power, 1)} at {', '.join(best)}</div>"
        f'<div class="rx-dim">Outline: {100 * _BAND:g} % above. Lines: {lines} %.</div>'
        f'<div class="rx-dim">{"Fixed: " + escape(", ".join(held)) + "." if held else ""}</div></div>'
    )


def title(drawn: Map) -> str:
    """Titles of the axes."""
    x, y = drawn.parameters
    return (
        f'<div class="rx rx-line rx-small rx-map-title"><span>↑ {escape(y.title)} [{y.shown_unit}]</span>'
        f"<span>{escape(x.title)} [{x.shown_unit}] →</span></div>"
    )
