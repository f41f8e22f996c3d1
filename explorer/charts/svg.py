"""Drawings as SVG: marks, words and lines of any size; and the disk from above.

The disk has its field, marked regions, azimuth marks, flight arrow, colour bar and key.
"""

import base64
import math
from collections.abc import Iterable
from typing import NamedTuple

import msgspec
import numpy as np

from explorer.colours import RIM, DiskInk, Rgb, colour_map, css
from explorer.model.units import SI, Units
from explorer.picture.disk_image import LARGEST, SIZE, half_width
from explorer.picture.fields import Field
from explorer.picture.picture import disk_png
from explorer.picture.polar import ALL_MARKS, DrawnSolution, MarkedRegion, polar_grid, region_codes
from rotor import Solution
from rotor.support.chart import DrawnChart, bar_ticks
from rotor.support.markup import Attribute, Content, Markup, group, tag

Point = tuple[float, float]

BODY = "var(--mantine-color-body)"
"""The page's ground, for the halo that keeps words readable on lines."""
_HALO: dict[str, Attribute] = {
    "stroke": BODY,
    "stroke_width": 3,
    "paint_order": "stroke",
    "stroke_linejoin": "round",
}


def drawing(width: float, height: float, label: str, *content: Content) -> Markup:
    """A drawing as wide as its place, with the words of its label for who does not see it."""
    return tag(
        "svg",
        *content,
        viewBox=f"0 0 {width:g} {height:g}",
        width="100%",
        role="img",
        aria_label=label,
    )


def line(
    start: Point,
    end: Point,
    colour: str = "currentColor",
    width: float = 1.0,
    *,
    dashes: str | None = None,
    opacity: float | None = None,
) -> Markup:
    (x1, y1), (x2, y2) = start, end
    look: dict[str, Attribute] = {
        "stroke_width": width,
        "stroke_dasharray": dashes,
        "opacity": opacity,
    }
    return tag("line", x1=x1, y1=y1, x2=x2, y2=y2, stroke=colour, **look)


def arrow(start: Point, end: Point, colour: str = "currentColor", width: float = 2.0) -> Markup:
    """A straight arrow; its head shrinks with it, and there is none where there is no length."""
    reach = math.dist(start, end)
    if reach < 0.5:
        return Markup()
    head = min(7.0 + width, 0.6 * reach)
    along = (end[0] - start[0]) / reach, (end[1] - start[1]) / reach
    neck = end[0] - head * along[0], end[1] - head * along[1]
    half = 0.38 * head
    corners = (
        end,
        (neck[0] - half * along[1], neck[1] + half * along[0]),
        (neck[0] + half * along[1], neck[1] - half * along[0]),
    )
    return line(start, neck, colour, width) + polygon(corners, fill=colour)


def arc(
    centre: Point,
    radius: float,
    start: float,
    sweep: float,
    colour: str = "currentColor",
    width: float = 1.0,
) -> Markup:
    """Part of a circle from an angle [rad, clockwise from +x] on by `sweep`, with a small head at its end."""
    end = start + sweep
    first, last = _on(centre, radius, start), _on(centre, radius, end)
    large, way = int(abs(sweep) > math.pi), int(sweep > 0.0)
    d = f"M{first[0]:.1f},{first[1]:.1f} A{radius:g},{radius:g} 0 {large} {way} {last[0]:.1f},{last[1]:.1f}"
    path = tag("path", d=d, fill="none", stroke=colour, stroke_width=width)
    if abs(sweep) * radius < 9.0:
        return path
    back = end - math.copysign(5.5 / radius, sweep)
    head = (last, _on(centre, radius - 2.2, back), _on(centre, radius + 2.2, back))
    return path + polygon(head, fill=colour)


def polygon(points: Iterable[Point], **look: Attribute) -> Markup:
    return tag("polygon", points=" ".join(f"{x:.1f},{y:.1f}" for x, y in points), **look)


