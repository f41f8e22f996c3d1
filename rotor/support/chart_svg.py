"""A chart as SVG: as a file of its own it follows the reader's light or dark setting, within a page its text colour.

Fill and stroke are attributes of the drawing, so that no style sheet is needed.
"""

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from rotor.support.chart import (
    Axis,
    Band,
    Chart,
    Line,
    Points,
    Series,
    Span,
    Values,
    dash_lengths,
    scaled,
)
from rotor.support.markup import Attribute, Content, Markup, group, plain, tag

Place = tuple[float, float]
_WIDE, _HIGH, _SIZE = 640.0, 320.0, 12.0
"""Size of the drawing and of its text."""
_LETTER = 0.5 * _SIZE
"""Width of a letter, on average."""
_NAMESPACE = "http://www.w3.org/2000/svg"
_OWN_COLOURS = "svg{color:#1c2429}@media(prefers-color-scheme:dark){svg{color:#dfe5e9}}"
"""Style of a chart in a file of its own; in a page it would reach the page's other drawings."""

_BARE = Axis()


@dataclass(frozen=True)
class _Axes:
    """Where values lie in the drawing."""

    chart: Chart
    x_span: Span
    y_span: Span
    left: float
    top: float
    wide: float
    high: float

    def x(self, value: float) -> float:
        return self.left + self.wide * _share(scaled(value, self.chart.x.log), self.x_span)

    def y(self, value: float) -> float:
        return self.top + self.high * (1.0 - _share(scaled(value, self.chart.y.log), self.y_span))

    def places(self, x: Values, y: Values) -> list[Place]:
        return [(self.x(a), self.y(b)) for a, b in zip(x, y, strict=True)]


def svg(chart: Chart, inline: bool = False, size: Place = (_WIDE, _HIGH)) -> Markup:
    """The chart with legend and axes as an SVG file, or `inline` as part of a page.

    `size` [px]: width, and height with a key of one line; text keeps its size, so that it is large in a small chart.
    """
    full = size[0]
    y_ticks = chart.ticks("y", 6)
    key, lines = _key(chart, full)
    left = (
        12.0
        + _LETTER * max((len(word) for _, word in y_ticks), default=0)
        + (0.0 if chart.y.names else 1.5 * _SIZE)
    )
    top, high = 16.0 + 18.0 * lines, max(size[1] - 86.0, 21.0 * len(chart.y.names))
    axes = _Axes(chart, chart.span("x"), chart.span("y"), left, top, full - left - 16.0, high)
    bottom, right = top + high, left + axes.wide
    grid: list[str] = []
    words: list[Markup] = []
    for value, word in chart.ticks("x", 7):
        x = axes.x(value)
        grid.append(f"M{x:.1f},{top:.1f}V{bottom:.1f}")
        words.append(_text(x, bottom + 17.0, word))
    for value, word in y_ticks:
        y = axes.y(value)
        grid.append(f"M{left:.1f},{y:.1f}H{right:.1f}")
        words.append(_text(left - 7.0, y + 4.0, word, "end"))
    words.append(_text(0.5 * (left + right), bottom + 36.0, chart.x.label))
    if not chart.y.names:
        turned = f"translate(12 {0.5 * (top + bottom):.1f}) rotate(-90)"
        words.append(tag("g", _text(0.0, 0.0, chart.y.label), transform=turned))
    drawn = group(
        [_drawn(axes, series, colour) for series, colour in zip(chart.series, chart.colours(), strict=True)],
        [tag("path", d=_rule(axes, rule.at, rule.along), stroke=rule.colour, stroke_dasharray=rule.dashes)
         for rule in chart.rules],
    )  # fmt: skip
    lines = tag("path", d="".join(grid), fill="none", stroke="currentColor", stroke_opacity=0.14)
    frame = tag(
        "path",
        d=f"M{left:.1f},{top:.1f}V{bottom:.1f}H{right:.1f}",
        fill="none",
        stroke="currentColor",
    )
    text = tag("g", words, fill="currentColor")
    return _whole(
        (full, bottom + 46.0), chart.title, inline, lines, frame, text, key, _cut_off(axes, drawn)
    )


