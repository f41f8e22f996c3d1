"""Drawings as SVG: marks, words and lines of any size."""

import base64
import math
from collections.abc import Iterable
from html import escape

Point = tuple[float, float]

BODY = "var(--mantine-color-body)"
"""The page's ground, for the halo that keeps words readable on lines."""


def line(start: Point, end: Point, colour: str = "currentColor", width: float = 1.0, style: str = "") -> str:
    return (
        f'<line x1="{start[0]:.1f}" y1="{start[1]:.1f}" x2="{end[0]:.1f}" y2="{end[1]:.1f}" '
        f'stroke="{colour}" stroke-width="{width:g}" {style}/>'
    )


def arrow(start: Point, end: Point, colour: str = "currentColor", width: float = 2.0) -> str:
    """A straight arrow; its head shrinks with it, and there is none where there is no length."""
    reach = math.dist(start, end)
    if reach < 0.5:
        return ""
    head = min(7.0 + width, 0.6 * reach)
    along = (end[0] - start[0]) / reach, (end[1] - start[1]) / reach
    neck = end[0] - head * along[0], end[1] - head * along[1]
    half = 0.38 * head
    corners = (
        end,
        (neck[0] - half * along[1], neck[1] + half * along[0]),
        (neck[0] + half * along[1], neck[1] - half * along[0]),
    )
    return line(start, neck, colour, width) + polygon(corners, f'fill="{colour}"')


def arc(
    centre: Point, radius: float, start: float, sweep: float, colour: str = "currentColor", width: float = 1.0
) -> str:
    """Part of a circle from an angle [rad, clockwise from +x] on by `sweep`, with a small head at its end."""
    end = start + sweep
    first, last = _on(centre, radius, start), _on(centre, radius, end)
    large, way = int(abs(sweep) > math.pi), int(sweep > 0.0)
    path = (
        f'<path d="M{first[0]:.1f},{first[1]:.1f} A{radius:g},{radius:g} 0 {large} {way} {last[0]:.1f},{last[1]:.1f}" '
        f'fill="none" stroke="{colour}" stroke-width="{width:g}"/>'
    )
    if abs(sweep) * radius < 9.0:
        return path
    back = end - math.copysign(5.5 / radius, sweep)
    head = (last, _on(centre, radius - 2.2, back), _on(centre, radius + 2.2, back))
    return path + polygon(head, f'fill="{colour}"')


def polygon(points: Iterable[Point], style: str) -> str:
    return f'<polygon points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in points)}" {style}/>'


def words(
    at: Point, text: str, anchor: str = "middle", colour: str = "currentColor", style: str = "", *, low: str = ""
) -> str:
    """Text with a halo, so that it reads on whatever it crosses; `low` is its subscript."""
    subscript = f'<tspan font-size="10" dy="2.5">{escape(low)}</tspan>' if low else ""
    return (
        f'<text x="{at[0]:.1f}" y="{at[1]:.1f}" text-anchor="{anchor}" fill="{colour}" font-size="12" '
        f'stroke="{BODY}" stroke-width="3" paint-order="stroke" stroke-linejoin="round" {style}>'
        f"{escape(text)}{subscript}</text>"
    )


def tick(at: Point, text: str, anchor: str) -> str:
    """A number along an axis."""
    look = 'font-size="12" fill="currentColor"'
    return f'<text x="{at[0]:.1f}" y="{at[1]:.1f}" {look} text-anchor="{anchor}">{escape(text)}</text>'


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


def text(
    x: float, y: float, words: str, size: float, *, anchor: str = "start", weight: int = 400, opacity: float = 1.0
) -> str:
    """Text whose baseline starts, is centred or ends at a point."""
    look = f'font-size="{size:g}" text-anchor="{anchor}"'
    look += f' font-weight="{weight}"' if weight != 400 else ""
    look += f' opacity="{opacity:g}"' if opacity < 1.0 else ""
    return f'<text x="{x:.1f}" y="{y:.1f}" fill="currentColor" {look}>{escape(words)}</text>'


def image(x: float, y: float, wide: float, high: float, png: bytes) -> str:
    data = base64.b64encode(png).decode("ascii")
    return (
        f'<image x="{x:.2f}" y="{y:.2f}" width="{wide:.2f}" height="{high:.2f}" href="data:image/png;base64,{data}"/>'
    )