def words(
    at: Point,
    text: str,
    anchor: str = "middle",
    colour: str = "currentColor",
    *,
    low: str = "",
    weight: int | None = None,
    opacity: float | None = None,
) -> Markup:
    """Text with a halo, so that it reads on whatever it crosses; `low` is its subscript."""
    subscript = tag("tspan", low, font_size=10, dy=2.5) if low else None
    look: dict[str, Attribute] = {"font_size": 12, "font_weight": weight, "opacity": opacity}
    return tag(
        "text", text, subscript, x=at[0], y=at[1], text_anchor=anchor, fill=colour, **look, **_HALO
    )


def spread_heights(wanted: list[float], apart: float) -> list[float]:
    """Heights [px] as near those wanted as lets each be `apart` from the next; in the same order."""
    order = sorted(range(len(wanted)), key=lambda k: wanted[k])
    placed = [wanted[k] for k in order]
    for _ in range(20):
        for k in range(1, len(placed)):
            lack = apart - (placed[k] - placed[k - 1])
            if lack > 0.0:
                placed[k - 1] -= 0.5 * lack
                placed[k] += 0.5 * lack
    heights = [0.0] * len(wanted)
    for place, k in zip(placed, order, strict=True):
        heights[k] = place
    return heights


def _on(centre: Point, radius: float, angle: float) -> Point:
    return centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)


def text(x: float, y: float, words: str, size: float, *, anchor: str = "start") -> Markup:
    """Text whose baseline starts, is centred or ends at a point [px]."""
    return tag("text", words, x=x, y=y, fill="currentColor", font_size=size, text_anchor=anchor)


def image(x: float, y: float, wide: float, high: float, png: bytes) -> Markup:
    data = base64.b64encode(png).decode("ascii")
    return tag("image", x=x, y=y, width=wide, height=high, href=f"data:image/png;base64,{data}")


Range = tuple[float, float]

HALF_EDGE = 134.0
"""Half the edge of the drawing, where the rotor's radius is 100."""
_GRADIENT_STOPS = 25


def disk_drawing(
    solution: Solution,
    field: Field,
    colour_range: Range,
    pixels: int = SIZE,
    letters: float = 9.0,
    units: Units = SI,
) -> Markup:
    """The inside of an SVG that spans −HALF_EDGE…HALF_EDGE: nose up, advancing side right.

    `pixels`: along each edge of the field's picture; `letters`: their height.
    """
    half = half_width(100.0, min(pixels, LARGEST))
    png = disk_png(solution, field, colour_range, size=pixels, marks=ALL_MARKS)
    return image(-half, -half, 2 * half, 2 * half, png) + disk_marks(solution, letters, units)


def disk_marks(solution: Solution, letters: float, units: Units) -> Markup:
    """What stands around the disk in `disk_drawing`: rim, cut-out, azimuths, speed."""
    cutout = 100.0 * solution.design.rotor.blade.root_cutout
    rings = [tag("circle", r=r, fill="none") for r in (100.0, cutout)]
    rim = tag("g", rings, tag("path", d=_ticks()), stroke=css(RIM), stroke_width=0.8)
    return group(rim, _labels(letters), _flight(solution, letters, units))


def _ticks() -> str:
    parts = []
    for degrees in range(0, 360, 10):
        reach = 4.0 if degrees % 90 == 0 else 2.4 if degrees % 30 == 0 else 1.2
        (x, y), (x_end, y_end) = _at(degrees, 100.6), _at(degrees, 100.6 + reach)
        parts.append(f"M{x:.2f},{y:.2f}L{x_end:.2f},{y_end:.2f}")
    return "".join(parts)


def _labels(size: float) -> Markup:
    """Four azimuths, and the sense of rotation outside the rim between ψ 22° and 51°."""
    (x, y), (x_end, y_end) = _at(22.0, 109.0), _at(45.0, 109.0)
    head = " ".join(
        f"{a:.2f},{b:.2f}" for a, b in (_at(45.0, 105.6), _at(51.0, 109.0), _at(45.0, 112.4))
    )
    arc = f"M{x:.2f},{y:.2f}A109,109 0 0 0 {x_end:.2f},{y_end:.2f}"
    return group(
        text(0, 107 + size, "ψ = 0°", size, anchor="middle"),
        text(107, 0.35 * size, "90°", size),
        text(0, -107, "180°", size, anchor="middle"),
        text(-107, 0.35 * size, "270°", size, anchor="end"),
        tag("path", d=arc, fill="none", stroke=css(RIM), stroke_width=2.4),
        tag("polygon", points=head, fill=css(RIM)),
    )


