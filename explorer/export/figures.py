"""Figures of the report: power over speed, twist, disks with their scales, charts along the blade, and the actuator."""

import base64
import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.interpolate import PchipInterpolator

from explorer.charts import plots
from explorer.charts.plots import SWEEP, PowerCurves, held_range
from explorer.charts.strip import lift_per_metre
from explorer.charts.svg import HALF_EDGE, bar_drawing, disk_drawing, key_entries
from explorer.colours import BASELINE, IDEAL
from explorer.export.contents import DesignReport, ReportEntry, colours_of, fields_of
from explorer.model.units import Units
from explorer.picture.fields import Field
from explorer.text.readout import balance, change_kind, fuel_words, mass_words, mission_words, needs
from explorer.workers.call import at_once
from rotor import Solution
from rotor.actuator import Verdict, verdict_details
from rotor.actuator.verdict import reference
from rotor.support.arrays import Array
from rotor.support.chart import Axis, Chart, Line, Points
from rotor.support.chart_svg import svg
from rotor.support.markup import Content, Markup, group, tag
from rotor.trim.doubt import sureness

PIXELS = 480
"""Pixels of a disk along each edge: the labels of its regions can be read."""
AZIMUTHS = {0: "#0ca678", 90: "#e8590c", 180: "#1c7ed6", 270: "#9c36b5"}
"""Azimuths of the charts along the blade, with their colours: tail, advancing, nose, retreating."""
_BAR = 200.0
_LETTERS = 13.0
_CHART = 390.0, 240.0
"""[px] of a chart: two stand beside each other on paper, and their text is as large as that of a table."""
_WIDE, _ROW, _NAME, _NUMBER = 480.0, 30.0, 92.0, 74.0
"""[px] of the balance: its width, a row, and the room for names and numbers beside the bars."""


def overview(report: DesignReport, curves: PowerCurves) -> Markup:
    """Power over advance ratio and twist along the blade, all designs together."""
    pairs = list(zip(report.all, colours_of(report), strict=True))
    power = [
        series
        for entry, colour in reversed(pairs)
        for series in _power(report, entry, colour, curves)
    ]
    r = np.linspace(report.entries[0].solution.design.rotor.blade.root_cutout, 1.0, 160)
    twist, load = [], []
    for entry, colour in reversed(pairs):
        dashed = entry is report.reference
        solution = entry.solution
        twist.append(
            Line(entry.title, r, np.degrees(solution.design.twist(r)), colour, dashes=dashed)
        )
        load.append(
            Line(
                entry.title, solution.disk.r, lift_per_metre(solution) / 1e3, colour, dashes=dashed
            )
        )
    seen = [
        y
        for series in power
        for x, y in zip(series.x, series.y, strict=True)
        if x <= 0.4 and math.isfinite(y)
    ]
    y_range, unit = held_range(None, 0.0, max(seen, default=1.0)), report.units.power[0].symbol
    speed, speeds, along_r = "advance ratio µ", (-0.01, 0.46), (0.1, 1.01)
    changes = [
        series for entry, colour in pairs for series in _change(report, entry, colour, curves)
    ]
    zero = Line("", speeds, (0.0, 0.0), BASELINE, dashes=True)
    against = f"vs. {report.reference.title} [%]"
    charts = [
        Chart(
            "Power over advance ratio",
            Axis(f"{speed}; hover as a point", range=speeds),
            Axis(f"total power [{unit}]", range=y_range),
            tuple(power),
        ),
        *(
            [Chart("Change of power", Axis(speed, range=speeds), Axis(against), (zero, *changes))]
            if changes
            else []
        ),
        Chart(
            "Built-in twist along the blade",
            Axis("r/R", range=along_r),
            Axis("twist [°], zero at 0.75 R"),
            tuple(twist),
        ),
        Chart(
            "Load along the blade",
            Axis("r/R", range=along_r),
            Axis("dT/dr, mean over azimuth [kN/m]"),
            tuple(load),
        ),
    ]
    return tag("section", tag("h2", "Over speed and along the blade"), _charts(charts))


def _charts(charts: Sequence[Chart]) -> Markup:
    return tag("div.charts", map(figure, charts))


def figure(chart: Chart) -> Markup:
    """A chart with its title, as HTML."""
    return tag(
        "figure.chart",
        tag("figcaption", tag("b", chart.title)),
        svg(chart, inline=True, size=_CHART),
    )


