"""What a search says on the page, as HTML, and the small drawing of what a concept moves."""

from collections.abc import Callable
from functools import lru_cache
from html import escape

import numpy as np

from explorer.charts.strip import role_line
from explorer.colours import NOW, START_COLOURS, THIS, css
from explorer.model.units import SI, Units, number
from explorer.tabs.optimise.search_run import SearchRun, StartTrace
from rotor import Optimum
from rotor.chart import Axis, Chart, Line
from rotor.design import PiecewiseLinearTwist
from rotor.optimisation import Concept
from rotor.optimisation.concepts import Handle

_WIDTH, _HEIGHT, _EDGE = 272, 62, 8
_MIDDLE, _AMPLITUDE = 28, 15
_ROOT = 0.13
_EQUAL = 50.0
"""Powers closer than this [W] read the same."""
_NOMINAL = {"tilt": (-0.21, -0.09, -0.24), "bend": (0.28,), "lift": (0.17, 0.09, 0.055, 0.03, -0.025, -0.05)}
"""Typical values [SI] that tell the shapes apart; a slide stands where it is typical."""


@lru_cache(maxsize=32)
def concept_picture(concept: Concept) -> str:
    """SVG: root at the left, tip at the right, nose-up above."""
    values, counts = [], {"tilt": 0, "bend": 0, "lift": 0}
    for handle, parameter in zip(concept.handles, concept.parameters, strict=True):
        if handle.motion == "slide":
            values.append(0.45 * parameter.low + 0.55 * parameter.high)
        else:
            nominal = _NOMINAL[handle.motion]
            values.append(nominal[counts[handle.motion] % len(nominal)])
            counts[handle.motion] += 1
    law = concept.twist(values)
    r = np.linspace(_ROOT, 1.0, 60)
    angle = law(r)
    top, bottom = float(angle.max()), float(angle.min())

    def y(at: float) -> float:
        return _MIDDLE - _AMPLITUDE * (2.0 * (float(law(np.array([at]))[0]) - bottom) / (top - bottom) - 1.0)

    curve = " ".join(f"{_x(float(at)):.1f},{y(float(at)):.1f}" for at in r)
    marks = [_mark(handle, y) for handle in concept.handles]
    if isinstance(law, PiecewiseLinearTwist):
        marks += [f'<circle cx="{_x(place):.1f}" cy="{y(place):.1f}" r="3" fill="{THIS}"/>' for place in law.breaks]
    return (
        f'<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" width="100%" role="img" aria-label="what the concept moves">'
        f'<line x1="{_x(_ROOT)}" y1="{_MIDDLE}" x2="{_x(1.0)}" y2="{_MIDDLE}" stroke="currentColor" opacity=".25"/>'
        f'<polyline points="{curve}" fill="none" stroke="currentColor" stroke-width="2"/>{"".join(marks)}'
        f'<g font-size="11" fill="currentColor" opacity=".65"><text x="{_x(_ROOT)}" y="{_HEIGHT - 2}">root</text>'
        f'<text x="{_x(1.0)}" y="{_HEIGHT - 2}" text-anchor="end">tip</text></g></svg>'
    )


def _x(r: float) -> float:
    return round(_EDGE + (_WIDTH - 2 * _EDGE) * (r - _ROOT) / (1.0 - _ROOT), 1)


def _mark(handle: Handle, y: Callable[[float], float]) -> str:
    if handle.motion == "slide":
        low, high = _x(handle.inner), _x(handle.outer)
        return _arrow(low, 52.0, high, 52.0, THIS)
    at = handle.inner if handle.motion == "lift" else 0.5 * (max(handle.inner, _ROOT) + handle.outer)
    if handle.motion == "tilt" and handle.outer - handle.inner >= 1.0:
        at = 0.93
    x, middle = _x(max(at, _ROOT)), y(at)
    return _arrow(x, middle - 11.0, x, middle + 11.0, NOW)


def _arrow(x1: float, y1: float, x2: float, y2: float, colour: str) -> str:
    """A line with a head at both ends."""
    if x1 == x2:
        heads = f"M{x1 - 3},{y1 + 4} L{x1},{y1} L{x1 + 3},{y1 + 4} M{x2 - 3},{y2 - 4} L{x2},{y2} L{x2 + 3},{y2 - 4}"
    else:
        heads = f"M{x1 + 4},{y1 - 3} L{x1},{y1} L{x1 + 4},{y1 + 3} M{x2 - 4},{y2 - 3} L{x2},{y2} L{x2 - 4},{y2 + 3}"
    return f'<path d="M{x1},{y1} L{x2},{y2} {heads}" fill="none" stroke="{colour}" stroke-width="1.5"/>'


