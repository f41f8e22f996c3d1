"""Words, numbers, chart data and the drawn section of the Actuate mode; degrees, volts and kW begin here."""

import math
from functools import lru_cache
from html import escape

import numpy as np

from explorer.charts.plots import Plot, Range, held_range
from explorer.charts.svg import line, polygon
from explorer.colours import css
from explorer.model.units import number
from explorer.tabs.actuator.actuator_inputs import ActuatorInputs
from explorer.tabs.actuator.actuator_tasks import Outcome
from explorer.tabs.actuator.electrodes import named_lines
from explorer.tabs.actuator.lifted_picture import drive_colour, drive_text
from rotor import Design, Solution
from rotor.actuator import (
    Actuator,
    ExtensionTwist,
    InstalledActuator,
    PiezoPly,
    PowerMap,
    Verdict,
    verdict_details,
    verdict_sentence,
)
from rotor.actuator.harmonic import tip_response
from rotor.actuator.limits import Limit
from rotor.actuator.pictures import Part, section_picture
from rotor.arrays import Array
from rotor.reproduce.report import typographic

_NONE = "–"
_SHIFT = {0.0: ";transform:none", 100.0: ";transform:translateX(-100%)"}
"""The outer numbers stay within the bar."""


def voltage_bar(actuator: Actuator) -> str:
    """The colours of the plies: both sides of the voltage range, each to its own end."""
    low, high, unit = -100.0, 100.0, "%"
    if isinstance(actuator, PiezoPly):
        low, high, unit = *actuator.voltage_range, "V"
    stops = ",".join(css(drive_colour(k / 8.0)) for k in range(-8, 9))
    marks = ((0.0, low), (25.0, 0.5 * low), (50.0, 0.0), (75.0, 0.5 * high), (100.0, high))
    ticks = "".join(
        f'<i style="left:{at:g}%"></i><span style="left:{at:g}%{_SHIFT.get(at, "")};white-space:nowrap">'
        f"{number(value)}{' ' + unit if at == 100.0 else ''}</span>"
        for at, value in marks
    )
    return (
        '<div class="rx rx-scale" data-explorer="voltage-bar">'
        f'<div class="rx-gradient" style="background:linear-gradient(90deg,{stops})"></div>'
        f'<div class="rx-ticks">{ticks}</div></div>'
    )


def sweep_panel(power: PowerMap | str | None, inputs: ActuatorInputs, design: Design) -> str:
    """Least power over amplitude and phase, and where more twist costs."""
    return f'<div class="rx rx-small" data-explorer="swept">{escape(sweep_sentence(power, inputs, design))}</div>'


def now_panel(inputs: ActuatorInputs, installed: InstalledActuator, solution: Solution) -> str:
    """What the sliders make of the blade at this moment. `solution` with the actuator."""
    elastic = solution.elastic is not None
    tip = math.degrees(inputs.tip(installed, solution.design))
    lines: list[str] = []
    response = inputs.turning(installed, elastic)
    if response is not None:
        half = math.degrees(response.amplitude)
        if half:
            used = number(0.01 * inputs.amplitude * half, 2)
            text = f"and ±{used}° of {number(half, 2)}° at {inputs.per_rev}/rev, as the blades turn"
            if elastic:
                flown = math.degrees(tip_response(solution, inputs.per_rev)[0])
                text = (
                    f"and ±{used}° of {number(half, 2)}° at {inputs.per_rev}/rev on a blade at rest; flown, with the "
                    f"elastic twist, ±{number(flown, 2)}°"
                )
        else:
            text = f"cannot respond at {inputs.per_rev}/rev"
        lines.append(f'<div class="rx-dim rx-small">{text}</div>')
    over = over_range(inputs, installed)
    if over:
        lines.append(f'<div class="rxa-bad rx-small">{escape(over)}</div>')
    drives = " · ".join(drive_text(inputs, installed, k) for k in range(len(installed.shapes)))
    words = f"tip twist at {drives}" if inputs.driven else "tip twist, at rest"
    return (
        '<div class="rx" data-explorer="actuator-now"><div class="rxa-now">'
        f'<b data-explorer="actuator-twist">{number(tip, 2, sign=True)}°</b><span class="rx-dim">{words}</span></div>'
        f"{''.join(lines)}</div>"
    )


