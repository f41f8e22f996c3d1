"""Line charts as SVG: points and lines over two axes, for the trust page, reports and the documentation.

As a file of its own a chart follows the reader's light or dark setting; within a page it has the page's text colour.
Fill and stroke are attributes of the drawing, so that no style sheet is needed.
"""

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape
from typing import Literal

import numpy as np

Mark = Literal["points", "crosses", "line", "dashed", "both"]
Span = tuple[float, float]
AZIMUTH = (0.0, 90.0, 180.0, 270.0, 360.0)
"""Ticks of a chart over azimuth [°]."""
COLOURS = ("currentColor", "#1c7ed6", "#e8590c", "#0ca678", "#be4bdb")
"""Measured first, then ours; each can be read on white and on black."""
_WIDE, _HIGH, _SIZE = 640.0, 320.0, 12.0
"""Size of the drawing and of its text."""
_LETTER = 0.5 * _SIZE
"""Width of a letter, on average."""
_NAMESPACE = 'xmlns="http://www.w3.org/2000/svg" '
_OWN_COLOURS = "<style>svg{color:#1c2429}@media(prefers-color-scheme:dark){svg{color:#dfe5e9}}</style>"
"""Of a file of its own; in a page it would reach the page's other drawings."""


@dataclass(frozen=True)
class Series:
    """Points or a line."""

    label: str
    """For the key; empty leaves it out."""
    x: tuple[float, ...]
    y: tuple[float, ...]
    """NaN is a gap."""
    mark: Mark = "points"
    colour: int | str = 0
    """Place in `COLOURS`, or a colour as SVG writes it."""
    scatter: tuple[float, ...] = ()
    """Half the length of an error bar on each point, along the axis of values."""


@dataclass(frozen=True)
class LineChart:
    """One pair of axes."""

    title: str
    x_label: str
    y_label: str
    series: tuple[Series, ...]
    log: Literal["", "x", "y", "xy"] = ""
    x_ticks: tuple[float, ...] = ()
    names: tuple[str, ...] = ()
    """Where given, y counts these from the top, and values and error bars lie along x."""
    x_range: Span | None = None
    y_range: Span | None = None
    """Ends of the axes; None: as the series ask for. Lines are cut off there."""


@dataclass(frozen=True)
class _Axes:
    """Where values lie in the drawing."""

    chart: LineChart
    x_range: Span
    y_range: Span
    left: float
    top: float
    wide: float
    high: float

    def x(self, value: float) -> float:
        return self.left + self.wide * _share(_scaled(value, "x" in self.chart.log), self.x_range)

    def y(self, value: float) -> float:
        return self.top + self.high * (1.0 - _share(_scaled(value, "y" in self.chart.log), self.y_range))


def draw(chart: LineChart, inline: bool = False) -> str:
    """The chart with key and axes, as an SVG file, or `inline` as part of a page."""
    x_ticks = chart.x_ticks or _ticks(_range(chart, "x"), 7, "x" in chart.log)
    y_ticks = [float(k) for k in range(len(chart.names))] or _ticks(_range(chart, "y"), 6, "y" in chart.log)
    y_words = chart.names or [_tick_text(value, "y" in chart.log) for value in y_ticks]
    key, lines = _key([one for one in chart.series if one.label])
    left = 12.0 + _LETTER * max(map(len, y_words)) + (0.0 if chart.names else 1.5 * _SIZE)
    top, high = 16.0 + 18.0 * lines, max(_HIGH - 86.0, 21.0 * len(chart.names))
    axes = _Axes(chart, _range(chart, "x"), _range(chart, "y"), left, top, _WIDE - left - 16.0, high)
    bottom, right = top + high, left + axes.wide
    grid: list[str] = []
    words: list[str] = []
    for value in x_ticks:
        x = axes.x(value)
        grid.append(f"M{x:.1f},{top:.1f}V{bottom:.1f}")
        words.append(_text(x, bottom + 17.0, _tick_text(value, "x" in chart.log)))
    for value, word in zip(y_ticks, y_words, strict=True):
        y = axes.y(value)
        grid.append(f"M{left:.1f},{y:.1f}H{right:.1f}")
        words.append(_text(left - 7.0, y + 4.0, word, "end"))
    words.append(_text(0.5 * (left + right), bottom + 36.0, chart.x_label))
    if not chart.names:
        middle = 0.5 * (top + bottom)
        words.append(f'<g transform="translate(12 {middle:.1f}) rotate(-90)">{_text(0.0, 0.0, chart.y_label)}</g>')
    return (
        _head(_WIDE, bottom + 46.0, chart.title, inline)
        + f'<path d="{"".join(grid)}" fill="none" stroke="currentColor" stroke-opacity=".14"/>'
        + f'<path d="M{left:.1f},{top:.1f}V{bottom:.1f}H{right:.1f}" fill="none" stroke="currentColor"/>'
        + f'<g fill="currentColor">{"".join(words)}</g>{key}'
        + _cut_off(axes, "".join(_series(axes, one, 4.0, 2.0) for one in chart.series))
        + "</svg>\n"
    )