def small_svg(chart: Chart) -> Markup:
    """The chart without text, for a row of a table."""
    axes = _Axes(chart, chart.span("x"), chart.span("y"), 4.0, 3.0, 112.0, 28.0)
    frame = tag("path", d="M4,3V31H116", fill="none", stroke="currentColor", stroke_opacity=0.35)
    pairs = zip(chart.series, chart.colours(), strict=True)
    drawn = [_drawn(axes, series, colour, 0.45, 0.75) for series, colour in pairs]
    return _whole((120.0, 34.0), chart.title, False, frame, drawn)


def _whole(size: Place, title: str, inline: bool, *content: Content) -> Markup:
    style = None if inline else tag("style", Markup(_OWN_COLOURS))
    look: dict[str, Attribute] = {
        "font_family": "system-ui,sans-serif",
        "font_size": _SIZE,
        "aria_label": title,
    }
    box = f"0 0 {size[0]:.0f} {size[1]:.0f}"
    return tag(
        "svg",
        style,
        *content,
        xmlns=None if inline else _NAMESPACE,
        viewBox=box,
        role="img",
        **look,
    ) + Markup("\n")


def _cut_off(axes: _Axes, drawn: Markup) -> Markup:
    """What is drawn, cut off a little beyond the axes where their ends are given: an inner drawing shows no more."""
    if axes.chart.x.range is None and axes.chart.y.range is None:
        return drawn
    left, top, wide, high = axes.left, axes.top - 5.0, axes.wide, axes.high + 10.0
    box = f"{left:.1f} {top:.1f} {wide:.1f} {high:.1f}"
    return tag(
        "svg",
        drawn,
        x=plain(left, 1),
        y=plain(top, 1),
        width=plain(wide, 1),
        height=plain(high, 1),
        viewBox=box,
    )


def _rule(axes: _Axes, at: float, along: str) -> str:
    if along == "x":
        return f"M{axes.x(at):.1f},{axes.top:.1f}v{axes.high:.1f}"
    return f"M{axes.left:.1f},{axes.y(at):.1f}h{axes.wide:.1f}"


def _drawn(
    axes: _Axes, series: Series, colour: str, size: float = 1.0, thick: float = 1.0
) -> Markup:
    """A series; `size` of its marks and `thick` of its lines beside what they are in a large drawing."""
    if isinstance(series, Band):
        named = bool(axes.chart.y.names)
        low, high = (
            axes.places(*((y, series.x) if named else (series.x, y)))
            for y in (series.low, series.high)
        )
        if len(low) == 1:  # A band of one point has no area.
            return tag(
                "path", d=_path([*low, *high]), stroke=colour, stroke_width=5, stroke_opacity=0.3
            )
        known = [
            pair
            for pair in zip(low, high, strict=True)
            if all(map(math.isfinite, (*pair[0], *pair[1])))
        ]
        around = [*(pair[0] for pair in known), *(pair[1] for pair in reversed(known))]
        if not known:
            return Markup()
        return tag("path", d=_path(around), fill=colour, fill_opacity=series.opacity)
    places = axes.places(series.x, series.y)
    known = [place for place in places if all(map(math.isfinite, place))]
    if isinstance(series, Line):
        look: dict[str, Attribute] = {
            "stroke_width": thick * series.width,
            "stroke_linejoin": "round",
        }
        line = tag(
            "path",
            d=_path(places),
            stroke=colour,
            fill="none",
            **look,
            stroke_dasharray=dash_lengths(series),
        )
        return group(line, _dots(known, 2.8 * size, colour) if series.dots else None)
    parts: list[Markup] = []
    if series.scatter:
        bars = "".join(
            _bar(axes, *point) for point in zip(series.x, series.y, series.scatter, strict=True)
        )
        parts.append(
            tag(
                "path",
                d=bars,
                stroke=colour,
                fill="none",
                stroke_width=2 * thick,
                stroke_opacity=0.45,
            )
        )
    radius = series.size * size
    if size == 1.0:
        parts += [
            _point_name(place, name, series)
            for place, name in zip(places, series.names, strict=False)
            if name
        ]
    if series.mark == "cross":
        d = f"l{2 * radius:g},{2 * radius:g}m0,{-2 * radius:g}l{-2 * radius:g},{2 * radius:g}"
        crosses = "".join(f"M{x - radius:.1f},{y - radius:.1f}{d}" for x, y in known)
        parts.append(tag("path", d=crosses, stroke=colour, fill="none", stroke_width=2 * thick))
    else:
        parts.append(_dots(known, radius, colour, series.mark == "ring"))
    return group(parts)