def unmeasured() -> str:
    """What is known of the benefit of active twist from tests."""
    return (
        '<div class="rx rx-dim rx-small" data-explorer="unmeasured">Not validated: we found no measured power benefit '
        "of active twist. Published savings are computed.</div>"
    )


def over_range(inputs: ActuatorInputs, installed: InstalledActuator) -> str:
    """A sentence when steady voltage and harmonic together leave the range; empty otherwise."""
    actuator = installed.actuator
    if not inputs.per_rev or not isinstance(actuator, PiezoPly):
        return ""
    wave = 0.01 * inputs.amplitude * 0.5 * actuator.voltage_swing
    volts = inputs.volts(installed)
    least, most = min(volts) - wave, max(volts) + wave
    low, high = actuator.voltage_range
    if least >= low - 1e-6 and most <= high + 1e-6:
        return ""
    return (
        f"Voltage runs from {number(least)} to {number(most)} V, beyond {number(low)}…{number(high)} V: "
        f"lower the amplitude, or rest at {number(0.5 * (low + high))} V."
    )


def fit_panel(inputs: ActuatorInputs, installed: InstalledActuator, verdict: Verdict | None) -> str:
    """Numbers in two columns: those of the actuator on the blade are known at once, those of the verdict follow."""
    masses = installed.masses
    nominal, tested = math.degrees(installed.attainable), math.degrees(installed.attainable * installed.derating)
    entries = [
        ("Required Δtwist", _NONE if verdict is None else f"{number(math.degrees(verdict.required), 2)}°"),
        ("Added mass", f"{number(masses.aircraft)} kg"),
        ("Available", f"{number(nominal, 2)}°"),
        ("on each blade", f"{number(masses.blade, 1)} kg"),
        ("derated by test", f"{number(tested, 2)}°" if installed.derating < 1.0 else _NONE),
        ("First torsion", f"{number(installed.frequency, 2)} /rev"),
        ("twist commanded", f"{number(nominal * inputs.share, 2)}°"),
        ("Moment", f"{number(installed.moment)} N·m" if installed.moment else _NONE),
        ("Slewing power", _NONE if verdict is None else f"{number(verdict.drive.slew_power)} W"),
        ("Unlimited twist", _kw(None if verdict is None else verdict.ideal_saving)),
    ]
    return f'<div class="rx rx-grid" data-explorer="actuator-numbers">{named_lines(entries)}</div>'


def verdict_panel(outcome: Outcome | None, before: Verdict | None = None) -> str:
    """The verdict in one line, and what it rests on folded; on its way, the one before; or why there is none."""
    if isinstance(outcome, str):
        return _box("wrong", "problem", escape(outcome))
    shown = outcome or before
    if shown is None:
        return _box("wait", "computing", "<b>Computing what the actuator saves and what it costs…</b>")
    name = escape(shown.installed.actuator.name)
    why = f"<details><summary>{name}: reach and limits</summary>{escape(verdict_details(shown))}</details>"
    text = f"<b>{escape(verdict_sentence(shown))}</b>{why}"
    if outcome is None:
        return _box("wait", "computing", f'<div class="rx-faded">{text}</div><small>computing…</small>')
    return _box("yes" if shown.pays else "no", "ready", text)


def _box(look: str, kind: str, text: str) -> str:
    return f'<div class="rxa-box rxa-{look}" data-explorer="verdict" data-kind="{kind}">{text}</div>'


def segments_panel(installed: InstalledActuator, share: float, verdict: Verdict | None) -> str:
    """Bars: what each segment can make, nominal and as tested, with a mark where the optimum asks for it."""
    if isinstance(installed.actuator, ExtensionTwist) and verdict is None:
        return ""
    can = np.degrees(installed.segment_twists)
    need = None if verdict is None else np.degrees(np.abs(verdict.required_segments))
    largest = max(float(can.max()), 0.0 if need is None else float(need.max()), 0.1) * 1.05
    rows: list[str] = []
    for k, each in enumerate(can):
        mark = "" if need is None else f'<b style="left:{100 * need[k] / largest:.1f}%"></b>'
        asked = _NONE if need is None else f"{number(float(need[k]), 1)}°"
        rows.append(
            f"<span>{f'Segment {k + 1}' if len(can) > 1 else 'Required / available'}</span>"
            f'<span class="rxa-track"><i style="width:{100 * each / largest:.1f}%;background:rgba(28,126,214,.35)"></i>'
            f'<i style="width:{100 * share * each / largest:.1f}%;background:#1c7ed6"></i>{mark}</span>'
            f'<span class="rx-num">{asked} / {number(float(each), 1)}°</span>'
        )
    return f'<div class="rx rxa-bars" data-explorer="segments">{"".join(rows)}</div>'


