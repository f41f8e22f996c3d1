"""The section of a probe beside public data: its lift curve, and a table of the nearest points."""

import math
from html import escape

import numpy as np

from explorer.charts import svg
from explorer.tabs.probe.element import Probe
from explorer.text.glossary import tip
from explorer.text.status import section_title
from explorer.text.units import number
from explorer.theme.colours import LIMIT, NOW, THIS
from rotor.airfoil.public_points import SOURCES, PublicPoint, nearest_points, points_near

LIFT, MARK = THIS, "#099268"
_WIDTH, _HEIGHT = 312.0, 96.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 26.0, 300.0, 6.0, 80.0
_SHORT = {
    "umd-rans": "RANS",
    "umd-net": "RANS net",
    "cr-166309": "simulation deck",
    "tm-86719": "wind tunnel",
}


def lift_curve(probe: Probe) -> str:
    """C_l over α of this section at this Mach number, both stall angles, public points, and where the element is."""
    degrees = math.degrees(probe.alpha)
    low, high, step = (-15.0, 20.0, 5.0) if -15.0 < degrees < 20.0 else (-180.0, 180.0, 60.0)
    alpha = np.linspace(low, high, 91)
    curve = probe.section.lift_curve(np.radians(alpha), probe.table_mach)
    bottom, top = min(-1.0, float(curve.min()), probe.cl), max(1.6, float(curve.max()), probe.cl)

    def x(value: float) -> float:
        return _LEFT + (value - low) / (high - low) * (_RIGHT - _LEFT)

    def y(value: float) -> float:
        return _BOTTOM - (value - bottom) / (top - bottom) * (_BOTTOM - _TOP)

    marks = []
    for tick in np.arange(low, high + 0.1, step):
        marks.append(svg.line((x(tick), _BOTTOM), (x(tick), _BOTTOM + 3.0), width=0.8))
        if tick % (2.0 * step) == 0.0:
            marks.append(svg.tick((x(tick), _HEIGHT - 4.0), f"{number(tick)}°", "middle"))
    for tick in (-1.0, 0.0, 1.0):
        style = 'opacity=".5"' if tick == 0.0 else 'opacity=".18"'
        marks.append(svg.line((_LEFT, y(tick)), (_RIGHT, y(tick)), width=0.8, style=style))
        marks.append(svg.tick((_LEFT - 5.0, y(tick) + 3.5), number(tick), "end"))
    for angle in probe.stall:
        end = math.degrees(angle)
        if low < end < high:
            marks.append(svg.line((x(end), _TOP), (x(end), _BOTTOM), LIMIT, 1.2, 'stroke-dasharray="4 3"'))
    for point in _near(probe):
        at = x(math.degrees(point.alpha + probe.section.main.incidence_offset)), y(point.cl)
        if low < math.degrees(point.alpha) < high and bottom <= point.cl <= top:
            marks.append(
                f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="2.6" fill="none" stroke="currentColor" opacity=".7">'
                f"<title>{escape(SOURCES[point.source])}</title></circle>"
            )
    path = " ".join(f"{x(a):.1f},{y(cl):.1f}" for a, cl in zip(alpha.tolist(), curve.tolist(), strict=True))
    marks.append(f'<polyline points="{path}" fill="none" stroke="{LIFT}" stroke-width="1.8"/>')
    here = x(degrees), y(probe.cl)
    marks.append(svg.line((here[0], _BOTTOM), here, MARK, 1.0))
    if not probe.idle:
        marks.append(f'<circle cx="{here[0]:.1f}" cy="{here[1]:.1f}" r="4" fill="{NOW}" stroke="{svg.BODY}"/>')
    return (
        f'<div class="rx-line rx-probe-title"{tip("chart_lift_curve")}><span><b>Lift curve</b></span>'
        f'<span class="rx-dim">C<sub>l</sub> over α at Mach {number(probe.table_mach, 2)}</span>'
        f'<span><span class="rx-dash" style="background:{LIMIT}"></span>stall</span></div>'
        f'<svg viewBox="0 0 {_WIDTH:g} {_HEIGHT:g}" width="100%" role="img" '
        f'aria-label="Lift coefficient over angle of attack">{"".join(marks)}</svg>'
    )


def public_table(probe: Probe) -> str:
    """The nearest public point of each source with our coefficients at the same point; empty where none is near."""
    section = probe.section.main
    rows = []
    for point in nearest_points(section.name, probe.table_mach, probe.alpha - section.incidence_offset):
        here, moment = section.table(point.alpha, point.mach), section.table.moment(point.alpha, point.mach)
        place = f"M {number(point.mach, 2)}, {number(math.degrees(point.alpha), 1)}°"
        use = "kept aside" if point.kept_aside else "used for the section data"
        rows.append(
            f'<tr title="{escape(SOURCES[point.source])}: {use}"><td>{_SHORT[point.source]}, {place}</td>'
            f"{_cells(point.cl, point.cd, point.cm)}</tr>"
            f'<tr class="rx-dim"><td>section data</td>'
            f"{_cells(float(here.cl), float(here.cd), None if moment is None else float(moment))}</tr>"
        )
    if not rows:
        return ""
    head = "".join(f'<td class="rx-num rx-dim">C<sub>{letter}</sub></td>' for letter in "ldm")
    return (
        f'<div class="rx-line rx-probe-title"{tip("probe_public")}><span><b>Public data</b></span>'
        f'<span class="rx-dim">{escape(section_title(section.name))}, nearest points</span></div>'
        f'<table class="rx-small" data-explorer="probe-public"><tr><td></td>{head}</tr>{"".join(rows)}</table>'
    )


def _near(probe: Probe) -> tuple[PublicPoint, ...]:
    return points_near(probe.section.main.name, probe.table_mach)


def _cells(cl: float, cd: float, cm: float | None) -> str:
    texts = (number(cl, 3), number(cd, 4), "–" if cm is None else number(cm, 3))
    return "".join(f'<td class="rx-num">{text}</td>' for text in texts)
