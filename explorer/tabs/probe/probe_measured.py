"""The probe beside what others measured: its section, with lift curve and table; and airloads over the azimuth."""

import math
from dataclasses import dataclass
from html import escape

import numpy as np

from explorer.charts import svg
from explorer.colours import LIMIT, NOW, THIS
from explorer.model.stand import airload_curves, as_measured, condition_of, is_at, nearest_case
from explorer.model.units import number
from explorer.tabs.probe.element import Probe
from explorer.text.glossary import tip
from explorer.text.status import section_title
from rotor import Solution
from rotor.airfoil.public_points import SOURCES, nearest_points, points_near
from rotor.arrays import Array
from rotor.chart import round_ticks
from rotor.validation import FlownCase, MeasuredCurve, our_curve
from rotor.validation.airloads import REPORTS, harmonics

LIFT, MARK = THIS, "#099268"
_WIDTH, _HEIGHT = 312.0, 96.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 26.0, 300.0, 6.0, 80.0
_SHORT = {
    "umd-rans": "RANS",
    "umd-net": "RANS net",
    "cr-166309": "simulation deck",
    "tm-86719": "wind tunnel",
    "tm-88370": "rotor table",
    "hart2": "HART II table",
}

_LOAD_HEIGHT, _LOAD_LEFT, _LOAD_RIGHT, _LOAD_BOTTOM = 104.0, 34.0, 302.0, 86.0
"""Of the charts over azimuth."""
_TITLES = {
    "cn_m2": ("C<sub>n</sub>M²", "normal force coefficient times Mach number squared"),
    "cm_m2": ("C<sub>m</sub>M²", "moment coefficient times Mach number squared, nose up"),
    "cl_u2": ("C<sub>l</sub>(r + µ sin ψ)²", "lift coefficient times the square of the speed over tip speed"),
    "cl": ("C<sub>l</sub>", "lift coefficient of the section"),
    "tip_twist_deg": ("Tip twist [°]", "elastic twist of the tip, nose up"),
    "tip_flap": ("Tip flapping/R", "deflection of the tip up from the precone"),
    "pitch_link": ("Pitch link [N]", "load of one pitch link without its mean, by a nose-up moment of the blade"),
}
"""Symbol and meaning of what is drawn."""


