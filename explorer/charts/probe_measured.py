"""The probe beside what others measured: its section, with lift curve; and airloads over the azimuth."""

import math
import re
from dataclasses import dataclass

import numpy as np

from explorer.charts.svg import chart_box
from explorer.colours import LIMIT, NOW, THIS
from explorer.model.stand import airload_curves, as_measured, condition_of, is_at, nearest_case
from explorer.model.units import number
from explorer.picture.element import Probe
from explorer.text.glossary import MEASURED, tip
from explorer.text.readout import dash
from rotor import Solution
from rotor.support.arrays import Array
from rotor.support.chart import AZIMUTH, Axis, Chart, Line, Points, Rule, Series, drawn_chart
from rotor.support.markup import Markup, group, tag
from rotor.validation import FlownCase, MeasuredCurve, computed_curve
from rotor.validation.airloads import REPORTS, closed_around, harmonics

LIFT = THIS
HEIGHT = 92.0
"""Height of the charts [px]."""


def lift_chart(probe: Probe) -> Chart:
    """C_l over α of this section at this Mach number, both stall angles, and where the element is.

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

    series: list[Series] = [Line("", alpha, curve, LIFT, width=1.8)]
    if inside.any():  # A line that is broken where the element is out of the picture.
        turn = np.where(inside, loop, np.nan)[:, [*range(loop.shape[1]), 0]]
        series.append(Line("a turn", loop[0, [*range(loop.shape[1]), 0]], turn[1], NOW, width=1.6))
    if not probe.idle:
        series.append(Points("", (degrees,), (probe.cl,), NOW, words=("this element",)))
    ends = [math.degrees(end) for end in probe.stall or ()]
    dashed = "; dashed: static stall" if ends else ""
    return Chart(
        "Lift curve",
        Axis(
            "α",
            (low, high),
            tuple(np.arange(-180.0 if step > 5.0 else -10.0, high + 0.1, 2.0 * step).tolist()),
            unit="°",
        ),
        Axis(f"C_l at Mach {number(probe.table_mach, 2)}{dashed}", (bottom, top), (-1.0, 0.0, 1.0)),
        tuple(series),
        tuple(Rule(end, colour=LIMIT, dashes="4 3") for end in ends if low < end < high),
        note=tip("chart_lift_curve"),
    )


def with_indices(words: str) -> Markup:
    """Text with the index of C_l and the like set low."""
    return group(
        tag("sub", part) if k % 2 else part for k, part in enumerate(re.split(r"_(\w)", words))
    )


@dataclass(frozen=True, eq=False)
class AirloadComparison:
    """Measured curves, and the computed ones of one solution."""

    case: FlownCase
    at_test: bool
    """Whether the solution is in the condition of the test."""
    blade: bool
    """Whether it has the blade of the test."""
    curves: tuple[tuple[MeasuredCurve, Array, Array], ...]
    """A measured curve, then azimuths [rad] and computed values."""


def airload_comparison(solution: Solution, r: float) -> AirloadComparison | None:
    """What was measured nearest to r/R in the condition most like that of a solution; None without a measurement.

    In hover nothing depends on the azimuth, and nothing was measured.
    """
    design = solution.design
    case = None if design.hovering else nearest_case(design)
    if case is None:
        return None
    curves = [
        curve
        for curve in airload_curves(case.rotor)
        if curve.case == case and curve.quantity in MEASURED
    ]
    if solution.elastic is None:
        curves = [
            curve for curve in curves if curve.quantity not in ("tip_twist_deg", "pitch_link")
        ]
    if not curves:
        return None
    nearest = [
        min(
            (curve for curve in curves if curve.quantity == quantity),
            key=lambda curve: abs(curve.r - r),
        )
        for quantity in dict.fromkeys(curve.quantity for curve in curves)
    ]
    pairs = tuple((curve, *computed_curve(curve, solution)) for curve in nearest)
    return AirloadComparison(case, is_at(case, design), as_measured(design), pairs)


def measured_panel(beside: AirloadComparison, psi: float) -> Markup:
    """The curves one beneath the other; `psi`: azimuth of the probe [rad]."""
    condition = condition_of(beside.case.rotor, beside.case.name)
    name = (
        beside.case.name
        if condition is None
        else f"{condition.test}, {condition.label.partition(',')[0]}"
    )
    report = REPORTS[beside.case.test]
    differs = ["at another condition"] * (not beside.at_test) + ["with another twist"] * (
        not beside.blade
    )
    words = f"Computed {' and '.join(differs)}." if differs else ""
    value, what = beside.case.name, tip("fly_measured")
    press = tag(
        "button.rx-push", "Set test condition", data_do="flown", data_value=value, title=what
    )
    if beside.at_test or condition is None:
        press = None
    return tag(
        "div",
        tag(
            "div.rx-line.rx-probe-title",
            tag("span", tag("b", "Measured")),
            tag("span.rx-dim", name, title=report),
            tag("span", dash(THIS), "computed"),
            title=tip("probe_measured"),
        ),
        tag("div.rx-line.rx-small.rx-base", tag("span", words), press) if differs else None,
        [_chart(curve, at, computed, psi, not differs) for curve, at, computed in beside.curves],
        tag("div.rx-small.rx-dim", f"Points: {report}."),
        data_explorer="probe-measured",
    )


def correlation(measured: MeasuredCurve, psi: Array, computed: Array) -> float:
    """Correlation of the harmonics that are compared, without the mean, −1…1."""
    computed, other = (
        harmonics(at, values, measured.highest)[1:]
        for at, values in ((psi, computed), (measured.psi, measured.values))
    )
    return float(computed @ other / math.sqrt((computed @ computed) * (other @ other)))


def _chart(
    measured: MeasuredCurve, psi: Array, computed: Array, here: float, alike: bool
) -> Markup:
    title, meaning = MEASURED[measured.quantity]
    where = "" if measured.quantity.startswith("tip_") else f" at {number(measured.r, 2)} R"
    seen = *measured.values.tolist(), *computed.tolist()
    margin = 0.05 * (max(seen) - min(seen))
    size = 1.0 if len(measured.psi) > 100 else 1.7
    chart = Chart(
        f"{title}{where}",
        Axis("ψ", (0.0, 360.0), AZIMUTH, unit="°"),
        Axis(range=(min(seen) - margin, max(seen) + margin)),
        (
            Points("", np.degrees(measured.psi), measured.values, "var(--rx-dim)", size=size),
            Line("", *closed_around(psi, computed), THIS, width=1.8),
        ),
        (Rule(math.degrees(here) % 360.0),),
        value=f"correlation {number(correlation(measured, psi, computed), 2)}" if alike else "",
        note=f"{meaning[0].upper()}{meaning[1:]}, measured and computed. "
        f"Correlation of harmonics 1 to {measured.highest}, without the mean.",
    )
    return chart_box(drawn_chart(chart), HEIGHT)
