"""Figures of the report: power over speed, twist, disks with their scales, charts along the blade, and its actuator."""

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
from explorer.export.report.contents import DesignReport, JudgedActuator, ReportEntry, colours_of, fields_of
from explorer.model.units import Units, number
from explorer.picture.fields import Field
from explorer.text.readout import balance, fuel_words, pair_words, signed
from rotor import Solution
from rotor.actuator import ActuatorFlight, Verdict, verdict_details, verdict_sentence
from rotor.actuator.verdict import count
from rotor.arrays import Array
from rotor.chart import Axis, Chart, Line, Points
from rotor.chart_svg import svg

PIXELS = 480
"""Pixels of a disk along each edge: the labels of its regions can be read."""
AZIMUTHS = {0: "#0ca678", 90: "#e8590c", 180: "#1c7ed6", 270: "#9c36b5"}
"""Azimuths of the charts along the blade, with their colours: tail, advancing, nose, retreating."""
_BAR = 200.0
_LETTERS = 10.0
_WIDE, _ROW, _NAME, _NUMBER = 480.0, 30.0, 92.0, 74.0
"""[px] of the balance: its width, a row, and the room for names and numbers beside the bars."""
_WANTED, _REACHED, _RANGE = "#e8590c", "#1c7ed6", "#868e96"


def overview(report: DesignReport, curves: PowerCurves) -> str:
    """Power over advance ratio and twist along the blade, all designs together."""
    pairs = list(zip(report.all, colours_of(report), strict=True))
    power = [one for entry, colour in reversed(pairs) for one in _power(report, entry, colour, curves)]
    r = np.linspace(report.entries[0].solution.design.rotor.blade.root_cutout, 1.0, 160)
    twist, load = [], []
    for entry, colour in reversed(pairs):
        dashed = entry is report.reference
        solution = entry.solution
        twist.append(Line(entry.title, r, np.degrees(solution.design.twist(r)), colour, dashes=dashed))
        load.append(Line(entry.title, solution.disk.r, lift_per_metre(solution) / 1e3, colour, dashes=dashed))
    seen = [y for one in power for x, y in zip(one.x, one.y, strict=True) if x <= 0.4 and math.isfinite(y)]
    y_range, unit = held_range(None, 0.0, max(seen, default=1.0)), report.units.power[0].symbol
    speed, speeds, along_r = "advance ratio µ", (-0.01, 0.46), (0.1, 1.01)
    changes = [one for entry, colour in pairs for one in _change(report, entry, colour, curves)]
    zero = Line("", speeds, (0.0, 0.0), BASELINE, dashes=True)
    against = f"vs. {report.reference.title} [%]"
    charts = [
        Chart(
            "Power over advance ratio", Axis(f"{speed}; hover as a point", range=speeds),
            Axis(f"total power [{unit}]", range=y_range), tuple(power),
        ),
        *([Chart("Change of power", Axis(speed, range=speeds), Axis(against), (zero, *changes))] if changes else []),
        Chart("Jig twist along the blade", Axis("r/R", range=along_r), Axis("twist [°], zero at 0.75 R"), tuple(twist)),
        Chart("Load along the blade", Axis("r/R", range=along_r), Axis("dT/dr, mean over azimuth [kN/m]"), tuple(load)),
    ]  # fmt: skip
    return f"<section><h2>Over speed and along the blade</h2>{_charts(charts)}</section>"


def _charts(charts: Sequence[Chart]) -> str:
    return f'<div class="charts">{"".join(map(figure, charts))}</div>'


def figure(chart: Chart) -> str:
    """A chart with its title, as HTML."""
    title = f"<figcaption><b>{escape(chart.title)}</b></figcaption>"
    return f'<figure class="chart">{title}{svg(chart, inline=True)}</figure>'


