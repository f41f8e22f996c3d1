"""The small drawing of what a concept of twist moves."""

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from explorer.charts import svg
from explorer.colours import NOW, THIS
from rotor.design import PiecewiseLinearTwist
from rotor.optimisation import Concept
from rotor.optimisation.concepts import Handle
from rotor.support.markup import Markup, tag

_WIDTH, _HEIGHT, _EDGE = 272, 62, 8
_MIDDLE, _AMPLITUDE = 28, 15
_ROOT = 0.13
_NOMINAL = {
    "tilt": (-0.21, -0.09, -0.24),
    "bend": (0.28,),
    "lift": (0.17, 0.09, 0.055, 0.03, -0.025, -0.05),
}
"""Typical values [SI] that tell the shapes apart; a slide stands where it is typical."""


@lru_cache(maxsize=32)
def concept_picture(concept: Concept) -> Markup:
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
        return _MIDDLE - _AMPLITUDE * (
            2.0 * (float(law(np.array([at]))[0]) - bottom) / (top - bottom) - 1.0
        )

    curve = " ".join(f"{_x(float(at)):.1f},{y(float(at)):.1f}" for at in r)
    marks = [_mark(handle, y) for handle in concept.handles]
    if isinstance(law, PiecewiseLinearTwist):
        marks += [tag("circle", cx=_x(place), cy=y(place), r=3, fill=THIS) for place in law.breaks]
    root, tip = _x(_ROOT), _x(1.0)
    ends = (
        tag("text", "root", x=root, y=_HEIGHT - 2),
        tag("text", "tip", x=tip, y=_HEIGHT - 2, text_anchor="end"),
    )
    middle = svg.line((root, _MIDDLE), (tip, _MIDDLE), opacity=0.25)
    drawn = tag("polyline", points=curve, fill="none", stroke="currentColor", stroke_width=2)
    words = tag("g", ends, font_size=11, fill="currentColor", opacity=0.65)
    return svg.drawing(_WIDTH, _HEIGHT, "what the concept moves", middle, drawn, marks, words)


def _x(r: float) -> float:
    return round(_EDGE + (_WIDTH - 2 * _EDGE) * (r - _ROOT) / (1.0 - _ROOT), 1)


def _mark(handle: Handle, y: Callable[[float], float]) -> Markup:
    if handle.motion == "slide":
        low, high = _x(handle.inner), _x(handle.outer)
        return _arrow(low, 52.0, high, 52.0, THIS)
    at = (
        handle.inner if handle.motion == "lift" else 0.5 * (max(handle.inner, _ROOT) + handle.outer)
    )
    if handle.motion == "tilt" and handle.outer - handle.inner >= 1.0:
        at = 0.93
    x, middle = _x(max(at, _ROOT)), y(at)
    return _arrow(x, middle - 11.0, x, middle + 11.0, NOW)


def _arrow(x1: float, y1: float, x2: float, y2: float, colour: str) -> Markup:
    """A line with a head at both ends."""
    if x1 == x2:
        heads = f"M{x1 - 3},{y1 + 4} L{x1},{y1} L{x1 + 3},{y1 + 4} M{x2 - 3},{y2 - 4} L{x2},{y2} L{x2 + 3},{y2 - 4}"
    else:
        heads = f"M{x1 + 4},{y1 - 3} L{x1},{y1} L{x1 + 4},{y1 + 3} M{x2 - 4},{y2 - 3} L{x2},{y2} L{x2 - 4},{y2 + 3}"
    return tag(
        "path", d=f"M{x1},{y1} L{x2},{y2} {heads}", fill="none", stroke=colour, stroke_width=1.5
    )