def _at(psi_deg: float, r: float) -> tuple[float, float]:
    psi = math.radians(psi_deg)
    return r * math.sin(psi), r * math.cos(psi)


def _flight(solution: Solution, size: float, units: Units) -> Markup:
    """The arrow ahead of the nose with the speed; nothing in hover."""
    speed = solution.design.airspeed
    if speed == 0.0:
        return Markup()
    arrow = tag("path", d="M0,-131 l4.4,7 h-2.9 v6 h-3 v-6 h-2.9 Z", fill="#c92a2a")
    return arrow + text(7, -124.5 + 0.35 * size, units.speed[0].text(speed), size)


def bar_drawing(
    field: Field, colour_range: Range, wide: float, name: str, size: float = 9.0
) -> Markup:
    """A colour bar `wide` across with its label above and its numbers below: 4 × `size` high. `name`: unique."""
    stops = [
        tag("stop", offset=f"{k / (_GRADIENT_STOPS - 1):.4f}", stop_color=css(colour))
        for k, colour in enumerate(colour_map(field.colours, _GRADIENT_STOPS).tolist())
    ]
    scale: list[Markup] = []
    for percent, word in bar_ticks(*colour_range):
        x = 0.01 * wide * percent
        scale.append(
            tag("path", d=f"M{x:.1f},{2.5 * size:.1f}v{0.35 * size:.1f}", stroke="currentColor")
        )
        scale.append(text(x, 3.75 * size, word, 0.92 * size, anchor="middle"))
    bar = tag("rect", y=1.5 * size, width=wide, height=size, rx=1, fill=f"url(#{name})")
    return group(
        tag("linearGradient", stops, id=name), text(0, size, field.label, size), bar, scale
    )


class KeyMark(NamedTuple):
    """A marked region in the key of a disk."""

    title: str
    colour: Rgb
    """Of the outline."""
    dashes: tuple[float, float] | None
    """Lengths of the pieces of the outline and of the gaps, in units of a swatch 14 long; None for a solid line."""


def key_marks(solution: Solution) -> list[KeyMark]:
    """The marked regions that the disk has."""
    drawn, grid, ink = DrawnSolution(solution), polar_grid(solution.disk, 80, 240), DiskInk()
    codes = region_codes(drawn, grid, ALL_MARKS, 0.02)
    has = set[int]() if codes is None else set(np.unique(codes).tolist())
    shown = list[KeyMark]()
    if MarkedRegion.REVERSE in has:
        shown.append(KeyMark("reverse flow", ink.reverse_flow, None))
    if MarkedRegion.SEPARATED in has:
        shown.append(KeyMark("separated", ink.stall, None))
    if solution.past_static_area > 0.0:
        shown.append(KeyMark("past the static angle", ink.stall, (1.5, 2.5)))
    if MarkedRegion.DASH in has:
        shown.append(KeyMark("drag divergence", ink.drag_divergence, (4.0, 3.0)))
    return shown


def key_entries(solution: Solution) -> list[tuple[str, Markup]]:
    """Key of the marked regions: title, and a swatch 14 × 8 as the inside of an SVG."""
    return [
        (
            mark.title,
            tag(
                "path",
                d="M0,4h14",
                stroke=css(mark.colour),
                stroke_width=3,
                stroke_dasharray=mark.dashes and "{:g} {:g}".format(*mark.dashes),
            ),
        )
        for mark in key_marks(solution)
    ]


_CHART_HEIGHT = 94.0
"""Height of the axes [px]."""


def chart_box(chart: DrawnChart, height: float = _CHART_HEIGHT) -> Markup:
    """A chart within text for the page, which draws it as wide as there is room; `height` [px] of its axes."""
    content = msgspec.json.encode(chart).decode()
    return tag("div.rx-chart", data_chart=content, data_high=height)