def limit_words(name: str) -> str:
    """The name of a limit as an engineer reads it."""
    return "minimum torsional stiffness" if name == "torsion-least" else name.replace("-", " ")


def limits_panel(verdict: Verdict | None) -> str:
    """Every limit: those broken with their sentence, the others by name, and the data to be wary of."""
    if verdict is None:
        return ""
    broken = "".join(_limit(limit) for limit in verdict.broken)
    kept = ", ".join(limit_words(limit.name) for limit in verdict.limits if limit.ok)
    good = f'<div><span class="rx-good">✓</span><span class="rx-dim">met: {escape(kept)}</span></div>' if kept else ""
    cares = "".join(f'<div class="rx-care"><span>▲</span><span>{escape(text)}</span></div>' for text in verdict.caveats)
    return f'<div class="rx rxa-limits" data-explorer="limits">{broken}{good}{cares}</div>'


def _limit(limit: Limit) -> str:
    name = escape(limit_words(limit.name))
    return f'<div><span class="rxa-bad">✕</span><span><b>{name}</b> {escape(typographic(limit.sentence))}</span></div>'


def _kw(power: float | None) -> str:
    return _NONE if power is None else f"{number(1e-3 * power, 1, sign=True)} kW"


FLAT = 50.0
"""Changes of power below this are called none [W]."""
_POINTS = 73


def phase_plot(power: PowerMap, inputs: ActuatorInputs, previous: Range | None) -> Plot:
    """Change of power [kW] over phase [°]: at full amplitude, at this one, and now."""
    phases = np.linspace(0.0, 2.0 * math.pi, _POINTS)
    share, phase = 0.01 * inputs.amplitude, math.radians(inputs.phase)
    largest = float(power.shares[-1])
    now = _single(phases, phase, float(power.change(share, phase)))
    return _plot(np.degrees(phases), [power.change(largest, phases), power.change(share, phases), now], previous)


def amplitude_plot(power: PowerMap, inputs: ActuatorInputs, previous: Range | None) -> Plot:
    """Change of power [kW] over amplitude [%]: best phase, this phase, the limit beyond which more costs, now."""
    shares = np.linspace(0.0, 1.0, _POINTS)
    share, phase = 0.01 * inputs.amplitude, math.radians(inputs.phase)
    shown = np.where(shares <= power.shares[-1] + 1e-9, shares, np.nan)
    limit = power.limit(phase)
    series = [
        power.change(shown, power.best()[1]),
        power.change(shown, phase),
        _single(shares, limit, float(power.change(limit, phase))),
        _single(shares, share, float(power.change(share, phase))),
    ]
    return _plot(100.0 * shares, series, previous)


def _single(x: Array, at: float, value: float) -> Array:
    """One point, at the nearest abscissa."""
    points = np.full(len(x), np.nan)
    points[int(np.abs(x - at).argmin())] = value
    return points


def _plot(x: Array, series: list[Array], previous: Range | None) -> Plot:
    kilowatts = [1e-3 * values for values in series]
    seen = np.concatenate(kilowatts)
    low, high = min(float(np.nanmin(seen)), -0.5), max(float(np.nanmax(seen)), 0.5)
    return Plot((x, *kilowatts), held_range(previous, low, high))


def sweep_sentence(power: PowerMap | str | None, inputs: ActuatorInputs, design: Design) -> str:
    """What the charts say: the least power, and the limit beyond which more twist costs at this phase."""
    if design.hovering:
        return "Off in hover: fly faster."
    if power is None:
        return "Trimming amplitudes and phases…"
    if isinstance(power, str):
        return power
    share, phase, change = power.best()
    limit, most = power.limit(math.radians(inputs.phase)), float(power.shares[-1])
    here = "At this phase "
    if limit <= 0.005:
        here += "every amplitude costs power."
    elif limit >= most - 0.005:
        here += f"more twist saves more, up to {number(100.0 * most)} %."
    else:
        here += f"twist beyond {number(100.0 * limit)} % costs power again."
    if change > -FLAT:
        return f"No amplitude saves power at {inputs.per_rev}/rev. {here}"
    least = f"{number(100.0 * share)} % at {number(math.degrees(phase))}°: {number(1e-3 * change, 1, sign=True)} kW"
    return f"Least power: {least}, before the actuator's mass and losses. {here}"


