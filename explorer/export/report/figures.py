"""Figures of the report: power over speed, twist, disks with their scales, angle of attack and lift along the blade."""

import math
from collections.abc import Sequence
from dataclasses import replace
from html import escape

import numpy as np
from scipy.interpolate import PchipInterpolator

from explorer.charts import plots
from explorer.charts.plots import SWEEP, PowerCurves, held_range
from explorer.charts.strip import lift_per_metre
from explorer.colours import BASELINE, IDEAL
from explorer.export.disk_drawing import HALF, bar_drawing, disk_drawing, key_entries
from explorer.export.report.contents import DesignReport, ReportEntry, colours_of, fields_of
from explorer.picture.fields import Field
from rotor import Solution
from rotor.arrays import Array
from rotor.line_chart import LineChart, Mark, Series, draw

PIXELS = 480
"""Pixels of a disk along each edge: the labels of its regions can be read."""
AZIMUTHS = {0: "#0ca678", 90: "#e8590c", 180: "#1c7ed6", 270: "#9c36b5"}
"""Azimuths of the charts along the blade, with their colours: tail, advancing, nose, retreating."""
_BAR = 200.0
_LETTERS = 10.0


def overview(report: DesignReport, curves: PowerCurves) -> str:
    """Power over advance ratio and twist along the blade, all designs together."""
    pairs = list(zip(report.all, colours_of(report), strict=True))
    power = [one for entry, colour in reversed(pairs) for one in _power(report, entry, colour, curves)]
    r = np.linspace(report.entries[0].solution.design.rotor.blade.root_cutout, 1.0, 160)
    twist, load = [], []
    for entry, colour in reversed(pairs):
        mark: Mark = "dashed" if entry is report.reference else "line"
        solution = entry.solution
        twist.append(series(entry.title, r, np.degrees(solution.design.twist(r)), mark, colour))
        load.append(series(entry.title, solution.disk.r, lift_per_metre(solution) / 1e3, mark, colour))
    seen = [y for one in power for x, y in zip(one.x, one.y, strict=True) if x <= 0.4 and math.isfinite(y)]
    y_range, unit = held_range(None, 0.0, max(seen, default=1.0)), report.units.power[0].symbol
    speed, speeds, along_r = "advance ratio µ", (-0.01, 0.46), (0.1, 1.01)
    changes = [one for entry, colour in pairs for one in _change(report, entry, colour, curves)]
    zero = series("", np.array(speeds), np.zeros(2), "dashed", BASELINE)
    against = f"vs. {report.reference.title} [%]"
    charts = [
        LineChart("Power over advance ratio", f"{speed}; hover as a point", f"total power [{unit}]", tuple(power),
                  x_range=speeds, y_range=y_range),
        *([LineChart("Change of power", speed, against, (zero, *changes), x_range=speeds)] if changes else []),
        LineChart("Jig twist along the blade", "r/R", "twist [°], zero at 0.75 R", tuple(twist), x_range=along_r),
        LineChart("Load along the blade", "r/R", "dT/dr, mean over azimuth [kN/m]", tuple(load), x_range=along_r),
    ]  # fmt: skip
    return f"<section><h2>Over speed and along the blade</h2>{_charts(charts)}</section>"


def _charts(charts: Sequence[LineChart]) -> str:
    return f'<div class="charts">{"".join(map(figure, charts))}</div>'


def figure(chart: LineChart) -> str:
    """A chart with its title, as HTML."""
    title = f"<figcaption><b>{escape(chart.title)}</b></figcaption>"
    return f'<figure class="chart">{title}{draw(chart, inline=True)}</figure>'


def series(label: str, x: Array, y: Array, mark: Mark, colour: str) -> Series:
    return Series(label, tuple(x.tolist()), tuple(y.tolist()), mark, colour)


def _power(report: DesignReport, entry: ReportEntry, colour: str, curves: PowerCurves) -> list[Series]:
    """Curve over advance ratio, hover as a point, the present condition as a point."""
    design = entry.solution.design
    curves.sweep(design, report.reference.solution.design, lambda: False)
    curve, mu = curves.known(design, report.reference.solution.design), np.array(SWEEP)
    is_reference = entry is report.reference
    unit = report.units.power[0]
    here = np.array([design.condition.advance_ratio]), np.array([unit.of(entry.solution.power.total)])
    total, ideal = (1e3 * values / unit.size for values in (curve.design, curve.ideal))
    found = [
        series(entry.title, *_smooth(total), "dashed" if is_reference else "line", colour),
        series("", mu[:1], total[:1], "points", colour),
    ]
    if entry is report.entries[0]:
        found.insert(0, series("ideal for its lift", *_smooth(ideal), "dashed", IDEAL))
    return found if is_reference else [*found, series("", *here, "points", colour)]