def _power(report: DesignReport, entry: ReportEntry, colour: str, curves: PowerCurves) -> list[Line | Points]:
    """Curve over advance ratio, hover as a point, the present condition as a point."""
    design = entry.solution.design
    curves.sweep(design, report.reference.solution.design, lambda: False)
    curve, mu = curves.known(design, report.reference.solution.design), np.array(SWEEP)
    is_reference = entry is report.reference
    unit = report.units.power[0]
    here = np.array([design.condition.advance_ratio]), np.array([unit.of(entry.solution.power.total)])
    total, ideal = (1e3 * values / unit.size for values in (curve.design, curve.ideal))
    found: list[Line | Points] = [
        Line(entry.title, *_smooth(total), colour, dashes=is_reference),
        Points("", mu[:1], total[:1], colour),
    ]
    if entry is report.entries[0]:
        found.insert(0, Line("ideal for its lift", *_smooth(ideal), IDEAL, dashes=True))
    return found if is_reference else [*found, Points("", *here, colour)]


def _change(report: DesignReport, entry: ReportEntry, colour: str, curves: PowerCurves) -> list[Line | Points]:
    """Change against the reference over speed, for blades with the same weight and altitude."""
    design, reference = entry.solution.design, report.reference.solution.design
    alike = replace(design.condition, advance_ratio=0.0) == replace(reference.condition, advance_ratio=0.0)
    if entry is report.reference or not alike:
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
            alpha += [Line(name, r, limit, BASELINE, dashes=True) for name, limit in names]
        alpha.append(Line(f"ψ {degrees}°", r, angle, colour))
        cl = np.where(np.isfinite(angle), plots.lift_along(solution, float(degrees)), math.nan)
        lift.append(Line(f"ψ {degrees}°", r, cl, colour))
    x_label, x_range = "r/R; reverse flow omitted", (0.1, 1.01)
    charts = [
        Chart("Angle of attack", Axis(x_label, range=x_range), Axis("α [°]", range=(-15.0, 20.0)), tuple(alpha)),
        Chart("Lift coefficient", Axis(x_label, range=x_range), Axis("C_l", range=(-0.5, 1.5)), tuple(lift)),
    ]
    return f"<h3>Along the blade</h3>{_charts(charts)}"


def actuator_section(actuator: JudgedActuator | str, units: Units) -> str:
    """The section; empty where no actuator was chosen."""
    if not actuator:
        return ""
    if isinstance(actuator, str):
        return f'<section class="actuator"><h2>Actuator</h2><ul class="care"><li>{escape(actuator)}</li></ul></section>'
    verdict, flight = actuator.verdict, actuator.flight
    kind = "less" if verdict.pays else "more"
    placement, first = verdict.installed.placement, verdict.installed.actuator.name
    low, high = placement.span
    where = f"{count(verdict)}, {verdict.installed.host.label}, {low:.2f}–{high:.2f} R"
    flown = f"<p class='note'>{escape(flight)}</p>" if isinstance(flight, str) else _over_flight(flight)
    legs = "" if isinstance(flight, str) else _legs(flight, verdict, units)
    return (
        f'<section class="actuator"><h2>Actuator</h2><p class="lead">{escape(first)}, {escape(where)}</p>'
        f'<p class="{kind} lead" data-report="verdict">{escape(verdict_sentence(verdict))}</p>'
        f'<p class="dim">{escape(verdict_details(verdict))}</p>'
        f'<div class="charts"><figure class="chart"><figcaption><b>Balance of power</b>'
        f'<span class="dim">{units.power[0].symbol}, {escape(pair_words(verdict))}</span></figcaption>'
        f'{_bars(verdict, units)}<p data-report="fuel"><b>{escape(fuel_words(verdict))}</b></p></figure>'
        f"{flown}</div>{legs}{_cares(verdict)}</section>"
    )