def _cut_off(axes: _Axes, drawn: str) -> str:
    """What is drawn, cut off a little beyond the axes where their ends are given: an inner drawing shows no more."""
    if axes.chart.x_range is None and axes.chart.y_range is None:
        return drawn
    top, high = axes.top - 5.0, axes.high + 10.0
    return (
        f'<svg x="{axes.left:.1f}" y="{top:.1f}" width="{axes.wide:.1f}" height="{high:.1f}" '
        f'viewBox="{axes.left:.1f} {top:.1f} {axes.wide:.1f} {high:.1f}">{drawn}</svg>'
    )


def draw_small(chart: LineChart) -> str:
    """The same without text, for a row of a table."""
    axes = _Axes(chart, _range(chart, "x"), _range(chart, "y"), 4.0, 3.0, 112.0, 28.0)
    return (
        _head(120.0, 34.0, chart.title, False)
        + '<path d="M4,3V31H116" fill="none" stroke="currentColor" stroke-opacity=".35"/>'
        + "".join(_series(axes, one, 1.8, 1.5) for one in chart.series)
        + "</svg>\n"
    )


def _head(wide: float, high: float, title: str, inline: bool) -> str:
    return (
        f'<svg {"" if inline else _NAMESPACE}viewBox="0 0 {wide:.0f} {high:.0f}" role="img" '
        f'font-family="system-ui,sans-serif" font-size="{_SIZE:g}" aria-label="{escape(title, quote=True)}">'
        + ("" if inline else _OWN_COLOURS)
    )


def _series(axes: _Axes, one: Series, radius: float, width: float) -> str:
    places = [(axes.x(x), axes.y(y)) for x, y in zip(one.x, one.y, strict=True)]
    colour = COLOURS[one.colour] if isinstance(one.colour, int) else one.colour
    stroke = f'stroke="{colour}" fill="none" stroke-width="{width:g}"'
    parts: list[str] = []
    if one.mark in ("line", "dashed", "both"):
        dash = ' stroke-dasharray="6 4"' if one.mark == "dashed" else ""
        parts.append(f'<path d="{_path(places)}" {stroke} stroke-linejoin="round"{dash}/>')
    if one.scatter:
        bars = "".join(
            f"M{axes.x(x - half):.1f},{axes.y(y):.1f}H{axes.x(x + half):.1f}"
            if axes.chart.names
            else f"M{axes.x(x):.1f},{axes.y(y - half):.1f}V{axes.y(y + half):.1f}"
            for x, y, half in zip(one.x, one.y, one.scatter, strict=True)
        )
        parts.append(f'<path d="{bars}" {stroke} stroke-opacity=".45"/>')
    known = [place for place in places if all(map(math.isfinite, place))]
    if one.mark == "crosses":
        d = radius
        crosses = (f"M{x - d:.1f},{y - d:.1f}l{2 * d:g},{2 * d:g}m0,{-2 * d:g}l{-2 * d:g},{2 * d:g}" for x, y in known)
        parts.append(f'<path d="{"".join(crosses)}" {stroke}/>')
    elif one.mark in ("points", "both"):
        r = radius if one.mark == "points" else 0.7 * radius
        dots = "".join(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r:g}"/>' for x, y in known)
        parts.append(f'<g fill="{colour}" fill-opacity=".85">{dots}</g>')
    return "".join(parts)


def _path(places: Iterable[tuple[float, float]]) -> str:
    """A line through places, broken where one is not finite."""
    parts: list[str] = []
    pen = "M"
    for x, y in places:
        finite = math.isfinite(x) and math.isfinite(y)
        if finite:
            parts.append(f"{pen}{x:.1f},{y:.1f}")
        pen = "L" if finite else "M"
    return "".join(parts)


