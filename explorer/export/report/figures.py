"""Figures of the report: power over speed, twist, disks with their scales, angle of attack and lift along the blade."""

import math
from dataclasses import replace
from html import escape

import numpy as np
from scipy.interpolate import PchipInterpolator

from explorer.charts import plots
from explorer.charts.line_chart import Trace, line_chart
from explorer.charts.plots import SWEEP
from explorer.charts.power_curve import PowerCurves
from explorer.export.disk_drawing import HALF, bar_drawing, disk_drawing, key_entries
from explorer.export.report.contents import DesignReport, ReportEntry, colours_of, fields_of
from explorer.picture.fields import Field
from explorer.theme.colours import BASELINE, IDEAL
from rotor.arrays import Array
from rotor.trim.solution import Solution

PIXELS = 400
"""Pixels of a disk along each edge; more would be finer than the solver's grid."""
AZIMUTHS = {0: "#0ca678", 90: "#e8590c", 180: "#1c7ed6", 270: "#9c36b5"}
"""Azimuths of the charts along the blade, with their colours: tail, advancing, nose, retreating."""
_BAR = 200.0
_LETTERS = 10.0


def overview(report: DesignReport, curves: PowerCurves) -> str:
    """Power over advance ratio and twist along the blade, all designs together."""
    colours = colours_of(report)
    pairs = list(zip(report.all, colours, strict=True))
    power = [trace for entry, colour in reversed(pairs) for trace in _power(report, entry, colour, curves)]
    r = np.linspace(report.entries[0].solution.design.rotor.blade.root_cutout, 1.0, 160)
    twist, load = [], []
    for entry, colour in reversed(pairs):
        look = ("6 4", 1.6) if entry is report.reference else ("", 2.2)
        solution = entry.solution
        twist.append(Trace(entry.title, colour, r, np.degrees(solution.design.twist(r)), *look))
        load.append(Trace(entry.title, colour, solution.disk.r, _mean_load(solution), *look))
    known = np.concatenate([trace.y[trace.x <= 0.4] for trace in power])
    top = float(np.nanmax(known)) if np.isfinite(known).any() else 1.0
    charts = [
        line_chart(
            "Power over advance ratio",
            "advance ratio µ; hover as a point",
            f"total power [{report.units.power[0].symbol}]",
            power,
            (-0.01, 0.46),
            plots.held_range(None, 0.0, top),
        ),
        line_chart("Jig twist along the blade", "r/R", "twist [°], zero at 0.75 R", twist, (0.1, 1.01)),
        line_chart("Load along the blade", "r/R", "dT/dr, mean over azimuth [kN/m]", load, (0.1, 1.01)),
    ]
    changes = [trace for entry, colour in pairs for trace in _change(report, entry, colour, curves)]
    if changes:
        charts.insert(
            1,
            line_chart(
                "Change of power",
                "advance ratio µ",
                f"vs. {report.reference.title} [%]",
                [Trace("", BASELINE, np.array([0.0, 0.5]), np.zeros(2), "6 4", 1.4), *changes],
                (-0.01, 0.46),
            ),
        )
    return f'<section><h2>Over speed and along the blade</h2><div class="charts">{"".join(charts)}</div></section>'


def _power(report: DesignReport, entry: ReportEntry, colour: str, curves: PowerCurves) -> list[Trace]:
    """Curve over advance ratio, hover as a point, the present condition as a point."""
    design = entry.solution.design
    curves.sweep(design, report.reference.solution.design, lambda: False)
    curve, mu = curves.known(design, report.reference.solution.design), np.array(SWEEP)
    is_reference = entry is report.reference
    unit = report.units.power[0]
    here = np.array([design.condition.advance_ratio]), np.array([unit.of(entry.solution.power.total)])
    total, ideal = (1e3 * values / unit.size for values in (curve.design, curve.ideal))
    traces = [
        Trace(entry.title, colour, *_smooth(total), "6 4" if is_reference else "", 1.6 if is_reference else 2.2),
        Trace("", colour, mu[:1], total[:1], points=True),
    ]
    if entry is report.entries[0]:
        traces.insert(0, Trace("ideal for its lift", IDEAL, *_smooth(ideal), "2 3", 1.4))
    return traces if is_reference else [*traces, Trace("", colour, *here, points=True)]


def _mean_load(solution: Solution) -> Array:
    """Thrust per length of one blade, mean over azimuth [kN/m], (elements,)."""
    design = solution.design
    return solution.disk.dct.mean(axis=1) * design.thrust_unit / (design.rotor.blades * design.rotor.radius) / 1e3


def _change(report: DesignReport, entry: ReportEntry, colour: str, curves: PowerCurves) -> list[Trace]:
    """Change against the reference over speed, for blades with the same weight and altitude."""
    design, reference = entry.solution.design, report.reference.solution.design
    alike = replace(design.condition, advance_ratio=0.0) == replace(reference.condition, advance_ratio=0.0)
    if entry is report.reference or not alike:
        return []
    curve = curves.known(design, reference)
    change = 100.0 * (curve.design / curve.reference - 1.0)
    return [
        Trace(entry.title, colour, *_smooth(change)),
        Trace("", colour, np.array(SWEEP[:1]), change[:1], points=True),
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
    """The fields over the disk, each with its scale, and the key of the outlines."""
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
            alpha += [Trace("", BASELINE, r, limit, "3 3", 1.2) for limit in (lower, upper)]
        alpha.append(Trace(f"ψ {degrees}°", colour, r, angle))
        cl = plots.lift_along(solution, float(degrees))
        lift.append(Trace(f"ψ {degrees}°", colour, r, np.where(np.isfinite(angle), cl, math.nan)))
    alpha.append(Trace("stall at ψ 270°", BASELINE, r[:0], r[:0], "3 3", 1.2))
    return (
        '<h3>Along the blade</h3><div class="charts">'
        + line_chart("Angle of attack", "r/R; reverse flow omitted", "α [°]", alpha, (0.1, 1.01), (-15.0, 20.0))
        + line_chart("Lift coefficient", "r/R; reverse flow omitted", "Cl", lift, (0.1, 1.01), (-0.5, 1.5))
        + "</div>"
    )
