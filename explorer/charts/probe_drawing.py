"""The probe as a drawing and in words: section, velocity triangle, angles and forces; its numbers."""

import math
from dataclasses import dataclass

import numpy as np

from explorer.charts import svg
from explorer.charts.probe_measured import HEIGHT as CHART_HEIGHT
from explorer.charts.probe_measured import lift_chart, with_indices
from explorer.charts.svg import Point, chart_box
from explorer.colours import NOW, THIS
from explorer.model.units import adding, degrees, number
from explorer.picture.element import FlowRegion, Probe, outline, sections_of, where
from explorer.text.glossary import tip
from explorer.text.readout import dash
from rotor import Solution
from rotor.support.arrays import Array
from rotor.support.chart import drawn_chart
from rotor.support.markup import Attribute, Content, Markup, group, tag

WIDTH, HEIGHT = 312.0, 166.0
LIFT, DRAG, ALPHA = THIS, NOW, "#099268"
LIFT_INK, ALPHA_INK = "var(--rx-accent)", "var(--rx-good)"
"""Of words, which need more contrast than lines."""
_QUARTER: Point = (126.0, 82.0)
"""Where the quarter chord is drawn."""
_CHORD = 100.0
_FASTEST, _STRONGEST = 88.0, 70.0
"""Lengths of the greatest velocity and load of the disk."""
_DRAG_FACTORS = (10, 5, 2)
"""Drag is a fiftieth of the lift: on its scale it would not be seen."""
_SMALL = math.radians(40.0)
"""Angles up to here are marked behind the trailing edge, where they have room; larger ones round the section."""
_RAY, _COLUMN = 134.0, 266.0
"""Where the rays of small angles end, and where their words begin."""
_FAINT, _BOLD = 0.6, 600
"""Opacity of what is less important, and weight of what is more."""


@dataclass(frozen=True)
class DrawingScales:
    """By how much things are drawn larger than true, or than on the scale of the whole disk."""

    velocity: int
    lift: int
    drag: int


@dataclass(frozen=True)
class PrintedAngles:
    """The angles of a section with one decimal [°], rounded so that θ − φ + pitch rate is α as printed."""

    theta: float
    phi: float
    pitch_rate: float | None
    """None in steady flow."""
    turn: float
    """Whole turns between the sum and α, which is within ±180°."""

    @property
    def alpha(self) -> float:
        """α within ±180°."""
        return math.fsum((self.theta, -self.phi, self.pitch_rate or 0.0, self.turn))

    @property
    def sentence(self) -> str:
        """`θ 14.7° − φ 1.9° + pitch rate 0.5° = α 13.3°`"""
        words = f"θ {number(self.theta, 1)}° − φ {_in_a_sum(self.phi)}"
        if self.pitch_rate is not None:
            words += f" + pitch rate {_in_a_sum(self.pitch_rate)}"
        if self.turn:
            words += f" {'−' if self.turn < 0.0 else '+'} {number(abs(self.turn))}°"
        return f"{words} = α {number(self.alpha, 1)}°"


def printed_angles(probe: Probe) -> PrintedAngles:
    """The angles of a section as they are printed."""
    parts = [probe.theta, -probe.phi]
    if probe.pitch_rate is not None:
        parts.append(probe.pitch_rate)
    degrees_of_parts = [math.degrees(part) for part in parts]
    theta, minus_phi, *rate = adding(degrees_of_parts, 1)
    turns = round((math.degrees(probe.alpha) - math.fsum(degrees_of_parts)) / 360.0)
    return PrintedAngles(theta, -minus_phi, rate[0] if rate else None, 360.0 * turns)


def _in_a_sum(angle: float) -> str:
    """An angle [°] behind the sign of its term: one below zero in brackets."""
    text = f"{number(angle, 1)}°"
    return f"({text})" if text.startswith("−") else text


@dataclass(frozen=True)
class _Sketch:
    """A probe with its angles as they are printed."""

    probe: Probe
    printed: PrintedAngles

    @property
    def small(self) -> bool:
        here = self.probe
        return max(abs(here.theta), abs(here.phi), abs(here.alpha)) < _SMALL

    @property
    def behind(self) -> bool:
        """Whether the flow comes from the trailing edge."""
        return self.probe.u_t < 0.0


