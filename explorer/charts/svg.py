"""Drawings as SVG: marks, words and lines of any size."""

import base64
import math
from collections.abc import Iterable

from rotor.markup import Attribute, Markup, tag

Point = tuple[float, float]

BODY = "var(--mantine-color-body)"
"""The page's ground, for the halo that keeps words readable on lines."""


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
    look: dict[str, Attribute] = {"stroke_width": width, "stroke_dasharray": dashes, "opacity": opacity}
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
    centre: Point, radius: float, start: float, sweep: float, colour: str = "currentColor", width: float = 1.0
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
    halo: dict[str, Attribute] = {
        "stroke": BODY,
        "stroke_width": 3,
        "paint_order": "stroke",
        "stroke_linejoin": "round",
    }
    look: dict[str, Attribute] = {"font_size": 12, "font_weight": weight, "opacity": opacity}
    return tag("text", text, subscript, x=at[0], y=at[1], text_anchor=anchor, fill=colour, **look, **halo)


def spread(wanted: list[float], apart: float) -> list[float]:
    """Heights as near those wanted as lets each be `apart` from the next; in the same order."""
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


def text(x: float, y: float, words: str, size: float, *, anchor: str = "start", weight: int | None = None) -> Markup:
    """Text whose baseline starts, is centred or ends at a point."""
    look: dict[str, Attribute] = {"font_size": size, "text_anchor": anchor, "font_weight": weight}
    return tag("text", words, x=x, y=y, fill="currentColor", **look)


def image(x: float, y: float, wide: float, high: float, png: bytes) -> Markup:
    data = base64.b64encode(png).decode("ascii")
    return tag("image", x=x, y=y, width=wide, height=high, href=f"data:image/png;base64,{data}")
