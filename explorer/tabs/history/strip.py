"""The history as a strip of bars, as high as their power, and the kept designs as rows; a click takes one."""

import math
from collections.abc import Mapping, Sequence
from html import escape

import numpy as np

from explorer.state import Inputs
from explorer.text.design_words import flight_name, twist_name
from explorer.text.units import SI, Units
from explorer.theme.colours import BASELINE, NOW, THIS
from explorer.undo import History, KeptDesign
from rotor.trim.solution import Solution

FIELD = "Take step"
"""Label of the text field that clicks are written to: `step 3`, `take 1`, `drop 1`."""
MOST_KEPT = 8
SHOWN = 40
"""Bars of the strip: the newest steps."""

_WIDTH, _HEIGHT, _LOWEST = 300.0, 40.0, 7.0
_SPARK = 46.0, 18.0


def strip(history: History, powers: Mapping[Inputs, float], units: Units = SI) -> str:
    """SVG of the steps; `powers` [W] of those that were solved, a hollow bar for those that have no answer."""
    steps, present = history.steps, len(history.past)
    first = min(max(len(steps) - SHOWN, 0), present)  # The newest, unless undo has gone further back.
    shown = steps[first : first + SHOWN]
    known = [powers[step] for step in shown if step in powers]
    low, high = (min(known), max(known)) if known else (0.0, 1.0)
    pitch = min(_WIDTH / max(len(shown), 1), 16.0)
    bars = []
    for k, step in enumerate(shown):
        number_of = first + k
        power = powers.get(step)
        share = 0.5 if power is None or high - low < 1e-9 else (power - low) / (high - low)
        height = _LOWEST + share * (_HEIGHT - _LOWEST)
        colour = NOW if number_of == present else THIS if number_of < present else BASELINE
        fill = "none" if power is None else colour
        told = f"{twist_name(step)}; {flight_name(step, units)}; "
        told += "no trim" if power is None else units.watts(power)
        bars.append(
            f'<g data-write="{FIELD}" data-value="step {number_of}" class="rx-take">'
            f"<title>{escape(told)}</title>"
            f'<rect x="{pitch * k:.2f}" y="0" width="{pitch:.2f}" height="{_HEIGHT}" fill="transparent"/>'
            f'<rect x="{pitch * k + 0.6:.2f}" y="{_HEIGHT - height:.2f}" width="{max(pitch - 1.2, 1.0):.2f}" '
            f'height="{height:.2f}" rx="1" fill="{fill}" stroke="{colour}" stroke-width=".8"/></g>'
        )
    return (
        f'<svg viewBox="0 0 {_WIDTH:g} {_HEIGHT:g}" width="100%" class="rx-strip" data-explorer="history" '
        f'data-steps="{len(steps)}" data-present="{present}" role="img" aria-label="Steps of the design">'
        f"{''.join(bars)}</svg>"
    )


def caption(history: History) -> str:
    """Where in the history the page stands."""
    return (
        f'<div class="rx-line rx-dim rx-small"><span>Step {len(history.past) + 1} of {len(history.steps)}</span>'
        "<span>bar height: total power; click to go there</span></div>"
    )


def kept_rows(kept: Sequence[KeptDesign], present: Solution | None, units: Units = SI) -> str:
    """The kept designs: outline of the twist, name, power, and the change of the present design from it."""
    if not kept:
        return '<div class="rx-dim rx-small">No bookmarks yet: Keep bookmarks this design.</div>'
    rows = []
    for k, item in enumerate(kept):
        change = _blank_change(present, item, units)
        take, drop = (f'data-write="{FIELD}" data-value="{verb} {k}"' for verb in ("take", "drop"))
        rows.append(
            f'<tr><td {take} class="rx-take">{_spark(item.solution)}</td>'
            f'<td {take} class="rx-take rx-kept"><div>{escape(twist_name(item.inputs))}</div>'
            f'<div class="rx-dim rx-small">{escape(flight_name(item.inputs, units))}</div></td>'
            f'<td {take} class="rx-take rx-num">{units.watts(item.power)}'
            f'<div class="rx-dim rx-small">{change}</div></td>'
            f'<td class="rx-num"><a {drop} class="rx-take rx-dim" title="Forget it">✕</a></td></tr>'
        )
    return f'<table class="rx-kept-table" data-explorer="kept">{"".join(rows)}</table>'


def asked(text: str) -> tuple[str, int] | None:
    """What a click on the strip or on the rows asks for; None for a text that asks for nothing."""
    verb, _, digits = text.strip().partition(" ")
    return (verb, int(digits)) if verb in ("step", "take", "drop") and digits.isdigit() else None


def _blank_change(present: Solution | None, item: KeptDesign, units: Units) -> str:
    if present is None or not math.isfinite(item.power):
        return ""
    return f"now {units.watts(present.power.total - item.power, sign=True)}"


def _spark(solution: Solution) -> str:
    """The twist along the blade, ±12° high."""
    width, height = _SPARK
    r = np.linspace(solution.design.rotor.blade.root_cutout, 1.0, 24)
    angle = np.clip(np.degrees(solution.design.twist(r)) / 12.0, -1.0, 1.0)
    points = " ".join(f"{width * x:.1f},{0.5 * height * (1.0 - y):.1f}" for x, y in zip(r, angle, strict=True))
    return (
        f'<svg width="{width:g}" height="{height:g}"><path d="M0,{0.5 * height} h{width}" stroke="currentColor" '
        f'opacity=".25"/><polyline points="{points}" fill="none" stroke="{THIS}" stroke-width="1.6"/></svg>'
    )
