"""The section at its pitch in its own wind: velocity triangle, angles and forces, as an SVG drawing.

Seen from the hub: the nose is left, so an ordinary flow comes from the left and reverse flow from the right. Angles
count clockwise from the disk plane, as pitch and inflow angle do on a blade seen so.
"""

import math
from dataclasses import dataclass

import numpy as np

from explorer.charts import svg
from explorer.charts.svg import Point
from explorer.picture.section_outline import blade_axes_outline
from explorer.tabs.probe.element import Blend, Probe
from explorer.text.units import number
from explorer.theme.colours import NOW, THIS
from rotor.arrays import Array

WIDTH, HEIGHT = 312.0, 166.0
LIFT, DRAG, ALPHA = THIS, NOW, "#099268"
OPENED = 3
"""How many times wider small angles are drawn on request."""
_QUARTER: Point = (126.0, 82.0)
"""Where the quarter chord is drawn."""
_CHORD = 100.0
_FASTEST, _STRONGEST = 88.0, 70.0
"""Lengths of the greatest velocity and load of the disk."""
_DRAG_FACTORS = (10, 5, 2)
"""Drag is a fiftieth of the lift: on its scale it would not be seen."""
_SMALL = math.radians(40.0)
"""Angles up to here are marked behind the trailing edge, where they have room; larger ones round the section."""
_WIDEST = math.radians(31.0)
"""As far as angles are opened."""
_RAY, _COLUMN = 134.0, 266.0
"""Where the rays of small angles end, and where their words begin."""
_OUTLINE = 61
_FAINT = 'opacity=".6"'
_BOLD = 'font-weight="600"'


@dataclass(frozen=True)
class Scales:
    """By how much things are drawn larger than true, or than on the scale of the whole disk."""

    velocity: int
    lift: int
    drag: int
    angles: int


@dataclass(frozen=True)
class _Sketch:
    """A probe with the angles as they are drawn."""

    probe: Probe
    theta: float
    phi: float
    alpha: float

    @property
    def small(self) -> bool:
        return max(abs(self.theta), abs(self.phi), abs(self.alpha)) < _SMALL

    @property
    def behind(self) -> bool:
        """Whether the flow comes from the trailing edge."""
        return self.probe.u_t < 0.0


def drawing(probe: Probe, fastest: float, strongest: float, opened: bool = False) -> tuple[str, Scales]:
    """The SVG, and its scales.

    `fastest` [m/s], `strongest` [N/m]: the greatest velocity and load on this disk. `opened`: small angles are drawn
    wider, so that the triangle is seen.
    """
    lift, drag = (_STRONGEST * abs(load) / strongest for load in (probe.lift, probe.drag))
    widest = max(abs(probe.theta), abs(probe.phi))
    scales = Scales(
        velocity=_factor(_FASTEST * probe.u / fastest, 24.0, (1, 2, 5, 10, 20)),
        lift=_factor(lift, 10.0, (1, 2, 5, 10, 20)) if probe.u_t < 0.0 else 1,
        drag=next((factor for factor in _DRAG_FACTORS if factor * drag < 0.8 * _STRONGEST), 1),
        angles=next((k for k in range(OPENED, 1, -1) if opened and k * widest < _WIDEST), 1),
    )
    k = scales.angles
    sketch = _Sketch(probe, k * probe.theta, k * probe.phi, k * (probe.theta - probe.phi) if k > 1 else probe.alpha)
    parts = (
        _ground(sketch),
        _section(sketch),
        _triangle(sketch, scales.velocity * _FASTEST / fastest),
        _angles(sketch),
        _forces(sketch, scales.lift * _STRONGEST / strongest, scales.drag * _STRONGEST / strongest),
    )
    drawn = (
        f'<svg viewBox="0 0 {WIDTH:g} {HEIGHT:g}" width="100%" role="img" data-explorer="probe-drawing" '
        f'aria-label="The blade section with its velocity triangle and forces">{"".join(parts)}</svg>'
    )
    return drawn, scales


def outline(section: Blend) -> Array:
    """The true outline, blended as the blade is; (y, z) in reference chords about the quarter chord."""
    inner, outer = (blade_axes_outline(name, _OUTLINE) for name in (section.inner, section.outer))
    return (1.0 - section.weight) * inner + section.weight * outer


def _factor(length: float, floor: float, factors: tuple[int, ...]) -> int:
    """The least factor that brings a length to `floor`; the last where none does."""
    return next((factor for factor in factors if factor * length >= floor), factors[-1])


def _ray(angle: float, reach: float) -> Point:
    return _QUARTER[0] + reach * math.cos(angle), _QUARTER[1] + reach * math.sin(angle)


def _turned(points: Array, angle: float) -> Array:
    """Points of blade axes (y to the nose, z up, in chords) on the drawing, the nose up by `angle`."""
    across, down = -_CHORD * points[:, 0], -_CHORD * points[:, 1]
    cos, sin = math.cos(angle), math.sin(angle)
    return np.stack((_QUARTER[0] + across * cos - down * sin, _QUARTER[1] + across * sin + down * cos), axis=1)


def _section(sketch: _Sketch) -> str:
    shape = _turned(outline(sketch.probe.section), sketch.theta)
    style = 'fill="rgba(128,128,128,.22)" stroke="currentColor" stroke-width="1.2" stroke-linejoin="round"'
    return svg.polygon([(x, y) for x, y in shape.tolist()], style)