def lift_curve(probe: Probe) -> str:
    """C_l over α of this section at this Mach number, both stall angles, public points, and where the element is.

    With dynamic stall also the way of the element around the disk, at its own Mach numbers.
    """
    degrees = math.degrees(probe.alpha)
    low, high, step = (-15.0, 20.0, 5.0) if -15.0 < degrees < 20.0 else (-180.0, 180.0, 60.0)
    loop = np.full((2, 1), np.nan) if probe.unsteady is None else probe.unsteady.loop
    loop = np.stack([np.degrees(loop[0]), loop[1]])
    if high == 20.0 and (loop[0] > 20.0).any():
        high = 30.0
    alpha = np.linspace(low, high, 91)
    curve = probe.section.lift_curve(np.radians(alpha), probe.table_mach)
    inside = (loop[0] > low) & (loop[0] < high)
    reached = [float(curve.min()), float(curve.max()), probe.cl, *loop[1, inside].tolist()]
    bottom, top = min(-1.0, *reached), max(1.6, *reached)

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
    for point in points_near(probe.section.main.name, probe.table_mach):
        at = x(math.degrees(point.alpha + probe.section.main.incidence_offset)), y(point.cl)
        if low < math.degrees(point.alpha) < high and bottom <= point.cl <= top:
            marks.append(
                f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="2.6" fill="none" stroke="currentColor" opacity=".7">'
                f"<title>{escape(SOURCES[point.source])}</title></circle>"
            )
    path = " ".join(f"{x(a):.1f},{y(cl):.1f}" for a, cl in zip(alpha.tolist(), curve.tolist(), strict=True))
    marks.append(f'<polyline points="{path}" fill="none" stroke="{LIFT}" stroke-width="1.8"/>')
    way = "M"  # A line that is broken where the element is out of the picture.
    for k in [*range(loop.shape[1]), 0] if inside.any() else []:
        way += f"{x(loop[0, k]):.1f} {y(loop[1, k]):.1f}L" if inside[k] else "M"
    for piece in way.split("M"):
        if piece.count("L") > 1:
            marks.append(f'<path d="M{piece.rstrip("L")}" fill="none" stroke="{NOW}" stroke-width="1.6"/>')
    here = x(degrees), y(probe.cl)
    marks.append(svg.line((here[0], _BOTTOM), here, MARK, 1.0))
    if not probe.idle:
        marks.append(f'<circle cx="{here[0]:.1f}" cy="{here[1]:.1f}" r="4" fill="{NOW}" stroke="{svg.BODY}"/>')
    around = ""
    if probe.unsteady is not None:
        around = f'<span{tip("chart_stall_loop")}><span class="rx-dash" style="background:{NOW}"></span>a turn</span>'
    return (
        f'<div class="rx-line rx-probe-title"{tip("chart_lift_curve")}><span><b>Lift curve</b></span>'
        f'<span class="rx-dim">C<sub>l</sub> over α at Mach {number(probe.table_mach, 2)}</span>{around}'
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


def _cells(cl: float, cd: float, cm: float | None) -> str:
    texts = (number(cl, 3), number(cd, 4), "–" if cm is None else number(cm, 3))
    return "".join(f'<td class="rx-num">{text}</td>' for text in texts)


@dataclass(frozen=True, eq=False)
class BesideMeasured:
    """Measured curves and ours of one solution."""

    case: FlownCase
    at_test: bool
    """Whether the solution is in the condition of the test."""
    blade: bool
    """Whether it has the blade of the test."""
    curves: tuple[tuple[MeasuredCurve, Array, Array], ...]
    """A measured curve, then azimuths [rad] and values of ours."""


def beside_measured(solution: Solution, r: float) -> BesideMeasured | None:
    """What was measured nearest to r/R in the condition most like that of a solution; None without a measurement.

    In hover nothing depends on the azimuth, and nothing was measured.
    """
    design = solution.design
    case = None if design.hovering else nearest_case(design)
    if case is None:
        return None
    curves = [one for one in airload_curves(case.rotor) if one.case == case and one.quantity in _TITLES]
    if solution.elastic is None:
        curves = [one for one in curves if one.quantity not in ("tip_twist_deg", "pitch_link")]
    if not curves:
        return None
    nearest = [
        min((one for one in curves if one.quantity == quantity), key=lambda one: abs(one.r - r))
        for quantity in dict.fromkeys(one.quantity for one in curves)
    ]
    pairs = tuple((one, *our_curve(one, solution)) for one in nearest)
    return BesideMeasured(case, is_at(case, design), as_measured(design), pairs)


def measured_panel(beside: BesideMeasured, psi: float) -> str:
    """The curves one beneath the other; `psi`: azimuth of the probe [rad]."""
    condition = condition_of(beside.case.rotor, beside.case.name)
    name = beside.case.name if condition is None else f"{condition.test}, {condition.label.partition(',')[0]}"
    report = escape(REPORTS[beside.case.test])
    differs = ["at another condition"] * (not beside.at_test) + ["of another twist"] * (not beside.blade)
    words = f"Ours is {' and '.join(differs)}." if differs else ""
    press = (
        ""
        if beside.at_test or condition is None
        else f'<button class="rx-push" data-do="flown" data-value="{escape(beside.case.name)}"{tip("fly_measured")}>'
        "Set that of the test</button>"
    )
    line = f'<div class="rx-line rx-small rx-base"><span>{words}</span>{press}</div>' if differs else ""
    charts = "".join(_chart(curve, at, ours, psi, not differs) for curve, at, ours in beside.curves)
    return (
        f'<div data-explorer="probe-measured"><div class="rx-line rx-probe-title"{tip("probe_measured")}>'
        f'<span><b>Measured</b></span><span class="rx-dim" title="{report}">{escape(name)}</span>'
        f'<span><span class="rx-dash" style="background:{THIS}"></span>ours</span></div>{line}{charts}'
        f'<div class="rx-small rx-dim">Points: {report}.</div></div>'
    )


def correlation(measured: MeasuredCurve, psi: Array, ours: Array) -> float:
    """Of the harmonics that are compared, without the mean."""
    one, other = (
        harmonics(at, values, measured.highest)[1:] for at, values in ((psi, ours), (measured.psi, measured.values))
    )
    return float(one @ other / math.sqrt((one @ one) * (other @ other)))


def _chart(measured: MeasuredCurve, psi: Array, ours: Array, here: float, alike: bool) -> str:
    title, meaning = _TITLES[measured.quantity]
    where = "" if measured.quantity.startswith(("tip_", "pitch_link")) else f" at {number(measured.r, 2)} R"
    low = float(min(measured.values.min(), ours.min()))
    high = float(max(measured.values.max(), ours.max()))
    margin = 0.05 * (high - low)
    low, high = low - margin, high + margin

    def points(at: Array, values: Array) -> list[tuple[float, float]]:
        x = _LOAD_LEFT + np.degrees(at) / 360.0 * (_LOAD_RIGHT - _LOAD_LEFT)
        y = _LOAD_BOTTOM - (values - low) / (high - low) * (_LOAD_BOTTOM - _TOP)
        return list(zip(x.tolist(), y.tolist(), strict=True))

    marks = []
    for tick in (0, 90, 180, 270, 360):
        x = _LOAD_LEFT + tick / 360.0 * (_LOAD_RIGHT - _LOAD_LEFT)
        marks.append(svg.line((x, _TOP), (x, _LOAD_BOTTOM), width=0.8, style='opacity=".18"'))
        marks.append(svg.tick((x, _LOAD_HEIGHT - 6.0), f"{tick}°", "middle"))
    for value in round_ticks(low, high, 4):
        y = points(np.zeros(1), np.array([value]))[0][1]
        style = 'opacity=".5"' if value == 0.0 else 'opacity=".18"'
        marks.append(svg.line((_LOAD_LEFT, y), (_LOAD_RIGHT, y), width=0.8, style=style))
        marks.append(svg.tick((_LOAD_LEFT - 5.0, y + 3.5), f"{value:.6g}".replace("-", "−"), "end"))
    x = points(np.array([here % (2.0 * math.pi)]), np.zeros(1))[0][0]
    marks.append(svg.line((x, _TOP), (x, _LOAD_BOTTOM), width=1.0, style='stroke-dasharray="3 3" opacity=".6"'))
    dots = "".join(f"M{x:.1f} {y:.1f}h0" for x, y in points(measured.psi, measured.values))
    size = 2.0 if len(measured.psi) > 100 else 3.4
    marks.append(
        f'<path d="{dots}" stroke="currentColor" stroke-width="{size:g}" stroke-linecap="round" opacity=".6"/>'
    )
    closed = points(np.append(psi, psi[0] + 2.0 * math.pi), np.append(ours, ours[0]))
    line = " ".join(f"{x:.1f},{y:.1f}" for x, y in closed)
    marks.append(f'<polyline points="{line}" fill="none" stroke="{THIS}" stroke-width="1.8"/>')
    caption = f"correlation {number(correlation(measured, psi, ours), 2)}" if alike else ""
    hint = f"{meaning[0].upper()}{meaning[1:]}. Correlation of harmonics 1 to {measured.highest}, without the mean."
    return (
        f'<div class="rx-line rx-small" title="{escape(hint)}"><span>{title}{where}</span>'
        f'<span class="rx-dim rx-num rx-push" data-explorer="correlation">{caption}</span></div>'
        f'<svg viewBox="0 0 {_WIDTH:g} {_LOAD_HEIGHT:g}" width="100%" role="img" '
        f'aria-label="{escape(meaning)} over azimuth, measured and ours">{"".join(marks)}</svg>'
    )
