"""Measured airloads beside ours over the azimuth, below the probe: the nearest measured radius and condition."""

import math
from dataclasses import dataclass
from html import escape

import numpy as np

from explorer.charts import svg
from explorer.charts.strip import round_ticks
from explorer.flown import airload_curves, as_measured, is_at, nearest_case
from explorer.stand import MeasuredCondition, condition_of
from explorer.text.glossary import tip
from explorer.text.units import number
from explorer.theme.colours import THIS
from rotor.arrays import Array
from rotor.trim.solution import Solution
from rotor.validation.airloads import REPORTS, FlownCase, MeasuredCurve, harmonics, our_curve

_WIDTH, _HEIGHT = 312.0, 104.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 34.0, 302.0, 6.0, 86.0
_TITLES = {
    "cn_m2": ("C<sub>n</sub>M²", "normal force coefficient times Mach number squared"),
    "cm_m2": ("C<sub>m</sub>M²", "moment coefficient times Mach number squared, nose up"),
    "cl_u2": ("C<sub>l</sub>(r + µ sin ψ)²", "lift coefficient times the square of the speed over tip speed"),
    "tip_twist_deg": ("Tip twist [°]", "elastic twist of the tip, nose up"),
}


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

    @property
    def condition(self) -> MeasuredCondition | None:
        """That of the test, for the page to set."""
        return condition_of(self.case.rotor, self.case.name)


def beside_measured(solution: Solution, r: float) -> BesideMeasured | None:
    """What was measured nearest to r/R in the condition most like that of a solution; None without a measurement.

    In hover nothing depends on the azimuth, and nothing was measured.
    """
    design = solution.design
    case = None if design.hovering else nearest_case(design)
    if case is None:
        return None
    curves = [one for one in airload_curves(case.rotor) if one.case == case]
    if solution.elastic is None:
        curves = [one for one in curves if one.quantity != "tip_twist_deg"]
    nearest = [
        min((one for one in curves if one.quantity == quantity), key=lambda one: abs(one.r - r))
        for quantity in dict.fromkeys(one.quantity for one in curves)
    ]
    found = tuple((one, *our_curve(one, solution)) for one in nearest)
    return BesideMeasured(case, is_at(case, design), as_measured(design), found)


def measured_panel(beside: BesideMeasured, psi: float) -> str:
    """The curves one beneath the other; `psi`: azimuth of the probe [rad]."""
    condition = beside.condition
    name = beside.case.name if condition is None else f"{condition.test}, {condition.label}"
    differs = [
        *([] if beside.at_test else ["at another condition than the test"]),
        *([] if beside.blade else ["of another twist than the blade of the test"]),
    ]
    words = f"Our lines are {' and '.join(differs)}." if differs else ""
    charts = "".join(_chart(curve, at, ours, psi, not differs) for curve, at, ours in beside.curves)
    return (
        f'<div class="rx rx-probe" data-explorer="probe-measured" title="{escape(REPORTS[beside.case.test])}">'
        f'<div class="rx-line rx-probe-title"{tip("probe_measured")}><span><b>Measured</b></span>'
        f'<span class="rx-dim">{escape(name)}</span>'
        f'<span><span class="rx-dash" style="background:{THIS}"></span>ours</span></div>'
        f'{charts}<div class="rx-small rx-dim">{words} Measured: {escape(REPORTS[beside.case.test])}.</div></div>'
    )


def correlation(measured: MeasuredCurve, psi: Array, ours: Array) -> float:
    """Of the harmonics that are compared, without the mean."""
    one, other = (
        harmonics(at, values, measured.highest)[1:] for at, values in ((psi, ours), (measured.psi, measured.values))
    )
    return float(one @ other / math.sqrt((one @ one) * (other @ other)))


def _chart(measured: MeasuredCurve, psi: Array, ours: Array, here: float, alike: bool) -> str:
    title, meaning = _TITLES[measured.quantity]
    where = "" if measured.quantity == "tip_twist_deg" else f" at {number(measured.r, 2)} R"
    low = float(min(measured.values.min(), ours.min()))
    high = float(max(measured.values.max(), ours.max()))
    margin = 0.05 * (high - low)
    low, high = low - margin, high + margin

    def points(at: Array, values: Array) -> list[tuple[float, float]]:
        x = _LEFT + np.degrees(at) / 360.0 * (_RIGHT - _LEFT)
        y = _BOTTOM - (values - low) / (high - low) * (_BOTTOM - _TOP)
        return list(zip(x.tolist(), y.tolist(), strict=True))

    marks = []
    for tick in (0, 90, 180, 270, 360):
        x = _LEFT + tick / 360.0 * (_RIGHT - _LEFT)
        marks.append(svg.line((x, _TOP), (x, _BOTTOM), width=0.8, style='opacity=".18"'))
        marks.append(svg.tick((x, _HEIGHT - 6.0), f"{tick}°", "middle"))
    for value in round_ticks(low, high, 4):
        y = points(np.zeros(1), np.array([value]))[0][1]
        style = 'opacity=".5"' if value == 0.0 else 'opacity=".18"'
        marks.append(svg.line((_LEFT, y), (_RIGHT, y), width=0.8, style=style))
        marks.append(svg.tick((_LEFT - 5.0, y + 3.5), f"{value:.6g}".replace("-", "−"), "end"))
    x = points(np.array([here % (2.0 * math.pi)]), np.zeros(1))[0][0]
    marks.append(svg.line((x, _TOP), (x, _BOTTOM), width=1.0, style='stroke-dasharray="3 3" opacity=".6"'))
    dots = "".join(f"M{x:.1f} {y:.1f}h0" for x, y in points(measured.psi, measured.values))
    size = 2.0 if len(measured.psi) > 100 else 3.4
    marks.append(
        f'<path d="{dots}" stroke="currentColor" stroke-width="{size:g}" stroke-linecap="round" opacity=".6"/>'
    )
    closed = points(np.append(psi, psi[0] + 2.0 * math.pi), np.append(ours, ours[0]))
    line = " ".join(f"{x:.1f},{y:.1f}" for x, y in closed)
    marks.append(f'<polyline points="{line}" fill="none" stroke="{THIS}" stroke-width="1.8"/>')
    told = f"correlation {number(correlation(measured, psi, ours), 2)}" if alike else ""
    hint = f"{meaning[0].upper()}{meaning[1:]}. Correlation of harmonics 1 to {measured.highest}, without the mean."
    return (
        f'<div class="rx-line rx-small" title="{escape(hint)}"><span>{title}{where}</span>'
        f'<span class="rx-dim rx-num rx-push" data-explorer="correlation">{told}</span></div>'
        f'<svg viewBox="0 0 {_WIDTH:g} {_HEIGHT:g}" width="100%" role="img" '
        f'aria-label="{escape(meaning)} over azimuth, measured and ours">{"".join(marks)}</svg>'
    )