def headline(run: SearchRun, units: Units = SI) -> str:
    """The least power so far as a large number, and how each start compares."""
    starts = run.starts()
    ends = [one.best[-1] for one in starts if one.best]
    if not ends:
        return ""
    change = None if run.start_power is None else min(ends) - run.start_power
    kind = "" if change is None or abs(change) < _EQUAL else "rx-less" if change < 0.0 else "rx-more"
    objective = run.search.objective
    several = objective is not None and len(objective.conditions) > 1
    mean = "mean power" if several else f"{'total' if objective is None else objective.quantity} power"
    mean += ", best so far" if run.under_way else ", best found"
    rows = "".join(
        f'<span><i style="background:{css(START_COLOURS[k])}"></i>{escape(one.legend(units))}</span>'
        for k, one in enumerate(starts)
    )
    return (
        f'<div class="rxp-big" data-explorer="starts"><b data-explorer="best">{units.watts(min(ends), 1)}</b>'
        f'<em class="{kind}">{"" if change is None else units.watts(change, 1, sign=True)}</em>'
        f'<div class="rx-dim">{mean}{_against_start(min(ends), run.start_power)}</div>'
        f'<div class="rxp-starts">{rows}</div></div>'
    )


def starts_chart(run: SearchRun, units: Units) -> Chart:
    """The least power so far over the designs that each start has tried, for the strip below the scene."""
    unit, starts = units.power[0], run.starts()
    low, high = (unit.of(end) for end in power_axis(starts, run.start_power))
    longest = float(max([10, *(len(one.best) for one in starts)]))
    lines = [
        Line("", range(1, len(one.best) + 1), [unit.of(power) for power in one.best], css(START_COLOURS[k]),
             width=2.8 if one.is_best else 1.4)
        for k, one in enumerate(starts)
        if one.best
    ]  # fmt: skip
    if run.start_power is not None:
        lines.insert(0, role_line("reference", (1.0, longest), (unit.of(run.start_power),) * 2))
    above = sum(unit.of(power) > high for one in starts for power in one.powers)
    return Chart(
        "Searches from several starts",
        Axis(range=(1.0, longest)),
        Axis(f"least {unit.symbol} so far over designs tried", (low, high)),
        tuple(lines),
        value=_agreement(starts),
        note=f"{above} designs lie above the axis." if above else "",
    )


def _agreement(starts: tuple[StartTrace, ...]) -> str:
    """Which of the starts are best, as far as the digits that the page shows tell them apart."""
    best = [one.number for one in starts if one.gap is not None and one.gap < _EQUAL]
    if len(best) == len(starts) > 1:
        return f"all {len(starts)} starts agree"
    if len(best) > 1:
        return f"{len(best)} of {len(starts)} starts are best"
    return f"start {best[0]} is best" if best else ""


def power_axis(starts: tuple[StartTrace, ...], start_power: float | None) -> tuple[float, float]:
    """Range of power [W] that shows where the starts end, not the worst designs tried on the way."""
    ends = [one.best[-1] for one in starts if one.best]
    if not ends:
        return 0.0, 1.0
    low = min(ends)
    high = max(1.01 * low, start_power or 0.0)
    margin = 0.05 * (high - low)
    return low - margin, high + margin


def standing(run: SearchRun | None, problem: str = "") -> str:
    """One line beneath the bar: where the search stands."""
    if problem:
        return f'<div class="rx rx-found" data-explorer="search" data-kind="broken"><b>{escape(problem)}</b></div>'
    if run is None:
        return '<div class="rx rx-dim" data-explorer="search" data-kind="idle">Not run yet.</div>'
    progress = run.progress
    count = "" if progress is None else f"{number(progress.evaluation)} designs · {number(progress.elapsed, 1)} s"
    if run.optimum is not None:
        count = f"{number(run.optimum.evaluations)} designs · {number(run.optimum.elapsed, 1)} s"
    return (
        f'<div class="rx rx-line" data-explorer="search" data-kind="{run.state}">'
        f"<span>{escape(_where(run))}</span><span class='rx-dim rx-num'>{count}</span></div>"
    )


def _where(run: SearchRun) -> str:
    progress, kept = run.progress, "best so far is kept" if run.best else "nothing found yet"
    match run.state:
        case "starting":
            return "Starting a worker …"
        case "waiting":
            return "Waiting: next in line" if run.ahead == 0 else f"Waiting: {run.ahead} ahead"
        case "stopping":
            return "Stopping …"
        case "running":
            if progress is None:
                return "Trimming the current design …"
            if progress.phase == "band":
                return "Measuring the 0.1 % band"
            return f"Starting point {progress.start + 1} of {progress.starts}"
        case "done":
            return "Done"
        case "stopped":
            return f"Stopped, {kept}"
        case "late":
            return f"Time is up, {kept}"
        case "broken":
            return f"Ended early, {kept}"