def drawing(probe: Probe, fastest: float, strongest: float) -> tuple[Markup, DrawingScales]:
    """The SVG, and its scales.

    `fastest` [m/s], `strongest` [N/m]: the greatest velocity and load on this disk.
    """
    lift, drag = (_STRONGEST * abs(load) / strongest for load in (probe.lift, probe.drag))
    scales = DrawingScales(
        velocity=_factor(_FASTEST * probe.u / fastest, 24.0, (1, 2, 5, 10, 20)),
        lift=_factor(lift, 10.0, (1, 2, 5, 10, 20)) if probe.u_t < 0.0 else 1,
        drag=next((factor for factor in _DRAG_FACTORS if factor * drag < 0.8 * _STRONGEST), 1),
    )
    sketch = _Sketch(probe, printed_angles(probe))
    parts = (
        _ground(sketch),
        _section(sketch),
        _triangle(sketch, scales.velocity * _FASTEST / fastest),
        _angles(sketch),
        _forces(sketch, scales.lift * _STRONGEST / strongest, scales.drag * _STRONGEST / strongest),
    )
    label = "The blade section with its velocity triangle and forces"
    marks: dict[str, Attribute] = {"data_explorer": "probe-drawing", "aria_label": label}
    return tag(
        "svg", *parts, viewBox=f"0 0 {WIDTH:g} {HEIGHT:g}", width="100%", role="img", **marks
    ), scales


def _factor(length: float, floor: float, factors: tuple[int, ...]) -> int:
    """The least factor that brings a length to `floor`; the last where none does."""
    return next((factor for factor in factors if factor * length >= floor), factors[-1])


def _ray(angle: float, reach: float) -> Point:
    return _QUARTER[0] + reach * math.cos(angle), _QUARTER[1] + reach * math.sin(angle)


def _turned(points: Array, angle: float) -> Array:
    """Points of blade axes (y to the nose, z up, in chords) on the drawing, the nose up by `angle`."""
    across, down = -_CHORD * points[:, 0], -_CHORD * points[:, 1]
    cos, sin = math.cos(angle), math.sin(angle)
    return np.stack(
        (_QUARTER[0] + across * cos - down * sin, _QUARTER[1] + across * sin + down * cos), axis=1
    )


def _section(sketch: _Sketch) -> Markup:
    shape = _turned(outline(sketch.probe.section), sketch.probe.theta)
    look: dict[str, Attribute] = {
        "fill": "rgba(128,128,128,.22)",
        "stroke": "currentColor",
        "stroke_width": 1.2,
    }
    return svg.polygon([(x, y) for x, y in shape.tolist()], **look, stroke_linejoin="round")


def _ground(sketch: _Sketch) -> Markup:
    """The disk plane, and the chord line drawn out behind the section."""
    y = _QUARTER[1]
    plane = svg.line((4.0, y), (_QUARTER[0] + _RAY, y), width=0.9, dashes="5 4", opacity=0.55)
    chord = svg.line(
        _ray(sketch.probe.theta, -0.27 * _CHORD),
        _ray(sketch.probe.theta, _RAY),
        width=0.8,
        opacity=_FAINT,
    )
    return plane + chord


def _triangle(sketch: _Sketch, scale: float) -> Markup:
    """U_T, then U_P, and their resultant, which ends just short of the edge that it meets."""
    edge = -0.83 if sketch.behind else 0.32
    x, y = _turned(np.array([[edge, 0.0]]), sketch.probe.theta)[0].tolist()
    reach = scale * sketch.probe.u
    start = x - reach * math.cos(sketch.probe.phi), y - reach * math.sin(sketch.probe.phi)
    corner, middle = (x, start[1]), 0.5 * (start[0] + x)
    above = sketch.probe.phi >= 0.0
    over, under = (start[1] - 6.0, y + 15.0) if above else (start[1] + 13.0, y - 8.0)
    beside, anchor = (x - 3.0, "end") if sketch.behind else (x + 3.0, "start")
    return group(
        svg.arrow(start, corner, width=1.3),
        svg.arrow(corner, (x, y), width=1.3),
        svg.arrow(start, (x, y), width=2.6),
        svg.words((middle, over), "U", low="T"),
        svg.words((beside, over), "U", anchor, low="P"),
        svg.words((middle, under), "U", weight=_BOLD),
    )


