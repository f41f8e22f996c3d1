"""Words, numbers and the drawn section of the Actuate mode; degrees, volts and kW begin here."""

import math
from collections.abc import Iterable
from functools import lru_cache
from html import escape

import numpy as np

from explorer.charts.svg import line, polygon
from explorer.colours import css
from explorer.model.units import number
from explorer.tabs.actuator.actuator_inputs import ActuatorInputs
from explorer.tabs.actuator.actuator_tasks import Outcome
from explorer.tabs.actuator.lifted_picture import drive_colour, drive_text
from rotor import Solution
from rotor.actuator import (
    Actuator,
    ExtensionTwist,
    InstalledActuator,
    PiezoPly,
    Verdict,
    verdict_details,
    verdict_sentence,
)
from rotor.actuator.limits import Limit
from rotor.actuator.pictures import Part, section_picture
from rotor.units import typographic

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


def now_panel(inputs: ActuatorInputs, installed: InstalledActuator, solution: Solution) -> str:
    """What the sliders make of the blade at this moment. `solution` with the actuator."""
    tip = math.degrees(inputs.tip(installed, solution.design))
    drives = " · ".join(drive_text(inputs, installed, k) for k in range(len(installed.shapes)))
    words = f"tip twist at {drives}" if inputs.driven else "tip twist, at rest"
    return (
        '<div class="rx" data-explorer="actuator-now"><div class="rxa-now">'
        f'<b data-explorer="actuator-twist">{number(tip, 2, sign=True)}°</b><span class="rx-dim">{words}</span>'
        "</div></div>"
    )


def named_lines(entries: Iterable[tuple[str, str]]) -> str:
    """Names with their values, one a line; as HTML."""
    return "".join(
        f'<div class="rx-line"><span class="rx-dim">{name}</span><span class="rx-num">{value}</span></div>'
        for name, value in entries
    )


def fit_panel(installed: InstalledActuator, verdict: Verdict | None) -> str:
    """Numbers in two columns: those of the actuator on the blade are known at once, those of the verdict follow."""
    masses = installed.masses
    entries = [
        ("Required Δtwist", _NONE if verdict is None else f"{number(math.degrees(verdict.required), 2)}°"),
        ("Added mass", f"{number(masses.aircraft)} kg"),
        ("Available", f"{number(math.degrees(installed.attainable), 2)}°"),
        ("on each blade", f"{number(masses.blade, 1)} kg"),
        ("First torsion", f"{number(installed.frequency, 2)} /rev"),
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


def segments_panel(installed: InstalledActuator, verdict: Verdict | None) -> str:
    """Bars: what each segment can make, with a mark where the optimum asks for it."""
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
            f'<span class="rxa-track"><i style="width:{100 * each / largest:.1f}%;background:#1c7ed6"></i>{mark}</span>'
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