def _key(series: Sequence[Series]) -> tuple[str, int]:
    """Swatch and label of each series above the axes, and the number of lines that they take."""
    parts: list[str] = []
    x, line = 12.0, 0
    for one in series:
        wide = 52.0 + _LETTER * len(one.label)
        if x > 12.0 and x + wide > _WIDE:
            x, line = 12.0, line + 1
        y = 14.0 + 18.0 * line
        axes = _Axes(LineChart("", "", "", ()), (0.0, 1.0), (0.0, 1.0), x, y, 20.0, 0.0)
        middle = one.mark in ("points", "crosses")
        swatch = Series("", (0.5,) if middle else (0.0, 1.0), (0.5,) if middle else (0.5, 0.5), one.mark, one.colour)
        parts.append(_series(axes, swatch, 4.0, 2.0))
        parts.append(f'<g fill="currentColor">{_text(x + 27.0, y + 4.0, one.label, "start")}</g>')
        x += wide
    return "".join(parts), line + 1 if series else 0


def _range(chart: LineChart, axis: Literal["x", "y"]) -> Span:
    """As given, or of all values with their error bars, on the scale of the axis."""
    given = chart.x_range if axis == "x" else chart.y_range
    if given is not None:
        return given
    if axis == "y" and chart.names:
        return len(chart.names) - 0.5, -0.5
    along = "x" if chart.names else "y"
    seen: list[float] = []
    for one in chart.series:
        values, halves = getattr(one, axis), one.scatter if axis == along and one.scatter else (0.0,) * len(one.x)
        seen += [end for value, half in zip(values, halves, strict=True) for end in (value - half, value + half)]
    log = axis in chart.log
    known = [_scaled(value, log) for value in (*seen, *(chart.x_ticks if axis == "x" else ())) if math.isfinite(value)]
    low, high = (min(known), max(known)) if known else (0.0, 1.0)
    if axis == "x" and chart.x_ticks:
        return low, high
    if low == high:
        return low - 0.5 * (abs(low) or 1.0), high + 0.5 * (abs(high) or 1.0)
    if not log and 0.0 < low < 0.5 * high:
        low = 0.0
    margin = 0.06 * (high - low)
    return (low if low == 0.0 else low - margin), (high if high == 0.0 else high + margin)


def _scaled(value: float, log: bool) -> float:
    return math.log10(max(value, 1e-300)) if log else value


def _share(value: float, span: Span) -> float:
    """Where a value lies along an axis, 0 to 1; one far outside is moved nearer, so that numbers stay short."""
    return float(np.clip((value - span[0]) / (span[1] - span[0]), -1.0, 2.0))


def _ticks(span: Span, about: int, log: bool) -> list[float]:
    """Round values within a range, at most about that many; whole powers of ten on a logarithmic axis."""
    low, high = span
    if log:
        every = max(1, math.ceil((high - low) / about))
        return [10.0**k for k in range(math.ceil(low), math.floor(high) + 1) if k % every == 0]
    return round_ticks(low, high, about)


def round_up(step: float) -> float:
    """The round number 1, 2 or 5 × 10ⁿ nearest above `step`."""
    power = 10.0 ** math.floor(math.log10(step))
    return power * next(factor for factor in (1.0, 2.0, 5.0, 10.0) if factor * power >= step * (1.0 - 1e-9))


def round_ticks(low: float, high: float, about: int) -> list[float]:
    """At most `about` + 1 round numbers within an axis, zero among them where it is inside."""
    step = round_up((high - low) / about)
    return [round(k * step, 12) for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


def tick_text(value: float) -> str:
    """A tick's number with a true minus sign and no needless digits."""
    return f"{round(value, 6) + 0.0:.6g}".replace("-", "−")


def _tick_text(value: float, log: bool) -> str:
    if log and not 0.1 <= value <= 1e4:
        return "10" + f"{round(math.log10(value))}".translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return tick_text(value)


def _text(x: float, y: float, words: str, anchor: str = "middle") -> str:
    """Text with the index of C_T and the like set low."""
    low = re.sub(
        r"\b([CU])_(\w)", r'\1<tspan dy="3" font-size="9">\2</tspan><tspan dy="-3">&#8203;</tspan>', escape(words)
    )
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{low}</text>'