_WIDTH, _HEIGHT = 312.0, 92.0
_MIDDLE = 46.0
_PLY = 3.4
"""Plies are drawn this thick [px]; to scale they would be half a pixel."""
_GAP = 0.2


@lru_cache(maxsize=32)
def section_svg(installed: InstalledActuator, shares: tuple[float, ...]) -> str:
    """The cut through the blade at its middle segment; `shares` −1…1 colour the plies as they do on the blade."""
    middle = len(shares) // 2
    share = shares[middle]
    picture = section_picture(installed, exaggerate=1.6)
    scale = (_WIDTH - 12.0) / picture.chord
    looks = {
        "spar": 'fill="#5c6b80"',
        "skin": 'fill="#9aa3ad"',
        "web": 'fill="#3f4b5c"',
        "outline": 'fill="rgba(128,128,128,.14)" stroke="currentColor" stroke-width=".7"',
        "tube": f'fill="{css(drive_colour(share))}" stroke="currentColor" stroke-width=".6"',
    }
    marks = [
        _ply(part, scale, share)
        if part.role == "ply"
        else polygon(((6.0 + scale * y, _MIDDLE - scale * z) for y, z in part.points), looks[part.role])
        for part in picture.parts
    ]
    return (
        f'<div class="rx" data-explorer="section"><svg viewBox="0 0 {_WIDTH:g} {_HEIGHT:g}" width="100%" '
        f'role="img" aria-label="Section of the blade with its plies">{"".join(marks)}{_scale(installed)}</svg>'
        f'<div class="rx-dim rx-small">{escape(_caption(installed, middle + 1))}</div></div>'
    )


def _ply(part: Part, scale: float, share: float) -> str:
    """A band outside the contour along the ply's own line."""
    along = part.points[: len(part.points) // 2] * scale
    upper = "upper" in part.label.rsplit(",", 1)[-1]
    offset = (_GAP + 0.5 * _PLY) * (1.0 if upper else -1.0)
    points = " ".join(f"{6.0 + x:.1f},{_MIDDLE - y - offset:.1f}" for x, y in along)
    return (
        f'<polyline class="rx-ply" points="{points}" fill="none" stroke="currentColor" stroke-width="{_PLY + 1.2:g}"/>'
        f'<polyline points="{points}" fill="none" stroke="{css(drive_colour(share))}" stroke-width="{_PLY:g}"/>'
    )


def _scale(installed: InstalledActuator) -> str:
    front, rear = installed.placement.chord
    ends = (0.0, front, rear, 1.0) if isinstance(installed.actuator, PiezoPly) else (0.0, 1.0)
    marks = []
    for end in ends:
        x = 6.0 + (_WIDTH - 12.0) * end
        marks.append(line((x, 76.0), (x, 80.0), width=0.8))
        place = "start" if end < 0.03 else "end" if end > 0.97 else "middle"
        if not (0.0 < end < 0.08 or 0.9 < end < 1.0):
            look = f'font-size="12.5" fill="currentColor" text-anchor="{place}"'
            marks.append(f'<text x="{x:.1f}" y="90" {look}>{end:g} c</text>')
    return "".join(marks) + line((6.0, 78.0), (_WIDTH - 6.0, 78.0), width=0.5)


def _caption(installed: InstalledActuator, segment: int) -> str:
    labels = [part.label for part in section_picture(installed).parts]
    walls = next((label.split(",")[0] for label in labels if "spar" in label or "box" in label), "")
    plies = next((label.rsplit(",", 1)[0] for label in labels if "±" in label), installed.actuator.name)
    front, rear = installed.placement.chord
    where = f" per side, {100 * front:.0f}–{100 * rear:.0f} % chord" if isinstance(installed.actuator, PiezoPly) else ""
    shown = f" Segment {segment}." if len(installed.shapes) > 1 else ""
    return f"SC1095 with {walls} and web; {plies}{where}.{shown} Wall and ply thickness exaggerated."