def _bars(verdict: Verdict, units: Units) -> str:
    """Each part beside the end of the one before; what is left from zero."""
    rows = balance(verdict)
    ends, reached = [], 0.0
    for k, (_, power) in enumerate(rows):
        start = 0.0 if k == len(rows) - 1 else reached
        ends.append((start, start + power))
        reached += power
    low, high = min(0.0, *map(min, ends)), max(0.0, *map(max, ends))
    room = _WIDE - _NAME - _NUMBER

    def at(power: float) -> float:
        return _NAME + room * (power - low) / max(high - low, 1.0)

    drawn = f'<line x1="{at(0.0):.1f}" x2="{at(0.0):.1f}" y1="0" y2="{_ROW * len(rows):g}" class="zero"/>'
    for k, ((name, power), (start, end)) in enumerate(zip(rows, ends, strict=True)):
        text, top = signed(power, units), _ROW * k
        kind = {"−": "more", "+": "less"}.get(text[0], "dim")
        left, width = min(at(start), at(end)), abs(at(end) - at(start))
        weight = ' font-weight="650"' if k == len(rows) - 1 else ""
        if kind != "dim":
            drawn += f'<rect x="{left:.1f}" y="{top + 6:g}" width="{width:.1f}" height="{_ROW - 12:g}" class="{kind}"/>'
        drawn += (
            f'<text x="0" y="{top + 20:g}"{weight}>{escape(name)}</text>'
            f'<text x="{_WIDE:g}" y="{top + 20:g}" text-anchor="end" class="{kind}"{weight} data-report="balance">'
            f"{text}</text>"
        )
    said = ", ".join(f"{name} {signed(power, units)}" for name, power in rows)
    return (
        f'<svg viewBox="0 0 {_WIDE:g} {_ROW * len(rows):g}" class="balance" role="img" '
        f'aria-label="{escape(said)} {units.power[0].symbol}">{drawn}</svg>'
    )


def _over_flight(flight: ActuatorFlight) -> str:
    """Tip twist wanted and reached, and what the actuator can reach, over the legs by advance ratio."""
    mu = np.array([leg.advance_ratio for leg in flight.legs])
    low, high = (np.full(len(mu), math.degrees(end)) for end in flight.reach)
    lines = (
        Line("within reach", mu, low, _RANGE, dashes=True),
        Line("", mu, high, _RANGE, dashes=True),
        Line("wanted", mu, np.degrees(flight.wanted), _WANTED),
        Line("reached", mu, np.degrees(flight.reached), _REACHED),
        Points("", mu, np.degrees(flight.reached), _REACHED),
    )
    names = ", ".join(leg.name for leg in flight.legs)
    return figure(
        Chart("Tip twist over the flight", Axis(f"advance ratio µ: {names}"), Axis("change of tip twist [°]"), lines)
    )


def _legs(flight: ActuatorFlight, verdict: Verdict, units: Units) -> str:
    """A row for each leg."""
    tip_speed = verdict.baseline.pair.design.rotor.tip_speed
    rows = ""
    for k, leg in enumerate(flight.legs):
        speed = units.speed[0].text(leg.advance_ratio * tip_speed)
        climb = units.climb_rate(leg.climb_speed)
        fuel = "–" if flight.fuel_saving is None else number(-3600.0 * float(flight.fuel_saving[k]), 1, sign=True)
        cells = (
            f"{leg.name}, {speed}" + (f", {climb}" if climb else ""),
            *(number(math.degrees(float(of[k])), 1, sign=True) for of in (flight.wanted, flight.reached)),
            number(abs(math.degrees(float(flight.shortfall[k]))), 1),
            signed(float(flight.net_saving[k]), units),
            fuel,
        )
        rows += f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in cells)}</tr>"
    heads = ("Leg", "wanted °", "reached °", "short °", f"net {units.power[0].symbol}", "fuel kg/h")
    head = "".join(f"<th>{name}</th>" for name in heads)
    return f'<div class="wide"><table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>'


def _cares(verdict: Verdict) -> str:
    """Limits that are exceeded, then caveats."""
    sentences = [*(limit.sentence for limit in verdict.broken), *verdict.caveats]
    items = "".join(f"<li>{escape(sentence)}</li>" for sentence in sentences)
    return f'<ul class="care">{items}</ul>' if items else ""
