"""The disk from above as SVG of any size: field, outlines, azimuth marks, flight arrow, colour bar and key."""

import math
from html import escape

from explorer.charts import svg
from explorer.model.units import SI, Units
from explorer.picture import disk_image as image
from explorer.picture.fields import Field, tick_text, ticks
from explorer.picture.outlines import drag_divergence_segments, reverse_flow_segments, stall_segments
from explorer.picture.picture import OUTLINE_COLOURS, disk_png
from explorer.theme.colours import RIM, VOID, colour_map, css
from rotor.arrays import Array
from rotor.trim.solution import Solution

Range = tuple[float, float]

HALF = 134.0
"""Half the edge of the drawing, where the rotor's radius is 100."""
OUTLINES = {
    "reverse_flow": ("reverse flow", reverse_flow_segments),
    "stall": ("stall", stall_segments),
    "drag_divergence": ("drag divergence", drag_divergence_segments),
}
"""Title and source of each line on the disk, by the name of the toggle in `ViewState`."""
_STOPS = 25


def disk_drawing(
    solution: Solution,
    field: Field,
    colour_range: Range,
    pixels: int = image.SIZE,
    shown: tuple[str, ...] = tuple(OUTLINES),
    letters: float = 9.0,
    units: Units = SI,
) -> str:
    """The inside of an SVG that spans −HALF…HALF: nose up, advancing side right.

    `pixels`: along each edge of the field's picture; `shown`: names of the outlines; `letters`: their height.
    """
    half = image.half_width(100.0, min(pixels, image.LARGEST))
    picture = svg.image(-half, -half, 2 * half, 2 * half, disk_png(solution, field, colour_range, size=pixels))
    cutout = 100.0 * solution.design.rotor.blade.root_cutout
    rings = "".join(f'<circle r="{r:.2f}" fill="none"/>' for r in (100.0, cutout))
    rim = f'<g stroke="{css(RIM)}" stroke-width=".8">{rings}<path d="{_ticks()}"/></g>'
    return f"{picture}{rim}{_lines(solution, shown)}{_labels(letters)}{_flight(solution, letters, units)}"


def _lines(solution: Solution, shown: tuple[str, ...]) -> str:
    """Outlines, each with a casing, so that they can be seen on every colour."""
    out = []
    for name in shown:
        lines = [_up(line) for line in svg.joined(OUTLINES[name][1](solution))]
        if lines:
            colour, casing = OUTLINE_COLOURS[name]
            path = svg.polylines(lines)
            out += [
                f'<path d="{path}" stroke="{css(paint)}" stroke-width="{width}"/>'
                for paint, width in ((casing, 2.2), (colour, 1.0))
            ]
    return f'<g fill="none" stroke-linejoin="round" stroke-linecap="round">{"".join(out)}</g>'


def _up(points: Array) -> Array:
    """From (aft, starboard) in radii to the drawing's right and down."""
    return 100.0 * points[..., ::-1]


def _ticks() -> str:
    parts = []
    for degrees in range(0, 360, 10):
        psi = math.radians(degrees)
        reach = 4.0 if degrees % 90 == 0 else 2.4 if degrees % 30 == 0 else 1.2
        x, y = math.sin(psi), math.cos(psi)
        parts.append(f"M{100.6 * x:.2f},{100.6 * y:.2f}L{(100.6 + reach) * x:.2f},{(100.6 + reach) * y:.2f}")
    return "".join(parts)


def _labels(size: float) -> str:
    return "".join(
        (
            svg.text(0, 107 + size, "ψ = 0°", size, anchor="middle"),
            svg.text(107, 0.35 * size, "90°", size),
            svg.text(0, -107, "180°", size, anchor="middle"),
            svg.text(-107, 0.35 * size, "270°", size, anchor="end"),
            # Arrow of the sense of rotation, outside the rim between ψ 22° and 50°.
            f'<g fill="{css(RIM)}" stroke="none"><path d="{_arc(22.0, 45.0, 109.0, 2.4)}"/>'
            f'<path d="{_arrow_head(45.0, 51.0, 109.0, 3.4)}"/></g>',
        )
    )


def _arc(begin: float, end: float, radius: float, thickness: float) -> str:
    inner, outer = radius - thickness / 2, radius + thickness / 2
    (ax, ay), (bx, by), (cx, cy), (dx, dy) = (
        _at(psi, r) for psi, r in ((begin, inner), (end, inner), (end, outer), (begin, outer))
    )
    return (
        f"M{ax:.2f},{ay:.2f}A{inner:g},{inner:g} 0 0 0 {bx:.2f},{by:.2f}"
        f"L{cx:.2f},{cy:.2f}A{outer:g},{outer:g} 0 0 1 {dx:.2f},{dy:.2f}Z"
    )


def _arrow_head(base: float, tip: float, radius: float, half: float) -> str:
    points = [_at(base, radius - half), _at(tip, radius), _at(base, radius + half)]
    return "M" + "L".join(f"{x:.2f},{y:.2f}" for x, y in points) + "Z"


def _at(psi_deg: float, r: float) -> tuple[float, float]:
    psi = math.radians(psi_deg)
    return r * math.sin(psi), r * math.cos(psi)


def _flight(solution: Solution, size: float, units: Units) -> str:
    """The arrow ahead of the nose with the speed; nothing in hover."""
    speed = solution.design.airspeed
    if speed == 0.0:
        return ""
    arrow = '<path d="M0,-131 l4.4,7 h-2.9 v6 h-3 v-6 h-2.9 Z" fill="#c92a2a"/>'
    return arrow + svg.text(7, -124.5 + 0.35 * size, units.speed[0].text(speed), size)


def bar_drawing(field: Field, colour_range: Range, wide: float, name: str, size: float = 9.0) -> str:
    """A colour bar `wide` across with its label above and its numbers below: 4 × `size` high. `name`: unique."""
    low, high = colour_range
    stops = "".join(
        f'<stop offset="{k / (_STOPS - 1):.4f}" stop-color="{css(colour)}"/>'
        for k, colour in enumerate(colour_map(field.colours, _STOPS).tolist())
    )
    scale = []
    for value in ticks(low, high):
        x = wide * (value - low) / (high - low)
        scale.append(f'<path d="M{x:.1f},{2.5 * size:.1f}v{0.35 * size:.1f}" stroke="currentColor"/>')
        scale.append(svg.text(x, 3.75 * size, tick_text(value), 0.92 * size, anchor="middle"))
    return (
        f'<linearGradient id="{escape(name)}">{stops}</linearGradient>{svg.text(0, size, field.label, size)}'
        f'<rect y="{1.5 * size:.1f}" width="{wide:g}" height="{size:g}" rx="1" fill="url(#{escape(name)})"/>'
        + "".join(scale)
    )


def key_entries(solution: Solution, field: Field, shown: tuple[str, ...] = tuple(OUTLINES)) -> list[tuple[str, str]]:
    """Key of the outlines and the grey patch: title, and a swatch 14 × 8 as the inside of an SVG."""
    entries = []
    for name in shown:
        title, source = OUTLINES[name]
        if len(source(solution)):
            line, casing = OUTLINE_COLOURS[name]
            entries.append(
                (
                    title,
                    f'<path d="M0,4h14" stroke="{css(casing)}" stroke-width="4.4"/>'
                    f'<path d="M0,4h14" stroke="{css(line)}" stroke-width="2"/>',
                )
            )
    if field.void_in_reverse_flow and len(reverse_flow_segments(solution)):
        entries.append(("not defined", f'<rect width="14" height="8" rx="1.5" fill="{css(VOID)}"/>'))
    return entries
