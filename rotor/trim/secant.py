"""How far a design lies ahead on the line through two others, for trims that begin on the secant through theirs.

A hand that drags changes one thing, step by step: with it every unknown of the trim varies nearly in proportion.
"""

import math
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any, cast

import numpy as np

from rotor.design.design import Design

_FARTHEST = 3.0
"""Steps beyond which the last trim itself is the better start; one more back, to the first of the two. Our choice."""
_PARALLEL = 0.3
"""Part of the larger of two changes of a number by which it may be out of proportion with the others. Our choice."""
_NO_CHANGE = 1e-12
"""Change of a number, in its own unit, that rounding makes."""


def steps_ahead(before: Design, latest: Design, design: Design) -> float | None:
    """How many of the steps from one design to the next lead from there to a third, negative on the way back.

    None where it does not lie on their line or lies far off, or where more than numbers changes.
    """
    if len({before.hovering, latest.hovering, design.hovering}) > 1:
        return None
    last, now = np.array(list(_moves(before, latest, design))).reshape(-1, 2).T
    if not last.all():
        return None
    steps = float((now / last).mean()) if len(last) else math.nan
    off = np.abs(now - steps * last) / np.maximum(np.abs(last), np.abs(now))
    return steps if abs(steps + 0.5) <= _FARTHEST + 0.5 and bool((off <= _PARALLEL).all()) else None


def _moves(before: object, latest: object, design: object) -> Iterator[tuple[float, float]]:
    """The last change and the new one of each number that changes; NaN for anything else but a name that does."""
    each = before, latest, design
    if before is latest is design:
        return
    if all(isinstance(one, float) for one in each):
        a, b, c = cast(tuple[float, float, float], each)
        if max(abs(b - a), abs(c - b)) > _NO_CHANGE:
            yield b - a, c - b
    elif type(before) is type(latest) is type(design) and is_dataclass(design):
        for one in fields(design):
            if one.compare and one.name not in ("name", "spec"):
                yield from _moves(*(getattr(given, one.name) for given in each))
    elif (
        all(isinstance(one, tuple) for one in each)
        and len({len(one) for one in cast(tuple[Any, ...], each)}) == 1
    ):
        for parts in zip(*cast(tuple[tuple[Any, ...], ...], each), strict=True):
            yield from _moves(*parts)
    elif not before == latest == design:
        yield math.nan, math.nan