def _angles(sketch: _Sketch) -> Markup:
    """θ from the disk plane to the chord, φ to the wind, α from the wind to the chord, which the pitch rate turns."""
    probe, printed, small = sketch.probe, sketch.printed, sketch.small
    wind = svg.line(
        _ray(sketch.probe.phi, 10.0),
        _ray(sketch.probe.phi, _RAY if small else 76.0),
        width=0.8,
        opacity=_FAINT,
    )
    theta, phi, alpha = (124.0, 98.0, 111.0) if small else (56.0, 32.0, 64.0)
    arcs = (
        svg.arc(_QUARTER, theta, 0.0, sketch.probe.theta)
        + svg.arc(_QUARTER, phi, 0.0, sketch.probe.phi)
        + svg.arc(_QUARTER, alpha, sketch.probe.phi, sketch.probe.alpha, ALPHA, 1.8)
    )
    if small and probe.pitch_rate is not None:
        # The chord as the flow meets it, from which α is counted.
        met = sketch.probe.phi + sketch.probe.alpha
        arcs += svg.line(_ray(met, 72.0), _ray(met, _RAY), ALPHA, width=0.8, dashes="2 2")
    places = _in_column(sketch) if small else _around(sketch)
    anchors = (
        ("start", "start", "start", "end") if small else ("start", "middle", "middle", "start")
    )
    words = (
        (f"θ {number(printed.theta, 1)}°", "currentColor", None, None),
        (f"φ {number(printed.phi, 1)}°", "currentColor", None, None),
        (f"α {degrees(probe.alpha, 1)}", ALPHA_INK, _BOLD, None),
        ("disk plane", "currentColor", None, _FAINT),
    )
    labels = [
        svg.words(place, text, anchor, colour, weight=weight, opacity=opacity)
        for place, anchor, (text, colour, weight, opacity) in zip(
            places, anchors, words, strict=True
        )
    ]
    return group(wind, arcs, labels)


def _in_column(sketch: _Sketch) -> list[Point]:
    """Places of the words θ, φ, α and "disk plane" one beneath the other, each near what it names."""
    heights = [
        _ray(angle, _RAY)[1]
        for angle in (
            sketch.probe.theta,
            0.5 * sketch.probe.phi,
            sketch.probe.phi + 0.5 * sketch.probe.alpha,
            0.0,
        )
    ]
    # The pitch spans both others: its word goes beyond the chord line, that of the plane to the other side.
    heights[0] += math.copysign(9.0, sketch.probe.theta)
    heights[3] -= math.copysign(9.0, sketch.probe.theta)
    edges = (_COLUMN, _COLUMN, _COLUMN, WIDTH - 1.0)
    return [
        (x, height + 3.5)
        for x, height in zip(edges, svg.spread_heights(heights, 12.5), strict=True)
    ]


def _around(sketch: _Sketch) -> list[Point]:
    """Places of the same words about the section, where angles are large."""
    x, y = _QUARTER
    inner, outer = (
        _ray(0.5 * sketch.probe.phi, 42.0),
        _ray(sketch.probe.phi + 0.5 * sketch.probe.alpha, 75.0),
    )
    return [
        (x + 46.0, y - 6.0),
        (inner[0], inner[1] + 3.5),
        (outer[0], outer[1] + 3.5),
        (4.0, y - 5.0),
    ]


def _forces(sketch: _Sketch, lift_scale: float, drag_scale: float) -> Markup:
    """Lift across the wind, drag along it, both from the quarter chord."""
    lift, drag = lift_scale * sketch.probe.lift, drag_scale * sketch.probe.drag
    cos, sin = math.cos(sketch.probe.phi), math.sin(sketch.probe.phi)
    x, y = _QUARTER
    tip = x + lift * sin, y - lift * cos
    text, place = "", (tip[0] + 7.0, tip[1] + 8.0 if tip[1] < y else max(tip[1] + 2.0, y + 19.0))
    if sketch.behind:  # All the angles are on one side: there is room on the other.
        text, place = "lift ", (x - 14.0, y - 40.0 if sketch.probe.phi > 0.0 else y + 48.0)
    return group(
        svg.arrow(_QUARTER, (x + drag * cos, y + drag * sin), DRAG, 2.6),
        svg.arrow(_QUARTER, tip, LIFT, 3.2),
        tag("circle", cx=x, cy=y, r=2.4, fill=svg.BODY, stroke="currentColor", stroke_width=1.2),
        svg.words(
            place,
            f"{text}{number(sketch.probe.lift / 1e3, 2)} kN/m",
            "start",
            LIFT_INK,
            weight=_BOLD,
        ),
    )