def _against_start(power: float, start: float | None) -> str:
    if not start or start <= 0.0:
        return "; the starting design has no trim"
    return f", {number(100.0 * (power / start - 1.0), 2, sign=True)} % vs. start"


def result(run: SearchRun, units: Units = SI) -> str:
    """What the best so far saves against what is not the starting design; or why there is none."""
    best = run.best
    parts = []
    if run.state == "broken":
        parts.append(f"<div class='rx-broken'>{escape(run.sentence)}</div>")
    if best is None:
        if run.state == "done":
            parts.append(f"<div>{escape(run.sentence)}</div>")
        return _block(parts)
    if run.reference_power != run.start_power:
        parts.append(f"<table>{_saving(run.reference_title, best.power, run.reference_power, units)}</table>")
    return _block(parts)


def details(run: SearchRun, units: Units = SI) -> str:
    """What the optimum is made of, how flat it is, and what else was found."""
    optimum = run.optimum
    return "" if optimum is None or optimum.best is None else _block([_optimum(optimum, run.concept, units)], "details")


def _block(parts: list[str], name: str = "found") -> str:
    return f'<div class="rx rx-found" data-explorer="{name}">{"".join(parts)}</div>' if parts else ""


def _saving(title: str, power: float, reference: float | None, units: Units) -> str:
    if reference is None or reference <= 0.0:
        return f'<tr><td class="rx-dim">{escape(title)}</td><td class="rx-num">has no trim</td><td></td></tr>'
    less = power <= reference
    percent = 100.0 * (power / reference - 1.0)
    kind = "" if abs(percent) < 0.005 else " rx-less" if less else " rx-more"
    return (
        f'<tr><td class="rx-dim">{"saving vs." if less else "above"} {escape(title)}</td>'
        f'<td class="rx-num">{units.watts(abs(power - reference), 1)}</td>'
        f'<td class="rx-num{kind}" style="width:26%">{number(abs(percent), 2)} %</td></tr>'
    )


def _optimum(optimum: Optimum, concept: Concept, units: Units) -> str:
    best = optimum.best
    assert best is not None
    bands = {band.parameter: band for band in optimum.band}
    rows = []
    for parameter, value in zip(concept.parameters, best.parameters, strict=True):
        band, digits = bands.get(parameter.name), 1 if parameter.angular else 2
        reach = ""
        if band is not None:
            reach = f"{number(parameter.shown(band.low), digits)} … {number(parameter.shown(band.high), digits)}"
        rows.append(
            f'<tr><td>{escape(parameter.title)}</td><td class="rx-num">{number(parameter.shown(value), digits)}</td>'
            f'<td class="rx-dim rx-unit">{escape(parameter.shown_unit)}</td>'
            f'<td class="rx-num rx-dim">{reach}</td></tr>'
        )
    heading = (
        '<tr class="rx-dim rx-small"><td class="rx-num" colspan="4">range within 0.1 % of the least power</td></tr>'
    )
    lines = [f"<table>{heading if bands else ''}{''.join(rows)}</table>"]
    notes = [optimum.message]
    if best.active:
        notes.append(f"Active limits: {', '.join(name.replace('_', ' ') for name in best.active)}.")
    if best.index is not None:
        notes.append(f"Vibration index {number(best.index, 1)} %.")
    others = [units.watts(other.power, 1) for other in optimum.minima[1:3]]
    if others:
        notes.append(f"Other {'minimum' if len(others) == 1 else 'minima'}: {', '.join(others)}.")
    lines.append(f'<div class="rx-dim rx-small">{escape(" ".join(notes))}</div>')
    return "".join(lines)


def frame_line(run: SearchRun, units: Units = SI) -> str:
    """What the scrubber points at."""
    if not run.frames:
        return ""
    frame = run.frames[run.cursor]
    power = frame.power if frame.power < 1e12 else None  # A design that did not trim has no power.
    what = "starting design" if run.cursor == 0 else f"design {frame.evaluation}"
    return (
        f'<div class="rx rx-line rx-dim rx-small" data-explorer="frame"><span>{what}</span>'
        f"<span>{units.watts(power, 1)}</span></div>"
    )


def moved_on() -> str:
    """The sliders no longer hold the starting design of the search."""
    return (
        '<div class="rx rx-dim rx-small" data-explorer="frame">The sliders have changed. Apply takes the optimum.</div>'
    )