def _power(
    report: DesignReport, entry: ReportEntry, colour: str, curves: PowerCurves
) -> list[Line | Points]:
    """Curve over advance ratio, hover as a point, the present condition as a point."""
    design = entry.solution.design
    at_once(curves.sweep(design, report.reference.solution.design))
    curve, mu = curves.known(design, report.reference.solution.design), np.array(SWEEP)
    is_reference = entry is report.reference
    unit = report.units.power[0]
    here = (
        np.array([design.condition.advance_ratio]),
        np.array([unit.of(entry.solution.power.total)]),
    )
    total, ideal = (1e3 * values / unit.size for values in (curve.design, curve.ideal))
    series: list[Line | Points] = [
        Line(entry.title, *_smooth(total), colour, dashes=is_reference),
        Points("", mu[:1], total[:1], colour),
    ]
    if entry is report.entries[0]:
        series.insert(0, Line("ideal for its lift", *_smooth(ideal), IDEAL, dashes=True))
    return series if is_reference else [*series, Points("", *here, colour)]


def _change(
    report: DesignReport, entry: ReportEntry, colour: str, curves: PowerCurves
) -> list[Line | Points]:
    """Change against the reference over speed, for blades with the same weight and altitude."""
    design, reference = entry.solution.design, report.reference.solution.design
    alike = replace(design.condition, advance_ratio=0.0) == replace(
        reference.condition, advance_ratio=0.0
    )
    if report.is_reference(entry) or not alike:
        return []
    curve = curves.known(design, reference)
    change = 100.0 * (curve.design / curve.reference - 1.0)
    return [
        Line(entry.title, *_smooth(change), colour),
        Points("", np.array(SWEEP[:1]), change[:1], colour),
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


def front(report: DesignReport, rotor: bytes | None) -> Markup:
    """The first design for the first page of a print: its rotor, a WebP that the page drew, and its disk."""
    field = fields_of(report)[0]
    seen = None if rotor is None else f"data:image/webp;base64,{base64.b64encode(rotor).decode()}"
    picture = None if seen is None else tag("img", src=seen, alt="The rotor in trim")
    return tag("div.front", picture, _disk(report, report.entries[0], field, "front-bar"))


def _disk(report: DesignReport, entry: ReportEntry, field: Field, name: str) -> Markup:
    """A field over the disk above its scale. `name`: of the scale, unique."""
    colour_range, label = report.colour_range(field), f"{field.title} over the disk"
    drawn = disk_drawing(
        entry.solution, field, colour_range, PIXELS, letters=_LETTERS, units=report.units
    )
    box = f"{-HALF_EDGE:g} {-HALF_EDGE:g} {2 * HALF_EDGE:g} {2 * HALF_EDGE:g}"
    disk = tag("svg", drawn, viewBox=box, role="img", aria_label=label)
    return tag("figure", disk, bar(field, colour_range, name))


def disks(report: DesignReport, entry: ReportEntry, k: int) -> Markup:
    """The fields over the disk, each with its scale, and the key of the marked regions."""
    solution = entry.solution
    drawings = [
        _disk(report, entry, field, f"bar-{k}-{n}") for n, field in enumerate(fields_of(report))
    ]
    key = [
        tag("span", tag("svg", swatch, width=14, height=8), f" {title}")
        for title, swatch in key_entries(solution)
    ]
    several = " Colours are the same for all designs." if len(report.shown) > 1 else ""
    seen = tag("span.dim", f"From above, nose up, advancing side right.{several}")
    return group(tag("h3", "Over the disk"), tag("div.disks", drawings), tag("p.key", key, seen))


def bar(field: Field, colour_range: tuple[float, float], name: str) -> Markup:
    """A colour bar as a separate SVG."""
    drawn = bar_drawing(field, colour_range, _BAR, name, _LETTERS)
    return tag("svg.bar-svg", drawn, viewBox=f"-14 0 {_BAR + 28:g} {4 * _LETTERS:g}")


def along(solution: Solution) -> Markup:
    """Angle of attack and lift coefficient along the blade at four azimuths."""
    r = solution.disk.r
    alpha, lift = [], []
    for degrees, colour in AZIMUTHS.items():
        lower, upper, angle = plots.angles_along(solution, float(degrees))
        if degrees == 270:
            names = zip(("static stall angle at ψ 270°", ""), (lower, upper), strict=True)
            alpha += [Line(name, r, limit, BASELINE, dashes=True) for name, limit in names]
        alpha.append(Line(f"ψ {degrees}°", r, angle, colour))
        cl = np.where(np.isfinite(angle), plots.lift_along(solution, float(degrees)), math.nan)
        lift.append(Line(f"ψ {degrees}°", r, cl, colour))
    x_label, x_range = "r/R; reverse flow omitted", (0.1, 1.01)
    charts = [
        Chart(
            "Angle of attack",
            Axis(x_label, range=x_range),
            Axis("α [°]", range=(-15.0, 20.0)),
            tuple(alpha),
        ),
        Chart(
            "Lift coefficient",
            Axis(x_label, range=x_range),
            Axis("C_l", range=(-0.5, 1.5)),
            tuple(lift),
        ),
    ]
    return tag("h3", "Along the blade") + _charts(charts)


def actuator_section(verdict: Verdict | str, units: Units) -> Markup:
    """The verdict, its parts and its band, or why there is none; empty where no actuator was chosen."""
    if not verdict:
        return Markup()
    title = tag("h2", "Actuator")
    if isinstance(verdict, str):
        return tag("section.actuator", title, tag("ul.care", tag("li", verdict)))
    placement, first = verdict.installed.placement, verdict.installed.actuator.name
    low, high = placement.span
    where = f"{verdict.installed.count}, {verdict.installed.host.label}, {low:.2f}–{high:.2f} R"
    unit = tag("span.dim", f"{units.power[0].symbol}, {mission_words(verdict.baseline.mission)}")
    word = None if verdict.net_band is None else sureness(verdict.net_saving, verdict.net_band)
    kind = change_kind(-verdict.net_saving, word)
    cares = [*(limit.sentence for limit in verdict.broken), *verdict.caveats]
    sentence = f"Compared with {reference(verdict)}, it {needs(verdict, units)} over the mission."
    fuel = tag("p", tag("b", fuel_words(verdict)), data_report="fuel")
    parts = tag(
        "figure.chart",
        tag("figcaption", tag("b", "Extra power"), unit),
        _balance_bars(verdict, units),
        fuel,
    )
    return tag(
        "section.actuator",
        title,
        tag("p.lead", f"{first}, {where}; {mass_words(verdict.installed)}"),
        tag(
            "p.lead",
            sentence,
            class_="" if kind == "less" and not verdict.buildable else kind,
            data_report="verdict",
        ),
        tag("p.dim", verdict_details(verdict, (units.power[0].symbol, units.power[0].size))),
        parts,
        tag("ul.care", [tag("li", care) for care in cares]) if cares else None,
    )


def _balance_bars(verdict: Verdict, units: Units) -> Markup:
    """Each part beside the end of the one before; what is left from zero."""
    rows = balance(verdict.savings, units, verdict.net_band, verdict.bands, verdict.sourced)
    ends, reached = [], 0.0
    for row in rows:
        start = 0.0 if row is rows[-1] else reached
        ends.append((start, start + row.value))
        reached += row.value
    reach = [
        (min(a, b - row.band), max(a, b + row.band)) for row, (a, b) in zip(rows, ends, strict=True)
    ]
    low, high = min(0.0, *(one for one, _ in reach)), max(0.0, *(one for _, one in reach))
    room = _WIDE - _NAME - _NUMBER

    def at(power: float) -> float:
        return _NAME + room * (power - low) / max(high - low, 1e-3)

    height = _ROW * len(rows)
    drawn: list[Content] = [tag("line.zero", x1=at(0.0), x2=at(0.0), y1=0, y2=height)]
    for k, (row, (start, end)) in enumerate(zip(rows, ends, strict=True)):
        text, top, kind = row.text, _ROW * k, row.kind or None
        left, width = min(at(start), at(end)), abs(at(end) - at(start))
        weight = 650 if k == len(rows) - 1 else None
        drawn.append(
            tag("rect", x=left, y=top + 6, width=width, height=_ROW - 12, class_=kind or "unsure")
        )
        if row.band:
            y, left, right = top + 0.5 * _ROW, at(end - row.band), at(end + row.band)
            drawn.append(tag("line.band", tag("title", row.words), x1=left, x2=right, y1=y, y2=y))
        drawn.append(tag("text", row.name, x=0, y=top + 20, font_weight=weight))
        look = {
            "text_anchor": "end",
            "class_": kind,
            "font_weight": weight,
            "data_report": "balance",
        }
        drawn.append(tag("text", text, x=_WIDE, y=top + 20, **look))
    label = ", ".join(row.words or f"{row.name} {row.text} {units.power[0].symbol}" for row in rows)
    return tag(
        "svg.balance", drawn, viewBox=f"0 0 {_WIDE:g} {height:g}", role="img", aria_label=label
    )