_CHIPS = {
    FlowRegion.IDLE: "back",
    FlowRegion.ATTACHED: "good",
    FlowRegion.SEPARATED: "bad",
    FlowRegion.PAST_STATIC: "back",
    FlowRegion.REVERSE: "back",
    FlowRegion.DIVERGED: "bad",
}


def probe_panel(probe: Probe, solution: Solution, measured: Content = None) -> Markup:
    """Everything about one blade element, one beneath the other.

    `measured`: airloads over the azimuth, as `measured_panel` draws them.
    """
    disk, design = solution.disk, solution.design
    fastest = design.rotor.tip_speed * float(np.hypot(disk.u_t, disk.u_p).max())
    strongest = design.thrust_per_metre * float(np.hypot(disk.dct, disk.dcq).max())
    picture, scales = drawing(probe, fastest, strongest)
    return tag(
        "div.rx.rx-probe",
        _head(probe),
        picture,
        _sum(probe),
        _key(scales),
        _table(probe),
        measured,
        chart_box(drawn_chart(lift_chart(probe)), CHART_HEIGHT),
        data_explorer="probe",
    )


def _head(probe: Probe) -> Markup:
    alpha, chip = (
        f"α {degrees(probe.alpha, 1)}",
        f"span.rx-push.rx-chip.rx-chip-{_CHIPS[probe.region]}",
    )
    return tag(
        "div.rx-line.rx-base",
        tag("span.rx-best", alpha, data_explorer="probe-alpha", title=_alpha_tip(probe)),
        tag("span.rx-dim", where(probe.psi), data_explorer="probe-place"),
        tag(chip, probe.region.value, data_explorer="probe-region", title=tip("probe_region")),
    )


def _sum(probe: Probe) -> Markup:
    """What the angle of attack is made of."""
    return tag(
        "div.rx-line.rx-small.rx-num",
        printed_angles(probe).sentence,
        data_explorer="probe-angles",
        title=_alpha_tip(probe),
    )


def _alpha_tip(probe: Probe) -> str:
    """The formula of α that is used here."""
    return tip("probe_alpha" if probe.pitch_rate is None else "probe_alpha_unsteady")


def _key(scales: DrawingScales) -> Markup:
    """The colours of the arrows, and what is drawn larger than true or than on the scale of the whole disk."""
    entries = (
        ("velocity", "currentColor", scales.velocity),
        ("lift", LIFT, scales.lift),
        ("drag", DRAG, scales.drag),
    )
    keys = [
        tag("span", dash(colour), f"{name}{_times(factor)}") for name, colour, factor in entries
    ]
    view = tag("span.rx-push", "seen from the hub")
    return tag("div.rx-line.rx-small.rx-dim.rx-base", keys, view)


def _times(factor: int) -> str:
    return f" ×{factor}" if factor > 1 else ""


def _table(probe: Probe) -> Markup:
    margin = probe.stall_margin
    entries = (
        ("probe_u_t", "Tangential U_T", f"{number(probe.u_t, 1)} m/s"),
        ("probe_mach", "Mach", number(probe.mach, 3)),
        ("probe_induced", "Induced v_i", f"{number(probe.induced, 1)} m/s"),
        ("probe_cl", "C_l", number(probe.cl, 3)),
        ("probe_margin", "Stall margin", "–" if margin is None else degrees(margin, 1)),
        ("probe_cd", "C_d", number(probe.cd, 4)),
        (
            "probe_elastic",
            "Elastic twist",
            "–" if probe.elastic is None else degrees(probe.elastic),
        ),
        ("probe_section", "Section", sections_of(probe.section)),
        ("probe_power", "Power", f"{number(probe.power / 1e3, 1)} kW/m"),
    )
    cells = [
        tag(
            "div.rx-line",
            tag("span.rx-dim", with_indices(name)),
            tag("span.rx-num", value),
            title=tip(key),
        )
        for key, name, value in entries
    ]
    return tag("div.rx-grid", cells)