def _ground(sketch: _Sketch) -> str:
    """The disk plane, and the chord line drawn out behind the section."""
    y = _QUARTER[1]
    plane = svg.line((4.0, y), (_QUARTER[0] + _RAY, y), width=0.9, style='stroke-dasharray="5 4" opacity=".55"')
    chord = svg.line(_ray(sketch.theta, -0.27 * _CHORD), _ray(sketch.theta, _RAY), width=0.8, style=_FAINT)
    return plane + chord


def _triangle(sketch: _Sketch, scale: float) -> str:
    """U_T, then U_P, and their resultant, which ends just short of the edge that it meets."""
    edge = -0.83 if sketch.behind else 0.32
    x, y = _turned(np.array([[edge, 0.0]]), sketch.theta)[0].tolist()
    reach = scale * sketch.probe.u
    start = x - reach * math.cos(sketch.phi), y - reach * math.sin(sketch.phi)
    corner, middle = (x, start[1]), 0.5 * (start[0] + x)
    above = sketch.phi >= 0.0
    over, under = (start[1] - 6.0, y + 15.0) if above else (start[1] + 13.0, y - 8.0)
    beside, anchor = (x - 3.0, "end") if sketch.behind else (x + 3.0, "start")
    return (
        svg.arrow(start, corner, width=1.3)
        + svg.arrow(corner, (x, y), width=1.3)
        + svg.arrow(start, (x, y), width=2.6)
        + svg.words((middle, over), "U", low="T")
        + svg.words((beside, over), "U", anchor, low="P")
        + svg.words((middle, under), "U", style=_BOLD)
    )


def _angles(sketch: _Sketch) -> str:
    """θ from the disk plane to the chord, φ to the wind, α from the wind to the chord."""
    probe, small = sketch.probe, sketch.small
    wind = svg.line(_ray(sketch.phi, 10.0), _ray(sketch.phi, _RAY if small else 76.0), width=0.8, style=_FAINT)
    theta, phi, alpha = (124.0, 98.0, 111.0) if small else (56.0, 32.0, 64.0)
    arcs = (
        svg.arc(_QUARTER, theta, 0.0, sketch.theta)
        + svg.arc(_QUARTER, phi, 0.0, sketch.phi)
        + svg.arc(_QUARTER, alpha, sketch.phi, sketch.alpha, ALPHA, 1.8)
    )
    places = _in_column(sketch) if small else _around(sketch)
    anchors = ("start", "start", "start", "end") if small else ("start", "middle", "middle", "start")
    words = (
        (f"θ {_degrees(probe.theta)}", "currentColor", ""),
        (f"φ {_degrees(probe.phi)}", "currentColor", ""),
        (f"α {_degrees(probe.alpha)}", ALPHA, _BOLD),
        ("disk plane", "currentColor", _FAINT),
    )
    return wind + arcs + "".join(
        svg.words(place, text, anchor, colour, style)
        for place, anchor, (text, colour, style) in zip(places, anchors, words, strict=True)
    )  # fmt: skip


def _in_column(sketch: _Sketch) -> list[Point]:
    """Places of the words θ, φ, α and "disk plane" one beneath the other, each near what it names."""
    heights = [_ray(angle, _RAY)[1] for angle in (sketch.theta, 0.5 * sketch.phi, sketch.phi + 0.5 * sketch.alpha, 0.0)]
    # The pitch spans both others: its word goes beyond the chord line, that of the plane to the other side.
    heights[0] += math.copysign(9.0, sketch.theta)
    heights[3] -= math.copysign(9.0, sketch.theta)
    edges = (_COLUMN, _COLUMN, _COLUMN, WIDTH - 1.0)
    return [(x, height + 3.5) for x, height in zip(edges, svg.spread(heights, 12.5), strict=True)]


def _around(sketch: _Sketch) -> list[Point]:
    """Places of the same words about the section, where angles are large."""
    x, y = _QUARTER
    inner, outer = _ray(0.5 * sketch.phi, 42.0), _ray(sketch.phi + 0.5 * sketch.alpha, 75.0)
    return [(x + 46.0, y - 6.0), (inner[0], inner[1] + 3.5), (outer[0], outer[1] + 3.5), (4.0, y - 5.0)]


def _forces(sketch: _Sketch, lift_scale: float, drag_scale: float) -> str:
    """Lift across the wind, drag along it, both from the quarter chord."""
    lift, drag = lift_scale * sketch.probe.lift, drag_scale * sketch.probe.drag
    cos, sin = math.cos(sketch.phi), math.sin(sketch.phi)
    x, y = _QUARTER
    tip = x + lift * sin, y - lift * cos
    text, place = "", (tip[0] + 7.0, tip[1] + 8.0 if tip[1] < y else max(tip[1] + 2.0, y + 19.0))
    if sketch.behind:  # All the angles are on one side: there is room on the other.
        text, place = "lift ", (x - 14.0, y - 40.0 if sketch.phi > 0.0 else y + 48.0)
    return (
        svg.arrow(_QUARTER, (x + drag * cos, y + drag * sin), DRAG, 2.6)
        + svg.arrow(_QUARTER, tip, LIFT, 3.2)
        + f'<circle cx="{x}" cy="{y}" r="2.4" fill="{svg.BODY}" stroke="currentColor" stroke-width="1.2"/>'
        + svg.words(place, f"{text}{number(sketch.probe.lift / 1e3, 2)} kN/m", "start", LIFT, _BOLD)
    )


def _degrees(angle: float) -> str:
    return f"{number(math.degrees(angle), 1)}°"
