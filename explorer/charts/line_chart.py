"""A line chart as SVG for stand-alone pages. Text and grid take their colours from the page."""

import math
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from explorer.charts import svg
from explorer.charts.plots import Range, held_range
from explorer.picture.fields import tick_text, ticks
from rotor.arrays import Array

WIDE, HIGH = 520.0, 270.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 52.0, 14.0, 12.0, 40.0
_SIZE = 12.0
"""Font size."""


@dataclass(frozen=True, eq=False)
class Trace:
    """One line; NaN is a gap."""

    label: str
    colour: str
    x: Array
    y: Array
    dash: str = ""
    """As in SVG, for example 5 3."""
    width: float = 2.0
    points: bool = False
    """Points instead of a line."""


def line_chart(
    title: str,
    x_label: str,
    y_label: str,
    traces: Sequence[Trace],
    x_range: Range,
    y_range: Range | None = None,
    high: float = HIGH,
) -> str:
    """The chart with title and a key of the labelled lines; lines are clipped at the axes."""
    y_range = y_range or _fitted(traces)
    frame = _Frame(x_range, y_range, high)
    lines = "".join(_points(frame, trace) if trace.points else _line(frame, trace) for trace in traces)
    clip = f"clip-{_name(title, traces)}"
    return (
        f'<figure class="chart"><figcaption><b>{escape(title)}</b>{_key(traces)}</figcaption>'
        f'<svg viewBox="0 0 {WIDE:g} {high:g}" role="img" aria-label="{escape(title, quote=True)}">'
        f'<clipPath id="{clip}"><rect x="{_LEFT:g}" y="{_TOP:g}" width="{frame.wide:g}" height="{frame.high:g}"/>'
        f'</clipPath>{frame.axes(x_label, y_label)}<g clip-path="url(#{clip})" fill="none">{lines}</g></svg></figure>'
    )


@dataclass(frozen=True)
class _Frame:
    x_range: Range
    y_range: Range
    full_height: float

    @property
    def wide(self) -> float:
        return WIDE - _LEFT - _RIGHT

    @property
    def high(self) -> float:
        return self.full_height - _TOP - _BOTTOM

    def place(self, x: Array, y: Array) -> Array:
        """Points of the drawing, (n, 2); points far outside are moved to just outside, so that paths stay short."""
        across = (x - self.x_range[0]) / (self.x_range[1] - self.x_range[0])
        up = (y - self.y_range[0]) / (self.y_range[1] - self.y_range[0])
        return np.stack(
            (_LEFT + self.wide * np.clip(across, -1.0, 2.0), _TOP + self.high * (1.0 - np.clip(up, -1.0, 2.0))), axis=1
        )

    def axes(self, x_label: str, y_label: str) -> str:
        bottom, right = _TOP + self.high, _LEFT + self.wide
        grid, words = [], []
        for value in ticks(*self.x_range, about=7):
            x = float(self.place(np.array([value]), np.array([self.y_range[0]]))[0, 0])
            grid.append(f"M{x:.1f},{_TOP:g}V{bottom:g}")
            words.append(svg.text(x, bottom + 1.25 * _SIZE, tick_text(value), _SIZE - 1, anchor="middle"))
        for value in ticks(*self.y_range, about=5):
            y = float(self.place(np.array([self.x_range[0]]), np.array([value]))[0, 1])
            grid.append(f"M{_LEFT:g},{y:.1f}H{right:g}")
            words.append(svg.text(_LEFT - 6, y + 0.35 * _SIZE, tick_text(value), _SIZE - 1, anchor="end"))
        return (
            f'<path class="grid" d="{"".join(grid)}"/><path class="axis" d="M{_LEFT:g},{_TOP:g}V{bottom:g}H{right:g}"/>'
            + "".join(words)
            + svg.text(0.5 * (_LEFT + right), self.full_height - 5, x_label, _SIZE, anchor="middle", opacity=0.75)
            + f'<g transform="translate(12 {0.5 * (_TOP + bottom):.1f}) rotate(-90)">'
            + svg.text(0, 0, y_label, _SIZE, anchor="middle", opacity=0.75)
            + "</g>"
        )


def _line(frame: _Frame, trace: Trace) -> str:
    points = frame.place(trace.x, trace.y)
    known = np.asarray(np.isfinite(points).all(axis=1))
    runs = np.split(np.arange(len(points)), np.flatnonzero(~known))
    lines = [np.compress(known[run], points[run], axis=0) for run in runs]
    path = svg.polylines([line for line in lines if len(line) > 1])
    dash = f' stroke-dasharray="{trace.dash}"' if trace.dash else ""
    return f'<path d="{path}" stroke="{trace.colour}" stroke-width="{trace.width:g}" stroke-linejoin="round"{dash}/>'


def _points(frame: _Frame, trace: Trace) -> str:
    points = frame.place(trace.x, trace.y)
    return "".join(
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.2" fill="{trace.colour}" class="dot"/>'
        for x, y in points
        if math.isfinite(x) and math.isfinite(y)
    )


def _key(traces: Sequence[Trace]) -> str:
    entries = []
    for trace in traces:
        if not trace.label:
            continue
        dash = f' stroke-dasharray="{trace.dash}"' if trace.dash else ""
        swatch = f'<path d="M0,5h20" stroke="{trace.colour}" stroke-width="{trace.width:g}"{dash}/>'
        if trace.points:
            swatch = f'<circle cx="10" cy="5" r="4" fill="{trace.colour}"/>'
        entries.append(f'<span><svg width="20" height="10">{swatch}</svg> {escape(trace.label)}</span>')
    return f'<span class="key">{"".join(entries)}</span>'


def _fitted(traces: Sequence[Trace]) -> Range:
    known = np.concatenate([trace.y[np.isfinite(trace.y)] for trace in traces])
    return held_range(None, float(known.min()), float(known.max())) if len(known) else (0.0, 1.0)


def _name(title: str, traces: Sequence[Trace]) -> str:
    """A name that no other chart on the page has."""
    return f"{zlib.crc32(b''.join([title.encode(), *(trace.y.tobytes() for trace in traces)])):x}"