def _change(report: DesignReport, entry: ReportEntry, colour: str, curves: PowerCurves) -> list[Series]:
    """Change against the reference over speed, for blades with the same weight and altitude."""
    design, reference = entry.solution.design, report.reference.solution.design
    alike = replace(design.condition, advance_ratio=0.0) == replace(reference.condition, advance_ratio=0.0)
    if entry is report.reference or not alike:
        return []
    curve = curves.known(design, reference)
    change = 100.0 * (curve.design / curve.reference - 1.0)
    return [
        series(entry.title, *_smooth(change), "line", colour),
        series("", np.array(SWEEP[:1]), change[:1], "points", colour),
    ]


def _smooth(values: Array) -> tuple[Array, Array]:
    """Values at the advance ratios of `SWEEP` as a smooth line through those known; without hover beside a gap."""
    mu = np.array(SWEEP)
    known = np.isfinite(values)
    known[0] &= known[1]
    if known.sum() < 2:
        return mu[1:], values[1:]
    line = np.linspace(mu[known].min(), mu[known].max(), 120)
    return line, PchipInterpolator(mu[known], values[known])(line)


def disks(report: DesignReport, entry: ReportEntry, k: int) -> str:
    """The fields over the disk, each with its scale, and the key of the marked regions."""
    solution, figures = entry.solution, []
    for n, field in enumerate(fields_of(report)):
        colour_range = report.colour_range(field)
        drawn = disk_drawing(solution, field, colour_range, PIXELS, letters=_LETTERS, units=report.units)
        figures.append(
            f'<figure><svg viewBox="{-HALF:g} {-HALF:g} {2 * HALF:g} {2 * HALF:g}" role="img" '
            f'aria-label="{escape(field.title, quote=True)} over the disk">{drawn}</svg>'
            f"{bar(field, colour_range, f'bar-{k}-{n}')}</figure>"
        )
    keys: dict[str, str] = {}
    for field in fields_of(report):
        keys.update(key_entries(solution, field))
    key = "".join(
        f'<span><svg width="14" height="8">{swatch}</svg> {escape(title)}</span>' for title, swatch in keys.items()
    )
    several = " Colours are the same for all designs." if len(report.shown) > 1 else ""
    return (
        f'<h3>Over the disk</h3><div class="disks">{"".join(figures)}</div><p class="key">{key}'
        f'<span class="dim">From above, nose up, advancing side right.{several}</span></p>'
    )


def bar(field: Field, colour_range: tuple[float, float], name: str) -> str:
    """A colour bar as a separate SVG."""
    drawn = bar_drawing(field, colour_range, _BAR, name, _LETTERS)
    return f'<svg class="bar-svg" viewBox="-14 0 {_BAR + 28:g} {4 * _LETTERS:g}">{drawn}</svg>'


def along(solution: Solution) -> str:
    """Angle of attack and lift coefficient along the blade at four azimuths."""
    r = solution.disk.r
    alpha, lift = [], []
    for degrees, colour in AZIMUTHS.items():
        lower, upper, angle = plots.angles_along(solution, float(degrees))
        if degrees == 270:
            names = zip(("stall at ψ 270°", ""), (lower, upper), strict=True)
            alpha += [series(name, r, limit, "dashed", BASELINE) for name, limit in names]
        alpha.append(series(f"ψ {degrees}°", r, angle, "line", colour))
        cl = np.where(np.isfinite(angle), plots.lift_along(solution, float(degrees)), math.nan)
        lift.append(series(f"ψ {degrees}°", r, cl, "line", colour))
    x_label, x_range = "r/R; reverse flow omitted", (0.1, 1.01)
    charts = [
        LineChart("Angle of attack", x_label, "α [°]", tuple(alpha), x_range=x_range, y_range=(-15.0, 20.0)),
        LineChart("Lift coefficient", x_label, "C_l", tuple(lift), x_range=x_range, y_range=(-0.5, 1.5)),
    ]
    return f"<h3>Along the blade</h3>{_charts(charts)}"
