"""The disk from above as SVG: field, marked regions, azimuth marks, flight arrow, colour bar and key."""

import math
from html import escape

from explorer.charts import svg
from explorer.colours import RIM, VOID, colour_map, css
from explorer.model.units import SI, Units
from explorer.picture import disk_image as image
from explorer.picture.fields import Field, reverse_flow
from explorer.picture.picture import disk_png
from explorer.picture.polar import polar_grid
from explorer.picture.regions import ALL_MARKS, MarkedRegion, Marks, region_codes
from explorer.picture.scene_theme import DiskInk
from explorer.text.design_words import flight_words, title_words
from rotor import Solution
from rotor.chart import round_ticks, tick_text

Range = tuple[float, float]

HALF = 134.0
"""Half the edge of the drawing, where the rotor's radius is 100."""
_STOPS = 25


def disk_drawing(
    solution: Solution,
    field: Field,
    colour_range: Range,
    pixels: int = image.SIZE,
    marks: Marks = ALL_MARKS,
    letters: float = 9.0,
    units: Units = SI,
) -> str:
    """The inside of an SVG that spans −HALF…HALF: nose up, advancing side right.

    `pixels`: along each edge of the field's picture; `letters`: their height.
    """
    half = image.half_width(100.0, min(pixels, image.LARGEST))
    png = disk_png(solution, field, colour_range, size=pixels, marks=marks)
    cutout = 100.0 * solution.design.rotor.blade.root_cutout
    rings = "".join(f'<circle r="{r:.2f}" fill="none"/>' for r in (100.0, cutout))
    rim = f'<g stroke="{css(RIM)}" stroke-width=".8">{rings}<path d="{_ticks()}"/></g>'
    return (
        f"{svg.image(-half, -half, 2 * half, 2 * half, png)}{rim}{_labels(letters)}{_flight(solution, letters, units)}"
    )


def disk_svg(solution: Solution, field: Field, colour_range: Range, marks: Marks, units: Units) -> str:
    """The drawing as a file of its own, with a title, the colour bar and the key; black on white."""
    size, wide = 9.0, 200.0
    key, at = [], -HALF + 6.0
    for title, swatch in key_entries(solution, field, marks):
        key.append(f'<g transform="translate({at:.1f} 0)">{swatch}{svg.text(18.0, 7.5, title, size)}</g>')
        at += 30.0 + 0.55 * size * len(title)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{-HALF:g} {-HALF - 34:g} {2 * HALF:g} {2 * HALF + 98:g}" '
        'font-family="system-ui,sans-serif" color="#212529" style="background:#fff">'
        f"{svg.text(0, -HALF - 20, title_words(solution.design), 10.5, anchor='middle', weight=650)}"
        f"{svg.text(0, -HALF - 6, flight_words(solution.design, units), size, anchor='middle')}"
        f"{disk_drawing(solution, field, colour_range, 1000, marks, size, units)}"
        f'<g transform="translate({-0.5 * wide:g} {HALF + 4:g})">{bar_drawing(field, colour_range, wide, "scale")}</g>'
        f'<g transform="translate(0 {HALF + 48:g})">{"".join(key)}</g></svg>'
    )


def _ticks() -> str:
    parts = []
    for degrees in range(0, 360, 10):
        reach = 4.0 if degrees % 90 == 0 else 2.4 if degrees % 30 == 0 else 1.2
        (x, y), (x_end, y_end) = _at(degrees, 100.6), _at(degrees, 100.6 + reach)
        parts.append(f"M{x:.2f},{y:.2f}L{x_end:.2f},{y_end:.2f}")
    return "".join(parts)


def _labels(size: float) -> str:
    """Four azimuths, and the sense of rotation outside the rim between ψ 22° and 51°."""
    (x, y), (x_end, y_end) = _at(22.0, 109.0), _at(45.0, 109.0)
    head = " ".join(f"{a:.2f},{b:.2f}" for a, b in (_at(45.0, 105.6), _at(51.0, 109.0), _at(45.0, 112.4)))
    return (
        svg.text(0, 107 + size, "ψ = 0°", size, anchor="middle")
        + svg.text(107, 0.35 * size, "90°", size)
        + svg.text(0, -107, "180°", size, anchor="middle")
        + svg.text(-107, 0.35 * size, "270°", size, anchor="end")
        + f'<path d="M{x:.2f},{y:.2f}A109,109 0 0 0 {x_end:.2f},{y_end:.2f}" fill="none" stroke="{css(RIM)}" '
        f'stroke-width="2.4"/><polygon points="{head}" fill="{css(RIM)}"/>'
    )


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
    for value in round_ticks(low, high, 5):
        x = wide * (value - low) / (high - low)
        scale.append(f'<path d="M{x:.1f},{2.5 * size:.1f}v{0.35 * size:.1f}" stroke="currentColor"/>')
        scale.append(svg.text(x, 3.75 * size, tick_text(value), 0.92 * size, anchor="middle"))
    return (
        f'<linearGradient id="{escape(name)}">{stops}</linearGradient>{svg.text(0, size, field.label, size)}'
        f'<rect y="{1.5 * size:.1f}" width="{wide:g}" height="{size:g}" rx="1" fill="url(#{escape(name)})"/>'
        + "".join(scale)
    )


def key_entries(solution: Solution, field: Field, marks: Marks = ALL_MARKS) -> list[tuple[str, str]]:
    """Key of the marked regions and the grey patch: title, and a swatch 14 × 8 as the inside of an SVG."""
    grid, ink = polar_grid(solution.disk, 80, 240), DiskInk()
    codes = region_codes(solution, grid, marks, 0.02)
    entries = []
    for region, title, colour, dash in (
        (MarkedRegion.REVERSE, "reverse flow", ink.reverse_flow, ""),
        (MarkedRegion.STALLED, "stall", ink.stall, ""),
        (MarkedRegion.DASH, "drag divergence", ink.drag_divergence, ' stroke-dasharray="4 3"'),
    ):
        if codes is not None and (codes == region).any():
            entries.append((title, f'<path d="M0,4h14" stroke="{css(colour)}" stroke-width="3"{dash}/>'))
    if field.void_in_reverse_flow and not marks.reverse_flow and reverse_flow(solution, grid).any():
        entries.append(("not defined", f'<rect width="14" height="8" rx="1.5" fill="{css(VOID)}"/>'))
    return entries