def _point_name(place: Place, name: str, series: Points) -> Markup:
    """The name of a point, where its series says."""
    x, y = place
    down = series.size + 12.0 if series.name_place == "below" else -series.size - 4.0
    return tag("g", _text(x, y + down, name), fill="currentColor")


def _dots(places: Iterable[Place], radius: float, colour: str, hollow: bool = False) -> Markup:
    dots = [tag("circle", cx=plain(x, 1), cy=plain(y, 1), r=radius) for x, y in places]
    if hollow:
        return tag("g", dots, fill="none", stroke=colour, stroke_width=1.2)
    return tag("g", dots, fill=colour, fill_opacity=0.85)


def _bar(axes: _Axes, x: float, y: float, half: float) -> str:
    if axes.chart.y.names:
        return f"M{axes.x(x - half):.1f},{axes.y(y):.1f}H{axes.x(x + half):.1f}"
    return f"M{axes.x(x):.1f},{axes.y(y - half):.1f}V{axes.y(y + half):.1f}"


def _path(places: Iterable[Place]) -> str:
    """A line through places, broken where one is not finite."""
    parts: list[str] = []
    pen = "M"
    for x, y in places:
        finite = math.isfinite(x) and math.isfinite(y)
        if finite:
            parts.append(f"{pen}{x:.1f},{y:.1f}")
        pen = "L" if finite else "M"
    return "".join(parts)


def _key(chart: Chart, full: float) -> tuple[Markup, int]:
    """Swatch and label of each series above the axes, and the number of lines that they take."""
    parts: list[Markup] = []
    x, line = 12.0, 0
    for series, colour in zip(chart.series, chart.colours(), strict=True):
        if not series.label:
            continue
        wide = 52.0 + _LETTER * len(series.label)
        if x > 12.0 and x + wide > full:
            x, line = 12.0, line + 1
        y = 14.0 + 18.0 * line
        axes = _Axes(Chart("", _BARE, _BARE, ()), (0.0, 1.0), (0.0, 1.0), x, y, 20.0, 0.0)
        parts.append(_drawn(axes, _swatch(series), colour))
        parts.append(tag("g", _text(x + 27.0, y + 4.0, series.label, "start"), fill="currentColor"))
        x += wide
    return group(parts), line + 1 if parts else 0


def _swatch(series: Series) -> Series:
    if isinstance(series, Line):
        return replace(series, x=(0.0, 1.0), y=(0.5, 0.5))
    if isinstance(series, Points):
        return replace(series, x=(0.5,), y=(0.5,), scatter=())
    return Line("", (0.0, 1.0), (0.5, 0.5), width=8.0)


def _share(value: float, span: Span) -> float:
    """Where a value lies along an axis, 0 to 1; one far outside is moved nearer, so that numbers stay short."""
    return float(np.clip((value - span[0]) / (span[1] - span[0]), -1.0, 2.0))


def _text(x: float, y: float, words: str, anchor: str = "middle") -> Markup:
    """Text with the index of C_T and the like set low."""
    parts: list[Content] = []
    for part in re.split(r"\b([CU]_\w)", words):
        if re.fullmatch(r"[CU]_\w", part):
            parts += [
                part[0],
                tag("tspan", part[2], dy=3, font_size=9),
                tag("tspan", "\u200b", dy=-3),
            ]
        else:
            parts.append(part)
    return tag("text", *parts, x=plain(x, 1), y=plain(y, 1), text_anchor=anchor)
